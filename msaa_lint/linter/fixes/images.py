"""`do: allow-multisampling` and `do: share-image`: changes to the images that a description
declares.
"""

from __future__ import annotations

from msaa_lint.frame.facts.facts import Subject

from .changes import Change, NoFix
from .context import FixContext
from .subject_parts import described_image


def allow_multisampling(subject: Subject, _: FixContext) -> list[Change]:
    """Removes the mip levels, dimensions, cube faces and tiling that Vulkan forbids for an image
    with more than one sample.

    VUID-VkImageCreateInfo-samples-02257. For other conflicts, the image needs one sample, or
    another format or usage.
    """
    image = described_image(subject)
    conflicts = subject.facts.values.get("image.multisampling_conflicts")
    removable = ("mipLevels ", "imageType ", "CUBE_COMPATIBLE", "LINEAR tiling")
    if not isinstance(conflicts, list) or not all(
        str(conflict).startswith(removable) for conflict in conflicts
    ):
        raise NoFix(
            "whether the image needs one sample, or another format or usage, has to be decided"
        )
    required = (("mipLevels", 1), ("imageType", "2D"), ("tiling", "OPTIMAL"))
    return [
        Change(image, "flags", "remove", "CUBE_COMPATIBLE"),
        *(
            Change(image, member, "set", value)
            for member, value in required
            if image.states(member)
        ),
    ]


def share_image(subject: Subject, context: FixContext) -> list[Change]:
    """Uses one image in all framebuffers in place of several that alternate, and removes the
    others.
    """
    names = subject.facts.values.get("image.taking_turns")
    description = context.document.description
    if not isinstance(names, list) or len(names) < 2:
        raise NoFix("the image does not alternate with others")
    shared, others = str(names[0]), {str(name) for name in names[1:]}
    framebuffers = list(description.framebuffers.values())
    if any(context.references.has_others(name, framebuffers) for name in others):
        raise NoFix("commands or attachments name the other images")
    changes = [
        Change(framebuffer, "attachments", "replace", (index, shared))
        for framebuffer in framebuffers
        for index, name in enumerate(framebuffer.attachments)
        if name in others
    ]
    return [
        *changes,
        *(
            Change(description, "images", "drop", n)
            for n, name in enumerate(description.images)
            if name in others
        ),
    ]

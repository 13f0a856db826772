"""Frames with another sample count."""

from __future__ import annotations

from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import (
    RENDERING,
    Aspect,
    Attachment,
    Pass,
    PassSubpass,
    Resolve,
    Target,
)

from .frame_edits import (
    attachments_by_target,
    command_order,
    effective_resolves,
    images_of_commands,
    own_image,
    rename_images,
    set_commands,
)
from .resolves import inline

COUNTS = (1, 2, 4, 8, 16, 32, 64)
"""VkSampleCountFlagBits."""


def is_multisampled(frame: Frame) -> bool:
    """Whether anything in a frame has more than one sample."""
    if any((target.samples or 1) > 1 for target in frame.all_targets):
        return True
    return any(
        any(attachment.samples not in (None, 1) for attachment in render_pass.attachments)
        or any(subpass.single_sampled for subpass in render_pass.subpasses)
        for render_pass in frame.passes
    )


def set_samples(frame: Frame, samples: int) -> None:
    """Gives everything that has more than one sample another sample count."""
    attachments = [
        attachment for render_pass in frame.passes for attachment in render_pass.attachments
    ]
    targets = [
        *frame.targets.values(),
        *(target for attachment in attachments for target in attachment.targets),
    ]
    multisampled: list[Target | Attachment] = [*targets, *attachments]
    for part in multisampled:
        if part.samples is not None and part.samples > 1:
            part.samples = samples
    for render_pass in frame.passes:
        for subpass in render_pass.subpasses:
            if subpass.single_sampled and subpass.single_sampled_count != 1:
                subpass.single_sampled_count = samples


def remove_multisampling(frame: Frame) -> None:
    """Removes multisampling: nothing is resolved, and passes draw to what they resolved to.

    If a pass resolves a source to several images, it draws to the last; the others are written as
    before.
    """
    inline(frame)
    replacements: dict[str, dict[str, Target]] = {}
    for render_pass in frame.passes:
        for resolve in reversed(effective_resolves(render_pass)):
            source, target = resolve.source, resolve.written_part
            assert source is not None and target is not None
            names = [image.name for image in source.targets if image.image is not None]
            if isinstance(target, Attachment):
                if not source.used:
                    continue
                _draw_to_attachment(render_pass, source, target)
                images = target.targets
            else:
                if resolve not in render_pass.subpasses[0].resolves:
                    continue
                _draw_to_image(render_pass.subpasses[0], resolve, target)
                images = [target]
            for name in names:
                replacements.setdefault(name, {}).update((image.name, image) for image in images)
    set_samples(frame, 1)
    for render_pass in frame.passes:
        for subpass in render_pass.subpasses:
            subpass.single_sampled, subpass.single_sampled_count = False, None
    _replace_images(
        frame,
        {name: images.popitem()[1] for name, images in replacements.items() if len(images) == 1},
    )
    used, named = attachments_by_target(frame), images_of_commands(frame)
    for name in replacements:
        if id(frame.targets[name]) not in used and name not in named:
            del frame.targets[name]


def _draw_to_attachment(render_pass: Pass, source: Attachment, target: Attachment) -> None:
    """Puts a resolve target of a render pass in place of its source: loaded like the source, stored
    if either was.
    """
    resolved_aspects = {aspect for aspects in target.resolve.values() for aspect in aspects}
    stores = {aspect.name: aspect.store for aspect in target.aspects}
    for index in source.color | source.depth_stencil:
        subpass = render_pass.subpasses[index]
        subpass.color = [
            target if attachment is source else attachment for attachment in subpass.color
        ]
        subpass.depth_stencil = [
            target if attachment is source else attachment for attachment in subpass.depth_stencil
        ]
        subpass.resolves = [
            resolve
            for resolve in subpass.resolves
            if resolve.source is not source or resolve.target is not target
        ]
        target.resolve.pop(index, None)
    target.color |= source.color
    target.depth_stencil |= source.depth_stencil
    target.input |= source.input
    source.color, source.depth_stencil, source.input = set(), set(), set()
    target.aspects = [
        aspect._replace(
            store=_either_store(aspect.store, stores.get(aspect.name))
            if aspect.name in resolved_aspects
            else aspect.store
        )
        for aspect in source.aspects
    ]
    for image, source_image in zip(
        target.targets, source.targets * len(target.targets), strict=False
    ):
        _take_extent(image, source_image)
        _take_wider_format(image, source)
    _take_wider_format(target, source)


def _either_store(one: str | None, other: str | None) -> str | None:
    """The store operation of contents that are stored if either is; None if that depends on an
    unknown one.
    """
    if "STORE" in (one, other):
        return "STORE"
    return None if None in (one, other) else other


def _draw_to_image(subpass: PassSubpass, resolve: Resolve, target: Target) -> None:
    """Puts the resolve target of a rendering in place of its source; it is stored, as the resolve
    wrote it whatever storeOp was.
    """
    source = resolve.source
    assert source is not None
    # Depth and stencil belong to one image: the aspect that is not resolved moves along.
    moved = subpass.depth_stencil if source.depth_stencil else [source]
    resolved = {id(each.source) for each in subpass.resolves if each.is_certain}
    for attachment in moved:
        for image in attachment.targets:
            _take_extent(target, image)
        _take_wider_format(target, attachment)
        if id(attachment) in resolved:
            attachment.aspects = [
                Aspect(a.name, a.load, "STORE", a.load_member, a.store_member)
                for a in attachment.aspects
            ]
        attachment.name, attachment.targets = target.name, [target]
    subpass.resolves = [
        each
        for each in subpass.resolves
        if not any(each.source is attachment for attachment in moved)
    ]


def _take_extent(target: Target, source: Target) -> None:
    """Gives an image the extent of another, if it states none."""
    if (
        target.image is not None
        and target.image.extent is None
        and source.image is not None
        and source.image.extent is not None
    ):
        image = own_image(target)
        assert image is not None
        image.extent = source.image.extent


def _take_wider_format(target: Target | Attachment, source: Attachment) -> None:
    """Gives an image the format of what is now drawn to it, if that has more aspects."""
    if source.format is not None and len(source.format.aspects) > len(
        target.format.aspects if target.format is not None else ()
    ):
        target.format = source.format


def _replace_images(frame: Frame, images: dict[str, Target]) -> None:
    """Replaces images wherever they are used."""
    if not images:
        return
    for render_pass in frame.passes:
        for attachment in render_pass.attachments:
            attachment.targets = [
                images.get(t.name, t) if t.image is not None else t for t in attachment.targets
            ]
            if render_pass.kind == RENDERING and attachment.targets:
                attachment.name = attachment.targets[0].name
    if frame.has_commands:
        names = {name: target.name for name, target in images.items()}
        set_commands(
            frame,
            [(rename_images(command, names), begun) for command, begun in command_order(frame)],
        )

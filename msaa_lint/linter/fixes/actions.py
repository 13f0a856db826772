"""What pages name by `do`: changes that take more than a member and a value."""

from __future__ import annotations

from collections.abc import Callable

from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import Image
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Resolve, Target

from .changes import Change, FixContext, Refused
from .clears import clear_on_load, draw_the_copy
from .fact_sources import mode_place
from .inline_resolve import resolve_in_pass
from .read_resolve import resolve_before_read
from .resolve_depth import hand_over_depth
from .resolves import drop_resolve, resolve_to_copy, share_image, wait_for_resolve
from .transient import make_transient

Deed = Callable[[Subject, FixContext], list[Change] | Refused]


def resolve_by_sample_zero(subject: Subject, _: FixContext) -> list[Change] | Refused:
    """SAMPLE_ZERO for both aspects: what every device offers. An aspect that is not resolved stays so, if a device allows that."""
    resolve = subject.of
    if not isinstance(resolve, Resolve):
        return Refused("it is about no resolve")
    both = subject.facts.values.get("resolve.pair_supported") is False
    ends = [each for each in (resolve, resolve.pair) if each is not None and (both or each.mode != "NONE")]
    if any(each.target is None and each.target_image is None for each in ends):
        return Refused("one of the two aspects has no image to be resolved to")
    places = [place for each in ends if (place := mode_place(each)) is not None]
    return [Change(record, member, "set", "SAMPLE_ZERO") for record, member, _ in places]


def allow_multisampling(subject: Subject, _: FixContext) -> list[Change] | Refused:
    """Takes away what Vulkan forbids beside more than one sample (VUID-VkImageCreateInfo-samples-02257), where it is stated."""
    image = subject.of.image if isinstance(subject.of, Target) else None
    if not isinstance(image, Image):
        return Refused("the image is not described")
    made = [Change(image, "flags", "remove", "CUBE_COMPATIBLE")]
    for member, value in (("mipLevels", 1), ("imageType", "2D"), ("tiling", "OPTIMAL")):
        if image.states(member):
            made.append(Change(image, member, "set", value))
    return made


DEEDS: dict[str, Deed] = {
    "make-transient": make_transient,
    "resolve-in-pass": resolve_in_pass,
    "resolve-before-read": resolve_before_read,
    "resolve-by-sample-zero": resolve_by_sample_zero,
    "allow-multisampling": allow_multisampling,
    "clear-on-load": clear_on_load,
    "draw-the-copy": draw_the_copy,
    "drop-resolve": drop_resolve,
    "resolve-to-copy": resolve_to_copy,
    "wait-for-resolve": wait_for_resolve,
    "share-image": share_image,
    "hand-over-depth": hand_over_depth,
}


def deed(name: str, document: Document) -> Deed:
    """What a name does to a frame in its API's words; where it is known of the other's alone, it refuses."""
    if document.metal is None:
        return DEEDS.get(name, _in_other_words)
    from .metal import DEEDS as OF_METAL

    return OF_METAL.get(name, _in_other_words)


def _in_other_words(_: Subject, __: FixContext) -> list[Change] | Refused:
    return Refused("the fix is for frames in another API's words")

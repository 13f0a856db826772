"""Facts of resolves: in a subpass, at the end of a rendering, by command."""

from __future__ import annotations

from ..devices import DeviceProfile
from ..devices.shares import resolve_mode_share
from ..vulkan.formats import Format
from .facts import Facts
from .frame import RENDERING, Frame, Pass, Resolve, Target
from .timeline import Timeline


def resolve_facts(resolve: Resolve, device: DeviceProfile | None) -> Facts:
    """What is known of a resolve by its structure."""
    facts = Facts()
    facts.put("resolve.kind", resolve.kind, resolve.record.head)
    facts.put("resolve.aspect", resolve.aspect, resolve.record.head)
    facts.put("resolve.mode", resolve.mode, resolve.mode_at)
    source, target = resolve.source_image, resolve.target_image
    facts.put("resolve.has_source", resolve.source is not None or source is not None, resolve.source_at)
    facts.put("resolve.has_target", resolve.target is not None or target is not None, resolve.target_at)
    facts.put("resolve.source", resolve.source.title if resolve.source is not None else source.title if source is not None else None)
    facts.put("resolve.target", resolve.target.title if resolve.target is not None else target.title if target is not None else None)
    facts.put("resolve.source_samples", _samples(resolve, "source"), resolve.source_at)
    facts.put("resolve.target_samples", _samples(resolve, "target"), resolve.target_at)
    from_format, to_format = _format(resolve, "source"), _format(resolve, "target")
    facts.put("resolve.source_format", from_format.name if from_format is not None else None, resolve.source_at)
    facts.put("resolve.target_format", to_format.name if to_format is not None else None, resolve.target_at)
    facts.put("resolve.source_numeric", from_format.numeric if from_format is not None and "color" in from_format.aspects else None)
    encoding = source.image.encoding if source is not None and source.image is not None else None
    at = source.image.place("encoding") if source is not None and source.image is not None else None
    facts.put("resolve.source_encoding", encoding, at)
    facts.put("resolve.source_is_data", encoding == "DATA")
    facts.put("resolve.formats_match", formats_match(resolve, from_format, to_format), resolve.target_at)
    single = resolve.within is not None and any(s.single_sampled for s in resolve.within.subpasses if s.index == resolve.subpass)
    facts.put("resolve.single_sampled_render", single)
    _modes(facts, resolve, device)
    return facts


def command_facts(facts: Facts, resolve: Resolve, position: int, frame: Frame, timeline: Timeline) -> None:
    """What the frame says of a vkCmdResolveImage: whether the pass before it could have resolved."""
    if resolve.source_image is None:
        return
    writer = _last_writer(resolve.source_image, position, frame, timeline)
    if writer is None:
        return
    within, written = writer
    facts.put("resolve.writer", within.name, within.record.head)
    attachments = [a for a in within.attachments if any(t is resolve.source_image for t in a.targets)]
    resolved = [r for s in within.subpasses for r in s.resolves if any(r.source is a for a in attachments)]
    facts.put("resolve.pass_could_resolve", written and not resolved)


def _last_writer(image: Target, position: int, frame: Frame, timeline: Timeline) -> tuple[Pass, bool] | None:
    """The pass begun last before a command that draws to the image, and whether nothing else wrote it in between."""
    begins = sorted(
        (at, each) for each in frame.passes for at in each.begun if any(a.drawn and image in a.targets for a in each.attachments)
    )
    before = [each for at, each in begins if at < position] or [each for _, each in begins]
    if not before:
        return None
    at = max(at for at, each in begins if each is before[-1])
    between = [u for u in timeline.uses.get(image.name, []) if at < u.position < position and u.kind != "read"]
    return before[-1], not between


def _samples(resolve: Resolve, end: str) -> int | None:
    attachment = resolve.source if end == "source" else resolve.target
    image = resolve.source_image if end == "source" else resolve.target_image
    return attachment.samples if attachment is not None else image.samples if image is not None else None


def _format(resolve: Resolve, end: str) -> Format | None:
    attachment = resolve.source if end == "source" else resolve.target
    image = resolve.source_image if end == "source" else resolve.target_image
    return attachment.format if attachment is not None else image.format if image is not None else None


def formats_match(resolve: Resolve, source: Format | None, target: Format | None) -> bool | None:
    """Whether Vulkan allows the two formats together.

    Colour, commands and dynamic rendering want the same format; a depth-stencil resolve in a render pass wants the same bits and type of
    each aspect that both have (VUID-VkSubpassDescriptionDepthStencilResolve-pDepthStencilResolveAttachment-03181, 03182).
    """
    if source is None or target is None:
        return None
    if resolve.within is not None and resolve.within.custom_resolve:
        return True
    if resolve.kind != "subpass" or resolve.aspect == "color":
        return source.name == target.name
    if resolve.aspect not in target.aspects:
        return True
    if resolve.aspect == "depth":
        return (source.depth_bits, source.depth_type) == (target.depth_bits, target.depth_type)
    return (source.stencil_bits, source.stencil_type) == (target.stencil_bits, target.stencil_type)


def _modes(facts: Facts, resolve: Resolve, device: DeviceProfile | None) -> None:
    pair = resolve.pair
    facts.put("resolve.first_of_pair", pair is None or resolve.aspect == "depth")
    modes = [resolve.mode] if pair is None else [resolve.mode, pair.mode]
    facts.put("resolve.all_modes_none", False if any(m not in (None, "NONE") for m in modes) else None if None in modes else True)
    if resolve.aspect == "color":
        return
    if resolve.mode is not None and resolve.mode != "NONE":
        facts.put("resolve.share_of_tilers", resolve_mode_share(resolve.mode, tilers=True))
    if device is None:
        return
    offered = device.depth_resolve_modes if resolve.aspect == "depth" else device.stencil_resolve_modes
    if offered is not None:
        facts.put("resolve.supported_modes", list(offered))
        if resolve.mode is not None and (resolve.mode in (*offered, "NONE") or not device.minimum):
            facts.put("resolve.mode_supported", resolve.mode in (*offered, "NONE"), resolve.mode_at)
    if pair is not None:
        facts.put("resolve.pair_supported", _pair_supported(resolve, pair, device), resolve.mode_at)


def _pair_supported(resolve: Resolve, pair: Resolve, device: DeviceProfile) -> bool | None:
    """Modes may differ with independentResolve, or with independentResolveNone where one is NONE (03185, 03186)."""
    if resolve.mode is None or pair.mode is None:
        return None
    if resolve.mode == pair.mode or device.independent_resolve:
        return True
    if "NONE" in (resolve.mode, pair.mode):
        answer = device.independent_resolve_none if not device.independent_resolve else True
        if device.independent_resolve is None and not answer:
            return None
    else:
        answer = device.independent_resolve
    return None if device.minimum and not answer else answer


__all__ = ["RENDERING", "command_facts", "formats_match", "resolve_facts"]

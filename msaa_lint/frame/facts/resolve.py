"""Facts of resolves: in a subpass, at the end of a rendering, by command."""

from __future__ import annotations

from msaa_lint.frame.description.models import ResolveImage
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.devices.shares import resolve_mode_share
from msaa_lint.frame.vulkan.formats import Format

from .facts import Facts
from .parts import Resolve, sizes_differ, states_mode
from .readers import Readers
from .timeline import Timeline


def resolve_facts(resolve: Resolve, device: DeviceProfile | None) -> Facts:
    """What is known of a resolve by its structure."""
    facts = Facts()
    facts.put("resolve.kind", resolve.kind, resolve.record.head)
    facts.put("resolve.aspect", resolve.aspect, resolve.record.head)
    facts.put("resolve.mode", resolve.mode, resolve.mode_at)
    formats: list[Format | None] = []
    for end, part, at in (
        ("source", resolve.read_part, resolve.source_at),
        ("target", resolve.written_part, resolve.target_at),
    ):
        format = part.format if part is not None else None
        formats.append(format)
        facts.put(f"resolve.has_{end}", part is not None, at)
        facts.put(f"resolve.{end}", part.title if part is not None else None)
        facts.put(f"resolve.{end}_samples", part.samples if part is not None else None, at)
        facts.put(f"resolve.{end}_format", format.name if format is not None else None, at)
    from_format, to_format = formats
    integers = (
        from_format.is_integer
        if from_format is not None and "color" in from_format.aspects
        else None
    )
    facts.put(
        "resolve.source_integers", None if _other_view(resolve, source_only=True) else integers
    )
    facts.put("resolve.mode_stated", resolve.kind == "command" and states_mode(resolve.record))
    facts.put(
        "resolve.source_numeric",
        from_format.numeric if from_format is not None and "color" in from_format.aspects else None,
    )
    image = resolve.source_image.image if resolve.source_image is not None else None
    if image is not None:
        facts.put("resolve.source_encoding", image.encoding, image.place("encoding"))
    facts.put("resolve.source_is_data", image is not None and image.encoding == "DATA")
    facts.put(
        "resolve.formats_match", formats_match(resolve, from_format, to_format), resolve.target_at
    )
    single = (
        resolve.render_pass is not None
        and resolve.render_pass.subpasses[resolve.subpass].single_sampled
    )
    facts.put("resolve.single_sampled_render", single)
    if resolve.kind == "command":
        facts.put("resolve.target_also", "NOTHING")
    else:
        facts.put("resolve.pass_could_resolve", False)
    _modes(facts, resolve, device)
    return facts


def command_facts(facts: Facts, resolve: Resolve, position: int, timeline: Timeline) -> None:
    """What the frame says of a vkCmdResolveImage: whether the pass before it, round the loop, could
    have resolved.
    """
    source, target = resolve.source_image, resolve.target_image
    writer = timeline.last_writer(source, position) if source is not None else None
    if source is None or writer is None:
        return
    begin, render_pass = writer
    if render_pass is None:
        facts.put("resolve.pass_could_resolve", False)
        return
    facts.put("resolve.writer", render_pass.name, render_pass.record.head)
    resolves = (
        resolve
        for attachment in timeline.drawn_by(source, (begin, render_pass))
        for resolve in attachment.resolved
    )
    modes = [resolve.mode for resolve in resolves if resolve.mode != "NONE"]
    # Attachments of one pass are resolved texel for texel.
    unknown = (
        modes == [None]
        or not timeline.area(render_pass, begin).covers(source)
        or sizes_differ(source, target)
    )
    facts.put("resolve.pass_could_resolve", None if unknown else not modes)


def read_in_vain(readers: Readers) -> set[str]:
    """The images that nothing but resolve commands reads, each after a pass that resolved it
    itself, or threw it away.
    """
    timeline, frame = readers.timeline, readers.frame
    in_vain: dict[str, int] = {}
    for position, resolve in frame.resolve_commands if timeline.followed else ():
        source = resolve.source_image
        begin, render_pass = (
            timeline.last_writer(source, position) if source is not None else None
        ) or (0, None)
        if source is None or render_pass is None:
            continue
        drawn = timeline.drawn_by(source, (begin, render_pass))
        resolved = any(
            resolve.is_certain for attachment in drawn for resolve in attachment.resolved
        )
        lost = bool(drawn) and all(
            aspect.store in ("DONT_CARE", "NONE") for a in drawn for aspect in a.aspects
        )
        if resolved or lost:
            in_vain[source.name] = in_vain.get(source.name, 0) + 1
    counts = {name: count for name, count in in_vain.items() if not frame.may_be_read(name)}
    return {name for name, count in counts.items() if len(readers.reads(name)) == count}


def formats_match(resolve: Resolve, source: Format | None, target: Format | None) -> bool | None:
    """Whether Vulkan allows the two formats together.

    Color, commands and dynamic rendering want the same format; a depth-stencil resolve in a render
    pass wants the same bits and type of each aspect that both have
    (VUID-VkSubpassDescriptionDepthStencilResolve-pDepthStencilResolveAttachment-03181, 03182).
    """
    if source is None or target is None:
        return None
    if resolve.render_pass is not None and resolve.render_pass.custom_resolve:
        return True
    if resolve.kind != "subpass" or resolve.aspect == "color":
        same = source.name == target.name
        return None if not same and _other_view(resolve) else same
    if resolve.aspect not in target.aspects:
        return True
    if resolve.aspect == "depth":
        return (source.depth_bits, source.depth_type) == (target.depth_bits, target.depth_type)
    return (source.stencil_bits, source.stencil_type) == (target.stencil_bits, target.stencil_type)


def _other_view(resolve: Resolve, source_only: bool = False) -> bool:
    """Whether the formats are those of images of which a view may have another: MUTABLE_FORMAT, and
    no attachment that states its own.
    """
    if resolve.kind == "command":
        return False
    ends = ((resolve.source, resolve.source_image), (resolve.target, resolve.target_image))[
        : 1 if source_only else 2
    ]
    images = [
        t.image
        for a, t in ends
        if t is not None and not (a is not None and a.record.states("format"))
    ]
    return any(image is not None and "MUTABLE_FORMAT" in image.flags for image in images)


def _modes(facts: Facts, resolve: Resolve, device: DeviceProfile | None) -> None:
    pair = resolve.pair
    facts.put(
        "resolve.first_of_pair",
        pair is None or pair.render_pass is None or resolve.aspect == "depth",
    )
    modes = [resolve.mode] if pair is None else [resolve.mode, pair.mode]
    if (
        isinstance(resolve.record, ResolveImage)
        and resolve.aspect == "depth"
        and _has_stencil(resolve)
    ):
        modes.append(resolve.record.stencilResolveMode)
    facts.put(
        "resolve.all_modes_none",
        False
        if any(mode not in (None, "NONE") for mode in modes)
        else None
        if None in modes
        else True,
    )
    if resolve.aspect == "color":
        return
    if resolve.mode is not None and resolve.is_certain:
        facts.put("resolve.share_of_tilers", resolve_mode_share(resolve.mode, tilers=True))
    offered = _offered(resolve, device)
    if offered is not None:
        facts.put("resolve.supported_modes", list(offered))
    # Every device offers SAMPLE_ZERO.
    certain = (*(offered or ("SAMPLE_ZERO",)), "NONE")
    if resolve.mode is not None and (
        resolve.mode in certain
        or (offered is not None and device is not None and not device.minimum)
    ):
        facts.put("resolve.mode_supported", resolve.mode in certain, resolve.mode_at)
    facts.put(
        "resolve.pair_supported",
        _pair_supported(resolve, pair, device) if pair is not None else True,
        resolve.mode_at,
    )


def _has_stencil(resolve: Resolve) -> bool:
    """Whether the format of what a resolve reads has a stencil aspect."""
    return (
        resolve.read_part is not None
        and resolve.read_part.format is not None
        and "stencil" in resolve.read_part.format.aspects
    )


def _offered(resolve: Resolve, device: DeviceProfile | None) -> tuple[str, ...] | None:
    if device is None:
        return None
    return device.depth_resolve_modes if resolve.aspect == "depth" else device.stencil_resolve_modes


def _offers(device: DeviceProfile, resolve: Resolve) -> bool:
    offered = _offered(resolve, device)
    return offered is None or resolve.mode in (*offered, "NONE")


def _pair_supported(resolve: Resolve, pair: Resolve, device: DeviceProfile | None) -> bool | None:
    """Modes may differ with independentResolve, or with independentResolveNone where one is NONE
    (03185, 03186).

    Of a mode that the device does not offer at all, that is what is wrong.
    """
    if resolve.mode is None or pair.mode is None:
        return None
    if resolve.mode == pair.mode:
        return True
    if device is None:
        return None
    if device.independent_resolve or not _offers(device, resolve) or not _offers(device, pair):
        return True
    if "NONE" in (resolve.mode, pair.mode):
        answer = device.independent_resolve_none
        if device.independent_resolve is None and not answer:
            return None
    else:
        answer = device.independent_resolve
    return None if device.minimum and not answer else answer

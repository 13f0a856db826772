"""Facts of subpasses: sample counts together, and the pipelines that draw in them."""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.frame.description.models import BeginRendering, Draw, Pipeline, Subpass
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.vulkan.formats import Format

from .facts import Facts
from .global_facts import single_sampled_enabled, single_sampled_offered
from .parts import Attachment, PassSubpass
from .walk import Walk


def subpass_facts(subpass: PassSubpass, walk: Walk, device: DeviceProfile | None) -> Facts:
    """What is known of a subpass, or of a dynamic rendering."""
    facts = Facts()
    record = subpass.record
    facts.put("subpass.index", subpass.index, record.head)
    color = [attachment for attachment in subpass.color if attachment is not None]
    # Multisampled rendering to single-sampled attachments gives those private samples of their own.
    description = walk.frame.description
    private = subpass.single_sampled or single_sampled_enabled(description)
    color_counts, depth_counts = (
        _known_counts(color, private),
        _known_counts(subpass.depth_stencil, private),
    )
    facts.put("subpass.color_samples", color_counts, record.place("colorAttachments"))
    if depth_counts:
        at = record.place("depthStencilAttachment", "depthAttachment", "stencilAttachment")
        facts.put("subpass.depth_stencil_samples", depth_counts[0], at)
    excused = private or single_sampled_offered(description, device)
    _put_mixed(facts, color, subpass.depth_stencil, excused)
    _odd(facts, subpass, excused)
    own = subpass.single_sampled_count
    odd = (
        subpass.single_sampled
        and own is not None
        and any(count != own for count in (*color_counts, *depth_counts))
    )
    facts.put("subpass.differs_from_single_sampled_count", odd)
    shared = samples_of(subpass)
    facts.put(
        "subpass.samples",
        shared,
        record.place(
            "colorAttachments", "depthStencilAttachment", "depthAttachment", "stencilAttachment"
        ),
    )
    _tile(facts, subpass, device)
    _pipelines(facts, pipelines_of(subpass, walk))
    return facts


def _known_counts(attachments: Sequence[Attachment], private: bool) -> list[int]:
    """The distinct known counts, ascending; without those of single-sampled attachments where these
    have private samples.
    """
    counts = {attachment.samples for attachment in attachments}
    return sorted(count for count in counts if count is not None and not (private and count == 1))


def _put_mixed(
    facts: Facts, color: Sequence[Attachment], depth_stencil: Sequence[Attachment], private: bool
) -> None:
    """Whether the counts of a subpass's attachments differ."""
    above, below = _known_counts(color, private), _known_counts(depth_stencil, private)
    color_known = all(attachment.samples is not None for attachment in color)
    depth_known = all(attachment.samples is not None for attachment in depth_stencil)
    both_known = color_known and depth_known
    facts.put("subpass.mixed_color_samples", _decided(len(above) > 1, color_known))
    facts.put(
        "subpass.depth_below_color",
        _decided(bool(above and below) and below[0] < above[-1], both_known),
    )
    facts.put(
        "subpass.depth_above_color",
        _decided(bool(above and below) and below[-1] > above[0], both_known),
    )
    facts.put("subpass.mixed_depth_stencil_samples", _decided(len(below) > 1, depth_known))


def samples_of(subpass: PassSubpass) -> int | None:
    """The count that rasterization in a subpass has; None where it has no attachments, or they are
    unknown or differ.
    """
    if subpass.single_sampled:
        return subpass.single_sampled_count
    attachments = [*(a for a in subpass.color if a is not None), *subpass.depth_stencil]
    counts = {attachment.samples for attachment in attachments}
    return counts.pop() if len(counts) == 1 else None


def tile_targets(
    subpass: PassSubpass,
) -> tuple[list[tuple[Format, int]], tuple[Format, int] | None] | None:
    """Format and samples of what a subpass draws to, as stored on the tile: color, and
    depth-stencil; None if one is unknown.

    Where it renders multisampled to single-sampled attachments, the tile has the samples.
    """
    if subpass.single_sampled and subpass.single_sampled_count is None:
        return None
    color = [attachment for attachment in subpass.color if attachment is not None]
    # Dynamic rendering states depth and stencil apart; they are of one image.
    found: list[tuple[Format, int]] = []
    for attachment in [*color, *subpass.depth_stencil[:1]]:
        samples = attachment.samples
        if subpass.single_sampled_count is not None and samples == 1:
            samples = subpass.single_sampled_count
        if attachment.format is None or samples is None:
            return None
        found.append((attachment.format, samples))
    return found[: len(color)], found[-1] if subpass.depth_stencil else None


def _tile(facts: Facts, subpass: PassSubpass, device: DeviceProfile | None) -> None:
    """What the subpass takes of the device's tile."""
    targets = tile_targets(subpass) if device is not None and device.tile is not None else None
    use = None
    if device is not None and device.tile is not None and targets is not None:
        from msaa_lint.frame.devices.tiles import tile_use

        use = tile_use(device.tile, *targets)
    facts.put("subpass.tile_known", use is not None)
    if use is not None:
        at = subpass.record.place(
            "colorAttachments", "depthStencilAttachment", "depthAttachment", "stencilAttachment"
        )
        facts.put("subpass.tile_bytes", use.bytes_per_pixel, at)
        facts.put("subpass.tile_pixels", use.pixels, at)
        facts.put("subpass.tile_full", use.full, at)
        facts.put("subpass.tile_spills", use.spills, at)


def _odd(facts: Facts, subpass: PassSubpass, private: bool) -> None:
    """The attachment to point at where counts differ: the first that has not the stated count, or
    the first one's.
    """
    record = subpass.record
    expected = subpass.single_sampled_count
    places = {
        n: reference.place("attachment", "image")
        for n, reference in enumerate(record.colorAttachments)
        if reference is not None
    }
    drawn = [(a, places.get(n, record.head)) for n, a in enumerate(subpass.color) if a is not None]
    reference = record.depthStencilAttachment if isinstance(record, Subpass) else None
    for n, attachment in enumerate(subpass.depth_stencil):
        # A second one is Metal's stencil in a texture of its own.
        drawn.append(
            (
                attachment,
                reference.place("attachment")
                if reference is not None and n == 0
                else attachment.record.place("image"),
            )
        )
    for attachment, place in drawn:
        if attachment.samples is None or (private and attachment.samples == 1):
            continue
        if expected is None:
            expected = attachment.samples
        elif attachment.samples != expected:
            facts.put("subpass.odd_attachment", attachment.title, place)
            facts.put("subpass.odd_samples", attachment.samples, place)
            facts.put("subpass.expected_samples", expected)
            return


def _decided(answer: bool, known: bool) -> bool | None:
    """A yes stands whatever the unknown counts are; a no only where every count is known."""
    return True if answer else False if known else None


def pipelines_of(subpass: PassSubpass, walk: Walk) -> list[Pipeline | None]:
    """The pipelines that draw in it: those made for a subpass, those of the draws in a rendering.
    None where that is not all of them.
    """
    frame, render_pass = walk.frame, subpass.render_pass
    if isinstance(render_pass.record, BeginRendering):
        elsewhere = any(
            flag.startswith(("SUSPENDING", "RESUMING", "CONTENTS_SECONDARY"))
            for flag in render_pass.record.flags
        )
        draws = (
            (
                command.body
                for run in walk.recorded_runs_of(render_pass)
                for _, command in run.commands
            )
            if not elsewhere
            else ()
        )
        return [
            frame.description.pipelines.get(draw.pipeline or "")
            for draw in draws
            if isinstance(draw, Draw)
        ]
    if not frame.document.whole:
        return []
    return frame.pipelines_of(render_pass, subpass.index)


def _pipelines(facts: Facts, own: list[Pipeline | None]) -> None:
    facts.put(
        "subpass.has_pipelines", bool(own), own[0].head if own and own[0] is not None else None
    )
    answers = [_covers_in_part(pipeline) if pipeline is not None else None for pipeline in own]
    if own:
        facts.put(
            "subpass.partial_coverage",
            True if True in answers else None if None in answers else False,
        )


def _covers_in_part(pipeline: Pipeline) -> bool | None:
    """Whether a pipeline can cover a pixel in part; None where what decides it is not stated.

    One that rasterizes with one sample is invalid in a multisampled subpass, whatever it covers:
    that is another mistake.
    """
    raster, state, dynamic = (
        pipeline.rasterizationState,
        pipeline.multisampleState,
        pipeline.dynamicState,
    )
    discard = (
        raster.rasterizerDiscardEnable
        if raster is not None and "RASTERIZER_DISCARD_ENABLE" not in dynamic
        else None
    )
    samples = (
        state.rasterizationSamples
        if state is not None and "RASTERIZATION_SAMPLES_EXT" not in dynamic
        else None
    )
    if discard is True:
        return False
    return None if discard is None and samples is None else True

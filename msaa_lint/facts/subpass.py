"""Facts of subpasses: sample counts together, and the pipelines that draw in them."""

from __future__ import annotations

from ..document.records import Subpass
from .facts import Facts
from .frame import RENDER_PASS, Frame, PassSubpass
from .surroundings import single_sampled_render


def subpass_facts(subpass: PassSubpass, frame: Frame) -> Facts:
    """What is known of a subpass, or of a dynamic rendering."""
    facts = Facts()
    record = subpass.record
    facts.put("subpass.index", subpass.index, record.head)
    color = [attachment for attachment in subpass.color if attachment is not None]
    # Where multisampled rendering goes to single-sampled attachments, those have their own, private samples.
    private = subpass.single_sampled or single_sampled_render(frame.description)
    counts = [a.samples for a in color if not (private and a.samples == 1)]
    below = [a.samples for a in subpass.depth_stencil if not (private and a.samples == 1)]
    known = sorted({count for count in counts if count is not None})
    depth = sorted({count for count in below if count is not None})
    facts.put("subpass.color_samples", known, record.place("colorAttachments"))
    if depth:
        facts.put("subpass.depth_stencil_samples", depth[0], record.place("depthStencilAttachment", "depthAttachment", "stencilAttachment"))
    facts.put("subpass.mixed_color_samples", _decided(len(known) > 1, counts))
    facts.put("subpass.depth_below_color", _decided(bool(known and depth) and depth[0] < known[-1], [*counts, *below]))
    facts.put("subpass.depth_above_color", _decided(bool(known and depth) and depth[-1] > known[0], [*counts, *below]))
    facts.put("subpass.mixed_depth_stencil_samples", _decided(len(depth) > 1, below))
    _odd(facts, subpass, private)
    own = subpass.single_sampled_count
    every = {*known, *depth}
    odd = subpass.single_sampled and own is not None and any(count != own for count in every)
    facts.put("subpass.differs_from_single_sampled_count", odd)
    shared = samples_of(subpass)
    facts.put("subpass.samples", shared, record.place("colorAttachments", "depthStencilAttachment", "depthAttachment", "stencilAttachment"))
    _pipelines(facts, subpass, frame)
    return facts


def samples_of(subpass: PassSubpass) -> int | None:
    """The count that rasterization in a subpass has; None where it has no attachments, or they are unknown or differ."""
    if subpass.single_sampled:
        return subpass.single_sampled_count
    attachments = [*(a for a in subpass.color if a is not None), *subpass.depth_stencil]
    counts = {attachment.samples for attachment in attachments}
    return counts.pop() if len(counts) == 1 else None


def _odd(facts: Facts, subpass: PassSubpass, private: bool) -> None:
    """The attachment to point at where counts differ: the first that has not the stated count, or the first one's."""
    record = subpass.record
    expected = subpass.single_sampled_count
    places = {n: reference.place("attachment", "image") for n, reference in enumerate(record.colorAttachments) if reference is not None}
    drawn = [(a, places.get(n, record.head)) for n, a in enumerate(subpass.color) if a is not None]
    reference = record.depthStencilAttachment if isinstance(record, Subpass) else None
    drawn += [(a, reference.place("attachment") if reference is not None else a.record.place("image")) for a in subpass.depth_stencil]
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


def _decided(answer: bool, counts: list[int | None]) -> bool | None:
    """A yes stands whatever else comes; a no only where every count is known."""
    return True if answer else None if None in counts else False


def _pipelines(facts: Facts, subpass: PassSubpass, frame: Frame) -> None:
    if subpass.within.kind != RENDER_PASS or not frame.document.whole:
        facts.put("subpass.has_pipelines", False)
        return
    only = 0 if len(subpass.within.subpasses) == 1 else None
    own = [p for p, w in frame.pipelines if w is subpass.within and subpass.index == (only if p.subpass is None else p.subpass)]
    facts.put("subpass.has_pipelines", bool(own), own[0].head if own else None)
    answers: list[bool | None] = []
    for pipeline in own:
        discard = pipeline.rasterizationState.rasterizerDiscardEnable if pipeline.rasterizationState is not None else None
        samples = pipeline.multisampleState.rasterizationSamples if pipeline.multisampleState is not None else None
        if "RASTERIZATION_SAMPLES_EXT" in pipeline.dynamicState:
            samples = None
        if discard is True or samples == 1:
            answers.append(False)
        else:
            answers.append(None if discard is None and samples is None else True)
    if own:
        facts.put("subpass.partial_coverage", True if True in answers else None if None in answers else False)

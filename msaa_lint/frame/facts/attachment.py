"""Facts of attachments, of their aspects, and of the pass around them with the clear values that it
is begun with.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from msaa_lint.frame.description.models import (
    AttachmentDescription,
    BeginRendering,
    BeginRenderPass,
    RenderPass,
    Subpass,
)
from msaa_lint.frame.devices import DeviceProfile

from .facts import Facts
from .frame import Frame
from .image import supported_samples
from .parts import RENDER_PASS, Aspect, Attachment, Pass, Resolve
from .readers import Readers


def pass_facts(render_pass: Pass, frame: Frame) -> Facts:
    """What holds for all of a pass."""
    facts = Facts()
    facts.put("pass.kind", render_pass.kind)
    facts.put("pass.name", render_pass.name)
    facts.put("pass.labels", _labels(render_pass, frame))
    facts.put("pass.begun", frame.whether_begun(render_pass))
    facts.put("pass.partial_area", render_pass.partial_area)
    facts.put("pass.custom_resolve", render_pass.custom_resolve)
    facts.put("pass.suspends", render_pass.suspends)
    return facts


def _labels(render_pass: Pass, frame: Frame) -> list[str]:
    """The debug labels within which a pass is begun."""
    labels: dict[str, None] = {}
    for body in [frame.commands[position].body for position in render_pass.begun]:
        stated = body.label if isinstance(body, (BeginRenderPass, BeginRendering)) else None
        labels.update(dict.fromkeys((stated,) if isinstance(stated, str) else stated or ()))
    return list(labels)


def clear_value_facts(facts: Facts, render_pass: Pass, frame: Frame) -> None:
    """Adds how many clear values a render pass is begun with, the most that any begin gives, and
    whether an attachment takes one.

    A rendering has them in its attachments, and is begun with none.
    """
    facts.put(
        "pass.attachments", len(render_pass.attachments), render_pass.record.place("attachments")
    )
    if render_pass.kind != RENDER_PASS or not render_pass.begun:
        facts.put("pass.clear_values", 0)
        return
    operations = {
        aspect.load
        for attachment in render_pass.attachments
        if attachment.used
        for aspect in attachment.aspects
    }
    facts.put(
        "pass.clears", True if "CLEAR" in operations else None if None in operations else False
    )
    bodies = [frame.commands[position].body for position in render_pass.begun]
    given = [
        (body.clearValueCount, body)
        for body in bodies
        if isinstance(body, BeginRenderPass) and body.clearValueCount is not None
    ]
    if given:
        count, body = max(given, key=lambda one: one[0])
        facts.put("pass.clear_values", count, body.place("clearValueCount"))


def attachment_facts(
    attachment: Attachment, known: bool, dependencies: Mapping[int, Collection[int]]
) -> Facts:
    """What is known of an attachment in its pass; `known` says whether the pass's subpasses are.

    `dependencies` are the later subpasses that depend on each subpass.
    """
    facts = Facts()
    record = attachment.record
    target = attachment.target
    facts.put("attachment.name", attachment.title, record.head)
    format_at, samples_at = record.head, record.head
    for name in ("format", "samples"):
        stated = (
            record
            if record.states(name)
            else target.record
            if target is not None and target.record.states(name)
            else record
        )
        at = stated.place(name) if stated.states(name) else record.place("image")
        format_at, samples_at = (at, samples_at) if name == "format" else (format_at, at)
    facts.put(
        "attachment.format",
        attachment.format.name if attachment.format is not None else None,
        format_at,
    )
    facts.put("attachment.samples", attachment.samples, samples_at)
    if known or attachment.used:
        facts.put("attachment.used", attachment.used)
    facts.put("attachment.drawn", attachment.drawn)
    facts.put("attachment.is_resolve_target", bool(attachment.resolve))
    facts.put("attachment.read_as_input", bool(attachment.input))
    lost = _lost(attachment, dependencies)
    facts.put("attachment.lost_in_subpass", lost[0] if lost is not None else None)
    facts.put("attachment.lost_for_subpass", lost[1] if lost is not None else None)
    facts.put("attachment.lost", lost is not None)
    facts.put("attachment.lost_for_input", lost is not None and lost[1] in attachment.input)
    if isinstance(record, AttachmentDescription):
        facts.put("attachment.initial_layout", record.initialLayout, record.place("initialLayout"))
        facts.put("attachment.final_layout", record.finalLayout, record.place("finalLayout"))
    return facts


def single_sampled_facts(
    facts: Facts,
    render_pass: Pass,
    attachment: Attachment,
    device: DeviceProfile | None,
    chained_known: bool,
) -> None:
    """Adds whether samples of the rendering are resolved to an attachment as it is stored
    (VkMultisampledRenderToSingleSampledInfoEXT), and whether a depth-stencil attachment that it
    concerns lacks the structure that this requires (VUID-VkSubpassDescription2-pNext-06871).

    `chained_known` is false of source code, of which some structures are not read. Resolve targets
    are not concerned (VUID-VkFramebufferCreateInfo-samples-06881,
    VUID-VkRenderingInfo-imageView-06859).
    """
    depths = [render_pass.subpasses[index].record for index in sorted(attachment.depth_stencil)]
    rendered = [
        each
        for each in depths
        if isinstance(each, Subpass) and each.multisampledRenderToSingleSampled is not None
    ]
    facts.put(
        "attachment.depth_resolve_missing",
        chained_known and any(each.depthStencilResolve is None for each in rendered),
    )
    indices = attachment.color | attachment.depth_stencil | attachment.input
    chained = [
        render_pass.subpasses[index].record.multisampledRenderToSingleSampled
        for index in sorted(indices)
    ]
    states = [
        each
        for each in chained
        if each is not None and each.multisampledRenderToSingleSampledEnable is not False
    ]
    enabled = next((each for each in states if each.multisampledRenderToSingleSampledEnable), None)
    facts.put(
        "attachment.single_sampled_render",
        True if enabled is not None else None if states else False,
    )
    if enabled is None:
        return
    count, place = enabled.rasterizationSamples, enabled.place("rasterizationSamples")
    facts.put("attachment.render_samples", count, place)
    target = attachment.target
    offered, whole = supported_samples(target, device) if target is not None else (None, False)
    if (
        count is not None
        and offered is not None
        and device is not None
        and not device.minimum
        and (whole or count not in offered)
    ):
        facts.put("attachment.render_samples_supported", count in offered, place)


def later_subpasses(render_pass: Pass) -> dict[int, list[int]]:
    """The later subpasses of a pass that a stated dependency makes depend on each subpass."""
    found: dict[int, list[int]] = {}
    for dependency in (
        render_pass.record.dependencies if isinstance(render_pass.record, RenderPass) else ()
    ):
        source, target = dependency.srcSubpass, dependency.dstSubpass
        if isinstance(source, int) and isinstance(target, int) and source < target:
            found.setdefault(source, []).append(target)
    return found


def _lost(
    attachment: Attachment, dependencies: Mapping[int, Collection[int]]
) -> tuple[int, int] | None:
    """The subpass in which the contents of an attachment become undefined, and the next one after
    it that draws to it or reads it.

    They become undefined in a subpass that neither uses nor preserves it, and depends on one that
    does, and stay so in what depends on that subpass until they are written again, as a resolve
    does (Vulkan specification, Render Pass Creation, VkSubpassDescription).
    """
    used = (
        attachment.color | attachment.depth_stencil | attachment.input | attachment.resolve.keys()
    )
    if not dependencies or len(used) < 2 or not used - attachment.input:
        return None
    kept, first = used | attachment.preserve, min(used)
    lost = {
        target
        for source, targets in dependencies.items()
        if source in kept and source >= first
        for target in targets
    } - kept
    for start in sorted(lost):
        reached, following = set[int](), [start]
        while following:
            for target in dependencies.get(following.pop(), ()):
                if target not in reached and target not in used:
                    following.append(target)
                reached.add(target)
        uses = sorted(reached & (attachment.color | attachment.depth_stencil | attachment.input))
        if uses:
            return start, uses[0]
    return None


def resolves_at(render_pass: Pass) -> dict[int, list[Resolve]]:
    """The resolves of a pass by the attachments, by identity, that they read or write."""
    found: dict[int, list[Resolve]] = {}
    for resolve in render_pass.resolves:
        for end in (resolve.source, resolve.target):
            if end is not None:
                found.setdefault(id(end), []).append(resolve)
    return found


def aspect_facts(
    render_pass: Pass,
    attachment: Attachment,
    aspect: Aspect,
    resolves: list[Resolve],
    readers: Readers,
) -> Facts:
    """What is known of one aspect: its operations, who resolves it (`resolves` are the
    attachment's), who reads it later.
    """
    facts = Facts()
    record = attachment.record
    facts.put("aspect.name", aspect.name, record.head)
    load_at, store_at = record.place(aspect.load_member), record.place(aspect.store_member)
    facts.put("aspect.load", aspect.load, load_at)
    facts.put("aspect.store", aspect.store, store_at)
    stored = aspect.store == "STORE"
    needs = [op for op, member in ((aspect.store, "STORE"), (aspect.load, "LOAD")) if op == member]
    facts.put("aspect.memory_operations", needs, store_at if stored else load_at)
    if isinstance(record, AttachmentDescription):
        separate = aspect.name == "stencil" and record.stencilInitialLayout is not None
        layout = record.stencilInitialLayout if separate else record.initialLayout
        facts.put(
            "aspect.initial_layout",
            layout,
            record.place("stencilInitialLayout" if separate else "initialLayout"),
        )
    from_it = [r for r in resolves if r.source is attachment and r.aspect == aspect.name]
    certain = [resolve.target_at for resolve in from_it if resolve.is_certain]
    resolved = (
        True
        if certain
        else None
        if render_pass.unread or any(resolve.mode is None for resolve in from_it)
        else False
    )
    facts.put("aspect.resolved", resolved, certain[0] if certain else None)
    over: set[str] = set().union(*attachment.resolve.values())
    overwritten = (
        True
        if aspect.name in over
        else None
        if "?" in over or (over and aspect.name is None)
        else False
    )
    onto = [
        r
        for r in resolves
        if r.target is attachment and r.aspect == aspect.name and r.mode != "NONE"
    ]
    facts.put("aspect.resolved_over", overwritten, onto[0].target_at if onto else None)
    at = {subpass for subpass, aspects in attachment.resolve.items() if aspect.name in aspects}
    # A resolve comes at the end of its subpass: the same subpass reads what was there before.
    before = bool(at) and (
        any(s <= min(at) for s in attachment.input)
        or any(s < min(at) for s in attachment.depth_stencil)
    )
    facts.put("aspect.read_before_resolve", before)
    facts.put(
        "aspect.read_after_resolve",
        bool(at) and any(s > min(at) for s in attachment.input | attachment.depth_stencil),
    )
    read_later = readers.read_later(render_pass, attachment, aspect)
    facts.put("aspect.read_later", read_later)
    facts.put("aspect.readers_known", read_later is not None)
    store = readers.stored_before(render_pass, attachment, aspect)
    facts.put(
        "aspect.stored_by",
        store.render_pass.name if store else None,
        store.place if store else None,
    )
    costly = [
        op
        for op, costs in (
            ("LOAD", aspect.load == "LOAD"),
            ("STORE", stored and read_later is False),
        )
        if costs
    ]
    facts.put("aspect.costly_operations", costly, load_at if "LOAD" in costly else store_at)
    return facts

"""Facts of resumed renderings: which one each resumes, and in what it differs from it.

"The contents of pRenderingInfo must match between suspended render pass instances and the render
pass instances that resume them, other than the presence or absence of the
VK_RENDERING_RESUMING_BIT, VK_RENDERING_SUSPENDING_BIT, and
VK_RENDERING_CONTENTS_SECONDARY_COMMAND_BUFFERS_BIT flags." (VkRenderingFlagBits)
"""

from __future__ import annotations

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import BeginRendering, RenderingAttachment
from msaa_lint.frame.description.record import Record

from .facts import Facts
from .parts import Pass
from .walk import Walk

_FREE_FLAGS = frozenset({"RESUMING", "SUSPENDING", "CONTENTS_SECONDARY_COMMAND_BUFFERS"})

Difference = tuple[str, Span]
"""A member as `colorAttachments[0].loadOp`, and where the resumed rendering states it."""


def resumption_facts(facts: Facts, render_pass: Pass, walk: Walk) -> None:
    """Adds the rendering that a pass resumes, and the first member that differs. Members that one
    of the two leaves out are unknown.
    """
    suspended = walk.suspended.get(id(render_pass))
    difference: Difference | None = None
    if suspended is not None:
        one, other = suspended.record, render_pass.record
        assert isinstance(one, BeginRendering) and isinstance(other, BeginRendering)
        difference = _difference(one, other)
    name, at = (
        (suspended.name, suspended.record.place("flags")) if suspended is not None else ("", None)
    )
    member, differs_at = difference if difference is not None else ("", None)
    facts.put("pass.resumes_differently", difference is not None, differs_at)
    facts.put("pass.resumed_from", name, at)
    facts.put("pass.resumed_member", member)


def _difference(one: BeginRendering, other: BeginRendering) -> Difference | None:
    if not set(one.flags) ^ set(other.flags) <= _FREE_FLAGS:
        return "flags", other.place("flags")
    found = _members(
        one,
        other,
        ("renderArea", "layerCount", "viewMask", "multisampledRenderToSingleSampled"),
        "",
    )
    if found is not None:
        return found
    if len(one.colorAttachments) != len(other.colorAttachments):
        return "colorAttachments", other.place("colorAttachments")
    pairs = [
        (f"colorAttachments[{number}]", pair)
        for number, pair in enumerate(
            zip(one.colorAttachments, other.colorAttachments, strict=True)
        )
    ]
    pairs += [
        (name, (getattr(one, name), getattr(other, name)))
        for name in ("depthAttachment", "stencilAttachment")
    ]
    for name, (before, after) in pairs:
        found = _of_attachments(before, after, name, other)
        if found is not None:
            return found
    return None


def _of_attachments(
    one: RenderingAttachment | None,
    other: RenderingAttachment | None,
    name: str,
    rendering: BeginRendering,
) -> Difference | None:
    """How two attachments differ; one without an image is none."""
    images = [each.image if each is not None else None for each in (one, other)]
    if images[0] != images[1]:
        return (
            (f"{name}.image", other.place("image"))
            if other is not None
            else (name, rendering.place(name.partition("[")[0]))
        )
    if one is None or other is None:
        return None
    targets = [each.resolveImage if each.resolveMode != "NONE" else None for each in (one, other)]
    if targets[0] != targets[1]:
        return f"{name}.resolveImage", other.place("resolveImage", "resolveMode")
    return _members(
        one,
        other,
        ("imageLayout", "loadOp", "storeOp", "resolveMode", "resolveImageLayout"),
        f"{name}.",
    )


def _members(one: Record, other: Record, names: tuple[str, ...], prefix: str) -> Difference | None:
    """The first of some members that both state, with other values."""
    for name in names:
        before, after = getattr(one, name), getattr(other, name)
        if isinstance(before, Record) and isinstance(after, Record):
            found = _members(before, after, tuple(before.SHAPE), f"{prefix}{name}.")
            if found is not None:
                return found
        elif None not in (before, after) and before != after:
            return prefix + name, other.place(name)
    return None

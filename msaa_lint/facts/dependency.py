"""Facts of what orders a frame's use of an attachment after the last frame's."""

from __future__ import annotations

from collections.abc import Iterator

from ..document.records import RenderPass, SubpassDependency
from .facts import Facts
from .frame import RENDER_PASS, Attachment, Pass

_INCLUDE_LATE_TESTS = frozenset({"LATE_FRAGMENT_TESTS", "ALL_GRAPHICS", "ALL_COMMANDS", "BOTTOM_OF_PIPE"})


def external_dependencies(each: Pass) -> Iterator[tuple[SubpassDependency, Facts]]:
    """For every subpass with stated dependencies from EXTERNAL: the first of them, and the facts of all together."""
    if each.kind != RENDER_PASS or not isinstance(each.record, RenderPass):
        return
    into: dict[int, list[SubpassDependency]] = {}
    for dependency in each.record.dependencies:
        if dependency.srcSubpass == "EXTERNAL" and isinstance(dependency.dstSubpass, int):
            into.setdefault(dependency.dstSubpass, []).append(dependency)
    for subpass, dependencies in into.items():
        yield dependencies[0], _facts(each, subpass, dependencies)


def _facts(each: Pass, subpass: int, dependencies: list[SubpassDependency]) -> Facts:
    facts = Facts()
    first = dependencies[0]
    stages = _union([d.srcStageMask for d in dependencies])
    accesses = _union([d.srcAccessMask for d in dependencies])
    facts.put("dependency.subpass", subpass, first.place("dstSubpass"))
    if stages is not None:
        facts.put("dependency.stages", stages, first.place("srcStageMask"))
        late = not _INCLUDE_LATE_TESTS.isdisjoint(stages)
        facts.put("dependency.waits_for_late_tests", late, first.place("srcStageMask"))
    if accesses is not None:
        facts.put("dependency.accesses", accesses, first.place("srcAccessMask"))
        facts.put("dependency.makes_writes_available", any("WRITE" in access for access in accesses), first.place("srcAccessMask"))
    begun = [a for a in each.attachments if a.drawn and min(a.color | a.depth_stencil) == subpass and _first_use(a) == subpass]
    facts.put("dependency.multisampled", _any_multisampled(begun))
    facts.put("dependency.multisampled_depth_stencil", _any_multisampled([a for a in begun if subpass in a.depth_stencil]))
    return facts


def _first_use(attachment: Attachment) -> int:
    return min(attachment.color | attachment.depth_stencil | attachment.input | set(attachment.resolve))


def _any_multisampled(attachments: list[Attachment]) -> bool | None:
    counts = [attachment.samples for attachment in attachments]
    if any(count is not None and count > 1 for count in counts):
        return True
    return None if None in counts else False


def _union(masks: list[tuple[str, ...] | None]) -> list[str] | None:
    """The names of all masks; None where one could not be read."""
    if None in masks:
        return None
    return list(dict.fromkeys(name for mask in masks for name in mask or ()))

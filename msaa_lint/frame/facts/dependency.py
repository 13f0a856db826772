"""Facts of what orders a frame's use of an attachment after the last frame's."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.records import ImageBarrier, PipelineBarrier, RenderPass, SubpassDependency

from .facts import Facts
from .frame import RENDER_PASS, Attachment, Frame, Pass

_INCLUDE_LATE_TESTS = frozenset({"LATE_FRAGMENT_TESTS", "ALL_GRAPHICS", "ALL_COMMANDS", "BOTTOM_OF_PIPE"})
_ATTACHMENT_STAGES = frozenset({"COLOR_ATTACHMENT_OUTPUT", "EARLY_FRAGMENT_TESTS", "LATE_FRAGMENT_TESTS", "ALL_GRAPHICS", "ALL_COMMANDS"})


class Masks(NamedTuple):
    """What is waited for: source stages, and accesses made available."""

    srcStageMask: tuple[str, ...]
    srcAccessMask: tuple[str, ...]


Barriers = dict[str | None, Masks]


def recorded_barriers(frame: Frame) -> Barriers:
    """By image (None: for all memory, where attachments wait for it): what the recorded barriers wait for, taken together."""
    found: Barriers = {}
    for command in frame.commands:
        body = command.body
        if not isinstance(body, PipelineBarrier):
            continue
        images = {image.image if isinstance(image, ImageBarrier) else image for image in body.images}
        for name in images or ({None} if not _ATTACHMENT_STAGES.isdisjoint(body.dstStageMask or ()) else set()):
            before = found.get(name, Masks((), ()))
            stages = dict.fromkeys((*before.srcStageMask, *(body.srcStageMask or ())))
            accesses = dict.fromkeys((*before.srcAccessMask, *(body.srcAccessMask or ())))
            found[name] = Masks(tuple(stages), tuple(accesses))
    return found


def external_dependencies(each: Pass, barriers: Barriers, apart: bool = False) -> Iterator[tuple[Record, Facts]]:
    """For every subpass with stated dependencies from EXTERNAL: the first of them, and the facts of all together.

    A subpass without any that is the first to use a multisampled attachment comes by itself: what orders it is not known. Nor is it known
    of passes that stand `apart` from any frame: where commands are stated, and are none.
    """
    if each.kind != RENDER_PASS or not isinstance(each.record, RenderPass):
        return
    into: dict[int, list[SubpassDependency]] = {}
    for dependency in each.record.dependencies:
        if dependency.srcSubpass == "EXTERNAL" and isinstance(dependency.dstSubpass, int):
            into.setdefault(dependency.dstSubpass, []).append(dependency)
    began: dict[int, list[Attachment]] = {}
    for attachment in each.attachments:
        if attachment.drawn and _first_use(attachment) in attachment.color | attachment.depth_stencil:
            began.setdefault(_first_use(attachment), []).append(attachment)
    for subpass, dependencies in into.items():
        names = dict.fromkeys(t.name for a in began.get(subpass, ()) if a.samples != 1 for t in a.targets if t.image is not None)
        waits = [barriers[name] for name in (*names, None) if name in barriers] if each.begun else []
        if apart:
            yield dependencies[0], _use_facts(subpass, began.get(subpass, []))
            continue
        yield dependencies[0], _facts(subpass, began.get(subpass, []), dependencies, waits)
    for subpass, attachments in began.items():
        if subpass not in into and _any_multisampled(attachments):
            yield each.subpasses[subpass].record, _use_facts(subpass, attachments)


def _use_facts(subpass: int, began: list[Attachment]) -> Facts:
    facts = Facts()
    facts.put("dependency.subpass", subpass)
    facts.put("dependency.multisampled", _any_multisampled(began))
    facts.put("dependency.multisampled_depth_stencil", _any_multisampled([a for a in began if subpass in a.depth_stencil]))
    return facts


def _facts(subpass: int, began: list[Attachment], dependencies: list[SubpassDependency], barriers: list[Masks]) -> Facts:
    facts = _use_facts(subpass, began)
    first = dependencies[0]
    stages_at, accesses_at = first.place("srcStageMask"), first.place("srcAccessMask")
    stages = _union([*(d.srcStageMask for d in dependencies), *(b.srcStageMask for b in barriers)])
    accesses = _union([*(d.srcAccessMask for d in dependencies), *(b.srcAccessMask for b in barriers)])
    facts.places["dependency.subpass"] = first.place("dstSubpass")
    if stages is not None:
        late = not _INCLUDE_LATE_TESTS.isdisjoint(stages)
        facts.put("dependency.stages", stages, stages_at)
        facts.put("dependency.waits_for_late_tests", late, stages_at)
        if not late and facts.values.get("dependency.multisampled_depth_stencil"):
            facts.put("dependency.missing", "LATE_FRAGMENT_TESTS in srcStageMask", stages_at)
    if accesses is not None:
        writes = any("WRITE" in access for access in accesses)
        facts.put("dependency.accesses", accesses, accesses_at)
        facts.put("dependency.makes_writes_available", writes, accesses_at)
        if not writes:
            facts.put("dependency.missing", "a write access in srcAccessMask", accesses_at)
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

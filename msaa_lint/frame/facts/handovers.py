"""Samples that a pass stores for the fragment shaders of a later pass: a multisampled G-buffer that
is lit in a pass of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from msaa_lint.frame.description.models import ReadImage

from .commands import READ
from .event_search import ENDS, EventSearch, every_time, is_unknown, reads
from .facts import Facts
from .parts import Attachment, Pass, sizes_differ
from .timeline import key_of
from .walk import PassRun

Fetched = Callable[[int], tuple[str | None, str | None]]
"""Which samples the read at a position fetches, and how it combines them: `read.samples` and
`read.resolves`.
"""

_FRAGMENT_STAGES = ("FRAGMENT", "FRAGMENT_SHADER", "ALL_GRAPHICS")


class Handover(NamedTuple):
    """Attachments whose samples one later pass reads, that pass, and the positions of the reads."""

    attachments: tuple[Attachment, ...]
    reader: Pass
    positions: tuple[int, ...]


def put_handover(facts: Facts, render_pass: Pass, search: EventSearch, fetched: Fetched) -> None:
    """Adds which samples a pass hands over to a later pass; nothing where the order of the commands
    is not known.
    """
    if not search.frame.has_commands or not search.timeline.ordered:
        return
    found = handover(render_pass, search, fetched)
    if search.steps_left < 0:
        return
    facts.put(
        "pass.handed_over",
        [attachment.title for attachment in found.attachments] if found is not None else [],
    )
    first = found.attachments[0] if found is not None else None
    if first is not None:
        facts.places["pass.handed_over"] = first.record.place(first.aspects[0].store_member)
    facts.put("pass.handed_samples", first.samples if first is not None else 0)
    reader = found.reader if found is not None else None
    facts.put(
        "pass.handed_to",
        reader.name if reader is not None else "",
        reader.record.head if reader is not None else None,
    )


def handover(render_pass: Pass, search: EventSearch, fetched: Fetched) -> Handover | None:
    """The samples that a pass stores, which only the fragment shaders of one later pass of the
    frame read. None if there are none.

    Depth alone is a shadow map, or read around a pixel, as for ambient occlusion. Where something
    between the two passes depends on the first, they cannot become one.
    """
    runs = search.timeline.walk.runs_of(render_pass)
    if len(runs) != 1 or render_pass.suspends or render_pass.resumes:
        return None
    by_reader: dict[int, tuple[PassRun, list[Attachment], list[int]]] = {}
    for attachment in render_pass.attachments:
        positions = _read_at(attachment, search, fetched)
        readers = {
            id(run): run
            for run in (_reader(position, search) for position in positions)
            if run is not None
        }
        if len(readers) != 1:
            continue
        ((key, run),) = readers.items()
        _, attachments, at = by_reader.setdefault(key, (run, [], []))
        attachments.append(attachment)
        at.extend(positions)
    for run, attachments, at in by_reader.values():
        if any(attachment.color for attachment in attachments) and _may_be_one(
            runs[0], run, attachments, at, search
        ):
            return Handover(tuple(attachments), run.render_pass, tuple(sorted(set(at))))
    return None


def _read_at(attachment: Attachment, search: EventSearch, fetched: Fetched) -> list[int]:
    """The positions of the commands that read what an attachment stores; none where not only
    fragment shaders do, in the same frame, or where another rule answers: a shader that resolves,
    or that reads one sample of depth.
    """
    target = attachment.target
    stored = next(
        (
            aspect
            for aspect in attachment.aspects
            if aspect.name in ("color", "depth") and aspect.store == "STORE"
        ),
        None,
    )
    if (
        not attachment.drawn
        or (attachment.samples or 1) == 1
        or target is None
        or stored is None
        or search.frame.may_be_read(target.name)
    ):
        return []
    positions: list[int] = []
    for ref in search.written_at(attachment, stored.name):
        for event, later in search.after(ref, stored.name):
            if is_unknown(event):
                return []
            body = event.command.body if event.command is not None and event.kind == READ else None
            if isinstance(body, ReadImage) and not later and body.stage in _FRAGMENT_STAGES:
                samples, resolves = fetched(event.position)
                if (
                    samples == "ONE"
                    or resolves not in (None, "OTHER")
                    or (samples is None and stored.name == "depth")
                ):
                    return []
                positions.append(event.position)
            elif reads(event):
                return []
            elif every_time(event) and event.kind in ENDS:
                break
    return positions


def _reader(position: int, search: EventSearch) -> PassRun | None:
    """The run of the pass whose draws a read belongs to: the one around it, or the next one."""
    walk = search.timeline.walk
    around = walk.steps[position].run
    return (
        around
        if around is not None
        else next((run for run in walk.runs if (run.position or 0) > position), None)
    )


def _may_be_one(
    first: PassRun,
    second: PassRun,
    attachments: list[Attachment],
    read_at: list[int],
    search: EventSearch,
) -> bool:
    """Whether two passes may become one: they have the same size as far as that is stated, and
    nothing between them reads what the first one writes.
    """
    others = [
        target for attachment in second.render_pass.attachments for target in attachment.targets
    ]
    mine = [target for attachment in attachments for target in attachment.targets]
    if second is first or any(sizes_differ(one, other) for one in mine for other in others):
        return False
    written = {
        key_of(target)
        for attachment in first.render_pass.attachments
        for target in attachment.targets
    }
    written |= {
        key_of(resolve.target_image)
        for resolve in first.render_pass.resolves
        if resolve.target_image is not None
    }
    between = (
        event
        for key in written
        for event in search.of.get(key, ())
        if first.end_time < event.time < second.begin_time
    )
    return not any(reads(event) and event.position not in read_at for event in between)

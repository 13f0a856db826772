"""Facts of copies and blits: the sample counts of what they read and write."""

from __future__ import annotations

from collections.abc import Iterator

from msaa_lint.frame.description.record import Record

from .commands import COPY_READ, COPY_WRITE, accesses
from .facts import Facts, Subject
from .frame import Frame


def copies(frame: Frame, around: Facts) -> Iterator[Subject]:
    """The copies and blits of a frame, between images and between an image and a buffer, with their
    facts.
    """
    for command in frame.commands:
        ends = {
            access.effect: (name, access.member)
            for name, access in accesses(command)
            if access.effect in (COPY_READ, COPY_WRITE)
        }
        body = command.body
        if not ends or not isinstance(body, Record):
            continue
        facts = Facts(around)
        facts.put("copy.command", command.kind, command.head)
        counts: list[int | None] = []
        multisampled_at = command.head
        for effect, (name, member) in ends.items():
            end = "source" if effect == COPY_READ else "target"
            target = frame.target(name)
            samples = target.samples if target is not None else None
            counts.append(samples)
            facts.put(f"copy.{end}", name)
            facts.put(f"copy.{end}_samples", samples, body.place(member))
            if samples is not None and samples > 1 and multisampled_at is command.head:
                multisampled_at = body.place(member)
        known = [count for count in counts if count is not None]
        multisampled = any(count > 1 for count in known)
        facts.put(
            "copy.multisampled",
            True if multisampled else None if None in counts else False,
            multisampled_at,
        )
        facts.put(
            "copy.counts_differ", None if len(known) < 2 else known[0] != known[1], multisampled_at
        )
        yield Subject("copy", command.path, command.head, facts)

"""The confidence of findings in source code: low if one of the values that a finding rests on is
assumed, otherwise at most medium.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from msaa_lint.core.finding import CONFIDENCES, Finding
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.parts import Attachment, Resolve, Target

LOW, MEDIUM, _ = CONFIDENCES

_PARAMETER = re.compile(r"\A\w+\((\w+)\)\Z")
"""A condition on the parameter of a function."""

_NAME = re.compile(r"#?[\w.:()]{1,40}")
"""A condition that can be named as it is written."""


class Qualifier:
    """Lowers the confidence of the findings of a document from source code.

    A finding rests on all values of its subject: of the attachment, with its images and resolves;
    of the image, with the attachments that it is bound to; of the pipeline, and so on. It is of low
    confidence if one of them is assumed, if more than one condition was decided for them, which may
    never hold together, or if the document consists of excerpts.
    """

    def __init__(self, document: Document, attachments: Mapping[int, Sequence[Attachment]]) -> None:
        self._pieces = document.pieces
        self._basis = document.basis
        self._attachments = attachments
        self._places: dict[int, frozenset[Span]] = {}
        """By the identity of a record: the places of its values."""

    def __call__(self, finding: Finding, subject: Subject) -> Finding:
        """The finding with the confidence that the values of its subject allow."""
        assumption = "" if self._pieces else self._assumption(subject)
        level = MEDIUM if assumption is None else LOW
        notes = (*finding.notes, f"assumption: {assumption}") if assumption else finding.notes
        if CONFIDENCES.index(finding.confidence) < CONFIDENCES.index(level):
            level = finding.confidence
        return finding._replace(confidence=level, notes=notes)

    def _assumption(self, subject: Subject) -> str | None:
        """What is assumed of a subject, in words (empty: one of the document's assumptions); None
        if nothing is.
        """
        conditions, assumed = self._basis
        if not conditions and not assumed:
            return None
        decided: set[str] = set()
        reasons: set[str] = set()
        for place in {
            *self._places_of(_records(subject, self._attachments)),
            *subject.facts.places.values(),
        }:
            if place in assumed:
                reasons.add(assumed[place])
            decided.update(conditions.get(place, ()))
        if reasons or len(decided) < 2:
            return max(reasons, default=None)
        names = [_PARAMETER.sub(r"\1", name) for name in decided]
        what = (
            " and ".join(quoted(name) for name in sorted(names))
            if all(map(_NAME.fullmatch, names))
            else f"{len(names)} conditions"
        )
        return f"{what} hold at the same time"

    def _places_of(self, records: Iterable[Record]) -> Iterator[Span]:
        for record in records:
            places = self._places.get(id(record))
            if places is None:
                places = self._places[id(record)] = frozenset((record.head, *_spans(record.node)))
            yield from places


def _records(subject: Subject, attachments: Mapping[int, Sequence[Attachment]]) -> Iterator[Record]:
    """The structures whose values the facts of a subject come from."""
    for part in (subject.pipeline, subject.dependency):
        if part is not None:
            yield part
    if subject.attachment is not None:
        yield from _of_attachment(subject.attachment)
    if subject.image is not None:
        yield subject.image.record
        for attachment in attachments.get(id(subject.image.record), ()):
            yield from _of_attachment(attachment)
    if subject.resolve is not None:
        yield from _of_resolve(subject.resolve)
    if subject.subpass is not None:
        yield subject.subpass.record
        for used in (*subject.subpass.color, *subject.subpass.depth_stencil):
            if used is not None:
                yield used.record
                yield from _of_images(used.targets)
    if subject.render_pass is not None:
        yield subject.render_pass.record


def _of_attachment(attachment: Attachment) -> Iterator[Record]:
    yield attachment.record
    yield from _of_images(attachment.targets)
    for resolve in attachment.resolved:
        yield from _of_resolve(resolve)


def _of_resolve(resolve: Resolve) -> Iterator[Record]:
    yield resolve.record
    for end in (resolve.source, resolve.target):
        if end is not None:
            yield end.record
            yield from _of_images(end.targets)
    yield from _of_images(
        target for target in (resolve.source_image, resolve.target_image) if target is not None
    )


def _of_images(targets: Iterable[Target]) -> Iterator[Record]:
    return (target.record for target in targets)


def _spans(node: Node) -> Iterator[Span]:
    """The places of a node and of everything in it."""
    waiting = [node]
    while waiting:
        node = waiting.pop()
        yield node.span
        if node.kind == "mapping":
            waiting += [*node.keys.values(), *node.value.values()]
        elif node.kind == "sequence":
            waiting += node.value

"""Files whose documents are the kinds of frame of one program: each defect is one finding, however
many of these frames have it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from msaa_lint.core.finding import CONFIDENCES, Finding, Price, rank
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.record import Record

from .results import DocumentResult, FileResult
from .rules.rule_runner import Verdicts, finding_key

if TYPE_CHECKING:
    from msaa_lint.frame.facts.parts import Pass

_DOCUMENT = re.compile(r"documents\[(\d+)\]\.")
_DIGITS = re.compile(r"\d+")
_COMMAND = re.compile(r"commands\[(\d+)\]")

MAX_TURNS = 64
"""Maximum number of defects of alike images of which each may be that of another frame."""

SHARED_SECTIONS = ("images", "renderPasses", "framebuffers", "pipelines")
"""The sections in which documents of a program describe the same object under the same name."""


def merged(result: FileResult) -> FileResult:
    """The result of linting a file, with one finding for each defect of a program whose frames it
    describes.

    The result that fixes work with, which has a finding for each document, is its `description`.
    """
    findings = merge(result.findings, result.documents)
    return (
        result._replace(findings=findings, description=result)
        if len(findings) < len(result.findings)
        else result
    )


def merge(findings: Sequence[Finding], documents: Sequence[DocumentResult]) -> list[Finding]:
    """The findings, with one for each defect that several kinds of frame of a program have.

    A defect is one if its rule, the member, and the objects are the same. A rendering is the same
    if its multisampled images are. Images are the same, too, if they are created alike, used alike,
    and no frame has the defect for both: then they take turns.
    """
    programs = {
        document.number: _Objects(document.document)
        for document in documents
        if document.document.is_frame_of_program
    }
    if len(programs) < 2:
        return list(findings)
    groups: dict[Hashable, list[tuple[int, Finding]]] = {}
    for finding in findings:
        number, subject = _parts(finding)
        key = programs[number].key(finding, subject) if number in programs else (len(groups),)
        groups.setdefault(key, []).append((number, finding))
    defects: dict[Hashable, list[list[tuple[int, Finding]]]] = {}
    for found in groups.values():
        number, finding = found[0]
        alike: Hashable = id(found)
        numbers = {number for number, _ in found}
        if number in programs and finding.images:
            subject = _parts(finding)[1]
            is_image = subject.startswith("images.")
            place = "images" if is_image else _COMMAND.sub("commands", subject)
            alike = (
                finding.code,
                finding.context,
                place,
                programs[number].likeness(finding.images),
            )
            if is_image and not programs[number].multisampled(finding.images):
                # What is only resolved to takes turns even within a kind of frame: commands between
                # passes may name any of several.
                numbers = set()
        same = defects.setdefault(alike, [])
        group = next(
            (
                group
                for group in same[:MAX_TURNS]
                if numbers.isdisjoint(number for number, _ in group)
            ),
            None,
        )
        if group is None:
            same.append(found)
        else:
            group += found
    return [_one(group) for same in defects.values() for group in same]


def shared_objects(documents: Sequence[DocumentResult]) -> Callable[[Finding], Hashable | None]:
    """A function that returns the rule of a finding and the object that it is about, if documents
    of a program share such objects.
    """
    programs = {document.number for document in documents if document.document.is_frame_of_program}

    def shared(finding: Finding) -> Hashable | None:
        number, subject = _parts(finding)
        is_shared = number in programs and subject.partition(".")[0] in SHARED_SECTIONS
        return (finding.code, subject) if is_shared else None

    return shared


def _parts(finding: Finding) -> tuple[int, str]:
    """The number of the document that a finding is in, and its subject there; -1 if it is the only
    document.
    """
    match = _DOCUMENT.match(finding.subject)
    return (
        (int(match[1]), finding.subject[match.end() :])
        if match is not None
        else (-1, finding.subject)
    )


class _Objects:
    """The objects of a document that findings are about."""

    def __init__(self, document: Document) -> None:
        self._document = document
        self._counts: dict[Hashable, int] = {}

    def key(self, finding: Finding, subject: str) -> Hashable:
        """What tells a defect from others."""
        match = _COMMAND.match(subject)
        if match is None:
            return finding.code, subject
        position = int(match[1])
        images = (
            self.multisampled(finding.images),
            self.multisampled(self._rendered.get(position, frozenset())),
        )
        key = (finding.code, finding.context, _COMMAND.sub("commands", subject), *images)
        if any(images):
            return key
        # The n-th such finding of a document is the n-th of another.
        self._counts[key] = self._counts.get(key, 0) + 1
        return (*key, finding.images, self._counts[key])

    def likeness(self, names: frozenset[str]) -> Hashable:
        """How the images are named, but for numbers, how they are created, and for multisampled
        ones what passes do with them.
        """
        images = self._document.description.images
        many = self.multisampled(names)
        described = [
            (
                _DIGITS.sub("", name),
                plain(images[name]),
                sorted(self._uses.get(name, ())) if many else (),
            )
            for name in many or names
            if name in images
        ]
        return tuple(sorted(map(repr, described)))

    def multisampled(self, names: frozenset[str]) -> frozenset[str]:
        """Those of some images that have several samples. What they are resolved to differs from
        frame to frame.
        """
        images = self._document.description.images
        return frozenset(
            name for name in names if name in images and (images[name].samples or 1) > 1
        )

    @cached_property
    def _passes(self) -> list[Pass]:
        from msaa_lint.frame.facts.frame import Frame

        return Frame(self._document).passes

    @cached_property
    def _rendered(self) -> dict[int, frozenset[str]]:
        """The images of renderings by the positions of the commands that begin them."""
        return {
            position: frozenset(
                target.name for attachment in each.attachments for target in attachment.targets
            )
            for each in self._passes
            if each.kind == "rendering"
            for position in each.begun
        }

    @cached_property
    def _uses(self) -> dict[str, set[str]]:
        """The load and store operations that passes have for each image."""
        uses: dict[str, set[str]] = {}
        for each in self._passes:
            for attachment in each.attachments:
                operations = repr(
                    [(aspect.name, aspect.load, aspect.store) for aspect in attachment.aspects]
                )
                for target in attachment.targets:
                    uses.setdefault(target.name, set()).add(operations)
        return uses


def _one(found: Sequence[tuple[int, Finding]]) -> Finding:
    """One finding for those of a defect: the most severe, of several the first, which is that of
    the most frequent frame.

    Traffic adds up, because that of each frame is weighted by its share. The memory of an image
    counts once.
    """
    findings = [finding for _, finding in found]
    first = max(
        findings,
        key=lambda finding: (rank(finding.severity), CONFIDENCES.index(finding.confidence)),
    )
    if len(findings) == 1:
        return first
    prices = [finding.price for finding in findings if finding.price is not None]
    if prices:
        memory: dict[frozenset[str], float] = {}
        for finding in findings:
            if finding.price is not None:
                memory[finding.images] = max(
                    memory.get(finding.images, 0.0), finding.price.memory_mib
                )
        total = Price(*(sum(column) for column in zip(*prices, strict=True)))
        first = first._replace(price=total._replace(memory_mib=sum(memory.values())))
    location = first.capture_location
    if location is not None:
        # The location of an object has the frames of all kinds, that of a command the frames of
        # one.
        frames: dict[Hashable, int] = {}
        for number, finding in found:
            subject = _parts(finding)[1]
            other = finding.capture_location
            frames[number if _COMMAND.match(subject) else subject] = (
                (other.frames or 0) if other is not None else 0
            )
        first = first._replace(
            capture_location=location._replace(
                frames=min(sum(frames.values()), location.of) or None
            )
        )
    # What a command resolves to differs from frame to frame anyway.
    others = (
        {name for finding in findings for name in finding.images} - first.images
        if not _COMMAND.match(_parts(first)[1])
        else ()
    )
    return _with_others(first, sorted(others))


def of_turns(verdicts: Verdicts, sets: Iterable[Sequence[str]]) -> Verdicts:
    """The verdicts with one finding for all images of a set that take turns: its fix is made in all
    of them.
    """
    firsts = {f"images.{name}": f"images.{names[0]}" for names in sets for name in names[1:]}
    spoken = (
        {(finding.code, finding.subject): finding for finding in verdicts.findings}
        if firsts
        else {}
    )
    others: dict[Hashable, list[str]] = {}
    remaining = []
    for finding in verdicts.findings:
        first = spoken.get((finding.code, firsts.get(finding.subject, "")))
        if first is None:
            remaining.append(finding)
            continue
        others.setdefault(finding_key(first), []).append(finding.subject.removeprefix("images."))
        specs = verdicts.fix_specs.pop(finding_key(finding), [])
        verdicts.fix_specs.setdefault(finding_key(first), []).extend(specs)
    if not others:
        return verdicts
    findings = [
        _with_others(finding, others.get(finding_key(finding), ())) for finding in remaining
    ]
    return verdicts._replace(findings=findings)


def _with_others(finding: Finding, names: Iterable[str]) -> Finding:
    """A finding that applies to other images, too, with a note that names them."""
    text = ", ".join(f"`{name}`" for name in names)
    return (
        finding._replace(
            notes=(
                *finding.notes,
                f"the same applies to {text}, which other frames use in its place",
            )
        )
        if text
        else finding
    )


def plain(value: object) -> object:
    """A structure without its places: equal for structures that state the same."""
    if isinstance(value, Record):
        return {name: plain(getattr(value, name)) for name in value.spelled}
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    return [plain(item) for item in value] if isinstance(value, (list, tuple)) else value


def contradiction(before: FileResult, after: FileResult) -> str | None:
    """The name of an object that the documents of a program described alike before a change, but
    not after it.
    """
    described, old = _described(after), None
    for key, values in described.items():
        if len(values) > 1 and any(value != values[0] for value in values):
            old = _described(before) if old is None else old
            unchanged = old.get(key, [])
            if len(unchanged) > 1 and all(value == unchanged[0] for value in unchanged):
                return key[1]
    return None


def _described(result: FileResult) -> dict[tuple[str, str], list[object]]:
    """What the documents of a program say of each object, by section and name."""
    documents = [
        document.document for document in result.documents if document.document.is_frame_of_program
    ]
    described: dict[tuple[str, str], list[object]] = {}
    for document in documents if len(documents) > 1 else ():
        for section in SHARED_SECTIONS:
            for name, record in getattr(document.description, section).items():
                described.setdefault((section, name), []).append(plain(record))
    return described

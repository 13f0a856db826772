"""What findings cost: the frame as it is written less the frame with the fix, by the cost model. No rule has a formula of its own."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Finding, Price
from msaa_lint.frame.cost.amounts import Amount, FrameCost, Terms
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.cost.power import ASSUMED_FPS
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import BeginRenderPass, Command, Description, RenderPass
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.frame import Frame, Pass

from .fixes.changes import PLAIN, Change, Refused, Structural, applied
from .fixes.document_fixes import DocumentFixes
from .results import CombinedPrice
from .rules.rule_runner import Key, finding_key

Reread = Callable[[Sequence[Change]], Document | None]
"""A document with changes made in its text and read again; None where they cannot be written."""

MAX_TRIALS = 16
"""How many fixes that add or take away are tried one by one, where they cannot be made all at once."""

_DIGITS = 6
"""Decimals that are kept: differences of sums have noise below."""


class Part(NamedTuple):
    """What of a document changes may alter the cost of: passes by their path, images by their name."""

    passes: frozenset[str]
    images: frozenset[str]


class Prices:
    """Prices of one document's findings. What is the same for several is worked out once."""

    def __init__(self, document: Document, device: DeviceProfile | None, terms: Terms | None, reread: Reread) -> None:
        self.document = document
        self.device = device
        self.terms = terms
        self._reread = reread
        self._frame = Frame(document)
        self._owners = dict(_owners(self._frame))
        self._before: dict[Part | None, FrameCost] = {}
        self._images: dict[Part, set[str]] = {}

    def of(self, changes: Sequence[Change]) -> Price | None:
        """What the frame costs for the lack of some changes; None where what they alter cannot be reckoned, for want of a size or format.

        Only the passes and images that the changes touch are reckoned, and what they have to do with: the rest is the same before and
        after.
        """
        part = self._part(changes)
        before = self.as_written(part)
        after = self.changed(changes, part)
        return None if after is None else _difference(before, after)

    def together(self, several: Iterable[Sequence[Change]]) -> Price | None:
        """What a frame costs for the lack of all of some changes; of two that give a member different values, the first.

        Where one takes away what another changes, as many as can be made together.
        """
        every = list(several)
        changes = merged(every)
        after = self.changed(changes, None) if changes else None
        if after is None and changes:
            after = self._as_many(every)
        return None if after is None else _difference(self.as_written(None), after)

    def _as_many(self, several: Sequence[Sequence[Change]]) -> FrameCost | None:
        """The frame with those of some changes that can be made together: first those that take nothing away."""
        taken = [changes for changes in several if all(change.action in PLAIN for change in changes)]
        after = self.changed(merged(taken), None)
        structural = [changes for changes in several if any(change.action not in PLAIN for change in changes)]
        for changes in structural[:MAX_TRIALS]:
            more = self.changed(merged([*taken, changes]), None)
            if more is not None:
                taken.append(changes)
                after = more
        return after

    def assumed(self, price: Price) -> tuple[str, ...]:
        """What a price takes for granted that the input does not state."""
        size = self.document.description.frame
        stated = size is not None and size.fps is not None
        return () if stated or not (price.read_mb_per_s or price.write_mb_per_s) else (f"the cost is at {ASSUMED_FPS:g} frames a second",)

    def as_written(self, part: Part | None = None) -> FrameCost:
        """What the frame, or a part of it, costs as it is written."""
        if part not in self._before:
            self._before[part] = self._cost(self.document, part)
        return self._before[part]

    def changed(self, changes: Sequence[Change], part: Part | None = None) -> FrameCost | None:
        """What the frame, or a part of it, costs with changes made; None where they cannot be made."""
        try:
            with applied(changes):
                return self._cost(self.document, part)
        except Structural:
            document = self._reread(changes)
            # What was inserted is in no part of the frame as it was.
            return None if document is None else self._cost(document, None)

    def _cost(self, document: Document, part: Part | None) -> FrameCost:
        if part is not None:
            description, images = _within(document.description, part, self._images.get(part, set()))
            # An image that a change leaves to nobody takes its memory all the same.
            self._images.setdefault(part, images)
            document = document._replace(description=description)
        return frame_cost(Frame(document), self.device, self.terms)

    def _part(self, changes: Sequence[Change]) -> Part | None:
        """The part that changes may alter; None, the whole, where one changes something that belongs to neither a pass nor an image."""
        passes: set[str] = set()
        images: set[str] = set()
        for change in changes:
            owners = self._owners.get(id(change.record))
            if owners is None or change.action not in PLAIN:
                return None
            passes |= owners.passes
            images |= owners.images
        return Part(frozenset(passes), frozenset(images))


def merged(several: Iterable[Sequence[Change]]) -> tuple[Change, ...]:
    """Changes of several fixes as one: what is changed alike once, and of two values for a member the first."""
    kept: dict[tuple[object, ...], Change] = {}
    for changes in several:
        for change in changes:
            what = (id(change.record), change.member) + ((change.action, str(change.value)) if change.action != "set" else ())
            kept.setdefault(what, change)
    return tuple(kept.values())


def _owners(frame: Frame) -> Iterator[tuple[int, Part]]:
    """Each record that is part of a pass or an image, by its identity, with what changes with it."""
    using: dict[str, set[str]] = {}
    for each in frame.passes:
        own = Part(frozenset({each.path}), frozenset())
        for record in _records(each):
            yield id(record), own
        for name in _images(each):
            using.setdefault(name, set()).add(each.path)
    for name, target in frame.targets.items():
        yield id(target.record), Part(frozenset(using.get(name, ())), frozenset({name}))


def _records(each: Pass) -> Iterator[Record]:
    yield each.record
    for attachment in each.attachments:
        yield attachment.record
    for subpass in each.subpasses:
        yield subpass.record
        chained = getattr(subpass.record, "depthStencilResolve", None)
        if chained is not None:
            yield chained


def _images(each: Pass) -> Iterator[str]:
    """The images that a pass draws to, resolves to or reads."""
    for attachment in each.attachments:
        for target in attachment.targets:
            if target.image is not None:
                yield target.name
    for subpass in each.subpasses:
        for resolve in subpass.resolves:
            if resolve.target_image is not None:
                yield resolve.target_image.name


def _within(description: Description, part: Part, images: set[str]) -> tuple[Description, set[str]]:
    """A description with the passes of a part alone, and the commands that begin them or name its images; and the names of all its images,
    some among them."""
    made = Description.__new__(Description)
    vars(made).update(vars(description))
    made.renderPasses = {name: record for name, record in description.renderPasses.items() if record.path in part.passes}
    made.pipelines = {}
    if description.commands is not None:
        made.commands = tuple(c for c in description.commands if c is not None and _concerns(c, part, made.renderPasses))
    named = {name for record in made.renderPasses.values() for name in _named(record)}
    named.update(name for command in made.commands or () if command is not None for name in _mentioned(command.body))
    named.update(name for buffer in description.framebuffers.values() for name in buffer.attachments if name is not None)
    named |= images | part.images
    made.images = {name: image for name, image in description.images.items() if name in named}
    return made, named


def _concerns(command: Command, part: Part, passes: dict[str, RenderPass]) -> bool:
    body = command.body
    if isinstance(body, BeginRenderPass):
        return body.renderPass in passes
    if command.kind == "beginRendering":
        return isinstance(body, Record) and body.path in part.passes
    return isinstance(body, Record) and not part.images.isdisjoint(_mentioned(body))


def _named(record: RenderPass) -> Iterator[str]:
    for attachment in record.attachments:
        if attachment is not None and attachment.image is not None:
            yield attachment.image


_MEMBERS = ("image", "srcImage", "dstImage", "resolveImage")


def _mentioned(body: object) -> Iterator[str]:
    """The images that a command names."""
    infos = (*getattr(body, "colorAttachments", ()), getattr(body, "depthAttachment", None), getattr(body, "stencilAttachment", None))
    for record in (body, *infos):
        for member in _MEMBERS:
            name = getattr(record, member, None)
            if isinstance(name, str):
                yield name


def _difference(before: FrameCost, after: FrameCost) -> Price | None:
    price = Price(*(round(a - b, _DIGITS) + 0.0 for a, b in zip(_figures(before.total), _figures(after.total), strict=True)))
    if not any(price) and (before.unknown or after.unknown):
        return None
    return price


def _figures(amount: Amount) -> tuple[float, float, float, float]:
    return amount.read_mb_per_s, amount.write_mb_per_s, amount.memory_mib, amount.milliwatts


def priced(offers: Sequence[DocumentFixes], findings: Sequence[Finding], terms: Terms | None = None) -> tuple[list[Finding], CombinedPrice]:
    """The findings of an input with their prices, and what works out what some of them cost together. `offers` are its documents' fixes."""
    books = [Prices(each.result.document, each.result.device, terms, each.reread) for each in offers]
    made: dict[Key, tuple[Prices, tuple[Change, ...]]] = {}
    out = []
    for found in findings:
        changes, book = next(((c, b) for o, b in zip(offers, books, strict=True) if (c := o.changes(found)) is not None), (None, None))
        if book is not None and changes is not None and not isinstance(changes, Refused):
            price = book.of(changes)
            if price is not None:
                made[finding_key(found)] = (book, changes)
                found = found._replace(price=price, notes=(*found.notes, *book.assumed(price)))
        out.append(found)

    def together(some: Sequence[Finding]) -> Price | None:
        by_book: dict[int, list[tuple[Change, ...]]] = {}
        for found in some:
            if finding_key(found) in made:
                book, changes = made[finding_key(found)]
                by_book.setdefault(books.index(book), []).append(changes)
        sums = [price for n, each in by_book.items() if (price := books[n].together(each)) is not None]
        return Price(*(sum(column) for column in zip(*sums, strict=True))) if sums else None

    return out, together

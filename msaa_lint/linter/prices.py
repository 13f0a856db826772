"""Prices of findings: the estimated cost of the frame as written minus its cost with the fix. No rule has its own formula."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Finding, Price
from msaa_lint.frame.cost.amounts import FrameCost
from msaa_lint.frame.cost.input_cost import input_total
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.cost.power import ASSUMED_FPS
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import BeginRenderPass, Command, Description, RenderPass
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.commands import named_images
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Pass

from .fixes.changes import Change, NoFix, StructuralChange, apply_temporarily
from .fixes.document_fixes import DocumentFixes
from .savings import difference

MAX_REREAD = 2 << 20
"""Characters that are read again for the prices of one document's fixes: a structural one is priced by reading the text that it gives."""


class Part(NamedTuple):
    """The part of a document whose cost changes may alter: passes by path, images by name."""

    passes: frozenset[str]
    images: frozenset[str]


NOT_PRICED = "the input has too many findings of this kind to price each of them; the totals include what its fix saves"


class Prices:
    """The prices of one document's findings. Costs that several findings have in common are computed once."""

    def __init__(self, fixes: DocumentFixes) -> None:
        self.document = fixes.result.document
        self._fixes = fixes
        self._owners = dict(_owners(Frame(self.document)))
        self._costs: dict[Part | None, FrameCost] = {}
        self._images: dict[Part, set[str]] = {}
        self._reread = 0

    @property
    def exhausted(self) -> bool:
        """Whether a fix was not priced because too much text would have been read again."""
        return self._reread > MAX_REREAD

    def of(self, changes: Sequence[Change]) -> Price | None:
        """The saving from some changes; None if a size or format that this depends on is unknown.

        Only the passes and images that the changes concern are computed, because the rest costs the same before and after.
        """
        part = self._part(changes)
        # First, because this also determines the images of the part.
        before = self.cost(part)
        after = self.cost_with(changes, part)
        return None if after is None else difference(input_total([before]), input_total([after]))

    def notes(self, price: Price) -> tuple[str, ...]:
        """What a price assumes that the input does not state."""
        size = self.document.description.frame
        assumes_fps = (size is None or size.fps is None) and bool(price.read_mb_per_s or price.write_mb_per_s)
        return (f"the cost assumes {ASSUMED_FPS:g} frames per second",) if assumes_fps else ()

    def cost(self, part: Part | None) -> FrameCost:
        """The cost of a part of the frame, or of all of it, as written."""
        if part not in self._costs:
            self._costs[part] = self._cost(self.document, part)
        return self._costs[part]

    def cost_with(self, changes: Sequence[Change], part: Part | None) -> FrameCost | None:
        """The cost of a part of the frame, or of all of it, after changes; None if they cannot be made."""
        try:
            with apply_temporarily(changes):
                return self._cost(self.document, part)
        except StructuralChange:
            self._reread += len(self.document.source.text)
            if self.exhausted:
                return None
            document = self._fixes.reread(changes)
            # New passes and images belong to no part of the original frame.
            return None if document is None else self._cost(document, None)

    def _cost(self, document: Document, part: Part | None) -> FrameCost:
        if part is not None:
            description, images = _restrict(document.description, part, self._images.get(part, set()))
            # An image takes its memory even if a change leaves it without a use.
            self._images.setdefault(part, images)
            document = document._replace(description=description)
        return frame_cost(Frame(document), self._fixes.result.device)

    def _part(self, changes: Sequence[Change]) -> Part | None:
        """The part whose cost changes may alter. None, for the whole frame, if one of them concerns neither a pass nor an image."""
        passes: set[str] = set()
        images: set[str] = set()
        for change in changes:
            owner = self._owners.get(id(change.record))
            if owner is None or change.structural:
                return None
            passes |= owner.passes
            images |= owner.images
        return Part(frozenset(passes), frozenset(images))


def _owners(frame: Frame) -> Iterator[tuple[int, Part]]:
    """The records of passes and images, by identity, with the part that changes with each."""
    users: dict[str, set[str]] = {}
    for render_pass in frame.passes:
        part = Part(frozenset({render_pass.path}), frozenset())
        for record in _records(render_pass):
            yield id(record), part
        for name in _images(render_pass):
            users.setdefault(name, set()).add(render_pass.path)
    for name, target in frame.targets.items():
        yield id(target.record), Part(frozenset(users.get(name, ())), frozenset({name}))


def _records(render_pass: Pass) -> Iterator[Record]:
    yield render_pass.record
    for attachment in render_pass.attachments:
        yield attachment.record
    for subpass in render_pass.subpasses:
        yield subpass.record
        depth_resolve = getattr(subpass.record, "depthStencilResolve", None)
        if depth_resolve is not None:
            yield depth_resolve


def _images(render_pass: Pass) -> Iterator[str]:
    """The images that a pass draws to, resolves to or reads."""
    for attachment in render_pass.attachments:
        for target in attachment.targets:
            if target.image is not None:
                yield target.name
    for subpass in render_pass.subpasses:
        for resolve in subpass.resolves:
            if resolve.target_image is not None:
                yield resolve.target_image.name


def _restrict(description: Description, part: Part, images: set[str]) -> tuple[Description, set[str]]:
    """A description with only the passes of a part, the commands that concern it, and the images that those name or that are given.

    Also returns the names of these images.
    """
    subset = Description.__new__(Description)
    vars(subset).update(vars(description))
    subset.renderPasses = {name: record for name, record in description.renderPasses.items() if record.path in part.passes}
    subset.pipelines = {}
    if description.commands is not None:
        commands = (command for command in description.commands if command is not None)
        subset.commands = tuple(command for command in commands if _concerns(command, part, subset.renderPasses))
    attachments = [attachment for record in subset.renderPasses.values() for attachment in record.attachments]
    names = images | part.images
    names.update(attachment.image for attachment in attachments if attachment is not None and attachment.image is not None)
    names.update(name for command in subset.commands or () if command is not None for name in named_images(command))
    names.update(name for framebuffer in description.framebuffers.values() for name in framebuffer.attachments if name is not None)
    subset.images = {name: image for name, image in description.images.items() if name in names}
    return subset, names


def _concerns(command: Command, part: Part, render_passes: dict[str, RenderPass]) -> bool:
    body = command.body
    if isinstance(body, BeginRenderPass):
        return body.renderPass in render_passes
    if command.kind == "beginRendering":
        return isinstance(body, Record) and body.path in part.passes
    return any(name in part.images for name in named_images(command))


def price_findings(documents: Sequence[DocumentFixes], findings: Sequence[Finding]) -> list[Finding]:
    """The findings of an input with their prices."""
    prices = list(map(Prices, documents))
    return [_priced(documents, prices, finding) for finding in findings]


def _priced(documents: Sequence[DocumentFixes], prices: Sequence[Prices], finding: Finding) -> Finding:
    number = next((n for n, fixes in enumerate(documents) if fixes.covers(finding)), None)
    if number is None:
        return finding
    try:
        price = prices[number].of(documents[number].changes(finding))
    except NoFix:
        return finding
    if price is None:
        return finding._replace(notes=(*finding.notes, NOT_PRICED)) if prices[number].exhausted else finding
    return finding._replace(price=price, notes=(*finding.notes, *prices[number].notes(price)))

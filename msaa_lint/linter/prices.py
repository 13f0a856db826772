"""Prices of findings: the estimated cost of the frame as written minus its cost with the fix. No
rule has its own formula.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import NamedTuple

from msaa_lint.core.allowance import Allowance
from msaa_lint.core.finding import Finding, Price
from msaa_lint.frame.cost.amounts import FrameCost
from msaa_lint.frame.cost.input_cost import input_total
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.cost.power import ASSUMED_FPS
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import (
    BeginRendering,
    BeginRenderPass,
    Description,
    PipelineBarrier,
    RenderPass,
)
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.commands import named_images
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Pass

from .fixes.changes import Change, NoFix, StructuralChange, apply_temporarily
from .fixes.document_fixes import DocumentFixes
from .fixes.references import nested_records
from .rules.rule_runner import Key, finding_key
from .savings import assumes_tiler, difference

MAX_REREAD = 1 << 19
"""Characters that are read again for the prices of one input's fixes: a structural one is priced by
reading the text that it gives.
"""

MAX_COSTED = 100_000
"""Passes, attachments, commands and images of which costs are computed for the prices of one
input's fixes.
"""

FINDING_WEIGHT = 10
"""What the price of a finding takes beside its part of the frame, in such structures."""


class Part(NamedTuple):
    """The part of a document whose cost changes may alter: passes by path, images by name."""

    passes: frozenset[str]
    images: frozenset[str]


NOT_PRICED = (
    "the input has too many findings of this kind to price each of them; the totals "
    "include what its fix saves"
)


class PriceAllowance(NamedTuple):
    """What the prices of one input may take: characters that are read again, and structures of
    which costs are computed.
    """

    reread: Allowance
    costed: Allowance


class NotPriced(Exception):
    """The budget has nothing left for the price of a finding."""


class Prices:
    """The prices of one document's findings. Costs that several findings have in common are
    computed once.
    """

    def __init__(self, fixes: DocumentFixes, budget: PriceAllowance) -> None:
        self.document = fixes.result.document
        self._fixes = fixes
        self._budget = budget
        self._parts = Parts(Frame(self.document))
        self._costs: dict[Part | None, FrameCost] = {}
        self._images: dict[Part, set[str]] = {}

    def of(self, changes: Sequence[Change]) -> Price | None:
        """The saving from some changes; None if a size or format that this depends on is unknown.
        Raises: NotPriced.

        Only the passes and images that the changes concern are computed, because the rest costs the
        same before and after.
        """
        part = self._parts.of(changes)
        if part == NO_PART:
            total = input_total([self.cost(None)])
            return difference(total, total)
        # First, because this also determines the images of the part.
        before = self.cost(part)
        after = self.cost_with(changes, part)
        return None if after is None else difference(input_total([before]), input_total([after]))

    def notes(self, price: Price) -> tuple[str, ...]:
        """What a price assumes that the input does not state."""
        size = self.document.description.frame
        assumes_fps = (size is None or size.fps is None) and bool(
            price.read_mb_per_s or price.write_mb_per_s
        )
        return (f"the cost assumes {ASSUMED_FPS:g} frames per second",) if assumes_fps else ()

    def cost(self, part: Part | None) -> FrameCost:
        """The cost of a part of the frame, or of all of it, as written."""
        if part not in self._costs:
            self._take(part)
            self._costs[part] = self._cost(self.document, part)
        return self._costs[part]

    def _take(self, part: Part | None) -> None:
        if not self._budget.costed.take(FINDING_WEIGHT + self._parts.weight(part)):
            raise NotPriced

    def cost_with(self, changes: Sequence[Change], part: Part | None) -> FrameCost | None:
        """The cost of a part of the frame, or of all of it, after changes; None if they cannot be
        made. Raises: NotPriced.
        """
        try:
            with apply_temporarily(changes):
                self._take(part)
                return self._cost(self.document, part)
        except StructuralChange:
            if not self._budget.reread.take(len(self.document.source.text)):
                raise NotPriced from None
            document = self._fixes.reread(changes)
            # New passes and images belong to no part of the original frame.
            return None if document is None else self._cost(document, None)

    def _cost(self, document: Document, part: Part | None) -> FrameCost:
        if part is not None:
            description, images = self._parts.restrict(part, self._images.get(part, set()))
            # An image takes its memory even if a change leaves it without a use.
            self._images.setdefault(part, images)
            document = document._replace(description=description)
        return frame_cost(Frame(document), self._fixes.result.device)


class Parts:
    """The parts of a frame: whose cost a change may alter, and the description with nothing but a
    part.
    """

    def __init__(self, frame: Frame) -> None:
        self._description = frame.description
        self._passes = {render_pass.path: render_pass for render_pass in frame.passes}
        self._begun_with: dict[str, list[str]] = {}
        """By pass: the framebuffers that are made for it, or that it is begun with."""
        self._commands = frame.commands
        self._naming: dict[str, list[int]] = {}
        """By image: the positions of the commands, without those that begin passes, that name
        it.
        """
        begins = (BeginRenderPass, BeginRendering)
        for position, command in enumerate(frame.commands):
            for name in (
                dict.fromkeys(named_images(command)) if not isinstance(command.body, begins) else ()
            ):
                self._naming.setdefault(name, []).append(position)
        paths = {record.path: name for name, record in frame.description.renderPasses.items()}
        names = {name: path for path, name in paths.items()}
        for framebuffer in frame.description.framebuffers.values():
            self._begun_with.setdefault(names.get(framebuffer.renderPass or "", ""), []).append(
                framebuffer.key
            )
        for render_pass in frame.passes:
            for position in render_pass.begun:
                buffers = frame.framebuffers_of(frame.commands[position].body)
                self._begun_with.setdefault(render_pass.path, []).extend(
                    buffer.key for buffer in buffers
                )
        self._order = {name: number for number, name in enumerate(frame.description.framebuffers)}
        self._owners = dict(_owners(frame))
        self._weights = {
            path: _weight(render_pass, self._begun_with.get(path, ()))
            for path, render_pass in self._passes.items()
        }

    def of(self, changes: Sequence[Change]) -> Part | None:
        """The part whose cost changes may alter. None, for the whole frame, if one of them concerns
        neither a pass nor an image.
        """
        passes: set[str] = set()
        images: set[str] = set()
        for change in changes:
            owner = self._owners.get(id(change.record))
            if owner is None or change.structural:
                return None
            passes |= owner.passes
            images |= owner.images
        return Part(frozenset(passes), frozenset(images))

    def weight(self, part: Part | None) -> int:
        """How many structures a part has."""
        if part is None:
            return sum(self._weights.values()) + len(self._commands) + len(self._description.images)
        named = sum(len(self._naming.get(name, ())) for name in part.images)
        return sum(self._weights.get(path, 0) for path in part.passes) + named + len(part.images)

    def restrict(self, part: Part, images: Collection[str]) -> tuple[Description, set[str]]:
        """The description with only the passes of a part, the commands that concern it, and the
        images that those name or that are given.

        Also returns the names of these images.
        """
        description = self._description
        passes = sorted(
            (self._passes[path] for path in part.passes),
            key=lambda render_pass: (render_pass.kind, render_pass.record.head),
        )
        subset = Description.__new__(Description)
        vars(subset).update(vars(description))
        subset.renderPasses = {
            each.name: each.record for each in passes if isinstance(each.record, RenderPass)
        }
        subset.pipelines = {}
        if description.commands is not None:
            positions = {position for each in passes for position in each.begun}
            positions.update(
                position for name in part.images for position in self._naming.get(name, ())
            )
            subset.commands = tuple(self._commands[position] for position in sorted(positions))
        keys = dict.fromkeys(key for each in passes for key in self._begun_with.get(each.path, ()))
        subset.framebuffers = {
            key: description.framebuffers[key] for key in sorted(keys, key=self._order.__getitem__)
        }
        attachments = [
            attachment
            for record in subset.renderPasses.values()
            for attachment in record.attachments
        ]
        names = {*images, *part.images}
        names.update(
            attachment.image
            for attachment in attachments
            if attachment is not None and attachment.image is not None
        )
        names.update(
            name
            for command in subset.commands or ()
            if command is not None
            for name in named_images(command)
        )
        names.update(
            name
            for framebuffer in subset.framebuffers.values()
            for name in framebuffer.attachments
            if name is not None
        )
        subset.images = {
            name: description.images[name] for name in sorted(names) if name in description.images
        }
        return subset, names


NO_PART = Part(frozenset(), frozenset())
"""What a change concerns that costs nothing: the state of a pipeline, or what a wait waits for."""


def _owners(frame: Frame) -> Iterator[tuple[int, Part]]:
    """The records of passes and images, by identity, with the part that changes with each; and
    those that cost nothing.
    """
    users: dict[str, set[str]] = {}
    for render_pass in frame.passes:
        part = Part(frozenset({render_pass.path}), frozenset())
        for record in _records(render_pass, frame):
            yield id(record), part
        for name in _images(render_pass):
            users.setdefault(name, set()).add(render_pass.path)
    for name, target in frame.targets.items():
        yield id(target.record), Part(frozenset(users.get(name, ())), frozenset({name}))
    for record in nested_records(frame.description.pipelines):
        yield id(record), NO_PART
    for _, barrier in frame.recorded(PipelineBarrier):
        yield id(barrier), NO_PART


def _weight(render_pass: Pass, framebuffers: Sequence[str]) -> int:
    subpasses = sum(
        1 + len(subpass.color) + len(subpass.resolves) for subpass in render_pass.subpasses
    )
    return (
        1
        + (2 + len(framebuffers)) * len(render_pass.attachments)
        + subpasses
        + len(render_pass.begun)
    )


def _records(render_pass: Pass, frame: Frame) -> Iterator[Record]:
    yield render_pass.record
    for attachment in render_pass.attachments:
        yield attachment.record
    for subpass in render_pass.subpasses:
        yield subpass.record
        depth_resolve = getattr(subpass.record, "depthStencilResolve", None)
        if depth_resolve is not None:
            yield depth_resolve
    for position in render_pass.begun:
        body = frame.commands[position].body
        if isinstance(body, Record):
            yield body


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


def price_findings(
    documents: Sequence[DocumentFixes],
    documents_by_key: Mapping[Key, Sequence[int]],
    findings: Sequence[Finding],
) -> list[Finding]:
    """The findings of an input with their prices. Beyond a budget, findings are not priced and say
    so.
    """
    budget = PriceAllowance(Allowance(MAX_REREAD), Allowance(MAX_COSTED))
    prices: dict[int, Prices] = {}
    priced = []
    for finding in findings:
        number = next(iter(documents_by_key.get(finding_key(finding), ())), None)
        if number is not None:
            if number not in prices:
                prices[number] = Prices(documents[number], budget)
            finding = _priced(documents[number], prices[number], finding)
        priced.append(finding)
    return priced


def _priced(fixes: DocumentFixes, prices: Prices, finding: Finding) -> Finding:
    try:
        changes, price_notes = fixes.price_changes(finding)
        price = prices.of(changes)
    except NoFix:
        return finding
    except NotPriced:
        return finding._replace(notes=(*finding.notes, NOT_PRICED))
    if price is None:
        return finding
    notes = (*finding.notes, *(price_notes if any(price) else ()), *prices.notes(price))
    return finding._replace(
        price=price, notes=notes, assumes_tiler=any(price) and assumes_tiler(fixes.result.device)
    )

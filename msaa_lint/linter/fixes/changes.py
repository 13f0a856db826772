"""What a fix changes, in terms of the document's records."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import cached_property
from types import TracebackType
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import Framebuffer, MetalRecord
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Attachment, Frame, Pass
from msaa_lint.frame.facts.image import Bindings
from msaa_lint.frame.facts.resolve import Writers, writers_of
from msaa_lint.frame.facts.resolve_uses import Results
from msaa_lint.frame.facts.timeline import Timeline
from msaa_lint.linter.rules.rule_file import FixSpec, Setting

from .mentions import Mentions
from .usages import Usages

if TYPE_CHECKING:
    from .metal_mentions import MetalMentions

PLAIN = ("set", "unset", "add", "remove")
"""The actions that change one member of a record and nothing else."""


class Change(NamedTuple):
    """One change of a record's member.

    `action` is `set` (value: a canonical name, a number or a boolean), `unset` (as if it were not stated), `add` or `remove` (of flags;
    value: one canonical name); or, of a member that holds entries, `entry` (value: a name and its plain data, put at the end of a mapping
    or a list), `append` (plain data, at the end of a list), `behind` (an index and plain data, put after what stands there), `item` (an
    index and a scalar, in place of what stands there), `drop` (an index).
    """

    record: Record
    member: str
    action: str
    value: Any = None


class Refused(NamedTuple):
    """Why there is no fix, in words."""

    reason: str


class Structural(Exception):
    """A change that `applied` cannot make: it adds entries or takes them away, or is one of Metal's words, of which the records are made.

    Write it into the text (`text.edits`) and read that.
    """


class FixContext:
    """What is made once for the fixes of one document: the frame, what is bound where, who uses what when."""

    def __init__(self, document: Document) -> None:
        self.document = document

    @cached_property
    def frame(self) -> Frame:
        return Frame(self.document)

    @cached_property
    def bindings(self) -> Bindings:
        return Bindings(self.frame)

    @cached_property
    def timeline(self) -> Timeline:
        return Timeline(self.frame)

    @cached_property
    def usages(self) -> Usages:
        return Usages(self.frame)

    @cached_property
    def writers(self) -> Writers:
        return writers_of(self.frame)

    @cached_property
    def results(self) -> Results:
        return Results(self.frame, self.timeline)

    @cached_property
    def mentions(self) -> Mentions:
        return Mentions(self.frame)

    @cached_property
    def metal_mentions(self) -> MetalMentions:
        from .metal_mentions import MetalMentions

        metal = self.document.description.metal
        assert metal is not None
        return MetalMentions(metal)

    @cached_property
    def recorded_at(self) -> dict[Span, list[tuple[int, int | None]]]:
        """The commands by the places that facts name; of a vkCmdClearAttachments its entries too."""
        from .clears import recorded_at

        return recorded_at(self)

    @cached_property
    def framebuffers(self) -> dict[str, list[Framebuffer]]:
        """By render pass."""
        found: dict[str, list[Framebuffer]] = {}
        for framebuffer in self.document.description.framebuffers.values():
            found.setdefault(framebuffer.renderPass or "", []).append(framebuffer)
        return found

    @cached_property
    def attachments(self) -> dict[int, list[tuple[Pass, Attachment]]]:
        """By the identity of an image's record: the attachments that it is bound to, with their passes."""
        found: dict[int, list[tuple[Pass, Attachment]]] = {}
        for each in self.frame.passes:
            for attachment in each.attachments:
                for record in {id(target.record) for target in attachment.targets}:
                    found.setdefault(record, []).append((each, attachment))
        return found


def changes(mend: FixSpec, subject: Subject, mending: FixContext) -> tuple[Change, ...] | Refused:
    """What a page's fix changes for a subject; a reason where there it has none."""
    from .fact_sources import places

    made: list[Change] = []
    if mend.do:
        from .actions import deed

        done = deed(mend.do, mending.document)(subject, mending)
        if isinstance(done, Refused):
            return done
        made += done
    for action, settings in (("set", mend.set), ("add", mend.add), ("remove", mend.remove)):
        for setting in settings:
            values = _values(setting, subject)
            if values is None:
                return Refused(f"{setting.value} is not known")
            at = places(setting.fact, subject, mending)
            if isinstance(at, Refused):
                return at
            made += [Change(record, member, as_action or action, value) for record, member, as_action in at for value in values]
    needed: list[Change] = []
    for change in made:
        if change not in needed and _changes_something(change):
            needed.append(change)
    return tuple(needed) or Refused("it is stated like that already")


def _values(setting: Setting, subject: Subject) -> list[Any] | None:
    """The value of a setting; where it names a fact, what that is: each of its texts, if it is a list."""
    match = re.fullmatch(r"\{([a-z_.0-9]+)\}", setting.value) if isinstance(setting.value, str) else None
    if match is None:
        return [setting.value]
    value = subject.facts.values.get(match[1])
    return list(value) if isinstance(value, list) else [value] if value is not None else None


def _changes_something(change: Change) -> bool:
    if change.action not in PLAIN:
        return True
    before = getattr(change.record, change.member)
    if change.action == "unset":
        return change.record.states(change.member)
    return bool(_after(change, before) != before)


def _after(change: Change, before: Any) -> Any:
    if change.action == "set":
        return change.value
    if change.action == "unset":
        return getattr(type(change.record), change.member)
    if change.action == "add":
        return tuple(dict.fromkeys((*(before or ()), change.value)))
    return before if before is None else tuple(flag for flag in before if flag != change.value)


class applied:
    """While it is entered, the records are as if the changes were made; what they were comes back exactly, whatever happens.

    Structural, with nothing changed, where one of them cannot be made so.
    """

    def __init__(self, changes: Iterable[Change]) -> None:
        self._changes: Sequence[Change] = tuple(changes)
        self._before: list[tuple[Record, str, Any]] = []

    def __enter__(self) -> None:
        if any(change.action not in PLAIN or isinstance(change.record, MetalRecord) for change in self._changes):
            raise Structural
        for change in self._changes:
            before = getattr(change.record, change.member)
            self._before.append((change.record, change.member, before))
            setattr(change.record, change.member, _after(change, before))

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        while self._before:
            record, member, value = self._before.pop()
            setattr(record, member, value)

"""The fixes of one text, in rounds: those that do not overlap are made at once, what comes out is judged again.

Nothing is taken that does not read clean, that leaves its finding, or that brings one that was not there.
"""

from __future__ import annotations

import re
from bisect import bisect_left, insort
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Finding, rank
from msaa_lint.core.text.edits import Overlap, apply
from msaa_lint.core.text.span import Edit
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules.rule_runner import finding_key

from .aliases import wishes
from .changes import Change, Refused
from .document_fixes import DocumentFixes

MAX_ROUNDS = 10
MAX_TRIALS = 60
"""Times that a text is judged again: a hostile one may hold thousands of fixes that fail, each found by halving."""

UNUSED = "MSAA911"
"""A suppression may lose what it silenced to a fix: that is no mistake of the fix, and the next round takes it out."""

Lint = Callable[[str], FileResult]
Kind = tuple[str, str]
"""A rule's code and a structural path without its indices, which move when something is taken out before them."""


class Unfixed(NamedTuple):
    """A finding whose fix was not made, and why."""

    finding: Finding
    reason: str


class Fixed(NamedTuple):
    """What came out: the text, its findings as they are now, those that are mended, those whose fix would not do."""

    text: str
    linted: FileResult
    fixed: tuple[Finding, ...]
    unfixed: tuple[Unfixed, ...]


class _Fix(NamedTuple):
    """Findings that are mended together, since they share an edit."""

    findings: tuple[Finding, ...]
    edits: tuple[Edit, ...]


def fix(linted: FileResult, lint: Lint, unsafe: bool = False, wanted: Callable[[Finding], bool] = lambda _: True) -> Fixed:
    """A text that was judged with its findings mended: by safe fixes, with `unsafe` by others too; `wanted` leaves some as they are.

    Suppressed findings stay. `lint` reads and judges a text.
    """
    return _Rounds(lint, unsafe, wanted).run(linted)


class _Rounds:
    def __init__(self, lint: Lint, unsafe: bool, wanted: Callable[[Finding], bool]) -> None:
        self.lint = lint
        self.unsafe = unsafe
        self.wanted = wanted
        self.trials = 0
        self.reasons: list[Unfixed] = []

    def run(self, linted: FileResult) -> Fixed:
        text = linted.source.text if linted.source is not None else ""
        fixed: list[Finding] = []
        for _ in range(MAX_ROUNDS):
            self.reasons = []
            waiting, taken = self.candidates(linted), list[_Fix]()
            # Where none of those can be made, what they stood in the way of may be.
            while waiting and not taken:
                chosen = _apart(waiting)
                taken, text, linted = self.take(chosen, [], text, linted, text, linted)
                waiting = [each for each in waiting if each not in chosen]
            if not taken:
                break
            fixed += (found for each in taken for found in each.findings)
        return Fixed(text, linted, tuple(fixed), tuple(self.reasons))

    def candidates(self, linted: FileResult) -> list[_Fix]:
        """The fixes that may be made, those that share an edit as one."""
        if linted.source is None:
            return []
        # Of two that want the same place otherwise, the graver has it.
        applicable = sorted((found for found in linted.findings if self.may(found)), key=lambda found: -rank(found.severity))
        # What a page says is worked out anew, with all that is wanted in this round; what is about comments has its edits.
        stated = {key for judged in linted.documents for key in judged.fix_specs}
        made = [
            _Fix((found,), found.fix.edits) for found in applicable if found.fix and found.fix.edits and finding_key(found) not in stated
        ]
        for judged in linted.documents:
            offers = DocumentFixes(linted.source, judged)
            changed: list[tuple[Finding, tuple[Change, ...]]] = []
            for found in applicable:
                changes = offers.changes(found)
                if isinstance(changes, Refused):
                    self.refuse(found, changes.reason)
                elif changes is not None:
                    changed.append((found, changes))
            changed = _leaving_one(changed)
            every = wishes(change for _, changes in changed for change in changes)
            for found, changes in changed:
                edits = offers.edits(changes, every)
                if isinstance(edits, Refused):
                    self.refuse(found, edits.reason)
                else:
                    made.append(_Fix((found,), edits))
        return _joined(made)

    def may(self, found: Finding) -> bool:
        mend = found.fix
        return mend is not None and not mend.shown and (mend.safe or self.unsafe) and self.wanted(found)

    def refuse(self, found: Finding, reason: str) -> None:
        self.reasons.append(Unfixed(found, reason))

    def take(
        self, group: Sequence[_Fix], taken: list[_Fix], text: str, linted: FileResult, now: str, judged: FileResult
    ) -> tuple[list[_Fix], str, FileResult]:
        """What can be taken of a group beside what is taken already, the text with it, and what is found in that.

        `text` and `linted` are those before the round, `now` and `judged` with what is taken. Who spoils a group is found by halving.
        """
        if self.trials >= MAX_TRIALS:
            for found in (found for each in group for found in each.findings):
                self.refuse(found, "too many fixes of this input cannot be made")
            return taken, now, judged
        self.trials += 1
        tried = [*taken, *group]
        try:
            new = apply(text, {edit for each in tried for edit in each.edits})
        except Overlap:
            reason, result = "it overlaps another fix", None
        else:
            result = self.lint(new)
            reason = _objection(linted, result, [found for each in tried for found in each.findings])
        if result is not None and not reason:
            return tried, new, result
        if len(group) == 1:
            for found in group[0].findings:
                self.refuse(found, reason)
            return taken, now, judged
        half = len(group) // 2
        taken, now, judged = self.take(group[:half], taken, text, linted, now, judged)
        return self.take(group[half:], taken, text, linted, now, judged)


def _leaving_one(changed: Iterable[tuple[Finding, tuple[Change, ...]]]) -> list[tuple[Finding, tuple[Change, ...]]]:
    """Fixes without those that would take the last entry of a list together with others: an empty list may mean something else than
    none, and who takes the last entry alone, in the next round, knows that it is the last."""
    gone: Counter[tuple[int, str]] = Counter()
    kept = []
    for found, changes in changed:
        dropped = [change for change in changes if change.action == "drop"]
        drops = Counter((id(change.record), change.member) for change in dropped)
        lengths = {(id(change.record), change.member): len(getattr(change.record, change.member)) for change in dropped}
        if any(gone[key] and gone[key] + count >= lengths[key] for key, count in drops.items()):
            continue
        gone += drops
        kept.append((found, changes))
    return kept


def _joined(fixes: Iterable[_Fix]) -> list[_Fix]:
    """Fixes that have an edit in common become one, where the first of them stands."""
    made = list(fixes)
    parents = list(range(len(made)))

    def root(n: int) -> int:
        while parents[n] != n:
            parents[n] = n = parents[parents[n]]
        return n

    owners: dict[Edit, int] = {}
    for n, each in enumerate(made):
        for edit in each.edits:
            one, other = sorted((root(owners.setdefault(edit, n)), root(n)))
            parents[other] = one
    groups: dict[int, list[_Fix]] = {}
    for n, each in enumerate(made):
        groups.setdefault(root(n), []).append(each)
    return [
        _Fix(tuple(found for one in group for found in one.findings), tuple(sorted({edit for one in group for edit in one.edits})))
        for group in groups.values()
    ]


def _apart(fixes: Iterable[_Fix]) -> list[_Fix]:
    """Those that do not overlap one that was chosen before; the others wait for the next round."""
    chosen: list[_Fix] = []
    taken: list[Edit] = []
    for each in fixes:
        if any(_overlaps(edit, taken) for edit in each.edits):
            continue
        chosen.append(each)
        for edit in each.edits:
            insort(taken, edit)
    return chosen


def _overlaps(edit: Edit, taken: Sequence[Edit]) -> bool:
    """Whether an edit claims text that one of those taken does; they are sorted, and do not overlap among themselves."""
    at = bisect_left(taken, edit)
    # Between the neighbours there may be insertions at its ends, which stand beside it.
    for other in taken[max(at - 2, 0) : at + 2]:
        (start, end), (from_, to) = edit.span, other.span
        if (start < to and from_ < end) or edit.span == other.span:
            return True
    return False


_INDEX = re.compile(r"\[[0-9]+\]")


def _kind(found: Finding) -> Kind:
    return (found.code, _INDEX.sub("[]", found.subject))


def _objection(before: FileResult, after: FileResult, mended: Sequence[Finding]) -> str:
    """Why a result cannot be taken: in words, empty where it can."""
    broken = next((found for found in after.findings if found.fatal and _kind(found) not in set(map(_kind, before.findings))), None)
    if broken is not None:
        return f"the result would not read clean: {broken.message}"
    # A silenced finding is still there: one that only got under a comment is not mended.
    there = Counter(map(_kind, [*before.findings, *(each.finding for each in before.suppressed)]))
    left = Counter(map(_kind, [*after.findings, *(each.finding for each in after.suppressed)]))
    new = next((kind for kind in left if left[kind] > there[kind] and kind[0] != UNUSED), None)
    if new is not None:
        brought = next(found for found in [*after.findings, *(each.finding for each in after.suppressed)] if _kind(found) == new)
        return f"it would bring {brought.rule}: {brought.message}"
    gone = Counter(map(_kind, mended))
    kept = next((found for found in mended if left[_kind(found)] > there[_kind(found)] - gone[_kind(found)]), None)
    return "the finding would stay" if kept is not None and kept.code != UNUSED else ""

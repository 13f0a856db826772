"""Fixes one text in rounds: each applies the fixes that do not overlap, then lints the result.

A fix is kept only if the result has no errors, its finding is gone, and no finding appears that was
not there before.
"""

from __future__ import annotations

from bisect import bisect_left, insort
from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Finding, rank
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.edits import Overlap, apply
from msaa_lint.core.text.span import Edit
from msaa_lint.linter.programs import contradiction, shared_objects
from msaa_lint.linter.results import FileResult, finding_kind
from msaa_lint.linter.rules.rule_runner import finding_key

from .aliases import Member, requests
from .changes import Change, NoFix
from .document_fixes import DocumentFixes, documents_by_key

MAX_ROUNDS = 10
MAX_TRIALS = 60
"""How often a text is linted at most: a hostile text may have thousands of failing fixes, each
found by bisection.
"""

MIN_TRIALS = 8
MAX_TRIAL_SIZE = 4 << 20
"""Characters of all trials together, beyond `MIN_TRIALS`."""

UNUSED_SUPPRESSION = "MSAA911"
"""A fix may leave a suppression without a finding. That is not the fix's fault, and the next round
removes the suppression.
"""

Lint = Callable[[str], FileResult]
"""Lints a text."""


class FailedFix(NamedTuple):
    """A finding that was not fixed, and the reason."""

    finding: Finding
    reason: str


class FixResult(NamedTuple):
    """A fixed text, the result of linting it, the findings that are fixed, and the fixes that
    failed in the last round.
    """

    text: str
    result: FileResult
    fixed_findings: tuple[Finding, ...]
    failed_fixes: tuple[FailedFix, ...]


class _Fix(NamedTuple):
    """The edits of one fix, or of several that share edits, with their findings."""

    findings: tuple[Finding, ...]
    edits: tuple[Edit, ...]


def fix_text(
    result: FileResult,
    lint: Lint,
    unsafe: bool = False,
    selects: Callable[[Finding], bool] = lambda _: True,
) -> FixResult:
    """Fixes the findings of a linted text that `selects` accepts, by safe fixes and, with `unsafe`,
    by unsafe ones too.

    Suppressed findings are not fixed.
    """
    return _Fixer(result, lint, unsafe, selects).run()


class _Fixer:
    """One run. `text` and `result` include the fixes applied so far."""

    def __init__(
        self, result: FileResult, lint: Lint, unsafe: bool, selects: Callable[[Finding], bool]
    ) -> None:
        self.text = result.source.text if result.source is not None else ""
        self.result = result
        self.lint = lint
        self.unsafe = unsafe
        self.selects = selects
        self.trials = 0
        self.max_trials = min(MAX_TRIALS, max(MIN_TRIALS, MAX_TRIAL_SIZE // (len(self.text) or 1)))
        self.failed_fixes: list[FailedFix] = []

    def run(self) -> FixResult:
        fixed_findings: list[Finding] = []
        for _ in range(MAX_ROUNDS):
            self.failed_fixes = []
            before_round = (self.text, self.result)
            candidates, applied = self.candidates(), list[_Fix]()
            # If none of the first fixes can be applied, those that overlap them may be.
            while candidates and not applied:
                group = _without_overlaps(candidates)
                applied = self.apply(group, [], *before_round)
                tried = set(map(id, group))
                candidates = [fix for fix in candidates if id(fix) not in tried]
            if not applied:
                break
            fixed_findings += (finding for fix in applied for finding in fix.findings)
        return FixResult(self.text, self.result, tuple(fixed_findings), tuple(self.failed_fixes))

    def candidates(self) -> list[_Fix]:
        """The fixes that may be applied, those of the most severe findings first. Fixes that share
        edits are joined.
        """
        if self.result.source is None:
            return []
        findings = sorted(
            filter(self.may_fix, self.result.findings), key=lambda finding: -rank(finding.severity)
        )
        # Fixes of rules are written anew, together with all others of this round; fixes of comments
        # come with their edits.
        of_rules = documents_by_key(self.result.documents)
        fixes = [
            _Fix((finding,), finding.fix.edits)
            for finding in findings
            if finding.fix and finding.fix.edits and finding_key(finding) not in of_rules
        ]
        of_document: dict[int, list[Finding]] = {}
        for finding in findings:
            for number in of_rules.get(finding_key(finding), ()):
                of_document.setdefault(number, []).append(finding)
        for number, document in enumerate(self.result.documents):
            if number in of_document:
                fixes += self.document_candidates(DocumentFixes(document), of_document[number])
        return _join(fixes, shared_objects(self.result.documents))

    def may_fix(self, finding: Finding) -> bool:
        """Whether a finding has a fix that may be applied."""
        fix = finding.fix
        return (
            fix is not None
            and not fix.shown
            and (fix.safe or self.unsafe)
            and self.selects(finding)
        )

    def document_candidates(self, fixes: DocumentFixes, findings: Iterable[Finding]) -> list[_Fix]:
        """The fixes of one document's findings."""
        plans: list[tuple[Finding, tuple[Change, ...]]] = []
        for finding in findings:
            try:
                plans.append((finding, fixes.changes(finding)))
            except NoFix as error:
                self.failed_fixes.append(FailedFix(finding, str(error)))
        plans = _leaving_an_entry(plans)
        requested = requests(change for _, changes in plans for change in changes)
        candidates = []
        for finding, changes in plans:
            try:
                candidates.append(_Fix((finding,), fixes.edits(changes, requested)))
            except NoFix as error:
                self.failed_fixes.append(FailedFix(finding, str(error)))
        return candidates

    def apply(
        self, group: Sequence[_Fix], applied: list[_Fix], text: str, result: FileResult
    ) -> list[_Fix]:
        """Applies as many fixes of a group as possible, after those already applied in this round.
        Returns all applied fixes.

        `text` and `result` are those before the round. Failing fixes are found by what their result
        has findings about, else by bisection.
        """
        if not group:
            return applied
        if self.trials >= self.max_trials:
            self.fail(group, "too many fixes of this input failed")
            return applied
        self.trials += 1
        attempt = [*applied, *group]
        objections = [Objection("it overlaps another fix")]
        edits = {edit for fix in attempt for edit in fix.edits}
        try:
            new_text = apply(text, edits)
        except Overlap:
            pass
        else:
            new_result = self.lint(new_text)
            objections = _objections(
                result, new_result, [finding for fix in attempt for finding in fix.findings], edits
            )
            if not objections:
                self.text, self.result = new_text, new_result
                return attempt
        if len(group) == 1:
            self.fail(group, objections[0].reason)
            return applied
        blamed = _blamed(group, objections)
        if len(blamed) == len(group) and None not in blamed.values():
            for number, reason in blamed.items():
                self.fail([group[number]], reason or "")
            return applied
        certain = [
            number for number in blamed if len(blamed) < len(group) or blamed[number] is not None
        ]
        middle = len(group) // 2
        later = set(certain or range(middle, len(group)))
        # The others first: without them it shows whether it is these that fail.
        applied = self.apply(
            [fix for number, fix in enumerate(group) if number not in later], applied, text, result
        )
        return self.apply(
            [fix for number, fix in enumerate(group) if number in later], applied, text, result
        )

    def fail(self, fixes: Iterable[_Fix], reason: str) -> None:
        """Records why fixes are not applied."""
        self.failed_fixes += (
            FailedFix(finding, reason) for fix in fixes for finding in fix.findings
        )


def _leaving_an_entry(
    plans: Iterable[tuple[Finding, tuple[Change, ...]]],
) -> list[tuple[Finding, tuple[Change, ...]]]:
    """The fixes without those that would remove the last entry of a list after others removed the
    rest.

    An empty list may mean something other than no list. In the next round the entry is the only
    one, and its fix accounts for that.
    """
    drop_counts: Counter[Member] = Counter()
    remaining = []
    for finding, changes in plans:
        drops = [change for change in changes if change.action == "drop"]
        counts = Counter((id(change.record), change.member) for change in drops)
        lengths = {
            (id(change.record), change.member): len(getattr(change.record, change.member))
            for change in drops
        }
        if any(
            drop_counts[member] and drop_counts[member] + count >= lengths[member]
            for member, count in counts.items()
        ):
            continue
        drop_counts.update(counts)
        remaining.append((finding, changes))
    return remaining


def _join(
    fixes: Sequence[_Fix], shared: Callable[[Finding], Hashable | None] = lambda _: None
) -> list[_Fix]:
    """Joins fixes that have edits in common, or whose findings are about one object, which `shared`
    returns, at the position of the first.

    A fix with edits that overlap others of its group stays apart: it is made after them, or in
    their place.
    """
    parents = list(range(len(fixes)))

    def root(n: int) -> int:
        while parents[n] != n:
            parents[n] = n = parents[parents[n]]
        return n

    owners: dict[Hashable, int] = {}
    for n, fix in enumerate(fixes):
        objects = (each for finding in fix.findings if (each := shared(finding)) is not None)
        for part in (*fix.edits, *objects):
            first, second = sorted((root(owners.setdefault(part, n)), root(n)))
            parents[second] = first
    groups: dict[int, list[_Fix]] = {}
    for n, fix in enumerate(fixes):
        groups.setdefault(root(n), []).append(fix)
    joined: list[_Fix] = []
    apart: list[_Fix] = []
    for group in groups.values():
        findings, edits, known = list[Finding](), list[Edit](), set[Edit]()
        for fix in group:
            new = [edit for edit in fix.edits if edit not in known]
            if any(_overlaps(edit, edits) for edit in new):
                apart.append(fix)
                continue
            findings += fix.findings
            known.update(new)
            for edit in new:
                insort(edits, edit)
        joined.append(_Fix(tuple(findings), tuple(edits)))
    return joined + apart


def _without_overlaps(fixes: Iterable[_Fix]) -> list[_Fix]:
    """The fixes that do not overlap an earlier fix of the result."""
    selection: list[_Fix] = []
    edits: list[Edit] = []
    for fix in fixes:
        if any(_overlaps(edit, edits) for edit in fix.edits):
            continue
        selection.append(fix)
        for edit in fix.edits:
            insort(edits, edit)
    return selection


def _overlaps(edit: Edit, others: Sequence[Edit]) -> bool:
    """Whether an edit overlaps one of several edits, which are sorted and do not overlap each
    other.
    """
    at = bisect_left(others, edit)
    # Between an edit and its neighbor there may be insertions at the edit's ends, which do not
    # overlap it.
    for other in others[max(at - 2, 0) : at + 2]:
        if edit.span == other.span or (
            edit.span.start < other.span.end and other.span.start < edit.span.end
        ):
            return True
    return False


def _with_suppressed(result: FileResult) -> list[Finding]:
    # A finding that only moved under a suppression comment is not fixed.
    return [*result.findings, *(suppressed.finding for suppressed in result.suppressed)]


def _document(finding: Finding) -> str:
    """The document of a stream that a finding is in, by the start of its subject. What a fix
    introduces is in its own document.
    """
    return finding.subject.partition(".")[0] if finding.subject.startswith("documents[") else ""


def _kind(finding: Finding) -> tuple[str, ...]:
    return (_document(finding), *finding_kind(finding))


def _images(finding: Finding) -> list[tuple[str, ...]]:
    document = _document(finding)
    return [(document, image) for image in finding.images]


class Objection(NamedTuple):
    """A reason why the result of fixes cannot be kept, and the finding that it is about, if a fix
    may be told from that.
    """

    reason: str
    finding: Finding | None = None


def _objections(
    before: FileResult, after: FileResult, fixed_findings: Sequence[Finding], edits: Iterable[Edit]
) -> list[Objection]:
    """The reasons why the result of fixes cannot be kept."""
    kinds_before = set(map(_kind, before.findings))
    error = next(
        (
            finding
            for finding in after.findings
            if finding.fatal and _kind(finding) not in kinds_before
        ),
        None,
    )
    if error is not None:
        return [Objection(f"the result would have an error: {error.message}")]
    name = contradiction(before, after)
    if name is not None:
        return [Objection(f"the documents would describe {quoted(name)} differently")]
    fixed_kinds = set(map(_kind, fixed_findings))
    return [
        Objection("it would not remove the finding", addition)
        if _kind(addition) in fixed_kinds
        else Objection(f"it would introduce {addition.rule}: {addition.message}", addition)
        for addition in _additions(before, after, fixed_findings, edits)
        if addition.code != UNUSED_SUPPRESSION
    ]


MAX_SUSPECTS = 4
"""Of more fixes that a finding may be due to, the one at fault is found by bisection."""


def _blamed(group: Sequence[_Fix], objections: Sequence[Objection]) -> dict[int, str | None]:
    """The fixes of a group, by number, that objections are probably due to: the reason, None where
    another fix may be at fault.

    A fix is suspected of a finding of its kind, or about one of its images; of several suspects,
    the last one.
    """
    suspects: dict[object, list[int]] = {}
    for number, fix in enumerate(group):
        for key in dict.fromkeys(
            key for finding in fix.findings for key in (_kind(finding), *_images(finding))
        ):
            suspects.setdefault(key, []).append(number)
    blamed: dict[int, str | None] = {}
    for objection in objections:
        keys = (
            (_kind(objection.finding), *_images(objection.finding))
            if objection.finding is not None
            else ()
        )
        lists = [suspects[key] for key in keys if key in suspects]
        numbers = (
            set[int]().union(*lists) if all(len(each) <= MAX_SUSPECTS for each in lists) else set()
        )
        if len(numbers) == 1:
            number = numbers.pop()
            blamed[number] = blamed.get(number) or objection.reason
        elif 1 < len(numbers) <= MAX_SUSPECTS:
            blamed.setdefault(max(numbers), None)
    return blamed


def _additions(
    before: FileResult, after: FileResult, fixed_findings: Sequence[Finding], edits: Iterable[Edit]
) -> Iterator[Finding]:
    """The findings of `after` that neither were there before nor are one that moved.

    A fix may move a finding: a resolve that becomes part of a pass has the same problem there. It
    is then by the same rule and about the same image as one in the text that the edits remove or
    replace.
    """
    expected = Counter(map(_kind, _with_suppressed(before)))
    expected.subtract(map(_kind, fixed_findings))
    new = []
    for finding in _with_suppressed(after):
        kind = _kind(finding)
        expected[kind] -= 1
        if expected[kind] < 0:
            new.append(finding)
    if not new:
        return
    spans = [edit.span for edit in edits]
    gone: dict[tuple[str, tuple[str, ...]], list[int]] = {}
    for number, finding in enumerate(_with_suppressed(before)):
        kind = _kind(finding)
        if expected[kind] > 0:
            expected[kind] -= 1
            at = finding.span
            if at is None or not any(
                span.start <= at.start and at.end <= span.end for span in spans
            ):
                continue
            for image in _images(finding):
                gone.setdefault((finding.code, image), []).append(number)
    matched: set[int] = set()
    for finding in new:
        candidates = [gone.get((finding.code, image), []) for image in _images(finding)]
        for numbers in candidates:
            while numbers and numbers[-1] in matched:
                numbers.pop()
        origin = min((numbers[-1] for numbers in candidates if numbers), default=None)
        if origin is None:
            yield finding
        else:
            matched.add(origin)

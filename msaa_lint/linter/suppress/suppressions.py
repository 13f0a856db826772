"""Applies suppression comments to findings, and reports the problems of the comments.

`# msaa-lint: ignore[rule, MSAA201] reason` suppresses the findings of those rules on its line or,
alone on its line, on the next line that is not a comment. A finding is on every line of its
location and of its labels in the same file. `# msaa-lint: ignore-file[rule] reason`, in the
comments at the top, applies to the whole file. 9xx errors cannot be suppressed.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Collection, Iterable, Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from msaa_lint.core.diagnostics import DIAGNOSTICS, diagnostic
from msaa_lint.core.finding import Finding, Fix, Suppressed
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.linter.settings.selectors import Named, RuleNames

from .comments import Directive, Entry, read, removing

if TYPE_CHECKING:
    from msaa_lint.core.text.comments import Comment
    from msaa_lint.core.text.source import Source

MAX_FINDINGS = 100
"""Of each code in a file: an input may have millions of comments."""

_ABOUT_COMMENTS = frozenset(
    info.name for info in DIAGNOSTICS.values() if info.severity == "warning"
)


def apply(
    findings: Iterable[Finding],
    comments: Sequence[Comment],
    source: Source,
    known_rules: Iterable[Named],
    enabled: Collection[str],
    comment_lines: Collection[int] | None = None,
) -> tuple[list[Finding], list[Suppressed], list[Finding]]:
    """The findings of one file that remain, the suppressed ones, and those about the comments
    (MSAA911, MSAA912, MSAA913).

    `enabled` are the names of the rules that were decided: only their suppressions can be unused.
    In a file with a 9xx error none is, since no rule ran. `comment_lines` is as for
    `comments.read`.
    """
    findings = list(findings)
    diagnostics = Diagnostics(source)
    directives = read(comments, source, diagnostics.add, comment_lines)
    names = RuleNames(known_rules)
    table = _Table()
    for directive in directives:
        for entry in directive.entries:
            _enter(table, diagnostics, names, directive, entry)
    kept, suppressed = table.apply(findings, source)
    if not any(found.fatal for found in findings):
        _report_unused(table, diagnostics, {*enabled} - _ABOUT_COMMENTS)
    remaining, about_comments = table.apply(diagnostics.take(), source)
    _report_unused(table, diagnostics, _ABOUT_COMMENTS)
    return kept, [*suppressed, *about_comments], [*remaining, *diagnostics.take()]


class Diagnostics:
    """The problems of the comments of a file, at most MAX_FINDINGS of each code."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._found: list[Finding] = []
        self._counts: dict[str, int] = {}

    def add(self, code: str, message: str, span: Span, fix: Fix | None = None) -> None:
        count = self._counts[code] = self._counts.get(code, 0) + 1
        if count <= MAX_FINDINGS:
            last = ("more findings of this kind are not shown",) if count == MAX_FINDINGS else ()
            self._found.append(
                diagnostic(code, message, self._source.name, span)._replace(fix=fix, notes=last)
            )

    def full(self, code: str) -> bool:
        return self._counts.get(code, 0) >= MAX_FINDINGS

    def take(self) -> list[Finding]:
        """The findings since the last call, in order of location."""
        found, self._found = self._found, []
        return sorted(found, key=lambda finding: (finding.span or Span(0, 0), finding.code))


class _Table:
    """The entries of suppressions by rule, for lines and for the whole file, and which of them
    suppressed a finding.
    """

    def __init__(self) -> None:
        self._on_lines: dict[str, list[tuple[int, int]]] = {}
        self._in_file: dict[str, list[int]] = {}
        self._entries: list[tuple[Directive, Entry, str]] = []
        self._used: set[int] = set()

    def add(self, directive: Directive, entry: Entry, rule: str) -> None:
        number = len(self._entries)
        self._entries.append((directive, entry, rule))
        if directive.line is None:
            self._in_file.setdefault(rule, []).append(number)
        else:
            self._on_lines.setdefault(rule, []).append((directive.line, number))

    def apply(
        self, findings: Iterable[Finding], source: Source
    ) -> tuple[list[Finding], list[Suppressed]]:
        """The findings that remain, and the suppressed ones."""
        for lines in self._on_lines.values():
            lines.sort()
        remaining: list[Finding] = []
        suppressed: list[Suppressed] = []
        covered: dict[str, list[tuple[int, int]]] = {}
        for found in findings:
            by = (
                None
                if found.fatal or found.file != source.name
                else self._by(found, source, covered)
            )
            if by is None:
                remaining.append(found)
            else:
                suppressed.append(Suppressed(found, "inline", self._entries[by][0].reason))
        for rule, ranges in covered.items():
            self._use(self._on_lines[rule], ranges)
        return remaining, suppressed

    def _by(
        self, found: Finding, source: Source, covered: dict[str, list[tuple[int, int]]]
    ) -> int | None:
        """The entry that suppresses a finding: the first on its lines, or else for the file. All
        entries that match it become used.
        """
        by = None
        lines = self._on_lines.get(found.rule)
        if lines is not None and found.span is not None:
            for span in (found.span, *(label.span for label in found.labels if label.file is None)):
                first, last = (
                    source.position(span.start).line,
                    source.position(max(span.start, span.end - 1)).line,
                )
                at = bisect_left(lines, (first, -1))
                if at < len(lines) and lines[at][0] <= last:
                    covered.setdefault(found.rule, []).append((first, last))
                    by = lines[at][1] if by is None else by
        in_file = self._in_file.get(found.rule)
        if in_file is not None:
            self._used.update(in_file)
            by = in_file[0] if by is None else by
        return by

    def _use(self, lines: list[tuple[int, int]], ranges: list[tuple[int, int]]) -> None:
        """Marks the entries on the lines of `ranges` as used, in linear time even if the ranges
        overlap.
        """
        done = 0
        for first, last in sorted(ranges):
            at = max(done, bisect_left(lines, (first, -1)))
            while at < len(lines) and lines[at][0] <= last:
                self._used.add(lines[at][1])
                at += 1
            done = max(done, at)

    def unused(self, rules: Collection[str]) -> Iterator[tuple[Directive, list[Entry]]]:
        """The suppressions with unused entries for these rules."""
        for directive, numbers in groupby(
            range(len(self._entries)), key=lambda number: self._entries[number][0]
        ):
            entries = [self._entries[number] for number in numbers if number not in self._used]
            unused = [entry for _, entry, rule in entries if rule in rules]
            if unused:
                yield directive, unused


def _enter(
    table: _Table, diagnostics: Diagnostics, names: RuleNames, directive: Directive, entry: Entry
) -> None:
    """Adds an entry to the table if it names a rule, or else reports it."""
    rule = names.by_word.get(entry.name)
    if rule is not None:
        info = DIAGNOSTICS.get(rule.code)
        if info is None or info.severity != "error":
            table.add(directive, entry, rule.name)
            return
        diagnostics.add(
            "MSAA911", f"{quoted(entry.name)} is an error and cannot be suppressed", entry.span
        )
    elif diagnostics.full("MSAA912") or names.may_be_missing(entry.name):
        return
    elif names.selects_any(entry.name):
        diagnostics.add(
            "MSAA913",
            f"{quoted(entry.name)} names a group of rules; name each rule to suppress",
            entry.span,
        )
    else:
        close = names.suggestions.nearest(entry.name)
        hint = (
            f"; did you mean `{close}`?"
            if close
            else "; separate rules with commas"
            if " " in entry.name
            else ""
        )
        fix = Fix(f"write {close}", False, (Edit(entry.span, close),)) if close else None
        diagnostics.add(
            "MSAA912", f"unknown rule {quoted(entry.name)} in a suppression{hint}", entry.span, fix
        )


def _report_unused(table: _Table, diagnostics: Diagnostics, rules: Collection[str]) -> None:
    for directive, entries in table.unused(rules):
        whole = len(entries) == len(directive.entries)
        for entry in entries:
            if diagnostics.full("MSAA911"):
                return
            fix = Fix("remove it", True, (removing(directive, entry, whole),))
            diagnostics.add(
                "MSAA911",
                f"unused suppression: no {quoted(entry.name)} finding here",
                entry.span,
                fix,
            )

"""Suppressions: comments of an input that silence findings, and what is wrong with them.

`# msaa-lint: ignore[rule, MSAA201] reason` silences those rules on its line; alone on its line, on the next line that is no comment.
A finding is on every line of its place and of its labels' places. `# msaa-lint: ignore-file[rule] reason` among the comments at the top
silences for the whole file. 9xx errors cannot be silenced: they say that something could not be judged.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from msaa_lint.core.diagnostics import DIAGNOSTICS, diagnostic
from msaa_lint.core.finding import Finding, Fix, Suppressed
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.linter.settings.selectors import Named, RuleNames

from .comments import Directive, Entry, read, without

if TYPE_CHECKING:
    from msaa_lint.core.text.comments import Comment
    from msaa_lint.core.text.source import Source

MAX_FINDINGS = 100
"""Of each code in a file."""

_ABOUT_COMMENTS = frozenset(info.name for info in DIAGNOSTICS.values() if info.severity == "warning")


def apply(
    findings: Iterable[Finding],
    comments: Sequence[Comment],
    source: Source,
    known_rules: Iterable[Named],
    enabled: Collection[str],
    alone: Collection[int] | None = None,
) -> tuple[list[Finding], list[Suppressed], list[Finding]]:
    """The findings of one file that stay, those that its comments silence, and what is wrong with the comments (MSAA911, 912, 913).

    `enabled` are the names of the rules that were judged: a suppression of any other is not called unused, so a rule that stayed
    undecided is best left out. Nothing is called unused in a file with a 9xx error, since that was not judged. `alone`, in source code,
    are the lines that hold comments and nothing else.
    """
    findings = list(findings)
    complaints = _Complaints(source)
    directives = read(comments, source, complaints.add, alone)
    words = RuleNames(known_rules)
    table = _Table()
    for directive in directives:
        for entry in directive.entries:
            _enter(table, complaints, words, directive, entry)
    kept, suppressed = table.silence(findings, source)
    if not any(found.fatal for found in findings):
        _report_unused(table, complaints, {*enabled} - _ABOUT_COMMENTS)
    remaining, silenced = table.silence(complaints.taken(), source)
    _report_unused(table, complaints, _ABOUT_COMMENTS)
    return kept, [*suppressed, *silenced], [*remaining, *complaints.taken()]


class _Complaints:
    """What is wrong with the comments of a file, the first of each code: a stranger may write millions."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._found: list[Finding] = []
        self._counts: dict[str, int] = {}

    def add(self, code: str, message: str, span: Span, help: str = "", fix: Fix | None = None) -> None:
        count = self._counts[code] = self._counts.get(code, 0) + 1
        if count <= MAX_FINDINGS:
            last = ("further findings of this kind are not shown",) if count == MAX_FINDINGS else ()
            self._found.append(diagnostic(code, message, self._source.name, span, help=help)._replace(fix=fix, notes=last))

    def full(self, code: str) -> bool:
        return self._counts.get(code, 0) >= MAX_FINDINGS

    def taken(self) -> list[Finding]:
        """What was found since it was last taken, by place."""
        found, self._found = self._found, []
        return sorted(found, key=lambda each: (each.span or Span(0, 0), each.code))


class _Table:
    """The rules that comments name, by line and for the whole file, and which of these entries silenced something."""

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

    def silence(self, findings: Iterable[Finding], source: Source) -> tuple[list[Finding], list[Suppressed]]:
        """The findings that no comment covers, and those that one does."""
        for lines in self._on_lines.values():
            lines.sort()
        kept: list[Finding] = []
        suppressed: list[Suppressed] = []
        covered: dict[str, list[tuple[int, int]]] = {}
        for found in findings:
            by = None if found.fatal or found.file != source.name else self._by(found, source, covered)
            if by is None:
                kept.append(found)
            else:
                suppressed.append(Suppressed(found, "inline", self._entries[by][0].reason))
        for rule, ranges in covered.items():
            self._use(self._on_lines[rule], ranges)
        return kept, suppressed

    def _by(self, found: Finding, source: Source, covered: dict[str, list[tuple[int, int]]]) -> int | None:
        """The entry that silences a finding: the first on its lines, else one for the file. All that could count as used."""
        by = None
        lines = self._on_lines.get(found.rule)
        if lines is not None and found.span is not None:
            for span in (found.span, *(label.span for label in found.labels)):
                first, last = source.position(span.start).line, source.position(max(span.start, span.end - 1)).line
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
        """Marks the entries on the lines of `ranges`, each once however much the ranges overlap."""
        done = 0
        for first, last in sorted(ranges):
            at = max(done, bisect_left(lines, (first, -1)))
            while at < len(lines) and lines[at][0] <= last:
                self._used.add(lines[at][1])
                at += 1
            done = max(done, at)

    def unused(self, rules: Collection[str]) -> Iterator[tuple[Directive, list[Entry]]]:
        """Each suppression with those of its entries that are for these rules and silenced nothing."""
        waiting: list[Entry] = []
        of: Directive | None = None
        for number, (directive, entry, rule) in enumerate(self._entries):
            if directive is not of:
                if of is not None and waiting:
                    yield of, waiting
                of, waiting = directive, []
            if number not in self._used and rule in rules:
                waiting.append(entry)
        if of is not None and waiting:
            yield of, waiting


def _enter(table: _Table, complaints: _Complaints, words: RuleNames, directive: Directive, entry: Entry) -> None:
    """A name in the brackets: to the table where it is a rule's, else what is wrong with it."""
    rule = words.by_word.get(entry.name)
    if rule is not None:
        info = DIAGNOSTICS.get(rule.code)
        if info is None or info.severity != "error":
            table.add(directive, entry, rule.name)
            return
        message = f"{quoted(entry.name)} cannot be silenced: it says that something could not be judged"
        complaints.add("MSAA911", message, entry.span)
    elif complaints.full("MSAA912"):
        return
    elif words.selects_any(entry.name):
        message = f"{quoted(entry.name)} names a group of rules: it silences nothing"
        complaints.add("MSAA913", message, entry.span, "name each rule that is meant")
    else:
        close = words.nearest(entry.name)
        help = f"did you mean `{close}`?" if close else "commas separate the rules" if " " in entry.name else ""
        fix = Fix(f"write {close}", False, (Edit(entry.span, close),)) if close else None
        complaints.add("MSAA912", f"unknown rule {quoted(entry.name)} in a suppression: it silences nothing", entry.span, help, fix)


def _report_unused(table: _Table, complaints: _Complaints, rules: Collection[str]) -> None:
    for directive, entries in table.unused(rules):
        whole = len(entries) == len(directive.entries)
        for entry in entries:
            if complaints.full("MSAA911"):
                return
            fix = Fix("remove it", True, (without(directive, entry, whole),))
            complaints.add("MSAA911", f"unused suppression: no {quoted(entry.name)} here", entry.span, fix=fix)

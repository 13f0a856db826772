"""Reads suppression comments: the rules they name, the lines they apply to, and the edits that
remove them.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from itertools import islice
from typing import TYPE_CHECKING, NamedTuple, Protocol

from msaa_lint.core.quote import quoted
from msaa_lint.core.suggestions import Suggestions
from msaa_lint.core.text.span import Edit, Span

if TYPE_CHECKING:
    from msaa_lint.core.text.comments import Comment
    from msaa_lint.core.text.source import Source

WORDS = ("ignore", "ignore-file")

ASSUME = "assume"
"""The word of a comment in source code that states what the code does not."""

_BEGINNING = re.compile(r"#\s*(msaa[-_ ]?lint)\b\s*(:)?\s*([A-Za-z_-]*)\s*", re.IGNORECASE)
_BEFORE_REASON = " \t-–—:"


class Entry(NamedTuple):
    """One rule in the brackets, as written."""

    name: str
    span: Span


MAX_ENTRIES = 100_000
"""Maximum number of rules that the suppressions of a file name; each takes almost a kilobyte of
memory.
"""


class Directive(NamedTuple):
    """One `ignore[...]` with the rules it names, the line that it applies to (None: the whole
    file), its reason and its location.

    `removal` is the span to delete to remove it.
    """

    entries: tuple[Entry, ...]
    line: int | None
    reason: str
    span: Span
    removal: Span


class Report(Protocol):
    """Reports a problem of a comment."""

    def __call__(self, code: str, message: str, span: Span) -> None: ...


def read(
    comments: Iterable[Comment],
    source: Source,
    report: Report,
    comment_lines: Collection[int] | None = None,
) -> list[Directive]:
    """The suppressions in comments, in order of location; comments that only look like one are
    reported.

    `comment_lines`, for source code, are the lines with nothing but comments; None for a text in
    which comments begin with `#`.
    """
    directives: list[Directive] = []
    count = 0
    lines = _Lines(source, comment_lines)
    for comment in sorted(comments, key=lambda comment: comment.span.start):
        starts = list(islice(_BEGINNING.finditer(comment.text), MAX_ENTRIES + 1))
        if not starts:
            continue
        lines.move_to(comment)
        ends = [*(match.start() for match in starts[1:]), len(comment.text)]
        first = not comment.text[: starts[0].start()].strip("# \t")
        for match, end in zip(starts, ends, strict=True):
            start = 0 if first and match is starts[0] else match.start()
            directive = _read(comment, match, start, end, lines, report)
            if directive is None:
                continue
            count += len(directive.entries)
            if count > MAX_ENTRIES:
                message = (
                    f"limit exceeded: suppressions name more than {MAX_ENTRIES:,} rules; "
                    "this one and those after it are not read"
                )
                report("MSAA906", message, directive.span)
                return directives
            directives.append(directive)
    return directives


def removing(directive: Directive, entry: Entry, whole: bool) -> Edit:
    """The edit that removes an entry from a suppression, or with `whole` the suppression."""
    if whole:
        return Edit(directive.removal, "")
    at = directive.entries.index(entry)
    if at + 1 < len(directive.entries):
        return Edit(Span(entry.span.start, directive.entries[at + 1].span.start), "")
    return Edit(Span(directive.entries[at - 1].span.end, entry.span.end), "")


class _Lines:
    """The line of the current comment, whether the comment is `alone` on it, and the line that it
    is `about`.
    """

    def __init__(self, source: Source, comment_lines: Collection[int] | None) -> None:
        self.source = source
        self.mark = "#" if comment_lines is None else "//"
        self._comment_lines = comment_lines
        self.line = self.about = 0
        self.alone = False
        self._run = (0, 0)
        self._content: int | None = None
        self.suggestions = Suggestions(WORDS)

    def move_to(self, comment: Comment) -> None:
        """Makes a comment the current one. One alone on its line is about the next line that is not
        a comment.
        """
        self.line, column = self.source.position(comment.span.start)
        if self._comment_lines is not None:
            self.alone = self.line in self._comment_lines
        else:
            self.alone = not self.source.line(self.line)[: column - 1].strip()
        self.about = self._next_content(self.line) if self.alone else self.line

    def _next_content(self, line: int) -> int:
        first, after = self._run
        if not first <= line < after:
            after = line + 1
            while after <= self.source.line_count and self._is_comment(after):
                after += 1
            self._run = (line, after)
        return after

    def _is_comment(self, number: int) -> bool:
        """Whether a line has a comment and nothing else."""
        if self._comment_lines is not None:
            return number in self._comment_lines
        return self.source.line(number).lstrip().startswith("#")

    def example(self, word: str = WORDS[0]) -> str:
        """What to write instead."""
        return f"write `{self.mark} msaa-lint: {word}[rule-name] reason`"

    def at_top(self) -> bool:
        """Whether the comment is before all content."""
        if self._content is None:
            at = 1
            while at <= self.source.line_count:
                text = self.source.line(at).strip()
                yaml = self._comment_lines is None and (
                    text.startswith("%") or text == "---" or text.startswith("--- #")
                )
                if text and not yaml and not self._is_comment(at):
                    break
                at += 1
            self._content = at
        return self.line < self._content


def _read(
    comment: Comment, match: re.Match[str], start: int, end: int, lines: _Lines, report: Report
) -> Directive | None:
    """The suppression of `match` in a comment, which extends from `start` to `end`."""
    base = comment.span.start
    rest = comment.text[match.end() : end]
    word = match[3].lower()
    span = Span(
        base + match.start(), base + match.start() + len(comment.text[match.start() : end].rstrip())
    )
    if match[1].lower() != "msaa-lint" or match[2] is None:
        if rest.startswith("[") and word.startswith("i"):
            report("MSAA913", f"invalid suppression; {lines.example()}", span)
        return None
    if word == ASSUME and lines.mark == "//":
        # Read with the code.
        return None
    if word not in WORDS:
        _unknown_word(match, base, lines, report)
        return None
    named = Span(span.start, base + match.end(3))
    close = rest.find("]")
    if not rest.startswith("["):
        if rest.startswith(("(", "{", ":", "=")):
            report("MSAA913", f"suppression without square brackets; {lines.example(word)}", span)
        else:
            report("MSAA913", f"`{word}` names no rule; {lines.example(word)}", named)
        return None
    if close < 0:
        report("MSAA913", f"suppression without a closing `]`; {lines.example()}", span)
        return None
    entries = _entries(rest[1:close], base + match.end() + 1)
    if not entries:
        report(
            "MSAA913",
            f"`{word}[]` names no rule; {lines.example(word)}",
            Span(span.start, base + match.end() + close + 1),
        )
        return None
    line: int | None = lines.about
    if word == "ignore-file":
        if not (lines.alone and lines.at_top()):
            message = (
                "`ignore-file` has no effect here; move it to the comments at the top of the "
                "file, or write `ignore`"
            )
            report("MSAA911", message, span)
            return None
        line = None
    reason = rest[close + 1 :].strip().lstrip(_BEFORE_REASON)
    whole = lines.alone and start == 0 and end == len(comment.text)
    return Directive(
        entries, line, reason, span, _removal(comment, start, end, whole, lines.source.text)
    )


def _unknown_word(match: re.Match[str], base: int, lines: _Lines, report: Report) -> None:
    close = lines.suggestions.nearest(match[3])
    hint = (
        f"did you mean `{close}`?"
        if close
        else "expected `ignore[rule-name]` or `ignore-file[rule-name]`"
    )
    span = (
        Span(base + match.start(3), base + match.end(3))
        if match[3]
        else Span(base + match.start(), base + match.end())
    )
    what = f"unknown word {quoted(match[3])}" if match[3] else "no word"
    report("MSAA913", f"{what} after `msaa-lint:`; {hint}", span)


def _entries(text: str, start: int) -> tuple[Entry, ...]:
    """The comma-separated names, each with its location."""
    entries = []
    for part in text.split(",", MAX_ENTRIES + 1):
        name = part.strip()
        if name:
            at = start + len(part) - len(part.lstrip())
            entries.append(Entry(name, Span(at, at + len(name))))
        start += len(part) + 1
    return tuple(entries)


def _removal(comment: Comment, start: int, end: int, line: bool, text: str) -> Span:
    """A suppression with the blanks before it, and with the end of its `line` if nothing else is on
    it.
    """
    first, last = comment.span.start + start, comment.span.start + end
    if end < len(comment.text):
        return Span(first, last)
    while first > 0 and text[first - 1] in " \t":
        first -= 1
    if line:
        if text.startswith("\r\n", last):
            last += 2
        elif text[last : last + 1] in ("\n", "\r"):
            last += 1
    return Span(first, last)

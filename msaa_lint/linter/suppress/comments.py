"""Reads suppression comments: what they name, where they count, and how one is taken out again."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from typing import TYPE_CHECKING, NamedTuple, Protocol

from msaa_lint.core.quote import quoted
from msaa_lint.core.suggestions import Suggestions
from msaa_lint.core.text.span import Edit, Span

if TYPE_CHECKING:
    from msaa_lint.core.text.comments import Comment
    from msaa_lint.core.text.source import Source

WORDS = ("ignore", "ignore-file")
HOW = "write `{mark} msaa-lint: {word}[rule-name] reason`"

_BEGINNING = re.compile(r"#\s*(msaa[-_ ]?lint)\b\s*(:)?\s*([A-Za-z_-]*)\s*", re.IGNORECASE)
_BEFORE_REASON = " \t-–—:"


class Entry(NamedTuple):
    """One rule in the brackets, as it is written."""

    name: str
    span: Span


class Directive(NamedTuple):
    """One `ignore[...]`: what it names, the line that it counts on (None: the whole file), its reason, and its place.

    `removal` is what goes with it where nothing of it is needed.
    """

    entries: tuple[Entry, ...]
    line: int | None
    reason: str
    span: Span
    removal: Span


class Complain(Protocol):
    """Takes what is wrong with a comment."""

    def __call__(self, code: str, message: str, span: Span, help: str = "") -> None: ...


def read(comments: Iterable[Comment], source: Source, complain: Complain, alone: Collection[int] | None = None) -> list[Directive]:
    """The suppressions in comments, in the order of their places; what looks like one and is none is complained about.

    `alone`, in source code, are the lines that hold comments and nothing else: there a `#` at the beginning of a line is none.
    """
    found: list[Directive] = []
    lines = _Lines(source, alone)
    for comment in sorted(comments, key=lambda each: each.span.start):
        starts = list(_BEGINNING.finditer(comment.text))
        if not starts:
            continue
        lines.at(comment)
        ends = [*(match.start() for match in starts[1:]), len(comment.text)]
        first = not comment.text[: starts[0].start()].strip("# \t")
        for match, end in zip(starts, ends, strict=True):
            start = 0 if first and match is starts[0] else match.start()
            directive = _read(comment, match, start, end, lines, complain)
            if directive is not None:
                found.append(directive)
    return found


def without(directive: Directive, entry: Entry, whole: bool) -> Edit:
    """The edit that takes an entry out of a suppression, or with `whole` all of it."""
    if whole:
        return Edit(directive.removal, "")
    at = directive.entries.index(entry)
    if at + 1 < len(directive.entries):
        return Edit(Span(entry.span.start, directive.entries[at + 1].span.start), "")
    return Edit(Span(directive.entries[at - 1].span.end, entry.span.end), "")


class _Lines:
    """The lines of a text, and how a comment stands among them: its line, whether it is `alone` on it, and the line that it is about."""

    def __init__(self, source: Source, comments: Collection[int] | None) -> None:
        self.source = source
        self.mark = "#" if comments is None else "//"
        self._comments = comments
        self.line = self.about = 0
        self.alone = False
        self._run = (0, 0)
        self._content: int | None = None
        self._suggestions = Suggestions(WORDS)

    def at(self, comment: Comment) -> None:
        """Moves on to a comment. One alone on its line is about the next line that does not begin with a comment too."""
        self.line, column = self.source.position(comment.span.start)
        if self._comments is not None:
            self.alone = self.line in self._comments
        else:
            self.alone = not self.source.line(self.line)[: column - 1].strip()
        self.about = self._after(self.line) if self.alone else self.line

    def _after(self, line: int) -> int:
        first, after = self._run
        if not first <= line < after:
            after = line + 1
            while after <= self.source.line_count and self._holds_a_comment(after):
                after += 1
            self._run = (line, after)
        return after

    def _holds_a_comment(self, number: int) -> bool:
        """Whether a line holds a comment and nothing else."""
        if self._comments is not None:
            return number in self._comments
        return self.source.line(number).lstrip().startswith("#")

    def how(self, word: str = WORDS[0]) -> str:
        """How a suppression is written."""
        return HOW.format(mark=self.mark, word=word)

    def nearest(self, word: str) -> str | None:
        """The one of WORDS that was most likely meant by another word; see `Suggestions` for its limits."""
        return self._suggestions.nearest(word)

    def at_top(self) -> bool:
        """Whether the comment stands before all content."""
        if self._content is None:
            at = 1
            while at <= self.source.line_count:
                text = self.source.line(at).strip()
                yaml = self._comments is None and (text.startswith("%") or text == "---" or text.startswith("--- #"))
                if text and not yaml and not self._holds_a_comment(at):
                    break
                at += 1
            self._content = at
        return self.line < self._content


def _read(comment: Comment, match: re.Match[str], start: int, end: int, lines: _Lines, complain: Complain) -> Directive | None:
    """The suppression of `match` in a comment, which reaches from `start` to `end`."""
    base = comment.span.start
    rest = comment.text[match.end() : end]
    word = match[3].lower()
    span = Span(base + match.start(), base + match.start() + len(comment.text[match.start() : end].rstrip()))
    if match[1].lower() != "msaa-lint" or match[2] is None:
        if rest.startswith("[") and word.startswith("i"):
            complain("MSAA913", "not written as a suppression: it silences nothing", span, lines.how())
        return None
    if word not in WORDS:
        _unknown_word(match, base, lines, complain)
        return None
    named = Span(span.start, base + match.end(3))
    close = rest.find("]")
    if not rest.startswith("["):
        if rest.startswith(("(", "{", ":", "=")):
            complain("MSAA913", f"`{word}` without square brackets: it silences nothing", span, lines.how(word))
        else:
            complain("MSAA913", f"`{word}` without a rule: it silences nothing", named, lines.how(word))
        return None
    if close < 0:
        complain("MSAA913", "a suppression without its `]`: it silences nothing", span, lines.how())
        return None
    entries = _entries(rest[1:close], base + match.end() + 1)
    if not entries:
        complain("MSAA913", f"`{word}[]` names no rule: it silences nothing", Span(span.start, base + match.end() + close + 1), lines.how())
        return None
    line: int | None = lines.about
    if word == "ignore-file":
        if not (lines.alone and lines.at_top()):
            message = "`ignore-file` counts only among the comments at the top of a file: it silences nothing"
            complain("MSAA911", message, span, "move it to the top, or write `ignore` here")
            return None
        line = None
    reason = rest[close + 1 :].strip().lstrip(_BEFORE_REASON)
    whole = lines.alone and start == 0 and end == len(comment.text)
    return Directive(entries, line, reason, span, _removal(comment, start, end, whole, lines.source.text))


def _unknown_word(match: re.Match[str], base: int, lines: _Lines, complain: Complain) -> None:
    close = lines.nearest(match[3])
    help = f"did you mean `{close}`?" if close else "there are `ignore[rule-name]` and `ignore-file[rule-name]`"
    span = Span(base + match.start(3), base + match.end(3)) if match[3] else Span(base + match.start(), base + match.end())
    what = f"unknown word {quoted(match[3])}" if match[3] else "no word"
    complain("MSAA913", f"{what} after `msaa-lint:`: it silences nothing", span, help)


def _entries(text: str, start: int) -> tuple[Entry, ...]:
    """What commas separate, each with its place."""
    entries = []
    for part in text.split(","):
        name = part.strip()
        if name:
            at = start + len(part) - len(part.lstrip())
            entries.append(Entry(name, Span(at, at + len(name))))
        start += len(part) + 1
    return tuple(entries)


def _removal(comment: Comment, start: int, end: int, line: bool, text: str) -> Span:
    """From the blanks before a suppression to its end; with its line where nothing else is on it."""
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

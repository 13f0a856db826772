"""Preprocessor conditions inside braces and calls.

The grammar does not support them: it reports `#ifdef` as an error and misreads what follows.
"""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.input.code.core.conditions import condition_key
from msaa_lint.input.code.parsing import SyntaxNode

_DIRECTIVE = re.compile(
    r"^[ \t]*#[ \t]*(ifdef|ifndef|if|elifdef|elifndef|elif|else|endif)\b((?:\\\n|[^\n])*)",
    re.MULTILINE,
)
_COMMENT = re.compile(r"//.*|/\*.*?(?:\*/|$)", re.DOTALL)
_BLOCK = re.compile(
    r"\b(?:class|struct|union|enum|namespace|else|do|try|const|noexcept|override|final|extern|mutable)\b[^=(]*$|\)\s*$|^\s*$"
)
"""What precedes the brace of a block rather than a list."""

_BRACKET = re.compile(r"[(){}\[\];]")

MAX_LIST_LENGTH = 20_000
"""The maximum distance in characters between the start of a list and a directive in it."""

MAX_ARMS = 32
"""The maximum number of directives from an #if to its #endif in a list; each depends on those
before it.
"""

MAX_CONDITIONS = 8
"""The maximum number of conditions of an item in a list."""

MAX_STATEMENT = 4000
"""The maximum number of characters before a brace in which the statement that it belongs to
starts.
"""


class Section(NamedTuple):
    """A range of the text that exists only if a condition holds, or, for `way` False, does not.
    Offsets are in characters.
    """

    start: int
    end: int
    text: str
    way: bool


def clear_list_directives(text: str, root: SyntaxNode) -> tuple[str, tuple[Section, ...]]:
    """Returns the text without the directives inside lists that cause parse errors, and the
    sections that depend on them.
    """
    if not root.has_error or "#if" not in text.replace(" ", ""):
        return text, ()
    errors = sorted(_error_ranges(root))
    brackets = _Brackets(text)
    sections: list[Section] = []
    blanked: list[tuple[int, int]] = []
    open_groups: list[list[re.Match[str]]] = []
    groups: list[list[re.Match[str]]] = []
    for match in _DIRECTIVE.finditer(text):
        word = match[1]
        if word.startswith("if"):
            open_groups.append([match])
        elif open_groups:
            open_groups[-1].append(match)
            if word == "endif":
                group = open_groups.pop()
                if len(group) <= MAX_ARMS and any(_is_error(errors, item) for item in group):
                    groups.append(group)
    for group in sorted(groups, key=lambda group: group[0].start()):
        if brackets.list_around(group[0].start()):
            sections += _of_group(group)
            blanked += [item.span() for item in group]
    if not blanked:
        return text, ()
    parts: list[str] = []
    last = 0
    for start, end in sorted(blanked):
        parts += (text[last:start], re.sub(r"[^\n]", " ", text[start:end]))
        last = end
    return "".join((*parts, text[last:])), tuple(sorted(sections))


class Sections:
    """The sections of a text, each inside another one or apart from it."""

    def __init__(self, sections: Sequence[Section]) -> None:
        # Sections of the same range are the conditions of one.
        self._sections = sorted(sections, key=lambda section: (section.start, -section.end))
        self._starts = [section.start for section in self._sections]
        self._around: list[int] = []
        """For each section, the one before it that contains it, or -1."""
        open_sections: list[int] = []
        for n, section in enumerate(self._sections):
            while open_sections and self._sections[open_sections[-1]].end <= section.start:
                open_sections.pop()
            self._around.append(open_sections[-1] if open_sections else -1)
            open_sections.append(n)

    def __bool__(self) -> bool:
        return bool(self._sections)

    def starts_in(self, start: int, end: int) -> bool:
        """Returns whether a section starts inside a range."""
        n = bisect_right(self._starts, start)
        return n < len(self._starts) and self._starts[n] < end

    def of(self, at: int) -> list[Section] | None:
        """Returns the sections that contain an offset, the outermost first; None if there are too
        many.
        """
        sections: list[Section] = []
        n = bisect_right(self._starts, at) - 1
        while n >= 0 and len(sections) <= MAX_CONDITIONS:
            if self._sections[n].end > at:
                sections.append(self._sections[n])
            n = self._around[n]
        return sections[::-1] if n < 0 else None


def _error_ranges(root: SyntaxNode) -> Iterator[tuple[int, int]]:
    """Yields the ranges of parse errors."""
    stack = [root]
    while stack:
        node = stack.pop()
        if node.is_error:
            yield node.start_byte, node.end_byte
        stack += [child for child in node.children if child.has_error]


def _is_error(errors: list[tuple[int, int]], match: re.Match[str]) -> bool:
    """Returns whether a parse error starts or ends on the line of a directive, or surrounds it
    closely.
    """
    start, end = match.span()
    at = bisect_left(errors, (start, 0))
    return any(
        a < end and b > start and (a >= start or b - a < MAX_LIST_LENGTH)
        for a, b in errors[max(at - 8, 0) : at + 8]
    )


class _Brackets:
    """The brackets of a text, read once from the start."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.signs = _BRACKET.finditer(text)
        self.next = next(self.signs, None)
        self.open: list[tuple[int, bool]] = []
        """The offsets of the open brackets, and whether a statement ends in each."""

    def list_around(self, at: int) -> bool:
        """Returns whether the innermost open bracket at an offset, not before the previous one,
        belongs to a call or a list of values.
        """
        while self.next is not None and self.next.start() < at:
            start, sign = self.next.start(), self.next[0]
            if sign in "({[":
                self.open.append((start, False))
            elif self.open:
                opened = self.open.pop()
                if sign == ";":
                    self.open.append((opened[0], True))
            self.next = next(self.signs, None)
        for n, ended in reversed(self.open):
            if ended or at - n > MAX_LIST_LENGTH:
                return False
            if self.text[n] != "{":
                return True
            before, sign = _before(self.text, n)
            if before.strip() or sign != "{":
                return _BLOCK.search(before) is None
            # Nested braces have the kind of the outer ones.
        return False


def _before(text: str, at: int) -> tuple[str, str]:
    """Returns the text from the end of the previous statement to an offset, without comments, and
    the character that ends that statement.
    """
    start = max(text.rfind(sign, max(at - MAX_STATEMENT, 0), at) for sign in ";{}")
    return _COMMENT.sub("", text[max(start + 1, at - 400) : at]), text[
        start : start + 1
    ] if start >= 0 else ""


def _of_group(group: list[re.Match[str]]) -> Iterator[Section]:
    """Yields the sections of the directives from an #if to its #endif."""
    failed: list[tuple[str, bool]] = []
    for n, match in enumerate(group[:-1]):
        start, end = match.end(), group[n + 1].start()
        yield from (Section(start, end, text, not way) for text, way in failed)
        if match[1] == "else":
            continue
        condition = condition_key(_COMMENT.sub("", match[2]), not match[1].endswith("ndef"))
        yield Section(start, end, *condition)
        failed.append(condition)

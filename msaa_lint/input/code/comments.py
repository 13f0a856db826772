"""The comments of source code that can hold suppressions, in the form of those of a description: a `#`, and what is said."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.core.text.comments import Comment
from msaa_lint.core.text.span import Span

from .parsing import Code


class Comments(NamedTuple):
    """The comments of a program, a line each, and the numbers of the lines that hold a comment and nothing else."""

    comments: tuple[Comment, ...]
    alone: frozenset[int]


# What may hold what looks like a comment and is none: strings, raw strings (C++ [lex.string]), Swift's of several lines and with `#`.
_C = re.compile(
    r"""
    (?P<line>//(?:[^\n\\]|\\(?:\r\n|[^\n])|\\\n)*)
    | (?P<block>/\*)
    | (?:\b(?:u8|[uUL])?R"(?P<mark>[^()\\\s"]{0,16})\((?:(?!\)(?P=mark)").)*(?:\)(?P=mark)"|\Z))
    | "(?:[^"\\\n]|\\.)*"?
    | '(?:[^'\\\n]|\\.){1,8}'
    """,
    re.VERBOSE | re.DOTALL,
)
_SWIFT = re.compile(
    r'''
    (?P<line>//[^\n]*)
    | (?P<block>/\*)
    | (?P<hashes>\#{1,8})"""(?:(?!"""(?P=hashes)).)*(?:"""(?P=hashes)|\Z)
    | (?P<few>\#{1,8})"(?:(?!"(?P=few))[^\n])*(?:"(?P=few))?
    | """(?:[^"\\]|\\.|"(?!""))*(?:"""|\Z)
    | "(?:[^"\\\n]|\\.)*"?
    ''',
    re.VERBOSE | re.DOTALL,
)
_EDGE = re.compile(r"/\*|\*/")
_BLANKS = re.compile(r"[ \t]*")
_BEFORE = re.compile(r"[ \t]*\**[ \t]*")


def comments(codes: Sequence[Code]) -> Comments:
    """The comments of code, in order. One that goes over several lines gives one for each; the `//` or `/*` is a `# ` in them, and what
    closes one is left out, so that offsets hold."""
    lines: list[Comment] = []
    alone: set[int] = set()
    for code in codes:
        _read(code, lines, alone)
    return Comments(tuple(sorted(lines)), frozenset(alone))


def _read(code: Code, lines: list[Comment], alone: set[int]) -> None:
    text = code.text
    # Lines count from 1.
    starts = [0, 0, *(match.end() for match in re.finditer(r"\r\n|\r|\n", text)), len(text) + 1]
    line, position, clean = 1, 0, True
    for start, end in spans(code):
        lines.extend(_lines(text, start, end))
        if starts[line + 1] <= start:
            while starts[line + 1] <= start:
                line += 1
            position, clean = starts[line], True
        clean = clean and not text[position:start].strip()
        while starts[line + 1] < end:
            if clean:
                alone.add(line)
            line += 1
            clean = True
        position = end
        rest = _BLANKS.match(text, end)
        if clean and rest is not None and (rest.end() == len(text) or text[rest.end()] in "\r\n"):
            alone.add(line)


def spans(code: Code) -> Iterator[tuple[int, int]]:
    """Where the comments of code are, with their marks. Linear in the text, whatever it holds."""
    text, swift = code.text, code.language == "swift"
    token = _SWIFT if swift else _C
    at = 0
    while (match := token.search(text, at)) is not None:
        at = match.end()
        if match["line"] is not None:
            yield match.start(), match.start() + len(match[0].rstrip("\r"))
        elif match["block"] is not None:
            at = _block_end(text, at, swift)
            yield match.start(), at


def _block_end(text: str, at: int, nested: bool) -> int:
    """The end of a block comment that is open at a place; those of Swift stand in each other."""
    deep = 1
    while deep:
        edge = _EDGE.search(text, at) if nested else None
        if not nested:
            end = text.find("*/", at)
            return end + 2 if end >= 0 else len(text)
        if edge is None:
            return len(text)
        deep += 1 if edge[0] == "/*" else -1
        at = edge.end()
    return at


def _lines(text: str, start: int, end: int) -> Iterator[Comment]:
    """The lines of a comment."""
    stop = end - 2 if text.startswith("/*", start) and end - start >= 4 and text.startswith("*/", end - 2) else end
    for match in re.finditer(r"[^\r\n]+", text[start:stop]):
        at, line = start + match.start(), match[0].rstrip()
        if at == start:
            yield Comment(Span(at, at + len(line)), "# " + line[2:])
            continue
        before = _BEFORE.match(line)
        assert before is not None
        # What stands at the margin has nothing before it that could be the `#`.
        if 0 < before.end() < len(line):
            at += before.end() - 1
            rest = line[before.end() :]
            yield Comment(Span(at, at + 1 + len(rest)), "#" + rest)

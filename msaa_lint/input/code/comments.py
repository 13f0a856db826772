"""Comments in source code that can contain suppressions, in the form of comments in a description:
`#` followed by text.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.core.text.comments import Comment
from msaa_lint.core.text.span import Span

from .parsing import Code


class Comments(NamedTuple):
    """The comments of a source file, one for each line, and the numbers of lines that contain only
    a comment.
    """

    comments: tuple[Comment, ...]
    alone: frozenset[int]


# Tokens that may contain comment marks: strings, raw strings (C++ [lex.string]), Swift's multi-line
# and `#` strings, Rust's raw strings.
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
_RUST = re.compile(
    r"""
    (?P<line>//[^\n]*)
    | (?P<block>/\*)
    | (?:\b[bc]?r(?P<hashes>\#{0,16})"(?:(?!"(?P=hashes)).)*(?:"(?P=hashes)|\Z))
    | "(?:[^"\\]|\\.)*"?
    | '(?:[^'\\\n]|\\[^\n]{1,10}?)'
    """,
    re.VERBOSE | re.DOTALL,
)
_TOKENS = {"swift": _SWIFT, "rust": _RUST}
_EDGE = re.compile(r"/\*|\*/")
_BLANKS = re.compile(r"[ \t]*")
_BEFORE = re.compile(r"[ \t]*\**[ \t]*")


def comments(codes: Sequence[Code]) -> Comments:
    """Returns the comments of code in order.

    A comment that spans several lines yields one for each line. The `//` or `/*` becomes `# `, and
    the closing mark is removed, so that offsets are preserved.
    """
    lines: list[Comment] = []
    alone: set[int] = set()
    for code in codes:
        _read(code, lines, alone)
    return Comments(tuple(sorted(lines)), frozenset(alone))


def _read(code: Code, lines: list[Comment], alone: set[int]) -> None:
    text = code.text
    # Line numbers start at 1.
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
    """Yields the ranges of comments, including their marks, in time linear in the text."""
    text, token, nests = code.text, _TOKENS.get(code.language, _C), code.language in _TOKENS
    at = 0
    while (match := token.search(text, at)) is not None:
        at = match.end()
        if match["line"] is not None:
            yield match.start(), match.start() + len(match[0].rstrip("\r"))
        elif match["block"] is not None:
            at = _block_end(text, at, nests)
            yield match.start(), at


def _block_end(text: str, at: int, nested: bool) -> int:
    """Returns the end of a block comment, which can nest in Swift and Rust."""
    if not nested:
        end = text.find("*/", at)
        return end + 2 if end >= 0 else len(text)
    depth = 1
    for edge in _EDGE.finditer(text, at):
        depth += 1 if edge[0] == "/*" else -1
        if not depth:
            return edge.end()
    return len(text)


def _lines(text: str, start: int, end: int) -> Iterator[Comment]:
    """Yields the lines of a comment."""
    stop = (
        end - 2
        if text.startswith("/*", start) and end - start >= 4 and text.startswith("*/", end - 2)
        else end
    )
    for match in re.finditer(r"[^\r\n]+", text[start:stop]):
        at, line = start + match.start(), match[0].rstrip()
        if at == start:
            yield Comment(Span(at, at + len(line)), "# " + line[2:])
            continue
        before = _BEFORE.match(line)
        assert before is not None
        # At the left margin, no character precedes the text that the `#` could replace.
        if 0 < before.end() < len(line):
            at += before.end() - 1
            rest = line[before.end() :]
            yield Comment(Span(at, at + 1 + len(rest)), "#" + rest)

"""The code of pages: AsciiDoc's and reStructuredText's code blocks, line by line; those of Markdown
are in `fences`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import NamedTuple

Line = tuple[int, int]
"""The range of a line, without its end."""

NAMES = {
    "c": "c", "h": "c",
    "cpp": "cpp", "c++": "cpp", "cc": "cpp", "cxx": "cpp", "hpp": "cpp", "h++": "cpp", "hxx": "cpp",
    "objc": "objc", "objective-c": "objc", "objectivec": "objc", "obj-c": "objc", "m": "objc",
    "objcpp": "objcpp", "objc++": "objcpp", "objective-c++": "objcpp", "obj-c++": "objcpp",
    "mm": "objcpp",
    "swift": "swift",
    "rust": "rust", "rs": "rust",
    "glsl": "glsl", "vert": "glsl", "frag": "glsl", "comp": "glsl",
}  # fmt: skip
"""Languages by the word that a page names them with, in lowercase."""

_LINE = re.compile(r"([^\r\n]*)(?:\r\n|\r|\n|\Z)")
_FENCE = re.compile(r"(`{3,})[ \t]*([\w+-]+)[ \t]*")
_CALLOUTS = re.compile(r"(?:[ \t]*<(?:\d+|\.)>)+[ \t]*\Z")
_SOURCE = re.compile(
    r"\[(?:source)?(?:%\w+)*,\s*(?:language=)?\"?([\w+-]+)\"?(?:%\w+)*\s*(?:,[^\]]*)?\][ \t]*"
)
_TITLE = re.compile(r"\.[^\s.].*|\[\[.*\]\][ \t]*|\[[#.%][^\]]*\][ \t]*")
"""A block title, an anchor, or attributes, which may stand between the language and its block."""

_DELIMITER = re.compile(r"(-{4,}|\.{4,}|--|`{3,})[ \t]*")
_DIRECTIVE = re.compile(r"([ \t]*)\.\.[ \t]+(?:code-block|code|sourcecode)::[ \t]*([\w+-]+)[ \t]*")
_OPTION = re.compile(r"[ \t]+:[\w-]+:.*")


class Block(NamedTuple):
    """A block of code: its language, and the ranges of its lines without quote marks and
    indentation.
    """

    language: str
    lines: tuple[Line, ...]


def lines_of(text: str) -> list[Line]:
    """Returns the lines of a text; the last one may be empty."""
    return [match.span(1) for match in _LINE.finditer(text)]


def asciidoc(text: str) -> Iterator[Block]:
    """Yields the blocks of AsciiDoc with a style of `source` and a language, and its fenced blocks.
    Without a delimiter, the paragraph is the block. Callouts at the ends of lines are left out.
    """
    lines = lines_of(text)
    at = 0
    while at < len(lines):
        fence, style = _FENCE.fullmatch(text, *lines[at]), _SOURCE.fullmatch(text, *lines[at])
        at += 1
        if fence is None and style is None:
            continue
        mark, name = (
            (fence[1], fence[2])
            if fence is not None
            else ("", style[1] if style is not None else "")
        )
        while not mark and at < len(lines) and _TITLE.fullmatch(text, *lines[at]):
            at += 1
        delimiter = _DELIMITER.fullmatch(text, *lines[at]) if not mark and at < len(lines) else None
        if delimiter is not None:
            mark = delimiter[1]
            at += 1
        first = at
        while at < len(lines) and (
            text[slice(*lines[at])].rstrip() != mark if mark else text[slice(*lines[at])].strip()
        ):
            at += 1
        language = NAMES.get(name.lower())
        if language is not None:
            yield Block(language, tuple(_without_callouts(text, line) for line in lines[first:at]))
        at += bool(mark)


def _without_callouts(text: str, line: Line) -> Line:
    callouts = (
        _CALLOUTS.search(text[slice(*line)]) if text.endswith((">", " ", "\t"), *line) else None
    )
    return line if callouts is None else (line[0], line[0] + callouts.start())


def restructured(text: str) -> Iterator[Block]:
    """Yields the blocks of the directives `code-block`, `code`, and `sourcecode`: the lines after
    it that are indented more.
    """
    lines = lines_of(text)
    at = 0
    while at < len(lines):
        directive = _DIRECTIVE.fullmatch(text, *lines[at])
        at += 1
        if directive is None:
            continue
        while at < len(lines) and _OPTION.fullmatch(text, *lines[at]):
            at += 1
        margin, first = len(directive[1]), at
        while at < len(lines) and (
            not text[slice(*lines[at])].strip() or _indentation(text, lines[at]) > margin
        ):
            at += 1
        language = NAMES.get(directive[2].lower())
        if language is not None:
            yield Block(language, tuple(lines[first:at]))


def _indentation(text: str, line: Line) -> int:
    start, end = line
    return end - start - len(text[start:end].lstrip(" \t"))


BLOCKS: dict[str, Callable[[str], Iterator[Block]]] = {"asciidoc": asciidoc, "rst": restructured}
"""What yields the blocks of a page, by its format."""

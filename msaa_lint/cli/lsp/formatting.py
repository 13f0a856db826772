"""The layout of YAML and JSON as ryl writes it: edits of whitespace alone, with which the text
reads the same and has the same comments.
"""

import os
import re
import subprocess
from collections import deque
from collections.abc import Iterator, Sequence
from functools import cache
from importlib.metadata import PackageNotFoundError, distribution
from typing import NamedTuple

from msaa_lint.core.text.edits import apply
from msaa_lint.core.text.events import ERRORS
from msaa_lint.core.text.node import Stop
from msaa_lint.core.text.reformatting import brackets_of, content_of
from msaa_lint.core.text.span import Edit, Span

MAX_SECONDS = 10
"""For a text of 1 MB ryl takes 0.1 seconds."""

MAX_LENGTH = 1 << 20
"""Characters of a text; what ryl is given may be 200 times as long."""

_STYLE = """\
indent-width = 2
[format]
comment-spacing = 2
comment-starting-space = "preserve"
line-ending = "auto"
max-blank-lines = 1
quote-style = "preserve"
"""

_DEEP = " " * 200
"""What ryl is given before the lines in brackets in a block, which move with the one on which the
brackets begin.

ryl indents some of them too little, and rejects a text where they are so. YAML 1.2 does, too, but
not libyaml.
"""

_GAP = re.compile(r"[ \t\r\n,]+")


class Layout(NamedTuple):
    """The edits that format a text, in order, and what could not be formatted."""

    edits: list[Edit]
    problems: list[str]


@cache
def ryl() -> str | None:
    """The path of the program of the package ryl, wherever the search path leads; None if it is not
    installed.
    """
    try:
        files = distribution("ryl").files or ()
    except PackageNotFoundError:
        return None
    paths = (
        os.path.normpath(file.locate())
        for file in files
        if file.stem == "ryl" and file.parent.name in ("bin", "Scripts")
    )
    return next(filter(os.path.isfile, paths), None)


def layout(text: str, within: Span | None = None) -> Layout:
    """The layout of a text, or of a part of it. A text with a syntax error has no edits, and no
    problems, as its findings state them.
    """
    program = ryl()
    if program is None:
        return Layout([], ["the package ryl is not installed"])
    if len(text) > MAX_LENGTH:
        return Layout([], [f"the text is longer than {MAX_LENGTH:,} characters"])
    try:
        brackets = brackets_of(text)
    except (Stop, *ERRORS):
        return Layout([], [])
    given = apply(
        text, [Edit(span, text[slice(*span)].replace("\n", "\n" + _DEEP)) for span in brackets]
    )
    command = [program, "format", "--no-cache", "--config-data", _STYLE, "-"]
    try:
        done = subprocess.run(
            command, input=given.encode(), capture_output=True, timeout=MAX_SECONDS, check=True
        )
        after = done.stdout.decode()
    except (OSError, UnicodeError, subprocess.SubprocessError) as error:
        return Layout([], [f"ryl has failed: {type(error).__name__}"])
    if after == given and not done.stderr:
        return Layout([], [])
    try:
        before = content_of(text)
    except (Stop, *ERRORS):
        return Layout([], [])
    try:
        edits = [
            edit
            for edit in _edits(text, after, brackets)
            if within is None or (within.start <= edit.span.start and edit.span.end <= within.end)
        ]
        if not edits or content_of(apply(text, edits)) == before:
            return Layout(
                edits,
                [
                    line.removeprefix("<stdin>:")
                    for line in done.stderr.decode("utf-8", "replace").splitlines()
                ],
            )
    except (Stop, *ERRORS):
        pass
    return Layout([], ["formatting would change what the text means"])


def _edits(before: str, after: str, brackets: Sequence[Span]) -> Iterator[Edit]:
    """The edits of the whitespace in which two texts differ. Trailing commas, which ryl removes,
    stay. So do spaces that align a comment.

    Raises ValueError if the texts differ in more.
    """
    if _GAP.sub("", before) != _GAP.sub("", after):
        raise ValueError("more than whitespace differs")
    old, new = _gaps(before), _gaps(after)
    inside = deque(brackets)
    length = shift = 0
    for at in sorted(old.keys() | new.keys()):
        gap, other = old.get(at, ""), new.get(at, "")
        parts = other.split(",") if "," in other or "," not in gap else ["", other]
        for number, (blank, part) in enumerate(zip(gap.split(","), parts, strict=True)):
            start = at + length + (number > 0)
            length = start + len(blank) - at
            while inside and inside[0].end <= start:
                inside.popleft()
            if "\n" in blank and inside and inside[0].start < start:
                part = part.replace(_DEEP, "")
                part = part[: len(part) - _indent(part)] + " " * max(_indent(blank) + shift, 0)
            elif "\n" in blank or at == 0:
                shift = _indent(part) - _indent(blank)
            is_aligned = (
                before.startswith("#", at + length)
                and blank
                and part
                and not (blank + part).strip(" ")
            )
            if blank != part and not is_aligned:
                yield _shortest(start, blank, part)


def _indent(blank: str) -> int:
    """The length of the whitespace at the end of which a line begins."""
    return len(blank) - blank.rfind("\n") - 1


def _gaps(text: str) -> dict[int, str]:
    """The whitespace and commas of a text by the number of other characters before them."""
    found = {}
    length = 0
    for match in _GAP.finditer(text):
        found[match.start() - length] = match[0]
        length += len(match[0])
    return found


def _shortest(start: int, old: str, new: str) -> Edit:
    """An edit that leaves as much as possible of the whitespace at a place. A CRLF is replaced as a
    whole.
    """
    if "\r" in old + new:
        return Edit(Span(start, start + len(old)), new)
    same = _common(old, new)
    tail = _common(old[same:][::-1], new[same:][::-1])
    return Edit(Span(start + same, start + len(old) - tail), new[same : len(new) - tail])


def _common(one: str, other: str) -> int:
    """The number of characters with which both texts begin."""
    return next(
        (number for number, pair in enumerate(zip(one, other, strict=False)) if pair[0] != pair[1]),
        min(len(one), len(other)),
    )

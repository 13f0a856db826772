"""Source lines with underlined marks, in the style of rustc."""

from collections.abc import Sequence
from itertools import groupby
from operator import itemgetter
from typing import NamedTuple

from msaa_lint.core.text.source import Source

from .color import SECONDARY, paint
from .window import CUT, Window, line_end, window

MAX_MARKS = 30
"""Places of one finding that an excerpt shows."""

_MAX_BARS = 3
_MAX_LINES_BETWEEN = 4
_MIN_WIDTH = 30
_MAX_LINE = 4096

_Row = list[tuple[str, str]]
"""The pieces of a line, each with its style."""


class Mark(NamedTuple):
    """A place to underline, as half-open offsets, and its text, already escaped (may be empty)."""

    start: int
    end: int
    text: str
    style: str
    primary: bool


class _Arm(NamedTuple):
    """One end of a mark that spans several lines; `bar` is its column in the margin."""

    bar: int
    offset: int
    mark: Mark
    opens: bool


def excerpt(
    source: Source, marks: Sequence[Mark], width: int, color: bool
) -> tuple[int, list[str]]:
    """The number of cells that line numbers take, and the lines with the `marks` (at least one).
    Without the texts of the marks, no line is wider than `width` cells (0: no limit).
    """
    digits, rows = excerpt_rows(source, marks, width)
    return digits, ["".join(paint(text, style, color) for text, style in row) for row in rows]


def excerpt_rows(source: Source, marks: Sequence[Mark], width: int) -> tuple[int, list[_Row]]:
    """`excerpt`, with the lines as pieces of text with their styles."""
    text = source.text
    singles: dict[int, list[Mark]] = {}
    arms: dict[int, list[_Arm]] = {}
    starts: dict[int, int] = {}
    bars = 0
    for mark in marks[:MAX_MARKS]:
        mark = mark._replace(
            start=max(0, min(mark.start, len(text))), end=max(0, min(mark.end, len(text)))
        )
        line, column = source.position(mark.start)
        last = max(mark.start, mark.end - 1)
        last_line, last_column = source.position(last)
        starts[line] = mark.start - column + 1
        if last_line == line or bars == _MAX_BARS:
            singles.setdefault(line, []).append(mark)
            continue
        starts[last_line] = last - last_column + 1
        _add_between(text, line, last_line, starts)
        arms.setdefault(line, []).append(_Arm(bars, mark.start, mark, True))
        arms.setdefault(last_line, []).append(_Arm(bars, last, mark, False))
        bars += 1
    digits = len(str(max(starts)))
    room = max(_MIN_WIDTH, width - digits - 3 - 2 * bars) if width else 0
    margin = [""] * bars
    rows: list[_Row] = [_edge(digits, "", margin)]
    before = 0
    for line in sorted(starts):
        if any(margin) and line > before + 1:
            rows.append([(f"{CUT:<{digits + 3}}", SECONDARY), *_bars(margin)])
        before = line
        rows += _line(
            text,
            line,
            starts[line],
            singles.get(line, []),
            arms.get(line, []),
            digits,
            margin,
            room,
        )
    return digits, list(map(_joined, rows))


def _add_between(text: str, first: int, last: int, starts: dict[int, int]) -> None:
    """Adds the lines between the ends of a mark; none if there are many, or one is very long."""
    if last - first - 1 > _MAX_LINES_BETWEEN:
        return
    offset = starts[first]
    for number in range(first + 1, last):
        end = line_end(text, offset, _MAX_LINE)
        if end is None:
            return
        offset = end + (2 if text.startswith("\r\n", end) else 1)
        starts[number] = offset


def _line(
    text: str,
    number: int,
    start: int,
    marks: list[Mark],
    arms: list[_Arm],
    digits: int,
    margin: list[str],
    room: int,
) -> list[_Row]:
    """One source line with its marks, repeated if one window cannot hold them all. Opens and closes
    the bars of `margin`.
    """
    rows = []
    while True:
        view = window(
            text,
            start,
            min([mark.start for mark in marks] + [arm.offset for arm in arms], default=start),
            room,
        )
        inside = [mark for mark in marks if view.shows(mark.start)]
        here = [arm for arm in arms if view.shows(arm.offset)]
        # A mark that begins with the line opens its bar next to it.
        simple = [arm for arm in here if arm.opens and _begins_line(text, start, arm.offset)]
        bars = _bars(margin)
        for arm in simple:
            bars[2 * arm.bar] = ("/", arm.mark.style)
            margin[arm.bar] = arm.mark.style
        rows.append([*_edge(digits, str(number)), *bars, (view.text, "")])
        rows += (
            [[*_edge(digits, "", margin), *row] for row in _underlines(view, inside)]
            if inside
            else []
        )
        for arm in sorted(here, key=lambda arm: (not arm.opens, arm.offset)):
            if arm not in simple:
                rows.append([*_edge(digits, "", margin[: arm.bar]), *_arm(arm, view, len(margin))])
                margin[arm.bar] = arm.mark.style if arm.opens else ""
        marks = [mark for mark in marks if mark not in inside]
        arms = [arm for arm in arms if arm not in here]
        if not marks and not arms:
            return rows


def _underlines(view: Window, marks: list[Mark]) -> list[_Row]:
    """The row of `^` and `-` with the text of the rightmost mark, then a row for each other text,
    under its mark.
    """
    places = []
    for mark in marks:
        start = view.cell(mark.start)
        end = view.cell(mark.end) + (len(CUT) if view.cut and mark.end > view.end else 0)
        places.append((start, max(end, start + 1), mark))
    row: _Row = [(" ", "")] * max(end for _, end, _ in places)
    # Of two marks on one cell, the shorter is drawn over the longer, which would hide it.
    for start, end, mark in sorted(
        places, key=lambda place: (place[0] - place[1], place[2].primary)
    ):
        row[start:end] = [("^" if mark.primary else "-", mark.style)] * (end - start)
    inline = max(places, key=lambda place: (place[1], place[0], place[2].text))
    if inline[2].text:
        row = [*row, (" " + inline[2].text, inline[2].style)]
    below = sorted(
        (place for place in places if place is not inline and place[2].text),
        key=lambda place: (place[0], place[1]),
    )
    rows = [row]
    if below:
        rows.append(_connectors(below))
    while below:
        start, _, mark = below.pop()
        left = _connectors([place for place in below if place[0] < start])
        rows.append([*left, (" " * (start - len(left)), ""), (mark.text, mark.style)])
    return rows


def _connectors(places: list[tuple[int, int, Mark]]) -> _Row:
    row: _Row = [(" ", "")] * (max((start for start, _, _ in places), default=-1) + 1)
    for start, _, mark in places:
        row[start] = ("|", mark.style)
    return row


def _arm(arm: _Arm, view: Window, bars: int) -> _Row:
    """From the bar in the margin to the first or last character of the mark."""
    reach = 2 * (bars - arm.bar) - 1 + view.cell(arm.offset)
    text = "" if arm.opens or not arm.mark.text else " " + arm.mark.text
    return [
        (
            (" " if arm.opens else "|") + "_" * reach + ("^" if arm.mark.primary else "-") + text,
            arm.mark.style,
        )
    ]


def _begins_line(text: str, start: int, offset: int) -> bool:
    return offset - start < _MIN_WIDTH and not text[start:offset].strip(" -")


def _edge(digits: int, number: str = "", margin: Sequence[str] = ()) -> _Row:
    return [(f"{number:>{digits}} |", SECONDARY), (" ", ""), *_bars(margin)]


def _bars(margin: Sequence[str]) -> _Row:
    return [piece for style in margin for piece in (("|" if style else " ", style), (" ", ""))]


def _joined(row: _Row) -> _Row:
    """The row with neighbors of one style as one piece, without spaces at its end."""
    while row and not row[-1][0].rstrip():
        row = row[:-1]
    row[-1] = (row[-1][0].rstrip(), row[-1][1])
    return [
        ("".join(piece for piece, _ in pieces), style)
        for style, pieces in groupby(row, key=itemgetter(1))
    ]

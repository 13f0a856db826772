"""Tables of the text reports, laid out for the width of the output. A figure is never broken, and
nothing is cut.
"""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from typing import NamedTuple

from rich.cells import cell_len
from rich.console import Console
from rich.table import Table as RichTable
from rich.text import Text

from . import Options, Write
from .escape import escape_commands

FIGURE, TEXT, SHORT, NAME = "figure", "text", "short", "name"
MIN_NAME_WIDTH = 12
GOOD_WIDTHS = {TEXT: 24, SHORT: 14, NAME: 60}
"""Cells in which a longer text or name is readable in several lines."""

_UNLIMITED = 10_000


class Column(NamedTuple):
    """A column: its heading, and what its cells hold. Figures are on the right and never broken,
    texts and short ones are broken between words, and names anywhere.
    """

    title: str
    kind: str = TEXT


class Table(NamedTuple):
    """The columns of a table, its rows with their styles, and the number of spaces between
    columns.
    """

    columns: Sequence[Column]
    rows: Sequence[tuple[str, Sequence[Text]]]
    gap: int = 2


def print_tables(out: Write, options: Options, *layouts: Sequence[Table]) -> int:
    """Prints the tables of the first layout that fits with long texts and names broken, else those
    of the last one; returns its place.
    """
    width = options.width or _UNLIMITED
    fitting = (
        place
        for place, layout in enumerate(layouts)
        if all(_total(table, _good_widths(table)) <= width for table in layout)
    )
    chosen = next(fitting, len(layouts) - 1)
    for number, table in enumerate(layouts[chosen]):
        out(("\n" if number else "") + _rendered(table, width, options.color))
    return chosen


def _rendered(table: Table, width: int, color: bool) -> str:
    widths = _shrunk(table, width)
    titled = any(column.title for column in table.columns)
    layout = RichTable(
        box=None,
        pad_edge=False,
        padding=(0, table.gap, 0, 0),
        show_header=titled,
        header_style="underline",
    )
    for column, cells in zip(table.columns, widths, strict=True):
        is_figure = column.kind == FIGURE
        layout.add_column(
            column.title,
            justify="right" if is_figure else "left",
            no_wrap=is_figure,
            overflow="fold",
            width=cells,
        )
    for style, texts in table.rows:
        layout.add_row(*texts, style=style)
    buffer = io.StringIO()
    Console(
        file=buffer, width=_total(table, widths), color_system="standard" if color else None,
        force_terminal=color, no_color=not color,
        markup=False, highlight=False, emoji=False, legacy_windows=False, _environ={},
    ).print(layout)  # fmt: skip
    return escape_commands(
        re.sub(
            r"(?m)(?:\x1b\[[0-9;]*m| )+$", lambda end: end[0].replace(" ", ""), buffer.getvalue()
        )
    )


def _shrunk(table: Table, width: int) -> list[int]:
    """The widths of the columns in a table of a width, which only the least width of its columns
    can exceed.
    """
    widths, least = _widths(table), _least_widths(table)
    while _total(table, widths) > width:
        widest = max(
            range(len(widths)),
            key=lambda number: widths[number] if widths[number] > least[number] else 0,
        )
        if widths[widest] <= least[widest]:
            break
        widths[widest] -= 1
    return widths


def _total(table: Table, widths: Sequence[int]) -> int:
    return sum(widths) + table.gap * (len(widths) - 1)


def _widths(table: Table) -> list[int]:
    """The widths of the columns if nothing is broken."""
    return [
        max(cell_len(line) for text in texts for line in text.split("\n"))
        for texts in _columns(table)
    ]


def _good_widths(table: Table) -> list[int]:
    """The widths of the columns if only long texts and names are broken."""
    widths = zip(table.columns, _widths(table), _least_widths(table), strict=True)
    return [
        min(width, max(least, GOOD_WIDTHS.get(column.kind, width)))
        for column, width, least in widths
    ]


def _least_widths(table: Table) -> list[int]:
    """The widths of the longest parts that are not broken."""
    least = []
    for column, texts, width in zip(table.columns, _columns(table), _widths(table), strict=True):
        if column.kind == FIGURE:
            least.append(width)
        else:
            words = (column.title if column.kind == NAME else " ".join(texts)).split()
            least.append(
                min(
                    width,
                    max([MIN_NAME_WIDTH if column.kind == NAME else 1, *map(cell_len, words)]),
                )
            )
    return least


def _columns(table: Table) -> list[list[str]]:
    """The texts of each column, with its heading."""
    return [
        [column.title, *(texts[number].plain for _, texts in table.rows)]
        for number, column in enumerate(table.columns)
    ]

"""The tables of `msaa-lint cost`, for a terminal or a pipe."""

from __future__ import annotations

import io
from collections.abc import Sequence

from rich.console import Console
from rich.measure import Measurement
from rich.table import Table as RichTable
from rich.text import Text

from msaa_lint.core.finding import Result
from msaa_lint.frame.cost.input_cost import CostComparison, CostedFrame

from . import Options, Write, cost_rows
from .cost_rows import Row, Table, frame_name
from .escape import clip, display, escape
from .paths import display_path

MAX_NAME = 60
"""Code points of a name in a table; JSON has all of it."""

MAX_ROWS = 1000
"""Rows of a table: nobody reads more, and laying one out takes a millisecond."""

MIN_NAME_WIDTH = 12
_UNLIMITED = 10_000
_STYLES = {cost_rows.PASS: "bold", cost_rows.LINE: "", cost_rows.TOTAL: "bold"}


def render(frames: Sequence[CostedFrame], errors: Result, out: Write, options: Options) -> None:
    """Prints the tables of each frame; for several frames, their totals as well. `errors` go to the standard error stream instead."""
    names = [frame_name(frame, options) for frame in frames]
    for number, (name, frame) in enumerate(zip(names, frames, strict=True)):
        out(("\n" if number else "") + f"{name}: {display(cost_rows.head(frame.cost))}\n")
        for table in cost_rows.frame_tables(frame):
            _print_table(table, out, options)
        if not options.quiet:
            _print_remarks([*cost_rows.details(frame.cost), *cost_rows.remarks(frame.cost)], out)
    if len(frames) > 1:
        _print_table(cost_rows.totals(frames, names), out, options)


def render_comparison(compared: CostComparison, errors: Result, out: Write, options: Options) -> None:
    """Prints what the new input costs more than the old one, for passes that differ, and in total."""
    for number, comparison in enumerate(compared.frames):
        document = f", document {number + 1}" if len(compared.frames) > 1 else ""
        names = " -> ".join(display_path(file, options.root) for file in (compared.old_file, compared.new_file)) + document
        out(("\n" if number else "") + f"{names}\n{cost_rows.sentence(comparison, cost_rows.budget_of(compared))}\n")
        _print_table(cost_rows.changes(comparison), out, options)
        if not options.quiet:
            _print_remarks(cost_rows.comparison_remarks(compared, number), out)


def _print_remarks(remarks: Sequence[tuple[str, str]], out: Write) -> None:
    if remarks:
        out("\n" + "".join(f"{word}: {display(text)}\n" for word, text in remarks))


def _print_table(table: Table, out: Write, options: Options) -> None:
    """Prints a table after an empty line, as wide as its contents; on a terminal, as narrow as its figures allow."""
    if not table.rows:
        return
    table = table._replace(rows=_limited(table.rows))
    width = options.width or _UNLIMITED
    buffer = io.StringIO()
    console = Console(
        file=buffer, width=_UNLIMITED, color_system="standard" if options.color else None, force_terminal=options.color,
        no_color=not options.color, markup=False, highlight=False, emoji=False, legacy_windows=False, _environ={},
    )  # fmt: skip
    layout = _layout(table, False)
    if Measurement.get(console, console.options, layout).maximum > width:
        layout = _layout(table, True)
    console.width = max(width, Measurement.get(console, console.options, layout).minimum)
    console.print(layout)
    lines = buffer.getvalue().split("\n")
    out("\n" + "\n".join(line if options.color else line.rstrip(" ") for line in lines))


def _limited(rows: list[Row]) -> list[Row]:
    """The first rows, the totals, and between them the number of rows that are left out."""
    if len(rows) <= MAX_ROWS:
        return rows
    totals = [row for row in rows[MAX_ROWS:] if row.kind == cost_rows.TOTAL]
    text = f"and {len(rows) - MAX_ROWS - len(totals)} more rows (--output json has all)"
    rest = Row(cost_rows.PASS, (text, *("" for _ in rows[0].texts[1:])), tuple("" for _ in rows[0].figures))
    return [*rows[:MAX_ROWS], rest, *totals]


def _layout(table: Table, narrow: bool) -> RichTable:
    layout = RichTable(box=None, pad_edge=False, padding=(0, 1 if narrow else 2, 0, 0), header_style="underline")
    for title in table.texts[:1] if narrow else table.texts:
        layout.add_column(title, overflow="fold", no_wrap=not narrow, min_width=MIN_NAME_WIDTH if narrow else None, vertical="bottom")
    for title in table.figures:
        layout.add_column(title.replace(" ", "\n") if narrow else title, justify="right", no_wrap=True, vertical="bottom")
    indent = "  " if any(row.kind == cost_rows.PASS for row in table.rows) else ""
    for row in table.rows:
        # CI runners obey lines that begin with `::`, wherever the table breaks a name.
        cells = [clip(escape(text), MAX_NAME).replace("::", ":\\x3a") for text in row.texts]
        if row.kind == cost_rows.LINE:
            cells[0] = indent + cells[0]
        if narrow:
            cells = [" ".join(cell for cell in cells if cell)]
        layout.add_row(*(Text(cell) for cell in (*cells, *row.figures)), style=_STYLES[row.kind])
    return layout

"""The tables of `msaa-lint cost`, for a terminal or a pipe."""

from __future__ import annotations

from collections.abc import Sequence

from rich.text import Text

from msaa_lint.core.finding import Result
from msaa_lint.frame.cost.input_cost import CostComparison, CostedFrame

from . import Options, Write, cost_rows
from .cost_rows import Table, frame_name
from .escape import clip, display, escape
from .paths import display_path
from .tables import FIGURE, NAME, Column, print_tables
from .tables import Table as TextTable

MAX_NAME = 240
"""Code points of a name in a table; JSON has all of it."""

_STYLES = {cost_rows.PASS: "bold", cost_rows.LINE: "", cost_rows.TOTAL: "bold"}


def render(frames: Sequence[CostedFrame], errors: Result, out: Write, options: Options) -> None:
    """Prints the tables of each frame; for several frames, their totals as well. `errors` go to the
    standard error stream instead.
    """
    names = [frame_name(frame, options) for frame in frames]
    for number, (name, frame) in enumerate(zip(names, frames, strict=True)):
        out(("\n" if number else "") + f"{name}: {display(cost_rows.head(frame.cost))}\n")
        for table in cost_rows.frame_tables(frame):
            print_table(table, out, options)
        if not options.quiet:
            _print_remarks([*cost_rows.details(frame.cost), *cost_rows.remarks(frame.cost)], out)
    if len(frames) > 1:
        print_table(cost_rows.totals(frames, names), out, options)


def render_comparison(
    compared: CostComparison, errors: Result, out: Write, options: Options
) -> None:
    """Prints what the new input costs more than the old one, for passes that differ, and in
    total.
    """
    for number, comparison in enumerate(compared.frames):
        document = f", document {number + 1}" if len(compared.frames) > 1 else ""
        names = (
            " -> ".join(
                display_path(file, options.root) for file in (compared.old_file, compared.new_file)
            )
            + document
        )
        out(
            ("\n" if number else "")
            + f"{names}\n{cost_rows.sentence(comparison, cost_rows.budget_of(compared))}\n"
        )
        print_table(cost_rows.changes(comparison), out, options)
        if not options.quiet:
            _print_remarks(cost_rows.comparison_remarks(compared, number), out)


def _print_remarks(remarks: Sequence[tuple[str, str]], out: Write) -> None:
    if remarks:
        out("\n" + "".join(f"{word}: {display(text)}\n" for word, text in remarks))


def print_table(table: Table, out: Write, options: Options) -> None:
    """Prints a table after an empty line. Where it is too wide, its texts share a column and its
    headings take several lines.
    """
    if table.rows:
        table = cost_rows.limited(table)
        out("\n")
        print_tables(out, options, [_layout(table, False)], [_layout(table, True)])


def _layout(table: Table, narrow: bool) -> TextTable:
    titles = table.texts[:1] if narrow else table.texts
    columns = [Column(title, NAME) for title in titles]
    columns += [
        Column(title.replace(" ", "\n") if narrow else title, FIGURE) for title in table.figures
    ]
    indent = "  " if any(row.kind == cost_rows.PASS for row in table.rows) else ""
    rows = []
    for row in table.rows:
        texts = [clip(escape(text), MAX_NAME) for text in row.texts]
        if row.kind == cost_rows.LINE:
            texts[0] = indent + texts[0]
        if narrow:
            texts = [" ".join(filter(None, texts))]
        figures = [figure.replace(" ", "") for figure in row.figures] if narrow else row.figures
        rows.append((_STYLES[row.kind], [Text(text) for text in (*texts, *map(_broken, figures))]))
    return TextTable(columns, rows, 1 if narrow else 2)


def _broken(figure: str) -> str:
    """A figure; a range of large ones, which have no decimals, takes two lines."""
    return figure if "." in figure else figure.replace("–", "–\n")

"""The tables of `msaa-lint cost`, for a terminal or a pipe."""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from . import cost_rows
from .escape import clip, shown, visible
from .paths import shown_path

if TYPE_CHECKING:
    from rich.table import Table

    from msaa_lint.frame.cost.input_cost import Compared, Costed

    from . import Options, Write

LONGEST_NAME = 60
"""Code points of a name in a table; JSON has the rest."""

MOST_ROWS = 1000
"""Of a table: more nobody reads, and laying one out takes a millisecond."""

NARROWEST_NAME = 12
_UNCUT = 10_000
_STYLES = {cost_rows.PASS: "bold", cost_rows.LINE: "", cost_rows.TOTAL: "bold"}


def render(frames: Sequence[Costed], out: Write, options: Options) -> None:
    """Prints for each frame what its passes cost, what its images take, and what it would cost otherwise; of several the totals."""
    for number, each in enumerate(frames):
        out(("\n" if number else "") + f"{where(each, options)}: {shown(cost_rows.head(each.cost))}\n")
        _table(cost_rows.COLUMNS, cost_rows.FIGURES, cost_rows.rows(each.cost), out, options)
        _table(("the frame",), cost_rows.FIGURES, cost_rows.options_of(each), out, options)
        _table(("image", ""), ("in full MiB", "committed MiB"), cost_rows.images(each.cost), out, options)
        _remarks([*cost_rows.details(each.cost), *cost_rows.remarks(each.cost)], out)
    if len(frames) > 1:
        _table(("frame",), cost_rows.FIGURES, totals(frames, options), out, options)


def render_comparison(found: Compared, out: Write, options: Options) -> None:
    """Prints what the new input costs more than the old, by passes that cost something else, and in total."""
    for number, each in enumerate(found.frames):
        which = f", document {number + 1}" if len(found.frames) > 1 else ""
        names = f"{shown_path(found.old_file, options.root)} -> {shown_path(found.new_file, options.root)}{which}"
        out(("\n" if number else "") + f"{names}\n{cost_rows.sentence(each, cost_rows.budget_of(found))}\n")
        _table(("pass", "change"), cost_rows.CHANGES, cost_rows.changes(each), out, options)
        _remarks(cost_rows.remarks_on(found, number), out)


def where(each: Costed, options: Options) -> str:
    """A frame's input, and which of its documents it is."""
    return shown_path(each.file, options.root) + (f", document {each.number + 1}" if each.documents > 1 else "")


def totals(frames: Sequence[Costed], options: Options) -> Iterable[cost_rows.Row]:
    """The total of each frame, under its name."""
    for each in frames:
        *_, last = cost_rows.rows(each.cost)
        yield cost_rows.Row(cost_rows.LINE, (where(each, options),), last.figures)


def _remarks(told: Sequence[tuple[str, str]], out: Write) -> None:
    if told:
        out("\n" + "".join(f"{word}: {shown(text)}\n" for word, text in told))


def _table(texts: Sequence[str], figures: Sequence[str], found: Iterable[cost_rows.Row], out: Write, options: Options) -> None:
    """A table as wide as what it holds, after an empty line; narrower on a terminal that is, as far as its figures allow."""
    from rich.console import Console
    from rich.measure import Measurement

    made = _few([*found])
    if not made:
        return
    width = options.width or _UNCUT
    buffer = io.StringIO()
    console = Console(
        file=buffer, width=_UNCUT, color_system="standard" if options.color else None, force_terminal=options.color,
        no_color=not options.color, markup=False, highlight=False, emoji=False, legacy_windows=False, _environ={},
    )  # fmt: skip
    table = _laid(texts, figures, made, False)
    if Measurement.get(console, console.options, table).maximum > width:
        table = _laid(texts, figures, made, True)
    least = Measurement.get(console, console.options, table).minimum
    console.width = max(width, least)
    console.print(table)
    lines = buffer.getvalue().split("\n")
    out("\n" + "\n".join(line if options.color else line.rstrip(" ") for line in lines))


def _few(found: list[cost_rows.Row]) -> list[cost_rows.Row]:
    """The rows that a table shows: the first, the totals, and how many there are between."""
    if len(found) <= MOST_ROWS:
        return found
    totals = [row for row in found[MOST_ROWS:] if row.kind == cost_rows.TOTAL]
    left = len(found) - MOST_ROWS - len(totals)
    said = f"and {left} more, which --output json has"
    rest = cost_rows.Row(cost_rows.PASS, (said, *("" for _ in found[0].texts[1:])), tuple("" for _ in found[0].figures))
    return [*found[:MOST_ROWS], rest, *totals]


def _laid(texts: Sequence[str], figures: Sequence[str], found: Sequence[cost_rows.Row], narrow: bool) -> Table:
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, padding=(0, 1 if narrow else 2, 0, 0), header_style="underline")
    for title in texts[:1] if narrow else texts:
        table.add_column(title, overflow="fold", no_wrap=not narrow, min_width=NARROWEST_NAME if narrow else None, vertical="bottom")
    for title in figures:
        table.add_column(title.replace(" ", "\n") if narrow else title, justify="right", no_wrap=True, vertical="bottom")
    indent = "  " if any(row.kind == cost_rows.PASS for row in found) else ""
    for row in found:
        # A CI runner takes a line that begins with `::` as an order, wherever the table breaks a name.
        cells = [clip(visible(text), LONGEST_NAME).replace("::", ":\\x3a") for text in row.texts]
        if row.kind == cost_rows.LINE:
            cells[0] = indent + cells[0]
        if narrow:
            cells = [" ".join(cell for cell in cells if cell)]
        table.add_row(*(Text(cell) for cell in (*cells, *row.figures)), style=_STYLES[row.kind])
    return table

"""The answers of `msaa-lint corpus`, for a terminal or a pipe."""

from __future__ import annotations

from rich.text import Text

from msaa_lint.linter.corpus.database import Rows
from msaa_lint.linter.corpus.summary import Summary

from . import Options, Write
from .corpus_tables import heads, query_table, remarks, since_line, tables
from .cost_full import MAX_NAME, print_table
from .escape import clip, display, escape_commands
from .tables import FIGURE, NAME, Column, print_tables
from .tables import Table as TextTable


def render(summary: Summary, out: Write, options: Options) -> None:
    """Prints the runs, the tables, and what to know of them."""
    for line in heads(summary):
        out(escape_commands(display(line)) + "\n")
    if summary.since is not None:
        out(escape_commands(display(since_line(summary.since))) + "\n")
    if not summary.groups:
        out("No findings\n")
    for caption, table in tables(summary):
        out(f"\n{caption}\n")
        print_table(table, out, options)
    if not options.quiet:
        noted = remarks(summary)
        out(("\n" if noted else "") + "".join(f"{word}: {display(text)}\n" for word, text in noted))


def render_query(result: Rows, out: Write, options: Options) -> None:
    """Prints the rows of a query."""
    table = query_table(result)
    if not table.rows:
        out("No rows\n")
        return
    columns = [Column(title, NAME) for title in table.texts] + [
        Column(title, FIGURE) for title in table.figures
    ]
    rows = [
        ("", [Text(clip(cell, MAX_NAME)) for cell in (*row.texts, *row.figures)])
        for row in table.rows
    ]
    print_tables(out, options, [TextTable(columns, rows)], [TextTable(columns, rows, 1)])

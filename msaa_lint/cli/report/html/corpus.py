"""The page of `msaa-lint corpus`."""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.linter.corpus.database import Rows
from msaa_lint.linter.corpus.summary import Summary

from .. import Options, Write
from ..corpus_tables import Captioned, heads, query_table, remarks, since_line, tables
from ..cost_rows import limited
from ..words import plural
from .page import write_page


def render(summary: Summary, out: Write, options: Options) -> None:
    """Writes the runs, the tables, and what to know of them."""
    lines = [*heads(summary), *([since_line(summary.since)] if summary.since is not None else [])]
    noted = [] if options.quiet else remarks(summary)
    title = f"Findings of {plural(sum(run.inputs for run in summary.runs), 'input')}"
    _write(title, lines, tables(summary), noted, "No findings", out)


def render_query(result: Rows, out: Write, options: Options) -> None:
    """Writes the rows of a query."""
    table = query_table(result)
    _write(
        "Rows of a corpus",
        [],
        [("The rows of the query", table)] if table.rows else [],
        [],
        "No rows",
        out,
    )


def _write(
    title: str,
    lines: Sequence[str],
    captioned: Sequence[Captioned],
    noted: Sequence[tuple[str, str]],
    nothing: str,
    out: Write,
) -> None:
    sections = [(caption, limited(table)) for caption, table in captioned]
    write_page(
        "corpus.html",
        {
            "title": title,
            "lines": lines,
            "sections": sections,
            "remarks": noted,
            "nothing": nothing,
        },
        out,
    )

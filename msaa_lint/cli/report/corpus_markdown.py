"""The answers of `msaa-lint corpus` as Markdown, for a page or a comment on a pull request."""

from __future__ import annotations

from msaa_lint.linter.corpus.database import Rows
from msaa_lint.linter.corpus.summary import Summary

from . import Options, Write
from .corpus_tables import heads, query_table, remarks, since_line, tables
from .cost_markdown import Comment
from .escape import display
from .markdown import escape_markdown

HEAD = "<!-- msaa-lint corpus -->\n"
"""By which a program finds its own comment again."""


def render(summary: Summary, out: Write, options: Options) -> None:
    """Prints the runs, the tables, and what to know of them, as far as one comment can hold
    them.
    """
    comment = Comment(out)
    comment.add(f"{HEAD}### Findings of a corpus\n")
    for line in [
        *heads(summary),
        *([since_line(summary.since)] if summary.since is not None else []),
    ]:
        comment.add(f"\n{escape_markdown(display(line))}\n")
    if not summary.groups:
        comment.add("\nNo findings\n")
    for caption, table in tables(summary):
        comment.add(f"\n#### {caption}\n")
        comment.table(table)
    comment.remarks([] if options.quiet else remarks(summary))
    comment.close()


def render_query(result: Rows, out: Write, options: Options) -> None:
    """Prints the rows of a query, as far as one comment can hold them."""
    comment = Comment(out)
    comment.add(HEAD)
    table = query_table(result)
    comment.table(table)
    if not table.rows:
        comment.add("\nNo rows\n")
    comment.close()

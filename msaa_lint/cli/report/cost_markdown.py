"""The tables of `msaa-lint cost` as Markdown, for a page or a comment on a pull request."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msaa_lint.core.finding import Result
from msaa_lint.frame.cost.input_cost import CostComparison, CostedFrame

from . import Options, Write, cost_rows
from .concise import line
from .cost_rows import Table, frame_name
from .escape import display
from .markdown import MAX_COMMENT, escape_markdown
from .paths import display_path

HEAD = "<!-- msaa-lint cost -->\n"
"""By which a program finds its own comment again."""


class Comment:
    """The text, as far as one comment can hold it."""

    def __init__(self, out: Write) -> None:
        self._out = out
        self._room = MAX_COMMENT - 200
        self._missing = 0

    def add(self, text: str) -> None:
        """Writes a piece, or nothing if it does not fit."""
        if len(text) > self._room or self._missing:
            self._missing += 1
            return
        self._room -= len(text)
        self._out(text)

    def table(self, table: Table) -> None:
        """Writes a table if it has rows."""
        if not table.rows:
            return
        heads = [_cell(text) for text in (*table.texts, *table.figures)]
        self.add(
            f"\n| {' | '.join(heads)} |\n"
            f"|{' --- |' * len(table.texts)}{' ---: |' * len(table.figures)}\n"
        )
        for row in table.rows:
            cells = [*(_cell(text) for text in row.texts), *row.figures]
            if row.kind != cost_rows.LINE:
                cells = [f"**{cell}**" if cell else "" for cell in cells]
            self.add(f"| {' | '.join(cells)} |\n")

    def remarks(self, remarks: Iterable[tuple[str, str]]) -> None:
        """Writes remarks as a list."""
        lines = "".join(f"- {escape_markdown(word)}: {_cell(text)}\n" for word, text in remarks)
        if lines:
            self.add(f"\n{lines}")

    def close(self) -> None:
        """Says how much did not fit."""
        if self._missing:
            self._out(f"\n{self._missing} more lines and tables do not fit into this comment.\n")


def render(frames: Sequence[CostedFrame], errors: Result, out: Write, options: Options) -> None:
    """Prints inputs that cannot be used, then the tables of each frame; for several frames, their
    totals first.
    """
    comment = Comment(out)
    comment.add(f"{HEAD}### Cost of the {'frame' if len(frames) == 1 else 'frames'}\n")
    comment.remarks([("error", line(finding, errors, options)) for finding in errors.findings])
    names = [frame_name(frame, options) for frame in frames]
    if len(frames) > 1:
        comment.table(cost_rows.totals(frames, names))
    for name, frame in zip(names, frames, strict=True):
        comment.add(f"\n#### {escape_markdown(name)}\n\n{_cell(cost_rows.head(frame.cost))}\n")
        for table in cost_rows.frame_tables(frame):
            comment.table(table)
        comment.remarks([*cost_rows.details(frame.cost), *cost_rows.remarks(frame.cost)])
    comment.close()


def render_comparison(
    compared: CostComparison, errors: Result, out: Write, options: Options
) -> None:
    """Prints what the new input costs more than the old one: the sum in a sentence, then the passes
    that differ.
    """
    comment = Comment(out)
    comment.add(f"{HEAD}### Cost of this change\n")
    comment.remarks([("error", line(finding, errors, options)) for finding in errors.findings])
    names = " → ".join(
        escape_markdown(display_path(file, options.root))
        for file in (compared.old_file, compared.new_file)
    )
    for number, comparison in enumerate(compared.frames):
        document = f", document {number + 1}" if len(compared.frames) > 1 else ""
        comment.add(
            f"\n{names}{document}\n\n"
            f"**{escape_markdown(cost_rows.sentence(comparison, cost_rows.budget_of(compared)))}.**\n"  # noqa: E501
        )
        comment.table(cost_rows.changes(comparison))
        comment.remarks(cost_rows.comparison_remarks(compared, number))
    comment.close()


def _cell(text: str) -> str:
    return escape_markdown(display(text))

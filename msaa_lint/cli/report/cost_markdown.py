"""The tables of `msaa-lint cost` as Markdown: for a page, or for a comment on a pull request."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from . import cost_rows
from .concise import line
from .cost_full import totals, where
from .escape import shown
from .markdown import LONGEST_COMMENT, literal
from .paths import shown_path

if TYPE_CHECKING:
    from msaa_lint.core.finding import Result
    from msaa_lint.frame.cost.input_cost import Compared, Costed

    from . import Options, Write

HEAD = "<!-- msaa-lint cost -->\n"
"""By which a program finds its own comment again."""


class _Comment:
    """What is written, as far as one comment holds it."""

    def __init__(self, out: Write) -> None:
        self._out = out
        self._left = LONGEST_COMMENT - 200
        self._missing = 0

    def add(self, text: str) -> None:
        """Writes a piece that stands alone, or none of it."""
        if len(text) > self._left or self._missing:
            self._missing += 1
            return
        self._left -= len(text)
        self._out(text)

    def table(self, texts: Sequence[str], figures: Sequence[str], found: Iterable[cost_rows.Row]) -> None:
        """Writes a table, if it has a row."""
        made = [*found]
        if not made:
            return
        heads = [_cell(text) for text in (*texts, *figures)]
        self.add(f"\n| {' | '.join(heads)} |\n|{' --- |' * len(texts)}{' ---: |' * len(figures)}\n")
        for row in made:
            cells = [*(_cell(text) for text in row.texts), *row.figures]
            if row.kind != cost_rows.LINE:
                cells = [f"**{cell}**" if cell else "" for cell in cells]
            self.add(f"| {' | '.join(cells)} |\n")

    def close(self) -> None:
        """Says how much did not fit."""
        if self._missing:
            self._out(f"\n{self._missing} more lines and tables do not fit here.\n")


def render(frames: Sequence[Costed], wrong: Result, out: Write, options: Options) -> None:
    """Prints what could not be used; for each frame what its passes cost and what it would cost otherwise; of several the totals first."""
    page = _Comment(out)
    page.add(f"{HEAD}### What the {'frame costs' if len(frames) == 1 else 'frames cost'}\n")
    _remarks(page, [("error", line(found, wrong, options)) for found in wrong.findings])
    if len(frames) > 1:
        page.table(("frame",), cost_rows.FIGURES, totals(frames, options))
    for each in frames:
        page.add(f"\n#### {literal(where(each, options))}\n\n{literal(shown(cost_rows.head(each.cost)))}\n")
        page.table(cost_rows.COLUMNS, cost_rows.FIGURES, cost_rows.rows(each.cost))
        page.table(("the frame",), cost_rows.FIGURES, cost_rows.options_of(each))
        page.table(("image", ""), ("in full MiB", "committed MiB"), cost_rows.images(each.cost))
        _remarks(page, [*cost_rows.details(each.cost), *cost_rows.remarks(each.cost)])
    page.close()


def render_comparison(found: Compared, out: Write, options: Options) -> None:
    """Prints what the new input costs more than the old: the sum in a sentence, then the passes that cost something else."""
    page = _Comment(out)
    page.add(f"{HEAD}### What this change costs\n")
    names = f"{literal(shown_path(found.old_file, options.root))} → {literal(shown_path(found.new_file, options.root))}"
    for number, each in enumerate(found.frames):
        which = f", document {number + 1}" if len(found.frames) > 1 else ""
        page.add(f"\n{names}{which}\n\n**{literal(cost_rows.sentence(each, cost_rows.budget_of(found)))}.**\n")
        page.table(("pass", "change"), cost_rows.CHANGES, cost_rows.changes(each))
        _remarks(page, cost_rows.remarks_on(found, number))
    page.close()


def _remarks(page: _Comment, told: Iterable[tuple[str, str]]) -> None:
    lines = "".join(f"- {literal(word)}: {literal(shown(text))}\n" for word, text in told)
    if lines:
        page.add(f"\n{lines}")


def _cell(text: str) -> str:
    return literal(shown(text))

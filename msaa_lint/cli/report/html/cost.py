"""The page of `msaa-lint cost`."""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.core.finding import Result
from msaa_lint.frame.cost.input_cost import CostComparison, CostedFrame

from .. import Options, Write, cost_rows
from ..concise import line
from ..paths import display_path
from .page import write_page


def render(frames: Sequence[CostedFrame], errors: Result, out: Write, options: Options) -> None:
    """Writes the costs of each frame."""
    names = [cost_rows.frame_name(frame, options) for frame in frames]
    title = f"Cost of {names[0]}" if len(frames) == 1 else f"Cost of {len(frames)} frames"
    sections = [
        {
            "name": name,
            "head": cost_rows.head(frame.cost),
            "tables": [table for table in cost_rows.frame_tables(frame) if table.rows],
            "remarks": [*cost_rows.details(frame.cost), *cost_rows.remarks(frame.cost)],
        }
        for name, frame in zip(names, frames, strict=True)
    ]
    context = {"title": title, "errors": _errors(errors, options), "sections": sections}
    write_page("cost.html", context, out)


def render_comparison(compared: CostComparison, errors: Result, out: Write, options: Options) -> None:
    """Writes what the new input costs more than the old one."""
    old, new = (display_path(file, options.root) for file in (compared.old_file, compared.new_file))
    sections = [
        {
            "name": f"Document {number + 1}" if len(compared.frames) > 1 else "The change",
            "head": cost_rows.sentence(comparison, cost_rows.budget_of(compared)),
            "tables": [cost_rows.changes(comparison)],
            "remarks": cost_rows.comparison_remarks(compared, number),
        }
        for number, comparison in enumerate(compared.frames)
    ]
    context = {"title": f"{old} → {new}", "errors": _errors(errors, options), "sections": sections}
    write_page("cost.html", context, out)


def _errors(errors: Result, options: Options) -> list[str]:
    return [line(finding, errors, options) for finding in errors.findings]

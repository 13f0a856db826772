"""The page of `msaa-lint cost`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from msaa_lint.core.finding import Result
from msaa_lint.frame.cost.amounts import FrameCost
from msaa_lint.frame.cost.compare import Change
from msaa_lint.frame.cost.input_cost import CostComparison, CostedFrame

from .. import Options, Write, cost_rows
from ..concise import line
from ..cost_rows import figure
from ..paths import display_path
from ..words import plural
from . import waterfall
from .frames import frame_section, graph_section
from .page import write_page

MAX_FRAMES = 50
"""Frames with a section."""


def render(frames: Sequence[CostedFrame], errors: Result, out: Write, options: Options) -> None:
    """Writes the costs of each frame, with its graph and waterfall; for several frames, their
    totals first.
    """
    names = [cost_rows.frame_name(frame, options) for frame in frames]
    shown = frames[:MAX_FRAMES]
    context = {
        "title": f"Cost of {names[0]}"
        if len(frames) == 1
        else f"Cost of {plural(len(frames), 'frame')}",
        "errors": _errors(errors, options),
        "totals": cost_rows.limited(cost_rows.totals(frames, names)) if len(frames) > 1 else None,
        "frames": [_section(frame, options) for frame in shown],
        "more_frames": len(frames) - len(shown),
    }
    write_page("cost.html", context, out)


def render_comparison(
    compared: CostComparison, errors: Result, out: Write, options: Options
) -> None:
    """Writes what the new input costs more than the old one, and both frames side by side."""
    old, new = (display_path(file, options.root) for file in (compared.old_file, compared.new_file))
    sides = [{frame.number: frame for frame in frames} for frames in (compared.old, compared.new)]
    titles = (f"Old: {old}", f"New: {new}")
    sections = []
    for number, comparison in enumerate(compared.frames[:MAX_FRAMES]):
        sections.append({
            "name": f"Document {number + 1}" if len(compared.frames) > 1 else "The change",
            "sentence": cost_rows.sentence(comparison, cost_rows.budget_of(compared)),
            "tiles": _change_tiles(comparison.total),
            "waterfall": [(bar, "") for bar in waterfall.of_comparison(comparison)],
            "changes": cost_rows.limited(cost_rows.changes(comparison)),
            "remarks": cost_rows.comparison_remarks(compared, number),
            "sides": [_side(side[number], name) for side, name in zip(sides, titles,
            strict=True) if number in side],
        })  # fmt: skip
    context = {
        "title": f"{old} → {new}",
        "errors": _errors(errors, options),
        "sections": sections,
        "more_sections": len(compared.frames) - len(sections),
    }
    write_page("comparison.html", context, out)


def _section(frame: CostedFrame, options: Options) -> dict[str, Any]:
    section = frame_section(frame, options)
    passes, states, images = map(cost_rows.limited, cost_rows.frame_tables(frame))
    tables = [
        ("What passes and attachments cost", passes),
        ("The frame otherwise", states),
        ("Memory of images", images),
    ]
    return {
        **section,
        "tiles": _tiles(frame.cost),
        "tables": [(caption, table) for caption, table in tables if table.rows],
    }


def _side(frame: CostedFrame, name: str) -> dict[str, Any]:
    """A frame of a comparison."""
    graph = (
        graph_section(frame.graph, frame.cost.fps, "as written")
        if frame.graph is not None and frame.graph.passes
        else None
    )
    table = cost_rows.limited(cost_rows.frame_tables(frame)[0])
    return {
        "name": name,
        "head": cost_rows.head(frame.cost),
        "tiles": _tiles(frame.cost),
        "graph": graph,
        "table": table,
    }


def _tiles(cost: FrameCost) -> list[tuple[str, str, str, str]]:
    """The total at a glance."""
    total = cost.total
    least = cost_rows.AT_LEAST if cost.unknown else ""
    share = cost.budget_share
    budget = (
        []
        if share is None
        else [(least + figure(100 * share, 1), "%", f"of {cost.budget_milliwatts:g} mW", "")]
    )
    return [
        (least + figure(total.read_mb_per_s, 0), "MB/s", "read from memory", "memory"),
        (least + figure(total.write_mb_per_s, 0), "MB/s", "written to memory", "memory"),
        (least + figure(total.memory_mib, 1), "MiB", "memory of images", ""),
        (least + figure(total.milliwatts, 0), "mW", "power of the traffic", ""),
        *budget,
    ]


def _change_tiles(change: Change) -> list[tuple[str, str, str, str]]:
    """The difference at a glance: red if it costs more, green if less."""
    difference = change.difference
    figures = (
        (difference.read_mb_per_s, 0, "MB/s", "read"),
        (difference.write_mb_per_s, 0, "MB/s", "written"),
        (difference.memory_mib, 1, "MiB", "memory"),
        (difference.milliwatts, 0, "mW", "power"),
    )
    return [
        (
            figure(value, digits, sign=True),
            unit,
            label,
            "memory" if value > 0 else "good" if value < 0 else "",
        )
        for value, digits, unit, label in figures
    ]


def _errors(errors: Result, options: Options) -> list[str]:
    return [line(finding, errors, options) for finding in errors.findings]

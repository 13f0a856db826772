"""The part of a page about a frame: its graph, and the waterfall of its cost."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice
from typing import Any

from msaa_lint.frame.cost.graph import FrameGraph
from msaa_lint.frame.cost.input_cost import CostedFrame

from .. import Options, cost_rows
from ..words import plural
from . import graph, waterfall


def frame_section(
    frame: CostedFrame, options: Options, anchors: Mapping[int, str] | None = None
) -> dict[str, Any]:
    """What `frame.html` shows of a frame. `anchors` has the fragment of each finding on the page,
    by its identity.
    """
    states = ((frame.graph, "as written"), (frame.fixed_graph, "as fixed"))
    graphs = [
        graph_section(each, frame.cost.fps, state)
        for each, state in states
        if each is not None and each.passes
    ]
    rows = waterfall.of_frame(frame)
    return {
        "name": cost_rows.frame_name(frame, options),
        "head": cost_rows.head(frame.cost),
        "graphs": graphs,
        "waterfall": [
            (bar, anchors.get(id(bar.finding), "") if anchors and bar.finding else "")
            for bar in rows
        ],
        "remarks": [*cost_rows.details(frame.cost), *cost_rows.remarks(frame.cost)],
    }


def graph_section(frame: FrameGraph, fps: float, state: str) -> dict[str, Any]:
    """A graph and the table that says the same."""
    count = sum(len(each.flows) for each in frame.passes)
    rows = list(islice(graph.flow_rows(frame), cost_rows.MAX_ROWS))
    left_out = (
        f"The table has {len(rows)} of {count} rows; --output json of `msaa-lint cost` has all."
        if count > len(rows)
        else ""
    )
    description = (
        f"{plural(len(frame.passes), 'pass')} and {plural(len(frame.images), 'image')}; "
        "the table below says the same in words"
    )
    return {
        "state": state,
        "drawing": graph.drawing(frame, fps),
        "rows": rows,
        "left_out": left_out,
        "description": description,
    }

"""The figure of a study whose points, front, and recommendation follow a slider for the cost of
shading.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.predictions import Prediction, predictions

from ..escape import display
from ..figure import Figure, title
from ..study_panels import Panel, panels
from ..study_plot import axes_of, chart_of, labels_of, layer_rows
from .vega import PageFigures, columns, data_names

WIDTH, HEIGHT, REACH = 560.0, 330.0, 120.0
"""Of the panel, and how far a label may be from its point, in pixels."""


def slider(study: Study, scene: SceneSummary, figures: PageFigures) -> dict[str, Any] | None:
    """Adds the figure of a scene, with what it shows at each cost; None where no model of times was
    fitted.
    """
    costs = predictions(study, scene.name)
    drawn = [(cost, row[0]) for cost in costs for row in panels(cost.study)[:1]]
    if len(drawn) < 2:
        return None
    axes = axes_of([panel for _, panel in drawn], WIDTH, HEIGHT)
    labels = [labels_of(panel, axes, REACH) for _, panel in drawn]
    # The script begins where the slider does, at the cost in the middle of those that were
    # measured.
    measured = [number for number, (cost, _) in enumerate(drawn) if cost.is_measured]
    start = measured[len(measured) // 2]
    spec = _spec(drawn[start][1], axes, labels[start], study)
    states = [
        {
            **_state(cost, panel),
            "rows": [columns(rows) for rows in layer_rows(panel, axes, of_panel)],
        }
        for (cost, panel), of_panel in zip(drawn, labels, strict=True)
    ]
    figure = figures.add_moving(
        spec,
        f"Error against time by cost of shading: {scene.name}",
        data=data_names(spec),
        states=states,
    )
    model = next(model for model in study.models if model.scene == scene.name)
    return {
        "figure": figure,
        "start": start,
        "last": len(states) - 1,
        "state": states[start],
        "measured": [(number, drawn[number][0].shading.name) for number in measured],
        "residual": f"{100 * model.rms:.1f} % (at most {100 * model.residual:.1f} %)",
    }


def _spec(panel: Panel, axes: Any, labels: Sequence[Any], study: Study) -> Any:
    import altair

    figure = Figure()
    # What the title of a panel says changes with the cost; the page says it.
    chart = chart_of(panel, axes, labels, figure, first=True)
    chart.title = altair.Undefined
    heading = title(
        f"Error against {'added ' if panel.base is not None else ''}time: {display(study.device)}",
        [],
        WIDTH,
        size=13,
    )
    figure.add([chart], heading)
    return figure.spec()


def _state(cost: Prediction, panel: Panel) -> dict[str, Any]:
    """What the page says at a cost of shading."""
    choice = next(iter(cost.study.recommendations), None)
    screen = cost.shading.full_screen_ms or 0.0
    name = f"{cost.shading.name}, measured" if cost.is_measured else "predicted"
    return {
        "label": display(f"{screen:.3g} ms a full screen at 1x ({name})"),
        "base": f"1x takes {panel.base:.3g} ms." if panel.base is not None else "",
        "take": f"{choice.text[0].upper()}{choice.text[1:]}." if choice is not None else "",
        "reasons": [choice.reason, choice.following] if choice is not None else [],
    }

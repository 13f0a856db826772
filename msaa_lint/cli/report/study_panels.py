"""What the figures of a study show: a panel for each scene and cost of shading, with the points
that have a place in it.
"""

import math
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

from msaa_lint.experiments.study.crops import short_name
from msaa_lint.experiments.study.measures import ERROR
from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.pareto import tie
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, Point, Technique
from msaa_lint.experiments.study.shading import NONE, Shading

from .escape import display
from .figure import title

SOFTWARE = "times of a software driver: they say nothing about a GPU"

COLUMNS = {0: 1, 1: 1, 2: 2, 3: 3, 4: 2}
"""Of panels, by the number of scenes, where there is one cost of shading."""


class Panel(NamedTuple):
    """The points of a scene under one cost of shading. `base` is the time of one sample, None if
    times do not refer to it; with `by_time`, the Pareto-optimal points are those of error against
    time.
    """

    scene: SceneSummary
    shading: Shading
    points: Sequence[Point]
    base: float | None
    by_time: bool

    @property
    def front(self) -> list[tuple[float, float]]:
        """The places of the Pareto front, from its fastest point on; nothing if it is not of error
        against time.
        """
        return (
            sorted(self.place(point) for point in self.points if point.best) if self.by_time else []
        )

    def is_optimal(self, point: Point) -> bool:
        """Whether a point is Pareto-optimal, or has the error and, within the noise, the time of a
        point that is.
        """
        rounded = self.scene.measure.rounded
        best = (other for other in self.points if other.best)
        return any(
            other is point
            or (self.by_time and rounded(other) == rounded(point) and tie(other, point))
            for other in best
        )

    def place(self, point: Point) -> tuple[float, float]:
        """What a point is drawn at: the time that it adds to that of one sample, or its time, or
        without times samples plus shader invocations per pixel; and its error.
        """
        if point.time_ms is None:
            return float(point.technique.samples + point.technique.shaded), error(self.scene, point)
        return point.time_ms - (self.base or 0.0), error(self.scene, point)

    def interval(self, point: Point) -> tuple[float, float] | None:
        """The bounds of a point's place; None without any."""
        if point.time_ms is None or point.low_ms is None or point.high_ms is None:
            return None
        return point.low_ms - (self.base or 0.0), point.high_ms - (self.base or 0.0)

    @property
    def measure(self) -> str:
        """The name of the error, for its axis."""
        measure = self.scene.measure
        if measure.key == ERROR.key:
            return "RMSE of coverage" if self.scene.coverage else "RMSE of linear color"
        return measure.name

    def heading(self, width: float) -> Any:
        """The scene, the cost of shading as calibrated, and the time of one sample, as a title of a
        panel of this width.
        """
        lines = []
        if self.shading.name:
            screen = self.shading.full_screen_ms
            known = screen is not None and self.shading.name != NONE
            lines.append(
                f"shading: {display(self.shading.name)}"
                + (f", {screen:.3g} ms a full screen" if known else "")
            )
        if self.base is not None:
            lines.append(f"1x takes {self.base:.3g} ms")
        return title(display(self.scene.name), lines, width, size=11)


def abbreviation(techniques: Iterable[Technique]) -> list[str]:
    """What the short name of sample shading means, by the one of the techniques of which the fewest
    samples are shaded; nothing where none has such a name.
    """
    shaded = sorted(
        (technique for technique in techniques if technique.kind == SAMPLE_SHADING),
        key=lambda each: each.shaded / each.samples,
    )
    return [
        f"{short_name(each)}: {each.samples} samples, {each.shaded} of them shaded"
        for each in shaded[:1]
    ]


def panels(study: Study) -> list[list[Panel]]:
    """The panels by scene, each with one per cost of shading; nothing for a scene without a point
    that has a place.
    """
    costs = {shading.name: shading for shading in study.shadings}
    points = {scene.name: plotted(scene, study.of(scene.name)) for scene in study.scenes}
    names = list(
        dict.fromkeys(point.shading for scene in study.scenes for point in points[scene.name])
    )
    by_time = not study.software and any(point.time_ms is not None for point in study.points)
    rows = []
    for scene in study.scenes:
        if points[scene.name]:
            row = [
                Panel(scene, costs.get(name, Shading(name)), of_cost, _base(of_cost), by_time)
                for name in names
                for of_cost in [[point for point in points[scene.name] if point.shading == name]]
            ]
            related = all(panel.base is not None for panel in row if panel.points)
            # Either all panels of a scene show what is added, or none does.
            rows.append(row if related else [panel._replace(base=None) for panel in row])
    return rows


def _base(points: Sequence[Point]) -> float | None:
    return next((point.time_ms for point in points if point.technique == Technique(MSAA, 1)), None)


def error(scene: SceneSummary, point: Point) -> float:
    """The error of a point that its scene is about; NaN where it was not measured."""
    value = scene.measure.of(point)
    return math.nan if value is None else value


def plotted(scene: SceneSummary, points: Sequence[Point]) -> list[Point]:
    """The points of a scene that have a place: those with a time if there are any."""
    timed = any(point.time_ms is not None for point in points)
    with_time = [point for point in points if point.time_ms is not None] if timed else points
    return [
        point
        for point in with_time
        if math.isfinite(error(scene, point)) and math.isfinite(point.time_ms or 0.0)
    ]

"""The result of `msaa-lint study`, for reports."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Finding

from .advice import Advice
from .crops import Crops
from .measures import ERROR, Measure
from .points import Point
from .recommendation import DEFAULT_BUDGET_MS, Recommendation
from .scenes.about import EDGES
from .shading import Shading
from .steps import Step
from .tasks import FailedPoint
from .time_model import TimeModel


class SceneSummary(NamedTuple):
    """A scene of a study: what it shows, in one sentence; its effects, each with the reason;
    whether its error is of coverage, in [0, 1], or of linear color; what it is about
    (study/scenes/about.py), and the error by which its techniques are therefore compared; what is
    assumed of a frame that a device timed.
    """

    name: str
    description: str
    effects: tuple[tuple[str, str], ...]
    coverage: bool = True
    about: tuple[str, ...] = (EDGES,)
    measure: Measure = ERROR
    assumed: tuple[str, ...] = ()


class UntimedTechnique(NamedTuple):
    """A technique that the device did not draw, and why."""

    name: str
    reason: str


class Study(NamedTuple):
    """A study.

    `device` is the source of the times, empty without any; `model` is the device whose traffic the
    cost model estimates, empty for none in particular. `points` are in the order of the scenes,
    shading costs, and techniques. `wrong` are findings that say why an input could not be used;
    `records` and `pictures` are the paths of the files written, `crops` the crops by scene, if they
    were asked for. `answer.conclude` marks the Pareto-optimal points, and adds `steps`,
    `recommendations`, and `advice`.

    `software` says that the device is a CPU: its times are labelled as such, and advice does not
    use them. `shadings` are the costs of shading, as calibrated, and `models` the fitted times of
    the scenes. `budget_ms` is what a technique may add to the time of one sample.
    """

    device: str
    model: str
    size: tuple[int, int]
    bits: int
    scenes: Sequence[SceneSummary]
    points: Sequence[Point]
    failed: Sequence[FailedPoint]
    untimed: Sequence[UntimedTechnique]
    advice: Sequence[Advice] = ()
    wrong: Sequence[Finding] = ()
    records: Sequence[str] = ()
    pictures: Sequence[str] = ()
    software: bool = False
    shadings: Sequence[Shading] = ()
    models: Sequence[TimeModel] = ()
    budget_ms: float = DEFAULT_BUDGET_MS
    steps: Sequence[Step] = ()
    recommendations: Sequence[Recommendation] = ()
    crops: Mapping[str, Crops] = {}

    def of(self, scene: str, shading: str | None = None) -> list[Point]:
        """The points of one scene, or those of one of its shading costs."""
        return [
            point
            for point in self.points
            if point.scene == scene and shading in (None, point.shading)
        ]

    def shading_names(self, scene: str) -> list[str]:
        """The names of the costs of shading that a scene was timed under, in the order of its
        points; one empty name without times.
        """
        return list(dict.fromkeys(point.shading for point in self.points if point.scene == scene))

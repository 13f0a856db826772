"""Points that no simulator made, in known numbers, and a measure that gives them: importable, so
that worker processes have it too.
"""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from typing import Any

from msaa_lint.experiments.study.points import MSAA, SSAA, Point, Technique
from msaa_lint.experiments.study.shading import Shading
from msaa_lint.experiments.study.tasks import StudyInput, Task
from msaa_lint.experiments.study.time_model import TERMS, Terms, TimeModel
from msaa_lint.experiments.study.times import Cost, Costs

ERRORS = {1: 0.2887, 2: 0.1443, 4: 0.0722, 8: 0.0361, 16: 0.0363}
TIMES = {1: 1.0, 2: 1.3, 4: 2.0, 8: 3.8, 16: 7.6}


def point(technique: Technique, scene: str = "edges", **other: Any) -> Point:
    """An axis-aligned edge's errors by the closed form, 1/(n*sqrt(12)), and the bias of 16
    samples.
    """
    error = (
        1 / (technique.grid * math.sqrt(12))
        if technique.kind == SSAA
        else ERRORS[technique.samples]
    )
    bias = 1 / 32 if technique.samples == 16 and technique.kind == MSAA else 0.0
    made = Point(
        scene,
        technique,
        64,
        48,
        error,
        error / 8,
        2 * error,
        bias,
        20.0 - 20 * math.log10(error),
        18.0,
        321,
        ("depth test",),
    )
    return made._replace(**other)


def timed(technique: Technique, scene: str = "edges", **other: Any) -> Point:
    """The same with a device's time: sample shading takes 1.5 times that of its count, SSAA its
    invocations.
    """
    time = TIMES.get(technique.samples, 4.0)
    time = (
        float(technique.samples)
        if technique.kind == SSAA
        else time
        if technique.kind == MSAA
        else 1.5 * time
    )
    given = {
        "time_ms": time,
        "time_from": "a device",
        "ratio": time,
        "bytes_per_frame": 8294400,
        "milliwatts": 49.8,
        "memory_mib": 7.9,
    }
    return point(technique, scene, **{**given, **other})


def shaded(
    technique: Technique, shading: str, nanoseconds: float, noise: float = 0.01, **other: Any
) -> Point:
    """The same under a cost of shading, by the model of times: what the bare fill takes, and a
    million invocations each.
    """
    bare = timed(technique)
    assert bare.time_ms is not None
    time = bare.time_ms + technique.shaded * nanoseconds * 1e-6
    bounds = {"low_ms": time * (1 - noise), "high_ms": time * (1 + noise)}
    return bare._replace(**{"shading": shading, "time_ms": time, **bounds, "ratio": None, **other})


def measure(task: Task) -> Point:
    """A point of a task. What the scene's name says comes to pass at 4x: `breaks`, `dies`,
    `twice`.
    """
    name, four = task.input.name, task.technique == Technique(MSAA, 4)
    if four and name == "breaks":
        raise ValueError("the picture \x1b[31m is no picture")
    if four and name == "dies":
        os._exit(3)
    return point(task.technique, name, width=task.width, height=task.height)


def tasks(*names: str, techniques: list[Technique], **other: Any) -> list[Task]:
    """The tasks of scenes and techniques."""
    return [
        Task(StudyInput("scene", name), technique, 64, 48)._replace(**other)
        for name in names
        for technique in techniques
    ]


class DeviceClock:
    """A source that takes note of what it is asked."""

    def __init__(self, name: str = "a device", unsupported: tuple[int, ...] = ()) -> None:
        self.name = name
        self.unsupported = unsupported
        self.input: list[Technique] = []

    def costs(
        self, techniques: Sequence[Technique], shadings: Sequence[Shading], size: tuple[int, int]
    ) -> Costs:
        """Its samples in milliseconds, and as much again for each operation of shading."""
        self.input += techniques
        return {
            (technique, shading.name): self._of(technique, shading)
            for technique in techniques
            for shading in shadings
        }

    def _of(self, technique: Technique, shading: Shading) -> Cost:
        if technique.samples in self.unsupported:
            return Cost(None, 1000, 1.0, 0.5, reason="the device does not have that count")
        time = 2.0 * technique.samples * (1 + shading.operations)
        return Cost(time, 1000 * technique.samples, 1.0, 0.5, 0.95 * time, 1.05 * time)


def model(
    scene: str,
    base: Mapping[Technique, float],
    invocations: Mapping[Technique, float],
    residual: float,
    noise: float,
) -> TimeModel:
    """A model of times that are `base` milliseconds plus `invocations` times the cost of a million
    of them, with such residuals.
    """
    coefficients = tuple(
        1.0 if name in ("ms_per_gb_written", "fragments") else 0.0 for name in TERMS
    )
    terms = {
        technique: Terms(gb_written=base[technique], fragments=invocations[technique] / 1e6)
        for technique in base
    }
    # No cost above 0 is measured: all are uncertain by the residual.
    return TimeModel(
        scene,
        coefficients,
        terms,
        {technique: [(-1.0, 1.0)] for technique in base},
        residual,
        residual,
        noise,
    )

"""Measures the simulation beside lavapipe on the same scene: `python
tests/benchmarks/study_lavapipe.py [ROUNDS]`.

Prints a table in Markdown: one triangle over most of a picture of 1920x1080, and 20,000 triangles
of about 16 pixels, at 1 and 4 samples. lavapipe's time is by its own clock, of a pass that clears,
draws and resolves; the simulation's of coverage alone, least of the rounds.
"""

from __future__ import annotations

import sys
import time

import numpy as np
from study_coverage import HEIGHT, LARGE, WIDTH, small

from msaa_lint.experiments.study.coverage import rows
from msaa_lint.experiments.study.fragments import fragments
from msaa_lint.experiments.study.locations import SUBPIXELS, standard
from msaa_lint.experiments.study.points import MSAA, Technique
from msaa_lint.experiments.study.scene_timing import SceneClock
from msaa_lint.experiments.study.scenes import area, shapes
from msaa_lint.experiments.study.scenes.scene import WHITE, Scene
from msaa_lint.experiments.study.shading import Shading
from msaa_lint.experiments.study.times import CostModel, DeviceClock


def simulate(triangles: np.ndarray, samples: int, rounds: int) -> float:
    """Milliseconds of spans and fragments, the least of the rounds."""
    found = []
    for _ in range(rounds):
        start = time.perf_counter()
        fragments(rows(triangles, WIDTH, HEIGHT, standard(samples)), samples)
        found.append(time.perf_counter() - start)
    return 1000 * min(found)


def main() -> int:
    """Measures and prints."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    print("| scene | samples | simulation, ms | lavapipe, ms | ratio |\n|---|---:|---:|---:|---:|")
    techniques, none = [Technique(MSAA, samples) for samples in (1, 4)], Shading("none")
    with DeviceClock(None, repeats=rounds) as clock:
        for name, triangles in (("one large triangle", LARGE), ("20,000 small triangles", small())):
            colors = shapes.uniform_colors(len(triangles), WHITE)
            scene = Scene(WIDTH, HEIGHT, triangles / SUBPIXELS, colors, area.disjoint(colors))
            with SceneClock(clock, scene, CostModel()) as source:
                costs = source.costs(techniques, [none], (WIDTH, HEIGHT))
            for technique in techniques:
                own, device = (
                    simulate(triangles, technique.samples, rounds),
                    costs[technique, none.name].time_ms,
                )
                assert device is not None, clock.name
                print(
                    f"| {name} | {technique.samples} | {own:.1f} | {device:.1f} | "
                    f"{own / device:.2f} |"
                )
    return 0


if __name__ == "__main__":
    sys.exit(main())

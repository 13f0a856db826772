"""Measures how long coverage takes at 1920x1080: `python tests/benchmarks/study_coverage.py
[ROUNDS]`.

Prints a table in Markdown: one triangle over most of the picture, spans alone and with the mask of
every sample or with fragments, for 1 to 16 samples; 20,000 triangles of about 16 pixels; the exact
areas. Least of the rounds, each in turn. The goals are of an idle machine.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.coverage import rows
from msaa_lint.experiments.study.exact_area import areas, areas_of
from msaa_lint.experiments.study.fragments import fragments
from msaa_lint.experiments.study.locations import SUBPIXELS, standard
from msaa_lint.frame.vulkan.sample_locations import STANDARD

WIDTH, HEIGHT = 1920, 1080
LARGE = np.array(
    [
        [
            (10, 20),
            (WIDTH * SUBPIXELS - 77, 300 * SUBPIXELS),
            (500 * SUBPIXELS + 3, HEIGHT * SUBPIXELS - 9),
        ]
    ]
)
SMALL = 20_000


def small() -> NDArray[np.int64]:
    """Triangles with their corners in boxes of 16 pixels."""
    random = np.random.default_rng(0)
    corners = random.integers(
        0, ((WIDTH - 16) * SUBPIXELS, (HEIGHT - 16) * SUBPIXELS), (SMALL, 1, 2)
    )
    return np.asarray(corners + random.integers(0, 16 * SUBPIXELS, (SMALL, 3, 2)))


def spans(triangles: NDArray[np.int64], samples: int) -> Any:
    return rows(triangles, WIDTH, HEIGHT, standard(samples))


def with_fragments(triangles: NDArray[np.int64], samples: int) -> Any:
    return fragments(spans(triangles, samples), samples)


def main() -> int:
    """Measures and prints."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    many = small()
    tasks: dict[str, tuple[Callable[[], Any], float | None]] = {}
    for samples in STANDARD:
        tasks[f"one large triangle, {samples}x: spans"] = (
            partial(spans, LARGE, samples),
            1.0 if samples == 4 else None,
        )
        tasks[f"one large triangle, {samples}x: spans and fragments"] = (
            partial(with_fragments, LARGE, samples),
            None,
        )
    tasks["20,000 small triangles, 4x: spans"] = partial(spans, many, 4), None
    tasks["20,000 small triangles, 4x: spans and fragments"] = (
        partial(with_fragments, many, 4),
        1500.0,
    )
    tasks["one large triangle: exact areas"] = (
        partial(areas, LARGE[0] / SUBPIXELS, WIDTH, HEIGHT),
        None,
    )
    tasks["20,000 small triangles: exact areas"] = (
        partial(areas_of, many / SUBPIXELS, WIDTH, HEIGHT),
        None,
    )

    least = dict.fromkeys(tasks, float("inf"))
    for _ in range(rounds):
        for name, (task, _goal) in tasks.items():
            # The first call brings code and memory back that the other tasks have put out of the
            # cache.
            for _again in range(2):
                start = time.perf_counter()
                task()
                least[name] = min(least[name], 1000 * (time.perf_counter() - start))
    print(f"| {WIDTH}x{HEIGHT}, least of {rounds} rounds | ms | goal |\n|---|---:|---|")
    for name, (_task, goal) in tasks.items():
        says = "" if goal is None else f"{goal:g}: {'met' if least[name] <= goal else 'MISSED'}"
        print(f"| {name} | {least[name]:.2f} | {says} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())

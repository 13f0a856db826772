"""Measures the simulator: `python tests/benchmarks/study_effects.py [--quick]`. Prints tables in
Markdown.

What each effect takes beside the same draw without it, what it takes where it is off, and how time
and memory grow with pixels and samples. Runs of what is compared alternate; the least of them is
shown, which other work on the machine spoils last.
"""

from __future__ import annotations

import sys
import time
import tracemalloc
from collections.abc import Callable, Mapping

import numpy as np

from msaa_lint.experiments.study import effects
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, Technique
from msaa_lint.experiments.study.scenes import area, shapes
from msaa_lint.experiments.study.scenes.scene import Scene
from msaa_lint.experiments.study.simulate import simulate

SIZE = (1920, 1080)
FOUR = Technique(MSAA, 4)


def picture(width: int, height: int) -> Scene:
    """Two sheets over the whole picture, one through the other, shaded by a gradient."""
    made = shapes.triangles([shapes.rectangle(0, 0, width, height)] * 2)
    slope = np.array([[0.3, 0.7, 0.7], [0.3, 0.7, 0.3]])
    depths = np.concatenate([np.full((2, 3), 0.5), slope])

    def shade(triangle: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        value = x / width
        return np.stack([value, value, value, 0.25 + value / 2], axis=-1)

    colors = shapes.uniform_colors(4, (1.0, 0.5, 0.25, 0.75))
    return Scene(width, height, made, colors, area.disjoint(colors), False, depths, shade=shade)


EFFECTS: dict[str, tuple[tuple[str, ...], dict[str, object], Technique]] = {
    "sample-mask": (("sample-mask",), {"sample-mask": 15}, FOUR),
    "sample-shading, each": ((), {}, Technique(SAMPLE_SHADING, 4, 1.0)),
    "alpha-test": (("alpha-test",), {}, FOUR),
    "alpha-to-coverage": (("alpha-to-coverage",), {}, FOUR),
    "stencil": (("stencil",), {"stencil": (0, 2, 4)}, FOUR),
    "depth-test": (("depth-test",), {}, FOUR),
    "blending": (("blending",), {}, FOUR),
    "hdr": (("hdr",), {}, FOUR),
    "srgb": (("srgb",), {"srgb": "linear-light"}, FOUR),
    "depth-resolve (with the test)": (
        ("depth-test", "depth-resolve"),
        {"depth-resolve": "MIN"},
        FOUR,
    ),
    "tone-mapping, after": (("tone-mapping",), {"tone-mapping": "after-resolve"}, FOUR),
    "tone-mapping, before": (("tone-mapping",), {"tone-mapping": "before-resolve"}, FOUR),
    "tone-mapping, weighted": (("tone-mapping",), {"tone-mapping": "weighted"}, FOUR),
}


def least(tasks: Mapping[str, Callable[[], object]], rounds: int) -> dict[str, float]:
    """The least milliseconds of each, run in turns after one that does not count."""
    found = dict.fromkeys(tasks, float("inf"))
    for turn in range(rounds + 1):
        for name, task in tasks.items():
            start = time.process_time()
            task()
            if turn:
                found[name] = min(found[name], 1000 * (time.process_time() - start))
    return found


def by_effect(rounds: int) -> None:
    """What each effect takes."""
    plain = picture(*SIZE)
    tasks: dict[str, Callable[[], object]] = {"none": lambda: simulate(plain, FOUR)}
    for name, (names, settings, technique) in EFFECTS.items():
        scene = plain._replace(effects=names, settings=settings)
        tasks[name] = lambda scene=scene, technique=technique: simulate(scene, technique)  # type: ignore[misc]
    found = least(tasks, rounds)
    none = found.pop("none")
    print(
        f"Two sheets at {SIZE[0]}x{SIZE[1]}, 4x, CPU milliseconds; {none:.0f} without an effect.\n"
    )
    print("| effect | ms | more than without |\n|---|---:|---:|")
    for name, took in found.items():
        print(f"| {name} | {took:.0f} | {took - none:+.0f} |")
    print()


def off(rounds: int) -> None:
    """What effects take that are off, all of them together: beside a table without any, which
    leaves nothing to look up or to leave out.
    """
    plain, whole = picture(480, 270), effects.TABLE

    def without() -> None:
        effects.TABLE = ()
        try:
            simulate(plain, FOUR)
        finally:
            effects.TABLE = whole

    found = least({"off": lambda: simulate(plain, FOUR), "not there": without}, rounds)
    more = 100 * (found["off"] / found["not there"] - 1)
    print(
        f"All effects off: {found['off']:.2f} ms; none there to be off: {found['not there']:.2f} "
        f"ms: {more:+.2f} % (at most 1).\n"
    )


def growth(rounds: int) -> None:
    """Time and the most memory at once, by pixels and by samples."""
    print(
        "| pixels | samples | CPU ms | ns a pixel and sample | peak MiB | bytes a pixel |\n"
        "|---|---:|---:|---:|---:|---:|"
    )
    cases = [(480, 270, 4), (960, 540, 4), (1920, 1080, 4), (3840, 2160, 4)]
    cases += [(1920, 1080, count) for count in (1, 2, 8, 16)]
    for width, height, count in cases:
        scene = picture(width, height)._replace(effects=("depth-test",))
        technique = Technique(MSAA, count)
        took = least(
            {"": lambda scene=scene, technique=technique: simulate(scene, technique)}, rounds
        )[""]  # type: ignore[misc]
        tracemalloc.start()
        simulate(scene, technique)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        pixels = width * height
        print(
            f"| {width}x{height} | {count} | {took:.0f} | {1e6 * took / pixels / count:.0f} | "
            f"{peak / 2**20:.0f} | {peak / pixels:.0f} |"
        )


if __name__ == "__main__":
    quick = "--quick" in sys.argv
    by_effect(3 if quick else 9)
    off(60 if quick else 300)
    growth(1 if quick else 3)

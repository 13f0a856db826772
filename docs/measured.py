"""Measures accuracy and time on a device: samples are read back from it, and its clock measures the time.

`python -m docs.measured --device NVIDIA --size 3840x2160 edge-fan` prints a table in Markdown; `--json FILE` stores the points, `--plot
FILE.svg` plots error against time, and `--from FILE` uses stored points instead of a device.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
import tempfile
from collections.abc import Iterator

import numpy as np

from msaa_lint.cli.report.figure import draw
from msaa_lint.cli.report.study_plot import plot
from msaa_lint.experiments.confirm.child import Limits
from msaa_lint.experiments.confirm.session import Session, environment
from msaa_lint.experiments.confirm.vulkan_errors import Unusable
from msaa_lint.experiments.study import coverage, locations, snap
from msaa_lint.experiments.study.measure import truth
from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.pareto import mark_best
from msaa_lint.experiments.study.points import SSAA, Point, Technique, techniques
from msaa_lint.experiments.study.scene_timing import clip
from msaa_lint.experiments.study.scenes import scene
from msaa_lint.experiments.study.scenes.scene import Scene
from msaa_lint.experiments.study.sums import difference, errors
from msaa_lint.experiments.study.times import DeviceClock
from tests.experiments.study.device import covered, viewport
from tests.experiments.study.spans import masks


@dataclasses.dataclass
class Measured:
    """A technique on a device. Errors are of coverage over the pixels that an edge crosses; `differ` is the number of samples that differ
    from the simulation."""

    scene: str
    technique: str
    size: str
    rmse: float | None
    bias: float | None
    greatest: float | None
    differ: int | None
    samples: int
    time_ms: float | None
    low_ms: float | None
    high_ms: float | None
    reason: str = ""


def simulate(corners: np.ndarray, width: int, height: int, samples: int, fused: bool) -> np.ndarray:
    """The samples that triangles cover in the simulation."""
    triangles = snap.snapped(viewport(corners[..., :2], width, height, fused))
    return masks(coverage.rows(triangles, width, height, locations.standard(samples)), width, height, samples)


def measured(made: Scene, technique: Technique, session: Session, clock: DeviceClock) -> Measured:
    """The errors and the time of a technique."""
    side = technique.grid if technique.kind == SSAA else 1
    samples = 1 if technique.kind == SSAA else technique.samples
    width, height = made.width * side, made.height * side
    corners = clip(made.triangles * side, width, height)
    found = Measured(made.name, technique.name, f"{made.width}x{made.height}", *[None] * 4, samples * width * height, *[None] * 3)
    try:
        drawn = covered(session, corners, width, height, samples)
    except Unusable as error:
        return dataclasses.replace(found, reason=str(error))
    share = drawn.reshape(made.height, side, made.width, side, samples).mean(axis=(1, 3, 4), dtype=np.float64)
    exact = truth(made, technique)
    own = errors(difference(share, exact.image[..., 3])[exact.edge_pixels])
    differ = int((drawn != simulate(corners, width, height, samples, "llvmpipe" in clock.name)).sum())
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "vertices")
        corners.tofile(path)
        cost = clock.of(technique, made.width, made.height, path)
    return dataclasses.replace(
        found, rmse=own.rmse, bias=own.bias, greatest=own.greatest, differ=differ, time_ms=cost.time_ms, low_ms=cost.low_ms,
        high_ms=cost.high_ms, reason=cost.reason,
    )  # fmt: skip


def plotted(found: list[Measured], device: str) -> bytes:
    """Error against time as SVG."""
    by_name = {technique.name: technique for technique in techniques()}
    width, height = map(int, found[0].size.split("x"))
    points = [
        Point(
            each.scene,
            by_name[each.technique],
            width,
            height,
            each.rmse,
            0,
            0,
            0,
            0,
            0,
            0,
            time_ms=each.time_ms,
            low_ms=each.low_ms,
            high_ms=each.high_ms,
        )
        for each in found
        if each.rmse is not None and each.time_ms is not None
    ]
    scenes = [SceneSummary(name, "", ()) for name in dict.fromkeys(each.scene for each in found)]
    return draw(plot(Study(device, "", (width, height), 8, scenes, mark_best(points), (), (), ())), "svg")


def table(found: list[Measured]) -> Iterator[str]:
    """The rows of a table in Markdown."""
    yield "| technique | RMSE at edges | worst | bias | ms | ratio to 1x | samples that differ from the simulation |"
    yield "|---|---:|---:|---:|---:|---:|---:|"
    first = next((each.time_ms for each in found if each.time_ms), None)
    for each in found:
        if each.rmse is None:
            yield f"| {each.technique} | {each.reason} | | | | | |"
            continue
        time = f"{each.time_ms:.3f}" if each.time_ms is not None else "-"
        ratio = f"{each.time_ms / first:.2f}" if each.time_ms is not None and first else "-"
        errors = f"{each.rmse:.4f} | {each.greatest:.3f} | {each.bias:+.4f}"
        yield f"| {each.technique} | {errors} | {time} | {ratio} | {each.differ} of {each.samples} |"


def main() -> None:
    """Prints the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--device", default=None)
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--samples", default="1,2,4,8")
    parser.add_argument("--repeats", type=int, default=31)
    parser.add_argument("--json")
    parser.add_argument("--plot")
    parser.add_argument("--from", dest="kept")
    arguments = parser.parse_args()
    if arguments.kept:
        with open(arguments.kept, encoding="utf-8") as file:
            device, every = arguments.device or "", [Measured(**each) for each in json.load(file)]
        every = [each for each in every if each.scene in arguments.scenes]
    else:
        device, every = on_device(arguments)
    for name in arguments.scenes:
        print(f"\n{name}, {every[0].size}, {device}\n")
        print("\n".join(table([each for each in every if each.scene == name])))
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump([dataclasses.asdict(each) for each in every], file, indent=1)
    if arguments.plot:
        with open(arguments.plot, "wb") as image:
            image.write(plotted(every, device))


def on_device(arguments: argparse.Namespace) -> tuple[str, list[Measured]]:
    """The device's name, and its points."""
    width, height = map(int, arguments.size.split("x"))
    counts = tuple(map(int, arguments.samples.split(",")))
    limits = Limits(seconds=120)
    with (
        Session(arguments.device, validation=False, limits=limits, environment=environment(arguments.device)) as session,
        DeviceClock(arguments.device, repeats=arguments.repeats) as clock,
    ):
        scenes = [scene(name, width, height) for name in arguments.scenes]
        return clock.name, [measured(made, technique, session, clock) for made in scenes for technique in techniques(counts=counts)]


if __name__ == "__main__":
    main()

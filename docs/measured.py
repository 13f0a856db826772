"""Compares the coverage of a device with the simulation, sample by sample: the samples are read
back from the device.

`python -m docs.measured --device NVIDIA --size 3840x2160 edge-fan` prints a table in Markdown.
"""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Iterator

import numpy as np

from msaa_lint.experiments.confirm.child import Limits
from msaa_lint.experiments.confirm.outcome import about
from msaa_lint.experiments.confirm.session import Session, environment
from msaa_lint.experiments.confirm.vulkan_errors import Unusable
from msaa_lint.experiments.study import coverage, locations, snap
from msaa_lint.experiments.study.measure import truth
from msaa_lint.experiments.study.points import MSAA, SSAA, Technique, techniques
from msaa_lint.experiments.study.scene_timing import clip
from msaa_lint.experiments.study.scenes import scene
from msaa_lint.experiments.study.scenes.scene import Scene
from msaa_lint.experiments.study.sums import ErrorSum, difference
from tests.experiments.study.device import covered, viewport
from tests.experiments.study.spans import masks


@dataclasses.dataclass
class Measured:
    """A technique on a device. Errors are of coverage over the pixels that an edge crosses;
    `differ` is the number of samples that differ from the simulation.
    """

    technique: str
    samples: int
    rmse: float = 0.0
    bias: float = 0.0
    greatest: float = 0.0
    differ: int = 0
    reason: str = ""


def simulate(corners: np.ndarray, width: int, height: int, samples: int, fused: bool) -> np.ndarray:
    """The samples that triangles cover in the simulation."""
    triangles = snap.snapped(viewport(corners[..., :2], width, height, fused))
    return masks(
        coverage.rows(triangles, width, height, locations.standard(samples)), width, height, samples
    )


def measured(made: Scene, technique: Technique, session: Session, fused: bool) -> Measured:
    """The errors of a technique, and how many samples differ."""
    side = technique.grid if technique.kind == SSAA else 1
    samples = 1 if technique.kind == SSAA else technique.samples
    width, height = made.width * side, made.height * side
    corners = clip(made.triangles * side, width, height)
    try:
        drawn = covered(session, corners, width, height, samples)
    except Unusable as error:
        return Measured(technique.name, samples * width * height, reason=str(error))
    share = drawn.reshape(made.height, side, made.width, side, samples).mean(
        axis=(1, 3, 4), dtype=np.float64
    )
    exact = truth(made, technique)
    error_sum = ErrorSum()
    error_sum.add(difference(share, exact.image[..., 3])[exact.edge_pixels])
    errors = error_sum.errors()
    differ = int((drawn != simulate(corners, width, height, samples, fused)).sum())
    return Measured(
        technique.name, samples * width * height, errors.rmse, errors.bias, errors.greatest, differ
    )


def table(found: list[Measured]) -> Iterator[str]:
    """The rows of a table in Markdown."""
    yield "| technique | RMSE at edges | worst | bias | samples that differ from the simulation |"
    yield "|---|---:|---:|---:|---:|"
    for each in found:
        figures = (
            f"{each.rmse:.4f} | {each.greatest:.3f} | {each.bias:+.4f} | {each.differ} of "
            f"{each.samples}"
        )
        yield f"| {each.technique} | {each.reason or figures} |"


def main() -> None:
    """Prints the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--device", default=None)
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--samples", default="1,2,4,8")
    arguments = parser.parse_args()
    width, height = map(int, arguments.size.split("x"))
    counts = tuple(map(int, arguments.samples.split(",")))
    with Session(
        arguments.device,
        validation=False,
        limits=Limits(seconds=120),
        environment=environment(arguments.device),
    ) as session:
        device = about(session.open()).name
        for name in arguments.scenes:
            made = scene(name, width, height)
            print(f"\n{name}, {width}x{height}, {device}\n")
            # Sample shading covers what its sample count covers.
            compared = techniques((MSAA, SSAA), counts)
            print(
                "\n".join(
                    table(
                        [
                            measured(made, technique, session, "llvmpipe" in device)
                            for technique in compared
                        ]
                    )
                ),
                flush=True,
            )


if __name__ == "__main__":
    main()

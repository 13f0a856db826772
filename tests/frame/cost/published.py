"""The six configurations whose counters Khronos published for a Mali-G76, and the model's
prediction of them.

The counters are those on the screenshots of Vulkan-Samples, samples/performance/msaa (2168x1080,
RGBA8, 32-bit depth, 60 Hz), in MiB/s.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from msaa_lint.frame.cost.amounts import FrameCost
from tests.frame.cost.frames import EXAMPLES, cost

FOLDER = Path(__file__).parent / "mali_g76"
MB_PER_MIB = 2**20 / 1e6


class Configuration(NamedTuple):
    """A published configuration: its description, and external reads and writes in MiB/s."""

    name: str
    path: Path
    read: float
    write: float

    def cost(self) -> FrameCost:
        """What the model says of it."""
        return cost(self.path.read_text(encoding="utf-8"))


CONFIGURATIONS = {
    "A": Configuration("no MSAA", FOLDER / "single-sampled.msaa.yaml", 607.1, 413.1),
    "B": Configuration(
        "4x, color resolved in the pass", FOLDER / "color-inline.msaa.yaml", 633.5, 433.1
    ),
    "C": Configuration(
        "4x, color resolved by a command",
        EXAMPLES / "khronos-msaa/color-separate.msaa.yaml",
        2803.3,
        2715.1,
    ),
    "D": Configuration(
        "no MSAA, post-processing", FOLDER / "single-sampled-post.msaa.yaml", 1117.7, 905.4
    ),
    "E": Configuration(
        "4x, post-processing, both resolved in the pass",
        EXAMPLES / "khronos-msaa/inline.msaa.yaml",
        1160.6,
        930.7,
    ),
    "F": Configuration(
        "4x, post-processing, neither",
        EXAMPLES / "khronos-msaa/depth-unresolved.msaa.yaml",
        3527.0,
        4881.6,
    ),
}

FITTED_ON = ("A", "B", "D", "E")
"""The configurations that the constants are fitted to: those in which no multisampled image leaves
the tile. C and F are predicted.
"""


class Fit(NamedTuple):
    """measured = base + ratio * arithmetic, for one direction.

    `base`, in MiB/s, is what the scene moves beside its targets: geometry, textures.
    """

    base: float
    ratio: float


def fitted(direction: str) -> Fit:
    """The least squares of base and ratio over the four configurations; two constants a direction,
    two degrees of freedom left.
    """
    points = []
    for name in FITTED_ON:
        each = CONFIGURATIONS[name]
        total = each.cost().total
        plain = total.read_mb_per_s if direction == "read" else total.write_mb_per_s
        points.append((plain / MB_PER_MIB, each.read if direction == "read" else each.write))
    middle = sum(x for x, _ in points) / len(points)
    mean = sum(y for _, y in points) / len(points)
    ratio = sum((x - middle) * (y - mean) for x, y in points) / sum(
        (x - middle) ** 2 for x, _ in points
    )
    return Fit(mean - ratio * middle, ratio)


class Prediction(NamedTuple):
    """A counter as published and as predicted, in MiB/s."""

    name: str
    direction: str
    measured: float
    predicted: float

    @property
    def error(self) -> float:
        """In per cent of what was measured."""
        return 100 * (self.predicted / self.measured - 1)


def predictions() -> list[Prediction]:
    """Every counter, by the scene's fitted base and the built-in profile's compression."""
    bases = {direction: fitted(direction).base for direction in ("read", "write")}
    found = []
    for name, each in CONFIGURATIONS.items():
        corrected = each.cost().corrected
        assert corrected is not None
        found.append(
            Prediction(
                name, "read", each.read, bases["read"] + corrected.read_mb_per_s / MB_PER_MIB
            )
        )
        found.append(
            Prediction(
                name, "write", each.write, bases["write"] + corrected.write_mb_per_s / MB_PER_MIB
            )
        )
    return found

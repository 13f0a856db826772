"""Cases of the exact picture: areas of triangles within a pixel."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from msaa_lint.experiments.study.exact_area import ACCURACY, areas
from tests.experiments.study.rational import clipped_area, exact_area

from .row import Row


def exact_areas() -> Iterator[Row]:
    """Areas within a pixel of triangles that reach far beyond it, to 12 digits."""
    step = 1 / 256
    for triangle, words in (
        (
            [(-4096.0, -4095.5), (4096.0, 4096.0), (4096.0, 4096.0 + step)],
            "a sliver 1/256 pixel wide and 11,585 long",
        ),
        (
            [(-(2.0**20), -(2.0**20) + 0.25), (2.0**20, 2.0**20), (-(2.0**20), 2.0**20)],
            "a triangle whose corners are 2^20 pixels away",
        ),
        (
            [(-(2.0**23), 0.5), (2.0**23, 0.5 + step), (0.0, 2.0**23)],
            "a triangle whose corners are 2^23 pixels away",
        ),
    ):
        exact = float(exact_area(np.array(triangle), 0, 0))
        single, double = (
            float(clipped_area(triangle, 0, 0, number)) for number in (np.float32, np.float64)
        )
        found = single, double, float(areas(np.array(triangle), 1, 1)[0, 0])
        yield Row(
            "exact picture",
            f"area in a pixel of {words}; naive: clipped and added in float32",
            exact,
            *found,
            ACCURACY / exact,
        )

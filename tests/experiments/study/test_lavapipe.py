"""Coverage held against lavapipe, sample by sample: more than ten million samples at 1x and 4x, and
not one that differs.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from numpy.typing import NDArray

from msaa_lint.experiments.confirm.session import Session, environment
from msaa_lint.experiments.study.coverage import rows
from msaa_lint.experiments.study.locations import standard
from msaa_lint.experiments.study.scene_timing import clip
from msaa_lint.experiments.study.snap import snapped
from tests.experiments.study.device import covered, viewport
from tests.experiments.study.spans import masks

SIDE = 1024
"""A power of two: then positions in clip coordinates are exact whatever way the viewport is
applied.
"""

CELL = 32


@pytest.fixture(scope="module")
def session() -> Iterator[Session]:
    with Session(None, validation=False, environment=environment(None)) as opened:
        yield opened


def in_cells(kind: str, seed: int) -> NDArray[np.float64]:
    """Triangles in pixels, one in each cell of a grid, so that what each covers is seen."""
    random = np.random.default_rng(seed)
    corners = np.arange(0, SIDE, CELL)
    cells = np.stack(np.meshgrid(corners, corners), axis=-1).reshape(-1, 1, 2).astype(np.float64)
    own = random.uniform(1, CELL - 1, (len(cells), 3, 2))
    if kind == "ties":
        # Half-way between two positions of the grid of 1/256 pixel: rounded to the even one.
        own = (np.floor(own * 256) + 0.5) / 256
    elif kind == "on samples":
        own = np.round(own * 16) / 16
    elif kind == "slivers":
        own[:, 2] = (
            own[:, 0]
            + (own[:, 1] - own[:, 0]) * random.uniform(0, 1, (len(cells), 1))
            + random.uniform(-1, 1, (len(cells), 2)) / 128
        )
    return cells + np.clip(own, 1, CELL - 1)


@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize(
    ("kind", "seed"), [("anywhere", 1), ("ties", 2), ("on samples", 3), ("slivers", 4)]
)
def test_no_sample_differs(session: Session, kind: str, seed: int, samples: int) -> None:
    corners = clip(in_cells(kind, seed), SIDE, SIDE)
    drawn = covered(session, corners, SIDE, SIDE, samples)
    triangles = snapped(viewport(corners[..., :2], SIDE, SIDE))
    simulate = masks(rows(triangles, SIDE, SIDE, standard(samples)), SIDE, SIDE, samples)
    assert drawn.shape == simulate.shape == (SIDE, SIDE, samples)
    assert int((drawn != simulate).sum()) == 0
    assert drawn.sum() > 20


def test_sides_that_are_no_power_of_two_take_the_viewport_as_lavapipe_does(
    session: Session,
) -> None:
    """One fused multiply-add in single precision; two roundings would put some corners
    elsewhere.
    """
    width, height = 1000, 600
    triangles = in_cells("anywhere", 5)
    inside = triangles[
        (triangles[..., 0].max(axis=1) < width - 1) & (triangles[..., 1].max(axis=1) < height - 1)
    ]
    corners = clip(inside, width, height)
    drawn = covered(session, corners, width, height, 4)
    simulate = masks(
        rows(snapped(viewport(corners[..., :2], width, height)), width, height, standard(4)),
        width,
        height,
        4,
    )
    assert int((drawn != simulate).sum()) == 0


def test_another_rounding_would_be_seen(session: Session) -> None:
    """Should corners be cut instead of rounded, or samples lie elsewhere, samples differ: the
    comparison can fail.
    """
    corners = clip(in_cells("anywhere", 1), SIDE, SIDE)
    drawn = covered(session, corners, SIDE, SIDE, 4)
    pixels = viewport(corners[..., :2], SIDE, SIDE)
    cut = np.floor(pixels * 256).astype(np.int64)
    assert int((drawn != masks(rows(cut, SIDE, SIDE, standard(4)), SIDE, SIDE, 4)).sum()) > 100
    turned = standard(4)[::-1].copy()
    assert (
        int((drawn != masks(rows(snapped(pixels), SIDE, SIDE, turned), SIDE, SIDE, 4)).sum()) > 1000
    )

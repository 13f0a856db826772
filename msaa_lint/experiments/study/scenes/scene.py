"""A scene: triangles, the effects it needs, and its exact picture. Importing this needs no
NumPy.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Shade = Callable[[NDArray[np.int32], Floats, Floats], Floats]
    """Triangle indices, x and y in pixels (F,) to linear RGBA (F, 4)."""

    from .view import Truth, View

    Exact = Callable[[View], Truth]
    """Snapped triangles near some parts of the picture to the exact picture of these parts."""

RGBA = tuple[float, float, float, float]
BLACK: RGBA = (0.0, 0.0, 0.0, 0.0)
WHITE: RGBA = (1.0, 1.0, 1.0, 1.0)

MIN_SIZE = 32
"""Minimum width and height of a picture, in pixels."""


class Scene(NamedTuple):
    """A picture to render. Coordinates are pixels, x to the right and y down; colors are linear,
    1.0 is display white.

    `depths` are those of the triangles' corners, in [0, 1]; None without depth. `effects` names the
    stages that the scene needs (study/effects.py), `why` gives the reason for each, and `settings`
    the choices. `shade` gives the color at a point; None where each triangle has a single color.
    `exact` gives parts of the picture without sampling error, as an infinite number of samples
    would, after any tone mapping, and the pixels that an edge crosses. With `coverage_matter` its
    alpha is the exact coverage and errors are of coverage, otherwise of color.
    """

    width: int
    height: int
    triangles: Floats
    colors: Floats
    exact: Exact
    coverage_matter: bool = True
    depths: Floats | None = None
    effects: tuple[str, ...] = ()
    why: Mapping[str, str] = {}
    settings: Mapping[str, object] = {}
    shade: Shade | None = None
    background: RGBA = BLACK
    name: str = ""
    description: str = ""


def check_size(width: int, height: int) -> None:
    """ValueError where a picture is too small for a scene."""
    if width < MIN_SIZE or height < MIN_SIZE:
        raise ValueError(
            f"a scene must be at least {MIN_SIZE}x{MIN_SIZE} pixels, found {width}x{height}"
        )

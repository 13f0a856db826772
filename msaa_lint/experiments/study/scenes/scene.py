"""What a scene is: triangles, the effects that it calls for, and the exact picture. Nothing here needs NumPy to be imported."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Shade = Callable[[NDArray[np.int32], Floats, Floats], Floats]
    """Triangles' numbers, x and y in pixels (F,) to linear RGBA (F, 4)."""

    Exact = Callable[[Floats], Floats]
    """Triangles (T, 3, 2) in pixels, as they were snapped, to the exact picture (H, W, 4) in linear colour."""

    Crossed = Callable[[Floats], NDArray[np.bool_]]
    """Triangles as above to the pixels (H, W) that an edge crosses."""

RGBA = tuple[float, float, float, float]
BLACK: RGBA = (0.0, 0.0, 0.0, 0.0)
WHITE: RGBA = (1.0, 1.0, 1.0, 1.0)


class Scene(NamedTuple):
    """A picture to be drawn. Coordinates are pixels, x to the right and y down; colours are linear, 1.0 is display white.

    `depths` are of the triangles' corners, in [0, 1], None where nothing calls for depth. `effects` are the stages that it calls for, by
    their names (study/effects), `why` says for each in words why, `settings` how where there is a choice. `shade` gives the colour at a
    point, None where a triangle has one colour all over. `exact` is the picture without sampling error: what an infinite number of samples
    would give, after the tone mapping where there is one. Where `coverage_matter`, its alpha is the exact coverage, and errors are of
    coverage; else of colour. `crossed` are the pixels that an edge crosses, by default those of a coverage above 0 and below 1.
    """

    name: str
    says: str
    width: int
    height: int
    triangles: Floats
    colors: Floats
    depths: Floats | None
    background: RGBA
    effects: tuple[str, ...]
    why: Mapping[str, str]
    exact: Exact
    coverage_matter: bool = True
    shade: Shade | None = None
    crossed: Crossed | None = None
    settings: Mapping[str, object] = {}

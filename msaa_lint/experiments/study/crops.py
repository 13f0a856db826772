"""Crops of a scene where techniques differ: the exact picture and the result of each technique."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from msaa_lint.experiments.confirm.png import EDGE, Picture

from .points import MSAA, SAMPLE_SHADING, Technique

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_PERIOD = 8


class Crops:
    """The same part of a scene by each technique, and exactly; `corner` is its left top pixel."""

    def __init__(self, corner: tuple[int, int], exact: Picture, pictures: Sequence[tuple[Technique, Picture]]) -> None:
        self.corner, self.exact, self.pictures = corner, exact, pictures


def crops(scene: Any, techniques: Sequence[Technique], bits: int = 8) -> Crops:
    """The crops of at most 16x16 pixels in which the first technique differs most from the exact picture.

    Linear colors are clipped to [0, 1] and encoded as sRGB.
    """
    from .measure import truth
    from .simulate import simulate

    exact = display_codes(truth(scene, Technique(MSAA, 1), bits).image)
    # The first technique determines the crop; the others are rendered only there.
    x, y = align(most_different(display_codes(simulate(scene, techniques[0], bits).image), exact))
    part = window(scene, x, y)
    pictures = [(technique, _picture(display_codes(simulate(part, technique, bits).image))) for technique in techniques]
    return Crops((x, y), _picture(exact[y : y + part.height, x : x + part.width]), pictures)


def align(corner: tuple[int, int]) -> tuple[int, int]:
    """A corner moved back to a multiple of 8, so that patterns that repeat every few pixels (dithering) are the same in the crop."""
    return corner[0] // _PERIOD * _PERIOD, corner[1] // _PERIOD * _PERIOD


def window(scene: Any, x: int, y: int) -> Any:
    """The part of a scene from a corner on, at most 16x16 pixels, which renders exactly as it does within the whole."""
    width, height = min(EDGE, scene.width - x), min(EDGE, scene.height - y)
    whole = scene.shade

    def shade(triangle: NDArray[np.int32], column: NDArray[np.float64], row: NDArray[np.float64]) -> NDArray[np.float64]:
        colors: NDArray[np.float64] = whole(triangle, column + x, row + y)
        return colors

    triangles = scene.triangles - (x, y)
    return scene._replace(width=width, height=height, triangles=triangles, shade=shade if whole is not None else None)


def display_codes(linear: NDArray[Any]) -> NDArray[np.uint8]:
    """The 8-bit sRGB codes of linear RGB (IEC 61966-2-1); NaN is black."""
    import numpy as np

    light = np.clip(np.nan_to_num(linear[..., :3], nan=0.0), 0.0, 1.0)
    codes = np.where(light <= 0.0031308, light * 12.92, 1.055 * light ** (1 / 2.4) - 0.055)
    return np.asarray(np.floor(codes * 255 + 0.5), dtype=np.uint8)


def most_different(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> tuple[int, int]:
    """The corner (x, y) of the 16x16 pixels in which two pictures differ most; the first of equal ones."""
    import numpy as np

    difference = np.abs(one.astype(np.int64) - other.astype(np.int64)).sum(axis=2)
    height, width = difference.shape
    integral = np.zeros((height + 1, width + 1), dtype=np.int64)
    integral[1:, 1:] = difference.cumsum(axis=0).cumsum(axis=1)
    rows, columns = min(EDGE, height), min(EDGE, width)
    sums = integral[rows:, columns:] - integral[:-rows, columns:] - integral[rows:, :-columns] + integral[:-rows, :-columns]
    y, x = np.unravel_index(int(sums.argmax()), sums.shape)
    return int(x), int(y)


def short_name(technique: Technique) -> str:
    """A short name: `4x`, `4x/2` for two shaded samples, `SSAA 2x2`."""
    return f"{technique.samples}x/{technique.shaded}" if technique.kind == SAMPLE_SHADING else technique.name


def _picture(codes: NDArray[np.uint8]) -> Picture:
    height, width = codes.shape[:2]
    return Picture(width, height, codes.tobytes())

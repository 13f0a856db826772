"""Crops of a scene where techniques differ: the exact picture and the result of each technique."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.experiments.confirm.png import EDGE, Picture

from .points import MSAA, SAMPLE_SHADING, Technique

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .scenes.scene import Scene

_BAND = 128
"""Rows of the picture that are compared at once."""


class Crops(NamedTuple):
    """The same part of a scene by each technique, and exactly; `corner` is its left top pixel."""

    corner: tuple[int, int]
    exact: Picture
    pictures: Sequence[tuple[Technique, Picture]]


def crops(scene: Scene, techniques: Sequence[Technique], bits: int = 8) -> Crops:
    """The crops of at most 16x16 pixels in which the first technique differs most from the exact
    picture.

    Colors are as a display shows them: light beyond its white is mapped, and all is encoded as
    sRGB.
    """
    from .measure import truth
    from .scenes.part import Part
    from .simulate import simulate

    found = -1, 0, 0
    for top in range(0, max(scene.height - EDGE, 0) + 1, _BAND):
        # Bands overlap, so that every crop is within one of them.
        band = Part(0, top, scene.width, min(_BAND + EDGE - 1, scene.height - top))
        rendered, exact = (
            simulate(scene, techniques[0], bits, band).image,
            truth(scene, Technique(MSAA, 1), bits, band).image,
        )
        amount, x, y = most_different(shown(scene, rendered), shown(scene, exact))
        found = max(found, (amount, x, top + y), key=lambda crop: crop[0])
    part = Part(*found[1:], min(EDGE, scene.width), min(EDGE, scene.height))
    exact = truth(scene, Technique(MSAA, 1), bits, part).image
    pictures = [
        (technique, _picture(shown(scene, simulate(scene, technique, bits, part).image)))
        for technique in techniques
    ]
    return Crops((part.left, part.top), _picture(shown(scene, exact)), pictures)


def shown(scene: Scene, color: NDArray[Any]) -> NDArray[np.uint8]:
    """The 8-bit sRGB codes of resolved color; NaN is black."""
    import numpy as np

    from .displayed import display_codes

    codes = np.clip(np.nan_to_num(display_codes(scene, color), nan=0.0), 0.0, 1.0)
    return np.asarray(np.floor(codes * 255 + 0.5), dtype=np.uint8)


def most_different(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> tuple[int, int, int]:
    """By how much two pictures differ in the 16x16 pixels in which they differ most, and their
    corner (x, y); of equal ones the first.
    """
    import numpy as np

    difference = np.abs(one.astype(np.int64) - other.astype(np.int64)).sum(axis=2)
    height, width = difference.shape
    integral = np.zeros((height + 1, width + 1), dtype=np.int64)
    integral[1:, 1:] = difference.cumsum(axis=0).cumsum(axis=1)
    rows, columns = min(EDGE, height), min(EDGE, width)
    sums = (
        integral[rows:, columns:]
        - integral[:-rows, columns:]
        - integral[rows:, :-columns]
        + integral[:-rows, :-columns]
    )
    y, x = np.unravel_index(int(sums.argmax()), sums.shape)
    return int(sums.max()), int(x), int(y)


def short_name(technique: Technique) -> str:
    """A short name: `4x`, `4x/2` for two shaded samples, `SSAA 2x2`."""
    return (
        f"{technique.samples}x/{technique.shaded}"
        if technique.kind == SAMPLE_SHADING
        else technique.name
    )


def _picture(codes: NDArray[np.uint8]) -> Picture:
    height, width = codes.shape[:2]
    return Picture(width, height, codes.tobytes())

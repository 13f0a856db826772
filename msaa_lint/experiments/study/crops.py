"""Enlarged crops of a scene: the exact picture and the result of each technique, side by side, where they differ most."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from msaa_lint.experiments.confirm.png import EDGE, Picture, PictureFolder, enlarged

from .points import KINDS, MSAA, SAMPLE_SHADING, Technique

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_GAP = 8
_PERIOD = 8
_GRAY = b"\x80\x80\x80"

_DOT = 3
_GLYPHS = {
    "0": "75557", "1": "26227", "2": "71747", "3": "71717", "4": "55711", "5": "74717", "6": "74757", "7": "71111", "8": "75757",
    "9": "75717", "X": "55255", "S": "74717", "A": "75755", "E": "74747", "C": "74447", "T": "72222", "/": "11244", " ": "00000",
}  # fmt: skip
"""The letters of technique names: five rows, each an octal digit whose bits are three dots."""


def crops(album: PictureFolder, name: str, scene: Any, techniques: Sequence[Technique], bits: int = 8) -> str:
    """Writes one picture of a scene and returns its path.

    There is a row for each kind of technique, with the exact picture first and then the techniques in order, under their names (`4x/2` is
    4x with two samples shaded). Linear colors are clipped to [0, 1] and encoded as sRGB.
    """
    from .measure import truth
    from .simulate import simulate

    exact = display_codes(truth(scene, Technique(MSAA, 1), bits).image)
    # The first technique determines the crop; the others are rendered only there.
    corner = align(most_different(display_codes(simulate(scene, techniques[0], bits).image), exact))
    crop = window(scene, *corner)
    exact_crop = exact[corner[1] : corner[1] + crop.height, corner[0] : corner[0] + crop.width]
    rows: list[Picture] = []
    for kind in KINDS:
        of_kind = [technique for technique in techniques if technique.kind == kind]
        if of_kind:
            images = [exact_crop, *(display_codes(simulate(crop, technique, bits).image) for technique in of_kind)]
            labels = label_row(["exact", *map(short_name, of_kind)], crop.width * EDGE)
            rows += [labels, enlarged([_picture(image) for image in images], (0, 0))]
    return album.write(stack(rows), name, "crops")


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


def label_row(names: Sequence[str], label_width: int) -> Picture:
    """Names in white on gray, each in `label_width` pixels and clipped there, with the gap of enlarged pictures between them."""
    width = (label_width + _GAP) * len(names) - _GAP
    lines = []
    for row in range(5):
        line = bytearray(_GRAY * width)
        for number, name in enumerate(names):
            for place, letter in enumerate(name.upper()):
                bits = int(_GLYPHS.get(letter, "00000")[row], 8)
                for dot in (n for n in range(3) if bits >> (2 - n) & 1):
                    x = (place * 4 + dot) * _DOT
                    if x + _DOT <= label_width:
                        start = 3 * (number * (label_width + _GAP) + x)
                        line[start : start + 3 * _DOT] = b"\xff" * (3 * _DOT)
        lines += [bytes(line)] * _DOT
    return Picture(width, 5 * _DOT, b"".join(lines))


def _picture(codes: NDArray[np.uint8]) -> Picture:
    height, width = codes.shape[:2]
    return Picture(width, height, codes.tobytes())


def stack(rows: Sequence[Picture]) -> Picture:
    """Pictures below each other, aligned at the left."""
    width = max((row.width for row in rows), default=1)
    lines: list[bytes] = []
    for number, row in enumerate(rows):
        if number:
            lines.append(_GRAY * (width * _GAP))
        step = 3 * row.width
        lines += [row.rgb[n * step : (n + 1) * step] + _GRAY * (width - row.width) for n in range(row.height)]
    height = sum(row.height for row in rows) + _GAP * max(len(rows) - 1, 0)
    return Picture(width, height, b"".join(lines)) if rows else Picture(1, 1, _GRAY)

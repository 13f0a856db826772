"""Enlarged crops of a scene: the exact picture and what each technique makes of it, side by side, where they differ most."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from msaa_lint.experiments.confirm.png import EDGE, Album, Picture, enlarged

from .points import KINDS, MSAA, SAMPLE_SHADING, Technique

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_GAP = 8
_PERIOD = 8
_GREY = b"\x80\x80\x80"

_DOT = 3
_GLYPHS = {
    "0": "75557", "1": "26227", "2": "71747", "3": "71717", "4": "55711", "5": "74717", "6": "74757", "7": "71111", "8": "75757",
    "9": "75717", "X": "55255", "S": "74717", "A": "75755", "E": "74747", "C": "74447", "T": "72222", "/": "11244", " ": "00000",
}  # fmt: skip
"""Letters of names: five rows, each an octal digit whose bits are three dots."""


def crops(album: Album, name: str, scene: Any, techniques: Sequence[Technique], bits: int = 8) -> str:
    """Writes one picture of a scene and gives its path: a row for each kind of technique, the exact picture first in each, then the
    techniques in their order, under their names (`4x/2` is 4x, two of them shaded). Colours are as a display shows linear light: clipped to
    [0, 1], encoded by sRGB."""
    from .measure import truth
    from .simulate import simulated

    exact = displayed(truth(scene, Technique(MSAA, 1), bits).image)
    # Where to look, the first technique says; of the others nothing else is drawn.
    corner = aligned(most_different(displayed(simulated(scene, techniques[0], bits).image), exact))
    part = window(scene, *corner)
    cut = exact[corner[1] : corner[1] + part.height, corner[0] : corner[0] + part.width]
    rows: list[Picture] = []
    for kind in KINDS:
        own = [technique for technique in techniques if technique.kind == kind]
        if own:
            row = [cut, *(displayed(simulated(part, technique, bits).image) for technique in own)]
            parts = enlarged([_picture(each) for each in row], (0, 0))
            rows += [lettered(["exact", *map(short, own)], part.width * EDGE), parts]
    return album.write(stacked(rows), name, "crops")


def aligned(corner: tuple[int, int]) -> tuple[int, int]:
    """A corner a little before, so that patterns that repeat every few pixels (dithers) lie in the part as in the whole."""
    return corner[0] // _PERIOD * _PERIOD, corner[1] // _PERIOD * _PERIOD


def window(scene: Any, x: int, y: int) -> Any:
    """The part of a scene from a corner on, at most 16 pixels wide and high: drawn, it is what that part of the whole is."""
    width, height = min(EDGE, scene.width - x), min(EDGE, scene.height - y)
    whole = scene.shade

    def shade(triangle: NDArray[np.int32], across: NDArray[np.float64], down: NDArray[np.float64]) -> NDArray[np.float64]:
        made: NDArray[np.float64] = whole(triangle, across + x, down + y)
        return made

    triangles = scene.triangles - (x, y)
    return scene._replace(width=width, height=height, triangles=triangles, shade=shade if whole is not None else None)


def displayed(linear: NDArray[Any]) -> NDArray[np.uint8]:
    """Codes of linear RGB as a display takes them (IEC 61966-2-1); what is no number is black."""
    import numpy as np

    light = np.clip(np.nan_to_num(linear[..., :3], nan=0.0), 0.0, 1.0)
    codes = np.where(light <= 0.0031308, light * 12.92, 1.055 * light ** (1 / 2.4) - 0.055)
    return np.asarray(np.floor(codes * 255 + 0.5), dtype=np.uint8)


def most_different(one: NDArray[np.uint8], other: NDArray[np.uint8]) -> tuple[int, int]:
    """The corner (x, y) of the part, 16 pixels wide and high, in which two pictures differ most; the first of equal ones."""
    import numpy as np

    apart = np.abs(one.astype(np.int64) - other.astype(np.int64)).sum(axis=2)
    height, width = apart.shape
    above = np.zeros((height + 1, width + 1), dtype=np.int64)
    above[1:, 1:] = apart.cumsum(axis=0).cumsum(axis=1)
    high, wide = min(EDGE, height), min(EDGE, width)
    sums = above[high:, wide:] - above[:-high, wide:] - above[high:, :-wide] + above[:-high, :-wide]
    y, x = np.unravel_index(int(sums.argmax()), sums.shape)
    return int(x), int(y)


def short(technique: Technique) -> str:
    """A name for little room: `4x`, `4x/2` for two shaded samples, `SSAA 2x2`."""
    return f"{technique.samples}x/{technique.shaded}" if technique.kind == SAMPLE_SHADING else technique.name


def lettered(names: Sequence[str], wide: int) -> Picture:
    """Names in white on grey, each in so many pixels, what is longer cut, with the gap of enlarged pictures between."""
    width = (wide + _GAP) * len(names) - _GAP
    lines = []
    for row in range(5):
        line = bytearray(_GREY * width)
        for number, name in enumerate(names):
            for place, letter in enumerate(name.upper()):
                bits = int(_GLYPHS.get(letter, "00000")[row], 8)
                for dot in (n for n in range(3) if bits >> (2 - n) & 1):
                    x = (place * 4 + dot) * _DOT
                    if x + _DOT <= wide:
                        start = 3 * (number * (wide + _GAP) + x)
                        line[start : start + 3 * _DOT] = b"\xff" * (3 * _DOT)
        lines += [bytes(line)] * _DOT
    return Picture(width, 5 * _DOT, b"".join(lines))


def _picture(codes: NDArray[np.uint8]) -> Picture:
    height, width = codes.shape[:2]
    return Picture(width, height, codes.tobytes())


def stacked(rows: Sequence[Picture]) -> Picture:
    """Pictures below each other, from the left."""
    width = max((row.width for row in rows), default=1)
    lines: list[bytes] = []
    for number, row in enumerate(rows):
        if number:
            lines.append(_GREY * (width * _GAP))
        step = 3 * row.width
        lines += [row.rgb[n * step : (n + 1) * step] + _GREY * (width - row.width) for n in range(row.height)]
    height = sum(row.height for row in rows) + _GAP * max(len(rows) - 1, 0)
    return Picture(width, height, b"".join(lines)) if rows else Picture(1, 1, _GREY)

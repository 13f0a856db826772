"""The figure of `study --crops`: the same part of a scene, exactly and by each technique."""

from __future__ import annotations

from base64 import b64encode
from typing import Any

from msaa_lint.experiments.confirm.png import Picture, png
from msaa_lint.experiments.study.crops import Crops, short_name
from msaa_lint.experiments.study.points import KINDS

from .escape import display
from .figure import GRID, Figure, Spec, title
from .study_panels import abbreviation

_COLUMNS = 6
"""The exact picture, and five techniques."""

_SIDE, _GAP, _NAME = 96, 8, 16
"""The width of a crop, and what is free beside and above it, in pixels."""


def crops_figure(scene: str, crops: Crops) -> Spec:
    """The figure of a scene. There are rows for each kind of technique, and the exact picture is
    the first of each row.
    """
    import altair

    cells = _cells(crops)
    columns, rows = (1 + max(cell[axis] for cell in cells) for axis in ("column", "row"))
    x = altair.X(
        "x:Q", axis=None, scale=altair.Scale(domain=[0, columns * (_SIDE + _GAP)], nice=False)
    )
    y = altair.Y(
        "y:Q", axis=None, scale=altair.Scale(domain=[rows * (_SIDE + _NAME + _GAP), 0], nice=False)
    )
    figure = Figure()
    chart = figure.chart(cells)
    layers = [
        # Pixels are not blended.
        chart.mark_image(
            width=_SIDE, height=_SIDE, align="left", baseline="top", smooth=False, aria=False
        ).encode(x, y, url="url:N"),
        chart.mark_rect(filled=False, stroke=GRID, aria=False).encode(
            x, y, x2="right", y2="bottom"
        ),
        chart.mark_text(align="left", baseline="bottom", dy=-3).encode(x, y, text="name:N"),
    ]
    panel = altair.layer(*layers).properties(
        width=columns * (_SIDE + _GAP),
        height=rows * (_SIDE + _NAME + _GAP),
        view=altair.ViewBackground(stroke=None),
    )
    lines = [crops_place(crops), *abbreviation(technique for technique, _ in crops.pictures)]
    figure.add([panel], title(display(scene), lines, columns * (_SIDE + _GAP), size=13))
    return figure.spec()


def crops_place(crops: Crops) -> str:
    """Where the crops are in the picture, and why there."""
    (left, top), exact = crops.corner, crops.exact
    place = (
        f"pixels {left} to {left + exact.width - 1} from the left, {top} to "
        f"{top + exact.height - 1} from the top"
    )
    return f"{place}: where {short_name(crops.pictures[0][0])} differs most"


def crop_rows(crops: Crops) -> list[list[tuple[str, Picture]]]:
    """The named pictures in rows for each kind of technique, each of which the exact one begins."""
    rows = []
    for kind in KINDS:
        of_kind = [
            (short_name(technique), picture)
            for technique, picture in crops.pictures
            if technique.kind == kind
        ]
        starts = range(0, len(of_kind), _COLUMNS - 1)
        rows += [
            [("exact", crops.exact), *of_kind[start : start + _COLUMNS - 1]] for start in starts
        ]
    return rows


def _cells(crops: Crops) -> list[dict[str, Any]]:
    """The pictures, their names, and the places of both."""
    cells: list[dict[str, Any]] = []
    for row, pictures in enumerate(crop_rows(crops)):
        for column, (name, picture) in enumerate(pictures):
            x, y = column * (_SIDE + _GAP), row * (_SIDE + _NAME + _GAP) + _NAME
            place = {
                "column": column,
                "row": row,
                "x": x,
                "y": y,
                "right": x + _SIDE,
                "bottom": y + _SIDE,
            }
            cells.append({"name": name, **place, "url": _url(picture)})
    return cells


def _url(picture: Picture) -> str:
    return f"data:image/png;base64,{b64encode(png(picture)).decode()}"

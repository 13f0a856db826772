"""Figures: Vega-Lite specifications as files.

Specifications are built by altair and drawn by vl-convert, without a browser, the network, or
anything that a user configures. The same specification always gives the same bytes: vl-convert
brings the font with it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

FORMATS = ("svg", "png", "json")
"""Pictures, and the Vega-Lite specification itself."""

Spec = dict[str, Any]
"""A Vega-Lite specification with its data inline."""

FONT = "Liberation Sans, Arial, Helvetica, sans-serif"
"""vl-convert brings the first one; the next ones have letters of the same widths, for whoever shows
the SVG.
"""

INK, GRID = "#222222", "#DDDDDD"
FONT_SIZE = 10
"""Of axes and labels, in pixels."""

_CONFIG: Spec = {
    "font": FONT,
    "axis": {
        "domainColor": INK, "gridColor": GRID, "labelColor": INK, "labelFontSize": FONT_SIZE,
        "labelLimit": 400, "tickColor": INK,
        "titleColor": INK, "titleFontSize": FONT_SIZE, "titleFontWeight": "normal",
    },
    "axisQuantitative": {"labelExpr": "format(datum.value, '~g')"},
    "legend": {"direction": "horizontal", "labelColor": INK, "labelFontSize": FONT_SIZE,
    "orient": "bottom", "title": None},
    "text": {"color": INK, "fontSize": FONT_SIZE},
    "title": {
        "anchor": "start", "color": INK, "fontSize": 12, "frame": "bounds", "subtitleColor": INK,
        "subtitleFontSize": FONT_SIZE,
        "subtitlePadding": 4,
    },
    "view": {"stroke": GRID},
}  # fmt: skip

_WIDTHS = {
    0.28: "ijltf.,:;/ '|![]",
    0.34: "r()-`\"",
    0.56: "abcdeghknopqsuvxyz0123456789_LJ$#?+=<>~",
    0.95: "mwMW%",
    1.02: "@",
}  # fmt: skip
"""The greatest width of letters in the figures' font, in font sizes."""

_BOLD = 1.12
"""How much wider bold letters are, at most on average."""

_SCALE = 2.0
"""Pixels of a PNG per pixel of a figure."""


_MAX_LINES = 3
"""Of a text in a title; of a longer one, the middle is left out."""


def title(text: str, lines: Sequence[str], width: float, *, size: int) -> Spec:
    """A title with further lines below it, all broken at a width in pixels."""
    below = [part for line in lines for part in wrapped(line, width / FONT_SIZE)]
    # Bold letters are wider.
    return {
        "text": wrapped(text, width / size / _BOLD),
        "subtitle": below,
        "fontSize": size,
        "limit": width,
        "offset": 8,
    }


def wrapped(text: str, width: float) -> list[str]:
    """The lines of a text, none wider than `width` font sizes: broken after spaces and the
    separators of paths, else anywhere.
    """
    lines, room = [""], width
    for piece in re.findall(r"[^ /_-]*[ /_-]|[^ /_-]+", text):
        if sum(map(_width, piece.rstrip())) > room and lines[-1]:
            lines.append("")
            room = width
        for letter in piece:
            if _width(letter) > room and letter != " ":
                lines.append("")
                room = width
            lines[-1] += letter
            room -= _width(letter)
    if len(lines) > _MAX_LINES:
        # The end of a path is its file's name.
        lines = [f"{lines[0][:-2]}…", *lines[1 - _MAX_LINES :]]
    return [line.rstrip() for line in lines]


def _width(letter: str) -> float:
    """The width of a letter of the figures' font, or more, in font sizes."""
    return next(
        (width for width, letters in _WIDTHS.items() if letter in letters),
        0.78 if letter.isascii() else 1.0,
    )


class Figure:
    """Charts below each other, with their data."""

    def __init__(self) -> None:
        self._parts: list[Spec] = []
        self._data: dict[str, list[dict[str, Any]]] = {}

    def chart(self, rows: list[dict[str, Any]]) -> Any:
        """An altair chart of these rows. They are kept here, because altair copies what is within a
        chart many times.
        """
        import altair

        name = f"data-{len(self._data)}"
        self._data[name] = rows
        return altair.Chart(altair.NamedData(name))

    def add(
        self, panels: Sequence[Any], heading: Spec, *, columns: int = 1, spacing: int = 0
    ) -> None:
        """Adds panels, which are altair charts, in rows from left to right under a heading."""
        # altair has validated each part when it was made.
        specs = [panel.to_dict(validate=False) for panel in panels]
        kept = [
            {key: value for key, value in spec.items() if key not in ("$schema", "config")}
            for spec in specs
        ]
        self._parts.append(
            {"concat": kept, "columns": columns, "spacing": spacing, "title": heading}
        )

    def spec(self) -> Spec:
        """The specification, in the style of all figures."""
        import altair

        apart = {"scale": {"color": "independent", "shape": "independent"}}
        return {
            "$schema": altair.SCHEMA_URL, "background": "white", "padding": 8, "config": _CONFIG,
            "spacing": 24, "resolve": apart,
            "vconcat": self._parts, "datasets": self._data,
        }  # fmt: skip


def draw(spec: Spec, format: str) -> bytes:
    """A specification as SVG, PNG, or JSON. ModuleNotFoundError if the extra `chart` is not
    installed.
    """
    if format == "json":
        import json

        return (json.dumps(spec, indent=1, allow_nan=False) + "\n").encode()
    import vl_convert

    # Data is inline, so nothing is loaded from anywhere.
    if format == "png":
        return vl_convert.vegalite_to_png(spec, scale=_SCALE, allowed_base_urls=[])
    return vl_convert.vegalite_to_svg(spec, allowed_base_urls=[]).encode()


def vega_bundle() -> str:
    """The script with which a page draws specifications: Vega, Vega-Lite, and Vega-Embed, with the
    interpreter of expressions that a Content-Security-Policy without `unsafe-eval` needs.
    """
    import vl_convert

    return str(vl_convert.javascript_bundle("window.vegaEmbed = vegaEmbed;"))

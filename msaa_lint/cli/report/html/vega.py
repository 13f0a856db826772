"""Figures in a page: an SVG picture that needs no script, and the specification and the scripts
with which Vega draws it there.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from typing import Any

from markupsafe import Markup

from ..figure import Spec, draw, vega_bundle
from .page import asset

Rows = list[dict[str, Any]]

DIGITS = 5
"""Significant digits of numbers that are drawn."""


class PageFigures:
    """The figures of a page. Templates draw them by number; `data` is what the script `vega.js`
    reads.
    """

    def __init__(self) -> None:
        self.data: list[dict[str, Any]] = []

    def add(self, spec: Spec, name: str) -> dict[str, Any]:
        """Adds a figure; returns what the template `figure` of `figures.html` takes."""
        return {
            **self.add_moving(spec, name),
            "picture": data_url(draw(spec, "svg"), "image/svg+xml"),
        }

    def add_moving(self, spec: Spec, name: str, **states: Any) -> dict[str, Any]:
        """Adds a figure without a picture: `states` are what its slider shows."""
        self.data.append({"spec": spec, **states})
        return {"number": len(self.data) - 1, "name": name}

    @property
    def scripts(self) -> tuple[str, ...]:
        """Vega, once, and what draws the figures with it; nothing for a page without figures."""
        return (vega_bundle(), asset("vega.js")) if self.data else ()


def data_url(data: bytes, kind: str) -> Markup:
    """A file inside the page: letters and digits, of which nothing is escaped or cut."""
    return Markup(f"data:{kind};base64,{b64encode(data).decode()}")


def columns(rows: Rows) -> dict[str, list[Any]]:
    """Rows by column, where they take a fraction of the room; a row without a value has null."""
    names: Mapping[str, None] = {name: None for row in rows for name in row}
    return {name: [_short(row.get(name)) for row in rows] for name in names}


def _short(value: object) -> object:
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value


def data_names(spec: Spec) -> Sequence[str]:
    """The names of a specification's data, in the order in which they were added."""
    return list(spec["datasets"])

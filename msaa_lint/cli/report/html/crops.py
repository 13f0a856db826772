"""The pictures of `study --crops` inside the page."""

from __future__ import annotations

from typing import Any

from msaa_lint.experiments.confirm.png import Picture, png
from msaa_lint.experiments.study.outcome import Study

from ..study_crops import crop_rows, crops_place
from .vega import data_url

MAX_PICTURES = 2000
"""Of a page, of at most 1.2 kB each: a browser decodes them all when it prints."""

_SCALE = 6
"""CSS pixels per pixel."""


def page_crops(study: Study) -> dict[str, dict[str, Any]]:
    """What the template shows of each scene with crops. Of scenes without room for all their
    pictures, it says so.
    """
    room, shown = MAX_PICTURES, {}
    for name, crops in study.crops.items():
        rows = [
            [_picture(title, picture, crops.exact) for title, picture in row]
            for row in crop_rows(crops)
        ]
        room -= sum(map(len, rows))
        left_out = (
            f"A page has at most {MAX_PICTURES} pictures; those of this scene are in the "
            "folder of --crops."
        )
        shown[name] = {
            "text": crops_place(crops) if room >= 0 else left_out,
            "rows": rows if room >= 0 else [],
        }
    return shown


def _picture(name: str, picture: Picture, exact: Picture) -> dict[str, Any]:
    difference = max(abs(one - other) for one, other in zip(picture.rgb, exact.rgb, strict=True))
    said = (
        f"differs from the exact pixels by up to {difference} of 255"
        if difference
        else "the same as the exact pixels"
    )
    return {
        "name": name,
        "alt": "The exact pixels" if picture is exact else f"{name}: {said}",
        "url": data_url(png(picture), "image/png"),
        "width": picture.width * _SCALE,
        "height": picture.height * _SCALE,
    }

"""Scenes by name, each with the effects that it calls for and the exact picture. Importing this needs no NumPy; making a scene does."""

from __future__ import annotations

import difflib
from importlib import import_module
from typing import TYPE_CHECKING

from .scene import Scene

if TYPE_CHECKING:
    from msaa_lint.frame.facts.frame import Frame

_TABLE: tuple[tuple[str, str, str, str], ...] = (
    ("edge-fan", "edges", "edge_fan", "edges at all angles, uniformly"),
    ("near-horizontal", "edges", "near_horizontal", "edges with slopes below 1/16, where steps are longest"),
    ("wires", "edges", "wires", "lines of 0.1 to 2 pixels, which drop out between samples"),
    ("siemens-star", "edges", "siemens_star", "wedges that become finer than pixels towards the middle"),
    ("zone-plate", "detail", "zone_plate", "detail within triangles, which samples of coverage cannot help"),
    ("foliage", "detail", "foliage", "leaves cut out by an alpha test"),
    ("foliage-to-coverage", "detail", "foliage_to_coverage", "the same leaves by alpha to coverage"),
    ("hdr-emitter", "light", "emitter", "light far above display white on black, tone mapped after the resolve"),
    ("hdr-emitter-before", "light", "emitter_before", "the same light, tone mapped before the resolve"),
    ("hdr-emitter-weighted", "light", "emitter_weighted", "the same light, samples weighted by 1 / (1 + luma)"),
    ("glass", "light", "glass", "panes of glass over one another, blended"),
    ("intersecting", "depth", "intersecting", "surfaces that cross in depth, standard"),
    ("intersecting-reversed", "depth", "intersecting_reversed", "the same surfaces with reversed depth"),
    ("intersecting-far", "depth", "intersecting_far", "surfaces that cross far away, standard depth"),
    ("intersecting-far-reversed", "depth", "intersecting_far_reversed", "the same far surfaces with reversed depth"),
    ("silhouette", "depth", "silhouette", "a near surface before a far one, whose depth is resolved"),
    ("portal", "depth", "portal", "an edge that is in stencil alone"),
    ("mesh", "edges", "mesh", "a watertight mesh in many colours, every edge shared"),
)

SAYS: dict[str, str] = {name: says for name, _, _, says in _TABLE}
"""By the name of a scene: what it shows."""

_MADE = {name: (module, function) for name, module, function, _ in _TABLE}

NAMES: tuple[str, ...] = tuple(SAYS)


def scene(name: str, width: int, height: int) -> Scene:
    """The scene of that name in a picture of width x height pixels. LookupError, with the nearest name, where there is none; ValueError
    where the picture is too small to show it."""
    if name not in _MADE:
        near = difflib.get_close_matches(name, NAMES, 1)
        hint = f"did you mean {near[0]}?" if near else f"scenes are {', '.join(NAMES)}"
        raise LookupError(f"no scene is called {name}; {hint}")
    if width < LEAST or height < LEAST:
        raise ValueError(f"{width}x{height} pixels are too few: scenes are at least {LEAST} wide and high")
    module, function = _MADE[name]
    made: Scene = getattr(import_module(f"{__name__}.{module}"), function)(width, height)
    return made._replace(name=name, says=SAYS[name])


LEAST = 32
"""Pixels of a picture's width and height at least."""


def from_mesh(path: str, width: int, height: int) -> Scene:
    """A user's own triangles, of an OBJ or PLY file (scenes/own.py)."""
    from .mesh import from_mesh as made

    return made(path, width, height)


def from_description(frame: Frame, width: int, height: int) -> Scene:
    """What a description's `scene` and pipelines call for (scenes/described.py)."""
    from .from_description import from_description as made

    return made(frame, width, height)

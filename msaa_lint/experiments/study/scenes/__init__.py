"""Scenes by name, each with its effects and its exact picture. Importing this needs no NumPy;
making a scene does.
"""

from __future__ import annotations

from importlib import import_module

from msaa_lint.core.suggestions import nearest

from .scene import Scene, check_size

_TABLE: tuple[tuple[str, str, str, str], ...] = (
    ("edge-fan", "edges", "edge_fan", "edges at all angles, evenly distributed"),
    (
        "near-horizontal",
        "edges",
        "near_horizontal",
        "edges with slopes below 1/16, where steps are longest",
    ),
    ("wires", "edges", "wires", "lines 0.1 to 2 pixels wide, which fall between samples"),
    (
        "siemens-star",
        "edges",
        "siemens_star",
        "wedges that become narrower than a pixel toward the center",
    ),
    (
        "zone-plate",
        "detail",
        "zone_plate",
        "detail inside triangles, which coverage samples cannot smooth",
    ),
    ("foliage", "detail", "foliage", "leaves cut out by an alpha test"),
    (
        "foliage-to-coverage",
        "detail",
        "foliage_to_coverage",
        "the same leaves with alpha to coverage",
    ),
    (
        "hdr-emitter",
        "light",
        "emitter",
        "light far above display white on black, tone mapped after the resolve",
    ),
    (
        "hdr-emitter-before",
        "light",
        "emitter_before",
        "the same light, tone mapped before the resolve",
    ),
    (
        "hdr-emitter-weighted",
        "light",
        "emitter_weighted",
        "the same light, samples weighted by 1 / (1 + luma)",
    ),
    ("glass", "light", "glass", "overlapping panes of glass, blended"),
    ("intersecting", "depth", "intersecting", "intersecting surfaces, standard depth"),
    (
        "intersecting-reversed",
        "depth",
        "intersecting_reversed",
        "the same surfaces with reversed depth",
    ),
    (
        "intersecting-far",
        "depth",
        "intersecting_far",
        "distant intersecting surfaces, standard depth",
    ),
    (
        "intersecting-far-reversed",
        "depth",
        "intersecting_far_reversed",
        "the same distant surfaces with reversed depth",
    ),
    (
        "silhouette",
        "depth",
        "silhouette",
        "a near surface in front of a far one, with depth resolved",
    ),
    ("portal", "depth", "portal", "an edge that exists in stencil alone"),
    ("mesh", "edges", "mesh", "a watertight mesh in many colors, every edge shared"),
)

DESCRIPTIONS: dict[str, str] = {name: description for name, _, _, description in _TABLE}
"""By the name of a scene: what it shows."""

_FACTORIES = {name: (module, function) for name, module, function, _ in _TABLE}

NAMES: tuple[str, ...] = tuple(DESCRIPTIONS)


def scene(name: str, width: int, height: int) -> Scene:
    """The scene of that name in a picture of width x height pixels. LookupError, with the nearest
    name, for an unknown one; ValueError for a picture that is too small.
    """
    if name not in _FACTORIES:
        close = nearest(name, NAMES)
        hint = f"did you mean `{close}`?" if close else f"the scenes are {', '.join(NAMES)}"
        raise LookupError(f"unknown scene `{name}`: {hint}")
    check_size(width, height)
    module, function = _FACTORIES[name]
    made: Scene = getattr(import_module(f"{__name__}.{module}"), function)(width, height)
    return made._replace(name=name, description=DESCRIPTIONS[name])

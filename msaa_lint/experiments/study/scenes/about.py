"""What a scene is about: by that its techniques are compared (study/measures.py)."""

from __future__ import annotations

from .scene import Scene

HDR, THIN_LINES, ALPHA, TEXTURE, EDGES = "hdr", "thin lines", "alpha", "texture", "edges"

THIN = 2.0
"""A line that is at most this wide, in pixels, falls between samples here and there, and flickers
as it moves.
"""

MIN_ELONGATION = 4.0
"""A triangle is part of a line if it is at least this many times as long as high; small triangles
of a mesh are not.
"""


def about(scene: Scene) -> tuple[str, ...]:
    """What the picture shows besides edges, by its effects, its shading, and its triangles; edges
    where that is nothing.
    """
    matters = [
        (HDR, not {"hdr", "tone-mapping"}.isdisjoint(scene.effects)),
        (ALPHA, not {"alpha-test", "alpha-to-coverage"}.isdisjoint(scene.effects)),
        (
            TEXTURE,
            scene.shade is not None
            and {"alpha-test", "alpha-to-coverage"}.isdisjoint(scene.effects),
        ),
        (THIN_LINES, scene.shade is None and _has_thin_lines(scene)),
    ]
    return tuple(name for name, applies in matters if applies) or (EDGES,)


def _has_thin_lines(scene: Scene) -> bool:
    """Whether at least half of the picture's triangles, by their lengths, are parts of thin
    lines.
    """
    import numpy as np

    sides = np.roll(scene.triangles, -1, axis=1) - scene.triangles
    lengths = np.hypot(sides[..., 0], sides[..., 1]).max(axis=1, initial=0.0)
    areas = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
    drawn = (areas > 0) & (lengths > 0)
    heights = areas[drawn] / lengths[drawn]
    thin = (heights <= THIN) & (lengths[drawn] >= MIN_ELONGATION * heights)
    return bool(lengths[drawn][thin].sum() * 2 >= lengths[drawn].sum() > 0)

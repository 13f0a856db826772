"""The scene that `confirm` draws: overlapping triangles at different depths, with edges at many
angles.

Every triangle has its own color (shaders/scene.vert). The first one is a backdrop behind all others
that covers every pixel.
"""

from __future__ import annotations

import struct

GRID = 128
"""Corners lie on a grid of 1/128 of half the picture, in x and y."""

DEPTHS = 256
"""Depths lie on a grid of 1/256."""

CORNERS = (
    (-128, -128, 250), (384, -128, 250), (-128, 384, 250),
    (36, 0, 16), (10, 10, 16), (7, -14, 16),
    (15, 63, 86), (-51, 22, 86), (-2, -24, 86),
    (-8, 7, 156), (-13, -51, 156), (36, -43, 156),
    (-1, 43, 46), (27, 17, 46), (42, 46, 46),
    (-101, -40, 116), (-15, -26, 116), (-45, 43, 116),
    (36, -76, 186), (68, -17, 186), (12, -3, 186),
    (10, 29, 76), (-9, 72, 76), (-41, 46, 76),
    (-7, -50, 146), (-34, -44, 146), (-34, -68, 146),
    (88, 71, 36), (28, 22, 36), (82, -18, 36),
    (-78, 65, 106), (-76, 7, 106), (-28, 21, 106),
    (3, -56, 176), (34, -79, 176), (46, -48, 176),
    (-29, 32, 66), (54, 56, 66), (16, 121, 66),
    (-67, -88, 136), (-43, -25, 136), (-100, -18, 136),
    (105, -39, 26), (81, 2, 26), (52, -28, 26),
    (-28, 73, 96), (-55, 76, 96), (-52, 52, 96),
    (12, -33, 166), (-42, -88, 166), (16, -121, 166),
    (47, 94, 56), (56, 37, 56), (101, 56, 56),
    (-118, 8, 126), (-85, -10, 126), (-77, 21, 126),
)  # fmt: skip
"""By vertex: x to the right and y down from the center of the picture, and depth; three vertices
form a triangle.
"""

BACKDROP = 3
"""The number of vertices of the backdrop, which come first."""

VERTEX_BYTES = 12

CLEARED = (0.125, 0.25, 0.5, 1.0)
CLEARED_INTEGERS = (3, 5, 7, 11)
CLEARED_STENCIL, DRAWN_STENCIL = 0, 1
"""The clear values of color attachments, of integer color attachments and of stencil, and the
stencil value that the scene writes.
"""

POISON = (0.8125, 0.0625, 0.6875, 0.0)
POISON_INTEGER = 99
POISON_DEPTH, POISON_STENCIL = 0.0, 0xA5
"""What undefined contents are overwritten with: a purple that the scene neither draws nor clears
to, the components of integer colors, the nearest depth (with reversed depth, 1 minus it), and
stencil.
"""


def vertices() -> bytes:
    """The vertices in the input format of shaders/scene.vert: the position in clip coordinates as
    three 32-bit floats.
    """
    return b"".join(struct.pack("<3f", x / GRID, y / GRID, z / DEPTHS) for x, y, z in CORNERS)

"""A part of a picture. Importing this needs no NumPy."""

from typing import NamedTuple


class Part(NamedTuple):
    """A window of a picture: its left column, its top row, its width and its height in pixels,
    where the scene has moved by (dx, dy) pixels. What belongs to the screen (sample locations,
    dithering) has not moved.
    """

    left: int
    top: int
    width: int
    height: int
    dx: float = 0.0
    dy: float = 0.0

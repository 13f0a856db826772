"""Descriptions: every list of the format, many of what rules look at, wrong names, fixes and prices."""

from __future__ import annotations

from .shape import Shape, text

FRAME = "frame: {width: 64, height: 64, fps: 60}\n"
COLOR = "{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}"


def images(count: int) -> str:
    """Images that no pass uses."""
    return FRAME + "images:\n" + "".join(f"  i{number}: {COLOR}\n" for number in range(count)) + "renderPasses: {}\n"


SHAPES = (Shape("images", text("a.msaa.yaml", images)),)

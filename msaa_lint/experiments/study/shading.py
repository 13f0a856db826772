"""The cost of shading, under which techniques are timed: what a fragment shader invocation does besides writing a color."""

from __future__ import annotations

from typing import NamedTuple

NONE, LIGHT, MEDIUM, HEAVY = "none", "light", "medium", "heavy"


class Shading(NamedTuple):
    """A cost of shading.

    An invocation executes `operations` multiply-adds, each of which needs the result of the previous one, and `fetches` texture fetches of
    four bytes each, spread over `footprint` bytes. `name` is the one in reports: `medium`, `200ops`, a shader's file. As calibrated on the
    device, a million invocations take `nanoseconds`, and a full screen with one invocation per pixel takes `full_screen_ms` longer than
    without shading; None where it was not calibrated.
    """

    name: str
    operations: int = 0
    fetches: int = 0
    footprint: int = 0
    nanoseconds: float | None = None
    full_screen_ms: float | None = None

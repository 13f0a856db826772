"""The cost of shading, under which techniques are timed: what a fragment shader invocation does
besides writing a color.
"""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.frame.description.scalars import SHADING_LEVELS, shading_cost

NONE, LIGHT, MEDIUM, HEAVY = SHADING_LEVELS

DEFAULT = (NONE, MEDIUM, HEAVY)
"""The costs of a study that names none: bound by fill, balanced, bound by shading."""

FRAME_MS = 1000 / 60
"""The milliseconds of a frame at 60 Hz."""

SHARES = {NONE: 0.0, LIGHT: 1 / 16, MEDIUM: 1 / 4, HEAVY: 3 / 4}
"""The share of a frame that shading a full screen at one sample takes, by level."""

FETCHES = {NONE: 0, LIGHT: 1, MEDIUM: 4, HEAVY: 8}
"""The texture fetches of an invocation, by level: an albedo; a material of four textures; with
shadows and environment, eight. They count towards the level's share.
"""

FOOTPRINT = 16 << 20
"""The bytes that fetches are spread over: four textures of 1024x1024 texels of 4 bytes."""


class Shading(NamedTuple):
    """A cost of shading.

    An invocation executes `operations` multiply-adds, each of which needs the result of the
    previous one, and `fetches` texture fetches of four bytes each, spread over `footprint` bytes.
    `name` is the one in reports: `medium`, `200ops`, a shader's file. As calibrated on the device,
    a million invocations take `nanoseconds`, and a full screen with one invocation per pixel takes
    `full_screen_ms` longer than without shading; None where it was not calibrated.
    """

    name: str
    operations: int = 0
    fetches: int = 0
    footprint: int = 0
    nanoseconds: float | None = None
    full_screen_ms: float | None = None


class Target(NamedTuple):
    """A cost to calibrate: `added_ms` is the time that it adds to a full screen, None for a stated
    number of operations.
    """

    shading: Shading
    added_ms: float | None


def target(name: str, size: tuple[int, int]) -> Target:
    """The cost of a name (scalars.shading_cost) for pictures of a size in pixels. ValueError for
    another name.
    """
    canonical = shading_cost(name)
    if canonical is None:
        raise ValueError(name)
    if canonical in SHARES:
        fetches = FETCHES[canonical]
        return Target(
            Shading(canonical, 0, fetches, FOOTPRINT if fetches else 0),
            SHARES[canonical] * FRAME_MS,
        )
    number, unit = (
        float(canonical[:-3] if canonical.endswith("ops") else canonical[:-2]),
        canonical.lstrip("0123456789.e+"),
    )
    if unit == "ops":
        return Target(Shading(canonical, int(number)), None)
    return Target(
        Shading(canonical), number if unit == "ms" else number * 1e-12 * size[0] * size[1]
    )


MAX_OFF = 0.05
"""The share of its time by which a level may miss it without a word."""


def missed(shading: Shading) -> str:
    """What share of a frame a level takes on the device that it was calibrated on, where that is
    not the one it stands for; else empty.
    """
    share = SHARES.get(shading.name, 0.0)
    if (
        shading.full_screen_ms is None
        or not share
        or abs(shading.full_screen_ms / FRAME_MS - share) <= MAX_OFF * share
    ):
        return ""
    return (
        f"{shading.full_screen_ms / FRAME_MS:.1%} of a frame at 60 Hz, not {share:.1%}: no "
        "nearer cost was found on this device"
    )


def calibrated(shading: Shading, added_ms: float, size: tuple[int, int]) -> Shading:
    """The cost, where it adds a time to a full screen of a size in pixels."""
    added = max(added_ms, 0.0)
    return shading._replace(nanoseconds=added * 1e12 / (size[0] * size[1]), full_screen_ms=added)

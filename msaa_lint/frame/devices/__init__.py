"""Devices: what they support, and the built-in profiles that a description can name."""

from functools import cache
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from .tile_models import TileModel


class DeviceProfile(NamedTuple):
    """What a device supports. None is unknown, never "nothing".

    Enumerants have canonical short names (`SAMPLE_ZERO`, `LAZILY_ALLOCATED`); features and
    extensions have Vulkan's full names. `minimum` marks a class of devices: the profile has what
    all of them guarantee, and what it does not list is not guaranteed.

    `tile` is the model of its tile sizes, `compression` the measured traffic relative to plain
    arithmetic by sample count (reads, writes), of images that it may compress; `compression_most`
    what was measured at most of any image, None where `compression` is no range;
    `milliwatts_per_gbps` the power of 10^9 bytes per second of external memory traffic, `source`
    the origin of the facts. `builtin_profiles.py` says which features and extensions built-in
    profiles record.
    """

    name: str
    vendor: str | None = None
    tiler: bool | None = None
    color_samples: tuple[int, ...] | None = None
    depth_samples: tuple[int, ...] | None = None
    stencil_samples: tuple[int, ...] | None = None
    integer_samples: tuple[int, ...] | None = None
    memory_types: tuple[tuple[str, ...], ...] | None = None
    depth_resolve_modes: tuple[str, ...] | None = None
    stencil_resolve_modes: tuple[str, ...] | None = None
    independent_resolve: bool | None = None
    independent_resolve_none: bool | None = None
    features: tuple[str, ...] | None = None
    extensions: tuple[str, ...] | None = None
    api_version: str | None = None
    max_efficient_samples: int | None = None
    minimum: bool = False
    source: str = ""
    tile: "TileModel | None" = None
    compression: dict[int, tuple[float, float]] | None = None
    compression_most: tuple[float, float] | None = None
    milliwatts_per_gbps: float | None = None


def sample_counts(mask: int) -> tuple[int, ...]:
    """The counts in a VkSampleCountFlags mask in ascending order: (1, 4, 8) for 13. Unknown bits
    are left out.
    """
    return tuple(count for count in (1, 2, 4, 8, 16, 32, 64) if mask & count)


def names() -> tuple[str, ...]:
    """The names of the built-in profiles."""
    from .builtin_profiles import PROFILES

    return tuple(PROFILES)


def builtin(name: str) -> DeviceProfile | None:
    """The built-in profile of a name, which is case-sensitive; None if there is none."""
    from .builtin_profiles import PROFILES

    return _profile(name) if name in PROFILES else None


@cache
def _profile(name: str) -> DeviceProfile:
    from msaa_lint.frame.vulkan.names import flag_names

    from .builtin_profiles import EFFICIENT, PROFILES
    from .tile_models import MODELS
    from .vendors import is_tiler

    row = PROFILES[name]
    vendor = row["vendor"]
    color, depth, stencil, integer = row["counts"]
    depth_modes, stencil_modes, independent, independent_none = row["resolve"]
    memory = row.get("memory")
    return DeviceProfile(
        name=row["name"],
        vendor=vendor,
        tiler=row.get("tiler", is_tiler(vendor)),
        color_samples=sample_counts(color),
        depth_samples=sample_counts(depth),
        stencil_samples=sample_counts(stencil),
        integer_samples=None if integer is None else sample_counts(integer),
        memory_types=None
        if memory is None
        else tuple(tuple(flag_names("VkMemoryPropertyFlagBits", mask) or ()) for mask in memory),
        depth_resolve_modes=tuple(flag_names("VkResolveModeFlagBits", depth_modes) or ()),
        stencil_resolve_modes=tuple(flag_names("VkResolveModeFlagBits", stencil_modes) or ()),
        independent_resolve=independent,
        independent_resolve_none=independent_none,
        features=("sampleRateShading",) if row.get("sample_rate_shading", True) else (),
        extensions=row["extensions"],
        api_version=row["api"],
        max_efficient_samples=row.get("efficient", 4 if vendor in EFFICIENT else None),
        minimum=row.get("minimum", False),
        source=row["source"] + EFFICIENT.get(vendor, "") + row.get("hardware", ""),
        tile=MODELS.get(row.get("tile", "")),
        compression=row.get("compression"),
        compression_most=row.get("compression_most"),
    )

"""Devices: what one offers, and the built-in profiles that a description names."""

from __future__ import annotations

from typing import NamedTuple


class DeviceProfile(NamedTuple):
    """What a device offers. None is unknown, never "nothing".

    Names are canonical short ones (`SAMPLE_ZERO`, `LAZILY_ALLOCATED`); features and extensions are Vulkan's whole names. `features` and
    `extensions` of a built-in profile are those that bear on multisampling and rendering. `minimum` marks a class of devices: it holds what
    all of them guarantee, and what it does not list is "not guaranteed" rather than "not offered". `source` says where the facts are from.
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


def sample_counts(mask: int) -> tuple[int, ...]:
    """The counts of a VkSampleCountFlags mask, rising: (1, 4, 8) of 13. Unknown bits are left out."""
    return tuple(count for count in (1, 2, 4, 8, 16, 32, 64) if mask & count)


def names() -> tuple[str, ...]:
    """The names of the built-in profiles."""
    from .builtin import PROFILES

    return tuple(PROFILES)


def builtin(name: str) -> DeviceProfile | None:
    """The built-in profile of a name, by case; None where there is none."""
    from .builtin import PROFILES

    row = PROFILES.get(name)
    return None if row is None else _profile(row)


def _profile(row: dict[str, object]) -> DeviceProfile:
    from ..vulkan.names import flag_names

    fields: dict[str, object] = {}
    for key, value in row.items():
        if key.endswith("_samples") and key != "max_efficient_samples":
            assert isinstance(value, int)
            value = sample_counts(value)
        elif key.endswith("_modes"):
            assert isinstance(value, int)
            value = tuple(flag_names("VkResolveModeFlagBits", value) or ())
        elif key == "memory_types":
            assert isinstance(value, tuple)
            value = tuple(tuple(flag_names("VkMemoryPropertyFlagBits", mask) or ()) for mask in value)
        fields[key] = value
    return DeviceProfile(**fields)  # type: ignore[arg-type]

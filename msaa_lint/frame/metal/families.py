"""What the GPUs of Metal's families support.

From Apple's documentation of supportsTextureSampleCount (1 and 4 on every device, 2 on every
iPhone, iPad and Apple TV and some Macs, 8 on some Macs alone) and of MTLStorageMode.memoryless,
with the families of the feature set tables: those up to apple6 are in no Mac.
"""

from __future__ import annotations

from functools import lru_cache

from msaa_lint.frame.devices import DeviceProfile

EVERYWHERE = (1, 4)
"""The sample counts that every device supports."""

SOMEWHERE = (1, 2, 4, 8)
"""The sample counts that some devices support."""

_LAST_IN_NO_MAC = 6
_TILES = {7: "apple-g13", 8: "apple-g13"}


def _apple(family: str | None) -> int:
    """The number of a family of Apple GPUs; 0 for any other family, which also covers Macs with
    other GPUs.
    """
    number = (family or "").removeprefix("apple")
    return int(number) if number.isdecimal() else 0


def counts(family: str | None, stated: tuple[int, ...] | None) -> tuple[int, ...]:
    """The sample counts that are certainly supported: those stated for supportsTextureSampleCount,
    else those of the family.
    """
    if stated is not None:
        return tuple(sorted({*stated}))
    return (1, 2, 4) if _apple(family) else EVERYWHERE


def offers_count(count: int, family: str | None, stated: tuple[int, ...] | None) -> bool | None:
    """Whether devices of the family support a sample count; None if only some do."""
    if count in counts(family, stated):
        return True
    if (
        stated is not None
        or count not in SOMEWHERE
        or (count == 8 and 0 < _apple(family) <= _LAST_IN_NO_MAC)
    ):
        return False
    return None


def offers_memoryless(family: str | None) -> bool | None:
    """Whether devices of the family have memoryless textures (apple2 and later); None for families
    that cover Macs with other GPUs.
    """
    number = _apple(family)
    return number >= 2 if number else None


@lru_cache(maxsize=64)
def profile(family: str | None, stated: tuple[int, ...] | None) -> DeviceProfile | None:
    """What all GPUs of an Apple family support, as a class of devices; None for other families."""
    from msaa_lint.frame.devices.tile_models import MODELS

    number = _apple(family)
    if not number or family is None:
        return None
    offered = counts(family, stated)
    memory = (("DEVICE_LOCAL",), ("DEVICE_LOCAL", "LAZILY_ALLOCATED")) if number >= 2 else None
    return DeviceProfile(
        name=family,
        vendor="apple",
        tiler=True,
        color_samples=offered,
        depth_samples=offered,
        stencil_samples=offered,
        memory_types=memory,
        minimum=True,
        source=f"what Apple documents of the GPU family {family}",
        tile=MODELS.get(_TILES.get(number, "")),
    )

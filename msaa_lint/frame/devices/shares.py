"""How many devices offer what: shares that a rule names where the device is unknown.

Counted over the newest report of each device in vulkan.gpuinfo.org's database, by vendor and device
name.
"""

from __future__ import annotations

from .shares_table import ALL, LAZILY_ALLOCATED, SAMPLES_ALL, SAMPLES_TILERS, TILERS

ATTRIBUTION = (
    "vulkan.gpuinfo.org, Sascha Willems and contributors, CC BY 4.0, snapshot of 2025-05-12"
)

DEPTH_RESOLVE_ALL = (1696, {"SAMPLE_ZERO": 1693, "MIN": 1367, "MAX": 1367, "AVERAGE": 1192})
"""Devices that report supportedDepthResolveModes, and how many of them have each mode (the whole
reports of the same snapshot).
"""

DEPTH_RESOLVE_TILERS = (154, {"SAMPLE_ZERO": 154, "MIN": 58, "MAX": 58, "AVERAGE": 22})
"""The same of tile-based devices."""


def sample_count_share(count: int, tilers: bool = False) -> int:
    """Per cent of devices, or of tile-based ones, that offer a sample count for color
    attachments.
    """
    devices, having = (TILERS, SAMPLES_TILERS) if tilers else (ALL, SAMPLES_ALL)
    return per_cent(having.get(count, 0), devices)


def resolve_mode_share(mode: str, tilers: bool = False) -> int | None:
    """Per cent of the devices that report depth resolve modes that offer one; None for modes that
    were not counted.
    """
    devices, having = DEPTH_RESOLVE_TILERS if tilers else DEPTH_RESOLVE_ALL
    return per_cent(having[mode], devices) if mode in having else None


def lazily_allocated_share(vendor: str) -> int | None:
    """Per cent of a vendor's devices that have a lazily allocated memory type; None for vendors
    that were not counted.
    """
    if vendor not in LAZILY_ALLOCATED:
        return None
    having, devices = LAZILY_ALLOCATED[vendor]
    return per_cent(having, devices)


def per_cent(part: int, whole: int) -> int:
    """The nearest per cent, but 0 only for none and 100 only for all."""
    if part in (0, whole):
        return 100 if part else 0
    return min(99, max(1, round(100 * part / whole)))

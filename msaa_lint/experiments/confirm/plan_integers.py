"""The integers of Vulkan's names, for plans."""

from __future__ import annotations

from collections.abc import Iterable

from msaa_lint.frame.vulkan.enums import VALUES

LAYOUTS = frozenset(
    (*range(8), 1000001002, 1000117000, 1000117001, 1000241000, 1000241001, 1000241002, 1000241003,
    1000314000, 1000314001)
)  # fmt: skip
"""The layouts of Vulkan 1.3 except PREINITIALIZED, into which no image can be transitioned, and
PRESENT_SRC_KHR.
"""

GENERAL = 1
"""VK_IMAGE_LAYOUT_GENERAL."""


def number(enum: str, name: str) -> int:
    """The value of an enumerant's short name."""
    return VALUES[enum][name]


def mask(enum: str, names: Iterable[str] | None) -> int:
    """The bit mask of short names; 0 without any."""
    bits = 0
    for name in names or ():
        bits |= VALUES[enum].get(name, 0)
    return bits


def layout(name: str | None, default: int) -> int:
    """The value of a layout's short name; `default` if unstated, and GENERAL for one of an
    extension that confirm does not enable.
    """
    if name is None:
        return default
    value = VALUES["VkImageLayout"][name]
    return value if value in LAYOUTS else GENERAL

"""The integers of Vulkan's names, for plans."""

from __future__ import annotations

from collections.abc import Iterable

from msaa_lint.frame.vulkan.enums import VALUES


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
    """The value of a layout's short name; `default` if unstated."""
    return VALUES["VkImageLayout"][name] if name is not None else default

"""What the validation layer looked at: which layer it was, with which checks, on which device, at which kinds of passes."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from .families import RENDER_PASS, RENDER_PASS_2, RENDERING, Version
from .outcome import about

LAZILY_ALLOCATED = 0x10
"""VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT."""


class Looking(NamedTuple):
    """What the layer looked at, and with what: a `version` of None is unknown; `kinds` are those of passes (`families.RENDER_PASS` ...) by
    their number, `lazy_memory` says whether the device it ran on offers lazily allocated memory."""

    version: Version | None = None
    vendors: frozenset[str] = frozenset()
    kinds: Mapping[int, str] = {}
    lazy_memory: bool | None = None
    device: str = "the device"


def looking(layer: Mapping[str, Any] | None, device: Mapping[str, Any], kinds: Mapping[int, str], vendors: Iterable[str] = ()) -> Looking:
    """What a session's layer and device look at. Both are what a child process says: what is not as it should be is unknown.

    `vendors` are those whose checks were asked for, where the layer does not say.
    """
    stated = layer or {}
    on = stated.get("vendors", vendors)
    named = frozenset(each for each in on if isinstance(each, str)) if isinstance(on, (list, tuple, set, frozenset)) else frozenset(vendors)
    return Looking(_version(stated), named, kinds, _lazy(device), about(device).name)


def kind(api: object, rendering: bool) -> str:
    """The kind of a pass: dynamic rendering, or by the version (1, 2) of the structure that creates it."""
    return RENDERING if rendering else RENDER_PASS_2 if api == 2 else RENDER_PASS


def _version(layer: Mapping[str, Any]) -> Version | None:
    """The version of Vulkan that a layer is written for, as text, number or list."""
    for name in ("specVersion", "spec_version", "version", "api_version"):
        value = layer.get(name)
        if isinstance(value, str) and (match := re.match(r"(\d+)\.(\d+)\.(\d+)", value)):
            return int(match[1]), int(match[2]), int(match[3])
        if isinstance(value, int) and value >= 1 << 22:
            return value >> 22 & 0x7F, value >> 12 & 0x3FF, value & 0xFFF
        if isinstance(value, (list, tuple)) and len(value) == 3 and all(isinstance(each, int) for each in value):
            return value[0], value[1], value[2]
    return None


def _lazy(device: Mapping[str, Any]) -> bool | None:
    """Whether a device offers lazily allocated memory."""
    memory = device.get("memory")
    types = memory.get("memoryTypes") if isinstance(memory, dict) else None
    if not isinstance(types, list):
        return None
    flags = [each.get("propertyFlags") for each in types if isinstance(each, dict)]
    return any(isinstance(each, int) and each & LAZILY_ALLOCATED for each in flags)

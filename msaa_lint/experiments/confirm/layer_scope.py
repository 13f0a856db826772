"""What the validation layer checked: its version, the vendors' checks, the device and the kinds of
passes.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from .families import RENDER_PASS, RENDER_PASS_2, RENDERING, Version
from .outcome import about

LAZILY_ALLOCATED = 0x10
"""VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT."""


class LayerScope(NamedTuple):
    """What the layer checked. `version` is None if unknown; `kinds` are those of the passes
    (`families.RENDER_PASS` and others) by number; `lazy_memory` says whether the device offers
    lazily allocated memory.
    """

    version: Version | None = None
    vendors: frozenset[str] = frozenset()
    kinds: Mapping[int, str] = {}
    lazy_memory: bool | None = None
    device: str = "the device"


def layer_scope(
    layer: Mapping[str, Any] | None,
    device: Mapping[str, Any],
    kinds: Mapping[int, str],
    vendors: Iterable[str] = (),
) -> LayerScope:
    """The scope of a session's layer and device, as a child process reports them; malformed values
    count as unknown.

    `vendors` are those whose checks were requested, used where the layer does not state them.
    """
    layer = layer or {}
    stated = layer.get("vendors", vendors)
    names = stated if isinstance(stated, (list, tuple, set, frozenset)) else vendors
    enabled = frozenset(name for name in names if isinstance(name, str))
    return LayerScope(_version(layer), enabled, kinds, _has_lazy_memory(device), about(device).name)


def pass_kind(api: object, rendering: bool) -> str:
    """The kind of a pass: dynamic rendering, or the version (1, 2) of the structure that creates
    it.
    """
    return RENDERING if rendering else RENDER_PASS_2 if api == 2 else RENDER_PASS


def _version(layer: Mapping[str, Any]) -> Version | None:
    """The Vulkan version of a layer; None if unknown."""
    match = re.match(r"(\d+)\.(\d+)\.(\d+)", str(layer.get("version")))
    return (int(match[1]), int(match[2]), int(match[3])) if match else None


def _has_lazy_memory(device: Mapping[str, Any]) -> bool | None:
    """Whether a device offers lazily allocated memory; None if unknown."""
    memory = device.get("memory")
    types = memory.get("memoryTypes") if isinstance(memory, dict) else None
    if not isinstance(types, list):
        return None
    flags = [entry.get("propertyFlags") for entry in types if isinstance(entry, dict)]
    return any(isinstance(value, int) and value & LAZILY_ALLOCATED for value in flags)

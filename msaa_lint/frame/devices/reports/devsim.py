"""The JSON of the Device Simulation layer, which old `vulkaninfo --json` prints: Vulkan's
structures at the top, masks as numbers.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .gpuinfo import memory
from .members import Found, extension_names, gathered

_STRUCTURE = "VkPhysicalDevice"


def claims(root: Mapping[str, Any]) -> bool:
    """Whether a JSON object has the device's properties at its top."""
    return isinstance(root.get("VkPhysicalDeviceProperties"), dict)


def read(root: Mapping[str, Any]) -> list[Found]:
    """The one device of a file."""
    structures = {
        name: value
        for name, value in root.items()
        if isinstance(value, dict) and name.startswith(_STRUCTURE)
    }
    properties = [
        root["VkPhysicalDeviceProperties"],
        *(structures[name] for name in sorted(structures) if "Properties" in name),
    ]
    features: dict[object, object] = {}
    for name in sorted(structures, reverse=True):
        if "Features" in name:
            features.update(structures[name])
    return [
        Found(
            gathered(*properties),
            features if "VkPhysicalDeviceFeatures" in structures else None,
            extension_names(root.get("ArrayOfVkExtensionProperties")),
            *memory(root.get("VkPhysicalDeviceMemoryProperties")),
            what="vulkaninfo --json (devsim)",
        )
    ]

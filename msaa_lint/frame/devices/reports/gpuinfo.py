"""Reports of vulkan.gpuinfo.org and of its tool, the Vulkan Hardware Capability Viewer: JSON with
masks, and extensions' values as text.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from . import values
from .members import Found, extension_names, gathered

CORES = ("core11", "core12", "core13", "core14")


def claims(root: Mapping[str, Any]) -> bool:
    """Whether a JSON object is such a report."""
    return (
        isinstance(root.get("properties"), dict)
        and "environment" in root
        and ("extended" in root or "memory" in root)
    )


def read(root: Mapping[str, Any]) -> list[Found]:
    """The one device of a report."""
    properties = root["properties"]
    cores = [core for name in CORES if isinstance(core := root.get(name), dict)]
    extended = _object(root.get("extended"))
    members = gathered(properties, *(core.get("properties") for core in cores))
    for entry in _entries(extended.get("deviceproperties2")):
        name = entry.get("name")
        if isinstance(name, str) and gathered({name: entry.get("value")}):
            members.setdefault(name, []).append(entry.get("value"))
    features: dict[object, object] = {}
    for structure in (*(core.get("features") for core in reversed(cores)), root.get("features")):
        features.update(structure if isinstance(structure, dict) else {})
    for entry in _entries(extended.get("devicefeatures2")):
        name = entry.get("name")
        if isinstance(name, str) and not values.boolean(features.get(name)):
            features[name] = entry.get("supported")
    environment = _object(root.get("environment"))
    system = " ".join(
        filter(
            None, (values.text(environment.get("name")), values.text(environment.get("version")))
        )
    )
    return [
        Found(
            members,
            features if isinstance(root.get("features"), dict) else None,
            extension_names(root.get("extensions")),
            *memory(root.get("memory")),
            api=properties.get("apiVersionText") or properties.get("apiVersion"),
            what="report of vulkan.gpuinfo.org or its tool" + (f", {system}" if system else ""),
        )
    ]


def memory(stated: object) -> tuple[list[object] | None, list[tuple[object, object]] | None]:
    """The flags of the memory types, and the heaps, of a VkPhysicalDeviceMemoryProperties as an
    object; None where they are not there.
    """
    if not isinstance(stated, dict):
        return None, None
    types, heaps = stated.get("memoryTypes"), stated.get("memoryHeaps")
    type_count, heap_count = (
        values.number(stated.get(name)) for name in ("memoryTypeCount", "memoryHeapCount")
    )
    return (
        [entry.get("propertyFlags") for entry in _entries(types)][:type_count]
        if isinstance(types, list)
        else None,
        [(entry.get("size"), entry.get("flags")) for entry in _entries(heaps)][:heap_count]
        if isinstance(heaps, list)
        else None,
    )


def _object(value: object) -> Mapping[str, Any]:
    return value if isinstance(value, dict) else {}


def _entries(listed: object) -> list[Mapping[str, Any]]:
    """The objects of a list."""
    return list(map(_object, listed)) if isinstance(listed, list) else []

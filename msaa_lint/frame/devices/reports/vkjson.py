"""vkjson, what `adb shell cmd gpu vkjson` prints on an Android device: an instance with all its
devices. Numbers may be written as 13.0.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from .gpuinfo import memory
from .members import Found, extension_names, gathered

MAX_DEVICES = 16
_OWN = ("queues", "layers", "formats", "memory", "extensions")


def claims(root: Mapping[str, Any]) -> bool:
    """Whether a JSON object is an instance of vkjson, or one of its devices."""
    return any(_is_device(device) for device in _devices(root))


def read(root: Mapping[str, Any]) -> list[Found]:
    """Every device."""
    return [_device(device) for device in _devices(root) if _is_device(device)]


def _devices(root: Mapping[str, Any]) -> list[Any]:
    listed = root.get("devices")
    return listed[:MAX_DEVICES] if isinstance(listed, list) else [root]


def _is_device(device: object) -> bool:
    return (
        isinstance(device, dict)
        and isinstance(device.get("properties"), dict)
        and "memory" in device
        and "features" in device
    )


def _device(device: Mapping[str, Any]) -> Found:
    groups = {
        name: value
        for name, value in device.items()
        if name not in _OWN and isinstance(value, dict)
    }
    return Found(
        gathered(
            device["properties"], *(groups[name] for name in sorted(groups) if name != "properties")
        ),
        dict(_features(groups)) if isinstance(device.get("features"), dict) else None,
        extension_names(device.get("extensions")),
        *memory(device.get("memory")),
        what="vkjson",
    )


def _features(groups: Mapping[str, dict[str, Any]]) -> Iterator[tuple[object, object]]:
    """The members of every features structure: those that are called so, and those of
    extensions.
    """
    waiting = [(name, group, 0) for name, group in groups.items()]
    while waiting:
        name, group, depth = waiting.pop()
        if "eature" in name:
            yield from (
                (member, value)
                for member, value in group.items()
                if not isinstance(value, (dict, list))
            )
        elif depth < 3:
            waiting.extend(
                (inner, value, depth + 1)
                for inner, value in group.items()
                if isinstance(value, dict)
            )

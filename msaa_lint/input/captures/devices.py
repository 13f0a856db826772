"""Tracks the physical device's properties, and the extensions and features that the application
enables.
"""

from __future__ import annotations

from typing import Any

from msaa_lint.frame.devices.mapping import description
from msaa_lint.frame.devices.msaa_features import EXTENSIONS, FEATURES
from msaa_lint.frame.devices.offer import Offer
from msaa_lint.frame.devices.reports.members import BOOLEANS, FLAGS, NUMBERS, Found, gathered
from msaa_lint.frame.devices.reports.reading import report

from . import values
from .call import Call
from .labels import printable

MAX_DEVICES = 256
"""Maximum number of physical devices."""

MAX_STRUCTURES = 256
"""Maximum number of different structures that the queries of a physical device return."""


class Devices:
    """The physical devices that the application queried, and the device that it created."""

    def __init__(self) -> None:
        self.queried: dict[int, dict[str, Any]] = {}
        """The structures that queries returned, by physical device and by topic."""
        self.used: int | None = None
        self.api: str | None = None
        self.program = ""
        self.engine = ""
        self.extensions: list[str] | None = None
        self.features: list[str] | None = None

    def _queried(self, physical_device: object) -> dict[str, Any]:
        handle = values.handle(physical_device)
        if handle not in self.queried and len(self.queried) >= MAX_DEVICES:
            return {"properties": [], "features": []}
        return self.queried.setdefault(handle, {"properties": [], "features": []})

    def on_CreateInstance(self, call: Call) -> None:
        info = values.record(values.record(call.args.get("pCreateInfo")).get("pApplicationInfo"))
        self.program = (
            _versioned(info.get("pApplicationName"), info.get("applicationVersion")) or self.program
        )
        self.engine = _versioned(info.get("pEngineName"), info.get("engineVersion")) or self.engine
        version = values.integer(info.get("apiVersion"))
        if version:
            self.api = f"{version >> 22 & 0x7F}.{version >> 12 & 0x3FF}"

    def on_GetPhysicalDeviceProperties(self, call: Call) -> None:
        structures = self._queried(call.args.get("physicalDevice"))["properties"]
        for structure in values.chain(call.args.get("pProperties")):
            _add(structures, {key: item for key, item in structure.items() if key != "pNext"})

    on_GetPhysicalDeviceProperties2 = on_GetPhysicalDeviceProperties

    def on_GetPhysicalDeviceFeatures(self, call: Call) -> None:
        _add(
            self._queried(call.args.get("physicalDevice"))["features"],
            values.record(call.args.get("pFeatures")),
        )

    def on_GetPhysicalDeviceFeatures2(self, call: Call) -> None:
        for structure in _features_in(call.args.get("pFeatures")):
            _add(self._queried(call.args.get("physicalDevice"))["features"], structure)

    def on_GetPhysicalDeviceMemoryProperties(self, call: Call) -> None:
        properties = values.record(call.args.get("pMemoryProperties"))
        properties = values.record(properties.get("memoryProperties")) or properties
        count = values.integer(properties.get("memoryTypeCount"))
        types = values.items(properties.get("memoryTypes"))
        if types:
            self._queried(call.args.get("physicalDevice"))["memory"] = [
                values.record(each).get("propertyFlags")
                for each in types[: count if count is not None else 64]
            ]

    on_GetPhysicalDeviceMemoryProperties2 = on_GetPhysicalDeviceMemoryProperties

    def on_EnumerateDeviceExtensionProperties(self, call: Call) -> None:
        properties = values.items(call.args.get("pProperties"))
        if properties and not call.args.get("pLayerName"):
            names = [
                values.text(values.record(each).get("extensionName")) for each in properties[:1024]
            ]
            self._queried(call.args.get("physicalDevice"))["extensions"] = [
                name for name in names if name is not None
            ]

    # A trimmed capture of gfxreconstruct has these meta commands instead of the queries.

    def device_properties_command(self, call: Call) -> None:
        args = call.args
        properties = {
            "vendorID": args.get("vendor_id"),
            "deviceName": args.get("device_name"),
            "apiVersion": args.get("api_version"),
        }
        stated = {key: item for key, item in properties.items() if item is not None}
        _add(self._queried(args.get("physical_device_id"))["properties"], stated)

    def memory_properties_command(self, call: Call) -> None:
        types = values.items(call.args.get("memory_types"))
        if types:
            flags = [values.record(each).get("property_flags") for each in types[:64]]
            self._queried(call.args.get("physical_device_id")).setdefault("memory", flags)

    def on_CreateDevice(self, call: Call) -> None:
        self.used = values.handle(call.args.get("physicalDevice"))
        info = values.record(call.args.get("pCreateInfo"))
        names = [
            values.text(each) for each in values.items(info.get("ppEnabledExtensionNames"))[:1024]
        ]
        self.extensions = [name for name in names if name is not None]
        structures = [values.record(info.get("pEnabledFeatures")), *_features_in(info.get("pNext"))]
        self.features = [
            name
            for name in FEATURES
            if any(values.boolean(structure.get(name)) for structure in structures)
        ]

    @property
    def current(self) -> dict[str, Any]:
        """The query results for the device in use; if that is unknown, for the only one queried."""
        if self.used in self.queried:
            return self.queried[self.used]
        return next(iter(self.queried.values())) if len(self.queried) == 1 else {}

    def device_name(self) -> str:
        """The name of the device in use; empty if the capture does not state it."""
        names = (
            values.text(structure.get("deviceName"))
            for each in self.current.get("properties", ())
            for structure in _nested(each)
        )
        return printable(next(filter(None, names), ""))

    def memory_flags(self, index: int) -> list[str] | None:
        """The property flags of a memory type."""
        types = self.current.get("memory") or []
        if not 0 <= index < len(types):
            return None
        parsed = values.flags("VkMemoryPropertyFlagBits", types[index])
        return parsed[0] if parsed is not None and parsed[1] else None

    def device(self) -> str:
        """The `device` section of a description, as YAML; empty if the capture has no information
        about it.
        """
        queries = self.current
        members = gathered(*queries.get("properties", ()))
        for member, stated in members.items():
            members[member] = [
                spelled for value in stated if (spelled := _spelled(member, value)) is not None
            ]
        members = {member: stated for member, stated in members.items() if stated}
        if not members and "memory" not in queries:
            return ""
        available = queries.get("features") or None
        features: dict[object, object] | None = None
        if available:
            features = {
                name: True
                for name in FEATURES
                if any(values.boolean(each.get(name)) for each in available)
            }
        types: list[object] | None = [
            values.bits("VkMemoryPropertyFlagBits", flags) for flags in queries.get("memory", ())
        ]
        if not types or None in types:
            types = None
        api = next(
            (version for version in map(values.integer, members.pop("apiVersion", ())) if version),
            None,
        )
        report_members = Found(
            members, features, queries.get("extensions"), types, None, "", api, what="capture"
        )
        return description(Offer(report(report_members))) + "  captured: true\n"

    def enabled(self) -> dict[str, Any] | None:
        """The `enabled` section of a description, with the extensions and features that matter for
        multisampling.
        """
        section: dict[str, Any] = {}
        if self.api is not None:
            section["apiVersion"] = self.api
        if self.extensions is not None:
            section["extensions"] = [name for name in self.extensions if name in EXTENSIONS]
        if self.features is not None:
            section["features"] = self.features
        return section or None


def _versioned(name: object, version: object) -> str:
    """The name of a program with its version, if it has a major one; empty without a name."""
    text = printable(values.text(name) or "")
    number = values.integer(version)
    # Many programs count their versions in another way than VK_MAKE_API_VERSION.
    if not text or number is None or not 1 << 22 <= number < 1 << 32:
        return text
    return f"{text} {number >> 22 & 0x7F}.{number >> 12 & 0x3FF}.{number & 0xFFF}"


def _nested(structure: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """A structure of properties, and the one within it: VkPhysicalDeviceProperties2 has the others'
    names.
    """
    return structure, values.record(structure.get("properties"))


def _add(structures: list[dict[str, Any]], structure: dict[str, Any]) -> None:
    """Adds a structure unless an earlier query returned it."""
    if len(structures) < MAX_STRUCTURES and structure not in structures:
        structures.append(structure)


def _spelled(member: str, value: object) -> object:
    """The value of a properties member in the form that device reports use."""
    if member in FLAGS:
        return values.bits(FLAGS[member], value)
    if member in BOOLEANS:
        return values.boolean(value)
    return values.integer(value) if member in NUMBERS else value


def _features_in(chain: object) -> list[dict[str, Any]]:
    """The feature structures in a pNext chain."""
    return [
        values.record(structure.get("features")) or structure
        for structure in values.chain(chain)
        if "FEATURES" in values.structure_type(structure) or "features" in structure
    ]

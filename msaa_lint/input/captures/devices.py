"""What a capture says of the device, and of what the application turns on."""

from __future__ import annotations

from typing import Any

from msaa_lint.frame.devices.mapping import description
from msaa_lint.frame.devices.msaa_features import EXTENSIONS, FEATURES
from msaa_lint.frame.devices.offer import Offer
from msaa_lint.frame.devices.reports.members import BOOLEANS, FLAGS, NUMBERS, Found, gathered
from msaa_lint.frame.devices.reports.reading import report

from . import values
from .call import Call


class Devices:
    """The physical devices that the application asked about, and the device that it made."""

    def __init__(self) -> None:
        self.asked: dict[int, dict[str, Any]] = {}
        """By physical device: the structures that queries filled in, by what they describe."""
        self.used: int | None = None
        self.api: str | None = None
        self.extensions: list[str] | None = None
        self.features: list[str] | None = None

    def _of(self, call: Call) -> dict[str, Any]:
        return self.asked.setdefault(values.handle(call.args.get("physicalDevice")), {"properties": [], "features": []})

    def on_CreateInstance(self, call: Call) -> None:
        info = values.record(values.record(call.args.get("pCreateInfo")).get("pApplicationInfo"))
        version = values.integer(info.get("apiVersion"))
        if version:
            self.api = f"{version >> 22 & 0x7F}.{version >> 12 & 0x3FF}"

    def on_GetPhysicalDeviceProperties(self, call: Call) -> None:
        self._of(call)["properties"].append(values.record(call.args.get("pProperties")))

    def on_GetPhysicalDeviceProperties2(self, call: Call) -> None:
        structure: Any = call.args.get("pProperties")
        known = self._of(call)["properties"]
        for _ in range(64):
            if not isinstance(structure, dict):
                break
            known.append({key: item for key, item in structure.items() if key != "pNext"})
            structure = structure.get("pNext")

    def on_GetPhysicalDeviceFeatures(self, call: Call) -> None:
        self._of(call)["features"].append(values.record(call.args.get("pFeatures")))

    def on_GetPhysicalDeviceFeatures2(self, call: Call) -> None:
        self._of(call)["features"].extend(_features_in(call.args.get("pFeatures")))

    def on_GetPhysicalDeviceMemoryProperties(self, call: Call) -> None:
        self._memory(call, values.record(call.args.get("pMemoryProperties")))

    def on_GetPhysicalDeviceMemoryProperties2(self, call: Call) -> None:
        self._memory(call, values.record(values.record(call.args.get("pMemoryProperties")).get("memoryProperties")))

    def _memory(self, call: Call, properties: dict[str, Any]) -> None:
        count = values.integer(properties.get("memoryTypeCount"))
        types = values.items(properties.get("memoryTypes"))
        if types:
            self._of(call)["memory"] = [values.record(each).get("propertyFlags") for each in types[: count if count is not None else 64]]

    def on_EnumerateDeviceExtensionProperties(self, call: Call) -> None:
        listed = values.items(call.args.get("pProperties"))
        if listed and not call.args.get("pLayerName"):
            names = [values.text(values.record(each).get("extensionName")) for each in listed[:1024]]
            self._of(call)["extensions"] = [name for name in names if name is not None]

    # A trimmed capture has these of gfxreconstruct's own in place of the queries.

    def device_properties_command(self, call: Call) -> None:
        given = call.args
        known = {"vendorID": given.get("vendor_id"), "deviceName": given.get("device_name"), "apiVersion": given.get("api_version")}
        handle = values.handle(given.get("physical_device_id"))
        of = self.asked.setdefault(handle, {"properties": [], "features": []})
        of["properties"].append({key: item for key, item in known.items() if item is not None})

    def memory_properties_command(self, call: Call) -> None:
        handle = values.handle(call.args.get("physical_device_id"))
        types = values.items(call.args.get("memory_types"))
        if types:
            of = self.asked.setdefault(handle, {"properties": [], "features": []})
            of.setdefault("memory", [values.record(each).get("property_flags") for each in types[:64]])

    def on_CreateDevice(self, call: Call) -> None:
        self.used = values.handle(call.args.get("physicalDevice"))
        info = values.record(call.args.get("pCreateInfo"))
        names = [values.text(each) for each in values.items(info.get("ppEnabledExtensionNames"))[:1024]]
        self.extensions = [name for name in names if name is not None]
        structures = [values.record(info.get("pEnabledFeatures")), *_features_in(info.get("pNext"))]
        self.features = [name for name in FEATURES if any(values.boolean(structure.get(name)) for structure in structures)]

    @property
    def known(self) -> dict[str, Any]:
        """What was asked of the device that is used; of the only one where that is not told."""
        if self.used in self.asked:
            return self.asked[self.used]
        return next(iter(self.asked.values())) if len(self.asked) == 1 else {}

    def memory_flags(self, index: int) -> list[str] | None:
        """The property flags of a memory type."""
        types = self.known.get("memory") or []
        if not 0 <= index < len(types):
            return None
        found = values.flags("VkMemoryPropertyFlagBits", types[index])
        return found[0] if found is not None and found[1] else None

    def device(self) -> str:
        """The `device` of a description, as YAML; empty where the capture says nothing of it."""
        known = self.known
        members = gathered(*known.get("properties", ()))
        for member, stated in members.items():
            members[member] = [spelled for value in stated if (spelled := _spelled(member, value)) is not None]
        members = {member: stated for member, stated in members.items() if stated}
        if not members and "memory" not in known:
            return ""
        offered = known.get("features") or None
        features: dict[object, object] | None = None
        if offered:
            features = {name: True for name in FEATURES if any(values.boolean(each.get(name)) for each in offered)}
        types: list[object] | None = [values.bits("VkMemoryPropertyFlagBits", flags) for flags in known.get("memory", ())]
        if not types or None in types:
            types = None
        api = next((version for version in map(values.integer, members.pop("apiVersion", ())) if version), None)
        found = Found(members, features, known.get("extensions"), types, None, "", api, what="capture")
        return description(Offer(report(found)))

    def enabled(self) -> dict[str, Any] | None:
        """The `enabled` of a description: of extensions and features those that multisampling has to do with."""
        made: dict[str, Any] = {}
        if self.api is not None:
            made["apiVersion"] = self.api
        if self.extensions is not None:
            made["extensions"] = [name for name in self.extensions if name in EXTENSIONS]
        if self.features is not None:
            made["features"] = self.features
        return made or None


def _spelled(member: str, value: object) -> object:
    """A member of a properties structure as reports of devices spell it."""
    if member in FLAGS:
        return values.bits(FLAGS[member], value)
    if member in BOOLEANS:
        return values.boolean(value)
    return values.integer(value) if member in NUMBERS else value


def _features_in(chain: object) -> list[dict[str, Any]]:
    """The features structures of a chain."""
    found: list[dict[str, Any]] = []
    for _ in range(64):
        if not isinstance(chain, dict):
            break
        if "FEATURES" in values.structure_type(chain) or "features" in chain:
            found.append(values.record(chain.get("features")) or chain)
        chain = chain.get("pNext")
    return found

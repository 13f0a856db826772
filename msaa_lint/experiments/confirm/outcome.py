"""What a whole run of `msaa-lint confirm` gives, for reporters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from .verdict import WRONG, Verdict, counts


class About(NamedTuple):
    """A device, as reports name it. `type` is `CPU`, `INTEGRATED_GPU`, `DISCRETE_GPU`, `VIRTUAL_GPU` or `OTHER`."""

    name: str
    type: str = "OTHER"
    api_version: str = ""
    driver: str = ""
    vendor_id: int = 0

    @property
    def software(self) -> bool:
        """Whether it is the CPU."""
        return self.type == "CPU"


class DeviceRun(NamedTuple):
    """One device: what came of every pass there, or why it could not be used (`unusable`, in words)."""

    device: About | None
    layer: Mapping[str, Any] | None = None
    verdicts: Sequence[Verdict] = ()
    notes: Sequence[str] = ()
    unusable: str = ""
    asked: str = ""
    cannot_show: str = ""
    printed: Sequence[str] = ()

    @property
    def agreement(self) -> dict[str, int]:
        """How much both say, we alone, they alone; what of theirs is explained, what noise."""
        return counts(self.verdicts)

    @property
    def title(self) -> str:
        """What the device is called: by its driver, else as it was asked for."""
        return self.device.name if self.device is not None else self.asked or "no device"


TYPES = ("OTHER", "INTEGRATED_GPU", "DISCRETE_GPU", "VIRTUAL_GPU", "CPU")
"""VkPhysicalDeviceType, by its number."""


def about(device: Mapping[str, Any]) -> About:
    """A device by what its child says of it: a driver may say anything, so what is no name or number is left out."""
    properties = device.get("properties")
    stated: Mapping[str, Any] = properties if isinstance(properties, dict) else device
    name = _text(stated.get("deviceName")) or _text(device.get("name")) or "unnamed device"
    kind = stated.get("deviceType", device.get("type"))
    if isinstance(kind, int):
        kind = TYPES[kind] if 0 <= kind < len(TYPES) else "OTHER"
    kind = _text(kind).removeprefix("VK_PHYSICAL_DEVICE_TYPE_").upper()
    version = stated.get("apiVersion", device.get("api_version", ""))
    if isinstance(version, int):
        version = f"{version >> 22 & 0x7F}.{version >> 12 & 0x3FF}.{version & 0xFFF}"
    chained = device.get("VkPhysicalDeviceDriverProperties")
    driver = " ".join(_text(chained.get(each)) for each in ("driverName", "driverInfo")).strip() if isinstance(chained, dict) else ""
    vendor = stated.get("vendorID", 0)
    kind = kind if kind in TYPES else "OTHER"
    return About(name, kind, _text(version), driver or _text(device.get("driver")), vendor if isinstance(vendor, int) else 0)


def _text(value: object) -> str:
    return value if isinstance(value, str) else ""


def exit_code(runs: Sequence[DeviceRun], wrong: bool) -> int:
    """2 where an input or a device could not be used, 1 where a pass on some device is wrong, else 0."""
    if wrong or any(run.unusable for run in runs):
        return 2
    return int(any(verdict.status in WRONG for run in runs for verdict in run.verdicts))

"""What `--profile` may name: a built-in device, a class of devices, or a vendor."""

from __future__ import annotations

from .devices import DeviceProfile, builtin, names
from .facts.table import WORDS


def device_of(name: str | None) -> DeviceProfile | None:
    """The device that descriptions without one are judged for; a vendor's is one of which only that is known."""
    if name is None:
        return None
    found = builtin(name)
    if found is None and name in WORDS["vendor"]:
        return DeviceProfile(name=name, vendor=name, minimum=True, source="only the vendor is known")
    return found


def known_profiles() -> tuple[str, ...]:
    """Every name that `device_of` knows."""
    return (*names(), *WORDS["vendor"])

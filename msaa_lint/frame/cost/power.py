"""Bytes of a frame to MB/s, and to the power that they take."""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.frame.description.models import Description
from msaa_lint.frame.devices import DeviceProfile

from .amounts import Amount, Terms

MILLIWATTS_PER_GBPS = 100.0
"""10^9 bytes a second of external memory, by Arm ("Understanding render passes"; the Khronos MSAA sample reckons with it)."""

ASSUMED_FPS = 60.0
MAX_RATE = 1e9
"""Frames a second, and milliwatts per GB/s, above which an input's figure is taken for this one: every sum stays finite."""

MIB = 2**20


class Rates(NamedTuple):
    """Frames a second, and milliwatts for 10^9 bytes a second."""

    fps: float
    milliwatts_per_gbps: float

    def amount(self, read: float, written: float, committed: int) -> Amount:
        """Bytes that a frame reads and writes, and bytes of memory, as an amount."""
        reads, writes = read * self.fps / 1e6, written * self.fps / 1e6
        return Amount(reads, writes, committed / MIB, (reads + writes) / 1000 * self.milliwatts_per_gbps)


def rates(description: Description, device: DeviceProfile | None, terms: Terms) -> Rates:
    """The caller's rates, else the description's (fps) and the device's (power), else 60 Hz and 100 mW."""
    size = description.frame
    fps = terms.fps or (size.fps if size is not None else None) or ASSUMED_FPS
    power = terms.milliwatts_per_gbps
    if power is None and device is not None:
        power = device.milliwatts_per_gbps
    return Rates(min(float(fps), MAX_RATE), min(float(MILLIWATTS_PER_GBPS if power is None else power), MAX_RATE))


def budget_share(amount: Amount, terms: Terms) -> float:
    """How much of the power budget an amount takes: 1 is all of it. 4.5 GB/s at 100 mW are 0.18 of 2.5 W."""
    return amount.milliwatts / terms.budget_milliwatts

"""Conversion of bytes per frame to MB/s, and to the power that the traffic takes."""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.frame.description.models import Description
from msaa_lint.frame.devices import DeviceProfile

from .amounts import Amount, Terms

MILLIWATTS_PER_GBPS = 100.0
"""Milliwatts for 10^9 bytes per second of external memory: Arm, "Understanding render passes"; the
Khronos MSAA sample uses it too.
"""

BUDGET_MILLIWATTS = 2500.0
"""A phone's sustained power budget, by the same source: Arm, "Understanding render passes". It
applies to devices that are known to be tile-based, and where none is named.
"""

ASSUMED_FPS = 60.0
MAX_RATE = 1e9
"""The upper bound of frames per second and of milliwatts per GB/s, so that every sum stays
finite.
"""

MIB = 2**20


class Rates(NamedTuple):
    """Frames per second, and milliwatts per 10^9 bytes per second."""

    fps: float
    milliwatts_per_gbps: float

    def amount(self, read: float, written: float, committed: int) -> Amount:
        """The amount for the bytes that a frame reads and writes, and the bytes of memory that it
        commits.
        """
        reads, writes = read * self.fps / 1e6, written * self.fps / 1e6
        return Amount(
            reads, writes, committed / MIB, (reads + writes) / 1000 * self.milliwatts_per_gbps
        )


def rates(description: Description, device: DeviceProfile | None, terms: Terms) -> Rates:
    """The caller's rates, else the description's (fps) and the device's (power), else 60 Hz and 100
    mW.

    A kind of frame that is only a share of a program's frames comes as often as that share of the
    frame rate.
    """
    size = description.frame
    fps = terms.fps or (size.fps if size is not None else None) or ASSUMED_FPS
    if size is not None and size.share is not None:
        fps *= size.share
    power = terms.milliwatts_per_gbps
    if power is None and device is not None:
        power = device.milliwatts_per_gbps
    return Rates(
        min(float(fps), MAX_RATE),
        min(float(MILLIWATTS_PER_GBPS if power is None else power), MAX_RATE),
    )

"""What a device's lossless compression leaves of traffic with attachments and sampled images."""

from __future__ import annotations

from msaa_lint.frame.devices import DeviceProfile


def ratio(device: DeviceProfile | None, samples: int, direction: str) -> float | None:
    """Measured traffic by that of plain arithmetic, for images of a sample count; None where it was not measured for the device.

    It is an average over pictures: 1 means that nothing is compressed, above 1 that more moves than the texels.
    """
    if device is None or device.compression is None:
        return None
    known = device.compression.get(samples)
    return None if known is None else known[0] if direction == "read" else known[1]

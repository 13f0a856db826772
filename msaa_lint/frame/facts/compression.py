"""Which images a device may compress: properties of an image, not of a sample count.

Arm Frame Buffer Compression, by the Arm GPU Best Practices Developer Guide (101897, version 3.2),
9.8 "AFBC textures for Vulkan", and the column of each GPU in the Arm GPU Datasheet (102849, version
7), "AFBC - RGBA16". Qualcomm's UBWC compresses multisampled images too (Mesa, tu_image.cc); of what
rules it out, as of other vendors' compression, no document of the vendor is at hand.
"""

from __future__ import annotations

import re

from msaa_lint.frame.description.models import Image
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.vulkan.formats import Format

BIFROST = frozenset({31, 51, 52, 71, 72, 76})
VALHALL = frozenset({57, 68, 77, 78, 310, 510, 610, 710, 615, 715})
"""Mali GPUs by number; the fifth generation is G620, G625, G720, G725, G925 and later."""

FIRST_HALF_FLOATS = 310
"""The datasheet lists AFBC of 16 bits by four components for G310, G510, G710 and all later ones;
their numbers alone have three digits.
"""

_NUMBER = re.compile(r"\b(?:Mali|Immortalis)-G(\d+)", re.IGNORECASE)
_G1 = re.compile(r"\bMali-G1\b", re.IGNORECASE)
_BIFROST_FORMATS = frozenset({
    "R4G4B4A4_UNORM_PACK16", "B4G4R4A4_UNORM_PACK16", "R5G6B5_UNORM_PACK16",
    "R5G5B5A1_UNORM_PACK16", "B5G5R5A1_UNORM_PACK16",
    "A1R5G5B5_UNORM_PACK16", "B8G8R8_UNORM", "B8G8R8A8_UNORM", "B8G8R8A8_SRGB",
    "A8B8G8R8_UNORM_PACK32", "A8B8G8R8_SRGB_PACK32",
    "A2R10G10B10_UNORM_PACK32", "A2B10G10R10_UNORM_PACK32", "R8_UNORM", "R8G8_UNORM",
    "R8G8B8_UNORM", "R8G8B8A8_UNORM", "R8G8B8A8_SRGB",
    "D24_UNORM_S8_UINT", "X8_D24_UNORM_PACK32", "D16_UNORM", "D32_SFLOAT",
})  # fmt: skip
"""The guide's list, which names packed formats of 10 bits and depth of 24 bits by their
components.
"""


def mali_number(device: DeviceProfile | None) -> int | None:
    """The number of an Arm GPU, 76 for Mali-G76; None for another device, and where its name does
    not state it.
    """
    if device is None or device.vendor != "arm":
        return None
    if _G1.search(device.name):
        return 1000
    number = _NUMBER.search(device.name)
    return int(number[1]) if number is not None else None


def is_valhall_or_later(device: DeviceProfile | None) -> bool | None:
    """Whether an Arm GPU is of the Valhall generation or a later one; None where its name does not
    say.
    """
    number = mali_number(device)
    return None if number is None else number not in BIFROST


def compresses(
    device: DeviceProfile, format: Format | None, samples: int, image: Image | None
) -> bool | None:
    """Whether a device may compress an image; None where that depends on a GPU generation that is
    not known.

    True where nothing that is stated rules it out: compression also depends on the driver and on
    the picture.
    """
    if device.vendor != "arm":
        return True
    usage: tuple[str, ...] = (image.usage or ()) if image is not None else ()
    flags: tuple[str, ...] = image.flags if image is not None else ()
    if (
        samples != 1
        or "STORAGE" in usage
        or "FRAGMENT_SHADING_RATE_ATTACHMENT" in usage
        or "ALIAS" in flags
    ):
        return False
    if image is not None and (
        image.imageType not in (None, "2D") or image.tiling not in (None, "OPTIMAL")
    ):
        return False
    early = "TRANSIENT_ATTACHMENT" in usage or "MUTABLE_FORMAT" in flags
    number = mali_number(device)
    if number is None:
        certain = format is None or format.name in _BIFROST_FORMATS
        return None if early or not certain else True
    if number in BIFROST:
        return not early and (format is None or format.name in _BIFROST_FORMATS)
    if format is None or format.bytes <= 4:
        return True
    return number >= FIRST_HALF_FLOATS and format.name.startswith("R16G16B16A16_")

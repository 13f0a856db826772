"""What a report says, whichever the dialect: the members that are looked for, as found and as
read.
"""

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from msaa_lint.frame.devices import DeviceProfile

COUNTS = {
    "no_attachments": "framebufferNoAttachmentsSampleCounts",
    "sampled_color": "sampledImageColorSampleCounts",
    "sampled_integer": "sampledImageIntegerSampleCounts",
    "sampled_depth": "sampledImageDepthSampleCounts",
    "sampled_stencil": "sampledImageStencilSampleCounts",
    "storage": "storageImageSampleCounts",
    "sample_locations": "sampleLocationSampleCounts",
}
"""The members with the sample counts that profiles do not have, by use."""

_SAMPLES = "VkSampleCountFlagBits"
FLAGS = {
    **dict.fromkeys(
        (
            f"framebuffer{aspect}SampleCounts"
            for aspect in ("Color", "Depth", "Stencil", "IntegerColor")
        ),
        _SAMPLES,
    ),
    **dict.fromkeys(COUNTS.values(), _SAMPLES),
    **dict.fromkeys(
        ("supportedDepthResolveModes", "supportedStencilResolveModes"), "VkResolveModeFlagBits"
    ),
}
"""Members that are masks, and of which enum."""

BOOLEANS = (
    "independentResolve",
    "independentResolveNone",
    "standardSampleLocations",
    "variableSampleLocations",
)
NUMBERS = (
    "subPixelPrecisionBits",
    "maxFramebufferWidth",
    "maxFramebufferHeight",
    "maxColorAttachments",
    "vendorID",
)
TEXTS = ("deviceName", "deviceType", "apiVersion", "driverVersion", "driverName", "driverInfo")
WANTED = frozenset((*FLAGS, *BOOLEANS, *NUMBERS, *TEXTS))
"""The members of properties structures that a report is read for."""


class Found(NamedTuple):
    """What one dialect's reader found, in Vulkan's names and in the report's own spelling.

    `members` are those of properties structures that are `WANTED`, each with every value that the
    report has for it, the best first. None is what the report does not have. `memory_types` are
    their propertyFlags; `heaps` sizes and flags.
    """

    members: Mapping[str, list[object]]
    features: Mapping[object, object] | None = None
    extensions: Iterable[object] | None = None
    memory_types: list[object] | None = None
    heaps: list[tuple[object, object]] | None = None
    name: str = ""
    api: object = None
    minimum: bool = False
    what: str = ""
    notes: tuple[str, ...] = ()


class Details(NamedTuple):
    """What a report has beyond the profile. None is unknown.

    Sample counts by use (those of `COUNTS`), memory heaps (bytes, and whether they are the device's
    own), the framebuffer's largest size in pixels, the snap of vertices in bits, what Vulkan says
    of sample locations, the driver and the kind of device in words.
    """

    counts: Mapping[str, tuple[int, ...] | None] = dict.fromkeys(COUNTS)
    standard_sample_locations: bool | None = None
    sub_pixel_precision_bits: int | None = None
    max_framebuffer: tuple[int, int] | None = None
    max_color_attachments: int | None = None
    heaps: tuple[tuple[int, bool], ...] | None = None
    device_type: str | None = None
    driver: str | None = None


class Report(NamedTuple):
    """A device as a report describes it. `notes` says what of the report could not be read, one
    line each.
    """

    profile: DeviceProfile
    details: Details = Details()
    notes: tuple[str, ...] = ()


def gathered(*structures: object) -> dict[str, list[object]]:
    """The wanted members of structures and of the structures in them; anything but a mapping is
    skipped.
    """
    found: dict[str, list[object]] = {}
    waiting = [(structure, 0) for structure in reversed(structures)]
    while waiting:
        structure, depth = waiting.pop()
        if not isinstance(structure, dict):
            continue
        for name, value in structure.items():
            if name in WANTED:
                found.setdefault(name, []).append(value)
            elif isinstance(value, dict) and depth < 4:
                waiting.append((value, depth + 1))
    return found


def extension_names(listed: object) -> list[object] | None:
    """The names in a list of VkExtensionProperties, or of names; None where it is not a list."""
    if not isinstance(listed, list):
        return None
    return [entry.get("extensionName") if isinstance(entry, dict) else entry for entry in listed]


def shown(value: object) -> str:
    """A value as a note names it: a short text, never what is in a list."""
    kinds: dict[type, str] = {list: "a list", dict: "an object"}
    return kinds.get(type(value)) or (
        repr(value)[:60] if not isinstance(value, int) or abs(value) < 1 << 64 else "a long number"
    )

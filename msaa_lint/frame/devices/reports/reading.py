"""A report made into a profile: the one place that knows which member is which fact."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TypeVar

from msaa_lint.frame.devices import DeviceProfile, builtin, sample_counts
from msaa_lint.frame.devices import names as builtin_names
from msaa_lint.frame.devices.builtin_profiles import EFFICIENT
from msaa_lint.frame.devices.vendors import is_tiler, vendor_of

from . import values
from .members import COUNTS, FLAGS, Details, Found, Report, shown

Value = TypeVar("Value")

MAX_NAMES = 4000
"""Features, extensions: a driver has some hundreds."""

MAX_TYPES = 32
"""VK_MAX_MEMORY_TYPES; heaps are fewer."""

MAX_NOTES = 12

DEVICE_TYPES = ("OTHER", "INTEGRATED_GPU", "DISCRETE_GPU", "VIRTUAL_GPU", "CPU")
"""VkPhysicalDeviceType, by value."""


def report(found: Found, file: str = "") -> Report:
    """The report as a profile and its details."""
    made = _Reading(found)
    name = found.name or made.text("deviceName") or "a device without a name"
    number = made.number("vendorID")
    vendor = vendor_of(number) if number is not None else None
    kind = _device_type(next(iter(found.members.get("deviceType", [])), None))
    twin = None if found.minimum else _twin(name, vendor)
    driver = _driver(made)
    source = f"{file}: {found.what}" if file else found.what
    profile = DeviceProfile(
        name=name,
        vendor=vendor,
        tiler=False if kind == "CPU" or "llvmpipe" in name else is_tiler(vendor),
        color_samples=made.counts("framebufferColorSampleCounts"),
        depth_samples=made.counts("framebufferDepthSampleCounts"),
        stencil_samples=made.counts("framebufferStencilSampleCounts"),
        integer_samples=made.counts("framebufferIntegerColorSampleCounts"),
        memory_types=made.memory_types(),
        depth_resolve_modes=made.modes("supportedDepthResolveModes"),
        stencil_resolve_modes=made.modes("supportedStencilResolveModes"),
        independent_resolve=made.boolean("independentResolve"),
        independent_resolve_none=made.boolean("independentResolveNone"),
        features=made.features(),
        extensions=made.extensions(),
        api_version=values.version(found.api)
        or next(filter(None, map(values.version, found.members.get("apiVersion", []))), None),
        max_efficient_samples=4 if vendor in EFFICIENT else None,
        minimum=found.minimum,
        source=source
        + (f", driver {driver}" if driver else "")
        + EFFICIENT.get(vendor or "", "")
        + _of_twin(twin),
        tile=twin[1].tile if twin is not None else None,
        compression=twin[1].compression if twin is not None else None,
        compression_most=twin[1].compression_most if twin is not None else None,
    )
    width, height = made.number("maxFramebufferWidth"), made.number("maxFramebufferHeight")
    details = Details(
        counts={use: made.counts(member) for use, member in COUNTS.items()},
        standard_sample_locations=made.boolean("standardSampleLocations"),
        sub_pixel_precision_bits=made.number("subPixelPrecisionBits"),
        max_framebuffer=(width, height) if width and height else None,
        max_color_attachments=made.number("maxColorAttachments"),
        heaps=made.heaps(),
        device_type=kind.lower().replace("gpu", "GPU").replace("cpu", "CPU").replace("_", " ")
        if kind is not None
        else None,
        driver=driver,
    )
    return Report(profile, details, (*found.notes, *made.notes)[:MAX_NOTES])


class _Reading:
    """The members of a report while they are read: what is wrong of one is a note, and the member
    unknown.
    """

    def __init__(self, found: Found) -> None:
        self.found = found
        self.notes: list[str] = []

    def wrong(self, what: str, value: object, due: str) -> None:
        if len(self.notes) < MAX_NOTES:
            self.notes.append(f"{what}: {shown(value)} where {due} is due, passed over")

    def counts(self, member: str) -> tuple[int, ...] | None:
        """None too for a mask without a count: Vulkan guarantees some."""
        return sample_counts(self._mask(member, "a mask of sample counts")) or None

    def modes(self, member: str) -> tuple[str, ...] | None:
        return (
            values.names("VkResolveModeFlagBits", self._mask(member, "a mask of resolve modes"))
            or None
        )

    def _mask(self, member: str, due: str) -> int:
        return next(
            filter(None, self._readable(member, partial(values.mask, FLAGS[member]), due)), 0
        )

    def boolean(self, member: str) -> bool | None:
        return next(iter(self._readable(member, values.boolean, "a boolean")), None)

    def number(self, member: str) -> int | None:
        return next(iter(self._readable(member, values.number, "a number")), None)

    def _readable(
        self, member: str, read: Callable[[object], Value | None], due: str
    ) -> list[Value]:
        """The values of a member that can be read."""
        every = self.found.members.get(member, [])
        readable = [value for value in map(read, every) if value is not None]
        if every and not readable:
            self.wrong(member, every[0], due)
        return readable

    def text(self, member: str) -> str | None:
        return next(filter(None, map(values.text, self.found.members.get(member, []))), None)

    def features(self) -> tuple[str, ...] | None:
        if self.found.features is None:
            return None
        offered: set[str] = set()
        for name, value in self.found.features.items():
            read = values.boolean(value)
            if read is None or not values.is_feature(name):
                self.wrong(f"feature {str(name)[:60]}", value, "a boolean")
            elif read and len(offered) < MAX_NAMES:
                offered.add(str(name))
        return tuple(sorted(offered))

    def extensions(self) -> tuple[str, ...] | None:
        if self.found.extensions is None:
            return None
        offered: set[str] = set()
        for name in self.found.extensions:
            if not values.is_extension(name):
                self.wrong("extensions", name, "an extension's name")
            elif len(offered) < MAX_NAMES:
                offered.add(str(name))
        return tuple(sorted(offered))

    def memory_types(self) -> tuple[tuple[str, ...], ...] | None:
        """Each once. One that cannot be read might be any: then none is known."""
        stated = self.found.memory_types
        if stated is None:
            return None
        masks = [values.mask("VkMemoryPropertyFlagBits", flags) for flags in stated[:MAX_TYPES]]
        wrong = next(
            (flags for flags, bits in zip(stated, masks, strict=False) if bits is None), None
        )
        if None in masks or not masks:
            self.wrong("memory types", wrong, "a mask of memory properties")
            return None
        return tuple(
            dict.fromkeys(
                values.names("VkMemoryPropertyFlagBits", bits) for bits in masks if bits is not None
            )
        )

    def heaps(self) -> tuple[tuple[int, bool], ...] | None:
        read = []
        for size, flags in (self.found.heaps or [])[:MAX_TYPES]:
            size_bytes = values.number(size)
            if size_bytes is None:
                self.wrong("memory heap", size, "a size in bytes")
                return None
            listed = flags if isinstance(flags, list) else [flags]
            local = any("DEVICE_LOCAL" in each for each in listed if isinstance(each, str)) or bool(
                (values.number(flags) or 0) & 1
            )
            read.append((size_bytes, local))
        return tuple(read) or None


def _device_type(value: object) -> str | None:
    number = values.number(value)
    if number is not None:
        return DEVICE_TYPES[number] if number < len(DEVICE_TYPES) else None
    word = (values.text(value) or "").removeprefix("VK_").removeprefix("PHYSICAL_DEVICE_TYPE_")
    return word if word in DEVICE_TYPES else None


def _driver(made: _Reading) -> str | None:
    parts = [part for part in (made.text("driverName"), made.text("driverInfo")) if part]
    words = " ".join(" ".join(dict.fromkeys(parts)).split())
    return words[:120] or None


def _twin(name: str, vendor: str | None) -> tuple[str, DeviceProfile] | None:
    """The built-in device of the same name: its tiles and compression are the hardware's."""
    bare = " ".join(name.lower().replace("(tm)", " ").replace("turnip", " ").split())
    for key in builtin_names():
        known = builtin(key)
        if (
            known is None
            or known.minimum
            or known.vendor != vendor
            or (known.tile is None and known.compression is None)
        ):
            continue
        own = known.name.lower()
        if bare.startswith(own) and not bare[len(own) : len(own) + 1].isalnum():
            return key, known
    return None


def _of_twin(twin: tuple[str, DeviceProfile] | None) -> str:
    if twin is None:
        return ""
    model = twin[1].tile.source if twin[1].tile is not None else ""
    return f"; tiles{' and compression' if twin[1].compression else ''}: as of {twin[0]}" + (
        f" ({model})" if model else ""
    )

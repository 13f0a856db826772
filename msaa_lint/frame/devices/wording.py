"""What a device supports for multisampling, as a table and rows of text. What a class of devices
does not list is not guaranteed.
"""

from collections.abc import Iterator
from typing import NamedTuple

from . import DeviceProfile
from .msaa_features import EXTENSIONS, FEATURES
from .offer import (
    COUNTS,
    DEFAULT_EFFICIENT_SAMPLES,
    Offer,
    counts_of,
    lazily_allocated,
    offered,
    tiles,
)
from .shares import ATTRIBUTION, lazily_allocated_share, resolve_mode_share, sample_count_share

COLUMNS = {
    "color": "color",
    "depth": "depth",
    "stencil": "stencil",
    "integer": "integer",
    "no_attachments": "none",
    "sampled_color": "read color",
    "sampled_integer": "read integer",
    "sampled_depth": "read depth",
    "sampled_stencil": "read stencil",
    "storage": "storage",
}
"""The columns of the table: attachments by aspect (`none`: passes without attachments), then images
that shaders read or write.
"""

PRINCIPAL = (
    "sampleRateShading", "dynamicRendering", "multisampledRenderToSingleSampled",
    "shaderStorageImageMultisample",
    "variableMultisampleRate", "extendedDynamicState3RasterizationSamples", "customResolve",
)  # fmt: skip
PRINCIPAL_EXTENSIONS = ("VK_KHR_depth_stencil_resolve", "VK_EXT_sample_locations")
"""Features and extensions whose absence is shown."""


Row = tuple[str, str]
"""A fact about a device: its label and its text."""


class Table(NamedTuple):
    """A row for each sample count, and the meaning of the marks."""

    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    legend: tuple[str, ...]


def title(offer: Offer) -> str:
    """The name of the device, with its kind in parentheses."""
    profile = offer.profile
    kinds = {True: "tile-based", False: "not tile-based", None: ""}
    parts = [profile.vendor or "", kinds[profile.tiler], offer.details.device_type or ""]
    parts += [f"Vulkan {profile.api_version}" if profile.api_version else ""]
    parts += ["a minimum that every such device guarantees" if profile.minimum else ""]
    known = ", ".join(part for part in parts if part)
    return f"{profile.name} ({known})" if known else profile.name


def table(offer: Offer) -> Table:
    """For each sample count: its uses, its tile size, and the share of devices that support it."""
    profile = offer.profile
    counts = counts_of(offer)
    known = [
        use
        for use in COLUMNS
        if counts[use] is not None or use in ("color", "depth", "stencil", "integer")
    ]
    offers = {count for use in known for count in counts[use] or ()}
    size = {tile.samples: tile for tile in tiles(profile)}
    shown = [count for count in COUNTS if count in offers or count <= 16]
    rows = []
    for count in shown:
        cells = [_mark(counts[use], count) for use in known]
        tile = (
            [
                ("spills" if size[count].spills else f"{size[count].pixels} px")
                if count in size
                else ""
            ]
            if size
            else []
        )
        share = [f"{sample_count_share(count)} %", f"{sample_count_share(count, True)} %"]
        rows.append((f"{count}x", *cells, *tile, *share))
    heads = tuple(COLUMNS[use] for use in known)
    missing = "not guaranteed" if profile.minimum else "not supported"
    legend = [f"- {missing}; ? unknown"]
    if len(known) > 4:
        legend.append(
            "read: images that shaders fetch from; storage: images that they write; none: passes "
            "without attachments"
        )
    legend.append(
        f"of devices, of tilers: the share that supports the count for color; {ATTRIBUTION}"
    )
    return Table(
        ("samples", *heads, *(["tile, RGBA8"] if size else []), "of devices", "of tilers"),
        tuple(rows),
        tuple(legend),
    )


def _mark(counts: tuple[int, ...] | None, count: int) -> str:
    return "?" if counts is None else "yes" if count in counts else "-"


def rows(offer: Offer) -> list[Row]:
    """The facts other than the sample counts."""
    return [(label, text) for label, text in _rows(offer) if text]


def _rows(offer: Offer) -> Iterator[Row]:
    profile, details = offer.profile, offer.details
    yield "depth resolve", _modes(profile, profile.depth_resolve_modes, True)
    yield "stencil resolve", _modes(profile, profile.stencil_resolve_modes, False)
    yield "independent resolve", _independent(profile)
    yield "lazily allocated", _lazily(profile)
    types = profile.memory_types
    yield (
        "memory types",
        "; ".join(" | ".join(flags) or "(none)" for flags in types) if types is not None else "",
    )
    heaps = details.heaps or ()
    yield (
        "memory heaps",
        "; ".join(
            f"{size / 2**20:,.0f} MiB{' device-local' if local else ''}" for size, local in heaps
        ),
    )
    yield "efficient samples", _efficient(profile)
    yield "sample locations", _locations(offer)
    if details.max_framebuffer is not None:
        yield "largest framebuffer", "{} x {} pixels".format(*details.max_framebuffer)
    for name, meaning in FEATURES.items():
        if offered(offer, name):
            yield name, meaning
    for name, meaning in EXTENSIONS.items():
        if offered(offer, name, extension=True):
            yield name, meaning
    yield from _lacking(offer)
    if profile.tile is not None:
        yield "tiles", f"source: {profile.tile.source}"
    if profile.compression is not None:
        most = profile.compression_most
        at_most = (
            "" if most is None else f", at least; at most reads {most[0]:g}, writes {most[1]:g}"
        )
        yield "compression", _compression(profile.compression) + at_most
    yield "source", profile.source
    for note in offer.report.notes:
        yield "note", note


def _modes(profile: DeviceProfile, modes: tuple[str, ...] | None, depth: bool) -> str:
    if modes is None:
        return "not guaranteed" if profile.minimum else "unknown"
    if not depth:
        return ", ".join(modes)
    lacking = [mode for mode in ("AVERAGE", "MIN", "MAX") if mode not in modes]
    shares = ", ".join(
        f"{mode} (by {resolve_mode_share(mode, True)} % of tilers)" for mode in lacking
    )
    word = "not guaranteed" if profile.minimum else "not supported"
    return ", ".join(modes) + (f"; {word}: {shares}" if lacking else "")


def _independent(profile: DeviceProfile) -> str:
    if profile.independent_resolve:
        return "any pair of depth and stencil modes"
    if profile.independent_resolve_none:
        return "depth and stencil modes are the same, or one is NONE"
    if profile.independent_resolve is None or profile.independent_resolve_none is None:
        return "not guaranteed" if profile.minimum else "unknown"
    return "depth and stencil modes must be the same"


def _lazily(profile: DeviceProfile) -> str:
    found = lazily_allocated(profile)
    share = lazily_allocated_share(profile.vendor) if profile.vendor is not None else None
    others = f" ({share} % of {profile.vendor}'s devices support it)" if share is not None else ""
    if found:
        return "yes: a transient attachment takes memory only if it has to leave the tile"
    if found is None:
        return (
            "not guaranteed" if profile.minimum else "unknown: the memory types are not stated"
        ) + others
    return f"no: a transient attachment takes its full size{others}"


def _efficient(profile: DeviceProfile) -> str:
    if profile.max_efficient_samples is not None:
        return f"up to {profile.max_efficient_samples}, according to the vendor's guide"
    return f"not stated; rules assume {DEFAULT_EFFICIENT_SAMPLES}"


def _locations(offer: Offer) -> str:
    details = offer.details
    words = {True: "standard", False: "not standard", None: ""}[details.standard_sample_locations]
    counts = details.counts["sample_locations"]
    own = f"chosen by the application at {', '.join(map(str, counts))} samples" if counts else ""
    snap = details.sub_pixel_precision_bits
    bits = f"vertices snap to 1/{1 << snap} pixel" if snap is not None and snap < 32 else ""
    return "; ".join(part for part in (words, own, bits) if part)


def _lacking(offer: Offer) -> Iterator[Row]:
    states = [(name, offered(offer, name)) for name in PRINCIPAL] + [
        (name, offered(offer, name, True)) for name in PRINCIPAL_EXTENSIONS
    ]
    yield "not supported", ", ".join(name for name, state in states if state is False)
    unknown = "not guaranteed" if offer.profile.minimum else "not known"
    yield unknown, ", ".join(name for name, state in states if state is None)


def _compression(compression: dict[int, tuple[float, float]]) -> str:
    parts = [
        f"{count}x reads {read:g}, writes {write:g}" for count, (read, write) in compression.items()
    ]
    return "; ".join(parts) + " of plain arithmetic"

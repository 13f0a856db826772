"""What a device offers for multisampling, put together from its profile, its report and the shares
of other devices.
"""

from typing import NamedTuple

from msaa_lint.frame.vulkan.formats import format_of

from . import DeviceProfile, builtin
from .builtin_profiles import RECORDED
from .reports.members import Details, Report
from .shares import lazily_allocated_share, resolve_mode_share, sample_count_share
from .tile_models import MODELS
from .tiles import tile_use

COUNTS = (1, 2, 4, 8, 16, 32, 64)
RECORDED_FEATURES = ("sampleRateShading",)
"""The features whose absence from a built-in profile of a device says that the device does not
offer them.
"""

DEFAULT_EFFICIENT_SAMPLES = 4
TILE_FORMAT = "R8G8B8A8_UNORM"


class Tile(NamedTuple):
    """The tile with one RGBA8 attachment at a sample count: pixels, and whether even the smallest
    does not hold it.
    """

    samples: int
    pixels: int
    spills: bool


class Offer(NamedTuple):
    """A device to be shown. `recorded_features` and `recorded_extensions` are what the source
    looked for, None where it lists all.

    `key` is the built-in profile's name, or the path of the report: what a description's `device`
    can say.
    """

    report: Report
    key: str | None = None
    recorded_features: tuple[str, ...] | None = None
    recorded_extensions: tuple[str, ...] | None = None

    @property
    def profile(self) -> DeviceProfile:
        """The device's profile."""
        return self.report.profile

    @property
    def details(self) -> Details:
        """What only reports have."""
        return self.report.details


def builtin_offer(name: str) -> Offer | None:
    """The offer of a built-in profile; None if there is none with that name."""
    found = builtin(name)
    return Offer(Report(found), name, RECORDED_FEATURES, RECORDED) if found is not None else None


def counts_of(offer: Offer) -> dict[str, tuple[int, ...] | None]:
    """Sample counts by use, of attachments first. None is unknown."""
    profile = offer.profile
    return {
        "color": profile.color_samples,
        "depth": profile.depth_samples,
        "stencil": profile.stencil_samples,
        "integer": profile.integer_samples,
        **offer.details.counts,
    }


def offered(offer: Offer, name: str, extension: bool = False) -> bool | None:
    """Whether a device offers a feature or an extension. None: the source does not say, or a class
    of devices does not guarantee it.
    """
    listed = offer.profile.extensions if extension else offer.profile.features
    recorded = offer.recorded_extensions if extension else offer.recorded_features
    if listed is None:
        return None
    if name in listed:
        return True
    return (
        None if offer.profile.minimum or (recorded is not None and name not in recorded) else False
    )


def lazily_allocated(profile: DeviceProfile) -> bool | None:
    """Whether there is memory that is taken only when it is written to; None where memory types are
    not known.
    """
    if profile.memory_types is None:
        return None
    found = any("LAZILY_ALLOCATED" in flags for flags in profile.memory_types)
    return True if found else (None if profile.minimum else False)


def tiles(profile: DeviceProfile) -> list[Tile]:
    """The tile at each sample count of color with one RGBA8 attachment; empty where the device's
    tiles are not known.
    """
    format = format_of(TILE_FORMAT)
    if profile.tile is None or format is None:
        return []
    found = [
        (count, tile_use(profile.tile, [(format, count)], None))
        for count in profile.color_samples or ()
    ]
    return [Tile(count, use.pixels, use.spills) for count, use in found if use is not None]


def tile_model(profile: DeviceProfile) -> str | None:
    """The name of the device's tile model, where it has one."""
    return (
        next((name for name, model in MODELS.items() if model == profile.tile), None)
        if profile.tile is not None
        else None
    )


def shares(profile: DeviceProfile) -> dict[str, object]:
    """Per cent of devices, and of tile-based ones: by sample count of color, by depth resolve
    mode; lazily allocated memory by vendor.
    """
    return {
        "samples": {
            count: {"all": sample_count_share(count), "tilers": sample_count_share(count, True)}
            for count in COUNTS
        },
        "depth_resolve_modes": {
            mode: {"all": resolve_mode_share(mode), "tilers": resolve_mode_share(mode, True)}
            for mode in ("SAMPLE_ZERO", "AVERAGE", "MIN", "MAX")
        },
        "lazily_allocated_of_vendor": lazily_allocated_share(profile.vendor)
        if profile.vendor is not None
        else None,
    }


def record(offer: Offer) -> dict[str, object]:
    """The device as `msaa-lint device --output json` has it (docs/devices.md). None is unknown."""
    profile, details = offer.profile, offer.details
    return {
        "name": profile.name,
        "key": offer.key,
        "vendor": profile.vendor,
        "tiler": profile.tiler,
        "minimum": profile.minimum,
        "api_version": profile.api_version,
        "device_type": details.device_type,
        "driver": details.driver,
        "sample_counts": counts_of(offer),
        "depth_resolve_modes": profile.depth_resolve_modes,
        "stencil_resolve_modes": profile.stencil_resolve_modes,
        "independent_resolve": profile.independent_resolve,
        "independent_resolve_none": profile.independent_resolve_none,
        "memory_types": profile.memory_types,
        "lazily_allocated": lazily_allocated(profile),
        "heaps": [{"bytes": size, "device_local": local} for size, local in details.heaps]
        if details.heaps is not None
        else None,
        "features": profile.features,
        "features_recorded": offer.recorded_features,
        "extensions": profile.extensions,
        "extensions_recorded": offer.recorded_extensions,
        "max_efficient_samples": profile.max_efficient_samples,
        "standard_sample_locations": details.standard_sample_locations,
        "sub_pixel_precision_bits": details.sub_pixel_precision_bits,
        "max_framebuffer": details.max_framebuffer,
        "max_color_attachments": details.max_color_attachments,
        "tile_model": tile_model(profile),
        "tiles_rgba8": [tile._asdict() for tile in tiles(profile)],
        "compression": {
            count: {"read": pair[0], "write": pair[1]}
            for count, pair in profile.compression.items()
        }
        if profile.compression is not None
        else None,
        "compression_most": dict(zip(("read", "write"), profile.compression_most, strict=True))
        if profile.compression_most
        else None,
        "shares": shares(profile),
        "source": profile.source,
        "notes": offer.report.notes,
    }

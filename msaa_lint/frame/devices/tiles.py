"""How many pixels a tile has, by what a pixel takes on it. Smaller tiles are more tiles: more
binning, more loads and stores of edges.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.frame.vulkan.formats import Format

from .tile_models import TileModel


class TileUse(NamedTuple):
    """What one pixel takes on the tile, and how many pixels a tile then has; `full` is the tile at
    one sample, `spills` where even the smallest does not fit.
    """

    bytes_per_pixel: int
    pixels: int
    full: int
    spills: bool


Targets = Sequence[tuple[Format, int]]
"""Color attachments: format, and samples a pixel."""

SMALLEST = {"mali": 16, "apple": 256, "v3d4": 64, "v3d7": 64, "powervr": 256, "adreno": 1}
"""Pixels of the smallest tile of each kind."""

V3D_SAMPLES = (1, 4)
V3D_TILES = (4096, 2048, 1024, 512, 256, 128, 64)
APPLE_TILES = (1024, 512, 256)
APPLE_SAMPLE_BYTES = 64
POWERVR_TILES = {1: 1024, 2: 1024, 4: 512, 8: 256}


def tile_use(model: TileModel, colors: Targets, depth: tuple[Format, int] | None) -> TileUse | None:
    """The tile of a subpass with these color attachments and depth-stencil attachment; None
    without any, or beyond what the model says.

    `bytes_per_pixel` are those on the tile, of all samples: color, and depth where the model
    counts it in the same memory (Adreno).
    """
    if not colors and depth is None:
        return None
    samples = max(count for _, count in (*colors, *([depth] if depth is not None else [])))
    used = _USES[model.kind](model, colors, depth, samples)
    single = _USES[model.kind](
        model,
        [(format, 1) for format, _ in colors],
        (depth[0], 1) if depth is not None else None,
        1,
    )
    if used is None or single is None:
        return None
    bytes_per_pixel, pixels = used
    least = SMALLEST[model.kind]
    return TileUse(bytes_per_pixel, max(pixels, least), max(single[1], least), pixels < least)


def _mali(
    model: TileModel, colors: Targets, depth: tuple[Format, int] | None, samples: int
) -> tuple[int, int]:
    """The largest power of two that fits in the budgets; 2 samples take what 4 do where they are
    promoted.

    Blendable formats take 4 bytes, others their size rounded up to a power of two.
    """
    promoted = {2: 4} if model.promotes else {}
    samples = promoted.get(samples, samples)
    size = sum(
        (4 if _blendable(format) else _power_of_two(format.bytes)) * promoted.get(count, count)
        for format, count in colors
    )
    pixels = model.max_pixels
    if size:
        fitting = model.color_bytes // _power_of_two(size)
        if fitting < SMALLEST["mali"]:
            fitting = model.limit_bytes // _power_of_two(size)
        pixels = min(pixels, fitting)
    # The tile keeps 32 bits of depth for every sample, whatever the format, and room for it where
    # nothing is attached.
    return size, min(pixels, max(model.depth_bytes // _power_of_two(4 * samples), SMALLEST["mali"]))


def _blendable(format: Format) -> bool:
    """Normalised formats of at most 10 bits a component, which the tile holds as 32 bits."""
    return (
        format.numeric in ("UNORM", "SRGB")
        and bool(format.components)
        and all(0 < bits <= 10 for _, bits in format.components)
    )


def _power_of_two(number: int) -> int:
    return 1 << (number - 1).bit_length()


def _apple(
    model: TileModel, colors: Targets, depth: tuple[Format, int] | None, samples: int
) -> tuple[int, int]:
    """Color alone lies in the tile buffer, a sample in multiples of 8 bytes; beyond 64 render
    targets go to memory.
    """
    sample = 0
    for size in (_power_of_two(format.bytes) for format, _ in colors):
        sample = -(-sample // size) * size + size
    sample = -(-sample // 8) * 8
    size = sample * samples
    fitting = next((pixels for pixels in APPLE_TILES if size * pixels <= model.color_bytes), 0)
    return size, fitting if sample <= APPLE_SAMPLE_BYTES else 0


def _v3d_words(format: Format) -> int:
    """32-bit words of a pixel in the tile buffer: 1, 2 or 4. sRGB, 10-bit and small float colors
    are kept as four 16-bit floats.
    """
    widest = max((bits for _, bits in format.components), default=8)
    if widest > 16:
        return _power_of_two(len(format.components))
    if widest <= 8:
        return 2 if format.numeric == "SRGB" else 1
    return 1 if format.is_integer and format.bytes <= 4 and widest == 16 else 2


def _v3d7(
    model: TileModel, colors: Targets, depth: tuple[Format, int] | None, samples: int
) -> tuple[int, int] | None:
    """The first tile size whose color and depth fit; color may take the depth's memory where
    depth fits in an auxiliary half of it.
    """
    if samples not in V3D_SAMPLES:
        return None
    size = 4 * sum(_v3d_words(format) for format, _ in colors) * samples
    for pixels in V3D_TILES:
        under = pixels * 4 * samples
        aside = under <= model.depth_bytes // 2 and pixels * size <= model.limit_bytes
        if aside or (under <= model.depth_bytes and pixels * size <= model.color_bytes):
            return size, pixels
    return size, 0


def _v3d4(
    model: TileModel, colors: Targets, depth: tuple[Format, int] | None, samples: int
) -> tuple[int, int] | None:
    """A step down the sizes for more render targets, for multisampling two, and for wider
    formats.
    """
    if samples not in V3D_SAMPLES:
        return None
    words = [_v3d_words(format) for format, _ in colors]
    step = 3 if len(words) > 4 else 2 if len(words) > 2 else 1 if len(words) > 1 else 0
    step += (2 if samples > 1 else 0) + max((count.bit_length() - 1 for count in words), default=0)
    return 4 * sum(words) * samples, V3D_TILES[step] if step < len(V3D_TILES) else 0


def _powervr(
    model: TileModel, colors: Targets, depth: tuple[Format, int] | None, samples: int
) -> tuple[int, int] | None:
    """By the sample count alone."""
    size = sum(format.bytes * count for format, count in colors)
    return None if samples not in POWERVR_TILES else (size, POWERVR_TILES[samples])


def _adreno(
    model: TileModel, colors: Targets, depth: tuple[Format, int] | None, samples: int
) -> tuple[int, int]:
    """Every attachment lies in GMEM, stencil beside depth where the format keeps them apart."""
    size = sum(
        format.bytes * samples
        for format, samples in [*colors, *([depth] if depth is not None else [])]
    )
    return size, model.color_bytes // size


_USES = {
    "mali": _mali,
    "apple": _apple,
    "v3d4": _v3d4,
    "v3d7": _v3d7,
    "powervr": _powervr,
    "adreno": _adreno,
}


def bins(width: int, height: int, bytes_per_pixel: int, gmem: int) -> int:
    """The least number of bins of an Adreno: ceil(width * height * bytes / GMEM)."""
    return -(-width * height * bytes_per_pixel // gmem)

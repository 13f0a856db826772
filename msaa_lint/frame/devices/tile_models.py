"""What a tile holds: the budgets of tile-based GPUs, as their open-source drivers reckon. Vendors'
own drivers may choose otherwise.
"""

from collections.abc import Mapping
from typing import NamedTuple

from msaa_lint.core.suggestions import did_you_mean

PANFROST = "Mesa, Panfrost (pan_desc.c, pan_props.h, pan_model.c)"
DATASHEET = (
    "Arm GPU Datasheet 102849, version 7: 256 bits a pixel of G31, G51 and G52; depth: " + PANFROST
)
ASAHI = "Mesa, Asahi (agx_tilebuffer.c): 32767 bytes a tile, 64 bytes a sample, of G13"
V3D = "Mesa, V3D (v3d_util.c, v3d_choose_tile_size)"
IMAGINATION = (
    "Imagination, Performance Recommendations: MSAA Performance (32x32, 32x16, 16x16; 2x virtually "
    "free); by samples: the Linux kernel's "
    "pvr_rogue_cr_defs_client.h, ROGUE_CR_TE_AA, for 2 ISP samples a pixel"
)
MSM = "Linux kernel, msm driver: adreno_info.gmem of {}"
META = "Meta, Mobile GPUs and improved algorithms: about 1 MB on the chip of Quest-class Adrenos"


class TileModel(NamedTuple):
    """How a GPU sizes its tiles; `tiles.py` reckons by it.

    `kind` is the formula: `mali`, `apple`, `v3d4`, `v3d7`, `powervr` or `adreno`. `color_bytes` is
    what color may take of a tile, `depth_bytes` what depth may, `max_pixels` the largest tile;
    `limit_bytes` what color may take where less than the smallest tile would be left otherwise (a
    Mali keeps half of its memory for the next tile, and gives that up). An Adreno's `color_bytes`
    is its whole GMEM. `promotes`: 2 samples a pixel are kept as 4.
    """

    kind: str
    color_bytes: int = 0
    depth_bytes: int = 0
    max_pixels: int = 0
    limit_bytes: int = 0
    source: str = ""
    promotes: bool = False


def _mali(color: int, depth: int, most: int, halved: bool) -> TileModel:
    """By the sizes of the tile buffers; half of each is kept for the next tile, but on
    architectures 4 and 6.

    From G71 on and before the fifth generation, whose tiles are larger, 2 samples are promoted to 4
    (Arm GPU Datasheet 102849, version 7).
    """
    share = 2 if halved else 1
    return TileModel("mali", color // share, depth // share, most, color, PANFROST, most < 4096)


MODELS: dict[str, TileModel] = {
    "mali-t760": _mali(8192, 8192, 256, True)._replace(promotes=False),
    "mali-g71": _mali(4096, 4096, 256, False),
    "mali-g72": _mali(8192, 4096, 256, False),
    "mali-g51": TileModel("mali", 8192, 4096, 256, 8192, DATASHEET, True),
    "mali-g76": _mali(16384, 8192, 256, True),
    "mali-g610": _mali(32768, 16384, 1024, True),
    "mali-g720": _mali(65536, 32768, 4096, True),
    "mali-g725": _mali(65536, 65536, 4096, True),
    "apple-g13": TileModel("apple", 32767, 0, 1024, 32767, ASAHI),
    "v3d-4": TileModel("v3d4", 0, 0, 4096, 0, V3D),
    "v3d-7": TileModel("v3d7", 16384, 16384, 4096, 32768, V3D),
    "powervr": TileModel("powervr", 0, 0, 1024, 0, IMAGINATION),
    "adreno-740": TileModel("adreno", 3 * 2**20, 0, 0, 3 * 2**20, MSM.format("Adreno 740: 3 MiB")),
    "adreno-quest": TileModel("adreno", 2**20, 0, 0, 2**20, META),
}
"""Tile models by name. T760 stands for T760 to T880; G51 for G31 and G52 r1; G76 for G52, G57 and
G310 v1-3; G610 for G310 v4-5 and what is between it and G720.
"""

MAX_BYTES = 2**31
KINDS = {
    "mali": {"colorBytes": True, "depthBytes": True, "maxPixels": True, "limitBytes": False},
    "adreno": {"gmemBytes": True},
}
"""The kinds that a description may state by numbers: whether each number is required."""


class Misstated(NamedTuple):
    """A mistake in a mapping: its key (None: the mapping as a whole), a message, and help."""

    key: str | None
    message: str
    help: str


def stated_tile(mapping: Mapping[str, float | str | None] | None) -> TileModel | Misstated | None:
    """The tile model that a device mapping's `tile` states: `{model: mali-g76}`, or a kind and its
    numbers. None without a mapping.

    `{kind: mali, colorBytes: 8192, depthBytes: 4096, maxPixels: 256}` or `{kind: adreno, gmemBytes:
    1048576}`.
    """
    if mapping is None:
        return None
    if "model" in mapping:
        extra = next((key for key in mapping if key != "model"), None)
        if extra is not None:
            return Misstated(
                extra,
                f"`{extra[:40]}` cannot be combined with `model`; state `kind` instead of `model`",
                "",
            )
        name = mapping["model"]
        found = MODELS.get(name) if isinstance(name, str) else None
        return found or Misstated(
            "model", f"unknown tile model `{str(name)[:40]}`", f"write one of {', '.join(MODELS)}"
        )
    kind = mapping.get("kind")
    numbers = KINDS.get(kind) if isinstance(kind, str) else None
    if numbers is None:
        where = "kind" if "kind" in mapping else None
        help = f"the kinds are {', '.join(KINDS)}; the models are {', '.join(MODELS)}"
        return Misstated(where, "a tile needs a `model` or a `kind`", help)
    for key, value in mapping.items():
        if key != "kind" and key not in numbers:
            return Misstated(
                key,
                f"unknown key `{key[:40]}` for kind {kind}{did_you_mean(key, numbers, ': ')}",
                f"the keys are {', '.join(numbers)}",
            )
        if key != "kind" and not (isinstance(value, int) and 16 <= value <= MAX_BYTES):
            return Misstated(key, f"`{key}` must be an integer from 16 to {MAX_BYTES}", "")
    lacking = next((key for key, needed in numbers.items() if needed and key not in mapping), None)
    if lacking is not None:
        return Misstated(None, f"kind {kind} needs `{lacking}`", "")
    sizes = {key: int(value) for key, value in mapping.items() if isinstance(value, (int, float))}
    if kind == "adreno":
        return TileModel("adreno", sizes["gmemBytes"], 0, 0, sizes["gmemBytes"], "the description")
    color = sizes["colorBytes"]
    return TileModel(
        "mali",
        color,
        sizes["depthBytes"],
        sizes["maxPixels"],
        max(sizes.get("limitBytes", color), color),
        "the description",
    )


Compression = dict[int, tuple[float, float]]
"""By sample count: the measured bytes read and written, relative to plain arithmetic."""

COUNTS = ("1", "2", "4", "8", "16", "32", "64")
MAX_RATIO = 16


MOST = ("most read", "most write")
"""Keys beside those of sample counts: what was measured at most of any image, where the other
ratios are the least.
"""


def stated_most(mapping: Mapping[str, float | None] | None) -> tuple[float, float] | None:
    """The most that a device mapping's `compression` states for reads and writes; None unless it
    states both.
    """
    read, write = ((mapping or {}).get(key) for key in MOST)
    return None if read is None or write is None else (read, write)


def stated_compression(
    mapping: Mapping[str, float | None] | None,
) -> Compression | Misstated | None:
    """The compression that a device mapping's `compression` states: by sample count, one ratio or
    separate ratios for reads and writes.

    `{1: 0.5, 4: 1.0}`, or `{1 read: 0.48, 1 write: 0.46, 4: 1.0}`. `stated_most` reads the two keys
    of MOST.
    """
    if mapping is None:
        return None
    found: dict[int, list[float | None]] = {}
    for key, value in mapping.items():
        if key in MOST and value is not None and 0 < value <= MAX_RATIO:
            continue
        text, _, direction = key.partition(" ")
        if text not in COUNTS or direction not in ("", "read", "write"):
            return Misstated(
                key,
                f"`{key[:40]}` is not a sample count",
                "a key is a sample count, optionally followed by ` read` or ` write`",
            )
        if value is None or not 0 < value <= MAX_RATIO:
            return Misstated(
                key,
                f"`{key}` must be above 0 and at most {MAX_RATIO}",
                "1 is the traffic of plain arithmetic, 0.5 half of it",
            )
        pair = found.setdefault(int(text), [None, None])
        for n, name in enumerate(("read", "write")):
            if direction == name or (not direction and f"{text} {name}" not in mapping):
                pair[n] = float(value)
    for count, (read, write) in found.items():
        if read is None or write is None:
            stated, lacking = ("write", "read") if read is None else ("read", "write")
            return Misstated(
                f"{count} {stated}",
                f"`{count} {stated}` needs `{count} {lacking}`; state both, or the count alone",
                "",
            )
    return {
        count: (read, write)
        for count, (read, write) in found.items()
        if read is not None and write is not None
    }

"""Vulkan's formats: their sizes, aspects, components and numeric types."""

from functools import cache
from typing import NamedTuple

from .formats_table import ARM_FLOAT_BLEND, ROWS


class Format(NamedTuple):
    """A VkFormat, by its canonical short name.

    `bytes` is what one texel block takes as it is allocated: 4 for D24_UNORM_S8_UINT, where both
    aspects share a word, and by convention 5 for D32_SFLOAT_S8_UINT, whose aspects drivers keep
    apart (4 + 1). `block` is the block's extent in texels, (1, 1, 1) but for compressed and
    chroma-subsampled formats. `numeric` is the color's type (empty without color), `components`
    the components in the order of the name with their bits (0 where compressed); widths of depth
    and stencil are 0 and their types empty where there is none.
    """

    name: str
    bytes: int
    block: tuple[int, int, int]
    aspects: tuple[str, ...]
    numeric: str
    components: tuple[tuple[str, int], ...]
    depth_bits: int
    depth_type: str
    stencil_bits: int
    stencil_type: str
    compressed: bool
    ycbcr: bool

    @property
    def is_srgb(self) -> bool:
        """Whether values are stored with the sRGB transfer function."""
        return self.numeric == "SRGB"

    @property
    def is_integer(self) -> bool:
        """Whether the color has integers, which cannot be averaged."""
        return self.numeric in ("UINT", "SINT")

    @property
    def is_float16(self) -> bool:
        """Whether every color component is a 16-bit float."""
        return self.numeric == "SFLOAT" and all(bits == 16 for _, bits in self.components)

    @property
    def arm_float_blend(self) -> bool:
        """Whether it is a float format that Mali GPUs do not blend at full rate when
        multisampled.
        """
        return self.name in ARM_FLOAT_BLEND

    @property
    def depth_bytes(self) -> int:
        """The bytes of the depth aspect per texel: 2, 3 or 4; 0 without depth."""
        return self.depth_bits // 8

    @property
    def stencil_bytes(self) -> int:
        """The bytes of the stencil aspect per texel: 1, or 0 without stencil."""
        return self.stencil_bits // 8


def format_of(name: str) -> Format | None:
    """The format with a canonical short name (`R8G8B8A8_UNORM`); None for UNDEFINED and unknown
    names.
    """
    row = ROWS.get(name)
    return None if row is None else _read(name, row)


@cache
def _read(name: str, text: str) -> Format:
    size, extent, numeric, parts, scheme = text.split()
    depth, stencil = (0, ""), (0, "")
    components = []
    for part in parts.split(","):
        width, _, kind = part[1:].partition(":")
        if kind and part[0] == "D":
            depth = int(width), kind
        elif kind:
            stencil = int(width), kind
        else:
            components.append((part[0], int(width)))
    x, y, z = map(int, extent.split("x"))
    aspects = tuple(
        a
        for a, there in (("color", components), ("depth", depth[0]), ("stencil", stencil[0]))
        if there
    )
    ycbcr = scheme.startswith("YCBCR")
    kind = "" if numeric == "-" else numeric
    return Format(
        name,
        int(size),
        (x, y, z),
        aspects,
        kind,
        tuple(components),
        *depth,
        *stencil,
        not ycbcr and scheme != "-",
        ycbcr,
    )

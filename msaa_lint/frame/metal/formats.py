"""MTLPixelFormat: each format, and the VkFormat with the same bits; empty if Vulkan has none.

Metal names components from the least significant bit of a packed format up, Vulkan's `PACK` names
from the most significant one down.
"""

from __future__ import annotations

_BLOCKS = (
    "4x4",
    "5x4",
    "5x5",
    "6x5",
    "6x6",
    "8x5",
    "8x6",
    "8x8",
    "10x5",
    "10x6",
    "10x8",
    "10x10",
    "12x10",
    "12x12",
)

_ASTC = {"srgb": "SRGB", "ldr": "UNORM", "hdr": "SFLOAT"}

_NUMERIC = {
    "Unorm": "UNORM",
    "Snorm": "SNORM",
    "Uint": "UINT",
    "Sint": "SINT",
    "Float": "SFLOAT",
    "Unorm_srgb": "SRGB",
}

_KINDS: dict[int, tuple[str, ...]] = {
    8: ("Unorm", "Unorm_srgb", "Snorm", "Uint", "Sint"),
    16: ("Unorm", "Snorm", "Uint", "Sint", "Float"),
    32: ("Uint", "Sint", "Float"),
}


def _plain() -> dict[str, str]:
    """Formats such as `rgba8Unorm`, whose components have one width."""
    named = [
        (letters, bits, kind)
        for letters in ("r", "rg", "rgba")
        for bits, kinds in _KINDS.items()
        for kind in kinds
    ]
    named += [("bgra", 8, "Unorm"), ("bgra", 8, "Unorm_srgb")]
    return {
        f"{letters}{bits}{kind}": "".join(f"{letter}{bits}" for letter in letters.upper())
        + f"_{_NUMERIC[kind]}"
        for letters, bits, kind in named
    }


PIXEL_FORMATS: dict[str, str] = {
    "invalid": "",
    "a8Unorm": "A8_UNORM",
    **_plain(),
    "b5g6r5Unorm": "R5G6B5_UNORM_PACK16",
    "a1bgr5Unorm": "R5G5B5A1_UNORM_PACK16",
    "abgr4Unorm": "R4G4B4A4_UNORM_PACK16",
    "bgr5A1Unorm": "A1R5G5B5_UNORM_PACK16",
    "rgb10a2Unorm": "A2B10G10R10_UNORM_PACK32",
    "rgb10a2Uint": "A2B10G10R10_UINT_PACK32",
    "bgr10a2Unorm": "A2R10G10B10_UNORM_PACK32",
    "rg11b10Float": "B10G11R11_UFLOAT_PACK32",
    "rgb9e5Float": "E5B9G9R9_UFLOAT_PACK32",
    "bgr10_xr": "",
    "bgr10_xr_srgb": "",
    "bgra10_xr": "",
    "bgra10_xr_srgb": "",
    "bc1_rgba": "BC1_RGBA_UNORM_BLOCK",
    "bc1_rgba_srgb": "BC1_RGBA_SRGB_BLOCK",
    "bc2_rgba": "BC2_UNORM_BLOCK",
    "bc2_rgba_srgb": "BC2_SRGB_BLOCK",
    "bc3_rgba": "BC3_UNORM_BLOCK",
    "bc3_rgba_srgb": "BC3_SRGB_BLOCK",
    "bc4_rUnorm": "BC4_UNORM_BLOCK",
    "bc4_rSnorm": "BC4_SNORM_BLOCK",
    "bc5_rgUnorm": "BC5_UNORM_BLOCK",
    "bc5_rgSnorm": "BC5_SNORM_BLOCK",
    "bc6H_rgbFloat": "BC6H_SFLOAT_BLOCK",
    "bc6H_rgbuFloat": "BC6H_UFLOAT_BLOCK",
    "bc7_rgbaUnorm": "BC7_UNORM_BLOCK",
    "bc7_rgbaUnorm_srgb": "BC7_SRGB_BLOCK",
    **{
        f"pvrtc_{letters}_{bits}bpp{suffix}": f"PVRTC1_{bits}BPP_{numeric}_BLOCK_IMG"
        for letters in ("rgb", "rgba")
        for bits in (2, 4)
        for suffix, numeric in (("", "UNORM"), ("_srgb", "SRGB"))
    },
    "eac_r11Unorm": "EAC_R11_UNORM_BLOCK",
    "eac_r11Snorm": "EAC_R11_SNORM_BLOCK",
    "eac_rg11Unorm": "EAC_R11G11_UNORM_BLOCK",
    "eac_rg11Snorm": "EAC_R11G11_SNORM_BLOCK",
    "eac_rgba8": "ETC2_R8G8B8A8_UNORM_BLOCK",
    "eac_rgba8_srgb": "ETC2_R8G8B8A8_SRGB_BLOCK",
    "etc2_rgb8": "ETC2_R8G8B8_UNORM_BLOCK",
    "etc2_rgb8_srgb": "ETC2_R8G8B8_SRGB_BLOCK",
    "etc2_rgb8a1": "ETC2_R8G8B8A1_UNORM_BLOCK",
    "etc2_rgb8a1_srgb": "ETC2_R8G8B8A1_SRGB_BLOCK",
    **{
        f"astc_{block}_{kind}": f"ASTC_{block}_{numeric}_BLOCK"
        for block in _BLOCKS
        for kind, numeric in _ASTC.items()
    },
    "gbgr422": "G8B8G8R8_422_UNORM",
    "bgrg422": "B8G8R8G8_422_UNORM",
    "depth16Unorm": "D16_UNORM",
    "depth32Float": "D32_SFLOAT",
    "stencil8": "S8_UINT",
    "depth24Unorm_stencil8": "D24_UNORM_S8_UINT",
    "depth32Float_stencil8": "D32_SFLOAT_S8_UINT",
    "x32_stencil8": "",
    "x24_stencil8": "",
}
"""By Swift's name. The formats with extended range (`_xr`), and the views of stencil alone
(`x32_stencil8`), have no VkFormat.
"""

"""Metal's enumerants: every spelling, and the VkFormat of each pixel format."""

from __future__ import annotations

import pytest

from msaa_lint.frame.metal.formats import PIXEL_FORMATS
from msaa_lint.frame.metal.names import (
    ENUMS,
    nearest_to,
    objective_c,
    parse,
    parse_options,
    spelled,
    spellings,
)
from msaa_lint.frame.vulkan.formats import format_of


def test_pixel_formats_are_vulkans_formats() -> None:
    for name, vulkan in PIXEL_FORMATS.items():
        if vulkan:
            found = format_of(vulkan)
            assert found is not None and found.name == vulkan, name
    assert {name for name, vulkan in PIXEL_FORMATS.items() if not vulkan} == {
        "invalid",
        "bgr10_xr",
        "bgr10_xr_srgb",
        "bgra10_xr",
        "bgra10_xr_srgb",
        "x32_stencil8",
        "x24_stencil8",
    }


@pytest.mark.parametrize(
    ("name", "bits", "bytes_"),
    [
        ("b5g6r5Unorm", [("R", 5), ("G", 6), ("B", 5)], 2),
        ("rgb10a2Unorm", [("A", 2), ("B", 10), ("G", 10), ("R", 10)], 4),
        ("rg11b10Float", [("B", 10), ("G", 11), ("R", 11)], 4),
        ("bgra8Unorm_srgb", [("B", 8), ("G", 8), ("R", 8), ("A", 8)], 4),
        ("rgba16Float", [("R", 16), ("G", 16), ("B", 16), ("A", 16)], 8),
    ],
)
def test_components_are_the_same(name: str, bits: list[tuple[str, int]], bytes_: int) -> None:
    found = format_of(PIXEL_FORMATS[name])
    assert found is not None
    assert (list(found.components), found.bytes) == (bits, bytes_)


@pytest.mark.parametrize(
    ("enum", "name", "theirs"),
    [
        ("MTLPixelFormat", "bgra8Unorm_srgb", "MTLPixelFormatBGRA8Unorm_sRGB"),
        ("MTLPixelFormat", "depth32Float_stencil8", "MTLPixelFormatDepth32Float_Stencil8"),
        ("MTLPixelFormat", "rgb10a2Unorm", "MTLPixelFormatRGB10A2Unorm"),
        ("MTLPixelFormat", "rg11b10Float", "MTLPixelFormatRG11B10Float"),
        ("MTLPixelFormat", "bgr5A1Unorm", "MTLPixelFormatBGR5A1Unorm"),
        ("MTLPixelFormat", "bgr10_xr_srgb", "MTLPixelFormatBGR10_XR_sRGB"),
        ("MTLPixelFormat", "bc7_rgbaUnorm_srgb", "MTLPixelFormatBC7_RGBAUnorm_sRGB"),
        ("MTLPixelFormat", "pvrtc_rgba_4bpp", "MTLPixelFormatPVRTC_RGBA_4BPP"),
        ("MTLPixelFormat", "astc_4x4_hdr", "MTLPixelFormatASTC_4x4_HDR"),
        ("MTLPixelFormat", "stencil8", "MTLPixelFormatStencil8"),
        ("MTLTextureType", "type2DMultisampleArray", "MTLTextureType2DMultisampleArray"),
        ("MTLTextureType", "typeCube", "MTLTextureTypeCube"),
        (
            "MTLStoreAction",
            "storeAndMultisampleResolve",
            "MTLStoreActionStoreAndMultisampleResolve",
        ),
        ("MTLMultisampleDepthResolveFilter", "sample0", "MTLMultisampleDepthResolveFilterSample0"),
        ("MTLGPUFamily", "apple10", "MTLGPUFamilyApple10"),
    ],
)
def test_objective_cs_names(enum: str, name: str, theirs: str) -> None:
    assert objective_c(enum, name) == theirs
    for text in (name, f".{name}", f"{enum}.{name}", theirs):
        assert parse(enum, text) == name
        assert spelled(enum, name, text) == text


@pytest.mark.parametrize("enum", ENUMS)
def test_a_spelling_is_of_one_enumerant(enum: str) -> None:
    assert len(spellings(enum)) == len(set(spellings(enum))) == 4 * len(ENUMS[enum])
    assert parse(enum, "") is None and parse(enum, ENUMS[enum][0].upper() + "?") is None


@pytest.mark.parametrize(
    ("enum", "word", "meant"),
    [
        ("MTLStoreAction", "multisampleResove", "multisampleResolve"),
        ("MTLStoreAction", "DONT_CARE", "dontCare"),
        ("MTLStoreAction", "MTLStoreActionStoreAndMultisampleResolv", "storeAndMultisampleResolve"),
        ("MTLPixelFormat", ".bgra8unorm", "bgra8Unorm"),
        ("MTLTextureUsage", "rendertarget", "renderTarget"),
        ("MTLStorageMode", "memoryles", "memoryless"),
        ("MTLLoadAction", "x" * 200, None),
        ("MTLLoadAction", "zzz", None),
    ],
)
def test_the_nearest_word(enum: str, word: str, meant: str | None) -> None:
    assert nearest_to(enum, word) == meant


def test_options_are_joined() -> None:
    assert parse_options(
        "MTLTextureUsage", "MTLTextureUsageShaderRead | .renderTarget|shaderRead"
    ) == ["shaderRead", "renderTarget"]
    with pytest.raises(ValueError, match=r"^shaderReed$"):
        parse_options("MTLTextureUsage", "shaderReed | renderTarget")

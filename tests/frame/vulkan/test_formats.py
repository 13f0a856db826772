"""Formats against what the Vulkan specification says of them."""

from __future__ import annotations

import pytest

from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.frame.vulkan.formats import format_of
from msaa_lint.frame.vulkan.formats_table import ARM_FLOAT_BLEND, ROWS


@pytest.mark.parametrize(
    ("name", "size", "numeric", "components"),
    [
        ("R8G8B8A8_UNORM", 4, "UNORM", (("R", 8), ("G", 8), ("B", 8), ("A", 8))),
        ("B8G8R8A8_SRGB", 4, "SRGB", (("B", 8), ("G", 8), ("R", 8), ("A", 8))),
        ("A2B10G10R10_UNORM_PACK32", 4, "UNORM", (("A", 2), ("B", 10), ("G", 10), ("R", 10))),
        ("B10G11R11_UFLOAT_PACK32", 4, "UFLOAT", (("B", 10), ("G", 11), ("R", 11))),
        ("R5G6B5_UNORM_PACK16", 2, "UNORM", (("R", 5), ("G", 6), ("B", 5))),
        ("R16G16B16A16_SFLOAT", 8, "SFLOAT", (("R", 16), ("G", 16), ("B", 16), ("A", 16))),
        ("R32G32B32A32_SFLOAT", 16, "SFLOAT", (("R", 32), ("G", 32), ("B", 32), ("A", 32))),
        ("R8_UINT", 1, "UINT", (("R", 8),)),
        ("R32_SINT", 4, "SINT", (("R", 32),)),
        ("R8G8_SNORM", 2, "SNORM", (("R", 8), ("G", 8))),
        ("R64G64B64A64_SFLOAT", 32, "SFLOAT", (("R", 64), ("G", 64), ("B", 64), ("A", 64))),
    ],
)
def test_colour(
    name: str, size: int, numeric: str, components: tuple[tuple[str, int], ...]
) -> None:
    found = format_of(name)
    assert found is not None
    assert (found.name, found.bytes, found.numeric, found.components) == (
        name,
        size,
        numeric,
        components,
    )
    assert (found.aspects, found.block, found.compressed, found.ycbcr) == (
        ("color",),
        (1, 1, 1),
        False,
        False,
    )
    assert (found.depth_bits, found.depth_type, found.stencil_bits, found.stencil_type) == (
        0,
        "",
        0,
        "",
    )
    assert (found.depth_bytes, found.stencil_bytes) == (0, 0)


@pytest.mark.parametrize(
    ("name", "size", "depth", "stencil", "depth_bytes"),
    [
        ("D16_UNORM", 2, (16, "UNORM"), (0, ""), 2),
        ("X8_D24_UNORM_PACK32", 4, (24, "UNORM"), (0, ""), 3),
        ("D32_SFLOAT", 4, (32, "SFLOAT"), (0, ""), 4),
        ("S8_UINT", 1, (0, ""), (8, "UINT"), 0),
        ("D16_UNORM_S8_UINT", 3, (16, "UNORM"), (8, "UINT"), 2),
        ("D24_UNORM_S8_UINT", 4, (24, "UNORM"), (8, "UINT"), 3),
        ("D32_SFLOAT_S8_UINT", 5, (32, "SFLOAT"), (8, "UINT"), 4),
    ],
)
def test_depth_and_stencil(
    name: str, size: int, depth: tuple[int, str], stencil: tuple[int, str], depth_bytes: int
) -> None:
    found = format_of(name)
    assert found is not None
    assert (
        found.bytes,
        (found.depth_bits, found.depth_type),
        (found.stencil_bits, found.stencil_type),
    ) == (size, depth, stencil)
    assert (found.depth_bytes, found.stencil_bytes) == (depth_bytes, stencil[0] // 8)
    assert found.aspects == tuple(
        aspect for aspect, bits in (("depth", depth[0]), ("stencil", stencil[0])) if bits
    )
    assert (found.numeric, found.components) == ("", ())


@pytest.mark.parametrize(
    ("name", "size", "block", "compressed", "ycbcr"),
    [
        ("BC1_RGB_UNORM_BLOCK", 8, (4, 4, 1), True, False),
        ("BC7_SRGB_BLOCK", 16, (4, 4, 1), True, False),
        ("ASTC_6x5_UNORM_BLOCK", 16, (6, 5, 1), True, False),
        ("ETC2_R8G8B8_UNORM_BLOCK", 8, (4, 4, 1), True, False),
        ("G8_B8_R8_3PLANE_420_UNORM", 6, (2, 2, 1), False, True),
        ("G8_B8R8_2PLANE_420_UNORM", 6, (2, 2, 1), False, True),
        ("G8B8G8R8_422_UNORM", 4, (2, 1, 1), False, True),
        ("G16_B16_R16_3PLANE_444_UNORM", 6, (1, 1, 1), False, True),
        ("G10X6_B10X6R10X6_2PLANE_420_UNORM_3PACK16", 12, (2, 2, 1), False, True),
    ],
)
def test_blocks(
    name: str, size: int, block: tuple[int, int, int], compressed: bool, ycbcr: bool
) -> None:
    found = format_of(name)
    assert found is not None
    assert (found.bytes, found.block, found.compressed, found.ycbcr) == (
        size,
        block,
        compressed,
        ycbcr,
    )


def test_every_format_but_undefined_is_known() -> None:
    assert set(VALUES["VkFormat"]) - set(ROWS) == {"UNDEFINED"}
    assert format_of("UNDEFINED") is None
    assert format_of("VK_FORMAT_R8_UNORM") is None
    for name in ROWS:
        found = format_of(name)
        assert found is not None
        assert found.aspects
        assert found.bytes > 0
        assert bool(found.numeric) == ("color" in found.aspects) == bool(found.components)
        bits = sum(width for _, width in found.components) + found.depth_bits + found.stencil_bits
        if found.block == (1, 1, 1) and not found.ycbcr and found.numeric != "SFIXED5":
            shared_exponent = 5 if name == "E5B9G9R9_UFLOAT_PACK32" else 0
            assert bits + shared_exponent <= 8 * found.bytes, name


def test_kinds() -> None:
    def kinds(name: str) -> tuple[bool, bool, bool]:
        found = format_of(name)
        assert found is not None
        return found.is_srgb, found.is_integer, found.is_float16

    assert kinds("R8G8B8A8_SRGB") == (True, False, False)
    assert kinds("ASTC_4x4_SRGB_BLOCK") == (True, False, False)
    assert kinds("R16G16_SFLOAT") == (False, False, True)
    assert kinds("R16_UINT") == (False, True, False)
    assert kinds("R32G32_SINT") == (False, True, False)
    assert kinds("R32_SFLOAT") == (False, False, False)
    assert kinds("B10G11R11_UFLOAT_PACK32") == (False, False, False)
    assert kinds("S8_UINT") == (False, False, False)
    assert kinds("D32_SFLOAT") == (False, False, False)


def test_formats_that_mali_does_not_blend_at_full_rate() -> None:
    blended = {
        name for name in ROWS if (found := format_of(name)) is not None and found.arm_float_blend
    }
    assert blended == ARM_FLOAT_BLEND
    assert len(blended) == 9
    assert "R16G16B16A16_SFLOAT" in blended
    assert "E5B9G9R9_UFLOAT_PACK32" not in blended

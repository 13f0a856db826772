"""Pictures compared texel by texel, and taken apart by their formats."""

from __future__ import annotations

import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.confirm.pixels import RawImage, compare, read
from msaa_lint.experiments.confirm.texels import format_name, format_of, texel_bytes, texels
from msaa_lint.frame.vulkan.enums import VALUES

NUMBERS = VALUES["VkFormat"]


def raw(format: str, data: bytes, width: int = 2, aspect: str = "") -> RawImage:
    form = format_of(format)
    assert form is not None
    return RawImage(
        NUMBERS[format],
        width,
        len(data) // texel_bytes(form, aspect or form.aspects[0]) // width,
        data,
        aspect,
    )


def test_formats_have_their_names_back() -> None:
    assert [format_name(number) for number in (37, 43, 44, 97, 126, 129, 10**9)] == [
        "R8G8B8A8_UNORM", "R8G8B8A8_SRGB", "B8G8R8A8_UNORM", "R16G16B16A16_SFLOAT", "D32_SFLOAT",
        "D24_UNORM_S8_UINT", "1000000000",
    ]  # fmt: skip


@given(st.binary(min_size=16, max_size=16))
def test_same_bytes_are_the_same_picture(data: bytes) -> None:
    (found,) = compare(
        {"color": raw("R8G8B8A8_UNORM", data)}, {"color": raw("R8G8B8A8_UNORM", data)}
    )
    assert (found.equal, found.differing, found.pixels, found.first) == (True, 0, 4, None)
    assert found.text == "equal, 4 pixels"


@given(st.binary(min_size=64, max_size=64), st.integers(0, 63), st.integers(1, 255))
def test_one_byte_more_is_found_where_it_is(data: bytes, place: int, more: int) -> None:
    other = bytearray(data)
    other[place] = (other[place] + more) % 256
    (found,) = compare(
        {"c": raw("R8G8B8A8_UNORM", data, 4)}, {"c": raw("R8G8B8A8_UNORM", bytes(other), 4)}
    )
    assert (found.equal, found.differing) == (False, 1)
    assert found.first == (place // 4 % 4, place // 16)
    assert found.greatest == abs(other[place] - data[place])


def test_tolerance_is_stated_and_is_no_wider() -> None:
    before = raw("R8G8B8A8_UNORM", bytes([100] * 16))
    allowed = {"c": (1, "Vulkan does not say how an average is rounded")}
    (near,) = compare(
        {"c": before},
        {"c": raw("R8G8B8A8_UNORM", bytes([100] * 12 + [101, 99, 100, 100]))},
        allowed,
    )
    assert (near.equal, near.differing, near.greatest) == (True, 1, 1)
    assert near.text == (
        "1 of 4 pixels differ, the first at (1, 1), by at most 1 step; 1 allowed: Vulkan does not "
        "say how an average is rounded"
    )
    (far,) = compare(
        {"c": before},
        {"c": raw("R8G8B8A8_UNORM", bytes([100] * 12 + [102, 100, 100, 100]))},
        allowed,
    )
    assert (far.equal, far.greatest) == (False, 2)


def halves(*values: float) -> bytes:
    return struct.pack(f"<{len(values)}e", *values)


def test_steps_of_half_floats_are_units_in_the_last_place() -> None:
    before = raw("R16_SFLOAT", halves(1.0, 0.0, 2.0, math.inf))
    (found,) = compare(
        {"c": before}, {"c": raw("R16_SFLOAT", halves(1.0 + 3 * 2**-10, -0.0, 2.0, math.inf))}
    )
    assert (found.differing, found.greatest) == (2, 3)
    (spoilt,) = compare(
        {"c": before}, {"c": raw("R16_SFLOAT", halves(1.0, 0.0, math.nan, math.inf))}
    )
    assert (spoilt.equal, spoilt.greatest) == (False, math.inf)
    assert "by at most not a number" in spoilt.text


def test_image_of_one_version_alone_is_not_compared() -> None:
    image = raw("R8G8B8A8_UNORM", bytes(16))
    gone, new = compare({"a": image}, {"b": image})
    assert (gone.equal, new.equal) == (None, None)
    assert (
        gone.text
        == "not compared: its contents are undefined in the fixed version, and nothing reads them"
    )
    assert new.text == "not compared: its contents are undefined in the version as written"


def test_other_format_is_not_compared() -> None:
    (found,) = compare(
        {"a": raw("R8G8B8A8_UNORM", bytes(16))}, {"a": raw("R8G8B8A8_SRGB", bytes(16))}
    )
    assert found.equal is None and found.reason == "its format or size differs in the fixed version"


def test_half_an_image_is_not_compared() -> None:
    (found,) = compare({"a": RawImage(37, 2, 2, bytes(15))}, {"a": RawImage(37, 2, 2, bytes(15))})
    assert found.equal is None and found.reason == "it was not read back completely"


def test_bytes_beside_24_bits_of_depth_mean_nothing() -> None:
    one, other = b"\x01\x02\x03\x00" * 4, b"\x01\x02\x03\xff" * 4
    (found,) = compare(
        {"d": raw("X8_D24_UNORM_PACK32", one)}, {"d": raw("X8_D24_UNORM_PACK32", other)}
    )
    assert found.equal
    seen = read(raw("D24_UNORM_S8_UINT", other))
    assert seen is not None and list(seen.planes["D"]) == [0x030201] * 4


@pytest.mark.parametrize(
    ("format", "data", "planes"),
    [
        ("R8G8B8A8_UNORM", bytes([1, 2, 3, 4, 5, 6, 7, 8]), {"R": [1, 5], "G": [2, 6], "B": [3, 7],
        "A": [4, 8]}),
        ("B8G8R8A8_SRGB", bytes([1, 2, 3, 4, 5, 6, 7, 8]), {"B": [1, 5], "G": [2, 6], "R": [3, 7],
        "A": [4, 8]}),
        ("R8G8_SNORM", bytes([0x7F, 0x81, 0, 0xFF]), {"R": [127, 0], "G": [-127, -1]}),
        ("R16G16_UINT", struct.pack("<4H", 1, 2, 3, 65535), {"R": [1, 3], "G": [2, 65535]}),
        ("R32_SINT", struct.pack("<2i", -5, 7), {"R": [-5, 7]}),
        ("R16G16_SFLOAT", halves(0.5, -1, 65504, 2), {"R": [0.5, 65504], "G": [-1, 2]}),
        ("R32_SFLOAT", struct.pack("<2f", 0.25, -8), {"R": [0.25, -8]}),
        ("A2B10G10R10_UNORM_PACK32", struct.pack("<2I", 3 << 30 | 1023 << 20 | 5 << 10 | 7, 0),
         {"A": [3, 0], "B": [1023, 0], "G": [5, 0], "R": [7, 0]}),
        ("R5G6B5_UNORM_PACK16", struct.pack("<2H", 31 << 11 | 5 << 5 | 9, 0), {"R": [31, 0],
        "G": [5, 0], "B": [9, 0]}),
        ("B10G11R11_UFLOAT_PACK32", struct.pack("<2I",
        (15 << 5) << 22 | (15 << 6 | 32) << 11 | 16 << 6, 31 << 6),
         {"B": [1, 0], "G": [1.5, 0], "R": [2, math.inf]}),
        ("E5B9G9R9_UFLOAT_PACK32", struct.pack("<2I", 16 << 27 | 256, 0), {"R": [1, 0], "G": [0,
        0], "B": [0, 0]}),
        ("D16_UNORM", struct.pack("<2H", 0, 65535), {"D": [0, 65535]}),
        ("D32_SFLOAT", struct.pack("<2f", 0, 1), {"D": [0, 1]}),
        ("S8_UINT", bytes([3, 4]), {"S": [3, 4]}),
    ],
)  # fmt: skip
def test_formats_are_taken_apart(format: str, data: bytes, planes: dict[str, list[float]]) -> None:
    form = format_of(format)
    assert form is not None
    found = texels(form, data, 2)
    assert found is not None and (found.width, found.height) == (2, 1)
    assert {name: list(plane) for name, plane in found.planes.items()} == planes


def test_stencil_of_a_joined_format_is_a_byte() -> None:
    seen = read(RawImage(NUMBERS["D24_UNORM_S8_UINT"], 2, 1, bytes([7, 9]), "stencil"))
    assert seen is not None and list(seen.planes["S"]) == [7, 9]


@pytest.mark.parametrize("number", sorted(NUMBERS.values()))
def test_no_format_is_too_much(number: int) -> None:
    read(RawImage(number, 2, 2, bytes(64)))
    compare(
        {"a": RawImage(number, 2, 2, bytes(64))}, {"a": RawImage(number, 2, 2, bytes(63) + b"\1")}
    )

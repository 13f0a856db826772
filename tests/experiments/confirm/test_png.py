"""Pictures as PNG files: read back by a reader of our own, and by what a display would show of each
format.
"""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.confirm.png import (
    EDGE,
    Picture,
    PictureFolder,
    around,
    difference,
    edge,
    encoded,
    enlarged,
    file_name,
    picture,
    png,
    show,
    version_pictures,
)
from msaa_lint.experiments.confirm.texels import Texels
from msaa_lint.experiments.confirm.vulkan_errors import NotWritten


def decoded(data: bytes) -> Picture:
    """What a PNG file of 8-bit RGB holds; every checksum is looked at."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, chunks = 8, {}
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length : at + 12 + length]) == (
            zlib.crc32(kind + body),
        )
        chunks[kind] = body
        at += 12 + length
    assert list(chunks) == [b"IHDR", b"sRGB", b"tEXt", b"IDAT", b"IEND"]
    width, height, depth, kind, *rest = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert (depth, kind, rest) == (8, 2, [0, 0, 0])
    lines = zlib.decompress(chunks[b"IDAT"])
    row = 3 * width + 1
    assert len(lines) == row * height and all(lines[n * row] == 0 for n in range(height))
    return Picture(
        width, height, b"".join(lines[n * row + 1 : (n + 1) * row] for n in range(height))
    )


@given(st.integers(1, 9), st.integers(1, 9), st.randoms(use_true_random=False))
def test_png_holds_the_picture(width: int, height: int, chance: object) -> None:
    made = Picture(width, height, bytes(chance.randrange(256) for _ in range(3 * width * height)))  # type: ignore[attr-defined]
    assert decoded(png(made)) == made
    assert png(made) == png(made)


def image(
    numeric: str,
    planes: dict[str, list[float]],
    bits: int = 8,
    aspect: str = "color",
    width: int = 2,
) -> Texels:
    count = len(next(iter(planes.values())))
    return Texels(width, count // width, numeric, dict(planes), dict.fromkeys(planes, bits), aspect)


@pytest.mark.parametrize(
    ("seen", "rgb"),
    [
        (
            image("UNORM", {"R": [0, 255], "G": [1, 2], "B": [3, 4], "A": [9, 9]}),
            [0, 1, 3, 255, 2, 4],
        ),
        (image("SRGB", {"B": [3, 4], "G": [1, 2], "R": [0, 188]}), [0, 1, 3, 188, 2, 4]),
        (image("UNORM", {"R": [0, 1023], "G": [0, 0], "B": [0, 512]}, 10), [0, 0, 0, 255, 0, 128]),
        (image("SNORM", {"R": [127, -127], "G": [0, 0], "B": [0, 0]}), [255, 0, 0, 0, 0, 0]),
        (
            image("SFLOAT", {"R": [0.5, 7.0], "G": [-1, float("nan")], "B": [1.0, 0.0]}, 16),
            [188, 0, 255, 255, 0, 0],
        ),
        (image("UINT", {"R": [10, 20], "G": [15, 10], "B": [10, 10]}), [0, 128, 0, 255, 0, 0]),
        (image("UNORM", {"D": [0x8000, 0xFFFF]}, 16, "depth"), [0, 0, 0, 255, 255, 255]),
        (image("SFLOAT", {"D": [0.25, 0.25]}, 32, "depth"), [0, 0, 0, 0, 0, 0]),
        (image("UINT", {"S": [1, 3]}, 8, "stencil"), [0, 0, 0, 255, 255, 255]),
        (image("UNORM", {"R": [7, 9]}), [7, 7, 7, 9, 9, 9]),
    ],
)
def test_formats_are_shown_as_a_display_does(seen: Texels, rgb: list[int]) -> None:
    assert list(picture(seen).rgb) == rgb


@given(st.floats(0, 1))
def test_codes_of_light_are_as_exact_as_a_byte_can_be(light: float) -> None:
    shown = picture(image("SFLOAT", {"R": [light, 0], "G": [0, 0], "B": [0, 0]}, 32)).rgb[0]
    assert abs(shown - encoded(light) * 255) <= 0.62


def test_srgb_curve_at_known_places() -> None:
    assert [
        round(encoded(light) * 255) for light in (0.0, 0.0031308, 0.2158605, 0.5, 1.0, 2.0)
    ] == [0, 10, 128, 188, 255, 255]


def test_difference_is_black_but_where_they_differ() -> None:
    before = image("UNORM", {"R": [1, 5, 9, 9], "G": [0] * 4, "B": [0] * 4, "A": [255] * 4})
    after = image(
        "UNORM", {"R": [1, 6, 9, 29], "G": [0] * 4, "B": [0] * 4, "A": [255, 255, 254, 255]}
    )
    assert list(difference(before, after).rgb[::3]) == [0, 64 + 191 // 20, 64 + 191 // 20, 255]


def test_edge_is_where_most_colours_are() -> None:
    flat = bytearray(3 * 64 * 64)
    for y in range(64):
        for x in range(64):
            if 40 <= x < 44:
                flat[3 * (y * 64 + x)] = x * 5 if y >= 32 else 0
    x, y = edge(Picture(64, 64, bytes(flat)))
    assert x <= 40 < x + EDGE and y + EDGE > 32


def test_part_around_a_pixel_stays_in_the_picture() -> None:
    made = Picture(64, 32, bytes(3 * 64 * 32))
    assert [around(made, place) for place in ((0, 0), (63, 31), (32, 16))] == [
        (0, 0),
        (48, 16),
        (24, 8),
    ]
    assert around(Picture(2, 2, bytes(12)), (1, 1)) == (0, 0)


def test_enlarged_pixels_are_squares_beside_each_other() -> None:
    one, other = (
        Picture(2, 1, bytes([1, 2, 3, 4, 5, 6])),
        Picture(2, 1, bytes([7, 8, 9, 10, 11, 12])),
    )
    made = enlarged([one, other], (0, 0))
    assert (made.width, made.height) == (2 * 2 * EDGE + 8, EDGE)
    row = made.rgb[: made.width * 3]
    assert (
        row
        == bytes([1, 2, 3]) * EDGE
        + bytes([4, 5, 6]) * EDGE
        + b"\x80" * 24
        + bytes([7, 8, 9]) * EDGE
        + bytes([10, 11, 12]) * EDGE
    )
    assert made.rgb == row * EDGE


@pytest.mark.parametrize(
    ("parts", "name"),
    [
        (("a/b.msaa.yaml", "color"), "a-b.msaa.yaml-color"),
        (("../../etc/passwd", "x"), "etc-passwd-x"),
        (("\x1b[31m", "a\nb"), "31m-a_b"),
        (("...", ""), "_-_"),
        (("Ünï",), "n"),
    ],
)
def test_names_of_inputs_make_harmless_names(parts: tuple[str, ...], name: str) -> None:
    assert file_name(*parts) == name


@given(st.lists(st.text(), min_size=1, max_size=5))
def test_no_name_leads_out_of_the_folder(parts: list[str]) -> None:
    name = file_name(*parts)
    assert (
        name
        and len(name) <= 200
        and not name.startswith(".")
        and not set(name) & set("/\\\0:*?<>|\n")
    )


def test_album_numbers_what_has_the_same_name_and_follows_no_link(tmp_path: Path) -> None:
    outside = tmp_path / "outside"
    outside.write_text("mine")
    folder = tmp_path / "album"
    folder.mkdir()
    (folder / "a.png").symlink_to(outside)
    album = PictureFolder(str(folder))
    made = Picture(1, 1, b"\1\2\3")
    assert [Path(album.write(made, name)).name for name in ("a", "A", "b")] == [
        "a.png",
        "A-2.png",
        "b.png",
    ]
    assert outside.read_text() == "mine" and not (folder / "a.png").is_symlink()
    assert sorted(path.name for path in folder.iterdir()) == ["A-2.png", "a.png", "b.png"]


def test_album_replaces_only_its_own_pictures(tmp_path: Path) -> None:
    made = Picture(1, 1, b"\1\2\3")
    (tmp_path / "a.png").write_bytes(b"\x89PNG photograph")
    with pytest.raises(NotWritten, match=r"a\.png: msaa-lint did not write the file that is there"):
        PictureFolder(str(tmp_path)).write(made, "a")
    assert (tmp_path / "a.png").read_bytes() == b"\x89PNG photograph"
    for force in (True, False):
        PictureFolder(str(tmp_path), force).write(made, "a")
    assert decoded((tmp_path / "a.png").read_bytes()) == made


def test_pictures_of_an_image(tmp_path: Path) -> None:
    before = image("UNORM", {"R": [0, 255] * 512, "G": [0] * 1024, "B": [0] * 1024}, width=32)
    after = image(
        "UNORM", {"R": [0, 255] * 511 + [0, 254], "G": [0] * 1024, "B": [0] * 1024}, width=32
    )
    paths = show(
        PictureFolder(str(tmp_path)), ("file", "color"), version_pictures(before, after), (31, 31)
    )
    names = [f"file-color-{kind}.png" for kind in ("as-written", "fixed", "difference", "edge")]
    assert [Path(path).name for path in paths] == names
    beside = decoded(Path(paths[3]).read_bytes())
    assert (beside.width, beside.height) == (3 * EDGE * EDGE + 16, EDGE * EDGE)
    assert [Path(path).name for path in show(PictureFolder(str(tmp_path)), ("file", "depth"),
    version_pictures(before, None), None)] == [
        "file-depth-as-written.png", "file-depth-edge.png",
    ]  # fmt: skip

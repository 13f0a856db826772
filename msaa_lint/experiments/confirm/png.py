"""PNG files of images as written and fixed, their difference, and an enlarged edge. It needs no
library except zlib.
"""

from __future__ import annotations

import math
import os
import re
import struct
import zlib
from typing import NamedTuple, Protocol

from msaa_lint.core.atomic_write import write_file

from .texels import Plane, Texels
from .vulkan_errors import NotWritten

EDGE = 16
"""Width and height in pixels of an enlarged part, and the factor by which it is enlarged."""

_GAP = 8
_SOFTWARE = b"tEXt", b"Software\0msaa-lint"
_LEVELS = 1 << 14


class Picture(NamedTuple):
    """Pixels of three bytes, red, green and blue, encoded as sRGB."""

    width: int
    height: int
    rgb: bytes


def png(picture: Picture) -> bytes:
    """A picture as a PNG file (ISO/IEC 15948): 8-bit RGB, marked as sRGB. The same picture always
    gives the same bytes.
    """
    row = picture.width * 3
    lines = b"".join(b"\0" + picture.rgb[n * row : (n + 1) * row] for n in range(picture.height))
    header = struct.pack(">IIBBBBB", picture.width, picture.height, 8, 2, 0, 0, 0)
    chunks = [
        (b"IHDR", header),
        (b"sRGB", b"\0"),
        _SOFTWARE,
        (b"IDAT", zlib.compress(lines, 6)),
        (b"IEND", b""),
    ]
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(kind, data) for kind, data in chunks)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def signed(data: bytes) -> bytes:
    """A PNG file that another library encoded, with the mark by which `is_own_picture` knows it."""
    start = 8 + 12 + 13
    return data[:start] + _chunk(*_SOFTWARE) + data[start:]


def is_own_picture(path: str) -> bool:
    """Whether a file is a picture that `png` encoded. Raises OSError if it cannot be read."""
    with open(path, "rb") as file:
        return b"".join(_SOFTWARE) in file.read(100)


def encoded(linear: float) -> float:
    """The sRGB code, 0 to 1, of linear light (IEC 61966-2-1). Values out of range are clamped; NaN
    is 0.
    """
    if not linear > 0:
        return 0.0
    return linear * 12.92 if linear <= 0.0031308 else min(1.055 * linear ** (1 / 2.4) - 0.055, 1.0)


def picture(image: Texels) -> Picture:
    """An image as a display shows it.

    Codes of UNORM and sRGB formats are shown as stored. Floats are linear light, clamped and
    encoded. Integers, depth and stencil are scaled from their smallest to their greatest value.
    Alpha is ignored.
    """
    scale = _scale(image)
    planes = {
        name: _codes(plane, image, name, scale)
        for name, plane in image.planes.items()
        if name in "RGBDS"
    }
    grey = planes.get("D") or planes.get("S") or (planes.get("R") if len(planes) == 1 else None)
    count = image.width * image.height
    black = bytes(count)
    rgb = bytearray(3 * count)
    for n, name in enumerate("RGB"):
        rgb[n::3] = grey if grey is not None else planes.get(name, black)
    return Picture(image.width, image.height, bytes(rgb))


def _scale(image: Texels) -> tuple[float, float]:
    """The smallest and greatest value of an image that is scaled; zeros for others."""
    if image.aspect == "color" and image.numeric not in ("UINT", "SINT"):
        return 0.0, 0.0
    values = [
        v
        for name, plane in image.planes.items()
        if name != "A"
        for v in (min(plane), max(plane))
        if math.isfinite(v)
    ]
    return (min(values), max(values)) if values else (0.0, 0.0)


def _codes(plane: Plane, image: Texels, component: str, scale: tuple[float, float]) -> bytes:
    low, high = scale
    if high > low:
        return bytes(_code((value - low) / (high - low)) for value in plane)
    if image.aspect != "color" or image.numeric in ("UINT", "SINT"):
        return bytes(len(plane))
    bits = image.bits[component]
    if image.numeric in ("UNORM", "SRGB"):
        if bits == 8:
            return (
                bytes(bytearray(int(value) for value in plane))
                if not isinstance(plane, bytes)
                else plane
            )
        most = (1 << bits) - 1
        return bytes(_code(value / most) for value in plane)
    if image.numeric == "SNORM":
        most = (1 << (bits - 1)) - 1
        return bytes(_code(value / most) for value in plane)
    return bytes(_OF_LIGHT[_level(value)] for value in plane)


def _level(value: float) -> int:
    return 0 if not value > 0 else _LEVELS if value >= 1 else int(value * _LEVELS + 0.5)


def _code(share: float) -> int:
    return 0 if not share > 0 else 255 if share >= 1 else int(share * 255 + 0.5)


_OF_LIGHT = bytes(_code(encoded(n / _LEVELS)) for n in range(_LEVELS + 1))
"""Codes of linear light in 16384 steps: even the steepest part of the curve has five steps per
code.
"""


def difference(before: Texels, after: Texels) -> Picture:
    """The difference of two images: black where they are equal, otherwise scaled so that the
    greatest difference is white.

    The smallest difference is still clearly visible, including differences in alpha only.
    """
    count = before.width * before.height
    amounts = [0.0] * count
    for name, plane in before.planes.items():
        for n, (a, b) in enumerate(zip(plane, after.planes[name], strict=True)):
            if a != b and not (a != a and b != b):
                apart = abs(a - b)
                amounts[n] = max(amounts[n], apart if math.isfinite(apart) else 0.0, 5e-324)
    most = max(amounts, default=0.0)
    codes = bytes(0 if not amount else 64 + int(191 * (amount / most)) for amount in amounts)
    rgb = bytearray(3 * count)
    for n in range(3):
        rgb[n::3] = codes
    return Picture(before.width, before.height, bytes(rgb))


def edge(picture: Picture) -> tuple[int, int]:
    """The corner of the part of a picture with the most distinct colors: an edge, and a smoothed
    one if there is any.
    """
    best, at = 0, (0, 0)
    for y in range(0, max(picture.height - EDGE, 0) + 1, EDGE // 2):
        for x in range(0, max(picture.width - EDGE, 0) + 1, EDGE // 2):
            colors = len(set(_pixels(picture, x, y)))
            if colors > best:
                best, at = colors, (x, y)
    return at


def around(picture: Picture, place: tuple[int, int]) -> tuple[int, int]:
    """The corner of the part centered on a pixel, within the picture."""
    x, y = place
    return max(min(x - EDGE // 2, picture.width - EDGE), 0), max(
        min(y - EDGE // 2, picture.height - EDGE), 0
    )


def _pixels(picture: Picture, x: int, y: int) -> list[bytes]:
    wide = min(EDGE, picture.width - x)
    rows = (((y + n) * picture.width + x) * 3 for n in range(min(EDGE, picture.height - y)))
    return [picture.rgb[row + 3 * n : row + 3 * n + 3] for row in rows for n in range(wide)]


def enlarged(pictures: list[Picture], corner: tuple[int, int]) -> Picture:
    """The same part of pictures of equal size side by side, enlarged sixteen times."""
    x, y = corner
    first = pictures[0]
    wide, high = min(EDGE, first.width - x), min(EDGE, first.height - y)
    lines = []
    for n in range(high):
        line = bytearray()
        for number, each in enumerate(pictures):
            if number:
                line += b"\x80" * (3 * _GAP)
            row = ((y + n) * each.width + x) * 3
            for m in range(wide):
                line += each.rgb[row + 3 * m : row + 3 * m + 3] * EDGE
        lines.append(bytes(line) * EDGE)
    return Picture((wide * EDGE + _GAP) * len(pictures) - _GAP, high * EDGE, b"".join(lines))


def file_name(*parts: str) -> str:
    """A safe file name from names in an input: letters, digits, `.`, `-` and `_` only, not hidden,
    without folders, and not too long.
    """
    clean = [
        re.sub(r"[^A-Za-z0-9._-]+", "_", part.replace(os.sep, "-").replace("/", "-"))[-60:].strip(
            "._-"
        )
        or "_"
        for part in parts
    ]
    return "-".join(clean)[-200:]


class Album(Protocol):
    """What gets pictures, under names made of parts."""

    def write(self, picture: Picture, *parts: str) -> str: ...


class PictureList:
    """The PNG files of pictures, with the parts of their names, to be written to a folder later.
    `write` returns its number.
    """

    def __init__(self) -> None:
        self.files: list[tuple[bytes, tuple[str, ...]]] = []

    def write(self, picture: Picture, *parts: str) -> str:
        """Adds a picture."""
        self.files.append((png(picture), parts))
        return str(len(self.files) - 1)


class PictureFolder:
    """A folder of pictures. Pictures of msaa-lint are replaced, other files only if `force` is
    true, and links are not followed.

    NotWritten if the folder cannot be created.
    """

    def __init__(self, folder: str, force: bool = False) -> None:
        self.folder, self.force = folder, force
        self.written: list[str] = []
        try:
            os.makedirs(folder, exist_ok=True)
        except OSError as error:
            raise NotWritten(f"cannot write pictures to {folder}: {error.strerror}") from None

    def write(self, picture: Picture, *parts: str) -> str:
        """Writes a picture and returns its path. A number distinguishes names that would be
        equal.
        """
        return self.write_file(png(picture), *parts)

    def write_file(self, data: bytes, *parts: str) -> str:
        """`write`, of a signed PNG file."""
        stem = file_name(*parts)
        name, count = f"{stem}.png", 1
        while name.lower() in self.written:
            count += 1
            name = f"{stem}-{count}.png"
        self.written.append(name.lower())
        path = os.path.join(self.folder, name)
        try:
            write_file(path, data, None if self.force else is_own_picture)
        except OSError as error:
            raise NotWritten(f"cannot write {path}: {error.strerror or error}") from None
        return path


class VersionPictures(NamedTuple):
    """An image as written; and fixed, with the difference, where there is a fixed version of the
    same size and components.
    """

    as_written: Picture
    fixed: Picture | None = None
    difference: Picture | None = None


def version_pictures(before: Texels, after: Texels | None) -> VersionPictures:
    """The pictures of an image in both versions."""
    as_written = picture(before)
    if (
        after is None
        or (after.width, after.height) != (before.width, before.height)
        or after.planes.keys() != before.planes.keys()
    ):
        return VersionPictures(as_written)
    return VersionPictures(as_written, picture(after), difference(before, after))


def show(
    album: Album, stem: tuple[str, ...], pictures: VersionPictures, first: tuple[int, int] | None
) -> list[str]:
    """Writes the pictures of one image and returns their paths: as written; fixed and the
    difference; and an enlarged edge.
    """
    names = ("as-written", "fixed", "difference")
    known = [(each, name) for each, name in zip(pictures, names, strict=True) if each is not None]
    paths = [album.write(each, *stem, name) for each, name in known]
    corner = around(pictures.as_written, first) if first is not None else edge(pictures.as_written)
    return [*paths, album.write(enlarged([each for each, _ in known], corner), *stem, "edge")]

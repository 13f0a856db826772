"""Compares the picture as written with that of the fixed version: which images differ, in how many
pixels, and where first.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Collection, Mapping
from typing import NamedTuple

from .texels import Texels, aspect_of, format_name, format_of, texel_bytes, texels


class RawImage(NamedTuple):
    """An image as read back. If its contents are not `defined`, they are poison, or come from it;
    `discarded` ones are nothing but it.
    """

    format: int
    width: int
    height: int
    data: bytes
    aspect: str = ""
    defined: bool = True
    discarded: bool = False


class ImageComparison(NamedTuple):
    """The comparison of an image in both versions. `equal` is None if they were not compared, and
    `reason` says why; `missing`, that it should have been.

    `differing` of `pixels` differ; `first` is the first of them in row order. `greatest` is the
    greatest difference in steps of the format (codes of normalized and integer components, units in
    the last place of floats). `tolerance` is the number of steps that the specification allows,
    `why` the reason.
    """

    image: str
    equal: bool | None
    differing: int = 0
    pixels: int = 0
    first: tuple[int, int] | None = None
    greatest: float = 0.0
    tolerance: int = 0
    why: str = ""
    reason: str = ""
    missing: bool = False

    @property
    def text(self) -> str:
        """A one-line summary."""
        if self.equal is None:
            return f"not compared: {self.reason}"
        if self.reason:
            return self.reason
        if not self.differing:
            return f"equal, {self.pixels} pixels"
        steps = (
            "not a number"
            if math.isinf(self.greatest)
            else f"{self.greatest:.0f} step{'s' if self.greatest != 1 else ''}"
        )
        at = f"({self.first[0]}, {self.first[1]})" if self.first is not None else "?"
        found = (
            f"{self.differing} of {self.pixels} pixels differ, the first at {at}, by at most "
            f"{steps}"
        )
        return f"{found}; {self.tolerance} allowed: {self.why}" if self.tolerance else found


def compare(
    as_written: Mapping[str, RawImage],
    fixed: Mapping[str, RawImage],
    tolerances: Mapping[str, tuple[int, str]] | None = None,
    *,
    others: tuple[Collection[str], Collection[str]] = ((), ()),
    read: Collection[str] = (),
) -> list[ImageComparison]:
    """The comparisons of the images of both versions that were read back, and of `others` with
    defined contents, ordered by name.

    `tolerances` are the steps by which two correct results may differ, and why: Vulkan does not
    specify how an average is rounded. An image whose contents are undefined as written may hold
    anything. If only the fixed version discards them, it differs if something may `read` it
    afterwards; what reads it within the frame reads poison.
    """
    allowed = tolerances or {}
    out = []
    for name in sorted({*as_written, *others[0], *fixed}):
        before, after = as_written.get(name), fixed.get(name)
        defined = name in others[1] or (after is not None and after.defined)
        if name not in others[0] and (before is None or not before.defined):
            if defined:
                out.append(
                    ImageComparison(
                        name, None, reason="its contents are undefined in the version as written"
                    )
                )
        elif not defined and name not in read and (after is None or after.discarded):
            out.append(
                ImageComparison(
                    name,
                    None,
                    reason="its contents are undefined in the fixed version, and nothing reads "
                    "them",
                )
            )
        elif before is not None and after is not None:
            out.append(_compare(name, before, after, *allowed.get(name, (0, ""))))
        elif not defined:
            out.append(
                ImageComparison(
                    name,
                    False,
                    reason="its contents are undefined in the fixed version, and something reads "
                    "them",
                )
            )
    return out


def _compare(
    name: str, before: RawImage, after: RawImage, tolerance: int, why: str
) -> ImageComparison:
    if (before.format, before.width, before.height) != (after.format, after.width, after.height):
        return ImageComparison(
            name, None, reason="its format or size differs in the fixed version", missing=True
        )
    form = format_of(format_name(before.format))
    size = texel_bytes(form, aspect_of(form, before.aspect)) if form is not None else 0
    if not size or not before.width:
        return ImageComparison(name, None, reason="its format cannot be compared", missing=True)
    if len(before.data) != len(after.data) or len(before.data) % (size * before.width):
        return ImageComparison(name, None, reason="it was not read back completely", missing=True)
    count = len(before.data) // size
    one, other = _masked(before, form), _masked(after, form)
    if one == other:
        return ImageComparison(name, True, 0, count, tolerance=tolerance, why=why)
    places = [
        n
        for n in range(count)
        if one[n * size : (n + 1) * size] != other[n * size : (n + 1) * size]
    ]
    greatest = _greatest(before, after, places)
    first = places[0] % before.width, places[0] // before.width
    return ImageComparison(
        name, greatest <= tolerance, len(places), count, first, greatest, tolerance, why
    )


def _masked(raw: RawImage, form: object) -> bytes:
    """The bytes without padding: the highest eight bits of 24-bit depth are undefined."""
    if getattr(form, "depth_bits", 0) == 24 and raw.aspect != "stencil":
        data = bytearray(raw.data)
        data[3::4] = bytes(len(data) // 4)
        return bytes(data)
    return raw.data


def _greatest(before: RawImage, after: RawImage, places: list[int]) -> float:
    """The greatest difference among some texels, in steps of the format."""
    one, other = read(before), read(after)
    if one is None or other is None:
        return math.inf
    steps = 0.0
    for name, plane in one.planes.items():
        values = other.planes[name]
        steps = max(
            steps, max((_steps(plane[n], values[n], one, name) for n in places), default=0.0)
        )
    return steps


def _steps(a: float, b: float, of: Texels, component: str) -> float:
    if of.numeric not in ("SFLOAT", "UFLOAT"):
        return abs(a - b)
    if a == b or (math.isnan(a) and math.isnan(b)):
        return 0.0
    if not (math.isfinite(a) and math.isfinite(b)):
        return math.inf
    bits = of.bits[component]
    if bits in (10, 11) or of.numeric == "UFLOAT":
        # Both are exact in a half float, whose units in the last place are smaller by 2^(difference
        # of the mantissa bits).
        return abs(_ordered(a, 16) - _ordered(b, 16)) / (
            1 << (15 - bits if bits in (10, 11) else 1)
        )
    return float(abs(_ordered(a, bits) - _ordered(b, bits)))


def _ordered(value: float, bits: int) -> int:
    """The rank of a float among all floats of its width: neighbors are 1 apart, and both zeros are
    0.
    """
    form, whole = {16: ("<e", "<h"), 32: ("<f", "<i"), 64: ("<d", "<q")}[bits]
    (code,) = struct.unpack(whole, struct.pack(form, value))
    return int(code) if code >= 0 else -(int(code) + (1 << (bits - 1)))


def read(raw: RawImage) -> Texels | None:
    """The components of an image; None if its format cannot be decoded."""
    form = format_of(format_name(raw.format))
    return texels(form, raw.data, raw.width, raw.aspect) if form is not None else None

"""Decodes raw texels, as vkCmdCopyImageToBuffer lays them out, into the values of their
components.
"""

from __future__ import annotations

import array
import struct
import sys
from collections.abc import Sequence
from typing import Any, NamedTuple

from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.frame.vulkan.formats import Format, format_of

Plane = Sequence[float]
_WORDS = {8: "B", 16: "H", 32: "I", 64: "Q"}
_NAMES: dict[int, str] = {}


class Texels(NamedTuple):
    """The components of an image, one value per texel, in rows from the top. `numeric` is UNORM,
    SRGB, SNORM, UINT, SINT, SFLOAT or UFLOAT; `bits` are by component; values are as stored: codes
    of normalized formats, numbers of floats.
    """

    width: int
    height: int
    numeric: str
    planes: dict[str, Plane]
    bits: dict[str, int]
    aspect: str


def format_name(number: int) -> str:
    """The short name of a VkFormat's number (37: `R8G8B8A8_UNORM`); the number itself if
    unknown.
    """
    if not _NAMES:
        _NAMES.update((value, name) for name, value in reversed(VALUES["VkFormat"].items()))
    return _NAMES.get(number, str(number))


def texel_bytes(form: Format, aspect: str) -> int:
    """Bytes of one texel in a buffer: depth and stencil are copied separately, 24 bits as 32
    (Copying Data, "Depth/stencil aspect copy table").
    """
    if aspect == "stencil":
        return 1
    if aspect == "depth":
        return 2 if form.depth_bits == 16 else 4
    return form.bytes


def aspect_of(form: Format, stated: str = "") -> str:
    """The copied aspect: the stated one, otherwise color, depth, or stencil for a stencil-only
    format.
    """
    return stated if stated in form.aspects else form.aspects[0] if form.aspects else "color"


def texels(form: Format, data: bytes, width: int, aspect: str = "") -> Texels | None:
    """The components of raw bytes, with the layers of an image below each other. None for formats
    that cannot be rendered to.
    """
    aspect = aspect_of(form, aspect)
    size = texel_bytes(form, aspect)
    if not width or not size or form.block != (1, 1, 1):
        return None
    count = len(data) // size // width * width
    data = data[: count * size]
    height = count // width
    if aspect == "stencil":
        return Texels(width, height, "UINT", {"S": data}, {"S": 8}, aspect)
    if aspect == "depth":
        return _depth(form, data, width, height)
    if form.compressed or form.ycbcr or not form.components:
        return None
    planes = _packed(form, data) if "_PACK" in form.name else _planes(form, data)
    return (
        Texels(width, height, form.numeric, planes, dict(form.components), aspect)
        if planes
        else None
    )


def _depth(form: Format, data: bytes, width: int, height: int) -> Texels:
    if form.depth_type == "SFLOAT":
        return Texels(width, height, "SFLOAT", {"D": _array("f", data)}, {"D": 32}, "depth")
    if form.depth_bits == 16:
        return Texels(width, height, "UNORM", {"D": _array("H", data)}, {"D": 16}, "depth")
    text = _array("I", data)
    return Texels(
        width, height, "UNORM", {"D": [word & 0xFFFFFF for word in text]}, {"D": 24}, "depth"
    )


def _planes(form: Format, data: bytes) -> dict[str, Plane]:
    """The components of a format with components of one width."""
    widths = {bits for _, bits in form.components}
    if (
        len(widths) != 1
        or (bits := widths.pop()) not in _WORDS
        or (form.numeric == "SFLOAT" and bits == 8)
    ):
        return {}
    if form.numeric == "SFLOAT":
        values: Plane = (
            struct.unpack(f"<{len(data) // 2}e", data)
            if bits == 16
            else _array({32: "f", 64: "d"}[bits], data)
        )
    else:
        letter = _WORDS[bits]
        values = _array(letter.lower() if form.numeric in ("SINT", "SNORM") else letter, data)
    step = len(form.components)
    return {name: values[n::step] for n, (name, _) in enumerate(form.components)}


def _packed(form: Format, data: bytes) -> dict[str, Plane]:
    """The components of a packed format: the first one has the highest bits of a word."""
    text = _array(_WORDS[form.bytes * 8], data)
    if form.name.startswith("E5B9G9R9"):
        shifts = (("R", 0), ("G", 9), ("B", 18))
        return {
            name: [(word >> shift & 0x1FF) * 2.0 ** ((word >> 27) - 24) for word in text]
            for name, shift in shifts
        }
    planes: dict[str, Plane] = {}
    shift = form.bytes * 8
    for name, bits in form.components:
        shift -= bits
        mask = (1 << bits) - 1
        if form.numeric == "UFLOAT":
            values: Plane = [_small_float(word >> shift & mask, bits - 5) for word in text]
        elif form.numeric in ("SINT", "SNORM"):
            half = 1 << (bits - 1)
            values = [((word >> shift & mask) ^ half) - half for word in text]
        else:
            values = [word >> shift & mask for word in text]
        planes[name] = values
    return planes


def _small_float(code: int, mantissa: int) -> float:
    """The value of an unsigned 10- or 11-bit float: five exponent bits, no sign."""
    exponent, fraction = code >> mantissa, (code & ((1 << mantissa) - 1)) / (1 << mantissa)
    if exponent == 31:
        return float("nan") if fraction else float("inf")
    return 2.0**-14 * fraction if exponent == 0 else 2.0 ** (exponent - 15) * (1 + fraction)


def _array(letter: str, data: bytes) -> array.array[Any]:
    values: array.array[Any] = array.array(letter, data)
    if sys.byteorder == "big":
        values.byteswap()
    return values


__all__ = ["Texels", "aspect_of", "format_name", "format_of", "texel_bytes", "texels"]

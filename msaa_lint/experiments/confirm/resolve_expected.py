"""The expected result of a resolve, from its samples, and the tolerance around it.

Values are as stored: codes of normalized formats, numbers of floats, integers of integer formats
and stencil.

- UNORM and SNORM, averaged: within one code of the exact average, because Vulkan specifies neither
  the rounding nor the precision.
- sRGB, averaged: within one code of the encoded average of the decoded samples, because drivers
  encode by approximations.
- Floats, averaged: one of the two neighbors of the average in the format, because the rounding is
  unspecified. If single precision gives different sums for different orders, the order is
  unspecified too: the result may then be off by half a unit in the last place of the sum for each
  sample, 2 units in single precision itself for 4 samples. Subnormals may become zero.
- A single sample, the minimum or the maximum: exactly that value. 24-bit depth may be off by one,
  because the samples are read back in single precision, which does not distinguish all codes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.frame.vulkan.formats import Format

from .parts import COLOR, STENCIL

ZERO, AVERAGE, LEAST, GREATEST = 1, 2, 4, 8
"""VkResolveModeFlagBits."""

MANTISSAS = {10: 5, 11: 6, 16: 10, 32: 23}
"""Mantissa bits by the width of a float."""

SINGLE = 23
TWENTY_FOUR = (1 << 24) - 1


class Component(NamedTuple):
    """A component of a format: its name and its position among those that a shader reads. Floats
    have the number of mantissa bits and the smallest normal exponent (`least`), normalized values
    the greatest code. `numeric` is UNORM, SNORM, SRGB, FLOAT or WHOLE (integer).
    """

    name: str
    place: int
    numeric: str
    codes: int = 0
    mantissa: int = 0
    least: int = 0


class Expected(NamedTuple):
    """The expected value, and the smallest and greatest correct values."""

    value: float
    low: float
    high: float

    def met(self, given: float) -> bool:
        """Whether a value is correct."""
        return self.low <= given <= self.high or (math.isnan(given) and math.isnan(self.value))


def components(form: Format, aspect: int) -> list[Component]:
    """The components of an aspect that can be checked; none for formats with unsupported
    components.
    """
    if aspect == STENCIL:
        return [Component("S", 0, "WHOLE")]
    if aspect != COLOR:
        if form.depth_type == "SFLOAT":
            return [_float("D", 0, 32)]
        return [Component("D", 0, "UNORM", (1 << form.depth_bits) - 1)]
    found = []
    for name, bits in form.components:
        if name not in "RGBA":
            continue
        place = "RGBA".index(name)
        if form.numeric in ("SFLOAT", "UFLOAT"):
            if bits not in MANTISSAS:
                return []
            found.append(_float(name, place, bits))
        elif form.is_integer:
            found.append(Component(name, place, "WHOLE"))
        elif form.is_srgb and name != "A":
            found.append(Component(name, place, "SRGB", 255))
        elif form.numeric in ("UNORM", "SRGB", "SNORM"):
            signed = form.numeric == "SNORM"
            found.append(
                Component(name, place, "SNORM" if signed else "UNORM", (1 << (bits - signed)) - 1)
            )
    return found


def _float(name: str, place: int, bits: int) -> Component:
    return Component(name, place, "FLOAT", 0, MANTISSAS[bits], -126 if bits == 32 else -14)


def stored(own: Component, read: float) -> float:
    """The stored value of a sample, from the number that a shader reads."""
    if own.numeric in ("FLOAT", "WHOLE") or not math.isfinite(read):
        return read
    return round((encoded(read) if own.numeric == "SRGB" else read) * own.codes)


def value(own: Component, code: float) -> float:
    """A stored value as a number: from 0 to 1 for normalized formats, without decoding sRGB."""
    return code / own.codes if own.codes else code


def due(own: Component, mode: int, samples: Sequence[float]) -> Expected:
    """The expected result of resolving the stored samples of a pixel."""
    if mode == AVERAGE:
        return _averaged(own, samples)
    if own.numeric == "FLOAT" and any(map(math.isnan, samples)) and mode != ZERO:
        return Expected(math.nan, -math.inf, math.inf)
    chosen = samples[0] if mode == ZERO else min(samples) if mode == LEAST else max(samples)
    slack = 1 if own.codes == TWENTY_FOUR else 0
    return Expected(chosen, chosen - slack, chosen + slack)


def _averaged(own: Component, samples: Sequence[float]) -> Expected:
    if own.numeric == "FLOAT":
        return _float_average(own, samples)
    if own.numeric == "SRGB":
        light = math.fsum(decoded(code / own.codes) for code in samples) / len(samples)
        exact = encoded(light) * own.codes
    else:
        exact = sum(samples) / len(samples)
    return Expected(exact, exact - 1, exact + 1)


def _float_average(own: Component, samples: Sequence[float]) -> Expected:
    if not all(map(math.isfinite, samples)):
        # As IEEE 754 adds them: infinities of both signs give NaN.
        total = sum(samples)
        return Expected(total, total, total)
    exact = math.fsum(samples) / len(samples)
    slack = _order_slack(samples)
    tiny = math.ldexp(1.0, own.least)
    slack += sum(abs(sample) for sample in samples if abs(sample) < tiny) / len(samples)
    low, high = beside(own, exact - slack)[0], beside(own, exact + slack)[1]
    if abs(exact) < tiny:
        low, high = min(low, 0.0), max(high, 0.0)
    return Expected(exact, low, high)


def _order_slack(samples: Sequence[float]) -> float:
    """The possible error of the average in single precision due to the order of addition; 0 if
    every order is exact.
    """
    size = math.fsum(map(abs, samples))
    if not size:
        return 0.0
    # Every partial sum is a multiple of the lowest bit that any sample has set.
    lowest = min(
        (numerator & -numerator) / denominator
        for numerator, denominator in (abs(s).as_integer_ratio() for s in samples if s)
    )
    if size / lowest <= 1 << (SINGLE + 1):
        return 0.0
    unit = math.ldexp(1.0, math.frexp(size)[1] - 1 - SINGLE)
    return unit / 2


def beside(own: Component, number: float) -> tuple[float, float]:
    """The neighbors of a number in a component's format: the greatest float not above it and the
    smallest not below it.
    """
    if not number:
        return 0.0, 0.0
    exponent = max(math.frexp(number)[1] - 1, own.least)
    unit = math.ldexp(1.0, exponent - own.mantissa)
    return math.floor(number / unit) * unit, math.ceil(number / unit) * unit


def decoded(encoded_value: float) -> float:
    """The linear light of an sRGB value, both from 0 to 1 (IEC 61966-2-1)."""
    return (
        encoded_value / 12.92
        if encoded_value <= 0.04045
        else ((encoded_value + 0.055) / 1.055) ** 2.4
    )


def encoded(light: float) -> float:
    """The sRGB value of linear light, both from 0 to 1 (IEC 61966-2-1)."""
    return 12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055


def likeness(own: Component, wrong: Sequence[tuple[float, Sequence[float]]]) -> str:
    """What incorrect values are instead, if one cause explains all of them; each value comes with
    its samples.
    """
    guesses = {
        "the minimum of the samples": (LEAST, own),
        "the maximum of the samples": (GREATEST, own),
    }
    if own.numeric != "WHOLE":
        guesses["the average of the samples"] = AVERAGE, own
    if own.numeric == "SRGB":
        guesses[ENCODED_AVERAGE] = AVERAGE, own._replace(numeric="UNORM")
    count = len(wrong[0][1]) if wrong else 0
    for number in range(count):
        if all(due(own, ZERO, samples[number:]).met(given) for given, samples in wrong):
            return f"sample {number}"
    for text, (mode, component) in guesses.items():
        if wrong and all(due(component, mode, samples).met(given) for given, samples in wrong):
            return text
    return ""


ENCODED_AVERAGE = "the average of the encoded values instead of the light"

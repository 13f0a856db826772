"""What a resolve is to give, from the samples that it is of: the value that is due, and how far from it a right answer may lie.

Values are taken as they are stored: codes of normalised formats, numbers of floats, whole numbers of integers and of stencil.

- UNORM and SNORM, averaged: at most a code beside the exact average, as Vulkan says neither how the average is rounded nor how precisely
  it is made.
- sRGB, averaged: a code beside the encoded average of the decoded samples; drivers encode by approximations.
- Floats, averaged: one of the two neighbours of the average in the format, because rounding is free. Where single precision adds the
  samples to other sums in other orders, that order is free too: then it may be off by half a unit in the last place of the sum for each
  sample, 2 units in single precision itself for 4 samples. What is subnormal may be zero.
- A sample, or the least or greatest of them: that very value. 24 bits of depth may be off by one, as the samples are read back as single
  precision, which does not tell all of them apart.
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
"""By the bits of a float: those of its mantissa."""

SINGLE = 23
TWENTY_FOUR = (1 << 24) - 1


class Component(NamedTuple):
    """A component of a format: its name and place among those that a shader reads; of floats the bits of the mantissa and the least
    exponent of a normal one, of normalised values the greatest code. `numeric` is UNORM, SNORM, SRGB, FLOAT or WHOLE."""

    name: str
    place: int
    numeric: str
    codes: int = 0
    mantissa: int = 0
    least: int = 0


class Expected(NamedTuple):
    """The value that is due, and the least and the greatest that are right."""

    value: float
    low: float
    high: float

    def met(self, given: float) -> bool:
        """Whether a value is right."""
        return self.low <= given <= self.high or (math.isnan(given) and math.isnan(self.value))


def components(form: Format, aspect: int) -> list[Component]:
    """The components of an aspect that can be judged; none of formats with others than these."""
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
            found.append(Component(name, place, "SNORM" if signed else "UNORM", (1 << (bits - signed)) - 1))
    return found


def _float(name: str, place: int, bits: int) -> Component:
    return Component(name, place, "FLOAT", 0, MANTISSAS[bits], -126 if bits == 32 else -14)


def stored(own: Component, read: float) -> float:
    """What a sample is stored as, of the number that a shader reads."""
    if own.numeric in ("FLOAT", "WHOLE") or not math.isfinite(read):
        return read
    return round((encoded(read) if own.numeric == "SRGB" else read) * own.codes)


def value(own: Component, code: float) -> float:
    """What is stored as a number: of 0 to 1 where it is normalised, without decoding it."""
    return code / own.codes if own.codes else code


def due(own: Component, mode: int, samples: Sequence[float]) -> Expected:
    """What the stored samples of a pixel resolve to."""
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
        # As IEEE 754 adds them: infinities of both signs are no number.
        total = sum(samples)
        return Expected(total, total, total)
    exact = math.fsum(samples) / len(samples)
    slack = _order_slack(samples)
    tiny = math.ldexp(1.0, own.least)
    slack += sum(abs(each) for each in samples if abs(each) < tiny) / len(samples)
    low, high = beside(own, exact - slack)[0], beside(own, exact + slack)[1]
    if abs(exact) < tiny:
        low, high = min(low, 0.0), max(high, 0.0)
    return Expected(exact, low, high)


def _order_slack(samples: Sequence[float]) -> float:
    """How far single precision may be from the average by the order in which it adds; 0 where every order adds exactly."""
    size = math.fsum(map(abs, samples))
    if not size:
        return 0.0
    # The lowest bit that any sample has set: every partial sum is a multiple of it.
    lowest = min((numerator & -numerator) / denominator for numerator, denominator in (abs(s).as_integer_ratio() for s in samples if s))
    if size / lowest <= 1 << (SINGLE + 1):
        return 0.0
    unit = math.ldexp(1.0, math.frexp(size)[1] - 1 - SINGLE)
    return unit / 2


def beside(own: Component, number: float) -> tuple[float, float]:
    """The greatest float of a component's format that is not above a number, and the least that is not below it."""
    if not number:
        return 0.0, 0.0
    exponent = max(math.frexp(number)[1] - 1, own.least)
    unit = math.ldexp(1.0, exponent - own.mantissa)
    return math.floor(number / unit) * unit, math.ceil(number / unit) * unit


def decoded(encoded_value: float) -> float:
    """Linear light of an sRGB value, both of 0 to 1 (IEC 61966-2-1)."""
    return encoded_value / 12.92 if encoded_value <= 0.04045 else ((encoded_value + 0.055) / 1.055) ** 2.4


def encoded(light: float) -> float:
    """The sRGB value of linear light, both of 0 to 1 (IEC 61966-2-1)."""
    return 12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055


def likeness(own: Component, wrong: Sequence[tuple[float, Sequence[float]]]) -> str:
    """What wrong values are instead, where one thing explains all of them: each is given with the samples that it was made of."""
    guesses = {"the least of the samples": (LEAST, own), "the greatest of the samples": (GREATEST, own)}
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


ENCODED_AVERAGE = "the average of what is stored, not of its light"

"""Cases of resolves and light, and of the sums of errors."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from msaa_lint.experiments.study.effects import store_half
from msaa_lint.experiments.study.measure import total
from msaa_lint.experiments.study.resolve import average, to_srgb, to_unorm, tone_map, weighted

from .row import Row


def sequential(samples: list[float], kind: type[np.floating[Any]]) -> float:
    """The sum in a precision, in order, divided by the count."""
    with np.errstate(over="ignore", invalid="ignore"):
        value = kind(samples[0])
        for each in samples[1:]:
            value = value + kind(each)
        return float(value / kind(len(samples)))


def scaled(samples: list[float], kind: type[np.floating[Any]]) -> float:
    """The sum of samples that are divided by the count first, in a precision."""
    value = kind(0)
    for each in samples:
        value = value + kind(each) / kind(len(samples))
    return float(value)


def mean(samples: list[float]) -> float:
    return float(sum((Fraction(each) for each in samples), Fraction(0)) / len(samples))


def averages() -> Iterator[Row]:
    def made(samples: list[float], kind: type[Any] = np.float32) -> float:
        return float(average(np.array(samples, kind)[:, None])[0])

    for samples, words in (
        ([65504.0] * 4, "4 samples of 65504 in half precision; naive: added in half"),
        ([5000.0] * 16, "16 samples of 5000 in half precision; naive: added in half"),
        ([2048.0, 1.0, 1.0, 1.0], "2048, 1, 1, 1 in half precision; naive: added in half"),
    ):
        yield Row(
            "resolve", words, mean(samples), sequential(samples, np.float16), sequential(samples, np.float64), made(samples, np.float16)
        )
    tiny, least = [2.0**-24] * 4, [2.0**-149] * 4
    case = "4 times the smallest half-precision subnormal; naive: each quartered in half"
    yield Row("resolve", case, mean(tiny), scaled(tiny, np.float16), scaled(tiny, np.float64), made(tiny, np.float16))
    case = "4 times the smallest single-precision subnormal; naive: each quartered"
    yield Row("resolve", case, mean(least), scaled(least, np.float32), scaled(least, np.float64), made(least))
    for samples, due, words in (
        ([math.inf, 1.0, 2.0, 3.0], math.inf, "an infinite sample; naive: clamped to 65504, as some drivers do"),
        ([math.nan, 1.0, 2.0, 3.0], math.nan, "a NaN sample; naive: treated as 0, as fixed point does"),
    ):
        shown = [65504.0 if math.isinf(each) else 0.0 if math.isnan(each) else each for each in samples]
        yield Row("resolve", words, due, sequential(shown, np.float32), sequential(samples, np.float64), made(samples))
    codes = [254, 255, 255, 255]
    exact = round(Fraction(sum(codes), 4))
    light = [code / 255 for code in codes]
    cut = float(int(np.float32(sequential(light, np.float32)) * 255))
    nearest = float(np.rint(to_unorm(average(np.array(light, np.float32)[:, None]))[0] * 255))
    in_double = float(round(sequential(light, np.float64) * 255))
    yield Row("resolve", "UNORM8 codes 254, 255, 255, 255; naive: truncated", exact, cut, in_double, nearest)


def lights() -> Iterator[Row]:
    white, black = np.float32(1), np.float32(0)
    half = Fraction(1, 2)
    code = round(255 * (1.055 * float(half) ** (1 / 2.4) - 0.055))
    found = float(np.rint(to_srgb(average(np.array([white, black])[:, None]))[0] * 255))
    yield Row("light", "sRGB code of white and black, averaged; naive: codes averaged", code, round(255 / 2), code, found)
    firefly = [60000.0, 0.1, 0.1, 0.1]
    shares = [Fraction(float(np.float32(each))) for each in firefly]
    due = float(sum((each / (1 + each) for each in shares), Fraction(0)) / 4)
    samples = np.ones((4, 1, 4), np.float32)
    samples[..., :3] = np.array(firefly, np.float32)[:, None, None]
    after = float(tone_map(average(samples))[0, 0])
    in_double = sum(float(each) / (1 + float(each)) for each in shares) / 4
    before = float(average(tone_map(samples))[0, 0])
    yield Row("light", "60000 and three of 0.1, displayed; naive: tone mapped after the resolve", due, after, in_double, before, 1e-6)
    mixed = float(tone_map(weighted(samples))[0, 0])
    yield Row("light", "the same by the weighted resolve; naive: averaged without weights", due, after, in_double, mixed, 1e-6)
    bright = np.full((1, 4), np.inf, np.float32)
    with np.errstate(invalid="ignore"):
        ratio = float(bright[0, 0] / (1 + bright[0, 0]))
    yield Row("light", "infinite light, displayed; naive: x / (1 + x)", 1.0, ratio, math.nan, float(tone_map(bright)[0, 0]))
    with np.errstate(over="ignore"):
        large = float(np.float16(65519.99))
    yield Row("light", "65519.99 stored in half precision; naive: anything above 65504 is infinite", 65504.0, math.inf, large,
              float(store_half(np.array([65519.99], np.float32))[0]))  # fmt: skip


def sums() -> Iterator[Row]:
    count = 2**24 + 4096
    ones = np.ones(count, np.float32)
    yield Row("sums", f"{count:,} squared errors of 1; naive: added one by one", count, float(np.cumsum(ones, dtype=np.float32)[-1]),
              float(count), total(ones))  # fmt: skip
    numbers = np.arange(6_220_800, dtype=np.int64) * 40503 % 65536
    exact = float(Fraction(int(np.sum(numbers * numbers)), 65536**2))
    values = numbers / 65536
    single = values.astype(np.float32)
    one_by_one = float(np.cumsum(single * single, dtype=np.float32)[-1])
    squares = values * values
    words = "squared errors of 1920 x 1080 pixels of 3 channels; naive: added one by one"
    yield Row("sums", words, exact, one_by_one, float(np.sum(squares)), total(squares), 1e-15)

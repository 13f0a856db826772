"""Cases of resolves and light, and of the sums of errors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.effects import store_half
from msaa_lint.experiments.study.resolve import LUMA, average, to_srgb, to_unorm, tone_map, weighted
from msaa_lint.experiments.study.sums import total

from .row import Row

Color = tuple[float, float, float]


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
            "resolve",
            words,
            mean(samples),
            sequential(samples, np.float16),
            sequential(samples, np.float64),
            made(samples, np.float16),
        )
    tiny, least = [2.0**-24] * 4, [2.0**-149] * 4
    case = "4 times the smallest half-precision subnormal; naive: each quartered in half"
    yield Row(
        "resolve",
        case,
        mean(tiny),
        scaled(tiny, np.float16),
        scaled(tiny, np.float64),
        made(tiny, np.float16),
    )
    case = "4 times the smallest single-precision subnormal; naive: each quartered"
    yield Row(
        "resolve",
        case,
        mean(least),
        scaled(least, np.float32),
        scaled(least, np.float64),
        made(least),
    )
    for samples, due, words in (
        (
            [math.inf, 1.0, 2.0, 3.0],
            math.inf,
            "an infinite sample; naive: clamped to 65504, as some drivers do",
        ),
        (
            [math.nan, 1.0, 2.0, 3.0],
            math.nan,
            "a NaN sample; naive: treated as 0, as fixed point does",
        ),
    ):
        shown = [
            65504.0 if math.isinf(each) else 0.0 if math.isnan(each) else each for each in samples
        ]
        yield Row(
            "resolve",
            words,
            due,
            sequential(shown, np.float32),
            sequential(samples, np.float64),
            made(samples),
        )
    codes = [254, 255, 255, 255]
    exact = round(Fraction(sum(codes), 4))
    light = [code / 255 for code in codes]
    cut = float(int(np.float32(sequential(light, np.float32)) * 255))
    nearest = float(np.rint(to_unorm(average(np.array(light, np.float32)[:, None]))[0] * 255))
    in_double = float(round(sequential(light, np.float64) * 255))
    yield Row(
        "resolve",
        "UNORM8 codes 254, 255, 255, 255; naive: truncated",
        exact,
        cut,
        in_double,
        nearest,
    )


def lights() -> Iterator[Row]:
    white, black = np.float32(1), np.float32(0)
    half = Fraction(1, 2)
    code = round(255 * (1.055 * float(half) ** (1 / 2.4) - 0.055))
    found = float(np.rint(to_srgb(average(np.array([white, black])[:, None]))[0] * 255))
    yield Row(
        "light",
        "sRGB code of white and black, averaged; naive: codes averaged",
        code,
        round(255 / 2),
        code,
        found,
    )
    firefly = [60000.0, 0.1, 0.1, 0.1]
    shares = [Fraction(float(np.float32(each))) for each in firefly]
    due = float(sum((each / (1 + each) for each in shares), Fraction(0)) / 4)
    samples = np.ones((4, 1, 4), np.float32)
    samples[..., :3] = np.array(firefly, np.float32)[:, None, None]
    after = float(tone_map(average(samples))[0, 0])
    in_double = sum(float(each) / (1 + float(each)) for each in shares) / 4
    before = float(average(tone_map(samples))[0, 0])
    yield Row(
        "light",
        "60000 and three of 0.1, displayed; naive: tone mapped after the resolve",
        due,
        after,
        in_double,
        before,
        1e-6,
    )
    mixed = float(tone_map(weighted(samples))[0, 0])
    yield Row(
        "light",
        "the same by the weighted resolve; naive: averaged without weights",
        due,
        after,
        in_double,
        mixed,
        1e-6,
    )
    bright = np.full((1, 4), np.inf, np.float32)
    with np.errstate(invalid="ignore"):
        ratio = float(bright[0, 0] / (1 + bright[0, 0]))
    yield Row(
        "light",
        "infinite light, displayed; naive: x / (1 + x)",
        1.0,
        ratio,
        math.nan,
        float(tone_map(bright)[0, 0]),
    )
    with np.errstate(over="ignore"):
        large = float(np.float16(65519.99))
    yield Row("light",
    "65519.99 stored in half precision; naive: anything above 65504 is infinite", 65504.0,
    math.inf, large,
              float(store_half(np.array([65519.99], np.float32))[0]))  # fmt: skip


LUMA_SHARES = [Fraction(str(share)) for share in LUMA]


def exact_weighted(samples: Sequence[Color]) -> list[Fraction]:
    """The weighted resolve in rational arithmetic; negative light counts as none."""
    light = [
        [max(Fraction(float(np.float32(value))), Fraction(0)) for value in color]
        for color in samples
    ]
    weights = [
        1 / (1 + sum((a * b for a, b in zip(LUMA_SHARES, color, strict=True)), Fraction(0)))
        for color in light
    ]
    parts = [
        sum(
            (weight * color[channel] for weight, color in zip(weights, light, strict=True)),
            Fraction(0),
        )
        for channel in range(3)
    ]
    return [part / sum(weights, Fraction(0)) for part in parts]


def floating_weighted(samples: Sequence[Color], kind: type[np.floating[Any]]) -> float:
    """The red of the weighted resolve as a shader has it, in a precision."""
    with np.errstate(all="ignore"):
        light = np.array(samples).astype(kind)
        weights = kind(1) / (kind(1) + (light * np.array(LUMA, kind)).sum(axis=1, dtype=kind))
        return float((light[:, 0] * weights).sum(dtype=kind) / weights.sum(dtype=kind))


def mapped_back(samples: Sequence[Color], kind: type[np.floating[Any]]) -> float:
    """The average of mapped samples x / (1 + x), mapped back by y / (1 - y)."""
    light = np.array(samples)[:, 0].astype(kind)
    mean = (light / (kind(1) + light)).sum(dtype=kind) / kind(len(light))
    return float(mean / (kind(1) - mean))


def weighted_resolves() -> Iterator[Row]:
    """The red of weighted resolves at both ends of what formats hold."""

    def made(samples: Sequence[Color]) -> float:
        pixels = np.ones((len(samples), 1, 4), np.float32)
        pixels[:, 0, :3] = samples
        return float(weighted(pixels)[0, 0])

    def gray(*values: float) -> list[Color]:
        return [(value, value, value) for value in values]

    most, half_step, single_step = 65504.0, 2.0**-24, 2.0**-149
    for samples, words, naive in (
        (
            gray(*[most] * 16),
            "16 samples of 65504; naive: mapped, averaged, mapped back",
            mapped_back,
        ),
        (
            gray(most, half_step, half_step, half_step),
            "65504 and three of 2^-24; naive: in half precision",
            None,
        ),
        (
            [(most, 0, 0), (0, most, 0), (0, 0, most), (0, 0, 0)],
            "65504 of red, of green, of blue, and black; naive: in half precision",
            None,
        ),
    ):
        low = naive(samples, np.float32) if naive else floating_weighted(samples, np.float16)
        double = (naive or floating_weighted)(samples, np.float64)
        yield Row(
            "light",
            f"weighted resolve of {words}",
            float(exact_weighted(samples)[0]),
            low,
            double,
            made(samples),
            1e-6,
        )
    for step, words in (
        (half_step, "2^-24, the smallest of half precision"),
        (single_step, "2^-149, the smallest of single precision"),
    ):
        samples = gray(*[step] * 4)
        case = f"weighted resolve of 4 samples of {words}; naive: subnormals flushed to zero"
        yield Row(
            "light",
            case,
            float(exact_weighted(samples)[0]),
            0.0,
            floating_weighted(samples, np.float64),
            made(samples),
            1e-6,
        )
    greatest = float(np.finfo(np.float32).max)
    samples = gray(*[greatest] * 4)
    naive_sum = float(np.float32(sequential([greatest] * 4, np.float32)))
    case = (
        "weighted resolve of 4 samples of 2^128 - 2^104, the greatest of single precision; "
        "naive: added without weights"
    )
    yield Row(
        "light",
        case,
        greatest,
        naive_sum,
        floating_weighted(samples, np.float64),
        made(samples),
        1e-6,
    )
    for value in (-1.0, -2.0):
        samples = gray(value, 1, 1, 1)
        case = (
            f"weighted resolve of {value:.0f} and three of 1, where negative light counts as "
            "none; naive: weight of 1 / (1 + luma)"
        )
        in_single, in_double = (
            floating_weighted(samples, kind) for kind in (np.float32, np.float64)
        )
        yield Row(
            "light",
            case,
            float(exact_weighted(samples)[0]),
            in_single,
            in_double,
            made(samples),
            1e-6,
        )
    infinite = [(0.0, math.inf, 0.0)] * 4
    in_single, in_double = (floating_weighted(infinite, kind) for kind in (np.float32, np.float64))
    yield Row(
        "light",
        "red of 4 samples of infinite green, weighted; naive: weight of 1 / (1 + luma)",
        0.0,
        in_single,
        in_double,
        made(infinite),
    )


def sums() -> Iterator[Row]:
    """Sums of 2^24 values and more, from which on a single-precision counter of ones stands
    still.
    """
    for count, words in ((2**24 + 1, "2^24 + 1"), (2**24 + 4096, "2^24 + 4,096"), (2**25, "2^25")):
        yield _sum(f"{words} squared errors of 1", np.ones(count, np.float32), Fraction(count))
    pixels = 7680 * 4320
    tenth = np.float32(0.1)
    yield _sum(
        "errors of 0.1 in 7680 x 4320 pixels",
        np.full(pixels, tenth),
        Fraction(float(tenth)) * pixels,
    )
    small = np.full(2**24 + 1, np.float32(2.0**-10))
    small[0] = np.float32(65504.0**2)
    yield _sum("65504 squared and 2^24 of 2^-10", small, Fraction(float(small[0])) + 2**14)
    mixed = np.full(2**24, np.float32(2.0**-10))
    mixed[0::2] += np.float32(4096)
    mixed[1::2] -= np.float32(4096)
    yield _sum("2^24 errors of 4096 + 2^-10 and -4096 + 2^-10 in turn", mixed, Fraction(2**14))
    numbers = np.arange(6_220_800, dtype=np.int64) * 40503 % 65536
    squares = (numbers / 65536) ** 2
    yield _sum(
        "squared errors of 1920 x 1080 pixels of 3 channels",
        squares,
        Fraction(int(np.sum(numbers * numbers)), 65536**2),
        1e-15,
    )


def _sum(
    words: str, values: NDArray[np.floating[Any]], exact: Fraction, within: float = 1e-15
) -> Row:
    one_by_one = float(np.add.accumulate(values, dtype=np.float32)[-1])
    return Row(
        "sums",
        f"{words}; naive: added one by one",
        float(exact),
        one_by_one,
        float(np.sum(values, dtype=np.float64)),
        total(values),
        within,
    )

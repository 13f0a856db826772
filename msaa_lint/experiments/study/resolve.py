"""Resolves: several samples to one pixel, in single precision and a stated order, with the
encodings and the tone mapping around them.

An average adds the samples in order, ((s0 + s1) + s2) + ..., and multiplies by 1/N where N is a
power of two, which is exact, or divides by N. IEEE 754 determines the rest: a sum with an infinity
is infinite, a sum with infinities of both signs or with a NaN is NaN, and sums of subnormals are
exact. Half-precision samples are converted first, so that no sum overflows.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]

LUMA = (0.2126, 0.7152, 0.0722)
"""Luminance of linear red, green and blue (Rec. 709)."""

DEPTH_MODES = ("SAMPLE_ZERO", "AVERAGE", "MIN", "MAX")
"""VkResolveModeFlagBits for depth."""

TONE_MAPPING = ("after-resolve", "before-resolve", "weighted")
"""Where tone mapping stands relative to the resolve.

- `after-resolve`: the average of light is mapped; next to a bright surface an edge looks hardly
  smoothed;
- `before-resolve`: mapped samples are averaged, which gives the correct displayed color;
- `weighted`: samples are averaged with weights of 1 / (1 + luma), then mapped; equal to
  `before-resolve` for gray and close to it for color, and single very bright samples (fireflies) do
  not fill the pixel.
"""


def average(samples: NDArray[np.float32] | NDArray[np.float16]) -> Floats:
    """The average of samples (N, ...): (...)."""
    with np.errstate(over="ignore", invalid="ignore"):
        return _divide(_sum(samples), len(samples))


def weighted(samples: NDArray[np.float32] | NDArray[np.float16]) -> Floats:
    """Samples (N, ..., 4) averaged with weights of 1 / (1 + luma); alpha is averaged without
    weights. Negative light counts as none, as for the tone mapping. An infinite sample has no
    weight; infinite samples alone are averaged without weights.
    """
    light = np.maximum(samples[..., :3].astype(np.float32), np.float32(0))
    resolved = np.empty((*samples.shape[1:-1], 4), np.float32)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        luma = (
            light[..., 0] * np.float32(LUMA[0])
            + light[..., 1] * np.float32(LUMA[1])
            + light[..., 2] * np.float32(LUMA[2])
        )
        weights = np.reciprocal(np.float32(1) + luma)[..., None].astype(np.float32)
        total = _sum(weights)
        parts: Floats = np.where(weights == 0, np.float32(0), light * weights)
        resolved[..., :3] = _sum(parts) / total
    infinite = total[..., 0] == 0
    resolved[infinite, :3] = average(light[:, infinite])
    resolved[..., 3] = average(samples[..., 3])
    return resolved


def resolve_depth(depth: Floats, mode: str) -> Floats:
    """The depths of samples (N, P) resolved to pixels (P,).

    SAMPLE_ZERO is always supported, and not at the pixel's center. MIN is the nearest with standard
    depth and the farthest with reversed depth; MAX is the opposite. AVERAGE of two surfaces is a
    depth where there is no surface. NaN stays NaN except with SAMPLE_ZERO. ValueError for another
    mode.
    """
    if mode == "SAMPLE_ZERO":
        return np.array(depth[0], np.float32)
    if mode == "MIN":
        return np.asarray(np.minimum.reduce(depth, axis=0), np.float32)
    if mode == "MAX":
        return np.asarray(np.maximum.reduce(depth, axis=0), np.float32)
    if mode != "AVERAGE":
        raise ValueError(f"{mode} is not a depth resolve mode; expected {', '.join(DEPTH_MODES)}")
    return average(depth)


def tone_map(color: Floats) -> Floats:
    """Colors (..., 4) mapped to [0, 1] by Reinhard's x / (1 + x), per channel; alpha is unchanged.
    Infinity maps to 1, negative light to 0, and NaN stays NaN.
    """
    light = np.maximum(color[..., :3], np.float32(0))
    with np.errstate(invalid="ignore"):
        return with_rgb(
            color, np.where(np.isinf(light), np.float32(1), light / (np.float32(1) + light))
        )


def to_unorm(color: Floats, bits: int = 8) -> Floats:
    """The nearest value that a UNORM format holds, in [0, 1]; ties go to even codes; NaN becomes 0
    (specification: conversion to normalized fixed point).
    """
    codes = np.float32((1 << bits) - 1)
    clamped = np.clip(np.where(np.isnan(color), np.float32(0), color), 0, 1)
    return np.asarray(np.rint(clamped * codes) / codes, np.float32)


def to_srgb(light: NDArray[np.floating]) -> Floats:
    """Linear light, clamped to [0, 1], encoded (IEC 61966-2-1). Computed in double precision and
    rounded once. NaN stays NaN.
    """
    clamped = np.clip(light.astype(np.float64), 0, 1)
    return np.where(
        clamped <= 0.0031308, 12.92 * clamped, 1.055 * clamped ** (1 / 2.4) - 0.055
    ).astype(np.float32)


def from_srgb(code: NDArray[np.floating]) -> Floats:
    """Encoded values in [0, 1] as linear light. Computed in double precision and rounded once."""
    value = code.astype(np.float64)
    return np.where(
        value <= 0.04045, value / 12.92, (np.maximum(value, 0.04045) + 0.055) ** 2.4 / 1.055**2.4
    ).astype(np.float32)


def encode(samples: Floats) -> Floats:
    """Colors (..., 4) as the sRGB codes, in [0, 1], that a UNORM format averages: darker at edges
    than the average of light.
    """
    return with_rgb(samples, to_srgb(samples[..., :3]))


def decode(picture: Floats) -> Floats:
    """sRGB codes (..., 4) as linear light."""
    return with_rgb(picture, from_srgb(picture[..., :3]))


def with_rgb(color: Floats, rgb: Floats) -> Floats:
    """A copy of colors (..., 4) with other red, green and blue (..., 3)."""
    copy = color.copy()
    copy[..., :3] = rgb
    return copy


def _sum(samples: NDArray[np.float32] | NDArray[np.float16]) -> Floats:
    total: Floats = samples[0].astype(np.float32)
    for sample in samples[1:]:
        total += sample
    return total


def _divide(total: Floats, count: int) -> Floats:
    quotient = (
        total * np.float32(1 / count) if count & (count - 1) == 0 else total / np.float32(count)
    )
    return np.asarray(quotient, np.float32)

"""Resolves: several samples to one pixel, in single precision, in a stated order, and the rounding of what is stored.

An average adds the samples in their order, ((s0 + s1) + s2) + ..., and multiplies by 1/N where N is a power of two, which is exact, and
else divides by N. IEEE 754 says the rest: a sum with an infinity is infinite, one with infinities of both signs or with a NaN is NaN, sums
of subnormals are exact. Half-precision samples are converted first, so that no sum overflows.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]

LUMA = (0.2126, 0.7152, 0.0722)
"""Rec. 709: light of red, green and blue."""


def average(samples: NDArray[np.float32] | NDArray[np.float16]) -> Floats:
    """Samples (N, ...) to (...)."""
    with np.errstate(over="ignore", invalid="ignore"):
        return _part(_added(samples), len(samples))


def weighted(samples: NDArray[np.float32] | NDArray[np.float16]) -> Floats:
    """Samples (N, ..., 4) averaged with weights of 1 / (1 + luma), alpha without. An infinite sample weighs nothing; where all are
    infinite, so is the average."""
    count = len(samples)
    total: Floats | None = None
    weights: Floats | None = None
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for sample in np.asarray(samples):
            light = sample[..., :3].astype(np.float32)
            luma = light[..., 0] * np.float32(LUMA[0]) + light[..., 1] * np.float32(LUMA[1]) + light[..., 2] * np.float32(LUMA[2])
            weight = (np.float32(1) / (np.float32(1) + luma))[..., None]
            part = np.where(weight == 0, np.float32(0), light * weight)
            total = part if total is None else total + part
            weights = weight if weights is None else weights + weight
        assert total is not None and weights is not None
        made = np.empty((*total.shape[:-1], 4), np.float32)
        made[..., :3] = np.where(weights == 0, np.float32(np.inf), total / weights)
        made[..., 3] = _part(_added(samples[..., 3]), count)
    return made


def _added(samples: NDArray[np.float32] | NDArray[np.float16]) -> Floats:
    total: Floats = samples[0].astype(np.float32)
    for sample in samples[1:]:
        total += sample
    return total


def _part(total: Floats, count: int) -> Floats:
    made = total * np.float32(1 / count) if count & (count - 1) == 0 else total / np.float32(count)
    return np.asarray(made, np.float32)


def to_unorm(color: Floats, bits: int = 8) -> Floats:
    """The nearest value that a UNORM format holds, in [0, 1]; halfway to even codes; NaN is 0 (specification: conversion to normalised
    fixed point)."""
    codes = np.float32((1 << bits) - 1)
    kept = np.clip(np.where(np.isnan(color), np.float32(0), color), 0, 1)
    return np.asarray(np.rint(kept * codes) / codes, np.float32)


def to_srgb(light: NDArray[np.floating]) -> Floats:
    """Linear light clipped to [0, 1], encoded (IEC 61966-2-1). Made in double precision, rounded once. NaN stays NaN."""
    kept = np.clip(light.astype(np.float64), 0, 1)
    return np.where(kept <= 0.0031308, 12.92 * kept, 1.055 * kept ** (1 / 2.4) - 0.055).astype(np.float32)


def from_srgb(code: NDArray[np.floating]) -> Floats:
    """Encoded values in [0, 1] as linear light. Made in double precision, rounded once."""
    value = code.astype(np.float64)
    return np.where(value <= 0.04045, value / 12.92, (np.maximum(value, 0.04045) + 0.055) ** 2.4 / 1.055**2.4).astype(np.float32)

"""sRGB: samples are kept as 8-bit sRGB codes. With an sRGB format the resolve averages light; a UNORM format that holds encoded values
averages the codes, which darkens edges. `settings["srgb"]` says which: `linear-light` or `encoded`."""

from __future__ import annotations

import numpy as np

from msaa_lint.experiments.study.resolve import from_srgb, to_srgb, to_unorm

from .drawing import Floats

MODES = ("linear-light", "encoded")

LIGHT: Floats = from_srgb(np.arange(256) / 255)
"""By code."""


def stored(color: Floats) -> Floats:
    """What is read back of what is written, in linear light. NaN is kept as 0."""
    codes = np.rint(np.nan_to_num(to_srgb(color[..., :3])) * np.float32(255)).astype(np.uint8)
    return _colors(to_unorm(color), LIGHT[codes])


def encoded(samples: Floats) -> Floats:
    """Samples as the codes that a UNORM format averages, in [0, 1]."""
    return _colors(samples, to_srgb(samples[..., :3]))


def decoded(picture: Floats) -> Floats:
    """The averaged codes as light."""
    return _colors(picture, from_srgb(picture[..., :3]))


def _colors(given: Floats, colors: Floats) -> Floats:
    made = given.copy()
    made[..., :3] = colors
    return made

"""sRGB: samples are kept as 8-bit sRGB codes. With an sRGB format the resolve averages light; a UNORM format that holds encoded values
averages the codes, which darkens edges. `settings["srgb"]` says which: `linear-light` or `encoded`."""

from __future__ import annotations

import numpy as np

from .drawing import Floats

MODES = ("linear-light", "encoded")


def stored(color: Floats) -> Floats:
    """What is read back of what is written, in linear light."""
    from ..resolve import from_srgb, to_srgb, to_unorm

    made = np.empty_like(color)
    codes = np.rint(np.nan_to_num(to_srgb(color[..., :3])).astype(np.float64) * 255)
    made[..., :3] = from_srgb(codes / 255)
    made[..., 3] = to_unorm(color[..., 3])
    return made


def encoded(samples: Floats) -> Floats:
    """Samples as the codes that a UNORM format averages, in [0, 1]."""
    from ..resolve import to_srgb

    return _colors(samples, to_srgb(samples[..., :3]))


def decoded(picture: Floats) -> Floats:
    """The averaged codes as light."""
    from ..resolve import from_srgb

    return _colors(picture, from_srgb(picture[..., :3]))


def _colors(given: Floats, colors: Floats) -> Floats:
    made = given.copy()
    made[..., :3] = colors
    return made

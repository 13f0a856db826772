"""Effects: independent stages of a draw. A scene enables those it needs; the others are neither
called nor allocated.

A stage of `TABLE` either removes samples from fragments (`fragment`), combines a color with the one
behind it (`blend`), or rounds a color to what an attachment stores (`store`). Effects of the
resolve (`depth-resolve`, `tone-mapping`) are in `resolve`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .drawing import Band, Batch, Bits, Drawing, Floats, has_sample
from .resolve import from_srgb, to_srgb, to_unorm, with_rgb

SAMPLE_SHADING = "sample-shading"

ALPHA_THRESHOLD = 0.5
"""The alpha test discards invocations whose alpha is below this."""

BAYER = np.array(
    [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]], np.float32
) / 16 + np.float32(1 / 32)
"""Dither thresholds by row and column of a 4x4 block, evenly spaced from 1/32 to 31/32."""

COMPARE: dict[str, Callable[[Any, Any], NDArray[np.bool_]]] = {
    "LESS": np.less,
    "LESS_OR_EQUAL": np.less_equal,
    "GREATER": np.greater,
    "GREATER_OR_EQUAL": np.greater_equal,
    "EQUAL": np.equal,
    "NOT_EQUAL": np.not_equal,
}
"""VkCompareOp without NEVER and ALWAYS, which compare nothing."""


def sample_mask(batch: Batch, band: Band, drawing: Drawing) -> None:
    """Keeps the samples of `settings["sample-mask"]`: those whose bit is unset are never drawn
    (pSampleMask, specification 28.4).
    """
    mask = drawing.settings["sample-mask"]
    assert isinstance(mask, int)
    batch.mask = batch.mask & np.uint16(mask & 0xFFFF)


def alpha_test(batch: Batch, band: Band, drawing: Drawing) -> None:
    """Discards invocations below the threshold, with all their samples (OpKill,
    OpTerminateInvocation). NaN passes.
    """
    for number, bits in enumerate(drawing.groups):
        discarded = batch.color[:, number, 3] < ALPHA_THRESHOLD
        batch.mask = np.where(discarded, batch.mask & np.uint16(~bits & 0xFFFF), batch.mask)


def alpha_to_coverage(batch: Batch, band: Band, drawing: Drawing) -> None:
    """Removes samples in proportion to alpha, each group's by its own alpha.

    The specification leaves the pattern open. `settings["alpha-to-coverage"]` selects a model:

    - `dithered`: alpha * N plus one of 16 thresholds chosen by the pixel's position in a 4x4 block,
      rounded down; the average over a block is accurate to 1/(16 N);
    - `ceil`: alpha * N rounded up, the same in every pixel, so that a fragment with any alpha above
      0 covers at least one sample.
    """
    thresholds: Floats | None = None
    if drawing.settings.get("alpha-to-coverage", "dithered") == "dithered":
        thresholds = BAYER[batch.y & 3, batch.x & 3]
    mask = np.zeros_like(batch.mask)
    for number, bits in enumerate(drawing.groups):
        mask |= alpha_coverage(batch.color[:, number, 3], thresholds, drawing.samples) & np.uint16(
            bits
        )
    batch.mask = batch.mask & mask


def alpha_coverage(alpha: Floats, thresholds: Floats | None, samples: int) -> Bits:
    """A bit mask of the first samples that each alpha covers: dithered by `thresholds`, or rounded
    up without them.

    Alpha that is 0, negative or NaN covers no sample; 1 and above cover all of them.
    """
    share = np.clip(np.where(alpha > 0, alpha, np.float32(0)), 0, 1) * np.float32(samples)
    if thresholds is None:
        count = np.ceil(share)
    else:
        # As floor(share + thresholds), but exact: that sum is rounded, up to the next integer where
        # it is just below.
        count = np.floor(share)
        count += share - count >= np.float32(1) - thresholds
    bits: Bits = ((1 << count.astype(np.uint32)) - 1).astype(np.uint16)
    return bits


def stencil_test(batch: Batch, band: Band, drawing: Drawing) -> None:
    """Lets some triangles mark samples (write 1 to stencil, and no color) and draws others only on
    marked samples (EQUAL 1).

    `settings["stencil"]` are three triangle indices: from the first up to the second triangles
    mark, from the second up to the third they are tested; all others are unaffected.
    """
    assert band.stencil is not None
    limits = drawing.settings["stencil"]
    assert isinstance(limits, tuple)
    first_marking, first_tested, end = limits
    marks = (batch.triangle >= first_marking) & (batch.triangle < first_tested)
    tests = (batch.triangle >= first_tested) & (batch.triangle < end)
    mask = np.where(marks | tests, np.uint16(0), batch.mask)
    for sample in range(drawing.samples):
        covered = has_sample(batch.mask, sample)
        plane = band.stencil[sample]
        passes = covered & tests & (plane[batch.pixel] == 1)
        plane[batch.pixel[covered & marks]] = 1
        mask |= passes.astype(np.uint16) << np.uint16(sample)
    batch.mask = mask


def depth_test(batch: Batch, band: Band, drawing: Drawing) -> None:
    """Removes samples that fail the comparison and stores the depth of those that pass.

    A triangle's depth is evaluated at each sample location in double precision and rounded once to
    D32_SFLOAT, so the line where surfaces intersect is an edge too. Equal depth fails LESS: the
    first surface drawn stays.
    """
    assert band.depth is not None and drawing.planes is not None
    compare = COMPARE[str(drawing.settings.get("depth-test", "LESS"))]
    plane_of = batch.plane
    # Most batches are of one triangle.
    slope_x, slope_y, base = drawing.planes[
        plane_of[0] if (plane_of == plane_of[0]).all() else plane_of
    ].T
    corner = slope_x * batch.x + slope_y * batch.y + base
    mask = np.zeros_like(batch.mask)
    for sample, (x, y) in enumerate(drawing.locations):
        depth = np.clip(corner + (slope_x * x + slope_y * y), 0.0, 1.0).astype(np.float32)
        plane = band.depth[sample]
        passes = compare(depth, plane[batch.pixel]) & has_sample(batch.mask, sample)
        plane[batch.pixel[passes]] = depth[passes]
        mask |= passes.astype(np.uint16) << np.uint16(sample)
    batch.mask = mask


def clear_depth(comparison: object) -> float:
    """The farthest depth, which attachments are cleared to: 0 with reversed depth, where greater is
    nearer, otherwise 1.
    """
    return 0.0 if str(comparison).startswith("GREATER") else 1.0


def blend(source: Floats, behind: Floats) -> Floats:
    """Colors (F, 4) over those behind, in linear light: color by SRC_ALPHA and ONE_MINUS_SRC_ALPHA,
    alpha by ONE, ONE_MINUS_SRC_ALPHA.
    """
    alpha = source[:, 3:4]
    part = source * alpha
    part[:, 3:4] = alpha
    part += behind * (np.float32(1) - alpha)
    return np.asarray(part, np.float32)


def store_half(color: Floats) -> Floats:
    """Colors as R16G16B16A16_SFLOAT stores them: rounded to nearest, ties to even; 65520 and above
    become infinity.
    """
    with np.errstate(over="ignore"):
        return color.astype(np.float16).astype(np.float32)


_LIGHT_OF_CODE: Floats = from_srgb(np.arange(256) / 255)


def store_srgb(color: Floats) -> Floats:
    """Linear colors as 8-bit sRGB codes store them. NaN is stored as 0."""
    codes = np.rint(np.nan_to_num(to_srgb(color[..., :3])) * np.float32(255)).astype(np.uint8)
    return with_rgb(to_unorm(color), _LIGHT_OF_CODE[codes])


class Effect(NamedTuple):
    """An effect and its stage, if it has one: `fragment` updates a batch of shaded fragments before
    anything is written; `blend` combines a color with the one behind it; `store` rounds colors to
    what the attachment holds, for samples and for resolved pixels.
    """

    name: str
    description: str
    fragment: Callable[[Batch, Band, Drawing], None] | None = None
    blend: Callable[[Floats, Floats], Floats] | None = None
    store: Callable[[Floats], Floats] | None = None


TABLE: tuple[Effect, ...] = (
    Effect("sample-mask", "samples outside pSampleMask are not drawn", fragment=sample_mask),
    Effect(SAMPLE_SHADING, "the shader runs for groups of samples instead of once per pixel"),
    Effect(
        "alpha-test", "the shader discards where alpha is below a threshold", fragment=alpha_test
    ),
    Effect(
        "alpha-to-coverage",
        "alpha determines how many samples are covered",
        fragment=alpha_to_coverage,
    ),
    Effect("stencil", "samples are drawn where stencil is marked", fragment=stencil_test),
    Effect("depth-test", "each sample keeps the nearest surface", fragment=depth_test),
    Effect("blending", "colors are blended sample by sample", blend=blend),
    Effect("hdr", "samples are stored in half precision", store=store_half),
    Effect("srgb", "samples are stored as 8-bit sRGB codes", store=store_srgb),
    Effect("depth-resolve", "the depths of a pixel's samples are resolved to one"),
    Effect("tone-mapping", "light is mapped to the range of the display"),
)
"""All effects, in the order in which they apply (specification: Fragment Operations)."""

BY_NAME: dict[str, Effect] = {effect.name: effect for effect in TABLE}


def ordered(names: tuple[str, ...]) -> tuple[Effect, ...]:
    """Effects by name, in the order of the table. LookupError for an unknown name."""
    unknown = [name for name in names if name not in BY_NAME]
    if unknown:
        raise LookupError(f"unknown effect `{unknown[0]}`; the effects are {', '.join(BY_NAME)}")
    return tuple(effect for effect in TABLE if effect.name in names)

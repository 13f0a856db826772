"""How far a picture is from the exact one. Sums are in double precision: blocks by NumPy's pairwise sum, those together by math.fsum."""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .locations import SUBPIXELS
from .points import MSAA, Point, Technique
from .resolve import to_srgb
from .scenes.area import NOTHING
from .scenes.scene import Scene
from .simulate import simulated, snapped

Floats = NDArray[np.float64]

BLOCK = 1 << 16
"""Values that NumPy adds up by itself."""

ONE = Technique(MSAA, 1)


class Truth(NamedTuple):
    """The exact picture (H, W, 4) in linear colour, and the pixels (H, W) that an edge crosses."""

    image: Floats
    crossed: NDArray[np.bool_]


class Errors(NamedTuple):
    """Root of the mean square, greatest size, mean with its sign (measured less exact), and how many values they are of."""

    rmse: float
    greatest: float
    bias: float
    values: int


def total(values: NDArray[np.floating]) -> float:
    """The sum, in double precision. Infinities of both signs, and NaN, give NaN."""
    # NumPy adds pairwise along the fastest axis alone: what is summed is one row.
    row = np.ascontiguousarray(values).reshape(-1)
    with np.errstate(invalid="ignore", over="ignore"):
        sums = [float(np.sum(row[start : start + BLOCK], dtype=np.float64)) for start in range(0, len(row), BLOCK)]
        try:
            return math.fsum(sums)
        except (ValueError, OverflowError):
            return float(np.sum(sums))


def difference(measured: NDArray[np.floating], exact: NDArray[np.floating]) -> Floats:
    """Measured less exact, in double precision; 0 where they are equal, infinities too."""
    with np.errstate(invalid="ignore"):
        return np.where(measured == exact, 0.0, measured.astype(np.float64) - exact.astype(np.float64))


def errors(found: Floats) -> Errors:
    """What differences are as numbers; zeros where there are none."""
    if not found.size:
        return Errors(0.0, 0.0, 0.0, 0)
    return Errors(math.sqrt(total(found * found) / found.size), float(np.max(np.abs(found))), total(found) / found.size, found.size)


def psnr(measured: NDArray[np.floating], exact: NDArray[np.floating]) -> float:
    """Peak signal to noise in dB, the peak being 1.0, display white; infinite where nothing differs."""
    found = difference(measured, exact)
    square = total(found * found) / found.size
    return math.inf if square == 0 else -10 * math.log10(square) if math.isfinite(square) else -square


def ssim_of(measured: NDArray[np.floating], exact: NDArray[np.floating]) -> float:
    """Structural similarity (Wang and others 2004) of pictures (H, W, 3) with values in [0, 1], by scikit-image, with its Gaussian window.
    ModuleNotFoundError where that is not installed."""
    from skimage.metrics import structural_similarity

    return float(
        structural_similarity(  # type: ignore[no-untyped-call]
            measured, exact, channel_axis=-1, data_range=1.0, gaussian_weights=True, sigma=1.5, use_sample_covariance=False
        )
    )


def truth(scene: Scene, technique: Technique = ONE, bits: int = 8) -> Truth:
    """The exact picture of the triangles as the technique's drawing snaps them: what remains is the error of sampling. The last few are
    remembered."""
    for known, grid, kept, found in _REMEMBERED:
        if known is scene and (grid, kept) == (technique.grid, bits):
            return found
    made = truth_of(scene, snapped(scene, technique, bits) / (SUBPIXELS * technique.grid))
    _REMEMBERED.append((scene, technique.grid, bits, made))
    return made


_REMEMBERED: deque[tuple[Scene, int, int, Truth]] = deque(maxlen=4)


def truth_of(scene: Scene, triangles: Floats) -> Truth:
    """The exact picture of triangles (T, 3, 2) in pixels in place of the scene's own."""
    image = scene.exact(triangles)
    if scene.crossed is not None:
        return Truth(image, scene.crossed(triangles))
    return Truth(image, (image[..., 3] > NOTHING) & (image[..., 3] < 1 - NOTHING))


def snapping_error(scene: Scene, technique: Technique = ONE, bits: int = 8) -> float:
    """The error that snapping alone makes: the exact picture of snapped triangles against that of the scene's own, root of the mean square
    over the pixels that an edge of either crosses."""
    own, moved = truth_of(scene, scene.triangles), truth(scene, technique, bits)
    where = own.crossed | moved.crossed
    parts = slice(3, 4) if scene.coverage_matter else slice(0, 3)
    return errors(difference(moved.image[where][:, parts], own.image[where][:, parts])).rmse


def point(scene: Scene, technique: Technique, bits: int = 8, ssim: bool = False) -> Point:
    """Everything of a point but time, bytes, power and memory. Errors are of sampling alone."""
    made, exact = simulated(scene, technique, bits), truth(scene, technique, bits)
    colors = difference(made.image[..., :3], exact.image[..., :3])
    found = difference(made.coverage, exact.image[..., 3]) if made.coverage is not None else colors
    edges = errors(found[exact.crossed])
    shown, wanted = to_srgb(made.image[..., :3]), to_srgb(exact.image[..., :3])
    return Point(
        scene=scene.name,
        technique=technique,
        width=scene.width,
        height=scene.height,
        rmse=edges.rmse,
        rmse_all=errors(found).rmse,
        max_error=edges.greatest,
        bias=edges.bias,
        psnr_db=psnr(made.image[..., :3], exact.image[..., :3].astype(np.float32)),
        psnr_display_db=psnr(shown, wanted),
        edge_pixels=int(np.count_nonzero(exact.crossed)),
        effects=made.effects,
        ssim=ssim_of(shown, wanted) if ssim else None,
        simulated_ms=made.milliseconds,
    )

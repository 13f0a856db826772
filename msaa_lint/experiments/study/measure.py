"""The error of a picture against the exact one. Sums are in double precision: blocks by NumPy's pairwise sum, their totals by math.fsum."""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .locations import SUBPIXELS
from .points import MSAA, Point, Technique
from .resolve import to_srgb
from .scenes.area import partly_covered
from .scenes.scene import Scene
from .simulate import simulate, snapped_triangles

Floats = NDArray[np.float64]

BLOCK = 1 << 16
"""Values that NumPy sums at a time."""

ONE = Technique(MSAA, 1)


class Truth(NamedTuple):
    """The exact picture (H, W, 4) in linear color, and the pixels (H, W) that an edge crosses."""

    image: Floats
    edge_pixels: NDArray[np.bool_]


class Errors(NamedTuple):
    """The root mean square, greatest magnitude and mean (measured minus exact) of differences, and their number."""

    rmse: float
    greatest: float
    bias: float
    values: int


def total(values: NDArray[np.floating]) -> float:
    """The sum, in double precision. Infinities of both signs, and NaN, give NaN."""
    # NumPy sums pairwise along the fastest axis alone, so sum a single row.
    row = np.ascontiguousarray(values).reshape(-1)
    with np.errstate(invalid="ignore", over="ignore"):
        sums = [float(np.sum(row[start : start + BLOCK], dtype=np.float64)) for start in range(0, len(row), BLOCK)]
        try:
            return math.fsum(sums)
        except (ValueError, OverflowError):
            return float(np.sum(sums))


def difference(measured: NDArray[np.floating], exact: NDArray[np.floating]) -> Floats:
    """Measured minus exact, in double precision; 0 where they are equal, including infinities."""
    with np.errstate(invalid="ignore"):
        return np.where(measured == exact, 0.0, measured.astype(np.float64) - exact.astype(np.float64))


def errors(differences: Floats) -> Errors:
    """Differences summarized; zeros where there are none."""
    count = differences.size
    if not count:
        return Errors(0.0, 0.0, 0.0, 0)
    return Errors(
        math.sqrt(total(differences * differences) / count), float(np.max(np.abs(differences))), total(differences) / count, count
    )


def psnr(measured: NDArray[np.floating], exact: NDArray[np.floating]) -> float:
    """The peak signal-to-noise ratio in dB with a peak of 1.0, display white; infinite where nothing differs."""
    differences = difference(measured, exact)
    square = total(differences * differences) / differences.size
    return math.inf if square == 0 else -10 * math.log10(square) if math.isfinite(square) else -square


def ssim_of(measured: NDArray[np.floating], exact: NDArray[np.floating]) -> float:
    """The structural similarity (Wang and others 2004) of pictures (H, W, 3) with values in [0, 1], by scikit-image with its Gaussian
    window. ModuleNotFoundError where scikit-image is not installed."""
    from skimage.metrics import structural_similarity

    return float(
        structural_similarity(  # type: ignore[no-untyped-call]
            measured, exact, channel_axis=-1, data_range=1.0, gaussian_weights=True, sigma=1.5, use_sample_covariance=False
        )
    )


def truth(scene: Scene, technique: Technique = ONE, bits: int = 8) -> Truth:
    """The exact picture of the triangles as the technique snaps them, so that only the error of sampling remains. The last few are
    cached."""
    for cached_scene, grid, cached_bits, cached in _CACHE:
        if cached_scene is scene and (grid, cached_bits) == (technique.grid, bits):
            return cached
    triangles = snapped_triangles(scene, technique, bits) / (SUBPIXELS * technique.grid)
    image = scene.exact(triangles)
    exact = Truth(image, scene.edge_pixels(triangles) if scene.edge_pixels is not None else partly_covered(image[..., 3]))
    _CACHE.append((scene, technique.grid, bits, exact))
    return exact


_CACHE: deque[tuple[Scene, int, int, Truth]] = deque(maxlen=4)


def point(scene: Scene, technique: Technique, bits: int = 8, ssim: bool = False) -> Point:
    """A point without time, bytes, power and memory. Errors are of sampling alone."""
    simulation, exact = simulate(scene, technique, bits), truth(scene, technique, bits)
    colors = difference(simulation.image[..., :3], exact.image[..., :3])
    differences = difference(simulation.coverage, exact.image[..., 3]) if simulation.coverage is not None else colors
    edges = errors(differences[exact.edge_pixels])
    displayed, displayed_exact = to_srgb(simulation.image[..., :3]), to_srgb(exact.image[..., :3])
    return Point(
        scene=scene.name,
        technique=technique,
        width=scene.width,
        height=scene.height,
        rmse=edges.rmse,
        rmse_all=errors(differences).rmse,
        max_error=edges.greatest,
        bias=edges.bias,
        psnr_db=psnr(simulation.image[..., :3], exact.image[..., :3].astype(np.float32)),
        psnr_display_db=psnr(displayed, displayed_exact),
        edge_pixels=int(np.count_nonzero(exact.edge_pixels)),
        effects=simulation.effects,
        ssim=ssim_of(displayed, displayed_exact) if ssim else None,
        simulated_ms=simulation.milliseconds,
    )

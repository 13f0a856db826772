"""What the display shows of linear color, and how different people find two pictures."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .resolve import to_srgb, tone_map
from .scenes.scene import Scene
from .sums import total

Floats = NDArray[np.float32]


def display_codes(scene: Scene, color: NDArray[np.floating]) -> Floats:
    """The sRGB codes (..., 3), in [0, 1], of resolved color (..., 4). Light beyond display white
    that the scene stores and does not map itself is mapped by the display, as tone_map() does.
    """
    if "hdr" in scene.effects and "tone-mapping" not in scene.effects:
        color = tone_map(np.asarray(color, np.float32))
    light = color[..., :3]
    first = light[..., :1]
    # Pictures in gray are encoded once.
    return np.repeat(to_srgb(first), 3, axis=-1) if bool((light == first).all()) else to_srgb(light)


def flip(measured: Floats, exact: Floats) -> float:
    """The mean of FLIP (Andersson and others 2020) of sRGB codes (H, W, 3), by flip-evaluator, 0 to
    1, at its default of 67 pixels per degree: a 4K display 70 cm wide, seen from 70 cm away.
    ModuleNotFoundError where it is not installed.
    """
    import flip_evaluator

    # Its own mean is a sum in single precision.
    pictures = (np.clip(np.nan_to_num(codes, nan=0.0), 0, 1) for codes in (exact, measured))
    error_map, _, _ = flip_evaluator.evaluate(
        *pictures, "LDR", applyMagma=False, computeMeanError=False
    )
    return total(error_map) / float(error_map.size)


def ssim(measured: Floats, exact: Floats) -> float:
    """The structural similarity (Wang and others 2004) of pictures (H, W, 3) with values in [0, 1],
    by scikit-image with its Gaussian window. ModuleNotFoundError where scikit-image is not
    installed.
    """
    from skimage.metrics import structural_similarity

    return float(
        structural_similarity(  # type: ignore[no-untyped-call]
            measured,
            exact,
            channel_axis=-1,
            data_range=1.0,
            gaussian_weights=True,
            sigma=1.5,
            use_sample_covariance=False,
        )
    )

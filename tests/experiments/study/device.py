"""What a device covers, and where it puts corners: the reference for the simulation."""

from __future__ import annotations

import os
import shutil
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.confirm import gate, plan
from msaa_lint.experiments.confirm.frame_results import SAMPLES_OF
from msaa_lint.experiments.confirm.parts import Plan
from msaa_lint.experiments.confirm.scene import CLEARED
from msaa_lint.experiments.confirm.session import Session
from msaa_lint.experiments.confirm.vulkan_errors import Unusable
from msaa_lint.experiments.study.points import MSAA, Technique
from msaa_lint.experiments.study.technique_frames import frame_of

TOLERANCE = 0.008
"""More than one step of eight bits, and less than the distance between the scene's colors and the
clear color.
"""


def covered(
    session: Session, corners: NDArray[np.float32], width: int, height: int, samples: int
) -> NDArray[np.bool_]:
    """The samples (height, width, samples) that triangles (T, 3, 3) in clip coordinates cover on
    the device of a session.

    Unusable where the device does not support that sample count or the driver dies.
    """
    device = session.open()
    folder = session.folder("drawn")
    try:
        path = os.path.join(folder, "vertices")
        np.ascontiguousarray(corners, dtype=np.float32).tofile(path)
        frame_plan = plan.plan(frame_of(Technique(MSAA, samples), width, height))._replace(
            vertices=path
        )
        refused = gate.gate(frame_plan, device)
        if refused:
            raise Unusable(refused[0])
        return _covered(session, frame_plan, samples, folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _covered(session: Session, frame_plan: Plan, samples: int, folder: str) -> NDArray[np.bool_]:
    name = "color" if samples > 1 else "picture"
    size = [frame_plan.images[0].width, frame_plan.images[0].height]
    options = {"pixels": folder, "size": size, "samples_of": name if samples > 1 else None}
    run = session.run(frame_plan, [0], options)
    event = run.images.get(name + SAMPLES_OF if samples > 1 else name)
    if run.failed or event is None:
        raise Unusable(run.failed or run.passes[0].reason or "the device returned no samples")
    shape = (event["height"], event["width"], samples)
    red: NDArray[np.floating[Any]]
    if samples > 1:
        red = np.fromfile(event["path"], dtype=np.float32).reshape(*shape, 4)[..., 0]
    else:
        red = np.fromfile(event["path"], dtype=np.uint8).reshape(*shape, 4)[..., 0] / np.float32(
            255
        )
    return np.asarray(np.abs(red - np.float32(CLEARED[0])) > TOLERANCE)


def viewport(
    ndc: NDArray[np.float32], width: int, height: int, fused: bool = True
) -> NDArray[np.float64]:
    """Normalized device coordinates (..., 2) in pixels of a viewport that covers the picture: `ndc
    * side / 2 + side / 2`.

    Computed in single precision as devices do: with one rounding (`fused`, a fused multiply-add,
    lavapipe) or with two (SwiftShader).
    """
    points = np.asarray(ndc, dtype=np.float32)
    half = np.array((width, height), dtype=np.float32) / np.float32(2)
    if not fused:
        rounded: NDArray[np.float32] = points * half + half
        return rounded.astype(np.float64)
    # The product of two singles is exact in double precision. The sum is rounded to odd, so that
    # the subsequent rounding to single equals one rounding of the exact sum (Boldo and Melquiond
    # 2008).
    product, offset = points.astype(np.float64) * half.astype(np.float64), half.astype(np.float64)
    total = product + offset
    difference = total - product
    error = (product - (total - difference)) + (offset - difference)
    even = (total.view(np.int64) & 1) == 0
    odd = np.where((error != 0) & even, np.nextafter(total, np.copysign(np.inf, error)), total)
    single: NDArray[np.float32] = odd.astype(np.float32)
    return single.astype(np.float64)

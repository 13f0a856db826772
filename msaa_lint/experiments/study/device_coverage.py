"""The samples that triangles cover on a device: the reference for the simulation."""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.confirm import gate, plan
from msaa_lint.experiments.confirm.frame_results import SAMPLES_OF
from msaa_lint.experiments.confirm.parts import Plan, to_json
from msaa_lint.experiments.confirm.scene import CLEARED
from msaa_lint.experiments.confirm.session import Session
from msaa_lint.experiments.confirm.vulkan_errors import Unusable

from .points import MSAA, Technique
from .technique_frames import frame_of

TOLERANCE = 0.008
"""More than one step of eight bits, and less than the distance between the scene's colors and the clear color."""


def clip(triangles: NDArray[np.float64], width: int, height: int) -> NDArray[np.float32]:
    """Corners (..., 3, 2) in pixels as x, y and depth (..., 3, 3) in clip coordinates, rounded to single precision."""
    scaled = triangles * (2.0 / np.array([width, height])) - 1.0
    depths = np.full((*triangles.shape[:-1], 1), 0.5)
    return np.concatenate([scaled, depths], axis=-1).astype(np.float32)


def covered(session: Session, corners: NDArray[np.float32], width: int, height: int, samples: int) -> NDArray[np.bool_]:
    """The samples (height, width, samples) that triangles (T, 3, 3) in clip coordinates cover on the device of a session.

    Unusable where the device does not support that sample count or the driver dies.
    """
    device = session.open()
    folder = session.folder("drawn")
    try:
        path = os.path.join(folder, "vertices")
        np.ascontiguousarray(corners, dtype=np.float32).tofile(path)
        frame_plan = plan.plan(frame_of(Technique(MSAA, samples), width, height))._replace(vertices=path)
        refused = gate.gate(frame_plan, device)
        if refused:
            raise Unusable(refused[0])
        return _covered(session, frame_plan, samples, folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _covered(session: Session, frame_plan: Plan, samples: int, folder: str) -> NDArray[np.bool_]:
    name = "color" if samples > 1 else "picture"
    size = [frame_plan.images[0].width, frame_plan.images[0].height]
    options: Mapping[str, Any] = {
        "pixels": folder, "repeats": 0, "warmups": 0, "size": size, "samples_of": name if samples > 1 else None,
    }  # fmt: skip
    run = session.run(to_json(frame_plan), [0], options)
    event = run.images.get(name + SAMPLES_OF if samples > 1 else name)
    if run.failed or event is None:
        raise Unusable(run.failed or run.passes[0].reason or "the device returned no samples")
    shape = (event["height"], event["width"], samples)
    red: NDArray[np.floating[Any]]
    if samples > 1:
        red = np.fromfile(event["path"], dtype=np.float32).reshape(*shape, 4)[..., 0]
    else:
        red = np.fromfile(event["path"], dtype=np.uint8).reshape(*shape, 4)[..., 0] / np.float32(255)
    return np.asarray(np.abs(red - np.float32(CLEARED[0])) > TOLERANCE)

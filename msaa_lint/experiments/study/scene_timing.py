"""The time that a device takes to draw the triangles of one scene."""

from __future__ import annotations

import os
import shutil
from hashlib import sha256
from types import TracebackType
from typing import TYPE_CHECKING, Any

from .points import Technique
from .times import Cost, CostModel, DeviceClock

if TYPE_CHECKING:
    from typing import Self

    import numpy as np
    from numpy.typing import NDArray


class SceneClock:
    """A device clock (study/times.py) for the triangles of a scene: `with SceneClock(clock, scene, model) as source:`.

    `content` identifies the triangles.
    """

    def __init__(self, clock: DeviceClock, scene: Any, model: CostModel) -> None:
        self.clock, self.model, self.name = clock, model, clock.name
        self._vertices = vertices(scene)
        self.content = sha256(self._vertices).hexdigest()[:16]
        self._folder = ""

    def __enter__(self) -> Self:
        self._folder = self.clock.session.folder("timed")
        with open(self._path, "xb") as file:
            file.write(self._vertices)
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None) -> None:
        shutil.rmtree(self._folder, ignore_errors=True)

    @property
    def _path(self) -> str:
        return os.path.join(self._folder, self.content)

    def of(self, technique: Technique, width: int, height: int) -> Cost:
        """The device's time and the model's bytes."""
        self.clock.model = self.model
        return self.clock.of(technique, width, height, self._path)


def vertices(scene: Any) -> bytes:
    """The triangles of a scene in the vertex shader's input format (confirm/scene.py)."""
    return clip(scene.triangles, scene.width, scene.height).tobytes()


def clip(triangles: NDArray[np.float64], width: int, height: int) -> NDArray[np.float32]:
    """Corners (..., 3, 2) in pixels as x, y and depth (..., 3, 3) in clip coordinates, rounded to single precision."""
    import numpy as np

    scaled = triangles * (2.0 / np.array([width, height])) - 1.0
    depths = np.full((*triangles.shape[:-1], 1), 0.5)
    corners: NDArray[np.float32] = np.concatenate([scaled, depths], axis=-1).astype(np.float32)
    return corners

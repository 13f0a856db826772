"""Vertex buffers with the triangles of meshes. Only this module of `confirm` imports NumPy, and
only if a plan has meshes.
"""

from __future__ import annotations

from typing import Any

from .meshes import MAX_VERTICES
from .opening import DEVICE_MEMORY, DeviceObjects, OpenDevice
from .parts import Mesh, Plan

MAX_LAYERS = 1024
"""Layers with depths of their own, from 0.9 to 0.4; then they start again."""

SCREEN = (-1.0, -1.0, 0.9, 3.0, -1.0, 0.9, -1.0, 3.0, 0.9)
"""A triangle that covers the screen, in clip coordinates."""


class MeshBuffers(DeviceObjects):
    """The vertex buffers of meshes, by their columns and rows, for all plans of a device."""

    def __init__(self, opened: OpenDevice) -> None:
        super().__init__(opened)
        self._buffers: dict[tuple[int, int], tuple[Any, int]] = {}

    def prepare(self, plan: Plan) -> None:
        """Creates the buffers of a plan's meshes. Nothing may be recorded with the earlier ones any
        more.
        """
        needed: dict[tuple[int, int], int] = {}
        for mesh in (mesh for step in plan.steps for inner in step.inner for mesh in inner.mesh):
            key = (mesh.columns, mesh.rows)
            needed[key] = max(needed.get(key, 0), mesh.first + mesh.triangles * mesh.draws)
        for key, triangles in needed.items():
            triangles = min(triangles, MAX_VERTICES // 3)
            if self._buffers.get(key, (None, 0))[1] < triangles:
                with self.opened.session.unheard():
                    buffer, memory = self.opened.buffer(
                        vertices(*key, triangles), properties=DEVICE_MEMORY
                    )
                self.own(self.vk.vkFreeMemory, memory)
                self._buffers[key] = self.own(self.vk.vkDestroyBuffer, buffer), triangles

    def of(self, mesh: Mesh, draw: int) -> tuple[Any, int]:
        """The buffer with the triangles of one of a mesh's draws, and the number of the first
        vertex.
        """
        buffer, triangles = self._buffers[mesh.columns, mesh.rows]
        first = mesh.first + draw * mesh.triangles
        # Of more triangles than a buffer has, the later ones are drawn where others were.
        last = max(triangles - mesh.triangles, 0)
        return buffer, 3 * (first if first <= last else first % (last + 1))


def mesh_buffers(opened: OpenDevice) -> MeshBuffers:
    """The vertex buffers of a device, which are destroyed with it."""
    if opened.meshes is None:
        opened.meshes = MeshBuffers(opened)
    assert isinstance(opened.meshes, MeshBuffers)
    return opened.meshes


def vertices(columns: int, rows: int, triangles: int) -> bytes:
    """The first triangles of a mesh in the input format of shaders/scene.vert: cell after cell, row
    by row, layer by layer, the later ones nearer.
    """
    import numpy as np

    if columns == 0:
        return np.array(SCREEN, np.float32).tobytes()
    triangle = np.arange(triangles)
    layer, cell = np.divmod(triangle // 2, columns * rows)
    # The corners of a cell, 0 to 3 row by row, in the order 0 1 2 and 2 1 3.
    corners = np.where((triangle % 2 == 0)[:, None], (0, 1, 2), (2, 1, 3))
    positions = np.empty((triangles, 3, 3), np.float32)
    positions[..., 0] = ((cell % columns)[:, None] + corners % 2) / columns * 2 - 1
    positions[..., 1] = ((cell // columns)[:, None] + corners // 2) / rows * 2 - 1
    positions[..., 2] = (0.9 - layer % MAX_LAYERS / (2 * MAX_LAYERS))[:, None]
    return positions.tobytes()

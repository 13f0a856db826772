"""A user's own triangles, of an OBJ or PLY file, seen along z, with y up and what has the greater z nearer.

trimesh reads both formats, text and binary, needs nothing but NumPy, and is well kept; meshio, the other small reader, has had no release
since January 2024, and plyfile reads PLY alone.
"""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msaa_lint.experiments.study.resolve import from_srgb

from . import LEAST, area, shapes, visible
from .scene import BLACK, WHITE, Scene

Floats = NDArray[np.float64]

MOST_BYTES = 64 << 20
MOST_TRIANGLES = 100_000
"""The exact picture of as many that overlap takes minutes."""

FORMATS = {".obj": "obj", ".ply": "ply"}


def from_mesh(path: str, width: int, height: int) -> Scene:
    """The triangles of a file, fitted into the picture with a pixel to spare on every side.

    Flat meshes (all z equal) without colours are white on black, a matter of coverage; others are in their own colours, of faces or
    vertices (taken as sRGB), or in greys by how much a triangle faces the viewer. OSError where the file cannot be read, ValueError where
    it is no such mesh or too large, ModuleNotFoundError without trimesh.
    """
    if width < LEAST or height < LEAST:
        raise ValueError(f"{width}x{height} pixels are too few: scenes are at least {LEAST} wide and high")
    corners, own = _read(path)
    flat = bool(np.ptp(corners[..., 2]) == 0)
    low, high = corners.reshape(-1, 3).min(axis=0), corners.reshape(-1, 3).max(axis=0)
    size = high - low
    if not np.all(np.isfinite(size)) or not size[:2].any():
        raise ValueError("the mesh has no extent to be seen")
    scale = min((side - 2) / part for side, part in zip((width, height), size[:2], strict=True) if part > 0)
    middle = (low + high) / 2
    made = np.empty((len(corners), 3, 2))
    made[..., 0] = (corners[..., 0] - middle[0]) * scale + width / 2
    made[..., 1] = (middle[1] - corners[..., 1]) * scale + height / 2
    name, says = os.path.basename(path), f"{len(made)} triangles of a file"
    if flat and own is None and not _overlap(made, width, height):
        colors = shapes.painted(len(made), WHITE)
        return Scene(name, says, width, height, made, colors, None, BLACK, (), {}, area.disjoint(colors, BLACK, width, height))
    colors = own if own is not None else _greys(corners)
    if flat:
        exact, crossed = visible.overlapping(colors, None, BLACK, width, height, visible.Look())
        return Scene(name, says, width, height, made, colors, None, BLACK, (), {}, exact, False, None, crossed)
    depths = 0.01 + 0.98 * (high[2] - corners[..., 2]) / size[2]
    exact, crossed = visible.overlapping(colors, depths, BLACK, width, height, visible.Look(depth=True))
    why = {"depth-test": "its triangles are at different depths"}
    settings: dict[str, object] = {"depth-test": "LESS"}
    return Scene(name, says, width, height, made, colors, depths, BLACK, ("depth-test",), why, exact, False, None, crossed, settings)


def _read(path: str) -> tuple[Floats, Floats | None]:
    """Corners (T, 3, 3), and colours (T, 4), linear, where the file has any."""
    try:
        import trimesh
    except ModuleNotFoundError:
        raise ModuleNotFoundError("trimesh, which reads meshes, is not installed: pip install 'msaa-lint[study]'", name="trimesh") from None

    form = FORMATS.get(os.path.splitext(path)[1].lower())
    if form is None:
        raise ValueError(f"meshes are {' or '.join(FORMATS)} files")
    with open(path, "rb") as file:
        if os.fstat(file.fileno()).st_size > MOST_BYTES:
            raise ValueError(f"the file is larger than {MOST_BYTES >> 20} MiB")
        try:
            # From the open file: no other file that it names, materials or textures, is looked for.
            mesh = trimesh.load_mesh(file, file_type=form, process=False, skip_materials=True)
            corners = np.asarray(mesh.triangles, np.float64)
            colors = _colors(mesh)
        except Exception as error:
            raise ValueError(f"the file is no {form.upper()} mesh: {type(error).__name__}: {str(error)[:200]}") from None
    if not len(corners):
        raise ValueError("the file has no triangles")
    if len(corners) > MOST_TRIANGLES:
        raise ValueError(f"the file has {len(corners)} triangles, more than {MOST_TRIANGLES}")
    if not np.all(np.isfinite(corners)):
        raise ValueError("a vertex has a coordinate that is no finite number")
    return corners, colors


def _colors(mesh: Any) -> Floats | None:
    """The file's own colours by triangle, linear; None where it has none."""
    kind = getattr(mesh.visual, "kind", None)
    if kind not in ("face", "vertex"):
        return None
    codes = np.asarray(mesh.visual.face_colors, np.float64) / 255
    made = np.ones((len(codes), 4))
    made[:, :3] = from_srgb(codes[:, :3])
    return made


def _greys(corners: Floats) -> Floats:
    """Lighter the more a triangle faces the viewer."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    facing = np.abs(normals[:, 2]) / np.where(lengths > 0, lengths, 1)
    light = np.round(0.1 + 0.9 * facing, 4)
    return np.stack([light, light, light, np.ones_like(light)], axis=1)


def _overlap(triangles: Floats, width: int, height: int) -> bool:
    """Whether triangles cover more of a pixel, together, than there is."""
    from msaa_lint.experiments.study import exact_area

    return bool(exact_area.areas_of(triangles, width, height).max() > 1 + area.NOTHING)

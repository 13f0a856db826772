"""A user's triangles from an OBJ or PLY file, seen along z, with y up and greater z nearer.

trimesh reads both formats, text and binary, needs only NumPy, and is maintained; meshio, the other
small reader, has had no release since January 2024, and plyfile reads only PLY.
"""

from __future__ import annotations

import io
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from msaa_lint.core.extras import needs_extra
from msaa_lint.core.text.files import read
from msaa_lint.core.text.source import Unreadable
from msaa_lint.experiments.study.exact_area import areas_of
from msaa_lint.experiments.study.locations import SUBPIXELS
from msaa_lint.experiments.study.resolve import from_srgb
from msaa_lint.experiments.study.snap import snapped

from . import area, shapes, visible
from .scene import WHITE, Scene, check_size
from .view import whole

Floats = NDArray[np.float64]

MAX_BYTES = 64 << 20
MAX_TRIANGLES = 100_000
"""Of those that overlap, `visible` has a further limit."""

MAX_COORDINATE = 1e100

FORMATS = {".obj": "obj", ".ply": "ply"}


def from_mesh(path: str, width: int, height: int) -> Scene:
    """The triangles of a file, scaled to fill the picture with a margin of one pixel.

    Flat meshes (all z equal) without colors are white on black, a scene of coverage; others have
    the colors of their faces or vertices (taken as sRGB), or a gray by how much a triangle faces
    the viewer. OSError where the file cannot be read, ValueError where it is not such a mesh, too
    large, or with too many triangles over the same pixels, ModuleNotFoundError without trimesh.
    """
    check_size(width, height)
    corners, mesh_colors = _read(path)
    flat = bool(np.ptp(corners[..., 2]) == 0)
    low, high = corners.reshape(-1, 3).min(axis=0), corners.reshape(-1, 3).max(axis=0)
    # Normals are products of extents.
    if np.abs(corners).max() > MAX_COORDINATE:
        raise ValueError(f"a vertex has a coordinate above {MAX_COORDINATE:g}")
    size = high - low
    if not size[:2].any():
        raise ValueError("the mesh has no visible extent")
    with np.errstate(over="ignore", invalid="ignore"):
        scale = min(
            (side - 2) / side_length
            for side, side_length in zip((width, height), size[:2], strict=True)
            if side_length > 0
        )
        center = low + size / 2
        triangles = np.empty((len(corners), 3, 2))
        triangles[..., 0] = (corners[..., 0] - center[0]) * scale + width / 2
        triangles[..., 1] = (center[1] - corners[..., 1]) * scale + height / 2
    if not np.all(np.isfinite(triangles)):
        raise ValueError("the mesh is too small: its extent is not a normal number")
    name, description = os.path.basename(path), f"{len(triangles)} triangles from a file"
    if (
        flat
        and mesh_colors is None
        and areas_of(triangles, width, height).max() <= 1 + area.TOLERANCE
    ):
        colors = shapes.uniform_colors(len(triangles), WHITE)
        return Scene(
            width,
            height,
            triangles,
            colors,
            area.disjoint(colors),
            name=name,
            description=description,
        )
    colors = mesh_colors if mesh_colors is not None else _grays(corners)
    depths = 0.01 + 0.98 * (high[2] - corners[..., 2]) / size[2] if not flat else None
    exact = visible.overlapping(colors, depths, width, height, visible.Visibility(depth=not flat))
    scene = Scene(
        width, height, triangles, colors, exact, False, depths, name=name, description=description
    )
    # The picture that the points are compared with is computed now, so that its limit is an error
    # of the mesh, not of each point.
    exact(whole(snapped(triangles) / SUBPIXELS, width, height))
    if flat:
        return scene
    why = {"depth-test": "the mesh has triangles at different depths"}
    return scene._replace(effects=("depth-test",), why=why, settings={"depth-test": "LESS"})


def _read(path: str) -> tuple[Floats, Floats | None]:
    """Corners (T, 3, 3), and linear colors (T, 4) if the file has any."""
    try:
        import trimesh
    except ModuleNotFoundError:
        raise ModuleNotFoundError(needs_extra("reading a mesh", "study"), name="trimesh") from None

    format = FORMATS.get(os.path.splitext(path)[1].lower())
    if format is None:
        raise ValueError(f"a mesh must be a {' or '.join(FORMATS)} file")
    try:
        data = read(path, MAX_BYTES, None)
    except Unreadable:
        raise ValueError(f"the file is larger than {MAX_BYTES >> 20} MiB") from None
    not_valid = f"the file is not a valid {format.upper()} mesh"
    problem = _broken_obj(data) if format == "obj" else ""
    if problem:
        raise ValueError(f"{not_valid}: {problem}")
    try:
        # Bytes have no folder in which trimesh would look for other files that the mesh names
        # (materials, textures).
        mesh = trimesh.load_mesh(
            io.BytesIO(data), file_type=format, process=False, skip_materials=True
        )
        problem = _broken_faces(mesh)
        corners = np.asarray(mesh.triangles, np.float64) if not problem else np.empty((0, 3, 3))
        colors = _colors(mesh) if not problem else None
    except (IndexError, KeyError):
        raise ValueError(f"{not_valid}: its header and its data do not fit together") from None
    except Exception as error:
        raise ValueError(f"{not_valid}: {type(error).__name__}: {str(error)[:200]}") from None
    if problem:
        raise ValueError(f"{not_valid}: {problem}")
    if not len(corners):
        raise ValueError("the file has no triangles")
    if len(corners) > MAX_TRIANGLES:
        raise ValueError(
            f"the file has {len(corners)} triangles; at most {MAX_TRIANGLES} are supported"
        )
    if not np.all(np.isfinite(corners)):
        raise ValueError("a vertex has a coordinate that is not finite")
    return corners, colors


def _broken_obj(data: bytes) -> str:
    """What is wrong with the vertices and faces of an OBJ file, at the first line with a mistake;
    empty if nothing is.

    trimesh renumbers vertices, so that index 0 becomes another one.
    """
    vertices, greatest, line_of_greatest = 0, 0, 0
    for number, line in enumerate(io.BytesIO(data), 1):
        if line.startswith((b"v ", b"v\t")):
            vertices += 1
            if len(line.split(b"#")[0].split()) < 4:
                return f"line {number}: a vertex needs x, y, and z"
        elif line.startswith((b"f ", b"f\t")) and not line.rstrip().endswith(b"\\"):
            try:
                indices = [int(corner.split(b"/")[0]) for corner in line.split(b"#")[0].split()[1:]]
            except ValueError:
                return f"line {number}: a face must consist of numbers of vertices"
            if len(indices) < 3:
                return f"line {number}: a face needs three vertices"
            if 0 in indices or min(indices) < -vertices:
                wrong = 0 if 0 in indices else min(indices)
                return f"line {number}: a face refers to vertex {wrong}, which does not exist"
            if max(indices) > greatest:
                greatest, line_of_greatest = max(indices), number
    if greatest > vertices:
        return (
            f"line {line_of_greatest}: a face refers to vertex {greatest}, but the file has "
            f"{vertices}"
        )
    return ""


def _broken_faces(mesh: Any) -> str:
    """What is wrong with the faces of a mesh; empty if nothing is. NumPy counts negative indices
    from the end.
    """
    faces, count = np.asarray(getattr(mesh, "faces", ())), len(getattr(mesh, "vertices", ()))
    wrong = faces[(faces < 0) | (faces >= count)]
    return (
        f"a face refers to vertex {wrong[0]} (counting from 0), but the file has {count}"
        if len(wrong)
        else ""
    )


def _colors(mesh: Any) -> Floats | None:
    """The file's colors by triangle, linear; None without colors."""
    kind = getattr(mesh.visual, "kind", None)
    if kind not in ("face", "vertex"):
        return None
    codes = np.asarray(mesh.visual.face_colors, np.float64) / 255
    linear = np.ones((len(codes), 4))
    linear[:, :3] = from_srgb(codes[:, :3])
    return linear


def _grays(corners: Floats) -> Floats:
    """A gray for each triangle, lighter the more it faces the viewer."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    facing = np.abs(normals[:, 2]) / np.where(lengths > 0, lengths, 1)
    light = np.round(0.1 + 0.9 * facing, 4)
    return np.stack([light, light, light, np.ones_like(light)], axis=1)

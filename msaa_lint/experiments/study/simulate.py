"""A scene rendered with a technique: coverage, the effects that the scene needs, and the resolve.
Nothing else is computed or allocated.

What is rendered are parts of the picture: bands of rows, so that memory does not grow with the
picture, or windows anywhere, with the scene moved by fractions of a pixel. Parts of one size are
rendered together, one below the other. The fragments go through the stages in batches of distinct
pixels, in the order of the triangles.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import coverage, effects, fragments, locations, resolve
from .drawing import Band, Batch, Drawing, Floats, group_of, has_sample
from .locations import SUBPIXELS
from .points import SAMPLE_SHADING, SSAA, Technique
from .scenes.part import Part
from .scenes.scene import Scene
from .scenes.shapes import depth_planes
from .scenes.view import Snapped, offsets, snapped
from .shade import groups, positions, shade
from .stage_times import StageTimes

T = TypeVar("T", bound=np.generic)

BAND_SAMPLES = 1 << 19
"""Approximate number of samples in a band: 8 MiB of color."""

BAND_MIN_DENSITY = 4
"""Bands with fewer samples per pixel than this are no higher than with this many: their exact
pictures take most of the memory.
"""

BAND_ROWS = 16
"""The height of a band is a multiple of this where more rows fit: exact pictures are made of tiles
of as many rows.
"""


BATCH = 1 << 15
"""Fragments that go through the stages at a time, at most."""

LARGE_TRIANGLE = 256
"""Average number of fragments from which triangles are worth looking at one by one."""


class Simulation(NamedTuple):
    """Resolved parts of a picture (P, H, W, 4), or one whole picture (H, W, 4), in linear color.
    `coverage` (..., H, W) is the share of samples that were drawn to, None for scenes without
    coverage; `depth` (..., H, W) is resolved depth for scenes that need it. `effects` are the
    stages that ran.
    """

    image: Floats
    coverage: NDArray[np.float64] | None
    effects: tuple[str, ...]
    depth: Floats | None


def simulate(
    scene: Scene, technique: Technique, bits: int = 8, part: Part | None = None
) -> Simulation:
    """The scene rendered with the technique, or a part of it, with corners snapped to 2^-bits
    pixels.
    """
    simulator = Simulator(scene, technique, bits)
    parts = [simulator.render([band]) for band in (simulator.bands() if part is None else [part])]
    image, covered, depth = (
        None
        if parts[0][column] is None
        else np.concatenate([np.asarray(each[column])[0] for each in parts])
        for column in (0, 1, 3)
    )
    assert image is not None
    return Simulation(image, covered, simulator.effect_names, depth)


class Simulator:
    """Renders parts of the picture of a scene and a technique. `times` accumulates what the stages
    take.
    """

    def __init__(self, scene: Scene, technique: Technique, bits: int = 8) -> None:
        self.scene, self.bits = scene, bits
        self.grid = technique.grid if technique.kind == SSAA else 1
        self.samples = 1 if technique.kind == SSAA else technique.samples
        self.sample_locations = locations.standard(self.samples)
        # Without a shader, every invocation gives the triangle's color.
        sample_shading = technique.kind == SAMPLE_SHADING and scene.shade is not None
        self.effects = effects.ordered(
            (*scene.effects, effects.SAMPLE_SHADING) if sample_shading else scene.effects
        )
        self.effect_names = tuple(effect.name for effect in self.effects)
        self.times = StageTimes(self.effect_names)
        self.sample_groups = groups(self.samples, technique.shaded if sample_shading else 1)
        self.pixel_locations = self.sample_locations.astype(np.float64) / SUBPIXELS
        self.shading_positions = positions(self.pixel_locations, self.sample_groups)
        self.colors = scene.colors.astype(np.float32)
        self.fragment_stages = [
            (effect.name, effect.fragment) for effect in self.effects if effect.fragment is not None
        ]
        self.blend = next(
            ((effect.name, effect.blend) for effect in self.effects if effect.blend is not None),
            None,
        )
        self.store = self._store()

    def has(self, name: str) -> bool:
        """Whether the scene needs an effect."""
        return name in self.effect_names

    def _store(self) -> tuple[str, Callable[[Floats], Floats]] | None:
        storing: list[tuple[str, Callable[[Floats], Floats]]] = [
            (effect.name, effect.store) for effect in self.effects if effect.store is not None
        ]
        if len(storing) > 1:
            raise ValueError(
                f"{' and '.join(name for name, _ in storing)} exclude each other: a sample is "
                "stored in one format"
            )
        return storing[0] if storing else None

    def bands(self) -> Iterator[Part]:
        """The picture in bands of rows."""
        width, height = self.scene.width, self.scene.height
        step = max(
            BAND_SAMPLES // (width * max(self.grid * self.grid * self.samples, BAND_MIN_DENSITY)), 1
        )
        if step > BAND_ROWS:
            step -= step % BAND_ROWS
        for top in range(0, height, step):
            yield Part(0, top, width, min(step, height - top))

    def snapped(self, parts: Sequence[Part]) -> Snapped:
        """The triangles near parts of one size as the technique renders them."""
        return snapped(self.scene.triangles, parts, self.grid, self.bits)

    def render(self, parts: Sequence[Part], triangles: Snapped | None = None) -> Simulation:
        """Parts of one size; `triangles` are snapped(parts)."""
        if triangles is None:
            triangles = self.snapped(parts)
        size = len(parts), parts[0].height, parts[0].width
        band = self.band(size[0] * size[1] * size[2] * self.grid * self.grid)
        self._draw(band, triangles)
        image = self._color(band, size[2]).reshape(*size, 4)
        covered = (
            None if band.written is None else self._coverage(band.written, size[2]).reshape(size)
        )
        depth = self._depth(band, size[2]).reshape(size) if self.has("depth-resolve") else None
        return Simulation(image, covered, self.effect_names, depth)

    def band(self, pixels: int) -> Band:
        """Cleared samples."""
        color = np.empty((self.samples, pixels, 4), np.float32)
        background = np.asarray(self.scene.background, np.float32)
        _pack(color)[:] = _pack(background if self.store is None else self.store[1](background))
        depth = stencil = None
        if self.has("depth-test"):
            clear = effects.clear_depth(self.scene.settings.get("depth-test", "LESS"))
            depth = np.full((self.samples, pixels), clear, np.float32)
        if self.has("stencil"):
            stencil = np.zeros((self.samples, pixels), np.uint8)
        written = np.zeros(pixels, np.uint16) if self.scene.coverage_matter else None
        return Band(color, depth, stencil, written)

    def _draw(self, band: Band, triangles: Snapped) -> None:
        """Draws triangles into the samples of their parts, which are one below the other."""
        grid, parts = self.grid, triangles.parts
        first = parts[0]
        width, height = first.width * grid, first.height * grid
        scene_to_stack = (offsets(parts) - (first.left, first.top)) * grid
        corners = triangles.corners + scene_to_stack[triangles.part][:, None] * SUBPIXELS
        rows_of = triangles.part[:, None] * height + (0, height)
        rows = coverage.rows(
            corners, width, height * len(parts), self.sample_locations, limits=rows_of
        )
        drawn = fragments.fragments(rows, self.samples)
        planes = None
        if self.has("depth-test") and self.scene.depths is not None:
            planes = depth_planes(
                triangles.corners / SUBPIXELS, self.scene.depths[triangles.triangle]
            )
        drawing = Drawing(
            self.samples, self.pixel_locations, self.sample_groups, self.scene.settings, planes
        )
        motion = np.array([(part.dx, part.dy) for part in parts])
        moves = self.scene.shade is not None and bool(motion.any())
        pixel = drawn.y.astype(np.intp) * width + drawn.x
        number_of, in_scene = triangles.triangle.astype(np.int32), -scene_to_stack.astype(np.int32)
        for which in _batches(pixel, drawn.triangle):
            number = drawn.triangle[which]
            part = 0 if len(parts) == 1 else triangles.part[number]
            shift = in_scene[part].T
            batch = Batch(
                number_of[number],
                pixel[which],
                drawn.x[which] + shift[0],
                drawn.y[which] + shift[1],
                drawn.mask[which],
            )
            batch.plane = number
            moved = np.broadcast_to(motion[part], (len(number), 2)) if moves else None
            with self.times.stage(effects.SAMPLE_SHADING):
                batch.color = shade(
                    self.scene, batch, self.shading_positions, grid, self.colors, moved
                )
            for name, stage in self.fragment_stages:
                with self.times.stage(name):
                    stage(batch, band, drawing)
            self._write(batch, band)

    def _write(self, batch: Batch, band: Band) -> None:
        if band.written is not None:
            band.written[batch.pixel] |= batch.mask
        color, per_group = _pack(batch.color), batch.color.shape[1] > 1
        for sample in range(self.samples):
            mask = has_sample(batch.mask, sample)
            # Most fragments are inside shapes and have every sample: whole batches are then moved
            # without indexing.
            drawn = slice(None) if mask.all() else mask
            pixels, plane = batch.pixel[drawn], _pack(band.color[sample])
            texels = color[drawn, group_of(sample, self.sample_groups) if per_group else 0]
            if self.blend is not None:
                with self.times.stage(self.blend[0]):
                    texels = _pack(self.blend[1](_unpack(texels), _unpack(plane[pixels])))
            if self.store is not None:
                with self.times.stage(self.store[0]):
                    texels = _pack(self.store[1](_unpack(texels)))
            plane[pixels] = texels

    def _color(self, band: Band, width: int) -> Floats:
        """The resolved color of samples (P, 4), after any tone mapping."""
        samples = self._per_pixel(band.color, width)
        tone_mapping = (
            str(self.scene.settings.get("tone-mapping", "after-resolve"))
            if self.has("tone-mapping")
            else ""
        )
        encoded = self.has("srgb") and self.scene.settings.get("srgb") == "encoded"
        if tone_mapping == "before-resolve":
            with self.times.stage("tone-mapping"):
                samples = resolve.tone_map(samples)
        if encoded:
            with self.times.stage("srgb"):
                samples = resolve.encode(samples)
        color = (
            resolve.weighted(samples) if tone_mapping == "weighted" else resolve.average(samples)
        )
        if encoded:
            with self.times.stage("srgb"):
                color = resolve.decode(color)
        if self.store is not None:
            with self.times.stage(self.store[0]):
                color = self.store[1](color)
        if tone_mapping not in ("after-resolve", "weighted"):
            return color
        with self.times.stage("tone-mapping"):
            return resolve.tone_map(color)

    def _coverage(self, written: NDArray[np.uint16], width: int) -> NDArray[np.float64]:
        """The share of each pixel's samples that were drawn to (P,)."""
        counts = self._per_pixel(np.bitwise_count(written)[None, :, None], width)
        shares: NDArray[np.float64] = counts.sum(axis=0, dtype=np.int64)[..., 0] / (
            self.samples * self.grid * self.grid
        )
        return shares

    def _depth(self, band: Band, width: int) -> Floats:
        """Resolved depth (P,)."""
        assert band.depth is not None
        mode = str(self.scene.settings.get("depth-resolve", "SAMPLE_ZERO"))
        with self.times.stage("depth-resolve"):
            return resolve.resolve_depth(
                self._per_pixel(band.depth[..., None], width)[..., 0], mode
            )

    def _per_pixel(self, samples: NDArray[T], width: int) -> NDArray[T]:
        """Rendered samples (N, P, C) as samples of the resolved picture: for SSAA the pixels of a
        block, row by row.
        """
        if self.grid == 1:
            return samples
        grid, channels = self.grid, samples.shape[-1]
        blocks = samples.reshape(-1, grid, width, grid, channels).transpose(1, 3, 0, 2, 4)
        return np.ascontiguousarray(blocks).reshape(grid * grid, -1, channels)


def _pack(color: Floats) -> NDArray[np.complex128]:
    """Colors (..., 4) as (...), each in one number of the same size, which NumPy moves faster; in
    the same memory if a color's components are adjacent.
    """
    adjacent = color if color.strides[-1] == color.itemsize else np.ascontiguousarray(color)
    texels: NDArray[np.complex128] = adjacent.view(np.complex128)[..., 0]
    return texels


def _unpack(texels: NDArray[np.complex128]) -> Floats:
    """The same colors as (..., 4)."""
    return np.ascontiguousarray(texels)[..., None].view(np.float32)


def _batches(
    pixel: NDArray[np.intp], triangle: NDArray[np.int32]
) -> Iterator[slice | NDArray[np.intp]]:
    """Fragments, ordered by triangle, in batches of distinct pixels that fit the cache; fragments
    of one pixel stay in order.
    """
    count = len(pixel)
    if not count:
        return
    starts = np.flatnonzero(np.concatenate(([True], triangle[1:] != triangle[:-1])))
    if len(starts) * LARGE_TRIANGLE < count:
        for start, end in _runs(pixel, np.append(starts, count)):
            yield from (slice(first, min(first + BATCH, end)) for first in range(start, end, BATCH))
        return
    order = np.argsort(pixel, kind="stable")
    ordered_pixels = pixel[order]
    starts = np.flatnonzero(np.concatenate(([True], ordered_pixels[1:] != ordered_pixels[:-1])))
    if len(starts) == count:
        yield from (slice(start, start + BATCH) for start in range(0, count, BATCH))
        return
    # The first fragment of every pixel, then the second, and so on.
    rank = np.arange(count) - np.repeat(starts, np.diff(np.append(starts, count)))
    by_rank = order[np.argsort(rank, kind="stable")]
    begin = 0
    for size in np.bincount(rank):
        yield from (
            by_rank[start : min(start + BATCH, begin + size)]
            for start in range(begin, begin + size, BATCH)
        )
        begin += size


def _runs(pixel: NDArray[np.intp], limits: NDArray[np.intp]) -> Iterator[tuple[int, int]]:
    """The begins and ends of the longest runs of triangles, whose fragments begin and end at
    `limits`, that do not overlap.
    """
    run_of = np.zeros(int(pixel.max()) + 1, np.int32)
    number, begin = 1, 0
    for start, end in pairwise(limits.tolist()):
        pixels = pixel[start:end]
        if (run_of[pixels] == number).any():
            yield begin, start
            number, begin = number + 1, start
        run_of[pixels] = number
    yield begin, int(limits[-1])

"""A scene rendered with a technique: coverage, the effects that the scene needs, and the resolve. Nothing else is computed or allocated.

The picture is rendered in bands of rows so that memory besides the picture does not grow with its height. The fragments of a band go
through the stages in batches of distinct pixels, in the order of the triangles.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import coverage, effects, fragments, locations, resolve, snap
from .drawing import Band, Batch, Drawing, Floats, group_of, has_sample
from .effects import Effect
from .locations import SUBPIXELS
from .points import SAMPLE_SHADING, SSAA, Technique
from .scenes.scene import Scene
from .scenes.shapes import depth_planes
from .shade import groups, positions, shade

T = TypeVar("T", bound=np.generic)

BAND_SAMPLES = 1 << 19
"""Approximate number of samples in a band: 8 MiB of color."""


class Simulation(NamedTuple):
    """A resolved picture (H, W, 4) in linear color. `coverage` (H, W) is the share of samples that were drawn to, None for scenes without
    coverage; `depth` (H, W) is resolved depth for scenes that need it. `effects` are the stages that ran; `milliseconds` is the time of the
    simulation, which says nothing about a GPU."""

    image: Floats
    coverage: NDArray[np.float64] | None
    effects: tuple[str, ...]
    depth: Floats | None
    milliseconds: float


def snapped_triangles(scene: Scene, technique: Technique, bits: int = 8) -> NDArray[np.int64]:
    """The scene's triangles (T, 3, 2) in subpixels of the picture that the technique renders, which is larger for SSAA."""
    return snap.snapped(scene.triangles * technique.grid, bits)


def simulate(scene: Scene, technique: Technique, bits: int = 8) -> Simulation:
    """The scene rendered with the technique, with corners snapped to 2^-bits pixels."""
    start = time.perf_counter()
    renderer = _Renderer(scene, technique, bits)
    height, width = scene.height, scene.width
    image = np.empty((height, width, 4), np.float32)
    covered = np.empty((height, width)) if scene.coverage_matter else None
    depth = np.empty((height, width), np.float32) if renderer.has("depth-resolve") else None
    for top, bottom, rows in renderer.bands():
        band = renderer.band(bottom - top)
        renderer.draw(band, rows, top * renderer.grid)
        image[top:bottom] = renderer.color(band).reshape(-1, width, 4)
        if covered is not None:
            covered[top:bottom] = renderer.coverage(band).reshape(-1, width)
        if depth is not None:
            depth[top:bottom] = renderer.depth(band).reshape(-1, width)
    return Simulation(image, covered, renderer.effect_names, depth, 1000 * (time.perf_counter() - start))


class _Renderer:
    """Everything that does not change from band to band of a scene and a technique."""

    def __init__(self, scene: Scene, technique: Technique, bits: int) -> None:
        self.scene = scene
        self.grid = technique.grid if technique.kind == SSAA else 1
        self.samples = 1 if technique.kind == SSAA else technique.samples
        self.width = scene.width * self.grid
        triangles = snapped_triangles(scene, technique, bits)
        subpixel_locations = locations.standard(self.samples)
        self.rows = coverage.rows(triangles, self.width, scene.height * self.grid, subpixel_locations)
        # Without a shader, every invocation gives the triangle's color.
        sample_shading = technique.kind == SAMPLE_SHADING and scene.shade is not None
        self.effects = effects.ordered((*scene.effects, effects.SAMPLE_SHADING) if sample_shading else scene.effects)
        self.effect_names = tuple(effect.name for effect in self.effects)
        planes = depth_planes(triangles / SUBPIXELS, scene.depths) if self.has("depth-test") and scene.depths is not None else None
        sample_groups = groups(self.samples, technique.shaded if sample_shading else 1)
        pixel_locations = subpixel_locations.astype(np.float64) / SUBPIXELS
        self.drawing = Drawing(self.samples, pixel_locations, sample_groups, scene.settings, planes)
        self.shading_positions = positions(pixel_locations, sample_groups)
        self.colors = scene.colors.astype(np.float32)
        self.fragment_stages = [effect.fragment for effect in self.effects if effect.fragment is not None]
        self.blend = next((effect.blend for effect in self.effects if effect.blend is not None), None)
        self.store = self._store()

    def has(self, name: str) -> bool:
        """Whether the scene needs an effect."""
        return name in self.effect_names

    def _store(self) -> Callable[[Floats], Floats] | None:
        storing: list[Effect] = [effect for effect in self.effects if effect.store is not None]
        if len(storing) > 1:
            raise ValueError(f"{' and '.join(effect.name for effect in storing)} exclude each other: a sample is stored in one format")
        return storing[0].store if storing else None

    def bands(self) -> Iterator[tuple[int, int, coverage.Rows]]:
        """The first row and the end of each band of the resolved picture, and its covered rows."""
        height = self.scene.height
        step = max(BAND_SAMPLES // (self.width * self.grid * self.samples), 1)
        number = self.rows.row // (step * self.grid)
        order = np.argsort(number, kind="stable")
        limits = np.searchsorted(number[order], np.arange(-(-height // step) + 1))
        for place, top in enumerate(range(0, height, step)):
            which = order[limits[place] : limits[place + 1]]
            yield top, min(top + step, height), coverage.Rows(*(column[which] for column in self.rows))

    def band(self, rows: int) -> Band:
        """The cleared samples of `rows` rows of the resolved picture."""
        pixels = rows * self.grid * self.width
        color = np.empty((self.samples, pixels, 4), np.float32)
        background = np.asarray(self.scene.background, np.float32)
        color[:] = background if self.store is None else self.store(background)
        depth = stencil = None
        if self.has("depth-test"):
            clear = effects.clear_depth(self.drawing.settings.get("depth-test", "LESS"))
            depth = np.full((self.samples, pixels), clear, np.float32)
        if self.has("stencil"):
            stencil = np.zeros((self.samples, pixels), np.uint8)
        written = np.zeros(pixels, np.uint16) if self.scene.coverage_matter else None
        return Band(color, depth, stencil, written)

    def draw(self, band: Band, rows: coverage.Rows, top: int) -> None:
        """Draws the covered rows into a band whose first rendered row is `top`."""
        drawn = fragments.fragments(rows, self.samples)
        pixel = (drawn.y - top).astype(np.intp) * self.width + drawn.x
        for which in _batches(pixel, drawn.triangle):
            batch = Batch(drawn.triangle[which], pixel[which], drawn.x[which], drawn.y[which], drawn.mask[which])
            batch.color = shade(self.scene, batch, self.shading_positions, self.grid, self.colors)
            for stage in self.fragment_stages:
                stage(batch, band, self.drawing)
            self._write(batch, band)

    def _write(self, batch: Batch, band: Band) -> None:
        if band.written is not None:
            band.written[batch.pixel] |= batch.mask
        color, per_group = _pack(batch.color), batch.color.shape[1] > 1
        for sample in range(self.samples):
            mask = has_sample(batch.mask, sample)
            # Most fragments are inside shapes and have every sample: whole batches are then moved without indexing.
            drawn = slice(None) if mask.all() else mask
            pixels, plane = batch.pixel[drawn], _pack(band.color[sample])
            texels = color[drawn, group_of(sample, self.drawing.groups) if per_group else 0]
            if self.blend is not None:
                texels = _pack(self.blend(_unpack(texels), _unpack(plane[pixels])))
            if self.store is not None:
                texels = _pack(self.store(_unpack(texels)))
            plane[pixels] = texels

    def color(self, band: Band) -> Floats:
        """The resolved color of a band (P, 4), after any tone mapping."""
        samples = self._per_pixel(band.color)
        tone_mapping = self.scene.settings.get("tone-mapping", "after-resolve") if self.has("tone-mapping") else ""
        encoded = self.has("srgb") and self.scene.settings.get("srgb") == "encoded"
        if tone_mapping == "before-resolve":
            samples = resolve.tone_map(samples)
        if encoded:
            samples = resolve.encode(samples)
        color = resolve.weighted(samples) if tone_mapping == "weighted" else resolve.average(samples)
        if encoded:
            color = resolve.decode(color)
        if self.store is not None:
            color = self.store(color)
        return resolve.tone_map(color) if tone_mapping in ("after-resolve", "weighted") else color

    def coverage(self, band: Band) -> NDArray[np.float64]:
        """The share of each pixel's samples that were drawn to (P,)."""
        assert band.written is not None
        counts = self._per_pixel(np.bitwise_count(band.written)[None, :, None])
        shares: NDArray[np.float64] = counts.sum(axis=0, dtype=np.int64)[..., 0] / (self.samples * self.grid * self.grid)
        return shares

    def depth(self, band: Band) -> Floats:
        """The resolved depth of a band (P,)."""
        assert band.depth is not None
        mode = str(self.scene.settings.get("depth-resolve", "SAMPLE_ZERO"))
        return resolve.resolve_depth(self._per_pixel(band.depth[..., None])[..., 0], mode)

    def _per_pixel(self, samples: NDArray[T]) -> NDArray[T]:
        """Rendered samples (N, P, C) as samples of the resolved picture: for SSAA the pixels of a block, row by row."""
        if self.grid == 1:
            return samples
        grid, channels = self.grid, samples.shape[-1]
        blocks = samples.reshape(-1, grid, self.scene.width, grid, channels).transpose(1, 3, 0, 2, 4)
        return np.ascontiguousarray(blocks).reshape(grid * grid, -1, channels)


def _pack(color: Floats) -> NDArray[np.complex128]:
    """Colors (..., 4) as (...), each in one number of the same size, which NumPy moves faster."""
    texels: NDArray[np.complex128] = np.ascontiguousarray(color).view(np.complex128)[..., 0]
    return texels


def _unpack(texels: NDArray[np.complex128]) -> Floats:
    """The same colors as (..., 4)."""
    return np.ascontiguousarray(texels)[..., None].view(np.float32)


def _batches(pixel: NDArray[np.intp], triangle: NDArray[np.int32]) -> Iterator[slice | NDArray[np.intp]]:
    """Fragments in batches of distinct pixels: the first fragment of every pixel, then the second, and so on."""
    count = len(pixel)
    if not count:
        return
    if triangle[0] == triangle[-1]:
        yield slice(None)
        return
    order = np.argsort(pixel, kind="stable")
    ordered_pixels = pixel[order]
    starts = np.flatnonzero(np.concatenate(([True], ordered_pixels[1:] != ordered_pixels[:-1])))
    sizes = np.diff(np.append(starts, count))
    if len(starts) == count:
        yield slice(None)
        return
    rank = np.arange(count) - np.repeat(starts, sizes)
    by_rank = order[np.argsort(rank, kind="stable")]
    start = 0
    for size in np.bincount(rank):
        yield by_rank[start : start + size]
        start += size

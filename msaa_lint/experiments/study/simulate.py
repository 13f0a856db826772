"""A scene drawn with a technique: coverage, the stages that the scene calls for, the resolve. Nothing else is computed or allocated.

The picture is drawn in bands of rows, so that memory beside the picture does not grow with its height; fragments of a band go through the
stages in batches in which no pixel comes twice, in the order of the triangles.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import coverage, fragments, locations, snap
from .effects import SAMPLE_SHADING, Effect, depth_resolve, depth_test, ordered, srgb, tone_mapping
from .effects.drawing import Band, Batch, Drawing, Floats, chosen, group_of
from .locations import SUBPIXELS
from .points import SAMPLE_SHADING as SHADED
from .points import SSAA, Technique
from .resolve import average, weighted
from .scenes.scene import Scene
from .shade import groups, places, planes, shaded

T = TypeVar("T", bound=np.generic)

BAND = 1 << 19
"""Samples of a band, about: 8 MiB of colour."""


class Simulated(NamedTuple):
    """A picture (H, W, 4) in linear colour, resolved. `coverage` (H, W) is the share of samples that anything was drawn to, None where the
    scene is no matter of coverage; `depth` (H, W) is resolved depth where the scene calls for it. `effects` are the stages that ran;
    `milliseconds` are this simulation's, and nobody's GPU."""

    image: Floats
    coverage: NDArray[np.float64] | None
    effects: tuple[str, ...]
    depth: Floats | None
    milliseconds: float


def snapped(scene: Scene, technique: Technique, bits: int = 8) -> NDArray[np.int64]:
    """The scene's triangles (T, 3, 2) in subpixels of the picture that the technique draws, which for SSAA is larger."""
    return snap.snapped(scene.triangles * technique.grid, bits)


def simulated(scene: Scene, technique: Technique, bits: int = 8) -> Simulated:
    """The scene drawn with the technique, corners snapped to 2^-bits pixels."""
    started = time.perf_counter()
    draw = _Draw(scene, technique, bits)
    height, width = scene.height, scene.width
    image = np.empty((height, width, 4), np.float32)
    covered = np.empty((height, width)) if scene.coverage_matter else None
    depth = np.empty((height, width), np.float32) if draw.resolves_depth else None
    for top, bottom, found in draw.bands():
        band = draw.band(bottom - top)
        draw.fill(band, found, top * draw.grid)
        image[top:bottom] = draw.picture(band).reshape(-1, width, 4)
        if covered is not None:
            covered[top:bottom] = draw.share(band).reshape(-1, width)
        if depth is not None:
            depth[top:bottom] = draw.depth(band).reshape(-1, width)
    return Simulated(image, covered, draw.names, depth, 1000 * (time.perf_counter() - started))


class _Draw:
    """A scene and a technique, made ready: what every band needs."""

    def __init__(self, scene: Scene, technique: Technique, bits: int) -> None:
        self.scene = scene
        self.grid = technique.grid if technique.kind == SSAA else 1
        self.samples = 1 if technique.kind == SSAA else technique.samples
        self.width = scene.width * self.grid
        triangles = snapped(scene, technique, bits)
        at = locations.standard(self.samples)
        self.rows = coverage.rows(triangles, self.width, scene.height * self.grid, at)
        own = scene.effects
        # Where a triangle has one colour all over, every invocation gives the same.
        if technique.kind == SHADED and scene.shade is not None:
            own = (*own, SAMPLE_SHADING)
        self.effects = ordered(own)
        self.names = tuple(each.name for each in self.effects)
        invocations = technique.shaded if SAMPLE_SHADING in own else 1
        depths = planes(triangles / SUBPIXELS, scene.depths) if self._has("depth-test") and scene.depths is not None else None
        shared = groups(self.samples, invocations)
        places_px = at.astype(np.float64) / SUBPIXELS
        self.drawing = Drawing(self.samples, places_px, shared, scene.settings, depths)
        self.at = places(places_px, shared)
        self.colors = scene.colors.astype(np.float32)
        self.stages = [each.fragment for each in self.effects if each.fragment is not None]
        self.write = self._only("write")
        self.stored = self._only("stored")
        self.resolves_depth = self._has("depth-resolve")

    def _has(self, name: str) -> bool:
        return name in self.names

    def _only(self, hook: str) -> Callable[..., Floats] | None:
        found: list[Effect] = [each for each in self.effects if getattr(each, hook) is not None]
        if len(found) > 1:
            raise ValueError(f"{' and '.join(each.name for each in found)} cannot both be: a sample is stored in one format")
        return getattr(found[0], hook) if found else None

    def bands(self) -> Iterator[tuple[int, int, coverage.Rows]]:
        """Rows of the resolved picture from and to, and the covered rows of what is drawn there."""
        height = self.scene.height
        step = max(BAND // (self.width * self.grid * self.samples), 1)
        number = self.rows.row // (step * self.grid)
        order = np.argsort(number, kind="stable")
        limits = np.searchsorted(number[order], np.arange(-(-height // step) + 1))
        for place, top in enumerate(range(0, height, step)):
            which = order[limits[place] : limits[place + 1]]
            yield top, min(top + step, height), coverage.Rows(*(each[which] for each in self.rows))

    def band(self, rows: int) -> Band:
        """Cleared samples of so many rows of the resolved picture."""
        pixels = rows * self.grid * self.width
        color = np.empty((self.samples, pixels, 4), np.float32)
        behind = np.asarray(self.scene.background, np.float32)
        color[:] = behind if self.stored is None else self.stored(behind)
        depth = stencil = None
        if self._has("depth-test"):
            clear = depth_test.cleared(self.drawing.settings.get("depth-test", "LESS"))
            depth = np.full((self.samples, pixels), clear, np.float32)
        if self._has("stencil"):
            stencil = np.zeros((self.samples, pixels), np.uint8)
        written = np.zeros(pixels, np.uint16) if self.scene.coverage_matter else None
        return Band(color, depth, stencil, written)

    def fill(self, band: Band, rows: coverage.Rows, top: int) -> None:
        """Draws the covered rows; `top` is the first row of what is drawn."""
        found = fragments.fragments(rows, self.samples)
        pixel = (found.y - top).astype(np.intp) * self.width + found.x
        for which in _batches(pixel, found.triangle):
            batch = Batch(found.triangle[which], pixel[which], found.x[which], found.y[which], found.mask[which])
            batch.color = shaded(self.scene, batch, self.drawing, self.at, self.grid, self.colors)
            for stage in self.stages:
                stage(batch, band, self.drawing)
            self._output(batch, band)

    def _output(self, batch: Batch, band: Band) -> None:
        if band.written is not None:
            band.written[batch.pixel] |= batch.mask
        color, several = _texels(batch.color), batch.color.shape[1] > 1
        for sample in range(self.samples):
            has = chosen(batch.mask, sample)
            # Most fragments are within shapes, where each has every sample: whole batches are moved without being searched.
            drawn = slice(None) if has.all() else has
            pixels, plane = batch.pixel[drawn], _texels(band.color[sample])
            own = color[drawn, group_of(sample, self.drawing.groups) if several else 0]
            if self.write is not None:
                own = _texels(self.write(_parts(own), _parts(plane[pixels])))
            if self.stored is not None:
                own = _texels(self.stored(_parts(own)))
            plane[pixels] = own

    def picture(self, band: Band) -> Floats:
        """The band resolved (P, 4), displayed where there is tone mapping."""
        samples = self._folded(band.color)
        place = self.scene.settings.get("tone-mapping", "after-resolve") if self._has("tone-mapping") else ""
        coded = self._has("srgb") and self.scene.settings.get("srgb") == "encoded"
        if place == "before-resolve":
            samples = tone_mapping.mapped(samples)
        if coded:
            samples = srgb.encoded(samples)
        made = weighted(samples) if place == "weighted" else average(samples)
        if coded:
            made = srgb.decoded(made)
        if self.stored is not None:
            made = self.stored(made)
        return tone_mapping.mapped(made) if place in ("after-resolve", "weighted") else made

    def share(self, band: Band) -> NDArray[np.float64]:
        """The share of each pixel's samples that anything was drawn to (P,)."""
        assert band.written is not None
        counts = np.bitwise_count(band.written)[None, :, None]
        folded = self._folded(counts)
        shares: NDArray[np.float64] = folded.sum(axis=0, dtype=np.int64)[..., 0] / (self.samples * self.grid * self.grid)
        return shares

    def depth(self, band: Band) -> Floats:
        """Resolved depth (P,)."""
        assert band.depth is not None
        mode = str(self.scene.settings.get("depth-resolve", "SAMPLE_ZERO"))
        return depth_resolve.resolved(self._folded(band.depth[..., None])[..., 0], mode)

    def _folded(self, samples: NDArray[T]) -> NDArray[T]:
        """Samples (N, P, C) of what is drawn as samples of the resolved picture: for SSAA the pixels of a block, rows first."""
        if self.grid == 1:
            return samples
        grid, parts = self.grid, samples.shape[-1]
        blocks = samples.reshape(-1, grid, self.scene.width, grid, parts).transpose(1, 3, 0, 2, 4)
        return np.ascontiguousarray(blocks).reshape(grid * grid, -1, parts)


def _texels(color: Floats) -> NDArray[np.complex128]:
    """Colours (..., 4) as (...), each in one number of as many bits, which NumPy moves faster."""
    made: NDArray[np.complex128] = np.ascontiguousarray(color).view(np.complex128)[..., 0]
    return made


def _parts(texels: NDArray[np.complex128]) -> Floats:
    """The same colours as (..., 4)."""
    return np.ascontiguousarray(texels)[..., None].view(np.float32)


def _batches(pixel: NDArray[np.intp], triangle: NDArray[np.int32]) -> Iterator[slice | NDArray[np.intp]]:
    """Fragments in batches without a pixel twice: first the first fragment of every pixel, then the second, and on."""
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

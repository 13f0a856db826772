"""The error of a picture against the exact one, band by band, so that memory does not grow with the
picture.
"""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray

from . import displayed
from .flicker import flicker
from .points import MSAA, SAMPLE_SHADING, Point, Technique
from .scenes.part import Part
from .scenes.scene import Scene
from .scenes.view import Truth, snapped
from .simulate import Simulation, Simulator
from .sums import ErrorSum, Sum, difference

ONE = Technique(MSAA, 1)


def truth(
    scene: Scene, technique: Technique = ONE, bits: int = 8, part: Part | None = None
) -> Truth:
    """The exact picture of the triangles as the technique snaps them, so that only the error of
    sampling remains; of the whole scene or of a part.
    """
    whole = part or Part(0, 0, scene.width, scene.height)
    image, edge_pixels = scene.exact(snapped(scene.triangles, [whole], technique.grid, bits).view())
    return Truth(image[0], edge_pixels[0])


_LAST: list[tuple[Scene, tuple[object, ...], Point]] = []


def point(
    scene: Scene, technique: Technique, bits: int = 8, ssim: bool = False, flip: bool = False
) -> Point:
    """A point without time, bytes, power and memory. Errors are of sampling alone."""
    rendered = same_picture(scene, technique)
    key = (rendered, bits, ssim, flip)
    for cached_scene, cached_key, cached in _LAST:
        if cached_scene is scene and cached_key == key:
            measured = cached
            break
    else:
        measured = _measure(scene, rendered, bits, ssim, flip)
        _LAST[:] = [(scene, key, measured)]
    return measured._replace(technique=technique)


def same_picture(scene: Scene, technique: Technique) -> Technique:
    """The technique to simulate: without a shader, sample shading gives the picture of
    multisampling.
    """
    return (
        Technique(MSAA, technique.samples)
        if technique.kind == SAMPLE_SHADING and scene.shade is None
        else technique
    )


class _Sums:
    """The sums that the errors of a point are made of."""

    def __init__(self, scene: Scene, keep: bool) -> None:
        self.scene = scene
        self.edges, self.all, self.light, self.shown = ErrorSum(), ErrorSum(), Sum(), Sum()
        self.edge_pixels = 0
        self.kept: list[tuple[displayed.Floats, displayed.Floats]] | None = [] if keep else None

    def add(self, simulation: Simulation, exact: Truth) -> None:
        """Adds a band; the displayed pictures are kept if they are needed as a whole."""
        image, edge_pixels = exact
        light = simulation.image[..., :3]
        if simulation.coverage is not None:
            differences = difference(simulation.coverage, image[..., 3])
        else:
            differences = difference(light, image[..., :3])
        self.edges.add(differences[edge_pixels])
        self.all.add(differences)
        self.edge_pixels += int(np.count_nonzero(edge_pixels))
        rounded = difference(light, image[..., :3].astype(np.float32))
        self.light.add(rounded * rounded)
        shown = self._shown(simulation.image, image)
        self.shown.add(shown * shown)

    def _shown(self, measured: displayed.Floats, exact: NDArray[np.float64]) -> NDArray[np.float64]:
        """The difference of what the display shows."""
        if self.kept is not None:
            codes = (
                displayed.display_codes(self.scene, measured),
                displayed.display_codes(self.scene, exact),
            )
            self.kept.append((codes[0][0], codes[1][0]))
            return difference(*codes)
        differences = np.zeros((*measured.shape[:-1], 3))
        # Most pixels of a scene of coverage are inside or outside of shapes, and are not encoded.
        differ = (measured != exact).any(axis=-1)
        codes = (
            displayed.display_codes(self.scene, measured[differ]),
            displayed.display_codes(self.scene, exact[differ]),
        )
        differences[differ] = difference(*codes)
        return differences

    def pictures(self) -> tuple[displayed.Floats, displayed.Floats]:
        """What the display shows of the measured and of the exact picture (H, W, 3)."""
        measured, exact = zip(*(self.kept or []), strict=True)
        return np.concatenate(measured), np.concatenate(exact)


def _measure(scene: Scene, technique: Technique, bits: int, ssim: bool, flip: bool) -> Point:
    simulator, sums = Simulator(scene, technique, bits), _Sums(scene, ssim or flip)
    seconds = 0.0
    for band in simulator.bands():
        start = time.perf_counter()
        triangles = simulator.snapped([band])
        simulation = simulator.render([band], triangles)
        seconds += time.perf_counter() - start
        sums.add(simulation, scene.exact(triangles.view()))
    edges = sums.edges.errors()
    return Point(
        scene=scene.name,
        technique=technique,
        width=scene.width,
        height=scene.height,
        rmse=edges.rmse,
        rmse_all=sums.all.errors().rmse,
        max_error=edges.greatest,
        bias=edges.bias,
        psnr_db=sums.light.psnr(),
        psnr_display_db=sums.shown.psnr(),
        edge_pixels=sums.edge_pixels,
        effects=simulator.effect_names,
        ssim=displayed.ssim(*sums.pictures()) if ssim else None,
        flip=displayed.flip(*sums.pictures()) if flip else None,
        flicker=flicker(scene, technique, bits),
        simulated_ms=1000 * seconds,
        stages=simulator.times.table(),
    )

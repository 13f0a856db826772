"""Cases of depth: resolves at silhouettes, standard and reversed projection."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

import numpy as np

from msaa_lint.experiments.study.resolve import DEPTH_MODES, resolve_depth
from msaa_lint.experiments.study.scenes.scene import Scene

from . import silhouette
from .row import Row
from .silhouette import Sample


def depths() -> Iterator[Row]:
    near, far = 0.25, 0.75
    samples = np.array([[far], [near], [near], [far]], np.float32)
    found = {mode: float(resolve_depth(samples, mode)[0]) for mode in DEPTH_MODES}
    average_of = found["AVERAGE"]
    for mode, words, due in (
        ("MIN", "nearest", near),
        ("MAX", "farthest", far),
        ("SAMPLE_ZERO", "first sample's", far),
    ):
        words = f"depth of a silhouette, 0.25 in front of 0.75: {mode}, the {words}; naive: AVERAGE"
        yield Row("depth", words, due, average_of, (near + near + far + far) / 4, found[mode])
    # One millimeter apart at one kilometer, with the near plane at 0.1 m: depth is 1 - 0.1 / z,
    # reversed 0.1 / z.
    first, second = Fraction(1, 10) / 1000, Fraction(1, 10) / (1000 + Fraction(1, 1000))
    standard = [np.float32(float(1 - each)) for each in (first, second)]
    reverse = [np.float32(float(each)) for each in (first, second)]
    double = float(1 - first) < float(1 - second)
    words = (
        "1 mm apart at 1 km, is the nearer one drawn (1 yes)? naive: standard depth; ours: "
        "reversed depth"
    )
    yield Row(
        "depth",
        words,
        1,
        float(standard[0] < standard[1]),
        float(double),
        float(reverse[0] > reverse[1]),
    )
    for samples in (8, 16):
        yield from _outline(samples)


def _outline(samples: int) -> Iterator[Row]:
    """A disc 10 cm in front of a wall 1 km away, at the samples of every pixel that its outline
    crosses.
    """
    words = f"outline of a disc 10 cm in front of a wall at 1 km, {samples}x"
    reverse, standard = (
        silhouette.scene(reversed_depth, "MAX") for reversed_depth in (True, False)
    )
    edge = silhouette.edge_samples(standard, samples)
    disc = [(each.disc, each.wall) for each in edge if each.disc is not None]
    held = sum(one.stored < wall.stored for one, wall in disc)
    in_single = sum(one.by_plane < wall.by_plane for one, wall in disc)
    in_double = sum(float(one.exact) < float(wall.exact) for one, wall in disc)
    case = (
        f"{words}, reversed depth: samples that show it; naive: standard depth; float64: "
        "standard depth, not stored in D32_SFLOAT"
    )
    yield Row("depth", case, len(disc), held, in_double, _shown(reverse, edge, samples))
    case = (
        f"{words}, standard depth: samples of {len(disc)} for which D32_SFLOAT keeps it in "
        "front; naive: planes in float32"
    )
    yield Row("depth", case, held, in_single, in_double, _shown(standard, edge, samples))
    yield _resolved(f"{words}, reversed depth", reverse, samples)


def _shown(scene: Scene, edge: Sequence[Sample], samples: int) -> int:
    """The number of samples that show the disc, which is white, in the pixels of its outline."""
    image = silhouette.rendered(scene, samples).image
    return sum(round(float(image[pixel][0]) * samples) for pixel in {each.pixel for each in edge})


def _resolved(words: str, scene: Scene, samples: int) -> Row:
    """The pixels whose resolved depth is not that of the nearest sample, rounded once."""
    edge = silhouette.edge_samples(scene, samples)
    nearest = {each.pixel: 0.0 for each in edge}
    for each in edge:
        nearest[each.pixel] = max(nearest[each.pixel], (each.disc or each.wall).stored)
    wrong = []
    for mode in ("MIN", "AVERAGE", "MAX"):
        settings = {**scene.settings, "depth-resolve": mode}
        depth = silhouette.rendered(scene._replace(settings=settings), samples).depth
        assert depth is not None
        wrong.append(float(sum(float(depth[pixel]) != due for pixel, due in nearest.items())))
    case = (
        f"{words}: pixels of {len(nearest)} resolved to another depth than the nearest; naive: "
        "MIN; float64: AVERAGE; ours: MAX"
    )
    return Row("depth", case, 0, *wrong)

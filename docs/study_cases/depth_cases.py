"""Cases of depth: resolves at silhouettes, standard and reversed projection."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from msaa_lint.experiments.study.resolve import DEPTH_MODES, resolve_depth

from .row import Row


def depths() -> Iterator[Row]:
    near, far = 0.25, 0.75
    samples = np.array([[far], [near], [near], [far]], np.float32)
    found = {mode: float(resolve_depth(samples, mode)[0]) for mode in DEPTH_MODES}
    average_of = found["AVERAGE"]
    for mode, words, due in (("MIN", "nearest", near), ("MAX", "farthest", far), ("SAMPLE_ZERO", "first sample's", far)):
        words = f"depth of a silhouette, 0.25 in front of 0.75: {mode}, the {words}; naive: AVERAGE"
        yield Row("depth", words, due, average_of, (near + near + far + far) / 4, found[mode])
    # One millimeter apart at one kilometer, with the near plane at 0.1 m: depth is 1 - 0.1 / z, reversed 0.1 / z.
    first, second = Fraction(1, 10) / 1000, Fraction(1, 10) / (1000 + Fraction(1, 1000))
    standard = [np.float32(float(1 - each)) for each in (first, second)]
    reverse = [np.float32(float(each)) for each in (first, second)]
    double = float(1 - first) < float(1 - second)
    words = "1 mm apart at 1 km, is the nearer one drawn (1 yes)? naive: standard depth; ours: reversed depth"
    yield Row("depth", words, 1, float(standard[0] < standard[1]), float(double), float(reverse[0] > reverse[1]))

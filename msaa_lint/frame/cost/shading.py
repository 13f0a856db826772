"""How often a fragment shader runs: multisampling, sample shading, supersampling, and the share of
edges of small triangles.

A pixel shades a triangle once if the triangle covers any of its samples, so a triangle shades more
pixels than its area: those of the union of its copies, each moved by one sample.
"""

from __future__ import annotations

import math

from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import RENDER_PASS, Pass
from msaa_lint.frame.facts.subpass import samples_of

from .amounts import Shading
from .sizes import Area


def shaded_samples(minimum: float, samples: int) -> int:
    """Invocations per pixel that sample shading requires: max(ceil(minSampleShading *
    rasterizationSamples), 1).
    """
    return max(math.ceil(minimum * samples), 1)


def supersampling(samples: int) -> int:
    """Pixels of the smallest k x k grid with at least as many pixels as samples: 4 for 2 and 4, 9
    for 8, 16 for 16.
    """
    return (math.isqrt(samples - 1) + 1) ** 2


EDGES: dict[int, tuple[tuple[int, float], ...]] = {
    1: ((1, 1.0), (2, 1.0), (4, 1.0), (8, 1.0), (16, 1.0), (32, 1.0)),
    2: ((1, 2.0), (2, 1.75), (4, 1.4375), (8, 1.2344), (16, 1.1211), (32, 1.0615)),
    4: ((1, 3.3125), (2, 2.2031), (4, 1.6133), (8, 1.3096), (16, 1.1555), (32, 1.0779)),
    8: ((1, 4.1094), (2, 2.4648), (4, 1.71), (8, 1.3494), (16, 1.1733), (32, 1.0863)),
    16: ((1, 5.2617), (2, 2.9717), (4, 1.946), (8, 1.4631), (16, 1.229), (32, 1.1139)),
}
"""By sample count: fragment shader invocations per pixel of area of right triangles whose legs,
along the pixel grid, are 1 to 32 pixels.

Means over all positions, computed exactly by `tests/frame/cost/triangles.py` and rounded to four
places.
"""


def pass_shading(each: Pass, area: Area, frame: Frame) -> Shading | None:
    """The invocations of one layer of triangles over everything a pass renders to; None if the size
    or every sample count is unknown.

    The subpass with the most samples stands for a pass.
    """
    if area.width is None or not each.subpasses:
        return None
    counts = [samples_of(subpass) for subpass in each.subpasses]
    samples = max((count for count in counts if count is not None), default=None)
    if samples is None:
        return None
    pixels = area.layered
    least = _demanded(each, frame, samples)
    return Shading(
        pixels,
        samples,
        pixels / 1e6,
        pixels * samples / 1e6,
        pixels * supersampling(samples) / 1e6,
        None if least is None else pixels * least / 1e6,
        EDGES.get(samples, ()),
    )


def _demanded(each: Pass, frame: Frame, samples: int) -> int | None:
    """Invocations per pixel of the pass's pipeline that requires the most; None if no pipeline is
    stated, or one does not state it.
    """
    if each.kind != RENDER_PASS:
        return None
    demands = []
    for pipeline in frame.pipelines_by_pass.get(id(each), ()):
        state = pipeline.multisampleState
        if state is None or state.sampleShadingEnable is None:
            return None
        if state.sampleShadingEnable and state.minSampleShading is None:
            return None
        demands.append(
            shaded_samples(min(state.minSampleShading or 0.0, 1.0), samples)
            if state.sampleShadingEnable
            else 1
        )
    return max(demands, default=None)

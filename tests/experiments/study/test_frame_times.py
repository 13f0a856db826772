"""The times of frames: what a device counts of them, and the model that is fitted to those of a GPU
(frame_times.json beside this file).
"""

from __future__ import annotations

import json
import math
from typing import Any

import pytest

from msaa_lint.experiments.study.frame_plans import FramePlans
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, SSAA, Technique
from msaa_lint.experiments.study.scene_timing import drawn_by_frame
from msaa_lint.experiments.study.shading import NONE, Shading
from msaa_lint.experiments.study.time_model import MeasuredTime, Terms, fit
from msaa_lint.experiments.study.times import DeviceClock
from tests.experiments.confirm.frames import frame
from tests.paths import ROOT

PHONE = ROOT / "examples/phone/forward.msaa.yaml"
MEASURED: list[dict[str, Any]] = json.loads(
    (ROOT / "tests/experiments/study/frame_times.json").read_text()
)["frames"]
ONE, FOUR, EACH, LARGE = (
    Technique(MSAA, 1),
    Technique(MSAA, 4),
    Technique(SAMPLE_SHADING, 4, 1.0),
    Technique(SSAA, 9, grid=3),
)


def technique(kind: str, samples: int, shaded: int) -> Technique:
    if kind == SSAA:
        return Technique(SSAA, samples, grid=math.isqrt(samples))
    return Technique(kind, samples, shaded / samples if kind == SAMPLE_SHADING else 0.0)


@pytest.mark.parametrize("measured", MEASURED, ids=lambda each: each["file"])
def test_the_model_of_times_fits_those_of_a_gpu(measured: dict[str, Any]) -> None:
    rows = {technique(*row[:3]): row[3:] for row in measured["techniques"]}
    counts = {each: count for each, (_, _, count, _) in rows.items()}
    terms = {
        each: Terms(written, resolved, *drawn_by_frame(each, counts))
        for each, (written, resolved, _, _) in rows.items()
    }
    model = fit(
        measured["file"],
        [MeasuredTime(each, cost, ms) for each, row in rows.items() for cost, ms in row[3]],
        terms,
    )
    assert model is not None
    assert model.rms < 0.025 and model.residual < 0.05


def test_what_a_frame_draws_follows_from_the_invocations_of_its_techniques() -> None:
    counts = {ONE: 1_000_000, FOUR: 1_200_000, EACH: 4_100_000, LARGE: 9_000_000}
    assert drawn_by_frame(FOUR, counts) == (4.1, 1.2, 0.2, 0.0, 0.0)
    assert drawn_by_frame(EACH, counts) == pytest.approx((4.1, 1.2, 0.2, 2.9, 0.6))
    assert drawn_by_frame(LARGE, counts) == pytest.approx((9.0, 9.0, 0.6, 0.0, 0.0)), (
        "one sample for each pixel of a larger picture"
    )
    assert drawn_by_frame(FOUR, {FOUR: 1_200_000}) == (4.8, 1.2, 0.0, 0.0, 0.0), (
        "nothing is known of edges"
    )
    assert drawn_by_frame(FOUR, {FOUR: None}) == ()


def test_passes_are_counted_one_by_one() -> None:
    """What techniques do not apply to is drawn as often under each."""
    plans = FramePlans(frame(PHONE.read_text()), str(PHONE), (216, 480))
    with DeviceClock(repeats=1) as clock:
        items = clock.time(
            [(plans.of(each).plan, [Shading(NONE)]) for each in (ONE, FOUR, LARGE)]
        ).items
    passes = [item.invocations(plans.passes) for item in items]
    others = [item.invocations() - inside for item, inside in zip(items, passes, strict=True)]
    assert others[0] >= 2 * 216 * 480, "tone mapping, and the user interface"
    assert others == others[:1] * 3 and passes == sorted(set(passes))

"""Studies whose errors are zero, equal, tiny, infinite or NaN, and whose times are missing, zero or
equal: they are still reported.
"""

from __future__ import annotations

import json
import math
import re

import jsonschema
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.cli.report import Options
from msaa_lint.cli.report.html.study_slider import slider
from msaa_lint.cli.report.html.vega import PageFigures
from msaa_lint.cli.report.study_full import render as as_text
from msaa_lint.cli.report.study_json import render as as_json
from msaa_lint.cli.report.study_plot import plot
from msaa_lint.experiments.study.answer import conclude
from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.points import Point, Technique, techniques
from msaa_lint.experiments.study.shading import Shading
from msaa_lint.experiments.study.time_model import MeasuredTime, Terms, fit
from tests.experiments.study.fakes import timed
from tests.paths import ROOT
from tests.strength import examples

SCHEMA = json.loads((ROOT / "msaa_lint" / "cli" / "report" / "study_v1.schema.json").read_text())
ERRORS = st.sampled_from([0.0, 1e-300, 1e-9, 0.1, 0.2, 1.0, 1e6, math.inf, math.nan])
TIMES = st.sampled_from([None, 0.0, 1e-9, 1.0, 1.04, 2.0, 1e9])
NOISE = st.sampled_from([None, 0.0, 0.01, 0.5])
NAMES = ("none", "medium")


@st.composite
def points(draw: st.DrawFn, technique: Technique, name: str) -> Point:
    """A point of a technique under a cost of shading."""
    error, time, noise = draw(ERRORS), draw(TIMES), draw(NOISE)
    bounds = (
        (None, None) if time is None or noise is None else (time * (1 - noise), time * (1 + noise))
    )
    parts = {"fill_ms": time, "shading_ms": 0.0, "resolve_ms": 0.0} if time is not None else {}
    seen = {
        "flip": draw(st.sampled_from([None, 0.0, error])),
        "flicker": draw(st.sampled_from([None, 0.0, error])),
        "bias": draw(ERRORS),
    }
    return timed(
        technique, rmse=error, rmse_all=error, max_error=error, psnr_display_db=draw(ERRORS),
        shading=name, time_ms=time, ratio=None,
        low_ms=bounds[0], high_ms=bounds[1], **parts, **seen,
    )  # fmt: skip


@st.composite
def studies(draw: st.DrawFn) -> Study:
    """The answer to a study of one scene."""
    chosen = draw(
        st.lists(st.sampled_from(techniques()), min_size=1, max_size=7, unique=True).map(sorted)
    )
    made = [draw(points(technique, name)) for name in NAMES for technique in chosen]
    quantities = st.builds(Terms, *[st.sampled_from([0.0, 1e-6, 1.0, 2.0])] * len(Terms._fields))
    terms = {technique: draw(quantities) for technique in chosen}
    model = fit(
        "edges",
        [
            MeasuredTime(technique, cost, draw(TIMES) or 0.0, 0.01)
            for technique in chosen
            for cost in (0.0, 2e6)
        ],
        terms,
    )
    shadings = [
        Shading(
            name, nanoseconds=draw(st.sampled_from([None, 0.0, 1e6])), full_screen_ms=draw(TIMES)
        )
        for name in NAMES
    ]
    about = draw(
        st.sampled_from([(), ("hdr",), ("alpha",), ("texture",), ("thin lines",), ("edges",)])
    )
    return conclude(
        Study(
            "a device", "", (64, 48), 8, [SceneSummary("edges", "", ())._replace(about=about)],
            made, [], [], shadings=shadings,
            software=draw(st.booleans()), models=[] if model is None else [model],
            budget_ms=draw(st.sampled_from([1e-9, 0.5, 1e9])),
        )
    )  # fmt: skip


def printed(render: object, study: Study) -> str:
    out: list[str] = []
    render(study, out.append, Options(width=120))  # type: ignore[operator]
    return "".join(out)


@examples(1)
@given(studies())
def test_reports_have_figures_for_any_error_and_time(study: Study) -> None:
    jsonschema.validate(json.loads(printed(as_json, study), parse_constant=_refused), SCHEMA)
    text = printed(as_text, study)
    sentences = [
        line
        for line in text.splitlines()
        if re.match(r"^(advice|step|take|[0-9]+x to)", line.strip())
    ]
    assert not any(re.search(r"\b(nan|inf)\b", sentence) for sentence in sentences), sentences
    for choice in study.recommendations:
        assert choice.added.high_ms <= study.budget_ms


@examples(0.3)
@given(studies())
def test_figures_have_places_for_any_error_and_time(study: Study) -> None:
    json.dumps(plot(study), allow_nan=False)


@examples(0.3)
@given(studies())
def test_sliders_have_places_for_any_error_and_time(study: Study) -> None:
    figures = PageFigures()
    slider(study, study.scenes[0], figures)
    json.dumps(figures.data, allow_nan=False)


def _refused(constant: str) -> None:
    raise AssertionError(f"{constant} is not JSON")

"""What is printed of points that nobody simulated: byte for byte, safe to show, true to its
schema.
"""

from __future__ import annotations

import json
import math
import os
import re
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.cli.report import Options
from msaa_lint.cli.report.figure import draw
from msaa_lint.cli.report.study_crops import crops_figure
from msaa_lint.cli.report.study_full import render as as_text
from msaa_lint.cli.report.study_json import render as as_json
from msaa_lint.cli.report.study_panels import plotted
from msaa_lint.cli.report.study_plot import plot
from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.experiments.confirm.png import Picture, is_own_picture, png, signed
from msaa_lint.experiments.study.advice import Advice
from msaa_lint.experiments.study.answer import conclude
from msaa_lint.experiments.study.crops import crops, most_different, short_name, shown
from msaa_lint.experiments.study.measure import truth
from msaa_lint.experiments.study.outcome import SceneSummary, Study, UntimedTechnique
from msaa_lint.experiments.study.points import (
    MSAA,
    SAMPLE_SHADING,
    SSAA,
    Point,
    Technique,
    techniques,
)
from msaa_lint.experiments.study.scenes import scene
from msaa_lint.experiments.study.shading import Shading
from msaa_lint.experiments.study.simulate import simulate
from msaa_lint.experiments.study.tasks import FailedPoint
from tests.cli.report.drawn import Drawing, overlaps
from tests.experiments.study import fakes
from tests.experiments.study.fakes import TIMES, point, shaded, timed
from tests.paths import ROOT
from tests.strength import examples

GOLDEN = ROOT / "tests" / "golden" / "study"
SCHEMA = json.loads((ROOT / "msaa_lint" / "cli" / "report" / "study_v1.schema.json").read_text())
HOSTILE = "\x1b[31m\u202e##[error]\udcff[bold]\n"


def study(**other: Any) -> Study:
    """Two scenes, one of coverage and one of colour, timed by a device that has no 16 samples."""
    points = [timed(technique) for technique in techniques()]
    points += [
        timed(technique, "texture", rmse=0.3 / math.sqrt(technique.shaded), psnr_db=math.inf)
        for technique in techniques((MSAA,))
    ]
    missing = {"time_ms": None, "time_from": "", "ratio": None}
    points = [each._replace(**missing) if each.technique.samples == 16 else each for each in points]
    return conclude(
        Study(
            "a device",
            "Mali-G76",
            (64, 48),
            8,
            [
                SceneSummary(
                    "edges", "edges at all angles", (("depth-test", "a pipeline tests depth"),)
                ),
                SceneSummary("texture", "detail inside of triangles", (), coverage=False),
            ],
            points,
            [FailedPoint("texture", Technique(SAMPLE_SHADING, 4, 1.0), "ValueError: it broke")],
            [
                UntimedTechnique("16x", "the device does not have 16 samples"),
                UntimedTechnique("16x, each shaded", "the device does not have 16 samples"),
            ],
            wrong=[diagnostic("MSAA901", "the input is empty", "bad.msaa.yaml")],
            records=["frame.msaa.yaml.msaa-study.json"],
            pictures=["crops/edges-crops.png"],
        )._replace(**other)
    )


COSTS = (
    Shading("none", nanoseconds=0.0, full_screen_ms=0.0),
    Shading("medium", 312, 4, 16 << 20, 2e6, 4.17),
    Shading("heavy", 936, 12, 16 << 20, 8e6, 12.5),
)


def costly(**other: Any) -> Study:
    """One scene under three costs of shading, with all that can be measured."""
    of = [*techniques((MSAA,), (1, 2, 4, 8)), Technique(SAMPLE_SHADING, 4, 1.0)]
    measured = {
        "flip": 0.05,
        "invocations": 1234567,
        "expected_invocations": 1230000,
        "fill_ms": 0.5,
        "shading_ms": 0.3,
        "resolve_ms": 0.2,
    }
    points = [
        shaded(
            technique,
            cost.name,
            cost.nanoseconds or 0.0,
            flicker=0.1 / technique.samples,
            ratio=1.5,
            stages=(("depth-test", 25.0),),
            simulated_ms=100.0,
            **measured,
        )
        for cost in COSTS
        for technique in of
    ]
    base = {technique: TIMES[technique.samples] for technique in of}
    model = fakes.model(
        "edges", base, {technique: 3072.0 * technique.shaded for technique in of}, 0.031, 0.01
    )
    more = {
        "scenes": study().scenes[:1],
        "points": points,
        "failed": [],
        "shadings": COSTS,
        "models": [model],
        "budget_ms": 1.2,
    }
    return study(**{**more, **other})


def printed(render: Any, of: Study, *more: Any) -> str:
    pieces: list[str] = []
    render(of, pieces.append, *more)
    return "".join(pieces)


def check(name: str, text: str) -> None:
    path = GOLDEN / name
    if os.environ.get("UPDATE"):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text.encode())
    assert text == path.read_bytes().decode()


def test_json_byte_for_byte() -> None:
    text = printed(as_json, study(), Options(version="1.0"))
    check("study.json", text)
    jsonschema.Draft202012Validator(SCHEMA).validate(json.loads(text))


def test_text_byte_for_byte() -> None:
    check("study.txt", printed(as_text, study(), Options(width=160)))


def test_costs_of_shading_byte_for_byte() -> None:
    """Errors once, then times with a group of columns for each cost, in 100 columns."""
    text = printed(as_text, costly(), Options(width=100))
    check("shading.txt", text)
    assert widest(text) <= 100
    assert text.count("0.2887") == 1, "errors are the same under every cost"
    json_text = printed(as_json, costly(), Options(version="1.0"))
    check("shading.json", json_text)
    jsonschema.Draft202012Validator(SCHEMA).validate(json.loads(json_text))


def test_a_software_driver_s_times_are_labelled_and_advise_nothing() -> None:
    of = costly(software=True, device="llvmpipe")
    text = printed(as_text, of, Options(width=100))
    check("software.txt", text)
    assert "llvmpipe is a software driver: its times say nothing about a GPU" in text
    assert text.count("software") == 1 and text.index("software") < text.index("RMSE"), (
        "once, before any time"
    )
    assert all(word not in text for word in ("take ", "front", "worth its time at", "+0.3 ms"))
    data = json.loads(printed(as_json, of, Options()))
    assert data["software"] is True and {each["software"] for each in data["points"]} == {True}
    assert data["recommendations"] == [] and {each["added_ms"] for each in data["steps"]} == {None}


def widest(text: str) -> int:
    """The length of the longest line of the tables, which every row of a technique belongs to."""
    rows = re.compile(r"[*= ]*(?:samples|\d+x|SSAA)\b.*\d$|[*= ]*samples .*")
    return max(len(line) for line in text.splitlines() if rows.fullmatch(line))


@pytest.mark.parametrize("width", [50, 60, 70, 80, 90, 100, 120, 140, 200])
def test_tables_fit_their_width_with_each_cost_as_a_column(width: int) -> None:
    text = printed(as_text, costly(), Options(width=width))
    assert widest(text) <= width
    assert text.count("none") >= 2 and text.count("0.2887") == 1, (
        "errors are the same under every cost"
    )
    # Errors, times, and where these are too wide their parts, in tables of their own.
    tables = len(re.findall(r"(?m)^[*= ]*samples ", text))
    assert tables == 2 if width >= 80 else tables >= 2
    lost = {"RMSE all", "mW", "MiB", "bias", "PSNR dB linear"} if width == 80 else set()
    line = next(
        (line for line in text.splitlines() if line.startswith("left out at this width")), ""
    )
    assert lost <= set(line.partition(": ")[2].split(", ")) and bool(line) == (width < 120)


def test_one_scene_under_three_costs_is_about_a_screen() -> None:
    lines = printed(as_text, costly(), Options(width=80)).splitlines()
    of_scene = lines[
        : next(number for number, line in enumerate(lines) if line.startswith("64x48"))
    ]
    assert sum(-(-max(len(line), 1) // 80) for line in of_scene) <= 58
    names = [line for line in lines if line.startswith("take ")]
    assert (
        names == ["take 4x within 1.2 ms under every cost of shading"]
        and lines.index(names[0]) == 3
    )


def test_the_intervals_of_times_are_never_in_scientific_notation() -> None:
    points = [
        each._replace(low_ms=(each.time_ms or 0.0) - 1e-7, high_ms=(each.time_ms or 0.0) + 9e-6)
        for each in costly().points
    ]
    text = printed(as_text, costly(points=points), Options(width=200))
    assert "<0.01" in text and not re.search(r"\de[-+]\d", text)


def test_a_shader_of_one_s_own_is_its_file_s_name_and_what_it_takes() -> None:
    own = Shading("lit.frag", nanoseconds=1.5e6, full_screen_ms=3.21)
    points = [
        each._replace(shading="lit.frag") for each in costly().points if each.shading == "medium"
    ]
    text = printed(as_text, costly(shadings=[own], points=points), Options(width=80))
    assert "lit.frag: 3.21 ms a full screen at 1x" in text.splitlines()
    assert "shading lit.frag (3.21 ms a full screen at 1x): take 4x" in text.splitlines()
    assert " operation" not in text


def test_a_time_that_ties_with_the_next_shorter_one_is_marked() -> None:
    tied = [
        each._replace(time_ms=2.0, low_ms=1.9, high_ms=2.1)
        if each.technique.samples == 4 and each.shading == "none"
        else each
        for each in costly().points
    ]
    lines = [
        line
        for line in printed(as_text, costly(points=tied), Options(width=100)).splitlines()
        if "4x, each shaded" in line
    ]
    assert any(line.startswith("=") or " = " in line for line in lines)


def test_text_in_color() -> None:
    text = printed(
        as_text,
        study(points=[each for each in study().points if each.scene == "edges"]),
        Options(width=160, color=True),
    )
    lines = [line for line in text.splitlines() if "8x" in line and "3.8" in line]
    assert lines[0].startswith("\x1b[32m*")


def test_what_is_no_number_or_infinite_is_null() -> None:
    odd = point(Technique(MSAA, 4), rmse=math.nan, psnr_db=math.inf, bias=-0.0, max_error=math.inf)
    text = printed(as_json, study(points=[odd]), Options())
    (found,) = json.loads(text)["points"]
    assert (found["rmse"], found["psnr_db"], found["max_error"], found["time_ms"]) == (
        None,
        None,
        None,
        None,
    )
    assert math.copysign(1, found["bias"]) == 1
    shown = printed(as_text, study(points=[odd]), Options(width=160))
    assert "exact" in shown
    below = printed(as_text, study(points=[odd._replace(bias=-0.00004)]), Options(width=160))
    assert "+0.0000" in below and "-0.0000" not in below


def test_without_a_device_no_time_is_shown_as_one() -> None:
    points = [point(technique, simulated_ms=12345.6) for technique in techniques()]
    of = study(device="", model="", points=points, untimed=[])
    text = printed(as_text, of, Options(width=160))
    assert "to 1x" not in text and "12345" not in text and "12346" not in text
    assert "no times: --device NAME measures them" in text
    data = printed(as_json, of, Options())
    assert "12345" not in data
    assert {each["time_ms"] for each in json.loads(data)["points"]} == {None}


def test_optional_columns_come_with_their_figures() -> None:
    bare = [point(technique) for technique in techniques((MSAA,))]
    text = printed(as_text, study(points=bare), Options(width=160))
    assert "SSIM" not in text and "mW" not in text
    text = printed(
        as_text,
        study(points=[each._replace(ssim=0.98765, milliwatts=12.0) for each in bare]),
        Options(width=160),
    )
    assert "SSIM" in text and "0.9877" in text and "mW" in text


def hostile() -> Study:
    points = [
        each._replace(scene=HOSTILE, time_from=HOSTILE, shading=HOSTILE, fill_ms=1.0)
        for each in study().points
    ]
    return study(
        device=HOSTILE,
        model=HOSTILE,
        scenes=[SceneSummary(HOSTILE, HOSTILE, (("depth-test", HOSTILE),))],
        points=points,
        failed=[FailedPoint(HOSTILE, Technique(MSAA, 4), HOSTILE)],
        untimed=[UntimedTechnique("16x", HOSTILE)],
        shadings=[Shading(HOSTILE, 1, 1, 1, 1.0, 1.0)],
        models=[fakes.model(HOSTILE, {}, {}, 0.1, 0.1)],
        wrong=[diagnostic("MSAA901", HOSTILE, HOSTILE)],
        records=[HOSTILE],
        pictures=[HOSTILE],
    )


def test_hostile_texts_are_safe_to_show() -> None:
    of = hostile()
    text = printed(
        as_text, of._replace(advice=[Advice(HOSTILE, HOSTILE, HOSTILE)]), Options(width=200)
    )
    assert (
        "\x1b" not in text and "\u202e" not in text and "##[" not in text and "\udcff" not in text
    )
    assert "\\x1b[31m" in text and "[bold]" in text, "shown as it is, not taken for markup"
    data = printed(as_json, of, Options())
    assert data.isascii()
    jsonschema.Draft202012Validator(SCHEMA).validate(json.loads(data))


def test_nothing_studied_is_still_a_report() -> None:
    empty = study(scenes=[], points=[], failed=[], untimed=[])
    jsonschema.Draft202012Validator(SCHEMA).validate(json.loads(printed(as_json, empty, Options())))
    assert printed(as_text, empty, Options()).endswith("0 points of 0 scenes\n")
    assert draw(plot(empty), "png").startswith(b"\x89PNG")


ODD = st.floats() | st.sampled_from([0.0, 1.0, 1.0, math.inf, math.nan])
FIGURES = ("rmse", "rmse_all", "max_error", "bias", "psnr_db", "psnr_display_db", "time_ms",
"bytes_per_frame", "low_ms", "high_ms", "flip",
           "flicker")  # fmt: skip


@examples(0.5)
@given(
    st.lists(st.lists(ODD, min_size=len(FIGURES), max_size=len(FIGURES)), min_size=1, max_size=5),
    st.sampled_from(["edges", "hdr"]),
)
def test_any_figures_can_be_printed(rows: list[list[float]], about: str) -> None:
    points = [
        timed(technique, **dict(zip(FIGURES, figures, strict=True)))
        for technique, figures in zip(techniques(), rows, strict=False)
    ]
    for budget in (0.5, 1e9):
        of = study(
            points=points, scenes=[SceneSummary("edges", "", (), about=(about,))], budget_ms=budget
        )
        json.loads(printed(as_json, of, Options()))
        text = printed(as_text, of, Options(width=160))
        assert all(one.technique.name in text for one in points)


def test_hostile_names_are_plotted_as_text() -> None:
    text = draw(plot(hostile()), "svg").decode()
    assert "\x1b" not in text and "\u202e" not in text


def test_a_plot_shows_what_has_a_place() -> None:
    text = draw(plot(study()), "svg").decode()
    for name in (
        "1x",
        "4x",
        "8x/8",
        "SSAA 2x2",
        "edges",
        "texture",
        "added time, ms",
        "RMSE of coverage",
        "RMSE of linear color",
    ):
        assert f">{name}</text>" in text, name
    assert ">16x</text>" not in text, "it was not timed"
    bare = draw(
        plot(study(device="", points=[point(technique) for technique in techniques()])), "svg"
    ).decode()
    assert ">16x</text>" in bare and "no times measured" in bare and "time, ms" not in bare


def test_an_error_of_zero_has_a_place_too() -> None:
    points = [timed(technique, rmse=0.0) for technique in techniques((MSAA,))]
    assert draw(plot(study(points=points)), "png").startswith(b"\x89PNG")
    scene = SceneSummary("edges", "", ())
    assert (
        plotted(scene, [points[0]._replace(rmse=math.nan), points[1]._replace(time_ms=None)]) == []
    )


def picture(pixels: list[list[int]]) -> Any:
    return np.repeat(np.array(pixels, dtype=np.uint8)[:, :, None], 3, axis=2)


def test_linear_light_is_displayed_as_srgb() -> None:
    linear = np.array(
        [[[0.0, 0.5, 1.0, 0.3], [2.0, -1.0, math.nan, 1.0], [0.0031308, 0.21404, math.inf, 0.0]]]
    )
    assert shown(scene("edge-fan", 32, 32), linear).tolist() == [
        [[0, 188, 255], [255, 0, 0], [10, 127, 255]]
    ]


@given(st.integers(1, 40), st.integers(1, 40), st.data())
def test_a_crop_is_where_pictures_differ_most(width: int, height: int, data: st.DataObject) -> None:
    one = np.zeros((height, width, 3), dtype=np.uint8)
    other = one.copy()
    x, y = data.draw(st.integers(0, width - 1)), data.draw(st.integers(0, height - 1))
    other[y, x] = 200
    amount, left, top = most_different(one, other)
    assert amount == 600
    assert left <= x < left + 16 and top <= y < top + 16
    assert 0 <= left <= max(width - 16, 0) and 0 <= top <= max(height - 16, 0)
    assert most_different(one, one) == (0, 0, 0)


def test_crops_have_their_names_above_them_and_begin_with_the_exact_picture() -> None:
    whole = scene("edge-fan", 96, 64)
    found = crops(whole, techniques())
    drawing = Drawing(draw(crops_figure("edge-fan", found), "svg"))
    wanted = sorted(["exact"] * 4 + [short_name(technique) for technique, _ in found.pictures])
    names = [text for text in drawing.texts if text.text in wanted]
    assert sorted(text.text for text in names) == wanted
    images = drawing.marks_of("image")
    assert len(images) == len(names)
    for text, image in zip(names, images, strict=True):
        assert text.box.left == image.box.left and 0 < image.box.top - text.box.bottom < 6
    boxes = [text.box for text in drawing.texts]
    assert not list(overlaps(boxes, [image.box for image in images])) and not list(overlaps(boxes))
    assert {text.box.left for text in names if text.text == "exact"} == {
        min(text.box.left for text in names)
    }


@pytest.mark.parametrize(
    "name", ["edge-fan", "zone-plate", "foliage-to-coverage", "intersecting", "hdr-emitter"]
)
def test_crops_are_parts_of_the_pictures_where_the_first_technique_differs_most(name: str) -> None:
    whole = scene(name, 96, 160)
    chosen = [
        Technique(MSAA, 1),
        Technique(MSAA, 4),
        Technique(SAMPLE_SHADING, 4, 1.0),
        Technique(SSAA, 9, grid=3),
    ]
    found = crops(whole, chosen)
    exact = shown(whole, truth(whole).image)
    rendered = [shown(whole, simulate(whole, technique).image) for technique in chosen]
    x, y = found.corner
    assert (x, y) == most_different(rendered[0], exact)[1:]
    for crop, picture in zip(
        [found.exact, *(crop for _, crop in found.pictures)], [exact, *rendered], strict=True
    ):
        codes = np.frombuffer(crop.rgb, dtype=np.uint8).reshape(16, 16, 3)
        np.testing.assert_allclose(
            codes.astype(int), picture[y : y + 16, x : x + 16], rtol=0, atol=1
        )


def test_a_signed_picture_is_the_same_picture(tmp_path: Path) -> None:
    data = png(Picture(2, 1, b"\x01" * 6))
    plain = data.replace(signed(data)[33:64], b"")
    assert signed(plain).count(b"msaa-lint") == 1 and signed(plain).startswith(plain[:33])
    (tmp_path / "a.png").write_bytes(signed(plain))
    assert is_own_picture(str(tmp_path / "a.png"))
    (tmp_path / "b.png").write_bytes(plain)
    assert not is_own_picture(str(tmp_path / "b.png"))


@pytest.mark.parametrize("technique", techniques(), ids=lambda technique: technique.name)
def test_short_names_are_short(technique: Technique) -> None:
    assert len(short_name(technique)) <= 8


def test_points_are_told_by_scene() -> None:
    of = study()
    points: list[Point] = of.of("texture")
    assert {each.scene for each in points} == {"texture"} and len(points) == 5

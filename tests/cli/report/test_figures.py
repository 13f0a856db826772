"""Figures of studies: what they show, and by geometry that no text meets a mark, another text, or a
border, at any size.
"""

from __future__ import annotations

import json
import math
from functools import cache
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import Phase, example, given
from hypothesis import strategies as st

from msaa_lint.cli.report.figure import FONT_SIZE, draw, wrapped
from msaa_lint.cli.report.labels import Box, around, place_labels, width_of
from msaa_lint.cli.report.scales import LINEAR, LOG, SYMLOG, Scale, from_zero, linear_or_log
from msaa_lint.cli.report.study_plot import plot
from msaa_lint.experiments.study.crops import short_name
from msaa_lint.experiments.study.measures import FLICKER
from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.pareto import mark_best
from msaa_lint.experiments.study.points import MSAA, SSAA, Point, Technique, techniques
from msaa_lint.experiments.study.shading import Shading
from tests.cli.report import drawn
from tests.cli.report.drawn import Drawing, overlaps
from tests.experiments.study.fakes import point
from tests.strength import examples

COSTS = {"none": 0.0, "medium": 4.17, "heavy": 12.5}


def shaded_point(technique: Technique, scene: str, cost: str) -> Point:
    """A point whose time is that of its bytes, its invocations, and its resolve."""
    fill = 0.18 * technique.samples
    shading = COSTS[cost] * (
        technique.shaded if technique.kind != MSAA else 1 + 0.08 * (technique.samples - 1)
    )
    resolve = 0.06 * technique.samples if technique.samples > 1 else 0.0
    time = fill + shading + resolve
    error = (
        0.2887 / technique.grid**1.1 if technique.kind == SSAA else 0.2887 / technique.samples**0.75
    )
    return point(
        technique, scene, rmse=error, shading=cost, time_ms=time, low_ms=0.985 * time,
        high_ms=1.02 * time, fill_ms=fill,
        shading_ms=shading, resolve_ms=resolve,
    )  # fmt: skip


def shaded_study(*scenes: str, **other: Any) -> Study:
    """A study of all techniques under three costs of shading."""
    points = [
        each
        for scene in scenes
        for cost in COSTS
        for each in mark_best([shaded_point(technique, scene, cost) for technique in techniques()])
    ]
    shadings = [Shading(name, full_screen_ms=cost) for name, cost in COSTS.items()]
    named = [SceneSummary(scene, "", ()) for scene in scenes]
    return Study(
        "a device", "", (1920, 1080), 8, named, points, (), (), (), shadings=shadings
    )._replace(**other)


@cache
def drawing_of(*scenes: str) -> Drawing:
    """A study's figures."""
    return Drawing(draw(plot(shaded_study(*scenes)), "svg"))


def check_geometry(drawing: Drawing) -> None:
    """Fails if a text is cut off, or meets another text, a mark, or the border of a panel."""
    boxes = [text.box for text in drawing.texts]
    whole = Box(0, 0, drawing.width, drawing.height)
    assert all(
        whole.left <= box.left
        and whole.top <= box.top
        and box.right <= whole.right
        and box.bottom <= whole.bottom
        for box in boxes
    )
    assert not list(overlaps(boxes))
    assert not list(overlaps(boxes, [mark.box for mark in drawing.marks_of("symbol")]))
    lines = [
        line
        for kind in ("rule", "line")
        for mark in drawing.marks_of(kind)
        for line in pairwise(mark.corners)
    ]
    assert not [
        (name, line) for name in drawing.names for line in lines if name.box.crossed_by(line)
    ]
    for name in drawing.names:
        borders = [panel for panel in drawing.panels if panel.meets(name.box)]
        assert all(inside(name.box, panel) for panel in borders)


def inside(box: Box, panel: Box) -> bool:
    return (
        panel.left < box.left
        and panel.top < box.top
        and box.right < panel.right
        and box.bottom < panel.bottom
    )


def names_only(study: Study) -> Study:
    """The study without the parts of its times, whose bars have texts beside their panels."""
    return study._replace(points=[each._replace(fill_ms=None) for each in study.points])


@pytest.mark.parametrize("scenes", [("edges",), ("edges", "wires")])
def test_every_technique_has_its_name_beside_it(scenes: tuple[str, ...]) -> None:
    drawing = Drawing(draw(plot(names_only(shaded_study(*scenes))), "svg"))
    check_geometry(drawing)
    assert sorted(name.text for name in drawing.names) == sorted(
        3 * len(scenes) * [short_name(technique) for technique in techniques()]
    )
    lines = [mark.box for kind in ("rule", "line") for mark in drawing.marks_of(kind)]
    assert len(lines) > 50


CORNERS = st.tuples(st.floats(0, 1), st.floats(0, 1))
NAMES = st.sampled_from([short_name(technique) for technique in techniques()])


@examples(0.5)
@given(
    st.lists(st.tuples(st.one_of(CORNERS, st.just((0.5, 0.5))), NAMES), max_size=24),
    st.sampled_from([(90.0, 60.0), (200.0, 170.0), (420.0, 240.0), (900.0, 600.0)]),
    st.lists(st.tuples(CORNERS, CORNERS), max_size=8),
)
def test_labels_keep_clear_of_everything(
    points: list[Any], size: tuple[float, float], rects: list[Any]
) -> None:
    places = [(x * size[0], y * size[1]) for (x, y), _ in points]
    names = [name for _, name in points]
    marks = [around(place, 4.5) for place in places]
    lines = [
        Box(min(a, c) * size[0], b * size[1] - 1, max(a, c) * size[0], b * size[1] + 1)
        for (a, b), (c, _) in rects
    ]
    labels = place_labels(places, names, marks, lines, size, reach=1000)
    shown = [
        (label, mark, name)
        for label, mark, name in zip(labels, marks, names, strict=True)
        if label is not None
    ]
    boxes = [label.box for label, _, _ in shown]
    assert not list(overlaps(boxes))
    assert not list(overlaps(boxes, [*marks, *lines]))
    assert all(inside(box, Box(0, 0, *size)) for box in boxes)
    assert all(
        box.right - box.left == pytest.approx(width_of(name))
        for box, (_, _, name) in zip(boxes, shown, strict=True)
    )
    for number, (label, mark, _) in enumerate(shown):
        if label.leader is not None:
            assert not any(
                box.crossed_by(label.leader) for other, box in enumerate(boxes) if other != number
            )
            assert mark.meets(around(label.leader[0], 0.5))
    if size[0] >= 900:
        assert len(shown) == len(points), "there is room for all"


def test_names_are_no_wider_than_the_boxes_that_they_are_placed_by() -> None:
    for technique in techniques():
        name = short_name(technique)
        for weight in ("normal", "bold"):
            assert drawn.width_of(name, weight) * FONT_SIZE <= width_of(name)


def test_many_points_at_one_place_have_names_all_the_same() -> None:
    points = [point(technique, time_ms=1.0, rmse=0.1) for technique in techniques()]
    study = Study("a device", "", (64, 48), 8, [SceneSummary("edges", "", ())], points, (), (), ())
    drawing = Drawing(draw(plot(study), "svg"))
    check_geometry(drawing)
    assert len(drawing.names) == len(points)


# A smaller example of figures that meet takes minutes to find, and shows no more.
@examples(0.25, phases=[Phase.explicit, Phase.reuse, Phase.generate])
@given(
    st.lists(st.tuples(st.floats(1e-3, 1e3), st.floats(1e-6, 1)), min_size=17, max_size=17),
    st.integers(1, 3),
)
def test_no_label_of_a_drawn_study_meets_anything(
    figures: list[tuple[float, float]], costs: int
) -> None:
    points = []
    for number in range(costs):
        of_cost = [
            point(
                technique,
                shading=f"cost {number}",
                time_ms=time,
                low_ms=0.9 * time,
                high_ms=1.2 * time,
                rmse=error,
            )
            for technique, (time, error) in zip(techniques(), figures, strict=True)
        ]
        points += mark_best(of_cost)
    study = Study("a device", "", (64, 48), 8, [SceneSummary("edges", "", ())], points, (), (), ())
    drawing = Drawing(draw(plot(study), "svg"))
    check_geometry(drawing)
    assert (
        len(drawing.marks_of("symbol")) == costs * 17
        and len(drawing.marks_of("rule")) >= costs * 17
    )


def values(kind: str) -> st.SearchStrategy[list[float]]:
    sizes = (
        st.floats(1e-6, 1e6)
        if kind == LOG
        else st.one_of(st.floats(1e-6, 1e6), st.sampled_from([5e-324, 1e-310, 1e-200]))
    )
    return st.lists(
        sizes if kind == LOG else st.one_of(st.just(0.0), sizes, sizes.map(lambda value: -value)),
        min_size=1,
        max_size=8,
    )


@given(values(SYMLOG), values(LOG))
@example([5e-324], [1.0])
@example([0.0, 1e-310], [1e-6, 1e6])
def test_scales_have_a_place_for_every_value_and_ticks_apart(
    any_sign: list[float], positive: list[float]
) -> None:
    for scale, shown in (
        (from_zero(any_sign), any_sign),
        (linear_or_log(positive, 3), positive),
        (linear_or_log(any_sign, 3), any_sign),
    ):
        assert all(0 < scale.share(value) < 1 for value in shown)
        for value in shown:
            assert scale.value(scale.share(value)) == pytest.approx(
                value, rel=1e-6, abs=1e-6 * (scale.high - scale.low)
            )
        ticks = scale.axis(300, upright=False).get("values", [])
        places = [scale.share(tick) * 300 for tick in ticks]
        widths = [0.6 * FONT_SIZE * len(f"{tick:g}") for tick in ticks]
        assert all(
            b - a > (w + v) / 2
            for a, b, w, v in zip(places, places[1:], widths, widths[1:], strict=False)
        ), ticks
        assert scale.kind == LINEAR or all(scale.low <= tick <= scale.high for tick in ticks)


@pytest.mark.parametrize(
    "scale", [Scale(LINEAR, 1, 9), Scale(LOG, 0.01, 3), Scale(SYMLOG, -1, 100, 0.5)]
)
def test_vega_puts_values_where_the_labels_are_placed(scale: Scale) -> None:
    import altair

    shown = [scale.value(share) for share in (0.1, 0.35, 0.8)]
    chart = altair.Chart(altair.Data(values=[{"v": value} for value in shown])).mark_point()
    spec = (
        chart.encode(altair.X("v:Q", scale=altair.Scale(**scale.spec())))
        .properties(width=200, height=20)
        .to_dict()
    )
    drawing = Drawing(draw(spec, "svg"))
    found = [
        (mark.box.left + mark.box.right) / 2 - drawing.panels[0].left
        for mark in drawing.marks_of("symbol")
    ]
    assert found == pytest.approx([200 * scale.share(value) for value in shown], abs=0.51)


def test_panels_are_of_the_costs_of_shading() -> None:
    words = drawing_of("edges", "wires").words()
    assert (
        words.count("edges") == words.count("wires") == 6
        and words.count("shading: medium, 4.17 ms a full screen") == 4
    )
    assert words.count("1x takes 4.35 ms") == 4 and words.count("added time, ms") == 12
    assert "Error against added time: a device, 1920x1080" in words
    assert "What each technique adds to the time of one sample, by part" in words


def test_bars_are_what_a_technique_adds_by_part() -> None:
    spec = plot(shaded_study("edges"))
    layers = spec["vconcat"][1]["concat"][1]["layer"]
    bars, totals = (spec["datasets"][layer["data"]["name"]] for layer in layers)
    added = {bar["part"]: bar["added"] for bar in bars if bar["technique"] == "4x"}
    assert added == pytest.approx({"fill": 0.54, "shading": 1.0008, "resolve": 0.24})
    (total,) = (row for row in totals if row["technique"] == "4x")
    assert total["end"] == pytest.approx(1.7808) and total["text"] == "+1.78 ms (+41 %)"
    check = Drawing(draw(spec, "svg"))
    assert "+1.78 ms (+41 %)" in check.words()
    boxes = [text.box for text in check.texts]
    assert not list(overlaps(boxes)) and max(box.right for box in boxes) <= check.width


def test_parts_that_nobody_knows_have_no_bars() -> None:
    assert len(plot(names_only(shaded_study("edges")))["vconcat"]) == 1


def test_a_place_is_the_time_that_is_added_with_its_interval() -> None:
    spec = plot(shaded_study("edges"))
    (four,) = (row for row in points_of(spec, 1) if row["technique"] == "4x")
    assert (four["x"], four["low"], four["high"]) == pytest.approx(
        (1.7808, 0.985 * 6.1308 - 4.35, 1.02 * 6.1308 - 4.35)
    )
    assert (four["time"], four["error"]) == pytest.approx((6.1308, 0.2887 / 4**0.75))


def test_without_one_sample_times_are_not_differences() -> None:
    study = shaded_study("edges")
    bare = study._replace(
        points=[each for each in study.points if each.technique != Technique(MSAA, 1)]
    )
    words = Drawing(draw(plot(bare), "svg")).words()
    assert (
        "time, ms" in words
        and "added time, ms" not in words
        and not any("1x takes" in word for word in words)
    )


def test_times_of_a_software_driver_are_labelled_as_such() -> None:
    drawing = Drawing(draw(plot(shaded_study("edges", software=True)), "svg"))
    assert "Error against added time on a software driver: a device, 1920x1080" in drawing.words()
    assert drawing.words().count("times of a software driver: they say nothing about a GPU") == 2, (
        "above each figure"
    )
    assert not drawing.marks_of("line"), "there is no front of times that say nothing"
    assert drawing_of("edges").marks_of("line") and not any(
        "software" in word for word in drawing_of("edges").words()
    )


def points_of(spec: Any, panel: int) -> list[dict[str, Any]]:
    """What is drawn of the points of a panel."""
    layers = spec["vconcat"][0]["concat"][panel]["layer"]
    (rows,) = (
        spec["datasets"][layer["data"]["name"]]
        for layer in layers
        if layer["mark"]["type"] == "point"
    )
    return list(rows)


def test_the_error_is_the_one_that_the_scene_is_about() -> None:
    study = shaded_study("edges")
    points = [each._replace(flicker=2 * each.rmse) for each in study.points]
    spec = plot(study._replace(points=points, scenes=[study.scenes[0]._replace(measure=FLICKER)]))
    assert {row["technique"]: row["y"] for row in points_of(spec, 0)}["1x"] == pytest.approx(
        2 * 0.2887
    )
    assert "flicker" in Drawing(draw(spec, "svg")).words()


def test_marks_are_pale_beyond_the_noise_of_the_front() -> None:
    rows = {row["technique"]: row["opacity"] for row in points_of(plot(shaded_study("edges")), 0)}
    same_time = {"4x", "4x, half of them shaded", "4x, each shaded"}
    assert {rows[name] for name in same_time} == {1.0}, (
        "shading costs nothing, so that they take the same time"
    )
    rows = {row["technique"]: row["opacity"] for row in points_of(plot(shaded_study("edges")), 2)}
    assert rows["4x"] == 1.0 and rows["4x, half of them shaded"] < 1 and rows["4x, each shaded"] < 1


def test_the_front_is_a_line_from_its_fastest_point_on() -> None:
    spec = plot(shaded_study("edges"))
    panel = spec["vconcat"][0]["concat"][2]
    (line,) = (layer for layer in panel["layer"] if layer["mark"]["type"] == "line")
    corners = spec["datasets"][line["data"]["name"]]
    best = {
        (row["x"], row["y"])
        for row in points_of(spec, 2)
        if row["technique"] in ("1x", "2x", "4x", "8x", "16x")
    }
    assert {(corner["x"], corner["y"]) for corner in corners} == best
    assert [corner["x"] for corner in corners] == sorted(corner["x"] for corner in corners)
    assert line["mark"]["interpolate"] == "step-after"


def test_a_scene_without_one_of_the_costs_keeps_the_columns() -> None:
    study = shaded_study("edges", "wires")
    holes = study._replace(
        points=[each for each in study.points if (each.scene, each.shading) != ("edges", "medium")]
    )
    drawing = Drawing(draw(plot(names_only(holes)), "svg"))
    lefts = sorted({round(mark.left) for mark in drawing.panels if mark.right - mark.left == 200})
    assert len(lefts) == 3


@pytest.mark.parametrize("format", ["svg", "png", "json"])
def test_the_same_study_gives_the_same_bytes(format: str) -> None:
    assert draw(plot(shaded_study("edges")), format) == draw(plot(shaded_study("edges")), format)


def test_a_specification_has_its_data_and_no_address() -> None:
    spec = json.loads(draw(plot(shaded_study("edges")), "json"))
    assert spec["$schema"].startswith("https://vega.github.io/schema/vega-lite/v6")
    assert '"url"' not in json.dumps(spec) and spec["datasets"]
    svg = draw(plot(shaded_study("edges")), "svg").decode()
    addresses = {part.split('"')[0] for part in svg.split("http")[1:]}
    assert addresses == {"://www.w3.org/2000/svg", "://www.w3.org/1999/xlink"}


@pytest.mark.parametrize(
    "name", ["n" * 5000, "<script>alert(1)</script>", "日本語", "a: b {{c}} ' + datum.x", "1e400"]
)
def test_names_of_any_length_and_content_are_text(name: str) -> None:
    drawing = Drawing(draw(plot(shaded_study(name)), "svg"))
    shown = [
        text
        for text in drawing.texts
        if text.text == name or (len(name) > 100 and text.text.startswith("nnn"))
    ]
    # A long name begins, is left out, and ends.
    assert len(shown) == (6 if len(name) < 100 else 18)
    assert all(text.box.right <= drawing.width for text in drawing.texts)


LONG = (
    "examples/some/very/long/path/to/a/frame_of_an_engine/with-many-passes/FORWARD+MSAA.msaa.yaml"
)


@pytest.mark.parametrize("costs", [1, 2, 3])
@pytest.mark.parametrize(
    "name", [LONG, "W" * 90 + "_THE END", "many short words in a sentence " * 5 + "and the end"]
)
def test_the_end_of_a_long_name_is_shown(name: str, costs: int) -> None:
    study = shaded_study(name)
    cost = "a/shader/with_a_long_name.frag"
    names = [*COSTS][:costs]
    points = [
        each._replace(shading=cost if each.shading == "none" else each.shading)
        for each in study.points
        if each.shading in names
    ]
    study = study._replace(
        points=points,
        device="a device with a name that is longer than any other one, of a vendor, and a driver "
        "1.2.3",
    )
    drawing = Drawing(draw(plot(study), "svg"))
    titles = [text for text in drawing.texts if "role-title" in text.kind]
    assert not [
        text.text
        for text in titles
        if text.text.endswith("…") and not name.startswith(text.text[:-1])
    ], "nothing is cut off"
    words = "".join(text.text for text in titles).replace(" ", "")
    assert (
        words.count(name.replace(" ", "")[-7:]) == 2 * costs
        and "driver1.2.3" in words
        and "with_a_long_name.frag" in words
    )
    assert not list(overlaps([text.box for text in titles]))
    assert all(text.box.right <= drawing.width for text in titles)


@given(st.text(st.characters(min_codepoint=32, max_codepoint=126), max_size=120), st.floats(6, 60))
def test_lines_are_the_text_and_fit(text: str, width: float) -> None:
    lines = wrapped(text, width)
    assert len(lines) <= 3
    if not any(line.endswith("…") for line in lines):
        assert "".join(lines).replace(" ", "") == text.replace(" ", "")


@pytest.mark.parametrize("weight", ["normal", "bold"])
def test_letters_are_no_wider_than_the_lines_that_they_are_broken_by(weight: str) -> None:
    words = [
        LONG,
        "shading: medium, 4.15 ms a full screen",
        "NVIDIA H100 80GB HBM3, 1920x1080",
        "llvmpipe (LLVM 15.0.6, 256 bits)",
    ]
    for text in words:
        for line in wrapped(text, 20 / (1.12 if weight == "bold" else 1)):
            assert drawn.width_of(line, weight) <= 20


def test_names_that_cannot_be_seen_are_escaped() -> None:
    name = "\x00\ufffe\ud800\u202e\n"
    words = Drawing(draw(plot(shaded_study(name)), "svg")).words()
    assert words.count("\\x00\\ufffe\\ud800\\u202e") == 6
    assert draw(plot(shaded_study(name)), "json").isascii()


@pytest.mark.parametrize(("count", "columns"), [(1, 1), (2, 2), (3, 3), (4, 2), (5, 3)])
def test_scenes_without_costs_of_shading_are_in_a_grid(count: int, columns: int) -> None:
    points = [
        point(technique, f"scene {number}")
        for number in range(count)
        for technique in techniques((MSAA,))
    ]
    scenes = [SceneSummary(f"scene {number}", "", ()) for number in range(count)]
    spec = plot(Study("", "", (64, 48), 8, scenes, points, (), ()))
    assert spec["vconcat"][0]["columns"] == columns and len(spec["vconcat"][0]["concat"]) == count


def test_times_without_a_number_have_no_place() -> None:
    points = [shaded_point(technique, "edges", "none") for technique in techniques((MSAA,))]
    points[1:3] = [points[1]._replace(time_ms=math.nan), points[2]._replace(rmse=math.inf)]
    study = shaded_study("edges", points=points)
    assert {name.text for name in Drawing(draw(plot(names_only(study)), "svg")).names} == {
        "1x",
        "8x",
        "16x",
    }

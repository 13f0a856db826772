"""The chart: what it draws, the same bytes each time, and nothing of a name that is markup."""

from __future__ import annotations

import itertools
import re
import subprocess
import sys
from xml.etree import ElementTree

import pytest

from msaa_lint.cli.report.cost_chart import COLORS, Bar, bars, chart, compared_bars
from msaa_lint.cli.report.figure import draw
from msaa_lint.cli.report.study_parts import PARTS
from msaa_lint.frame.cost.amounts import FrameCost, Terms
from msaa_lint.frame.cost.input_cost import CostedFrame, compare_inputs
from msaa_lint.frame.cost.variants import variants
from msaa_lint.frame.facts.global_facts import profile
from tests.cli.report.drawn import Drawing, overlaps
from tests.frame.cost.frames import EXAMPLES, cost, document, example

SEPARATE = (EXAMPLES / "khronos-msaa/color-separate.msaa.yaml").read_text(encoding="utf-8")


def costed(text: str = SEPARATE) -> CostedFrame:
    found = document(text)
    listed = variants(found, profile(found.description), Terms())
    fixed = example("khronos-msaa/inline.msaa.yaml")
    return CostedFrame("frame.yaml", 0, 1, cost(text), listed, fixed, fixed, listed)


def svg(
    bars: list[Bar], of: FrameCost, heading: str = "frame.yaml", subheading: str = "Mali-G76"
) -> bytes:
    return draw(chart(bars, heading, subheading, of), "svg")


def test_bars_are_as_written_fixed_and_every_count_in_both_places() -> None:
    found = bars(costed())
    assert [bar.name for bar in found] == [
        "as written", "with --fix", *(f"{name}, same fixes" for name in (
            "1x", "2x, inline (not supported)", "2x, separate (not supported)", "4x, inline",
            "4x, separate", "8x, inline", "8x, separate",
        )),
    ]  # fmt: skip
    assert (found[0].read, found[0].write) == pytest.approx((2247.7824, 2809.728))
    assert found[5].read + found[5].write == pytest.approx(561.9456)


def test_what_resolves_nothing_has_a_bar_for_each_count() -> None:
    found = bars(costed((EXAMPLES / "shader-resolve/note.msaa.yaml").read_text(encoding="utf-8")))
    assert [bar.name for bar in found if bar.group] == [
        f"{count}x, same fixes" for count in (1, 2, 4, 8)
    ]


def test_two_frames_stand_above_the_variants_of_the_new_one() -> None:
    old, new = CostedFrame("a", 0, 1, example("khronos-msaa/inline.msaa.yaml")), costed()
    names = [bar.name for bar in compared_bars(compare_inputs("a", [old], "b", [new]))]
    assert names[:4] == ["old, as written", "new, as written", "new, with --fix", "1x, same fixes"]


def test_the_two_colours_differ_in_lightness_too() -> None:
    """Whoever sees no hue tells them apart all the same (WCAG's relative luminance)."""

    def luminance(color: str) -> float:
        parts = [int(color[n : n + 2], 16) / 255 for n in (1, 3, 5)]
        linear = [
            part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts
        ]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    for colors in (COLORS, PARTS):
        lightness = sorted(luminance(color) + 0.05 for color in colors.values())
        assert all(b / a > 1.5 for a, b in itertools.pairwise(lightness))


def test_svg_has_names_and_units_as_text() -> None:
    found = costed()
    shown = Drawing(svg(bars(found), found.cost)).words()
    assert {
        "as written",
        "with --fix",
        "4x, separate, same fixes",
        "read",
        "write",
        "5058 MB/s, 506 mW (20.2 %)",
    } <= set(shown)
    assert "traffic with external memory, MB/s (share of 2500 mW in parentheses)" in shown


def test_bars_are_as_long_as_their_traffic_and_apart_from_other_groups() -> None:
    found = costed()
    listed = bars(found)
    marks = [mark.box for mark in Drawing(svg(listed, found.cost)).marks_of("rect")]
    reads, writes = list(marks[::2]), marks[1::2]
    scale = 420 / max(bar.read + bar.write for bar in listed)
    assert [box.right - box.left for box in reads] == pytest.approx(
        [scale * bar.read for bar in listed], abs=0.01
    )
    assert [box.right - box.left for box in writes] == pytest.approx(
        [scale * bar.write for bar in listed], abs=0.01
    )
    assert [box.left for box in writes] == pytest.approx([box.right for box in reads], abs=0.01)
    gaps = [below.top - above.bottom for above, below in itertools.pairwise(reads)]
    assert [gap > 2 * min(gaps) for gap in gaps] == [
        one.group != other.group for one, other in itertools.pairwise(listed)
    ]


@pytest.mark.parametrize("format", ["svg", "png", "json"])
def test_the_same_frame_gives_the_same_bytes(format: str) -> None:
    found = costed()
    once, again = (draw(chart(bars(found), "t", "s", found.cost), format) for _ in range(2))
    assert once == again and not re.search(rb"\d{4}-\d\d-\d\dT", once)


NAMES = [
    "</text><script>alert(1)</script>",
    "$x$",
    "&amp; <b>",
    "日本語",
    '" onload="x',
    "]]>",
    "'] + alert(1) + ['",
    "{{x}}",
    "\\u0041",
]


@pytest.mark.parametrize("name", NAMES)
def test_a_name_is_text_and_nothing_else(name: str) -> None:
    found = costed()
    data = svg([Bar(name, "", 1, 1, 1)], found.cost, name, name)
    assert Drawing(data).words().count(name) == 3
    assert not list(ElementTree.fromstring(data).iter("{http://www.w3.org/2000/svg}script"))
    assert draw(chart([Bar(name, "", 1, 1, 1)], name, name, found.cost), "png").startswith(
        b"\x89PNG\r\n"
    )


def test_a_frame_that_moves_nothing_is_drawn() -> None:
    words = Drawing(svg([Bar("as written", "", 0, 0, 0)], cost("images: {}"))).words()
    assert words.count("0 MB/s, 0 mW (0.0 %)") == 1
    assert "0" in words and Drawing(svg([], cost("images: {}"))).words()


@pytest.mark.parametrize("listed", [
    bars(costed()),
    [Bar(f"bar {number}", str(number // 3), number, 2.0 * number, number) for number in range(200)],
    [Bar("same name", "", 1, 2, 3), Bar("same name", "", 4e9, 5e9, 6e9), Bar("n" * 300, "", 1e-3,
    0, 0)],
])  # fmt: skip
def test_no_text_is_cut_off_or_meets_another(listed: list[Bar]) -> None:
    drawing = Drawing(svg(listed, costed().cost, "t" * 1000, "s" * 1000))
    boxes = [text.box for text in drawing.texts]
    assert len([word for word in drawing.words() if "MB/s, " in word and "mW (" in word]) == len(
        listed
    )
    assert not list(overlaps(boxes))
    assert not list(overlaps(boxes, [mark.box for mark in drawing.marks_of("rect")]))
    assert min(box.left for box in boxes) >= 0 and max(box.right for box in boxes) <= drawing.width
    assert min(box.top for box in boxes) >= 0 and max(box.bottom for box in boxes) <= drawing.height


def test_nothing_loads_a_library_before_a_chart_is_drawn() -> None:
    modules = (
        "msaa_lint.cli.report.cost_chart, msaa_lint.cli.report.study_plot, "
        "msaa_lint.cli.report.study_crops, msaa_lint.cli.cost"
    )
    code = f"import sys, {modules}; print({{'altair', 'vl_convert', 'numpy'}} & set(sys.modules))"
    assert (
        subprocess.run(
            [sys.executable, "-c", code], capture_output=True, text=True, check=True
        ).stdout
        == "set()\n"
    )

"""The chart: what it draws, the same bytes each time, and nothing of a name that is markup."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from msaa_lint.cli.report.cost_chart import READ_COLOR, WRITE_COLOR, Bar, bars, compared_bars, draw
from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.input_cost import CostedFrame, compare_inputs
from msaa_lint.frame.cost.variants import variants
from msaa_lint.frame.facts.global_facts import profile
from tests.frame.cost.frames import EXAMPLES, cost, document, example

SEPARATE = (EXAMPLES / "khronos-msaa/color-separate.msaa.yaml").read_text(encoding="utf-8")
SVG = "{http://www.w3.org/2000/svg}"


def costed(text: str = SEPARATE) -> CostedFrame:
    found = document(text)
    listed = variants(found, profile(found.description), Terms())
    fixed = example("khronos-msaa/inline.msaa.yaml")
    return CostedFrame("frame.yaml", 0, 1, cost(text), listed, fixed, fixed, listed)


def texts(svg: bytes) -> list[str]:
    return ["".join(each.itertext()) for each in ElementTree.fromstring(svg).iter(f"{SVG}text")]


def test_bars_are_as_written_fixed_and_every_count_in_both_places() -> None:
    found = bars(costed())
    assert [bar.name for bar in found] == [
        "as written", "with --fix", *(f"{name}, same fixes" for name in (
            "1x", "2x, inline (not supported)", "2x, separate (not supported)", "4x, inline", "4x, separate", "8x, inline", "8x, separate",
        )),
    ]  # fmt: skip
    assert (found[0].read, found[0].write) == pytest.approx((2247.7824, 2809.728))
    assert found[5].read + found[5].write == pytest.approx(561.9456)


def test_what_resolves_nothing_has_a_bar_for_each_count() -> None:
    found = bars(costed((EXAMPLES / "shader-resolve/note.msaa.yaml").read_text(encoding="utf-8")))
    assert [bar.name for bar in found if bar.group] == [f"{count}x, same fixes" for count in (1, 2, 4, 8)]


def test_two_frames_stand_above_the_variants_of_the_new_one() -> None:
    old, new = CostedFrame("a", 0, 1, example("khronos-msaa/inline.msaa.yaml")), costed()
    names = [bar.name for bar in compared_bars(compare_inputs("a", [old], "b", [new]))]
    assert names[:4] == ["old, as written", "new, as written", "new, with --fix", "1x, same fixes"]


def test_the_two_colours_differ_in_lightness_too() -> None:
    """Whoever sees no hue tells them apart all the same (WCAG's relative luminance)."""

    def luminance(color: str) -> float:
        parts = [int(color[n : n + 2], 16) / 255 for n in (1, 3, 5)]
        linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    assert (luminance(READ_COLOR) + 0.05) / (luminance(WRITE_COLOR) + 0.05) > 1.5


def test_svg_has_names_and_units_as_text() -> None:
    pytest.importorskip("matplotlib")
    found = costed()
    shown = texts(draw(bars(found), "frame.yaml", "Mali-G76", found.cost, "svg"))
    assert {"as written", "with --fix", "4x, separate, same fixes", "read", "write", "5058 MB/s, 506 mW (20.2 %)"} <= set(shown)
    assert "traffic with external memory, MB/s (share of 2500 mW in parentheses)" in shown


def test_the_same_frame_gives_the_same_svg_whatever_is_configured(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    found = costed()
    once = draw(bars(found), "t", "s", found.cost, "svg")
    assert once == draw(bars(found), "t", "s", found.cost, "svg")
    assert not re.search(rb"dc:date|\d{4}-\d\d-\d\dT", once)
    assert b"matplotlib.org/" not in once.split(b"<metadata>")[1].split(b"</metadata>")[0]
    import matplotlib

    with matplotlib.rc_context({"font.size": 30, "axes.facecolor": "red", "svg.hashsalt": "x"}):
        assert draw(bars(found), "t", "s", found.cost, "svg") == once
        assert matplotlib.rcParams["font.size"] == 30


@pytest.mark.parametrize("name", ["</text><script>alert(1)</script>", "$\\frac{1}{$", "$x$", "&amp; <b>", "日本語", '" onload="x', "]]>"])
def test_a_name_is_text_and_nothing_else(name: str) -> None:
    pytest.importorskip("matplotlib")
    found = costed()
    svg = draw([Bar(name, "", 1, 1, 1)], name, name, found.cost, "svg")
    assert texts(svg).count(name) == 3
    root = ElementTree.fromstring(svg)
    assert not list(root.iter(f"{SVG}script"))
    assert draw([Bar(name, "", 1, 1, 1)], name, name, found.cost, "png").startswith(b"\x89PNG\r\n")


def test_a_frame_that_moves_nothing_is_drawn() -> None:
    pytest.importorskip("matplotlib")
    empty = cost("images: {}")
    assert texts(draw([Bar("as written", "", 0, 0, 0)], "t", "s", empty, "svg")).count("0 MB/s, 0 mW (0.0 %)") == 1


def test_nothing_loads_matplotlib_before_a_chart_is_drawn() -> None:
    code = "import sys, msaa_lint.cli.report.cost_chart, msaa_lint.cli.cost; print('matplotlib' in sys.modules, 'numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "False False\n"

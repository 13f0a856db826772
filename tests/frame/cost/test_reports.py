"""The outputs of `msaa-lint cost`: the tables byte for byte, the JSON by its schema, and no text of
an input that acts on its reader.
"""

from __future__ import annotations

import functools
import io
import itertools
import json
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from markdown_it import MarkdownIt

import msaa_lint.cli.report
from msaa_lint.cli.report import Options, cost_full, cost_json, cost_markdown
from msaa_lint.cli.report.cost_rows import figure
from msaa_lint.cli.report.markdown import MAX_COMMENT
from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Result
from msaa_lint.core.text.span import Span
from msaa_lint.frame.cost.amounts import (
    Amount,
    FrameCost,
    ImageMemory,
    Line,
    PassCost,
    Shading,
    Terms,
)
from msaa_lint.frame.cost.input_cost import CostComparison, CostedFrame, compare_inputs
from msaa_lint.frame.cost.variants import Variant, variants
from msaa_lint.frame.devices.tiles import TileUse
from msaa_lint.frame.facts.global_facts import profile
from tests.cli.report.hostile import texts
from tests.frame.cost.frames import EXAMPLES, cost, document
from tests.paths import ROOT

GOLDEN = ROOT / "tests" / "golden" / "cost"
NOTHING = Result([], [], [], [], {}, [])
PARSER = MarkdownIt("commonmark").enable(["table", "strikethrough"])


@functools.cache
def validator() -> jsonschema.Draft202012Validator:
    schema = json.loads(
        Path(msaa_lint.cli.report.__file__)
        .with_name("cost_v1.schema.json")
        .read_text(encoding="utf-8")
    )
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def costed(name: str, file: str | None = None) -> CostedFrame:
    text = (EXAMPLES / name).read_text(encoding="utf-8")
    found = document(text)
    listed = variants(found, profile(found.description), Terms())
    return CostedFrame(file or f"examples/{name}", 0, 1, cost(text), listed)


INLINE, SEPARATE = "khronos-msaa/inline.msaa.yaml", "khronos-msaa/color-separate.msaa.yaml"


def pair() -> CostComparison:
    old, new = costed(INLINE, "old.yaml"), costed(SEPARATE, "new.yaml")
    return compare_inputs(old.file, [old], new.file, [new])


def printed(
    render: Callable[..., None], costs: Any, errors: Result | None = None, **options: Any
) -> str:
    out = io.StringIO()
    render(costs, errors or NOTHING, out.write, Options(**{"width": 0, **options}))
    return out.getvalue()


def golden(name: str, text: str) -> None:
    path = GOLDEN / name
    if os.environ.get("UPDATE"):
        path.write_bytes(text.encode())
    assert text == path.read_bytes().decode()


def test_table() -> None:
    golden("full.txt", printed(cost_full.render, [costed(SEPARATE)]))


def test_table_in_color_on_a_narrow_terminal() -> None:
    golden(
        "full-color-narrow.txt", printed(cost_full.render, [costed(SEPARATE)], color=True, width=70)
    )


def test_tables_of_several_frames_end_with_their_totals() -> None:
    text = printed(cost_full.render, [costed(INLINE), costed(SEPARATE)])
    assert text.split("\n\n")[-1].splitlines()[1].split()[:3] == [
        f"examples/{INLINE}",
        "1123.89",
        "1685.84",
    ]


def test_comparison() -> None:
    golden("comparison.txt", printed(cost_full.render_comparison, pair()))


def test_markdown() -> None:
    golden("markdown.md", printed(cost_markdown.render, [costed(SEPARATE)], NOTHING))


def test_markdown_of_a_comparison() -> None:
    golden("comparison.md", printed(cost_markdown.render_comparison, pair()))


def test_a_table_has_an_end() -> None:
    frame = costed(SEPARATE)
    many = tuple(
        frame.cost.passes[0]._replace(name=f"pass {number}", lines=()) for number in range(1200)
    )
    text = printed(cost_full.render, [frame._replace(cost=frame.cost._replace(passes=many))])
    assert "\nand 200 more rows (--output json has all)\ntotal " in text
    assert "pass 999 " in text and "pass 1000 " not in text


def test_color_changes_nothing_but_color() -> None:
    for width in (0, 60, 100):
        plain, colored = (
            printed(cost_full.render, [costed(SEPARATE)], width=width, color=color)
            for color in (False, True)
        )
        unpainted = re.sub("\x1b\\[[0-9;]*m", "", colored)
        assert [line.rstrip() for line in unpainted.split("\n")] == plain.split("\n")


def test_a_terminal_loses_no_figure() -> None:
    """However narrow it is, every number of the wide table stands in the narrow one, whole."""
    wide = re.findall(r"\d+\.\d+", printed(cost_full.render, [costed(SEPARATE)]))
    for width in (40, 70, 80, 100):
        text = printed(cost_full.render, [costed(SEPARATE)], width=width)
        assert re.findall(r"\d+\.\d+", text) == wide
        assert "…" not in text


def test_what_is_not_counted_whole_is_said_to_be_more() -> None:
    text = (
        "renderPasses: {main: {attachments: [{format: R8_UNORM, samples: 4, storeOp: STORE}], "
        "subpasses: [{colorAttachments: [0]}]}}"
    )
    table = printed(cost_full.render, [CostedFrame("a.yaml", 0, 1, cost(text))])
    assert "≥ 0.00" in table
    assert "assumed: 60 frames a second" in table
    assert (
        "unknown: `main`: its size is not stated: write `frame: {width: ..., height: ...}`" in table
    )
    assert "≥" not in printed(cost_full.render, [costed(SEPARATE)])


@pytest.mark.parametrize(
    ("value", "digits", "sign", "text"),
    [
        (0, 2, False, "0.00"),
        (-0.001, 2, True, "0.00"),
        (0.001, 2, True, "0.00"),
        (1.005, 1, True, "+1.0"),
        (-2247.7824, 2, True, "-2247.78"),
        (999999999.4, 1, False, "999999999"),
        (1e12, 2, False, "1e+12"),
        (-1.5e300, 2, True, "-1.5e+300"),
    ],
)
def test_figures(value: float, digits: int, sign: bool, text: str) -> None:
    assert figure(value, digits, sign) == text


# Frames one by one: streams of several are in the tests of the command.
ONE_EACH = [
    path
    for path in sorted(EXAMPLES.rglob("*.msaa.yaml"))
    if "\n---\n" not in path.read_text(encoding="utf-8")
]


@pytest.mark.parametrize("path", ONE_EACH, ids=lambda path: path.name)
def test_json_of_an_example_keeps_its_schema_and_the_contract(path: Path) -> None:
    found = costed(str(path.relative_to(EXAMPLES)))
    report = json.loads(printed(cost_json.render, [found], NOTHING))
    validator().validate(report)
    assert next(iter(report)) == "schema"
    for each in [*report["passes"], report["total"]]:
        for amount in [each] + ([each["corrected"]] if each["corrected"] else []):
            assert {"read_mb_per_s", "write_mb_per_s", "memory_mib", "milliwatts"} <= amount.keys()
    assert [each["name"] for each in report["passes"]] == [each.name for each in found.cost.passes]
    for name in ("read_mb_per_s", "write_mb_per_s", "milliwatts"):
        assert sum(each[name] for each in report["passes"]) == pytest.approx(
            report["total"][name], abs=1e-4
        )
    assert {
        key: value
        for key, value in report.items()
        if key in report["frames"][0] and key != "passes"
    } == {key: value for key, value in report["frames"][0].items() if key != "passes"}


def test_json_lines_add_up_to_their_pass() -> None:
    report = json.loads(printed(cost_json.render, [costed(SEPARATE)], NOTHING))
    for each in report["passes"]:
        assert sum(line["mb_per_s"] for line in each["lines"]) == pytest.approx(
            each["read_mb_per_s"] + each["write_mb_per_s"]
        )
        corrected = each["corrected"]
        assert sum(line["corrected_mb_per_s"] for line in each["lines"]) == pytest.approx(
            corrected["read_mb_per_s"] + corrected["write_mb_per_s"], abs=1e-4
        )


def test_json_of_a_comparison() -> None:
    report = json.loads(printed(cost_json.render_comparison, pair(), NOTHING))
    validator().validate(report)
    for name, value in report["difference"]["total"].items():
        if name not in ("corrected", "percent"):
            assert value == pytest.approx(
                report["new"]["total"][name] - report["old"]["total"][name], abs=1e-5
            )


def hostile_frame(words: list[str], value: float) -> CostedFrame:
    """A frame that has one of everything, with the words wherever an input's text may stand, and
    one figure everywhere.
    """
    word = itertools.cycle(words)
    amount = Amount(value, value, value, value)
    lines = tuple(
        Line(
            next(word),
            next(word),
            "color",
            4,
            "resolve command",
            direction,
            2**40,
            value,
            Span(0, 1),
        )
        for direction in ("read", "write")
    )
    shading = Shading(9, 4, value, value, value, value / 2, ((4, 1.5),))
    passes = tuple(
        PassCost(
            next(word), next(word), kind, 2, 3, None, lines, amount, amount, shading, TileUse(4, 4,
            8, True), (next(word),)
        )
        for kind in ("renderPass", "rendering", "command")
    )  # fmt: skip
    images = (ImageMemory(next(word), 2**40, 0, True), ImageMemory(next(word), None, None))
    cost = FrameCost(passes, images, amount, amount, 60, next(word), (next(word),), (next(word),))
    return CostedFrame(next(word) or "x", 0, 1, cost, [Variant(8, "inline", cost, False)], cost)


words = st.lists(texts, min_size=1, max_size=3)
values = st.sampled_from([0.0, 0.004, 12.5, 1e9, 1e300])
frames = st.builds(hostile_frame, words, values)
hostile = settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.too_slow])


def harmless(text: str) -> None:
    for line in text.split("\n"):
        assert line.isprintable(), line
        assert not re.search(r"##\w*\[", line), line
        assert not line.lstrip().startswith("::"), line


def one_structure(text: str) -> None:
    """Of Markdown: nothing but the headings, tables and lists that the report makes."""
    for token in PARSER.parse(text):
        if token.type == "html_block":
            assert token.content.strip() == cost_markdown.HEAD.strip()
        assert token.type not in ("code_block", "fence", "blockquote_open", "ordered_list_open"), (
            token
        )
        for inner in token.children or ():
            assert inner.type in (
                "text",
                "text_special",
                "strong_open",
                "strong_close",
                "softbreak",
            ), inner
            assert not re.search(r"@\w|#\d|https?://|www\.", inner.content), inner


@hostile
@given(st.lists(frames, min_size=1, max_size=2), st.integers(0, 120))
def test_no_name_acts_on_its_reader(found: list[CostedFrame], width: int) -> None:
    wrong = Result([diagnostic("MSAA901", found[0].file, found[0].file)], [], [], [], {}, [])
    for color in (False, True):
        harmless(
            re.sub(
                "\x1b\\[[0-9;]*m", "", printed(cost_full.render, found, width=width, color=color)
            )
        )
    markdown = printed(cost_markdown.render, found, wrong)
    harmless(markdown)
    one_structure(markdown)
    report = printed(cost_json.render, found, wrong)
    assert report.isascii()
    validator().validate(json.loads(report))


@hostile
@given(frames, frames)
def test_no_name_acts_on_who_compares(old: CostedFrame, new: CostedFrame) -> None:
    found = compare_inputs(old.file, [old], new.file, [new])
    harmless(printed(cost_full.render_comparison, found))
    markdown = printed(cost_markdown.render_comparison, found)
    harmless(markdown)
    one_structure(markdown)
    validator().validate(json.loads(printed(cost_json.render_comparison, found, NOTHING)))


def test_no_line_of_a_comment_begins_with_the_name_of_a_device() -> None:
    frame = costed(SEPARATE)
    frame = frame._replace(cost=frame.cost._replace(device="::stop-commands::x"))
    harmless(printed(cost_markdown.render, [frame], NOTHING))


def test_markup_of_rich_is_text() -> None:
    frame = costed(SEPARATE)
    named = frame.cost.passes[0]._replace(
        name="[bold red]x[/] :smile: [link=http://evil.example]y[/link]"
    )
    frame = frame._replace(cost=frame.cost._replace(passes=(named,)))
    assert "[bold red]x[/] :smile: [link=http://evil.example]y[/link]" in printed(
        cost_full.render, [frame]
    )


def test_a_comment_has_an_end() -> None:
    """What GitHub would refuse is cut at a whole line, and said."""
    frame = costed(SEPARATE)
    many = tuple(frame.cost.passes[0]._replace(name=f"pass {number}") for number in range(3000))
    text = printed(
        cost_markdown.render, [frame._replace(cost=frame.cost._replace(passes=many))], NOTHING
    )
    assert len(text) < MAX_COMMENT
    assert re.search(r"\n\n\d+ more lines and tables do not fit into this comment\.\n$", text)

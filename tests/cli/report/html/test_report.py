"""What the pages contain: the policy, the layout of graphs, waterfalls that add up, and limits."""

from __future__ import annotations

import base64
import hashlib
import re
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path

import pytest

from msaa_lint.cli import common
from msaa_lint.cli.report.html import check, diff, graph, waterfall
from msaa_lint.cli.report.html.page import json_element
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.graph import Flow, FrameGraph, GraphImage, GraphPass
from msaa_lint.frame.cost.input_cost import CostedFrame
from msaa_lint.linter.cost_run import run_costs
from msaa_lint.linter.request import Request
from tests.cli.report.sample import finding, printed, result
from tests.command import run
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"


class Page(HTMLParser):
    """The elements of a page, and the texts of its scripts and styles."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.texts: dict[str, list[str]] = {"script": [], "style": [], "data": []}
        self._into: list[str] | None = None
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag in ("script", "style"):
            self._into = self.texts[
                "data" if dict(attrs).get("type") == "application/json" else tag
            ]
            self._into.append("")

    def handle_endtag(self, tag: str) -> None:
        self._into = None

    def handle_data(self, data: str) -> None:
        if self._into is not None:
            self._into[-1] += data


def page(command: str, *arguments: str) -> str:
    return run(EXAMPLES, command, "--isolated", *arguments, "--output", "html").stdout


def hashes(texts: list[str]) -> str:
    return " ".join(
        f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"
        for text in texts
    )


COMPARISON = ("cost", "phone/frame.msaa.yaml", "khronos-msaa/inline.msaa.yaml")


@pytest.mark.parametrize("inputs", [("check", "phone"), ("cost", "phone"), COMPARISON])
def test_a_page_is_one_file_under_a_strict_policy(inputs: tuple[str, ...]) -> None:
    text = page(*inputs)
    found = Page(text)
    policy = next(
        each["content"]
        for tag, each in found.elements
        if each.get("http-equiv") == "Content-Security-Policy"
    )
    assert policy == (
        f"default-src 'none'; script-src {hashes(found.texts['script'])}; style-src "
        f"{hashes(found.texts['style'])}; "
        "img-src data:; base-uri 'none'; form-action 'none'"
    )
    for tag, attributes in found.elements:
        assert not {"style", "src", "onload", "onclick", "srcset"} & attributes.keys(), (
            tag,
            attributes,
        )
        assert tag not in ("link", "iframe", "object", "embed", "img")
        assert tag == "a" or "href" not in attributes
    ids = [each["id"] for _, each in found.elements if "id" in each]
    assert len(ids) == len(set(ids))
    links = [each["href"] or "" for tag, each in found.elements if tag == "a"]
    assert {link[1:] for link in links if link.startswith("#")} <= set(ids)
    assert page(*inputs) == text


def test_json_of_a_script_element_ends_no_element() -> None:
    text = json_element({"</script>": ["<!--", "&\u2028\u2029"]})
    assert text == '{"\\u003c/script\\u003e":["\\u003c!--","\\u0026\\u2028\\u2029"]}'


def test_a_rule_links_to_the_documentation(tmp_path: Path) -> None:
    (tmp_path / "msaa-lint.toml").write_text('docs-url = "https://example.com/msaa"\n')
    frame = EXAMPLES / "phone" / "frame.msaa.yaml"
    linked = run(
        tmp_path, "check", str(frame), "--config", "msaa-lint.toml", "--output", "html"
    ).stdout
    assert 'href="https://example.com/msaa/rules/resolve-outside-pass/"' in linked
    assert "example.com" not in page("check", "phone/frame.msaa.yaml")


def test_without_the_extra_a_message_names_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(common, "find_spec", lambda name: None)
    for command in ("check", "cost"):
        done = run(tmp_path, command, str(EXAMPLES / "phone"), "--output", "html=report.html")
        assert done.returncode == 2
        assert "--output html needs the extra `html`: run `" in done.stderr
        assert not (tmp_path / "report.html").exists()


def costed(*paths: str, terms: Terms | None = None) -> list[CostedFrame]:
    request = Request(
        paths=[str(EXAMPLES / path) for path in paths], isolated=True, formats=["html"]
    )
    return list(run_costs(request, terms or Terms(), (1, 4)).frames)


@pytest.mark.parametrize(
    "terms", [Terms(), Terms(fps=24.0, width=640, height=360)], ids=["as stated", "other terms"]
)
def test_a_waterfall_adds_up(terms: Terms) -> None:
    checked = 0
    for frame in costed("phone", "khronos-msaa", "tutorial", "frame", "impeller", terms=terms):
        bars = waterfall.of_frame(frame)
        if frame.fixed is None:
            assert [bar.name for bar in bars] in ([], ["as written", "with 1x"])
            continue
        names = [bar.name for bar in bars]
        end = names.index("as fixed")
        assert float(bars[0].traffic) == pytest.approx(frame.cost.total.traffic_mb_per_s, abs=0.01)
        assert float(bars[end].traffic) == pytest.approx(
            frame.fixed.total.traffic_mb_per_s, abs=0.01
        )
        for column in ("traffic", "milliwatts", "memory"):
            values = [float(getattr(bar, column)) for bar in bars[: end + 1]]
            assert sum(values[:-1]) == pytest.approx(values[-1], abs=0.06 * len(values)), (
                frame.file,
                column,
            )
        assert all(bar.start >= 0 and bar.start + bar.length <= 100.001 for bar in bars)
        checked += 1
    assert checked > 8


def test_fixes_that_save_the_same_bytes_count_once() -> None:
    """In the phone's frame, an image that is not transient and its store have the same price."""
    bars = waterfall.of_frame(costed("phone/frame.msaa.yaml")[0])
    assert [(bar.name, bar.traffic) for bar in bars] == [
        ("as written", "18429.12"),
        ("resolve-outside-pass", "-9953.28"),
        ("multisampled-image-not-transient", "-2488.32"),
        ("as fixed", "5987.52"),
        ("with 1x", "5987.52"),
    ]


def test_the_graph_of_a_frame() -> None:
    found = costed("khronos-msaa/color-separate.msaa.yaml")[0].graph
    assert found is not None
    assert [
        (row.name, row.image, row.samples, row.action, row.path, row.megabytes)
        for row in graph.flow_rows(found)
    ] == [
        ("scene", "depth_ms", "4x", "drawn to", "stays on the tile", ""),
        ("scene", "color_ms", "4x", "store", "through memory", "37.46"),
        (
            "resolveImage color_ms, backbuffer",
            "color_ms",
            "4x",
            "resolve command",
            "through memory",
            "37.46",
        ),
        (
            "resolveImage color_ms, backbuffer",
            "backbuffer",
            "1x",
            "resolve command",
            "through memory",
            "9.37",
        ),
    ]


def chain(passes: int) -> FrameGraph:
    """Each pass reads the image of the one before it."""
    images = [GraphImage(f"image{n}", "R8G8B8A8_UNORM", 4, 100) for n in range(passes)]
    flows = [
        [
            *([Flow(n - 1, "read", "read", 4, 1000)] if n else []),
            Flow(n, "store", "write", 4, 10 ** (n % 9)),
        ]
        for n in range(passes)
    ]
    return FrameGraph(
        tuple(
            GraphPass(f"pass{n}", f"renderPasses.pass{n}", "renderPass", 1, tuple(flows[n]))
            for n in range(passes)
        ),
        tuple(images),
    )


def test_boxes_do_not_overlap_and_columns_are_shared() -> None:
    drawing = graph.drawing(chain(40), 60)
    assert drawing.left_out == ""
    boxes = [*drawing.passes, *drawing.images]
    for number, one in enumerate(boxes):
        assert (
            one.x >= 0
            and one.x + one.width <= drawing.width
            and one.y + one.height <= drawing.height
        )
        for other in boxes[:number]:
            apart = one.x >= other.x + other.width or other.x >= one.x + one.width
            assert apart or one.y >= other.y + other.height or other.y >= one.y + one.height
    assert len({box.x for box in drawing.images}) == 2
    assert all(one.y < other.y for one, other in pairwise(drawing.passes))


def test_a_long_frame_is_cut_and_says_so() -> None:
    drawing = graph.drawing(chain(200), 60)
    assert len(drawing.passes) == graph.MAX_PASSES
    assert drawing.left_out == "The graph shows the first 60 of 200 passes."
    wide = GraphPass(
        "wide", "p", "renderPass", 1, tuple(Flow(n, "store", "write", 1, 1) for n in range(300))
    )
    drawing = graph.drawing(
        FrameGraph((wide,), tuple(GraphImage(f"{n}", None, None, None) for n in range(300))), 60
    )
    assert drawing.left_out == "The graph shows 16 of their 300 reads and writes."


def test_a_frame_without_passes_has_no_graph(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(
        "images: {a: {format: R8G8B8A8_UNORM, samples: 4, extent: {width: 8, height: 8}}}\n"
    )
    (tmp_path / "b.msaa.yaml").write_text("images: {}\n")
    for arguments in (
        ["check", "a.msaa.yaml"],
        ["cost", "a.msaa.yaml"],
        ["cost", "a.msaa.yaml", "b.msaa.yaml"],
    ):
        done = run(tmp_path, *arguments, "--isolated", "--output", "html")
        assert "</html>" in done.stdout, done.stderr
        assert '<figure class="graph">' not in done.stdout


def test_ten_thousand_findings_have_a_limit() -> None:
    def size(count: int) -> int:
        run = result(
            *(finding(f"finding {n}", span=Span(0, 1), severity="note") for n in range(count)),
            text="a: b\n" * 20,
        )
        text = printed("html", run)
        assert text.count("<article") == min(count, check.MAX_FINDINGS)
        assert text.count('<pre class="source">') == min(count, check.MAX_CARDS)
        return len(text)

    sizes = [size(count) for count in (2000, 4000, 8000)]
    assert (sizes[2] - sizes[1]) == pytest.approx(2 * (sizes[1] - sizes[0]), rel=0.05)
    text = printed(
        "html", result(*(finding(f"finding {n}") for n in range(check.MAX_FINDINGS + 7)))
    )
    assert (
        f"7 of {check.MAX_FINDINGS + 7} findings are not on this page; --output json has all."
        in text
    )


def test_a_fix_is_a_diff_of_its_lines() -> None:
    text = "".join(f"line {n}\n" for n in range(1000))
    at = text.index("500")
    lines = diff.fix_diff(Source("a", text), [Edit(Span(at, at + 3), "five hundred")])
    assert [(line.sign + line.text) for line in lines] == [
        "@@ line 500 @@",
        " line 499",
        "-line 500",
        "+line five hundred",
        " line 501",
    ]
    many = [Edit(Span(match.start(), match.end()), "x") for match in re.finditer("[0-9]+", text)]
    lines = diff.fix_diff(Source("a", text), many)
    assert len(lines) <= diff.MAX_LINES + 1
    assert (
        lines[-1].text
        == f"{len(many) - diff.MAX_EDITS} more edits are not shown; `msaa-lint check --diff` "
        "prints all"
    )


def test_pages_of_rules_are_text_of_a_stranger(tmp_path: Path) -> None:
    rule = (
        "---\ncode: ACME1\nseverity: warning\nsubject: image\nwhen: image.samples > 1\nmessage: "
        "too many\n"
        "at: image.samples\n---\nToo many.\n\n"
        "<script>alert(1)</script> [x](javascript:alert(1)) ![y](http://evil.example/) "
        "<http://evil.example>\n"
    )
    (tmp_path / "too-many.md").write_text(rule)
    done = run(
        tmp_path,
        "check",
        "--isolated",
        "--rules",
        "too-many.md",
        "--select",
        "ACME1",
        str(EXAMPLES / "phone"),
        "--output",
        "html",
    )
    found = Page(done.stdout)
    assert "too many" in done.stdout, done.stderr
    assert not [
        each
        for tag, each in found.elements
        if tag == "img" or (each.get("href") or "#").startswith(("javascript", "http://evil"))
    ]
    assert len(found.texts["script"]) == 1


def test_a_comparison_leads_from_the_old_cost_to_the_new_one() -> None:
    old, new = (
        EXAMPLES / "khronos-msaa" / f"{name}.msaa.yaml" for name in ("color-separate", "inline")
    )
    text = run(EXAMPLES, "cost", "--isolated", str(old), str(new), "--output", "html").stdout
    found = re.findall(
        r'<tr class="(?:total|saving|addition)">\s*<th scope="row">(\w+).*?<td '
        r'class="figure">([-+.\d]+)</td>',
        text,
        re.DOTALL,
    )
    assert found[:6] == [
        ("old", "5057.51"),
        ("resolveImage", "-2809.73"),
        ("post", "+1685.84"),
        ("scene", "-1123.89"),
        ("images", "0.00"),
        ("new", "2809.73"),
    ]
    assert text.count('<figure class="graph">') == 2

"""Prices of findings: exact values and general properties."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.finding import Finding, Price
from msaa_lint.linter import prices as price
from msaa_lint.linter.engine import Engine, LintOptions
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules.registry import load
from msaa_lint.linter.rules.rule_file import Rule
from tests.pages import all_examples
from tests.paths import ROOT
from tests.strength import examples

EXAMPLES = sorted((ROOT / "examples").rglob("*.msaa.yaml"))
ENGINE = Engine(load())


def as_written(rule: Rule, suggested: str, vendor: str | None) -> str:
    return suggested


def lint(text: str) -> FileResult:
    return ENGINE.lint(text.encode(), "frame.yaml", LintOptions(as_written, prices=True))


def prices(result: FileResult) -> dict[str, Price | None]:
    return {f"{found.code} {found.subject}": found.price for found in result.findings}


def together(result: FileResult, some: list[Finding] | None = None) -> Price | None:
    return result.combined_price(result.findings if some is None else some) if result.combined_price is not None else None


ATTACHED = """
frame: {width: 2168, height: 1080, fps: 60}
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]}
  depth_ms: {format: D32_SFLOAT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT, TRANSIENT_ATTACHMENT]}
  output: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
renderPasses:
  scene:
    attachments:
      color: {image: color_ms, loadOp: CLEAR, storeOp: STORE}
      depth: {image: depth_ms, loadOp: CLEAR, storeOp: STORE}
      output: {image: output, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output], depthStencilAttachment: depth}
"""


def test_price_of_a_store() -> None:
    """2168 * 1080 * 4 B * 4 samples * 60 Hz."""
    stored = 2168 * 1080 * 4 * 4 * 60 / 1e6
    assert round(stored, 2) == 2247.78
    found = prices(lint(ATTACHED))
    assert found["MSAA201 renderPasses.scene.attachments.color"] == pytest.approx(Price(0.0, stored, 0.0, stored / 10))
    assert found["MSAA203 renderPasses.scene.attachments.depth"] == pytest.approx(Price(0.0, stored, 0.0, stored / 10))


def test_independent_prices_add_up() -> None:
    result = lint(ATTACHED)
    both = [found for found in result.findings if found.code in ("MSAA201", "MSAA203")]
    assert together(result, both) == pytest.approx(tuple(map(sum, zip(*(found.price or () for found in both), strict=True))))


def test_assumed_frame_rate_is_noted() -> None:
    (found,) = [f for f in lint(ATTACHED.replace(", fps: 60", "")).findings if f.code == "MSAA201"]
    assert found.price is not None and round(found.price.write_mb_per_s, 2) == 2247.78
    assert "the cost assumes 60 frames per second" in found.notes
    assert not any("the cost assumes" in note for f in lint(ATTACHED).findings for note in f.notes)


def test_no_price_without_a_size() -> None:
    assert set(prices(lint(ATTACHED.replace("frame: {width: 2168, height: 1080, fps: 60}", ""))).values()) == {None}


def test_fix_that_saves_nothing_has_price_zero() -> None:
    text = (
        ATTACHED
        + """
pipelines:
  p:
    renderPass: scene
    multisampleState: {rasterizationSamples: 4, sampleShadingEnable: true, minSampleShading: 0.2}
    subpass: 0
"""
    )
    assert prices(lint(text))["MSAA502 pipelines.p"] == Price(0.0, 0.0, 0.0, 0.0)


def test_prices_are_only_computed_on_request() -> None:
    result = ENGINE.lint(ATTACHED.encode(), "frame.yaml", LintOptions(as_written))
    assert result.combined_price is None
    assert {found.price for found in result.findings} == {None}


def test_prices_of_a_stream() -> None:
    result = lint(ATTACHED + "---\n" + ATTACHED.replace("fps: 60", "fps: 30"))
    costs = [found.price.write_mb_per_s for found in result.findings if found.code == "MSAA201" and found.price is not None]
    assert costs == pytest.approx([2247.7824, 1123.8912])
    whole = together(result)
    assert whole is not None and whole.write_mb_per_s == pytest.approx(3 * 2247.7824)


FORMATS = {"color": ["R8G8B8A8_UNORM", "R16G16B16A16_SFLOAT"], "depth": ["D32_SFLOAT", "D24_UNORM_S8_UINT"]}
OPS = {"loadOp": ["CLEAR", "LOAD", "DONT_CARE"], "storeOp": ["STORE", "DONT_CARE"]}
STENCIL_OPS = {"stencilLoadOp": ["CLEAR", "LOAD", "DONT_CARE"], "stencilStoreOp": ["STORE", "DONT_CARE"]}


@st.composite
def frames(draw: st.DrawFn) -> str:
    """Frames with mistakes that have a price: passes that share images, resolves inside and outside of passes, readers."""
    device = draw(st.sampled_from(["mali-g76", "nvidia", None]))
    images: dict[str, Any] = {}
    for name in ("color_a", "color_b", "depth"):
        usage = ["DEPTH_STENCIL_ATTACHMENT" if name == "depth" else "COLOR_ATTACHMENT"]
        usage += draw(st.sampled_from([[], ["TRANSIENT_ATTACHMENT"], ["SAMPLED"], ["TRANSFER_SRC"]]))
        image = {"format": draw(st.sampled_from(FORMATS["depth" if name == "depth" else "color"])), "samples": 4, "usage": usage}
        if draw(st.booleans()):
            image["memory"] = draw(st.sampled_from([["DEVICE_LOCAL"], ["DEVICE_LOCAL", "LAZILY_ALLOCATED"]]))
        images[name] = image
    for name in ("color_a", "color_b"):
        images[f"{name}_1x"] = {"format": images[name]["format"], "samples": 1, "usage": ["COLOR_ATTACHMENT", "TRANSFER_DST", "SAMPLED"]}
    passes: dict[str, Any] = {}
    for number in range(draw(st.integers(1, 3))):
        color = draw(st.sampled_from(["color_a", "color_b"]))
        attachments = {
            "color": {"image": color, **{member: draw(st.sampled_from(values)) for member, values in OPS.items()}},
            "depth": {"image": "depth", **{m: draw(st.sampled_from(v)) for m, v in (OPS | STENCIL_OPS).items()}},
        }
        subpass: dict[str, Any] = {"colorAttachments": ["color"], "depthStencilAttachment": "depth"}
        if draw(st.booleans()):
            attachments["output"] = {"image": f"{color}_1x", **{m: draw(st.sampled_from(v)) for m, v in OPS.items()}}
            subpass["resolveAttachments"] = ["output"]
        passes[f"pass{number}"] = {"attachments": attachments, "subpasses": [subpass]}
    description: dict[str, Any] = {"frame": {"width": 640, "height": 480, "fps": 30}, "images": images, "renderPasses": passes}
    if device is not None:
        description["device"] = device
    if draw(st.booleans()):
        commands: list[Any] = []
        for name, each in passes.items():
            commands += [{"beginRenderPass": {"renderPass": name}}, "endRenderPass"]
            color = each["attachments"]["color"]["image"]
            commands += draw(
                st.sampled_from(
                    [
                        [],
                        [{"resolveImage": {"srcImage": color, "dstImage": f"{color}_1x"}}],
                        [{"readImage": {"image": "depth", "samples": 1}}],
                        [{"readImage": {"image": f"{color}_1x"}}],
                    ]
                )
            )
        description["commands"] = commands
    return json.dumps(description)


def assert_at_most_the_sum(result: FileResult) -> None:
    whole = together(result)
    parts = [found.price for found in result.findings if found.price is not None]
    assert (whole is None) == (not parts)
    if whole is not None:
        # What a fix costs instead of saving (memory that an image takes again, say) is shared as well, where two findings ask for it.
        for figure, column in zip(whole, zip(*parts, strict=True), strict=True):
            assert figure <= sum(part for part in column if part > 0) + 1e-6


@examples(3)
@given(frames())
def test_combined_price_is_at_most_the_sum(text: str) -> None:
    assert_at_most_the_sum(lint(text))


@examples(2)
@given(frames())
def test_combined_price_of_one_finding_is_its_price(text: str) -> None:
    """The price of one finding is computed on a part of the frame, that of several on the whole."""
    result = lint(text)
    for found in result.findings:
        assert together(result, [found]) == (pytest.approx(found.price, abs=1e-5) if found.price is not None else None)


@examples(2)
@given(frames(), frames())
def test_prices_of_independent_documents_add_up(one: str, other: str) -> None:
    """The fixes are independent, so their savings add up."""
    first, second = together(lint(one)), together(lint(other))
    both = together(lint(f"{one}\n---\n{other}"))
    none = Price(0.0, 0.0, 0.0, 0.0)
    assert (both or none) == pytest.approx([a + b for a, b in zip(first or none, second or none, strict=True)])


@pytest.mark.parametrize("text", [path.read_text() for path in EXAMPLES], ids=[path.stem for path in EXAMPLES])
def test_combined_price_of_examples_is_at_most_the_sum(text: str) -> None:
    assert_at_most_the_sum(lint(text))


@pytest.mark.parametrize("example", all_examples(), ids=str)
def test_findings_of_rule_pages_can_be_priced(example: Any) -> None:
    """Pricing raises for no finding of a page, and the combined price is at most the sum."""
    text = example.text
    if example.language == "yaml" and "\nframe:" not in f"\n{text}" and "\n---" not in text:
        text = f"frame: {{width: 1920, height: 1080, fps: 60}}\n{text}"
    assert_at_most_the_sum(lint(text))


KHRONOS = ROOT / "examples" / "khronos-msaa"


def test_separate_resolve_matches_the_khronos_measurement() -> None:
    """Its counters differ by 2169.8 MiB/s read and 2282.0 MiB/s written, 4.668 GB/s; the model gives 2 * 2247.78 MB/s, 450 mW."""
    (found,) = [f for f in lint((KHRONOS / "color-separate.msaa.yaml").read_text()).findings if f.code == "MSAA301"]
    assert found.price is not None
    assert found.price == pytest.approx(Price(2247.7824, 2247.7824, 2168 * 1080 * 4 * 4 / 2**20, 449.55648))
    measured = (2169.8 * 2**20 / 1e6, 2282.0 * 2**20 / 1e6)
    assert found.price.read_mb_per_s == pytest.approx(measured[0], rel=0.02)
    assert found.price.write_mb_per_s == pytest.approx(measured[1], rel=0.07)


def test_price_of_storing_and_resolving() -> None:
    result = lint((KHRONOS / "stored-and-resolved.msaa.yaml").read_text())
    memory = 2 * 2168 * 1080 * 4 * 4 / 2**20
    assert together(result) == pytest.approx(Price(0.0, 2 * 2247.7824, memory, 449.55648))


def test_pricing_restores_records() -> None:
    """Pricing applies changes to records temporarily; linting gives the same findings before and after."""
    result = lint(ATTACHED)
    again = together(result)
    assert again == together(result)
    assert [found._replace(price=None) for found in result.findings] == [
        found._replace(price=None) for found in ENGINE.lint(ATTACHED.encode(), "frame.yaml", LintOptions(as_written)).findings
    ]


def test_merge_changes_keeps_the_first_of_two_values() -> None:
    class Stand:
        pass

    record: Any = Stand()
    one, other = price.Change(record, "storeOp", "set", "DONT_CARE"), price.Change(record, "storeOp", "set", "STORE")
    flag = price.Change(record, "usage", "add", "TRANSIENT_ATTACHMENT")
    assert price.merge_changes([[one, flag], [other, flag]]) == (one, flag)

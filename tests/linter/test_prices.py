"""Prices of findings: exact values and general properties."""

from __future__ import annotations

from typing import Any

import pytest

from msaa_lint.core.finding import Price
from msaa_lint.linter import prices as price
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules.registry import load
from msaa_lint.linter.rules.rule import Rule
from tests.pages import all_examples
from tests.paths import ROOT

ENGINE = Engine(load())


def as_written(rule: Rule, suggested: str, vendor: str | None) -> str:
    return suggested


def lint(text: str) -> FileResult:
    return ENGINE.lint(text.encode(), "frame.yaml", LintOptions(as_written, prices=True))


def prices(result: FileResult) -> dict[str, Price | None]:
    return {f"{found.code} {found.subject}": found.price for found in result.findings}


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
    assert found["MSAA201 renderPasses.scene.attachments.color"] == pytest.approx(
        Price(0.0, stored, 0.0, stored / 10)
    )
    assert found["MSAA203 renderPasses.scene.attachments.depth"] == pytest.approx(
        Price(0.0, stored, 0.0, stored / 10)
    )


def test_assumed_frame_rate_is_noted() -> None:
    (found,) = [f for f in lint(ATTACHED.replace(", fps: 60", "")).findings if f.code == "MSAA201"]
    assert found.price is not None and round(found.price.write_mb_per_s, 2) == 2247.78
    assert "the cost assumes 60 frames per second" in found.notes
    assert not any("the cost assumes" in note for f in lint(ATTACHED).findings for note in f.notes)


def test_no_price_without_a_size() -> None:
    assert set(
        prices(lint(ATTACHED.replace("frame: {width: 2168, height: 1080, fps: 60}", ""))).values()
    ) == {None}


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
    assert {found.price for found in result.findings} == {None}


def test_prices_of_a_stream() -> None:
    result = lint(ATTACHED + "---\n" + ATTACHED.replace("fps: 60", "fps: 30"))
    costs = [
        found.price.write_mb_per_s
        for found in result.findings
        if found.code == "MSAA201" and found.price is not None
    ]
    assert costs == pytest.approx([2247.7824, 1123.8912])


@pytest.mark.parametrize("example", all_examples(), ids=str)
def test_findings_of_rule_pages_can_be_priced(example: Any) -> None:
    """Pricing raises for no finding of a page."""
    text = example.text
    if example.language == "yaml" and "\nframe:" not in f"\n{text}" and "\n---" not in text:
        text = f"frame: {{width: 1920, height: 1080, fps: 60}}\n{text}"
    lint(text)


KHRONOS = ROOT / "examples" / "khronos-msaa"


def test_separate_resolve_matches_the_khronos_measurement() -> None:
    """Its counters differ by 2169.8 MiB/s read and 2282.0 MiB/s written, 4.668 GB/s; the model
    gives 2 * 2247.78 MB/s, 450 mW.
    """
    (found,) = [
        f
        for f in lint((KHRONOS / "color-separate.msaa.yaml").read_text()).findings
        if f.code == "MSAA301"
    ]
    assert found.price is not None
    assert found.price == pytest.approx(
        Price(2247.7824, 2247.7824, 2168 * 1080 * 4 * 4 / 2**20, 449.55648)
    )
    measured = (2169.8 * 2**20 / 1e6, 2282.0 * 2**20 / 1e6)
    assert found.price.read_mb_per_s == pytest.approx(measured[0], rel=0.02)
    assert found.price.write_mb_per_s == pytest.approx(measured[1], rel=0.07)


def test_pricing_restores_records() -> None:
    """Pricing applies changes to records temporarily; linting gives the same findings before and
    after.
    """
    linted = ENGINE.lint(ATTACHED.encode(), "frame.yaml", LintOptions(as_written))
    assert [
        found._replace(price=None, assumes_tiler=False) for found in lint(ATTACHED).findings
    ] == [found._replace(price=None) for found in linted.findings]


def test_structural_fixes_beyond_the_budget_are_not_priced_and_say_so() -> None:
    """Each is priced by reading the text again, so that their number would make the time
    quadratic.
    """
    parts = [
        (
            f"  ms{n}: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, "
            f"TRANSFER_SRC]}}\n"
            f"  r{n}: {{format: R8G8B8A8_UNORM, samples: 1, usage: [TRANSFER_DST, SAMPLED]}}\n",
            f"  p{n}: {{attachments: {{c: {{image: ms{n}, loadOp: CLEAR, storeOp: STORE}}}}, "
            f"subpasses: [{{colorAttachments: [c]}}]}}\n",
            f"  - beginRenderPass: {{renderPass: p{n}}}\n  - endRenderPass\n  - resolveImage: "
            f"{{srcImage: ms{n}, dstImage: r{n}}}\n",
        )
        for n in range(20)
    ]
    images, passes, commands = ("".join(column) for column in zip(*parts, strict=True))
    text = (
        f"frame: {{width: 64, height: 64, fps: 60}}\nimages:\n{images}renderPasses:\n"
        f"{passes}commands:\n{commands}"
    )
    text += "#" * (price.MAX_REREAD // 10 - len(text))
    resolves = [found for found in lint(text).findings if found.code == "MSAA301"]
    assert [found.price is not None for found in resolves] == [True] * 10 + [False] * 10
    assert [price.NOT_PRICED in found.notes for found in resolves] == [False] * 10 + [True] * 10

"""Vulkan SC pipeline JSON: C's structures as the tools dump them, and what those tools may write
yet.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from msaa_lint import lint
from msaa_lint.core.finding import Finding, Result
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import Pipeline, RenderPass, Subpass
from msaa_lint.input.readers import read
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.rules.registry import load
from tests.frame.description.shapes import JUNK, paths, replaced
from tests.frame.description.test_schema import value_of
from tests.paths import ROOT, SAMPLES
from tests.strength import examples

DATA = ROOT / "tests" / "data"
FOLDER = SAMPLES / "vulkan_sc"

RENDERPASS = (DATA / "vulkan_sc_renderpass.json").read_text(encoding="utf-8")
RENDERPASS2 = (DATA / "vulkan_sc_renderpass2.json").read_text(encoding="utf-8")
COMPUTE = (DATA / "vulkan_sc_compute.json").read_text(encoding="utf-8")


def document(text: str) -> Document:
    source = Source("pipeline.json", text)
    parsed = parse(source, Limits())
    assert not parsed.problems, parsed.problems
    return read(source, parsed.documents[0])


def pipeline(text: str) -> tuple[RenderPass, Pipeline]:
    found = document(text)
    assert found.problems == ()
    assert not found.whole
    (render_pass,) = found.description.renderPasses.values()
    return render_pass, found.description.pipelines["GraphicsPipeline"]


def places(result: Result) -> list[tuple[str, int, str]]:
    """The rule, the line and the text that every finding marks."""
    out = []
    for found in result.findings:
        source = result.sources[found.file]
        assert found.span is not None
        out.append(
            (
                found.rule,
                source.position(found.span.start).line,
                source.text[found.span.start : found.span.end],
            )
        )
    return out


def test_a_render_pass_of_version_1() -> None:
    render_pass, made = pipeline(RENDERPASS)
    color, depth, output = render_pass.attachments
    assert (color.format, color.samples, color.loadOp, color.storeOp) == (
        "R8G8B8A8_UNORM",
        4,
        "CLEAR",
        "STORE",
    )
    assert (color.flags, depth.flags, output.flags) == (("MAY_ALIAS",), (), ())
    assert (depth.samples, depth.stencilLoadOp, depth.stencilStoreOp) == (4, "CLEAR", "DONT_CARE")
    assert output.finalLayout == "PRESENT_SRC_KHR"
    (subpass,) = render_pass.subpasses
    assert [each.attachment for each in subpass.colorAttachments] == [0, None]
    assert [each.attachment for each in subpass.resolveAttachments] == [2, None]
    assert (
        subpass.depthStencilAttachment is not None
        and subpass.depthStencilAttachment.attachment == 1
    )
    assert (subpass.inputAttachments, subpass.preserveAttachments, subpass.depthStencilResolve) == (
        (),
        (),
        None,
    )
    (dependency,) = render_pass.dependencies
    assert (dependency.srcSubpass, dependency.dstSubpass) == ("EXTERNAL", 0)
    assert dependency.srcStageMask == ("COLOR_ATTACHMENT_OUTPUT", "LATE_FRAGMENT_TESTS")
    assert dependency.dstStageMask == ("EARLY_FRAGMENT_TESTS", "COLOR_ATTACHMENT_OUTPUT")
    assert (
        dependency.srcAccessMask
        == dependency.dstAccessMask
        == ("COLOR_ATTACHMENT_WRITE", "DEPTH_STENCIL_ATTACHMENT_WRITE")
    )
    assert (made.renderPass, made.subpass, made.dynamicState) == (
        "Renderpass",
        0,
        ("VIEWPORT", "SCISSOR"),
    )
    state = made.multisampleState
    assert state is not None
    assert (state.rasterizationSamples, state.sampleShadingEnable, state.minSampleShading) == (
        4,
        True,
        0.25,
    )
    assert (state.sampleMask, state.alphaToCoverageEnable, state.alphaToOneEnable) == (
        (7,),
        False,
        False,
    )
    assert made.colorBlendState is not None
    blended = made.colorBlendState.attachments[0]
    assert (blended.blendEnable, blended.colorWriteMask, blended.dstColorBlendFactor) == (
        True,
        ("R", "A"),
        None,
    )
    assert made.stages[0].stage == "FRAGMENT"
    assert made.depthStencilState is None


def test_what_is_enabled() -> None:
    enabled = document(RENDERPASS).description.enabled
    assert enabled is not None
    assert (enabled.extensions, enabled.features, enabled.apiVersion) == (
        ("VK_KHR_swapchain",),
        ("sampleRateShading",),
        None,
    )
    nothing = document(RENDERPASS2).description.enabled
    assert nothing is not None
    assert (nothing.extensions, nothing.features) == (None, None)


def test_a_render_pass_of_version_2() -> None:
    render_pass, made = pipeline(RENDERPASS2)
    depth, _ = render_pass.attachments
    assert (depth.initialLayout, depth.stencilInitialLayout) == (
        "DEPTH_ATTACHMENT_OPTIMAL",
        "UNDEFINED",
    )
    assert depth.stencilFinalLayout == "STENCIL_ATTACHMENT_OPTIMAL"
    subpass: Subpass = render_pass.subpasses[0]
    assert (
        subpass.depthStencilAttachment is not None
        and subpass.depthStencilAttachment.attachment == 0
    )
    resolve = subpass.depthStencilResolve
    assert resolve is not None and resolve.attachment is not None
    assert (
        resolve.depthResolveMode,
        resolve.stencilResolveMode,
        resolve.attachment.attachment,
    ) == ("AVERAGE", "NONE", 1)
    single = subpass.multisampledRenderToSingleSampled
    assert single is not None
    assert (single.multisampledRenderToSingleSampledEnable, single.rasterizationSamples) == (
        False,
        1,
    )
    (dependency,) = render_pass.dependencies
    assert (dependency.srcStageMask, dependency.srcAccessMask) == (
        ("LATE_FRAGMENT_TESTS",),
        ("DEPTH_STENCIL_ATTACHMENT_WRITE",),
    )
    assert made.renderPass == "Renderpass2"
    assert made.multisampleState is not None and made.multisampleState.sampleMask == ()


def test_findings_of_version_1_stand_at_their_members() -> None:
    assert places(lint(text=RENDERPASS, filename="pipeline.json", isolated=True)) == [
        ("multisampled-attachment-stored", 17, '"VK_ATTACHMENT_STORE_OP_STORE"'),
        ("sample-shading-ineffective", 128, '"VK_TRUE"'),
        ("sample-mask-drops-samples", 130, '"pSampleMask"'),
    ]


def test_findings_of_version_2_stand_at_their_members() -> None:
    found = places(lint(text=RENDERPASS2, filename="pipeline.json", isolated=True))
    assert found == [
        ("load-from-undefined", 26, '"VK_ATTACHMENT_LOAD_OP_LOAD"'),
        ("depth-averaged", 60, '"VK_RESOLVE_MODE_AVERAGE_BIT"'),
    ]


def test_a_compute_pipeline_says_nothing() -> None:
    found = document(COMPUTE)
    assert (found.problems, found.whole) == ((), False)
    assert (found.description.renderPasses, found.description.pipelines) == ({}, {})
    result = lint(text=COMPUTE, filename="compute.json", isolated=True)
    assert (result.findings, result.undecided) == ([], [])


def changed(text: str, *changes: tuple[str, str]) -> str:
    for old, new in changes:
        assert text.count(old) >= 1, old
        text = text.replace(old, new)
    return text


def test_enumerants_of_the_future_are_unknown() -> None:
    text = changed(
        RENDERPASS,
        ("VK_ATTACHMENT_STORE_OP_STORE", "VK_ATTACHMENT_STORE_OP_STORE_TWICE_EXT"),
        ("VK_FORMAT_R8G8B8A8_UNORM", "VK_FORMAT_R1_UNORM_FUTURE"),
        ("VK_ATTACHMENT_DESCRIPTION_MAY_ALIAS_BIT", "VK_ATTACHMENT_DESCRIPTION_MAY_DO_ELSE_BIT"),
        ("VK_DYNAMIC_STATE_SCISSOR", "VK_DYNAMIC_STATE_FUTURE"),
        ('"dstStageMask" : 1280', '"dstStageMask" : "0x8000000000000000"'),
    )
    render_pass, made = pipeline(text)
    color = render_pass.attachments[0]
    assert (color.storeOp, color.format, color.flags) == (None, None, ())
    assert made.dynamicState == ("VIEWPORT",)
    assert render_pass.dependencies[0].dstStageMask is None
    assert "multisampled-attachment-stored" not in {
        found.rule for found in lint(text=text, isolated=True).findings
    }


def test_a_pipeline_without_a_render_pass() -> None:
    data = json.loads(json.dumps(value_of(parse(Source("x", RENDERPASS), Limits()).documents[0])))
    data["GraphicsPipelineState"]["Renderpass"] = "NULL"
    data["GraphicsPipelineState"]["GraphicsPipeline"]["renderPass"] = ""
    data["GraphicsPipelineState"]["GraphicsPipeline"]["pNext"] = {
        "sType": "VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO_KHR",
        "pNext": "NULL",
        "viewMask": 0,
        "colorAttachmentCount": 2,
        "pColorAttachmentFormats": ["VK_FORMAT_R16G16B16A16_SFLOAT", "VK_FORMAT_UNDEFINED"],
        "depthAttachmentFormat": "VK_FORMAT_D32_SFLOAT",
        "stencilAttachmentFormat": "VK_FORMAT_UNDEFINED",
    }
    found = document(json.dumps(data))
    assert found.problems == ()
    assert found.description.renderPasses == {}
    made = found.description.pipelines["GraphicsPipeline"]
    assert made.renderPass is None
    assert made.rendering is not None
    assert made.rendering.colorAttachmentFormats == ("R16G16B16A16_SFLOAT", "UNDEFINED")


def test_dynamic_sample_count() -> None:
    static = changed(
        RENDERPASS,
        (
            '"rasterizationSamples" : "VK_SAMPLE_COUNT_4_BIT"',
            '"rasterizationSamples" : "VK_SAMPLE_COUNT_8_BIT"',
        ),
    )
    dynamic = changed(
        static, ("VK_DYNAMIC_STATE_SCISSOR", "VK_DYNAMIC_STATE_RASTERIZATION_SAMPLES_EXT")
    )
    assert pipeline(dynamic)[1].dynamicState == ("VIEWPORT", "RASTERIZATION_SAMPLES_EXT")
    for text, fires in ((static, True), (dynamic, False)):
        assert (
            "rasterization-samples-mismatch"
            in {found.rule for found in lint(text=text, isolated=True).findings}
        ) == fires


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            '{"GraphicsPipelineState": []}',
            "`GraphicsPipelineState` must be a mapping, found a list",
        ),
        (
            '{"GraphicsPipelineState": {"Renderpass": 4}}',
            "`GraphicsPipelineState.Renderpass` must be a mapping, found `4`",
        ),
        (
            '{"GraphicsPipelineState": {"GraphicsPipeline": []}}',
            "`GraphicsPipelineState.GraphicsPipeline` must be a mapping, found a list",
        ),
        ('{"GraphicsPipelineState": {"Renderpass": {"pAttachments": {}}}}', None),
        (
            '{"GraphicsPipelineState": {"Renderpass": {"pAttachments": [4]}}}',
            "`GraphicsPipelineState.Renderpass.pAttachments[0]` must be a mapping, found `4`",
        ),
        (
            '{"GraphicsPipelineState": {"Renderpass": {"pAttachments": [{"samples": '
            '"VK_SAMPLE_COUNT_3_BIT"}]}}}',
            None,
        ),
        (
            '{"GraphicsPipelineState": {"Renderpass": {"pSubpasses": [{"viewMask": "²"}]}}}',
            "`viewMask` must be an integer from 0 to 4294967295, found `²`",
        ),
        (
            '{"GraphicsPipelineState": {"Renderpass": {"pSubpasses": [{"viewMask": '
            '"99999999999999999999999"}]}}}',
            None,
        ),
        (
            '{"GraphicsPipelineState": {"GraphicsPipeline": {"pMultisampleState": '
            '{"minSampleShading": "much"}}}}',
            None,
        ),
        (
            '{"GraphicsPipelineState": {"GraphicsPipeline": {"pMultisampleState": '
            '{"sampleShadingEnable": "VK_MAYBE"}}}}',
            None,
        ),
    ],
)
def test_what_no_tool_writes(text: str, message: str | None) -> None:
    found = document(text)
    if 'pAttachments": {}' in text:
        assert found.problems == ()
        return
    (problem,) = found.problems
    assert problem.code == "MSAA903"
    assert message is None or problem.message == message


ENGINE = Engine(load())
VALUES: list[Any] = [
    value_of(parse(Source("x", text), Limits()).documents[0]) for text in (RENDERPASS, RENDERPASS2)
]


@examples(1.5, suppress_health_check=[HealthCheck.too_slow])
@given(
    st.sampled_from([0, 1]),
    st.lists(st.tuples(st.integers(0, 10**6), JUNK | st.text(max_size=3)), min_size=1, max_size=4),
)
def test_garbage_in_any_member_never_crashes(which: int, changes: list[tuple[int, Any]]) -> None:
    value = VALUES[which]
    for number, junk in changes:
        every = paths(value)
        value = replaced(value, every[number % len(every)], junk)
    linted = ENGINE.lint(
        json.dumps(value).encode(),
        "pipeline.json",
        LintOptions(lambda rule, suggested, vendor: suggested),
    )
    fatal = {found.code for found in linted.findings if found.fatal}
    assert fatal <= {"MSAA903", "MSAA902"}


@pytest.mark.skipif(not FOLDER.is_dir(), reason=f"no samples at {FOLDER}")
class TestSamples:
    """The 129 files of the Khronos tools' own tests."""

    @staticmethod
    def linted() -> Result:
        return lint(str(FOLDER), isolated=True)

    def test_what_is_found(self) -> None:
        result = self.linted()
        assert len(result.files) == len(list(FOLDER.rglob("*.json"))) == 129
        assert [found for found in result.findings if found.code.startswith("MSAA9")] == []
        above: list[Finding] = [found for found in result.findings if found.severity != "note"]
        (stored,) = above
        assert stored.rule == "multisampled-attachment-stored"
        source = result.sources[stored.file]
        assert stored.span is not None
        line = source.line(source.position(stored.span.start).line)
        assert line.strip() == '"storeOp" : "VK_ATTACHMENT_STORE_OP_STORE",'
        assert source.text[stored.span.start : stored.span.end] == '"VK_ATTACHMENT_STORE_OP_STORE"'
        assert '"samples" : "VK_SAMPLE_COUNT_4_BIT"' in source.line(
            source.position(stored.span.start).line - 2
        )
        of_compute = [found for found in result.findings if "compute" in Path(found.file).name]
        assert of_compute == []

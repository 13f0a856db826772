"""Fixes of clear and copy commands."""

from __future__ import annotations

import textwrap

import pytest

from msaa_lint.linter.fixes.changes import NoFix
from msaa_lint.linter.fixes.document_fixes import DocumentFixes
from msaa_lint.linter.rules.rule_runner import finding_key
from tests.linter.fixes.linting import fix_findings, lint

CLEAR = "clearAttachments: {attachments: [%s], rects: [{x: 0, y: 0, width: 64, height: 64}]}"
FRAME = """\
images:
  color: {format: R8G8B8A8_UNORM, samples: 1}
  depth: {format: D32_SFLOAT, samples: 1}
renderPasses:
  scene:
    attachments:
      color: {image: color, loadOp: LOAD, storeOp: STORE}
      depth: {image: depth, loadOp: LOAD, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], depthStencilAttachment: depth}
commands:
"""
BEGIN = (
    "  - beginRenderPass: {renderPass: scene, renderArea: {x: 0, y: 0, width: 64, height: 64}, "
    "clearValueCount: %d}\n"
)


def commands(text: str) -> str:
    return text[text.index("commands:\n") :]


def reasons(text: str, rule: str) -> list[str]:
    """The reasons why findings of a rule cannot be fixed."""
    result = lint(text)
    assert result.source is not None
    fixes = DocumentFixes(result.documents[0])
    found = []
    for finding in result.findings:
        try:
            if finding.rule == rule and finding_key(finding) in fixes.result.fix_specs:
                fixes.changes(finding)
        except NoFix as error:
            found.append(str(error))
    return found


def test_clear_becomes_the_load_operation_with_its_clear_value() -> None:
    """VUID-VkRenderPassBeginInfo-clearValueCount-00902: there are values up to the last cleared
    attachment.
    """
    text = (
        FRAME
        + BEGIN % 0
        + f"  - {CLEAR % '{aspect: DEPTH}'}\n  - draw: {{vertexCount: 3}}\n  - endRenderPass\n"
    )
    done = fix_findings(text, True)
    assert [found.rule for found in done.fixed_findings] == ["clear-command-instead-of-load-op"]
    assert "depth: {image: depth, loadOp: CLEAR, storeOp: STORE}" in done.text
    assert "color: {image: color, loadOp: LOAD, storeOp: STORE}" in done.text
    assert (
        commands(done.text)
        == "commands:\n" + BEGIN % 2 + "  - draw: {vertexCount: 3}\n  - endRenderPass\n"
    )


@pytest.mark.parametrize(
    ("stated", "index", "needed"), [(0, 0, 1), (0, 1, 2), (1, 1, 2), (1, 0, 1), (2, 1, 2)]
)
def test_clear_values_reach_the_cleared_attachment(stated: int, index: int, needed: int) -> None:
    """VUID-VkRenderPassBeginInfo-clearValueCount-00902, and not one value more."""
    what = ("{aspect: COLOR, colorAttachment: 0}", "{aspect: DEPTH}")[index]
    text = (
        FRAME
        + BEGIN % stated
        + f"  - {CLEAR % what}\n  - draw: {{vertexCount: 3}}\n  - endRenderPass\n"
    )
    expected = "commands:\n" + BEGIN % needed + "  - draw: {vertexCount: 3}\n  - endRenderPass\n"
    assert commands(fix_findings(text, True).text) == expected


def test_sufficient_clear_values_stay() -> None:
    text = (
        FRAME
        + BEGIN % 2
        + f"  - {CLEAR % '{aspect: COLOR, colorAttachment: 0}'}\n  - endRenderPass\n"
    )
    assert (
        commands(fix_findings(text, True).text) == "commands:\n" + BEGIN % 2 + "  - endRenderPass\n"
    )


def test_other_attachments_of_a_clear_command_stay() -> None:
    both = "{aspect: COLOR, colorAttachment: 0}, {aspect: DEPTH}"
    late = "  - draw: {vertexCount: 3}\n  - endRenderPass\n"
    used = FRAME.replace(
        "loadOp: LOAD, storeOp: STORE}\n    subpasses",
        "loadOp: NONE, storeOp: STORE}\n    subpasses",
    )
    done = fix_findings(used + BEGIN % 2 + f"  - {CLEAR % both}\n{late}", True)
    assert (
        commands(done.text)
        == "commands:\n" + BEGIN % 2 + f"  - {CLEAR % '{aspect: DEPTH}'}\n{late}"
    )


def test_pass_that_begins_twice_is_not_changed() -> None:
    once = BEGIN % 2 + f"  - {CLEAR % '{aspect: COLOR, colorAttachment: 0}'}\n  - endRenderPass\n"
    assert reasons(FRAME + once + once, "clear-command-instead-of-load-op") == [
        "the pass begins more than once"
    ]


def test_useless_clear_is_removed_and_the_load_operation_stays() -> None:
    text = textwrap.dedent("""\
        images: {color: {format: R8G8B8A8_UNORM, samples: 1}}
        commands:
          - clearColorImage: {image: color}
          - beginRendering: {colorAttachments: [{image: color, loadOp: DONT_CARE, storeOp: STORE}]}
          - endRendering
    """)
    assert fix_findings(text, True).text == text.replace(
        "  - clearColorImage: {image: color}\n", ""
    )


def test_surplus_clear_values_are_removed_from_every_begin() -> None:
    text = (
        FRAME.replace("LOAD", "CLEAR", 1)
        + (BEGIN % 3 + "  - endRenderPass\n")
        + (BEGIN % 4 + "  - endRenderPass\n")
    )
    assert (
        commands(fix_findings(text, False).text)
        == "commands:\n" + (BEGIN % 2 + "  - endRenderPass\n") * 2
    )


def test_clear_value_without_clear_is_not_fixed() -> None:
    """Either the clear or its value was forgotten. Together with the fix of a clear command, a
    CLEAR would have no value.
    """
    text = FRAME + BEGIN % 2 + "  - endRenderPass\n"
    assert [found.rule for found in lint(text).findings if found.code == "MSAA214"] == [
        "clear-value-without-clear"
    ]
    assert fix_findings(text, True).text == text


def test_draw_the_copy_is_only_shown() -> None:
    text = textwrap.dedent("""\
        images: {a: {format: R8G8B8A8_UNORM, samples: 1}, b: {format: R8G8B8A8_UNORM, samples: 1}}
        commands:
          - copyImage: {srcImage: a, dstImage: b}
          - beginRendering: {colorAttachments: [{image: b, loadOp: LOAD, storeOp: STORE}]}
          - endRendering
    """)
    assert fix_findings(text, True).text == text
    assert reasons(text, "copied-then-loaded") == []
    assert (
        reasons(
            text.replace(
                "copyImage: {srcImage: a, dstImage: b}", "copyBufferToImage: {dstImage: b}"
            ),
            "copied-then-loaded",
        )
        == []
    )

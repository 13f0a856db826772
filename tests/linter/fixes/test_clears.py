"""Clears and copies by command: what their fixes make of a frame, and where there is none."""

from __future__ import annotations

import textwrap

from msaa_lint.linter.fixes.changes import NoFix
from msaa_lint.linter.fixes.document_fixes import DocumentFixes
from tests.linter.fixes.judging import fixed, lint

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
BEGIN = "  - beginRenderPass: {renderPass: scene, renderArea: {x: 0, y: 0, width: 64, height: 64}, clearValueCount: %d}\n"


def commands(text: str) -> str:
    return text[text.index("commands:\n") :]


def reasons(text: str, rule: str) -> list[str]:
    """Why the fixes of a rule's findings cannot be made."""
    linted = lint(text)
    assert linted.source is not None
    fixes = DocumentFixes(linted.documents[0])
    found = []
    for finding in linted.findings:
        try:
            if finding.rule == rule and fixes.covers(finding):
                fixes.changes(finding)
        except NoFix as error:
            found.append(str(error))
    return found


def test_a_clear_becomes_the_load_operation_and_has_its_value() -> None:
    """VUID-VkRenderPassBeginInfo-clearValueCount-00902: values up to the last attachment that is cleared."""
    text = FRAME + BEGIN % 0 + f"  - {CLEAR % '{aspect: DEPTH}'}\n  - draw: {{vertexCount: 3}}\n  - endRenderPass\n"
    done = fixed(text, True)
    assert [found.rule for found in done.fixed_findings] == ["clear-command-instead-of-load-op"]
    assert "depth: {image: depth, loadOp: CLEAR, storeOp: STORE}" in done.text
    assert "color: {image: color, loadOp: LOAD, storeOp: STORE}" in done.text
    assert commands(done.text) == "commands:\n" + BEGIN % 2 + "  - draw: {vertexCount: 3}\n  - endRenderPass\n"


def test_as_many_values_as_there_are_stay() -> None:
    text = FRAME + BEGIN % 2 + f"  - {CLEAR % '{aspect: COLOR, colorAttachment: 0}'}\n  - endRenderPass\n"
    assert commands(fixed(text, True).text) == "commands:\n" + BEGIN % 2 + "  - endRenderPass\n"


def test_of_a_command_for_several_attachments_the_others_stay() -> None:
    both = "{aspect: COLOR, colorAttachment: 0}, {aspect: DEPTH}"
    late = "  - draw: {vertexCount: 3}\n  - endRenderPass\n"
    used = FRAME.replace("loadOp: LOAD, storeOp: STORE}\n    subpasses", "loadOp: NONE, storeOp: STORE}\n    subpasses")
    done = fixed(used + BEGIN % 2 + f"  - {CLEAR % both}\n{late}", True)
    assert commands(done.text) == "commands:\n" + BEGIN % 2 + f"  - {CLEAR % '{aspect: DEPTH}'}\n{late}"


def test_a_pass_that_is_begun_several_times_is_left_alone() -> None:
    once = BEGIN % 2 + f"  - {CLEAR % '{aspect: COLOR, colorAttachment: 0}'}\n  - endRenderPass\n"
    assert reasons(FRAME + once + once, "clear-command-instead-of-load-op") == ["the pass begins more than once"]


def test_a_clear_in_vain_goes_and_the_load_operation_stays() -> None:
    text = textwrap.dedent("""\
        images: {color: {format: R8G8B8A8_UNORM, samples: 1}}
        commands:
          - clearColorImage: {image: color}
          - beginRendering: {colorAttachments: [{image: color, loadOp: DONT_CARE, storeOp: STORE}]}
          - endRendering
    """)
    assert fixed(text, True).text == text.replace("  - clearColorImage: {image: color}\n", "")


def test_clear_values_of_no_attachment_go_from_every_begin() -> None:
    text = FRAME.replace("LOAD", "CLEAR", 1) + (BEGIN % 3 + "  - endRenderPass\n") + (BEGIN % 4 + "  - endRenderPass\n")
    assert commands(fixed(text, False).text) == "commands:\n" + (BEGIN % 2 + "  - endRenderPass\n") * 2


def test_whether_a_clear_or_its_value_was_forgotten_is_a_choice() -> None:
    """Made beside the fix of a clear command it would leave a CLEAR without its value."""
    text = FRAME + BEGIN % 2 + "  - endRenderPass\n"
    assert [found.rule for found in lint(text).findings if found.code == "MSAA214"] == ["clear-value-without-clear"]
    assert fixed(text, True).text == text


def test_a_copy_that_is_to_be_drawn_is_shown_and_never_made() -> None:
    text = textwrap.dedent("""\
        images: {a: {format: R8G8B8A8_UNORM, samples: 1}, b: {format: R8G8B8A8_UNORM, samples: 1}}
        commands:
          - copyImage: {srcImage: a, dstImage: b}
          - beginRendering: {colorAttachments: [{image: b, loadOp: LOAD, storeOp: STORE}]}
          - endRendering
    """)
    assert fixed(text, True).text == text
    assert reasons(text, "copied-then-loaded") == []
    assert reasons(text.replace("copyImage: {srcImage: a, dstImage: b}", "copyBufferToImage: {dstImage: b}"), "copied-then-loaded") == []

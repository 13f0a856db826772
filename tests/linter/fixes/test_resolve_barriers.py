"""Barriers around a vkCmdResolveImage, when the pass resolves instead."""

from __future__ import annotations

import pytest

from tests.linter.fixes.linting import fix_findings

BARRIER = (
    "  - pipelineBarrier: {{srcStageMask: [{source}], dstStageMask: [{target}], srcAccessMask: "
    "[{written}], dstAccessMask: [{read}], "
    "images: [{images}]}}\n"
)
SAMPLES = BARRIER.format(
    source="COLOR_ATTACHMENT_OUTPUT",
    target="TRANSFER",
    written="COLOR_ATTACHMENT_WRITE",
    read="TRANSFER_READ",
    images="{image: color_ms, oldLayout: COLOR_ATTACHMENT_OPTIMAL, newLayout: "
    "TRANSFER_SRC_OPTIMAL}",
)
PREPARED = BARRIER.format(
    source="FRAGMENT_SHADER",
    target="TRANSFER",
    written="",
    read="TRANSFER_WRITE",
    images="{image: color, oldLayout: UNDEFINED, newLayout: TRANSFER_DST_OPTIMAL}",
)
RESOLVED = BARRIER.format(
    source="TRANSFER",
    target="FRAGMENT_SHADER",
    written="TRANSFER_WRITE",
    read="SHADER_READ",
    images="{image: color, oldLayout: TRANSFER_DST_OPTIMAL, newLayout: SHADER_READ_ONLY_OPTIMAL}",
)


def frame(before: str = "", between: str = "", after: str = "", dependencies: str = "") -> str:
    """A scene that a command resolves for a second pass, with barriers before the scene, and before
    and after the command.
    """
    return f"""\
images:
  color_ms: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSFER_SRC]}}
  color: {{format: R8G8B8A8_UNORM, samples: 1, usage: [TRANSFER_DST, SAMPLED]}}
  other: {{format: R8G8B8A8_UNORM, samples: 1, usage: [SAMPLED]}}
  backbuffer: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}}
renderPasses:
  scene:
    attachments:
      color: {{image: color_ms, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}}
    subpasses:
      - {{colorAttachments: [color]}}
{dependencies}  post:
    attachments:
      color: {{image: backbuffer, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: PRESENT_SRC_KHR}}
    subpasses:
      - {{colorAttachments: [color]}}
commands:
{before}  - beginRenderPass: {{renderPass: scene}}
  - endRenderPass
{between}  - resolveImage: {{srcImage: color_ms, dstImage: color}}
{after}  - beginRenderPass: {{renderPass: post}}
  - readImage: {{image: color, stage: FRAGMENT, access: SHADER_READ}}
  - endRenderPass
  - present: {{image: backbuffer}}
"""


def commands(text: str) -> str:
    return text[text.index("commands:") :]


def test_barriers_before_the_resolve_become_a_dependency_and_the_one_after_it_waits_for_the_pass() -> (
    None
):
    done = fix_findings(frame(between=SAMPLES + PREPARED, after=RESOLVED), unsafe=True)
    assert done.failed_fixes == ()
    assert (
        "dependencies: [{srcSubpass: EXTERNAL, dstSubpass: 0, srcStageMask: [FRAGMENT_SHADER, "
        "COLOR_ATTACHMENT_OUTPUT], "
        "dstStageMask: [COLOR_ATTACHMENT_OUTPUT], srcAccessMask: [COLOR_ATTACHMENT_WRITE], "
        "dstAccessMask: [COLOR_ATTACHMENT_WRITE]}]"
    ) in done.text
    assert (
        "{image: color, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: "
        "COLOR_ATTACHMENT_OPTIMAL}" in done.text
    )
    assert commands(done.text) == (
        "commands:\n  - beginRenderPass: {renderPass: scene}\n  - endRenderPass\n"
        + RESOLVED.replace("TRANSFER_WRITE", "COLOR_ATTACHMENT_WRITE")
        .replace("[TRANSFER]", "[COLOR_ATTACHMENT_OUTPUT]")
        .replace("TRANSFER_DST_OPTIMAL", "COLOR_ATTACHMENT_OPTIMAL")
        + commands(frame())[commands(frame()).index("  - beginRenderPass: {renderPass: post}") :]
    )


def test_a_barrier_without_layouts_leaves_the_transition_to_the_pass() -> None:
    plain = BARRIER.format(
        source="TRANSFER",
        target="FRAGMENT_SHADER",
        written="TRANSFER_WRITE",
        read="SHADER_READ",
        images="color",
    )
    done = fix_findings(frame(after=plain), unsafe=True)
    assert "initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}" in done.text
    assert "srcStageMask: [COLOR_ATTACHMENT_OUTPUT], dstStageMask: [FRAGMENT_SHADER]" in done.text


def test_a_stated_dependency_takes_over_what_a_barrier_waits_for() -> None:
    stated = (
        "    dependencies:\n      - {srcSubpass: EXTERNAL, dstSubpass: 0, srcStageMask: "
        "[COLOR_ATTACHMENT_OUTPUT], "
        "dstStageMask: [COLOR_ATTACHMENT_OUTPUT], srcAccessMask: [COLOR_ATTACHMENT_WRITE], "
        "dstAccessMask: [COLOR_ATTACHMENT_WRITE]}\n"
    )
    done = fix_findings(frame(between=PREPARED, after=RESOLVED, dependencies=stated), unsafe=True)
    assert "srcStageMask: [COLOR_ATTACHMENT_OUTPUT, FRAGMENT_SHADER]" in done.text
    assert done.text.count("srcSubpass: EXTERNAL") == 1


@pytest.mark.parametrize(
    ("barriers", "reason"),
    [
        ({"before": PREPARED}, "a barrier prepares the image that is resolved to before the pass"),
        (
            {"between": SAMPLES.replace("images: [", "images: [other, ")},
            "a barrier between the pass and the resolve concerns other images as well",
        ),
        (
            {"after": RESOLVED.replace("images: [", "images: [other, ")},
            "a barrier behind the resolve concerns other images as well",
        ),
    ],
)
def test_barriers_that_do_more_keep_the_command(barriers: dict[str, str], reason: str) -> None:
    text = frame(**barriers)
    done = fix_findings(text, unsafe=True)
    assert (done.text, [failed.reason for failed in done.failed_fixes]) == (text, [reason])


def test_dynamic_rendering_has_no_dependencies() -> None:
    attachment = (
        "{image: color_ms, imageLayout: COLOR_ATTACHMENT_OPTIMAL, loadOp: CLEAR, storeOp: STORE}"
    )
    begin = f"  - beginRendering: {{colorAttachments: [{attachment}]}}\n"
    begun = "  - beginRenderPass: {renderPass: scene}\n  - endRenderPass\n"
    text = frame(between=PREPARED, after=RESOLVED).replace(begun, begin + "  - endRendering\n")
    done = fix_findings(text, unsafe=True)
    assert [failed.reason for failed in done.failed_fixes] == [
        "a barrier prepares the image that is resolved to, and vkCmdBeginRendering has no "
        "dependencies"
    ]
    kept = fix_findings(text.replace(PREPARED, SAMPLES), unsafe=True)
    assert "resolveImage: {" not in kept.text and "resolveImage: color" in kept.text

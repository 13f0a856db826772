"""How long contents live: who reads what a pass stored, what ends it, and which one rule says so.

A line of carets under a line of input marks what must be found there, and nothing else of `WATCHED`
may be found.
"""

from __future__ import annotations

from collections import Counter

import pytest

from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from tests.linter.lifetimes import watched as given_frames

WATCHED = {f"MSAA{number}" for number in (201, 202, 203, 204, 205, 206, 207, 210, 215, 602)}


def lint(text: str, **values: str) -> FileResult:
    """Lints a text, in which `$name` stands for a value."""
    return given_frames.lint(given_frames.given_text(text, **values))


def check(text: str, **values: str) -> FileResult:
    """As `watched.check`, of the watched rules; `$name` stands for a value."""
    return given_frames.check(given_frames.given_text(text, **values), WATCHED)


def undecided(linted: FileResult) -> set[tuple[str, str]]:
    return {(each.code, each.subject) for each in linted.undecided if each.code in WATCHED}


def message(linted: FileResult, code: str) -> str:
    (found,) = [finding for finding in linted.findings if finding.code == code]
    return found.message


# With commands: they are the order, and only they read.


def test_only_commands_read_where_there_are_commands() -> None:
    linted = check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, SAMPLED, TRANSFER_SRC, STORAGE]}
      other: {format: R8G8B8A8_UNORM, samples: 4}
    renderPasses:
      scene:
        attachments:
          color: {image: ms, loadOp: CLEAR, storeOp: STORE}
    #                                                ^^^^^ MSAA201 warning high
        subpasses:
          - {colorAttachments: [color]}
    commands:
      - beginRenderPass: {renderPass: scene}
      - endRenderPass
      - readImage: {image: other, stage: FRAGMENT}
      - copyImage: {srcImage: other, dstImage: ms}
    """)
    assert (
        message(linted, "MSAA201")
        == "`color` stores 4x samples that nothing reads; set storeOp to DONT_CARE"
    )


# The pass itself, in the next frame.


@pytest.mark.parametrize(
    "commands", ["", "commands: [{beginRenderPass: {renderPass: grow}}, endRenderPass]"]
)
@pytest.mark.parametrize("image", ["image: ms", "format: R8G8B8A8_UNORM, samples: 4"])
def test_a_pass_that_loads_what_it_stored_is_its_own_reader(commands: str, image: str) -> None:
    """201 is silent, 202 says what it costs; so it is for an attachment that names no image."""
    linted = check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
    renderPasses:
      grow:
        attachments:
          color: {loadOp: LOAD, storeOp: STORE, $image}
    #                     ^^^^ MSAA202 warning high
        subpasses:
          - {colorAttachments: [color]}
    $commands
    """,
        image=image,
        commands=commands,
    )
    assert (
        message(linted, "MSAA202")
        == "`color` loads the 4x samples that it stored in the previous frame; clear them, or "
        "continue from the resolved image"
    )


def test_another_pass_between_ends_the_loop() -> None:
    """The load then reads what the other pass left, and what this one stored nobody."""
    linted = check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - beginRendering: {colorAttachments: [{image: ms, loadOp: LOAD, storeOp: STORE}]}
    #                                                           ^^^^ MSAA202
    #                                                                          ^^^^^ MSAA201
      - endRendering
    """)
    assert (
        message(linted, "MSAA202")
        == "`ms` loads 4x samples from memory; clear them, or draw in the pass that stored them"
    )
    (found,) = [finding for finding in linted.findings if finding.code == "MSAA202"]
    (label,) = [label for label in found.labels if label.text == "stored here"]
    assert linted.source is not None
    assert linted.source.position(label.span.start) == (4, 77)


def test_a_load_shows_no_store_that_something_overwrote() -> None:
    linted = check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - writeImage: {image: ms, stage: COMPUTE}
      - beginRendering: {colorAttachments: [{image: ms, loadOp: LOAD, storeOp: DONT_CARE}]}
    #                                                           ^^^^ MSAA202
    #                                                                          ^^^^^^^^^ MSAA207
      - endRendering
    """)
    assert [
        label.text for found in linted.findings if found.code == "MSAA202" for label in found.labels
    ] == ["4 samples"]


def test_stencil_that_is_loaded_and_stored_for_nobody_is_one_finding_at_the_load() -> None:
    linted = check("""
    images:
      both_ms: {format: D24_UNORM_S8_UINT, samples: 4}
    commands:
      - beginRendering: {stencilAttachment: {image: both_ms, loadOp: CLEAR, storeOp: STORE}}
      - endRendering
      - beginRendering: {stencilAttachment: {image: both_ms, loadOp: LOAD, storeOp: STORE}}
    #                                                                ^^^^ MSAA204
      - endRendering
    """)
    assert (
        message(linted, "MSAA204")
        == "the stencil of `both_ms` loads 4x samples, and stores them although nothing reads "
        "them; draw in the pass that stored them, "
        "and set stencilStoreOp to DONT_CARE"
    )


@pytest.mark.parametrize("image", ["image: ms", "format: R8G8B8A8_UNORM, samples: 4"])
@pytest.mark.parametrize("resolved", [True, False])
def test_unknown_readers(image: str, resolved: bool) -> None:
    """Neither usage nor commands: colour fires with medium confidence where the pass resolves it,
    and is undecided where not.
    """
    linted = check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    renderPasses:
      scene:
        attachments:
          color: {loadOp: CLEAR, storeOp: STORE, $image}
    $mark
          output: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color], resolveAttachments: [$target]}
    """,
        image=image,
        mark="#                                     ^^^^^ MSAA201 warning medium"
        if resolved
        else "",
        target="output" if resolved else "null",
    )
    subject = ("MSAA201", "renderPasses.scene.attachments.color")
    assert (subject in undecided(linted)) is not resolved
    if resolved:
        assert message(linted, "MSAA201").endswith(
            "unless something else reads them, set storeOp to DONT_CARE"
        )


# Framebuffers that alternate.


def test_a_resolve_in_the_pass_is_not_a_reader() -> None:
    linted = check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
      depth_ms: {format: D32_SFLOAT, samples: 4}
      single: {format: R8G8B8A8_UNORM, samples: 1}
      depth: {format: D32_SFLOAT, samples: 1}
    commands:
      - beginRendering:
          colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE, resolveMode: AVERAGE, resolveImage: single}]
    #                                                            ^^^^^ MSAA201 warning high
          depthAttachment: {image: depth_ms, loadOp: CLEAR, storeOp: STORE, resolveMode: SAMPLE_ZERO, resolveImage: depth}
    #                                                                ^^^^^ MSAA203 warning high
      - endRendering
      - readImage: {image: single, stage: FRAGMENT}
      - readImage: {image: depth, stage: FRAGMENT}
    """)
    assert linted.source is not None
    text = linted.source.text
    labels = {
        (found.code, text[label.span.start : label.span.end])
        for found in linted.findings
        for label in found.labels
    }
    assert {("MSAA201", "single"), ("MSAA203", "depth")} <= labels


def test_a_resolve_mode_of_none_is_no_resolve() -> None:
    linted = check("""
    renderPasses:
      scene:
        attachments:
          both: {format: D24_UNORM_S8_UINT, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE}
          out: {format: D24_UNORM_S8_UINT, samples: 1, loadOp: LOAD, storeOp: STORE, stencilLoadOp: LOAD, stencilStoreOp: DONT_CARE}
    #                                                          ^^^^ MSAA205
        subpasses:
          - depthStencilAttachment: both
            depthStencilResolve: {attachment: out, depthResolveMode: SAMPLE_ZERO, stencilResolveMode: NONE}
    """)
    assert (
        message(linted, "MSAA205")
        == "the depth of `out` is loaded, but a resolve overwrites all of it; set the load "
        "operation to DONT_CARE"
    )


def test_a_load_from_undefined_stands_in_for_the_readback() -> None:
    linted = check("""
    renderPasses:
      ui:
        attachments:
          color: {format: R8G8B8A8_UNORM, samples: 1, loadOp: LOAD, storeOp: STORE, initialLayout: UNDEFINED}
    #                                                         ^^^^ MSAA210 error high
          both:
            format: D24_UNORM_S8_UINT
            samples: 1
            loadOp: LOAD
    #               ^^^^ MSAA215 note high
            storeOp: STORE
            stencilLoadOp: LOAD
    #                      ^^^^ MSAA210 error high
            stencilStoreOp: STORE
            initialLayout: DEPTH_ATTACHMENT_OPTIMAL
            stencilInitialLayout: UNDEFINED
        subpasses:
          - {colorAttachments: [color], depthStencilAttachment: both}
    """)
    notes = [found.notes for found in linted.findings if found.code == "MSAA210"]
    assert notes == [("covers framebuffer-readback (MSAA215) too",)] * 2


# Dependencies between frames.


# Hostile input.


@pytest.mark.parametrize(("begins", "followed"), [(1, True), (700, False)])
def test_more_uses_than_are_followed_leave_readers_unknown(begins: int, followed: bool) -> None:
    """Attachments times begins grow faster than the input does: beyond a limit nothing is claimed,
    and a finding says so.
    """
    attachments = 100
    text = (
        "images: {ms: {format: R8G8B8A8_UNORM, samples: 4}}\nrenderPasses:\n  scene:\n    "
        "attachments:\n"
    )
    text += "      - {image: ms, loadOp: CLEAR, storeOp: STORE}\n" * attachments
    text += f"    subpasses: [{{colorAttachments: {list(range(attachments))}}}]\ncommands:\n"
    text += "  - beginRenderPass: {renderPass: scene}\n  - endRenderPass\n" * begins
    linted = given_frames.ENGINE.lint(
        text.encode(), "frame.yaml", LintOptions(given_frames.as_written)
    )
    codes = Counter(found.code for found in linted.findings)
    assert codes == ({"MSAA201": attachments} if followed else {"MSAA906": 1})
    assert (("MSAA201", "renderPasses.scene.attachments[0]") in undecided(linted)) is not followed
    if not followed:
        assert linted.findings[0].message.startswith("limit exceeded: passes use images 1")

"""What becomes of a resolve: who reads it, who waits for it, what is done twice; depth that is read
unresolved; images that take turns.

A line of carets under a line of input marks what must be found there, and nothing else of `WATCHED`
may be found.
"""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.finding import Finding
from msaa_lint.frame.facts.event_search import MIN_STEPS, STEPS_PER_STRUCTURE
from msaa_lint.linter.fixes.fixer import fix_text
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from tests.linter.lifetimes import watched as given_frames
from tests.linter.lifetimes.watched import ENGINE, as_written, given_text, lint
from tests.strength import examples

WATCHED = {"MSAA307", "MSAA308", "MSAA315", "MSAA317", "MSAA406", "MSAA601"}


def check(text: str, **values: str) -> FileResult:
    """As `watched.check`, of the watched rules; `$name` stands for a value."""
    return given_frames.check(given_text(text, **values), WATCHED)


def watched(linted: FileResult) -> list[Finding]:
    return given_frames.watched(linted, WATCHED)


def one(linted: FileResult, code: str) -> Finding:
    (found,) = [finding for finding in linted.findings if finding.code == code]
    return found


def undecided(linted: FileResult) -> set[tuple[str, str]]:
    return {(each.code, each.subject) for each in linted.undecided if each.code in WATCHED}


def fixed(text: str, code: str) -> str:
    """The text with the fixes of one rule made, the unsafe ones too; no finding of the rule is
    left.
    """
    done = fix_text(lint(text), lambda other: lint(other), True, lambda found: found.code == code)
    assert [found.code for found in done.fixed_findings] == [code]
    assert code not in {found.code for found in done.result.findings}
    return done.text


# 601: who waits for a resolve.

READ_AFTER = """
    images:
      depth_ms: {format: D32_SFLOAT, samples: 4}
      depth: {format: D32_SFLOAT, samples: 1}
      other: {format: D32_SFLOAT, samples: 1}
    commands:
      - beginRendering: {depthAttachment: {image: depth_ms, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: MIN, resolveImage: depth}}
      - endRendering
      $barriers
      - readImage: {image: depth, stage: $stage}
    """


def barrier(
    stages: str, into: str = "FRAGMENT_SHADER", access: str = "MEMORY_WRITE", images: str = "depth"
) -> str:
    masks = (
        f"srcStageMask: [{stages}], srcAccessMask: [{access}], dstStageMask: [{into}], "
        "dstAccessMask: [SHADER_READ]"
    )
    return f"- pipelineBarrier: {{{masks}, images: [{images}]}}"


def waits(*barriers: str, stage: str = "FRAGMENT") -> bool | None:
    """Whether what orders a reader after a resolve waits for it, as the rule has it; None where it
    does not say.
    """
    linted = lint(given_text(READ_AFTER, barriers="\n      ".join(barriers), stage=stage))
    if "MSAA601" in {found.code for found in linted.findings}:
        return False
    return None if "MSAA601" in {each.code for each in linted.undecided} else True


@pytest.mark.parametrize(
    ("stages", "answer"),
    [
        ("COLOR_ATTACHMENT_OUTPUT", True),
        ("VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT", True),
        ("VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT", True),
        ("LATE_FRAGMENT_TESTS, COLOR_ATTACHMENT_OUTPUT", True),
        ("ALL_GRAPHICS", True),
        ("ALL_COMMANDS", True),
        # It waits for everything, and accesses nothing.
        ("BOTTOM_OF_PIPE", False),
        ("LATE_FRAGMENT_TESTS", False),
        (
            "VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT, "
            "VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT",
            False,
        ),
        ("FRAGMENT_SHADER", False),
        ("TOP_OF_PIPE", False),
        ("TRANSFER", False),
        ("NONE", False),
        ("", False),
    ],
)
def test_which_stages_wait_for_a_resolve_of_depth(stages: str, answer: bool) -> None:
    assert waits(barrier(stages)) is answer


PASSES = """
    images:
      depth_ms: {format: D32_SFLOAT, samples: 4}
      depth: {format: D32_SFLOAT, samples: 1}
      depth_b: {format: D32_SFLOAT, samples: 1}
      color: {format: R8G8B8A8_UNORM, samples: 1}
    renderPasses:
      first:
        attachments:
          depth_ms: {image: depth_ms, loadOp: CLEAR, storeOp: DONT_CARE}
          depth: {image: depth, loadOp: DONT_CARE, storeOp: STORE}
        subpasses:
          - depthStencilAttachment: depth_ms
            depthStencilResolve: {attachment: depth, depthResolveMode: SAMPLE_ZERO, stencilResolveMode: NONE}
        dependencies: [$out]
      second:
        attachments:
          color: {image: color, loadOp: DONT_CARE, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color]}
        dependencies: [$into]
    framebuffers:
      $buffers
    commands:
      - beginRenderPass: {renderPass: first$named}
      - endRenderPass
      - beginRenderPass: {renderPass: second}
      - readImage: {image: depth, stage: FRAGMENT}
      - endRenderPass
    """


def dependency(
    src: str, dst: str, stages: str, into: str = "FRAGMENT_SHADER", access: str = "MEMORY_WRITE"
) -> str:
    masks = (
        f"srcStageMask: [{stages}], dstStageMask: [{into}], srcAccessMask: [{access}], "
        "dstAccessMask: [SHADER_READ]"
    )
    return f"{{srcSubpass: {src}, dstSubpass: {dst}, {masks}}}"


@pytest.mark.parametrize("named", ["", ", framebuffer: [one, two]"])
@pytest.mark.parametrize(
    ("out", "into", "answer"),
    [
        ("", "", None),
        (dependency("0", "EXTERNAL", "LATE_FRAGMENT_TESTS"), "", False),
        (dependency("0", "EXTERNAL", "COLOR_ATTACHMENT_OUTPUT"), "", True),
        (
            dependency(
                "0", "EXTERNAL", "COLOR_ATTACHMENT_OUTPUT", access="DEPTH_STENCIL_ATTACHMENT_WRITE"
            ),
            "",
            False,
        ),
        ("", dependency("EXTERNAL", "0", "LATE_FRAGMENT_TESTS"), False),
        (
            "",
            dependency("EXTERNAL", "0", "COLOR_ATTACHMENT_OUTPUT", access="COLOR_ATTACHMENT_WRITE"),
            True,
        ),
        (
            dependency("0", "EXTERNAL", "LATE_FRAGMENT_TESTS"),
            dependency("EXTERNAL", "0", "ALL_GRAPHICS"),
            True,
        ),
        # For what the reading pass draws to: it holds back no shader.
        (
            dependency("0", "EXTERNAL", "LATE_FRAGMENT_TESTS"),
            dependency(
                "EXTERNAL",
                "0",
                "COLOR_ATTACHMENT_OUTPUT",
                "COLOR_ATTACHMENT_OUTPUT",
                "COLOR_ATTACHMENT_WRITE",
            ),
            False,
        ),
        (
            "",
            dependency(
                "EXTERNAL",
                "0",
                "COLOR_ATTACHMENT_OUTPUT",
                "COLOR_ATTACHMENT_OUTPUT",
                "COLOR_ATTACHMENT_WRITE",
            ),
            None,
        ),
        # For what the first pass waits for itself.
        (dependency("EXTERNAL", "0", "LATE_FRAGMENT_TESTS"), "", None),
    ],
)
def test_dependencies_of_both_passes(out: str, into: str, answer: bool | None, named: str) -> None:
    """By one framebuffer, and by two that alternate."""
    buffers = "\n      ".join(
        (
            "one: {renderPass: first, attachments: [depth_ms, depth]}",
            "two: {renderPass: first, attachments: [depth_ms, depth_b]}" if named else "",
        )
    )
    linted = lint(given_text(PASSES, out=out, into=into, buffers=buffers, named=named))
    codes = {found.code for found in linted.findings}
    unknown = ("MSAA601", "renderPasses.first.subpasses[0].depthStencilResolve") in undecided(
        linted
    )
    assert ("MSAA601" in codes, unknown) == (answer is False, answer is None)


def test_within_a_pass_nothing_else_can_order_them() -> None:
    """Without commands too. The dependency between the two subpasses counts, not one into another
    subpass.
    """
    linted = check("""
    renderPasses:
      main:
        attachments:
          depth_ms: {format: D32_SFLOAT, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
          depth: {image: depth, loadOp: DONT_CARE, storeOp: DONT_CARE}
        subpasses:
          - depthStencilAttachment: depth_ms
            depthStencilResolve: {attachment: depth, depthResolveMode: SAMPLE_ZERO, stencilResolveMode: NONE}
          - {}
          - {inputAttachments: [depth]}
        dependencies:
          - {srcSubpass: 1, dstSubpass: 2, srcStageMask: [LATE_FRAGMENT_TESTS], dstStageMask: [FRAGMENT_SHADER]}
          - srcSubpass: 0
            dstSubpass: 2
            srcStageMask: [LATE_FRAGMENT_TESTS]
    #                     ^^^^^^^^^^^^^^^^^^^^^ MSAA601 error high
            srcAccessMask: [DEPTH_STENCIL_ATTACHMENT_WRITE]
            dstStageMask: [FRAGMENT_SHADER]
            dstAccessMask: [INPUT_ATTACHMENT_READ]
    images:
      depth: {format: D32_SFLOAT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT, INPUT_ATTACHMENT]}
    """)
    found = one(linted, "MSAA601")
    assert found.message == (
        "`depth` is read after waiting for LATE_FRAGMENT_TESTS, but its resolve runs in "
        "COLOR_ATTACHMENT_OUTPUT; "
        "add COLOR_ATTACHMENT_OUTPUT to srcStageMask"
    )
    assert [label.text for label in found.labels] == ["resolved here"]


def test_a_wait_is_mended_and_nothing_else() -> None:
    text = given_text(
        READ_AFTER,
        barriers=barrier("LATE_FRAGMENT_TESTS", access="DEPTH_STENCIL_ATTACHMENT_WRITE"),
        stage="FRAGMENT",
    )
    after = fixed(text, "MSAA601")
    assert after == text.replace(
        "[LATE_FRAGMENT_TESTS]", "[LATE_FRAGMENT_TESTS, COLOR_ATTACHMENT_OUTPUT]"
    ).replace(
        "[DEPTH_STENCIL_ATTACHMENT_WRITE]",
        "[DEPTH_STENCIL_ATTACHMENT_WRITE, COLOR_ATTACHMENT_WRITE]",
    )


STAGES = [
    "COLOR_ATTACHMENT_OUTPUT",
    "LATE_FRAGMENT_TESTS",
    "FRAGMENT_SHADER",
    "TRANSFER",
    "COMPUTE_SHADER",
    "ALL_COMMANDS",
    "TOP_OF_PIPE",
]
BARRIERS = st.lists(
    st.builds(
        lambda source, target, images: barrier(
            ", ".join(source), ", ".join(target), "MEMORY_WRITE", images
        ),
        st.lists(st.sampled_from(STAGES), min_size=1, max_size=2),
        st.lists(st.sampled_from(STAGES), min_size=1, max_size=2),
        st.sampled_from(["depth", "", "other"]),
    ),
    max_size=4,
)


@examples(0.8)
@given(BARRIERS, BARRIERS)
def test_one_more_wait_for_all_commands_is_enough(before: list[str], after: list[str]) -> None:
    """Wherever it stands, and whatever else is waited for."""
    assert waits(*before, barrier("ALL_COMMANDS", "ALL_COMMANDS"), *after) is True


@examples(0.8)
@given(BARRIERS)
def test_waits_without_the_stage_are_never_enough(barriers: list[str]) -> None:
    without = [
        re.sub("COLOR_ATTACHMENT_OUTPUT|ALL_COMMANDS", "EARLY_FRAGMENT_TESTS", each)
        for each in barriers
    ]
    meant = any("images: [depth]" in each for each in without)
    answer = waits(*without)
    assert answer is False if meant else answer in (None, False)


BOTH = """
    device: {name: any, independentResolve: $alone, independentResolveNone: $alone}
    images:
      ms: {format: D24_UNORM_S8_UINT, samples: 4}
      ds: {format: D24_UNORM_S8_UINT, samples: 1}
    renderPasses:
      first:
        attachments:
          ms: {image: ms, loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE}
          ds: {image: ds, loadOp: DONT_CARE, storeOp: STORE, stencilLoadOp: DONT_CARE, stencilStoreOp: STORE}
        subpasses:
          - depthStencilAttachment: ms
            depthStencilResolve:
              attachment: ds
              depthResolveMode: SAMPLE_ZERO
    $depth
              stencilResolveMode: SAMPLE_ZERO
    $stencil
      second:
        attachments:
          ds: {image: ds, loadOp: $load, storeOp: DONT_CARE, stencilLoadOp: DONT_CARE, stencilStoreOp: DONT_CARE}
        subpasses:
          - {depthStencilAttachment: ds}
    commands:
      - beginRenderPass: {renderPass: first}
      - endRenderPass
      - beginRenderPass: {renderPass: second}
      - endRenderPass
    """


def test_one_of_two_aspects_is_left_out() -> None:
    text = given_text(BOTH, alone="true", load="LOAD", depth="", stencil="")
    assert fixed(text, "MSAA308") == text.replace(
        "stencilResolveMode: SAMPLE_ZERO", "stencilResolveMode: NONE"
    ).replace("stencilStoreOp: STORE", "stencilStoreOp: DONT_CARE")


def test_an_unread_depth_resolve_costs_its_write() -> None:
    linted = lint(
        given_text(
            """
    frame: {width: 1920, height: 1080, fps: 60}
    images:
      depth_ms: {format: D32_SFLOAT, samples: 4}
      depth: {format: D32_SFLOAT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT]}
    commands:
      - beginRendering: {depthAttachment: {image: depth_ms, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: MIN, resolveImage: depth}}
      - endRendering
    """
        ),
        prices=True,
    )
    found = one(linted, "MSAA308")
    assert (found.confidence, found.fix and found.fix.safe) == ("high", True)
    assert found.price == pytest.approx((0.0, 1920 * 1080 * 4 * 60 / 1e6, 0.0, 49.7664))


def test_what_takes_too_long_to_find_out_stays_undecided() -> None:
    """Resolves to one layer each of an image: who reads which is looked for through the whole
    frame, each time.
    """
    rendering = (
        "{image: ms, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: MIN, resolveImage: depth}"
    )
    passes = f"  - beginRendering: {{depthAttachment: {rendering}}}\n  - endRendering\n" * 700
    images = (
        "images:\n  ms: {format: D32_SFLOAT, samples: 4}\n  depth: {format: D32_SFLOAT, "
        "samples: 1, arrayLayers: 700}\n"
    )
    linted = ENGINE.lint(
        f"{images}commands:\n{passes}".encode(), "frame.yaml", LintOptions(as_written)
    )
    decided = sum(found.code == "MSAA308" for found in linted.findings)
    left = sum(each.code == "MSAA308" for each in linted.undecided)
    assert decided + left == 700
    # 700 passes of an attachment and a subpass with an attachment and a resolve, and 1400 commands.
    assert 0 < decided <= (MIN_STEPS + STEPS_PER_STRUCTURE * (700 * 4 + 1400)) // 700
    assert [found.message for found in linted.findings if found.code == "MSAA906"] == [
        "limit exceeded: the uses of images follow each other at too great distances; "
        "some rules about what becomes of resolves are undecided"
    ]


# 308 and 317 against a frame that is played: what a resolve wrote is a token, which readers mark.

STEPS = ["clear and resolve", "load and resolve", "load", "read", "clear target"]


def played(steps: list[str]) -> tuple[set[int], set[int]]:
    """The steps whose result nothing reads, in a loop; those that a later one repeats with more
    drawn, unread in between, to be read.
    """
    written: dict[int, bool] = {}
    target: tuple[int, int] | None = None
    read: set[tuple[int, int]] = set()
    for turn in range(3):
        for number, step in enumerate(steps):
            if "resolve" in step:
                target = (turn, number)
                written[number] = True
            elif step == "read" and target is not None:
                read.add(target)
            elif step == "clear target":
                target = None
    unread = {number for number in written if (1, number) not in read}
    anew = set()
    for number in unread:
        for later in range(number + 1, len(steps)):
            if steps[later] == "clear and resolve":
                break
            if steps[later] == "load and resolve":
                anew.update([number] if later not in unread else ())
                break
    return unread, anew


@examples(1.5)
@given(st.lists(st.sampled_from(STEPS), min_size=1, max_size=7))
def test_what_nothing_reads_is_what_nothing_read_when_the_frame_was_played(
    steps: list[str],
) -> None:
    lines, places = [], {}
    for number, step in enumerate(steps):
        if step == "read":
            lines.append("- readImage: {image: depth, stage: COMPUTE}")
        elif step == "clear target":
            lines.append("- clearDepthStencilImage: {image: depth}")
        else:
            load_op = "CLEAR" if "clear" in step else "LOAD"
            resolve = ", resolveMode: MIN, resolveImage: depth" if "resolve" in step else ""
            places[f"commands[{len(lines)}]"] = number
            lines.append(
                f"- beginRendering: {{depthAttachment: {{image: ms, loadOp: {load_op}, storeOp: "
                f"STORE{resolve}}}}}"
            )
            lines.append("- endRendering")
    images = (
        "images:\n  ms: {format: D32_SFLOAT, samples: 4}\n  depth: {format: D32_SFLOAT, "
        "samples: 1}\n"
    )
    linted = lint(images + "commands:\n" + "".join(f"  {line}\n" for line in lines))
    found = {
        (each.code, places[re.match(r"commands\[\d+\]", each.subject)[0]])
        for each in watched(linted)
    }  # type: ignore[index]
    unread, anew = played(steps)
    # Of two rules that blame the same resolve, the more specific one is told.
    assert {number for code, number in found if code == "MSAA317"} == anew
    assert {number for code, number in found if code == "MSAA308"} == unread - anew


def test_with_nothing_drawn_between() -> None:
    linted = check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
      one: {format: R8G8B8A8_UNORM, samples: 1}
      two: {format: R8G8B8A8_UNORM, samples: 1}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE, resolveMode: AVERAGE, resolveImage: one}]}
      - endRendering
      - resolveImage: {srcImage: ms, dstImage: two}
    #   ^^^^^^^^^^^^ MSAA317 warning medium
      - readImage: {image: one, stage: FRAGMENT}
      - readImage: {image: two, stage: FRAGMENT}
    """)
    found = one(linted, "MSAA317")
    assert (
        found.message
        == "`ms` is resolved again, to `two`, although nothing was drawn to it since the first "
        "resolve; resolve once"
    )
    assert found.fix is not None and found.fix.shown
    (label,) = found.labels
    assert linted.source is not None and linted.source.position(label.span.start).line == 6


def test_a_slot_of_a_subpass_is_emptied() -> None:
    text = given_text("""
    images:
      a: {format: R8G8B8A8_UNORM, samples: 4}
      b: {format: R8G8B8A8_UNORM, samples: 4}
      one: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT]}
      two: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED]}
    renderPasses:
      scene:
        attachments:
          - {image: a, loadOp: CLEAR, storeOp: STORE}
          - {image: b, loadOp: CLEAR, storeOp: STORE}
          - {image: one, loadOp: DONT_CARE, storeOp: STORE}
          - {image: two, loadOp: DONT_CARE, storeOp: STORE}
        subpasses:
          - {colorAttachments: [0, 1], resolveAttachments: [2, 3]}
      more:
        attachments:
          - {image: a, loadOp: LOAD, storeOp: DONT_CARE}
          - {image: two, loadOp: DONT_CARE, storeOp: STORE}
        subpasses:
          - {colorAttachments: [0], resolveAttachments: [1]}
    commands:
      - beginRenderPass: {renderPass: scene}
      - endRenderPass
      - readImage: {image: two, stage: FRAGMENT}
      - beginRenderPass: {renderPass: more}
      - endRenderPass
      - readImage: {image: two, stage: FRAGMENT}
      - readImage: {image: b, stage: FRAGMENT, samples: ALL}
    """)
    assert fixed(text, "MSAA317") == text.replace(
        "resolveAttachments: [2, 3]", "resolveAttachments: [null, 3]"
    ).replace(
        "{image: one, loadOp: DONT_CARE, storeOp: STORE}",
        "{image: one, loadOp: DONT_CARE, storeOp: DONT_CARE}",
    )


# 315: a picture that is only copied on.

COPIED = """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
      color: {format: $from, samples: 1$from_size}
      back: {format: $to, samples: 1, presentable: true$to_size}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: AVERAGE, resolveImage: color}]}
    $mark
      - endRendering
      $before
      - $command: {srcImage: color, dstImage: back}
      $after
      - present: {image: back}
      $then
    """
COLOR_MARK = "#" + " " * 122 + "^^^^^ MSAA315"


def copied(mark: str = "", **values: str) -> FileResult:
    size = ", extent: {width: 64, height: 64}"
    given = {
        "from": "R8G8B8A8_UNORM",
        "to": "R8G8B8A8_UNORM",
        "from_size": size,
        "to_size": size,
        "command": "copyImage",
    }
    empty = dict.fromkeys(("before", "after", "then"), "")
    return check(
        COPIED, **{**given, **empty, **values, "mark": f"{COLOR_MARK}{mark}" if mark else ""}
    )


@pytest.mark.parametrize("command", ["copyImage", "blitImage"])
def test_same_format_and_size(command: str) -> None:
    linted = copied(" warning high", command=command)
    assert (
        one(linted, "MSAA315").message
        == "`ms` is resolved to `color` only to be copied to `back`; resolve to `back` directly"
    )


@pytest.mark.parametrize(
    "change",
    [
        {
            "before": "- beginRendering: {colorAttachments: [{image: color, loadOp: LOAD, storeOp: "
            "STORE}]}\n      - endRendering"
        },
        {"before": "- writeImage: {image: color, stage: COMPUTE}"},
        {"before": "- readImage: {image: color, stage: FRAGMENT}"},
        {"after": "- readImage: {image: color, stage: FRAGMENT}"},
        {"then": "- readImage: {image: color, stage: FRAGMENT}"},
        {"then": "- copyImageToBuffer: {srcImage: color}"},
        {"before": "- clearColorImage: {image: back}"},
        {"before": "- blitImage: {srcImage: ms, dstImage: back}"},
        {"after": "- copyImage: {srcImage: ms, dstImage: back}"},
        {"from_size": ", arrayLayers: 2", "to_size": ""},
    ],
)
def test_a_picture_that_is_used_otherwise_is_no_detour(change: dict[str, str]) -> None:
    copied(**change)


def test_the_copy_costs_its_read_and_write() -> None:
    text = given_text("""
    frame: {width: 1920, height: 1080, fps: 60}
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, extent: {width: 1920, height: 1080}}
      color: {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 1920, height: 1080}}
      back: {format: R8G8B8A8_UNORM, samples: 1, usage: [TRANSFER_DST], presentable: true, extent: {width: 1920, height: 1080}}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: AVERAGE, resolveImage: color}]}
      - endRendering
      - copyImage: {srcImage: color, dstImage: back}
      - present: {image: back}
    """)
    found = one(lint(text, prices=True), "MSAA315")
    assert found.price == pytest.approx((497.664, 497.664, 1920 * 1080 * 4 / 2**20, 99.5328))
    after = fixed(text, "MSAA315")
    assert "copyImage" not in after and "  color:" not in after
    assert "usage: [COLOR_ATTACHMENT]" in after and "resolveImage: back" in after


# 406: images that take turns.

TURNS = """
    images:
      ms_0: {format: R8G8B8A8_UNORM, samples: 4}
      ms_1: {format: R8G8B8A8_UNORM, samples: $count}
      back_0: {format: R8G8B8A8_UNORM, samples: 1, presentable: true}
      back_1: {format: R8G8B8A8_UNORM, samples: 1, presentable: true}
    renderPasses:
      scene:
        attachments:
          ms: {loadOp: $load, storeOp: DONT_CARE}
          back: {loadOp: DONT_CARE, storeOp: STORE}
        subpasses:
          - {colorAttachments: [ms], resolveAttachments: [back]}
    framebuffers:
      one: {renderPass: scene, attachments: [ms_0, back_0]}
      two: {renderPass: scene, attachments: [ms_1, back_1]}
    $commands
    """


def test_spare_images_cost_their_memory() -> None:
    commands = (
        "commands: [{beginRenderPass: {renderPass: scene, framebuffer: [one, two]}}, endRenderPass]"
    )
    text = "frame: {width: 1920, height: 1080, fps: 60}\n" + given_text(
        TURNS, commands=commands, load="CLEAR", count="4"
    )
    found = one(lint(text, prices=True), "MSAA406")
    assert found.price == pytest.approx((0.0, 0.0, 1920 * 1080 * 4 * 4 / 2**20, 0.0))
    after = fixed(text, "MSAA406")
    assert "ms_1" not in after
    assert "two: {renderPass: scene, attachments: [ms_0, back_1]}" in after


@examples(0.4)
@given(st.integers(2, 5), st.integers(1, 6))
def test_as_many_as_presentable_images_and_no_other_number(
    presentable: int, multisampled: int
) -> None:
    images = [f"  ms_{n}: {{format: R8G8B8A8_UNORM, samples: 4}}" for n in range(multisampled)]
    images += [
        f"  back_{n}: {{format: R8G8B8A8_UNORM, samples: 1, presentable: true}}"
        for n in range(presentable)
    ]
    rendered = (
        "{image: ms_0, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: AVERAGE, "
        "resolveImage: back_0}"
    )
    commands = [
        f"  - beginRendering: {{colorAttachments: [{rendered}]}}",
        "  - endRendering",
        "  - present: {image: back_0}",
    ]
    linted = lint("\n".join(["images:", *images, "commands:", *commands, ""]))
    assert ("MSAA406" in {each.code for each in linted.findings}) == (presentable == multisampled)


# 307: depth that a shader reads unresolved.

UNRESOLVED = """
    enabled: {apiVersion: "$version", extensions: []}
    images:
      depth_ms: {format: $format, samples: 4}
      color_ms: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {depthAttachment: {image: depth_ms, loadOp: CLEAR, storeOp: STORE}}
    $mark
      - endRendering
      $readers
    """
STORE_MARK = (
    "#                                                                               ^^^^^ MSAA307"
)


def unresolved(
    mark: str, *readers: str, version: str = "1.2", format: str = "D32_SFLOAT"
) -> FileResult:
    values = {
        "mark": f"{STORE_MARK}{mark}" if mark else "",
        "readers": "\n      ".join(readers),
        "version": version,
        "format": format,
    }
    return check(UNRESOLVED, **values)


READ_ONE, READ_ALL = (
    "- readImage: {image: depth_ms, samples: 1}",
    "- readImage: {image: depth_ms, samples: ALL}",
)

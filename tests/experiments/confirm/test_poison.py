"""What a frame makes undefined is overwritten: a wrong discard shows in pictures. A frame with
commands that Vulkan forbids is not confirmed.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from msaa_lint.experiments.confirm.inputs import inputs
from msaa_lint.experiments.confirm.outcome import CONFIRMED, DISAGREES, REFUSED, Verdict
from msaa_lint.experiments.confirm.scene import CLEARED, POISON
from msaa_lint.experiments.confirm.session import Session, environment
from msaa_lint.experiments.confirm.trial import TrialOptions, trial
from msaa_lint.linter.request import Request
from tests.command import run

SIZE = "extent: {width: 64, height: 32}"
READS = f"""\
images:
  a: {{format: FORMAT, samples: SAMPLES, USAGE {SIZE}}}
  o: {{format: R8G8B8A8_UNORM, samples: 1, presentable: false, {SIZE}}}
renderPasses:
  draws: {{attachments: {{a: {{image: a, loadOp: CLEAR, storeOp: STORE}}}}, subpasses: [{{ROLE}}]}}
  reads: {{attachments: {{o: {{image: o, loadOp: DONT_CARE, storeOp: STORE}}}}, subpasses: [{{colorAttachments: [o]}}]}}
commands:
  - beginRenderPass: {{renderPass: draws}}
  - endRenderPass
  - beginRenderPass: {{renderPass: reads}}
  - readImage: {{image: a, stage: FRAGMENT}}
  - endRenderPass
"""
LOADS = f"""\
images: {{a: {{format: R8G8B8A8_UNORM, samples: 4, USAGE {SIZE}}}, o: {{format: R8G8B8A8_UNORM, samples: 1, {SIZE}}}}}
renderPasses:
  draws: {{attachments: {{a: {{image: a, loadOp: CLEAR, storeOp: STORE}}}}, subpasses: [{{colorAttachments: [a]}}]}}
  resolves:
    attachments: {{a: {{image: a, loadOp: LOAD, storeOp: DONT_CARE, INITIAL}}, o: {{image: o, loadOp: DONT_CARE, storeOp: STORE}}}}
    subpasses: [{{colorAttachments: [a], resolveAttachments: [o]}}]
"""
TESTS = f"""\
images:
  d: {{format: D24_UNORM_S8_UINT, samples: 1, {SIZE}}}
  o: {{format: R8G8B8A8_UNORM, samples: 1, {SIZE}}}
renderPasses:
  depth:
    attachments: {{d: {{image: d, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STENCIL}}}}
    subpasses: [{{depthStencilAttachment: d}}]
  color:
    attachments:
      o: {{image: o, loadOp: CLEAR, storeOp: STORE}}
      d: {{image: d, loadOp: LOAD, storeOp: DONT_CARE, stencilLoadOp: DONT_CARE, stencilStoreOp: DONT_CARE}}
    subpasses: [{{colorAttachments: [o], depthStencilAttachment: d}}]
pipelines:
  p: {{renderPass: color, depthStencilState: {{depthTestEnable: true, depthWriteEnable: false, depthCompareOp: LESS_OR_EQUAL}}}}
"""
RENDERED = f"""\
images: {{a: {{format: R8G8B8A8_UNORM, samples: 4, {SIZE}}}, o: {{format: R8G8B8A8_UNORM, samples: 1, {SIZE}}}}}
commands:
  - beginRendering: {{colorAttachments: [{{image: a, loadOp: CLEAR, storeOp: STORE}}]}}
  - endRendering
  - BARRIER
  - resolveImage: {{srcImage: a, dstImage: o}}
"""
NOTHING = "pipelineBarrier: {srcStageMask: [ALL_COMMANDS], dstStageMask: [ALL_COMMANDS]}"
FORGETS = NOTHING[:-1] + ", images: [{image: a, oldLayout: UNDEFINED, newLayout: GENERAL}]}"


def fixed_as(tmp_path: Path, text: str, change: str) -> list[Verdict]:
    """The verdicts on a frame with another one in place of its fixed version."""
    (tmp_path / "a.msaa.yaml").write_text(text)
    (tmp_path / "b.msaa.yaml").write_text(change)
    as_written, fixed = inputs(Request(paths=[str(tmp_path)], isolated=True)).inputs
    with Session(None, environment=environment(None)) as session:
        made = trial(
            session, lambda: [as_written._replace(fixed=fixed.frame)], TrialOptions(time=False)
        )
    return list(made.verdicts)


def read(format: str = "R8G8B8A8_UNORM", samples: int = 1, usage: str = "") -> str:
    role = "colorAttachments: [a]" if "UNORM" in format else "depthStencilAttachment: a"
    return (
        READS.replace("FORMAT", format)
        .replace("SAMPLES", str(samples))
        .replace("ROLE", role)
        .replace("USAGE", usage)
    )


def loaded(usage: str = "", initial: str = "initialLayout: COLOR_ATTACHMENT_OPTIMAL") -> str:
    return LOADS.replace("USAGE", usage).replace("INITIAL", initial)


TESTED, TRANSIENT = (
    TESTS.replace("STENCIL}", "STORE}"),
    loaded("usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT],"),
)


def discard(text: str) -> str:
    return text.replace("loadOp: CLEAR, storeOp: STORE", "loadOp: CLEAR, storeOp: DONT_CARE", 1)


@pytest.mark.parametrize(
    ("text", "change", "equal"),
    [
        (read(), discard(read()), False),
        (read(samples=4), discard(read(samples=4)), False),
        (read("D32_SFLOAT"), discard(read("D32_SFLOAT")), False),
        (loaded(), discard(loaded()), False),
        (TRANSIENT, discard(TRANSIENT), False),
        (loaded(), loaded().replace("loadOp: LOAD", "loadOp: DONT_CARE"), False),
        (loaded(), loaded(initial="initialLayout: UNDEFINED"), False),
        (TESTED, TESTED.replace("storeOp: STORE, sten", "storeOp: DONT_CARE, sten"), False),
        # Nothing reads stencil, and depth stays.
        (TESTED, TESTS.replace("STENCIL}", "DONT_CARE}"), True),
        (RENDERED.replace("BARRIER", NOTHING), discard(RENDERED.replace("BARRIER", NOTHING)),
        False),
        (RENDERED.replace("BARRIER", NOTHING), RENDERED.replace("BARRIER", FORGETS), False),
        (read(), read(), True),
    ],
)  # fmt: skip
def test_a_wrong_discard_shows(tmp_path: Path, text: str, change: str, equal: bool) -> None:
    verdicts = fixed_as(tmp_path, text, change)
    assert {verdict.pixels_equal for verdict in verdicts} - {None} == {equal}, verdicts
    assert {verdict.status for verdict in verdicts} == (
        {CONFIRMED} if equal else {DISAGREES} | {v.status for v in verdicts}
    )
    different = {
        image.image for verdict in verdicts for image in verdict.images if image.equal is False
    }
    assert equal or "o" in different


SHOWN = f"""\
images: {{o: {{format: R8G8B8A8_UNORM, samples: 1, PRESENTABLE {SIZE}}}}}
renderPasses: {{p: {{attachments: {{o: {{image: o, loadOp: CLEAR, storeOp: STORE}}}}, subpasses: [{{colorAttachments: [o]}}]}}}}
commands: [{{beginRenderPass: {{renderPass: p}}}}, endRenderPass, THEN]
"""


@pytest.mark.parametrize(
    ("presentable", "then", "equal"),
    [
        ("presentable: true,", "{present: {image: o}}", False),
        ("", "{readImage: {image: o, stage: COMPUTE}}", False),
        ("", "{copyImageToBuffer: {srcImage: o}}", False),
        ("usage: [COLOR_ATTACHMENT, SAMPLED],", "{clearColorImage: {image: o}}", True),
        ("usage: [COLOR_ATTACHMENT, SAMPLED],", "endRenderPass", None),
    ],
)
def test_what_is_undefined_in_the_end_disagrees_unless_nothing_reads_it(
    tmp_path: Path, presentable: str, then: str, equal: bool | None
) -> None:
    text = (
        SHOWN.replace("PRESENTABLE", presentable)
        .replace("THEN", then)
        .replace(", endRenderPass, endRenderPass", ", endRenderPass")
    )
    (verdict,) = fixed_as(tmp_path, text, discard(text))
    assert verdict.pixels_equal is equal, verdict
    if equal is None:
        assert [image.text for image in verdict.images] == [
            "not compared: its contents are undefined in the fixed version, and nothing reads them"
        ]


def test_poison_is_no_color_of_the_scene() -> None:
    codes = [round(255 * value) for value in POISON]
    drawn = [{round(255 * k / steps) for k in range(steps + 1)} for steps in (7, 8, 10)]
    assert not any(code in each for code, each in zip(codes, drawn, strict=False))
    assert all(code != round(255 * cleared) for code, cleared in zip(codes, CLEARED, strict=True))


FORBIDDEN = f"""\
images:
  ms: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSFER_SRC], PRESENTABLE {SIZE}}}
  o: {{format: R8G8B8A8_UNORM, samples: 1, usage: [TRANSFER_DST, SAMPLED], {SIZE}}}
renderPasses:
  p: {{attachments: {{c: {{image: ms, loadOp: CLEAR, storeOp: STORE}}}}, subpasses: [{{colorAttachments: [c]}}]}}
commands: [{{beginRenderPass: {{renderPass: p}}}}, endRenderPass, {{COMMAND}}]
"""


@pytest.mark.parametrize(
    ("command", "said", "vuid"),
    [
        ("blitImage: {srcImage: ms, dstImage: o}", "blitImage of ms, which is multi",
        "VUID-vkCmdBlitImage-srcImage-00233"),
        ("copyImage: {srcImage: ms, dstImage: o}", "copyImage from ms to o, whose sample",
        "VUID-vkCmdCopyImage-srcImage-00136"),
        ("copyImageToBuffer: {srcImage: ms}", "copyImageToBuffer of ms, which is multisampled,",
        ""),
        ("present: {image: ms}", "present of ms, which is multisampled,", ""),
        ("presentable", "the presentable ms is multisampled, which is", ""),
    ],
)  # fmt: skip
def test_a_frame_with_a_forbidden_command_is_not_confirmed(
    tmp_path: Path, command: str, said: str, vuid: str
) -> None:
    text = FORBIDDEN.replace(
        "PRESENTABLE", "presentable: true," if command == "presentable" else ""
    )
    text = text.replace(", {COMMAND}", "" if command == "presentable" else f", {{{command}}}")
    (tmp_path / "frame.msaa.yaml").write_text(text)
    done = run(
        tmp_path, "confirm", "--isolated", "--no-cache", "--output", "json", "frame.msaa.yaml"
    )
    (found,) = json.loads(done.stdout)["passes"]
    assert found["status"] == REFUSED
    assert said in found["reason"]
    by_layer = {message["id"]: message["verdict"] for message in found["messages"]}
    assert not vuid or by_layer[vuid] == "both"

"""What frames of real programs contain besides mistakes: none of it may look like a disagreement
between the layer and the rules.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.command import run
from tests.paths import ROOT

IMAGES = """\
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, extent: {width: 64, height: 64}, usage: [COLOR_ATTACHMENT, TRANSFER_SRC, SAMPLED]}
  other_ms: {format: R8G8B8A8_UNORM, samples: 4, extent: {width: 64, height: 64}, usage: [COLOR_ATTACHMENT]}
  color: {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 64, height: 64}, usage: [COLOR_ATTACHMENT, SAMPLED, TRANSFER_DST]}
  texture:
    {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 64, height: 64}, mipLevels: 4,
     usage: [COLOR_ATTACHMENT, SAMPLED, TRANSFER_SRC, TRANSFER_DST]}
  wide: {format: R32G32B32A32_SFLOAT, samples: 1, extent: {width: 64, height: 64}, usage: [SAMPLED, TRANSFER_DST]}
"""

DYNAMIC = """\
pipelines:
  dynamic:
    multisampleState: {rasterizationSamples: 1}
    rendering: {colorAttachmentFormats: [R8G8B8A8_UNORM]}
    dynamicState: [VIEWPORT, SCISSOR, RASTERIZATION_SAMPLES_EXT, SAMPLE_MASK_EXT, ALPHA_TO_COVERAGE_ENABLE_EXT]
"""

RESOLVED = (
    "{image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: AVERAGE, "
    "resolveImage: texture}"
)
TEXTURE = "beginRendering: {colorAttachments: [{image: texture, loadOp: CLEAR, storeOp: STORE}]}"
COLOR = "beginRendering: {colorAttachments: [{image: color, loadOp: CLEAR, storeOp: STORE}]}"
DRAW = "draw: {pipeline: dynamic}"


def commands(*lines: str) -> str:
    return "commands:\n" + "".join(f"  - {line}\n" for line in lines)


def confirmed(folder: Path, text: str, code: int = 0) -> dict[str, Any]:
    """The report on a description. Its passes by name, unless something disagrees."""
    (folder / "frame.msaa.yaml").write_text(text)
    done = run(folder, "confirm", "--isolated", "--output", "json", "--no-time", "frame.msaa.yaml")
    assert done.stderr == ""
    report = json.loads(done.stdout)
    assert report["layer"] is not None, (
        "the validation layer is missing: apt install vulkan-validationlayers"
    )
    assert [
        (each["name"], each["status"], each["reason"])
        for each in report["passes"]
        if each["status"] != "confirmed"
    ] == []
    assert done.returncode == code
    assert report["agreement"]["theirs"] == 0
    return {each["name"]: each for each in report["passes"]}


def rows(found: dict[str, Any], id: str) -> list[tuple[str, str | None]]:
    """The verdicts on the messages of a pass with an id, and the rules that report the same."""
    return sorted(
        (each["verdict"], each["rule"])
        for each in found["messages"]
        if each["id"] and id in each["id"]
    )


STAGES = (
    "[GEOMETRY_SHADER, TESSELLATION_CONTROL_SHADER, TESSELLATION_EVALUATION_SHADER, "
    "TRANSFORM_FEEDBACK_EXT, FRAGMENT_SHADER]"
)


@pytest.mark.parametrize(
    "text",
    {
        "a pass that reads an image, with dynamic sample count, mask, and alpha to coverage": DYNAMIC
        + commands(
            COLOR,
            "endRendering",
            TEXTURE,
            "readImage: {image: color, stage: FRAGMENT}",
            "setRasterizationSamples: 1",
            DRAW,
        ),
        "a dynamic sample count that outlives the pass in which it was set": DYNAMIC
        + commands(
            f"beginRendering: {{colorAttachments: [{RESOLVED}]}}",
            "setRasterizationSamples: 4",
            DRAW,
            "endRendering",
            "beginRendering: {colorAttachments: [{image: other_ms, loadOp: CLEAR, storeOp: "
            "DONT_CARE}]}",
            DRAW,
        ),
        "the levels of a texture, by blits from each to the next": commands(
            TEXTURE,
            "endRendering",
            "blitImage: {srcImage: texture, dstImage: texture}",
            "copyImage: {srcImage: texture, dstImage: texture}",
        ),
        "a copy between formats of different sizes": commands(
            TEXTURE,
            "endRendering",
            "copyImage: {srcImage: texture, dstImage: wide}",
            "blitImage: {srcImage: texture, dstImage: wide}",
        ),
        "barriers for stages of features and extensions": commands(
            TEXTURE,
            "endRendering",
            f"pipelineBarrier: {{srcStageMask: {STAGES}, dstStageMask: {STAGES}, srcAccessMask: "
            "[SHADER_READ],"
            " dstAccessMask: [SHADER_READ, TRANSFORM_FEEDBACK_WRITE_EXT]}",
        ),
    }.items(),
    ids=lambda item: item[0],
)
def test_layer_reports_nothing_unexplained(text: tuple[str, str], tmp_path: Path) -> None:
    confirmed(tmp_path, IMAGES + text[1])


LEGACY = """\
renderPasses:
  first:
    attachments:
      color: {image: color, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}
    subpasses:
      - {colorAttachments: [color]}
  second:
    attachments:
      color_ms: {image: color_ms, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: TRANSFER_SRC_OPTIMAL}
    subpasses:
      - {colorAttachments: [color_ms]}
  third:
    attachments:
      other_ms: {image: other_ms, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      texture: {image: texture, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}
    subpasses:
      - {colorAttachments: [other_ms], resolveAttachments: [texture]}
"""

BARRIER = (
    "pipelineBarrier: {images: [{image: %s, oldLayout: UNDEFINED, newLayout: "
    "COLOR_ATTACHMENT_OPTIMAL}]}"
)


def begin(name: str) -> str:
    return f"beginRenderPass: {{renderPass: {name}}}"


NOT_TRANSIENT = "non-transient-ms-image"


def test_image_of_a_barrier_is_reported_with_the_pass_that_renders_to_it(tmp_path: Path) -> None:
    found = confirmed(
        tmp_path,
        IMAGES
        + LEGACY
        + commands(
            begin("first"), "endRenderPass", BARRIER % "other_ms", begin("third"), "endRenderPass"
        ),
    )
    assert rows(found["first"], NOT_TRANSIENT) == []
    assert ("both", "multisampled-image-not-transient") in rows(found["third"], NOT_TRANSIENT)


def test_image_of_a_read_is_reported_with_the_pass_that_renders_to_it(tmp_path: Path) -> None:
    reads = (
        begin("first"),
        "readImage: {image: color_ms, stage: FRAGMENT}",
        "endRenderPass",
        begin("second"),
        "endRenderPass",
    )
    found = confirmed(tmp_path, IMAGES + LEGACY + commands(*reads, begin("third"), "endRenderPass"))
    assert rows(found["first"], NOT_TRANSIENT) == []
    # The samples of one image are read; the finding about the other does not account for the
    # message about it.
    assert rows(found["second"], NOT_TRANSIENT) == [("explained", None)]
    assert rows(found["third"], NOT_TRANSIENT) == [("both", "multisampled-image-not-transient")]


def test_resolve_command_is_reported_with_the_pass_of_its_source(tmp_path: Path) -> None:
    found = confirmed(
        tmp_path,
        IMAGES
        + LEGACY
        + commands(
            begin("second"),
            "endRenderPass",
            begin("third"),
            "endRenderPass",
            "resolveImage: {srcImage: color_ms, dstImage: color}",
        ),
    )
    assert rows(found["second"], "resolving-image") == [("both", "resolve-outside-pass")]
    assert rows(found["third"], "resolving-image") == []


PARTS = """\
renderPasses:
  forward:
    attachments:
      color_ms: {image: color_ms, loadOp: LOAD, storeOp: STORE, initialLayout: COLOR_ATTACHMENT_OPTIMAL, finalLayout: GENERAL}
      texture: {image: texture, loadOp: LOAD, storeOp: STORE, initialLayout: COLOR_ATTACHMENT_OPTIMAL, finalLayout: GENERAL}
    subpasses:
      - {colorAttachments: [color_ms], resolveAttachments: [texture]}
"""


def test_message_about_a_resolve_target_is_not_laid_to_its_source(tmp_path: Path) -> None:
    """The render area is a part of the images: the load of the target preserves the rest, whereas
    that of the source is a finding.
    """
    area = "beginRenderPass: {renderPass: forward, renderArea: {x: 0, y: 0, width: 32, height: 64}}"
    found = confirmed(tmp_path, IMAGES + PARTS + commands(area, "endRenderPass"))
    assert rows(found["forward"], "attachment-needs-readback") == [
        ("both", "multisampled-attachment-loaded"),
        ("explained", None),
    ]


CLEARED = """\
renderPasses:
  forward:
    attachments:
      color: {image: color, loadOp: LOAD, storeOp: STORE, initialLayout: COLOR_ATTACHMENT_OPTIMAL, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
    subpasses:
      - {colorAttachments: [color]}
"""
CLEAR = (
    "clearAttachments: {attachments: [{aspect: [COLOR], colorAttachment: 0}], rects: [{x: 0, "
    "y: 0, width: 64, height: %d}]}"
)


@pytest.mark.parametrize(
    ("height", "size"), [(63, "16x16"), (63, "64x64"), (64, "64x64"), (64, "16x16")]
)
def test_clear_of_a_part_is_one_at_any_size(height: int, size: str, tmp_path: Path) -> None:
    text = (
        IMAGES + CLEARED + commands(begin("forward"), CLEAR % height, "draw: {}", "endRenderPass")
    )
    (tmp_path / "frame.msaa.yaml").write_text(text)
    done = run(
        tmp_path,
        "confirm",
        "--isolated",
        "--output",
        "json",
        "--no-time",
        "--size",
        size,
        "frame.msaa.yaml",
    )
    (found,) = json.loads(done.stdout)["passes"]
    whole = height == 64
    assert found["status"] == "confirmed"
    assert [verdict for verdict, _ in rows(found, "ClearCmdBeforeDraw")] == ["both"] * whole


def test_example_capture_agrees_as_the_description_of_it_does(tmp_path: Path) -> None:
    """`confirm` accepts what `convert` writes, and says the same of it."""
    capture = ROOT / "examples" / "capture" / "forward.jsonl"
    assert run(tmp_path, "convert", str(capture), "-o", "forward.msaa.yaml").returncode == 0
    reports = []
    for path in (str(capture), "forward.msaa.yaml"):
        done = run(tmp_path, "confirm", "--isolated", "--output", "json", "--no-time", path)
        assert done.returncode == 0
        reports.append(json.loads(done.stdout))
    direct, converted = ([{**each, "file": ""} for each in report["passes"]] for report in reports)
    assert direct == converted
    assert {each["status"] for each in direct} == {"confirmed"}


SHARED = """\
frame: {width: 64, height: 64, share: 0.5}
images:
  depth: {format: D16_UNORM, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT], extent: {width: 64, height: 64}}
  color: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT], extent: {width: 64, height: 64}}
commands:
  - beginRendering:
      colorAttachments: [{image: color, loadOp: %s, storeOp: %s}]
      depthAttachment: {image: depth, loadOp: CLEAR, storeOp: DONT_CARE}
  - endRendering
"""


def test_what_one_kind_of_frame_shows_explains_messages_about_the_others(tmp_path: Path) -> None:
    """One kind of frame loads the image, which therefore cannot be transient; no kind loads the
    other one.
    """
    (tmp_path / "frame.msaa.yaml").write_text(
        SHARED % ("CLEAR", "STORE") + "---\n" + SHARED % ("LOAD", "STORE")
    )
    done = run(
        tmp_path, "confirm", "--isolated", "--output", "json", "--no-time", "frame.msaa.yaml"
    )
    report = json.loads(done.stdout)
    assert [each["status"] for each in report["passes"]] == ["confirmed", "confirmed"]
    for each in report["passes"]:
        assert rows(each, NOT_TRANSIENT) == [
            ("both", "multisampled-image-not-transient"),
            ("explained", None),
        ]

"""What a rule says of a render pass depends on whether the frame begins it."""

from __future__ import annotations

import json
import lzma
from pathlib import Path

import pytest

from tests.command import run
from tests.paths import SAMPLES

FRAME = """\
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
  backbuffer: {format: R8G8B8A8_UNORM, samples: 1, presentable: true}
renderPasses:
  other:
    attachments:
      color: {format: R8G8B8A8_UNORM, samples: 8, loadOp: LOAD, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color]}
  main:
    attachments:
      color: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
      output: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output]}
framebuffers:
  main: {renderPass: main, attachments: [ms, backbuffer]}
pipelines:
  opaque: {renderPass: other, multisampleState: {rasterizationSamples: 8, sampleShadingEnable: true, minSampleShading: 1.0}}
"""
OTHER = "renderPasses.other.attachments.color"


def findings(folder: Path, text: str) -> dict[tuple[str, str], str]:
    """The confidence of each finding, by its code and subject."""
    (folder / "frame.msaa.yaml").write_text(text, encoding="utf-8")
    done = run(folder, "check", "--isolated", "--output", "json", "frame.msaa.yaml")
    assert done.returncode in (0, 1), done.stderr
    return {
        (found["code"], found["subject"]): found["confidence"]
        for found in json.loads(done.stdout)["findings"]
    }


@pytest.mark.parametrize(
    ("commands", "confidence"),
    [
        ("", "high"),
        ("commands: []", "low"),
        (
            "commands: [{beginRenderPass: {renderPass: main, framebuffer: main}}, endRenderPass, "
            "{present: {image: backbuffer}}]",
            None,
        ),
        (
            "commands: [{beginRenderPass: {framebuffer: main}}, endRenderPass, {present: {image: "
            "backbuffer}}]",
            None,
        ),
        (
            "commands: [{beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: "
            "DONT_CARE}]}}, endRendering]",
            None,
        ),
        ("commands: [{present: {image: backbuffer}}]", None),
        ("commands: [{beginRenderPass: {renderPass: other}}, endRenderPass]", "high"),
        (
            "commands: [{beginRenderPass: {renderPass: main}}, endRenderPass, {beginRenderPass: "
            "{renderPass: other}}, endRenderPass]",
            "high",
        ),
        ("commands: [{beginRenderPass: {}}, endRenderPass]", "low"),
    ],
)
def test_what_a_pass_loads_counts_if_a_command_begins_it(
    tmp_path: Path, commands: str, confidence: str | None
) -> None:
    found = findings(tmp_path, FRAME + commands)
    assert found.get(("MSAA202", OTHER)) == confidence
    # Its attachment stands for an image of a frame that runs the pass.
    assert (("MSAA101", OTHER) in found) == (confidence is not None)
    # A pipeline that is created with it draws in a compatible pass.
    assert found["MSAA501", "pipelines.opaque"] == "high"


def test_creating_a_pass_must_be_valid_even_if_none_begins_it(tmp_path: Path) -> None:
    text = FRAME.replace(
        "samples: 8, loadOp: LOAD", "samples: 8, initialLayout: UNDEFINED, loadOp: LOAD"
    )
    for commands in ("", "commands: []", "commands: [{present: {image: backbuffer}}]"):
        assert findings(tmp_path, text + commands)["MSAA210", OTHER] == "high"


def test_what_no_pass_does_loads_no_image(tmp_path: Path) -> None:
    """A pass that is not begun does not keep an image from being transient."""
    text = FRAME.replace(
        "color: {format: R8G8B8A8_UNORM, samples: 8",
        "color: {image: ms, format: R8G8B8A8_UNORM, samples: 4",
    )
    text = text.replace("rasterizationSamples: 8", "rasterizationSamples: 4")
    begin = (
        "commands: [{beginRenderPass: {framebuffer: main}}, endRenderPass, {present: {image: "
        "backbuffer}}]"
    )
    assert ("MSAA401", "images.ms") not in findings(tmp_path, text)
    assert ("MSAA401", "images.ms") in findings(tmp_path, text + begin)
    done = run(
        tmp_path,
        "check",
        "--isolated",
        "--select",
        "MSAA401",
        "--fix",
        "--unsafe-fixes",
        "frame.msaa.yaml",
    )
    assert done.returncode == 0, done.stdout
    fixed = (tmp_path / "frame.msaa.yaml").read_text(encoding="utf-8")
    assert fixed == (text + begin).replace(
        "usage: [COLOR_ATTACHMENT]", "usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]"
    )


def test_a_pass_that_is_not_begun_costs_nothing(tmp_path: Path) -> None:
    begin = (
        "commands: [{beginRenderPass: {renderPass: main, framebuffer: main}}, endRenderPass, "
        "{present: {image: backbuffer}}]\n"
    )
    costs = []
    for text in (
        FRAME,
        FRAME[: FRAME.index("  other:")]
        + FRAME[FRAME.index("  main:\n    attachments") : FRAME.index("pipelines:")],
    ):
        (tmp_path / "frame.msaa.yaml").write_text(
            "frame: {width: 64, height: 64, fps: 60}\n" + text + begin, encoding="utf-8"
        )
        done = run(tmp_path, "cost", "--output", "json", "frame.msaa.yaml")
        assert done.returncode == 0, done.stderr
        costs.append(json.loads(done.stdout)["total"])
    assert costs[0] == costs[1]


def test_a_rule_about_creating_passes_says_so(tmp_path: Path) -> None:
    page = (
        "---\ncode: ACME001\nseverity: error\nsubject: attachment\n{passes}when: "
        'attachment.samples == 8\nmessage: "m"\n---\nNo 8x.\n'
    )
    begin = "commands: [{beginRenderPass: {framebuffer: main}}, endRenderPass]\n"
    (tmp_path / "frame.msaa.yaml").write_text(FRAME + begin, encoding="utf-8")
    for passes, count in (("", 0), ("passes: begun\n", 0), ("passes: all\n", 1)):
        (tmp_path / "no-eight.md").write_text(page.format(passes=passes), encoding="utf-8")
        done = run(
            tmp_path,
            "check",
            "--isolated",
            "--rules",
            "no-eight.md",
            "--select",
            "ACME001",
            "--output",
            "json",
            "frame.msaa.yaml",
        )
        assert len(json.loads(done.stdout)["findings"]) == count, passes


def test_a_pipeline_of_vulkan_sc_does_not_say_what_runs_its_pass(tmp_path: Path) -> None:
    text = (Path(__file__).parents[2] / "data" / "vulkan_sc_renderpass.json").read_text(
        encoding="utf-8"
    )
    found = findings(tmp_path, text)
    operations = {
        code: confidence for (code, _), confidence in found.items() if code.startswith("MSAA2")
    }
    assert operations
    assert set(operations.values()) == {"low"}


@pytest.mark.parametrize(
    ("name", "absent", "unsure"),
    [
        ("wgpu_store.gfxr.jsonl.xz", "MSAA202", ()),
        ("wgpu_discard.gfxr.jsonl.xz", "MSAA202", ()),
        ("sdl3_spinning_cube.gfxr.jsonl.xz", "MSAA207", ()),
        ("wgpu_store.foz.xz", None, ("MSAA202", "MSAA204")),
        ("chromium_webgl.foz.xz", None, ("MSAA202",)),
    ],
)
def test_passes_of_real_programs_that_only_serve_to_create_pipelines(
    tmp_path: Path, name: str, absent: str | None, unsure: tuple[str, ...]
) -> None:
    stored = SAMPLES / "real_captures" / name
    if not stored.is_file():
        pytest.skip(
            f"the capture {name} is not at hand: MSAA_LINT_SAMPLES names the folder of samples"
        )
    path = tmp_path / name.removesuffix(".xz")
    path.write_bytes(lzma.decompress(stored.read_bytes()))
    done = run(tmp_path, "check", "--isolated", "--output", "json", path.name)
    found = [(each["code"], each["confidence"]) for each in json.loads(done.stdout)["findings"]]
    assert absent not in dict(found)
    assert {confidence for code, confidence in found if code in unsure} <= {"low"}
    assert set(unsure) <= set(dict(found))

"""One program captured by every tool: the same findings."""

from __future__ import annotations

import re

import pytest

from msaa_lint.core.finding import Finding
from tests.input.captures.program import Program, attachment, info, lint
from tests.input.captures.test_converted import said as spoken
from tests.input.captures.test_frames import forward
from tests.input.readers import dialects, dialects_binary
from tests.paths import SAMPLES

FOLDER = SAMPLES / "captures"


def current_renderdoc(text: bytes) -> bytes:
    """What version 1.35 writes: a width of enumerants, an index of chunks, a section with the log,
    and a later version of the chunks.
    """
    text = re.sub(rb'(<enum name="\w+")', rb'\1 width="4"', text)
    text = re.sub(rb'(<chunk id="\d+")', rb'\1 chunkIndex="7"', text)
    text = re.sub(
        rb"\n(\t<chunks version=)\"\d+\"",
        rb'\n\t<diagnostic_log>diagnostic.log</diagnostic_log>\n\1"22"',
        text,
    )
    assert b"width=" in text and b"chunkIndex=" in text and b"diagnostic_log" in text
    return text


DIALECTS = {
    "gfxreconstruct 0.9": lambda calls: dialects.lined(dialects.old_lines(calls)),
    "gfxreconstruct 1.x, lines": lambda calls: dialects.lined(dialects.new_lines(calls)),
    "gfxreconstruct 1.x, flags by name": lambda calls: dialects.lined(
        dialects.new_lines(calls, expand=True)
    ),
    "gfxreconstruct 1.x, an array": dialects.new_array,
    "api_dump": dialects.api_dump,
    "api_dump, older": lambda calls: dialects.api_dump(calls, null="NULL"),
    "RenderDoc": lambda calls: dialects_binary.renderdoc(calls).text(),
    "RenderDoc 1.35": lambda calls: current_renderdoc(dialects_binary.renderdoc(calls).text()),
}


def dynamic() -> Program:
    """A frame of dynamic rendering and a render pass, with a resolve by command."""
    program = Program()
    program.swap(1)
    image, target = program.image(usage=0x11), program.image(samples=1, usage=0x12)
    depth = program.view(program.image("VK_FORMAT_D24_UNORM_S8_UINT", usage=0x20))
    buffer = program.buffer()
    program.rendering(
        buffer, [info(program.view(image), store="STORE")], info(depth, store="STORE")
    )
    program.draw(buffer, program.pipeline())
    program.end(buffer, rendering=True)
    region = {
        "srcSubresource": {"aspectMask": 1, "layerCount": 1}, "dstSubresource": {"aspectMask": 1,
        "layerCount": 1},
        "srcOffset": {"x": 0, "y": 0, "z": 0}, "dstOffset": {"x": 0, "y": 0, "z": 0},
        "extent": {"width": 256, "height": 128, "depth": 1},
    }  # fmt: skip
    layouts = {
        "srcImageLayout": "VK_IMAGE_LAYOUT_GENERAL",
        "dstImageLayout": "VK_IMAGE_LAYOUT_GENERAL",
    }
    ends = {"srcImage": image, "dstImage": target}
    program.call(
        "vkCmdResolveImage",
        commandBuffer=buffer,
        **ends,
        **layouts,
        regionCount=1,
        pRegions=[region],
    )
    render_pass = program.render_pass([attachment(samples=4, store="STORE")], two=True)
    program.begin(
        buffer, render_pass, program.framebuffer(render_pass, [program.view(program.image())])
    )
    program.end(buffer)
    program.submit(buffer)
    program.present()
    return program


def said(findings: list[Finding]) -> set[tuple[str, ...]]:
    """What the findings say, without the indices of calls, which tools count differently."""
    return {
        (code, severity, confidence, re.sub(r"#\d+", "#", message))
        for code, severity, confidence, message in spoken(findings)
    }


@pytest.mark.parametrize("name", ["forward", "dynamic"])
def test_every_tool_s_capture_of_a_program_has_the_same_findings(name: str) -> None:
    program = forward(1, images=1) if name == "forward" else dynamic()
    expected = said(lint(program.text()))
    assert len(expected) >= 2
    for dialect, write in DIALECTS.items():
        assert said(lint(write(program.calls))) == expected, dialect


def test_every_tool_s_capture_has_the_labels_and_the_names() -> None:
    program = Program()
    program.swap(1)
    render_pass = program.render_pass([attachment(store="STORE")])
    view = program.view(program.image())
    framebuffer = program.framebuffer(render_pass, [view])
    program.name("VK_OBJECT_TYPE_IMAGE_VIEW", view, "scene color")
    buffer = program.buffer()
    program.call(
        "vkCmdBeginDebugUtilsLabelEXT", commandBuffer=buffer, pLabelInfo={"pLabelName": "Frame"}
    )
    program.call(
        "vkCmdDebugMarkerBeginEXT", commandBuffer=buffer, pMarkerInfo={"pMarkerName": "Main"}
    )
    program.begin(buffer, render_pass, framebuffer)
    program.end(buffer)
    program.call("vkQueueBeginDebugUtilsLabelEXT", queue=3, pLabelInfo={"pLabelName": "Game"})
    program.call(
        "vkQueueSubmit", queue=3, submitCount=1, pSubmits=[{"pCommandBuffers": [buffer]}], fence=0
    )
    program.present()
    for dialect, write in DIALECTS.items():
        (found,) = (each for each in lint(write(program.calls)) if each.code == "MSAA201")
        assert found.message.startswith(
            "in `Game / Frame / Main`, `scene color (attachment 0)` stores"
        ), dialect


def test_fossilize_has_what_does_not_need_images() -> None:
    program = dynamic()
    found = {each.code for each in lint(dialects_binary.fossilize(program.calls))}
    assert found <= {each.code for each in lint(program.text())}


@pytest.mark.skipif(not FOLDER.exists(), reason="no samples beside the repository")
def test_the_samples_of_one_program_have_the_same_findings() -> None:
    captures = sorted(
        path
        for path in FOLDER.iterdir()
        if "msaa" in path.name and path.suffix in (".jsonl", ".json", ".xml")
    )
    assert len(captures) == 6
    found = {path.name: said(lint(path.read_bytes())) for path in captures}
    first = found["gfxr_1.0.5_msaa.jsonl"]
    # What the layer says when the program runs: image-requires-memory (201), redundant-store (208),
    # non-transient-ms-image (401); and what it does not say of render pass 2 and dynamic rendering.
    # The dependency waits for color output alone, so that nothing orders the writes to depth of two
    # frames (602).
    assert {code for code, _, _, _ in first} == {
        "MSAA201",
        "MSAA208",
        "MSAA209",
        "MSAA308",
        "MSAA401",
        "MSAA501",
        "MSAA602",
    }
    assert {name for name, each in found.items() if each != first} == set()
    (database,) = FOLDER.glob("*.foz")
    assert {each.code for each in lint(database.read_bytes())} == {"MSAA201", "MSAA501"}


@pytest.mark.skipif(not FOLDER.exists(), reason="no samples beside the repository")
def test_a_single_sampled_program_has_no_finding_above_a_note() -> None:
    captures = sorted(path for path in FOLDER.iterdir() if "vkcube" in path.name)
    assert len(captures) == 3
    for path in captures:
        assert [found for found in lint(path.read_bytes()) if found.severity != "note"] == []

"""`msaa-lint convert`, and what it prints being what `check` judges."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from msaa_lint.core.finding import Finding
from tests.command import run
from tests.input.captures.program import COLOR, D32, DEPTH, Program, attachment, codes, info, lint
from tests.input.captures.test_frames import forward, history
from tests.input.readers import dialects_binary
from tests.paths import ROOT


def several() -> Program:
    """Frames of two kinds, one of which makes mistakes of its own."""
    program = forward(6)
    color, depth = program.view(program.image()), program.view(program.image(D32, usage=DEPTH))
    for _ in range(2):
        buffer = program.buffer()
        program.rendering(buffer, [info(color, store="STORE")], info(depth, store="STORE"))
        program.draw(buffer)
        program.end(buffer, rendering=True)
        program.submit(buffer)
        program.present()
    program.render_pass([attachment(samples=8, store="STORE")])
    return program


PROGRAMS = {
    "forward": forward(5),
    "right": forward(5, store="DONT_CARE"),
    "history": history(True),
    "several": several(),
}


def said(findings: list[Finding]) -> set[tuple[str, str, str, str]]:
    return {(found.code, found.severity, found.confidence, found.message) for found in findings}


@pytest.mark.parametrize("name", PROGRAMS)
def test_the_description_of_a_capture_has_the_capture_s_findings(name: str, tmp_path: Path) -> None:
    capture = tmp_path / "p.jsonl"
    capture.write_bytes(PROGRAMS[name].text())
    made = run(tmp_path, "convert", "p.jsonl")
    assert said(lint(made.stdout.encode())) == said(lint(capture.read_bytes()))


def test_a_description_can_be_edited_and_fixed(tmp_path: Path) -> None:
    (tmp_path / "p.jsonl").write_bytes(PROGRAMS["forward"].text())
    assert run(tmp_path, "convert", "p.jsonl", "-o", "frame.yaml").returncode == 0
    assert "MSAA201" in codes(lint((tmp_path / "frame.yaml").read_bytes()))
    run(tmp_path, "check", "--fix", "--isolated", "frame.yaml")
    assert "MSAA201" not in codes(lint((tmp_path / "frame.yaml").read_bytes()))


def test_a_file_that_exists_is_not_written_over(tmp_path: Path) -> None:
    (tmp_path / "p.jsonl").write_bytes(PROGRAMS["forward"].text())
    (tmp_path / "frame.yaml").write_text("mine")
    command = ["convert", "p.jsonl", "-o", "frame.yaml"]
    made = run(tmp_path, *command)
    assert made.returncode == 2
    assert made.stderr == "msaa-lint: frame.yaml already exists; --force overwrites it\n"
    assert (tmp_path / "frame.yaml").read_text() == "mine"
    assert run(tmp_path, *command, "--force").returncode == 0
    assert "renderPasses:" in (tmp_path / "frame.yaml").read_text()


def test_what_is_no_capture_needs_no_conversion(tmp_path: Path) -> None:
    (tmp_path / "frame.yaml").write_text("images: {}\n")
    made = run(tmp_path, "convert", "frame.yaml")
    assert made.returncode == 2
    assert "nothing to convert" in made.stderr


def test_a_capture_that_ends_in_the_middle_is_written_up_to_there(tmp_path: Path) -> None:
    (tmp_path / "p.jsonl").write_bytes(PROGRAMS["forward"].text() + b'{"index":')
    made = run(tmp_path, "convert", "p.jsonl")
    assert made.returncode == 2
    assert "the file is truncated" in made.stderr
    assert "renderPasses" in yaml.safe_load(made.stdout)


def test_standard_input_is_told_by_its_content(tmp_path: Path) -> None:
    arguments = ["check", "-", "--isolated", "--stdin-filename", "game.jsonl", "--output", "json"]
    made = run(tmp_path, *arguments, stdin=PROGRAMS["forward"].text())
    found = json.loads(made.stdout)["findings"]
    assert made.returncode == 1
    assert {(each["file"], each["code"]) for each in found} >= {("game.jsonl", "MSAA201")}
    stored = next(each for each in found if each["code"] == "MSAA201")
    assert stored["seen"] == {
        "by": "vkCreateRenderPass",
        "call": stored["seen"]["call"],
        "frames": 5,
        "of": 5,
    }
    assert (
        PROGRAMS["forward"]
        .lines()[stored["line"] - 1]
        .startswith(f'{{"index": {stored["seen"]["call"]}, ')
    )
    assert stored["fixable"] is False


def test_a_person_sees_the_call_and_the_structure(tmp_path: Path) -> None:
    program = PROGRAMS["forward"]
    (tmp_path / "game.jsonl").write_bytes(program.text())
    made = run(
        tmp_path,
        "check",
        "--isolated",
        "--fix",
        "--output",
        "full",
        "--select",
        "MSAA201",
        "game.jsonl",
    )
    index = next(
        number for number, (name, _) in enumerate(program.calls, 1) if name == "vkCreateRenderPass"
    )
    lines = made.stdout.splitlines()
    message = (
        "`color 256x128 RGBA8 4x #5 (attachment 0)` stores 4x samples that nothing reads; "
        "set storeOp to DONT_CARE"
    )
    assert lines[0] == f"warning[multisampled-attachment-stored]: {message}"
    assert lines[1].strip() == f"--> game.jsonl:{index + 1}:1"
    assert "        storeOp: STORE" in made.stdout
    assert f"= from: vkCreateRenderPass, call {index}; in 5 of 5 frames" in made.stdout
    assert "= fix: set storeOp to DONT_CARE (not applied automatically)" in made.stdout
    assert "game.jsonl is a capture and is not fixed" in made.stderr
    assert (tmp_path / "game.jsonl").read_bytes() == program.text()


@pytest.mark.parametrize(
    ("head", "said"),
    [
        (b"GFXR\0\0\0\0" + bytes(64), "gfxrecon-convert --format jsonl"),
        (b"RDOC" + bytes(64), "renderdoccmd convert"),
        (
            b"Thread 0, Frame 0:\nvkCreateInstance(pCreateInfo, pAllocator, pInstance) returns "
            b"VkResult VK_SUCCESS (0):\n",
            "VK_APIDUMP_OUTPUT_FORMAT",
        ),
    ],
)
def test_what_a_tool_wrote_for_itself_is_told_with_what_to_run_if_no_converter_is_installed(
    head: bytes, said: str, tmp_path: Path
) -> None:
    (tmp_path / "capture").write_bytes(head)
    made = run(tmp_path, "check", "--isolated", "--output", "json", "capture", PATH=str(tmp_path))
    (found,) = json.loads(made.stdout)["findings"]
    assert made.returncode == 2
    assert found["code"] == "MSAA901"
    assert said in found["message"]


def test_a_folder_s_captures_are_found(tmp_path: Path) -> None:
    (tmp_path / "game.jsonl").write_bytes(PROGRAMS["forward"].text())
    (tmp_path / "log.jsonl").write_text('{"message": "no capture"}\n')
    made = run(tmp_path, "check", "--isolated", "--output", "json", ".")
    assert {each["file"] for each in json.loads(made.stdout)["findings"]} == {"game.jsonl"}
    assert json.loads(made.stdout)["summary"]["files"] == 1


def test_a_profile_stands_in_for_the_device_that_was_captured_on(tmp_path: Path) -> None:
    program = Program()
    limits = {
        "framebufferColorSampleCounts": 5,
        "framebufferDepthSampleCounts": 5,
        "framebufferStencilSampleCounts": 5,
    }
    properties = {
        "vendorID": 0x10DE,
        "deviceName": "a desktop's",
        "apiVersion": 4206592,
        "limits": limits,
    }
    program.call("vkGetPhysicalDeviceProperties", physicalDevice=1, pProperties=properties)
    types = {"memoryTypeCount": 1, "memoryTypes": [{"propertyFlags": 1, "heapIndex": 0}]}
    program.call("vkGetPhysicalDeviceMemoryProperties", physicalDevice=1, pMemoryProperties=types)
    buffer = program.buffer()
    program.rendering(
        buffer,
        [
            info(
                program.view(program.image(usage=COLOR)),
                resolve=program.view(program.image(samples=1)),
            )
        ],
    )
    program.end(buffer, rendering=True)
    program.submit(buffer)
    severities = {}
    for profile in (None, "mali-g76"):
        found = lint(program.text(), **({"profile": profile} if profile else {}))
        severities[profile] = next(each.severity for each in found if each.code == "MSAA401")
    assert severities == {None: "note", "mali-g76": "warning"}


SHADER = (ROOT / "rules" / "shaders" / "glints.frag.spv").read_bytes()


def capture_with_shader() -> bytes:
    """A Fossilize archive with a pipeline whose shader is `SHADER`."""
    program = Program()
    render_pass = program.render_pass([attachment()])
    shader = {
        "sType": "VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO",
        "codeSize": len(SHADER),
        "pCode": SHADER,
    }
    program.call("vkCreateShaderModule", device=2, pCreateInfo=shader, pShaderModule=900)
    program.pipeline(render_pass)
    stage = {
        "stage": "VK_SHADER_STAGE_FRAGMENT_BIT",
        "module": 900,
        "pName": "main",
        "pSpecializationInfo": None,
    }
    program.calls[-1][1]["pCreateInfos"][0]["pStages"] = [stage]
    return dialects_binary.fossilize(program.calls)


def test_shaders_of_a_capture_are_written_beside_the_description(tmp_path: Path) -> None:
    (tmp_path / "game.foz").write_bytes(capture_with_shader())
    run(tmp_path, "convert", "game.foz", "-o", "frame.yaml")
    (written,) = (tmp_path / "shaders").iterdir()
    assert written.read_bytes() == SHADER
    # The shader runs for every sample, and the pipeline does not say so.
    for name in ("game.foz", "frame.yaml"):
        made = run(tmp_path, "check", "--isolated", "--output", "json", name)
        assert "MSAA504" in [found["code"] for found in json.loads(made.stdout)["findings"]], name

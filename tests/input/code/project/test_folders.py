"""Source files that are checked together, through the command."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.command import run

pytest.importorskip("tree_sitter_cpp")

PASS = """\
#include "settings.h"

void Renderer::createPass() {
    VkAttachmentDescription color{};
    color.format = VK_FORMAT_B8G8R8A8_UNORM;
    color.samples = SAMPLES;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentDescription target{};
    target.format = VK_FORMAT_B8G8R8A8_UNORM;
    target.samples = VK_SAMPLE_COUNT_1_BIT;
    target.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    target.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentReference color_reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference target_reference{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color_reference;
    subpass.pResolveAttachments = &target_reference;
    VkAttachmentDescription attachments[] = {color, target};
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &render_pass);
}
"""
SETTINGS = """\
#include <vulkan/vulkan.h>

constexpr VkSampleCountFlagBits SAMPLES = VK_SAMPLE_COUNT_{count}_BIT;

struct Renderer {{
    void createPass();
    VkDevice device;
    VkRenderPass render_pass;
}};
"""
MAIN = "\nint main() {\n    Renderer renderer;\n    renderer.createPass();\n}\n"
STORED = ("MSAA201", 8)


def write(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def check(folder: Path, *paths: str) -> dict[str, Any]:
    done = run(folder, "check", *(paths or (".",)), "--isolated", "--output", "json")
    assert done.returncode in (0, 1), done.stderr
    data: dict[str, Any] = json.loads(done.stdout)
    return data


def places(data: dict[str, Any]) -> list[tuple[str, str, int]]:
    return [(each["file"], each["code"], each["line"]) for each in data["findings"]]


def confidences(data: dict[str, Any]) -> list[tuple[str, str, str]]:
    """What is resolved has an unknown sample count above one, which gives a finding of low
    confidence.
    """
    return [(each["file"], each["code"], each["confidence"]) for each in data["findings"]]


def settings(count: int) -> str:
    return SETTINGS.format(count=count)


def test_a_source_uses_the_constant_of_a_header(tmp_path: Path) -> None:
    write(tmp_path, {"src/pass.cpp": PASS, "src/settings.h": settings(4)})
    data = check(tmp_path)
    assert places(data) == [("src/pass.cpp", *STORED)]
    assert data["findings"][0]["labels"][-1]["file"] in ("src/pass.cpp", "src/settings.h")
    write(tmp_path, {"src/settings.h": settings(1)})
    assert [code for _, code, _ in places(check(tmp_path))] == ["MSAA304"]


@pytest.mark.parametrize("header", ["src/settings.h", "include/settings.h", "settings.h"])
def test_a_file_that_is_named_sees_the_headers_of_its_project(tmp_path: Path, header: str) -> None:
    write(tmp_path, {"src/pass.cpp": PASS, header: settings(4), "msaa-lint.toml": ""})
    data = check(tmp_path, "src/pass.cpp")
    assert confidences(data) == [("src/pass.cpp", "MSAA201", "medium")]
    assert [entry["file"] for entry in data["inputs"]] == ["src/pass.cpp"]


def test_a_header_outside_the_project_is_not_read(tmp_path: Path) -> None:
    write(
        tmp_path, {"settings.h": settings(4), "project/src/pass.cpp": PASS, "project/.git/HEAD": ""}
    )
    (tmp_path / "project" / "src" / "link").symlink_to(tmp_path)
    unknown = [("src/pass.cpp", "MSAA201", "low")]
    assert confidences(check(tmp_path / "project", "src/pass.cpp")) == unknown
    (tmp_path / "project" / "src" / "settings.h").symlink_to(tmp_path / "settings.h")
    assert confidences(check(tmp_path / "project", "src/pass.cpp")) == unknown


def test_programs_side_by_side_stay_apart(tmp_path: Path) -> None:
    """Each has a constant and a class of the same names."""
    write(
        tmp_path,
        {
            "one.cpp": settings(4) + PASS.partition("\n")[2] + MAIN,
            "two.cpp": settings(1) + PASS.partition("\n")[2] + MAIN,
        },
    )
    assert [(file, code) for file, code, _ in places(check(tmp_path))] == [
        ("one.cpp", "MSAA201"),
        ("two.cpp", "MSAA304"),
    ]


def test_programs_in_folders_see_their_own_header_and_what_is_shared(tmp_path: Path) -> None:
    shared = settings(4).replace("SAMPLES", "SHARED_SAMPLES")
    include = '#include "../base/shared.h"\n#include "settings.h"\n'
    body = PASS.partition("\n")[2]
    write(
        tmp_path,
        {
            "base/shared.h": shared,
            "a/main.cpp": include + body.replace("= SAMPLES", "= SHARED_SAMPLES") + MAIN,
            "a/settings.h": "",
            "b/main.cpp": include + body + MAIN,
            "b/settings.h": "constexpr VkSampleCountFlagBits SAMPLES = VK_SAMPLE_COUNT_1_BIT;\n",
            "c/main.cpp": include + body + MAIN,
            "c/settings.h": "constexpr VkSampleCountFlagBits SAMPLES = VK_SAMPLE_COUNT_4_BIT;\n",
        },
    )
    assert confidences(check(tmp_path)) == [
        ("a/main.cpp", "MSAA201", "medium"),
        ("b/main.cpp", "MSAA304", "medium"),
        ("c/main.cpp", "MSAA201", "medium"),
    ]


def test_definitions_that_differ_leave_the_value_unknown(tmp_path: Path) -> None:
    """The source includes neither of the headers."""
    source = PASS.partition("\n")[2]
    write(tmp_path, {"pass.cpp": source, "settings.h": settings(4), "other.h": settings(2)})
    assert confidences(check(tmp_path)) == [("pass.cpp", "MSAA201", "low")]
    write(tmp_path, {"other.h": settings(4)})
    assert confidences(check(tmp_path)) == [("pass.cpp", "MSAA201", "medium")]


def test_a_library_is_reported_once(tmp_path: Path) -> None:
    write(tmp_path, {"lib/pass.cpp": PASS, "lib/settings.h": settings(4)})
    write(
        tmp_path,
        {f"app{number}/main.cpp": '#include "../lib/settings.h"\n' + MAIN for number in range(3)},
    )
    assert places(check(tmp_path)) == [("lib/pass.cpp", *STORED)]


def test_suppression_works_in_the_file_of_the_finding(tmp_path: Path) -> None:
    line = "    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;"
    source = PASS.replace(line, f"{line}  // msaa-lint: ignore[MSAA201] read back by a tool")
    write(tmp_path, {"pass.cpp": source, "settings.h": settings(4)})
    data = check(tmp_path)
    assert places(data) == []
    assert [(entry["finding"]["file"], entry["reason"]) for entry in data["suppressed"]] == [
        ("pass.cpp", "read back by a tool")
    ]


def test_a_file_that_cannot_be_read_loses_no_other(tmp_path: Path) -> None:
    write(
        tmp_path,
        {
            "pass.cpp": PASS,
            "settings.h": settings(4),
            "long.cpp": "// msaa VkImageCreateInfo\n" + "int a;\n" * 700_000,
        },
    )
    data = check_failed(tmp_path)
    assert [(each["file"], each["code"]) for each in data["findings"]] == [
        ("long.cpp", "MSAA906"),
        ("pass.cpp", "MSAA201"),
    ]


def check_failed(folder: Path) -> dict[str, Any]:
    done = run(folder, "check", ".", "--isolated", "--output", "json")
    assert done.returncode == 2
    data: dict[str, Any] = json.loads(done.stdout)
    return data


def test_convert_writes_what_the_files_of_a_folder_state(tmp_path: Path) -> None:
    write(tmp_path, {"pass.cpp": PASS, "settings.h": settings(4)})
    done = run(tmp_path, "convert", ".", "--output", "frame.msaa.yaml")
    assert (done.returncode, done.stderr) == (0, "")
    text = (tmp_path / "frame.msaa.yaml").read_text(encoding="utf-8")
    assert text.startswith(
        "# Read from settings.h, pass.cpp; what it does not state is left out.\nrenderPasses:\n"
    )
    assert "samples: 4" in text
    assert run(tmp_path, "convert", "pass.cpp", "settings.h").stdout == text
    alone = run(tmp_path, "convert", "pass.cpp").stdout
    assert alone == text.replace("settings.h, pass.cpp;", "pass.cpp;")


def test_facts_name_the_file_of_each_place(tmp_path: Path) -> None:
    write(tmp_path, {"pass.cpp": PASS, "settings.h": settings(4)})
    done = run(tmp_path, "facts", ".", "--output", "json")
    assert done.returncode == 0, done.stderr
    (color,) = (
        row
        for row in json.loads(done.stdout)
        if row["subject"] == "attachment" and row["path"].endswith(".color")
    )
    assert (color["file"], color["line"]) == ("pass.cpp", 4)
    assert color["facts"]["attachment.samples"] == {"value": 4, "line": 6}


def test_convert_joins_source_code_only(tmp_path: Path) -> None:
    write(tmp_path, {"a.yaml": "", "b.yaml": ""})
    done = run(tmp_path, "convert", "a.yaml", "b.yaml")
    assert done.returncode == 2
    assert "only source code is converted together" in done.stderr


def compiled(folder: Path, file: str, *words: str, target: str = "app") -> dict[str, Any]:
    arguments = ["c++", *words, "-c", str(folder / file)]
    return {
        "directory": str(folder),
        "file": file,
        "arguments": arguments,
        "output": f"CMakeFiles/{target}.dir/{file}.o",
    }


def test_a_build_defines_macros(tmp_path: Path) -> None:
    source = PASS.partition("\n")[2].replace("= SAMPLES", "= COUNT")
    write(tmp_path, {"src/pass.cpp": source, "src/other.cpp": "// msaa\n", ".git/HEAD": ""})
    assert confidences(check(tmp_path)) == [("src/pass.cpp", "MSAA201", "low")]
    commands = [
        compiled(tmp_path, "src/pass.cpp", "-DCOUNT=VK_SAMPLE_COUNT_4_BIT"),
        compiled(tmp_path, "../outside.cpp", "-DA"),
    ]
    write(tmp_path, {"build/compile_commands.json": json.dumps(commands)})
    assert confidences(check(tmp_path)) == [("src/pass.cpp", "MSAA201", "medium")]
    assert confidences(check(tmp_path, "src/pass.cpp")) == [("src/pass.cpp", "MSAA201", "medium")]


@pytest.mark.parametrize(
    "text", ["", "[", "{}", '[1, {}, {"file": 3}, {"file": "a", "command": "\'"}]']
)
def test_a_broken_compile_commands_is_passed_over(tmp_path: Path, text: str) -> None:
    write(tmp_path, {"pass.cpp": PASS, "settings.h": settings(4), "compile_commands.json": text})
    assert confidences(check(tmp_path)) == [("pass.cpp", "MSAA201", "medium")]


def test_the_files_of_a_target_are_a_program(tmp_path: Path) -> None:
    """The file with the constant is in another folder, which nothing includes."""
    write(
        tmp_path,
        {
            "app/main.cpp": "// msaa\n" + PASS.partition("\n")[2] + MAIN,
            "config/values.cpp": "extern const VkSampleCountFlagBits SAMPLES = "
            "VK_SAMPLE_COUNT_4_BIT;\n",
            ".git/HEAD": "",
        },
    )
    assert confidences(check(tmp_path)) == [("app/main.cpp", "MSAA201", "low")]
    write(
        tmp_path,
        {
            "compile_commands.json": json.dumps(
                [compiled(tmp_path, file) for file in ("app/main.cpp", "config/values.cpp")]
            )
        },
    )
    assert confidences(check(tmp_path)) == [("app/main.cpp", "MSAA201", "medium")]

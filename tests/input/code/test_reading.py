"""Source code as an input of the command: detected by name and content, with a confidence,
suppressed by its comments.
"""

from __future__ import annotations

import json
import subprocess
import time
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.input.code import language_of, parsing
from msaa_lint.input.file_types import SOURCES, missing_extra
from msaa_lint.input.source_file import read_source_file
from tests.command import run
from tests.paths import ROOT

RULE = "resolve-target-not-stored"
ONLY = ("--isolated", "--select", RULE)
MISTAKE = "attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;"
CODE = """\
#include <vulkan/vulkan.h>

VkRenderPass createForward(VkDevice device) {
    VkAttachmentDescription attachments[2] = {};
    attachments[0].format = VK_FORMAT_R8G8B8A8_UNORM;
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments[1].format = VK_FORMAT_R8G8B8A8_UNORM;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}
"""
GOOD = CODE.replace(MISTAKE, MISTAKE.replace("DONT_CARE", "STORE"))
LINE = CODE[: CODE.index(MISTAKE)].count("\n") + 1
COLUMN = 30
PLACE = f"{LINE}:{COLUMN}"
FOUND = f"warning[{RULE}]"

DESCRIPTION = """\
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [LAZILY_ALLOCATED]}
  out: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
renderPasses:
  main:
    attachments:
      color: {image: ms, loadOp: CLEAR, storeOp: DONT_CARE}
      output: {image: out, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output]}
"""


def write(folder: Path, name: str, text: str | bytes = CODE) -> str:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return name


def without_extra(
    folder: Path, *arguments: str, stdin: bytes = b""
) -> subprocess.CompletedProcess[str]:
    """Runs an installation without the extra."""
    blocked = folder / "blocked"
    write(blocked, "sitecustomize.py", "import sys\nsys.modules['tree_sitter'] = None\n")
    separator = ";" if ";" in __import__("os").pathsep else ":"
    return run(folder, *arguments, stdin=stdin, PYTHONPATH=f"{blocked}{separator}{ROOT}")


def findings(folder: Path, *arguments: str) -> list[dict[str, Any]]:
    done = run(folder, "check", "--output", "json", *arguments)
    found: list[dict[str, Any]] = json.loads(done.stdout)["findings"]
    return found


def places(folder: Path, *arguments: str) -> list[tuple[int, int, int]]:
    return [
        (each["line"], each["column"], each["end_column"])
        for each in findings(folder, *ONLY, *arguments)
        if each["rule"] == RULE
    ]


WHOLE = [(LINE, COLUMN, COLUMN + len("VK_ATTACHMENT_STORE_OP_DONT_CARE"))]


# Detection by name and content.


@pytest.mark.parametrize(
    "name",
    [
        "a.cpp",
        "a.cc",
        "A.CXX",
        "a.hpp",
        "a.h",
        "a.c",
        "a.inl",
        "a.h++",
        "a.tpp",
        "a.ixx",
        "a.cppm",
        "a.cu",
        "a.m",
        "a.mm",
    ],
)
def test_a_source_file_is_judged_at_its_lines(tmp_path: Path, name: str) -> None:
    write(tmp_path, name)
    assert places(tmp_path, name) == WHOLE


def test_what_is_right_is_found_right(tmp_path: Path) -> None:
    write(tmp_path, "a.cpp", GOOD)
    done = run(tmp_path, "check", *ONLY, "a.cpp")
    assert (done.returncode, done.stderr) == (0, "")
    assert "No findings in 1 file" in done.stdout


def test_standard_input_goes_by_its_name_or_its_format(tmp_path: Path) -> None:
    done = run(
        tmp_path, "check", *ONLY, "-", "--stdin-filename", "src/pass.cpp", stdin=CODE.encode()
    )
    assert f"src/pass.cpp:{PLACE}: {FOUND}" in done.stdout
    done = run(tmp_path, "check", *ONLY, "-", "--input-format", "cpp", stdin=CODE.encode())
    assert f"<stdin>:{PLACE}: {FOUND}" in done.stdout
    done = run(tmp_path, "check", *ONLY, "-", stdin=CODE.encode())
    assert done.returncode == 2, "what has no name and no fence is a description"


def test_the_format_that_is_named_goes_before_the_name(tmp_path: Path) -> None:
    write(tmp_path, "a.txt")
    assert places(tmp_path, "a.txt", "--input-format", "c") == WHOLE
    write(tmp_path, "a.cpp", DESCRIPTION)
    assert (
        run(tmp_path, "check", "--isolated", "a.cpp", "--input-format", "description").returncode
        == 0
    )
    assert (
        run(tmp_path, "check", "--isolated", "a.cpp", "--input-format", "vulkan-sc").returncode == 2
    )


@pytest.mark.parametrize(
    ("name", "head", "language"),
    [
        ("x.c", "", "c"),
        ("x.h", "void f(void);", "c"),
        ("x.h", "namespace a { }", "cpp"),
        ("x.h", "vk::Image f();", "cpp"),
        ("dir.cpp/x", "", None),
        ("x.MD", "", "markdown"),
        ("x.comp", "", "glsl"),
        ("x.txt", "no code", None),
        ("x.txt", "```cpp\nVkImageCreateInfo info; // msaa\n```\n", "markdown"),
        ("x.adoc", "", "asciidoc"),
        ("x.rst", "", "rst"),
        ("x.h", "#import <Metal/Metal.h>\n@interface A\n@end\n", "objc"),
        ("x.h", "@class B;\nnamespace a { }", "objcpp"),
        ("x.h", "@class B;\n@protocol C;\n", "objc"),
        ("x.m", "#import <Metal/Metal.h>\n", "objc"),
        ("x.m", "int main(void) {\n}\n", "objc"),
        ("x.m", "function y = f(x)\n  y = x;\nend\n", None),
        ("x.m", "% samples\nx = 4;\n", None),
        ("x.m", "(* samples *)\nf[x_] := x\n", None),
        ("x.m", ":- module samples.\n", None),
        ("x.txt", "```cpp\nint main() {}\n```\n", None),
        ("x.txt", "```python\nVkImageCreateInfo msaa\n```\n", None),
        ("x.yaml", "```cpp\nVkImageCreateInfo info; // msaa\n```\n", None),
        ("<stdin>", "```cpp\nVkImageCreateInfo info; // msaa\n```\n", "markdown"),
    ],
)
def test_languages_by_ending_and_fences(name: str, head: str, language: str | None) -> None:
    assert language_of(name, head) == language


def test_the_hook_takes_the_endings_of_source_code() -> None:
    hooks = (ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8")
    assert (
        f"files: \\.({'|'.join(ending[1:].replace('+', chr(92) + '+') for ending in SOURCES)})$"
        in hooks
    )


# Findings.


def test_findings_that_rest_on_an_assumption_fail_nothing_unless_asked_to(tmp_path: Path) -> None:
    write(tmp_path, "a.cpp")
    done = run(tmp_path, "check", *ONLY, "a.cpp")
    assert done.returncode == 1
    assert "Found 1 finding (1 warning) in 1 file (1 C++ file: 1 pass)\n" in done.stdout
    write(tmp_path, "a.md", f"```cpp\n{CODE}```\n")
    done = run(tmp_path, "check", *ONLY, "a.md")
    assert done.returncode == 0
    assert (
        "Found 1 finding (1 warning) in 1 file (1 Markdown page: 1 pass); 1 of low confidence, "
        "below --fail-confidence\n" in done.stdout
    )
    done = run(tmp_path, "check", *ONLY, "a.md", "--fail-confidence", "low")
    assert done.returncode == 1
    assert "confidence" not in done.stdout
    write(tmp_path, "msaa-lint.toml", 'fail-confidence = "low"\n')
    assert run(tmp_path, "check", "--select", RULE, "a.md").returncode == 1
    assert (
        run(tmp_path, "check", "--select", RULE, "a.md", "--fail-confidence", "medium").returncode
        == 0
    )
    assert (
        run(tmp_path, "check", "--select", RULE, "a.cpp", "--fail-confidence", "high").returncode
        == 0
    )
    write(tmp_path, "msaa-lint.toml", 'fail-confidence = "lowest"\n')
    done = run(tmp_path, "check", "--select", RULE, "a.cpp")
    assert done.returncode == 2
    assert "msaa-lint.toml:1:19: error[configuration] unknown value `lowest`" in done.stdout


def test_every_finding_of_code_is_of_medium_confidence_at_most_and_without_edits(
    tmp_path: Path,
) -> None:
    write(tmp_path, "a.cpp")
    found = findings(tmp_path, "--isolated", "a.cpp")
    assert RULE in {each["rule"] for each in found}
    assert {each["confidence"] for each in found} == {"medium"}
    assert not any(each["fixable"] for each in found)
    (own,) = (each for each in found if each["rule"] == RULE)
    assert own["fix"] == {
        "title": "set storeOp to STORE",
        "safe": False,
        "shown": True,
        "choice": False,
        "refusal": None,
    }


def test_undecided_rules_are_not_told(tmp_path: Path) -> None:
    write(tmp_path, "a.cpp")
    done = run(tmp_path, "check", "--isolated", "a.cpp", "--output", "json")
    assert json.loads(done.stdout)["undecided"] == []
    assert "undecided" not in run(tmp_path, "check", "--isolated", "a.cpp").stdout


def test_code_is_not_fixed(tmp_path: Path) -> None:
    write(tmp_path, "a.cpp")
    for flag in ("--fix", "--diff"):
        done = run(tmp_path, "check", *ONLY, "--unsafe-fixes", flag, "a.cpp")
        assert done.returncode == (flag == "--fix")
        assert "a.cpp is source code and is not fixed" in done.stderr
    assert (tmp_path / "a.cpp").read_text() == CODE
    for text in (CODE, "// µ\r\nint samples;\r\n"):
        done = run(
            tmp_path, "check", *ONLY, "--fix", "-", "--stdin-filename", "a.cpp", stdin=text.encode()
        )
        assert (done.returncode, done.stdout) == (int(text == CODE), text)


def test_the_same_bytes_every_time(tmp_path: Path) -> None:
    write(tmp_path, "b/a.cpp")
    write(tmp_path, "a.c")
    write(tmp_path, "a.msaa.yaml", DESCRIPTION)
    runs = {
        run(tmp_path, "check", "--isolated", "--output", "json", *order).stdout
        for order in ((".",), ("b", "a.msaa.yaml", "a.c"))
    }
    assert len(runs) == 1
    files = [each["file"] for each in json.loads(runs.pop())["findings"]]
    assert files == sorted(files)


# Limits.


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"// sample\n",
        b"\xff\xfe\x00",
        "// Größe µ\n".encode("latin-1") + CODE.encode(),
        b"\x00\x01sample\xff" * 1000,
        b"sample " + b"(" * 100_000,
        b"VkAttachmentDescription a = " + b"{" * 50_000,
        b"attachment " + b"if (a) " * 20_000,
        b"resolve /* " * 1000,
        CODE.encode("utf-16"),
    ],
    ids=[
        "empty",
        "comment",
        "broken UTF-16",
        "Latin-1",
        "binary",
        "parentheses",
        "braces",
        "ifs",
        "open comment",
        "UTF-16",
    ],
)
@pytest.mark.parametrize("name", ["a.c", "a.cpp", "a.swift", "a.frag", "a.md"])
def test_no_text_is_an_error_but_one_that_takes_too_long_to_parse(
    tmp_path: Path, name: str, text: bytes
) -> None:
    write(tmp_path, name, text)
    begun = time.process_time()
    done = run(tmp_path, "check", *ONLY, name)
    assert time.process_time() - begun < 20
    if (name, text[:14]) == ("a.swift", b"attachment if "):
        assert (done.returncode, done.stderr) == (2, "")
        assert "the code is too long or too complex to parse (MSAA906)" in done.stdout
    else:
        assert (done.returncode, done.stderr) == (int(FOUND in done.stdout), ""), done.stdout
    assert (FOUND in done.stdout) == (
        b"R8G8B8A8" in text.replace(b"\0", b"") and name in ("a.c", "a.cpp")
    )


def test_the_limit_on_bytes_holds(tmp_path: Path) -> None:
    write(tmp_path, "a.cpp")
    done = run(tmp_path, "check", *ONLY, "a.cpp", "--max-bytes", "100")
    assert done.returncode == 2
    assert (
        "a.cpp: error[limit-exceeded] cannot read the input: the input is larger than the limit of "
        "100 bytes" in done.stdout
    )


def test_places_count_characters(tmp_path: Path) -> None:
    text = CODE.replace("    " + MISTAKE, f"    /* Größe 😀 */ {MISTAKE}").replace("\n", "\r\n")
    write(tmp_path, "a.cpp", text)
    shift = len("/* Größe 😀 */ ")
    assert places(tmp_path, "a.cpp") == [
        (line, column + shift, end + shift) for line, column, end in WHOLE
    ]


# Without the extra.

MISSING = missing_extra()


@pytest.mark.parametrize("name", ["a.cpp", "a.c", "a.swift", "a.vert", "a.md"])
def test_without_the_extra_a_named_file_says_what_to_install(tmp_path: Path, name: str) -> None:
    write(tmp_path, name, f"```cpp\n{CODE}```\n" if name == "a.md" else CODE)
    done = without_extra(tmp_path, "check", "--isolated", name)
    assert (done.returncode, done.stderr) == (2, "")
    assert (
        done.stdout
        == f"{name}: error[configuration] {MISSING} (MSAA921)\nFound 1 finding (1 error) in 1 "
        "file\n"
    )


@pytest.mark.parametrize("command", ["cost", "facts", "convert", "confirm", "study"])
def test_without_the_extra_every_command_says_so(tmp_path: Path, command: str) -> None:
    write(tmp_path, "a.cpp")
    done = without_extra(tmp_path, command, "a.cpp")
    assert done.returncode == 2
    assert MISSING in done.stdout + done.stderr


def test_without_the_extra_a_folder_is_linted_and_its_code_counted(tmp_path: Path) -> None:
    write(tmp_path, "p/a.msaa.yaml", DESCRIPTION)
    write(tmp_path, "p/one.cpp")
    write(tmp_path, "p/deep/two.c")
    write(tmp_path, "p/other.cpp", "int main() {}\n")
    done = without_extra(tmp_path, "check", "--isolated", "p")
    assert done.returncode == 0
    assert done.stderr == f"msaa-lint: 2 source files skipped: {MISSING}\n"
    assert "No findings in 1 file" in done.stdout
    (tmp_path / "p/a.msaa.yaml").unlink()
    done = without_extra(tmp_path, "check", "--isolated", "p", "--output", "full")
    assert done.returncode == 2
    assert "nothing to lint in `p`" in done.stdout
    assert f"nothing to lint in `p`: {MISSING}" in done.stdout


def test_without_the_extra_descriptions_need_none(tmp_path: Path) -> None:
    write(tmp_path, "a.msaa.yaml", DESCRIPTION)
    done = without_extra(tmp_path, "check", "--isolated", "a.msaa.yaml")
    assert (done.returncode, done.stderr) == (0, "")


# Folders.


def checked(folder: Path, *arguments: str) -> int:
    """Returns the number of files of a run."""
    done = run(folder, "check", "--isolated", "--output", "json", *arguments)
    count: int = json.loads(done.stdout)["summary"]["files"]
    return count


def test_of_a_folder_what_speaks_of_multisampling_is_linted(tmp_path: Path) -> None:
    write(tmp_path, "yes/a.cpp")
    write(
        tmp_path,
        "yes/late.h",
        "// " + "x" * 500_000 + "\nvoid f(VkImageCreateInfo* info, int numSamples);\n",
    )
    write(tmp_path, "yes/a.frag", "uniform sampler2DMS image;\n")
    write(tmp_path, "yes/a.swift", "let d = MTLTextureDescriptor()\nd.sampleCount = 4\n")
    write(tmp_path, "yes/a.mm")
    write(
        tmp_path,
        "yes/a.m",
        "#import <Metal/Metal.h>\nvoid f(MTLTextureDescriptor *d) { d.sampleCount = 4; }\n",
    )
    assert checked(tmp_path, "yes") == 6
    write(tmp_path, "no/words/main.cpp", "int main() { return 0; } // MSAA, some day\n")
    write(
        tmp_path,
        "no/single.cpp",
        "VkImageCreateInfo info{};\ninfo.samples = VK_SAMPLE_COUNT_1_BIT;\n",
    )
    write(tmp_path, "no/far.cpp", "// " + "x" * (1 << 20) + "\nVkImageCreateInfo msaa;\n")
    write(tmp_path, "no/page.md", f"```cpp\n{CODE}```\n")
    write(tmp_path, "no/text.txt", f"```cpp\n{CODE}```\n")
    write(tmp_path, "no/page.adoc", f"[source,cpp]\n----\n{CODE}----\n")
    write(tmp_path, "no/a.java")
    write(tmp_path, "no/matlab.m", "function msaa(MTLTexture)\nend\n")
    write(tmp_path, "no/.hidden.cpp")
    write(tmp_path, "no/.git/a.cpp")
    write(tmp_path, "no/venv/a.cpp")
    done = run(tmp_path, "check", "--isolated", "no")
    assert done.returncode == 2
    assert "nothing to lint in `no`" in done.stdout


def test_of_a_folder_pages_are_linted_where_they_are_included(tmp_path: Path) -> None:
    write(tmp_path, "p/page.md", f"```cpp\n{CODE}```\n")
    write(tmp_path, "p/a.msaa.yaml", DESCRIPTION)
    write(tmp_path, "p/msaa-lint.toml", 'include = ["**/*.md"]\n')
    done = run(tmp_path, "check", "--select", RULE, "p")
    assert f"p/page.md:{LINE + 1}:{COLUMN}: {FOUND}" in done.stdout
    assert "in 1 file" in done.stdout


def test_exclude_and_per_file_ignores_hold_for_code(tmp_path: Path) -> None:
    write(tmp_path, "src/a.cpp")
    write(tmp_path, "third_party/a.cpp")
    write(tmp_path, "msaa-lint.toml", f'exclude = ["third_party/**"]\nselect = ["{RULE}"]\n')
    done = run(tmp_path, "check", ".")
    assert f"src/a.cpp:{PLACE}" in done.stdout
    assert "third_party" not in done.stdout
    write(
        tmp_path,
        "msaa-lint.toml",
        f'select = ["{RULE}"]\n[per-file-ignores]\n"src/**" = ["{RULE}"]\n',
    )
    done = run(tmp_path, "check", ".")
    assert "src/a.cpp" not in done.stdout
    assert f"third_party/a.cpp:{PLACE}" in done.stdout


def test_other_commands_take_code_that_is_named_alone(tmp_path: Path) -> None:
    write(tmp_path, "p/a.cpp")
    write(tmp_path, "p/a.msaa.yaml", DESCRIPTION)
    done = run(tmp_path, "cost", "p", "--output", "json", "--isolated")
    assert done.returncode == 0
    assert "a.cpp" not in done.stdout


# Pages.

PAGE = f"""\
# How the pass is made

First the attachments.

1. So:

   ```cpp
{"".join(f"   {line}" for line in CODE.splitlines(True)[:16])}   ...
   ```

> And the pass, *MSAA*:
>
> ~~~ C++
{"".join(f"> {line}" for line in CODE.splitlines(True)[16:])}> // ...
> ~~~

```python
attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE
```
"""


@pytest.mark.parametrize("name", ["page.md", "page.mdx", "page.txt"])
def test_the_blocks_of_a_page_are_one_program(tmp_path: Path, name: str) -> None:
    write(tmp_path, name, PAGE)
    line = PAGE[: PAGE.index(MISTAKE)].count("\n") + 1
    assert places(tmp_path, name) == [(line, WHOLE[0][1] + 3, WHOLE[0][2] + 3)]


def test_a_page_without_code_has_no_findings(tmp_path: Path) -> None:
    write(tmp_path, "page.md", "# MSAA\n\n```yaml\nimages: {}\n```\n")
    done = run(tmp_path, "check", *ONLY, "page.md")
    assert (done.returncode, done.stdout) == (
        0,
        "No findings in 1 file (1 Markdown page: nothing read)\n",
    )


# Suppressions.


def silenced(
    folder: Path, text: str, *arguments: str, name: str = "a.cpp"
) -> tuple[int, list[tuple[str, int, int]]]:
    """Returns the number of findings that comments suppress, and the others by rule, line, and
    column.
    """
    write(folder, name, text)
    done = run(folder, "check", "--output", "json", *ONLY, *arguments, name)
    result = json.loads(done.stdout)
    return len(result["suppressed"]), [
        (each["rule"], each["line"], each["column"]) for each in result["findings"]
    ]


@pytest.mark.parametrize(
    "comment",
    [
        f"// msaa-lint: ignore[{RULE}] the swapchain's",
        f"/* msaa-lint: ignore[{RULE}] the swapchain's */",
        "/* x */ // MSAA-lint: ignore[MSAA206]",
    ],
)
def test_a_comment_on_the_line_silences(tmp_path: Path, comment: str) -> None:
    assert silenced(tmp_path, CODE.replace(MISTAKE, f"{MISTAKE} {comment}")) == (1, [])


@pytest.mark.parametrize(
    "comment",
    [
        f"// msaa-lint: ignore[{RULE}] why\n",
        f"// msaa-lint: ignore[{RULE}] why\n// and more of it\n",
        f"/* msaa-lint: ignore[{RULE}] why */\n",
        f"/*\n     * msaa-lint: ignore[{RULE}] why\n     */\n",
    ],
)
def test_a_comment_alone_above_the_line_silences(tmp_path: Path, comment: str) -> None:
    assert silenced(tmp_path, CODE.replace(MISTAKE, f"{comment}    {MISTAKE}")) == (1, [])


def test_what_is_silenced_keeps_its_reason(tmp_path: Path) -> None:
    write(
        tmp_path,
        "a.cpp",
        CODE.replace(MISTAKE, f"{MISTAKE} /* msaa-lint: ignore[{RULE}] shown elsewhere */"),
    )
    done = run(tmp_path, "check", "--output", "json", *ONLY, "a.cpp")
    (entry,) = json.loads(done.stdout)["suppressed"]
    assert (entry["how"], entry["reason"], entry["finding"]["confidence"]) == (
        "inline",
        "shown elsewhere",
        "medium",
    )


def test_what_is_no_comment_silences_nothing(tmp_path: Path) -> None:
    for text in (
        f'; const char* s = "// msaa-lint: ignore[{RULE}]";',
        f'; auto s = R"(// msaa-lint: ignore[{RULE}])";',
    ):
        silent, left = silenced(tmp_path, CODE.replace(MISTAKE, MISTAKE + text))
        assert (silent, left) == (0, [(RULE, LINE, COLUMN)])


def test_no_ignores_disregards_them(tmp_path: Path) -> None:
    silent, left = silenced(
        tmp_path, CODE.replace(MISTAKE, f"{MISTAKE} // msaa-lint: ignore[{RULE}]"), "--no-ignores"
    )
    assert (silent, left) == (0, [(RULE, LINE, COLUMN)])


def test_the_first_comments_silence_for_the_file(tmp_path: Path) -> None:
    comment = f"// msaa-lint: ignore-file[{RULE}] generated\n"
    assert silenced(tmp_path, f"/* Copyright\n */\n\n{comment}{CODE}") == (1, [])
    silent, left = silenced(tmp_path, CODE.replace("\n\n", f"\n{comment}\n", 1))
    assert (silent, left) == (0, [("unused-suppression", 2, 1), (RULE, LINE + 1, COLUMN)])


def test_an_unused_comment_is_reported(tmp_path: Path) -> None:
    silent, left = silenced(
        tmp_path,
        GOOD.replace(
            "VkSubpassDescription subpass",
            f"/* msaa-lint: ignore[{RULE}] */ VkSubpassDescription subpass",
        ),
    )
    assert (silent, left) == (0, [("unused-suppression", 17, 26)])
    done = run(tmp_path, "check", *ONLY, "a.cpp")
    assert done.returncode == 0
    write(tmp_path, "b.cpp", f"{CODE}// msaa-lint: ignore\n")
    done = run(tmp_path, "check", *ONLY, "--output", "full", "b.cpp")
    assert "write `// msaa-lint: ignore[rule-name] reason`" in done.stdout


def test_comments_in_the_code_of_a_page_silence(tmp_path: Path) -> None:
    page = PAGE.replace(MISTAKE, f"{MISTAKE}  // msaa-lint: ignore[{RULE}]")
    assert silenced(tmp_path, page, name="page.md") == (1, [])
    outside = PAGE.replace("First the", f"// msaa-lint: ignore-file[{RULE}]\nFirst the")
    assert silenced(tmp_path, outside, name="page.md")[0] == 0


# The other commands.


def test_convert_writes_what_was_read(tmp_path: Path) -> None:
    write(tmp_path, "a.cpp")
    done = run(tmp_path, "convert", "a.cpp", "-o", "out.msaa.yaml")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    text = (tmp_path / "out.msaa.yaml").read_text()
    assert text.startswith("# Read from a.cpp; what it does not state is left out.\n")
    assert text == (tmp_path / "out.msaa.yaml").read_text()
    done = run(tmp_path, "check", *ONLY, "out.msaa.yaml")
    assert done.returncode == 1
    assert FOUND in done.stdout
    assert run(tmp_path, "convert", "a.cpp", "-o", "out.msaa.yaml").returncode == 2
    write(tmp_path, "empty.cpp", "int main() {}\n")
    done = run(tmp_path, "convert", "empty.cpp")
    assert (done.returncode, done.stdout) == (2, "")
    assert "empty.cpp: found no attachment" in done.stderr


def test_cost_reckons_what_the_code_states(tmp_path: Path) -> None:
    write(tmp_path, "a.cpp", GOOD)
    done = run(
        tmp_path,
        "cost",
        "a.cpp",
        "--isolated",
        "--size",
        "1920x1080",
        "--fps",
        "60",
        "--output",
        "json",
    )
    assert done.returncode == 0
    # One sample per pixel with four bytes, stored sixty times a second.
    assert json.loads(done.stdout)["total"]["write_mb_per_s"] == pytest.approx(
        1920 * 1080 * 4 * 60 / 1e6
    )


def test_facts_shows_what_is_known(tmp_path: Path) -> None:
    write(tmp_path, "a.cpp")
    done = run(tmp_path, "facts", "a.cpp", "--output", "json")
    assert done.returncode == 0
    facts = [row["facts"] for row in json.loads(done.stdout) if row["subject"] == "attachment"]
    samples = [
        (each["attachment.samples"]["value"], each["attachment.samples"]["line"]) for each in facts
    ]
    assert samples == [(4, 6), (1, 11)]


@pytest.mark.parametrize("command", ["confirm", "study"])
def test_code_is_not_drawn(tmp_path: Path, command: str) -> None:
    write(tmp_path, "a.cpp")
    done = run(tmp_path, command, "a.cpp")
    assert done.returncode == 2
    assert (
        "a.cpp: source code does not describe a complete frame: complete the description that "
        "`msaa-lint convert` writes" in done.stderr
    )


# Assumptions.


def test_what_is_assumed_is_a_note(monkeypatch: pytest.MonkeyPatch) -> None:
    from types import ModuleType

    from msaa_lint.core.text.node_builder import mapping
    from msaa_lint.core.text.span import Span
    from msaa_lint.input import code as programs

    def trees(code: parsing.Code) -> list[parsing.Read]:
        at = Span(0, 1)
        assumed = tuple(
            (f"the sample count `m_{n}`", Span(code.text.index("m_"), 3), str(n)) for n in range(4)
        )
        return [parsing.Read(mapping([], at), assumed[:1]), parsing.Read(mapping([], at), assumed)]

    stand_in = ModuleType("msaa_lint.input.code.stand_in")
    stand_in.trees = trees  # type: ignore[attr-defined]
    monkeypatch.setitem(__import__("sys").modules, "msaa_lint.input.code.stand_in", stand_in)
    monkeypatch.setitem(programs.MODULES, "cpp", "stand_in")
    program = read_source_file(b"// samples\nint m_samples;\n", "a.cpp", "cpp").program
    first = "the sample count `m_0` (line 2) is unknown; assumed to be 0"
    assert program.assumed[0] == (first,)
    assert program.assumed[1][0] == first
    assert program.assumed[1][3:] == ("1 more assumption",)


@pytest.mark.parametrize(
    ("name", "code", "language"),
    [
        ("a.m", "function y = f(x)\nend\n", "MATLAB"),
        ("a.m", "(* x *)\n", "Mathematica"),
        ("a.m", ":- module x.\n", "Mercury"),
    ],
)
def test_other_languages_with_the_ending_of_objective_c_are_named(
    tmp_path: Path, name: str, code: str, language: str
) -> None:
    (tmp_path / name).write_text(code, encoding="utf-8")
    done = run(tmp_path, "check", "--isolated", name)
    assert done.returncode == 2
    assert (
        f"this is {language}, which is not read; --input-format can be c, cpp, objc," in done.stdout
    )


@pytest.mark.parametrize(
    ("page", "text"),
    [("a.adoc", "[source,cpp]\n----\n{}----\n"), ("a.rst", ".. code-block:: cpp\n\n{}")],
)
def test_code_of_pages_is_checked_at_its_lines(tmp_path: Path, page: str, text: str) -> None:
    code = (
        CODE
        if page == "a.adoc"
        else "".join(f"   {line}\n" if line else "\n" for line in CODE.splitlines())
    )
    write(tmp_path, page, text.format(code))
    ((line, column, _),) = places(tmp_path, page)
    assert (line, column) == (LINE + 2, COLUMN + 3 * (page == "a.rst"))


@pytest.mark.parametrize(
    ("name", "language"), [("shader.HLSL", "HLSL"), ("main.go", "Go"), ("App.java", "Java")]
)
def test_a_language_that_is_not_read_is_said_to_be(
    tmp_path: Path, name: str, language: str
) -> None:
    path = tmp_path / name
    path.write_text(CODE, encoding="utf-8")
    done = run(tmp_path, "check", "--isolated", name)
    assert done.returncode == 2
    assert f"this is {language}, which is not read; --input-format can be c, cpp," in done.stdout
    assert run(tmp_path, "check", *ONLY, "--input-format", "cpp", name).stdout.startswith(
        f"{name}:{PLACE}: {FOUND}"
    )


def test_folders_are_checked_without_the_headers_of_vulkan(tmp_path: Path) -> None:
    (tmp_path / "libs").mkdir()
    (tmp_path / "libs/vulkan_hash.hpp").write_text(
        "struct VkImageCreateInfo { VkSampleCountFlagBits samples; };\n"
    )
    (tmp_path / "libs/targets.h").write_text(
        "#define LEVELS VK_SAMPLE_COUNT_4_BIT\nstruct Targets { VkImageCreateInfo color; };\n"
    )
    text = (
        '#include "targets.h"\nvoid f(VkImageCreateInfo& info) { info.samples = LEVELS; int '
        "msaaSampleCount; }\n"
    )
    (tmp_path / "libs/targets.cpp").write_text(text)
    report = json.loads(
        run(tmp_path, "check", "--isolated", "--no-cache", "--output", "json", ".").stdout
    )
    assert [entry["file"] for entry in report["inputs"]] == ["libs/targets.cpp", "libs/targets.h"]

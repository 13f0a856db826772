"""A mistake in msaa-lint that one input meets never takes down the rest."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from unittest import mock

import pytest

from msaa_lint.linter.engine import Engine
from msaa_lint.linter.rules import registry
from tests.command import run

STORED = """\
renderPasses:
  main:
    attachments:
      color: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: STORE}
      output: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output]}
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("a", "b", "c"):
        (tmp_path / f"{name}.msaa.yaml").write_text(STORED)
    return tmp_path


def failing_on(name: str) -> Any:
    """An engine that fails on one input."""
    lint = Engine.lint

    def failing(self: Engine, data: Any, file: str, options: Any) -> Any:
        if file == name:
            raise IndexError("list index\x1b[31m out of range")
        return lint(self, data, file, options)

    return mock.patch.object(Engine, "lint", failing)


@pytest.mark.parametrize("format", ["json", "sarif", "gitlab", "rdjson"])
def test_the_other_inputs_are_linted_and_machine_formats_are_whole(
    folder: Path, format: str
) -> None:
    with failing_on("b.msaa.yaml"):
        done = run(folder, "check", "--isolated", "--output", format, ".")
    assert done.returncode == 2
    text = json.dumps(json.loads(done.stdout))
    assert text.count("multisampled-attachment-stored") >= 2 and "internal-error" in text
    assert "\x1b" not in done.stdout + done.stderr


def test_it_is_a_finding_of_its_input(folder: Path) -> None:
    with failing_on("b.msaa.yaml"):
        done = run(folder, "check", "--isolated", "--output", "concise", ".")
    (line,) = [line for line in done.stdout.splitlines() if line.startswith("b.msaa.yaml")]
    assert line.startswith("b.msaa.yaml: error[internal-error] internal error: IndexError: ")
    assert "(MSAA941)" in line and "in 3 files" in done.stdout


def test_traceback_shows_where(folder: Path) -> None:
    with failing_on("b.msaa.yaml"), pytest.raises(IndexError):
        run(folder, "check", "--isolated", "--traceback", ".")


def test_cost_shows_the_other_frames(folder: Path) -> None:
    with failing_on("b.msaa.yaml"):
        done = run(folder, "cost", "--isolated", "--size", "640x480", "--output", "json", ".")
    output = json.loads(done.stdout)
    assert done.returncode == 2
    assert [frame["file"] for frame in output["frames"]] == ["a.msaa.yaml", "c.msaa.yaml"]
    assert [error["code"] for error in output["errors"]] == ["MSAA941"]


def test_a_designator_with_a_negative_index(tmp_path: Path) -> None:
    """C refuses it; the value of the enumerator may be wrong, or unknown."""
    (tmp_path / "a.c").write_text(
        "#include <vulkan/vulkan.h>\nenum { A = -1, B };\nvoid f(void) {\n"
        "  VkAttachmentDescription at[2] = {[A] = {.samples = VK_SAMPLE_COUNT_4_BIT}, [B] = "
        "{.samples = VK_SAMPLE_COUNT_1_BIT}};\n"
        "  VkRenderPassCreateInfo info = {.attachmentCount = 2, .pAttachments = at};\n"
        "  VkRenderPass pass;\n  vkCreateRenderPass(device, &info, 0, &pass);\n}\n"
    )
    done = run(tmp_path, "check", "--isolated", "--output", "concise", "a.c")
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize(
    "call",
    [
        "modf(1.0)",
        "frexp(1.0)",
        "textureSamples()",
        "texelFetch(s).x",
        "interpolateAtSample(v)",
        "clamp(1.0)",
    ],
)
def test_calls_with_too_few_arguments(call: str, tmp_path: Path) -> None:
    (tmp_path / "a.frag").write_text(
        "#version 450\nlayout(binding = 0) uniform sampler2DMS s;\nlayout(location = 0) in vec4 "
        "v;\nlayout(location = 0) out vec4 o;\n"
        f"void main() {{ o = texelFetch(s, ivec2(0), 0); float q = float({call}); o.x += q; }}\n"
    )
    done = run(tmp_path, "check", "--isolated", "--output", "concise", "a.frag")
    assert done.returncode == 0, done.stdout


def fail(*_: object, **__: object) -> Any:
    raise RecursionError("maximum recursion depth exceeded")


@pytest.mark.parametrize(
    "format", ["json", "sarif", "gitlab", "rdjson", "junit", "azure", "teamcity"]
)
def test_a_run_that_fails_is_its_only_finding(folder: Path, format: str) -> None:
    """A program that reads the output finds a whole document."""
    with mock.patch("msaa_lint.linter.run.Workspace", fail):
        done = run(folder, "check", "--isolated", "--output", format, ".")
    assert done.returncode == 2 and "internal error: RecursionError" in done.stdout
    if format in ("json", "sarif", "gitlab", "rdjson"):
        json.loads(done.stdout)


@pytest.mark.parametrize(
    "words", ["rule --all --output json", "check --isolated --output json a.msaa.yaml"]
)
def test_a_rule_page_that_fails_is_a_finding_of_the_page(folder: Path, words: str) -> None:
    for name in ("acme-one", "acme-two"):
        code = "ACME1" if name == "acme-one" else "ACME2"
        page = (
            f"---\ncode: {code}\nseverity: warning\nsubject: image\nwhen: image.samples > 1\n"
            "message: x\n---\nText.\n"
        )
        (folder / f"{name}.md").write_text(page)
    read = registry.read_page

    def failing(path: str, *rest: Any) -> Any:
        return fail() if path.endswith("acme-one.md") else read(path, *rest)

    with mock.patch.object(registry, "read_page", failing):
        done = run(folder, *words.split(), "--rules", "acme-one.md", "--rules", "acme-two.md")
    assert done.returncode == 2 and "internal error: RecursionError" in done.stdout + done.stderr
    json.loads(done.stdout)
    assert words.startswith("check") or "ACME2" in done.stdout


@pytest.mark.parametrize(
    ("words", "target", "kept"),
    [
        ("convert a.msaa.yaml", "msaa_lint.cli.convert.load", ""),
        ("facts a.msaa.yaml", "msaa_lint.cli.facts.load", ""),
        ("facts a.msaa.yaml --output json", "msaa_lint.frame.facts.program.subjects_of", "[]\n"),
    ],
)
def test_a_command_of_one_input_names_it(folder: Path, words: str, target: str, kept: str) -> None:
    with mock.patch(target, fail):
        done = run(folder, *words.split())
    assert (done.returncode, done.stdout) == (2, kept)
    assert (
        done.stderr.startswith("msaa-lint: a.msaa.yaml: internal error: RecursionError: ")
        and done.stderr.count("\n") == 1
    )
    with mock.patch(target, fail), pytest.raises(RecursionError):
        run(folder, *words.split(), "--traceback")

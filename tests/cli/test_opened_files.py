"""Nothing outside the project is opened because content names it: neither to read it, nor to tell
whether a kept result still holds.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from msaa_lint.linter.input_runs import MIN_KEPT
from tests.command import environment_of

pytestmark = pytest.mark.skipif(os.name != "posix", reason="links are tried")

WATCHED = """
import os, sys

outside = os.path.realpath(sys.argv.pop(1))

def watch(event, arguments):
    if event in ("open", "os.listdir", "os.scandir") and arguments and isinstance(arguments[0], (str, bytes)):
        path = os.path.realpath(os.fsdecode(arguments[0]))
        if path == outside or path.startswith(outside + os.sep):
            os.write(2, f"OPENED {path}\\n".encode())

sys.addaudithook(watch)
from msaa_lint.__main__ import main
main()
"""

PADDING = "# Results of less than MIN_KEPT bytes of inputs are not kept.\n" * (MIN_KEPT // 60 + 1)
SHADED = (
    """\
images: {color: {format: R8G8B8A8_UNORM, samples: 8, usage: [COLOR_ATTACHMENT]}}
pipelines:
  own:
    rendering: {colorAttachmentFormats: [R8G8B8A8_UNORM]}
    multisampleState: {rasterizationSamples: 4, alphaToCoverageEnable: true}
    stages: [{stage: FRAGMENT, module: "MODULE"}]
"""
    + PADDING
)
CODE = """\
#include "../outside/header.h"
#include "up/header.h"
#include "header.h"
#include "OUTSIDE/header.h"
VkAttachmentDescription attachment = {.format = VK_FORMAT_R8G8B8A8_UNORM, .samples = COUNT};
VkRenderPassCreateInfo create = {.attachmentCount = 1, .pAttachments = &attachment};
""" + PADDING.replace("#", "//")


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A repository of which every file names what is beside it, in a folder that exists."""
    outside, project = tmp_path / "outside", tmp_path / "project"
    outside.mkdir()
    (project / ".git").mkdir(parents=True)
    (project / "rules").mkdir()
    for name in (
        "module.spv",
        "shader.frag",
        "header.h",
        "page.md",
        "base.toml",
        "base.json",
        "frame.msaa.yaml",
        "ignored",
    ):
        (outside / name).write_text("#define COUNT VK_SAMPLE_COUNT_4_BIT\n")
    (project / "up").symlink_to("../outside")
    (project / "link.spv").symlink_to("../outside/module.spv")
    (project / "header.h").symlink_to("../outside/header.h")
    (project / "linked.msaa.yaml").symlink_to("../outside/frame.msaa.yaml")
    (project / ".gitignore").symlink_to("../outside/ignored")
    (project / "compile_commands.json").symlink_to("../outside/base.json")
    modules = (
        "../outside/module.spv",
        "up/shader.frag",
        "link.spv",
        f"{outside}/module.spv",
        "../project/../outside/gone.spv",
    )
    for number, module in enumerate(modules):
        (project / f"shaded{number}.msaa.yaml").write_text(SHADED.replace("MODULE", module))
        (project / f"shaded{number}.msaa.yaml.msaa-study.json").symlink_to("../outside/base.json")
        (project / f"device{number}.msaa.yaml").write_text(
            SHADED.replace("MODULE", "none.spv") + f"device: {module}\n"
        )
    (project / "code.cpp").write_text(CODE.replace("OUTSIDE", str(outside)))
    return project


def run(project: Path, *arguments: str) -> tuple[str, list[str]]:
    """What the command prints and what of the folder outside it opens, with a cache."""
    done = subprocess.run(
        [sys.executable, "-c", WATCHED, str(project.parent / "outside"), *arguments],
        cwd=project,
        env=environment_of({"XDG_CACHE_HOME": str(project.parent / "cache")}),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode in (0, 1, 2) and "Traceback" not in done.stderr, done.stderr
    return done.stdout, [line for line in done.stderr.splitlines() if line.startswith("OPENED")]


def settled() -> None:
    """Waits until files that were written are kept: what has just been written is not."""
    time.sleep(0.05)


@pytest.mark.parametrize(
    "command", ["check", "check --jobs 2", "check --fix --diff", "cost", "convert"]
)
def test_inputs_that_name_what_is_outside(project: Path, command: str) -> None:
    """Cold, then with what the first run kept."""
    settled()
    paths = ["."] if command != "convert" else ["shaded0.msaa.yaml"]
    first, again = (run(project, *command.split(), *paths) for _ in range(2))
    assert first[1] == again[1] == [], command
    assert first[0] == again[0]
    if command == "check":
        assert first[0].count("is outside the project") >= 6, first[0]


@pytest.mark.parametrize("key", ["rules", "extends", "baseline", "profile"])
@pytest.mark.parametrize("folder", ["../outside", "up"])
def test_a_configuration_that_names_what_is_outside(project: Path, key: str, folder: str) -> None:
    name = {
        "rules": "page.md",
        "extends": "base.toml",
        "baseline": "base.json",
        "profile": "base.json",
    }[key]
    (project / "rules/own.md").symlink_to("../../outside/page.md")
    (project / "msaa-lint.toml").write_text(
        f"{key} = " + (f'["{folder}/{name}", "rules"]' if key == "rules" else f'"{folder}/{name}"')
    )
    settled()
    for command in (
        "check shaded0.msaa.yaml",
        "check --jobs 2 .",
        "cost shaded0.msaa.yaml",
        "baseline --file b.json shaded0.msaa.yaml",
    ):
        assert run(project, *command.split())[1] == [], command


@pytest.mark.parametrize("name", ["inner.spv", "folder/inner.spv"])
def test_what_was_inside_when_it_was_kept(project: Path, name: str) -> None:
    """A kept result is not compared with what a link leads to since then, and it does not outlast
    the refusal.
    """
    (project / "folder").mkdir()
    (project / name).write_bytes(b"not SPIR-V")
    (project / "shaded0.msaa.yaml").write_text(SHADED.replace("MODULE", name))
    settled()
    command = ("check", "--output", "json", "shaded0.msaa.yaml")

    def messages() -> list[str]:
        output, opened = run(project, *command)
        assert opened == []
        return [
            finding["message"]
            for finding in json.loads(output)["findings"]
            if finding["code"] in ("MSAA903", "MSAA904")
        ]

    assert messages() == [f"`{name}`: it is not SPIR-V"] or "outside" not in messages()[0]
    (project / name).unlink()
    (project.parent / "outside/inner.spv").write_bytes(b"not SPIR-V")
    if "/" in name:
        (project / "folder").rmdir()
        (project / "folder").symlink_to("../outside")
    else:
        (project / name).symlink_to("../outside/inner.spv")
    settled()
    for _ in range(2):
        assert messages() == [f"`{name}` is outside the project"]
    (project.parent / "outside/inner.spv").unlink()
    assert messages() == [f"`{name}` is outside the project"]
    (project / name.partition("/")[0]).unlink()
    settled()
    assert messages() == [f"file not found: `{name}`"]

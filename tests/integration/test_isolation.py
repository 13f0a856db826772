"""Nothing in the working folder is imported, run, or read as somebody else's settings, whatever it
is called.
"""

from __future__ import annotations

import functools
import os
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from tests.command import environment_of, run_process
from tests.integration.test_pre_commit import GOOD
from tests.paths import ROOT

DESCRIPTION = GOOD.replace("renderPasses:", "frame: {width: 64, height: 64}\nrenderPasses:")
MESH = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
CODE = """\
VkAttachmentDescription attachment = {.format = VK_FORMAT_R8G8B8A8_UNORM, .samples = VK_SAMPLE_COUNT_4_BIT};
VkRenderPassCreateInfo create = {.attachmentCount = 1, .pAttachments = &attachment};
"""

STUDY = ("study", "triangle.obj", "--size", "32x32", "--samples", "1", "--techniques", "msaa")
COMMANDS = [
    ("--version",),
    ("--help",),
    ("check", "frame.msaa.yaml", "--output", "sarif"),
    ("check", "--fix", "frame.msaa.yaml", "code.cpp"),
    ("convert", "code.cpp"),
    ("cost", "frame.msaa.yaml", "--chart", "chart.svg"),
    ("confirm", "frame.msaa.yaml"),
    (*STUDY, "--jobs", "1"),
    (*STUDY, "--jobs", "2", "--plot", "plot.svg"),
    ("rule", "--all"),
    ("device", "mali-g76"),
    ("init", "new"),
]


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A folder with inputs."""
    for name, text in (
        ("frame.msaa.yaml", DESCRIPTION),
        ("triangle.obj", MESH),
        ("code.cpp", CODE),
    ):
        (tmp_path / name).write_text(text)
    return tmp_path


def modules() -> set[str]:
    """What Python, the packages that are installed, and this program may import."""
    loaded = {name.partition(".")[0] for name in sys.modules}
    packages = {
        name.partition("-")[0].partition(".")[0]
        for name in os.listdir(Path(pytest.__file__).parent.parent)
    }
    names = {
        *loaded,
        *packages,
        *sys.stdlib_module_names,
        "sitecustomize",
        "usercustomize",
        "pip",
        "venv",
        "vulkan",
        "trimesh",
    }
    return {name for name in names if name.isidentifier()} - {"__main__", "tests"}


@functools.lru_cache
def of_python() -> set[str]:
    """What Python itself imports for `python -m`, and for the packages of its environment, before
    any program has a say.
    """
    command = [sys.executable, "-c", "import runpy, sys, traceback\nprint(*sys.modules)"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return {name.partition(".")[0] for name in done.stdout.split()} | {
        "_distutils_hack",
        "sitecustomize",
        "usercustomize",
    }


def poison(folder: Path, names: set[str]) -> None:
    """Writes modules that say that they were imported."""
    marker = str(folder / "imported")
    for name in names:
        text = f"open({marker!r}, 'a').write({name + chr(10)!r})\n"
        if len(name) % 2:
            (folder / f"{name}.py").write_text(text)
        else:
            (folder / name).mkdir()
            (folder / name / "__init__.py").write_text(text)
    (folder / "evil.pth").write_text(f"import os; open({marker!r}, 'a').write('pth')\n")


def imported(folder: Path) -> str:
    path = folder / "imported"
    return path.read_text() if path.exists() else ""


def run_script(folder: Path, *command: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Runs the command as its console script does."""
    script = folder / "bin of python"
    script.mkdir(exist_ok=True)
    (script / "msaa-lint").write_text(
        "import re, sys\nfrom msaa_lint.__main__ import main\nsys.exit(main())\n"
    )
    arguments = [sys.executable, str(script / "msaa-lint"), *command]
    return subprocess.run(
        arguments,
        cwd=folder,
        env=environment_of(environment),
        capture_output=True,
        text=True,
        check=False,
    )


def test_no_module_of_the_working_folder_is_imported(checkout: Path) -> None:
    poison(checkout, modules())
    for command in COMMANDS:
        done = run_script(checkout, *command)
        assert imported(checkout) == "", command
        assert (
            done.returncode in ((2,) if command[0] == "convert" else (0, 1))
            and done.stdout + done.stderr
        ), command


def test_nor_by_python_dash_m(checkout: Path) -> None:
    poison(checkout, modules() - of_python() - {"msaa_lint"})
    for command in (("check", "code.cpp"), ("confirm", "frame.msaa.yaml"), (*STUDY, "--jobs", "2")):
        done = run_process(checkout, *command)
        assert imported(checkout) == "", command
        assert done.returncode in (0, 1) and done.stdout + done.stderr, command


def test_no_relative_entry_of_pythonpath_is_searched(checkout: Path) -> None:
    poison(checkout, modules() - of_python())
    paths = os.pathsep.join([environment_of({})["PYTHONPATH"], ".", "", "./", "/nowhere", ""])
    done = run_script(checkout, *STUDY, "--jobs", "2", PYTHONPATH=paths)
    assert imported(checkout) == ""
    assert done.returncode == 0, done.stderr


def test_the_hooks_and_the_action_ignore_pythonpath(checkout: Path) -> None:
    """Python itself imports from it before any program runs, so they have none: docs/security.md
    says what holds for other uses.
    """
    poison(checkout, modules())
    hooks = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    assert len(hooks) == 2
    for hook in hooks:
        python, *words = hook["entry"].split()
        assert python == "python"
        done = subprocess.run(
            [sys.executable, *words, "frame.msaa.yaml"],
            cwd=checkout,
            env=environment_of({"PYTHONPATH": f".{os.pathsep}"}),
            capture_output=True,
            text=True,
            check=False,
        )
        assert imported(checkout) == "" and done.returncode in (0, 1), done.stderr
    steps = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))["runs"]["steps"]
    lint = next(step["env"] for step in steps if step["name"] == "Lint")
    assert (lint["PYTHONPATH"], lint["PYTHONSAFEPATH"]) == ("", "1")
    done = run_script(
        checkout,
        "check",
        "frame.msaa.yaml",
        PYTHONPATH=lint["PYTHONPATH"],
        PYTHONSAFEPATH=lint["PYTHONSAFEPATH"],
    )
    assert imported(checkout) == "" and done.returncode in (0, 1), done.stderr
    stated = checkout / "stated"
    stated.mkdir()
    poison(stated, {"sitecustomize"})
    run_script(stated, "--version", PYTHONPATH=f".{os.pathsep}{ROOT}")
    assert imported(stated).startswith("sitecustomize"), (
        "as the documentation says of relative entries"
    )


@pytest.mark.skipif(os.name != "posix", reason="scripts with an interpreter line")
@pytest.mark.parametrize("path", [f".{os.pathsep}{os.pathsep}{os.environ['PATH']}", ""])
def test_no_program_of_the_working_folder_is_run(checkout: Path, path: str) -> None:
    names = {name for folder in ("/bin", "/usr/bin", "/sbin") for name in os.listdir(folder)}
    for name in names | {
        "glslangValidator",
        "git",
        "adb",
        "pip",
        "python",
        "python3",
        "msaa-lint",
        "lscpu",
    }:
        (checkout / name).write_text(f"#!/bin/sh\necho {name} >>{checkout}/imported\n")
        (checkout / name).chmod(0o755)
    for command in (("check", "."), ("confirm", "frame.msaa.yaml"), (*STUDY, "--jobs", "2")):
        run_process(checkout, *command, PATH=path)
    assert imported(checkout) == ""


@pytest.mark.parametrize(
    "option", [("cost", "frame.msaa.yaml", "--chart"), (*STUDY, "--jobs", "1", "--plot")]
)
def test_no_settings_of_a_working_folder_change_a_figure(
    checkout: Path, option: tuple[str, ...]
) -> None:
    assert run_process(checkout, *option, "plain.svg").returncode == 0
    for name in ("package.json", "deno.json", "vl-convert.json", ".fonts.conf", "fonts.conf"):
        (checkout / name).write_text("{")
    done = run_process(
        checkout,
        *option,
        "again.svg",
        DENO_DIR="settings",
        FONTCONFIG_FILE="fonts.conf",
        TMPDIR=str(checkout),
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert (checkout / "again.svg").read_bytes() == (checkout / "plain.svg").read_bytes()
    assert not (checkout / "settings").exists()

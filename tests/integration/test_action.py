"""The GitHub action: its form, and what its steps run, by bash with stand-ins for the runner."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.paths import ROOT

ACTION: dict[str, Any] = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
STEPS: list[dict[str, Any]] = ACTION["runs"]["steps"]

needs_bash = pytest.mark.skipif(shutil.which("bash") is None or os.name == "nt", reason="bash is not installed")


def jobs(workflow: Path) -> list[dict[str, Any]]:
    steps: list[dict[str, Any]] = []
    for job in yaml.safe_load(workflow.read_text(encoding="utf-8"))["jobs"].values():
        steps.extend(job["steps"])
    return steps


def test_inputs_and_outputs_are_described() -> None:
    assert ACTION["runs"]["using"] == "composite"
    for each in (*ACTION["inputs"].values(), *ACTION["outputs"].values()):
        assert each["description"].endswith(".")
    assert set(ACTION["inputs"]) == {"paths", "config", "fail-on", "source", "args", "annotations", "upload-sarif", "version"}
    assert all(isinstance(each["default"], str) for each in ACTION["inputs"].values())


@pytest.mark.parametrize("steps", [STEPS, *map(jobs, WORKFLOWS)], ids=["action.yml", *(path.name for path in WORKFLOWS)])
def test_scripts_hold_no_expressions(steps: list[dict[str, Any]]) -> None:
    """What `${{ }}` stands for is put into a script before the shell reads it: who chose it would run what they like."""
    scripts = [step["run"] for step in steps if "run" in step]
    assert scripts
    assert [script for script in scripts if "${{" in script] == []


@pytest.mark.parametrize("steps", [STEPS, *map(jobs, WORKFLOWS)], ids=["action.yml", *(path.name for path in WORKFLOWS)])
def test_actions_of_others_are_pinned(steps: list[dict[str, Any]]) -> None:
    used = [step["uses"] for step in steps if "uses" in step]
    assert used
    assert [name for name in used if not re.fullmatch(r"[\w-]+(/[\w-]+)+@v\d+", name)] == []


def test_every_input_is_used_and_every_one_used_exists() -> None:
    text = json.dumps(STEPS)
    assert set(re.findall(r"inputs\.([\w-]+)", text)) == set(ACTION["inputs"])
    assert set(re.findall(r"steps\.([\w-]+)\.", text)) <= {step.get("id") for step in STEPS}


def test_composite_steps_name_their_shell() -> None:
    assert {step["shell"] for step in STEPS if "run" in step} == {"bash"}


def step(name: str) -> dict[str, Any]:
    return next(each for each in STEPS if each["name"] == name)


class Runner:
    """A folder that looks like a runner's: msaa-lint and pip are stand-ins that write down what they were given."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.bin = folder / "temp" / "msaa-lint" / "bin"
        self.bin.mkdir(parents=True)
        self.given = folder / "given"
        self.stand_in(0)

    def stand_in(self, code: int, sarif: str = "{}") -> None:
        body = (
            f"#!{sys.executable}\nimport json, sys\n"
            f"json.dump(sys.argv[1:], open({str(self.given)!r}, 'w'))\n"
            "for word in sys.argv:\n"
            "    if word.startswith('sarif='):\n"
            f"        open(word[6:], 'w').write({sarif!r})\n"
            f"sys.exit({code})\n"
        )
        for name in ("msaa-lint", "python"):
            (self.bin / name).write_text(body)
            (self.bin / name).chmod(0o755)

    def run(self, name: str, **inputs: str) -> tuple[int, list[str], dict[str, str]]:
        """Runs a step; its exit code, what the stand-in was given, and the step's outputs."""
        values = {key: each["default"] for key, each in ACTION["inputs"].items()} | {key.replace("_", "-"): v for key, v in inputs.items()}
        stated: dict[str, str] = step(name)["env"]
        filled = {key: re.sub(r"\$\{\{ inputs\.([\w-]+) \}\}", lambda m: values[m[1]], text) for key, text in stated.items()}
        filled["PYTHON"] = "true"
        output = self.folder / "output"
        output.write_text("")
        environment = {
            **filled, "PATH": os.environ["PATH"], "RUNNER_TEMP": str(self.folder / "temp"), "GITHUB_OUTPUT": str(output),
            "GITHUB_ACTION_PATH": "/the action/at its ref",
        }  # fmt: skip
        command = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step(name)["run"]]
        done = subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True, check=False)
        assert not done.stderr, done.stderr
        return done.returncode, json.loads(self.given.read_text()), dict(line.split("=", 1) for line in output.read_text().splitlines())


@pytest.fixture
def runner(tmp_path: Path) -> Runner:
    return Runner(tmp_path)


@needs_bash
def test_lints_the_current_folder_by_default(runner: Runner) -> None:
    sarif = f"{runner.folder}/temp/msaa-lint.sarif"
    code, given, outputs = runner.run("Lint")
    assert code == 0
    assert given == ["check", "--output", "github", "--output", f"sarif={sarif}", "--", "."]
    assert outputs == {"exit-code": "0", "sarif": sarif}


@needs_bash
def test_gives_on_what_the_inputs_say(runner: Runner) -> None:
    _, given, outputs = runner.run(
        "Lint",
        paths="renderer/a folder\r\n\nmore.yaml\n",
        config="ci/msaa lint.toml",
        fail_on="error",
        args="--select MSAA2\n  --profile mali-g715\n",
        annotations="false",
        upload_sarif="false",
    )
    options = ["--output", "full", "--config=ci/msaa lint.toml", "--fail-on=error", "--select", "MSAA2", "--profile", "mali-g715"]
    assert given == ["check", *options, "--", "renderer/a folder", "more.yaml"]
    assert outputs == {"exit-code": "0", "sarif": ""}


HOSTILE = "$(touch owned) `touch owned`; touch owned; \"; touch owned; ' * ${PATH} \\"


@needs_bash
@pytest.mark.parametrize("name", ["paths", "config", "fail_on", "args"])
def test_inputs_are_words_and_no_code(runner: Runner, name: str) -> None:
    _, given, _ = runner.run("Lint", **{name: HOSTILE})
    assert not (runner.folder / "owned").exists()
    whole = {"paths": HOSTILE, "config": f"--config={HOSTILE}", "fail_on": f"--fail-on={HOSTILE}"}
    if name in whole:
        assert whole[name] in given
    else:
        assert "owned;" in given
        assert "${PATH}" in given


@needs_bash
def test_a_path_is_no_option(runner: Runner) -> None:
    _, given, _ = runner.run("Lint", paths="--exit-zero\n-")
    assert given[-3:] == ["--", "--exit-zero", "-"]


@needs_bash
@pytest.mark.parametrize("code", [1, 2])
def test_ends_as_the_linter_ends_and_still_uploads(runner: Runner, code: int) -> None:
    runner.stand_in(code)
    ended, _, outputs = runner.run("Lint")
    assert ended == code
    assert outputs["exit-code"] == str(code)
    assert outputs["sarif"].endswith("/msaa-lint.sarif")
    assert "!cancelled()" in step("Upload to code scanning")["if"]


@needs_bash
def test_uploads_nothing_where_nothing_was_written(runner: Runner) -> None:
    runner.stand_in(2, sarif="")
    ended, _, outputs = runner.run("Lint")
    assert ended == 2
    assert outputs["sarif"] == ""


@needs_bash
@pytest.mark.parametrize(
    ("version", "source", "wanted"),
    [
        ("", "false", "/the action/at its ref"),
        ("0.1.0; x", "no", "msaa-lint==0.1.0; x"),
        ("", "true", "/the action/at its ref[source]"),
        ("0.1.0", "true", "msaa-lint[source]==0.1.0"),
    ],
)
def test_installs_its_own_ref_or_a_release(runner: Runner, version: str, source: str, wanted: str) -> None:
    code, given, _ = runner.run("Install msaa-lint", version=version, source=source)
    assert code == 0
    assert given[:3] == ["-m", "pip", "install"]
    assert given[-1] == wanted

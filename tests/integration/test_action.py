"""The GitHub action: its form, and what its steps do, run by bash with stand-ins for the runner and
for Python.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.integration.test_pre_commit import BAD, GOOD, SHIPPED
from tests.paths import ROOT

ACTION: dict[str, Any] = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
DOCS = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
STEPS: list[dict[str, Any]] = ACTION["runs"]["steps"]

needs_bash = pytest.mark.skipif(
    shutil.which("bash") is None or os.name == "nt", reason="bash is not installed"
)


def jobs(workflow: Path) -> list[dict[str, Any]]:
    steps: list[dict[str, Any]] = []
    for job in yaml.safe_load(workflow.read_text(encoding="utf-8"))["jobs"].values():
        steps.extend(job["steps"])
    return steps


def test_inputs_and_outputs_are_described() -> None:
    assert ACTION["runs"]["using"] == "composite"
    for entry in (*ACTION["inputs"].values(), *ACTION["outputs"].values()):
        assert entry["description"].endswith(".")
    names = {
        "paths",
        "config",
        "fail-on",
        "source",
        "args",
        "annotations",
        "upload-sarif",
        "category",
        "version",
    }
    assert set(ACTION["inputs"]) == names
    assert all(isinstance(entry["default"], str) for entry in ACTION["inputs"].values())
    page = (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")
    for name, entry in ACTION["inputs"].items():
        default = f"`{entry['default']}`" if entry["default"] else ""
        assert f"\n| `{name}` | {default} | {entry['description']} |\n" in page
    for name, entry in ACTION["outputs"].items():
        assert f"\n| `{name}` | {entry['description']} |\n" in page


@pytest.mark.parametrize(
    "steps", [STEPS, *map(jobs, WORKFLOWS)], ids=["action.yml", *(path.name for path in WORKFLOWS)]
)
def test_scripts_hold_no_expressions(steps: list[dict[str, Any]]) -> None:
    """What `${{ }}` stands for is put into a script before the shell reads it: who chose it would
    run what they like.
    """
    scripts = [step["run"] for step in steps if "run" in step]
    assert scripts
    assert [script for script in scripts if "${{" in script] == []


def test_a_pinned_action_names_its_version_and_is_pinned_once() -> None:
    text = "".join(
        path.read_text(encoding="utf-8") for path in (ROOT / "action.yml", *WORKFLOWS, *DOCS)
    )
    uses = re.findall(r"(?m)^ *(?:- )?uses: (?!\.{1,2}/|\$/)(.*)$", text)
    pins = {re.fullmatch(r"(\S+)@([0-9a-f]{40}) # v\d+\.\d+\.\d+", use) for use in uses}
    assert None not in pins
    assert len({pin[1] for pin in pins if pin}) == len({pin[0] for pin in pins if pin}) == 6


ZIZMOR = shutil.which("zizmor", path=str(Path(sys.executable).parent))


@pytest.mark.skipif(ZIZMOR is None, reason="zizmor is not installed")
def test_zizmor_finds_nothing(tmp_path: Path) -> None:
    """In the action, the workflows, and the workflows and pre-commit configurations that the
    documentation shows.
    """
    workflows = tmp_path / ".github" / "workflows"
    workflows.mkdir(parents=True)
    for name in (
        "action.yml",
        ".pre-commit-hooks.yaml",
        ".github/dependabot.yml",
        *(path.relative_to(ROOT) for path in WORKFLOWS),
    ):
        shutil.copy(ROOT / name, tmp_path / name)
    shown = [
        block
        for page in DOCS
        for block in re.findall(r"```yaml\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    ]
    audited = len(list(tmp_path.rglob("*.y*ml")))
    for number, block in enumerate(
        block for block in shown if "uses: " in block or "hooks:" in block
    ):
        audited += 1
        if "hooks:" in block:
            (tmp_path / str(number)).mkdir()
            (tmp_path / str(number) / ".pre-commit-config.yaml").write_text(block)
        else:
            (workflows / f"{number}.yml").write_text(block)
    assert ZIZMOR is not None
    command = [
        ZIZMOR,
        "--offline",
        "--persona=pedantic",
        "--strict-collection",
        "--no-progress",
        "--color=never",
        str(tmp_path),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "No findings to report" in done.stdout + done.stderr
    assert (done.stdout + done.stderr).count("completed ") == audited >= 6


def test_every_input_is_used_and_every_one_used_exists() -> None:
    text = json.dumps(STEPS)
    assert set(re.findall(r"inputs\.([\w-]+)", text)) == set(ACTION["inputs"])
    assert set(re.findall(r"steps\.([\w-]+)\.", text)) <= {step.get("id") for step in STEPS}


def test_composite_steps_name_their_shell() -> None:
    assert {step["shell"] for step in STEPS if "run" in step} == {"bash"}


def step(name: str) -> dict[str, Any]:
    return next(entry for entry in STEPS if entry["name"] == name)


PYTHON = """\
import json, os, sys
if sys.argv[1:4] == ["-I", "-m", "venv"]:
    folder = os.path.join(sys.argv[4], os.environ["PROGRAMS"])
    os.makedirs(folder)
    os.symlink(__file__, folder + "/python")
    os.symlink(os.environ["LINTER"], folder + "/msaa-lint")
elif sys.argv[1:4] == ["-I", "-m", "pip"]:
    json.dump(sys.argv[4:], open(os.environ["RECORD"], "w"))
    sys.exit(int(os.environ["PIP_CODE"]))
else:
    os.execv(sys.executable, [sys.executable, *sys.argv[1:]])
"""
"""Stands in for Python: makes a virtual environment of stand-ins, and writes down what pip is
given.
"""

LINTER = """\
import json, os, sys
json.dump(sys.argv[1:], open(os.environ["RECORD"], "w"))
for word in sys.argv:
    if word.startswith("sarif="):
        open(word[6:], "w").write(os.environ["SARIF_TEXT"])
sys.exit(int(os.environ["LINTER_CODE"]))
"""
"""Stands in for msaa-lint: writes down what it is given, and a SARIF file where it is asked to."""

REAL = f"""\
import runpy, sys
sys.path.insert(0, {str(ROOT)!r})
runpy.run_module("msaa_lint", run_name="__main__")
"""
"""Runs msaa-lint from this repository."""


class Job:
    """A job of a runner: its folders, and uses of the action in it. Results: the exit code, and
    what was written down and printed.
    """

    def __init__(self, folder: Path, linter: str = LINTER) -> None:
        self.workspace = folder / "work space"
        self.temp = folder / "temp"
        self.record = folder / "record"
        for path in (self.workspace, self.temp):
            path.mkdir()
        self.tools = {"PYTHON": folder / "python", "LINTER": folder / "linter"}
        for name, text in (("PYTHON", PYTHON), ("LINTER", linter)):
            self.tools[name].write_text(f"#!{sys.executable}\n{text}")
            self.tools[name].chmod(0o755)
        self.environment = {
            "RECORD": str(self.record),
            "LINTER_CODE": "0",
            "SARIF_TEXT": "{}",
            "PIP_CODE": "0",
            "PROGRAMS": "bin",
        }
        self.action = "/the action/at its ref"
        self.printed = ""

    def use(self, upload: str = "success", **inputs: str) -> Use:
        """Runs the steps whose conditions hold, as a runner does. `upload` is the outcome of the
        upload.
        """
        values = {key: entry["default"] for key, entry in ACTION["inputs"].items()} | {
            key.replace("_", "-"): v for key, v in inputs.items()
        }
        contexts = {f"inputs.{key}": value for key, value in values.items()}
        contexts["steps.python.outputs.python-path"] = str(self.tools["PYTHON"])
        use = Use({})
        for entry in STEPS:
            if not holds(entry.get("if", "success()"), contexts, use.failed):
                continue
            use.steps.append(entry["name"])
            if "uses" in entry:
                uploads = entry.get("id") == "upload"
                use.upload = (
                    {key: fill(value, contexts) for key, value in entry["with"].items()}
                    if uploads
                    else use.upload
                )
                code, outputs = int(uploads and upload == "failure"), {}
            else:
                code, outputs = self.run(entry, contexts)
                use.arguments[entry["name"]] = (
                    json.loads(self.record.read_text()) if self.record.exists() else []
                )
                self.record.unlink(missing_ok=True)
            contexts |= {
                f"steps.{entry.get('id')}.outputs.{key}": value for key, value in outputs.items()
            }
            contexts[f"steps.{entry.get('id')}.outcome"] = "failure" if code else "success"
            use.failed |= bool(code) and not entry.get("continue-on-error")
        use.outputs = {
            key: fill(entry["value"], contexts) for key, entry in ACTION["outputs"].items()
        }
        return use

    def run(self, entry: dict[str, Any], contexts: dict[str, str]) -> tuple[int, dict[str, str]]:
        output = self.temp / "output"
        output.write_text("")
        kept = {
            name: value
            for name, value in os.environ.items()
            if name in ("PATH", "HOME") or name.startswith("PIP_")
        }
        environment = {
            **kept, **self.environment, **{key: fill(value, contexts) for key,
            value in entry.get("env", {}).items()},
            "LINTER": str(self.tools["LINTER"]), "RUNNER_TEMP": str(self.temp),
            "GITHUB_OUTPUT": str(output),
            "GITHUB_ACTION_PATH": self.action, "GITHUB_WORKSPACE": str(self.workspace),
        }  # fmt: skip
        command = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", entry["run"]]
        done = subprocess.run(
            command,
            cwd=self.workspace,
            env=environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=False,
        )
        self.printed = done.stdout + done.stderr
        return done.returncode, dict(line.split("=", 1) for line in output.read_text().splitlines())


@dataclass
class Use:
    """What came of a use: the steps that ran, what pip and msaa-lint were given, what was uploaded,
    and how it ended.
    """

    arguments: dict[str, list[str]]
    steps: list[str] = field(default_factory=list)
    upload: dict[str, str] = field(default_factory=dict)
    outputs: dict[str, str] = field(default_factory=dict)
    failed: bool = False


def fill(text: str, contexts: dict[str, str]) -> str:
    return re.sub(r"\$\{\{ ([\w.-]+) \}\}", lambda match: contexts.get(match[1], ""), text)


def holds(condition: str, contexts: dict[str, str], failed: bool) -> bool:
    """Whether a condition of a step holds, in a job that is not cancelled."""
    if condition == "success()":
        return not failed
    left, operator, right = (
        condition.removeprefix("${{ !cancelled() && ").removesuffix(" }}").split(" ")
    )
    return (contexts.get(left, "") == right.strip("'")) == {"==": True, "!=": False}[operator]


@pytest.fixture
def job(tmp_path: Path) -> Job:
    return Job(tmp_path)


@needs_bash
def test_lints_the_current_folder_by_default(job: Job) -> None:
    use = job.use()
    sarif = use.outputs["sarif"]
    assert Path(sarif).parent.parent == job.temp
    assert use.arguments["Lint"] == [
        "check",
        "--output",
        "github",
        "--output",
        f"sarif={sarif}",
        "--",
        ".",
    ]
    assert use.outputs == {"exit-code": "0", "sarif": sarif}
    assert use.upload == {"sarif_file": sarif, "category": "msaa-lint"}
    assert use.steps == ["Set up Python", "Install msaa-lint", "Lint", "Upload to code scanning"]
    assert not use.failed and not job.printed


@needs_bash
def test_finds_the_programs_of_a_virtual_environment_of_windows(job: Job) -> None:
    job.environment["PROGRAMS"] = "Scripts"
    assert job.use().arguments["Lint"][0] == "check"


@needs_bash
def test_passes_on_what_the_inputs_say(job: Job) -> None:
    use = job.use(
        paths="renderer/a folder\r\n\n*.yaml\n",
        config="ci/msaa lint.toml",
        fail_on="error",
        args="--select MSAA2\n  --profile 'my device.json' --exclude \"*.yaml\" --baseline "
        "ci\\known.json",
        annotations="false",
        upload_sarif="false",
    )
    assert use.arguments["Lint"] == [
        "check", "--output", "full", "--config=ci/msaa lint.toml", "--fail-on=error", "--select",
        "MSAA2", "--profile", "my device.json",
        "--exclude", "*.yaml", "--baseline", "ci\\known.json", "--", "renderer/a folder", "*.yaml",
    ]  # fmt: skip
    assert use.outputs == {"exit-code": "0", "sarif": ""}
    assert "Upload to code scanning" not in use.steps


HOSTILE = "$(touch owned) `touch owned`; touch owned; \\\"; touch owned; ' * ${PATH} \\"


@needs_bash
@pytest.mark.parametrize(
    "name",
    [
        "paths",
        "config",
        "fail_on",
        "args",
        "version",
        "source",
        "category",
        "annotations",
        "upload_sarif",
    ],
)
def test_inputs_are_words_and_no_code(job: Job, name: str) -> None:
    hostile = HOSTILE + "'" + '"' if name == "args" else HOSTILE
    use = job.use(**{name: hostile})
    assert not list(job.workspace.iterdir())
    lint = use.arguments["Lint"]
    whole = {"paths": HOSTILE, "config": f"--config={HOSTILE}", "fail_on": f"--fail-on={HOSTILE}"}
    if name in whole:
        assert whole[name] in lint
    elif name == "args":
        assert lint[lint.index("`touch") :][:3] == ["`touch", "owned`;", "touch"]
        assert "\\; touch owned; ' * ${PATH} \\'" in lint
    elif name == "version":
        assert use.arguments["Install msaa-lint"][-1] == f"msaa-lint=={HOSTILE}"
    elif name == "category":
        assert use.upload["category"] == HOSTILE


@needs_bash
def test_modules_of_the_workspace_are_not_imported(job: Job) -> None:
    for module in ("os", "shlex", "runpy"):
        (job.workspace / f"{module}.py").write_text("open('owned', 'w')\n")
    assert not job.use(args="--select MSAA2").failed
    assert not (job.workspace / "owned").exists()


@needs_bash
def test_a_quotation_mark_without_its_counterpart_is_an_error(job: Job) -> None:
    use = job.use(args="--config 'ci/msaa lint.toml")
    assert use.failed and use.outputs == {"exit-code": "2", "sarif": ""}
    assert (
        job.printed == "::error title=msaa-lint::the input `args` has a quotation mark without its "
        "counterpart\n"
    )
    assert use.arguments["Lint"] == []


@needs_bash
def test_a_path_is_no_option(job: Job) -> None:
    assert job.use(paths="--exit-zero\n-").arguments["Lint"][-3:] == ["--", "--exit-zero", "-"]


@needs_bash
@pytest.mark.parametrize("code", [1, 2])
def test_ends_as_the_linter_ends_and_still_uploads(job: Job, code: int) -> None:
    job.environment["LINTER_CODE"] = str(code)
    use = job.use(category="frames")
    assert use.failed and use.outputs["exit-code"] == str(code)
    assert use.upload == {"sarif_file": use.outputs["sarif"], "category": "frames"}


@needs_bash
def test_a_second_use_never_uploads_what_the_first_wrote(job: Job) -> None:
    first = job.use()
    job.environment |= {"LINTER_CODE": "2", "SARIF_TEXT": ""}
    second = job.use()
    assert first.upload and Path(first.outputs["sarif"]).exists()
    assert second.failed and second.outputs == {"exit-code": "2", "sarif": ""}
    assert not second.upload
    job.environment |= {"PIP_CODE": "1"}
    third = job.use()
    assert third.steps == ["Set up Python", "Install msaa-lint"]
    assert third.failed and third.outputs == {"exit-code": "", "sarif": ""}
    job.environment |= {"LINTER_CODE": "0", "SARIF_TEXT": "{}", "PIP_CODE": "0"}
    assert job.use().outputs["sarif"] not in ("", first.outputs["sarif"])


@needs_bash
@pytest.mark.parametrize("code", [0, 1])
def test_a_failed_upload_is_a_notice_and_changes_no_exit_code(job: Job, code: int) -> None:
    job.environment["LINTER_CODE"] = str(code)
    use = job.use(upload="failure")
    assert use.failed is bool(code)
    assert use.steps[-1] == "Report a failed upload"
    assert re.fullmatch(
        "::notice title=msaa-lint::The findings were not uploaded to code scanning: [^\n]*\n",
        job.printed,
    )


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
def test_installs_its_own_ref_or_a_release(
    job: Job, version: str, source: str, wanted: str
) -> None:
    arguments = job.use(version=version, source=source).arguments["Install msaa-lint"]
    assert arguments[0] == "install"
    assert arguments[-1] == wanted


@needs_bash
def test_with_msaa_lint_itself(tmp_path: Path) -> None:
    """Paths with spaces and with a dash at their beginning, findings, a clean file, and a
    configuration that does not exist.
    """
    job = Job(tmp_path, REAL)
    (job.workspace / "a folder").mkdir()
    (job.workspace / "a folder" / "-bad.msaa.yaml").write_text(BAD)
    (job.workspace / "--good.msaa.yaml").write_text(GOOD)
    use = job.use(
        paths="a folder\n--good.msaa.yaml", args="--ignore MSAA1 'MSAA4'", upload="failure"
    )
    assert use.outputs["exit-code"] == "2", "two rules need two options"
    use = job.use(paths="a folder\n--good.msaa.yaml", args="--ignore MSAA1 --ignore 'MSAA4'")
    assert use.failed and use.outputs["exit-code"] == "1"
    (run,) = json.loads(Path(use.outputs["sarif"]).read_text())["runs"]
    places = [
        result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
        for result in run["results"]
    ]
    assert set(places) == {"a%20folder/-bad.msaa.yaml"}
    assert "::warning file=a folder/-bad.msaa.yaml,line=" in job.printed
    clean = job.use(paths="--good.msaa.yaml")
    assert not clean.failed and clean.outputs["exit-code"] == "0"
    assert json.loads(Path(clean.outputs["sarif"]).read_text())["runs"][0]["results"] == []
    missing = job.use(config="no such.toml")
    assert missing.failed and missing.outputs["exit-code"] == "2"
    assert "no such.toml" in job.printed


@needs_bash
@pytest.mark.network
def test_with_python_and_pip_themselves(tmp_path: Path) -> None:
    """From a copy of this repository, as the documentation has it, in a folder whose name has a
    space.
    """
    job = Job(tmp_path)
    job.tools["PYTHON"] = Path(sys.executable)
    copy = job.workspace / "tools" / "msaa-lint"
    copy.mkdir(parents=True)
    for name in SHIPPED:
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, copy / name)
    job.action = str(copy)
    (job.workspace / "bad.msaa.yaml").write_text(BAD)
    (job.workspace / "pip.py").write_text("raise SystemExit('of the workspace')\n")
    use = job.use(paths="bad.msaa.yaml", source="true", config="")
    assert use.steps[-1] == "Upload to code scanning", job.printed
    assert use.failed and use.outputs["exit-code"] == "1"
    assert json.loads(Path(use.upload["sarif_file"]).read_text())["runs"][0]["results"]

"""What the documentation tells to install, from a clone of the working tree: README, docs/ci.md,
and the steps of a release.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from msaa_lint import __version__
from tests.doc_blocks import blocks
from tests.paths import ROOT

pytestmark = [
    pytest.mark.network,
    pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed"),
]


def steps(page: str) -> list[str]:
    """The blocks of a page that other tests leave to this one."""
    return [block.text for block in blocks(page) if "test_release.py" in block.skipped]


def tracked() -> list[str]:
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    return [name for name in listed.stdout.splitlines() if (ROOT / name).is_file()]


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    folder = tmp_path / "msaa-lint"
    for name in tracked():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, folder / name)
    execute(
        folder,
        'git init --quiet --initial-branch main && git add . && git commit --quiet --message "The '
        'working tree"',
    )
    return folder


def execute(folder: Path, script: str) -> subprocess.CompletedProcess[str]:
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("GIT_", "PYTHONPATH"))
    }
    author = {
        f"GIT_{who}_{what}": "tests@example.invalid"
        for who in ("AUTHOR", "COMMITTER")
        for what in ("NAME", "EMAIL")
    }
    return subprocess.run(
        ["bash", "-ec", script],
        cwd=folder,
        env={**kept, **author},
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_installation(clone: Path) -> None:
    """In a terminal the first command prints an excerpt too, in a pipe one line per finding."""
    first, extras = steps("README.md")
    done = execute(clone, first)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "warning[resolve-outside-pass]" in done.stdout
    shown = execute(clone, first.rpartition("&&")[2].strip() + " --output full").stdout.splitlines()
    assert 10 < len(shown) < 24
    assert execute(clone, ".venv/bin/msaa-lint check examples").returncode == 1
    done = execute(
        clone,
        f"{extras}\ncd examples\nmsaa-lint study --list-scenes\nmsaa-lint check --fail-confidence "
        "high code/forward.cpp",
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_steps_of_a_release(clone: Path) -> None:
    done = execute(clone, "\n".join(steps("CONTRIBUTING.md")))
    assert done.returncode == 0, done.stdout + done.stderr
    assert "No findings in 1 file" in done.stdout
    assert done.stdout.count("PASSED") == 2
    head = execute(
        clone, f'git rev-parse HEAD "v{__version__}^{{}}" "v{__version__.split(".")[0]}^{{}}"'
    ).stdout.split()
    assert len(head) == 3 and len(set(head)) == 1


def test_the_snippets_for_ci(clone: Path, tmp_path: Path) -> None:
    """In a project with a copy of the clone, as docs/ci.md says: the scripts of GitLab and Azure
    Pipelines, and the pre-commit hooks.
    """
    named = {
        block.file_name or block.language: block.text
        for block in reversed(list(blocks("docs/ci.md")))
    }
    project = tmp_path / "project"
    project.mkdir()
    execute(
        project,
        "git init --quiet --initial-branch main && git commit --quiet --allow-empty --message "
        "Start",
    )
    added = execute(project, named["sh"].replace("URL", str(clone)))
    assert added.returncode == 0, added.stderr

    install, check = yaml.safe_load(named[".gitlab-ci.yml"])["msaa-lint"]["script"]
    activated = f"{sys.executable} -m venv ../venv && . ../venv/bin/activate && "
    installed = execute(project, f"{activated}{install} && msaa-lint init renderer/descriptions")
    assert installed.returncode == 0, installed.stderr
    done = execute(project, f". ../venv/bin/activate && {check}")
    assert done.returncode == 1, done.stderr
    assert (
        len(json.loads((project / "gl-code-quality-report.json").read_text(encoding="utf-8"))) == 2
    )

    install_again, check = yaml.safe_load(named["azure-pipelines.yml"])["steps"][0][
        "script"
    ].splitlines()
    assert install_again == install
    done = execute(
        project, f". ../venv/bin/activate && export BUILD_SOURCESDIRECTORY=$PWD && {check}"
    )
    issues = [
        line for line in done.stdout.splitlines() if line.startswith("##vso[task.logissue type=")
    ]
    assert done.returncode == 1 and len(issues) == 2, done.stderr
    assert all(";sourcepath=renderer/descriptions/" in line for line in issues)

    head = execute(clone, "git rev-parse HEAD").stdout.strip()
    hooks = (
        named[".pre-commit-config.yaml"]
        .replace("file:///path/to/msaa-lint", clone.as_uri())
        .replace("COMMIT", head)
    )
    (project / ".pre-commit-config.yaml").write_text(hooks, encoding="utf-8")
    (project / "renderer" / "pass.cpp").write_text("int main() {}\n", encoding="utf-8")
    done = execute(
        project,
        f"git add renderer && PRE_COMMIT_HOME=$PWD/../cache {sys.executable} -m pre_commit run "
        "--color never",
    )
    assert done.returncode == 1, done.stdout + done.stderr
    assert (
        "renderer/descriptions/frame.msaa.yaml:24:18: warning[multisampled-attachment-stored]"
        in done.stdout
    )
    assert "No findings in 1 file" in done.stdout

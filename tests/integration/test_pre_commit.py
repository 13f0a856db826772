"""The hook, by a real pre-commit: installed from the working tree as from a repository, run on
another one.
"""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.input.code import test_reading as source
from tests.paths import ROOT

SHIPPED = (".pre-commit-hooks.yaml", "pyproject.toml", "README.md", "LICENSE", "msaa_lint", "rules")
"""What the hook is installed from."""

pytestmark = [
    pytest.mark.network,
    pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed"),
    pytest.mark.skipif(
        importlib.util.find_spec("pre_commit") is None, reason="pre-commit is not installed"
    ),
]

GOOD = """\
renderPasses:
  forward:
    attachments:
      color_ms: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
      color: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color_ms], resolveAttachments: [color]}
"""
BAD = GOOD.replace("loadOp: CLEAR, storeOp: DONT_CARE", "loadOp: CLEAR, storeOp: STORE")
PLACE = "4:78: warning[multisampled-attachment-stored]"


def environment(home: Path) -> dict[str, str]:
    """Without the git repository, the hooks and the configurations that the tests may run in."""
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("GIT_", "PRE_COMMIT", "MSAA_LINT_", "PYTHONPATH"))
    }
    author = {
        f"GIT_{who}_{what}": "tests@example.invalid"
        for who in ("AUTHOR", "COMMITTER")
        for what in ("NAME", "EMAIL")
    }
    return {
        **kept,
        **author,
        "GIT_CONFIG_GLOBAL": os.devnull,
        "GIT_CONFIG_NOSYSTEM": "1",
        "PRE_COMMIT_HOME": str(home),
    }


def git(folder: Path, home: Path, *arguments: str) -> str:
    done = subprocess.run(
        ["git", *arguments],
        cwd=folder,
        env=environment(home),
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.strip()


class Scratch:
    """A repository whose commits the hook is to judge."""

    def __init__(self, folder: Path, home: Path, hooks: Path) -> None:
        self.folder = folder
        self.home = home
        self.hooks = hooks
        folder.mkdir()
        git(folder, home, "init", "--quiet")

    def add(self, name: str, text: str) -> None:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        git(self.folder, self.home, "add", name)

    def configure(self, *lines: str, hook: str = "msaa-lint") -> None:
        """Uses a hook as a user does, with what a user says of it."""
        rev = git(self.hooks, self.home, "rev-parse", "HEAD")
        head = ["repos:", f"- repo: {self.hooks}", f"  rev: {rev}", "  hooks:", f"  - id: {hook}"]
        self.add(
            ".pre-commit-config.yaml", "\n".join([*head, *(f"    {line}" for line in lines), ""])
        )

    def pre_commit(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "pre_commit", *arguments, "--color", "never"]
        return subprocess.run(
            command,
            cwd=self.folder,
            env=environment(self.home),
            capture_output=True,
            text=True,
            check=False,
        )


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where pre-commit keeps what it has installed."""
    return tmp_path_factory.mktemp("pre-commit")


@pytest.fixture(scope="module")
def hooks(tmp_path_factory: pytest.TempPathFactory, home: Path) -> Path:
    """The working tree as a repository, committed or not."""
    folder = tmp_path_factory.mktemp("msaa-lint")
    for name in SHIPPED:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(
                source, folder / name, ignore=shutil.ignore_patterns("__pycache__", ".*_cache")
            )
        else:
            shutil.copy(source, folder / name)
    git(folder, home, "init", "--quiet")
    git(folder, home, "add", "--all")
    git(folder, home, "commit", "--quiet", "--message", "The working tree")
    return folder


@pytest.fixture
def scratch(tmp_path: Path, home: Path, hooks: Path) -> Scratch:
    return Scratch(tmp_path / "scratch", home, hooks)


def test_try_repo_fails_on_the_bad_file_alone(scratch: Scratch) -> None:
    scratch.add("frame/bad.msaa.yaml", BAD)
    scratch.add("frame/good.msaa.yaml", GOOD)
    scratch.add("frame/other.yaml", BAD)
    done = scratch.pre_commit("try-repo", str(scratch.hooks), "msaa-lint", "--all-files")
    assert done.returncode == 1, done.stdout + done.stderr
    assert "Failed" in done.stdout
    assert f"frame/bad.msaa.yaml:{PLACE}" in done.stdout
    assert "in 1 of 2 files" in done.stdout
    assert "other.yaml" not in done.stdout


def test_good_file_passes(scratch: Scratch) -> None:
    scratch.configure()
    scratch.add("good.msaa.yaml", GOOD)
    done = scratch.pre_commit("run", "--verbose")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Passed" in done.stdout
    assert "No findings in 1 file" in done.stdout


def test_files_of_ones_own(scratch: Scratch) -> None:
    scratch.configure(r"files: ^renderer/.*\.ya?ml$", "args: [--output, concise]")
    scratch.add("renderer/deep/bad.yml", BAD)
    scratch.add("elsewhere/bad.msaa.yaml", BAD)
    scratch.add("renderer/notes.md", BAD)
    done = scratch.pre_commit("run")
    assert done.returncode == 1, done.stdout + done.stderr
    assert f"renderer/deep/bad.yml:{PLACE}" in done.stdout
    assert "in 1 file (" in done.stdout
    assert "elsewhere" not in done.stdout


def test_other_files_are_left_alone(scratch: Scratch) -> None:
    scratch.configure()
    scratch.add("compose.yaml", BAD)
    scratch.add("bad.msaa.yaml.orig", BAD)
    done = scratch.pre_commit("run")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "Skipped" in done.stdout


def test_source_code_with_mistakes_fails(scratch: Scratch) -> None:
    scratch.configure(hook="msaa-lint-source")
    scratch.add("renderer/pass.cpp", source.CODE)
    scratch.add("renderer/frame.msaa.yaml", BAD)
    scratch.add("renderer/page.md", source.CODE)
    done = scratch.pre_commit("run")
    assert done.returncode == 1, done.stdout + done.stderr
    assert f"renderer/pass.cpp:{source.PLACE}: {source.FOUND}" in done.stdout
    assert "in 1 file (" in done.stdout
    scratch.configure("args: [--fail-confidence, high]", hook="msaa-lint-source")
    done = scratch.pre_commit("run")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "of low or medium confidence, below --fail-confidence" in done.stdout


def test_source_code_without_mistakes_passes(scratch: Scratch) -> None:
    scratch.configure("args: [--fail-confidence, low]", hook="msaa-lint-source")
    scratch.add("main.cpp", "int main() {}\n")
    scratch.add("sky.frag", "void main() {}\n")
    done = scratch.pre_commit("run")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "No findings in 2 files" in done.stdout

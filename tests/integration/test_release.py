"""The first command of the README and the steps of a release, as CONTRIBUTING.md states them, in a clone of the working tree."""

from __future__ import annotations

import os
import shutil
import subprocess
import tarfile
import zipfile
from pathlib import Path

import pytest

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
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return [name for name in listed.stdout.splitlines() if (ROOT / name).is_file()]


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    folder = tmp_path / "msaa-lint"
    for name in tracked():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, folder / name)
    execute(folder, 'git init --quiet && git add . && git commit --quiet --message "The working tree"')
    return folder


def execute(folder: Path, script: str) -> subprocess.CompletedProcess[str]:
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("GIT_", "PYTHONPATH"))}
    author = {f"GIT_{who}_{what}": "tests@example.invalid" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    return subprocess.run(["bash", "-ec", script], cwd=folder, env={**kept, **author}, capture_output=True, text=True, check=False)


def test_the_installation(clone: Path) -> None:
    """In a terminal the first command prints an excerpt too, in a pipe one line per finding."""
    first, extras = steps("README.md")
    done = execute(clone, first)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "warning[resolve-outside-pass]" in done.stdout
    shown = execute(clone, first.rpartition("&&")[2].strip() + " --output full").stdout.splitlines()
    assert 10 < len(shown) < 24
    assert execute(clone, ".venv/bin/msaa-lint check examples").returncode == 1
    done = execute(clone, f"{extras}\ncd examples\nmsaa-lint study --list-scenes\nmsaa-lint check --fail-confidence high code/forward.cpp")
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_steps_of_a_release(clone: Path) -> None:
    done = execute(clone, "\n".join(steps("CONTRIBUTING.md")))
    assert done.returncode == 0, done.stdout + done.stderr
    assert "No findings in 1 file" in done.stdout
    assert done.stdout.count("PASSED") == 2
    head = execute(clone, f'git rev-parse HEAD "v{__version__}^{{}}" "v{__version__.split(".")[0]}^{{}}"').stdout.split()
    assert len(head) == 3 and len(set(head)) == 1

    with zipfile.ZipFile(clone / "dist" / f"msaa_lint-{__version__}-py3-none-any.whl") as wheel:
        names = {name for name in wheel.namelist() if ".dist-info/" not in name}
        assert [name for name in wheel.namelist() if name.endswith("/LICENSE")]
    package = {name.replace("core/py.typed", "py.typed") for name in tracked() if name.startswith("msaa_lint/")}
    rules = {f"msaa_lint/{name}" for name in tracked() if name.startswith("rules/")}
    assert names == package | rules

    with tarfile.open(clone / "dist" / f"msaa_lint-{__version__}.tar.gz") as sdist:
        unpacked = {name.partition("/")[2] for name in sdist.getnames()}
    left_out = {name for name in tracked() if not name.startswith((".ci/", ".github/"))} - unpacked
    assert left_out == set()

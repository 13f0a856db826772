"""The wheel and the sdist: what git tracks, whatever else lies in the tree, and byte for byte the
same from everywhere.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

from tests.paths import ROOT

pytest.importorskip("hatchling")
pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")

STRAY = (
    *(
        "secrets.env",
        ".env",
        "msaa_lint/stray.txt",
        "msaa_lint/.env",
        "msaa_lint/core/finding.py.orig",
        "msaa_lint/core/key.pem",
        "msaa_lint/frame.yaml",
    ),
    *(
        "msaa_lint/__pycache__/x.cpython-311.pyc",
        "rules/draft.md~",
        "rules/.DS_Store",
        "rules/shaders/a.out",
        "rules/__pycache__/x.pyc",
    ),
    *(
        "docs/core.12",
        "examples/id_rsa",
        "tests/.env",
        "tests/run.log",
        "tests/integration/x.rej",
        ".venv/lib/x.py",
        "build/lib/msaa_lint/x.py",
    ),
    *(
        "shared/design.md",
        "fuzz-failures/a/frame.msaa.yaml",
        ".hypothesis/examples/x",
        "dist/old.whl",
    ),
)
"""Files as they lie in the trees of developers."""


def tracked() -> set[str]:
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    return {name for name in listed.stdout.splitlines() if (ROOT / name).is_file()}


def copy(folder: Path) -> Path:
    """A copy of the files that git tracks."""
    for name in tracked():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, folder / name)
    return folder


def build(tree: Path, out: Path, umask: int) -> tuple[Path, Path]:
    """The wheel and the sdist that are built from a tree."""
    command = [sys.executable, "-m", "hatchling", "build", "-d", str(out)]
    subprocess.run(
        command,
        cwd=tree,
        umask=umask,
        check=True,
        capture_output=True,
        env={"PATH": os.environ["PATH"]},
    )
    (wheel,), (sdist,) = out.glob("*.whl"), out.glob("*.tar.gz")
    return wheel, sdist


def test_a_tree_with_stray_files_builds_the_same_packages_as_a_clean_one(tmp_path: Path) -> None:
    clean, dirty = copy(tmp_path / "clean"), copy(tmp_path / "dirty")
    for name in STRAY:
        (dirty / name).parent.mkdir(parents=True, exist_ok=True)
        (dirty / name).write_text("TOKEN=secret\n", encoding="utf-8")
    for folder in ("msaa_lint", "rules", "tests", "docs"):
        (dirty / folder / "shared").symlink_to(dirty / "shared")
    wheel, sdist = build(dirty, tmp_path / "out", 0o022)

    names = zipfile.ZipFile(wheel).namelist()
    package = {
        name.replace("core/py.typed", "py.typed")
        for name in tracked()
        if name.startswith("msaa_lint/")
    }
    rules = {f"msaa_lint/{name}" for name in tracked() if name.startswith("rules/")}
    metadata = {
        f"{wheel.name.rpartition('-py3')[0]}.dist-info/{name}"
        for name in ("METADATA", "WHEEL", "RECORD", "entry_points.txt", "licenses/LICENSE")
    }
    assert sorted(names) == sorted(package | rules | metadata)
    with tarfile.open(sdist) as archive:
        assert {name.partition("/")[2] for name in archive.getnames()} == tracked() | {"PKG-INFO"}

    again = build(clean, tmp_path / "again", 0o077)
    assert [path.read_bytes() for path in again] == [wheel.read_bytes(), sdist.read_bytes()]

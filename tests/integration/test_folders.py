"""The benchmark of folders, on two small packages: its downloads, its table, and its exit code."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.paths import ROOT

pytestmark = [
    pytest.mark.network,
    pytest.mark.skipif(shutil.which("npm") is None, reason="npm is not installed"),
    pytest.mark.skipif(
        importlib.util.find_spec("unearth") is None, reason="unearth is not installed"
    ),
]

PACKAGES = ("check-jsonschema==0.39.0", "cordova-ios@8.1.1")


def benchmark(cache: Path) -> subprocess.CompletedProcess[str]:
    command = [
        sys.executable,
        str(ROOT / "tests/benchmarks/folders.py"),
        "--cache",
        str(cache),
        *PACKAGES,
    ]
    return subprocess.run(
        command,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )


def test_no_file_of_a_package_is_an_input_and_one_that_is_fails(tmp_path: Path) -> None:
    done = benchmark(tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    rows = [
        [cell.strip() for cell in line.split("|")[1:-1]]
        for line in done.stdout.splitlines()
        if line.startswith("| c")
    ]
    assert [(row[0], row[3], row[5:8]) for row in rows] == [
        (name, "0", ["0", "2", "0"]) for name in PACKAGES
    ]
    assert all(int(row[1]) > 9 for row in rows)
    (archive,) = (tmp_path / PACKAGES[1]).glob("*.tgz")
    tree = tmp_path / "tree"
    shutil.unpack_archive(archive, tree, filter="data")
    (tree / "package/frame.json").write_text(
        '{"images": {"a": {"format": "R8_UNORM", "samples": 3, "usage": ["SAMPLED"]}}}'
    )
    archive.unlink()
    shutil.make_archive(str(archive.with_suffix("")), "gztar", tree)
    done = benchmark(tmp_path)
    assert done.returncode == 1
    assert f"{PACKAGES[1]}: package/frame.json\n" in done.stdout

"""Runs `check .` on the source trees of public packages: `python tests/benchmarks/folders.py
[--cache FOLDER] [--doubling | NAME ...]`.

The packages are full of YAML, JSON, and XML that other tools read, or are about Vulkan, WebGPU, or
glTF; none of them contains a frame. Each is downloaded from its registry (by unearth, which does
not build an sdist, or by npm), unpacked, and linted as a folder, together with its source code.
Prints a table in Markdown. Exits with 1 if a data file is taken for an input, or if there is an
error other than that the folder has no inputs.

`--doubling` measures instead how the time of a search grows with the number of files, under a
.gitignore with 200 patterns.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
from typing import NamedTuple

from inputs import ROOT

from msaa_lint.input.discovery import discover
from msaa_lint.input.file_types import DATA, SOURCES
from msaa_lint.linter.settings.settings import Settings

PYPI = """\
ansible==12.3.0 ansible-core==2.19.14 awscli==1.46.2 botocore==1.44.5 cfn-lint==1.58.0 check-jsonschema==0.39.0 checkov==3.3.30
conda-lock==4.0.3 django==5.2.19 docker-compose==1.29.2 esphome==2026.6.5 gitlabci-local==13.2.0 gltflib==1.0.13 jsonschema==4.26.0
kivy==2.3.1 kubernetes==37.0.2 lxml==6.1.3 matplotlib==3.11.2 meson==1.12.1 moderngl==5.13.0 moto==5.2.5 openapi-spec-validator==0.9.0
panda3d-gltf==1.3.0 podman-compose==1.6.0 pre-commit==4.7.0 prefect==3.9.1 pyglet==2.1.19 pygltflib==1.16.5 pyvulkan==0.9 rdflib==7.6.0
salt==3008.5 scipy==1.17.1 sphinx==9.0.4 trimesh==5.2.0 vulkan==1.3.275.1 vulkan-object==1.4.366 wgpu==0.32.0 yamllint==1.38.0
"""
NPM = """\
@babel/core@8.1.2 @capacitor/ios@8.5.2 @gltf-transform/core@4.5.1 @luma.gl/core@9.4.2 @mdn/browser-compat-data@8.1.9
@octokit/openapi@23.0.2 @webgpu/types@0.1.74 aws-sdk@2.1693.0 babylonjs@9.31.0 caniuse-db@1.0.30001813 cesium@1.145.0
cordova-android@15.1.0 cordova-ios@8.1.1 electron@45.3.4 eslint@10.15.0 expo@57.0.26 expo-template-bare-minimum@58.0.8
gltf-validator@2.0.0-dev.3.10 kubernetes-models@5.1.0 playcanvas@2.23.3
simple-icons@16.37.0 three@0.187.0 vega-datasets@3.2.1 webgpu@0.6.2 webpack@5.112.2
"""

MIN_PACKAGES = 30
TIMEOUT = 600  # seconds, for a download or a run


class Row(NamedTuple):
    """What came of a package: its data files and source files, those of them that were taken for
    inputs, and the run of `check .`.
    """

    name: str
    data: int
    sources: int
    taken_data: list[str]
    taken_sources: list[str]
    skipped: str
    exit: int
    errors: list[str]
    findings: int
    seconds: float


def download(name: str, cache: str) -> str | None:
    """The archive of a package in the cache, downloaded if it is not there; None if that fails."""
    folder = os.path.join(cache, name.replace("/", "+"))
    os.makedirs(folder, exist_ok=True)
    if not os.listdir(folder):
        if "==" in name:
            command = [sys.executable, "-m", "unearth", name, "--no-binary", "--download", folder]
        else:
            command = ["npm", "pack", "--silent", "--pack-destination", folder, name]
        subprocess.run(command, capture_output=True, check=False, timeout=TIMEOUT)
    archives = [entry for entry in os.listdir(folder) if entry.endswith((".tar.gz", ".tgz"))]
    return os.path.join(folder, archives[0]) if archives else None


def lint(name: str, archive: str, folder: str) -> Row:
    """Unpacks an archive to a new folder and runs `check .` there."""
    with tarfile.open(archive) as file:
        file.extractall(folder, filter="data")
    names = [entry.lower() for _, _, entries in os.walk(folder) for entry in entries]
    here = os.getcwd()
    os.chdir(folder)
    try:
        found = discover(["."], lambda path: Settings(), sources=True)
        started = time.perf_counter()
        command = [
            sys.executable,
            "-m",
            "msaa_lint",
            "check",
            ".",
            "--isolated",
            "--no-cache",
            "--output",
            "json",
        ]
        done = subprocess.run(
            command,
            capture_output=True,
            text=True,
            check=False,
            timeout=TIMEOUT,
            env={**os.environ, "PYTHONPATH": ROOT},
        )
        seconds = time.perf_counter() - started
    finally:
        os.chdir(here)
    findings = json.loads(done.stdout)["findings"]
    errors = [
        f"{each['file']}:{each['line']}: {each['message']}"
        for each in findings
        if each["severity"] == "error"
    ]
    return Row(
        name,
        sum(entry.endswith(DATA) for entry in names),
        sum(entry.endswith(SOURCES) for entry in names),
        [path for path in found.files if not path.lower().endswith(SOURCES)],
        [path for path in found.files if path.lower().endswith(SOURCES)],
        "; ".join(note for note in found.notes if "look" in note),
        done.returncode,
        [error for error in errors if "nothing to lint in" not in error],
        sum(each["severity"] != "error" for each in findings),
        seconds,
    )


def doubling(folder: str) -> None:
    """Prints the CPU time to search 12,500 to 100,000 JSON files, a tenth of which begin like a
    description.
    """
    os.mkdir(os.path.join(folder, ".git"))
    with open(os.path.join(folder, ".gitignore"), "w", encoding="utf-8") as file:
        file.write("".join(f"/ignored{number}/*.json\n*.o{number}\n" for number in range(100)))
    print("| files | s |\n|--:|--:|")
    for count in (12_500, 25_000, 50_000, 100_000):
        top = os.path.join(folder, str(count))
        for number in range(count):
            path = os.path.join(top, str(number // 1000), f"{number}.json")
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(
                    '{"images": [{"idiom": "universal"}]}'
                    if number % 10 == 0
                    else '{"name": "a", "version": 1}'
                )
        started = time.process_time()
        discover([top], lambda path: Settings())
        print(f"| {count} | {time.process_time() - started:.1f} |", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cache", help="keep the downloads in this folder")
    parser.add_argument(
        "--doubling", action="store_true", help="measure how the time of a search grows instead"
    )
    parser.add_argument("names", nargs="*", help="packages of the list; all by default")
    arguments = parser.parse_args()
    temporary = tempfile.mkdtemp()
    rows, missing = [], []
    try:
        if arguments.doubling:
            doubling(temporary)
            return 0
        print(
            "| package | data files | source files | data taken | sources taken | nearly | exit | "
            "errors | findings | s |"
        )
        print("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|")
        for name in arguments.names or [*PYPI.split(), *NPM.split()]:
            archive = download(name, arguments.cache or os.path.join(temporary, "cache"))
            if archive is None:
                missing.append(name)
                continue
            folder = os.path.join(temporary, "tree")
            row = lint(name, archive, folder)
            shutil.rmtree(folder)
            rows.append(row)
            counts = (
                row.data,
                row.sources,
                len(row.taken_data),
                len(row.taken_sources),
                1 if row.skipped else 0,
            )
            print(
                f"| {name} | {' | '.join(map(str, counts))} | {row.exit} | {len(row.errors)} | "
                f"{row.findings} | {row.seconds:.1f} |",
                flush=True,
            )
    finally:
        shutil.rmtree(temporary)
    print(
        f"\n{len(rows)} packages, {sum(row.data for row in rows)} data files, "
        f"{sum(row.sources for row in rows)} source files"
    )
    for row in rows:
        for line in (*row.taken_data, *row.errors, *filter(None, [row.skipped])):
            print(f"{row.name}: {line}")
    if missing:
        print(f"not available: {', '.join(missing)}")
    few = not arguments.names and len(rows) < MIN_PACKAGES
    return int(few or any(row.taken_data or row.errors for row in rows))


if __name__ == "__main__":
    raise SystemExit(main())

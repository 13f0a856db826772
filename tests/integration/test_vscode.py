"""The extension for Visual Studio Code: type-checked, bundled, packaged, and run with a mock editor
and the real language server.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.cli.schema import description_schema
from msaa_lint.core.package import VERSION
from msaa_lint.input.file_types import DESCRIPTIONS
from tests.paths import ROOT

EXTENSION = ROOT / "editors" / "vscode"
MANIFEST: dict[str, Any] = json.loads((EXTENSION / "package.json").read_text(encoding="utf-8"))
MIN_NODE = 20


def node_version() -> int:
    """The major version of Node.js; 0 without it or without npm."""
    if shutil.which("npm") is None or shutil.which("node") is None:
        return 0
    version = subprocess.run(
        ["node", "--version"], capture_output=True, text=True, check=True
    ).stdout
    return int(version.removeprefix("v").partition(".")[0])


needs_node = pytest.mark.skipif(
    node_version() < MIN_NODE, reason=f"Node.js {MIN_NODE} with npm is not installed"
)


def npm(folder: Path, *arguments: str) -> str:
    """What an npm command prints; the extension's own `msaa-lint` is that of the working tree."""
    command = folder / "msaa-lint"
    command.write_text(
        f'#!/bin/sh\nPYTHONPATH="{ROOT}" exec "{sys.executable}" -m msaa_lint "$@"\n'
    )
    command.chmod(0o755)
    environment = {**os.environ, "MSAA_LINT": str(command), "NO_COLOR": "1"}
    done = subprocess.run(
        ["npm", *arguments],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=400,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the extension in a copy of the repository, with its packages and the bundle."""
    top = tmp_path_factory.mktemp("clone")
    shutil.copy(ROOT / "LICENSE", top)
    folder = top / "editors" / "vscode"
    shutil.copytree(
        EXTENSION, folder, ignore=shutil.ignore_patterns("node_modules", "out", "*.vsix", "LICENSE")
    )
    npm(folder, "ci", "--no-audit", "--no-fund")
    npm(folder, "run", "package", "--", "--out", "extension.vsix")
    return folder


def test_the_version_is_that_of_the_package() -> None:
    assert MANIFEST["version"] == VERSION


def test_the_lock_file_names_no_host() -> None:
    packages = json.loads((EXTENSION / "package-lock.json").read_text(encoding="utf-8"))["packages"]
    assert packages[""]["version"] == VERSION
    assert not [name for name, package in packages.items() if "resolved" in package]


def test_settings_and_commands_are_documented() -> None:
    readme = (EXTENSION / "README.md").read_text(encoding="utf-8")
    for name, setting in MANIFEST["contributes"]["configuration"]["properties"].items():
        assert f"| `{name}` | `{json.dumps(setting['default']).strip(chr(34))}` |" in readme
    for command in MANIFEST["contributes"]["commands"]:
        assert f"| {command['category']}: {command['title']} |" in readme


def test_the_schema_is_for_the_names_of_descriptions() -> None:
    patterns = {
        pattern
        for entry in MANIFEST["contributes"]["yamlValidation"]
        for pattern in entry["fileMatch"]
    }
    patterns |= {entry["fileMatch"] for entry in MANIFEST["contributes"]["jsonValidation"]}
    assert patterns == {f"*{ending}" for ending in DESCRIPTIONS}


def test_the_extension_starts_for_the_languages_of_the_server() -> None:
    source = (EXTENSION / "src" / "extension.ts").read_text(encoding="utf-8")
    listed = re.search(r"const LANGUAGES = \[(.*?)\];", source, re.DOTALL)
    assert listed is not None
    started = {
        event.removeprefix("onLanguage:")
        for event in MANIFEST["activationEvents"]
        if event.startswith("onLanguage:")
    }
    assert started == set(re.findall(r'"(.*?)"', listed[1]))


@pytest.mark.network
@needs_node
def test_the_package_has_the_bundle_and_the_schema_alone(built: Path) -> None:
    with zipfile.ZipFile(built / "extension.vsix") as package:
        names = {name for name in package.namelist() if name.startswith("extension/")}
        assert {name.lower() for name in names} == {
            "extension/package.json",
            "extension/readme.md",
            "extension/license.txt",
            "extension/out/extension.js",
            "extension/out/msaa-lint.schema.json",
        }
        assert (
            json.loads(package.read("extension/out/msaa-lint.schema.json")) == description_schema()
        )


@pytest.mark.network
@needs_node
def test_the_client_starts_the_server_and_shows_its_diagnostics(built: Path) -> None:
    pytest.importorskip("pygls", reason="pygls, which the language server uses, is not installed")
    report = npm(built, "test")
    assert re.search(r"^(?:#|ℹ) fail 0$", report, re.MULTILINE), report

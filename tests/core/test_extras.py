"""The command that installs an extra works where it is printed, whatever msaa-lint was installed
from.
"""

from __future__ import annotations

import json
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

from msaa_lint.core import extras
from tests.paths import ROOT


@pytest.fixture
def wheel(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The package as a wheel installs it: the rule pages are inside."""
    (tmp_path / "msaa_lint" / "rules").mkdir(parents=True)
    monkeypatch.setattr(extras, "FOLDER", str(tmp_path / "msaa_lint"))
    monkeypatch.setattr("shutil.which", lambda _: None)
    return tmp_path


def test_from_a_checkout() -> None:
    assert extras.needs_extra("x", "source").endswith(f" --editable '{ROOT}[source]'`")


@pytest.mark.parametrize(("origin", "requirement"), [
    (None, "msaa-lint[source]"),
    ({"url": "file:///a%20b/msaa-lint", "dir_info": {}}, "msaa-lint[source] @ "
        "file:///a%20b/msaa-lint"),
    ({"url": "https://x.example/r.git", "vcs_info": {"vcs": "git", "commit_id": "0af"}},
    "msaa-lint[source] @ git+https://x.example/r.git@0af"),
])  # fmt: skip
def test_from_where_it_was_installed(
    wheel: Path, monkeypatch: pytest.MonkeyPatch, origin: dict[str, object] | None, requirement: str
) -> None:
    class Installed:
        def read_text(self, name: str) -> str | None:
            assert name == "direct_url.json"
            return json.dumps(origin) if origin else None

    monkeypatch.setattr(metadata, "distribution", lambda _: Installed())
    assert (
        extras.needs_extra("x", "source")
        == f"x needs the extra `source`: run `{sys.executable} -m pip install '{requirement}'`"
    )


def test_the_pip_of_another_environment_is_not_named(
    wheel: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("shutil.which", lambda _: "/elsewhere/bin/pip")
    assert extras.pip_install("ray") == f"{sys.executable} -m pip install ray"
    monkeypatch.setattr("shutil.which", lambda _: str(Path(sys.executable).parent / "pip"))
    assert extras.pip_install("ray") == "pip install ray"


def test_an_environment_without_pip(wheel: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    assert extras.pip_install("ray") == f"uv pip install --python {sys.executable} ray"


@pytest.mark.parametrize("feature", ["--editable", ""])
@pytest.mark.network
def test_the_command_installs_the_extra(tmp_path: Path, feature: str) -> None:
    """In a virtual environment that msaa-lint was installed to from a checkout."""
    python = tmp_path / "venv" / "bin" / "python"
    subprocess.run([sys.executable, "-m", "venv", tmp_path / "venv"], check=True)
    subprocess.run(
        [python, "-m", "pip", "install", "--quiet", *filter(None, [feature]), ROOT], check=True
    )
    (tmp_path / "a.cpp").write_text("// VkImageCreateInfo VK_SAMPLE_COUNT_4_BIT\n")
    check = [python, "-m", "msaa_lint", "check", "a.cpp"]
    said = subprocess.run(check, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert said.returncode == 2
    command = said.stdout.split("`")[3]
    subprocess.run(command, shell=True, cwd=tmp_path, check=True)
    assert subprocess.run(check, cwd=tmp_path, check=False).returncode == 0

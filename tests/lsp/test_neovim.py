"""A real editor: Neovim without its screen."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.command import environment_of, run
from tests.descriptions import STORED
from tests.lsp.texts import CODES

SESSION = Path(__file__).with_name("session.lua")


@pytest.mark.skipif(shutil.which("nvim") is None, reason="needs Neovim (Debian's neovim)")
def test_neovim_shows_the_diagnostics_applies_the_fixes_and_formats(tmp_path: Path) -> None:
    file, report = tmp_path / "frame.msaa.yaml", tmp_path / "report.json"
    file.write_text(STORED, encoding="utf-8")
    folders = {
        name: str(tmp_path / name.lower())
        for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME")
    }
    environment = environment_of(
        {
            **folders,
            "SERVER": f"{sys.executable} -m msaa_lint lsp",
            "FILE": str(file),
            "REPORT": str(report),
            "HOME": str(tmp_path),
        }
    )
    command = ["nvim", "--headless", "--clean", "-n", "-c", f"luafile {SESSION}", "-c", "cquit"]
    done = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=200
    )
    assert report.exists(), done.stderr
    seen = json.loads(report.read_text(encoding="utf-8"))
    assert sorted(each["code"] for each in seen["before"]) == CODES
    place = STORED[: STORED.index("STORE, initialLayout")]
    assert {(each["line"], each["column"]) for each in seen["before"]} >= {
        (place.count("\n"), len(place.rpartition("\n")[2]))
    }
    assert seen["after"] == [] and seen["errors"] == []
    assert seen["text"] == run(tmp_path, "check", "--fix", "-", stdin=STORED.encode()).stdout
    assert seen["formatted"] == seen["text"] and seen["word"] == "storeOp"
    assert file.read_text(encoding="utf-8") == STORED

"""The documentation shows what the program does: generated pages are fresh (UPDATE=1 regenerates them), and links work."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from msaa_lint.cli.init import DESCRIPTION
from tests.command import run
from tests.paths import ROOT

GENERATED = {
    "rules/README.md": ["-m", "msaa_lint", "rule", "--all", "--output", "markdown"],
    "docs/facts.md": ["-m", "msaa_lint", "facts", "--output", "markdown"],
}


STALE = """stale: `UPDATE=1 python -m pytest tests/test_docs.py` regenerates it;
for a new rule page, also run `PYTHONPATH=. python docs/agreement.py`"""


@pytest.mark.parametrize("page", GENERATED)
def test_generated_pages_are_fresh(page: str) -> None:
    done = subprocess.run([sys.executable, *GENERATED[page]], cwd=ROOT, capture_output=True, text=True, check=True)
    if os.environ.get("UPDATE"):
        (ROOT / page).write_text(done.stdout, encoding="utf-8")
    assert (ROOT / page).read_text(encoding="utf-8") == done.stdout, STALE


def test_the_readme_shows_real_output(tmp_path: Path) -> None:
    """The blocks below the README's commands are what they print, in a folder with the files of `init` and of the README."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert run(tmp_path, "init").returncode == 0
    for name, code in re.findall(r"```cpp\n// (\S+)\n(.*?)```", text, re.DOTALL):
        (tmp_path / name).write_text(code, encoding="utf-8")
    blocks = list(re.finditer(r"```console\n\$ msaa-lint (check [^\n]*)\n(.*?)```", text, re.DOTALL))
    assert len(blocks) == 2
    for block in blocks:
        output = [] if "--output" in block[1] else ["--output", "full"]
        done = run(tmp_path, *block[1].split(), *output, "--color", "never")
        if os.environ.get("UPDATE"):
            text = text.replace(block[0], f"```console\n$ msaa-lint {block[1]}\n{done.stdout}```")
            (ROOT / "README.md").write_text(text, encoding="utf-8")
        else:
            assert block[2] == done.stdout


def test_the_commands_of_the_readme_work(tmp_path: Path) -> None:
    """Every command that needs neither an extra nor a device, in the order of the README, in an empty folder."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    lines = [line.partition("  #")[0].strip() for block in re.findall(r"```sh\n(.*?)```", text, re.DOTALL) for line in block.splitlines()]
    commands = [
        part.split()[1:]
        for line in ["msaa-lint init", *lines]
        for part in line.split(" && ")
        if part.startswith("msaa-lint ") and not {"confirm", "study", "--chart"} & set(part.split())
    ]
    assert len(commands) >= 6
    for command in commands:
        if command[-1] == "markdown":
            (tmp_path / "old.msaa.yaml").write_text(DESCRIPTION, encoding="utf-8")
        assert run(tmp_path, *command).returncode in (0, 1), command


def test_the_picture_of_a_finding_is_fresh() -> None:
    check = [] if os.environ.get("UPDATE") else ["--check"]
    assert subprocess.run([sys.executable, "docs/finding.py", *check], cwd=ROOT, check=False).returncode == 0


PAGES = [
    *sorted(path.name for path in ROOT.glob("*.md")),
    *sorted(f"docs/{path.name}" for path in ROOT.glob("docs/*.md")),
    "examples/README.md",
    "rules/README.md",
]


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_somewhere(page: str) -> None:
    path = ROOT / page
    for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", path.read_text(encoding="utf-8")):
        assert (path.parent / target).exists(), f"{page} links to {target}"

"""What the documentation shows is what the program does: made pages are fresh (UPDATE=1 writes them anew), links lead somewhere."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent

GENERATED = {
    "rules/README.md": ["-m", "msaa_lint", "rule", "--all", "--output", "markdown"],
    "docs/facts.md": ["-m", "msaa_lint", "facts", "--output", "markdown"],
}


STALE = """stale: `UPDATE=1 python -m pytest tests/test_docs.py` writes it anew;
where a rule page is new, `PYTHONPATH=. python docs/agreement.py` writes docs/agreement.md too"""


@pytest.mark.parametrize("page", GENERATED)
def test_generated_pages_are_fresh(page: str) -> None:
    done = subprocess.run([sys.executable, *GENERATED[page]], cwd=ROOT, capture_output=True, text=True, check=True)
    if os.environ.get("UPDATE"):
        (ROOT / page).write_text(done.stdout, encoding="utf-8")
    assert (ROOT / page).read_text(encoding="utf-8") == done.stdout, STALE


def test_the_readme_shows_a_real_finding() -> None:
    """The block below the README's second command is what it prints, and the picture is made from a run."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    block = re.search(r"```console\n\$ msaa-lint (check [^\n]*)\n(.*?)```", text, re.DOTALL)
    assert block is not None
    arguments = [sys.executable, "-m", "msaa_lint", *block[1].split(), "--output", "full", "--color", "never"]
    done = subprocess.run(arguments, cwd=ROOT, capture_output=True, text=True, check=False)
    if os.environ.get("UPDATE"):
        made = f"```console\n$ msaa-lint {block[1]}\n{done.stdout}```"
        (ROOT / "README.md").write_text(text.replace(block[0], made), encoding="utf-8")
        subprocess.run([sys.executable, "docs/finding.py"], cwd=ROOT, check=True)
        return
    assert block[2] == done.stdout
    assert subprocess.run([sys.executable, "docs/finding.py", "--check"], cwd=ROOT, check=False).returncode == 0


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

"""What the documentation shows is what the program does: made pages are fresh (UPDATE=1 writes them anew), links lead somewhere."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest

from tests.paths import ROOT

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
    """The blocks below the README's commands are what they print, and the picture is made from a run."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    blocks = list(re.finditer(r"```console\n\$ msaa-lint (check [^\n]*)\n(.*?)```", text, re.DOTALL))
    assert len(blocks) == 2
    for block in blocks:
        output = [] if "--output" in block[1] else ["--output", "full"]
        arguments = [sys.executable, "-m", "msaa_lint", *block[1].split(), *output, "--color", "never"]
        done = subprocess.run(arguments, cwd=ROOT, capture_output=True, text=True, check=False)
        if os.environ.get("UPDATE"):
            text = text.replace(block[0], f"```console\n$ msaa-lint {block[1]}\n{done.stdout}```")
            (ROOT / "README.md").write_text(text, encoding="utf-8")
        else:
            assert block[2] == done.stdout
    if os.environ.get("UPDATE"):
        subprocess.run([sys.executable, "docs/finding.py"], cwd=ROOT, check=True)
        return
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

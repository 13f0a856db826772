"""The documentation shows what the program does: generated pages are fresh (UPDATE=1 regenerates
them), and links work.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from msaa_lint.linter.settings.config_keys import KEYS, MAX_LIMITS
from msaa_lint.linter.settings.reference import SETTINGS, table
from msaa_lint.linter.settings.settings import Settings
from tests.paths import ROOT

GENERATED = {
    "rules/README.md": ["-m", "msaa_lint", "rule", "--all", "--output", "markdown"],
    "docs/facts.md": ["-m", "msaa_lint", "facts", "--output", "markdown"],
    "docs/commands.md": ["-m", "docs.commands"],
    "docs/keys.md": ["-m", "docs.keys"],
    "docs/rows.md": ["-m", "docs.rows"],
}


STALE = """stale: `UPDATE=1 python -m pytest tests/test_docs.py` regenerates it;
for a new rule page, also run `PYTHONPATH=. python docs/agreement.py`"""


@pytest.mark.parametrize("page", GENERATED)
def test_generated_pages_are_fresh(page: str) -> None:
    done = subprocess.run(
        [sys.executable, *GENERATED[page]], cwd=ROOT, capture_output=True, text=True, check=True
    )
    if os.environ.get("UPDATE"):
        (ROOT / page).write_text(done.stdout, encoding="utf-8")
    assert (ROOT / page).read_text(encoding="utf-8") == done.stdout, STALE


def test_the_table_of_settings_is_that_of_editors() -> None:
    page = ROOT / "docs" / "configuration.md"
    text = page.read_text(encoding="utf-8")
    stated = next(part for part in text.split("\n\n") if part.startswith("| key |"))
    if os.environ.get("UPDATE"):
        page.write_text(text.replace(stated, table()), encoding="utf-8")
        return
    assert stated == table(), STALE


def test_every_setting_is_documented_with_its_default() -> None:
    tables = {"limits": list(MAX_LIMITS), "source": ["assume"]}
    names = [f"{key}.{name}" if name else key for key in KEYS for name in tables.get(key, [""])]
    assert sorted(SETTINGS) == sorted([*names, "extends"])
    assert {name: int(SETTINGS[f"limits.{name}"].default) for name in MAX_LIMITS} == MAX_LIMITS
    defaults = Settings()
    for key in ("fail-on", "fail-confidence", "min-severity", "respect-gitignore", "strict-inputs"):
        assert SETTINGS[key].default == f"`{str(getattr(defaults, key.replace('-', '_'))).lower()}`"


def test_the_picture_of_a_finding_is_fresh() -> None:
    check = [] if os.environ.get("UPDATE") else ["--check"]
    assert (
        subprocess.run(
            [sys.executable, "docs/finding.py", *check], cwd=ROOT, check=False
        ).returncode
        == 0
    )


PAGES = [
    *sorted(path.name for path in ROOT.glob("*.md")),
    *sorted(f"docs/{path.name}" for path in ROOT.glob("docs/*.md")),
    "examples/README.md",
    "rules/README.md",
]


def anchors(path: Path) -> set[str]:
    """The anchors that GitHub gives to the headings of a page."""
    headings = re.findall(r"^#+ (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_somewhere(page: str) -> None:
    path = ROOT / page
    for target, anchor in re.findall(
        r"\]\(([^)#:]*)(?:#([^)]*))?\)", path.read_text(encoding="utf-8")
    ):
        linked = path.parent / target if target else path
        assert linked.exists(), f"{page} links to {target}"
        assert not anchor or anchor in anchors(linked), f"{page} links to {target}#{anchor}"

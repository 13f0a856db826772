"""The page of `corpus`: its tables in Chromium, without a message, a violation of WCAG, or a name
of a stranger that is not text.
"""

from __future__ import annotations

import base64
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

pytest.importorskip("duckdb")
pytest.importorskip("pyarrow")

from tests.cli.corpora import SIZE, write_inputs
from tests.command import run
from tests.descriptions import STORED

from .browser import PHONE, Browser
from .test_pages import HOSTILE

WORDS = {
    "rules": ("--by", "rule"),
    "devices": ("--by", "device", "--since", "old.sqlite"),
    "query": ("--sql", "select * from findings"),
    "nothing": ("--sql", "select * from run where false"),
}


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("corpus")
    write_inputs(folder / "inputs")
    run(folder, "check", "--isolated", "inputs", "--output", "sqlite=old.sqlite")
    (folder / "inputs" / "clean.msaa.yaml").write_text(SIZE + STORED)
    run(folder, "check", "--isolated", "inputs", "--output", "sqlite=new.sqlite")
    for name, words in WORDS.items():
        done = run(folder, "corpus", "new.sqlite", *words, "--output", f"html={name}.html")
        assert (done.returncode, done.stderr) == (0, "")
    return {name: folder / f"{name}.html" for name in WORDS}


@pytest.mark.parametrize("name", WORDS)
@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_opens_without_a_message_or_a_violation_of_wcag(
    browser: Browser, pages: dict[str, Path], name: str, dark: bool
) -> None:
    browser.open(pages[name], dark=dark)
    assert browser.complaints() == []
    assert browser.run("return performance.getEntriesByType('resource').length") == 0
    assert browser.violations() == []


@pytest.mark.parametrize("name", WORDS)
def test_a_phone_scrolls_in_one_direction(
    browser: Browser, pages: dict[str, Path], name: str
) -> None:
    browser.open(pages[name], width=PHONE)
    assert browser.overflow() == 0
    assert browser.violations() == []


def test_prints(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["devices"], dark=True)
    assert base64.b64decode(
        browser.driver.execute_cdp_cmd("Page.printToPDF", {})["data"]
    ).startswith(b"%PDF")
    browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    assert (
        browser.run("return getComputedStyle(document.body).backgroundColor")
        == "rgb(255, 255, 255)"
    )


@pytest.mark.parametrize(
    "words", [("--by", "device"), ("--by", "input"), ("--sql", "select rule, input from findings")]
)
def test_names_of_strangers_stay_text(
    browser: Browser, tmp_path: Path, words: tuple[str, ...]
) -> None:
    (tmp_path / "a.msaa.yaml").write_text(SIZE + STORED)
    run(tmp_path, "check", "--isolated", "a.msaa.yaml", "--output", "sqlite=a.sqlite")
    name = " ".join(HOSTILE)
    with closing(sqlite3.connect(tmp_path / "a.sqlite", isolation_level=None)) as connection:
        for column in ("rule", "input"):
            connection.execute(f"UPDATE findings SET {column} = ?", (name,))
        connection.execute("UPDATE inputs SET device = ?, input = ?", (name, name))
        connection.execute("UPDATE run SET version = ?, edition = ?", (name, name))
    assert run(tmp_path, "corpus", "a.sqlite", *words, "--output", "html=a.html").returncode == 0
    browser.open(tmp_path / "a.html")
    assert browser.complaints() == []
    assert browser.run("return document.images.length") == 0
    assert browser.run("return document.querySelectorAll('b, i').length") == 0
    text = browser.run("return document.body.textContent")
    assert all(each in text for each in HOSTILE if each.isprintable())
    assert "a\\u202eb" in text and "\u202e" not in text and "\u2028" not in text
    assert browser.violations() == []

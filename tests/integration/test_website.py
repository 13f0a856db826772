"""The site of the documentation: built as `docs/build` builds it, with working links, and nothing
that is loaded from elsewhere.
"""

from __future__ import annotations

import functools
import http.server
import os
import re
import subprocess
import sys
import threading
from collections.abc import Iterator
from html.parser import HTMLParser
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urldefrag, urljoin

import pytest

from docs.website import REFERENCE, navigation, sources, target_of
from msaa_lint.linter.rules.registry import load
from msaa_lint.linter.rules.rule import Rule
from tests.cli.report.html.browser import Browser
from tests.cli.report.html.conftest import browser  # noqa: F401
from tests.paths import ROOT

pytestmark = [
    pytest.mark.skipif(find_spec("zensical") is None, reason="zensical is not installed"),
    pytest.mark.skipif(sys.platform == "win32", reason="docs/build is a shell script"),
]

RULES = load().rules
LOADS = {
    "script": "src",
    "img": "src",
    "iframe": "src",
    "source": "src",
    "use": "href",
    "image": "href",
    "object": "data",
}
"""What a page loads, by element; of `link`, what is no mere reference."""


OF_THE_THEME = ("landmark-unique", "scrollable-region-focusable")
"""What axe finds in every site that Zensical builds: its navigation, and code that is wider than
the page.
"""


class Document(HTMLParser):
    """The links, what is loaded, and the anchors of a page."""

    def __init__(self, file: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.anchors: set[str] = set()
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        self.anchors.update(
            filter(None, (values.get("id"), values.get("name") if tag == "a" else None))
        )
        if tag in LOADS and LOADS[tag] in values:
            self.loaded.append(values[LOADS[tag]])
        if tag == "link" and values.get("rel") not in ("canonical", "next", "prev", "edit"):
            self.loaded.append(values.get("href", ""))
        if tag == "a" and "href" in values:
            self.links.append(values["href"])


def build(folder: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    variables = {**os.environ, "PYTHON": sys.executable, **environment}
    return subprocess.run(
        ["sh", "docs/build", str(folder)],
        cwd=ROOT,
        env=variables,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the built pages."""
    folder = tmp_path_factory.mktemp("site")
    done = build(folder)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.splitlines()[-1].endswith(
        f" its search needs a web server: python3 -m http.server --directory {folder / 'html'}"
    )
    return folder / "html"


@pytest.fixture(scope="module")
def documents(site: Path) -> dict[str, Document]:
    """The pages by their path, except the one for missing pages, which does not know where it
    is.
    """
    return {
        file.relative_to(site).as_posix(): Document(file)
        for file in site.rglob("*.html")
        if file.name != "404.html"
    }


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.name)
def test_every_rule_has_a_page_at_its_address(site: Path, rule: Rule) -> None:
    text = (site / "rules" / rule.name / "index.html").read_text(encoding="utf-8")
    assert f">{rule.name}<" in text and rule.code in text
    assert ">Price</p>" in text and ">References<" in text
    assert 'class="bad highlight"' in text or 'class="language-' in text
    assert f'href="{rule.name}/"' in (site / "rules" / "index.html").read_text(encoding="utf-8")


def test_a_page_has_the_price_and_the_picture_of_its_example(site: Path) -> None:
    text = (site / "rules" / "resolve-outside-pass" / "index.html").read_text(encoding="utf-8")
    price = "+1991 MB/s written, +1991 MB/s read, +398 mW on a tile-based GPU"
    assert f"<strong>{price}</strong> in a frame of 1920x1080 pixels at 60 Hz" in text
    picture = text[text.index("<svg role=") : text.index("</svg>", text.index("<svg role="))]
    assert "scene writes color_ms (store): 33.2 MB a frame, 1990.66 MB/s" in picture
    assert "resolve command 4x · 33.2 MB" in picture
    drawn = [
        rule
        for rule in RULES
        if "<svg role=" in (site / "rules" / rule.name / "index.html").read_text(encoding="utf-8")
    ]
    assert len(drawn) > 70


def test_links_lead_to_pages_and_anchors(site: Path, documents: dict[str, Document]) -> None:
    broken = []
    for name, document in documents.items():
        for link in document.links:
            address, anchor = urldefrag(
                urljoin(f"site:/{name}".replace("site:", "http://site"), link)
            )
            if not address.startswith("http://site/"):
                continue
            target = unquote(address.removeprefix("http://site/"))
            target = f"{target}index.html" if target == "" or target.endswith("/") else target
            if not (site / target).is_file() or (
                anchor and target in documents and unquote(anchor) not in documents[target].anchors
            ):
                broken.append((name, link))
    assert broken == []
    assert sum(len(document.links) for document in documents.values()) > 2000


def test_every_page_is_in_the_navigation() -> None:
    """A page that is not would only be found by search."""
    listed = repr(navigation())
    assert [source for source in sources() if f"'{target_of(source)}'" not in listed] == []
    assert all(
        (ROOT / f"docs/{name}.md").exists() for names in REFERENCE.values() for name in names
    )


def test_nothing_is_loaded_from_elsewhere(site: Path, documents: dict[str, Document]) -> None:
    external = re.compile(r"(?:[a-z]+:)?//", re.IGNORECASE)
    assert [
        (name, each)
        for name, document in documents.items()
        for each in document.loaded
        if external.match(each)
    ] == []
    for file in (*site.rglob("*.css"), *site.rglob("*.svg")):
        text = file.read_text(encoding="utf-8")
        assert (
            re.findall(
                r"@import[^;]*|url\(\s*[\"']?(?:[a-z]+:)?//[^)]*|<(?:image|use)[^>]*href=\"http[^\"]*",
                text,
            )
            == []
        ), file


def test_a_broken_link_fails_the_build(tmp_path: Path) -> None:
    assert build(tmp_path).returncode == 0
    command = [
        sys.executable,
        "-m",
        "zensical",
        "build",
        "--strict",
        "--clean",
        "--config-file",
        str(tmp_path / "zensical.toml"),
    ]
    for link in ("../none.md", "ci.md#none"):
        page = tmp_path / "pages" / "docs" / "guides" / "ci.md"
        text = page.read_text(encoding="utf-8")
        page.write_text(f"{text}\n[a link]({link})\n", encoding="utf-8")
        assert subprocess.run(command, capture_output=True, check=False).returncode != 0
        page.write_text(text, encoding="utf-8")


def test_the_address_of_the_site_is_in_the_map_of_the_site(tmp_path: Path) -> None:
    assert build(tmp_path, SITE_URL="https://example.com/msaa-lint").returncode == 0
    assert "<loc>https://example.com/msaa-lint/rules/resolve-outside-pass/</loc>" in (
        tmp_path / "html" / "sitemap.xml"
    ).read_text("utf-8")


@pytest.fixture(scope="module")
def address(site: Path) -> Iterator[str]:
    """The site on a local server: browsers load no search index from files."""
    handler = functools.partial(Quiet, directory=str(site))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()


class Quiet(http.server.SimpleHTTPRequestHandler):
    """Serves without a log."""

    def log_message(self, format: str, *values: Any) -> None: ...


class Address(str):
    """An address in place of a path."""

    def as_uri(self) -> str:
        return str(self)


def show(window: Browser, address: str, page: str, **options: Any) -> None:
    window.open(Address(address + page), **options)  # type: ignore[arg-type]


def test_pages_in_a_browser(browser: Browser, address: str, tmp_path: Path) -> None:  # noqa: F811
    """Without an error, as wide as the window, on a phone too. UPDATE=1 keeps the pictures."""
    folder = ROOT / "docs" / "images" if os.environ.get("UPDATE") else tmp_path
    pages = {
        "site-home": ("", {}),
        "site-rule": ("rules/resolve-outside-pass/", {}),
        "site-rules": ("rules/", {"dark": True}),
    }
    for name, (page, options) in pages.items():
        show(browser, address, page, **options)
        assert browser.complaints() == []
        assert browser.overflow() == 0
        assert (
            browser.run(
                "return performance.getEntriesByType('resource').filter(each => "
                "!each.name.startsWith(arguments[0]))",
                address,
            )
            == []
        )
        assert [each for each in browser.violations() if not each.startswith(OF_THE_THEME)] == []
        # Taking a picture changes the size of the window for a moment, and tabs fade in.
        browser.run(
            "document.head.insertAdjacentHTML('beforeend', '<style>* { transition: none !important "
            "}</style>')"
        )
        browser.picture(folder / f"{name}.png", height=820)
        assert (folder / f"{name}.png").stat().st_size < 150_000
        show(browser, address, page, width=390)
        assert browser.overflow() == 0


def test_the_list_of_rules_is_filtered(browser: Browser, address: str) -> None:  # noqa: F811
    show(browser, address, "rules/")

    def shown() -> int:
        return sum(row.is_displayed() for row in browser.all("table.rules tbody tr"))

    assert shown() == len(RULES)
    browser.all("input.severity-warning")[0].click()
    browser.all("input.severity-note")[0].click()
    assert shown() == sum(rule.severity == "error" for rule in RULES)
    browser.all("input.fix-none")[0].click()
    assert shown() == sum(rule.severity == "error" and bool(rule.fix_specs) for rule in RULES)
    browser.all("input.api-vulkan")[0].click()
    assert shown() == sum(
        rule.severity == "error" and bool(rule.fix_specs) and "metal" in rule.apis for rule in RULES
    )


def test_the_search_finds_a_rule(browser: Browser, address: str) -> None:  # noqa: F811
    show(browser, address, "")
    from selenium.webdriver.common.action_chains import ActionChains

    dialog = "[...document.querySelectorAll('*')].find(each => each.shadowRoot)?.shadowRoot"
    browser.all(".md-search__button")[0].click()
    browser.wait(f"return Boolean({dialog}?.querySelector('input'))")
    ActionChains(browser.driver).send_keys("resolve-outside-pass").perform()
    browser.wait(
        f"return [...({dialog}?.querySelectorAll('a') ?? [])].some(each => "
        "each.href.includes('/rules/resolve-outside-pass/'))"
    )

"""Reports opened in Chromium: no error, no violation of the policy or of WCAG, filters, widths,
print, and texts of strangers.
"""

from __future__ import annotations

import base64
import json
import os
from pathlib import Path

import pytest

from msaa_lint.core.text.span import Span
from tests.cli.report.html.browser import Browser
from tests.cli.report.sample import finding, printed, result
from tests.command import run
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"
COMMANDS = {
    "check": ("check", "phone/frame.msaa.yaml", "frame/deferred-forward.msaa.yaml"),
    "cost": ("cost", "phone/frame.msaa.yaml"),
    "comparison": (
        "cost",
        "khronos-msaa/color-separate.msaa.yaml",
        "khronos-msaa/inline.msaa.yaml",
    ),
}

HOSTILE = [
    "</script><img src=x onerror=alert(1)>",
    "]]>",
    "--><b>x</b>",
    "a\u202eb",
    "{{ 7 * 7 }}",
    "\" onload='alert(1)'",
    "&lt;i&gt;",
    "\u2028",
]


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("pages")
    for name, (command, *inputs) in COMMANDS.items():
        done = run(
            EXAMPLES, command, "--isolated", *inputs, "--output", f"html={folder / name}.html"
        )
        assert done.returncode in (0, 1), done.stderr
    return {name: folder / f"{name}.html" for name in COMMANDS}


@pytest.mark.parametrize("name", COMMANDS)
def test_opens_without_a_message(browser: Browser, pages: dict[str, Path], name: str) -> None:
    browser.open(pages[name])
    assert browser.complaints() == []
    assert browser.run("return performance.getEntriesByType('resource').length") == 0
    assert browser.run("return document.documentElement.classList.contains('with-script')")


def test_the_policy_refuses_scripts(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["check"])
    browser.run(
        "const script = document.createElement('script'); script.textContent = 'window.ran = 1'; "
        "document.body.append(script);"
    )
    browser.run(
        "document.body.insertAdjacentHTML('beforeend', '<p style=\"color: red\" "
        'onclick="1">x</p><img src="http://127.0.0.1:9/x">\');'
    )
    assert browser.run("return window.ran") is None
    assert sum("Content Security Policy" in message for message in browser.complaints()) >= 3


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("name", COMMANDS)
def test_no_violation_of_wcag(
    browser: Browser, pages: dict[str, Path], name: str, dark: bool
) -> None:
    browser.open(pages[name], dark=dark)
    open_everything(browser)
    assert browser.violations() == []


@pytest.mark.parametrize("name", COMMANDS)
def test_a_phone_scrolls_in_one_direction(
    browser: Browser, pages: dict[str, Path], name: str
) -> None:
    browser.open(pages[name], width=360)
    open_everything(browser)
    assert browser.overflow() == 0
    assert browser.violations() == []


def shown(browser: Browser) -> list[str]:
    """The findings that are visible, in their order on the page."""
    return list(
        browser.run(
            "return [...document.querySelectorAll('.finding')].filter(e => "
            "e.checkVisibility()).map(e => e.dataset.rule)"
        )
    )


def prices_of(browser: Browser, selector: str) -> list[float]:
    prices = browser.run(
        "return [...document.querySelectorAll(arguments[0])].map(e => e.dataset.price)", selector
    )
    return list(map(float, prices))


def choose(browser: Browser, name: str, value: str) -> None:
    script = "const field = document.forms[0].elements[arguments[0]]; field.value = arguments[1];"
    browser.run(script + "field.dispatchEvent(new Event('input', {bubbles: true}));", name, value)


def fragment(browser: Browser) -> str:
    return str(browser.run("return location.hash"))


def test_filters_are_in_the_address(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["check"])
    every = shown(browser)
    assert len(every) > 6
    choose(browser, "severity", "note")
    notes = shown(browser)
    assert 0 < len(notes) < len(every)
    assert fragment(browser) == "#severity=note"
    choose(browser, "text", notes[0])
    assert fragment(browser) == f"#severity=note&text={notes[0]}"
    assert set(shown(browser)) == {notes[0]}
    assert browser.run("return document.getElementById('count').textContent").startswith(
        f"{notes.count(notes[0])} of {len(every)} "
    )
    browser.driver.back()
    assert shown(browser) == every
    browser.driver.forward()
    assert set(shown(browser)) == {notes[0]}
    browser.open(pages["check"], fragment=f"#rule={every[0]}&confidence=high")
    assert set(shown(browser)) == {every[0]}
    browser.run("document.forms[0].reset()")
    browser.run("return new Promise(resolve => setTimeout(resolve, 50))")
    assert (shown(browser), fragment(browser)) == (every, "")


def test_filters_by_input_and_price_and_sorts(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["check"])
    every = shown(browser)
    choose(browser, "input", "1")
    assert 0 < len(shown(browser)) < len(every)
    choose(browser, "input", "")
    choose(browser, "price", "200")
    prices = [
        float(each)
        for each in browser.run(
            "return [...document.querySelectorAll('.finding:not([hidden])')].map(e => "
            "e.dataset.price)"
        )
    ]
    assert prices and min(prices) >= 200
    choose(browser, "price", "")
    choose(browser, "sort", "price")
    prices = prices_of(browser, ".finding")
    assert prices == sorted(prices, reverse=True)
    assert sorted(shown(browser)) == sorted(every)
    choose(browser, "sort", "")
    assert shown(browser) == every


def test_a_fragment_of_a_stranger_is_no_error(browser: Browser, pages: dict[str, Path]) -> None:
    for value in (
        "#severity=none&rule=%3Cimg%3E",
        "#%E0%A4%A",
        "#nothing",
        "#=",
        "#price=x&sort=y",
    ):
        browser.open(pages["check"], fragment=value)
        assert browser.complaints() == [], value
        assert shown(browser), value


def test_a_link_to_a_rule_opens_its_page(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["check"])
    before = shown(browser)
    browser.run("document.querySelector('.finding .facts a').click()")
    browser.run("return new Promise(resolve => setTimeout(resolve, 100))")
    assert fragment(browser).startswith("#rule-")
    assert browser.run(
        "return document.getElementById(location.hash.slice(1)).closest('details').open"
    )
    assert shown(browser) == before


def test_reads_without_a_script(browser: Browser, pages: dict[str, Path]) -> None:
    browser.open(pages["check"])
    every = shown(browser)
    browser.open(pages["check"], script=False)
    try:
        assert not [each for each in browser.all(".filters") if each.is_displayed()]
        assert len([each for each in browser.all(".finding") if each.is_displayed()]) == len(every)
    finally:
        browser.driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})


def test_works_by_keyboard(browser: Browser, pages: dict[str, Path]) -> None:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

    browser.open(pages["check"])
    ActionChains(browser.driver).send_keys(Keys.TAB).perform()
    assert browser.run("return document.activeElement.textContent") == "Skip to the report"
    assert browser.run("return getComputedStyle(document.activeElement).outlineStyle") == "solid"
    browser.run("document.forms[0].elements.severity.focus()")
    ActionChains(browser.driver).send_keys("n").perform()
    assert fragment(browser) == "#severity=note"
    browser.run("document.querySelector('details.rule summary').focus()")
    ActionChains(browser.driver).send_keys(Keys.ENTER).perform()
    assert browser.run("return document.querySelector('details.rule').open")


@pytest.mark.parametrize("name", COMMANDS)
def test_prints(browser: Browser, pages: dict[str, Path], name: str) -> None:
    browser.open(pages[name], dark=True)
    pdf = base64.b64decode(
        browser.driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})["data"]
    )
    assert pdf.startswith(b"%PDF")
    browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    assert (
        browser.run("return getComputedStyle(document.body).backgroundColor")
        == "rgb(255, 255, 255)"
    )
    assert browser.run(
        "return [...document.querySelectorAll('.filters, .contents, .skip')].every(e => "
        "!e.checkVisibility())"
    )


def test_names_of_strangers_stay_text(browser: Browser, tmp_path: Path) -> None:
    image = {
        "format": "R8G8B8A8_UNORM",
        "samples": 4,
        "usage": ["COLOR_ATTACHMENT"],
        "extent": {"width": 64, "height": 64},
    }
    operations = {
        "loadOp": "CLEAR",
        "storeOp": "STORE",
        "initialLayout": "UNDEFINED",
        "finalLayout": "COLOR_ATTACHMENT_OPTIMAL",
    }
    frame = {
        "images": dict.fromkeys(HOSTILE, image),
        "renderPasses": {
            name: {
                "attachments": {name: {"image": name, **operations}},
                "subpasses": [{"colorAttachments": [name]}],
            }
            for name in HOSTILE
        },
    }
    (tmp_path / "<b>&.msaa.json").write_text(json.dumps(frame))
    for command in ("check", "cost"):
        page = tmp_path / f"{command}.html"
        done = run(tmp_path, command, "--isolated", "<b>&.msaa.json", "--output", f"html={page}")
        assert page.exists(), done.stderr
        browser.open(page)
        assert browser.complaints() == []
        assert browser.run("return document.images.length") == 0
        assert browser.run("return document.querySelectorAll('b, i').length") == 0
        text = browser.run("return document.body.textContent")
        assert "<b>&.msaa.json" in text
        assert all(name in text for name in HOSTILE if name.isprintable())
        assert "a\\u202eb" in text and "\u202e" not in text and "\u2028" not in text
        open_everything(browser)
        assert browser.violations() == []


def open_everything(browser: Browser) -> None:
    """Opens and renders what is closed, or not in the window: axe looks at the rest alone."""
    browser.run("for (const each of document.querySelectorAll('details')) each.open = true;")
    browser.run(
        "for (const each of document.querySelectorAll('.finding')) each.style.contentVisibility = "
        "'visible';"
    )


@pytest.mark.skipif(
    not os.environ.get("UPDATE"), reason="UPDATE=1 draws the pictures of the documentation"
)
def test_pictures_of_the_documentation(browser: Browser, pages: dict[str, Path]) -> None:
    images = ROOT / "docs" / "images"
    browser.open(pages["check"])
    browser.picture(images / "report-check.png", height=1150)
    open_everything(browser)
    top = browser.run(
        "return document.getElementById('findings').getBoundingClientRect().top + scrollY"
    )
    browser.picture(images / "report-findings.png", top=int(top), height=1000)
    browser.open(pages["check"], width=360, dark=True)
    browser.picture(images / "report-phone.png", height=900)
    browser.open(pages["cost"], dark=True)
    browser.picture(images / "report-cost.png", height=1250)
    browser.open(pages["comparison"])
    browser.picture(images / "report-comparison.png", height=1050)


def test_ten_thousand_findings_open(browser: Browser, tmp_path: Path) -> None:
    page = tmp_path / "many.html"
    text = "images: {a: {format: R8G8B8A8_UNORM, samples: 4}}\n" * 20
    page.write_text(
        printed(
            "html",
            result(*(finding(f"finding {n}", span=Span(10, 20)) for n in range(10_000)), text=text),
        )
    )
    browser.open(page)
    choose(browser, "text", "finding 999")
    assert (
        browser.run("return document.getElementById('count').textContent") == "11 of 10000 findings"
    )
    assert browser.complaints() == []

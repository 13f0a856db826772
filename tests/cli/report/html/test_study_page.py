"""The page of `study`: what it says without scripts, and its figures and sliders in Chromium."""

from __future__ import annotations

import os
import re
from functools import cache
from pathlib import Path

import pytest

from msaa_lint.cli.report import Options
from msaa_lint.cli.report.html.study import render
from msaa_lint.experiments.confirm.png import Picture
from msaa_lint.experiments.study.crops import Crops
from msaa_lint.experiments.study.outcome import Study
from msaa_lint.experiments.study.points import MSAA, Technique
from msaa_lint.experiments.study.predictions import predictions
from tests.command import run
from tests.experiments.study.gpu import gpu_study
from tests.paths import ROOT

from .browser import PHONE, Browser

HOSTILE = (
    "</script><script>alert(1)</script><img src=x onerror=alert(1)>\x1b[31m\u202e{{7*7}}\udcff"
    + "x" * 300
)
CHART = '[data-figure="0"]'
DOTS = f"{CHART} [role=graphics-symbol][aria-roledescription=point]"


def page(folder: Path, study: Study) -> Path:
    path = folder / "study.html"
    pieces: list[str] = []
    render(study, pieces.append, Options())
    path.write_text("".join(pieces), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return page(tmp_path_factory.mktemp("page"), _study())


@cache
def _study() -> Study:
    return gpu_study("edge-fan", "wires")


def test_figures_are_drawn_without_a_complaint(browser: Browser, report: Path) -> None:
    browser.open(report)
    assert browser.complaints() == []
    assert browser.run("return document.documentElement.dataset.drawn") == "4"
    assert browser.texts("h2") == ["What to take within 1 ms", "edge-fan", "wires"]
    assert len(browser.all(DOTS)) == 13
    # Of the pictures that are for paper, none is shown.
    assert not any(picture.is_displayed() for picture in browser.all("img"))


def test_one_bundle_of_vega_however_many_figures(tmp_path: Path, report: Path) -> None:
    text = report.read_text()
    assert len(re.findall("window.vegaEmbed=", text)) == 1
    assert len(text) < 1_900_000
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', text)
    assert (
        policy is not None
        and "unsafe" not in policy[1]
        and "default-src &#39;none&#39;" in policy[1]
    )


def test_values_are_shown_on_hover(browser: Browser, report: Path) -> None:
    from selenium.webdriver.common.action_chains import ActionChains

    browser.open(report)
    assert not browser.all("#tip")[0].is_displayed()
    dot = browser.all(DOTS)[-1]
    browser.run("arguments[0].scrollIntoView({block: 'center'})", dot)
    ActionChains(browser.driver).move_to_element(dot).perform()
    browser.wait("return !document.getElementById('tip').hidden")
    lines = browser.texts("#tip")[0].splitlines()
    one = next(point for point in _study().of("edge-fan", "medium") if point.technique.name == "1x")
    assert one.time_ms is not None
    assert lines[0] == "technique: 1x"
    assert float(lines[1].removeprefix("error: ")) == pytest.approx(one.rmse, abs=0.001)
    assert float(lines[2].removeprefix("time, ms: ")) == pytest.approx(one.time_ms, abs=0.01)


def test_values_are_reached_by_keyboard(browser: Browser, report: Path) -> None:
    from selenium.webdriver.common.keys import Keys

    browser.open(report)
    first, stops = (
        browser.all(DOTS)[0],
        [dot for dot in browser.all(DOTS) if dot.get_attribute("tabindex") == "0"],
    )
    assert stops == [first]
    browser.run("arguments[0].focus()", first)
    assert browser.texts("#tip")[0].startswith("technique: SSAA 4x4")
    first.send_keys(Keys.ARROW_RIGHT)
    assert browser.texts("#tip")[0].startswith("technique: SSAA 3x3")
    browser.all(DOTS)[1].send_keys(Keys.ESCAPE)
    assert not browser.all("#tip")[0].is_displayed()


def test_the_slider_moves_points_front_and_recommendation(browser: Browser, report: Path) -> None:
    from selenium.webdriver.common.keys import Keys

    browser.open(report)
    costs = predictions(_study(), "edge-fan")
    number = int(browser.all("#cost-1")[0].get_attribute("value"))
    before = [dot.get_attribute("transform") for dot in browser.all(DOTS)]
    front = browser.all(f"{CHART} .mark-line path")[0].get_attribute("d")
    assert costs[number].shading.name == "medium"
    assert browser.texts(f"{CHART} [data-take]") == [
        f"Take {costs[number].study.recommendations[0].technique.name}."
    ]
    browser.keys("#cost-1", Keys.ARROW_LEFT)
    browser.wait(
        f"return document.querySelector('{CHART} [data-label]').textContent.includes('predicted')"
    )
    cost = costs[number - 1]
    assert browser.texts(f"{CHART} [data-label]") == [
        f"{cost.shading.full_screen_ms:.3g} ms a full screen at 1x (predicted)"
    ]
    assert (
        browser.all("#cost-1")[0].get_attribute("aria-valuetext")
        == browser.texts(f"{CHART} [data-label]")[0]
    )
    browser.keys("#cost-1", Keys.HOME)
    browser.wait(
        f"return document.querySelector('{CHART} [data-label]').textContent.startsWith('0 ms')"
    )
    browser.wait(
        f"return document.querySelector('{CHART} .mark-line path').getAttribute('d') !== '{front}'"
    )
    assert before != [dot.get_attribute("transform") for dot in browser.all(DOTS)]
    choice = costs[0].study.recommendations[0]
    assert browser.texts(f"{CHART} [data-take]") == [f"Take {choice.technique.name}."]
    assert browser.texts(f"{CHART} [data-reasons] li") == [choice.reason, choice.following]
    # The other scene stays where it was.
    assert "medium" in browser.texts("[data-figure='2'] [data-label]")[0]
    browser.all(f"{CHART} button")[-1].click()
    browser.wait(
        f"return document.querySelector('{CHART} [data-label]').textContent.includes('heavy, "
        "measured')"
    )
    assert browser.complaints() == []


def test_hostile_names_stay_text(browser: Browser, tmp_path: Path) -> None:
    study = gpu_study(HOSTILE, device=HOSTILE)
    browser.open(page(tmp_path, study))
    assert browser.complaints() == []
    assert browser.run("return document.querySelectorAll('img[src=x]').length") == 0
    assert browser.texts("h2")[1].startswith(
        "</script><script>alert(1)</script><img src=x onerror=alert(1)>\\x1b[31m\\u202e{{7*7}}"
    )


def test_a_scene_named_like_a_color_keeps_its_name(browser: Browser, tmp_path: Path) -> None:
    browser.open(page(tmp_path, gpu_study("white")), dark=True)
    assert (
        browser.run(
            "return [...document.querySelectorAll('.drawing text')].filter((text) => "
            "text.textContent === 'white').length"
        )
        == 6
    )
    # The background follows the page's, which is dark.
    backgrounds = browser.run(
        "return ['body', '.drawing svg'].map((name) => "
        "getComputedStyle(document.querySelector(name)).backgroundColor)"
    )
    assert backgrounds[0] == backgrounds[1] != "rgb(255, 255, 255)"


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_axe_has_nothing_to_say(browser: Browser, report: Path, dark: bool) -> None:
    browser.open(report, dark=dark)
    assert browser.violations() == []


def test_it_fits_a_phone(browser: Browser, report: Path) -> None:
    browser.open(report, width=PHONE)
    assert browser.overflow() == 0


def test_paper_has_the_pictures_without_controls(browser: Browser, report: Path) -> None:
    browser.open(report, dark=True)
    browser.open(report, media="print")
    assert [picture.is_displayed() for picture in browser.all("img")] == [True, True]
    assert not any(control.is_displayed() for control in browser.all("input, button, .drawing"))


def test_without_scripts_the_pictures_stay(browser: Browser, report: Path) -> None:
    browser.open(report, script=False)
    pictures = browser.all("img")
    assert [picture.is_displayed() and picture.size["width"] > 400 for picture in pictures] == [
        True,
        True,
    ]
    assert not any(control.is_displayed() for control in browser.all("input, button"))
    assert browser.texts("table")[0].startswith(
        "The least error that adds at most 1 ms to one sample"
    )


def test_a_software_driver_has_no_slider(browser: Browser, tmp_path: Path) -> None:
    browser.open(page(tmp_path, gpu_study(software=True)))
    assert browser.all("input") == [] and browser.complaints() == []
    assert browser.texts(".head .warning") == [
        "A GPU is a software driver: its times say nothing about a GPU, and nothing is recommended "
        "from them"
    ]


def test_the_command_writes_a_page(browser: Browser, tmp_path: Path) -> None:
    done = run(
        tmp_path,
        "study",
        "--isolated",
        "edge-fan",
        "--size",
        "64x48",
        "--samples",
        "1,4",
        "--jobs",
        "1",
        "--output",
        "html=a.html",
    )
    assert (done.returncode, done.stderr) == (0, "")
    browser.open(tmp_path / "a.html")
    assert browser.complaints() == []
    assert browser.texts("h1") == ["Study of edge-fan"]
    assert browser.texts("caption") == ["Errors and work"]


@pytest.fixture(scope="module")
def report_with_crops(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Of two scenes, by the command."""
    folder = tmp_path_factory.mktemp("crops")
    words = [
        "edge-fan",
        "wires",
        "--size",
        "64x48",
        "--samples",
        "1,4",
        "--jobs",
        "1",
        "--crops",
        "crops",
        "--output",
        "html=study.html",
    ]
    done = run(folder, "study", "--isolated", *words)
    assert (done.returncode, done.stderr) == (0, "")
    return folder / "study.html"


def test_crops_are_in_the_page(browser: Browser, report_with_crops: Path) -> None:
    browser.open(report_with_crops)
    assert browser.complaints() == []
    groups = [group.get_attribute("aria-label") for group in browser.all(".crops")]
    rows = ["1x to 4x", "4x/2 to 4x/4", "SSAA 2x2 to SSAA 4x4"]
    assert groups == [f"Crops of {scene}: {row}" for scene in ("edge-fan", "wires") for row in rows]
    first = browser.all(".crops")[0]
    names = [caption.text for caption in first.find_elements("css selector", "figcaption")]
    pictures = first.find_elements("css selector", "img")
    alternatives = [picture.get_attribute("alt") for picture in pictures]
    assert names == ["exact", "1x", "4x"] and alternatives[0] == "The exact pixels"
    one, four = (
        re.fullmatch(r"\dx: differs from the exact pixels by up to (\d+) of 255", text)
        for text in alternatives[1:]
    )
    assert one is not None and four is not None and int(one[1]) > int(four[1]) > 0
    browser.run("arguments[0].scrollIntoView()", first)
    browser.wait(
        "return [...document.querySelectorAll('.crops:first-of-type img')].every((image) => "
        "image.complete)"
    )
    sizes = [
        browser.run("return [arguments[0].naturalWidth, arguments[0].width]", picture)
        for picture in pictures
    ]
    assert sizes == [[16, 96]] * 3


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_axe_has_nothing_to_say_of_crops(
    browser: Browser, report_with_crops: Path, dark: bool
) -> None:
    browser.open(report_with_crops, dark=dark)
    assert browser.violations() == []


def test_crops_fit_a_phone_and_are_on_paper(browser: Browser, report_with_crops: Path) -> None:
    browser.open(report_with_crops, width=PHONE)
    assert browser.overflow() == 0
    browser.open(report_with_crops, media="print")
    assert all(picture.is_displayed() for picture in browser.all(".crops img"))


def test_crops_beyond_the_limit_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("msaa_lint.cli.report.html.crops.MAX_PICTURES", 3)
    exact, drawn = (Picture(1, 1, bytes(codes)) for codes in ((0, 0, 0), (9, 200, 3)))
    crops = Crops((5, 6), exact, [(Technique(MSAA, 1), drawn)])
    text = page(
        tmp_path, gpu_study("edges", HOSTILE, crops={"edges": crops, HOSTILE: crops})
    ).read_text()
    assert (
        text.count('class="crops"') == 1
        and 'alt="1x: differs from the exact pixels by up to 200 of 255"' in text
    )
    assert "pixels 5 to 5 from the left, 6 to 6 from the top: where 1x differs most" in text
    assert (
        text.count(
            "A page has at most 3 pictures; those of this scene are in the folder of --crops."
        )
        == 1
    )


def test_pictures_for_the_documentation(browser: Browser, report: Path, tmp_path: Path) -> None:
    folder = ROOT / "docs" / "images" if os.environ.get("UPDATE") else tmp_path
    folder.mkdir(exist_ok=True)
    for name, dark in (("study-report.png", False), ("study-report-dark.png", True)):
        browser.open(report, dark=dark)
        browser.picture(folder / name, height=1400)
        assert 10_000 < (folder / name).stat().st_size < 150_000

"""The page of `confirm`: pictures as written and fixed under a slider, their difference, statuses,
messages, and times.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from msaa_lint.cli.report import Options
from msaa_lint.cli.report.html.confirm import render
from msaa_lint.core.finding import Finding
from msaa_lint.experiments.confirm.outcome import (
    AgreementRow,
    DeviceInfo,
    DeviceRun,
    ShownImage,
    Times,
    Verdict,
)
from msaa_lint.experiments.confirm.pixels import RawImage, compare, read
from msaa_lint.experiments.confirm.png import png, version_pictures
from msaa_lint.experiments.confirm.timing import Timing
from tests.command import run
from tests.paths import ROOT

from .browser import PHONE, Browser

HOSTILE = (
    "</script><script>alert(1)</script><img src=x onerror=alert(1)>\x1b[31m\u202e{{7*7}}\udcff"
)
SIDE = 64
R8G8B8A8_UNORM = 37


def drawn(edge: Callable[[int, int], float]) -> RawImage:
    """A picture whose coverage by orange on blue is a function of the place."""
    data = bytearray()
    for y in range(SIDE):
        for x in range(SIDE):
            share = min(max(edge(x, y), 0.0), 1.0)
            data += bytes(
                (int(40 + 200 * share), int(60 + 80 * share), int(140 - 100 * share), 255)
            )
    return RawImage(R8G8B8A8_UNORM, SIDE, SIDE, bytes(data))


SMOOTH = drawn(lambda x, y: (x - 0.4 * y - 20.0) / 3)
SHARP = drawn(lambda x, y: float(x - 0.4 * y > 21.5))


def verdict(name: str = "forward", **other: object) -> Verdict:
    (comparison,) = compare({"color": SMOOTH}, {"color": SHARP})
    before, after = read(SMOOTH), read(SHARP)
    assert before is not None
    files = [png(each) for each in version_pictures(before, after) if each is not None]
    times = Times(
        Timing(23.9, 23.2, 26.1, 15, 0.95, "timestamp"),
        Timing(24.1, 23.7, 25.8, 15, 0.95, "timestamp"),
    )
    row = AgreementRow(
        "both", "BestPractices-store", "store", "multisampled-attachment-stored", "it is stored"
    )
    reason = f"a fix that is marked safe changes the picture: color: {comparison.text}"
    made = Verdict(
        "frame.msaa.yaml", name, "renderPasses." + name, "disagrees", reason, True, (row,),
        ("MSAA001",), True, False, (comparison,),
        times, None, (), (), (ShownImage("color", SIDE, SIDE, *files),),
    )  # fmt: skip
    return made._replace(**other)  # type: ignore[arg-type]


def device_run(*verdicts: Verdict, name: str = "A GPU") -> DeviceRun:
    return DeviceRun(
        DeviceInfo(name, "DISCRETE_GPU", "1.3.250", "a driver"), {"version": "1.3.239"}, verdicts
    )


def page(folder: Path, *runs: DeviceRun, errors: tuple[Finding, ...] = ()) -> Path:
    path = folder / "confirm.html"
    pieces: list[str] = []
    render(runs, errors, pieces.append, Options())
    path.write_text("".join(pieces), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    equal = verdict(
        "post",
        status="confirmed",
        reason="",
        pixels_equal=True,
        images=tuple(compare({"color": SMOOTH}, {"color": SMOOTH})),
    )
    return page(tmp_path_factory.mktemp("page"), device_run(verdict(), equal))


def test_status_messages_and_times_are_there(browser: Browser, report: Path) -> None:
    browser.open(report)
    assert browser.complaints() == []
    assert browser.texts("h1, h2") == ["Confirmation on A GPU", "A GPU"]
    assert browser.texts("tbody tr:first-child > *") == [
        "frame.msaa.yaml: forward", "disagrees", "yes", "1 both", "differ", "23.9 [23.2, 26.1]",
        "24.1 [23.7, 25.8]", "-", "-",
    ]  # fmt: skip
    reasons = browser.texts("section section:first-of-type li")
    assert reasons[1] == "both: BestPractices-store = multisampled-attachment-stored"
    assert [picture.is_displayed() for picture in browser.all("img")] == [True] * 6


def test_the_slider_moves_from_one_picture_to_the_other(browser: Browser, report: Path) -> None:
    from selenium.webdriver.common.keys import Keys

    browser.open(report)
    cut = "return getComputedStyle(document.querySelector('.pair .fixed')).clipPath"
    before, after = (picture.rect for picture in browser.all(".pair:first-child img")[:2])
    assert before == after and before["width"] == 5 * SIDE
    assert browser.run(cut) == "inset(0px 0px 0px 50%)"
    browser.keys(".compare input", Keys.ARROW_RIGHT)
    assert browser.run(cut) == "inset(0px 0px 0px 51%)"
    assert (
        browser.all(".compare input")[0].get_attribute("aria-valuetext")
        == "as written on the left 51 %, fixed on the right 49 %"
    )
    browser.keys(".compare input", Keys.HOME)
    assert browser.run(cut) == "inset(0px)" or browser.run(cut) == "inset(0px 0px 0px 0%)"
    browser.keys(".compare input", Keys.END)
    assert browser.run(cut) == "inset(0px 0px 0px 100%)"
    # The other pass stays where it was.
    assert browser.all(".compare input")[1].get_attribute("value") == "50"


def test_a_drag_on_the_picture_moves_the_slider(browser: Browser, report: Path) -> None:
    from selenium.webdriver.common.action_chains import ActionChains

    browser.open(report)
    pair = browser.all(".pair")[0]
    browser.run("arguments[0].scrollIntoView({block: 'center'})", pair)
    ActionChains(browser.driver).move_to_element(pair).click_and_hold().move_by_offset(
        80, 0
    ).release().perform()
    assert browser.all(".compare input")[0].get_attribute("value") == "75"


def test_the_difference_says_its_scale(browser: Browser, report: Path) -> None:
    browser.open(report)
    captions = browser.texts("figcaption")
    steps = compare({"color": SMOOTH}, {"color": SHARP})[0].greatest
    assert captions[1] == (
        "Difference, amplified: texels that are equal are black, and the greatest difference "
        f"({steps:.0f} steps of the format) is white; "
        "the least is a dark gray"
    )
    assert captions[2].endswith("equal, 4096 pixels")
    assert captions[3] == "Difference: black, because no texel differs"


def test_hostile_names_stay_text(browser: Browser, tmp_path: Path) -> None:
    image = verdict().shown[0]._replace(image=HOSTILE)
    bad = verdict(HOSTILE, file=HOSTILE, reason=HOSTILE, notes=(HOSTILE,), shown=(image,))
    browser.open(
        page(
            tmp_path,
            device_run(bad, name=HOSTILE),
            DeviceRun(None, unusable=HOSTILE, asked=HOSTILE),
        )
    )
    assert browser.complaints() == []
    assert browser.run("return document.querySelectorAll('img[src=x]').length") == 0
    assert browser.texts("h4")[0].startswith(
        "</script><script>alert(1)</script><img src=x onerror=alert(1)>\\x1b[31m\\u202e{{7*7}}"
    )


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_axe_has_nothing_to_say(browser: Browser, report: Path, dark: bool) -> None:
    browser.open(report, dark=dark)
    assert browser.violations() == []


def test_it_fits_a_phone(browser: Browser, report: Path) -> None:
    browser.open(report, width=PHONE)
    assert browser.overflow() == 0


@pytest.mark.parametrize(
    "terms", [{"media": "print"}, {"script": False}], ids=["on paper", "without scripts"]
)
def test_pictures_are_beside_each_other(
    browser: Browser, report: Path, terms: dict[str, object]
) -> None:
    browser.open(report, **terms)  # type: ignore[arg-type]
    before, after = (picture.rect for picture in browser.all(".pair img")[:2])
    assert (
        after["x"] >= before["x"] + before["width"] or after["y"] >= before["y"] + before["height"]
    )
    assert browser.all(".pair .fixed")[0].value_of_css_property("clip-path") == "none"
    assert not any(control.is_displayed() for control in browser.all("input"))


def test_several_devices_are_compared(browser: Browser, tmp_path: Path) -> None:
    other = device_run(verdict(status="confirmed", reason="", times=None), name="another")
    browser.open(page(tmp_path, device_run(verdict()), other))
    assert browser.texts("table:first-of-type")[0].splitlines()[1:] == [
        "file pass A GPU another", "frame.msaa.yaml forward disagrees, 23.9 [23.2, 26.1] ms "
            "confirmed",
    ]  # fmt: skip
    assert browser.texts(".contents a") == ["A GPU", "another"]
    assert browser.violations() == []


def test_the_command_writes_a_page_with_pictures(browser: Browser, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "examples" / "khronos-msaa", tmp_path / "a")
    done = run(
        tmp_path,
        "confirm",
        "--isolated",
        "a/stored-and-resolved.msaa.yaml",
        "--no-layer",
        "--output",
        "html=a.html",
        "--size",
        "64x32",
    )
    if "cannot open" in done.stderr or "no device" in done.stderr:
        pytest.skip("no Vulkan driver is installed")
    assert done.returncode == 0, done.stderr
    browser.open(tmp_path / "a.html")
    assert browser.complaints() == []
    assert browser.texts(".status")[0] == "confirmed"
    assert [picture.get_attribute("alt") for picture in browser.all("img")] == [
        "backbuffer as written", "backbuffer with the safe fixes", "Difference of backbuffer as "
            "written and fixed",
    ]  # fmt: skip
    assert browser.run("return [...document.images].every((image) => image.naturalWidth === 64)")


def test_findings_link_to_the_documentation(browser: Browser, tmp_path: Path) -> None:
    rules = (("MSAA001", "multisampled-attachment-stored"), ("X001", "our-rule"))
    path = tmp_path / "confirm.html"
    with path.open("w", encoding="utf-8") as file:
        render(
            [device_run(verdict(rules=rules))],
            (),
            file.write,
            Options(docs_url="https://docs.example"),
        )
    browser.open(path)
    assert browser.texts("section section p") == [
        "Findings: MSAA001 multisampled-attachment-stored, X001 our-rule"
    ]
    links = [link.get_attribute("href") for link in browser.all("section section p a")]
    assert links == ["https://docs.example/rules/multisampled-attachment-stored/"]


def test_picture_for_the_documentation(browser: Browser, report: Path, tmp_path: Path) -> None:
    folder = ROOT / "docs" / "images" if os.environ.get("UPDATE") else tmp_path
    folder.mkdir(exist_ok=True)
    browser.open(report)
    browser.picture(folder / "confirm-report.png", height=1050)
    assert 10_000 < (folder / "confirm-report.png").stat().st_size < 150_000

"""docs/cost.md and the README show what the model says: UPDATE=1 writes their tables anew, and
their figures are worked out again.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from msaa_lint.frame.cost.model import difference
from tests.frame.cost.frames import cost
from tests.frame.cost.published import CONFIGURATIONS, MB_PER_MIB, predictions
from tests.frame.cost.tables import TABLES, between, separate, stored
from tests.paths import ROOT

PAGE = ROOT / "docs" / "cost.md"
PAGES = (PAGE, ROOT / "README.md")
BLOCK = re.compile(r"(<!-- table: (\w+) -->\n)(.*?)(<!-- end -->)", re.DOTALL)


def test_every_table_is_in_a_page() -> None:
    assert sorted(
        match[2] for page in PAGES for match in BLOCK.finditer(page.read_text(encoding="utf-8"))
    ) == sorted(TABLES)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_tables_are_fresh(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    made = BLOCK.sub(lambda match: match[1] + TABLES[match[2]]() + match[4], text)
    if os.environ.get("UPDATE"):
        page.write_text(made, encoding="utf-8")
    assert page.read_text(encoding="utf-8") == made


def test_the_printed_numbers_with_their_units() -> None:
    assert stored(1, 2168, 1080).total.write_mb_per_s == 561.9456
    assert stored(4, 2168, 1080).total.write_mb_per_s == 2247.7824
    colour, _, _ = between("C", "B")
    assert colour.read_mb_per_s == pytest.approx(2247.7824)
    assert colour.write_mb_per_s == pytest.approx(2247.7824)
    assert colour.traffic_mb_per_s == pytest.approx(4495.5648)
    assert colour.milliwatts == pytest.approx(449.55648)
    worst, _, _ = between("F", "E")
    assert worst.read_mb_per_s == pytest.approx(2247.7824)
    assert worst.write_mb_per_s == pytest.approx(1685.8368 + 2247.7824)
    assert separate(1920, 1080).total.traffic_mb_per_s == pytest.approx(4478.976)
    assert separate(1920, 1080).total.traffic_mb_per_s - stored(
        1, 1920, 1080
    ).total.write_mb_per_s == pytest.approx(3981.312)
    assert separate(2560, 1440).total.traffic_mb_per_s == pytest.approx(7962.624)
    assert separate(2560, 1440).total.milliwatts == pytest.approx(796.2624)


def test_the_measured_ratios_of_four_samples() -> None:
    """1.065 and 1.053 of arithmetic for stores, 1.012 for loads."""
    colour, read, written = between("C", "B")
    assert written / (colour.write_mb_per_s / MB_PER_MIB) == pytest.approx(1.065, abs=5e-4)
    assert read / (colour.read_mb_per_s / MB_PER_MIB) == pytest.approx(1.012, abs=5e-4)
    worst, _, written = between("F", "E")
    assert written / (worst.write_mb_per_s / MB_PER_MIB) == pytest.approx(1.053, abs=5e-4)


def test_four_samples_of_depth_instead_of_one_would_be_far_off() -> None:
    text = (
        CONFIGURATIONS["F"]
        .path.read_text(encoding="utf-8")
        .replace("samples: 1}\n  - endRenderPass", "samples: ALL}\n  - endRenderPass")
    )
    more = difference(cost(text).total, CONFIGURATIONS["F"].cost().total).read_mb_per_s / MB_PER_MIB
    found = next(each for each in predictions() if (each.name, each.direction) == ("F", "read"))
    assert 100 * ((found.predicted + more) / found.measured - 1) == pytest.approx(46.5, abs=0.05)


@pytest.mark.parametrize(
    "link", re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", PAGE.read_text(encoding="utf-8"))
)
def test_links_lead_somewhere(link: str) -> None:
    assert (PAGE.parent / link).exists()

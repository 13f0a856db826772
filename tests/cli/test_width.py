"""Tables in 80 columns: no line is longer, and every number of the wide table is in the narrow one,
whole.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.command import run
from tests.paths import ROOT

EXAMPLES = sorted((ROOT / "examples").rglob("*.msaa.yaml"))
NUMBER = re.compile(r"[-+≥]*\d[\d,.]*(?:e[-+]\d+)?")
LONG = """\
frame: {width: 16384, height: 16384, fps: 1000}
images:
  NAME: {format: R32G32B32A32_SFLOAT, samples: 64, usage: [COLOR_ATTACHMENT], memory: [DEVICE_LOCAL]}
  unknown: {samples: 8, usage: [COLOR_ATTACHMENT]}
renderPasses:
  NAME:
    attachments:
      - {image: NAME, loadOp: LOAD, storeOp: STORE, initialLayout: COLOR_ATTACHMENT_OPTIMAL, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      - {image: unknown, loadOp: LOAD, storeOp: STORE, initialLayout: COLOR_ATTACHMENT_OPTIMAL, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
    subpasses:
      - {colorAttachments: [0, 1]}
"""


def tables(text: str) -> list[str]:
    """The lines of the tables: those below a heading, to the next empty line. Prose is not
    broken.
    """
    found = []
    for part in text.split("\n\n"):
        lines = part.splitlines()
        if any(re.search(r"\d\.\d", line) for line in lines) and not re.match(
            r"[a-z]+: ", lines[0]
        ):
            found += lines
    return found


def numbers(text: str) -> list[str]:
    return sorted(
        number for line in tables(text) for number in NUMBER.findall(line.replace("≥ ", "≥"))
    )


@pytest.mark.parametrize(
    "arguments", [["cost", str(path)] for path in EXAMPLES] + [["cost", *map(str, EXAMPLES[:2])]]
)
def test_tables_of_cost_fit(tmp_path: Path, arguments: list[str]) -> None:
    wide = run(tmp_path, *arguments, COLUMNS="400").stdout
    for environment in ({}, {"COLUMNS": "80"}):
        narrow = run(tmp_path, *arguments, **environment).stdout
        heads = (": 60 frames", " -> ", "This change", "frames per second")
        assert [
            line
            for line in tables(narrow)
            if len(line) > 80 and not any(head in line for head in heads)
        ] == []
        assert numbers(narrow) == numbers(wide)
        assert "…" not in narrow


@pytest.mark.parametrize("name", ["n" * 200, "a name " * 20, "Namespace::pass"])
def test_large_figures_and_long_names_of_cost_fit(tmp_path: Path, name: str) -> None:
    (tmp_path / "a.msaa.yaml").write_text(
        LONG.replace("NAME", f"'{name.strip()}'"), encoding="utf-8"
    )
    done = run(tmp_path, "cost", "a.msaa.yaml", "--profile", "mali-g76", COLUMNS="80")
    assert done.returncode == 0, done.stderr
    lines = [line for line in tables(done.stdout) if "frames per second" not in line]
    assert max(map(len, lines)) <= 80
    assert name.count("n") <= sum(line.count("n") for line in lines)
    assert "..." not in "".join(lines)


@pytest.mark.parametrize("scene", ["edge-fan", "intersecting"])
def test_tables_of_study_fit(tmp_path: Path, scene: str) -> None:
    pytest.importorskip("numpy")
    words = ["study", scene, "--size", "32x32", "--profile", "mali-g76", "--jobs", "1"]
    wide, narrow = (run(tmp_path, *words, COLUMNS=columns).stdout for columns in ("400", "80"))
    rows = [
        line
        for line in tables(narrow)
        if not line.startswith(("- ", "effect ", "no effects", "off, "))
    ]
    assert rows and max(map(len, rows)) <= 80
    wide_numbers, narrow_numbers = (set(re.findall(r"\d+\.\d+", text)) for text in (wide, narrow))
    assert "left out" not in wide and narrow_numbers < wide_numbers
    # Nothing is left out without being named.
    assert "left out at this width, but in --format json: mW, MiB" in narrow
    share = re.compile(r", \d+ % of the simulation's time")
    assert share.sub("", run(tmp_path, *words).stdout) == share.sub("", narrow)


@pytest.mark.parametrize("arguments", [["mali-g76", "portable-tiler"], ["--list"]])
def test_tables_of_device_fit(tmp_path: Path, arguments: list[str]) -> None:
    for environment in ({}, {"COLUMNS": "80"}):
        lines = run(tmp_path, "device", *arguments, **environment).stdout.splitlines()
        assert len(lines) > 10 and max(map(len, lines)) <= 80

"""`--fail-confidence`: findings of less confidence are shown and priced, and never end a run with
1.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command import run

FRAME = """\
frame: {width: 1920, height: 1080, fps: 60}
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
  out: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
renderPasses:
  main:
    attachments:
      color: {image: ms, loadOp: CLEAR, storeOp: STORE}
      output: {image: out, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output]}
"""


def page(confidence: str, severity: str = "error") -> str:
    return f"""\
---
code: OWN001
severity: {severity}
confidence: {confidence}
subject: aspect
when: attachment.samples > 1 && aspect.store == "STORE"
message: stored
at: aspect.store
fix: {{title: "storeOp: DONT_CARE", safety: safe, set: {{aspect.store: DONT_CARE}}}}
---
Ours.
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "a.msaa.yaml").write_text(FRAME, encoding="utf-8")
    for confidence in ("low", "medium", "high"):
        (tmp_path / confidence).mkdir()
        (tmp_path / confidence / "ours.md").write_text(page(confidence), encoding="utf-8")
    return tmp_path


def code(folder: Path, confidence: str, *arguments: str) -> int:
    return run(
        folder,
        "check",
        "a.msaa.yaml",
        "--isolated",
        "--select",
        "OWN001",
        "--rules",
        confidence,
        *arguments,
    ).returncode


@pytest.mark.parametrize(
    ("confidence", "asked", "failing"),
    [
        ("low", None, 0),
        ("medium", None, 1),
        ("high", None, 1),
        ("low", "low", 1),
        ("low", "medium", 0),
        ("medium", "medium", 1),
        ("medium", "high", 0),
        ("high", "high", 1),
    ],
)
def test_what_fails(folder: Path, confidence: str, asked: str | None, failing: int) -> None:
    arguments = [] if asked is None else ["--fail-confidence", asked]
    assert code(folder, confidence, *arguments) == failing
    (folder / confidence / "ours.md").write_text(page(confidence, "note"), encoding="utf-8")
    assert code(folder, confidence, *arguments) == 0, "a note fails nothing by its severity"
    assert code(folder, confidence, *arguments, "--fail-on-cost", "1GB/s") == failing
    assert code(folder, confidence, *arguments, "--fail-on-cost", "3GB/s") == 0


def test_what_others_cost_counts_alone(folder: Path) -> None:
    (folder / "low" / "depth.md").write_text(
        page("high", "note")
        .replace("OWN001", "OWN002")
        .replace("attachment.samples > 1", "attachment.samples == 1"),
        encoding="utf-8",
    )
    arguments = (
        "check",
        "a.msaa.yaml",
        "--isolated",
        "--select",
        "OWN001,OWN002",
        "--rules",
        "low",
    )
    done = run(folder, *arguments, "--fail-on-cost", "1GB/s", "--fail-on", "error")
    # Four samples at 1990.7 MB/s are not sure; one at 497.7 MB/s is.
    assert done.returncode == 0, done.stderr
    done = run(folder, *arguments, "--fail-on-cost", "400MB/s", "--fail-on", "error")
    assert done.returncode == 1
    assert (
        "a.msaa.yaml: fixes save 497.664 MB/s, which reaches --fail-on-cost 400MB/s" in done.stderr
    )
    assert "2 fixable with --fix: saves 2488 MB/s written" in done.stdout


def test_the_summary_says_how_many(folder: Path) -> None:
    arguments = ("check", "a.msaa.yaml", "--isolated", "--select", "OWN001", "--rules")
    last = "Found 1 finding (1 error) in 1 file (1 description: 2 images, 1 pass)"
    assert (
        f"{last}; 1 of low confidence, below --fail-confidence\n"
        in run(folder, *arguments, "low").stdout
    )
    assert f"{last}\n" in run(folder, *arguments, "medium").stdout
    done = run(folder, *arguments, "medium", "--fail-confidence", "high", "--output", "markdown")
    assert "1 of low or medium confidence, below" in done.stdout
    assert f"{last}\n" in run(folder, *arguments, "low", "--fail-confidence", "low").stdout


def test_machines_are_told_the_confidence_as_before(folder: Path) -> None:
    done = run(
        folder,
        "check",
        "a.msaa.yaml",
        "--isolated",
        "--select",
        "OWN001",
        "--rules",
        "low",
        "--output",
        "json",
    )
    (found,) = json.loads(done.stdout)["findings"]
    assert (found["severity"], found["confidence"]) == ("error", "low")


def test_a_test_report_has_no_failure_of_them(folder: Path) -> None:
    arguments = (
        "check",
        "a.msaa.yaml",
        "--isolated",
        "--select",
        "OWN001",
        "--output",
        "junit",
        "--rules",
        "low",
    )
    done = run(folder, *arguments)
    assert 'tests="1" failures="0" errors="0"' in done.stdout
    assert (
        "<system-out>line 8, column 50, stored (+1991 MB/s written, +199 mW on a tile-based "
        "GPU)</system-out>" in done.stdout
    )
    assert (
        'tests="1" failures="1" errors="0"'
        in run(folder, *arguments, "--fail-confidence", "low").stdout
    )


def test_what_cannot_be_used_fails_all_the_same(folder: Path) -> None:
    (folder / "a.msaa.yaml").write_text("images: 3\n", encoding="utf-8")
    assert code(folder, "low", "--fail-confidence", "high") == 2


def test_words_that_are_no_confidence(folder: Path) -> None:
    assert code(folder, "low", "--fail-confidence", "certain") == 2
    (folder / "msaa-lint.toml").write_text('fail-confidence = "hihg"\n', encoding="utf-8")
    done = run(folder, "check", "a.msaa.yaml", "--output", "full")
    assert done.returncode == 2
    assert (
        "unknown value `hihg` in `fail-confidence` of msaa-lint.toml: did you mean `high`?"
        in done.stdout
    )


def test_the_configuration_says_it_and_the_command_line_goes_before_it(folder: Path) -> None:
    (folder / "msaa-lint.toml").write_text(
        'fail-confidence = "low"\nrules = ["low"]\nselect = ["OWN001"]\n', encoding="utf-8"
    )
    assert run(folder, "check", "a.msaa.yaml").returncode == 1
    assert run(folder, "check", "a.msaa.yaml", "--fail-confidence", "medium").returncode == 0

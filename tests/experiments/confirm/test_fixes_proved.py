"""Every safe fix of every example of the rule pages, and of examples/, drawn on lavapipe before and
after: none changes a picture.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from msaa_lint.experiments.confirm.inputs import Input, inputs
from msaa_lint.experiments.confirm.outcome import CONFIRMED, DISAGREES, REFUSED, DeviceRun
from msaa_lint.experiments.confirm.session import Session, environment
from msaa_lint.experiments.confirm.trial import TrialOptions, trial
from msaa_lint.linter.request import Request
from tests.pages import all_examples
from tests.paths import ROOT


def ran(found: list[Input]) -> DeviceRun:
    with Session(None, environment=environment(None)) as session:
        made = trial(session, lambda: found, TrialOptions(time=False))
    assert not made.unusable, made.unusable
    return made


@pytest.fixture(scope="module")
def every(tmp_path_factory: pytest.TempPathFactory) -> DeviceRun:
    """All documents that a safe fix changes, in one child process."""
    folder = tmp_path_factory.mktemp("pages")
    for example in all_examples():
        (folder / f"{example}.msaa.yaml").write_text(example.text)
    found = inputs(Request(paths=[str(folder), str(ROOT / "examples")], isolated=True))
    return ran([each for each in found.inputs if each.fixed is not None])


def test_no_safe_fix_changes_a_pixel(every: DeviceRun) -> None:
    assert [(v.file, v.name, v.reason) for v in every.verdicts if v.pixels_equal is False] == []
    assert sum(v.pixels_equal is True for v in every.verdicts) >= 20


def test_no_safe_fix_keeps_a_pass_from_being_created(every: DeviceRun) -> None:
    assert [
        (v.file, v.name, v.status, v.reason)
        for v in every.verdicts
        if v.status not in (CONFIRMED, REFUSED)
    ] == []


def test_what_is_not_compared_says_why(every: DeviceRun) -> None:
    untold = [v for v in every.verdicts if v.status == CONFIRMED and v.pixels_equal is None]
    assert [
        (v.file, v.name, v.notes) for v in untold if not any("compare" in note for note in v.notes)
    ] == []


COMPARED = """\
images:
  color_ms: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}}
  color: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED]}}
commands:
  - beginRendering:
      colorAttachments:
        - {attachment}
  - endRendering
"""


RESOLVED = (
    "{image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: AVERAGE, "
    "resolveImage: color}"
)


def test_a_fix_that_changes_a_pixel_is_found(tmp_path: Path) -> None:
    """Should a fix draw with one sample where there were four, edges tell."""
    (tmp_path / "a.msaa.yaml").write_text(COMPARED.format(attachment=RESOLVED))
    (tmp_path / "b.msaa.yaml").write_text(
        COMPARED.format(attachment="{image: color, loadOp: CLEAR, storeOp: STORE}")
    )
    average, single = inputs(Request(paths=[str(tmp_path)], isolated=True)).inputs
    (spoilt,) = ran([average._replace(fixed=single.frame)]).verdicts
    assert (spoilt.status, spoilt.pixels_equal) == (DISAGREES, False)
    assert spoilt.reason.startswith("a fix that is marked safe changes the picture: color: ")
    (same,) = ran([average._replace(fixed=average.frame)]).verdicts
    assert (same.status, same.pixels_equal) == (CONFIRMED, True)

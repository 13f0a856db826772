"""Inputs through a trial with a driver that does as it is told: statuses, pictures, times, and what
is said of them.
"""

from __future__ import annotations

import io
import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from msaa_lint.cli.report import Options
from msaa_lint.cli.report.confirm_full import render as as_text
from msaa_lint.cli.report.confirm_json import render as as_json
from msaa_lint.experiments.confirm.child import Limits
from msaa_lint.experiments.confirm.frame_results import FrameRun
from msaa_lint.experiments.confirm.inputs import Input, inputs
from msaa_lint.experiments.confirm.outcome import AgreementRow, DeviceRun, exit_code
from msaa_lint.experiments.confirm.parts import Pass
from msaa_lint.experiments.confirm.planner import PlannedFrame
from msaa_lint.experiments.confirm.session import Session
from msaa_lint.experiments.confirm.trial import TrialOptions, trial
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.linter.request import Request
from tests.paths import ROOT

SCHEMA = json.loads((ROOT / "msaa_lint" / "cli" / "report" / "confirm_v1.schema.json").read_text())

FRAME = """\
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [DEVICE_LOCAL, LAZILY_ALLOCATED]}
  color: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED], memory: [DEVICE_LOCAL]}
renderPasses:
"""
PASS = """\
  NAME:
    attachments:
      color_ms: {image: color_ms, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      color: {image: color, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}
    subpasses:
      - {colorAttachments: [color_ms], resolveAttachments: [color]}
"""


class Fake:
    """Plans whose passes do what their names say: `draws`, `SIGSEGV`, `refuses`; as fixed what
    `fixed` says of them.
    """

    def __init__(
        self,
        fixed: Mapping[str, str] | None = None,
        gated: Sequence[str] = (),
        pixel: int = 0,
        said: Sequence[AgreementRow] = (),
    ) -> None:
        self.fixed = dict(fixed or {})
        self.gated = gated
        self.pixel = pixel
        self.rows = tuple(said)
        self.planned = 0

    def plan(
        self, frame: Frame, file: str, size: tuple[int, int] | None, samples: int | None
    ) -> PlannedFrame:
        written = any(
            a.store == "STORE" for p in frame.passes for t in p.attachments[:1] for a in t.aspects
        )
        deeds = [
            each.name if written else self.fixed.get(each.name, each.name) for each in frame.passes
        ]
        data = {"passes": deeds, "pixel": 0 if written else self.pixel}
        return PlannedFrame(
            data,
            [Pass(each.name, each.path, "", 0) for each in frame.passes],
            ["256 x 256 pixels are taken"],
        )

    def supported(self, planned: PlannedFrame, device: Mapping[str, Any]) -> PlannedFrame:
        return planned

    def gate(self, planned: PlannedFrame, device: Mapping[str, Any]) -> dict[int, str]:
        return {
            n: "8 samples are not offered"
            for n, each in enumerate(planned.passes)
            if each.name in self.gated
        }

    def deviations(
        self, session: Session, planned: PlannedFrame, device: Mapping[str, Any], color: bool
    ) -> dict[int, list[str]]:
        return {}

    def agreement(
        self, source: Input, planned: PlannedFrame, run: FrameRun, session: Session
    ) -> dict[int, tuple[AgreementRow, ...]]:
        return dict.fromkeys(run.passes, self.rows)


def tried(
    folder: Path,
    *passes: str,
    terms: TrialOptions | None = None,
    device: str | None = None,
    seconds: float = 20,
    **fake: Any,
) -> DeviceRun:
    (folder / "frame.msaa.yaml").write_text(
        FRAME + "".join(PASS.replace("NAME", name) for name in passes)
    )
    found = inputs(Request(paths=[str(folder / "frame.msaa.yaml")], isolated=True))
    assert not found.wrong
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with Session(
        device,
        limits=Limits(seconds),
        environment=environment,
        execute="tests.experiments.confirm.fake",
    ) as session:
        return trial(session, lambda: found.inputs, terms or TrialOptions(), Fake(**fake))


def shown(run: DeviceRun) -> tuple[dict[str, Any], str]:
    """Both reports of a run; the JSON is valid."""
    printed, text = io.StringIO(), io.StringIO()
    as_json([run], [], printed.write, Options(version="1.2.3"))
    data = json.loads(printed.getvalue())
    jsonschema.Draft202012Validator(SCHEMA).validate(data)
    as_text([run], [], text.write, Options(width=200))
    return data, text.getvalue()


def test_pass_that_draws_the_same_as_fixed_is_confirmed(tmp_path: Path) -> None:
    run = tried(
        tmp_path,
        "draws",
        said=[AgreementRow("both", "X-store", "store", "multisampled-attachment-stored", "stored")],
    )
    data, text = shown(run)
    (found,) = data["passes"]
    assert (found["status"], found["created"], found["agrees"], found["pixels_equal"]) == (
        "confirmed",
        True,
        True,
        True,
    )
    assert found["findings"] == ["MSAA201"] or "multisampled-attachment-stored" in text
    assert found["messages"][0]["rule"] == "multisampled-attachment-stored"
    assert data["agreement"] == {"both": 1, "ours": 0, "theirs": 0, "explained": 0, "noise": 0}
    assert found["time_ms"] is None and "unless --time" in data["notes"][0]
    assert (
        "draws" in text
        and "confirmed" in text
        and "1 both" in text
        and "1 pass: 1 confirmed" in text
    )
    assert exit_code([run], False) == 0


def test_safe_fix_that_changes_a_pixel_disagrees(tmp_path: Path) -> None:
    run = tried(tmp_path, "draws", pixel=3)
    (found,) = shown(run)[0]["passes"]
    assert (found["status"], found["pixels_equal"]) == ("disagrees", False)
    assert found["reason"] == (
        "a fix that is marked safe changes the picture: color: 1 of 4 pixels differ, the first at "
        "(0, 0), by at most 3 steps"
    )
    assert exit_code([run], False) == 1


def test_layer_alone_disagrees(tmp_path: Path) -> None:
    said = [
        AgreementRow("theirs", "VUID-1", text="do\x1b not"),
        AgreementRow("explained", "VUID-2", reason="a bug of theirs"),
    ]
    run = tried(tmp_path, "draws", said=said)
    data, text = shown(run)
    (found,) = data["passes"]
    assert (found["status"], found["agrees"], found["reason"]) == (
        "disagrees",
        False,
        "the layer reports what no rule does: VUID-1",
    )
    assert (
        "only the layer: VUID-1: do\\x1b not" in text
        and "explained: VUID-2 (a bug of theirs)" in text
    )
    assert exit_code([run], False) == 1


def test_failed_creation_without_an_error_of_ours_disagrees(tmp_path: Path) -> None:
    (found,) = shown(tried(tmp_path, "refuses"))[0]["passes"]
    assert (found["status"], found["created"]) == ("disagrees", False)
    assert found["reason"].startswith(
        "it cannot be created (VK_ERROR_UNKNOWN), but no rule reports an error"
    )


def test_death_is_of_its_pass_and_the_next_is_confirmed(tmp_path: Path) -> None:
    run = tried(tmp_path, "SIGSEGV", "draws")
    data, text = shown(run)
    assert [(each["name"], each["status"]) for each in data["passes"]] == [
        ("SIGSEGV", "driver-died"),
        ("draws", "confirmed"),
    ]
    assert data["passes"][0]["reason"] == "SIGSEGV"
    assert data["passes"][1]["notes"] == [
        "the pictures are not compared: not every pass went through"
    ]
    assert "driver-died" in text
    assert exit_code([run], False) == 1


def test_fixed_version_that_kills_the_driver_is_told(tmp_path: Path) -> None:
    (found,) = shown(tried(tmp_path, "draws", fixed={"draws": "SIGABRT"}))[0]["passes"]
    assert (found["status"], found["reason"]) == ("driver-died", "the fixed version: SIGABRT")


def test_pass_that_takes_too_long(tmp_path: Path) -> None:
    run = tried(tmp_path, "sleeps", "draws", seconds=1)
    assert [each.status for each in run.verdicts] == ["timed-out", "confirmed"]
    assert exit_code([run], False) == 1


def test_gate_refuses_and_the_rest_goes_on(tmp_path: Path) -> None:
    run = tried(tmp_path, "SIGSEGV", "draws", gated=["SIGSEGV"])
    data, _ = shown(run)
    assert [(each["status"], each["reason"]) for each in data["passes"]] == [
        ("refused", "8 samples are not offered"),
        ("confirmed", ""),
    ]
    assert data["passes"][0]["created"] is None
    assert exit_code([run], False) == 0


def test_gate_can_be_switched_off(tmp_path: Path) -> None:
    run = tried(tmp_path, "SIGSEGV", gated=["SIGSEGV"], terms=TrialOptions(gate=False))
    assert run.verdicts[0].status == "driver-died"
    assert "the gate is off" in " ".join(run.notes)


def test_times_of_both_versions_with_the_model_beside_them(tmp_path: Path) -> None:
    run = tried(tmp_path, "draws", terms=TrialOptions(time=True, repeats=12))
    data, text = shown(run)
    time = data["passes"][0]["time_ms"]
    assert (time["as_written"]["n"], time["fixed"]["n"], time["as_written"]["source"]) == (
        12,
        12,
        "timestamp",
    )
    assert (
        time["difference"]["says"]
        == "no difference: less than 10 % is not significant on a software driver"
    )
    assert data["cannot_show"].startswith("a software driver has neither tiles nor external memory")
    assert data["passes"][0]["model"]["as_written"].keys() == {
        "read_mb_per_s",
        "write_mb_per_s",
        "memory_mib",
        "milliwatts",
    }
    assert "What this device cannot show" in text and "cost model, MB/s" in text


def test_pictures_are_written(tmp_path: Path) -> None:
    run = tried(tmp_path, "draws", terms=TrialOptions(image=str(tmp_path / "pictures")))
    names = [Path(path).name for path in run.verdicts[0].pictures]
    assert [name.rpartition("-")[2] for name in names] == [
        "written.png",
        "fixed.png",
        "difference.png",
        "edge.png",
    ]
    assert sorted(path.name for path in (tmp_path / "pictures").iterdir()) == sorted(names)


def test_device_that_dies_at_once_cannot_be_used(tmp_path: Path) -> None:
    run = tried(tmp_path, "draws", device="dies")
    data, text = shown(run)
    assert data["device"] is None and data["unusable"] == "cannot open the driver: SIGSEGV"
    assert text == "dies: cannot be used: cannot open the driver: SIGSEGV\n"
    assert exit_code([run], False) == 2


def test_several_devices_stand_side_by_side(tmp_path: Path) -> None:
    runs = [tried(tmp_path, "draws", device=name) for name in ("one", "other")]
    printed, text = io.StringIO(), io.StringIO()
    as_json(runs, [], printed.write, Options())
    data = json.loads(printed.getvalue())
    jsonschema.Draft202012Validator(SCHEMA).validate(data)
    assert [each["device"]["name"] for each in data["devices"]] == ["one", "other"]
    as_text(runs, [], text.write, Options(width=200))
    lines = text.getvalue().splitlines()
    assert lines[0].split() == ["file", "pass", "one", "other"] and lines[1].split()[-2:] == [
        "confirmed",
        "confirmed",
    ]


@pytest.mark.parametrize("name", ["\x1b[2J", "a\u202eb", "[bold]x[/bold]"])
def test_names_of_a_device_are_escaped(tmp_path: Path, name: str) -> None:
    _, text = shown(tried(tmp_path, "draws", device=name))
    assert "\x1b" not in text and "\u202e" not in text
    assert name in text or "\\" in text

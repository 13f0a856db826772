"""Every example of every rule page, and examples/, run on lavapipe under the validation layer: what
it says against what we find.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from msaa_lint.experiments.confirm.agreement import SILENT
from msaa_lint.experiments.confirm.families import FAMILIES
from msaa_lint.experiments.confirm.inputs import Input, inputs
from msaa_lint.experiments.confirm.outcome import (
    CONFIRMED,
    DIED,
    REFUSED,
    SKIPPED,
    TIMED_OUT,
    AgreementRow,
    DeviceRun,
    Verdict,
)
from msaa_lint.experiments.confirm.planner import Planner
from msaa_lint.experiments.confirm.session import Session, environment
from msaa_lint.experiments.confirm.trial import TrialOptions, trial
from msaa_lint.frame.description.models import RenderPass, Subpass
from msaa_lint.frame.facts.parts import Pass
from msaa_lint.linter.request import Request
from tests.pages import all_examples
from tests.paths import ROOT

VENDORS = ("amd", "arm", "img", "nvidia")


def documents(tmp_path_factory: pytest.TempPathFactory) -> list[Input]:
    folder = tmp_path_factory.mktemp("pages")
    for example in all_examples():
        (folder / f"{example}.msaa.yaml").write_text(example.text)
    found = inputs(Request(paths=[str(folder), str(ROOT / "examples")], isolated=True))
    assert not found.wrong
    return [each._replace(fixed=None, mended=()) for each in found.inputs]


def tried(found: list[Input], gate: bool = True, api: int | None = None) -> DeviceRun:
    """Documents in one child process, as written."""
    with Session(None, vendors=VENDORS, environment=environment(None)) as session:
        made = trial(session, lambda: found, TrialOptions(time=False, gate=gate), Planner(api))
    assert not made.unusable, made.unusable
    assert made.layer is not None, (
        "the validation layer is missing: apt install vulkan-validationlayers"
    )
    return made


@pytest.fixture(scope="module")
def every(tmp_path_factory: pytest.TempPathFactory) -> list[Input]:
    return documents(tmp_path_factory)


@pytest.fixture(scope="module")
def ran(every: list[Input]) -> DeviceRun:
    return tried(every)


@pytest.fixture(scope="module")
def ungated(every: list[Input], ran: DeviceRun) -> DeviceRun:
    """What the gate refuses, tried all the same: the driver does what it likes, the layer says what
    it says.
    """
    refused = {verdict.file for verdict in ran.verdicts if verdict.status == REFUSED}
    return tried([each for each in every if each.file in refused], gate=False)


@pytest.fixture(scope="module")
def first(every: list[Input]) -> DeviceRun:
    """Render passes created by the first version of the structure, where that can say what they
    are.
    """
    able = [
        each for each in every if all(map(_first_version, each.frame.passes)) and each.frame.passes
    ]
    return tried(able, api=1)


def _first_version(each: Pass) -> bool:
    subpasses = [subpass for subpass in each.subpasses if isinstance(subpass.record, Subpass)]
    second = any(
        s.record.depthStencilResolve or s.single_sampled or s.record.viewMask for s in subpasses
    )  # type: ignore[union-attr]
    second = second or any(
        getattr(attachment.record, "stencilInitialLayout", None) for attachment in each.attachments
    )
    return bool(subpasses) and not second and isinstance(each.record, RenderPass)


def said(ran: DeviceRun) -> list[tuple[Verdict, AgreementRow]]:
    return [(verdict, each) for verdict in ran.verdicts for each in verdict.agreement]


def names(rows: list[tuple[Verdict, AgreementRow]]) -> list[str]:
    return [
        f"{Path(v.file).name}: {v.name}: {each.id or each.rule}: {each.text} {each.reason}"
        for v, each in rows
    ]


def test_the_layer_says_nothing_that_we_neither_find_nor_explain(ran: DeviceRun) -> None:
    assert names([row for row in said(ran) if row[1].verdict == "theirs"]) == []


def test_the_layer_is_silent_only_where_it_does_not_look(ran: DeviceRun) -> None:
    assert names([row for row in said(ran) if row[1].reason.startswith(SILENT)]) == []


def test_everything_that_is_not_both_has_a_reason(ran: DeviceRun) -> None:
    assert names([row for row in said(ran) if row[1].verdict != "both" and not row[1].reason]) == []
    assert len(said(ran)) > 500


def test_render_passes_of_the_first_version_agree_as_well(first: DeviceRun) -> None:
    rows = [
        row for row in said(first) if row[1].verdict == "theirs" or row[1].reason.startswith(SILENT)
    ]
    assert names(rows) == []
    assert len(first.verdicts) > 100


def test_without_the_gate_a_driver_that_dies_is_told_with_its_signal(ungated: DeviceRun) -> None:
    dead = [verdict.reason for verdict in ungated.verdicts if verdict.status == DIED]
    assert dead
    assert [reason for reason in dead if not reason.startswith("SIG")] == []
    assert sum(verdict.created is True for verdict in ungated.verdicts) >= 20


def test_no_pass_kills_or_stalls_the_driver(ran: DeviceRun) -> None:
    assert [
        (verdict.file, verdict.name, verdict.reason)
        for verdict in ran.verdicts
        if verdict.status in (DIED, TIMED_OUT)
    ] == []


UNHEARD = {
    "lazy-memory": "lavapipe has no lazily allocated memory",
    "should-be-transient": "lavapipe has no lazily allocated memory",
    "non-lazy-transient-image": "lavapipe has no lazily allocated memory",
    "depth-resolve-structure": "confirm enables depth-stencil resolve wherever it is there",
    "storage-image-multisample-feature": "confirm enables shaderStorageImageMultisample wherever "
    "it is there",
    "resolve-target-uses": "the layer does not look at what a resolve writes",
    "framebuffer-size": "confirm clips framebuffers and render areas to their images",
    "resolve-mode-none": "the layer says it since 1.3.278",
    "alpha-to-coverage-output": "the shader that confirm draws with writes alpha",
}
"""Families that nothing of ours can make lavapipe and this version of the layer say, and why."""


def test_every_family_is_heard_from_or_it_is_known_why_not(
    ran: DeviceRun, ungated: DeviceRun, first: DeviceRun
) -> None:
    heard = {
        each.family
        for run in (ran, ungated, first)
        for _, each in said(run)
        if each.family and each.verdict != "ours"
    }
    assert {family.name for family in FAMILIES} - heard == set(UNHEARD)


def test_most_passes_run_and_what_is_refused_says_why(ran: DeviceRun) -> None:
    statuses = [verdict.status for verdict in ran.verdicts]
    assert statuses.count(CONFIRMED) > 200
    assert [
        verdict.file
        for verdict in ran.verdicts
        if verdict.status in (REFUSED, SKIPPED) and not verdict.reason
    ] == []

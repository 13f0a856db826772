"""Planned changes, and changes applied to records and taken back."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.linter.fixes.changes import Change, NoFix, StructuralChange, apply_temporarily
from msaa_lint.linter.fixes.context import FixContext
from msaa_lint.linter.fixes.planning import plan
from msaa_lint.linter.rules.rule import FixSpec, Setting
from tests.linter.fixes.linting import lint, meaning

TEXT = """\
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT], memory: [DEVICE_LOCAL]}
  ms2: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
  out: {format: R8G8B8A8_UNORM, samples: 1, presentable: true}
renderPasses:
  main:
    attachments:
      color: {samples: 4, loadOp: CLEAR, storeOp: STORE}
      output: {loadOp: LOAD, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output]}
framebuffers:
  even: {renderPass: main, attachments: [ms, out]}
  odd: {renderPass: main, attachments: [ms2, out]}
commands:
  - beginRenderPass: {renderPass: main, framebuffer: [even, odd]}
  - endRenderPass
  - present: {image: out}
"""
LINTED = lint(TEXT)
(JUDGED,) = LINTED.documents
DOCUMENT = JUDGED.document


def planned(spec: FixSpec, kind: str, path: str) -> Any:
    """The changes of a fix, or the reason why there are none."""
    from msaa_lint.frame.facts.subjects import subjects

    subject = next(each for each in subjects(DOCUMENT) if (each.kind, each.path) == (kind, path))
    try:
        changes = plan(spec, subject, FixContext(DOCUMENT))
    except NoFix as error:
        return str(error)
    return [(change.record.path, change.member, change.action, change.value) for change in changes]


def spec(action: str, fact: str, value: Any) -> FixSpec:
    from msaa_lint.core.text.span import Span

    return FixSpec("", "safe", **{action: (Setting(fact, value, Span(0, 0)),)})


COLOR = "renderPasses.main.attachments.color"


@pytest.mark.parametrize(
    ("action", "fact", "value", "kind", "path", "expected"),
    [
        (
            "set",
            "aspect.store",
            "DONT_CARE",
            "aspect",
            COLOR,
            [(COLOR, "storeOp", "set", "DONT_CARE")],
        ),
        ("set", "aspect.store", "STORE", "aspect", COLOR, "the description already states this"),
        (
            "add",
            "image.usage",
            "SAMPLED",
            "image",
            "images.ms",
            [("images.ms", "usage", "add", "SAMPLED")],
        ),
        (
            "remove",
            "image.usage",
            "SAMPLED",
            "image",
            "images.ms",
            "the description already states this",
        ),
        (
            "remove",
            "image.memory",
            "DEVICE_LOCAL",
            "image",
            "images.ms2",
            "the description already states this",
        ),
        # Of images that alternate all are changed.
        (
            "add",
            "image.usage",
            "SAMPLED",
            "attachment",
            COLOR,
            [("images.ms", "usage", "add", "SAMPLED"), ("images.ms2", "usage", "add", "SAMPLED")],
        ),
        # A count is changed wherever it is stated.
        (
            "set",
            "image.samples",
            2,
            "image",
            "images.ms",
            [("images.ms", "samples", "set", 2), (COLOR, "samples", "set", 2)],
        ),
        (
            "set",
            "image.samples",
            "{image.samples}",
            "image",
            "images.ms",
            "the description already states this",
        ),
        (
            "add",
            "image.usage",
            "{image.flags}",
            "image",
            "images.ms",
            "the description already states this",
        ),
        (
            "add",
            "image.usage",
            "{image.encoding}",
            "image",
            "images.ms",
            "the value of image.encoding is not known",
        ),
        (
            "set",
            "attachment.final_layout",
            "GENERAL",
            "attachment",
            COLOR,
            [(COLOR, "finalLayout", "set", "GENERAL")],
        ),
        (
            "set",
            "resolve.mode",
            "MIN",
            "resolve",
            "renderPasses.main.subpasses[0].resolveAttachments[0]",
            "Vulkan prescribes the mode of this resolve",
        ),
    ],
)
def test_plan_changes_the_members_that_state_a_fact(
    action: str, fact: str, value: Any, kind: str, path: str, expected: Any
) -> None:
    assert planned(spec(action, fact, value), kind, path) == expected


@given(st.lists(st.sampled_from(["set", "unset", "add", "remove"]), max_size=6), st.booleans())
def test_apply_temporarily_restores_values(actions: list[str], fails: bool) -> None:
    image = DOCUMENT.description.images["ms"]
    before = meaning(LINTED)
    changes = [
        Change(image, "usage", action, "SAMPLED")
        if action in ("add", "remove")
        else Change(image, "samples", action, 8)
        for action in actions
    ]
    try:
        with apply_temporarily(changes):
            if actions and actions[-1] == "set":
                assert image.samples == 8
            if fails:
                raise KeyError
    except KeyError:
        pass
    assert meaning(LINTED) == before


def test_apply_temporarily_rejects_structural_changes() -> None:
    before = meaning(LINTED)
    image = DOCUMENT.description.images["ms"]
    with (
        pytest.raises(StructuralChange),
        apply_temporarily(
            [
                Change(image, "samples", "set", 8),
                Change(DOCUMENT.description, "commands", "drop", 0),
            ]
        ),
    ):
        pass
    assert meaning(LINTED) == before

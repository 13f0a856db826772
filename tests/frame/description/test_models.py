"""The pydantic models and the binder accept and refuse the same inputs, and read them to the same
values.
"""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pydantic import BaseModel, ValidationError

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.models import AttachmentReference
from msaa_lint.frame.description.problems import Problem
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.scalars import ATTACHMENT_UNUSED, UNUSED
from tests.frame.description.shapes import JUNK, MODELS, RECORDS, Json, paths, replaced, structure

SLOTS = {
    "DepthStencilResolve": {"attachment"},
    "RenderPass": {"fragmentDensityMapAttachment"},
    "Subpass": {"depthStencilAttachment", "fragmentShadingRateAttachment"},
}
"""Members that refer to an attachment, which null leaves unused."""

UNHURRIED = [HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much]
SOME = settings(max_examples=100, deadline=None, suppress_health_check=UNHURRIED)
MANY = settings(max_examples=300, deadline=None, suppress_health_check=UNHURRIED)


def bound(value: Json, kind: str) -> tuple[Any, list[Problem]]:
    """What the binder reads of a structure that is written as JSON."""
    parsed = parse(Source("given.json", json.dumps(value)), Limits())
    assert not parsed.problems, parsed.problems
    binder = Binder()
    return binder.record(RECORDS[kind], parsed.documents[0], "", ""), binder.problems


def accepted(value: Json, kind: str) -> BaseModel | None:
    try:
        return MODELS[kind].model_validate(value)
    except ValidationError:
        return None


def plain(value: Any, name: str = "") -> Any:
    """What a model or a record holds, in one form: an attachment slot that says nothing but which
    is that alone.
    """
    if isinstance(value, AttachmentReference) or type(value).__name__ == "AttachmentReference":
        return reference(plain(value.attachment), value.layout)
    if type(value).__name__ in ("Command", "MetalCommand"):
        return command(value)
    if isinstance(value, BaseModel):
        return members(value, list(type(value).model_fields))
    if isinstance(value, Record):
        return members(value, list(value.SHAPE))
    if isinstance(value, dict):
        if name == "attachments":
            return [plain(inner) for inner in value.values()]
        return {str(key): plain(inner) for key, inner in value.items()}
    if isinstance(value, (tuple, list)):
        return [plain(inner) for inner in value]
    return value


def members(value: Any, names: list[str]) -> dict[str, Any]:
    slots = ("inputAttachments", "colorAttachments", "resolveAttachments", "preserveAttachments")
    out: dict[str, Any] = {}
    for name in names:
        held = plain(getattr(value, name), name)
        if type(value).__name__ == "Subpass" and name in slots:
            held = [slot(each) for each in held]
        elif name in SLOTS.get(type(value).__name__, ()):
            held = slot(held)
        out[name] = held
    if type(value).__name__ == "DepthStencilResolve" and out["attachment"] is not None:
        # A record's reference has the layout that is stated beside it.
        out["attachment"]["layout"] = out["attachment"]["layout"] or out["layout"]
    return out


def slot(held: Any) -> Any:
    return held if isinstance(held, dict) else reference(held, None)


def reference(attachment: Any, layout: str | None) -> dict[str, Any]:
    unused = attachment == ATTACHMENT_UNUSED or attachment in UNUSED
    return {"attachment": None if unused else attachment, "layout": layout}


def command(value: Any) -> Any:
    if isinstance(value, Record):
        body = plain(value.body)  # type: ignore[attr-defined]
        return (value.kind, {} if body is None else body)  # type: ignore[attr-defined]
    (kind,) = value.model_fields_set
    body = plain(getattr(value, kind))
    return (kind, {} if body is None else body)


def bare_commands(held: Any) -> Any:
    """A model holds a bare word where a record holds the command."""
    if isinstance(held, dict) and isinstance(held.get("commands"), list):
        held["commands"] = [
            (each, {}) if isinstance(each, str) else each for each in held["commands"]
        ]
    return held


def test_every_model_has_the_members_of_its_record() -> None:
    assert set(MODELS) >= {
        "Description",
        "RenderPass",
        "Command",
        "Metal",
        "MetalCommand",
        "RenderTarget",
    }
    for name, model in MODELS.items():
        assert list(model.model_fields) == list(RECORDS[name].SHAPE)


@SOME
@given(structure("Description"))
def test_what_the_models_accept_the_binder_reads_to_the_same(value: Json) -> None:
    model = accepted(value, "Description")
    assert model is not None
    record, problems = bound(value, "Description")
    assert problems == []
    assert plain(record) == bare_commands(plain(model))


@MANY
@given(data=st.data())
def test_every_structure_is_read_to_the_same(data: st.DataObject) -> None:
    name = data.draw(
        st.sampled_from(sorted(set(RECORDS) - {"Description", "Command", "MetalCommand"}))
    )
    value = data.draw(structure(name))
    model = accepted(value, name)
    assert model is not None
    record, problems = bound(value, name)
    assert problems == []
    assert plain(record) == plain(model)


@MANY
@given(data=st.data())
def test_mutated_structures_are_refused_by_both_or_by_neither(data: st.DataObject) -> None:
    name = data.draw(st.sampled_from(sorted(set(RECORDS) - {"Command", "MetalCommand"})))
    value = data.draw(structure(name))
    where = data.draw(st.sampled_from(paths(value)))
    found: Json = value
    for key in where:
        found = found[key]
    if isinstance(found, dict) and data.draw(st.booleans()):
        # A key that the structure may have, or may not.
        where = (
            *where,
            data.draw(
                st.sampled_from(
                    [
                        "x",
                        "image",
                        "samples",
                        "format",
                        "attachment",
                        "commands",
                        "flags",
                        "storeOp",
                    ]
                )
            ),
        )
    mutated = replaced(value, where, data.draw(JUNK))
    if not isinstance(mutated, dict):
        return
    model = accepted(mutated, name)
    _, problems = bound(mutated, name)
    assert (model is not None) == (problems == []), problems
    assert {problem.code for problem in problems} <= {"MSAA902", "MSAA903"}


NULLABLE = {
    "AttachmentReference": {"attachment"},
    "Command": {"nextSubpass", "endRenderPass", "endRendering"},
    **SLOTS,
}
"""Members for which null says something: an unused attachment, no parameters."""


@pytest.mark.parametrize("name", sorted(RECORDS))
def test_null_is_no_value(name: str) -> None:
    for key in MODELS[name].model_fields:
        allowed = key in NULLABLE.get(name, ())
        assert (accepted({key: None}, name) is not None) == allowed, key
        if name not in ("Command", "MetalCommand"):
            _, problems = bound({key: None}, name)
            assert [problem.code for problem in problems] == ([] if allowed else ["MSAA903"]), key


@pytest.mark.parametrize(
    ("value", "fine"),
    [
        ({"framebuffers": {"f": {"attachments": ["a", None]}}}, True),
        ({"renderPasses": {"r": {"subpasses": [{"colorAttachments": [None, 0]}]}}}, True),
        ({"renderPasses": {"r": {"subpasses": [None]}}}, False),
        ({"renderPasses": {"r": {"attachments": [None]}}}, False),
        ({"renderPasses": {"r": {"attachments": {"a": None}}}}, False),
        ({"pipelines": {"p": {"rendering": {"colorAttachmentFormats": [None]}}}}, True),
        ({"pipelines": {"p": {"multisampleState": {"sampleMask": [None]}}}}, False),
        ({"images": {"i": {"usage": [None]}}}, False),
        ({"images": None}, False),
        ({"commands": None}, False),
        ({"commands": [None]}, False),
        ({"commands": [{}]}, False),
        ({"commands": [{"nextSubpass": None}]}, True),
        ({"commands": [{"draw": None}]}, False),
        ({"commands": ["draw"]}, False),
        ({"commands": ["endRenderPass"]}, True),
        ({"commands": [{"endRenderPass": {}, "nextSubpass": {}}]}, False),
        ({"commands": [{"beginRendering": {"colorAttachments": [None]}}]}, True),
        ({"commands": [{"pipelineBarrier": {"images": [None]}}]}, False),
        ({"commands": [{"beginRenderPass": {"framebuffer": [None]}}]}, False),
    ],
)
def test_null_in_lists(value: Json, fine: bool) -> None:
    assert (accepted(value, "Description") is not None) == fine
    assert (bound(value, "Description")[1] == []) == fine


def test_a_model_is_made_of_what_a_program_hands_in() -> None:
    made: Any = MODELS["Description"].model_validate(
        {
            "images": {
                "a": {"samples": "VK_SAMPLE_COUNT_4_BIT", "usage": "SAMPLED | COLOR_ATTACHMENT"}
            }
        }
    )
    assert (made.images["a"].samples, made.images["a"].usage) == (
        4,
        ("SAMPLED", "COLOR_ATTACHMENT"),
    )

"""Facts: what the modules put is what the table declares, and what it declares is found
somewhere.
"""

from __future__ import annotations

import json
from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, given

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.subjects import subjects
from msaa_lint.frame.facts.table import FACTS, GLOBAL, SUBJECTS
from msaa_lint.frame.facts.words import WORDS, Fact
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.input import readers
from msaa_lint.input.shader_modules import Modules
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.rules.condition import named
from msaa_lint.linter.rules.registry import load
from tests.frame.description.shapes import Json
from tests.frames import frames
from tests.pages import all_examples
from tests.paths import ROOT
from tests.strength import examples

TYPES = {"BOOL": bool, "INT": int, "DOUBLE": float, "STRING": str}


def found(text: str) -> Iterator[Subject]:
    source = Source("given", text)
    for root in parse(source, Limits()).documents:
        document = readers.read(source, root)
        assert document.problems == ()
        yield from subjects(
            document, shader=Modules(document, str(ROOT / "rules" / "example.yaml")).reflected
        )


CASES = (
    """
    renderPasses:
      r:
        attachments: [{format: R8_UNORM, samples: 4}, {format: R8_UNORM, samples: 2}]
        subpasses: [{colorAttachments: [0, 1]}]
    pipelines: {p: {renderPass: r}}
    """,
    """
    images: {d: {format: D16_UNORM, samples: 4}, s: {format: S8_UINT, samples: 2}}
    commands:
      - beginRendering: {depthAttachment: {image: d}, stencilAttachment: {image: s}}
    """,
    """
    metal:
      family: apple1
      textures: {c: {pixelFormat: rgba8Unorm, textureType: type2D, sampleCount: 4, usage: [renderTarget]}}
      renderPasses: {p: {colorAttachments: [{texture: c, loadAction: clear, storeAction: multisampleResolve}]}}
    sampleCountChoices: {chosen: {chosen: MAXIMUM}}
    """,
    """
    images: {ms: {format: R8G8B8A8_UNORM, samples: 4}, out: {format: R8G8B8A8_UNORM, samples: 1}}
    renderPasses:
      first: {attachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}], subpasses: [{colorAttachments: [0]}]}
    pipelines: {p: {renderPass: first, subpass: 0}}
    commands:
      - beginRenderPass: {renderPass: first}
      - draw: {pipeline: p}
      - endRenderPass
      - beginRendering: {colorAttachments: [{image: out, loadOp: DONT_CARE, storeOp: STORE}]}
      - readImage: {image: ms, stage: FRAGMENT, access: SHADER_READ, samples: ALL}
      - draw: {vertexCount: 3}
      - endRendering
    """,
)
"""What no example and no page has."""


def texts() -> Iterator[str]:
    yield from CASES
    for path in [*(ROOT / "examples").rglob("*.msaa.*"), *(ROOT / "tests" / "data").glob("*.*")]:
        yield path.read_text(encoding="utf-8")
    for example in all_examples():
        yield example.text


@pytest.fixture(scope="module")
def every() -> list[Subject]:
    """The subjects of all texts."""
    return [subject for text in texts() for subject in found(text)]


def is_of(fact: Fact, value: object) -> bool:
    """Whether a value is of the fact's type, and its texts are words that the fact can have."""
    if fact.type in ("LIST", "INTS"):
        inner = str if fact.type == "LIST" else int
        right = isinstance(value, list) and all(type(each) is inner for each in value)
    else:
        right = type(value) is TYPES[fact.type]
    if not right or not fact.enum:
        return right
    words = WORDS.get(fact.enum, VALUES.get(fact.enum, ()))
    return all(each in words for each in (value if isinstance(value, list) else [value]))


def undeclared(subject: Subject) -> list[tuple[str, object]]:
    declared = {fact.name: fact for fact in SUBJECTS[subject.kind]}
    return [
        (name, value)
        for name, value in subject.facts.values.items()
        if name not in declared or not is_of(declared[name], value)
    ]


def test_every_fact_that_is_put_is_declared_with_its_type(every: list[Subject]) -> None:
    for subject in every:
        assert undeclared(subject) == [], subject.path
        assert set(subject.facts.places) <= {fact.name for fact in SUBJECTS[subject.kind]}, (
            subject.path
        )


@pytest.mark.parametrize("kind", SUBJECTS)
def test_every_declared_fact_is_put_somewhere(kind: str, every: list[Subject]) -> None:
    put = {name for subject in every if subject.kind == kind for name in subject.facts.values}
    assert {fact.name for fact in SUBJECTS[kind]} - put == set()


@pytest.mark.parametrize(
    "fact", [fact for fact in FACTS.values() if fact.type == "BOOL"], ids=lambda fact: fact.name
)
def test_a_yes_or_no_is_both_somewhere(fact: Fact, every: list[Subject]) -> None:
    """A fact that is always the same decides nothing: its test, or its case, is missing."""
    assert {
        subject.facts.values[fact.name] for subject in every if fact.name in subject.facts.values
    } == {True, False}


def test_never_unknown_is_never_unknown(every: list[Subject]) -> None:
    """Facts that are declared so stand in every subject that has the rest of their group."""
    for kind, facts in SUBJECTS.items():
        for fact in facts:
            if "never unknown" not in fact.doc or (
                kind == "pipeline" and fact.name.startswith(("pass.", "subpass."))
            ):
                continue
            group = fact.name.partition(".")[0]
            for subject in every:
                within = {name.partition(".")[0] for name in subject.facts.values}
                if (
                    subject.kind == kind
                    and group in within
                    and subject.facts.values.get("image.stated", True)
                ):
                    assert fact.name in subject.facts.values, (fact.name, subject.path)


def test_the_table_is_in_order() -> None:
    for facts in SUBJECTS.values():
        names = [fact.name for fact in facts]
        assert len(set(names)) == len(names)
        assert set(GLOBAL) <= set(facts)
    for fact in FACTS.values():
        assert fact.type in (*TYPES, "LIST", "INTS")
        assert not fact.enum or fact.enum in WORDS or fact.enum in VALUES
        assert fact.doc and not fact.doc.endswith(".")
        assert named(f"{fact.name} == 1") == (fact.name,)


def test_every_fact_is_asked_or_of_use_to_a_users_rules() -> None:
    """The built-in rules ask most facts; those that none asks yet are known."""
    asked = {
        name
        for rule in load().rules
        for text in (rule.when, *(case.when for case in rule.cases))
        for name in named(text)
    }
    assert len(set(FACTS) - asked) < len(FACTS) // 2


ENGINE = Engine(load())


@examples(0.6, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@given(frames())
def test_random_frames_are_judged_without_a_failure(frame: Json) -> None:
    text = json.dumps(frame)
    for subject in found(text):
        assert undeclared(subject) == [], subject.path
    linted = ENGINE.lint(
        text.encode(), "random.json", LintOptions(lambda rule, suggested, vendor: suggested)
    )
    assert [finding for finding in linted.findings if finding.fatal] == []
    size = len(text)
    for finding in linted.findings:
        assert finding.span is not None and 0 <= finding.span.start <= finding.span.end <= size
        assert "{" not in finding.message and "unknown" not in finding.message, finding

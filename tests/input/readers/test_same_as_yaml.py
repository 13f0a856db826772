"""A render pass says the same however it is written: in YAML, as VkRenderPassCreateInfo and ...2 of
a Vulkan SC dump.
"""

from __future__ import annotations

import json
import re

import pytest

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.facts.subjects import subjects
from msaa_lint.input import readers
from msaa_lint.linter.rules.registry import load
from msaa_lint.linter.rules.rule import Rule
from msaa_lint.linter.rules.rule_runner import RuleRunner, Verdicts
from tests.frame.description.test_schema import documents
from tests.input.readers.vulkan_sc import Json, alone, dump, text
from tests.pages import Example, all_examples

CATALOGUE = load()
RULES = {rule.name: rule for rule in CATALOGUE.rules}
JUDGE = RuleRunner(CATALOGUE.rules)

ELSEWHERE = (
    *(
        "image.",
        "scene.",
        "device.",
        "frame.",
        "enabled.depth_stencil_resolve",
        "subpass.has_pipelines",
    ),
    *("subpass.partial_coverage", "subpass.tile_known"),
    *(
        "aspect.read_later",
        "aspect.costly_operations",
        "aspect.store_wasted",
        "resolve.source_encoding",
    ),
    *(
        "resolve.target_read",
        "resolve.waited_for",
        "resolve.resolved_anew",
        "aspect.undefined_used",
    ),
)
"""Facts that a dump of one pipeline cannot have."""

EXAMPLES = [
    e
    for e in all_examples()
    if "renderPasses:" in e.text and not re.search("PipelineState|^metal:", e.text, re.MULTILINE)
]


def as_written(rule: Rule, suggested: str, vendor: str | None) -> str:
    return suggested


def judged(given: str) -> Verdicts:
    source = Source("given", given)
    document = readers.read(source, parse(source, Limits()).documents[0])
    assert document.problems == ()
    # A dump of one pipeline is never all there is.
    return JUDGE.run(subjects(document._replace(whole=False)), "given", as_written)


def subject(path: str) -> str:
    """A structural path without what the two forms write differently."""
    path = re.sub(r"^(GraphicsPipelineState|renderPasses|pipelines)\.|\.pNext", "", path)
    return re.sub(r"\bp([A-Z])", lambda match: match[1].lower(), path).removesuffix(
        ".depthStencilResolve"
    )


def said(verdicts: Verdicts) -> tuple[list[Json], list[Json]]:
    findings = [
        (f.code, f.severity, f.confidence, f.message, subject(f.subject), f.notes)
        for f in verdicts.findings
    ]
    return sorted(findings), sorted(
        (u.code, subject(u.subject), u.missing) for u in verdicts.undecided
    )


@pytest.mark.parametrize("version", [1, 2])
@pytest.mark.parametrize("example", EXAMPLES, ids=str)
def test_the_same_findings(example: Example, version: int) -> None:
    for description in documents(example.text):
        for made in alone(description, version):
            assert said(judged(text(dump(made, version)))) == said(judged(json.dumps(made)))


def needs_the_pass_alone(example: Example) -> bool:
    asked = RULES[example.rule].when
    # A dump names no module.
    return not re.search("commands:|framebuffers:|module:", example.text) and not any(
        fact in asked for fact in ELSEWHERE
    )


@pytest.mark.parametrize(
    "example", [e for e in EXAMPLES if e.kind == "bad" and needs_the_pass_alone(e)], ids=str
)
def test_the_rule_fires_in_a_dump(example: Example) -> None:
    fired = [
        f.rule
        for d in documents(example.text)
        for made in alone(d, 2)
        for f in judged(text(dump(made, 2))).findings
    ]
    assert example.rule in fired


def test_the_law_is_not_empty() -> None:
    assert sum(needs_the_pass_alone(example) for example in EXAMPLES if example.kind == "bad") > 25

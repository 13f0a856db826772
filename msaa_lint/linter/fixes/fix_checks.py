"""Checks the fixes of rule pages."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from msaa_lint.core.finding import Finding
from msaa_lint.core.quote import quoted
from msaa_lint.core.suggestions import near_or_all, question
from msaa_lint.core.text.span import Span
from msaa_lint.frame.facts.table import FACTS, SUBJECTS
from msaa_lint.frame.facts.words import WORDS
from msaa_lint.frame.vulkan.names import nearest_name
from msaa_lint.linter.rules.condition import unknown_fact
from msaa_lint.linter.rules.rule import FixSpec, Rule, Setting
from msaa_lint.linter.rules.rule_file import MAX_PROBLEMS

from .actions import ACTIONS
from .fact_sources import FACT_SOURCES, ONLY_VALUES
from .metal import METAL_ACTIONS, METAL_FACT_SOURCES


def problems(rule: Rule) -> list[Finding]:
    """Unknown actions, facts that fixes cannot change, and values that facts cannot have
    (MSAA921).
    """
    found = (problem for spec in rule.fix_specs for problem in _problems(spec, rule))
    messages = dict.fromkeys(islice(found, MAX_PROBLEMS))
    return [rule.problem(message, span) for span, message in messages]


def _problems(spec: FixSpec, rule: Rule) -> Iterator[tuple[Span, str]]:
    actions = {**ACTIONS, **METAL_ACTIONS}
    if spec.do and spec.do not in actions:
        yield spec.at, f"unknown action {quoted(spec.do)}: {near_or_all(spec.do, list(actions))}"
    facts = {fact.name for fact in SUBJECTS[rule.subject]}
    sources = {**FACT_SOURCES, **(METAL_FACT_SOURCES if "metal" in rule.apis else {})}
    for setting in (*spec.set, *spec.add, *spec.remove):
        if setting.fact not in facts:
            yield setting.fact_at, unknown_fact(setting.fact, rule.subject)
        elif setting.fact not in sources:
            changeable = [fact for fact in sources if fact in facts]
            hint = (
                f"; use one of {', '.join(changeable)}"
                if changeable
                else f"; no fact of {rule.subject} can be changed"
            )
            yield setting.fact_at, f"fixes cannot change `{setting.fact}`{hint}"
        else:
            yield from _value_problems(setting, facts)


def _value_problems(setting: Setting, facts: set[str]) -> Iterator[tuple[Span, str]]:
    value, fact = setting.value, FACTS[setting.fact]
    if isinstance(value, str) and value[:1] == "{":
        other = FACTS.get(value[1:-1])
        if other is None or other.name not in facts or other.type != fact.type:
            yield setting.at, f"`{value}` does not refer to a fact of type {fact.type}"
    elif setting.fact in ONLY_VALUES and value not in ONLY_VALUES[setting.fact]:
        yield (
            setting.at,
            f"fixes can only set `{setting.fact}` to {str(ONLY_VALUES[setting.fact][0]).lower()}",
        )
    elif fact.enum and isinstance(value, str):
        from msaa_lint.frame.vulkan.enums import VALUES

        words = WORDS[fact.enum] if fact.enum in WORDS else tuple(VALUES.get(fact.enum, ()))
        if value not in words:
            yield (
                setting.at,
                f"`{fact.name}` is never {quoted(value)}{question(nearest_name(value, words))}",
            )

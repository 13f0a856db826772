"""What is wrong with the fixes of a rule's page."""

from __future__ import annotations

from collections.abc import Iterator

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.text.span import Span
from msaa_lint.frame.facts.table import FACTS, SUBJECTS, WORDS
from msaa_lint.frame.vulkan.names import nearest_name
from msaa_lint.linter.rules.rule_file import FixSpec, Rule, Setting

from .actions import DEEDS
from .fact_sources import CHANGEABLE, ONLY
from .metal import CHANGEABLE as OF_METAL
from .metal import DEEDS as METAL_DEEDS


def problems(rule: Rule) -> list[Finding]:
    """The facts that cannot be changed, the values that they never have, and what is to be done and nothing does (MSAA921)."""
    found = dict.fromkeys(each for mend in rule.fix_specs for each in _wrong(mend, rule))
    return [diagnostic("MSAA921", f"rule page `{rule.name}`: {message}", rule.source.name, span, rule.name) for span, message in found]


def _wrong(mend: FixSpec, rule: Rule) -> Iterator[tuple[Span, str]]:
    if mend.do and mend.do not in DEEDS and mend.do not in METAL_DEEDS:
        yield mend.at, f"no `do: {mend.do[:80]}`; there are {', '.join({**DEEDS, **METAL_DEEDS})}"
    known = {fact.name for fact in SUBJECTS[rule.subject]}
    for setting in (*mend.set, *mend.add, *mend.remove):
        if setting.fact not in known:
            yield setting.at, f"there is no fact {setting.fact} of {rule.subject}"
        elif setting.fact not in CHANGEABLE and setting.fact not in OF_METAL:
            yield setting.at, f"{setting.fact} cannot be changed by a fix; what can is {', '.join({**CHANGEABLE, **OF_METAL})}"
        else:
            yield from _value(setting, known)


def _value(setting: Setting, known: set[str]) -> Iterator[tuple[Span, str]]:
    value, fact = setting.value, FACTS[setting.fact]
    if isinstance(value, str) and value[:1] == "{":
        other = FACTS.get(value[1:-1])
        if other is None or other.name not in known or other.type != fact.type:
            yield setting.at, f"{value} is no fact of the same type"
    elif setting.fact in ONLY and value not in ONLY[setting.fact]:
        yield setting.at, f"{setting.fact} can only be set to {_shown(ONLY[setting.fact][0])}"
    elif fact.enum and isinstance(value, str):
        from msaa_lint.frame.vulkan.enums import VALUES

        words = WORDS[fact.enum] if fact.enum in WORDS else tuple(VALUES.get(fact.enum, ()))
        if value not in words:
            close = nearest_name(value, words)
            yield setting.at, f"{fact.name} is never '{value[:80]}'" + (f"; did you mean '{close}'?" if close else "")


def _shown(value: object) -> str:
    return str(value).lower()

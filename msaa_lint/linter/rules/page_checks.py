"""Checks what the front matter of a custom rule page says: its names, its conditions, and the facts
in its texts.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from itertools import islice

from msaa_lint.core.diagnostics import DIAGNOSTICS
from msaa_lint.core.finding import Finding
from msaa_lint.core.quote import quoted
from msaa_lint.core.suggestions import did_you_mean
from msaa_lint.core.text.span import Span
from msaa_lint.frame.facts.table import PASS_PARTS, SUBJECTS

from .condition import ConditionError, check, unknown_fact
from .rule import EDITIONS, Rule
from .rule_file import MAX_PROBLEMS

_WHOLE_PAGE = Span(0, 3)
_BRACES = re.compile(r"\{([^{}]*)(\}?)")


def check_names(rule: Rule, others: Mapping[str, Rule], names: Collection[str]) -> list[Finding]:
    """Problems of a page with a code, a name, or an edition that cannot be used or is taken.
    `others` are the rules so far by code and by name; `names` are those of all rules.
    """
    return [rule.problem(message, span) for message, span in _names(rule, others, names)]


def _names(
    rule: Rule, others: Mapping[str, Rule], names: Collection[str]
) -> Iterator[tuple[str, Span]]:
    usable = re.fullmatch(r"(?!MSAA)[A-Z]{2,12}-?[0-9]{1,6}", rule.code) is not None
    if not usable:
        form = (
            "the code must be 2 to 12 capital letters other than MSAA and a number, for example "
            "ACME001"
        )
        yield f"{form}; found {quoted(rule.code)}", rule.places["code"]
    if re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", rule.name) is None:
        plain = "-".join(
            re.findall(r"[a-z0-9]+", re.sub(r"(?<=[a-z])(?=[A-Z])", "-", rule.name).lower())
        )
        example = (
            f"; rename it to {plain}.md" if plain else ", for example no-multisampled-storage.md"
        )
        yield f"the file name must be lowercase words with hyphens{example}", _WHOLE_PAGE
    elif any(rule.name == info.name for info in DIAGNOSTICS.values()):
        yield f"the name {rule.name} is that of a diagnostic; rename the file", _WHOLE_PAGE
    same_code, same_name = others.get(rule.code), others.get(rule.name)
    if usable and same_code is not None:
        yield f"the code {rule.code} is already used by `{same_code.name}`", rule.places["code"]
    if same_name is not None and same_name is not same_code:
        owner = same_name.source.name if same_name.is_custom else "a built-in rule"
        yield f"the name {rule.name} is already used by {owner}; rename the file", _WHOLE_PAGE
    if rule.edition and rule.edition not in EDITIONS:
        yield (
            f"unknown edition {quoted(rule.edition)}: expected one of {', '.join(EDITIONS)}",
            rule.places["edition"],
        )
    for name in rule.supersedes:
        at = _place(rule.source.text, rule.places["supersedes"], name, 0)
        if name == rule.name:
            yield "the rule supersedes itself", at
        elif name not in names:
            yield f"`supersedes`: unknown rule {quoted(name)}{did_you_mean(name, names)}", at
    if "passes" in rule.places and rule.subject not in PASS_PARTS:
        yield (
            f"`passes` is for subjects that are parts of passes ({', '.join(PASS_PARTS)}), not for "
            f"{rule.subject}",
            rule.places["passes"],
        )


def check_rule(rule: Rule) -> list[Finding]:
    """The problems of a rule's conditions, and the facts its texts name that do not exist. Fixes
    are not checked.
    """
    return [rule.problem(message, span) for message, span in islice(_mistakes(rule), MAX_PROBLEMS)]


def _mistakes(rule: Rule) -> Iterator[tuple[str, Span]]:
    text = rule.source.text
    for when, at in (
        (rule.when, rule.condition_at),
        *((case.when, case.condition_at) for case in rule.cases),
    ):
        try:
            check(when, rule.subject)
        except ConditionError as error:
            yield str(error), _within(text, at, when, error)
    facts = {fact.name for fact in SUBJECTS[rule.subject]}
    yield from (
        (unknown_fact(name, rule.subject), at) for name, at in rule.named if name not in facts
    )
    for prose, at in rule.texts:
        for message, name, offset in _braces(prose, rule.subject, facts):
            yield message, _place(text, at, name, prose[:offset].count(name))


def _braces(prose: str, subject: str, facts: Collection[str]) -> Iterator[tuple[str, str, int]]:
    """The mistakes in the braces of a text: the message, the wrong text, and its offset."""
    for match in _BRACES.finditer(prose):
        if prose.startswith("{{", match.start()):
            yield "write one brace, not two, around a fact", "{{", match.start()
        elif not match[2]:
            word = match[1].split(" ", 1)[0]
            yield f"{quoted('{' + word)} has no closing brace", "{" + word, match.start()
        elif not match[1].strip():
            yield f"{quoted(match[0])} names no fact", match[0], match.start()
        elif match[1].strip() in facts and match[1] not in facts:
            yield (
                f"{quoted(match[0])} must be written `{{{match[1].strip()}}}`",
                match[0],
                match.start(),
            )
        elif match[1] not in facts:
            yield unknown_fact(match[1], subject), match[1], match.start(1)


def _within(text: str, at: Span, when: str, error: ConditionError) -> Span:
    """The location of an error in a condition on a page."""
    if error.offset is None:
        return at
    word = when[error.offset : error.offset + error.length]
    return _place(text, at, word, when[: error.offset].count(word)) if word else at


def _place(text: str, at: Span, word: str, number: int) -> Span:
    """The occurrence of a word, counted from 0, in a part of a page; all of the part if it is
    escaped there.
    """
    start = at.start - 1
    for _ in range(number + 1):
        start = text.find(word, start + 1, at.end)
        if start < 0:
            return at
    return Span(start, start + len(word))

"""Rule selectors: a rule's name, its code, a code prefix, or ALL."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Protocol

from msaa_lint.core.diagnostics import DIAGNOSTICS, diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.quote import quoted
from msaa_lint.core.suggestions import Suggestions

from .settings import COMMAND_LINE, Origin, Settings

ALL = "ALL"
EXACT = 1000
"""The specificity of a name or a whole code."""

MAX_FINDINGS = 50
_CUSTOM = re.compile(r"(?!MSAA)[A-Z]{2,12}-?[0-9]{0,6}\Z")
"""A code of a custom rule, or its prefix."""
_PREFIX = re.compile(r"([A-Z]+)[0-9]*\Z")


class Named(Protocol):
    """What suppressions and selectors need of a rule."""

    @property
    def code(self) -> str: ...
    @property
    def name(self) -> str: ...


class Weighed(Named, Protocol):
    """What a selection needs of a rule. The edition of a user's own rule is empty."""

    @property
    def severity(self) -> str: ...
    @property
    def edition(self) -> str: ...


def specificity(selector: str, rule: Named) -> int:
    """How specifically a selector names a rule: EXACT for its name or code, the prefix length plus
    1 for a code prefix, 1 for ALL, and 0 if it does not. A code prefix has all letters of the code:
    MSAA, MSAA2, but not MS.
    """
    if selector in (rule.code, rule.name):
        return EXACT
    if selector == ALL:
        return 1
    prefix = _PREFIX.match(selector)
    if (
        prefix is not None
        and rule.code.startswith(selector)
        and not rule.code[len(prefix[1]) : len(prefix[1]) + 1].isalpha()
    ):
        return len(selector) + 1
    return 0


def max_specificity(selectors: Iterable[str], rule: Named) -> int:
    """The specificity of the selector that names a rule most specifically; 0 if none does."""
    return max((specificity(selector, rule) for selector in selectors), default=0)


class RuleNames:
    """The names and codes of rules, to find unknown selectors and suggest the intended ones. A rule
    with a broken page may have no code.
    """

    def __init__(self, rules: Iterable[Named]) -> None:
        self.rules: list[Named] = [*rules, *DIAGNOSTICS.values()]
        self.by_word = {
            word: rule for rule in self.rules for word in (rule.name, rule.code) if word
        }
        self.suggestions = Suggestions(self.by_word)
        self._code_missing = not all(rule.code for rule in self.rules)

    def may_be_missing(self, word: str) -> bool:
        """Whether a word may be the code of a rule whose page does not state a readable one."""
        return self._code_missing and _CUSTOM.match(word) is not None

    def selects_any(self, selector: str) -> bool:
        """Whether a selector names at least one rule, or may name one."""
        return (
            selector in self.by_word
            or self.may_be_missing(selector)
            or any(specificity(selector, rule) for rule in self.rules)
        )


def unknown_selectors(settings: Settings, rules: Callable[[], Iterable[Named]]) -> list[Finding]:
    """A finding for each selector that names no rule, at its place in the configuration file if it
    has one.
    """
    uses = list(_uses(settings))
    if not uses:
        return []
    names = RuleNames(rules())
    findings: list[Finding] = []
    for selector, key, path, origin in uses:
        if names.selects_any(selector):
            continue
        close = names.suggestions.nearest(selector)
        hint = f"did you mean `{close}`?" if close else "`msaa-lint rule --all` lists the rules"
        message = f"unknown rule {quoted(selector)}"
        if origin is None:
            findings.append(diagnostic("MSAA921", f"{message} in `{key}`: {hint}", COMMAND_LINE))
        else:
            findings.append(origin.problem(path, message, hint, at_key=key == "severity"))
        if len(findings) >= MAX_FINDINGS:
            break
    return findings


def _uses(settings: Settings) -> Iterator[tuple[str, str, tuple[str | int, ...], Origin | None]]:
    """The selectors, each with the key that has it, its path in the file, and the file; None for
    the command line.
    """
    lists: dict[tuple[str, ...], Sequence[str]] = {
        ("select",): settings.select or (),
        ("extend-select",): settings.extend_select,
        ("ignore",): settings.ignore,
        **{
            ("per-file-ignores", glob.pattern): selectors
            for glob, selectors in settings.per_file_ignores
        },
    }
    for path, selectors in lists.items():
        for i, selector in enumerate(selectors):
            yield selector, path[0], (*path, i), settings.origin.get(path)
    for selector in settings.severity:
        yield (
            selector,
            "severity",
            ("severity", selector),
            settings.origin.get(("severity", selector)),
        )
    choice = settings.command_line
    by_option = {
        "select": choice.select or (),
        "extend-select": choice.extend_select,
        "ignore": choice.ignore,
        "severity": choice.severity,
    }
    for key, selected in by_option.items():
        for selector in selected:
            yield selector, f"--{key}", (), None

"""How a configuration names rules: by name, by code, by the beginning of a code, or all of them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple, Protocol

from msaa_lint.core.diagnostics import DIAGNOSTICS, diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.quote import quoted
from msaa_lint.core.suggestions import Suggestions

from .settings import COMMAND_LINE, Origin, Settings

ALL = "ALL"
EXACT = 1000
"""The specificity of a name or a whole code."""

MAX_PROBLEMS = 50
_PREFIX = re.compile(r"([A-Z]+)[0-9]*\Z")


class Named(Protocol):
    """What suppressions and selectors ask of a rule."""

    @property
    def code(self) -> str: ...
    @property
    def name(self) -> str: ...


class Weighed(Named, Protocol):
    """What a selection asks of a rule. A user's own rule has no edition (empty)."""

    @property
    def severity(self) -> str: ...
    @property
    def edition(self) -> str: ...


def specificity(selector: str, rule: Named) -> int:
    """How closely a selector names a rule: EXACT for its name or code, the length for the beginning of its code, 1 for ALL; 0 where it
    does not. The beginning of a code has all its letters: MSAA, MSAA2, but not MS."""
    if selector in (rule.code, rule.name):
        return EXACT
    if selector == ALL:
        return 1
    prefix = _PREFIX.match(selector)
    if prefix is not None and rule.code.startswith(selector) and not rule.code[len(prefix[1]) : len(prefix[1]) + 1].isalpha():
        return len(selector) + 1
    return 0


def closest(selectors: Iterable[str], rule: Named) -> int:
    """The specificity of the one that names a rule most closely."""
    return max((specificity(selector, rule) for selector in selectors), default=0)


class Words:
    """The names and codes there are, to tell which selectors are unknown and what they were meant to be."""

    def __init__(self, rules: Iterable[Named]) -> None:
        self.rules: list[Named] = [*rules, *DIAGNOSTICS.values()]
        self.exact = {word: rule for rule in self.rules for word in (rule.name, rule.code)}
        self._suggestions = Suggestions(self.exact)

    def knows(self, selector: str) -> bool:
        return selector in self.exact or any(specificity(selector, rule) for rule in self.rules)

    def nearest(self, word: str) -> str | None:
        """The name or code that was most likely meant by an unknown word; see `Suggestions` for its limits."""
        return self._suggestions.nearest(word)


class _Use(NamedTuple):
    """A selector where it is used: the key, its path below it, and the file (None: the command line)."""

    selector: str
    key: str
    path: tuple[str | int, ...]
    origin: Origin | None


def unknown_selectors(settings: Settings, known: Iterable[Named]) -> list[Finding]:
    """A finding for each selector that names no rule, at its place in the configuration, or as the command line gave it."""
    words = Words(known)
    found: list[Finding] = []
    for use in _uses(settings):
        if words.knows(use.selector):
            continue
        close = words.nearest(use.selector)
        help = f"did you mean `{close}`?" if close else "`msaa-lint rule --all` lists the rules there are"
        message = f"unknown rule {quoted(use.selector)} in `{use.key}`"
        if use.origin is None:
            found.append(diagnostic("MSAA921", message, COMMAND_LINE, help=help))
        else:
            in_file = f"{message} of {use.origin.source.name}"
            found.append(use.origin.wrong(use.path, in_file, help, at_key=use.key == "severity"))
        if len(found) >= MAX_PROBLEMS:
            break
    return found


def _uses(settings: Settings) -> Iterator[_Use]:
    lists = {"select": settings.select or (), "extend-select": settings.extend_select, "ignore": settings.ignore}
    for key, selectors in lists.items():
        origin = settings.origin.get((key,))
        for i, selector in enumerate(selectors):
            yield _Use(selector, key, (key, i), origin)
    for glob, selectors in settings.per_file_ignores:
        origin = settings.origin.get(("per-file-ignores", glob.pattern))
        for i, selector in enumerate(selectors):
            yield _Use(selector, "per-file-ignores", ("per-file-ignores", glob.pattern, i), origin)
    for selector in settings.severity:
        yield _Use(selector, "severity", ("severity", selector), settings.origin.get(("severity", selector)))
    choice = settings.command_line
    stated = {"select": choice.select or (), "extend-select": choice.extend_select, "ignore": choice.ignore, "severity": choice.severity}
    for key, given in stated.items():
        for selector in given:
            yield _Use(selector, f"--{key}", (), None)

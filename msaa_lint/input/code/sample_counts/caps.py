"""What caps a sample count that a file chooses: the variables that hold it, and what they are
compared with.
"""

from __future__ import annotations

import re
from collections import Counter

from msaa_lint.input.code.core.terms import (
    ADDRESS,
    ASSIGN,
    BINARY,
    BRACES,
    CALL,
    DECLARE,
    FIELD,
    NAME,
    TARGET,
    Term,
    Unit,
)

from .masks import COUNTS, Expressions, name_of
from .names import last, parts

MAX_NAMES = 12
"""The maximum number of names that hold a count."""

_CAPS = frozenset({"min", "MIN", "Min", "clamp", "Clamp", "CLAMP", "qMin", "qBound", "SDL_min"})
_LIMIT = re.compile(r"(?:m_|_)?(?:max|limit|supported)", re.IGNORECASE)
"""Members that say what a device offers. Which count is chosen is decided by what reads them."""

_SAMPLES = (
    "samples",
    "rasterizationSamples",
    "sampleCount",
    "rasterization_samples",
    "sample_count",
)
"""Members that many structures have, such as those that describe images."""


class Caps:
    """The caps of the values of a file, by the names that hold them."""

    def __init__(self, unit: Unit, expressions: Expressions) -> None:
        self.expressions = expressions
        self._targets: dict[str, list[str]] = {}
        self._limits: dict[str, list[int]] = {}
        self._mentions: Counter[str] = Counter()
        """How often each member is mentioned, less the assignments to it."""
        for function in unit.functions:
            for term in parts(function.body):
                self._read(term)
        for terms in (unit.outside, *unit.members.values()):
            for outer in terms:
                for term in parts(outer):
                    self._read(term)

    def of(self, name: str) -> int | None:
        """Returns the count that caps the value of a variable or function, 0 if the cap is unknown,
        and None if there is none.
        """
        if _LIMIT.match(name) and name in self._mentions and not self._mentions[name]:
            # What a device offers is only reported.
            return 0
        holders = [name]
        for holder in holders:
            holders += [
                item for item in dict.fromkeys(self._targets.get(holder, ())) if item not in holders
            ][: MAX_NAMES - len(holders)]
        limits = [limit for holder in holders for limit in self._limits.get(holder, ())]
        return min(limits) if limits else None

    def _read(self, term: Term) -> None:
        kind = term[0]
        if kind == FIELD:
            self._mentions[term[2]] += 1
        elif kind == ASSIGN and term[1] == "=" and term[2][0] == FIELD:
            self._mentions[term[2][2]] -= 1
        if kind == DECLARE and term[3] is not None:
            self._assigned(last(term[2]), term[3])
        elif kind == ASSIGN and term[1] == "=":
            self._assigned(_key(term[2]), term[3])
        elif kind == CALL and name_of(term[1]) in _CAPS:
            # `count.clamp(least, most)` is a method of the count.
            values = (
                (term[1][1], *term[2]) if term[1][0] == FIELD and len(term[2]) == 2 else term[2]
            )
            for value in values:
                others = [item for item in values if item is not value]
                limit = self.expressions.value(others[0], {}) if len(others) == 1 else None
                self._limits.setdefault(_source(value), []).append(
                    limit if isinstance(limit, int) and limit in COUNTS else 0
                )
        elif kind == BINARY and term[1] in ("<", ">", "<=", ">="):
            for side, other in (term[2:4], term[3:1:-1]):
                if self.expressions.value(other, {}) not in (0, 1):
                    self._limits.setdefault(_source(side), []).append(0)

    def _assigned(self, target: str, value: Term) -> None:
        source = _source(value)
        if source and target:
            self._targets.setdefault(source, []).append(target)


def _source(term: Term) -> str:
    """Returns the variable or function whose value an expression is, or an empty string."""
    while True:
        if term[0] in (ADDRESS, TARGET):
            term = term[1]
        elif term[0] == BRACES and len(term[2]) == 1 and term[2][0][0] is None:
            term = term[2][0][1]
        elif (
            term[0] == CALL
            and len(term[2]) == 1
            and term[1][0] == NAME
            and name_of(term[1]) in ("uint32_t", "int", "VkSampleCountFlagBits")
        ):
            term = term[2][0]
        else:
            return _key(term[1]) if term[0] == CALL else _key(term)


def _key(term: Term) -> str:
    """Returns the name of a variable, member, or function; of a member that many structures have,
    with its object.
    """
    name = name_of(term)
    if term[0] == FIELD and name in _SAMPLES and term[1][:2] != (NAME, "this"):
        return f"{term[1][1]}.{name}" if term[1][0] == NAME else ""
    return name

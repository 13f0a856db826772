"""Guards: the conditions under which a value applies."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from hashlib import blake2b

Guards = frozenset[tuple[str, bool]]
"""Conditions that all hold, each as its text and its value."""

ALWAYS: Guards = frozenset()

MAX_TEXT = 200
"""The maximum length of the text that stands for an expression; a digest stands for a longer
one.
"""

MAX_PARTS = 16
"""The maximum number of parts of a conjunction that are known."""

MAX_SPLITS = 64
"""The maximum number of cases that are distinguished to determine whether conditions cover all of
them.
"""

MAX_KEPT = 1 << 14
"""The number of answers about conditions that are kept, since the same ones are asked for many
times.
"""


_ENUMERATOR = re.compile(r"(?:\w+::)+[A-Z]\w*")
"""A constant whose value is unknown, by its name."""


class Conjunction(str):
    """The text of a condition that holds if all its parts do. The negation of several conditions is
    that of their conjunction.
    """

    __slots__ = ("parts",)

    parts: Guards


def brief(text: str) -> str:
    """Returns a text that stands for an expression, so that texts that contain others stay
    short.
    """
    return (
        text if len(text) <= MAX_TEXT else f"?{blake2b(text.encode(), digest_size=16).hexdigest()}"
    )


def negated(guards: Guards) -> Guards:
    """Returns the guards of the opposite condition."""
    if len(guards) == 1:
        ((text, way),) = guards
        if isinstance(text, Conjunction) and not way:
            return text.parts
        return frozenset({(text, not way)})
    text = brief(str(sorted(guards)))
    if len(guards) > MAX_PARTS:
        return frozenset({(text, False)})
    conjunction = Conjunction(text)
    conjunction.parts = guards
    return frozenset({(conjunction, False)})


def either(left: Guards, right: Guards) -> Guards:
    """Returns the guards of a condition that holds if one of two conditions does."""
    return negated(negated(left) | negated(right))


def contradicts(left: Guards, right: Guards) -> bool:
    """Returns whether two sets of guards contradict each other."""
    return any((text, not way) in right for text, way in left)


def decided(condition: bool | Guards, guards: Guards) -> bool | None:
    """Returns whether a condition holds where guards hold, or None if that is unknown."""
    if isinstance(condition, bool):
        return condition
    if condition <= guards:
        return True
    if not guards:
        return None
    ways = [
        None if (value := _implied(text, guards)) is None else value is way
        for text, way in condition
    ]
    return False if False in ways else None if None in ways else True


def _implied(text: str, guards: Guards) -> bool | None:
    """Returns the value of a condition where guards hold, or None if that is unknown."""
    for way in (True, False):
        if (text, way) in guards:
            return way
    if isinstance(text, Conjunction):
        ways = [
            (part, way) in guards or (None if (part, not way) not in guards else False)
            for part, way in text.parts
        ]
        return False if False in ways else None if None in ways else True
    subject = compared(text)
    return (
        False
        if subject
        and any(way and other != text and compared(other) == subject for other, way in guards)
        else None
    )


def compared(text: str) -> str:
    """Returns what a condition compares with a constant for equality, or an empty string."""
    subject, _, constant = text.rpartition("=")
    if (
        subject[-1:] == "="
        and _ENUMERATOR.fullmatch(constant)
        and not isinstance(text, Conjunction)
    ):
        return subject[:-1]
    fixed = constant.removeprefix("-").isdecimal() or constant.startswith("VK_")
    return (
        subject
        if fixed
        and subject[-1:] not in ("", "<", ">", "=", "!")
        and not isinstance(text, Conjunction)
        else ""
    )


def chosen(text: str, configuration: Mapping[str, bool]) -> bool | None:
    """Returns the value of a condition in a configuration, or None if that leaves it open."""
    way = configuration.get(text)
    if way is None and isinstance(text, Conjunction):
        ways = [
            configuration[part] is expected if part in configuration else None
            for part, expected in text.parts
        ]
        return False if False in ways else None if None in ways else True
    return way


def excluded(guards: Guards, configuration: Mapping[str, bool]) -> bool:
    """Returns whether a configuration denies that several conditions hold together."""
    return len(guards) > 1 and configuration.get(brief(str(sorted(guards)))) is False


def remaining(guards: Guards, configuration: Mapping[str, bool]) -> Guards | None:
    """Returns the conditions that a configuration leaves open, or None if it denies one of them."""
    rest = []
    for guard in guards:
        way = chosen(guard[0], configuration)
        if way is None:
            rest.append(guard)
        elif way is not guard[1]:
            return None
    left = guards if len(rest) == len(guards) else frozenset(rest)
    return None if excluded(left, configuration) else left


@lru_cache(MAX_KEPT)
def remaining_under(guards: Guards, known: Guards) -> Guards | None:
    """Returns the conditions that are open where others hold, or None if they cannot hold
    together.
    """
    return remaining(guards, dict(known))


@lru_cache(MAX_KEPT)
def covers(alternatives: tuple[Guards, ...]) -> bool:
    """Returns whether one of several conditions always holds. If that takes too many cases to find
    out, it is not concluded.
    """
    terms: list[Guards] = []
    for guards in alternatives:
        terms += _expanded(guards)
    return len(terms) <= MAX_SPLITS and _cover(terms, [MAX_SPLITS])


def _expanded(guards: Guards) -> list[Guards]:
    """Returns guards as alternatives without the first negated conjunction."""
    for text, way in sorted(guards):
        if isinstance(text, Conjunction):
            rest = guards - {(text, way)}
            return (
                [rest | text.parts]
                if way
                else [rest | negated(frozenset({part})) for part in text.parts]
            )
    return [guards]


def _cover(terms: Sequence[Guards], splits: list[int]) -> bool:
    if not terms:
        return False
    if any(not guards for guards in terms):
        return True
    every = frozenset[tuple[str, bool]]().union(*terms)
    both = [text for text, way in every if way and (text, False) in every]
    splits[0] -= 1
    if splits[0] < 0 or not both:
        return False
    text = min(both)
    subject = compared(text)
    for way in (True, False):
        rest: list[Guards] = []
        for guards in terms:
            if (text, not way) in guards:
                continue
            guards = guards - {(text, way)}
            if way and subject:
                others = frozenset(guard for guard in guards if compared(guard[0]) == subject)
                if any(value for _, value in others):
                    continue
                guards -= others
            rest.append(guards)
        if not _cover(rest, splits):
            return False
    return True

"""Which way Swift's conditions go, and the names that they bind."""

from __future__ import annotations

import re

from .configurations import by_branches, by_words, last_name, words_of
from .frame_state import Frame
from .machine import Machine
from .terms import BINARY, BIND, CALL, LITERAL, MEMBER, NAME, NOT, Term
from .values import NIL, Known, Object, Symbol, Texture

_FAMILY = re.compile(r"(?:apple|mac|common|metal)\d{1,2}")


def truth(machine: Machine, conditions: tuple[Term, ...], frame: Frame) -> bool | None:
    """What conditions are by the values in them; their names are bound as they are come by."""
    whole: bool | None = True
    for condition in conditions:
        one = _bound(machine, condition, frame) if condition[0] == BIND else _truth(machine, condition, frame)
        if one is False:
            return False
        if one is None:
            whole = None
    return whole


def _bound(machine: Machine, condition: Term, frame: Frame) -> bool | None:
    """Binds a name; that it is bound is sure of Metal's objects alone."""
    _, name, term, _ = condition
    if term is None:
        variable = frame.find(name)
        if variable is None:
            value = machine.evaluate(machine, (NAME, name, condition[-1]), frame)
            machine.variable(frame, name, Symbol(name, frame.within) if value == NIL else value)
            return True if isinstance(value, Object) else None
        return True if isinstance(variable[1], (Texture, Object)) else None
    value = machine.evaluate(machine, term, frame)
    machine.variable(frame, name, Symbol(last_name(term) or name, frame.whose) if value == NIL else value)
    return True if isinstance(value, Object) else None


def _truth(machine: Machine, condition: Term, frame: Frame) -> bool | None:
    if condition[0] in (BINARY, NOT, NAME, MEMBER, LITERAL):
        if condition[0] == BINARY and condition[1] in ("==", "!=") and (LITERAL, None) in (condition[2][:2], condition[3][:2]):
            return None
        value = machine.evaluate(machine, condition, frame)
        if isinstance(value, Known) and isinstance(value.value, bool):
            return value.value
    return None


def decided(machine: Machine, conditions: tuple[Term, ...], then: object, otherwise: object, frame: Frame) -> bool | None:
    """Which way conditions go; None where it cannot be told."""
    if not conditions:
        return None
    way = truth(machine, conditions, frame)
    if way is not None:
        return way
    words = words_of(conditions, machine.text)
    goes = machine.worlds.get(words)
    if goes is None:
        goes = by_words(conditions[0]) if len(conditions) == 1 else None
        if goes is None:
            goes = by_branches(then, otherwise)
        if goes is not None:
            machine.worlds[words] = goes
    if goes:
        hold(machine, conditions)
    return goes


def hold(machine: Machine, conditions: tuple[Term, ...]) -> None:
    """What conditions that hold say of the device."""
    for condition in conditions:
        if condition[0] != CALL or not condition[2]:
            continue
        name, first = last_name(condition[1]), condition[2][0][1]
        if name == "supportsTextureSampleCount" and first[0] == LITERAL and type(first[1]) is int:
            machine.offered.setdefault(first[1], first[-1])
        elif name == "supportsFamily" and first[0] == MEMBER and machine.family is None and _FAMILY.fullmatch(first[2]):
            machine.family = (first[2], first[-1])

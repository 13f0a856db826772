"""Decides conditions in Swift and binds their names."""

from __future__ import annotations

import re

from .configurations import by_branches, by_words, last_name, words_of
from .frame_state import CallFrame
from .interpreter import Interpreter
from .terms import BINARY, BIND, CALL, LITERAL, MEMBER, NAME, NOT, Term
from .values import NIL, Constant, MetalObject, Symbol, Texture

_FAMILY = re.compile(r"(?:apple|mac|common|metal)\d{1,2}")


def truth(interpreter: Interpreter, conditions: tuple[Term, ...], frame: CallFrame) -> bool | None:
    """Returns the value of conditions and binds their names; None if it is unknown."""
    whole: bool | None = True
    for condition in conditions:
        one = _bound(interpreter, condition, frame) if condition[0] == BIND else _truth(interpreter, condition, frame)
        if one is False:
            return False
        if one is None:
            whole = None
    return whole


def _bound(interpreter: Interpreter, condition: Term, frame: CallFrame) -> bool | None:
    """Binds a name. Only Metal objects are known not to be nil."""
    _, name, term, _ = condition
    if term is None:
        variable = frame.find(name)
        if variable is None:
            value = interpreter.evaluate(interpreter, (NAME, name, condition[-1]), frame)
            interpreter.variable(frame, name, Symbol(name, frame.type_name) if value == NIL else value)
            return True if isinstance(value, MetalObject) else None
        return True if isinstance(variable[1], (Texture, MetalObject)) else None
    value = interpreter.evaluate(interpreter, term, frame)
    interpreter.variable(frame, name, Symbol(last_name(term) or name, frame.function_name) if value == NIL else value)
    return True if isinstance(value, MetalObject) else None


def _truth(interpreter: Interpreter, condition: Term, frame: CallFrame) -> bool | None:
    if condition[0] in (BINARY, NOT, NAME, MEMBER, LITERAL):
        if condition[0] == BINARY and condition[1] in ("==", "!=") and (LITERAL, None) in (condition[2][:2], condition[3][:2]):
            return None
        value = interpreter.evaluate(interpreter, condition, frame)
        if isinstance(value, Constant) and isinstance(value.value, bool):
            return value.value
    return None


def decide(interpreter: Interpreter, conditions: tuple[Term, ...], then: object, otherwise: object, frame: CallFrame) -> bool | None:
    """Returns whether conditions are taken as true; None if undecided."""
    if not conditions:
        return None
    result = truth(interpreter, conditions, frame)
    if result is not None:
        return result
    words = words_of(conditions, interpreter.text)
    goes = interpreter.decisions.get(words)
    if goes is None:
        goes = by_words(conditions[0]) if len(conditions) == 1 else None
        if goes is None:
            goes = by_branches(then, otherwise)
        if goes is not None:
            interpreter.decisions[words] = goes
    if goes:
        note_capabilities(interpreter, conditions)
    return goes


def note_capabilities(interpreter: Interpreter, conditions: tuple[Term, ...]) -> None:
    """Records what conditions that hold say about the device."""
    for condition in conditions:
        if condition[0] != CALL or not condition[2]:
            continue
        name, first = last_name(condition[1]), condition[2][0][1]
        if name == "supportsTextureSampleCount" and first[0] == LITERAL and type(first[1]) is int:
            interpreter.offered_counts.setdefault(first[1], first[-1])
        elif name == "supportsFamily" and first[0] == MEMBER and interpreter.family is None and _FAMILY.fullmatch(first[2]):
            interpreter.family = (first[2], first[-1])

"""Decides conditions in Swift and binds their names.

Unknown conditions are decided in favor of the multisampled configuration, equal ones alike.
"""

from __future__ import annotations

import re
from typing import Any

from .interpreter import Interpreter
from .terms import BINARY, BIND, CALL, LITERAL, MEMBER, NAME, NOT, OTHER, SET, Term
from .values import NIL, CallFrame, Constant, MetalObject, Symbol, Texture

MAX_TERMS = 2000
"""The maximum number of terms of a branch searched for multisampling."""

ALWAYS_OFFERED = (1, 2, 4)
"""Counts that a check with supportsTextureSampleCount accepts: every device supports 4, and nearly all support 2."""

_ABOUT_SAMPLES = re.compile(r"sample|msaa|antialias", re.IGNORECASE)
_SWITCHED = re.compile(r"msaa|multisampl|antialias", re.IGNORECASE)
_ABOVE_ONE = {(">", 1), (">=", 2), ("!=", 1), ("==", 4)}
_ONE = {("==", 1), ("<=", 1), ("<", 2)}
_MIRRORED = {">": "<", "<": ">", ">=": "<=", "<=": ">="}
_WORDS = frozenset({"type2DMultisample", "type2DMultisampleArray", "multisampleResolve", "storeAndMultisampleResolve"})
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
    variable = frame.find(name) if term is None else None
    if variable is not None:
        return True if isinstance(variable[1], (Texture, MetalObject)) else None
    value = interpreter.evaluate(interpreter, term or (NAME, name, condition[-1]), frame)
    unknown = Symbol(last_name(term) or name, frame.function_name) if term else Symbol(name, frame.type_name)
    interpreter.variable(frame, name, unknown if value == NIL else value)
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


def by_words(condition: Term) -> bool | None:
    """Returns the value of a condition in the multisampled configuration, based on its names."""
    turned = False
    while condition[0] == NOT:
        condition, turned = condition[1], not turned
    result = _by_words(condition)
    return None if result is None else result != turned


def _by_words(condition: Term) -> bool | None:
    if condition[0] == BINARY:
        sign, left, right = condition[1], condition[2], condition[3]
        if sign in ("&&", "||"):
            one, other = by_words(left), by_words(right)
            if sign == "&&":
                return False if False in (one, other) else True if one and other else None
            return True if True in (one, other) else False if one is False and other is False else None
        if left[0] == LITERAL:
            sign, left, right = _MIRRORED.get(sign, sign), right, left
        if right[0] == LITERAL and type(right[1]) is int and _ABOUT_SAMPLES.search(last_name(left)):
            return True if (sign, right[1]) in _ABOVE_ONE else False if (sign, right[1]) in _ONE else None
        return None
    if condition[0] == CALL and last_name(condition[1]) == "supportsTextureSampleCount" and condition[2]:
        count = condition[2][0][1]
        return count[1] in ALWAYS_OFFERED if count[0] == LITERAL else None
    if condition[0] in (NAME, MEMBER) and _SWITCHED.search(last_name(condition)):
        return True
    return None


def by_branches(then: Any, otherwise: Any) -> bool | None:
    """Returns the value of a condition in the multisampled configuration if only one branch sets up multisampling."""
    one, other = mentions_multisampling(then), mentions_multisampling(otherwise)
    return one if one != other else None


def mentions_multisampling(term: Any) -> bool:
    """Returns whether a branch sets up multisampling."""
    stack = [term]
    left = MAX_TERMS
    while stack and left:
        left -= 1
        inner = stack.pop()
        if not isinstance(inner, tuple) or not inner:
            continue
        if inner[0] == MEMBER and len(inner) == 4 and inner[2] in _WORDS:
            return True
        if inner[0] == SET and len(inner) == 5 and inner[2][0] == MEMBER:
            name, value = inner[2][2], inner[3]
            if name in ("sampleCount", "rasterSampleCount") and not (value[0] == LITERAL and value[1] == 1):
                return True
            if name == "resolveTexture" and value[:2] != (LITERAL, None):
                return True
        stack.extend(inner)
    return False


def about_samples(name: str) -> bool:
    """Returns whether a name suggests a sample count or a switch for multisampling."""
    return _ABOUT_SAMPLES.search(name) is not None


def last_name(term: Term) -> str:
    """Returns the last name in an expression, `count` for `a.b.count`, or an empty string."""
    return str(term[2]) if term[0] == MEMBER else str(term[1]) if term[0] == NAME else last_name(term[1]) if term[0] == CALL else ""


def words_of(conditions: tuple[Term, ...], text: str) -> str:
    """Returns the text that identifies conditions."""
    first, last = conditions[0][-1], conditions[-1][-1]
    if conditions[0][0] == OTHER:
        return str(conditions[0][1])
    return "".join(text[first.start : last.end].split())[:500]

"""Assignments in Swift."""

from __future__ import annotations

from .evaluate import cell, declares, evaluate, owner_of
from .frame_state import CallFrame
from .interpreter import Interpreter
from .members import adopt_descriptor, set_index, set_member
from .terms import INDEX, MEMBER, NAME, TUPLE, Term, name_at
from .values import UNKNOWN, Aggregate, Instance, Symbol


def set_target(interpreter: Interpreter, sign: str, target: Term, value: Term, frame: CallFrame) -> None:
    """Executes an assignment."""
    new_value = evaluate(interpreter, value, frame)
    if sign != "=":
        new_value = UNKNOWN
    kind = target[0]
    place = value[-1]
    if kind == NAME:
        variable = frame.find(target[1])
        if variable is not None:
            interpreter.name_value(new_value, target[1], frame.function, frame.rank)
            interpreter.undo_log.write(variable[0].locals, target[1], new_value)
            return
        is_declared = declares(interpreter, frame.type_name, target[1])
        if (
            frame.self_value is not None
            and not is_declared
            and set_member(interpreter, frame.self_value, target[1], new_value, target[-1], place)
        ):
            return
        outer = not is_declared and declares(interpreter, "", target[1])
        interpreter.set_property("" if outer else frame.type_name, target[1], new_value, place)
    elif kind == MEMBER and target[1] is not None:
        owner = owner_of(interpreter, target[1], target[2], frame)
        if isinstance(owner, Instance):
            interpreter.set_property(owner.type, target[2], new_value, place)
            return
        if isinstance(owner, Symbol):
            owner = adopt_descriptor(interpreter, owner, target[1], target[2], frame)
        set_member(interpreter, owner, target[2], new_value, name_at(target), place)
    elif kind == INDEX:
        owner = evaluate(interpreter, target[1], frame)
        if not set_index(interpreter, owner, evaluate(interpreter, target[2], frame), new_value, target[-1], place):
            property_at = cell(target[1], frame)
            if property_at is not None:
                interpreter.set_property(property_at[0], property_at[1], new_value, place)
    elif kind == TUPLE and isinstance(new_value, Aggregate):
        for index, (_, item) in enumerate(target[1]):
            if item[0] == NAME and frame.find(item[1]) is not None:
                interpreter.undo_log.write(frame.locals, item[1], new_value.items.get(str(index), UNKNOWN))
            elif item[0] == NAME:
                interpreter.set_property(frame.type_name, item[1], new_value.items.get(str(index), UNKNOWN), place)

"""What Swift's assignments change."""

from __future__ import annotations

from .evaluate import cell, declares, evaluate, owner_of
from .frame_state import Frame
from .machine import Machine
from .members import adopted, set_index, set_member
from .terms import INDEX, MEMBER, NAME, TUPLE, Term, name_at
from .values import UNKNOWN, Aggregate, Instance, Symbol


def set_target(machine: Machine, sign: str, target: Term, value: Term, frame: Frame) -> None:
    """What an assignment changes."""
    new_value = evaluate(machine, value, frame)
    if sign != "=":
        new_value = UNKNOWN
    kind = target[0]
    place = value[-1]
    if kind == NAME:
        variable = frame.find(target[1])
        if variable is not None:
            machine.name(new_value, target[1], frame.function, frame.rank)
            machine.journal.write(variable[0].locals, target[1], new_value)
            return
        is_declared = declares(machine, frame.within, target[1])
        if frame.me is not None and not is_declared and set_member(machine, frame.me, target[1], new_value, target[-1], place):
            return
        outer = not is_declared and declares(machine, "", target[1])
        machine.set_property("" if outer else frame.within, target[1], new_value, place)
    elif kind == MEMBER and target[1] is not None:
        owner = owner_of(machine, target[1], target[2], frame)
        if isinstance(owner, Instance):
            machine.set_property(owner.type, target[2], new_value, place)
            return
        if isinstance(owner, Symbol):
            owner = adopted(machine, owner, target[1], target[2], frame)
        set_member(machine, owner, target[2], new_value, name_at(target), place)
    elif kind == INDEX:
        owner = evaluate(machine, target[1], frame)
        if not set_index(machine, owner, evaluate(machine, target[2], frame), new_value, target[-1], place):
            place_of = cell(target[1], frame)
            if place_of is not None:
                machine.set_property(place_of[0], place_of[1], new_value, place)
    elif kind == TUPLE and isinstance(new_value, Aggregate):
        for index, (_, item) in enumerate(target[1]):
            if item[0] == NAME and frame.find(item[1]) is not None:
                machine.journal.write(frame.locals, item[1], new_value.items.get(str(index), UNKNOWN))
            elif item[0] == NAME:
                machine.set_property(frame.within, item[1], new_value.items.get(str(index), UNKNOWN), place)

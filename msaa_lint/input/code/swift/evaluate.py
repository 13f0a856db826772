"""Swift's expressions, as far as their values can be known."""

from __future__ import annotations

from msaa_lint.core.text.span import Span

from .calls import called
from .conditions import decided
from .configurations import about_samples, last_name
from .frame_state import Frame
from .machine import Machine
from .members import adopted, index_of, member_of
from .terms import BINARY, CALL, CHOICE, CLOSURE, INDEX, LIST, LITERAL, MEMBER, NAME, NOT, TUPLE, Term
from .values import MOST_ITEMS, NIL, UNKNOWN, Aggregate, Code, Instance, Known, Symbol, Texture, Value, joined

_COMPARED = {
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
    ">": lambda a, b: a > b,
    "<": lambda a, b: a < b,
    ">=": lambda a, b: a >= b,
    "<=": lambda a, b: a <= b,
}
_LARGEST = 1 << 40


def evaluate(machine: Machine, term: Term, frame: Frame) -> Value:
    """The value of an expression."""
    kind = term[0]
    if kind == LITERAL:
        return Known(term[1])
    if kind == NAME:
        return _name(machine, term[1], term[-1], frame)
    if kind == MEMBER:
        return _member(machine, term, frame)
    if kind == CALL:
        return called(machine, term, frame)
    if kind == CHOICE:
        return _choice(machine, term, frame)
    if kind == BINARY:
        return _binary(machine, term, frame)
    if kind == LIST:
        return _list(machine, term, frame)
    if kind == INDEX:
        return _index(machine, term, frame)
    if kind == TUPLE:
        items: dict[str, Value] = {}
        for index, (label, item) in enumerate(term[1][:MOST_ITEMS]):
            items[str(index)] = value = evaluate(machine, item, frame)
            if label:
                items[label] = value
        return Aggregate(items)
    if kind == CLOSURE:
        return Code(term)
    if kind == NOT:
        value = evaluate(machine, term[1], frame)
        return Known(not value.value) if isinstance(value, Known) and isinstance(value.value, bool) else UNKNOWN
    return UNKNOWN


def _name(machine: Machine, name: str, at: Span, frame: Frame) -> Value:
    variable = frame.find(name)
    if variable is not None:
        return variable[1]
    if name == "self":
        return frame.me if frame.me is not None else Instance(frame.within)
    if name == "Self":
        return Instance(frame.within)
    for within in dict.fromkeys((frame.within, "")):
        value = _declared(machine, within, name, at, frame)
        if value is not None:
            return value
    if frame.me is not None:
        value = member_of(machine, frame.me, name, at, frame)
        if value is not None:
            return value
    if name in machine.unit.types:
        return Instance(name)
    return Symbol(name, frame.within)


def _declared(machine: Machine, within: str, name: str, at: Span, frame: Frame) -> Value | None:
    """The value of a property, or of a constant outside of types."""
    declaring_type = machine.type_of(within)
    if declaring_type is not None and name in declaring_type.computed:
        return machine.call(machine, declaring_type.computed[name], {}, frame, at, None)
    value = machine.property(within, name)
    if (value is None or value == NIL or value is UNKNOWN) and declaring_type is not None and name in declaring_type.members:
        kind = declaring_type.members[name].type
        type_node = machine.typed(kind, name, Span(0, 0), (within, name))
        return type_node if type_node is not None else value if value == NIL and not kind else Symbol(name, within)
    member = declaring_type.members.get(name) if declaring_type is not None else None
    if value is UNKNOWN or (member is not None and member.variable and _may_change(machine, within, name, value, member.open)):
        return Symbol(name, within)
    return value


def _may_change(machine: Machine, within: str, name: str, value: Value | None, open_: bool) -> bool:
    """Whether a variable property is more likely something else when it is used: a switch, a size, a count that begins as 1; what other
    files choose."""
    field = machine.now.get(within, {}).get(name)
    if field is not None and field.by == machine.root:
        return False
    if isinstance(value, Aggregate):
        return all(isinstance(item, Known) for item in value.items.values())
    number = value.value if isinstance(value, Known) else None
    if isinstance(number, str):
        return open_
    return isinstance(number, (bool, float)) or (type(number) is int and (number == 1 or not about_samples(name)))


def _member(machine: Machine, term: Term, frame: Frame) -> Value:
    _, target, name, at = term
    if target is None:
        return Known(name)
    if target[0] == NAME and target[1][:3] in ("MTL", "CAM") and frame.find(target[1]) is None:
        return Known(name)
    owner = owner_of(machine, target, name, frame)
    if isinstance(owner, Instance):
        declaring_type = machine.type_of(owner.type)
        if declaring_type is not None and name in declaring_type.cases:
            return Known(f"{owner.type}.{name}")
        value = _declared(machine, owner.type, name, at, frame)
        return value if value is not None else Symbol(name, owner.type)
    if isinstance(owner, Known) and isinstance(owner.value, str) and name == "rawValue":
        return _raw(machine, owner.value, frame)
    if isinstance(owner, Symbol) and name.endswith(("Attachment", "Attachments")):
        owner = adopted(machine, owner, target, name, frame)
    member = member_of(machine, owner, name, at, frame)
    if member is not None:
        return member
    if name == "texture" and "drawable" in last_name(target).lower():
        return _drawable_texture(machine, at, frame)
    return Symbol(f"{_words(target, machine)}.{name}", frame.whose if isinstance(owner, Symbol) else frame.within)


def owner_of(machine: Machine, target: Term, name: str, frame: Frame) -> Value:
    """What a member is of: of `self`, the type where it declares the member."""
    if target[:2] == (NAME, "self"):
        declaring_type = machine.type_of(frame.within)
        if declaring_type is not None and (name in declaring_type.members or name in declaring_type.computed):
            return Instance(frame.within)
    return evaluate(machine, target, frame)


def _drawable_texture(machine: Machine, at: Span, frame: Frame) -> Value:
    return member_of(machine, machine.made("drawable", "drawable", at, 0, False), "texture", at, frame) or UNKNOWN


def _raw(machine: Machine, name: str, frame: Frame) -> Value:
    """The raw value of an enumeration's case; an option set's are as good as its names."""
    of, _, case = name.rpartition(".")
    declaring_type = machine.type_of(of) if of else None
    if declaring_type is None:
        return Known(name)
    raw = declaring_type.cases.get(case)
    return evaluate(machine, raw, frame) if raw is not None else UNKNOWN


def _words(term: Term, machine: Machine) -> str:
    written = machine.text[term[-1].start : term[-1].end]
    return "".join(written.split()).replace("?", "").replace("!", "").removeprefix("self.")[:80]


def _choice(machine: Machine, term: Term, frame: Frame) -> Value:
    goes = decided(machine, term[1], term[2], term[3], frame)
    if goes is not None:
        return evaluate(machine, term[2] if goes else term[3], frame)
    one, other = evaluate(machine, term[2], frame), evaluate(machine, term[3], frame)
    return joined(one, other, "sampleCount" if _counts(one, other) else "")


def _counts(one: Value, other: Value) -> bool:
    """Whether a choice is between one sample and several."""
    values = {value.value for value in (one, other) if isinstance(value, Known) and type(value.value) is int}
    return 1 in values and bool(values & {2, 4, 8})


def _binary(machine: Machine, term: Term, frame: Frame) -> Value:
    sign = term[1]
    left, right = evaluate(machine, term[2], frame), evaluate(machine, term[3], frame)
    if sign == "??":
        return right if left == NIL else left
    if not isinstance(left, Known) or not isinstance(right, Known):
        return UNKNOWN
    one, other = left.value, right.value
    if sign == "|" and isinstance(one, (str, tuple)) and isinstance(other, (str, tuple)):
        return Known(_options(one) + _options(other))
    if isinstance(one, bool) and isinstance(other, bool) and sign in ("&&", "||"):
        return Known((one and other) if sign == "&&" else (one or other))
    if sign in ("==", "!="):
        return Known((one == other) == (sign == "=="))
    if not isinstance(one, (int, float)) or not isinstance(other, (int, float)):
        return UNKNOWN
    if sign in _COMPARED:
        return Known(bool(_COMPARED[sign](one, other)))
    result: int | float | None = None
    if sign == "+":
        result = one + other
    elif sign == "-":
        result = one - other
    elif sign == "*":
        result = one * other
    elif sign == "/" and other:
        result = one // other if isinstance(one, int) and isinstance(other, int) else one / other
    return Known(result) if result is not None and abs(result) < _LARGEST else UNKNOWN


def _options(value: str | tuple[str, ...]) -> tuple[str, ...]:
    return value if isinstance(value, tuple) else (value,)


def _list(machine: Machine, term: Term, frame: Frame) -> Value:
    """An option set, where every item is one."""
    names: list[str] = []
    whole = True
    for item in term[1]:
        value = evaluate(machine, item, frame)
        if isinstance(value, Known) and isinstance(value.value, str) and item[0] == MEMBER:
            names.append(value.value)
        else:
            whole = False
            if isinstance(value, Texture):
                machine.escaped.add(id(value))
    return Known(tuple(names)) if whole else UNKNOWN


def _index(machine: Machine, term: Term, frame: Frame) -> Value:
    owner = evaluate(machine, term[1], frame)
    at = evaluate(machine, term[2], frame)
    element = index_of(machine, owner, at, term[-1])
    if element is not None:
        return element
    place = cell(term[1], frame)
    value = machine.property(place[0], place[1]) if place is not None else None
    if value is not None:
        return value
    return Symbol(_words(term, machine), frame.whose)


def cell(term: Term, frame: Frame) -> tuple[str, str] | None:
    """The property that stands for all items of a collection."""
    if term[0] == NAME and frame.find(term[1]) is None:
        return frame.within, f"{term[1]}[]"
    if term[0] == MEMBER and term[1] is not None and term[1][:2] == (NAME, "self"):
        return frame.within, f"{term[2]}[]"
    return None


def declares(machine: Machine, within: str, name: str) -> bool:
    """Whether a type has a stored property of that name."""
    declaring_type = machine.type_of(within)
    return declaring_type is not None and name in declaring_type.members

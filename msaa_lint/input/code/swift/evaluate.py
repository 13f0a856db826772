"""Evaluates Swift expressions, and assigns their values."""

from __future__ import annotations

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.operators import ARITHMETIC, COMPARISONS

from .calls import evaluate_call
from .conditions import about_samples, decide, last_name
from .interpreter import Interpreter
from .members import adopt_descriptor, drawable, index_of, member_of, set_index, set_member
from .terms import BINARY, CALL, CHOICE, CLOSURE, INDEX, LIST, LITERAL, MAX_ITEMS, MEMBER, NAME, NOT, TUPLE, Term, name_at
from .values import (
    NIL,
    UNKNOWN,
    Aggregate,
    CallFrame,
    Code,
    Constant,
    Instance,
    Symbol,
    Texture,
    Value,
    aggregate,
    join,
    option_set,
    options,
)

_LARGEST = 1 << 40


def evaluate(interpreter: Interpreter, term: Term, frame: CallFrame) -> Value:
    """Returns the value of an expression."""
    interpreter.work.spend()
    kind = term[0]
    if kind == LITERAL:
        return Constant(term[1])
    if kind == NAME:
        return _name(interpreter, term[1], term[-1], frame)
    if kind == MEMBER:
        return _member(interpreter, term, frame)
    if kind == CALL:
        return evaluate_call(interpreter, term, frame)
    if kind == CHOICE:
        return _choice(interpreter, term, frame)
    if kind == BINARY:
        return _binary(interpreter, term, frame)
    if kind == LIST:
        return _list(interpreter, term, frame)
    if kind == INDEX:
        return _index(interpreter, term, frame)
    if kind == TUPLE:
        items: dict[str, Value] = {}
        for index, (label, item) in enumerate(term[1][:MAX_ITEMS]):
            items[str(index)] = value = evaluate(interpreter, item, frame)
            if label:
                items[label] = value
        return aggregate(items)
    if kind == CLOSURE:
        return Code(term)
    if kind == NOT:
        value = evaluate(interpreter, term[1], frame)
        return Constant(not value.value) if isinstance(value, Constant) and isinstance(value.value, bool) else UNKNOWN
    return UNKNOWN


def _name(interpreter: Interpreter, name: str, at: Span, frame: CallFrame) -> Value:
    variable = frame.find(name)
    if variable is not None:
        return variable[1]
    if name == "self":
        return frame.self_value if frame.self_value is not None else Instance(frame.type_name)
    if name == "Self":
        return Instance(frame.type_name)
    for type_name in dict.fromkeys((frame.type_name, "")):
        value = _declared(interpreter, type_name, name, at, frame)
        if value is not None:
            return value
    if frame.self_value is not None:
        value = member_of(interpreter, frame.self_value, name, at, frame)
        if value is not None:
            return value
    if name in interpreter.unit.types:
        return Instance(name)
    return Symbol(name, frame.type_name)


def _declared(interpreter: Interpreter, type_name: str, name: str, at: Span, frame: CallFrame) -> Value | None:
    """Returns the value of a property or a global constant, or None."""
    declaring_type = interpreter.type_of(type_name)
    if name in declaring_type.computed:
        return interpreter.call(interpreter, declaring_type.computed[name], {}, frame, at, None)
    value = interpreter.property(type_name, name)
    member = declaring_type.members.get(name)
    if (value is None or value == NIL or value is UNKNOWN) and member is not None:
        type_node = interpreter.typed_object(member.type, name, Span(0, 0), (type_name, name))
        return type_node if type_node is not None else value if value == NIL and not member.type else Symbol(name, type_name)
    if value is UNKNOWN or (member is not None and member.variable and _may_change(interpreter, type_name, name, value, member.open)):
        return Symbol(name, type_name)
    return value


def _may_change(interpreter: Interpreter, type_name: str, name: str, value: Value | None, open_: bool) -> bool:
    """Returns whether a variable property probably changes before it is used: a switch, a size, a count that starts as 1, or a value
    that other files choose."""
    field = interpreter.current_properties.get(type_name, {}).get(name)
    if field is not None and field.by == interpreter.root:
        return False
    if isinstance(value, Aggregate):
        return all(isinstance(item, Constant) for item in value.items.values())
    number = value.value if isinstance(value, Constant) else None
    if isinstance(number, str):
        return open_
    return isinstance(number, (bool, float)) or (type(number) is int and (number == 1 or not about_samples(name)))


def _member(interpreter: Interpreter, term: Term, frame: CallFrame) -> Value:
    _, target, name, at = term
    if target is None:
        return Constant(name)
    if target[0] == NAME and target[1][:3] in ("MTL", "CAM") and frame.find(target[1]) is None:
        return Constant(name)
    owner = owner_of(interpreter, target, name, frame)
    if isinstance(owner, Instance):
        if name in interpreter.type_of(owner.type).cases:
            return Constant(f"{owner.type}.{name}")
        value = _declared(interpreter, owner.type, name, at, frame)
        return value if value is not None else Symbol(name, owner.type)
    if isinstance(owner, Constant) and isinstance(owner.value, str) and name == "rawValue":
        return _raw(interpreter, owner.value, frame)
    if isinstance(owner, Symbol) and name.endswith(("Attachment", "Attachments")):
        owner = adopt_descriptor(interpreter, owner, target, name, frame)
    member = member_of(interpreter, owner, name, at, frame)
    if member is not None:
        return member
    if name == "texture" and "drawable" in last_name(target).lower():
        return drawable(interpreter, at)
    return Symbol(f"{_words(target, interpreter)}.{name}", frame.function_name if isinstance(owner, Symbol) else frame.type_name)


def owner_of(interpreter: Interpreter, target: Term, name: str, frame: CallFrame) -> Value:
    """Returns the owner of a member; for `self`, the type if it declares the member."""
    if target[:2] == (NAME, "self"):
        declaring_type = interpreter.type_of(frame.type_name)
        if name in declaring_type.members or name in declaring_type.computed:
            return Instance(frame.type_name)
    return evaluate(interpreter, target, frame)


def _raw(interpreter: Interpreter, name: str, frame: CallFrame) -> Value:
    """Returns the raw value of an enumeration case. For option sets, the names are enough."""
    of, _, case = name.rpartition(".")
    if not of or of not in interpreter.unit.types:
        return Constant(name)
    raw = interpreter.unit.types[of].cases.get(case)
    return evaluate(interpreter, raw, frame) if raw is not None else UNKNOWN


def _words(term: Term, interpreter: Interpreter) -> str:
    written = interpreter.text[term[-1].start : term[-1].end]
    return "".join(written.split()).replace("?", "").replace("!", "").removeprefix("self.")[:80]


def _choice(interpreter: Interpreter, term: Term, frame: CallFrame) -> Value:
    goes = decide(interpreter, term[1], term[2], term[3], frame)
    if goes is not None:
        return evaluate(interpreter, term[2] if goes else term[3], frame)
    one, other = evaluate(interpreter, term[2], frame), evaluate(interpreter, term[3], frame)
    return join(one, other, "sampleCount" if _counts(one, other) else "")


def _counts(one: Value, other: Value) -> bool:
    """Returns whether a choice is between one sample and several."""
    values = {value.value for value in (one, other) if isinstance(value, Constant) and type(value.value) is int}
    return 1 in values and bool(values & {2, 4, 8})


def _binary(interpreter: Interpreter, term: Term, frame: CallFrame) -> Value:
    sign = term[1]
    left, right = evaluate(interpreter, term[2], frame), evaluate(interpreter, term[3], frame)
    if sign == "??":
        return right if left == NIL else left
    if not isinstance(left, Constant) or not isinstance(right, Constant):
        return UNKNOWN
    one, other = left.value, right.value
    if sign == "|" and isinstance(one, (str, tuple)) and isinstance(other, (str, tuple)):
        return option_set(options(one) + options(other))
    if isinstance(one, bool) and isinstance(other, bool) and sign in ("&&", "||"):
        return Constant((one and other) if sign == "&&" else (one or other))
    if sign in ("==", "!="):
        return Constant((one == other) == (sign == "=="))
    if not isinstance(one, (int, float)) or not isinstance(other, (int, float)):
        return UNKNOWN
    if sign in COMPARISONS:
        return Constant(bool(COMPARISONS[sign](one, other)))
    result: int | float | None = None
    if sign in ARITHMETIC:
        result = ARITHMETIC[sign](one, other)
    elif sign == "/" and other:
        result = one // other if isinstance(one, int) and isinstance(other, int) else one / other
    return Constant(result) if result is not None and abs(result) < _LARGEST else UNKNOWN


def _list(interpreter: Interpreter, term: Term, frame: CallFrame) -> Value:
    """Returns an option set if every item is an option."""
    names: list[str] = []
    for item in term[1]:
        value = evaluate(interpreter, item, frame)
        if isinstance(value, Constant) and isinstance(value.value, str) and item[0] == MEMBER:
            names.append(value.value)
        elif isinstance(value, Texture):
            interpreter.escaped.add(id(value))
    return Constant(tuple(names)) if len(names) == len(term[1]) else UNKNOWN


def _index(interpreter: Interpreter, term: Term, frame: CallFrame) -> Value:
    owner = evaluate(interpreter, term[1], frame)
    at = evaluate(interpreter, term[2], frame)
    element = index_of(interpreter, owner, at, term[-1])
    if element is not None:
        return element
    place = cell(term[1], frame)
    value = interpreter.property(place[0], place[1]) if place is not None else None
    if value is not None:
        return value
    return Symbol(_words(term, interpreter), frame.function_name)


def cell(term: Term, frame: CallFrame) -> tuple[str, str] | None:
    """Returns the property that stands for all elements of a collection, or None."""
    if term[0] == NAME and frame.find(term[1]) is None:
        return frame.type_name, f"{term[1]}[]"
    if term[0] == MEMBER and term[1] is not None and term[1][:2] == (NAME, "self"):
        return frame.type_name, f"{term[2]}[]"
    return None


def assign(interpreter: Interpreter, sign: str, target: Term, value: Term, frame: CallFrame) -> None:
    """Executes an assignment."""
    computed = evaluate(interpreter, value, frame)
    new_value = computed if sign == "=" else UNKNOWN
    kind = target[0]
    place = value[-1]
    if kind == NAME:
        variable = frame.find(target[1])
        if variable is not None:
            interpreter.name_value(new_value, target[1], frame.function, frame.rank)
            interpreter.undo_log.write(variable[0].locals, target[1], new_value)
            return
        is_declared = target[1] in interpreter.type_of(frame.type_name).members
        owner = None if is_declared else frame.self_value
        if owner is not None and set_member(interpreter, owner, target[1], new_value, target[-1], place):
            return
        outer = not is_declared and target[1] in interpreter.type_of("").members
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
            element = new_value.items.get(str(index), UNKNOWN)
            if item[0] == NAME and frame.find(item[1]) is not None:
                interpreter.undo_log.write(frame.locals, item[1], element)
            elif item[0] == NAME:
                interpreter.set_property(frame.type_name, item[1], element, place)

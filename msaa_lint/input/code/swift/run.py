"""Swift's statements, gone through in order: what they leave in variables and members."""

from __future__ import annotations

from msaa_lint.core.text.span import Span

from .assign import set_target
from .conditions import decided, hold, truth
from .configurations import about_samples
from .evaluate import evaluate
from .frame_state import Frame
from .machine import OBJECTS, Machine, agreed
from .terms import BIND, BLOCK, CALL, CASES, CLOSURE, DO, FUNC, GUARD, IF, LEAVE, LET, LOOP, MEMBER, NAME, RETURN, SET, Function, Term
from .values import NIL, UNKNOWN, Aggregate, Code, Known, Symbol, Value

DEEPEST_CALL = 3
"""Calls within calls that are followed."""

DEEPEST_CLOSURE = 8
"""Closures and calls within each other that are gone through."""


def run(machine: Machine, statements: tuple[Term, ...], frame: Frame) -> bool:
    """Goes through statements; whether they end in a return or a jump."""
    for term in statements:
        machine.steps -= 1
        if machine.steps < 0:
            return True
        if _step(machine, term, frame):
            return True
    return False


def _step(machine: Machine, term: Term, frame: Frame) -> bool:
    kind = term[0]
    if kind == DO:
        evaluate(machine, term[1], frame)
    elif kind == SET:
        set_target(machine, term[1], term[2], term[3], frame)
    elif kind == LET:
        _declare(machine, term, frame)
    elif kind == IF:
        return _branch(machine, term, frame)
    elif kind == GUARD:
        if truth(machine, term[1], frame) is False:
            run(machine, term[2], frame)
            return True
        hold(machine, term[1])
    elif kind == RETURN:
        frame.returned.append(evaluate(machine, term[1], frame) if term[1] is not None else NIL)
        return True
    elif kind == LEAVE:
        return True
    elif kind == CASES:
        return _cases(machine, term, frame)
    elif kind == BLOCK:
        return run(machine, term[1], frame)
    elif kind == LOOP:
        for name in term[1]:
            if name:
                machine.journal.write(frame.locals, name, Symbol(name, frame.whose))
        machine.unsure += 1
        run(machine, term[2], frame)
        machine.unsure -= 1
    elif kind == FUNC:
        function: Function = term[1]
        names = tuple(parameter.name for parameter in function.parameters)
        machine.journal.write(frame.locals, function.name, Code((CLOSURE, names, machine.body(function), function.at), function))
    return False


def _declare(machine: Machine, term: Term, frame: Frame) -> None:
    names, kind, value, at = term[1:]
    if value is not None:
        initial = evaluate(machine, _begun(kind, value), frame)
        if len(names) > 1:
            for index, name in enumerate(names):
                item = initial.items.get(str(index), UNKNOWN) if isinstance(initial, Aggregate) else UNKNOWN
                machine.variable(frame, name, item)
            return
    else:
        type_node = machine.typed(kind, names[0], at, frame.way)
        if type_node is None and not frame.function and not frame.within:
            return  # of a fragment, maybe a property that a function of it sets
        initial = type_node if type_node is not None else NIL
    machine.variable(frame, names[0], initial)


def _begun(kind: str, value: Term) -> Term:
    """`.init()` with the type that is declared."""
    if value[0] == CALL and value[1][:3] == (MEMBER, None, "init") and kind in OBJECTS:
        return CALL, (NAME, kind, value[1][-1]), value[2], value[3], value[-1]
    return value


def _branch(machine: Machine, term: Term, frame: Frame) -> bool:
    """An `if`: the way that it goes, or both; the names that it binds end with it."""
    bound = [(condition[1], frame.locals.get(condition[1])) for condition in term[1] if condition[0] == BIND]
    goes = decided(machine, term[1], term[2], term[3], frame)
    left = run(machine, term[2] if goes else term[3], frame) if goes is not None else _both(machine, term[2], term[3], frame)
    for name, value in bound:
        machine.journal.write(frame.locals, name, value)
    return left


def _both(machine: Machine, then: tuple[Term, ...], otherwise: tuple[Term, ...], frame: Frame) -> bool:
    """Goes through both branches, from the same beginning; what they leave differently is unknown."""
    journal = machine.journal
    machine.unsure += 1
    mark = journal.mark()
    left = run(machine, then, frame)
    first = journal.back(mark)
    other_left = run(machine, otherwise, frame)
    machine.unsure -= 1
    if left:
        return other_left
    second = journal.back(mark)
    if other_left:
        journal.again(first)
    else:
        journal.join(first, second)
    return False


def _cases(machine: Machine, term: Term, frame: Frame) -> bool:
    journal = machine.journal
    mark = journal.mark()
    machine.unsure += 1
    joined_writes = None
    for body in term[1]:
        if run(machine, body, frame):
            journal.back(mark)
            continue
        writes = journal.back(mark)
        if joined_writes is None:
            joined_writes = writes
        else:
            journal.join(joined_writes, writes)
            joined_writes = journal.back(mark)
    machine.unsure -= 1
    if joined_writes is None:
        return bool(term[1])
    journal.again(joined_writes)
    return False


def call(machine: Machine, function: Function, arguments: dict[str, Value], frame: Frame, site: Span, me: Value | None = None) -> Value:
    """What a function of the file gives for arguments, by going through it where it is called."""
    machine.inlined.add(function.at.start)
    machine.called.add(function.at.start)
    if frame.rank >= DEEPEST_CALL or frame.depth >= DEEPEST_CLOSURE or machine.steps < 0:
        return UNKNOWN
    inner = Frame(function.within, function.name, frame.rank + 1, machine.way(frame, site.start), None, me)
    inner.depth = frame.depth + 1
    enter(machine, function, arguments, inner)
    result = body_of(machine, machine.body(function), inner)
    return labelled(machine, function, result)


def labelled(machine: Machine, function: Function, result: Value) -> Value:
    """What a function gives, with the labels of the tuple that it says it gives."""
    if not isinstance(result, Aggregate) or len(function.gives) < 2:
        return result
    items = {label: result.items.get(str(index), UNKNOWN) for index, label in enumerate(function.gives)}
    machine.tuples[function.at.start] = items
    return Aggregate({**result.items, **items})


def enter(machine: Machine, function: Function, arguments: dict[str, Value], frame: Frame) -> None:
    """Gives a function's parameters their values."""
    for parameter in function.parameters:
        value = arguments.get(parameter.name)
        if value is None or value is UNKNOWN:
            value = machine.typed(parameter.type, parameter.name, function.at, frame.way)
        if value is None and parameter.default is not None:
            default = evaluate(machine, parameter.default, frame)
            several = isinstance(default, Known) and default != Known(1) and about_samples(parameter.name)
            if arguments or several:
                value = default
        frame.locals[parameter.name] = value if value is not None else Symbol(parameter.name, frame.whose)


def body_of(machine: Machine, statements: tuple[Term, ...], frame: Frame) -> Value:
    """What a body gives: its single expression, or what it returns."""
    if len(statements) == 1 and statements[0][0] == DO:
        return evaluate(machine, statements[0][1], frame)
    run(machine, statements, frame)
    return agreed(frame.returned)


def call_closure(machine: Machine, code: Code, arguments: tuple[Value, ...] | dict[str, Value], frame: Frame, site: Span) -> Value:
    """What a closure gives for arguments, or a function in a function for its parameters."""
    if machine.steps < 0 or frame.depth >= DEEPEST_CLOSURE:
        return UNKNOWN
    inner = Frame(frame.within, frame.function, frame.rank, machine.way(frame, site.start), frame, frame.me)
    inner.depth = frame.depth + 1
    if isinstance(arguments, dict):
        if code.function is not None:
            inner.rank += 1
            enter(machine, code.function, arguments, inner)
        return body_of(machine, code.term[2], inner)
    names = code.term[1]
    for index, value in enumerate(arguments):
        inner.locals[f"${index}"] = value
        if index < len(names) and names[index]:
            inner.locals[names[index]] = value
    return body_of(machine, code.term[2], inner)

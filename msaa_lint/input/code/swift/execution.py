"""Executes Swift statements."""

from __future__ import annotations

from functools import partial, reduce

from msaa_lint.core.text.span import Span

from .conditions import about_samples, decide, note_capabilities, truth
from .evaluate import assign, evaluate
from .interpreter import OBJECTS, Interpreter
from .terms import BIND, BLOCK, CALL, CASES, CLOSURE, DO, FUNC, GUARD, IF, LEAVE, LET, LOOP, MEMBER, NAME, RETURN, SET, Function, Term
from .values import NIL, UNKNOWN, Aggregate, CallFrame, Code, Constant, Symbol, Value, aggregate, join

MAX_DEPTH_CALL = 3
"""The maximum depth of function calls that are executed."""

MAX_DEPTH_CLOSURE = 8
"""The maximum depth of closures and calls that are executed."""


def run_statements(interpreter: Interpreter, statements: tuple[Term, ...], frame: CallFrame) -> bool:
    """Executes statements. Returns whether they end in a return or a jump."""
    for term in statements:
        interpreter.work.spend()
        if _step(interpreter, term, frame):
            return True
    return False


def _step(interpreter: Interpreter, term: Term, frame: CallFrame) -> bool:
    kind = term[0]
    if kind == DO:
        evaluate(interpreter, term[1], frame)
    elif kind == SET:
        assign(interpreter, term[1], term[2], term[3], frame)
    elif kind == LET:
        _declare(interpreter, term, frame)
    elif kind == IF:
        return _branch(interpreter, term, frame)
    elif kind == GUARD:
        if truth(interpreter, term[1], frame) is False:
            run_statements(interpreter, term[2], frame)
            return True
        note_capabilities(interpreter, term[1])
    elif kind == RETURN:
        frame.returned.append(evaluate(interpreter, term[1], frame) if term[1] is not None else NIL)
        return True
    elif kind == LEAVE:
        return True
    elif kind == CASES:
        return _cases(interpreter, term, frame)
    elif kind == BLOCK:
        return run_statements(interpreter, term[1], frame)
    elif kind == LOOP:
        for name in term[1]:
            if name:
                interpreter.undo_log.write(frame.locals, name, Symbol(name, frame.function_name))
        interpreter.undecided_depth += 1
        run_statements(interpreter, term[2], frame)
        interpreter.undecided_depth -= 1
    elif kind == FUNC:
        function: Function = term[1]
        names = tuple(parameter.name for parameter in function.parameters)
        interpreter.undo_log.write(frame.locals, function.name, Code((CLOSURE, names, interpreter.body(function), function.at), function))
    return False


def _declare(interpreter: Interpreter, term: Term, frame: CallFrame) -> None:
    names, kind, value, at = term[1:]
    if value is not None:
        initial = evaluate(interpreter, _begun(kind, value), frame)
        if len(names) > 1:
            for index, name in enumerate(names):
                item = initial.items.get(str(index), UNKNOWN) if isinstance(initial, Aggregate) else UNKNOWN
                interpreter.variable(frame, name, item)
            return
    else:
        type_node = interpreter.typed_object(kind, names[0], at, frame.path)
        if type_node is None and not frame.function and not frame.type_name:
            return  # In a fragment, it may be a property that a function sets.
        initial = type_node if type_node is not None else NIL
    interpreter.variable(frame, names[0], initial)


def _begun(kind: str, value: Term) -> Term:
    """Returns `.init()` with the declared type."""
    if value[0] == CALL and value[1][:3] == (MEMBER, None, "init") and kind in OBJECTS:
        return CALL, (NAME, kind, value[1][-1]), value[2], value[3], value[-1]
    return value


def _branch(interpreter: Interpreter, term: Term, frame: CallFrame) -> bool:
    """Executes the branch of an `if` that is taken, or both. The names that it binds go out of scope."""
    bound = [(condition[1], frame.locals.get(condition[1])) for condition in term[1] if condition[0] == BIND]
    goes = decide(interpreter, term[1], term[2], term[3], frame)
    if goes is None:
        left = _both(interpreter, term[2], term[3], frame)
    else:
        left = run_statements(interpreter, term[2] if goes else term[3], frame)
    for name, value in bound:
        interpreter.undo_log.write(frame.locals, name, value)
    return left


def _both(interpreter: Interpreter, then: tuple[Term, ...], otherwise: tuple[Term, ...], frame: CallFrame) -> bool:
    """Executes both branches from the same state; values that differ afterwards are unknown."""
    undo_log = interpreter.undo_log
    interpreter.undecided_depth += 1
    mark = undo_log.mark()
    left = run_statements(interpreter, then, frame)
    first = undo_log.undo(mark)
    other_left = run_statements(interpreter, otherwise, frame)
    interpreter.undecided_depth -= 1
    if left:
        return other_left
    second = undo_log.undo(mark)
    if other_left:
        undo_log.redo(first)
    else:
        undo_log.join(first, second)
    return False


def _cases(interpreter: Interpreter, term: Term, frame: CallFrame) -> bool:
    undo_log = interpreter.undo_log
    mark = undo_log.mark()
    interpreter.undecided_depth += 1
    joined_writes = None
    for body in term[1]:
        if run_statements(interpreter, body, frame):
            undo_log.undo(mark)
            continue
        writes = undo_log.undo(mark)
        if joined_writes is None:
            joined_writes = writes
        else:
            undo_log.join(joined_writes, writes)
            joined_writes = undo_log.undo(mark)
    interpreter.undecided_depth -= 1
    if joined_writes is None:
        return bool(term[1])
    undo_log.redo(joined_writes)
    return False


def call(
    interpreter: Interpreter, function: Function, arguments: dict[str, Value], frame: CallFrame, site: Span, self_value: Value | None = None
) -> Value:
    """Returns the result of a function of the file, which is executed."""
    interpreter.inlined.add(function.at.start)
    interpreter.called_functions.add(function.at.start)
    if frame.rank >= MAX_DEPTH_CALL or frame.depth >= MAX_DEPTH_CLOSURE:
        return UNKNOWN
    inner = CallFrame(function.type_name, function.name, frame.rank + 1, interpreter.call_path(frame, site.start), None, self_value)
    inner.depth = frame.depth + 1
    bind_parameters(interpreter, function, arguments, inner)
    result = run_body(interpreter, interpreter.body(function), inner)
    return with_labels(interpreter, function, result)


def with_labels(interpreter: Interpreter, function: Function, result: Value) -> Value:
    """Returns a result with the labels of the declared tuple."""
    if not isinstance(result, Aggregate) or len(function.gives) < 2:
        return result
    items = {label: result.items.get(str(index), UNKNOWN) for index, label in enumerate(function.gives)}
    interpreter.tuples[function.at.start] = items
    return aggregate({**result.items, **items})


def bind_parameters(interpreter: Interpreter, function: Function, arguments: dict[str, Value], frame: CallFrame) -> None:
    interpreter.work.spend(len(function.parameters))
    for parameter in function.parameters:
        value = arguments.get(parameter.name)
        if value is None or value is UNKNOWN:
            value = interpreter.typed_object(parameter.type, parameter.name, function.at, frame.path)
        if value is None and parameter.default is not None:
            default = evaluate(interpreter, parameter.default, frame)
            several = isinstance(default, Constant) and default != Constant(1) and about_samples(parameter.name)
            if arguments or several:
                value = default
        frame.locals[parameter.name] = value if value is not None else Symbol(parameter.name, frame.function_name)


def run_body(interpreter: Interpreter, statements: tuple[Term, ...], frame: CallFrame) -> Value:
    """Returns the result of a body: its single expression, or the returned value."""
    if len(statements) == 1 and statements[0][0] == DO:
        return evaluate(interpreter, statements[0][1], frame)
    run_statements(interpreter, statements, frame)
    return reduce(partial(join, optional=True), frame.returned) if frame.returned else NIL


def call_closure(
    interpreter: Interpreter, code: Code, arguments: tuple[Value, ...] | dict[str, Value], frame: CallFrame, site: Span
) -> Value:
    """Returns the result of a closure for arguments, or of a nested function for parameters by name."""
    if frame.depth >= MAX_DEPTH_CLOSURE:
        return UNKNOWN
    inner = CallFrame(frame.type_name, frame.function, frame.rank, interpreter.call_path(frame, site.start), frame, frame.self_value)
    inner.depth = frame.depth + 1
    if isinstance(arguments, dict):
        if code.function is not None:
            inner.rank += 1
            bind_parameters(interpreter, code.function, arguments, inner)
        return run_body(interpreter, code.term[2], inner)
    names = code.term[1]
    for index, value in enumerate(arguments):
        inner.locals[f"${index}"] = value
        if index < len(names) and names[index]:
            inner.locals[names[index]] = value
    return run_body(interpreter, code.term[2], inner)

"""Loops over known sample counts: over a list, or halving a count until its bit is set."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import ASSIGN, BINARY, DECLARE, DO, UNARY, Term

from .arithmetic import arithmetic
from .masks import Bindings, Expressions, Mask, Order, name_of
from .statements import statements

MAX_ROUNDS = 16
"""The maximum number of iterations; there are seven counts."""

_TO_THE_END = re.compile(r"size|Size|count|Count|_countof|end\b|ARRAY")


def parts_of(loop: Term) -> tuple[Term | None, Term | None, Sequence[Term]]:
    """Returns the condition of a loop, its step, and what it repeats between them."""
    body = list(loop[3])
    test = body.pop(0)[1] if body and body[0][0] == DO and not _is_step(body[0][1]) else None
    step = body.pop()[1] if body and body[-1][0] == DO and _is_step(body[-1][1]) else None
    inner = list(statements(body))
    if step is None and inner and inner[-1][0] == DO and _is_step(inner[-1][1]):
        step = inner.pop()[1]
    return test, step, inner


def loop_iterations(loop: Term, expressions: Expressions, bindings: Bindings) -> Iterator[Bindings]:
    """Yields the values of variables in each iteration of a loop over counts; nothing if its bounds
    are unknown.
    """
    declared, over = loop[1], loop[2]
    if over is not None:
        order = expressions.value(over, bindings)
        name = declared[0][2] if len(declared) == 1 else ""
        for count in order.counts[:MAX_ROUNDS] if isinstance(order, Order) and name else ():
            yield {**bindings, name: count}
        return
    condition, step, _ = parts_of(loop)
    start = _start(loop, step, expressions, bindings)
    if start is None or step is None:
        return
    name, value = start
    for _ in range(MAX_ROUNDS):
        inner = {**bindings, name: value}
        holds = expressions.value(condition, inner) if condition is not None else 1
        if holds == 0 or not (
            isinstance(holds, int)
            or (condition is not None and _TO_THE_END.search(expressions.written(condition)))
        ):
            return
        yield inner
        next_step = _stepped(step, expressions, inner)
        if next_step is None or next_step[0] != name or next_step[1] < 0:
            return
        value = next_step[1]


def halving_loop(
    loop: Term, expressions: Expressions, bindings: Bindings
) -> tuple[str, list[tuple[Mask, int, Span]]] | None:
    """Returns the variable of `while (!(counts & c)) c >>= 1;` and the tested counts in order, or
    None.
    """
    condition, step, inner = parts_of(loop)
    if condition is None or step is None or inner:
        return None
    start = _start(loop, step, expressions, bindings)
    if start is None:
        return None
    name, value = start
    tests: list[tuple[Mask, int, Span]] = []
    for _ in range(MAX_ROUNDS):
        values = {**bindings, name: value}
        count = len(tests)
        for part in _conjuncts(condition):
            negated = expressions.negated(part)
            mask = expressions.value(negated, values)
            if isinstance(mask, Mask) and mask.bit is not None and negated is not None:
                tests.append((mask, value, negated[-1]))
                continue
            holds = expressions.value(part, values)
            if holds == 0:
                return (name, tests) if tests else None
            if not isinstance(holds, int):
                return None
        after = _stepped(step, expressions, values)
        if len(tests) == count or after is None or after[0] != name or after[1] < 1:
            break
        value = after[1]
    return (name, tests) if tests else None


def _is_step(term: Term) -> bool:
    return bool(term[0] == ASSIGN or (term[0] == UNARY and term[1][-2:] in ("++", "--")))


def _start(
    loop: Term, step: Term | None, expressions: Expressions, bindings: Bindings
) -> tuple[str, int] | None:
    """Returns the variable that a loop counts with, and its value before the loop."""
    declared = loop[1]
    if len(declared) == 1 and declared[0][0] == DECLARE and declared[0][3] is not None:
        name, value = declared[0][2], expressions.value(declared[0][3], bindings)
    else:
        name = name_of(step[2]) if step is not None else ""
        value = bindings.get(name)
    return (name, value) if isinstance(value, int) and name else None


def _stepped(step: Term, expressions: Expressions, bindings: Bindings) -> tuple[str, int] | None:
    """Returns the variable that a step changes, and its new value."""
    name = name_of(step[2])
    value = bindings.get(name)
    if not isinstance(value, int):
        return None
    if step[0] == UNARY:
        return name, value + (1 if step[1].endswith("++") else -1)
    operand = expressions.value(step[3], bindings)
    if not isinstance(operand, int):
        return None
    number = operand if step[1] == "=" else arithmetic(step[1].removesuffix("="), value, operand)
    return (name, number) if number is not None and number < 1 << 16 else None


def _conjuncts(term: Term) -> list[Term]:
    stack = [term]
    terms: list[Term] = []
    while stack and len(terms) < MAX_ROUNDS:
        inner = stack.pop()
        if inner[0] == BINARY and inner[1] in ("&&", "and"):
            stack += (inner[3], inner[2])
        else:
            terms.append(inner)
    return terms

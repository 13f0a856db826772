"""Loops in C and C++ over known sample counts: over a list, or halving a count until its bit is set."""

import re
from collections.abc import Iterator

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import SyntaxNode, fields, span, without_comments

from .arithmetic import arithmetic
from .masks import Bindings, Expressions, Mask, Order, Value

MAX_ROUNDS = 16
"""The maximum number of iterations; there are seven counts."""

_TO_THE_END = re.compile(r"size|Size|count|Count|_countof|end\b|ARRAY")


def loop_iterations(node: SyntaxNode, expressions: Expressions, bindings: Bindings) -> Iterator[Bindings]:
    """Yields the values of variables in each iteration of a loop over counts; nothing if its bounds are unknown."""
    if node.type == "for_range_loop":
        order = expressions.value(node.child_by_field_name("right"), bindings)
        name = expressions.name(_declared_name(node.child_by_field_name("declarator")))
        for count in order.counts[:MAX_ROUNDS] if isinstance(order, Order) and name else ():
            yield {**bindings, name: count}
        return
    start = _loop_start(node, expressions, bindings)
    update, condition = fields(node, "update", "condition")
    if start is None or update is None:
        return
    name, value = start
    for _ in range(MAX_ROUNDS):
        inner = {**bindings, name: value}
        holds = expressions.value(condition, inner) if condition is not None else 1
        if holds == 0 or not (isinstance(holds, int) or (condition is not None and _TO_THE_END.search(expressions.text_of(condition)))):
            return
        yield inner
        step = _loop_step(update, expressions, inner)
        if step is None or step[0] != name or step[1] < 0:
            return
        value = step[1]


def halving_loop(node: SyntaxNode, expressions: Expressions, bindings: Bindings) -> tuple[str, list[tuple[Mask, int, Span]]] | None:
    """Returns the variable of `while (!(counts & c)) c >>= 1;` and the tested counts in order, or None."""
    condition, body = fields(node, "condition", "body")
    update = node.child_by_field_name("update") if node.type == "for_statement" else _only(body)
    if condition is None or update is None or (node.type == "for_statement" and _only(body) is not None):
        return None
    start = _loop_start(node, expressions, bindings) if node.type == "for_statement" else None
    name = start[0] if start is not None else expressions.name(_target(update))
    value = start[1] if start is not None else bindings.get(name)
    tests: list[tuple[Mask, int, Span]] = []
    for _ in range(MAX_ROUNDS):
        if not isinstance(value, int):
            return None
        inner = {**bindings, name: value}
        count = len(tests)
        for part in _conjuncts(condition):
            negated = _negated(part, expressions)
            mask = expressions.value(negated, inner)
            if isinstance(mask, Mask) and mask.bit is not None and negated is not None:
                tests.append((mask, value, span(negated)))
                continue
            holds = expressions.value(part, inner)
            if holds == 0:
                return (name, tests) if tests else None
            if not isinstance(holds, int):
                return None
        step = _loop_step(update, expressions, inner)
        if len(tests) == count or step is None or step[0] != name or step[1] < 1:
            break
        value = step[1]
    return (name, tests) if tests else None


def _declared_name(node: SyntaxNode | None) -> SyntaxNode | None:
    while node is not None and node.type in ("reference_declarator", "pointer_declarator"):
        node = node.named_children[-1] if node.named_child_count else None
    return node


def _loop_start(node: SyntaxNode, expressions: Expressions, bindings: Bindings) -> tuple[str, int] | None:
    """Returns the variable of a `for` loop and its initial value."""
    first = node.child_by_field_name("initializer")
    declarator = first.child_by_field_name("declarator") if first is not None and first.type == "declaration" else first
    if declarator is None or declarator.type not in ("init_declarator", "assignment_expression"):
        return None
    target, source = ("declarator", "value") if declarator.type == "init_declarator" else ("left", "right")
    value: Value | None = expressions.value(declarator.child_by_field_name(source), bindings)
    name = expressions.name(declarator.child_by_field_name(target))
    return (name, value) if isinstance(value, int) and name else None


def _target(node: SyntaxNode) -> SyntaxNode | None:
    return node.child_by_field_name("left" if node.type == "assignment_expression" else "argument")


def _loop_step(node: SyntaxNode, expressions: Expressions, bindings: Bindings) -> tuple[str, int] | None:
    """Returns the variable that a step changes, and its new value."""
    name = expressions.name(_target(node))
    value = bindings.get(name)
    operator = expressions.text_of(node.child_by_field_name("operator"))
    if not isinstance(value, int):
        return None
    if node.type == "update_expression":
        return name, value + (1 if operator == "++" else -1)
    step = expressions.value(node.child_by_field_name("right"), bindings) if node.type == "assignment_expression" else None
    if not isinstance(step, int):
        return None
    if operator == "=":
        return name, step
    number = arithmetic(operator.removesuffix("="), value, step)
    return (name, number) if number is not None and number < 1 << 16 else None


def _only(body: SyntaxNode | None) -> SyntaxNode | None:
    """Returns the only expression in the body of a loop."""
    if body is not None and body.type == "compound_statement":
        statements = without_comments(body)
        body = statements[0] if len(statements) == 1 else None
    if body is None or body.type != "expression_statement" or not body.named_child_count:
        return None
    return body.named_children[0] if body.named_children[0].type in ("assignment_expression", "update_expression") else None


def _conjuncts(node: SyntaxNode) -> list[SyntaxNode]:
    stack = [node]
    nodes: list[SyntaxNode] = []
    while stack and len(nodes) < MAX_ROUNDS:
        inner = stack.pop()
        if inner.type in ("condition_clause", "parenthesized_expression"):
            stack += inner.named_children
        elif inner.type == "binary_expression" and any(child.type in ("&&", "and") for child in inner.children):
            stack += reversed(inner.named_children)
        else:
            nodes.append(inner)
    return nodes


def _negated(node: SyntaxNode, expressions: Expressions) -> SyntaxNode | None:
    """Returns the operand of a negated condition."""
    if node.type == "unary_expression" and expressions.text_of(node)[:1] == "!":
        inner = node.child_by_field_name("argument")
    elif (
        node.type == "binary_expression" and expressions.text_of(node.children[1]) == "==" and expressions.value(node.children[2], {}) == 0
    ):
        inner = node.child_by_field_name("left")
    else:
        return None
    while inner is not None and inner.type == "parenthesized_expression" and inner.named_child_count:
        inner = inner.named_children[0]
    return inner

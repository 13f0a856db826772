"""Loops of C and C++ over sample counts that are known: a list of them, or one that is halved until its bit is set."""

# No `from __future__ import annotations`: it would make names that are only for annotations ones of the module.
import re
from collections.abc import Iterator

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import SyntaxNode, span

from .masks import Expressions, Known, Mask, Order, Value

MOST_ROUNDS = 16
"""Rounds that are gone through; there are seven counts."""

_TO_THE_END = re.compile(r"size|Size|count|Count|_countof|end\b|ARRAY")


def rounds(node: SyntaxNode, expressions: Expressions, known: Known) -> Iterator[Known]:
    """What is known in each round of a loop over counts; none where its bounds are not known."""
    if node.type == "for_range_loop":
        order = expressions.value(node.child_by_field_name("right"), known)
        name = expressions.name(_declared(node.child_by_field_name("declarator")))
        for count in order.counts[:MOST_ROUNDS] if isinstance(order, Order) and name else ():
            yield {**known, name: count}
        return
    started = _started(node, expressions, known)
    update, condition = node.child_by_field_name("update"), node.child_by_field_name("condition")
    if started is None or update is None:
        return
    name, value = started
    for _ in range(MOST_ROUNDS):
        inner = {**known, name: value}
        holds = expressions.value(condition, inner) if condition is not None else 1
        if holds == 0 or not (isinstance(holds, int) or (condition is not None and _TO_THE_END.search(expressions.of(condition)))):
            return
        yield inner
        stepped = _stepped(update, expressions, inner)
        if stepped is None or stepped[0] != name or stepped[1] < 0:
            return
        value = stepped[1]


def waits(node: SyntaxNode, expressions: Expressions, known: Known) -> tuple[str, list[tuple[Mask, int, Span]]] | None:
    """`while (!(counts & c)) c >>= 1;`: the variable, and the counts that are asked, one after the other."""
    condition, body = node.child_by_field_name("condition"), node.child_by_field_name("body")
    update = node.child_by_field_name("update") if node.type == "for_statement" else _only(body)
    if condition is None or update is None or (node.type == "for_statement" and _only(body) is not None):
        return None
    started = _started(node, expressions, known) if node.type == "for_statement" else None
    name = started[0] if started is not None else expressions.name(_target(update))
    value = started[1] if started is not None else known.get(name)
    made: list[tuple[Mask, int, Span]] = []
    for _ in range(MOST_ROUNDS):
        if not isinstance(value, int):
            return None
        inner = {**known, name: value}
        asked = False
        for part in _conjuncts(condition):
            negated = _negated(part, expressions)
            mask = expressions.value(negated, inner)
            if isinstance(mask, Mask) and mask.bit is not None and negated is not None:
                made.append((mask, value, span(negated)))
                asked = True
                continue
            holds = expressions.value(part, inner)
            if holds == 0:
                return (name, made) if made else None
            if not isinstance(holds, int):
                return None
        stepped = _stepped(update, expressions, inner)
        if not asked or stepped is None or stepped[0] != name:
            break
        if stepped[1] < 1:
            return name, made
        value = stepped[1]
    return (name, made) if made else None


def _declared(node: SyntaxNode | None) -> SyntaxNode | None:
    while node is not None and node.type in ("reference_declarator", "pointer_declarator"):
        node = node.named_children[-1] if node.named_child_count else None
    return node


def _started(node: SyntaxNode, expressions: Expressions, known: Known) -> tuple[str, int] | None:
    """The variable of a `for` and what it begins with."""
    first = node.child_by_field_name("initializer")
    made = first.child_by_field_name("declarator") if first is not None and first.type == "declaration" else first
    if made is None or made.type not in ("init_declarator", "assignment_expression"):
        return None
    target, given = ("declarator", "value") if made.type == "init_declarator" else ("left", "right")
    value: Value | None = expressions.value(made.child_by_field_name(given), known)
    name = expressions.name(made.child_by_field_name(target))
    return (name, value) if isinstance(value, int) and name else None


def _target(node: SyntaxNode) -> SyntaxNode | None:
    return node.child_by_field_name("left" if node.type == "assignment_expression" else "argument")


def _stepped(node: SyntaxNode, expressions: Expressions, known: Known) -> tuple[str, int] | None:
    """The variable that a step changes, and what it is then."""
    name = expressions.name(_target(node))
    value = known.get(name)
    sign = node.child_by_field_name("operator")
    operator = expressions.of(sign) if sign is not None else ""
    if not isinstance(value, int):
        return None
    if node.type == "update_expression":
        return name, value + (1 if operator == "++" else -1)
    given = expressions.value(node.child_by_field_name("right"), known) if node.type == "assignment_expression" else None
    if not isinstance(given, int):
        return None
    if operator == "=":
        return name, given
    after = {">>=": value >> min(given, 32) if given >= 0 else None, "/=": value // given if given else None, "-=": value - given}
    after |= {"<<=": value << min(given, 32) if given >= 0 else None, "*=": value * given, "+=": value + given}
    found = after.get(operator)
    return (name, found) if found is not None and found < 1 << 16 else None


def _only(body: SyntaxNode | None) -> SyntaxNode | None:
    """The one expression of a loop's body."""
    if body is not None and body.type == "compound_statement":
        statements = [child for child in body.named_children if child.type != "comment"]
        body = statements[0] if len(statements) == 1 else None
    if body is None or body.type != "expression_statement" or not body.named_child_count:
        return None
    return body.named_children[0] if body.named_children[0].type in ("assignment_expression", "update_expression") else None


def _conjuncts(node: SyntaxNode) -> list[SyntaxNode]:
    waiting = [node]
    found: list[SyntaxNode] = []
    while waiting and len(found) < MOST_ROUNDS:
        each = waiting.pop()
        if each.type in ("condition_clause", "parenthesized_expression"):
            waiting += each.named_children
        elif each.type == "binary_expression" and any(child.type in ("&&", "and") for child in each.children):
            waiting += reversed(each.named_children)
        else:
            found.append(each)
    return found


def _negated(node: SyntaxNode, expressions: Expressions) -> SyntaxNode | None:
    """What a condition asks not to hold."""
    if node.type == "unary_expression" and expressions.of(node)[:1] == "!":
        inner = node.child_by_field_name("argument")
    elif node.type == "binary_expression" and expressions.of(node.children[1]) == "==" and expressions.value(node.children[2], {}) == 0:
        inner = node.child_by_field_name("left")
    else:
        return None
    while inner is not None and inner.type == "parenthesized_expression" and inner.named_child_count:
        inner = inner.named_children[0]
    return inner

"""Converts Swift expressions to terms. Unwrapping, `try`, `await`, and casts are removed: `a!`,
`try a`, and `a as! B` are `a`.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from functools import reduce

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import (
    BINARY,
    BRACES,
    CALL,
    CHOICE,
    DO,
    FIELD,
    IF,
    INDEX,
    LABEL,
    LAMBDA,
    LITERAL,
    NAME,
    RETURN,
    SWITCH,
    TUPLE,
    UNARY,
    UNPARSED,
    Parameter,
    Term,
)
from msaa_lint.input.code.parsing import SyntaxNode, SyntaxReader, fields, span

MAX_DEPTH = 40
"""The maximum nesting of expressions and statements."""

_NUMBER = re.compile(
    r"0[xX][0-9a-fA-F_]{1,16}|0[bB][01_]{1,64}|0[oO][0-7_]{1,22}|[0-9][0-9_]{0,18}"
)
_REAL = re.compile(r"[0-9_]+(?:\.[0-9_]+)?(?:[eE][-+]?[0-9]+)?")
_WRAPPERS = {
    "try_expression": "expr",
    "as_expression": "expr",
    "await_expression": "expr",
    "postfix_expression": "target",
}
_BINARY = frozenset({
    "comparison_expression", "equality_expression", "additive_expression",
    "multiplicative_expression", "bitwise_operation",
    "conjunction_expression", "disjunction_expression", "infix_expression",
})  # fmt: skip
_API = ("MTL", "MTK", "CAM")
_SELVES = frozenset({"rawValue", "self"})


class Expressions(SyntaxReader, ABC):
    """Reads the expressions of one file."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.called_names: set[str] = set()
        """The names of functions that other functions call."""
        self.current = ""
        """The function whose body is read."""
        self.own_class = ""
        """The type whose body is read."""

    @abstractmethod
    def statements(self, nodes: list[SyntaxNode], depth: int = 0) -> tuple[Term, ...]:
        """Returns the terms of statements."""

    @abstractmethod
    def branches(self, node: SyntaxNode, depth: int) -> list[Term]:
        """Returns an `if` chain."""

    @abstractmethod
    def cases(self, node: SyntaxNode, depth: int) -> list[Term]:
        """Returns a `switch`."""

    def other(self, node: SyntaxNode) -> Term:
        return UNPARSED, self.text_of(node)[:200], span(node)

    def expression(self, node: SyntaxNode | None, depth: int = 0) -> Term:
        if node is None:
            return UNPARSED, "", Span(0, 0)
        kind, at = node.type, span(node)
        if depth > MAX_DEPTH:
            return self.other(node)
        if kind == "self_expression":
            return NAME, "this", at
        if kind in ("simple_identifier", "type_identifier", "super_expression"):
            name = self.text_of(node).strip("`")
            return NAME, self.own_class if name == "Self" and self.own_class else name, at
        if kind == "navigation_expression":
            return self.member(node, depth, False)
        if kind == "prefix_expression":
            return self.prefixed(node, depth)
        if kind == "call_expression":
            return self.call(node, depth)
        if kind in _WRAPPERS:
            inner = node.child_by_field_name(_WRAPPERS[kind])
            return self.expression(inner or next(reversed(node.named_children), None), depth + 1)
        if kind in _BINARY:
            return self.binary(node, depth)
        if kind == "nil_coalescing_expression":
            left, right = (
                self.expression(part, depth + 1) for part in fields(node, "value", "if_nil")
            )
            return BINARY, "??", left, right, at
        if kind == "ternary_expression":
            return (
                CHOICE,
                *(
                    self.expression(part, depth + 1)
                    for part in fields(node, "condition", "if_true", "if_false")
                ),
                at,
            )
        if kind == "tuple_expression":
            return self.grouped(node, depth)
        if kind == "array_literal":
            items = [child for child in node.named_children if "comment" not in child.type]
            return BRACES, "", tuple((None, self.expression(item, depth + 1)) for item in items), at
        if kind == "lambda_literal":
            return self.closure(node, depth)
        if kind in ("if_statement", "switch_statement"):
            return self.choice(node, depth)
        return self.literal(node)

    def literal(self, node: SyntaxNode) -> Term:
        kind, written = node.type, self.text_of(node)
        if kind == "boolean_literal":
            return LITERAL, written == "true", span(node)
        if kind in ("nil_literal", "nil"):
            return LITERAL, None, span(node)
        if kind in (
            "integer_literal",
            "hex_literal",
            "oct_literal",
            "bin_literal",
        ) and _NUMBER.fullmatch(written):
            digits = written.replace("_", "")
            return (
                LITERAL,
                int(digits, 0) if digits[:2].lower() in ("0x", "0b", "0o") else int(digits),
                span(node),
            )
        if kind == "real_literal" and len(written) < 40 and _REAL.fullmatch(written):
            return LITERAL, float(written.replace("_", "")), span(node)
        return self.other(node)

    def member(self, node: SyntaxNode, depth: int, called: bool) -> Term:
        suffix = node.child_by_field_name("suffix")
        name = suffix.child_by_field_name("suffix") if suffix is not None else None
        if name is None:
            return self.other(node)
        target = self.expression(node.child_by_field_name("target"), depth + 1)
        word = self.text_of(name).strip("`")
        if word in _SELVES:
            return target
        if target[0] == NAME and target[1][:1].isupper():
            # A constant, or a static member of a type.
            if not target[1].startswith(_API):
                return NAME, f"{target[1]}::{word}", span(node)
            if not called:
                return NAME, f"{target[1]}.{word}", span(node)
        return FIELD, target, word, span(name)

    def prefixed(self, node: SyntaxNode, depth: int) -> Term:
        sign, target = fields(node, "operation", "target")
        if sign is None or target is None:
            return self.other(node)
        written = self.text_of(sign)
        if written == ".":
            return NAME, "." + self.text_of(target), span(node)
        if written in ("!", "-"):
            return UNARY, written, self.expression(target, depth + 1), span(node)
        return self.expression(target, depth + 1) if written in ("&", "+") else self.other(node)

    def call(self, node: SyntaxNode, depth: int) -> Term:
        children = node.named_children
        if len(children) < 2 or children[-1].type != "call_suffix":
            return self.other(node)
        callee = children[0]
        function = (
            self.member(callee, depth, True)
            if callee.type == "navigation_expression"
            else self.expression(callee, depth + 1)
        )
        arguments: list[Term] = []
        index = False
        for child in children[-1].named_children:
            if child.type == "value_arguments":
                index = self.text[child.start_byte] == "["
                arguments += [
                    self.argument(one, depth)
                    for one in child.named_children
                    if one.type == "value_argument"
                ]
            elif child.type == "lambda_literal":
                arguments.append(self.closure(child, depth))
        if index:
            return (
                INDEX,
                function,
                arguments[0] if len(arguments) == 1 else self.other(node),
                span(node),
            )
        if function[0] == NAME and function[1][:1] == ".":
            function = (
                NAME,
                function[1] if function[1] == ".init" else function[1][1:],
                function[2],
            )
        if function[0] == FIELD and function[2] == "init" and function[1][0] == NAME:
            function = function[1]
        name = (
            str(function[1]).rpartition("::")[2]
            if function[0] == NAME
            else function[2]
            if function[0] == FIELD
            else ""
        )
        if name != self.current:
            self.called_names.add(name)
        return CALL, function, tuple(arguments), span(node)

    def argument(self, node: SyntaxNode, depth: int) -> Term:
        label = node.child_by_field_name("name")
        term = self.expression(node.child_by_field_name("value"), depth + 1)
        return (LABEL, self.text_of(label), term, term[-1]) if label is not None else term

    def binary(self, node: SyntaxNode, depth: int) -> Term:
        left, sign, right = fields(node, "lhs", "op", "rhs")
        if left is None or sign is None or right is None:
            return self.other(node)
        operator = self.text_of(sign)
        one, other = self.expression(left, depth + 1), self.expression(right, depth + 1)
        if operator in ("==", "!=") and (LITERAL, None) in (one[:2], other[:2]):
            operand = (UNARY, "!", other if one[:2] == (LITERAL, None) else one, span(node))
            return operand if operator == "==" else (UNARY, "!", operand, span(node))
        return BINARY, operator, one, other, span(node)

    def grouped(self, node: SyntaxNode, depth: int) -> Term:
        items: list[tuple[str, Term]] = []
        label = ""
        for index, child in enumerate(node.children):
            field = node.field_name_for_child(index)
            if field == "name":
                label = self.text_of(child)
            elif field == "value":
                items.append((label, self.expression(child, depth + 1)))
                label = ""
        if len(items) == 1 and not items[0][0]:
            return items[0][1]
        return tuple_of([label for label, _ in items], [term for _, term in items], span(node))

    def closure(self, node: SyntaxNode, depth: int) -> Term:
        kind = node.child_by_field_name("type")
        groups = (
            [
                child
                for child in kind.named_children
                if child.type == "lambda_function_type_parameters"
            ]
            if kind is not None
            else []
        )
        names = [
            self.text_of(child.child_by_field_name("name"))
            for group in groups
            for child in group.named_children
        ]
        parameters = tuple(Parameter("", name, False, None) for name in names if name)
        body = returning(self.statements(block(node), depth + 1))
        if not parameters and "$0" in self.text_of(node)[:20_000]:
            parameters = (Parameter("", "$0", False, (LITERAL, None, span(node))),)
        return LAMBDA, parameters, body, span(node)

    def choice(self, node: SyntaxNode, depth: int) -> Term:
        """Returns an `if` or a `switch` that is used as an expression."""
        terms = (
            self.branches(node, depth) if node.type == "if_statement" else self.cases(node, depth)
        )
        value = _chosen(terms, 0) if len(terms) == 1 else None
        return value if value is not None else self.other(node)


def _chosen(terms: tuple[Term, ...] | list[Term], depth: int) -> Term | None:
    """Returns the value of statements that consist of a single expression, or a choice of
    several.
    """
    if len(terms) != 1 or depth > MAX_DEPTH:
        return None
    term = terms[0]
    if term[0] == DO:
        value: Term = term[1]
        return value
    if term[0] == SWITCH:
        return _chosen_case(term, depth)
    if term[0] != IF:
        return None
    then, otherwise = _chosen(term[2], depth + 1), _chosen(term[3], depth + 1)
    return (
        (CHOICE, term[1], then, otherwise, term[-1])
        if then is not None and otherwise is not None
        else None
    )


def _chosen_case(term: Term, depth: int) -> Term | None:
    """Returns the value of a `switch` whose cases are single expressions."""
    chosen: Term | None = None
    for labels, body in reversed(term[2][:MAX_DEPTH]):
        value = _chosen(body[:-1], depth + 1)
        if value is None:
            return None
        conditions = [
            (BINARY, "==", term[1], label, term[-1]) for label in labels if label is not None
        ]
        condition = (
            reduce(lambda a, b: (BINARY, "||", a, b, a[-1]), conditions) if conditions else None
        )
        chosen = (
            value
            if condition is None or chosen is None
            else (CHOICE, condition, value, chosen, term[-1])
        )
    return chosen


def tuple_of(labels: list[str], terms: list[Term], at: Span) -> Term:
    """Returns a tuple."""
    items = tuple(
        ((label or str(n),), term)
        for n, (label, term) in enumerate(zip(labels, terms, strict=True))
    )
    return BRACES, TUPLE, items, at


def returning(statements: tuple[Term, ...]) -> tuple[Term, ...]:
    """Returns a body whose single expression is its result."""
    if len(statements) == 1 and statements[0][0] == DO:
        return ((RETURN, statements[0][1], statements[0][-1]),)
    return statements


def block(node: SyntaxNode) -> list[SyntaxNode]:
    """Returns the statements in the braces of a node."""
    return [
        item
        for child in node.named_children
        if child.type == "statements"
        for item in child.named_children
    ]

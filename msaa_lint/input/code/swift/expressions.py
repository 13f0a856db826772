"""Converts Swift expressions to terms. Expressions that nest too deeply become OTHER."""

from __future__ import annotations

import re

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import SyntaxNode, SyntaxReader, fields, span

from .terms import BINARY, CALL, CHOICE, CLOSURE, DO, IF, INDEX, LIST, LITERAL, MEMBER, NAME, NOT, OTHER, TUPLE, Term

MAX_DEPTH = 40
"""The maximum nesting of expressions and statements."""

_NUMBER = re.compile(r"0[xX][0-9a-fA-F_]{1,16}|0[bB][01_]{1,64}|0[oO][0-7_]{1,22}|[0-9][0-9_]{0,18}")
_WRAPPERS = {"try_expression": "expr", "as_expression": "expr", "await_expression": "expr", "postfix_expression": "target"}
_BINARY = frozenset({
    "comparison_expression", "equality_expression", "additive_expression", "multiplicative_expression", "bitwise_operation",
    "conjunction_expression", "disjunction_expression", "infix_expression",
})  # fmt: skip


class Expressions(SyntaxReader):
    """Reads the expressions of one file."""

    def __init__(self, text: str) -> None:
        self.text = text

    def other(self, node: SyntaxNode) -> Term:
        return OTHER, self.text_of(node)[:200], span(node)

    def expression(self, node: SyntaxNode | None, depth: int = 0) -> Term:
        if node is None:
            return OTHER, "", Span(0, 0)
        kind = node.type
        if depth > MAX_DEPTH:
            return self.other(node)
        if kind in ("simple_identifier", "self_expression", "type_identifier", "super_expression"):
            return NAME, self.text_of(node), span(node)
        if kind == "navigation_expression":
            return self.member(node, depth)
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
            left, right = (self.expression(part, depth + 1) for part in fields(node, "value", "if_nil"))
            return BINARY, "??", left, right, span(node)
        if kind == "ternary_expression":
            condition, then, other = (self.expression(part, depth + 1) for part in fields(node, "condition", "if_true", "if_false"))
            return CHOICE, (condition,), then, other, span(node)
        if kind == "tuple_expression":
            return self.grouped(node, depth)
        if kind == "array_literal":
            items = [child for child in node.named_children if "comment" not in child.type]
            return LIST, tuple(self.expression(item, depth + 1) for item in items), span(node)
        if kind == "lambda_literal":
            return self.closure(node, depth)
        if kind == "if_statement":
            return self.choice(node, depth)
        return self.literal(node)

    def literal(self, node: SyntaxNode) -> Term:
        kind, written = node.type, self.text_of(node)
        if kind == "boolean_literal":
            return LITERAL, written == "true", span(node)
        if kind in ("nil_literal", "nil"):
            return LITERAL, None, span(node)
        if kind == "line_string_literal":
            return LITERAL, written.strip('"')[:200], span(node)
        if kind in ("integer_literal", "hex_literal", "oct_literal", "bin_literal") and _NUMBER.fullmatch(written):
            digits = written.replace("_", "")
            return LITERAL, int(digits, 0) if digits[:2].lower() in ("0x", "0b", "0o") else int(digits), span(node)
        if kind == "real_literal" and len(written) < 40:
            try:
                return LITERAL, float(written.replace("_", "")), span(node)
            except ValueError:
                pass
        return self.other(node)

    def member(self, node: SyntaxNode, depth: int) -> Term:
        suffix = node.child_by_field_name("suffix")
        name = suffix.child_by_field_name("suffix") if suffix is not None else None
        if name is None:
            return self.other(node)
        target = self.expression(node.child_by_field_name("target"), depth + 1)
        return MEMBER, target, self.text_of(name), Span(node.start_byte, name.end_byte)

    def prefixed(self, node: SyntaxNode, depth: int) -> Term:
        sign, target = fields(node, "operation", "target")
        if sign is None or target is None:
            return self.other(node)
        written = self.text_of(sign)
        if written == ".":
            return MEMBER, None, self.text_of(target), span(node)
        if written == "!":
            return NOT, self.expression(target, depth + 1), span(node)
        return self.expression(target, depth + 1) if written in ("&", "+") else self.other(node)

    def call(self, node: SyntaxNode, depth: int) -> Term:
        children = node.named_children
        if len(children) < 2 or children[-1].type != "call_suffix":
            return self.other(node)
        function = self.expression(children[0], depth + 1)
        arguments: tuple[tuple[str, Term], ...] = ()
        closure: Term | None = None
        index = False
        for child in children[-1].named_children:
            if child.type == "value_arguments":
                index = self.text[child.start_byte] == "["
                arguments = tuple(self.argument(one, depth) for one in child.named_children if one.type == "value_argument")
            elif child.type == "lambda_literal" and closure is None:
                closure = self.closure(child, depth)
        if index:
            indexed: Term = INDEX, function, arguments[0][1] if len(arguments) == 1 else self.other(node), span(node)
            return indexed if closure is None else (CALL, indexed, (), closure, span(node))
        return CALL, function, arguments, closure, span(node)

    def argument(self, node: SyntaxNode, depth: int) -> tuple[str, Term]:
        label = node.child_by_field_name("name")
        return self.text_of(label), self.expression(node.child_by_field_name("value"), depth + 1)

    def binary(self, node: SyntaxNode, depth: int) -> Term:
        left, sign, right = fields(node, "lhs", "op", "rhs")
        if left is None or sign is None or right is None:
            return self.other(node)
        return BINARY, self.text_of(sign), self.expression(left, depth + 1), self.expression(right, depth + 1), span(node)

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
        return TUPLE, tuple(items), span(node)

    def closure(self, node: SyntaxNode, depth: int) -> Term:
        kind = node.child_by_field_name("type")
        groups = [child for child in kind.named_children if child.type == "lambda_function_type_parameters"] if kind is not None else []
        names = [self.text_of(child.child_by_field_name("name")) for group in groups for child in group.named_children]
        return CLOSURE, tuple(names), self.statements(block(node), depth + 1), span(node)

    def choice(self, node: SyntaxNode, depth: int) -> Term:
        """Returns an `if` that is used as an expression."""
        branch = self.branches(node, depth)
        if branch[0] == IF and all(len(arm) == 1 and arm[0][0] == DO for arm in (branch[2], branch[3])):
            return CHOICE, branch[1], branch[2][0][1], branch[3][0][1], branch[-1]
        return self.other(node)

    def statements(self, nodes: list[SyntaxNode], depth: int = 0) -> tuple[Term, ...]:
        raise NotImplementedError

    def branches(self, node: SyntaxNode, depth: int) -> Term:
        raise NotImplementedError


def block(node: SyntaxNode) -> list[SyntaxNode]:
    """Returns the statements in the braces of a node."""
    return [item for child in node.named_children if child.type == "statements" for item in child.named_children]

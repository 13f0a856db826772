"""Converts Rust statements to terms."""

from __future__ import annotations

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import (
    BINARY,
    BLOCK,
    CALL,
    DECLARE,
    DO,
    FIELD,
    IF,
    INDEX,
    LEAVE,
    LITERAL,
    LOOP,
    NAME,
    RETURN,
    UNARY,
    UNPARSED,
    Term,
)
from msaa_lint.input.code.parsing import SyntaxNode, fields, span

from .expressions import BLOCKS, MAX_DEPTH, Expressions

_CONDITIONALS = frozenset({"if_expression", "match_expression"})
_LOOPS = frozenset({"for_expression", "while_expression", "loop_expression"})
_LEAVING = frozenset({"break_expression", "continue_expression"})

MAX_ARMS = 200
"""The maximum number of arms of a `match`, and of `else if`s, that are read."""


class Statements(Expressions):
    """The statements of one file."""

    def block(self, node: SyntaxNode, depth: int, is_value: bool) -> tuple[Term, ...]:
        if node.type in BLOCKS and node.type != "block":
            node = next((child for child in node.named_children if child.type == "block"), node)
        children = [
            child
            for child in node.named_children
            if "comment" not in child.type and child.type != "label"
        ]
        terms: list[Term] = []
        for number, child in enumerate(children) if depth < MAX_DEPTH else ():
            is_last = is_value and number == len(children) - 1
            terms += self.statement(child, depth + 1, is_last)
        return tuple(terms)

    def statement(self, node: SyntaxNode, depth: int, is_value: bool = False) -> list[Term]:
        """Returns the terms of a statement. The value of an expression without a semicolon is
        returned if `is_value` is set.
        """
        kind, at = node.type, span(node)
        if kind == "expression_statement":
            inner = node.named_children[0] if node.named_child_count else None
            # `if` and `match` need no semicolon, also at the end of a block with a value.
            is_value = (
                is_value
                and inner is not None
                and inner.type in _CONDITIONALS | BLOCKS
                and not self.text_of(node).endswith(";")
            )
            return self.statement(inner, depth, is_value) if inner is not None else []
        if kind == "let_declaration":
            return self.declared(node, depth)
        if kind == "return_expression":
            value = node.named_children[0] if node.named_child_count else None
            return [(RETURN, self.expression(value, depth) if value is not None else None, at)]
        if kind in _LEAVING:
            return [(LEAVE, at)]
        if kind in _CONDITIONALS:
            return [self.conditional(node, depth, is_value)]
        if kind in _LOOPS:
            return [self.loop(node, depth)]
        if kind in BLOCKS:
            return [(BLOCK, self.block(node, depth, is_value), at)]
        if kind in ("const_item", "static_item"):
            return self.constant(node)
        if (
            kind.endswith(("item", "definition", "declaration", "comment"))
            or kind == "empty_statement"
        ):
            return []
        term = self.expression(node, depth)
        return [(RETURN, term, at)] if is_value else [(DO, term, at)]

    def constant(self, node: SyntaxNode) -> list[Term]:
        """Returns a constant or a static variable."""
        name, kind, value = fields(node, "name", "type", "value")
        if name is None or value is None:
            return []
        fixed = node.type == "const_item" or not any(
            child.type == "mutable_specifier" for child in node.named_children
        )
        return [
            (
                DECLARE,
                self.type_text(kind),
                self.text_of(name),
                self.expression(value, 0),
                False,
                fixed,
                span(name),
            )
        ]

    def declared(self, node: SyntaxNode, depth: int) -> list[Term]:
        pattern, kind, value_node, alternative = fields(
            node, "pattern", "type", "value", "alternative"
        )
        value = self.expression(value_node, depth) if value_node is not None else None
        terms: list[Term] = []
        if alternative is not None and value is not None:
            terms.append(
                (
                    IF,
                    self.exists(value),
                    (),
                    self.block(alternative, depth, False),
                    span(alternative),
                )
            )
        return terms + self.bound(pattern, value, self.type_text(kind), depth)

    def exists(self, value: Term) -> Term:
        """Returns the condition that a value is not None."""
        return (CALL, (FIELD, value, "is_some", value[-1]), (), value[-1])

    def bound(
        self, pattern: SyntaxNode | None, value: Term | None, kind: str, depth: int
    ) -> list[Term]:
        """Returns the declarations of the names that a pattern binds to parts of a value."""
        if pattern is None:
            return []
        at = span(pattern)
        name = self.bound_name(pattern)
        if name:
            return [(DECLARE, kind, name, value, False, False, at)]
        parts = [child for child in pattern.named_children if child.type != "mutable_specifier"]
        if pattern.type == "tuple_struct_pattern":
            parts = parts[1:]
        if (
            pattern.type
            not in ("tuple_pattern", "slice_pattern", "struct_pattern", "tuple_struct_pattern")
            or value is None
        ):
            return []
        whole = f"#{at.start}"
        terms: list[Term] = [(DECLARE, "", whole, value, False, False, at)]
        for number, part in enumerate(parts):
            place = span(part)
            if pattern.type != "struct_pattern":
                terms += self.bound(
                    part, (INDEX, (NAME, whole, place), (LITERAL, number, place), place), "", depth
                )
            elif part.type == "field_pattern":
                member, inner = fields(part, "name", "pattern")
                field = (FIELD, (NAME, whole, place), self.text_of(member), place)
                terms += (
                    self.bound(inner, field, "", depth)
                    if inner is not None
                    else [(DECLARE, "", self.text_of(member), field, False, False, place)]
                )
        return terms

    def conditional(self, node: SyntaxNode, depth: int, is_value: bool) -> Term:
        if node.type == "match_expression":
            return self.match(node, depth, is_value)
        links: list[tuple[Term, tuple[Term, ...], Span]] = []
        otherwise: tuple[Term, ...] = ()
        current: SyntaxNode | None = node
        while current is not None:
            test, then, other = fields(current, "condition", "consequence", "alternative")
            condition, first = self.tested(test, depth)
            body = self.block(then, depth + 1, is_value) if then is not None else ()
            links.append((condition, (*first, *body), span(current)))
            last = (
                other.named_children[-1] if other is not None and other.named_child_count else None
            )
            current = (
                last
                if last is not None and last.type == "if_expression" and len(links) < MAX_ARMS
                else None
            )
            if current is None and last is not None and last.type != "if_expression":
                otherwise = self.block(last, depth + 1, is_value)
        for condition, body, at in reversed(links):
            otherwise = ((IF, condition, body, otherwise, at),)
        return otherwise[0]

    def tested(self, test: SyntaxNode | None, depth: int) -> tuple[Term, list[Term]]:
        """Returns a condition, and the names that it binds as declarations."""
        if test is None:
            return (UNPARSED, "", Span(0, 0)), []
        if test.type == "let_condition":
            pattern, value_node = fields(test, "pattern", "value")
            value = self.expression(value_node, depth)
            return self.matches(pattern, value, depth), self.bound(pattern, value, "", depth)
        if test.type == "let_chain":
            conditions, declared = zip(
                *(self.tested(child, depth) for child in test.named_children), strict=True
            )
            whole = conditions[0]
            for condition in conditions[1:]:
                whole = (BINARY, "&&", whole, condition, span(test))
            return whole, [term for terms in declared for term in terms]
        return self.expression(test, depth), []

    def matches(self, pattern: SyntaxNode | None, value: Term, depth: int) -> Term:
        """Returns the condition that a value matches a pattern."""
        at = span(pattern) if pattern is not None else value[-1]
        if (
            pattern is None
            or self.text_of(pattern) == "_"
            or (pattern.type == "identifier" and self.text_of(pattern)[:1].islower())
        ):
            return (LITERAL, True, at)
        if pattern.type == "or_pattern":
            terms = [self.matches(child, value, depth) for child in pattern.named_children]
            whole = terms[0] if terms else (UNPARSED, "", at)
            for term in terms[1:]:
                whole = (BINARY, "||", whole, term, at)
            return whole
        if pattern.type == "tuple_struct_pattern" and self.text_of(
            pattern.child_by_field_name("type")
        ) in ("Some", "Ok"):
            return self.exists(value)
        if pattern.type == "identifier" and self.text_of(pattern) == "None":
            return (UNARY, "!", self.exists(value), at)
        if pattern.type in (
            "integer_literal",
            "boolean_literal",
            "scoped_identifier",
            "identifier",
            "negative_literal",
        ):
            return (BINARY, "==", value, self.expression(pattern, depth), at)
        return (UNPARSED, self.text_of(pattern)[:100], at)

    def match(self, node: SyntaxNode, depth: int, is_value: bool) -> Term:
        """Returns a `match` as a chain of conditions."""
        value_node, body = fields(node, "value", "body")
        value = self.expression(value_node, depth)
        arms = (
            [child for child in body.named_children if child.type == "match_arm"][:MAX_ARMS]
            if body is not None
            else []
        )
        otherwise: tuple[Term, ...] = ()
        for arm in reversed(arms):
            pattern, result = fields(arm, "pattern", "value")
            inner = (
                pattern.named_children[0]
                if pattern is not None and pattern.named_child_count
                else pattern
            )
            condition = self.matches(inner, value, depth)
            guard = pattern.child_by_field_name("condition") if pattern is not None else None
            if guard is not None:
                condition = (BINARY, "&&", condition, self.expression(guard, depth), span(guard))
            statements = self.statement(result, depth + 1, is_value) if result is not None else []
            otherwise = (
                (
                    IF,
                    condition,
                    (*self.bound(inner, value, "", depth), *statements),
                    otherwise,
                    span(arm),
                ),
            )
        return otherwise[0] if otherwise else (DO, value, span(node))

    def loop(self, node: SyntaxNode, depth: int) -> Term:
        at = span(node)
        pattern, value, test, body_node = fields(node, "pattern", "value", "condition", "body")
        body = list(self.block(body_node, depth + 1, False)) if body_node is not None else []
        if node.type == "for_expression" and value is not None and pattern is not None:
            name = self.bound_name(pattern)
            if value.type == "range_expression" and name and value.named_child_count == 2:
                first, last = (self.expression(child, depth) for child in value.named_children)
                sign = "<=" if "..=" in self.text_of(value) else "<"
                counter: Term = (NAME, name, at)
                turns = [
                    (DO, (BINARY, sign, counter, last, at), at),
                    *body,
                    (DO, (UNARY, "++", counter, at), at),
                ]
                return (
                    LOOP,
                    ((DECLARE, "int", name, first, False, False, at),),
                    None,
                    tuple(turns),
                    at,
                )
            over = self.expression(value, depth)
            if name:
                return (LOOP, ((DECLARE, "", name, None, True, False, at),), over, tuple(body), at)
            return (
                LOOP,
                tuple(self.bound(pattern, (UNPARSED, "", at), "", depth)),
                None,
                tuple(body),
                at,
            )
        if test is not None:
            condition, first_terms = self.tested(test, depth)
            body = [(DO, condition, at), *first_terms, *body]
        return (LOOP, (), None, tuple(body), at)

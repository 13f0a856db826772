"""Converts C and C++ statements to terms."""

from __future__ import annotations

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import (
    BLOCK,
    BREAK,
    DECLARE,
    DO,
    IF,
    LEAVE,
    LOOP,
    RETURN,
    SOME,
    SWITCH,
    UNPARSED,
    Term,
)
from msaa_lint.input.code.parsing import SyntaxNode, fields, span, without_comments

from . import shapes
from .declarations import Declarations, structured_binding
from .kinds import BLOCKS, CHAIN_TESTS, MAX_DEPTH


class Statements(Declarations):
    """The statements of one file."""

    def block(self, node: SyntaxNode, depth: int) -> list[Term]:
        terms: list[Term] = []
        if depth < MAX_DEPTH:
            for child in node.named_children:
                fresh = self.statement(child, depth + 1)
                loop = (
                    shapes.loop_variable(terms[-1][1])
                    if child.type == "compound_statement" and terms and terms[-1][0] == DO
                    else None
                )
                if loop is not None:
                    fresh = [(LOOP, (loop[0],), loop[1], tuple(fresh), terms.pop()[-1])]
                terms += fresh
        return terms

    def statement(self, node: SyntaxNode, depth: int) -> list[Term]:
        kind = node.type
        at = span(node)
        if kind == "expression_statement":
            child = node.named_children[0] if node.named_child_count else None
            if child is None:
                return []
            term = self.expression(child, depth)
            return [shapes.declared(term) or (DO, shapes.cleared(term), at)]
        if kind == "declaration":
            return self.declared(node, depth)
        if kind == "return_statement" or kind == "co_return_statement":
            children = without_comments(node)
            return [(RETURN, self.expression(children[0], depth) if children else None, at)]
        if kind in ("throw_statement", "goto_statement"):
            return [(LEAVE, at)]
        if kind in ("break_statement", "continue_statement"):
            return [(BREAK, at)]
        if kind == "if_statement":
            return self.if_chain(node, depth)
        if kind in ("for_statement", "while_statement", "do_statement"):
            first, test, update, body = fields(node, "initializer", "condition", "update", "body")
            terms = (
                self.declared(first, depth)
                if first is not None and first.type == "declaration"
                else []
            )
            before = (
                [(DO, self.expression(first, depth), at)] if first is not None and not terms else []
            )
            nested = self.nested_statements(body, depth)
            if update is not None and (iterated := shapes.iterated(terms, nested)) is not None:
                return [(LOOP, iterated[0], iterated[1], tuple(nested), at)]
            if update is not None:
                nested.append((DO, self.expression(update, depth), at))
            if test is not None:
                nested.insert(0, (DO, self.expression(test, depth), at))
            return (
                nested
                if kind == "do_statement"
                else [*before, (LOOP, tuple(terms), None, tuple(nested), at)]
            )
        if kind == "for_range_loop":
            over, body, type_node, declarator = fields(node, "right", "body", "type", "declarator")
            bound = structured_binding(declarator)
            name, _, indirect = self.declarator(declarator) if bound is None else ("", None, True)
            if bound is not None:
                whole, *parts = self.bindings(
                    bound, (DECLARE, "auto", "", None, True, False, span(bound))
                )
            else:
                whole, parts = (
                    (DECLARE, self.type_text(type_node), name, None, indirect, False, at),
                    [],
                )
            elements = self.expression(over, depth) if over is not None else None
            declared = (whole,) if whole[2] else ()
            return [(LOOP, declared, elements, (*parts, *self.nested_statements(body, depth)), at)]
        if kind in CHAIN_TESTS:
            return self.preprocessor_block(node, depth)
        if kind == "switch_statement":
            return self.switch_cases(node, depth)
        if kind == "preproc_def":
            return self.macro_constant(node)
        if kind == "function_definition":
            # Inside a function, this is the result of a macro or a misparsed lambda.
            body = node.child_by_field_name("body")
            return self.block(body, depth) if body is not None and depth < MAX_DEPTH else []
        if kind in BLOCKS:
            return [(BLOCK, tuple(self.block(node, depth)), at)]
        return []

    def nested_statements(self, node: SyntaxNode | None, depth: int) -> list[Term]:
        return self.statement(node, depth + 1) if node is not None and depth < MAX_DEPTH else []

    def if_chain(self, node: SyntaxNode, depth: int) -> list[Term]:
        """Returns an `if` with its `else if`s, which nest in the syntax tree but not in the
        text.
        """
        links: list[tuple[Term, tuple[Term, ...], list[Term], Span]] = []
        otherwise: list[Term] = []
        current: SyntaxNode | None = node
        while current is not None:
            test, then, other = fields(current, "condition", "consequence", "alternative")
            at = span(current)
            first: list[Term] = []
            if test is not None and test.type == "condition_clause":
                start = test.child_by_field_name("initializer")
                first = self.block(start, depth) if start is not None else []
                test = test.child_by_field_name("value") or test
            condition = self.expression(test, depth) if test is not None else (UNPARSED, "", at)
            links.append((condition, tuple(self.nested_statements(then, depth)), first, at))
            current = None
            if other is not None:
                next_node = (
                    other.named_children[-1]
                    if other.type == "else_clause" and other.named_child_count
                    else other
                )
                if next_node.type == "if_statement" and len(links) < 200:
                    current = next_node
                else:
                    otherwise = self.nested_statements(next_node, depth)
        for condition, body, first, at in reversed(links):
            otherwise = [*first, (IF, condition, body, tuple(otherwise), at)]
        return otherwise

    def preprocessor_block(self, node: SyntaxNode, depth: int) -> list[Term]:
        """Returns a preprocessor block inside a function."""
        test = node.child_by_field_name("condition") or node.child_by_field_name("name")
        other = node.child_by_field_name("alternative")
        negated = node.type == "preproc_ifdef" and self.text.startswith("#ifndef", node.start_byte)
        then: list[Term] = []
        for child in node.named_children:
            if depth < MAX_DEPTH and child not in (test, other):
                then += self.statement(child, depth + 1)
        otherwise = self.nested_statements(other, depth)
        if negated:
            then, otherwise = otherwise, then
        return [(SOME, "#" + self.text_of(test).strip(), tuple(then), tuple(otherwise), span(node))]

    def switch_cases(self, node: SyntaxNode, depth: int) -> list[Term]:
        """Returns a switch with the statements at each of its labels."""
        test, body = fields(node, "condition", "body")
        cases: list[tuple[list[Term | None], list[Term]]] = []
        for child in body.named_children if body is not None and depth < MAX_DEPTH else ():
            if child.type != "case_statement":
                statements = self.statement(child, depth + 1)
                if cases:
                    cases[-1][1].extend(statements)
                continue
            value_node = child.child_by_field_name("value")
            label = self.expression(value_node, depth) if value_node is not None else None
            inner = [
                term
                for item in child.named_children
                if item != value_node
                for term in self.statement(item, depth + 1)
            ]
            if cases and not cases[-1][1]:
                cases[-1][0].append(label)
                cases[-1][1].extend(inner)
            else:
                cases.append(([label], inner))
        return [
            (
                SWITCH,
                self.expression(test, depth),
                tuple((tuple(labels), tuple(inner)) for labels, inner in cases),
                span(node),
            )
        ]

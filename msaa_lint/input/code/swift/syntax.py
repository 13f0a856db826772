"""Converts Swift statements and declarations to terms."""

from __future__ import annotations

import re

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import SyntaxNode, fields, span

from .expressions import MAX_DEPTH, Expressions, block
from .terms import BIND, BLOCK, CALL, CASES, DO, FUNC, GUARD, IF, LEAVE, LET, LOOP, NAME, OTHER, RETURN, SET, Function, Parameter, Term

MAX_ARMS = 50
"""The maximum number of branches in an `if` chain."""

_LABELS = re.compile(r"[(,]\s*([A-Za-z_]\w*)\s*:")
_LEAVING = frozenset({"fatalError", "preconditionFailure", "abort", "exit"})

_Open = tuple[list[Term], Span, list[tuple[str, list[Term]]]]
"""An open `#if`: the enclosing list, its location, and its branches with their conditions."""


class Syntax(Expressions):
    """Reads one file."""

    def statements(self, nodes: list[SyntaxNode], depth: int = 0) -> tuple[Term, ...]:
        """Returns the terms of statements; `#if` blocks are assembled from their directives."""
        if depth > MAX_DEPTH:
            return ()
        terms: list[Term] = []
        open_: list[_Open] = []
        for node in nodes:
            if node.type == "directive":
                terms = self.directive(node, terms, open_)
                continue
            self.statement(node, depth, terms)
        while open_:
            terms = _closed(terms, open_)
        return tuple(terms)

    def directive(self, node: SyntaxNode, terms: list[Term], open_: list[_Open]) -> list[Term]:
        """Handles a directive; returns the list that the following statements belong to."""
        written = self.text_of(node)
        arm: list[Term] = []
        if written.startswith("#if") and len(open_) < MAX_DEPTH:
            open_.append((terms, span(node), [(written[3:].strip(), arm)]))
            return arm
        if written.startswith("#else") and open_ and len(open_[-1][2]) < MAX_ARMS:
            open_[-1][2].append((written.removeprefix("#elseif").strip() if written.startswith("#elseif") else "", arm))
            return arm
        if written.startswith("#endif") and open_:
            return _closed(terms, open_)
        return terms

    def statement(self, node: SyntaxNode, depth: int, terms: list[Term]) -> None:
        kind = node.type
        if kind == "property_declaration":
            self.declared(node, depth, terms)
        elif kind == "assignment":
            target = node.child_by_field_name("target")
            inner = target.named_children[0] if target is not None and target.named_children else None
            sign, value = fields(node, "operator", "result")
            if inner is not None and sign is not None:
                terms.append((SET, self.text_of(sign), self.expression(inner, depth), self.expression(value, depth), span(node)))
        elif kind == "infix_expression" and node.child_count == 3 and self.text_of(node.children[1]).endswith("="):
            # The grammar parses `+=` as an assignment, but `<<=` and similar as custom operators.
            target, sign, value = node.children
            terms.append((SET, self.text_of(sign), self.expression(target, depth), self.expression(value, depth), span(node)))
        elif kind == "if_statement":
            terms.append(self.branches(node, depth))
        elif kind == "guard_statement":
            conditions, bodies = self.conditions(node, depth)
            terms.append((GUARD, conditions, bodies[0] if bodies else (), span(node)))
        elif kind in ("for_statement", "while_statement", "repeat_while_statement"):
            item = node.child_by_field_name("item")
            terms.append((LOOP, self.names(item) if item is not None else (), self.statements(block(node), depth + 1), span(node)))
        elif kind == "do_statement":
            terms.append((BLOCK, self.statements(block(node), depth + 1), span(node)))
        elif kind == "switch_statement":
            entries = [child for child in node.named_children if child.type == "switch_entry"]
            terms.append((CASES, tuple(self.statements(block(entry), depth + 1) for entry in entries), span(node)))
        elif kind == "control_transfer_statement":
            result = node.child_by_field_name("result")
            leaving = not self.text.startswith("return", node.start_byte)
            terms.append((LEAVE, span(node)) if leaving else (RETURN, self.expression(result, depth) if result else None, span(node)))
        elif kind == "function_declaration":
            terms.append((FUNC, self.function(node, ""), span(node)))
        elif kind == "ERROR":
            if depth < MAX_DEPTH:
                terms.extend(self.statements(node.named_children, depth + 20))
        elif not kind.endswith(("declaration", "comment")):
            term = self.expression(node, depth)
            leaves = term[0] == CALL and term[1][0] == NAME and term[1][1] in _LEAVING
            terms.append((LEAVE, span(node)) if leaves else (DO, term, span(node)))

    def branches(self, node: SyntaxNode, depth: int) -> Term:
        """Returns an `if` chain."""
        arms: list[tuple[tuple[Term, ...], tuple[Term, ...], Span]] = []
        otherwise: tuple[Term, ...] = ()
        while len(arms) < MAX_ARMS:
            conditions, bodies = self.conditions(node, depth)
            arms.append((conditions, bodies[0] if bodies else (), span(node)))
            next_node = node.children[-1]
            if next_node.type != "if_statement":
                otherwise = bodies[1] if len(bodies) > 1 else ()
                break
            node = next_node
        for conditions, body, place in reversed(arms):
            otherwise = ((IF, conditions, body, otherwise, place),)
        return otherwise[0]

    def conditions(self, node: SyntaxNode, depth: int) -> tuple[tuple[Term, ...], list[tuple[Term, ...]]]:
        """Returns the conditions of an `if` or `guard`, and the statements in each of its blocks."""
        terms: list[Term] = []
        bodies: list[tuple[Term, ...]] = []
        name: SyntaxNode | None = None
        for index, child in enumerate(node.children):
            kind = child.type
            if name is not None and kind in ("{", ",", "else"):
                terms.append(self.binding(name, None, depth))
                name = None
            if kind == "{":
                bodies.append(())
            elif kind == "statements" and bodies:
                bodies[-1] = self.statements(child.named_children, depth + 1)
            elif not bodies:
                field = node.field_name_for_child(index)
                if field == "bound_identifier":
                    name = child
                elif field == "condition" and child.is_named and kind != "value_binding_pattern":
                    terms.append(self.binding(name, child, depth) if name is not None else self.expression(child, depth))
                    name = None
        return tuple(terms), bodies

    def binding(self, name: SyntaxNode, value: SyntaxNode | None, depth: int) -> Term:
        term = self.expression(value, depth) if value is not None else None
        return BIND, self.text_of(name), term, Span(name.start_byte, (value or name).end_byte)

    def declared(self, node: SyntaxNode, depth: int, terms: list[Term]) -> None:
        """Adds the names declared by `let` or `var`."""
        names: tuple[str, ...] = ()
        kind = ""
        value: Term | None = None
        for index, child in enumerate(node.children):
            field = node.field_name_for_child(index)
            if field == "name" and child.type == "pattern":
                if names:
                    terms.append((LET, names, kind, value, span(node)))
                names, kind, value = self.names(child), "", None
            elif child.type == "type_annotation":
                kind = self.text_of(child).lstrip(": ").rstrip("?! ")
            elif field == "value":
                value = self.expression(child, depth)
        if names:
            terms.append((LET, names, kind, value, span(node)))

    def names(self, node: SyntaxNode) -> tuple[str, ...]:
        """Returns the names that a pattern binds; empty ones are ignored."""
        bound = node.child_by_field_name("bound_identifier")
        if bound is not None:
            return (self.text_of(bound),)
        return tuple(self.text_of(child) for child in node.named_children if child.type in ("pattern", "simple_identifier")) or ("",)

    def function(self, node: SyntaxNode, type_name: str) -> Function:
        """Returns a function or an initializer without parsing its body."""
        name = node.child_by_field_name("name")
        parameters: list[Parameter] = []
        gives: tuple[str, ...] = ()
        children = node.children
        for index, child in enumerate(children):
            if child.type == "parameter":
                has_default = index + 2 < len(children) and node.field_name_for_child(index + 2) == "default_value"
                parameters.append(self.parameter(child, children[index + 2] if has_default else None))
            elif child.type == "tuple_type":
                gives = tuple(_LABELS.findall(self.text_of(child)[:2000]))
        return Function(self.text_of(name), type_name, tuple(parameters), gives, node.child_by_field_name("body"), span(node))

    def parameter(self, node: SyntaxNode, default: SyntaxNode | None) -> Parameter:
        label, name = fields(node, "external_name", "name")
        written = self.text_of(name)
        kind = self.text_of(node).partition(":")[2].strip().removeprefix("inout ").rstrip("?! ")
        outer = self.text_of(label) if label is not None else written
        return Parameter("" if outer == "_" else outer, written, kind, self.expression(default) if default is not None else None)


def _closed(terms: list[Term], open_: list[_Open]) -> list[Term]:
    """Closes the innermost `#if` and returns the enclosing list."""
    enclosing, place, arms = open_.pop()
    otherwise: tuple[Term, ...] = ()
    for text, arm in reversed(arms):
        otherwise = ((IF, ((OTHER, "#if " + text, place),), tuple(arm), otherwise, place),) if text else tuple(arm)
    enclosing.extend(otherwise)
    return enclosing

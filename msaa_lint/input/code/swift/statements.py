"""Converts Swift statements to terms."""

from __future__ import annotations

import re
from functools import reduce

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import (
    ASSIGN,
    BINARY,
    BLOCK,
    BRACES,
    BREAK,
    CALL,
    DECLARE,
    DO,
    FIELD,
    IF,
    LAMBDA,
    LEAVE,
    LITERAL,
    LOOP,
    NAME,
    RETURN,
    SOME,
    SWITCH,
    TUPLE,
    UNARY,
    UNPARSED,
    Parameter,
    Term,
)
from msaa_lint.input.code.parsing import SyntaxNode, fields, span

from .expressions import MAX_DEPTH, Expressions, block, returning, tuple_of

MAX_ARMS = 50
"""The maximum number of branches in an `if` chain."""

_LEAVING = frozenset({"fatalError", "preconditionFailure", "abort", "exit"})
_LABELS = re.compile(r"[(,]\s*([A-Za-z_]\w*)\s*:")
_TYPE_WORDS = re.compile(
    r"^(?:(?:@\w+|inout|any|some|borrowing|consuming|__owned|unowned|weak)\s+)+"
)

_Open = tuple[list[Term], Span, list[tuple[str, list[Term]]]]
"""An open `#if`: the enclosing list, its location, and its branches with their conditions."""


class Statements(Expressions):
    """Reads the statements of one file."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.labels: list[str] = []
        """The labels of the tuple that the current function returns."""
        self.assigned: set[str] = set()
        """The names of variables and properties that are assigned."""

    def statements(self, nodes: list[SyntaxNode], depth: int = 0) -> tuple[Term, ...]:
        """Returns the terms of statements; `#if` blocks are assembled from their directives."""
        if depth > MAX_DEPTH:
            return ()
        terms: list[Term] = []
        open_: list[_Open] = []
        for node in nodes:
            if node.type == "directive":
                terms = self.directive(node, terms, open_)
            else:
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
            open_[-1][2].append(
                (
                    written.removeprefix("#elseif").strip()
                    if written.startswith("#elseif")
                    else "",
                    arm,
                )
            )
            return arm
        if written.startswith("#endif") and open_:
            return _closed(terms, open_)
        return terms

    def statement(self, node: SyntaxNode, depth: int, terms: list[Term]) -> None:
        kind, at = node.type, span(node)
        if kind == "property_declaration":
            terms += self.declared(node, depth)
        elif kind == "assignment":
            target = node.child_by_field_name("target")
            inner = (
                target.named_children[0] if target is not None and target.named_children else None
            )
            sign, value = fields(node, "operator", "result")
            if inner is not None and sign is not None:
                self.assignment(
                    self.text_of(sign),
                    self.expression(inner, depth),
                    self.expression(value, depth),
                    at,
                    terms,
                )
        elif (
            kind == "infix_expression"
            and node.child_count == 3
            and self.text_of(node.children[1]).endswith("=")
        ):
            # The grammar parses `+=` as an assignment, but `<<=` and similar as custom operators.
            target, sign, value = node.children
            self.assignment(
                self.text_of(sign),
                self.expression(target, depth),
                self.expression(value, depth),
                at,
                terms,
            )
        elif kind == "if_statement":
            terms += self.branches(node, depth)
        elif kind == "guard_statement":
            declared, condition, bodies = self.conditions(node, depth)
            terms += [*declared, (IF, condition, (), bodies[0] if bodies else (), at)]
        elif kind == "for_statement":
            terms.append(self.loop(node, depth))
        elif kind in ("while_statement", "repeat_while_statement"):
            terms.append((LOOP, (), None, self.statements(block(node), depth + 1), at))
        elif kind == "do_statement":
            terms.append((BLOCK, self.statements(block(node), depth + 1), at))
        elif kind == "switch_statement":
            terms += self.cases(node, depth)
        elif kind == "control_transfer_statement":
            result = node.child_by_field_name("result")
            leaving = not self.text.startswith("return", node.start_byte)
            jump = (BREAK if self.text.startswith("break", node.start_byte) else LEAVE, at)
            terms.append(
                jump
                if leaving
                else (RETURN, self.returned(self.expression(result, depth)) if result else None, at)
            )
        elif kind == "function_declaration":
            name = self.text_of(node.child_by_field_name("name"))
            parameters, labels = self.parameters(node)
            terms.append(
                (
                    DECLARE,
                    "",
                    name,
                    (LAMBDA, parameters, self.body(node, labels, depth + 1), at),
                    False,
                    True,
                    at,
                )
            )
        elif kind == "ERROR":
            if depth < MAX_DEPTH:
                terms += self.statements(node.named_children, depth + 20)
        elif not kind.endswith(("declaration", "comment")):
            term = self.expression(node, depth)
            leaves = term[0] == CALL and term[1][0] == NAME and term[1][1] in _LEAVING
            terms.append((LEAVE, at) if leaves else (DO, term, at))

    def returned(self, term: Term) -> Term:
        """Returns a result with the labels of the declared tuple."""
        if (
            len(self.labels) > 1
            and term[:2] == (BRACES, TUPLE)
            and len(term[2]) == len(self.labels)
        ):
            return tuple_of(self.labels, [item for _, item in term[2]], term[-1])
        return term

    def assignment(self, sign: str, target: Term, value: Term, at: Span, terms: list[Term]) -> None:
        if target[:2] == (BRACES, TUPLE):
            parts = [item for _, item in target[2]]
            if value[:2] == (BRACES, TUPLE) and len(value[2]) == len(parts):
                values = [item for _, item in value[2]]
            else:
                terms.append((DECLARE, "", f"({at.start})", value, False, True, at))
                values = [
                    (FIELD, (NAME, f"({at.start})", at), str(n), at) for n in range(len(parts))
                ]
            for part, item in zip(parts, values, strict=True):
                self.assignment(sign, part, item, at, terms)
            return
        if target[0] in (NAME, FIELD):
            self.assigned.add(target[1] if target[0] == NAME else target[2])
        if value[0] == CALL and value[1][:2] == (NAME, ".init"):
            value = (
                CALL,
                (NAME, "MTLRenderPassColorAttachmentDescriptor", value[1][-1]),
                *value[2:],
            )
        terms.append((DO, (ASSIGN, sign, target, value, at), at))

    def branches(self, node: SyntaxNode, depth: int) -> list[Term]:
        """Returns an `if` chain."""
        arms: list[tuple[list[Term], Term, tuple[Term, ...], Span]] = []
        otherwise: tuple[Term, ...] = ()
        while len(arms) < MAX_ARMS:
            declared, condition, bodies = self.conditions(node, depth)
            arms.append((declared, condition, bodies[0] if bodies else (), span(node)))
            next_node = node.children[-1]
            if next_node.type != "if_statement":
                otherwise = bodies[1] if len(bodies) > 1 else ()
                break
            node = next_node
        for declared, condition, body, place in reversed(arms):
            chain: Term = (IF, condition, body, otherwise, place)
            otherwise = ((BLOCK, (*declared, chain), place),) if declared else (chain,)
        return list(otherwise)

    def conditions(
        self, node: SyntaxNode, depth: int
    ) -> tuple[list[Term], Term, list[tuple[Term, ...]]]:
        """Returns the names that an `if` or `guard` binds, its condition, and the statements in
        each of its blocks.
        """
        declared: list[Term] = []
        terms: list[Term] = []
        bodies: list[tuple[Term, ...]] = []
        name: SyntaxNode | None = None
        for index, child in enumerate(node.children):
            kind = child.type
            if name is not None and kind in ("{", ",", "else"):
                terms.append((NAME, self.text_of(name), span(name)))
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
                    term = self.expression(child, depth)
                    if name is not None:
                        bound = self.text_of(name)
                        if term[:2] not in ((NAME, bound), (NAME, f"this->{bound}")):
                            declared.append((DECLARE, "", bound, term, False, True, span(name)))
                        term, name = (NAME, bound, span(name)), None
                    terms.append(term)
        condition = (
            reduce(lambda a, b: (BINARY, "&&", a, b, a[-1]), terms)
            if terms
            else (UNPARSED, "", span(node))
        )
        return declared, condition, bodies

    def loop(self, node: SyntaxNode, depth: int) -> Term:
        item, over = fields(node, "item", "collection")
        body, at = self.statements(block(node), depth + 1), span(node)
        names = self.names(item) if item is not None else ()
        declared = tuple((DECLARE, "", name, None, False, False, at) for name in names if name)
        if over is not None and over.type == "range_expression" and len(declared) == 1:
            start, end = (self.expression(part, depth + 1) for part in fields(over, "start", "end"))
            counter: Term = (NAME, names[0], at)
            sign = "<" if "..<" in self.text_of(over) else "<="
            head = (DECLARE, "", names[0], start, False, False, at)
            steps = (
                (DO, (BINARY, sign, counter, end, at), at),
                *body,
                (DO, (UNARY, "++", counter, at), at),
            )
            return LOOP, (head,), None, steps, at
        return (
            LOOP,
            declared,
            self.expression(over, depth + 1) if over is not None else None,
            body,
            at,
        )

    def cases(self, node: SyntaxNode, depth: int) -> list[Term]:
        """Returns a `switch`, whose cases do not fall through."""
        cases: list[tuple[tuple[Term | None, ...], tuple[Term, ...]]] = []
        for entry in (child for child in node.named_children if child.type == "switch_entry"):
            patterns = [child for child in entry.named_children if child.type == "switch_pattern"][
                :MAX_ARMS
            ]
            labels = tuple(self.pattern(pattern, depth) for pattern in patterns) or (None,)
            cases.append(
                (labels, (*self.statements(block(entry), depth + 1), (BREAK, span(entry))))
            )
        return [
            (
                SWITCH,
                self.expression(node.child_by_field_name("expr"), depth + 1),
                tuple(cases),
                span(node),
            )
        ]

    def pattern(self, node: SyntaxNode, depth: int) -> Term:
        """Returns the value that a pattern matches."""
        written, at = self.text_of(node).strip(), span(node)
        if re.fullmatch(r"[A-Z]?\w*\.\w+", written):
            return NAME, "." + written.rpartition(".")[2], at
        inner = node.named_children[0].named_children if node.named_child_count else []
        if len(inner) == 1 and inner[0].type.endswith("literal"):
            return self.expression(inner[0], depth + 1)
        return UNPARSED, written[:100], at

    def declared(self, node: SyntaxNode, depth: int = 0) -> list[Term]:
        """Returns the names declared by `let` or `var`."""
        terms: list[Term] = []
        names: tuple[str, ...] = ()
        kind, value = "", None
        fixed = any(
            child.type == "value_binding_pattern" and self.text_of(child) == "let"
            for child in node.named_children
        )
        for index, child in enumerate([*node.children, None]):
            field = node.field_name_for_child(index) if child is not None else "name"
            if child is None or (field == "name" and child.type == "pattern"):
                terms += self.bindings(names, kind, value, fixed, span(node))
                names, kind, value = self.names(child) if child is not None else (), "", None
            elif child.type == "type_annotation":
                kind = type_text(self.text_of(child).lstrip(":"))
            elif field == "value":
                value = self.expression(child, depth)
        return terms

    def bindings(
        self, names: tuple[str, ...], kind: str, value: Term | None, fixed: bool, at: Span
    ) -> list[Term]:
        if value is not None and value[0] == CALL and value[1][:2] == (NAME, ".init") and kind:
            value = (CALL, (NAME, kind, value[1][-1]), *value[2:])
        if len(names) == 1:
            return (
                [(DECLARE, kind, names[0], value, False, fixed, at)]
                if names[0] not in ("", "_")
                else []
            )
        if not names or value is None:
            return []
        whole: Term = (DECLARE, "", f"({at.start})", value, False, True, at)
        parts = [(FIELD, (NAME, f"({at.start})", at), str(n), at) for n in range(len(names))]
        return [
            whole,
            *(
                (DECLARE, "", n, part, False, fixed, at)
                for n, part in zip(names, parts, strict=True)
                if n not in ("", "_")
            ),
        ]

    def names(self, node: SyntaxNode) -> tuple[str, ...]:
        """Returns the names that a pattern binds; empty ones are ignored."""
        bound = node.child_by_field_name("bound_identifier")
        if bound is not None:
            return (self.text_of(bound),)
        return tuple(
            self.text_of(child)
            for child in node.named_children
            if child.type in ("pattern", "simple_identifier")
        ) or ("",)

    def body(self, node: SyntaxNode, labels: list[str], depth: int = 0) -> tuple[Term, ...]:
        """Returns the statements of a function."""
        before, self.labels = self.labels, labels
        inner = node.child_by_field_name("body")
        terms = returning(self.statements(block(inner), depth)) if inner is not None else ()
        if len(terms) == 1 and terms[0][0] == RETURN and terms[0][1] is not None:
            terms = ((RETURN, self.returned(terms[0][1]), terms[0][-1]),)
        self.labels = before
        return terms

    def parameters(self, node: SyntaxNode) -> tuple[tuple[Parameter, ...], list[str]]:
        """Returns the parameters of a function, and the labels of the tuple that it returns."""
        parameters: list[Parameter] = []
        labels: list[str] = []
        children = node.children
        for index, child in enumerate(children):
            if child.type == "parameter":
                has_default = (
                    index + 2 < len(children)
                    and node.field_name_for_child(index + 2) == "default_value"
                )
                parameters.append(
                    self.parameter(child, children[index + 2] if has_default else None)
                )
            elif child.type == "tuple_type":
                labels = _LABELS.findall(self.text_of(child)[:2000])
        return tuple(parameters), labels

    def parameter(self, node: SyntaxNode, default: SyntaxNode | None) -> Parameter:
        label, name = fields(node, "external_name", "name")
        written = self.text_of(name)
        kind = self.text_of(node).partition(":")[2].strip()
        outer = self.text_of(label) if label is not None else written
        term = (
            self.expression(default)
            if default is not None
            else (LITERAL, None, span(node))
            if "->" in kind
            else None
        )
        return Parameter(
            type_text(kind),
            written,
            kind.startswith("inout "),
            term,
            label="" if outer == "_" else outer,
        )


def type_text(written: str) -> str:
    """Returns a type without attributes, optional marks, and blanks."""
    return "".join(_TYPE_WORDS.sub("", written.strip()).rstrip("?! ").split())[:200]


def _closed(terms: list[Term], open_: list[_Open]) -> list[Term]:
    """Closes the innermost `#if` and returns the enclosing list."""
    enclosing, place, arms = open_.pop()
    otherwise: tuple[Term, ...] = ()
    for text, arm in reversed(arms):
        otherwise = ((SOME, f"#{text}", tuple(arm), otherwise, place),) if text else tuple(arm)
    enclosing.extend(otherwise)
    return enclosing

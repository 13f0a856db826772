"""Converts C and C++ declarations to terms."""

from __future__ import annotations

import re

from msaa_lint.input.code.core.terms import BRACES, CALL, DECLARE, LITERAL, NAME, Parameter, Term
from msaa_lint.input.code.parsing import SyntaxNode, fields, span, without_comments

from . import shapes
from .expressions import Expressions
from .kinds import BLANKS, MAX_DEPTH, NAMES, NUMBER, number


class Declarations(Expressions):
    """The declarations of one file."""

    def parameters(self, list_node: SyntaxNode | None) -> tuple[Parameter, ...]:
        parameters = []
        for node in list_node.named_children if list_node is not None else ():
            if node.type not in (
                "parameter_declaration",
                "optional_parameter_declaration",
                "variadic_parameter_declaration",
            ):
                continue
            kind, declarator, default = fields(node, "type", "declarator", "default_value")
            name, _, by_reference = self.declarator(declarator)
            text = self.type_text(kind)
            fixed = any(
                c.type == "type_qualifier" and self.text_of(c) == "const"
                for c in node.named_children
            )
            parameters.append(
                Parameter(
                    text,
                    name,
                    by_reference,
                    self.expression(default, 0) if default is not None else None,
                    fixed,
                )
            )
        if len(parameters) == 1 and parameters[0].type == "void" and not parameters[0].name:
            parameters.clear()
        return tuple(parameters)

    def declarator(self, node: SyntaxNode | None) -> tuple[str, SyntaxNode | None, bool]:
        """Returns a declarator's name, its array size, and whether it is a reference or pointer."""
        size: SyntaxNode | None = None
        indirect = False
        for _ in range(MAX_DEPTH):
            if node is None:
                return "", size, indirect
            if node.type in (
                "reference_declarator",
                "pointer_declarator",
                "abstract_reference_declarator",
                "abstract_pointer_declarator",
            ):
                indirect = True
            elif node.type in ("array_declarator", "abstract_array_declarator"):
                size = node.child_by_field_name("size") or node
            elif node.type in NAMES:
                return self.text_of(node), size, indirect
            unqualified = (child for child in node.named_children if child.type != "type_qualifier")
            node = node.child_by_field_name("declarator") or next(unqualified, None)
        return "", size, indirect

    def declared(self, node: SyntaxNode, depth: int = 0) -> list[Term]:
        """Returns the variables of a declaration as terms."""
        text = self.type_text(node.child_by_field_name("type"))
        fixed = any(
            c.type == "type_qualifier" and self.text_of(c) in ("const", "constexpr")
            for c in node.named_children
        )
        terms: list[Term] = []
        defaults = node.children_by_field_name("default_value")
        declarators = node.children_by_field_name("declarator")
        for child in (
            sorted((*declarators, *defaults), key=lambda child: child.start_byte)
            if defaults
            else declarators
        ):
            if child in defaults:
                if terms:
                    terms[-1] = (
                        *terms[-1][:3],
                        self.value(child, terms[-1][1], depth),
                        *terms[-1][4:],
                    )
                continue
            value: Term | None = None
            target, value_node = (
                fields(child, "declarator", "value")
                if child.type == "init_declarator"
                else (child, None)
            )
            if child.type == "function_declarator":
                if node.type != "declaration" or not self.is_construction(child):
                    continue
                target = child.child_by_field_name("declarator")
                list_node = child.child_by_field_name("parameters")
                at = span(child)
                arguments = [self.argument(c, depth) for c in without_comments(list_node)]
                value = (CALL, (NAME, text, at), tuple(arguments), at)
            bound = structured_binding(target)
            if bound is not None and value_node is not None:
                terms += self.bindings(
                    bound,
                    (
                        DECLARE,
                        text,
                        "",
                        self.value(value_node, text, depth),
                        False,
                        fixed,
                        span(bound),
                    ),
                )
            if target is None or bound is not None:
                continue
            name, size, indirect = self.declarator(target)
            if not name:
                continue
            at = span(target)
            extent = (
                BLANKS.sub("", self.text_of(size))
                if size is not None and size.type in ("number_literal", "identifier")
                else ""
            )
            full_type = f"{text}[{extent}]" if size is not None else text
            value = self.value(value_node, full_type, depth) if value_node is not None else value
            terms.append((DECLARE, full_type, name, value, indirect, fixed, at))
        return terms

    def bindings(self, node: SyntaxNode, whole: Term) -> list[Term]:
        """Returns the variables of a structured binding: of the whole, which gets a name, and of
        its elements.
        """
        at = span(node)
        name = f"binding {at.start}"
        elements = [
            (
                DECLARE,
                "auto",
                self.text_of(child),
                (CALL, (NAME, f"std::get<{n}>", at), ((NAME, name, at),), at),
                True,
                False,
                span(child),
            )
            for n, child in enumerate(without_comments(node))
        ]
        return [(*whole[:2], name, *whole[3:]), *elements]

    def is_construction(self, node: SyntaxNode) -> bool:
        """Returns whether an apparent function declaration constructs an object: `Image
        image(device, info);`
        """
        children = without_comments(node.child_by_field_name("parameters"))
        return bool(children) and all(
            c.type == "parameter_declaration" and self.is_argument(*c.named_children)
            for c in children
        )

    @staticmethod
    def is_argument(
        kind: SyntaxNode, declarator: SyntaxNode | None = None, *more: SyntaxNode
    ) -> bool:
        """Returns whether an apparent parameter is a name, or a call `Type()`."""
        if more or kind.type not in ("type_identifier", "qualified_identifier"):
            return False
        if declarator is None:
            return True
        empty = (
            declarator.type == "abstract_function_declarator" and declarator.named_child_count == 1
        )
        return empty and not declarator.named_children[0].named_child_count

    def argument(self, node: SyntaxNode, depth: int) -> Term:
        """Returns the argument that an apparent parameter is."""
        term = self.expression(node.named_children[0], depth)
        return (CALL, term, (), span(node)) if node.named_child_count > 1 else term

    def macro_constant(self, node: SyntaxNode) -> list[Term]:
        """Returns a macro that stands for a value, as a constant."""
        name, value = fields(node, "name", "value")
        if name is None or value is None:
            return []
        text = self.text_of(value).partition("//")[0].strip()
        while text[:1] == "(" and text[-1:] == ")":
            text = text[1:-1].strip()
        at = span(value)
        if re.fullmatch(r"[A-Za-z_][\w:]*", text):
            term: Term = (NAME, text, at)
        elif NUMBER.fullmatch(text):
            term = (LITERAL, number(text), at)
        else:
            return []
        return [(DECLARE, "auto", self.text_of(name), term, False, True, at)]

    def enumerators(self, node: SyntaxNode) -> list[Term]:
        """Returns the enumerators of an enum as constants, with and without the name of the
        enum.
        """
        list_node, owner = fields(node, "body", "name")
        terms: list[Term] = []
        next_node = 0
        for child in list_node.named_children if list_node is not None else ():
            name, value_node = fields(child, "name", "value")
            if child.type != "enumerator" or name is None:
                continue
            at = span(name)
            term: Term = (
                self.expression(value_node, 0)
                if value_node is not None
                else (LITERAL, next_node, at)
            )
            next_node = term[1] + 1 if term[0] == LITERAL and isinstance(term[1], int) else -(2**31)
            prefixes = ("", f"{self.text_of(owner)}::") if owner is not None else ("",)
            terms += [
                (DECLARE, "int", prefix + self.text_of(name), term, False, True, at)
                for prefix in prefixes
            ]
        return terms

    def value(self, node: SyntaxNode, kind: str, depth: int) -> Term:
        """Returns the term of an initializer; braces and parentheses construct the declared
        type.
        """
        at = span(node)
        if node.type == "argument_list":
            return (
                CALL,
                (NAME, kind, at),
                tuple(self.expression(c, depth + 1) for c in without_comments(node)),
                at,
            )
        term = self.expression(node, depth)
        return (
            (BRACES, kind, *term[2:])
            if term[0] == BRACES and not term[1]
            else shapes.zeroed(kind, term) or term
        )


def structured_binding(node: SyntaxNode | None) -> SyntaxNode | None:
    """Returns the `[a, b]` of a declarator, or None."""
    while node is not None and node.type == "reference_declarator" and node.named_child_count:
        node = node.named_children[-1]
    return node if node is not None and node.type == "structured_binding_declarator" else None

"""Converts C and C++ expressions to terms."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Iterator

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import (
    ADDRESS,
    ASSIGN,
    BINARY,
    BRACES,
    CALL,
    CHOICE,
    FIELD,
    INDEX,
    LAMBDA,
    LITERAL,
    NAME,
    SOME,
    TARGET,
    UNARY,
    UNPARSED,
    Parameter,
    Term,
    short_name,
)
from msaa_lint.input.code.parsing import SyntaxNode, SyntaxReader, fields, span, without_comments

from . import shapes
from .directives import Sections
from .kinds import BLANKS, CLASSES, MAX_DEPTH, MAX_NAME, NAMES, WORD, number

WRAPPERS = frozenset(
    {"parenthesized_expression", "cast_expression", "condition_clause", "co_await_expression"}
)

API_TYPES = ("vk::", "Vk", "VULKAN")
"""What the names of the types of Vulkan start with."""

OWNERS = frozenset(
    {"make_unique", "make_shared", "MakeUnique", "MakeShared", "CreateRef", "CreateScope"}
)
"""Functions that construct an object of the type that is their template argument."""

KEYWORDS = re.compile(r"\b(?:const|struct|typename|class)\b")
"""Words that types may have or not."""

CASTS = frozenset({"static_cast", "reinterpret_cast", "const_cast", "bit_cast"})


def unwrapped(node: SyntaxNode | None) -> SyntaxNode | None:
    """Returns an expression without the parentheses around it."""
    while (
        node is not None and node.type == "parenthesized_expression" and node.named_child_count == 1
    ):
        node = node.named_children[0]
    return node


class Expressions(SyntaxReader, ABC):
    """The expressions of one file."""

    text: str
    current: str
    aliases: dict[str, str]
    """The types that aliases stand for."""
    called_names: set[str]
    sections: Sections

    @abstractmethod
    def parameters(self, node: SyntaxNode | None) -> tuple[Parameter, ...]:
        """Returns the parameters of a function."""

    @abstractmethod
    def block(self, node: SyntaxNode, depth: int) -> list[Term]:
        """Returns the statements of a block."""

    def type_text(self, node: SyntaxNode | None) -> str:
        """Returns the text of a type without whitespace, `const`, and `struct`."""
        if node is None or node.end_byte - node.start_byte > MAX_NAME:
            return ""
        if node.type in CLASSES or node.type == "enum_specifier":
            return self.text_of(node.child_by_field_name("name"))
        text = self.text_of(node)
        return self.resolve_aliases(
            text if text.isidentifier() else BLANKS.sub("", KEYWORDS.sub(" ", text))
        )

    def resolve_aliases(self, name: str) -> str:
        """Returns a name with aliases resolved: those of `namespace v = vk;` and `using Samples =
        ...;`.
        """
        return (
            WORD.sub(lambda match: self.aliases.get(match[0], match[0]), name)
            if self.aliases
            else name
        )

    def expression(self, node: SyntaxNode | None, depth: int) -> Term:
        """Returns the term of an expression."""
        if node is None or depth > MAX_DEPTH:
            return (UNPARSED, "", span(node) if node is not None else Span(0, 0))
        kind, at, deeper = node.type, span(node), depth + 1
        if kind in NAMES:
            name = self.text_of(node)
            if len(name) > MAX_NAME:
                return (UNPARSED, "", at)
            return (
                (LITERAL, None, at)
                if name == "VK_NULL_HANDLE"
                else (
                    NAME,
                    self.resolve_aliases(name if name.isidentifier() else BLANKS.sub("", name)),
                    at,
                )
            )
        if kind == "field_expression":
            member = node.child_by_field_name("field")
            if member is None:
                return (UNPARSED, self.text_of(node), at)
            if self.text.startswith("*", member.start_byte - 1):
                # A pointer to a member.
                return (
                    INDEX,
                    *self.parts(node, deeper, "argument"),
                    (UNPARSED, "", span(member)),
                    at,
                )
            name = self.text_of(member)[:MAX_NAME].partition("<")[0].rpartition("::")[2]
            return (FIELD, *self.parts(node, deeper, "argument"), name, span(member))
        if kind == "call_expression":
            return self.call(node, deeper, at)
        if kind == "number_literal":
            literal = number(self.text_of(node))
            return (
                (LITERAL, literal, at)
                if literal is not None
                else (UNPARSED, self.text_of(node)[:40], at)
            )
        if kind in ("true", "false", "null"):
            return (LITERAL, None if kind == "null" else kind == "true", at)
        if kind == "initializer_list":
            return (BRACES, "", tuple(self.items(node, deeper)), at)
        if kind == "compound_literal_expression":
            type_node, value_node = fields(node, "type", "value")
            return (
                BRACES,
                self.type_text(type_node),
                tuple(self.items(value_node, deeper)) if value_node is not None else (),
                at,
            )
        if kind in WRAPPERS:
            inner = node.child_by_field_name("value") or (
                node.named_children[-1] if node.named_child_count else None
            )
            term = self.expression(inner, deeper)
            type_node = node.child_by_field_name("type")
            typed = kind == "cast_expression" and term[0] == BRACES and type_node is not None
            return (BRACES, self.type_text(type_node), *term[2:]) if typed else term
        sign = node.child_by_field_name("operator")
        operator = self.text_of(sign)
        if kind == "binary_expression":
            if operator == "/" and (counted := self.counted(node)) is not None:
                return (CALL, (NAME, shapes.COUNT, at), (self.expression(counted, deeper),), at)
            return (BINARY, operator, *self.parts(node, deeper, "left", "right"), at)
        if kind == "assignment_expression":
            return (ASSIGN, operator or "=", *self.parts(node, deeper, "left", "right"), at)
        if kind == "conditional_expression":
            return (
                CHOICE,
                *self.parts(node, deeper, "condition", "consequence", "alternative"),
                at,
            )
        if kind == "pointer_expression":
            return (
                ADDRESS if operator == "&" else TARGET,
                *self.parts(node, deeper, "argument"),
                at,
            )
        if kind == "unary_expression":
            return (UNARY, operator, *self.parts(node, deeper, "argument"), at)
        if kind == "update_expression":
            operand = node.child_by_field_name("argument")
            after = (
                sign is not None and operand is not None and operand.start_byte < sign.start_byte
            )
            return (
                UNARY,
                ("post" if after else "") + operator,
                self.expression(operand, deeper),
                at,
            )
        if kind == "subscript_expression":
            index = node.child_by_field_name("indices") or node.child_by_field_name("index")
            if (
                index is not None
                and index.type == "subscript_argument_list"
                and index.named_child_count
            ):
                index = index.named_children[0]
            return (
                INDEX,
                *self.parts(node, deeper, "argument"),
                self.expression(index, deeper),
                at,
            )
        if kind == "lambda_expression":
            declarator, body = fields(node, "declarator", "body")
            list_node = (
                declarator.child_by_field_name("parameters") if declarator is not None else None
            )
            return (
                LAMBDA,
                self.parameters(list_node),
                tuple(self.block(body, deeper)) if body is not None else (),
                at,
            )
        if kind in ("comma_expression", "ERROR") and node.named_child_count:
            return self.expression(node.named_children[-1], deeper)
        if kind == "new_expression":
            type_node, list_node, array = fields(node, "type", "arguments", "declarator")
            if type_node is not None and array is not None:
                length = self.expression(array.child_by_field_name("length"), deeper)
                return (CALL, (NAME, f"{self.type_text(type_node)}[]", at), (length,), at)
            if type_node is not None:
                self.called_names.add(short_name(self.type_text(type_node)))
                arguments = tuple(
                    self.expression(child, deeper) for child in without_comments(list_node)
                )
                return (CALL, (NAME, self.type_text(type_node), at), arguments, at)
        return (UNPARSED, self.text_of(node) if node.end_byte - node.start_byte < 200 else "", at)

    def parts(self, node: SyntaxNode, depth: int, *names: str) -> Iterator[Term]:
        """Yields the terms of the expressions in some fields of a node."""
        return (self.expression(child, depth) for child in fields(node, *names))

    def call(self, node: SyntaxNode, depth: int, at: Span) -> Term:
        function, list_node = fields(node, "function", "arguments")
        argument_nodes = without_comments(list_node)
        if function is not None and function.type == "template_function":
            name = function.child_by_field_name("name")
            if (
                name is not None
                and self.text_of(name).rpartition("::")[2] in CASTS
                and len(argument_nodes) == 1
            ):
                return self.expression(argument_nodes[0], depth)
        if len(argument_nodes) == 1 and self.text_of(function) in ("std::move", "std::as_const"):
            return self.expression(argument_nodes[0], depth)
        terms = (self.expression(child, depth) for child in argument_nodes)
        shifted = (
            list_node is not None and list_node.has_error and self.has_directives(argument_nodes)
        )
        arguments = tuple(
            self.ordered_arguments(argument_nodes, terms, shifted)
            if shifted or self.sections
            else terms
        )
        term = self.expression(function, depth)
        if (
            term[0] == CALL
            and len(term[2]) == 1
            and term[2][0][0] == NAME
            and term[1][0] == NAME
            and term[1][1].isupper()
        ):
            # `VK_CALL(vkCreateImage)(device)`
            term = term[2][0]
        if term[0] == FIELD and term[2] == "get" and not arguments and function is not None:
            # `chain.get<vk::SubpassDescription2>()`
            kind = self.resolve_aliases(self.text_of(function).rpartition("get<")[2][:-1])
            arguments = ((NAME, kind, at),) if kind.startswith(API_TYPES) else ()
        standard = shapes.called(term, arguments)
        if standard:
            term = (NAME, standard, term[-1])
        named = term[1] if term[0] == NAME else term[2] if term[0] == FIELD else ""
        short = short_name(str(named))
        if short != self.current or (term[0] == FIELD and term[1][:2] != (NAME, "this")):
            self.called_names.add(short)
        if short in OWNERS and term[0] == NAME and term[1].endswith(">"):
            self.called_names.add(short_name(term[1].partition("<")[2][:-1]))
        return (CALL, term, arguments, at)

    def counted(self, node: SyntaxNode) -> SyntaxNode | None:
        """Returns the array of `sizeof(array) / sizeof(array[0])`, or None."""
        sizes = [unwrapped(child) for child in fields(node, "left", "right")]
        if any(size is None or size.type != "sizeof_expression" for size in sizes):
            return None
        array = unwrapped(sizes[0].child_by_field_name("value")) if sizes[0] is not None else None
        if array is None or array.type not in ("identifier", "field_expression"):
            return None
        element = unwrapped(sizes[1].child_by_field_name("value")) if sizes[1] is not None else None
        if element is not None and element.type in ("subscript_expression", "pointer_expression"):
            element = element.child_by_field_name("argument")
            return array if self.text_of(unwrapped(element)) == self.text_of(array) else None
        # Parentheses around a type look like those around a name.
        return array if element is None or element.type == "identifier" else None

    def items(
        self, node: SyntaxNode, depth: int
    ) -> Iterator[tuple[tuple[str | int, ...] | None, Term]]:
        """Yields the items in braces: the designated members or None, and the term."""
        nodes = node.named_children
        if node.has_error and self.has_directives(nodes):
            # The result of the preprocessor is unknown.
            at = span(node)
            yield None, (SOME, "#", True, (UNPARSED, "", at), at)
            return
        for child in nodes:
            if child.type == "comment" or depth > MAX_DEPTH:
                continue
            if child.type != "initializer_pair":
                yield None, self.conditional_item(child, self.expression(child, depth))
                continue
            path: list[str | int] = []
            value_node = child.child_by_field_name("value")
            for part in child.children_by_field_name("designator"):
                inner = part.named_children[0] if part.named_child_count else None
                if inner is None:
                    continue
                if part.type == "subscript_designator":
                    index = self.expression(inner, depth)
                    path.append(
                        index[1]
                        if index[0] == LITERAL and isinstance(index[1], int)
                        else f"[{self.text_of(inner)}"
                    )
                else:
                    path.append(self.text_of(inner))
            yield tuple(path), self.conditional_item(child, self.expression(value_node, depth))

    def has_directives(self, nodes: list[SyntaxNode]) -> bool:
        """Returns whether a preprocessor directive remains between the items of a list."""
        return any(
            child.is_error and self.text.startswith("#", child.start_byte) for child in nodes
        )

    def conditional_item(self, node: SyntaxNode, term: Term) -> Term:
        """Returns the term of a list item with the conditions under which it exists; an item that
        is only partly conditional is unknown.
        """
        if not self.sections:
            return term
        sections = self.sections.of(node.start_byte)
        if sections is None or (
            self.sections.starts_in(node.start_byte, node.end_byte)
            and term[0] not in (BRACES, CALL, LAMBDA)
        ):
            return (UNPARSED, "", term[-1])
        for section in sections:
            term = (SOME, section.text, section.way, term, term[-1])
        return term

    def ordered_arguments(
        self, nodes: list[SyntaxNode], terms: Iterator[Term], shifted: bool
    ) -> Iterator[Term]:
        """Yields arguments; from the first conditional argument on, or if they are `shifted`, they
        are unknown.
        """
        for node, term in zip(nodes, terms, strict=True):
            argument = self.conditional_item(node, term)
            shifted = shifted or argument[0] == SOME
            yield (UNPARSED, "", term[-1]) if shifted else argument

"""Converts the declarations of a Rust file to terms."""

from __future__ import annotations

import re

from msaa_lint.input.code.core.terms import DECLARE, LITERAL, Function, Parameter, Term, Unit
from msaa_lint.input.code.parsing import Code, SyntaxNode, fields, span

from .expressions import MAX_DEPTH
from .imports import Imports
from .render_passes import RenderPassMacros

_TEST = re.compile(r"#\[\s*(?:cfg\s*\(\s*test\s*\)|test\s*\])")
_LIST_MACRO = re.compile(r"\bvec!(?=\s*\[)")


def prepared(code: Code) -> Code:
    """Returns code in which `vec![...]` is a list, as the grammar does not read the arguments of
    macros.
    """
    return code._replace(text=_LIST_MACRO.sub("    ", code.text))


def unit(code: Code, root: SyntaxNode) -> Unit:
    """Returns the functions, the members of structures, and the constants of a file that `prepared`
    returned.
    """
    return _Reader(code.text).unit(root)


class _Reader(RenderPassMacros):
    """Reads one file."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.imports = Imports()
        self.class_name = ""
        self.current = ""
        self.called_names: set[str] = set()
        self.members: dict[str, list[Term]] = {}
        self.outside: list[Term] = []
        self.found: list[tuple[str, SyntaxNode]] = []
        """The type that each function belongs to, and its node."""
        self.traits: set[str] = set()
        """The names of functions that types implement for traits, which a call cannot tell
        apart.
        """

    def unit(self, root: SyntaxNode) -> Unit:
        self.read_declarations(root)
        functions = [self.function(class_name, node) for class_name, node in self.found]
        return Unit(
            [function for function in functions if function is not None],
            self.members,
            self.outside,
            {},
            self.called_names,
        )

    def read_declarations(self, root: SyntaxNode) -> None:
        items: list[tuple[str, SyntaxNode]] = []
        stack: list[tuple[str, SyntaxNode, int]] = [("", root, 0)]
        while stack:
            class_name, node, depth = stack.pop()
            skipped = False
            inner: list[tuple[str, SyntaxNode, int]] = []
            for child in node.named_children if depth < MAX_DEPTH else ():
                kind = child.type
                if kind == "attribute_item":
                    skipped = skipped or _TEST.match(self.text, child.start_byte) is not None
                    continue
                if skipped:
                    skipped = False
                    continue
                if kind == "use_declaration":
                    self.imports.add(child, self.text)
                elif kind in ("mod_item", "impl_item", "trait_item", "ERROR"):
                    owner = class_name if kind in ("mod_item", "ERROR") else self.owner(child)
                    body = child.child_by_field_name("body") if kind != "ERROR" else child
                    if body is not None:
                        inner.append((owner, body, depth + 1))
                else:
                    items.append((class_name, child))
                    if kind in ("struct_item", "enum_item"):
                        self.imports.declared.add(self.text_of(child.child_by_field_name("name")))
            stack += reversed(inner)
        for class_name, child in items:
            self.class_name = class_name
            self.declaration(class_name, child)

    def owner(self, node: SyntaxNode) -> str:
        """Returns the name of the type that an `impl` or a trait is for."""
        kind = node.child_by_field_name("type") or node.child_by_field_name("name")
        while kind is not None and kind.type in ("generic_type", "reference_type"):
            kind = kind.child_by_field_name("type")
        return self.text_of(kind).rpartition("::")[2]

    def declaration(self, class_name: str, node: SyntaxNode) -> None:
        kind = node.type
        if kind == "function_item":
            self.found.append((class_name, node))
        elif kind in ("const_item", "static_item"):
            terms = self.constant(node)
            prefix = f"{class_name}::" if class_name else ""
            self.outside += [(*term[:2], prefix + term[2], *term[3:]) for term in terms]
        elif kind == "struct_item":
            self.structure_members(node)
        elif kind == "enum_item":
            self.enumerators(node)

    def structure_members(self, node: SyntaxNode) -> None:
        name, body = fields(node, "name", "body")
        terms = self.members.setdefault(self.text_of(name), [])
        for child in body.named_children if body is not None else ():
            member, kind = fields(child, "name", "type")
            if child.type == "field_declaration" and member is not None:
                terms.append(
                    (
                        DECLARE,
                        self.type_text(kind),
                        self.text_of(member),
                        None,
                        False,
                        False,
                        span(member),
                    )
                )

    def enumerators(self, node: SyntaxNode) -> None:
        """Adds the variants of an enum without fields as constants."""
        name, body = fields(node, "name", "body")
        number = 0
        for child in body.named_children if body is not None else ():
            variant, value = fields(child, "name", "value")
            if (
                child.type != "enum_variant"
                or variant is None
                or child.child_by_field_name("body") is not None
            ):
                continue
            literal = (
                self.expression(value, 0) if value is not None else (LITERAL, number, span(variant))
            )
            number = (
                literal[1] + 1 if literal[0] == LITERAL and type(literal[1]) is int else number + 1
            )
            owner = f"{self.text_of(name)}::{self.text_of(variant)}"
            self.outside.append((DECLARE, "int", owner, literal, False, True, span(variant)))

    def function(self, class_name: str, node: SyntaxNode) -> Function | None:
        name, list_node, kind, body = fields(node, "name", "parameters", "return_type", "body")
        if name is None or body is None:
            return None
        self.class_name, self.current = class_name, self.text_of(name)
        parameters: list[Parameter] = []
        for child in list_node.named_children if list_node is not None else ():
            if child.type != "parameter":
                continue
            pattern, type_node = fields(child, "pattern", "type")
            by_reference = type_node is not None and type_node.type == "reference_type"
            parameters.append(
                Parameter(self.type_text(type_node), self.bound_name(pattern), by_reference, None)
            )
        statements = self.block(body, 0, True)
        return Function(
            self.current,
            class_name,
            self.type_text(kind),
            tuple(parameters),
            statements,
            span(name),
        )

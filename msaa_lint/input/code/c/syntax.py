"""Converts C and C++ syntax trees to terms.

Constructs that no rule depends on stay UNPARSED, and parse errors are skipped: macros cause parse
errors in most real files, but rarely where a structure is filled in.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from msaa_lint.input.code.core.terms import (
    ASSIGN,
    CALL,
    DO,
    FIELD,
    NAME,
    Function,
    Parameter,
    Term,
    Unit,
)
from msaa_lint.input.code.parsing import (
    Code,
    SyntaxNode,
    fields,
    function_declarator,
    span,
    without_comments,
)

from .directives import Section, Sections
from .kinds import CLASSES, MAX_DEPTH, NAMES
from .relevance import is_about_graphics, is_accessor, relevant
from .statements import Statements

VIRTUAL = re.compile(r"\b(?:virtual|override)\b")

CONTAINERS = frozenset({
    "translation_unit", "namespace_definition", "declaration_list", "linkage_specification",
    "template_declaration", "preproc_if",
    "preproc_ifdef", "preproc_else", "preproc_elif", "preproc_elifdef", "ERROR",
    "compound_statement",
})  # fmt: skip


def unit(code: Code, root: SyntaxNode, sections: tuple[Section, ...] = ()) -> Unit:
    """Returns the functions, class members, and global declarations of a file. `sections` are the
    conditional parts of lists.
    """
    return Reader(code.text, code.fragments, sections).unit(root)


class Reader(Statements):
    """Reads one file."""

    def __init__(self, text: str, fragments: bool, sections: tuple[Section, ...]) -> None:
        self.text = text
        self.sections = Sections(sections)
        self.fragments = fragments
        self.found: list[tuple[str, str, SyntaxNode]] = []
        """The namespace, the class, and the node of each function."""
        self.members: dict[str, list[Term]] = {}
        self.prototypes: dict[str, tuple[Parameter, ...]] = {}
        """The parameters of declared functions by name."""
        self.outside: list[Term] = []
        self.current = ""
        self.public: set[int] = set()
        """The start offsets of public member declarations."""
        self.virtual: set[str] = set()
        """Virtual methods, each with its class."""
        self.visible: set[str] = set()
        """Public members, as `Class::member`."""
        self.bases: dict[str, list[str]] = {}
        """The classes that each class derives from."""
        self.aliases: dict[str, str] = {}
        self.named: dict[str, str] = {}
        """What aliases stand for that other files may use."""
        self.called_names: set[str] = set()
        """The names of functions that other functions call."""

    def unit(self, root: SyntaxNode) -> Unit:
        self.read_declarations(root)
        functions = [
            (self.function(node, *names), matters)
            for (*names, node), matters in self.functions_to_read()
        ]
        read = [
            function._replace(only_called=not matters)
            for function, matters in functions
            if function is not None
        ]
        names = {name: stands for name, stands in self.named.items() if stands != name}
        return Unit(
            read,
            self.members,
            self.outside,
            self.prototypes,
            self.called_names,
            self.virtual,
            self.bases,
            self.visible,
            aliases=names,
        )

    def read_declarations(self, root: SyntaxNode) -> None:
        """Reads everything that can contain functions: namespaces, classes, and preprocessor
        blocks.
        """
        stack: list[tuple[str, str, SyntaxNode, int]] = [("", "", root, 0)]
        while stack:
            namespace, class_name, node, depth = stack.pop()
            kind = node.type
            if kind in CONTAINERS or kind == "field_declaration_list":
                if kind == "namespace_definition":
                    name = node.child_by_field_name("name")
                    namespace = (
                        f"{namespace}{self.text_of(name)}::" if name is not None else namespace
                    )
                if kind == "field_declaration_list":
                    self.note_public_members(node)
                if depth < MAX_DEPTH:
                    stack += [
                        (namespace, class_name, child, depth + 1)
                        for child in reversed(node.named_children)
                    ]
            elif kind in CLASSES:
                name, body = fields(node, "name", "body")
                if body is not None:
                    full_name = f"{class_name}::" if class_name else namespace
                    full_name = (
                        f"{full_name}{self.text_of(name)}" if name is not None else class_name
                    )
                    self.note_bases(node, full_name if name is not None else "")
                    stack.append((namespace, full_name, body, depth + 1))
            elif kind == "function_definition":
                if node.child_by_field_name("body") is not None:
                    self.found.append((namespace, class_name, node))
            elif kind == "field_declaration":
                self.queue_class(node, stack, namespace, class_name, depth)
                if class_name:
                    terms = self.declared(node)
                    if node.start_byte in self.public:
                        # Any code may change a public member, so its initial value says nothing.
                        self.visible |= {
                            f"{class_name}::{term[2]}" for term in terms if not term[5]
                        }
                    self.members.setdefault(class_name, []).extend(terms)
                    self.note_prototype(node)
                    self.note_virtual_methods(node, class_name)
            elif kind == "declaration":
                self.queue_class(node, stack, namespace, class_name, depth)
                self.outside += [
                    (*term[:2], namespace + term[2], *term[3:]) for term in self.declared(node)
                ]
                self.note_prototype(node)
            elif kind == "preproc_def":
                parent = node.parent
                tested = (
                    parent.child_by_field_name("name")
                    if parent is not None and parent.type == "preproc_ifdef"
                    else None
                )
                # In `#ifndef N`, `#define N 4`, the build may define another value.
                if tested is None or self.text_of(tested) != self.text_of(
                    node.child_by_field_name("name")
                ):
                    self.outside += self.macro_constant(node)
            elif kind == "type_definition":
                self.queue_class(
                    node,
                    stack,
                    namespace,
                    self.named_by_typedef(node, namespace) or class_name,
                    depth,
                )
                self.alias(node)
            elif kind in ("namespace_alias_definition", "alias_declaration"):
                self.alias(node)
            elif kind == "enum_specifier":
                self.outside += [
                    (*term[:2], namespace + term[2], *term[3:]) for term in self.enumerators(node)
                ]
            elif self.fragments:
                # Pages show statements without their function.
                self.outside += self.statement(node, 0)

    def named_by_typedef(self, node: SyntaxNode, namespace: str) -> str:
        """Returns the name that `typedef struct {...} Name;` gives a structure. Beside its own
        name, that is like a derived class.
        """
        struct, name = fields(node, "type", "declarator")
        if (
            struct is None
            or struct.type not in CLASSES
            or name is None
            or name.type != "type_identifier"
        ):
            return ""
        tag, alias = struct.child_by_field_name("name"), f"{namespace}{self.text_of(name)}"
        if tag is not None and alias != f"{namespace}{self.text_of(tag)}":
            self.bases[alias] = [self.text_of(tag)]
        return alias

    @staticmethod
    def queue_class(
        node: SyntaxNode,
        stack: list[tuple[str, str, SyntaxNode, int]],
        namespace: str,
        class_name: str,
        depth: int,
    ) -> None:
        kind = node.child_by_field_name("type")
        if kind is not None and (kind.type in CLASSES or kind.type == "enum_specifier"):
            stack.append((namespace, class_name, kind, depth + 1))

    def functions_to_read(self) -> Iterator[tuple[tuple[str, str, SyntaxNode], bool]]:
        """Yields the functions that mention multisampling, and their callers, transitively; and
        with False those that say something only where they are called: accessors, and constructors
        that initialize members.
        """
        names = [(self.function_name(node),) for _, _, node in self.found]
        matters = relevant(
            [self.text_of(node) for _, _, node in self.found], names, is_about_graphics(self.text)
        )
        for found, kept in zip(self.found, matters, strict=True):
            body = found[2].child_by_field_name("body")
            if (
                kept
                or is_initializing(found[2])
                or (body is not None and is_accessor(self.text_of(body)[1:-1]))
            ):
                yield found, kept

    def note_public_members(self, node: SyntaxNode) -> None:
        """Records which members of a class are public."""
        parent = node.parent
        public = parent is not None and parent.type != "class_specifier"
        for child in node.named_children:
            if child.type == "access_specifier":
                public = self.text_of(child).startswith("public")
            elif public:
                self.public.add(child.start_byte)

    def note_bases(self, node: SyntaxNode, class_name: str) -> None:
        """Records the classes that a class derives from."""
        for child in node.named_children if class_name else ():
            if child.type == "base_class_clause":
                bases = [
                    self.type_text(base) for base in child.named_children if base.type in NAMES
                ]
                self.bases[class_name] = bases

    def note_virtual_methods(self, node: SyntaxNode, class_name: str) -> None:
        if VIRTUAL.search(self.text_of(node)):
            _, name = function_declarator(node)
            if name is not None:
                self.virtual.add(f"{class_name}::{self.text_of(name)}")

    def alias(self, node: SyntaxNode) -> None:
        """Records a namespace alias, a `using`, or a `typedef` of one type name."""
        name = node.child_by_field_name("name") or node.child_by_field_name("declarator")
        stands = node.child_by_field_name("type") or (
            node.named_children[-1] if node.named_child_count > 1 else None
        )
        if (
            name is None
            or stands is None
            or stands.end_byte - stands.start_byte >= 100
            or len(self.aliases) >= 200
        ):
            return
        text = self.type_text(stands)
        alias, is_name = (
            self.text_of(name),
            node.type != "type_definition" or name.type == "type_identifier",
        )
        is_template = node.parent is not None and node.parent.type == "template_declaration"
        if is_name and not is_template and text and text.rpartition("::")[2] != alias:
            self.named[alias] = text if self.named.get(alias, text) == text else alias
        if text.startswith(("vk", "Vk", "VULKAN")) and (
            node.type != "type_definition" or name.type == stands.type == "type_identifier"
        ):
            self.aliases[self.text_of(name)] = text

    def note_prototype(self, node: SyntaxNode) -> None:
        declarator, name = function_declarator(node)
        if declarator is not None and name is not None:
            parameters = self.parameters(declarator.child_by_field_name("parameters"))
            self.prototypes.setdefault(self.text_of(name).rpartition("::")[2], parameters)

    def function_name(self, node: SyntaxNode) -> str:
        return self.text_of(function_declarator(node)[1]).rpartition("::")[2].strip()

    def function(self, node: SyntaxNode, namespace: str, class_name: str) -> Function | None:
        declarator, name = function_declarator(node)
        body = node.child_by_field_name("body")
        if declarator is None or name is None or body is None:
            return None
        qualifier, _, short = self.type_text(name).rpartition("::")
        kind = self.type_text(node.child_by_field_name("type"))
        if kind in ("auto", ""):
            trailing = next(
                (c for c in declarator.named_children if c.type == "trailing_return_type"), None
            )
            kind = self.type_text(trailing).removeprefix("->") or kind
        owner = class_name or (namespace + qualifier if qualifier else "")
        self.current = short
        statements = tuple(self.initializer(node)) + tuple(self.block(body, 0))
        parameters = self.parameters(declarator.child_by_field_name("parameters"))
        declared = self.prototypes.get(short, ())
        if len(declared) == len(parameters):
            parameters = tuple(
                item._replace(default=item.default or entry.default)
                for item, entry in zip(parameters, declared, strict=True)
            )
        overridden = (
            VIRTUAL.search(self.text, node.start_byte, body.start_byte) is not None
            or f"{owner}::{short}" in self.virtual
        )
        returns = node.child_by_field_name("declarator")
        by_reference = returns is not None and returns.type == "reference_declarator"
        return Function(
            short,
            owner,
            kind,
            parameters,
            statements,
            span(name),
            namespace,
            overridden,
            by_reference=by_reference,
        )

    def initializer(self, node: SyntaxNode) -> Iterator[Term]:
        """Yields the assignments of a constructor's initializer list."""
        match = next((c for c in node.named_children if c.type == "field_initializer_list"), None)
        for child in match.named_children if match is not None else ():
            if child.type == "field_initializer" and child.named_child_count == 2:
                name, value = child.named_children
                items = [self.expression(c, 0) for c in without_comments(value)]
                at = span(name)
                term = items[0] if len(items) == 1 else (CALL, (NAME, "", at), tuple(items), at)
                # A parameter may have the name of the member.
                yield (
                    DO,
                    (ASSIGN, "=", (FIELD, (NAME, "this", at), self.text_of(name), at), term, at),
                    at,
                )


def is_initializing(node: SyntaxNode) -> bool:
    """Returns whether a function is a constructor with initializers of members."""
    return any(child.type == "field_initializer_list" for child in node.named_children)

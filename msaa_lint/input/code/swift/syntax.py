"""Converts a Swift file to terms."""

from __future__ import annotations

from msaa_lint.input.code.core.terms import DECLARE, LITERAL, Function, Term, Unit
from msaa_lint.input.code.parsing import Code, SyntaxNode, span

from .expressions import block, returning
from .statements import Statements


def unit(code: Code, root: SyntaxNode) -> Unit:
    """Returns the functions, type members, and global declarations and statements of a file."""
    return _Reader(code.text, code.fragments).unit(root)


class _Reader(Statements):
    """Reads one file."""

    def __init__(self, text: str, fragments: bool) -> None:
        super().__init__(text)
        self.fragments = fragments
        self.functions: list[Function] = []
        self.members: dict[str, list[Term]] = {}
        self.constants: list[Term] = []
        self.bases: dict[str, tuple[str, ...]] = {}
        self.visible: set[str] = set()
        self.hidden: set[str] = set()
        """Variables that only this file can assign."""
        self.overridden: set[str] = set()

    def unit(self, root: SyntaxNode) -> Unit:
        outside: list[SyntaxNode] = []
        stack: list[tuple[SyntaxNode, str]] = [(root, "")]
        while stack:
            node, class_name = stack.pop()
            inner: list[tuple[SyntaxNode, str]] = []
            for child in node.named_children:
                if child.type == "class_declaration":
                    name = self.type_declaration(child)
                    body = child.child_by_field_name("body")
                    if body is not None:
                        inner.append((body, name))
                elif child.type == "ERROR":
                    inner.append((child, class_name))
                elif child.type == "statements":
                    outside.extend(child.named_children)
                elif class_name or child.type in ("function_declaration", "init_declaration"):
                    self.member_declaration(child, class_name)
                else:
                    outside.append(child)
            stack.extend(reversed(inner))
        outside.sort(key=lambda node: node.start_byte)
        self.own_class = ""
        statements = self.statements(outside)
        functions = self.functions
        if not self.fragments:
            functions = [Function("", "", "", (), statements, span(root)), *functions]
        functions = [
            f._replace(open=f.open or f"{f.class_name}::{f.name}" in self.overridden)
            for f in functions
        ]
        globals_ = [
            *self.constants,
            *(
                statements
                if self.fragments
                else [term for term in statements if term[0] == DECLARE]
            ),
        ]
        return Unit(
            functions,
            self.settled(),
            globals_,
            {},
            self.called_names,
            bases=self.bases,
            visible=self.visible,
        )

    def settled(self) -> dict[str, list[Term]]:
        """Returns the members of each type; a variable that nothing assigns and no other file can
        is constant.
        """
        return {
            name: [
                (
                    *t[:5],
                    t[5] or (f"{name}::{t[2]}" in self.hidden and t[2] not in self.assigned),
                    t[6],
                )
                for t in terms
            ]
            for name, terms in self.members.items()
        }

    def type_declaration(self, node: SyntaxNode) -> str:
        """Returns the name of the type that a declaration or an extension belongs to."""
        name = node.child_by_field_name("name")
        written = (
            self.text_of(name).partition("<")[0].rpartition(".")[2] if name is not None else "?"
        )
        bases = tuple(
            self.text_of(child)[:100]
            for child in node.named_children
            if child.type == "inheritance_specifier"
        )
        self.bases[written] = (*self.bases.get(written, ()), *bases)
        self.members.setdefault(written, [])
        return written

    def member_declaration(self, node: SyntaxNode, class_name: str) -> None:
        """Adds a declaration in the body of a type."""
        kind = node.type
        self.own_class = class_name
        modifiers = self.modifiers(node)
        if kind in ("function_declaration", "init_declaration"):
            name = (
                self.text_of(node.child_by_field_name("name")).strip("`")
                if kind == "function_declaration"
                else class_name
            )
            self.current = name
            parameters, labels = self.parameters(node)
            self.add(
                Function(name, class_name, "", parameters, self.body(node, labels), span(node)),
                modifiers,
            )
        elif kind == "property_declaration":
            self.property_declaration(node, class_name, modifiers)
        elif kind == "enum_entry":
            self.enum_entry(node, class_name)

    def modifiers(self, node: SyntaxNode) -> frozenset[str]:
        words = " ".join(
            self.text_of(child) for child in node.named_children if child.type == "modifiers"
        )
        return frozenset(words.split())

    def add(self, function: Function, modifiers: frozenset[str]) -> None:
        self.functions.append(function._replace(open="open" in modifiers))
        if "override" in modifiers:
            self.overridden.update(
                f"{base}::{function.name}" for base in self.bases.get(function.class_name, ())
            )

    def property_declaration(
        self, node: SyntaxNode, class_name: str, modifiers: frozenset[str]
    ) -> None:
        computed = [child for child in node.named_children if child.type == "computed_property"]
        terms = self.declared(node)
        if not computed:
            # Properties refer to objects.
            self.members[class_name] += [(*term[:4], True, *term[5:]) for term in terms]
        name = terms[0][2] if terms else ""
        for term in terms:
            if modifiers.isdisjoint({"private", "fileprivate"}):
                self.visible.add(f"{class_name}::{term[2]}")
            else:
                self.hidden.add(f"{class_name}::{term[2]}")
            if "private(set)" in modifiers or "lazy" in modifiers:
                self.hidden.add(f"{class_name}::{term[2]}")
        self.current = name
        for child in computed:
            getter = next(
                (item for item in child.named_children if item.type == "computed_getter"), child
            )
            body = returning(self.statements(block(getter)))
            self.add(Function(name, class_name, "", (), body, span(node), getter=True), modifiers)
        for child in node.named_children if not computed else ():
            for clause in child.named_children if child.type == "willset_didset_block" else ():
                body = self.statements(block(clause))
                self.functions.append(
                    Function(f"{name} {clause.type}", class_name, "", (), body, span(clause))
                )

    def enum_entry(self, node: SyntaxNode, class_name: str) -> None:
        """Adds the cases of an enumeration as constants."""
        name: SyntaxNode | None = None
        for index, child in enumerate(node.children):
            field = node.field_name_for_child(index)
            if field == "name":
                name = child
                self.constant(class_name, name, (LITERAL, self.text_of(name), span(name)))
            elif field == "raw_value" and name is not None:
                self.constants.pop()
                self.constant(class_name, name, self.expression(child))

    def constant(self, class_name: str, name: SyntaxNode, value: Term) -> None:
        self.constants.append(
            (DECLARE, "", f"{class_name}::{self.text_of(name)}", value, False, True, span(name))
        )

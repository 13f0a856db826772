"""The declarations of a Swift file: types with their extensions, functions, and global statements."""

from __future__ import annotations

from msaa_lint.input.code.parsing import SyntaxNode, span

from .syntax import Syntax
from .terms import LET, Function, Member, Term, Type, Unit


def unit(root: SyntaxNode, syntax: Syntax) -> Unit:
    """Returns the contents of a file."""
    types: dict[str, Type] = {"": Type("", {}, {}, {}, {}, set())}
    outside: list[SyntaxNode] = []
    stack: list[tuple[SyntaxNode, str]] = [(root, "")]
    while stack:
        node, type_name = stack.pop()
        inner: list[tuple[SyntaxNode, str]] = []
        for child in node.named_children:
            if child.type == "class_declaration":
                declared = _type(child, syntax, types)
                body = child.child_by_field_name("body")
                if body is not None:
                    inner.append((body, declared.name))
            elif child.type == "ERROR":
                inner.append((child, type_name))
            elif child.type == "statements":
                outside.extend(child.named_children)
            elif type_name or child.type in ("function_declaration", "init_declaration"):
                _member(child, types[type_name], syntax)
            else:
                outside.append(child)
        stack.extend(reversed(inner))
    outside.sort(key=lambda node: node.start_byte)
    return Unit(types, syntax.statements(outside))


def _type(node: SyntaxNode, syntax: Syntax, types: dict[str, Type]) -> Type:
    """Returns the type that a declaration or extension belongs to."""
    name = node.child_by_field_name("name")
    written = syntax.text_of(name).partition("<")[0].rpartition(".")[2] if name is not None else "?"
    declaring_type = types.setdefault(written, Type(written, {}, {}, {}, {}, set()))
    for child in node.named_children:
        if child.type == "inheritance_specifier":
            declaring_type.inherits.add(syntax.text_of(child)[:100])
    return declaring_type


def _member(node: SyntaxNode, declaring_type: Type, syntax: Syntax) -> None:
    """Adds a declaration in the body of a type."""
    kind = node.type
    if kind in ("function_declaration", "init_declaration"):
        _add(declaring_type, syntax.function(node, declaring_type.name))
    elif kind == "property_declaration":
        _property(node, declaring_type, syntax)
    elif kind == "enum_entry":
        _cases(node, declaring_type, syntax)


def _property(node: SyntaxNode, declaring_type: Type, syntax: Syntax) -> None:
    terms: list[Term] = []
    syntax.declared(node, 0, terms)
    binding = next((syntax.text_of(child) for child in node.named_children if child.type == "value_binding_pattern"), "let")
    modifiers = " ".join(syntax.text_of(child) for child in node.named_children if child.type == "modifiers").split()
    open_ = "private" not in modifiers and "fileprivate" not in modifiers
    for term in terms:
        if term[0] == LET:
            for name in term[1]:
                declaring_type.members.setdefault(name, Member(term[2], term[3] if len(term[1]) == 1 else None, binding == "var", open_))
    name = term_name(terms)
    for child in node.named_children:
        if child.type == "computed_property":
            getter = next((item for item in child.named_children if item.type == "computed_getter"), child)
            declaring_type.computed[name] = Function(name, declaring_type.name, (), (), getter, span(node))
        elif child.type == "willset_didset_block":
            for clause in child.named_children:
                _add(declaring_type, Function(f"{name} {clause.type}", declaring_type.name, (), (), clause, span(clause)))


def _add(declaring_type: Type, function: Function) -> None:
    declaring_type.functions.setdefault(function.name, []).append(function)


def term_name(terms: list[Term]) -> str:
    """Returns the first name that declarations bind."""
    return terms[0][1][0] if terms else ""


def _cases(node: SyntaxNode, declaring_type: Type, syntax: Syntax) -> None:
    name = ""
    for index, child in enumerate(node.children):
        field = node.field_name_for_child(index)
        if field == "name":
            name = syntax.text_of(child)
            declaring_type.cases[name] = None
        elif field == "raw_value":
            declaring_type.cases[name] = syntax.expression(child)

"""What a Swift file declares: its types with their extensions, its functions, its statements outside of them."""

from __future__ import annotations

from msaa_lint.input.code.parsing import SyntaxNode, span

from .syntax import Syntax
from .terms import LET, Function, Member, Term, Type, Unit


def unit(root: SyntaxNode, syntax: Syntax) -> Unit:
    """All of a file."""
    types: dict[str, Type] = {"": Type("", {}, {}, {}, {}, set())}
    outside: list[SyntaxNode] = []
    waiting: list[tuple[SyntaxNode, str]] = [(root, "")]
    while waiting:
        node, within = waiting.pop()
        inner: list[tuple[SyntaxNode, str]] = []
        for child in node.named_children:
            if child.type == "class_declaration":
                found = _type(child, syntax, types)
                body = child.child_by_field_name("body")
                if body is not None:
                    inner.append((body, found.name))
            elif child.type == "ERROR":
                inner.append((child, within))
            elif child.type == "statements":
                outside.extend(child.named_children)
            elif within or child.type in ("function_declaration", "init_declaration"):
                _member(child, types[within], syntax)
            else:
                outside.append(child)
        waiting.extend(reversed(inner))
    outside.sort(key=lambda node: node.start_byte)
    return Unit(types, syntax.statements(outside))


def _type(node: SyntaxNode, syntax: Syntax, types: dict[str, Type]) -> Type:
    """The type that a declaration or an extension is of."""
    name = node.child_by_field_name("name")
    written = syntax.of(name).partition("<")[0].rpartition(".")[2] if name is not None else "?"
    found = types.setdefault(written, Type(written, {}, {}, {}, {}, set()))
    for child in node.named_children:
        if child.type == "inheritance_specifier":
            found.inherits.add(syntax.of(child)[:100])
    return found


def _member(node: SyntaxNode, found: Type, syntax: Syntax) -> None:
    """Adds what is declared in a type's braces."""
    kind = node.type
    if kind in ("function_declaration", "init_declaration"):
        _add(found, syntax.function(node, found.name))
    elif kind == "property_declaration":
        _property(node, found, syntax)
    elif kind == "enum_entry":
        _cases(node, found, syntax)


def _property(node: SyntaxNode, found: Type, syntax: Syntax) -> None:
    terms: list[Term] = []
    syntax.declared(node, 0, terms)
    binding = next((syntax.of(child) for child in node.named_children if child.type == "value_binding_pattern"), "let")
    modifiers = " ".join(syntax.of(child) for child in node.named_children if child.type == "modifiers").split()
    open_ = "private" not in modifiers and "fileprivate" not in modifiers
    for term in terms:
        if term[0] == LET:
            for name in term[1]:
                found.members.setdefault(name, Member(term[2], term[3] if len(term[1]) == 1 else None, binding == "var", open_))
    name = term_name(terms)
    for child in node.named_children:
        if child.type == "computed_property":
            getter = next((each for each in child.named_children if each.type == "computed_getter"), child)
            found.computed[name] = Function(name, found.name, (), (), getter, span(node))
        elif child.type == "willset_didset_block":
            for clause in child.named_children:
                _add(found, Function(f"{name} {clause.type}", found.name, (), (), clause, span(clause)))


def _add(found: Type, function: Function) -> None:
    found.functions.setdefault(function.name, []).append(function)


def term_name(terms: list[Term]) -> str:
    """The name that declarations bind first."""
    return terms[0][1][0] if terms else ""


def _cases(node: SyntaxNode, found: Type, syntax: Syntax) -> None:
    name = ""
    for index, child in enumerate(node.children):
        field = node.field_name_for_child(index)
        if field == "name":
            name = syntax.of(child)
            found.cases[name] = None
        elif field == "raw_value":
            found.cases[name] = syntax.expression(child)

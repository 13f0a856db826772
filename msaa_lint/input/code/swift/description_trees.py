"""Reads Swift that builds Metal descriptors as descriptions in Metal's terms.

Statements are executed in order, so that a texture has the state of its descriptor when it was created, and a pass that of its descriptor
when it was encoded. Unknown values are left out. For an undecided condition, the branch with multisampling is taken if only one has it;
otherwise differences between the branches are unknown.
"""

from __future__ import annotations

import re

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import Basis
from msaa_lint.input.code.core.limits import WorkLimitExceeded
from msaa_lint.input.code.parsing import Code, Read, SyntaxNode, Unread, span, tree

from .evaluate import evaluate
from .execution import bind_parameters, call, call_closure, run_body, run_statements, with_labels
from .interpreter import Interpreter
from .syntax import Syntax
from .terms import Function, Member, Term, Type, Unit
from .tree_writer import DescriptionWriter
from .values import Aggregate, CallFrame, Texture, Value, join

MAX_TUPLES = 20
"""The maximum number of functions with labeled tuples for which the functions that take them are searched."""

_SPEAKS = re.compile(r"MTL|[aA]ttachment|[sS]ampleCount")
_CALLED = re.compile(r"(?<![\w.])(func\s+)?([A-Za-z_]\w*)\s*\(|\.([A-Za-z_]\w*)\s*[({]")
_APPLE_ONLY = re.compile(r"^[ \t]*import[ \t]+(?:UIKit|ARKit|CompositorServices)\b", re.MULTILINE)
_OTHERS_TOO = re.compile(r"#if|^[ \t]*import[ \t]+(?:AppKit|Cocoa)\b", re.MULTILINE)


def trees(code: Code) -> list[Read]:
    """Returns the description of a Swift file or a page's fragments: one tree with the section `metal`, or none."""
    if not _SPEAKS.search(code.text):
        return []
    syntax = Syntax(code.text)
    interpreter = Interpreter(code.text, _unit(tree(code).root_node, syntax), syntax)
    try:
        interpret(code, interpreter)
    except (WorkLimitExceeded, RecursionError) as error:
        at = interpreter.function.at if interpreter.function is not None else Span(0, 0)
        return [Read(mapping([], Span(0, 0)), unread=(Unread(interpreter.work.message(error), at),))]
    writer = DescriptionWriter(interpreter, defaults=not code.fragments)
    node: Node | None = writer.tree(Span(0, len(code.text)))
    if node is None:
        return []
    assumed = writer.textures.assumed
    basis = Basis(assumed={at: "" for at, _ in assumed.values()})
    return [Read(node, tuple((what, at, value) for what, (at, value) in assumed.items()), basis=basis)]


def interpret(code: Code, interpreter: Interpreter) -> None:
    """Executes a file twice, the second time with the properties found in the first."""
    interpreter.evaluate, interpreter.call, interpreter.call_closure = evaluate, call, call_closure
    apple_import = _APPLE_ONLY.search(code.text)
    if apple_import is not None and not _OTHERS_TOO.search(code.text):
        interpreter.imports = Span(apple_import.start(), apple_import.end())
    mentioned = {match[2] or match[3] for match in _CALLED.finditer(code.text) if not match[1]}
    functions = [item for type_ in interpreter.unit.types.values() for named in type_.functions.values() for item in named]
    computed = [function for type_ in interpreter.unit.types.values() for function in type_.computed.values()]
    functions.sort(key=lambda function: (function.name != "init", function.at.start))
    for turn in range(2):
        if turn:
            interpreter.end()
        interpreter.begin()
        _begin(interpreter)
        called = frozenset(interpreter.called_functions)
        for function in functions:
            if function.name == "init" or not (function.at.start in called if turn else function.name in mentioned):
                _root(interpreter, function)
        for function in (*functions, *computed):
            if function.at.start not in interpreter.inlined:
                _root(interpreter, function)
    interpreter.end()


def _unit(root: SyntaxNode, syntax: Syntax) -> Unit:
    """Returns the declarations and global statements of a file."""
    types: dict[str, Type] = {"": Type("", {}, {}, {}, {}, set())}
    outside: list[SyntaxNode] = []
    stack: list[tuple[SyntaxNode, str]] = [(root, "")]
    while stack:
        node, type_name = stack.pop()
        inner: list[tuple[SyntaxNode, str]] = []
        for child in node.named_children:
            if child.type == "class_declaration":
                declared = _type_declaration(child, types, syntax)
                body = child.child_by_field_name("body")
                if body is not None:
                    inner.append((body, declared.name))
            elif child.type == "ERROR":
                inner.append((child, type_name))
            elif child.type == "statements":
                outside.extend(child.named_children)
            elif type_name or child.type in ("function_declaration", "init_declaration"):
                _member_declaration(child, types[type_name], syntax)
            else:
                outside.append(child)
        stack.extend(reversed(inner))
    outside.sort(key=lambda node: node.start_byte)
    return Unit(types, syntax.statements(outside))


def _type_declaration(node: SyntaxNode, types: dict[str, Type], syntax: Syntax) -> Type:
    """Returns the type that a declaration or extension belongs to."""
    name = node.child_by_field_name("name")
    written = syntax.text_of(name).partition("<")[0].rpartition(".")[2] if name is not None else "?"
    declaring_type = types.setdefault(written, Type(written, {}, {}, {}, {}, set()))
    declaring_type.inherits.update(syntax.text_of(child)[:100] for child in node.named_children if child.type == "inheritance_specifier")
    return declaring_type


def _member_declaration(node: SyntaxNode, declaring_type: Type, syntax: Syntax) -> None:
    """Adds a declaration in the body of a type."""
    kind = node.type
    if kind in ("function_declaration", "init_declaration"):
        declaring_type.add(syntax.function(node, declaring_type.name))
    elif kind == "property_declaration":
        _property_declaration(node, declaring_type, syntax)
    elif kind == "enum_entry":
        name = ""
        for index, child in enumerate(node.children):
            field = node.field_name_for_child(index)
            if field == "name":
                name = syntax.text_of(child)
                declaring_type.cases[name] = None
            elif field == "raw_value":
                declaring_type.cases[name] = syntax.expression(child)


def _property_declaration(node: SyntaxNode, declaring_type: Type, syntax: Syntax) -> None:
    terms: list[Term] = []
    syntax.declared(node, 0, terms)
    binding = next((syntax.text_of(child) for child in node.named_children if child.type == "value_binding_pattern"), "let")
    modifiers = " ".join(syntax.text_of(child) for child in node.named_children if child.type == "modifiers").split()
    open_ = "private" not in modifiers and "fileprivate" not in modifiers
    for _, names, kind, value, _ in terms:
        for name in names:
            declaring_type.members.setdefault(name, Member(kind, value if len(names) == 1 else None, binding == "var", open_))
    name = terms[0][1][0] if terms else ""
    for child in node.named_children:
        if child.type == "computed_property":
            getter = next((item for item in child.named_children if item.type == "computed_getter"), child)
            declaring_type.computed[name] = Function(name, declaring_type.name, (), (), getter, span(node))
        elif child.type == "willset_didset_block":
            for clause in child.named_children:
                declaring_type.add(Function(f"{name} {clause.type}", declaring_type.name, (), (), clause, span(clause)))


def _begin(interpreter: Interpreter) -> None:
    """Executes global statements and the initial values of properties."""
    interpreter.root += 1
    top = CallFrame("", "", 0, 0)
    run_statements(interpreter, interpreter.unit.outside, top)
    for name, value in list(top.locals.items()):
        interpreter.set_property("", name, value, Span(0, 0))
    for type_ in interpreter.unit.types.values():
        _members(interpreter, type_)


def _members(interpreter: Interpreter, type_: Type) -> None:
    frame = CallFrame(type_.name, "", 0, 0)
    for name, member in type_.members.items():
        if member.value is not None and type_.name:
            interpreter.set_property(type_.name, name, evaluate(interpreter, member.value, frame), member.value[-1])


def _root(interpreter: Interpreter, function: Function) -> None:
    """Executes a function that is not called in the file, or is called on objects of unknown type."""
    interpreter.inlined.add(function.at.start)
    interpreter.root += 1
    interpreter.undecided_depth = 0
    interpreter.function = function
    frame = CallFrame(function.type_name, function.name, 0, function.at.start, self_value=interpreter.self_value(function.type_name))
    _entered(interpreter, function, frame)


def _entered(interpreter: Interpreter, function: Function, frame: CallFrame) -> None:
    arguments: dict[str, Value] = {}
    for call_arguments in interpreter.call_arguments.get(function.at.start, ()):
        for name, value in call_arguments.items():
            arguments[name] = value if name not in arguments else join(arguments[name], value, name)
    if not arguments:
        arguments = _of_one_tuple(interpreter, function)
    bind_parameters(interpreter, function, arguments, frame)
    gives = with_labels(interpreter, function, run_body(interpreter, interpreter.body(function), frame))
    for item in gives.items.values() if isinstance(gives, Aggregate) else (gives,):
        if isinstance(item, Texture):
            item.open = True


def _of_one_tuple(interpreter: Interpreter, function: Function) -> dict[str, Value]:
    """Returns the textures that a function is meant to take: those of the only tuple in the file with the same labels, at least two."""
    textures = [parameter.name for parameter in function.parameters if parameter.type == "MTLTexture"]
    if len(textures) < 2 or len(interpreter.tuples) > MAX_TUPLES:
        return {}
    tuples = [items for items in interpreter.tuples.values() if all(name in items for name in textures)]
    return {name: tuples[0][name] for name in textures} if len(tuples) == 1 else {}

"""Reads Swift that builds Metal descriptors as descriptions in Metal's terms.

Statements are executed in order, so that a texture has the state of its descriptor when it was created, and a pass that of its descriptor
when it was encoded. Unknown values are left out. For an undecided condition, the branch with multisampling is taken if only one has it;
otherwise differences between the branches are unknown.
"""

from __future__ import annotations

import re

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import Code, Read, tree

from .declarations import unit
from .evaluate import evaluate
from .execution import bind_parameters, call, call_closure, run_body, run_statements, with_labels
from .frame_state import CallFrame
from .interpreter import Interpreter
from .syntax import Syntax
from .terms import Function, Type
from .tree_writer import DescriptionWriter
from .values import Aggregate, Texture, Value, join

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
    interpreter = interpret(code)
    writer = DescriptionWriter(interpreter, defaults=not code.fragments)
    node: Node | None = writer.tree(Span(0, len(code.text)))
    if node is None:
        return []
    return [Read(node, tuple((what, at, value) for what, (at, value) in writer.textures.assumed.items()))]


def interpret(code: Code) -> Interpreter:
    """Executes a file twice, the second time with the properties found in the first."""
    syntax = Syntax(code.text)
    parsed = tree(code)
    interpreter = Interpreter(code.text, unit(parsed.root_node, syntax), syntax)
    interpreter.evaluate, interpreter.call, interpreter.call_closure = evaluate, call, call_closure
    apple_import = _APPLE_ONLY.search(code.text)
    if apple_import is not None and not _OTHERS_TOO.search(code.text):
        interpreter.imports = Span(apple_import.start(), apple_import.end())
    mentioned = {match[2] or match[3] for match in _CALLED.finditer(code.text) if not match[1]}
    functions = [item for type_ in interpreter.unit.types.values() for named in type_.functions.values() for item in named]
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
        for function in functions:
            if function.at.start not in interpreter.inlined:
                _root(interpreter, function)
        for declaring_type in interpreter.unit.types.values():
            for function in declaring_type.computed.values():
                if function.at.start not in interpreter.inlined:
                    _root(interpreter, function)
    interpreter.end()
    return interpreter


def _begin(interpreter: Interpreter) -> None:
    """Executes global statements and the initial values of properties."""
    interpreter.root += 1
    top = CallFrame("", "", 0, 0)
    _guarded(interpreter, lambda: run_statements(interpreter, interpreter.unit.outside, top))
    for name, value in list(top.locals.items()):
        interpreter.set_property("", name, value, Span(0, 0))
    for type_ in interpreter.unit.types.values():
        _guarded(interpreter, lambda type_=type_: _members(interpreter, type_))


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
    frame = CallFrame(function.type_name, function.name, 0, function.at.start, self_value=interpreter.self_value(function.type_name))
    _guarded(interpreter, lambda: _entered(interpreter, function, frame))


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


def _guarded(interpreter: Interpreter, goes: object) -> None:
    """Executes part of a file; stops if it exceeds Python's recursion limit."""
    assert callable(goes)
    try:
        goes()
    except RecursionError:
        interpreter.incomplete.add(interpreter.root)

"""Swift that builds Metal's descriptors, as descriptions of frames in Metal's words.

Statements are gone through in order, so that a texture is what its descriptor was when it was made, and a pass what its descriptor was
when it was encoded. What cannot be known is left out. Of a condition that cannot be told the way with multisampling is taken
where only one is; else what its branches do differently is unknown.
"""

from __future__ import annotations

import re

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import Code, Read, tree

from .declarations import unit
from .evaluate import evaluate
from .frame_state import Frame
from .machine import Machine
from .run import body_of, call, call_closure, enter, labelled, run
from .syntax import Syntax
from .terms import Function, Type
from .tree_writer import Writer
from .values import Aggregate, Texture, Value, joined

MOST_TUPLES = 20
"""Functions that give labelled tuples, where those that take them are looked for."""

_SPEAKS = re.compile(r"MTL|[aA]ttachment|[sS]ampleCount")
_CALLED = re.compile(r"(?<![\w.])(func\s+)?([A-Za-z_]\w*)\s*\(|\.([A-Za-z_]\w*)\s*[({]")
_APPLE_ONLY = re.compile(r"^[ \t]*import[ \t]+(?:UIKit|ARKit|CompositorServices)\b", re.MULTILINE)
_OTHERS_TOO = re.compile(r"#if|^[ \t]*import[ \t]+(?:AppKit|Cocoa)\b", re.MULTILINE)


def trees(code: Code) -> list[Read]:
    """The frame that a Swift file, or the fragments of a page, have to do with: one tree with the section `metal`, or none."""
    if not _SPEAKS.search(code.text):
        return []
    machine = gone_through(code)
    writer = Writer(machine, defaults=not code.fragments)
    node: Node | None = writer.tree(Span(0, len(code.text)))
    if node is None:
        return []
    return [Read(node, tuple((what, at, value) for what, (at, value) in writer.textures.assumed.items()))]


def gone_through(code: Code) -> Machine:
    """A file after it was gone through twice."""
    syntax = Syntax(code.text)
    parsed = tree(code)
    machine = Machine(code.text, unit(parsed.root_node, syntax), syntax)
    machine.evaluate, machine.call, machine.call_closure = evaluate, call, call_closure
    apple_import = _APPLE_ONLY.search(code.text)
    if apple_import is not None and not _OTHERS_TOO.search(code.text):
        machine.imports = Span(apple_import.start(), apple_import.end())
    mentioned = {match[2] or match[3] for match in _CALLED.finditer(code.text) if not match[1]}
    functions = [item for type_ in machine.unit.types.values() for named in type_.functions.values() for item in named]
    functions.sort(key=lambda function: (function.name != "init", function.at.start))
    for turn in range(2):
        if turn:
            machine.end()
        machine.begin()
        _begin(machine)
        called = frozenset(machine.called)
        for function in functions:
            if function.name == "init" or not (function.at.start in called if turn else function.name in mentioned):
                _root(machine, function)
        for function in functions:
            if function.at.start not in machine.inlined:
                _root(machine, function)
        for declaring_type in machine.unit.types.values():
            for function in declaring_type.computed.values():
                if function.at.start not in machine.inlined:
                    _root(machine, function)
    machine.end()
    return machine


def _begin(machine: Machine) -> None:
    """What stands outside of functions, and the values that properties begin with."""
    machine.root += 1
    top = Frame("", "", 0, 0)
    _guarded(machine, lambda: run(machine, machine.unit.outside, top))
    for name, value in list(top.locals.items()):
        machine.set_property("", name, value, Span(0, 0))
    for type_ in machine.unit.types.values():
        _guarded(machine, lambda type_=type_: _members(machine, type_))


def _members(machine: Machine, type_: Type) -> None:
    frame = Frame(type_.name, "", 0, 0)
    for name, member in type_.members.items():
        if member.value is not None and type_.name:
            machine.set_property(type_.name, name, evaluate(machine, member.value, frame), member.value[-1])


def _root(machine: Machine, function: Function) -> None:
    """Goes through a function that nothing in the file calls, or that is called on objects whose type is not known."""
    machine.inlined.add(function.at.start)
    machine.root += 1
    machine.unsure = 0
    frame = Frame(function.within, function.name, 0, function.at.start, me=machine.me(function.within))
    _guarded(machine, lambda: _entered(machine, function, frame))


def _entered(machine: Machine, function: Function, frame: Frame) -> None:
    arguments: dict[str, Value] = {}
    for call_arguments in machine.handed.get(function.at.start, ()):
        for name, value in call_arguments.items():
            arguments[name] = value if name not in arguments else joined(arguments[name], value, name)
    if not arguments:
        arguments = _of_one_tuple(machine, function)
    enter(machine, function, arguments, frame)
    gives = labelled(machine, function, body_of(machine, machine.body(function), frame))
    for item in gives.items.values() if isinstance(gives, Aggregate) else (gives,):
        if isinstance(item, Texture):
            item.open = True


def _of_one_tuple(machine: Machine, function: Function) -> dict[str, Value]:
    """The textures that a function is meant to take: those of a tuple of the file with the same labels, two at least."""
    textures = [parameter.name for parameter in function.parameters if parameter.type == "MTLTexture"]
    if len(textures) < 2 or len(machine.tuples) > MOST_TUPLES:
        return {}
    tuples = [items for items in machine.tuples.values() if all(name in items for name in textures)]
    return {name: tuples[0][name] for name in textures} if len(tuples) == 1 else {}


def _guarded(machine: Machine, goes: object) -> None:
    """Goes through a part of a file; one that goes deeper than Python does is left where it was."""
    assert callable(goes)
    try:
        goes()
    except RecursionError:
        machine.incomplete.add(machine.root)

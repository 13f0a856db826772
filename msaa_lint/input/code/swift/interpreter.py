"""The state of an abstract interpreter of Swift: variables, properties, objects, and encoded commands."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.limits import Work

from .expressions import block
from .syntax import Syntax
from .terms import Function, Term, Type, Unit
from .values import UNKNOWN, Aggregate, CallFrame, Code, Field, Instance, MetalObject, Pass, Pipeline, Symbol, Texture, UndoLog, Value, join

OBJECTS = {
    "MTLTextureDescriptor": "texture",
    "MTLRenderPassDescriptor": "pass",
    "MTL4RenderPassDescriptor": "pass",
    "MTLRenderPipelineDescriptor": "pipeline",
    "MTL4RenderPipelineDescriptor": "pipeline",
    "MTLRenderPassColorAttachmentDescriptor": "attachment",
    "MTLRenderPassDepthAttachmentDescriptor": "attachment",
    "MTLRenderPassStencilAttachmentDescriptor": "attachment",
    "MTLRenderPipelineColorAttachmentDescriptor": "attachment",
    "MTKView": "view",
    "CAMetalLayer": "layer",
    "CAMetalDrawable": "drawable",
    "MTLDrawable": "drawable",
    "MTLCommandBuffer": "commands",
}
"""The kind of object for each Metal type that is tracked."""

SHARED = frozenset({"view", "layer", "drawable"})
"""Kinds of which a file has a single object, with several names."""

_UNDECLARED = Type("", {}, {}, {}, {}, set())
_PLAIN = re.compile(r"^(?:any |some |inout )*([A-Za-z_][\w.]*)")


def _not_followed(*_: Any) -> Value:
    return UNKNOWN


class Encoded(NamedTuple):
    """A step of a frame: a pass, copy, read, or presented drawable, and the function that encodes it.

    `sure` is set if it is unconditional.
    """

    kind: str
    what: tuple[object, ...]
    at: Span
    by: int
    sure: bool


class Interpreter:
    """The state of the interpreter. A file is executed twice, the second time with the properties found in the first."""

    def __init__(self, text: str, unit: Unit, syntax: Syntax) -> None:
        self.text = text
        self.unit = unit
        self.syntax = syntax
        self.functions: dict[str, list[Function]] = {}
        for type_ in unit.types.values():
            for name, named in type_.functions.items():
                self.functions.setdefault(name, []).extend(named)
        self.undo_log = UndoLog()
        self.decisions: dict[str, bool] = {}
        self.objects: dict[tuple[object, ...], MetalObject] = {}
        self.textures: dict[tuple[object, ...], Texture] = {}
        self.same: dict[tuple[object, ...], tuple[object, ...]] = {}
        self.ways: dict[tuple[int, int], int] = {}
        self.property_values: dict[tuple[str, str], Value] = {}
        self.member_values: dict[tuple[int, str], Value] = {}
        self.new_call_arguments: dict[int, list[dict[str, Value]]] = {}
        self.tuples: dict[int, dict[str, Value]] = {}
        self.call_arguments: dict[int, list[dict[str, Value]]] = {}
        self.views: set[int] = set()
        self.called_functions: set[int] = set()
        self.offered_counts: dict[int, Span] = {}
        self.family: tuple[str, Span] | None = None
        self.imports: Span | None = None
        self.bodies: dict[int, tuple[Term, ...]] = {}
        self.work = Work(len(text))
        self.function: Function | None = None
        """The function that is executed, not called."""
        self.evaluate: Callable[[Interpreter, Term, CallFrame], Value] = _not_followed
        self.call: Callable[[Interpreter, Function, dict[str, Value], CallFrame, Span, Value | None], Value] = _not_followed
        self.call_closure: Callable[[Interpreter, Code, tuple[Value, ...] | dict[str, Value], CallFrame, Span], Value] = _not_followed
        self.begin()

    def begin(self) -> None:
        """Resets the state before the file is executed."""
        self.current_properties: dict[str, dict[str, Field]] = {}
        self.new_property_values: dict[tuple[str, str], Value] = {}
        self.new_member_values: dict[tuple[int, str], Value] = {}
        self.passes: dict[tuple[object, ...], Pass] = {}
        self.pipelines: dict[tuple[object, ...], Pipeline] = {}
        self.encoded: list[Encoded] = []
        self.escaped: set[int] = set()
        self.inlined: set[int] = set()
        self.incomplete: set[int] = set()
        self.superseded: set[int] = set()
        self.root = 0
        self.undecided_depth = 0
        for texture in self.textures.values():
            texture.rank = 1 << 30
            texture.made = []
        for metal_object in self.objects.values():
            metal_object.fields = {}
            metal_object.loose = False
        self.undo_log.writes.clear()

    def end(self) -> None:
        """Keeps the values of properties and members for the next execution."""
        self.property_values = self.new_property_values
        self.member_values = self.new_member_values
        self.call_arguments = self.new_call_arguments
        self.new_call_arguments = {}

    def type_of(self, name: str) -> Type:
        """Returns the type with a name; one without members if the file declares none."""
        return self.unit.types.get(name, _UNDECLARED)

    def call_path(self, frame: CallFrame, site: int) -> int:
        """Returns a number that identifies the call path to a location."""
        return self.ways.setdefault((frame.path, site), len(self.ways) + 1)

    def object_at(self, kind: str, name: str, at: Span, path: object, complete: bool) -> MetalObject:
        """Returns the object that is created at a location."""
        key = (kind,) if kind in SHARED else (kind, at.start, at.end, path)
        return self.object_of(key, kind, name, at, complete)

    def object_of(self, key: tuple[object, ...], kind: str, name: str, at: Span, complete: bool) -> MetalObject:
        """Returns the object with a key, which is created on first use."""
        return self.objects.setdefault(key, MetalObject(kind, name, at, complete))

    def texture_of(self, key: tuple[object, ...], name: str, type_name: str, at: Span) -> Texture:
        """Returns the texture with a key, which is created on first use."""
        return self.textures.setdefault(key, Texture(name, type_name, at))

    def reset(self, item: MetalObject) -> None:
        """Resets an object whose creation is executed again."""
        for name in list(item.fields):
            self.undo_log.write(item.fields, name, None)

    def typed_object(self, kind: str, name: str, at: Span, path: object) -> Value | None:
        """Returns the object in a variable whose value is unknown, based on its type."""
        plain = _PLAIN.match(kind)
        if plain is None:
            return None
        written = plain[1].rpartition(".")[2]
        object_kind = OBJECTS.get(written)
        if object_kind is None and self.is_view(written):
            object_kind = "view"
        type_ = self.type_of(written)
        if object_kind is None and type_.members and not type_.cases:
            return Instance(written)
        return self.object_at(object_kind, name, at, (path, name), False) if object_kind is not None else None

    def is_view(self, name: str) -> bool:
        """Returns whether a type in the file is an MTKView."""
        return "MTKView" in self.type_of(name).inherits

    def self_value(self, type_name: str) -> Value | None:
        """Returns `self` in the functions of a Metal type."""
        kind = OBJECTS.get(type_name) or ("view" if self.is_view(type_name) else "")
        return self.object_at(kind, kind, Span(0, 0), type_name, False) if kind in SHARED else None

    def set_field(self, item: MetalObject, name: str, value: Value, key: Span, at: Span) -> None:
        self.undo_log.write(item.fields, name, Field(value, key, at, self.root))
        place = (id(item), name)
        before = self.new_member_values.get(place)
        self.new_member_values[place] = value if before is None else join(before, value, name)

    def field(self, item: MetalObject, name: str) -> Field | None:
        """Returns a member of an object: the value set by the current function, otherwise the value on which all functions agree."""
        field = item.fields.get(name)
        if field is None or field.by == self.root:
            return field
        common = self.member_values.get((id(item), name), field.value)
        return field if common == field.value else field._replace(value=common)

    def snapshot(self, item: MetalObject) -> dict[str, Field]:
        """Returns the current members of an object."""
        return {name: field for name in item.fields if (field := self.field(item, name)) is not None}

    def invalidate(self, item: MetalObject) -> None:
        """Marks an object that external code may change. A texture descriptor keeps only what is set afterwards."""
        item.loose = True
        if item.kind == "texture":
            for name, field in list(item.fields.items()):
                self.undo_log.write(item.fields, name, field._replace(value=UNKNOWN))

    def set_property(self, type_name: str, name: str, value: Value, at: Span) -> None:
        self.name_value(value, "" if name.endswith("[]") else name, type_name, -1)
        if isinstance(value, Texture):
            member = self.type_of(type_name).members.get(name.removesuffix("[]"))
            value.open = value.open or member is None or member.open
        self.hold_property(type_name, name, value, at)

    def hold_property(self, type_name: str, name: str, value: Value, at: Span) -> None:
        """Sets a property without naming its value."""
        self.undo_log.write(self.current_properties.setdefault(type_name, {}), name, Field(value, at, at, self.root))
        place = (type_name, name)
        before = self.new_property_values.get(place)
        if isinstance(before, Texture) and isinstance(value, Texture) and before is not value and _made_for(before, value, type_name, name):
            self.same.setdefault(value.key, before.key)
            return
        self.new_property_values[place] = value if before is None else join(before, value, name, optional=True)

    def property(self, type_name: str, name: str) -> Value | None:
        """Returns the value of a property, or None if the file does not set it."""
        field = self.current_properties.get(type_name, {}).get(name)
        if field is not None and field.by == self.root:
            return field.value
        return self.property_values.get((type_name, name), field.value if field is not None else None)

    def variable(self, frame: CallFrame, name: str, value: Value) -> None:
        if not name or name == "_":
            return
        if value is UNKNOWN:
            value = Symbol(name, frame.function_name)
        self.name_value(value, name, frame.function_name, frame.rank)
        self.undo_log.write(frame.locals, name, value)

    def name_value(self, value: Value, name: str, type_name: str, rank: int) -> None:
        """Names a value after what holds it. Properties take precedence over variables, and callers over called functions."""
        if isinstance(value, Texture):
            if rank < value.rank and name and not value.drawable and value.owner is None:
                value.name, value.type_name, value.rank = name, type_name, rank
        elif isinstance(value, Aggregate):
            for label, item in value.items.items():
                if isinstance(item, Texture) and not item.name and not label.isdigit():
                    self.name_value(item, label, type_name, 1 << 29)
        elif isinstance(value, MetalObject) and name:
            holder = value.of if value.kind == "state" else value
            if isinstance(holder, Pipeline) or (holder is value and not value.name):
                holder.name, holder.type_name = name, type_name

    def named_texture(self, text: str, function_name: str, at: Span) -> Texture:
        """Returns a texture of which only the name is known."""
        return self.texture_of(("named", function_name, text), text, function_name, at)

    def body(self, function: Function) -> tuple[Term, ...]:
        """Returns the statements of a function, which are parsed on demand."""
        key = function.at.start
        statements = self.bodies.get(key)
        if statements is None:
            statements = self.bodies[key] = self.syntax.statements(block(function.body)) if function.body is not None else ()
        return statements


def _made_for(first: Texture, second: Texture, type_name: str, name: str) -> bool:
    """Returns whether two textures are the same property, created again."""
    named = all((item.name, item.type_name) == (name, type_name) for item in (first, second))
    return named and first.multisampled == second.multisampled

"""What a reading of a Swift file goes through with: variables, properties, objects, and what the code was seen to do with them."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from msaa_lint.core.text.span import Span

from .frame_state import Encoded, Frame, Pass, Pipeline
from .syntax import Syntax
from .terms import Function, Term, Type, Unit
from .values import NIL, UNKNOWN, Aggregate, Code, Field, Instance, Journal, Object, Symbol, Texture, Value, joined

MOST_STEPS_PER_LINE = 20
"""Statements that are gone through for each line of the file: functions that call each other often cost no more."""

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
"""By type: the kind of object that is followed."""

SHARED = frozenset({"view", "layer", "drawable"})
"""Of these a file has one, under several names."""

_PLAIN = re.compile(r"^(?:any |some |inout )*([A-Za-z_][\w.]*)")


def _not_followed(*_: Any) -> Value:
    return UNKNOWN


class Machine:
    """All that is known of a file while it is gone through, twice: the second time with what the first found of every property."""

    def __init__(self, text: str, unit: Unit, syntax: Syntax) -> None:
        self.text = text
        self.unit = unit
        self.syntax = syntax
        self.functions: dict[str, list[Function]] = {}
        for type_ in unit.types.values():
            for name, named in type_.functions.items():
                self.functions.setdefault(name, []).extend(named)
        self.journal = Journal()
        self.worlds: dict[str, bool] = {}
        self.objects: dict[tuple[object, ...], Object] = {}
        self.textures: dict[tuple[object, ...], Texture] = {}
        self.same: dict[tuple[object, ...], tuple[object, ...]] = {}
        self.ways: dict[tuple[int, int], int] = {}
        self.gathered: dict[tuple[str, str], Value] = {}
        self.given: dict[tuple[int, str], Value] = {}
        self.arguments: dict[int, list[dict[str, Value]]] = {}
        self.tuples: dict[int, dict[str, Value]] = {}
        self.handed: dict[int, list[dict[str, Value]]] = {}
        self.views: set[int] = set()
        self.called: set[int] = set()
        self.offered: dict[int, Span] = {}
        self.family: tuple[str, Span] | None = None
        self.imports: Span | None = None
        self.bodies: dict[int, tuple[Term, ...]] = {}
        self.steps = 0
        self.evaluate: Callable[[Machine, Term, Frame], Value] = _not_followed
        self.call: Callable[[Machine, Function, dict[str, Value], Frame, Span, Value | None], Value] = _not_followed
        self.call_closure: Callable[[Machine, Code, tuple[Value, ...] | dict[str, Value], Frame, Span], Value] = _not_followed
        self.begin()

    def begin(self) -> None:
        """Begins to go through the file."""
        self.now: dict[str, dict[str, Field]] = {}
        self.all: dict[tuple[str, str], Value] = {}
        self.every: dict[tuple[int, str], Value] = {}
        self.passes: dict[tuple[object, ...], Pass] = {}
        self.pipelines: dict[tuple[object, ...], Pipeline] = {}
        self.encoded: list[Encoded] = []
        self.escaped: set[int] = set()
        self.inlined: set[int] = set()
        self.incomplete: set[int] = set()
        self.superseded: set[int] = set()
        self.root = 0
        self.unsure = 0
        self.steps = MOST_STEPS_PER_LINE * (self.text.count("\n") + 50)
        for texture in self.textures.values():
            texture.rank = 1 << 30
            texture.made = []
        for metal_object in self.objects.values():
            metal_object.fields = {}
            metal_object.loose = False
        self.journal.writes.clear()

    def end(self) -> None:
        """Keeps what was found of properties and members for the next time."""
        self.gathered, self.given, self.handed = self.all, self.every, self.arguments
        self.arguments = {}

    def type_of(self, name: str) -> Type | None:
        return self.unit.types.get(name)

    def way(self, frame: Frame, site: int) -> int:
        """A number for the way of calls that leads to a place."""
        return self.ways.setdefault((frame.way, site), len(self.ways) + 1)

    # Objects

    def made(self, kind: str, name: str, at: Span, way: object, complete: bool) -> Object:
        """The object that a place makes; it begins anew there."""
        key = (kind,) if kind in SHARED else (kind, at.start, at.end, way)
        metal_object = self.objects.get(key)
        if metal_object is None:
            metal_object = self.objects[key] = Object(kind, name, at, complete)
        return metal_object

    def renew(self, item: Object) -> None:
        """An object begins anew, where the code that makes it is gone through again."""
        for name in list(item.fields):
            self.journal.write(item.fields, name, None)

    def typed(self, kind: str, name: str, at: Span, way: object) -> Value | None:
        """The object that a variable of a type holds whose value is not seen."""
        plain = _PLAIN.match(kind)
        if plain is None:
            return None
        written = plain[1].rpartition(".")[2]
        object_kind = OBJECTS.get(written)
        if object_kind is None and self.is_view(written):
            object_kind = "view"
        type_ = self.unit.types.get(written)
        if object_kind is None and type_ is not None and type_.members and not type_.cases:
            return Instance(written)
        return self.made(object_kind, name, at, (way, name), False) if object_kind is not None else None

    def is_view(self, name: str) -> bool:
        """Whether a type of the file is an MTKView."""
        type_ = self.unit.types.get(name)
        return type_ is not None and any(supertype == "MTKView" for supertype in type_.inherits)

    def me(self, within: str) -> Value | None:
        """What `self` is in a type's functions, where that is one of Metal's objects."""
        if within in OBJECTS or self.is_view(within):
            kind = OBJECTS.get(within, "view")
            return self.made(kind, kind, Span(0, 0), within, False) if kind in SHARED else None
        return None

    def give(self, item: Object, name: str, value: Value, key: Span, at: Span) -> None:
        """An object's member is set."""
        self.journal.write(item.fields, name, Field(value, key, at, self.root))
        place = (id(item), name)
        before = self.every.get(place)
        self.every[place] = value if before is None else joined(before, value, name)

    def has(self, item: Object, name: str) -> Field | None:
        """What an object's member holds: what this function set, else what agrees with all functions that set it."""
        field = item.fields.get(name)
        if field is None or field.by == self.root:
            return field
        agreed = self.given.get((id(item), name), field.value)
        return field if agreed == field.value else field._replace(value=agreed)

    def snapshot(self, item: Object) -> dict[str, Field]:
        """All that an object holds now."""
        return {name: field for name in item.fields if (field := self.has(item, name)) is not None}

    def loosen(self, item: Object) -> None:
        """Code that is not read may change an object: a texture's descriptor holds what it is given afterwards."""
        item.loose = True
        if item.kind == "texture":
            for name, field in list(item.fields.items()):
                self.journal.write(item.fields, name, field._replace(value=UNKNOWN))

    # Properties

    def set_property(self, within: str, name: str, value: Value, at: Span) -> None:
        self.name(value, "" if name.endswith("[]") else name, within, -1)
        if isinstance(value, Texture):
            type_ = self.unit.types.get(within)
            member = type_.members.get(name.removesuffix("[]")) if type_ is not None else None
            value.open = value.open or member is None or member.open
        self.hold_property(within, name, value, at)

    def hold_property(self, within: str, name: str, value: Value, at: Span) -> None:
        """A property is set, and what it holds keeps its name."""
        self.journal.write(self.now.setdefault(within, {}), name, Field(value, at, at, self.root))
        place = (within, name)
        before = self.all.get(place)
        if isinstance(before, Texture) and isinstance(value, Texture) and before is not value and _made_for(before, value, within, name):
            self.same.setdefault(value.key, before.key)
            return
        self.all[place] = value if before is None else joined(before, value, name, optional=True)

    def property(self, within: str, name: str) -> Value | None:
        """What a property holds; None where nothing in the file sets it."""
        field = self.now.get(within, {}).get(name)
        if field is not None and field.by == self.root:
            return field.value
        value = self.gathered.get((within, name))
        if value is None:
            return field.value if field is not None else None
        return value

    # Names

    def variable(self, frame: Frame, name: str, value: Value) -> None:
        """A variable is declared."""
        if not name or name == "_":
            return
        if value is UNKNOWN:
            value = Symbol(name, frame.whose)
        self.name(value, name, frame.whose, frame.rank)
        self.journal.write(frame.locals, name, value)

    def name(self, value: Value, name: str, within: str, rank: int) -> None:
        """What holds a value gives it its name; a property's outdoes a variable's, and a caller's a called function's."""
        if isinstance(value, Texture):
            if rank < value.rank and name and not value.drawable and value.owner is None:
                value.name, value.within, value.rank = name, within, rank
        elif isinstance(value, Aggregate):
            for label, item in value.items.items():
                if isinstance(item, Texture) and not item.name and not label.isdigit():
                    self.name(item, label, within, 1 << 29)
        elif isinstance(value, Object) and name:
            if value.kind == "state":
                pipeline = value.of
                if isinstance(pipeline, Pipeline):
                    pipeline.name, pipeline.within = name, within
            elif not value.name:
                value.name, value.within = name, within

    def opaque(self, text: str, whose: str, at: Span) -> Texture:
        """A texture of which only the name is known."""
        key = ("named", whose, text)
        texture = self.textures.get(key)
        if texture is None:
            texture = self.textures[key] = Texture(text, whose, at)
        return texture

    def body(self, function: Function) -> tuple[Term, ...]:
        """The statements of a function, read when they are first asked for."""
        from .expressions import block

        key = function.at.start
        statements = self.bodies.get(key)
        if statements is None:
            statements = self.bodies[key] = self.syntax.statements(block(function.body)) if function.body is not None else ()
        return statements


def _made_for(first: Texture, second: Texture, within: str, name: str) -> bool:
    """Whether two textures are made for one property: the same one, made again."""
    named = all((item.name, item.within) == (name, within) for item in (first, second))
    return named and first.multisampled == second.multisampled


def agreed(values: list[Value]) -> Value:
    """What a function returns, of all that it may."""
    agreed_value: Value | None = None
    for value in values:
        agreed_value = value if agreed_value is None else joined(agreed_value, value, optional=True)
    return NIL if agreed_value is None else agreed_value

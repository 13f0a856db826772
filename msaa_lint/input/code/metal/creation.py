"""Metal objects that calls create, and the commands that they encode."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.conditions import canonical_text
from msaa_lint.input.code.core.escapes import mark_escaped
from msaa_lint.input.code.core.guards import ALWAYS, Guards
from msaa_lint.input.code.core.scope import MAX_CLOSURES, MEMBER, Scope
from msaa_lint.input.code.core.structures import Items
from msaa_lint.input.code.core.terms import ASSIGN, CALL, FIELD, NAME, Function, Term, labeled
from msaa_lint.input.code.core.values import (
    UNKNOWN_VALUE,
    Alternative,
    ApiObject,
    Array,
    Cell,
    Closure,
    Flags,
    Instance,
    Struct,
    Symbol,
    Value,
    pointee,
    sole_value,
)

from .instances import MetalInstances
from .names import (
    CREATES,
    DESCRIPTOR_METHODS,
    MEMBERS,
    PLAIN_OBJECTS,
    READS,
    STORES,
    kind_of,
    setter_member,
    type_name,
)
from .objects import CREATED, Encoded, name_by_member

_HARMLESS = frozenset(
    {
        "print",
        "assert",
        "precondition",
        "NSLog",
        "debugPrint",
        "withExtendedLifetime",
        "NSAssert",
        "NSParameterAssert",
    }
)
_SAME = frozenset({"init", "retain", "autorelease", "get", "mutableCopy", "release", "drain"})
"""Methods of an object that return it."""
_NEW = frozenset({"alloc", "new", "init", "renderPassDescriptor", "allocWithZone"})
"""Class methods that create an object."""
_OPTIONS = frozenset({"insert", "formUnion", "remove"})
_ELEMENT = frozenset({"object", "objectAtIndexedSubscript"})
_TRANSFERS = frozenset({"TransferPtr", "RetainPtr"})
ALWAYS_OFFERED = (1, 2, 4)
"""Counts that a check with supportsTextureSampleCount accepts: every device supports 4, and nearly
all support 2.
"""

_DESCRIPTOR_MEMBERS = ("pixelFormat", "width", "height", "mipmapLevelCount")
_DEFAULTS = {"mipmapped": "mipmapLevelCount", "size": "width"}


class MetalInterpreter(MetalInstances):
    """Executes a program that calls Metal."""

    @property
    def repeatable(self) -> bool:
        # Descriptors are objects, whose members change in whichever function they are passed to.
        return False

    def begin(self) -> None:
        super().begin()
        self.filled: dict[Instance, list[tuple[int, Struct, Guards]]] = {}
        """Descriptors that entry points fill in, by the numbers of these, with their last state."""
        self.passed: dict[str, bool] = {}
        """Conditions under which functions do not return early, which are assumed."""
        self.tuples: dict[Span, Struct] = {}
        """The tuples whose items have labels."""
        self.offers: dict[str, tuple[str, int | str, Span]] = {}
        """What a device is asked by a condition."""

    def object_method(
        self,
        owner: Term,
        value: Any,
        name: str,
        arguments: Sequence[Term],
        place: Span,
        scope: Scope,
    ) -> Value | None:
        """Returns the result of a method of one of Metal's objects, or None for other methods."""
        if owner[:2] == (NAME, "super") and name.startswith("init") and scope.class_name:
            return self.of_class(scope.class_name, place)
        if name in DESCRIPTOR_METHODS:
            return self.texture_descriptor(name, arguments, place, scope)
        kind = kind_of(str(owner[1])) if owner[0] == NAME else ""
        if kind and name in _NEW and not isinstance(value, Instance):
            return self.construct_object(kind, place, scope)
        for pattern, descriptor in CREATES:
            if pattern.match(name) and arguments:
                return self.create_from(descriptor, value, arguments, place, scope)
        if name in PLAIN_OBJECTS and not arguments:
            return self.construct_object(PLAIN_OBJECTS[name], place, scope)
        if name == "nextDrawable":
            return (Alternative(self.instance("drawable", ("drawable",), place, False), place),)
        if name in ("supportsTextureSampleCount", "supportsFamily") and arguments:
            return self.query(name, owner, arguments[0], place, scope)
        command = self.command(value, name, arguments, place, scope)
        if command is not None:
            return command
        if name in _OPTIONS and owner[0] == FIELD and len(arguments) == 1:
            return self.change_options(owner, name, arguments[0], place, scope)
        return (
            self.own_method(value, name, arguments, place, scope)
            if isinstance(value, (Instance, ApiObject))
            else None
        )

    def own_method(
        self,
        value: Instance | ApiObject,
        name: str,
        arguments: Sequence[Term],
        place: Span,
        scope: Scope,
    ) -> Value | None:
        """Returns the result of a method of an object that is known, or None."""
        same: Value = (Alternative(value, place),)
        if name in _SAME and not arguments:
            return same
        if isinstance(value, ApiObject):
            member = (
                value.info.fields.get(name) if value.kind == "texture" and not arguments else None
            )
            return member.read(scope.guards) if member is not None else None
        if name == "copy" and not arguments:
            return self.copy_of(value, place, scope)
        if name == "reset" and not arguments and value.kind in ("pass", "pipeline", "texture"):
            self.reset(value)
            return UNKNOWN_VALUE
        if name in _ELEMENT and len(arguments) == 1:
            element = self.element_of_object(value, self.sole(arguments[0], scope), place)
            return element.read(scope.guards) if element is not None else None
        if name == "setObject" and len(arguments) == 2:
            element = self.element_of_object(value, self.sole(arguments[1], scope), place)
            if element is not None:
                element.write(self.value(arguments[0], scope), place, scope.guards)
                return UNKNOWN_VALUE
        setter = setter_member(name)
        if setter is not None and len(arguments) == 1 and value.kind not in ("encoder", "commands"):
            self.store(value.cell(setter), self.value(arguments[0], scope), place, scope)
            return UNKNOWN_VALUE
        if not arguments and name in MEMBERS:
            member = self.member_of_object(value, Cell(), name, place, scope)
            return self.read_cell(member, place, scope)
        closure = self.sole(arguments[-1], scope) if len(arguments) == 1 else None
        if isinstance(closure, Closure):
            self.run_closure(closure, place, scope, same)
            return same
        self.invalidate(value, place, scope.guards)
        return None

    def read_cell(self, cell: Cell | None, place: Span, scope: Scope) -> Value:
        """Returns the value of a member, or the symbol that stands for it."""
        if cell is None:
            return UNKNOWN_VALUE
        value = cell.read(scope.guards)
        return value or (
            (Alternative(Symbol(cell.key, cell.name.rpartition(".")[2]), place),)
            if cell.key
            else UNKNOWN_VALUE
        )

    def texture_descriptor(
        self, name: str, arguments: Sequence[Term], place: Span, scope: Scope
    ) -> Value:
        """Returns a texture descriptor created by a class method."""
        descriptor = self.construct_object("texture", place, scope)
        instance: Instance = descriptor[0].value
        for n, argument in enumerate(arguments):
            label, term = labeled(argument)
            value = self.value(term, scope)
            member = _DEFAULTS.get(label, label)
            if n < len(_DESCRIPTOR_MEMBERS) and (not member or label == "with"):
                member = _DESCRIPTOR_MEMBERS[n]
            if member == "mipmapLevelCount":
                value = (
                    (Alternative(1, term[-1]),)
                    if sole_value(value) in (False, 0)
                    else UNKNOWN_VALUE
                )
            instance.cell(member).write(value, term[-1], scope.guards)
        kind = DESCRIPTOR_METHODS[name]
        if kind:
            instance.cell("textureType").write((Alternative(kind, place),), place, scope.guards)
        return descriptor

    def create_from(
        self, kind: str, owner: Any, arguments: Sequence[Term], place: Span, scope: Scope
    ) -> Value:
        """Returns the object that a call creates from a descriptor."""
        values = [self.value(argument, scope) for argument in arguments]
        descriptor = pointee(sole_value(values[0]))
        for value in values[1:]:
            self.escape(value, place, scope)
        known = isinstance(descriptor, Instance) and descriptor.kind == kind
        if kind == "pass" and not (
            known and isinstance(owner, Instance) and owner.kind == "commands" and owner.complete
        ):
            # Other code may also encode to a buffer that was created elsewhere.
            self.incomplete.add(self.root)
        if not known:
            return (
                UNKNOWN_VALUE
                if kind == "texture"
                else (Alternative(self.create("encoder", Struct("", place), place, scope), place),)
            )
        self.used.add(descriptor.key)
        obj = self.create(kind, self.snapshot(descriptor, scope.guards), place, scope)
        if kind != "texture":
            obj.name, obj.name_depth = descriptor.name, 98
        if kind == "pass":
            self.record("pass", (obj,), place, scope)
        return (Alternative(obj, place),)

    def record(self, kind: str, what: tuple[Any, ...], place: Span, scope: Scope) -> None:
        self.encoded.append(
            Encoded(kind, what, place, self.root, self.branches == 0 and not scope.unknown_loops)
        )

    def run_block(
        self, statements: Iterable[Term], scope: Scope, guards: Guards, scoped: bool = True
    ) -> bool:
        self.branches += bool(guards)
        left = super().run_block(statements, scope, guards, scoped)
        self.branches -= bool(guards)
        return left

    def test(self, condition: bool | Guards, term: Term, scope: Scope) -> None:
        before = scope.guards
        super().test(condition, term, scope)
        for text, way in scope.guards - before:
            self.passed.setdefault(text, way)

    def condition(self, term: Term, scope: Scope) -> bool | Guards:
        # An object exists in its methods.
        return True if term[:2] == (NAME, "this") else super().condition(term, scope)

    def declare(self, term: Term, scope: Scope) -> None:
        if self.fragments and len(scope.scopes) == 1 and not scope.calls and term[3] is not None:
            # Other fragments of the page may use it before.
            self.assign((ASSIGN, "=", (NAME, term[2], term[-1]), term[3], term[-1]), scope)
        else:
            super().declare(term, scope)

    def tuple_value(self, items: Items, place: Span, scope: Scope) -> Value:
        value = super().tuple_value(items, place, scope)
        if items and all(path and not str(path[0]).isdigit() for path, _ in items):
            self.tuples[place] = value[0].value
        return value

    def entry_scope(self, function: Function) -> Scope:
        """Binds textures that a function is meant to take: those of the only tuple in the program
        with the same labels, at least two.
        """
        scope = super().entry_scope(function)
        textures = [
            parameter.name
            for parameter in function.parameters
            if type_name(parameter.type) == "MTLTexture"
        ]
        tuples = (
            [item for item in self.tuples.values() if all(name in item.fields for name in textures)]
            if len(textures) > 1
            else []
        )
        for name in textures if len(tuples) == 1 else ():
            scope.scopes[-1][name].writes = tuples[0].fields[name].writes
        return scope

    def query(self, name: str, owner: Term, argument: Term, place: Span, scope: Scope) -> Value:
        """Returns what a device answers: the counts that every device supports, otherwise a
        condition.
        """
        asked = self.sole(argument, scope)
        if name == "supportsTextureSampleCount" and asked in ALWAYS_OFFERED:
            return (Alternative(True, place),)
        key = f"{name}({asked if isinstance(asked, (int, str)) else canonical_text(argument)})"
        if isinstance(asked, (int, str)):
            self.offers[key] = (name, asked, argument[-1])
        return (Alternative(Symbol(key, name), place),)

    def command(
        self, owner: Any, name: str, arguments: Sequence[Term], place: Span, scope: Scope
    ) -> Value | None:
        """Executes a command of an encoder or a command buffer, or returns None."""
        if name in ("present", "presentDrawable"):
            target = owner if isinstance(owner, Instance) and owner.kind == "drawable" else None
            if target is None and arguments:
                target = self.sole(arguments[0], scope)
            if isinstance(target, Instance) and target.kind == "drawable":
                self.record("present", (self.drawable_texture(place),), place, scope)
            else:
                self.incomplete.add(self.root)
            return UNKNOWN_VALUE
        if name in ("copy", "copyFromTexture") and len(arguments) > 1:
            ends = [
                self.value(a, scope)
                for n, a in enumerate(arguments)
                if n == 0 or labeled(a)[0] in ("to", "toTexture")
            ]
            if len(ends) == 2:
                self.record("copy", tuple(ends), place, scope)
                return UNKNOWN_VALUE
        if name in READS and arguments:
            render_pass = owner if isinstance(owner, ApiObject) and owner.kind == "pass" else None
            self.record(
                "read",
                (self.value(arguments[0], scope), READS[name], render_pass),
                labeled(arguments[0])[1][-1],
                scope,
            )
            return UNKNOWN_VALUE
        if (
            name == "setRenderPipelineState"
            and arguments
            and isinstance(owner, ApiObject)
            and owner.kind == "pass"
        ):
            for alternative in self.value(arguments[0], scope):
                if (
                    isinstance(alternative.value, ApiObject)
                    and alternative.value.kind == "pipeline"
                ):
                    drawn = alternative.value.info.cell("passes")
                    drawn.writes = (
                        *drawn.writes[:4],
                        Alternative(owner, place, alternative.guards | scope.guards),
                    )
            return UNKNOWN_VALUE
        if name in STORES and arguments and isinstance(owner, ApiObject) and owner.kind == "pass":
            self.set_store(owner, STORES[name], arguments, place, scope)
            return UNKNOWN_VALUE
        return None

    def set_store(
        self,
        render_pass: ApiObject,
        slot: str,
        arguments: Sequence[Term],
        place: Span,
        scope: Scope,
    ) -> None:
        """Sets the store action of an attachment whose descriptor leaves it unknown."""
        index = self.sole(arguments[1], scope) if len(arguments) > 1 else ""
        cell = render_pass.info.fields.get(f"{slot}{index}")
        attachment = sole_value(cell.writes) if cell is not None else None
        if isinstance(attachment, Struct):
            attachment.cell("storeAction").write(
                self.value(arguments[0], scope), place, scope.guards
            )

    def change_options(
        self, owner: Term, name: str, argument: Term, place: Span, scope: Scope
    ) -> Value:
        """Executes `insert` and similar methods of option sets."""
        cell = self.cell_of(owner, scope)
        change = options(sole_value(self.value(argument, scope)), place)
        before = options(sole_value(cell.read(scope.guards)), place) if cell is not None else None
        if cell is None:
            return UNKNOWN_VALUE
        after: Value = UNKNOWN_VALUE
        if before is not None and change is not None and len(before) + len(change) < 64:
            words = {word for word, _ in change}
            kept = (
                before
                if name != "remove"
                else tuple(item for item in before if item[0] not in words)
            )
            present = {word for word, _ in kept}
            added = (
                tuple(item for item in change if item[0] not in present) if name != "remove" else ()
            )
            after = (Alternative(Flags((*kept, *added)), place),)
        cell.write(after, place, scope.guards)
        return UNKNOWN_VALUE

    def external_call(
        self, term: Term, name: str, owner: Term | None, values: Sequence[Value], scope: Scope
    ) -> Value:
        """Returns the result of a function outside the program."""
        function, arguments, place = term[1], term[2], term[3]
        if owner is None and function[0] == NAME:
            qualified, _, last = str(function[1]).rpartition("::")
            kind = kind_of(qualified) if last in _NEW and qualified else kind_of(str(function[1]))
            if kind:
                return self.construct_object(kind, place, scope)
            if last in DESCRIPTOR_METHODS and kind_of(qualified):
                return self.texture_descriptor(last, arguments, place, scope)
            if last in _TRANSFERS and len(values) == 1:
                return values[0]
            class_name = self.class_of(str(function[1]), scope.enclosing)
            if class_name is not None:
                return self.class_object(class_name, arguments, values, place, scope)
        if name in _HARMLESS:
            return UNKNOWN_VALUE
        for value in values:
            self.escape(value, place, scope)
        return (
            Alternative(
                Symbol(
                    self.key_of_call(term, scope), name, bool(self.library.is_count_choice(name))
                ),
                place,
            ),
        )

    def escape(self, value: Value, place: Span, scope: Scope) -> None:
        """Handles an argument of a function outside the program, which may change descriptors, read
        textures, and call closures.
        """
        mark_escaped(value, self.work)
        for alternative in value:
            inner = pointee(alternative.value)
            if isinstance(inner, Instance):
                self.invalidate(inner, place, scope.guards)
                if inner.kind == "commands":
                    self.incomplete.add(self.root)
            elif isinstance(inner, Closure):
                self.run_closure(inner, place, scope, None)

    def run_closure(
        self, closure: Closure, place: Span, scope: Scope, argument: Value | None
    ) -> None:
        """Executes a closure that a function outside the program may call."""
        if place in scope.active_functions or len(scope.calls) >= MAX_CLOSURES:
            return
        name = closure.parameters[0].name if closure.parameters else "$0"
        cells = {
            parameter.name: Cell(parameter.type, parameter.name, (), f"closure({parameter.name})")
            for parameter in closure.parameters
        }
        if argument is not None:
            cells[name] = Cell("", name, argument)
        body = Function("", "", "", (), closure.body, place, scope.namespace)
        self.execute(
            body,
            (CALL, (NAME, "", place), (), place),
            scope,
            scope.this_object,
            (*closure.scopes, cells),
        )

    def store(self, cell: Cell, value: Value, place: Span, scope: Scope) -> None:
        super().store(cell, value, place, scope)
        if cell.kind == MEMBER and "@" not in cell.name:
            for alternative in value:
                name_by_member(alternative.value, cell.name)

    def reached_functions(self) -> Iterator[Function]:
        """Yields the entry points, and then the functions that no call was followed to: methods of
        objects of unknown type may have the same names.
        """
        entry_points = self.entry_points()
        yield from entry_points
        known = {function.at for function in entry_points}
        for function in self.unit.functions:
            if function.at not in known and function.at not in self.followed:
                yield function

    def create_unused(self, scope: Scope) -> None:
        """Notes the state of descriptors at the end of an entry point."""
        self.declared_structs.clear()
        for instance in self.touched():
            self.filled.setdefault(instance, []).append(
                (self.root, self.snapshot(instance, ALWAYS), ALWAYS)
            )

    def touched(self) -> Iterator[Instance]:
        """Yields the pass and pipeline descriptors that the current entry point fills in."""
        keys = dict.fromkeys(
            f"{key.partition('.')[0]}." for key in self.overlay if key.startswith("@")
        )
        touched = dict.fromkeys(self.owners.get(key) or self.by_key[key] for key in keys)
        return (instance for instance in touched if instance.kind in ("pass", "pipeline"))

    def create_from_fragments(self, overlay: dict[str, Cell]) -> None:
        """Fragments of a page are executed like a program."""

    def run(self) -> None:
        """Executes the program. Descriptors that no call takes create objects too, of which only
        what is set is known.
        """
        super().run()
        self.overlay, self.initial = {}, {}
        for instance, states in self.filled.items():
            if instance.key in self.used:
                continue
            info = states[0][1] if len(states) == 1 else self.snapshot(instance, ALWAYS)
            info.zeroed = False
            if info.fields.keys() - {CREATED}:
                obj = self.api_object(instance.kind, ("unused", instance.key), instance.at, info)
                obj.name = instance.name

    def result_of(
        self, function: Function, term: Term, value: Value, creates: bool, scope: Scope
    ) -> Value:
        return value


def options(value: Any, place: Span) -> tuple[tuple[str, Span], ...] | None:
    """Returns the options in a set, or None if any of them is unknown."""
    if isinstance(value, Flags):
        return value.bits
    if isinstance(value, str):
        return ((value, place),)
    if isinstance(value, Array) and value.complete:
        words: list[tuple[str, Span]] = []
        for cell in value.items:
            word = sole_value(cell.writes)
            if not isinstance(word, str):
                return None
            words.append((word, cell.writes[-1].at))
        return tuple(words)
    return None

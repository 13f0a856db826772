"""Methods of structures and lists."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span

from .escapes import forget
from .guards import ALWAYS
from .scope import MAX_TURNS, MEMBER, Scope
from .terms import CALL, FIELD, INDEX, LITERAL, NAME, Term
from .tuples import Tuples
from .types import element_type
from .values import (
    UNKNOWN,
    UNKNOWN_VALUE,
    Alternative,
    Array,
    Cell,
    Ref,
    Struct,
    Value,
    pointee,
    sole_value,
)

APPEND = frozenset(
    {"push_back", "emplace_back", "append", "add", "pushBack", "Add", "PushBack", "push"}
)

STARTS = APPEND | {"resize", "assign", "clear"}
"""Methods that fill a list or empty it."""

COUNTED = frozenset(
    {"size", "count", "length", "Num", "Size", "Count", "Length", "getSize", "GetSize", "ssize"}
)

DATA = frozenset(
    {"data", "begin", "cbegin", "get", "Data", "GetData", "getData", "constData", "ptr", "ptrw"}
)

SELF = frozenset(
    {
        "get",
        "value",
        "data",
        "begin",
        "as_span",
        "handle",
        "ptr",
        "operator*",
        "release",
        "Get",
        "asSpan",
        "c_ptr",
    }
)


class Receiver(NamedTuple):
    """What a method is called on: the expression, its cell if it has one, and its value."""

    owner: Term
    cell: Cell | None
    content: Value


class ListMethods(Tuples):
    """The list methods of one file."""

    def method(
        self, receiver: Receiver, name: str, arguments: Sequence[Term], place: Span, scope: Scope
    ) -> Value | None:
        """Returns the result of a method of a structure or list, or None for other objects."""
        owner, cell, content = receiver
        if (
            cell is not None
            and cell.kind == MEMBER
            and name in STARTS
            and cell.writes is self.initial.get(cell.key)
        ):
            # What the list holds before is known only if nothing else fills it.
            content = self.started_list(cell) or content
            cell.writes = content
        value = pointee(sole_value(content))
        if len(content) > 1 and any(isinstance(pointee(item.value), Array) for item in content):
            return self.on_alternatives(content, name, place)
        result = self.object_method(owner, value, name, arguments, place, scope)
        if result is not None:
            return result
        setter = self.library.setter(name)
        if isinstance(value, Struct) and value.kind and setter is not None:
            if len(arguments) != 1 or not self.library.has_member(value.kind, setter):
                return content
            kind = self.library.member_type(value.kind, setter)
            if self.library.copies_on_set:
                value = self.copies.value(value)
                content = (Alternative(value, content[0].at),)
            argument = self.value(arguments[0], scope, kind)
            # A setter of a list takes its address.
            argument = self.as_pointer("p" + name[3:], argument, arguments[0], scope)
            value.cell(setter).write(self.copies.alternatives(argument), place, scope.guards)
            return content
        if (
            setter is not None
            and len(arguments) == 1
            and self.fragments
            and owner[0] == NAME
            and not isinstance(value, Array)
        ):
            target = self.field(owner, setter, scope)
            if target is not None:
                target.write(self.value(arguments[0], scope), place, scope.guards)
                return content
        if isinstance(value, Array):
            if (
                cell is not None
                and name in ("resize", "assign", "clear")
                and self.started.get(cell.key) is value
            ):
                # Whatever the list held before, its length is known now.
                value.complete = value.complete or not scope.guards
                del self.started[cell.key]
            return self.on_list(value, cell, name, arguments, place, scope)
        if name in SELF and not arguments:
            return content
        if (
            name == "clear"
            and cell is not None
            and not arguments
            and element_type(self.type_of(cell)) is not None
        ):
            # Whatever the list held before, it is empty now.
            cell.write(
                (Alternative(Array(element_type(self.type_of(cell)) or "", place), place),),
                place,
                scope.guards,
            )
            return UNKNOWN_VALUE
        if cell is not None and cell.writes == () and name in APPEND and len(arguments) == 1:
            # The list was declared elsewhere, or its type is unknown.
            self.value(arguments[0], scope)
            return UNKNOWN_VALUE
        return None

    def object_method(
        self,
        owner: Term,
        value: Any,
        name: str,
        arguments: Sequence[Term],
        place: Span,
        scope: Scope,
    ) -> Value | None:
        """Returns the result of a method of an object of the API, or None for other methods.
        `value` is that of the owner.
        """
        return None

    def on_alternatives(self, value: Value, name: str, place: Span) -> Value:
        """Returns the result of a method on a list that has several alternatives. Which of them a
        change affects is unknown.
        """
        alternatives: list[Alternative] = []
        for alternative in value:
            array = pointee(alternative.value)
            if name in ("data", "begin", "cbegin"):
                alternatives.append(
                    Alternative(
                        Ref(Cell(writes=(Alternative(alternative.value, alternative.at),))),
                        place,
                        alternative.guards,
                    )
                )
            elif name in COUNTED:
                alternatives += [
                    a._replace(guards=alternative.guards) for a in self.count_value(array, place)
                ] or [Alternative(UNKNOWN, place, alternative.guards)]
            elif isinstance(array, Array):
                array.complete = False
        return tuple(alternatives)

    def on_list(
        self,
        array: Array,
        cell: Cell | None,
        name: str,
        arguments: Sequence[Term],
        place: Span,
        scope: Scope,
    ) -> Value:
        if name in APPEND:
            kind = array.kind
            if (
                name == "emplace_back"
                and self.library.structure(kind)
                and (len(arguments) != 1 or arguments[0][0] == LITERAL)
            ):
                value = self.construct(kind, [(None, item) for item in arguments], place, scope)
            else:
                value = self.value(arguments[0], scope, kind) if arguments else UNKNOWN_VALUE
            return self.append(
                array, tuple(self.named_copy(a, arguments) for a in value), place, scope
            )
        if name in DATA:
            return (
                Alternative(
                    Ref(cell if cell is not None else Cell(writes=(Alternative(array, place),))),
                    place,
                ),
            )
        if name in COUNTED:
            return self.count_value(array, place)
        if name in ("back", "front") and array.items:
            return (Alternative(Ref(array.items[-1 if name == "back" else 0], True), place),)
        if name == "at" and len(arguments) == 1:
            index = self.sole(arguments[0], scope)
            if type(index) is int and 0 <= index < len(array.items):
                return (Alternative(Ref(array.items[index], True), place),)
        if name == "at" and len(arguments) == 1:
            return (
                Alternative(Ref(self.element_of(array, arguments[0], place, scope), True), place),
            )
        if name in ("rbegin", "rend"):
            # The element is unknown, so writes to it make the list unknown.
            array.complete = False
            return UNKNOWN_VALUE
        if name == "clear":
            array.items.clear()
            array.others.clear()
            array.unset = False
            array.complete = not scope.guards
            return UNKNOWN_VALUE
        if name in ("insert", "assign", "resize", "fill") and self.refilled(
            array, name, arguments, place, scope
        ):
            return UNKNOWN_VALUE
        if name in ("resize", "fill", "assign", "insert", "pop_back", "erase", "swap", "emplace"):
            array.complete = array.complete and name == "resize" and not array.items
            if array.complete and arguments:
                count = self.sole(arguments[0], scope)
                array.complete = type(count) is int and 0 <= count <= 64
                array.items += [
                    self.unset_element(array.kind, place, True)
                    for _ in range(count if array.complete else 0)
                ]
        return UNKNOWN_VALUE

    def append(self, array: Array, value: Value, place: Span, scope: Scope) -> Value:
        """Appends an element to a list and returns a reference to it."""
        array.alike = (
            scope.unknown_loops > 0 and array.complete and not array.items and not array.unset
        )
        array.complete = array.complete and not scope.unknown_loops and len(array.items) < 64
        if len(array.items) >= 64:
            return UNKNOWN_VALUE
        item = Cell(array.kind)
        item.write(self.copies.alternatives(value), place, scope.guards)
        array.items.append(item)
        return (Alternative(Ref(item, True), place),)

    def refilled(
        self, array: Array, name: str, arguments: Sequence[Term], place: Span, scope: Scope
    ) -> bool:
        """Executes a method that appends or replaces elements. Returns False if its effect is
        unknown.
        """
        if scope.guards or scope.unknown_loops or not array.complete or not arguments:
            return False
        if name == "insert" or (name == "assign" and arguments[0][0] == CALL):
            ends = arguments[1:] if name == "insert" else arguments
            at_end = (
                arguments[0][0] == CALL
                and arguments[0][1][0] == FIELD
                and arguments[0][1][2] in ("end", "cend")
            )
            if name == "insert" and not at_end:
                return False
            source = self.target(ends[0], scope) if len(ends) == 2 else None
            if isinstance(source, Array) and source.complete:
                fresh = [
                    Cell(array.kind, writes=self.copies.alternatives(item.writes))
                    for item in source.items
                ]
            elif len(ends) == 1:
                fresh = [
                    Cell(
                        array.kind,
                        writes=self.copies.alternatives(self.value(ends[0], scope, array.kind)),
                    )
                ]
            else:
                return False
            array.items[:] = [*(array.items if name == "insert" else ()), *fresh][:64]
            return True
        count = len(array.items) if name == "fill" else self.sole(arguments[0], scope)
        if (
            type(count) is not int
            or not 0 <= count <= 64
            or len(arguments) != (1 if name == "fill" else 2)
        ):
            return False
        value = self.value(arguments[-1], scope, array.kind)
        kept = array.items[:count] if name == "resize" else []
        array.items[:] = [
            *kept,
            *(
                Cell(array.kind, writes=self.copies.alternatives(value))
                for _ in range(count - len(kept))
            ),
        ]
        return True

    def named_copy(self, alternative: Alternative, arguments: Sequence[Term]) -> Alternative:
        value = self.copies.value(alternative.value)
        if isinstance(value, Struct) and not value.name and arguments and arguments[0][0] == NAME:
            value.name = str(arguments[0][1])
        return Alternative(value, alternative.at, alternative.guards)

    def forget_target(self, target: Term, scope: Scope) -> None:
        """Handles a write to an unknown target: if it is an element, its list becomes unknown."""
        if target[0] in (FIELD, INDEX):
            for alternative in self.value(target[1], scope):
                value = pointee(alternative.value)
                if isinstance(value, Array):
                    value.complete = False
                elif isinstance(value, Struct) and target[0] == INDEX:
                    forget(value)
                elif isinstance(value, Struct) and target[0] == FIELD:
                    value.cell(self.library.member(target[2])).write(
                        UNKNOWN_VALUE, target[-1], ALWAYS
                    )


def few_elements(value: object) -> list[Cell] | None:
    """Returns the elements of a list if they are known and few enough for a loop over them,
    otherwise None.
    """
    return (
        value.items
        if isinstance(value, Array) and value.is_known and len(value.items) <= MAX_TURNS
        else None
    )

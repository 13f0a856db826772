"""Methods of structures and lists."""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.core.text.span import Span

from .names import MEMBERS, member, set_by, structure
from .scope import Around
from .structures import Structures, member_type
from .terms import CALL, FIELD, INDEX, LITERAL, NAME, Term
from .values import ALWAYS, UNKNOWN, UNKNOWN_VALUE, Alternative, Array, Cell, Ref, Struct, Value, copied, copies, one, pointee

APPEND = frozenset({"push_back", "emplace_back", "append", "add", "pushBack", "Add", "PushBack", "push"})

COUNTED = frozenset({"size", "count", "length"})

SELF = frozenset({"get", "value", "data", "begin", "as_span", "handle", "ptr", "operator*", "release", "Get", "asSpan", "c_ptr"})


class Lists(Structures):
    """Lists of one file."""

    def method(self, owner: Term, name: str, arguments: Sequence[Term], place: Span, around: Around) -> Value | None:
        """A method of a structure or a list; None where it is another's."""
        cell = self.run.place(owner, around) if owner[0] != CALL else None
        content = cell.read(around.guards) if cell is not None else self.run.value(owner, around)
        value = pointee(one(content))
        if len(content) > 1 and any(isinstance(pointee(item.value), Array) for item in content):
            return self.of_several(content, name, place)
        setter = set_by(name)
        if isinstance(value, Struct) and value.kind and setter is not None:
            if len(arguments) != 1 or (setter not in map(member, MEMBERS[value.kind]) and setter != "next"):
                return content
            kind = member_type(value.kind, setter)
            argument = self.run.value(arguments[0], around, kind)
            # A setter of a list takes its address.
            argument = self.run.by_pointer("p" + name[3:], argument, arguments[0], around)
            value.cell(setter).write(copies(argument), place, around.guards)
            return content
        if setter is not None and len(arguments) == 1 and self.run.fragments and owner[0] == NAME and not isinstance(value, Array):
            target = self.run.field(owner, setter, around)
            if target is not None:
                target.write(self.run.value(arguments[0], around), place, around.guards)
                return content
        if isinstance(value, Array):
            return self.of_list(value, cell, name, arguments, place, around)
        if name in SELF and not arguments:
            return content
        if cell is not None and cell.writes == () and name in APPEND and len(arguments) == 1:
            # A list that was not declared here, or whose type says nothing.
            self.run.value(arguments[0], around)
            return UNKNOWN_VALUE
        return None

    def of_several(self, value: Value, name: str, place: Span) -> Value:
        """What a method gives of a list that is one or another: nobody can tell which of them others change."""
        alternatives: list[Alternative] = []
        for alternative in value:
            array = pointee(alternative.value)
            if name in ("data", "begin", "cbegin"):
                alternatives.append(
                    Alternative(Ref(Cell(writes=(Alternative(alternative.value, alternative.at),))), place, alternative.guards)
                )
            elif name in COUNTED:
                alternatives += [a._replace(guards=alternative.guards) for a in self.counted(array, place)] or [
                    Alternative(UNKNOWN, place, alternative.guards)
                ]
            elif isinstance(array, Array):
                array.whole = False
        return tuple(alternatives)

    def of_list(self, array: Array, cell: Cell | None, name: str, arguments: Sequence[Term], place: Span, around: Around) -> Value:
        if name in APPEND:
            kind = array.kind
            struct_name = structure(kind)
            if name == "emplace_back" and struct_name and (len(arguments) != 1 or arguments[0][0] == LITERAL):
                value = self.constructed(struct_name, arguments, place, around, kind.startswith("vk::"))
            else:
                value = self.run.value(arguments[0], around, kind) if arguments else UNKNOWN_VALUE
            if around.loops or len(array.items) >= 64:
                array.whole = False
                return UNKNOWN_VALUE
            item = Cell(kind)
            item.write(tuple(self.named_copy(a, arguments) for a in value), place, around.guards)
            array.items.append(item)
            return (Alternative(Ref(item), place),)
        if name in ("data", "begin", "cbegin", "get"):
            return (Alternative(Ref(cell if cell is not None else Cell(writes=(Alternative(array, place),))), place),)
        if name in COUNTED:
            return self.counted(array, place)
        if name in ("back", "front") and array.items:
            return (Alternative(Ref(array.items[-1 if name == "back" else 0]), place),)
        if name == "at" and len(arguments) == 1:
            index = one(self.run.value(arguments[0], around))
            if type(index) is int and 0 <= index < len(array.items):
                return (Alternative(Ref(array.items[index]), place),)
        if name in ("at", "rbegin", "rend"):
            # Of which element it is, nobody can tell what is written to it.
            array.whole = False
            return UNKNOWN_VALUE
        if name in ("clear",):
            array.items.clear()
            array.whole = not around.guards
            return UNKNOWN_VALUE
        if name in ("resize", "reserve", "fill", "assign", "insert", "pop_back", "erase", "swap", "emplace"):
            if name != "reserve":
                array.whole = array.whole and name == "resize" and not array.items
            if name == "resize" and arguments and array.whole:
                count = one(self.run.value(arguments[0], around))
                array.whole = False
                if type(count) is int and 0 <= count <= 64:
                    array.whole = True
                    for _ in range(count):
                        struct_name = structure(array.kind)
                        item = Cell(array.kind)
                        if struct_name:
                            item.writes = (Alternative(Struct(struct_name, place, True), place),)
                        array.items.append(item)
            return UNKNOWN_VALUE
        return UNKNOWN_VALUE

    @staticmethod
    def named_copy(alternative: Alternative, arguments: Sequence[Term]) -> Alternative:
        value = copied(alternative.value)
        if isinstance(value, Struct) and not value.name and arguments and arguments[0][0] == NAME:
            value.name = str(arguments[0][1])
        return Alternative(value, alternative.at, alternative.guards)

    def lost(self, target: Term, around: Around) -> None:
        """Something was written to a place that cannot be told: of a list's element, the list is no longer known."""
        if target[0] in (FIELD, INDEX):
            for alternative in self.run.value(target[1], around):
                value = pointee(alternative.value)
                if isinstance(value, Array):
                    value.whole = False
                elif isinstance(value, Struct) and target[0] == FIELD:
                    value.cell(member(target[2])).write(UNKNOWN_VALUE, target[-1], ALWAYS)

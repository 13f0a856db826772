"""Structures and lists that expressions construct."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from msaa_lint.core.text.span import Span

from .escapes import forget
from .evaluate import Evaluator
from .executions import Results, emptied
from .guards import ALWAYS, Guards
from .library import Construction, Library
from .limits import Work
from .scope import Scope
from .terms import (
    ADDRESS,
    BINARY,
    BRACES,
    CALL,
    FIELD,
    INDEX,
    LITERAL,
    NAME,
    SOME,
    TUPLE,
    UNPARSED,
    Term,
    Unit,
)
from .types import element_type
from .values import (
    UNKNOWN,
    UNKNOWN_VALUE,
    Alternative,
    ApiObject,
    Array,
    Cell,
    Ref,
    Struct,
    Value,
    pointee,
    sole_value,
    structures_in,
)

Items = Sequence[tuple[tuple[str | int, ...] | None, Term]]
"""The items in braces: the designated members or None, and the term."""


class Structures(Evaluator):
    """Constructs the structures and lists of one file."""

    def __init__(
        self, unit: Unit, library: Library, fragments: bool, is_cpp: bool, work: Work
    ) -> None:
        super().__init__(unit, library, fragments, is_cpp, work)
        self.objects: dict[tuple[Any, ...], ApiObject] = {}
        self.current_objects: dict[tuple[Any, ...], ApiObject] = {}
        self.declared_structs: list[tuple[Struct, Guards]] = []
        self.follow_counts: dict[Span, int] = {}

    def begin(self) -> None:
        """Discards the results of the previous execution of the file, but keeps the identity of
        objects.
        """
        emptied(self.collected())
        self.declared_structs.clear()
        self.follow_counts.clear()

    def collected(self) -> Results:
        """Returns what entry points add to."""
        return [self.current_objects, self.class_objects, self.initial_reads]

    def construct(self, kind: str, items: Items, place: Span, scope: Scope) -> Value:
        """Returns a structure of the API, or a copy of one."""
        construction = self.library.construction(kind)
        struct = Struct(construction.structure, place, True)
        for name, default in construction.defaults.items():
            struct.cell(name).writes = (Alternative(default, place),)
        if len(items) == 1 and items[0][0] is None:
            term = items[0][1]
            value = self.target(term, scope) if term[0] in (NAME, FIELD) else None
            if isinstance(value, Struct) and (
                not value.kind or self.library.is_alike(value.kind, struct.kind)
            ):
                return (Alternative(self.copies.value(value), place),)
            if term[:2] == (LITERAL, 0):
                return (Alternative(struct, place),)
        self.initialize_positional(struct, items, scope, construction)
        return (Alternative(struct, place),)

    def initialize_positional(
        self, struct: Struct, items: Items, scope: Scope, construction: Construction
    ) -> None:
        names = construction.members
        n = 0
        for path, term in items:
            if path:
                self.initialize_designated(struct, path, term, scope)
                name = str(path[0])
                n = names.index(name) + 1 if name in names else n
                continue
            if n >= len(names):
                return
            if term[0] == SOME:
                # Which member an item initializes depends on a condition.
                for name in names[n:]:
                    struct.cell(self.library.member(name)).write(UNKNOWN_VALUE, term[-1], ALWAYS)
                return
            name = names[n]
            value = self.as_pointer(
                name,
                self.value(term, scope, self.library.member_type(struct.kind, name)),
                term,
                scope,
            )
            target = pointee(sole_value(value))
            if (
                name.endswith("Count")
                and construction.takes_lists
                and (isinstance(target, (Array, Struct)) or term[0] == BRACES)
            ):
                n += 1
                name = names[n] if n < len(names) else name
            struct.cell(self.library.member(name)).write(
                self.copies.alternatives(value), term[-1], ALWAYS
            )
            n += 1

    def initialize_designated(
        self, struct: Struct, path: Sequence[str | int], term: Term, scope: Scope
    ) -> None:
        """Initializes a designated member: `.extent.width = 4`."""
        if path == ("..",):
            base = self.target(term, scope)
            if isinstance(base, Struct):
                struct.zeroed = struct.zeroed and base.zeroed
                struct.fields.update(self.copies.value(base).fields)
            else:
                struct.zeroed = False
            return
        guards = ALWAYS
        if term[0] == SOME:
            guards, term = self.unwrap_conditions(term)
        target: Struct = struct
        for part in path[:-1]:
            cell = target.cell(self.library.member(str(part)))
            value = sole_value(cell.writes)
            if not isinstance(value, Struct):
                value = Struct("", term[-1], True)
                cell.writes = (Alternative(value, term[-1]),)
            target = value
        name = str(path[-1])
        value = self.as_pointer(
            name, self.value(term, scope, self.library.member_type(target.kind, name)), term, scope
        )
        target.cell(self.library.member(name)).write(
            self.copies.alternatives(value), term[-1], guards
        )

    def unwrap_conditions(self, term: Term) -> tuple[Guards, Term]:
        """Returns the guards of a list item, and the item."""
        guards = ALWAYS
        for _ in range(8):
            if term[0] != SOME:
                break
            guards, term = guards | {(term[1], term[2])}, term[3]
        return guards, term

    def braced_value(self, term: Term, scope: Scope, kind: str) -> Value:
        """Returns the value of a braced list for a target type."""
        kind, items, place = term[1] or kind, term[2], term[3]
        if kind == TUPLE:
            return self.tuple_value(items, place, scope)
        if self.library.structure(kind):
            return self.construct(kind, items, place, scope)
        inner = element_type(kind)
        if (
            items
            and all(path for path, _ in items)
            and isinstance(items[0][0][0], str)
            and inner is None
        ):
            struct = Struct("", place, True)
            for path, item in items:
                self.initialize_designated(struct, path, item, scope)
            return (Alternative(struct, place),)
        if not items and kind in ("", "auto"):
            # `{}` stands for no flags.
            return (Alternative(Array("", place), place),)
        if inner is None and kind and kind != "auto":
            if (
                len(items) == 1
                and items[0][0] is None
                and self.library.is_scalar(kind)
                and self.class_of(kind, scope.enclosing) is None
            ):
                return self.value(items[0][1], scope, kind)
            if not items and (
                self.library.is_type(kind) or kind.startswith(("bool", "int", "uint", "float"))
            ):
                return UNKNOWN_VALUE
            if (
                not items
                or not self.library.is_scalar(kind)
                or self.class_of(kind, scope.enclosing) is not None
            ):
                return self.class_value(kind, items, place, scope)
        made_list = self.list_value(inner or "", items, place, scope)
        if inner is not None and isinstance(made_list[0].value, Array):
            self.fill_array(made_list[0].value, kind, scope)
        return made_list

    def counted_pointer(self, items: Items, place: Span, scope: Scope) -> Value | None:
        """Returns the list of a count and a pointer to its elements, as vulkan.hpp takes it: `{1,
        &subpass}`.
        """
        if (
            len(items) != 2
            or any(path for path, _ in items)
            or items[1][1][0] not in (ADDRESS, CALL, NAME, FIELD)
        ):
            return None
        count = self.sole(items[0][1], scope)
        target = sole_value(self.value(items[1][1], scope))
        if type(count) is not int or not isinstance(target, Ref):
            return None
        content = pointee(target)
        array = Array("", place)
        array.items = content.items[:count] if isinstance(content, Array) else [target.cell]
        array.complete = len(array.items) == count
        return (Alternative(array, place),)

    def tuple_value(self, items: Items, place: Span, scope: Scope) -> Value:
        """Returns a tuple, whose items have numbers and may have labels."""
        struct = Struct("", place, True)
        for n, (path, item) in enumerate(items):
            self.initialize_designated(struct, path or (n,), item, scope)
            struct.fields[str(n)] = struct.cell(self.library.member(str((path or (n,))[0])))
        return (Alternative(struct, place),)

    def list_value(self, kind: str, items: Items, place: Span, scope: Scope) -> Value:
        array = Array(kind, place)
        counted = self.counted_pointer(items, place, scope)
        if counted is not None:
            return counted
        if (
            len(items) == 1
            and items[0][0] is None
            and items[0][1][0] == BRACES
            and not items[0][1][1]
        ):
            inner = items[0][1][2]
            # A std::array may have a second pair of braces; an element may have braces too.
            if (
                inner
                and (inner[0][1][0] in (BRACES, CALL, NAME, FIELD, INDEX) and not inner[0][0])
                and (not self.library.structure(kind) or self.has_kind(inner[0][1], kind, scope))
            ):
                items = inner
        array.zeroed = True
        for path, term in items:
            if term[:2] == (LITERAL, 0) and len(items) == 1 and self.library.structure(kind):
                continue
            guards, term = self.unwrap_conditions(term)
            value = self.value(term, scope, kind)
            cell = Cell(kind)
            cell.writes = tuple(
                Alternative(self.copies.value(a.value), a.at, a.guards | guards) for a in value
            ) or (Alternative(UNKNOWN, term[-1], guards),)
            index = path[0] if path else len(array.items)
            if isinstance(index, str):
                index = sole_value(self.value((NAME, index.removeprefix("["), term[-1]), scope))
            if not isinstance(index, int) or not 0 <= index <= 64:
                array.complete = False
                continue
            while len(array.items) < index:
                array.items.append(Cell(kind))
            if index < len(array.items):
                array.items[index] = cell
            else:
                array.items.append(cell)
            element = sole_value(cell.writes)
            if isinstance(element, Struct) and not element.name and term[0] in (NAME, FIELD):
                element.name = str(term[1] if term[0] == NAME else term[2])
        return (Alternative(array, place),)

    def sized_list(self, kind: str, arguments: Sequence[Term], place: Span, scope: Scope) -> Value:
        """Returns `std::vector<T> list(3)` or `list(3, value)`."""
        array = Array(kind, place)
        counts = self.value(arguments[0], scope) if arguments else (Alternative(0, place),)
        if (
            not counts
            or not all(type(item.value) is int and 0 <= item.value <= 64 for item in counts)
            or len(arguments) > 2
        ):
            value = pointee(sole_value(counts))
            if isinstance(value, Array) and all(
                value is self.target(a, scope) for a in arguments[1:]
            ):
                return (Alternative(self.copies.value(value), place),)
            array.complete = False
            return (Alternative(array, place),)
        for n in range(max(item.value for item in counts)):
            item = self.unset_element(kind, place, True)
            if len(arguments) == 2:
                item.writes = self.copies.alternatives(self.value(arguments[1], scope, kind))
            present = [count.guards for count in counts if count.value > n]
            if len(present) < len(counts):
                # The list is longer under some conditions.
                item.writes = tuple(
                    write._replace(guards=write.guards | guards)
                    for guards in present
                    for write in item.writes
                )
            array.items.append(item)
        return (Alternative(array, place),)

    def class_value(self, kind: str, items: Items, place: Span, scope: Scope) -> Value:
        """Returns an object of a class in the file, built by its constructor or from its members in
        order.
        """
        arguments = tuple(item for _, item in items)
        built = self.construct_class(kind, (CALL, (NAME, kind, place), arguments, place), scope)
        if built is not None:
            return built
        class_name = self.class_of(kind, scope.enclosing) or ""
        struct = self.new_object(class_name, place)
        members = self.members.get(class_name, {})
        for name, (path, term) in zip(members, items, strict=False):
            if not path:
                value = self.value(term, scope, members[name][1])
                struct.cell(self.library.member(name)).writes = self.copies.alternatives(value)
        return (Alternative(struct, place),)

    def has_kind(self, term: Term, kind: str, scope: Scope) -> bool:
        if term[0] == BRACES:
            return True
        value = self.target(term, scope)
        return isinstance(value, Struct) and self.library.is_alike(
            value.kind, self.library.structure(kind)
        )

    def count_value(self, value: Any, place: Span) -> Value:
        value = pointee(value)
        return (
            (Alternative(len(value.items), place),)
            if isinstance(value, Array) and value.is_known
            else UNKNOWN_VALUE
        )

    def copy_memory(self, target: Term, source: Term, scope: Scope) -> None:
        """Executes `memcpy(&a, &b, sizeof a)` and the like."""
        to, content = self.target(target, scope), self.target(source, scope)
        if isinstance(to, Struct) and isinstance(content, Struct) and not scope.guards:
            copy = self.copies.value(content)
            to.fields, to.zeroed, to.kind = copy.fields, copy.zeroed, to.kind or copy.kind
        elif isinstance(to, Array) and isinstance(content, Array) and not scope.guards:
            copied = self.copies.value(content)
            to.items[: len(copied.items)], to.complete = (
                copied.items,
                to.complete and copied.complete,
            )
        elif isinstance(to, (Struct, Array)):
            forget(to)

    def allocated(
        self, name: str, arguments: Sequence[Term], kind: str, place: Span, scope: Scope
    ) -> Value:
        """Returns memory for one or several structures of a type."""
        zeroed = "calloc" in name
        counts = [self.count_of_bytes(argument, scope) for argument in arguments]
        count = (
            counts[0] * counts[1]
            if len(counts) == 2 and counts[0] and counts[1]
            else counts[0]
            if len(counts) == 1
            else None
        )
        element = self.unset_element(kind, place, zeroed).writes or (
            Alternative(self.new_object(self.class_of(kind, "") or "", place), place),
        )
        if count == 1:
            return element
        array = Array(kind, place)
        array.zeroed = zeroed
        array.items = [
            self.unset_element(kind, place, zeroed)
            for _ in range(count if count is not None and count <= 64 else 0)
        ]
        return (Alternative(array, place),)

    def count_of_bytes(self, term: Term, scope: Scope) -> int | None:
        """Returns the number of elements in `n * sizeof(T)`, or None."""
        if term[0] == UNPARSED and term[1].startswith("sizeof"):
            return 1
        if term[0] == BINARY and term[1] == "*":
            left, right = self.count_of_bytes(term[2], scope), self.count_of_bytes(term[3], scope)
            return left * right if left is not None and right is not None else None
        count = self.sole(term, scope)
        return count if type(count) is int and 0 < count <= 64 else None

    def zero_memory(self, arguments: Sequence[Term], scope: Scope) -> Value:
        """Executes `memset(&x, 0, sizeof x)`."""
        if self.sole(arguments[1], scope) == 0:
            value = self.target(arguments[0], scope)
            target = arguments[0]
            if isinstance(value, Array) and target[0] == ADDRESS and target[1][0] == INDEX:
                size = arguments[2][1] if arguments[2][0] == UNPARSED else ""
                if "[" in size or "sizeof(Vk" in size.replace("struct", "").replace(" ", ""):
                    value = pointee(sole_value(value.items[0].writes)) if value.items else None
                elif not size.startswith("sizeof"):
                    for cell in value.items:
                        cell.writes = (Alternative(UNKNOWN, target[-1]),)
                    return UNKNOWN_VALUE
            for element in structures_in(value):
                element.zeroed = True
                element.fields.clear()
            if isinstance(value, Array) and self.library.structure(value.kind):
                # Elements added later are zero too.
                value.zeroed = True
        return UNKNOWN_VALUE

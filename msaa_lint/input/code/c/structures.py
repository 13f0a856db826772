"""Structures and lists that expressions make."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

from msaa_lint.core.text.span import Span

from .evaluate import Values
from .names import MEMBERS, WITHOUT_TYPE, elements, first_version, is_scalar, member, structure
from .scope import Around
from .terms import ADDRESS, BRACES, CALL, FIELD, INDEX, LITERAL, NAME, SOME, UNPARSED, Term
from .values import (
    ALWAYS,
    UNKNOWN,
    UNKNOWN_VALUE,
    Alternative,
    Array,
    Cell,
    Guards,
    Struct,
    Value,
    VulkanObject,
    copied,
    copies,
    one,
    pointee,
)


def member_type(kind: str, name: str) -> str:
    """The type of a member, where braces may give it."""
    return MEMBER_TYPES.get(member(name), "") if kind else ""


MEMBER_TYPES = {
    "attachments": "",
    "extent": "VkExtent3D",
    "subpasses": "std::vector<VkSubpassDescription>",
    "dependencies": "std::vector<VkSubpassDependency>",
    "colorAttachments": "",
    "depthStencilAttachment": "VkAttachmentReference",
}


def _hpp_defaults(struct: Struct) -> None:
    """Sample counts of vulkan.hpp's structures are 1 from the beginning, not 0."""
    if struct.kind in ("AttachmentDescription", "AttachmentDescription2", "ImageCreateInfo"):
        struct.cell("samples").writes = (Alternative(1, struct.at),)
    elif struct.kind == "PipelineMultisampleStateCreateInfo":
        struct.cell("rasterizationSamples").writes = (Alternative(1, struct.at),)


class Structures(ABC):
    """What the calls of one file make: its structures and lists."""

    def __init__(self, run: Values) -> None:
        self.run = run
        self.made: dict[tuple[Any, ...], VulkanObject] = {}
        self.met: dict[tuple[Any, ...], VulkanObject] = {}
        self.born: list[tuple[Struct, Guards]] = []
        self.resolves: dict[Span, tuple[Value, Value]] = {}
        self.followed: dict[Span, int] = {}

    def begin(self) -> None:
        """Forgets what an earlier turn made, but not which object is which."""
        self.met = {}
        self.born.clear()
        self.resolves.clear()
        self.followed.clear()

    @abstractmethod
    def object_made(self, kind: str, term: Term, around: Around) -> Value | None:
        """An object of a class of the file's, by its constructor."""

    def constructed(self, kind: str, arguments: Sequence[Term], place: Span, around: Around, hpp: bool) -> Value:
        """A structure made with arguments in the order of its members. vulkan.hpp takes lists for a count and a pointer."""
        struct = Struct(kind, place, True)
        if hpp:
            _hpp_defaults(struct)
        if len(arguments) == 1 and arguments[0][0] in (NAME, FIELD):
            value = pointee(one(self.run.value(arguments[0], around)))
            if isinstance(value, Struct) and first_version(value.kind) == first_version(kind):
                return (Alternative(copied(value), place),)
        self.positional(struct, [(None, a) for a in arguments], around, hpp)
        return (Alternative(struct, place),)

    def positional(self, struct: Struct, items: Sequence[tuple[Any, Term]], around: Around, hpp: bool) -> None:
        names = list(MEMBERS[struct.kind])
        if not hpp and struct.kind not in WITHOUT_TYPE:
            names = ["sType", "pNext", *names]
        elif hpp and struct.kind not in WITHOUT_TYPE:
            names.append("pNext")
        n = 0
        for path, term in items:
            if path:
                self.designated(struct, path, term, around)
                name = str(path[0])
                n = names.index(name) + 1 if name in names else n
                continue
            if n >= len(names):
                return
            if term[0] == SOME:
                # Which member is which hangs on a condition.
                for name in names[n:]:
                    struct.cell(member(name)).write(UNKNOWN_VALUE, term[-1], ALWAYS)
                return
            name = names[n]
            value = self.run.by_pointer(name, self.run.value(term, around, member_type(struct.kind, name)), term, around)
            target = pointee(one(value))
            if name.endswith("Count") and hpp and (isinstance(target, (Array, Struct)) or term[0] == BRACES):
                n += 1
                name = names[n] if n < len(names) else name
            struct.cell(member(name)).write(copies(value), term[-1], ALWAYS)
            n += 1

    def designated(self, struct: Struct, path: Sequence[str | int], term: Term, around: Around) -> None:
        """`.extent.width = 4`."""
        guards = ALWAYS
        if term[0] == SOME:
            guards, term = self.sometimes(term)
        target: Struct = struct
        for part in path[:-1]:
            cell = target.cell(member(str(part)))
            value = one(cell.writes)
            if not isinstance(value, Struct):
                value = Struct("", term[-1], True)
                cell.writes = (Alternative(value, term[-1]),)
            target = value
        name = str(path[-1])
        value = self.run.by_pointer(name, self.run.value(term, around, member_type(target.kind, name)), term, around)
        target.cell(member(name)).write(copies(value), term[-1], guards)

    def sometimes(self, term: Term) -> tuple[Guards, Term]:
        """The conditions of an item of braces, and the item."""
        guards = ALWAYS
        for _ in range(8):
            if term[0] != SOME:
                break
            guards, term = guards | {(term[1], term[2])}, term[3]
        return guards, term

    def braces(self, term: Term, around: Around, kind: str) -> Value:
        """What braces make, by the type that they are for."""
        kind, items, place = term[1] or kind, term[2], term[3]
        struct_name = structure(kind)
        hpp = kind.startswith(("vk::", "VULKAN"))
        if struct_name:
            struct = Struct(struct_name, place, True)
            if hpp:
                _hpp_defaults(struct)
            if len(items) == 1 and items[0][0] is None and items[0][1][0] in (NAME, FIELD):
                value = pointee(one(self.run.value(items[0][1], around)))
                if isinstance(value, Struct):
                    return (Alternative(copied(value), place),)
            self.positional(struct, [i for i in items if i[0] is not None or i[1][:2] != (LITERAL, 0) or len(items) > 1], around, hpp)
            return (Alternative(struct, place),)
        inner = elements(kind)
        if items and all(path for path, _ in items) and isinstance(items[0][0][0], str) and inner is None:
            struct = Struct("", place, True)
            for path, item in items:
                self.designated(struct, path, item, around)
            return (Alternative(struct, place),)
        if not items and kind in ("", "auto") and not struct_name:
            # `{}` for flags is none of them.
            return (Alternative(Array("", place), place),)
        if inner is None and kind and kind != "auto":
            if len(items) == 1 and items[0][0] is None and is_scalar(kind) and self.run.class_of(kind, around.space) is None:
                return self.run.value(items[0][1], around, kind)
            if not items and kind.startswith(("Vk", "vk::", "bool", "int", "uint", "float", "PFN")):
                return UNKNOWN_VALUE
            if not items or not is_scalar(kind) or self.run.class_of(kind, around.space) is not None:
                return self.of_class(kind, items, place, around)
        made_list = self.listed(inner or "", items, place, around)
        if inner is not None:
            self.run.filled(made_list[0].value, kind, around)
        return made_list

    def listed(self, kind: str, items: Sequence[tuple[Any, Term]], place: Span, around: Around) -> Value:
        array = Array(kind, place)
        if len(items) == 1 and items[0][0] is None and items[0][1][0] == BRACES and not items[0][1][1]:
            inner = items[0][1][2]
            # The second pair of braces of a std::array, unless it is the one element itself.
            if (
                inner
                and (inner[0][1][0] in (BRACES, CALL, NAME, FIELD, INDEX) and not inner[0][0])
                and (not structure(kind) or self.of_kind(inner[0][1], kind, around))
            ):
                items = inner
        array.zeroed = True
        for path, term in items:
            if term[:2] == (LITERAL, 0) and len(items) == 1 and structure(kind):
                continue
            guards, term = self.sometimes(term)
            value = self.run.value(term, around, kind)
            cell = Cell(kind)
            cell.writes = tuple(Alternative(copied(a.value), a.at, a.guards | guards) for a in value) or (
                Alternative(UNKNOWN, term[-1], guards),
            )
            index = path[0] if path else len(array.items)
            if isinstance(index, str):
                index = one(self.run.value((NAME, index.removeprefix("["), term[-1]), around))
            if not isinstance(index, int) or index > 64:
                array.whole = False
                continue
            while len(array.items) < index:
                array.items.append(Cell(kind))
            if index < len(array.items):
                array.items[index] = cell
            else:
                array.items.append(cell)
            element = one(cell.writes)
            if isinstance(element, Struct) and not element.name and term[0] in (NAME, FIELD):
                element.name = str(term[1] if term[0] == NAME else term[2])
        return (Alternative(array, place),)

    def sized(self, kind: str, arguments: Sequence[Term], place: Span, around: Around) -> Value:
        """`std::vector<T> list(3)`, and `(3, value)`."""
        array = Array(kind, place)
        count = one(self.run.value(arguments[0], around)) if arguments else 0
        if type(count) is not int or not 0 <= count <= 64 or len(arguments) > 2:
            value = pointee(count)
            if isinstance(value, Array) and all(value is pointee(one(self.run.value(a, around))) for a in arguments[1:]):
                return (Alternative(copied(value), place),)
            array.whole = False
            return (Alternative(array, place),)
        for _ in range(count):
            item = Cell(kind)
            if len(arguments) == 2:
                item.writes = copies(self.run.value(arguments[1], around, kind))
            elif structure(kind):
                item.writes = (Alternative(Struct(structure(kind), place, True), place),)
            array.items.append(item)
        return (Alternative(array, place),)

    def of_class(self, kind: str, items: Sequence[tuple[Any, Term]], place: Span, around: Around) -> Value:
        """An object of a class of the file's, by its constructor or given its members in their order."""
        arguments = tuple(item for _, item in items)
        built = self.object_made(kind, (CALL, (NAME, kind, place), arguments, place), around)
        if built is not None:
            return built
        struct = Struct("", place, False)
        names = list(self.run.members.get(self.run.class_of(kind, around.space) or "", ()))
        for name, (path, term) in zip(names, items, strict=False):
            if not path:
                value = self.run.value(term, around)
                struct.cell(member(name)).writes = copies(value)
        return (Alternative(struct, place),)

    def of_kind(self, term: Term, kind: str, around: Around) -> bool:
        if term[0] == BRACES:
            return True
        value = pointee(one(self.run.value(term, around)))
        return isinstance(value, Struct) and first_version(value.kind) == first_version(structure(kind))

    def counted(self, value: Any, place: Span) -> Value:
        value = pointee(value)
        return (Alternative(len(value.items), place),) if isinstance(value, Array) and value.whole else UNKNOWN_VALUE

    def zeroed(self, arguments: Sequence[Term], around: Around) -> Value:
        """`memset(&x, 0, sizeof x)`."""
        if one(self.run.value(arguments[1], around)) == 0:
            value = pointee(one(self.run.value(arguments[0], around)))
            first = arguments[0]
            if isinstance(value, Array) and first[0] == ADDRESS and first[1][0] == INDEX:
                size = arguments[2][1] if arguments[2][0] == UNPARSED else ""
                if "[" in size or "sizeof(Vk" in size.replace("struct", "").replace(" ", ""):
                    value = pointee(one(value.items[0].writes)) if value.items else None
                elif not size.startswith("sizeof"):
                    for cell in value.items:
                        cell.writes = (Alternative(UNKNOWN, first[-1]),)
                    return UNKNOWN_VALUE
            for element in (
                [value] if isinstance(value, Struct) else [one(c.writes) for c in value.items] if isinstance(value, Array) else []
            ):
                if isinstance(element, Struct):
                    element.zeroed = True
                    element.fields.clear()
            if isinstance(value, Array) and structure(value.kind):
                # Elements that come later are zero as well.
                value.zeroed = True
        return UNKNOWN_VALUE

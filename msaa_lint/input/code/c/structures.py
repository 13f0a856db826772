"""Structures and lists that expressions construct."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.limits import Work

from .evaluate import Evaluator
from .names import MEMBERS, WITHOUT_TYPE, element_type, first_version, is_scalar, member, vulkan_struct
from .scope import Scope
from .terms import ADDRESS, BRACES, CALL, FIELD, INDEX, LITERAL, NAME, SOME, UNPARSED, Term, Unit
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
    pointee,
    sole_value,
    structures_in,
)
from .variables import unset_element

Items = Sequence[tuple[tuple[str | int, ...] | None, Term]]
"""The items in braces: the designated members or None, and the term."""


def member_type(kind: str, name: str) -> str:
    """Returns the type of a member that can be initialized with braces."""
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
    """Sets the members of vulkan.hpp structures that default to a sample count of 1 rather than 0."""
    if struct.kind in ("AttachmentDescription", "AttachmentDescription2", "ImageCreateInfo"):
        struct.cell("samples").writes = (Alternative(1, struct.at),)
    elif struct.kind == "PipelineMultisampleStateCreateInfo":
        struct.cell("rasterizationSamples").writes = (Alternative(1, struct.at),)


class Structures(Evaluator):
    """Constructs the structures and lists of one file."""

    def __init__(self, unit: Unit, fragments: bool, is_cpp: bool, work: Work) -> None:
        super().__init__(unit, fragments, is_cpp, work)
        self.objects: dict[tuple[Any, ...], VulkanObject] = {}
        self.current_objects: dict[tuple[Any, ...], VulkanObject] = {}
        self.declared_structs: list[tuple[Struct, Guards]] = []
        self.resolves: dict[Span, tuple[Value, Value]] = {}
        self.follow_counts: dict[Span, int] = {}

    def begin(self) -> None:
        """Discards the results of the previous execution of the file, but keeps the identity of objects."""
        self.current_objects = {}
        self.declared_structs.clear()
        self.resolves.clear()
        self.follow_counts.clear()

    def construct(self, kind: str, items: Items, place: Span, scope: Scope) -> Value:
        """Returns a Vulkan structure of a type, or a copy. vulkan.hpp takes a list in place of a count and a pointer."""
        struct = Struct(vulkan_struct(kind), place, True)
        hpp = kind.startswith(("vk::", "VULKAN"))
        if hpp:
            _hpp_defaults(struct)
        if len(items) == 1 and items[0][0] is None:
            term = items[0][1]
            value = self.target(term, scope) if term[0] in (NAME, FIELD) else None
            if isinstance(value, Struct) and (not value.kind or first_version(value.kind) == first_version(struct.kind)):
                return (Alternative(self.copies.value(value), place),)
            if term[:2] == (LITERAL, 0):
                return (Alternative(struct, place),)
        self.initialize_positional(struct, items, scope, hpp)
        return (Alternative(struct, place),)

    def initialize_positional(self, struct: Struct, items: Items, scope: Scope, hpp: bool) -> None:
        names = list(MEMBERS[struct.kind])
        if not hpp and struct.kind not in WITHOUT_TYPE:
            names = ["sType", "pNext", *names]
        elif hpp and struct.kind not in WITHOUT_TYPE:
            names.append("pNext")
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
                    struct.cell(member(name)).write(UNKNOWN_VALUE, term[-1], ALWAYS)
                return
            name = names[n]
            value = self.as_pointer(name, self.value(term, scope, member_type(struct.kind, name)), term, scope)
            target = pointee(sole_value(value))
            if name.endswith("Count") and hpp and (isinstance(target, (Array, Struct)) or term[0] == BRACES):
                n += 1
                name = names[n] if n < len(names) else name
            struct.cell(member(name)).write(self.copies.alternatives(value), term[-1], ALWAYS)
            n += 1

    def initialize_designated(self, struct: Struct, path: Sequence[str | int], term: Term, scope: Scope) -> None:
        """Initializes a designated member: `.extent.width = 4`."""
        guards = ALWAYS
        if term[0] == SOME:
            guards, term = self.unwrap_conditions(term)
        target: Struct = struct
        for part in path[:-1]:
            cell = target.cell(member(str(part)))
            value = sole_value(cell.writes)
            if not isinstance(value, Struct):
                value = Struct("", term[-1], True)
                cell.writes = (Alternative(value, term[-1]),)
            target = value
        name = str(path[-1])
        value = self.as_pointer(name, self.value(term, scope, member_type(target.kind, name)), term, scope)
        target.cell(member(name)).write(self.copies.alternatives(value), term[-1], guards)

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
        if vulkan_struct(kind):
            return self.construct(kind, items, place, scope)
        inner = element_type(kind)
        if items and all(path for path, _ in items) and isinstance(items[0][0][0], str) and inner is None:
            struct = Struct("", place, True)
            for path, item in items:
                self.initialize_designated(struct, path, item, scope)
            return (Alternative(struct, place),)
        if not items and kind in ("", "auto"):
            # `{}` stands for no flags.
            return (Alternative(Array("", place), place),)
        if inner is None and kind and kind != "auto":
            if len(items) == 1 and items[0][0] is None and is_scalar(kind) and self.class_of(kind, scope.namespace) is None:
                return self.value(items[0][1], scope, kind)
            if not items and kind.startswith(("Vk", "vk::", "bool", "int", "uint", "float", "PFN")):
                return UNKNOWN_VALUE
            if not items or not is_scalar(kind) or self.class_of(kind, scope.namespace) is not None:
                return self.class_value(kind, items, place, scope)
        made_list = self.list_value(inner or "", items, place, scope)
        if inner is not None:
            self.fill_array(made_list[0].value, kind, scope)
        return made_list

    def list_value(self, kind: str, items: Items, place: Span, scope: Scope) -> Value:
        array = Array(kind, place)
        if len(items) == 1 and items[0][0] is None and items[0][1][0] == BRACES and not items[0][1][1]:
            inner = items[0][1][2]
            # A std::array may have a second pair of braces; an element may have braces too.
            if (
                inner
                and (inner[0][1][0] in (BRACES, CALL, NAME, FIELD, INDEX) and not inner[0][0])
                and (not vulkan_struct(kind) or self.has_kind(inner[0][1], kind, scope))
            ):
                items = inner
        array.zeroed = True
        for path, term in items:
            if term[:2] == (LITERAL, 0) and len(items) == 1 and vulkan_struct(kind):
                continue
            guards, term = self.unwrap_conditions(term)
            value = self.value(term, scope, kind)
            cell = Cell(kind)
            cell.writes = tuple(Alternative(self.copies.value(a.value), a.at, a.guards | guards) for a in value) or (
                Alternative(UNKNOWN, term[-1], guards),
            )
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
        count = self.sole(arguments[0], scope) if arguments else 0
        if type(count) is not int or not 0 <= count <= 64 or len(arguments) > 2:
            value = pointee(count)
            if isinstance(value, Array) and all(value is self.target(a, scope) for a in arguments[1:]):
                return (Alternative(self.copies.value(value), place),)
            array.complete = False
            return (Alternative(array, place),)
        for _ in range(count):
            item = unset_element(kind, place, True)
            if len(arguments) == 2:
                item.writes = self.copies.alternatives(self.value(arguments[1], scope, kind))
            array.items.append(item)
        return (Alternative(array, place),)

    def class_value(self, kind: str, items: Items, place: Span, scope: Scope) -> Value:
        """Returns an object of a class in the file, built by its constructor or from its members in order."""
        arguments = tuple(item for _, item in items)
        built = self.construct_class(kind, (CALL, (NAME, kind, place), arguments, place), scope)
        if built is not None:
            return built
        struct = Struct("", place, False)
        names = list(self.members.get(self.class_of(kind, scope.namespace) or "", ()))
        for name, (path, term) in zip(names, items, strict=False):
            if not path:
                value = self.value(term, scope)
                struct.cell(member(name)).writes = self.copies.alternatives(value)
        return (Alternative(struct, place),)

    def has_kind(self, term: Term, kind: str, scope: Scope) -> bool:
        if term[0] == BRACES:
            return True
        value = self.target(term, scope)
        return isinstance(value, Struct) and first_version(value.kind) == first_version(vulkan_struct(kind))

    def count_value(self, value: Any, place: Span) -> Value:
        value = pointee(value)
        return (Alternative(len(value.items), place),) if isinstance(value, Array) and value.complete else UNKNOWN_VALUE

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
            if isinstance(value, Array) and vulkan_struct(value.kind):
                # Elements added later are zero too.
                value.zeroed = True
        return UNKNOWN_VALUE

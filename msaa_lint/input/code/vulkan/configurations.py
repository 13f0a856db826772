"""The configuration that is described for a program that can render with one sample or with
several.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.configurations import Configuration
from msaa_lint.input.code.core.guards import Guards, covers
from msaa_lint.input.code.core.values import (
    UNKNOWN,
    ApiObject,
    Array,
    Cell,
    Ref,
    Struct,
    Symbol,
    Value,
    sole_value,
)

from .creation import VulkanInterpreter
from .enumerants import named
from .names import first_version
from .reads import Reads

NEEDS = {
    "AttachmentDescription": ("format", "samples"),
    "AttachmentReference": ("layout",),
    "RenderingAttachmentInfo": ("imageView",),
    "ImageCreateInfo": ("format", "usage"),
}
"""Members that are never zero in a valid structure. If one is not set by code that was understood,
other members may not be zero either.
"""

COUNTS = {
    "attachments": "attachmentCount",
    "subpasses": "subpassCount",
    "dependencies": "dependencyCount",
    "resolveAttachments": "colorAttachmentCount",
    "inputAttachments": "inputAttachmentCount",
    "colorAttachments": "colorAttachmentCount",
}
"""The member with the number of elements of another member."""


MAX_WRAPPERS = 3
"""One more than the maximum number of objects of the program around an object of Vulkan, one in
another.
"""


class VulkanConfiguration(Configuration):
    """The values of a Vulkan program in one configuration."""

    def __init__(self, program: VulkanInterpreter, fragments: bool, barriers: bool) -> None:
        super().__init__(list(program.current_objects.values()))
        self.assumed_places.update(program.initial_reads)
        self.program = program
        self.fragments = fragments
        self.barriers = barriers
        """Whether the file records barriers, which can replace subpass dependencies."""
        self.resolves = program.resolves
        self.reads = Reads(program)
        self.has_dynamic_samples = program.names.has_dynamic_samples
        self.multisampled_structs: set[int] = set()
        """The structures, by identity, whose unknown count is above 1."""
        self.object_names: dict[int, str] = {}
        self.used_names: set[str] = set()
        self.name_counts: dict[str, int] = {}
        """The number that the next object of a name takes."""
        self.framebuffer_images: dict[int, list[list[ApiObject | None]]] = {}
        """The images of each framebuffer of a render pass, by the identity of the pass."""
        self.duplicates: dict[tuple[Any, ...], ApiObject] = {}
        self.external_images: dict[str, tuple[str, Span, Node]] = {}

    def get(self, struct: Struct, name: str) -> tuple[Any, Span]:
        """Returns a member's value and location.

        The value is UNKNOWN if it is not known, and None if a zeroed structure does not set it.
        """
        cell = struct.fields.get(name)
        if cell is None or not cell.writes:
            # Without its required members, the structure was filled in a way that was not
            # understood.
            needs = NEEDS.get(first_version(struct.kind), ())
            is_zero = (
                struct.zeroed and cell is None and all(need in struct.fields for need in needs)
            )
            return (None if is_zero else UNKNOWN), struct.at
        value = self.settle(cell.writes)
        if struct.zeroed and value and not covers(tuple(a.guards for a in value)):
            return UNKNOWN, struct.at
        at = value[-1].at if value else struct.at
        constant = sole_value(value)
        return named(name, constant, at) if struct.kind else constant, at

    def known_value(self, struct: Struct, name: str) -> Any:
        value = self.get(struct, name)[0]
        return None if value is UNKNOWN else value

    def struct(self, struct: Struct, name: str) -> Struct | None:
        value = self.dereference(self.get(struct, name)[0])
        if isinstance(value, Array) and value.items:
            value = self.dereference(sole_value(self.settle(value.items[0].writes)))
        return value if isinstance(value, Struct) else None

    def structs(self, struct: Struct, name: str) -> list[Struct | None] | None:
        """Returns the structures that a member lists or points to: empty for null, None if unknown.
        Unknown elements are None.
        """
        structs, complete = self.elements(struct, name)
        return structs if complete else None

    def elements(self, struct: Struct, name: str) -> tuple[list[Struct | None], bool]:
        """Returns the known elements that a member lists or points to, and whether their order and
        number are known.
        """
        value = self.dereference(self.get(struct, name)[0])
        if value is None or (value == 0 and type(value) is int):
            return [], True
        if isinstance(value, Struct):
            return [value], True
        if not isinstance(value, Array):
            return [], False
        structs: list[Struct | None] = []
        complete = value.complete
        for cell in value.items:
            writes = self.settle(cell.writes)
            if cell.writes and not writes:
                # Present only in another configuration.
                continue
            complete = complete and not (writes and all(write.guards for write in writes))
            item = self.dereference(sole_value(writes))
            structs.append(item if isinstance(item, Struct) else None)
        count_member = COUNTS.get(name, "")
        count = self.known_value(struct, count_member)
        if type(count) is int and 0 <= count <= len(structs):
            return structs[:count], complete
        count_cell = struct.fields.get(count_member)
        # The number of elements depends on another condition.
        return structs, complete and (count_cell is None or len(self.settle(count_cell.writes)) < 2)

    def samples(self, struct: Struct, name: str = "samples") -> tuple[int | None, Span]:
        cell = struct.fields.get(name)
        value = self.settle(cell.writes) if cell is not None else ()
        at = max(a.at for a in value) if value else struct.at
        several = chosen_counts(value)
        if several:
            return self.assumed_count(f"count at {at.start}", name, at), at
        numbers = {self.count_of(a.value, a.at) for a in value}
        count = numbers.pop() if len(numbers) == 1 else None
        if count is None and id(struct) in self.multisampled_structs:
            count = self.assumed_count(
                f"count at {at.start}", f"{struct.name}.{name}" if struct.name else name, at
            )
        return count, at

    def image_of(self, struct: Struct, name: str) -> ApiObject | None:
        """Returns the image of the image view in a member."""
        return self.image_in(self.get(struct, name)[0])

    def image_in(self, view: Any) -> ApiObject | None:
        view = self.wrapped_object(view, "view")
        image = (
            self.wrapped_object(self.get(view.info, "image")[0], "image")
            if view is not None
            else None
        )
        return (
            self.first_duplicate(image)
            if image is not None and not self.is_excluded(image)
            else None
        )

    def wrapped_object(self, value: Any, kind: str) -> ApiObject | None:
        """Returns an object of Vulkan, or the only one of a kind that an object of the program
        holds, as a class that converts to it.
        """
        level = [self.dereference(value)]
        for _ in range(MAX_WRAPPERS):
            objects = [item for item in level if isinstance(item, ApiObject) and item.kind == kind]
            if objects:
                return objects[0] if all(item is objects[0] for item in objects) else None
            wrappers = [item for item in level if isinstance(item, Struct) and not item.kind]
            pointers = [item for item in level if isinstance(item, Symbol)]
            level = [
                self.dereference(sole_value(self.settle(cell.writes)))
                for item in wrappers
                for cell in item.fields.values()
            ]
            level += [value for pointer in pointers for value in self.members_of_pointed(pointer)]
        return None

    def members_of_pointed(self, pointer: Symbol) -> list[Any]:
        """Returns what methods assign to the members of the object that a member points to: a
        singleton, for example.
        """
        program = self.program
        class_name = (
            program.pointed_class(pointer.key).removesuffix("::") if "::" in pointer.key else ""
        )
        names = [
            f"{owner}::{name}"
            for owner in program.classes.chain(class_name)
            for name in program.members.get(owner, ())
        ]
        return [
            self.dereference(write.value)
            for name in names
            for write in program.summary.get(name, ())
        ]

    def first_duplicate(self, obj: ApiObject) -> ApiObject:
        """Returns the first object that is identical to this one; calling a function twice creates
        two.
        """
        return self.duplicates.setdefault((obj.name, obj.signature()), obj)


def chosen_counts(value: Value) -> set[int]:
    """Returns the counts above 1 that a program chooses from; empty for fewer than three."""
    counts = {a.value for a in value if type(a.value) is int and a.value > 1}
    return counts if len(counts) > 2 else set()


def guarded_structs(
    cell: Cell, depth: int, guards: Guards = frozenset()
) -> Iterator[tuple[Struct, Guards]]:
    """Yields the structures that a member lists or points to in any configuration, and under which
    conditions.
    """
    for write in cell.writes if depth < 6 else ():
        if isinstance(write.value, Struct):
            yield write.value, guards | write.guards
        elif isinstance(write.value, Ref):
            yield from guarded_structs(write.value.cell, depth + 1, guards | write.guards)
        elif isinstance(write.value, Array):
            for item in write.value.items:
                yield from guarded_structs(item, depth + 1, guards | write.guards)

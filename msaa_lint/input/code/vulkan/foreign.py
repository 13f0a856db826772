"""What code outside of the program does with objects of Vulkan: allocators and wrappers of
libraries.
"""

from __future__ import annotations

import re
from abc import abstractmethod
from collections.abc import Sequence
from typing import Any

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.lists import Receiver
from msaa_lint.input.code.core.scope import MEMBER, Scope
from msaa_lint.input.code.core.terms import CALL, FIELD, NAME, Function, Term
from msaa_lint.input.code.core.values import (
    UNKNOWN,
    Alternative,
    ApiObject,
    Array,
    Cell,
    Ref,
    Struct,
    Symbol,
    Value,
    pointee,
    sole_value,
)

from .chains import StructureChains

_IMPLEMENTED = re.compile(
    r"vma(?:Create|Allocate|Destroy|Find)[A-Z]\w*$|vk(?:Create(?:Image|ImageView|RenderPass2?|Framebuffer|Device)|CmdBeginRendering)(?:KHR)?$"
)
"""Functions of Vulkan and the Vulkan Memory Allocator that a program may contain an implementation
of.
"""

_OBJECT = re.compile(
    r"(?:m_|_)?(?:vk)?(?:image|img|handle|texture|tex|object|resource|descriptor)_?$", re.IGNORECASE
)
"""Members of what a library creates for an image that are the image, or hold its view."""

_VIEW = re.compile(r"view", re.IGNORECASE)

_OUTPUTS = {
    "image": re.compile(r"image|img|texture|target|attachment", re.IGNORECASE),
    "view": _VIEW,
}
"""What an argument, or its type, is called in which a library returns what it creates."""


class ForeignCode(StructureChains):
    """Knows what code outside of the program does."""

    @abstractmethod
    def view_of_argument(self, values: Sequence[Value], term: Term, scope: Scope) -> Value | None:
        """Returns a view of the only image among the arguments, or None."""

    def creation_structure(self, value: Value, before: Value, scope: Scope) -> Any:
        """Returns the structure that an argument points to: the first of a list, unless the
        argument before it is another count than 1. Several that functions assign to a member in
        turn are merged.
        """
        pointer = sole_value(value)
        content = pointer.cell.read(scope.guards) if isinstance(pointer, Ref) else ()
        if len({a.value.kind if isinstance(a.value, Struct) else "" for a in content}) == 1 < len(
            content
        ) and all(isinstance(a.value, Struct) and a.value.kind for a in content):
            return self.copies.merged(content)
        known = pointee(pointer)
        if not isinstance(known, Array) or not known.items:
            return known
        first = pointee(sole_value(known.items[0].writes))
        several = (
            isinstance(first, Struct)
            and first.kind == "GraphicsPipelineCreateInfo"
            and sole_value(before) != 1
        )
        return known if several and len(known.items) > 1 else first

    def find_function(
        self,
        name: str,
        arguments: Sequence[Term],
        function: Term,
        receiver: Receiver | None,
        scope: Scope,
    ) -> Function | None:
        # What commands create is known, also where a program contains a library that implements
        # them.
        is_command = receiver is None and _IMPLEMENTED.match(name) is not None
        return (
            None
            if is_command
            else super().find_function(name, arguments, function, receiver, scope)
        )

    def member_of_object(
        self, value: Any, cell: Cell, name: str, place: Span, scope: Scope
    ) -> Cell | None:
        """Returns what is read from a member of an object that a library creates for an image: the
        image, or its view.
        """
        if not isinstance(value, ApiObject) or value.kind != "image" or not self.reading:
            return super().member_of_object(value, cell, name, place, scope)
        if cell.kind == MEMBER and self.part_of_member(cell, name).writes:
            return None
        image = (Alternative(value, place),)
        if _VIEW.search(name):
            return Cell(
                writes=self.view_of_argument([image], (CALL, (NAME, name, place), (), place), scope)
                or ()
            )
        return Cell(writes=image) if _OBJECT.match(name) else None

    def output_argument(
        self, kind: str, arguments: Sequence[Term], values: Sequence[Value], scope: Scope
    ) -> Cell | None:
        """Returns the variable that a library's function is passed by reference for what it
        creates, or None.
        """
        named = _OUTPUTS.get(kind)
        for argument, value in zip(arguments, values, strict=True):
            if (
                named is None
                or not self.is_cpp
                or argument[0] not in (NAME, FIELD)
                or not _is_open(value, kind)
            ):
                continue
            if named.search(
                f"{argument[1] if argument[0] == NAME else argument[2]} "
                f"{self.type_of_term(argument, scope)}"
            ):
                return self.cell_of(argument, scope)
        return None


def _is_open(value: Value, kind: str) -> bool:
    """Returns whether a value may be overwritten: one of which nothing is known but its members,
    null, or an object of the same kind.
    """
    return all(
        a.value in (None, UNKNOWN)
        or isinstance(a.value, Symbol)
        or (isinstance(a.value, ApiObject) and a.value.kind == kind)
        or (isinstance(a.value, Struct) and not a.value.kind and not a.value.type)
        for a in value
    )

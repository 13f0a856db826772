"""Which images with a usage that allows reads no code of the program reads.

An image that external code does not have can only be read by a copy or a descriptor of the program.
If the program has one whose image is not known, it may be any image.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from msaa_lint.input.code.core.values import (
    UNKNOWN,
    ApiObject,
    Ref,
    Struct,
    Symbol,
    Value,
    inner_cells,
)

from .creation import VulkanInterpreter


class Reads:
    """The reads of images in one program."""

    def __init__(self, program: VulkanInterpreter) -> None:
        self.program = program
        self.parameters = {
            f"{function.name}({parameter.name})"
            for function in program.unit.functions
            for parameter in function.parameters
        }
        self.copied = self.images_of_all(program.copied)
        self.bound = self.images_of_all(
            struct.fields["imageView"].writes
            for struct in program.descriptors
            if "imageView" in struct.fields
        )
        self.visible = self.visible_objects()

    def is_unread(self, image: ApiObject, usage: str) -> bool:
        """Returns whether nothing can read an image, although its usage allows it."""
        if image.escaped or id(image) in self.visible or "STORAGE" in usage or "INPUT" in usage:
            return False
        reads = [
            *([self.copied] if "TRANSFER_SRC" in usage else ()),
            *([self.bound] if "SAMPLED" in usage else ()),
        ]
        return all(images is not None and id(image) not in images for images in reads)

    def images_of_all(self, values: Iterable[Value]) -> set[int] | None:
        """Returns the images that some values can be or be views of; None if one of them may be
        any.
        """
        images: set[int] = set()
        for value in values:
            read = self.images_of(value)
            if read is None:
                return None
            images |= read
        return images

    def images_of(self, value: Value) -> set[int] | None:
        """Returns the images, by identity, that a value can be or be a view of; None if it may be
        any.
        """
        images: set[int] = set()
        stack: list[Any] = [alternative.value for alternative in value] or [UNKNOWN]
        for _ in range(200):
            if not stack:
                return images
            item = stack.pop()
            if isinstance(item, Ref):
                stack += [write.value for write in item.cell.writes] or [UNKNOWN]
            elif isinstance(item, ApiObject) and item.kind == "view":
                stack += (
                    [write.value for write in item.info.fields["image"].writes]
                    if "image" in item.info.fields
                    else [UNKNOWN]
                )
            elif isinstance(item, ApiObject):
                images.add(id(item))
            elif isinstance(item, Struct) or (
                item is not None and item != 0 and not self.is_foreign(item)
            ):
                return None
        return None

    def is_foreign(self, value: Any) -> bool:
        """Returns whether a value comes from outside the program: a parameter of a function, a
        member that the program does not set.
        """
        return isinstance(value, Symbol) and (
            value.key in self.parameters
            or ("(" not in value.key and value.key not in self.program.summary)
        )

    def visible_objects(self) -> set[int]:
        """Returns the objects, by identity, in members of classes that are not declared in the
        program: other files may use them.
        """
        program = self.program
        visible: set[int] = set()
        seen: set[int] = set()
        for key, writes in program.summary.items():
            owner = key.rpartition("::")[0].partition(".")[0]
            name = key.removeprefix("::").partition(".")[0].partition("[")[0]
            if owner in program.members or (not owner and name in program.globals):
                continue
            stack: list[Any] = [write.value for write in writes]
            while stack:
                value = stack.pop()
                if isinstance(value, ApiObject):
                    visible.add(id(value))
                    stack += (
                        [w.value for w in value.info.fields["image"].writes]
                        if value.kind == "view" and "image" in value.info.fields
                        else []
                    )
                for cell in inner_cells(value):
                    if id(cell) not in seen:
                        seen.add(id(cell))
                        stack += [write.value for write in cell.writes]
        return visible

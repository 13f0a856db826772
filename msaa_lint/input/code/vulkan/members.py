"""Converts members of structures to nodes of a description."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, TypeVar

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.frame.vulkan.names import parse_enum, parse_flags
from msaa_lint.input.code.core.values import UNKNOWN, ApiObject, Array, Flags, Struct

from .enumerants import ENUMS, FLAGS
from .multisampling import Multisampling

Item = tuple[str, Span, Node]
_T = TypeVar("_T")

ZERO = {
    "loadOp": "LOAD", "storeOp": "STORE", "stencilLoadOp": "LOAD", "stencilStoreOp": "STORE",
    "initialLayout": "UNDEFINED",
    "imageType": "1D", "tiling": "OPTIMAL", "sharingMode": "EXCLUSIVE", "depthResolveMode": "NONE",
    "stencilResolveMode": "NONE",
    "resolveMode": "NONE", "sampleShadingEnable": False, "alphaToCoverageEnable": False,
    "alphaToOneEnable": False, "minSampleShading": 0.0,
    "srcAccessMask": (), "dstAccessMask": (), "blendEnable": False,
}  # fmt: skip
"""What zero means for members where it is a valid value."""


WITHOUT_USES = frozenset(
    {
        "RenderPassMultiviewCreateInfo",
        "RenderPassInputAttachmentAspectCreateInfo",
        "ImageFormatListCreateInfo",
    }
)
"""Structures of a pNext chain that are not read, and that neither name an attachment or image nor
change how one is used.
"""


def complete(nodes: Iterable[_T | None]) -> list[_T] | None:
    """Returns the nodes, or None if any of them is unknown."""
    known: list[_T] = []
    for node in nodes:
        if node is None:
            return None
        known.append(node)
    return known


class Members(Multisampling):
    """Converts members of structures to nodes."""

    def item(self, struct: Struct, name: str) -> Iterator[Item]:
        """Yields a member that is an enumerant, flags, a boolean, or a number, if its value is
        known.
        """
        value, at = self.get(struct, name)
        if value is None and name in ZERO:
            value = ZERO[name]
        if value is UNKNOWN and name in ("loadOp", "stencilLoadOp"):
            value = self.discarding_operation(struct, name)
        node = self.node(name, value, at)
        if node is not None:
            yield name, at, node

    def discarding_operation(self, struct: Struct, name: str) -> Any:
        """Returns one of the load operations that a program chooses from if none of them is LOAD,
        otherwise UNKNOWN.
        """
        cell = struct.fields.get(name)
        values = [write.value for write in self.settle(cell.writes)] if cell is not None else []
        operations = {
            parse_enum(ENUMS[name], value) if isinstance(value, str) else None for value in values
        }
        return (
            next((v for v in values if "CLEAR" in v), UNKNOWN)
            if operations == {"CLEAR", "DONT_CARE"}
            else UNKNOWN
        )

    def node(self, name: str, value: Any, at: Span) -> Node | None:
        if name in FLAGS:
            return flags_of(FLAGS[name], value, at)
        if name in ENUMS:
            if value == 0 and type(value) is int and name in ZERO:
                value = ZERO[name]
            short = parse_enum(ENUMS[name], value) if isinstance(value, str) else None
            # An undefined format means that the format is unknown.
            return (
                scalar(short, at)
                if short is not None and (short != "UNDEFINED" or name != "format")
                else None
            )
        if isinstance(value, bool) or (
            isinstance(value, (int, float)) and name == "minSampleShading"
        ):
            return scalar(value, at)
        if type(value) is int and name.endswith("Enable"):
            return scalar(bool(value), at)
        return None

    def chain(self, struct: Struct) -> tuple[list[Struct], bool]:
        """Returns the structures of a pNext chain that may use something, and whether these are all
        of them.
        """
        structs: list[Struct] = []
        value = self.get(struct, "next")[0] if struct.zeroed or "next" in struct.fields else None
        for _ in range(8):
            chained = self.dereference(value)
            if chained is None or (chained == 0 and type(chained) is int):
                return structs, True
            if not isinstance(chained, Struct) or not chained.kind:
                return structs, False
            if chained.kind not in WITHOUT_USES:
                structs.append(chained)
            value = (
                self.get(chained, "next")[0] if chained.zeroed or "next" in chained.fields else None
            )
        return structs, False

    def unread(self, struct: Struct) -> Item:
        """Returns the member that says that the pNext chain of a structure is not wholly known."""
        at = head_of(self.get(struct, "next")[1])
        return "pNext", at, sequence([scalar("UNKNOWN", at)], at)

    def object_name(self, obj: ApiObject, otherwise: str) -> str:
        """Returns a unique name for an object."""
        if id(obj) not in self.object_names:
            self.object_names[id(obj)] = self.unique(
                obj.name.rpartition("::")[2].strip("*&") or otherwise
            )
        return self.object_names[id(obj)]

    def unique(self, base: str) -> str:
        name, n = base, self.name_counts.get(base, 2)
        while name in self.used_names:
            name, n = f"{base} ({n})", n + 1
        self.used_names.add(name)
        self.name_counts[base] = n
        return name


def flags_of(enum: str, value: Any, at: Span) -> Node | None:
    """Returns a list of flags, or None if any of them is unknown."""
    if (
        value == ()
        or (type(value) is int and value == 0)
        or (isinstance(value, Array) and value.complete and not value.items)
    ):
        return sequence([], at)
    bits = (
        value.bits if isinstance(value, Flags) else ((value, at),) if isinstance(value, str) else ()
    )
    nodes = []
    for text, place in bits:
        try:
            names = list(parse_flags(enum, text))
        except ValueError:
            return None
        nodes += [scalar(name, place) for name in names]
    return sequence(nodes, at) if nodes or bits else None


def head_of(at: Span) -> Span:
    """Returns the location of the start of a long construct."""
    return at if at.end - at.start <= 80 else Span(at.start, at.start + 1)

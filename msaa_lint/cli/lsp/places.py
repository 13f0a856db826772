"""Places in a description's tree, with what the format says about each: the shape of its value and
the structure it is a member of.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.bind import fits
from msaa_lint.frame.description.models import AttachmentReference, Description
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.shapes import Shape
from msaa_lint.input.readers import vulkan_sc

UNKNOWN: Shape = ("unknown",)
"""The shape of the value of a key that the format does not have."""

SLOT: Shape = ("slot",)

_PROPERTIES = re.compile(r"(?:(?:&[^\s,\[\]{}]+|!<[^>\s]*>|![^\s,\[\]{}]*)[ \t\r\n]+)*")


class Place(NamedTuple):
    """A value in a description.

    `shape` is the shape that the value has been matched to, `stated` the one that its structure
    declares. `key` is the node of its key, `record` the structure whose member it is; both are None
    for an item of a list, `record` also for an entry of a mapping by name.
    """

    node: Node
    shape: Shape
    stated: Shape
    path: tuple[str, ...] = ()
    key: Node | None = None
    record: type[Record] | None = None
    parent: Place | None = None

    @property
    def ancestors(self) -> Iterator[Place]:
        """The place itself, then what it is in, up to the description."""
        place: Place | None = self
        while place is not None:
            yield place
            place = place.parent


def root_place(root: Node) -> Place:
    """The place of a whole description."""
    return Place(root, ("record", Description), ("record", Description))


def descriptions(roots: Sequence[Node]) -> list[Node]:
    """The documents of a text that are descriptions."""
    return [root for root in roots if not vulkan_sc.claims(root)]


def shape_for(shape: Shape, node: Node) -> Shape:
    """The one of a shape's alternatives that a node is of."""
    while True:
        kind = shape[0]
        if kind == "null":
            shape = shape[1]
        elif kind == "counted":
            return ("map" if node.kind == "mapping" else "list", shape[1])
        elif kind == "slot" and node.kind == "mapping":
            return "record", AttachmentReference
        elif kind == "either":
            shape = next((arm for arm in shape[1:] if fits(arm, node)), shape[1])
        else:
            return shape


def alternatives(shape: Shape) -> list[Shape]:
    """All shapes that a value of a shape may have."""
    kind = shape[0]
    if kind == "null":
        return alternatives(shape[1])
    if kind == "either":
        return [one for arm in shape[1:] for one in alternatives(arm)]
    if kind == "counted":
        return [("map", shape[1]), ("list", shape[1])]
    if kind == "slot":
        return [SLOT, ("record", AttachmentReference)]
    return [shape]


def members(
    shape: Shape, node: Node
) -> Iterator[tuple[str, Node | None, Node, Shape, type[Record] | None]]:
    """The name, key, value and declared shape of what a value consists of, aliases and merge keys
    expanded; and its structure.
    """
    kind = shape[0]
    if node.kind == "mapping":
        record: type[Record] | None = shape[1] if kind in ("record", "command") else None
        for name, value in node.value.items():
            if record is AttachmentReference and name == "attachment":
                stated: Shape = SLOT
            elif record is not None:
                stated = record.SHAPE.get(name, UNKNOWN)
            else:
                stated = shape[1] if kind in ("map", "numbered") else UNKNOWN
            yield name, node.keys[name], value, stated, record
    elif node.kind == "sequence":
        # Flags may be a list, too.
        stated = shape[1] if kind == "list" else ("enum", shape[1]) if kind == "flags" else UNKNOWN
        for index, item in enumerate(node.value):
            yield str(index), None, item, stated, None


def children(place: Place) -> Iterator[Place]:
    """The values that are written within a value: neither aliased nor merged ones."""
    node = place.node
    if node.anchor is not None:
        return
    for name, key, value, stated, record in members(place.shape, node):
        if node.start <= (key or value).start <= node.end:
            yield Place(
                value, shape_for(stated, value), stated, (*place.path, name), key, record, place
            )


def walk(root: Node) -> Iterator[Place]:
    """All places that are written in a document, in order."""
    pending = [root_place(root)]
    while pending:
        place = pending.pop()
        yield place
        if place.node.kind != "scalar":
            pending.extend(reversed(list(children(place))))


def place_at(roots: Sequence[Node], offset: int) -> tuple[Place, bool] | None:
    """The innermost value, or the one with the key, at an offset; and whether the offset is in its
    key. None outside of descriptions.
    """
    root = next((root for root in descriptions(roots) if root.start <= offset <= root.end), None)
    if root is None:
        return None
    place = root_place(root)
    while True:
        for child in children(place):
            if child.key is not None and child.key.start <= offset <= child.key.end:
                return child, True
            if child.node.start <= offset <= child.node.end and child.node.start < child.node.end:
                place = child
                break
        else:
            return place, False


def content(text: str, node: Node) -> Span:
    """The span of a node without its anchor and tag."""
    match = _PROPERTIES.match(text, node.start, node.end)
    return Span(match.end() if match is not None else node.start, node.end)


def inner(text: str, node: Node) -> Span:
    """The span of a scalar without its anchor, tag and quotes."""
    start, end = content(text, node)
    quoted = (
        not node.plain
        and end - start >= 2
        and text[start] in "\"'"
        and text[end - 1] == text[start]
    )
    return Span(start + 1, end - 1) if quoted else Span(start, end)

"""The names of a description: where each is defined, and where it is used."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.core.text.anchors import Anchor, anchors_of
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import Description, Pipeline, RenderPass
from msaa_lint.frame.description.scalars import EXTERNAL, UNUSED
from msaa_lint.frame.description.shapes import Shape

from .places import content, descriptions, inner, members, shape_for

SECTIONS = (
    "images",
    "renderPasses",
    "framebuffers",
    "pipelines",
    "metal.textures",
    "metal.renderPasses",
)
"""The mappings whose entries other structures name."""

ATTACHMENTS, SUBPASSES, ANCHORS = "attachments", "subpasses", "anchors"


class Name(NamedTuple):
    """What a name stands for: an entry of a section, or of the attachments or subpasses of a render
    pass.

    `scope` has the number of the document, or -1 for the kinds of frame of one program, whose
    objects of one name are one object; and the name of the render pass, if it is an entry of one.
    """

    section: str
    scope: tuple[int, str]
    text: str


class Occurrence(NamedTuple):
    """One place of a name. `is_index` says that a number stands there instead of the name."""

    node: Node
    is_definition: bool
    is_index: bool = False


Names = dict[Name, list[Occurrence]]


def names_of(roots: Sequence[Node]) -> Names:
    """All names of a text's descriptions, with their places in order. An anchored text belongs to
    all structures that share it.
    """
    found: Names = {}
    for number, root in enumerate(descriptions(roots)):
        _Reading(found, -1 if _is_frame_of_program(root) else number).read(root)
    return {
        name: sorted(set(places), key=lambda place: place.node.start)
        for name, places in found.items()
    }


def _is_frame_of_program(root: Node) -> bool:
    frame = root.value.get("frame") if root.kind == "mapping" else None
    return frame is not None and frame.kind == "mapping" and "share" in frame.value


class _Reading:
    """Reads the names of one document."""

    def __init__(self, found: Names, number: int) -> None:
        self.found = found
        self.number = number
        self.attachments: dict[str, list[str]] = {}
        """By render pass: the names of its attachments in order, if it names them."""

    def add(
        self,
        section: str,
        owner: str,
        text: str,
        node: Node,
        is_definition: bool = False,
        is_index: bool = False,
    ) -> None:
        name = Name(section, (self.number, owner), text)
        self.found.setdefault(name, []).append(Occurrence(node, is_definition, is_index))

    def read(self, root: Node) -> None:
        visited: set[tuple[int, str]] = set()
        pending: list[tuple[Node, Shape, str, tuple[str, ...]]] = [
            (root, ("record", Description), "", ())
        ]
        while pending:
            node, shape, owner, path = pending.pop()
            if node.kind == "scalar":
                self.read_scalar(node, shape, owner)
                continue
            if (id(node.value), owner) in visited:
                continue
            visited.add((id(node.value), owner))
            if ".".join(path) in SECTIONS:
                for text, key in node.keys.items():
                    self.add(".".join(path), "", text, key, is_definition=True)
            if shape == ("record", RenderPass):
                owner = path[-1]
                self.define_parts(node, owner)
            if shape == ("record", Pipeline) and node.kind == "mapping":
                self.read_subpass_of(node)
            for text, _, value, stated, _ in members(shape, node):
                pending.append(
                    (
                        value,
                        shape_for(stated, value),
                        owner,
                        (*path, text) if len(path) < 3 else path,
                    )
                )

    def define_parts(self, node: Node, owner: str) -> None:
        """Adds the attachments and subpasses of a render pass."""
        for section in (ATTACHMENTS, SUBPASSES):
            entries = node.value.get(section) if node.kind == "mapping" else None
            if entries is not None and entries.kind == "mapping" and section == ATTACHMENTS:
                self.attachments[owner] = list(entries.keys)
                for text, key in entries.keys.items():
                    self.add(section, owner, text, key, is_definition=True)
            elif entries is not None and entries.kind == "sequence":
                for index, item in enumerate(entries.value):
                    self.add(section, owner, str(index), item, is_definition=True, is_index=True)

    def read_subpass_of(self, node: Node) -> None:
        """Adds the subpass that a pipeline is for."""
        owner, index = node.value.get("renderPass"), node.value.get("subpass")
        if owner is not None and index is not None and owner.kind == index.kind == "scalar":
            self.add(SUBPASSES, owner.text, index.text, index, is_index=True)

    def read_scalar(self, node: Node, shape: Shape, owner: str) -> None:
        """Adds what a scalar names."""
        kind = shape[0]
        if node.value is None or isinstance(node.value, (bool, float)):
            return
        if kind == "name":
            self.add(shape[1], "", node.text, node)
        elif kind == "slot" and isinstance(node.value, int):
            names = self.attachments.get(owner, [])
            text = names[node.value] if 0 <= node.value < len(names) else node.text
            self.add(ATTACHMENTS, owner, text, node, is_index=True)
        elif kind == "slot" and node.text not in UNUSED:
            self.add(ATTACHMENTS, owner, node.text, node)
        elif kind == "subpass" and node.text not in EXTERNAL:
            self.add(SUBPASSES, owner, node.text, node, is_index=True)


def names_at(names: Names, text: str, offset: int) -> list[Name]:
    """The names at an offset: several where an anchored text is shared by several render passes."""
    return [
        name
        for name, places in names.items()
        for node in (place.node for place in places)
        if (node.kind == "scalar" and content(text, node).start <= offset <= node.end)
        or _is_head(node, offset)
    ]


def _is_head(node: Node, offset: int) -> bool:
    return node.kind != "scalar" and offset == node.start


def connected(names: Names, first: Sequence[Name]) -> list[Name]:
    """The given names, and all that share a place with one of them, directly or through others."""
    by_place: dict[int, list[Name]] = {}
    for name, places in names.items():
        for place in places:
            by_place.setdefault(id(place.node), []).append(name)
    found = dict.fromkeys(first)
    pending = list(first)
    while pending:
        for place in names[pending.pop()]:
            for name in by_place[id(place.node)]:
                if name not in found:
                    found[name] = None
                    pending.append(name)
    return list(found)


def occurrences(names: Names, of: Sequence[Name]) -> list[Occurrence]:
    """The places of some names, in order."""
    return sorted(
        {place for name in of for place in names[name]}, key=lambda place: place.node.start
    )


def span_of(text: str, place: Occurrence) -> Span:
    """The place of a name without quotes; of an entry of a list its first character."""
    if place.node.kind == "scalar":
        return inner(text, place.node)
    start = content(text, place.node).start
    return Span(start, min(start + 1, place.node.end))


def anchor_at(text: str, offset: int) -> tuple[Anchor, Span] | None:
    """The anchor that is defined or named at an offset, and the place of its name there."""
    for anchor in anchors_of(text):
        for span in anchor.spans:
            if span.start - 1 <= offset <= span.end:
                return anchor, span
    return None

"""Converts a Metal render pass descriptor to a Vulkan render pass with one subpass."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import StencilApart
from msaa_lint.frame.description.models import (
    MetalColorAttachment,
    MetalDepthAttachment,
    MetalRenderPass,
    MetalStencilAttachment,
)
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.scalars import UNUSED
from msaa_lint.frame.metal.names import MULTISAMPLE_RESOLVES

_LOAD = {"load": "LOAD", "clear": "CLEAR", "dontCare": "DONT_CARE"}
_STORE = {
    "store": "STORE",
    "storeAndMultisampleResolve": "STORE",
    "customSampleDepthStore": "STORE",
    "dontCare": "DONT_CARE",
    "multisampleResolve": "DONT_CARE",
}
_DEPTH_FILTERS = {None: "SAMPLE_ZERO", "sample0": "SAMPLE_ZERO", "min": "MIN", "max": "MAX"}

Kind = TypeVar("Kind")
Items = list[tuple[str, Span, Node]]
"""The items of a mapping: key, place of the key, and value."""

MetalAttachment = MetalColorAttachment | MetalDepthAttachment | MetalStencilAttachment


class PassTree:
    """The attachments of a pass in Vulkan's order: color, depth and stencil, then resolve
    targets.
    """

    def __init__(self, each: MetalRenderPass) -> None:
        self.each = each
        self.attachments: Items = []
        self.origins: list[tuple[str, Mapping[str, Record]]] = []
        """For each attachment, its path and its Metal structures by aspect; empty for a resolve
        target.
        """
        self.apart: StencilApart | None = None
        # `UNUSED` contains reserved names.
        self._names: set[str] = set(UNUSED)

    def tree(self) -> Node:
        subpass: Items = []
        colors = by_index(self.each.colorAttachments)
        references = [self._color(n, color) for n, color in enumerate(colors)]
        if colors:
            at = key_of(self.each, "colorAttachments")
            subpass.append(("colorAttachments", at, sequence(references, at)))
        resolved: list[tuple[int, MetalColorAttachment]] = [
            (n, c) for n, c in enumerate(colors) if c is not None and resolves(c)
        ]
        subpass += self._depth_stencil()
        if resolved:
            slots = [scalar(None, self.each.head) for _ in colors]
            for n, color in resolved:
                slots[n] = self._target(color, f"colorAttachments[{n}]", ("color",))
            at = key_of(self.each, "colorAttachments")
            subpass.append(("resolveAttachments", at, sequence(slots, at)))
        head, whole = self.each.head, self.each.node.span
        return mapping(
            [
                ("attachments", head, mapping(self.attachments, whole)),
                ("subpasses", head, sequence([mapping(subpass, whole)], whole)),
            ],
            whole,
        )

    def _name(self, texture: str | None, otherwise: str) -> str:
        """A unique name within the pass: the texture's if it is free."""
        candidates = [texture, f"{texture} ({otherwise})"] if texture is not None else []
        name = next(
            (candidate for candidate in (*candidates, otherwise) if candidate not in self._names),
            otherwise,
        )
        while name in self._names:
            name += "'"
        self._names.add(name)
        return name

    def _color(self, number: int, color: MetalColorAttachment | None) -> Node:
        if color is None:
            return scalar(None, self.each.head)
        slot = f"colorAttachments[{number}]"
        return self._add(
            color,
            slot,
            renamed(color, {"texture": "image"}) + _operations(color, ""),
            {"color": color},
        )

    def _add(
        self, of: MetalAttachment, slot: str, items: Items, origin: Mapping[str, Record]
    ) -> Node:
        name = self._name(of.texture, slot)
        self.attachments.append((name, of.head, mapping(items, of.node.span)))
        self.origins.append((of.path, origin))
        return scalar(name, of.place("texture"))

    def _depth_stencil(self) -> Items:
        depth, stencil = self.each.depthAttachment, self.each.stencilAttachment
        first = depth if depth is not None else stencil
        if first is None:
            return []
        items, origin = renamed(first, {"texture": "image"}), dict[str, Record]()
        together = (
            depth is None
            or stencil is None
            or (depth.texture is not None and depth.texture == stencil.texture)
        )
        if depth is not None:
            items += _operations(depth, "")
            origin["depth"] = depth
        if stencil is not None and together:
            items += _operations(stencil, "stencil")
            origin["stencil"] = stencil
        slot = "depthAttachment" if depth is not None else "stencilAttachment"
        reference = self._add(first, slot, items, origin)
        references: Items = [("depthStencilAttachment", key_of(self.each, slot), reference)]
        if stencil is not None and not together:
            name = self._add(
                stencil,
                "stencilAttachment",
                renamed(stencil, {"texture": "image"}) + _operations(stencil, "stencil"),
                {"stencil": stencil},
            )
            target = (
                self._target(stencil, "stencilAttachment", ("stencil",)).text
                if resolves(stencil)
                else None
            )
            self.apart = StencilApart(name.text, target, stencil)
        resolve_items = self._resolved(depth, stencil if together else None)
        return references + resolve_items

    def _resolved(
        self, depth: MetalDepthAttachment | None, stencil: MetalStencilAttachment | None
    ) -> Items:
        """The depth/stencil resolve: of one aspect, or of both to the same texture."""
        of_depth, of_stencil = (
            depth is not None and resolves(depth),
            stencil is not None and resolves(stencil),
        )
        if not of_depth and not of_stencil:
            return []
        first = depth if of_depth else stencil
        assert first is not None
        both = (
            of_depth
            and of_stencil
            and depth is not None
            and stencil is not None
            and depth.resolveTexture == stencil.resolveTexture
        )
        aspects = ("depth", "stencil") if both else ("depth",) if of_depth else ("stencil",)
        target = self._target(
            first, "depthAttachment" if of_depth else "stencilAttachment", aspects
        )
        key = key_of(first, "resolveTexture")
        items: Items = [("attachment", key, target)]
        place = first.place("resolveTexture")
        filters = depth.depthResolveFilter if depth is not None and of_depth else None
        mode = _DEPTH_FILTERS[filters] if of_depth else "NONE"
        items.append(
            (
                "depthResolveMode",
                key,
                scalar(mode, first.place("depthResolveFilter") if filters is not None else place),
            )
        )
        if not of_stencil or stencil is None:
            items.append(("stencilResolveMode", key, scalar("NONE", place)))
        elif (stencil.stencilResolveFilter != "depthResolvedSample" or mode == "SAMPLE_ZERO") and (
            both or not of_depth
        ):
            at = (
                stencil.place("stencilResolveFilter")
                if stencil.states("stencilResolveFilter")
                else stencil.place("resolveTexture")
            )
            items.append(("stencilResolveMode", key, scalar("SAMPLE_ZERO", at)))
        return [("depthStencilResolve", key, mapping(items, first.node.span))]

    def _target(self, of: MetalAttachment, slot: str, aspects: Sequence[str]) -> Node:
        """Adds an attachment's resolve texture as an attachment."""
        name = self._name(of.resolveTexture, f"{slot}.resolveTexture")
        key, at = key_of(of, "resolveTexture"), of.place("resolveTexture")
        items: Items = [("image", key, scalar(of.resolveTexture, at))]
        for aspect in aspects:
            load, store = (
                ("stencilLoadOp", "stencilStoreOp")
                if aspect == "stencil"
                else ("loadOp", "storeOp")
            )
            items += [(load, key, scalar("DONT_CARE", at)), (store, key, scalar("STORE", at))]
        self.attachments.append((name, key, mapping(items, at)))
        self.origins.append((f"{of.path}.resolveTexture", {}))
        return scalar(name, at)


def by_index(stated: Mapping[str, Kind | None] | Sequence[Kind | None]) -> list[Kind | None]:
    """Color attachments in index order; None for an unused index."""
    if not isinstance(stated, Mapping):
        return list(stated)
    attachments: list[Kind | None] = [None] * (
        max((int(index) for index in stated), default=-1) + 1
    )
    for index, attachment in stated.items():
        attachments[int(index)] = attachment
    return attachments


def first_stated(record: Record, members: Sequence[str]) -> str | None:
    """The first stated member among several names of the same property."""
    return next((member for member in members if getattr(record, member) is not None), None)


def key_of(record: Record, member: str) -> Span:
    """The place of a member's key; the record's head if it is not stated."""
    return record.spelled[member][0].span if member in record.spelled else record.head


def placed(record: Record, member: str, value: str | int | bool) -> tuple[Span, Node]:
    """Another value, at a member's place."""
    return key_of(record, member), scalar(value, record.place(member))


def renamed(record: Record, names: Mapping[str, str]) -> Items:
    """The stated members of a record under other names."""
    values = ((name, member, getattr(record, member)) for member, name in names.items())
    return [
        (name, *placed(record, member, value))
        for name, member, value in values
        if value is not None
    ]


def attachments_of(render_pass: MetalRenderPass) -> Iterable[tuple[str, MetalAttachment]]:
    """The attachments of a pass, each with its aspect."""
    for color in by_index(render_pass.colorAttachments):
        if color is not None:
            yield "color", color
    if render_pass.depthAttachment is not None:
        yield "depth", render_pass.depthAttachment
    if render_pass.stencilAttachment is not None:
        yield "stencil", render_pass.stencilAttachment


def resolves(attachment: MetalAttachment) -> bool:
    """Whether a pass resolves an attachment: its store action resolves, and it has a resolve
    texture.
    """
    return attachment.storeAction in MULTISAMPLE_RESOLVES and attachment.resolveTexture is not None


def _operations(attachment: MetalAttachment, aspect: str) -> Items:
    """The load and store operations for an attachment's actions. `unknown` is a placeholder that
    the program replaces, so it is omitted.
    """
    load, store = ("stencilLoadOp", "stencilStoreOp") if aspect else ("loadOp", "storeOp")
    items: Items = []
    if attachment.loadAction is not None:
        items.append((load, *placed(attachment, "loadAction", _LOAD[attachment.loadAction])))
    if attachment.storeAction in _STORE:
        items.append((store, *placed(attachment, "storeAction", _STORE[attachment.storeAction])))
    return items

"""Converts dynamic renderings and resolve commands to nodes of a description."""

from __future__ import annotations

from typing import Any

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.values import UNKNOWN, ApiObject, Struct, Symbol, Value, sole_value

from .members import Item, Members, complete, head_of


class Commands(Members):
    """Converts dynamic renderings and resolve commands to nodes."""

    def rendering(self, obj: ApiObject, attached: dict[int, ApiObject]) -> Node | None:
        """Returns a dynamic rendering, or None if its attachments are unknown."""
        info = obj.info
        colors = self.structs(info, "colorAttachments")
        if colors is None or not (info.zeroed or "colorAttachments" in info.fields):
            return None
        nodes = complete(self.rendered(color, attached) for color in colors)
        if nodes is None:
            return None
        head = head_of(obj.at)
        items: list[Item] = []
        if nodes:
            items.append(("colorAttachments", head, sequence(nodes, head)))
        for name in ("depthAttachment", "stencilAttachment"):
            if self.get(info, name)[0] in (None, 0):
                continue
            struct = self.struct(info, name)
            node = self.rendered(struct, attached)
            if struct is None or node is None:
                return None
            items.append((name, head_of(struct.at), node))
        if not items:
            return None
        return mapping([("beginRendering", head, mapping(items, head))], head)

    def rendered(self, struct: Struct | None, attached: dict[int, ApiObject]) -> Node | None:
        """Returns an attachment of a rendering, or None if it is unknown whether it is resolved."""
        if struct is None:
            return None
        head = head_of(struct.at)
        view, at = self.get(struct, "imageView")
        if view in (None, 0):
            return scalar(None, head)
        items: list[Item] = [("image", at, self.image_name(view, at, attached))]
        mode, place = self.get(struct, "resolveMode")
        if mode is UNKNOWN:
            return None
        target, target_at = self.get(struct, "resolveImageView")
        if target is not None and target != 0:
            items.append(("resolveImage", target_at, self.image_name(target, target_at, attached)))
        node = self.node("resolveMode", mode or 0, place)
        if node is None:
            return None
        items.append(("resolveMode", place, node))
        for member in ("loadOp", "storeOp"):
            items += self.item(struct, member)
        return mapping(items, head)

    def image_name(self, view: Any, at: Span, attached: dict[int, ApiObject]) -> Node:
        """Returns the name of the image of a view; an unknown image gets a name of its own."""
        image = self.image_in(view)
        if image is None:
            return scalar(self.external_image(view, at), at)
        attached[id(image)] = image
        return scalar(self.object_name(image, "image"), at)

    def external_image(self, value: Any, at: Span) -> str:
        """Returns the name of an image that the file does not create."""
        value = self.dereference(value)
        key = value.key if isinstance(value, Symbol) else f"image at {at.start}"
        if isinstance(value, ApiObject):
            key = f"image of {id(value)}"
        if key not in self.external_images:
            label = value.name if isinstance(value, (Symbol, ApiObject)) else ""
            name = self.unique(label.rpartition("::")[2].strip("*&") or "image")
            self.external_images[key] = (name, at, mapping((), at))
        return self.external_images[key][0]

    def resolve(self, at: Span, ends: tuple[Value, Value], attached: dict[int, ApiObject]) -> Node | None:
        """Returns a vkCmdResolveImage of an image that the file creates, or None."""
        head = head_of(at)
        items: list[Item] = []
        for name, value in zip(("srcImage", "dstImage"), ends, strict=True):
            known = self.dereference(sole_value(self.settle(value)))
            image = self.first_duplicate(known) if isinstance(known, ApiObject) and known.kind == "image" else None
            if image is None and name == "srcImage":
                return None
            if image is not None:
                attached[id(image)] = image
            text = self.object_name(image, "image") if image is not None else self.external_image(known, at)
            items.append((name, head, scalar(text, head)))
        return mapping([("resolveImage", head, mapping(items, head))], head)

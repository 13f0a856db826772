"""Converts dynamic renderings and resolve commands to nodes of a description."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.values import UNKNOWN, ApiObject, Struct, Symbol, Value, sole_value

from .enumerants import FLAGS, named
from .members import Item, Members, flags_of, head_of

RATES = {
    "RenderingFragmentDensityMapAttachmentInfo": "fragmentDensityMapAttachment",
    "RenderingFragmentShadingRateAttachmentInfo": "fragmentShadingRateAttachment",
}
"""The members of a description for structures that are chained to a VkRenderingInfo."""


class Commands(Members):
    """Converts dynamic renderings and resolve commands to nodes."""

    def rendering(self, obj: ApiObject, attached: dict[int, ApiObject]) -> Node | None:
        """Returns a dynamic rendering, or None if nothing is known of its attachments. Unknown
        color attachments keep their index.
        """
        info = obj.info
        colors = self.elements(info, "colorAttachments")[0]
        depth = [
            (name, self.struct(info, name)) for name in ("depthAttachment", "stencilAttachment")
        ]
        structs = [*colors, *(struct for _, struct in depth)]
        # All images of a rendering have the same count
        # (VUID-VkRenderingInfo-multisampledRenderToSingleSampled-06857).
        multisampled = any(
            struct is not None and self.is_multisampled_attachment(struct) for struct in structs
        )
        head = head_of(obj.at)
        items: list[Item] = []
        flags, flags_at = self.get(info, "flags")
        stated = flags_of(
            FLAGS["renderingFlags"], named("renderingFlags", flags or 0, flags_at), flags_at
        )
        if stated is not None and stated.value:
            items.append(("flags", flags_at, stated))
        if colors:
            nodes = [
                self.rendered(color, obj, multisampled, attached, stated is not None)
                for color in colors
            ]
            items.append(("colorAttachments", head, sequence(nodes, head)))
        for name, struct in depth:
            if struct is not None and self.get(info, name)[0] not in (None, 0):
                items.append(
                    (
                        name,
                        head_of(struct.at),
                        self.rendered(struct, obj, multisampled, attached, stated is not None),
                    )
                )
        if not any(
            node.kind != "scalar"
            for _, _, item in items
            for node in (item.value if item.kind == "sequence" else (item,))
        ):
            return None
        return mapping(
            [
                (
                    "beginRendering",
                    head,
                    mapping([*items, *self.chained_to_rendering(info, obj, attached)], head),
                )
            ],
            head,
        )

    def chained_to_rendering(
        self, info: Struct, obj: ApiObject, attached: dict[int, ApiObject]
    ) -> Iterator[Item]:
        """Yields what the pNext chain of a rendering states: the images that say how densely it
        shades.
        """
        structs, known = self.chain(info)
        for struct in structs:
            name = RATES.get(struct.kind)
            view, at = self.get(struct, "imageView")
            if name is None:
                known = False
            elif view is not None and not (view == 0 and type(view) is int):
                yield (
                    name,
                    head_of(struct.at),
                    mapping(
                        [("image", at, self.image_name(view, at, obj, attached))],
                        head_of(struct.at),
                    ),
                )
        if not known:
            yield self.unread(info)

    def is_multisampled_attachment(self, struct: Struct) -> bool:
        """Returns whether an attachment certainly has several samples: its image has, or it is
        resolved.
        """
        image = self.image_of(struct, "imageView")
        count = self.samples(image.info)[0] if image is not None else None
        return count > 1 if count is not None else self.resolves_attachment(struct)

    def rendered(
        self,
        struct: Struct | None,
        obj: ApiObject,
        multisampled: bool,
        attached: dict[int, ApiObject],
        performed: bool,
    ) -> Node:
        """Returns an attachment of a rendering, null if there is none or nothing is known of it.

        `performed`: whether it loads and stores is known. Where it may be one that resumes or
        suspends, its operations are left out. A store operation that only a resolve justifies is
        left out where it is not known whether there is a resolve.
        """
        head = head_of(struct.at if struct is not None else obj.at)
        view, at = self.get(struct, "imageView") if struct is not None else (None, head)
        if struct is None or view is None or (view == 0 and type(view) is int):
            return scalar(None, head)
        mode, place = self.get(struct, "resolveMode")
        count_at = place if self.resolves_attachment(struct) else head
        items: list[Item] = [
            (
                "image",
                at,
                self.image_name(view, at, obj, attached, count_at if multisampled else None),
            )
        ]
        target, target_at = self.get(struct, "resolveImageView")
        if target is not None and target != 0:
            items.append(
                ("resolveImage", target_at, self.image_name(target, target_at, obj, attached))
            )
        node = self.node("resolveMode", mode or 0, place) if mode is not UNKNOWN else None
        if node is not None:
            items.append(("resolveMode", place, node))
        if not performed:
            return mapping(items, head)
        items += self.item(struct, "loadOp")
        unresolved = node is None and target is not None
        items += [
            item
            for item in self.item(struct, "storeOp")
            if not unresolved or item[2].value == "STORE"
        ]
        return mapping(items, head)

    def image_name(
        self,
        view: Any,
        at: Span,
        obj: ApiObject,
        attached: dict[int, ApiObject],
        count_at: Span | None = None,
    ) -> Node:
        """Returns the name of the image of a view; an unknown image gets a name of its own, and a
        count if it is multisampled.
        """
        image = self.image_in(view)
        if image is None:
            return scalar(self.external_image(view, at, obj.at, count_at), at)
        attached[id(image)] = image
        return scalar(self.object_name(image, "image"), at)

    def external_image(self, value: Any, at: Span, use: Span, count_at: Span | None = None) -> str:
        """Returns the name of an image that the program does not create.

        What is an expression of parameters is another image for each use and role; a member is the
        same image wherever it is used.
        """
        value = self.dereference(value)
        key = value.key if isinstance(value, Symbol) else f"image at {at.start}"
        if isinstance(value, ApiObject):
            key = f"image of {id(value)}"
        elif not isinstance(value, Symbol) or "(" in key:
            key += f" at {use.start}"
        key += "" if count_at is None else " multisampled"
        if key not in self.external_images:
            label = value.name if isinstance(value, (Symbol, ApiObject)) else ""
            name = self.unique(label.rpartition("::")[2].strip("*&") or "image")
            items: list[Item] = []
            if count_at is not None:
                items.append(
                    (
                        "samples",
                        count_at,
                        scalar(
                            self.assumed_count(key, f"the sample count of {name}", count_at),
                            count_at,
                        ),
                    )
                )
            self.external_images[key] = (name, at, mapping(items, at))
        return self.external_images[key][0]

    def resolve(
        self, at: Span, parts: tuple[Value, Value, Value], attached: dict[int, ApiObject]
    ) -> Node | None:
        """Returns a vkCmdResolveImage of an image that the file creates, or None; also None if its
        pNext chain is unknown.
        """
        head = head_of(at)
        items: list[Item] = []
        modes: list[Item] = []
        chained = self.dereference(sole_value(self.settle(parts[2]))) if parts[2] else 0
        if isinstance(chained, Struct) and chained.kind == "ResolveImageModeInfo":
            modes = [*self.item(chained, "resolveMode"), *self.item(chained, "stencilResolveMode")]
        if not modes and chained is not None and chained != 0:
            return None
        for name, value in zip(("srcImage", "dstImage"), parts[:2], strict=True):
            known = self.dereference(sole_value(self.settle(value)))
            image = (
                self.first_duplicate(known)
                if isinstance(known, ApiObject) and known.kind == "image"
                else None
            )
            if image is None and name == "srcImage":
                return None
            if image is not None:
                attached[id(image)] = image
            text = (
                self.object_name(image, "image")
                if image is not None
                else self.external_image(known, at, at)
            )
            items.append((name, head, scalar(text, head)))
        return mapping([("resolveImage", head, mapping([*items, *modes], head))], head)

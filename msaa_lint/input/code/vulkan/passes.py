"""Converts render passes to nodes of a description."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.values import UNKNOWN, ApiObject, Array, Struct, sole_value

from .members import Item, Members, complete, head_of


class Passes(Members):
    """Converts render passes to nodes."""

    def bind(self, passes: Sequence[ApiObject]) -> None:
        """Assigns the images of framebuffers to the attachments of render passes."""
        for obj in self.current_objects:
            if obj.kind != "framebuffer":
                continue
            views = self.dereference(self.get(obj.info, "attachments")[0])
            if isinstance(views, ApiObject):
                images = [self.image_in(views)]
            elif isinstance(views, Array) and views.complete:
                images = [self.image_in(sole_value(self.settle(cell.writes))) for cell in views.items]
            else:
                continue
            target = self.dereference(self.get(obj.info, "renderPass")[0])
            if not isinstance(target, ApiObject):
                render_passes = [p for p in passes if len(self.structs(p.info, "attachments") or ()) == len(images)]
                target = render_passes[0] if len(render_passes) == 1 and len(passes) == 1 else None
            if target is None:
                continue
            before = self.framebuffer_images.get(id(target))
            if before is None:
                self.framebuffer_images[id(target)] = images
            else:
                self.framebuffer_images[id(target)] = [a if a is b else None for a, b in zip(before, images, strict=False)]

    def attachment(
        self, struct: Struct | None, image: ApiObject | None, attached: dict[int, ApiObject], head: Span, resolved: bool
    ) -> Node:
        items: list[Item] = []
        if struct is None:
            return mapping(items, head)
        count, at = self.samples(struct)
        of_image = self.samples(image.info)[0] if image is not None else None
        if image is not None and (count is None or of_image is None or count == of_image):
            attached[id(image)] = image
            items.append(("image", head, scalar(self.object_name(image, "image"), head)))
        for name in ("format", "loadOp", "storeOp", "stencilLoadOp", "stencilStoreOp", "initialLayout", "finalLayout"):
            items += self.item(struct, name)
        items += self.assumed_store(struct, resolved)
        if count is not None:
            items.insert(min(1, len(items)), ("samples", at, scalar(count, at)))
        return mapping(items, head)

    def render_pass(self, obj: ApiObject, attached: dict[int, ApiObject]) -> Item | None:
        info = obj.info
        structs = self.structs(info, "attachments")
        if not structs:
            return None
        images = [*self.framebuffer_images.get(id(obj), ()), *[None] * len(structs)][: len(structs)]
        names: list[str] = []
        array = self.dereference(self.get(info, "attachments")[0])
        list_name = array.name if isinstance(array, Array) else ""
        for n, struct in enumerate(structs):
            name = struct.name if struct is not None and struct.name else f"{list_name}[{n}]" if list_name else f"attachment {n}"
            names.append(name if name not in names else f"{name} ({n})")
        subpasses = [self.subpass(struct, names) for struct in self.structs(info, "subpasses") or ()]
        sources = _resolved([node for node in subpasses if node is not None])
        nodes: list[Item] = []
        for name, struct, image in zip(names, structs, images, strict=True):
            at = head_of(self.place_of(struct, obj.at))
            nodes.append((name, at, self.attachment(struct, image, attached, at, name in sources)))
        if type(self.known_value(info, "attachmentCount")) is not int:
            # The count is unknown: trailing attachments that nothing references may not exist.
            referred = {reference.text for node in subpasses if node is not None for reference in _leaves(node)}
            while nodes and nodes[-1][0] not in referred:
                nodes.pop()
            if not nodes:
                return None
        head = head_of(obj.at)
        items: list[Item] = [("attachments", head, mapping(nodes, head))]
        if known := complete(subpasses):
            items.append(("subpasses", head, sequence(known, head)))
        dependencies = self.structs(info, "dependencies")
        if dependencies and not self.barriers and self.has_single_images(structs, images):
            nodes_of_dependencies = complete(map(self.dependency, dependencies))
            if nodes_of_dependencies is not None:
                items.append(("dependencies", head, sequence(nodes_of_dependencies, head)))
        return self.object_name(obj, "renderPass"), head, mapping(items, head)

    def has_single_images(self, structs: Sequence[Struct | None], images: Sequence[ApiObject | None]) -> bool:
        """Returns whether each multisampled image of a pass is known and single.

        With one image per frame in flight, no frame waits for another.
        """
        return not any(
            struct is None or ((self.samples(struct)[0] or 2) > 1 and (image is None or "[" in image.name))
            for struct, image in zip(structs, images, strict=True)
        )

    def place_of(self, struct: Struct | None, otherwise: Span) -> Span:
        """Returns where a structure starts: its declaration, or the first write to it."""
        if struct is None:
            return otherwise
        if struct.name and not self.fragments and struct.zeroed:
            return struct.at
        return min((cell.writes[0].at for cell in struct.fields.values() if cell.writes), default=struct.at)

    def assumed_store(self, struct: Struct, resolved: bool) -> Iterator[Item]:
        """Yields an assumed store operation on pages that resolve a multisampled attachment without stating one:

        STORE, which is zero and which earlier steps of the page needed to present the attachment.
        """
        if self.fragments and resolved and "storeOp" not in struct.fields and not struct.zeroed and "samples" in struct.fields:
            at = struct.fields["samples"].writes[0].at
            self.assumed.setdefault(f"{struct.name}.storeOp", (f"{struct.name}.storeOp", at, "STORE"))
            yield "storeOp", at, scalar("STORE", at)

    def subpass(self, struct: Struct | None, names: Sequence[str]) -> Node | None:
        """Returns a subpass, or None if any of its lists is unknown."""
        if struct is None:
            return None
        head = head_of(struct.at)
        items: list[Item] = []
        for name in ("colorAttachments", "resolveAttachments", "inputAttachments"):
            if not struct.zeroed and name not in struct.fields and not self.fragments:
                return None
            references = self.references(struct, name, names)
            if references is None:
                return None
            at = self.get(struct, name)[1]
            if references:
                items.append((name, at, sequence(references, head_of(at))))
        if struct.zeroed or "depthStencilAttachment" in struct.fields or self.fragments:
            value, at = self.get(struct, "depthStencilAttachment")
            if value is not None and not (value is UNKNOWN and "depthStencilAttachment" not in struct.fields):
                node = self.reference(self.struct(struct, "depthStencilAttachment"), names)
                if node is None:
                    return None
                items.append(("depthStencilAttachment", at, node))
        else:
            return None
        chained = self.dereference(self.get(struct, "next")[0]) if struct.zeroed or "next" in struct.fields else None
        if chained is not None and not isinstance(chained, Struct):
            return None
        if isinstance(chained, Struct) and chained.kind == "SubpassDescriptionDepthStencilResolve":
            node = self.depth_resolve(chained, names)
            if node is None:
                return None
            items.append(("depthStencilResolve", head_of(chained.at), node))
        elif isinstance(chained, Struct) and chained.kind == "MultisampledRenderToSingleSampledInfo":
            count, place = self.samples(chained, "rasterizationSamples")
            inner = [*self.item(chained, "multisampledRenderToSingleSampledEnable")]
            if count is not None:
                inner.append(("rasterizationSamples", place, scalar(count, place)))
            items.append(("multisampledRenderToSingleSampled", head_of(chained.at), mapping(inner, head_of(chained.at))))
        elif chained is not None:
            return None
        return mapping(items, head)

    def depth_resolve(self, struct: Struct, names: Sequence[str]) -> Node | None:
        items: list[Item] = []
        target = self.dereference(self.get(struct, "depthStencilResolveAttachment")[0])
        if isinstance(target, Struct):
            node = self.reference(target, names)
            if node is None:
                return None
            items.append(("attachment", head_of(target.at), node))
        elif target is not None:
            return None
        for name in ("depthResolveMode", "stencilResolveMode"):
            items += self.item(struct, name)
        return mapping(items, head_of(struct.at))

    def references(self, struct: Struct, name: str, names: Sequence[str]) -> list[Node] | None:
        if name not in struct.fields:
            return []
        structs = self.structs(struct, name)
        return complete(self.reference(item, names) for item in structs) if structs is not None else None

    def reference(self, struct: Struct | None, names: Sequence[str]) -> Node | None:
        if struct is None:
            return None
        index, at = self.get(struct, "attachment")
        if index is UNKNOWN and self.fragments:
            # Pages that modify a program do not repeat that `colorAttachmentRef` refers to `colorAttachment`.
            indices = [n for n, name in enumerate(names) if struct.name and struct.name.startswith(name) and struct.name != name]
            index = indices[-1] if len(indices) == 1 else UNKNOWN
        if index is None:
            index = 0
        if index == 2**32 - 1 or index == "VK_ATTACHMENT_UNUSED":
            return scalar(None, at)
        return scalar(names[index], at) if type(index) is int and 0 <= index < len(names) else None

    def dependency(self, struct: Struct | None) -> Node | None:
        if struct is None:
            return None
        items: list[Item] = []
        for name in ("srcSubpass", "dstSubpass"):
            value, at = self.get(struct, name)
            if value in ("VK_SUBPASS_EXTERNAL", 2**32 - 1):
                items.append((name, at, scalar("EXTERNAL", at)))
            elif value is None or type(value) is int:
                items.append((name, at, scalar(value or 0, at)))
            else:
                return None
        for name in ("srcStageMask", "dstStageMask", "srcAccessMask", "dstAccessMask"):
            items += self.item(struct, name)
        return mapping(items, head_of(struct.at)) if len(items) == 6 else None


def _leaves(node: Node) -> Iterator[Node]:
    """Yields the scalars of a subpass."""
    stack = [node]
    while stack:
        inner = stack.pop()
        if inner.kind == "scalar":
            yield inner
        else:
            stack += inner.value.values() if inner.kind == "mapping" else inner.value


def _resolved(subpasses: Sequence[Node]) -> set[str]:
    """Returns the names of the color attachments that subpasses resolve."""
    names = set()
    for subpass in subpasses:
        colors, targets = (subpass.value[key].value if key in subpass.value else [] for key in ("colorAttachments", "resolveAttachments"))
        names |= {
            color.text for color, target in zip(colors, targets, strict=False) if color.value is not None and target.value is not None
        }
    return names

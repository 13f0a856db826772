"""Converts render passes to nodes of a description."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span

from .members import Item, Members, head_of
from .values import UNKNOWN, Array, Struct, VulkanObject, sole_value

EMPTY = mapping((), Span(0, 0))


class Passes(Members):
    """Converts render passes to nodes."""

    def bind(self, passes: Sequence[VulkanObject]) -> None:
        """Assigns the images of framebuffers to the attachments of render passes."""
        for obj in self.current_objects:
            if obj.kind != "framebuffer":
                continue
            views = self.dereference(self.get(obj.info, "attachments")[0])
            if isinstance(views, VulkanObject):
                images = [self.image_in(views)]
            elif isinstance(views, Array) and views.complete:
                images = [self.image_in(sole_value(self.settle(cell.writes))) for cell in views.items]
            else:
                continue
            target = self.dereference(self.get(obj.info, "renderPass")[0])
            if not isinstance(target, VulkanObject):
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
        self, struct: Struct | None, image: VulkanObject | None, attached: dict[int, VulkanObject], head: Span, resolved: bool
    ) -> Node:
        if struct is None:
            return mapping((), head)
        items: list[Item] = []
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

    def render_pass(self, obj: VulkanObject, attached: dict[int, VulkanObject]) -> Item | None:
        info = obj.info
        structs = self.structs(info, "attachments")
        if structs is None or not structs:
            return None
        images = self.framebuffer_images.get(id(obj), [])
        names: list[str] = []
        nodes: list[Item] = []
        array = self.dereference(self.get(info, "attachments")[0])
        list_node = array.name if isinstance(array, Array) else ""
        for n, struct in enumerate(structs):
            name = struct.name if struct is not None and struct.name else f"{list_node}[{n}]" if list_node else f"attachment {n}"
            name = name if name not in names else f"{name} ({n})"
            names.append(name)
            at = self.place_of(struct, obj.at)
            nodes.append((name, head_of(at), EMPTY))
        head = head_of(obj.at)
        subpasses = self.structs(info, "subpasses")
        written = [self.subpass(s, names) for s in subpasses] if subpasses is not None else []
        sources = _resolved([node for node in written if node is not None])
        for n, struct in enumerate(structs):
            image = images[n] if n < len(images) else None
            nodes[n] = (*nodes[n][:2], self.attachment(struct, image, attached, nodes[n][1], names[n] in sources))
        if type(self.known_value(info, "attachmentCount")) is not int:
            # The count is unknown: trailing attachments that nothing references may not exist.
            referred = {reference.text for node in written if node is not None for reference in _leaves(node)}
            while nodes and nodes[-1][0] not in referred:
                nodes.pop()
            if not nodes:
                return None
        items: list[Item] = [("attachments", head, mapping(nodes, head))]
        if written and all(node is not None for node in written):
            items.append(("subpasses", head, sequence([node for node in written if node is not None], head)))
        dependencies = self.structs(info, "dependencies")
        if dependencies and not self.barriers and self.has_single_images(structs, images):
            made_nodes = [self.dependency(d) for d in dependencies]
            if all(node is not None for node in made_nodes):
                items.append(("dependencies", head, sequence([node for node in made_nodes if node is not None], head)))
        return self.object_name(obj, "renderPass"), head, mapping(items, head)

    def has_single_images(self, structs: Sequence[Struct | None], images: Sequence[VulkanObject | None]) -> bool:
        """Returns whether each multisampled image of a pass is known and single.

        With one image per frame in flight, no frame waits for another.
        """
        for n, struct in enumerate(structs):
            image = images[n] if n < len(images) else None
            if struct is None or ((self.samples(struct)[0] or 2) > 1 and (image is None or "[" in image.name)):
                return False
        return True

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
                reference = self.struct(struct, "depthStencilAttachment")
                node = self.reference(reference, names) if reference is not None else None
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
        if structs is None:
            return None
        nodes = [self.reference(item, names) if item is not None else None for item in structs]
        return [node for node in nodes if node is not None] if all(node is not None for node in nodes) else None

    def reference(self, struct: Struct, names: Sequence[str]) -> Node | None:
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
            if value is None:
                value = 0
            if value in ("VK_SUBPASS_EXTERNAL", 2**32 - 1):
                items.append((name, at, scalar("EXTERNAL", at)))
            elif type(value) is int:
                items.append((name, at, scalar(value, at)))
            else:
                return None
        for name in ("srcStageMask", "dstStageMask", "srcAccessMask", "dstAccessMask"):
            items += self.item(struct, name)
        if len(items) < 6:
            return None
        return mapping(items, head_of(struct.at))


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

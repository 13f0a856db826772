"""Converts render passes to nodes of a description."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.values import ApiObject, Array, Struct, sole_value

from .members import Item, complete, head_of
from .subpasses import Subpasses

STORES = {"storeOp": "loadOp", "stencilStoreOp": "stencilLoadOp"}
"""The load operation beside each store operation."""


class Passes(Subpasses):
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
                # Null is what a view is after it is destroyed
                # (VUID-VkFramebufferCreateInfo-flags-02778).
                images = [
                    self.image_in(
                        sole_value(
                            tuple(
                                write
                                for write in self.settle(cell.writes)
                                if write.value is not None
                            )
                        )
                    )
                    for cell in views.items
                ]
            else:
                continue
            targets = self.targets(obj.info)
            if not targets:
                render_passes = [
                    p
                    for p in passes
                    if len(self.structs(p.info, "attachments") or ()) == len(images)
                ]
                targets = render_passes if len(render_passes) == 1 and len(passes) == 1 else []
            for target in targets:
                self.framebuffer_images.setdefault(id(target), []).append(images)

    def bound_images(self, render_pass: ApiObject) -> list[ApiObject | None]:
        """Returns the images of a render pass: the only one that its framebuffers are known to have
        for an attachment.
        """
        columns = zip(*self.framebuffer_images.get(id(render_pass), ()), strict=False)
        known = [
            list({id(image): image for image in column if image is not None}.values())
            for column in columns
        ]
        return [images[0] if len(images) == 1 else None for images in known]

    def targets(self, info: Struct) -> list[ApiObject]:
        """Returns the render passes that a framebuffer is created for: where several are assigned
        to a member, each of them in turn.
        """
        cell = info.fields.get("renderPass")
        objects = (
            [self.wrapped_object(write.value, "renderPass") for write in self.settle(cell.writes)]
            if cell is not None
            else []
        )
        return list({id(obj): obj for obj in objects if obj is not None}.values())

    def attachment(
        self,
        struct: Struct | None,
        image: ApiObject | None,
        attached: dict[int, ApiObject],
        head: Span,
        resolved: bool,
    ) -> Node:
        items: list[Item] = []
        if struct is None:
            return mapping(items, head)
        count, at = self.samples(struct)
        of_image = self.samples(image.info)[0] if image is not None else None
        if image is not None and (count is None or of_image is None or count == of_image):
            attached[id(image)] = image
            items.append(("image", head, scalar(self.object_name(image, "image"), head)))
        for name in (
            "format",
            "loadOp",
            "storeOp",
            "stencilLoadOp",
            "stencilStoreOp",
            "initialLayout",
            "finalLayout",
        ):
            if not self.is_for_another_pass(struct, name, image):
                items += self.item(struct, name)
        items += self.assumed_store(struct, resolved)
        if count is not None:
            items.insert(min(1, len(items)), ("samples", at, scalar(count, at)))
        return mapping(items, head)

    def is_for_another_pass(self, struct: Struct, name: str, image: ApiObject | None) -> bool:
        """Returns whether code that creates several passes writes a store operation for one of
        them, which another may load.
        """
        place = self.get(struct, name)[1] if name in STORES and name in struct.fields else None
        if place is None:
            return False
        loads = {
            load
            for load, other in self.loads_of_stores.get(place, ())
            if other is None or image is None or other is image
        }
        return len(loads) > 1 and True in loads

    @cached_property
    def loads_of_stores(self) -> dict[Span, list[tuple[bool, ApiObject | None]]]:
        """The attachments that each store operation in the code is written for: whether they load,
        and their images.
        """
        found: dict[Span, list[tuple[bool, ApiObject | None]]] = {}
        for obj in self.current_objects:
            structs, ordered = (
                self.elements(obj.info, "attachments") if obj.kind == "renderPass" else ((), False)
            )
            images = [*(self.bound_images(obj) if ordered else ()), *[None] * len(structs)]
            for struct, image in zip(structs, images, strict=False):
                for store, load in STORES.items() if struct is not None else ():
                    if struct is not None and store in struct.fields:
                        does_load = str(self.get(struct, load)[0]).endswith("LOAD")
                        found.setdefault(self.get(struct, store)[1], []).append((does_load, image))
        return found

    def render_pass(self, obj: ApiObject, attached: dict[int, ApiObject]) -> Item | None:
        info = obj.info
        structs, ordered = self.elements(info, "attachments")
        if not structs:
            return None
        bound = self.bound_images(obj) if ordered else ()
        images = [*bound, *[None] * len(structs)][: len(structs)]
        names = self.attachment_names(info, structs)
        head = head_of(obj.at)
        described, is_complete = self.elements(info, "subpasses") if ordered else ([], True)
        subpasses = [self.subpass(struct, names, head) for struct in described]
        sources = _resolved([subpass.node for subpass in subpasses])
        referred = {
            reference.text for subpass in subpasses for reference in _leaves(subpass.node)
        } & set(names)
        chained, chain_known = self.chained_to_pass(info, names)
        referred |= {reference.text for _, _, node in chained for reference in _leaves(node)} & set(
            names
        )
        is_complete = is_complete and chain_known and all(subpass.complete for subpass in subpasses)
        nodes: list[Item] = []
        for name, struct, image in zip(names, structs, images, strict=True):
            at = head_of(self.place_of(struct, obj.at))
            node = self.attachment(struct, image, attached, at, name in sources)
            nodes.append(
                (
                    name,
                    at,
                    node
                    if is_complete or not referred
                    else _certain(node, name in referred, name in sources),
                )
            )
        if referred and type(self.known_value(info, "attachmentCount")) is not int:
            # The count is unknown: trailing attachments that nothing references may not exist.
            while nodes[-1][0] not in referred:
                nodes.pop()
        items: list[Item] = [("attachments", head, mapping(nodes, head))]
        items += chained
        if referred or (subpasses and is_complete):
            items.append(
                ("subpasses", head, sequence([subpass.node for subpass in subpasses], head))
            )
        dependencies = self.structs(info, "dependencies")
        if dependencies and not self.barriers and self.has_single_images(structs, images):
            nodes_of_dependencies = complete(map(self.dependency, dependencies))
            if nodes_of_dependencies is not None:
                items.append(("dependencies", head, sequence(nodes_of_dependencies, head)))
        return self.object_name(obj, "renderPass"), head, mapping(items, head)

    def chained_to_pass(self, info: Struct, names: Sequence[str]) -> tuple[list[Item], bool]:
        """Returns what the pNext chain of a render pass states, and whether all of the chain is
        known.
        """
        items: list[Item] = []
        structs, known = self.chain(info)
        for struct in structs:
            node = None
            if struct.kind == "RenderPassFragmentDensityMapCreateInfo":
                node = self.chained_reference(struct, "fragmentDensityMapAttachment", names)
            if node is not None:
                items.append(("fragmentDensityMapAttachment", head_of(struct.at), node))
            known = known and node is not None
        return (items, True) if known else ([*items, self.unread(info)], False)

    def attachment_names(self, info: Struct, structs: Sequence[Struct | None]) -> list[str]:
        """Returns unique names of attachments: those of their variables, or indices of their
        list.
        """
        names: list[str] = []
        array = self.dereference(self.get(info, "attachments")[0])
        list_name = array.name if isinstance(array, Array) else ""
        for n, struct in enumerate(structs):
            name = (
                struct.name
                if struct is not None and struct.name
                else f"{list_name}[{n}]"
                if list_name
                else f"attachment {n}"
            )
            names.append(name if name not in names else f"{name} ({n})")
        return names

    def has_single_images(
        self, structs: Sequence[Struct | None], images: Sequence[ApiObject | None]
    ) -> bool:
        """Returns whether each multisampled image of a pass is known and single.

        With one image per frame in flight, no frame waits for another.
        """
        return not any(
            struct is None
            or (
                (self.samples(struct)[0] or 2) > 1
                and (image is None or image.repeated or "[" in image.name)
            )
            for struct, image in zip(structs, images, strict=True)
        )

    def place_of(self, struct: Struct | None, otherwise: Span) -> Span:
        """Returns where a structure starts: its declaration, or the first write to it."""
        if struct is None:
            return otherwise
        if struct.name and not self.fragments and struct.zeroed:
            return struct.at
        return min(
            (cell.writes[0].at for cell in struct.fields.values() if cell.writes), default=struct.at
        )

    def assumed_store(self, struct: Struct, resolved: bool) -> Iterator[Item]:
        """Yields an assumed store operation on pages that resolve a multisampled attachment without
        stating one:

        STORE, which is zero and which earlier steps of the page needed to present the attachment.
        """
        if (
            self.fragments
            and resolved
            and "storeOp" not in struct.fields
            and not struct.zeroed
            and "samples" in struct.fields
        ):
            at = struct.fields["samples"].writes[0].at
            self.assumed.setdefault(
                f"{struct.name}.storeOp", (f"{struct.name}.storeOp", at, "STORE")
            )
            yield "storeOp", at, scalar("STORE", at)


def _leaves(node: Node) -> Iterator[Node]:
    """Yields the scalars of a subpass."""
    stack = [node]
    while stack:
        inner = stack.pop()
        if inner.kind == "scalar":
            yield inner
        else:
            stack += inner.value.values() if inner.kind == "mapping" else inner.value


OPERATIONS = ("loadOp", "storeOp", "stencilLoadOp", "stencilStoreOp")


def _certain(node: Node, referred: bool, resolved: bool) -> Node:
    """Returns an attachment of a pass of which parts are unknown, without the operations that these
    parts may need.

    An attachment that no known part refers to may be used in any way; one that is discarded may be
    read or resolved before.
    """
    items = [(name, node.keys[name].span, value) for name, value in node.value.items()]
    kept = [
        item
        for item in items
        if item[0] not in OPERATIONS
        or (referred and (resolved or not item[0].endswith("toreOp") or item[2].text == "STORE"))
    ]
    return mapping(kept, node.span) if len(kept) < len(items) else node


def _resolved(subpasses: Sequence[Node]) -> set[str]:
    """Returns the names of the color attachments that subpasses resolve."""
    names = set()
    for subpass in subpasses:
        colors, targets = (
            subpass.value[key].value if key in subpass.value else []
            for key in ("colorAttachments", "resolveAttachments")
        )
        names |= {
            color.text
            for color, target in zip(colors, targets, strict=False)
            if color.value is not None and target.value is not None
        }
    return names

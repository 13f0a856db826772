"""Converts subpasses and their dependencies to nodes of a description.

What other code decides of a subpass is left out. An unknown reference is null, so that the others
keep their index.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.values import UNKNOWN, Array, Struct

from .members import Item, Members, head_of

LISTS = ("colorAttachments", "resolveAttachments", "inputAttachments")


class SubpassNode(NamedTuple):
    """What is known of a subpass, and whether that is all of it."""

    node: Node
    complete: bool


class Subpasses(Members):
    """Converts subpasses to nodes."""

    def subpass(self, struct: Struct | None, names: Sequence[str], at: Span) -> SubpassNode:
        """Returns what is known of a subpass. `names` are those of the attachments of its pass."""
        if struct is None:
            return SubpassNode(mapping([], at), False)
        head = head_of(struct.at)
        lists = {name: self.references(struct, name, names) for name in LISTS}
        complete = all(nodes is not None and None not in nodes for nodes in lists.values())
        colors, targets = lists["colorAttachments"], lists["resolveAttachments"]
        if targets and not (colors and len(colors) >= len(targets)):
            lists["resolveAttachments"], complete = None, False
        elif colors and targets:
            # Of an unknown color attachment, or to an unknown target, nothing is known to be
            # resolved.
            known = [
                target if color is not None else None
                for color, target in zip(colors, targets, strict=False)
            ]
            lists["resolveAttachments"] = known
        items: list[Item] = []
        for name, nodes in lists.items():
            if nodes:
                at = head_of(self.get(struct, name)[1])
                items.append(
                    (
                        name,
                        self.get(struct, name)[1],
                        sequence([node or scalar(None, at) for node in nodes], at),
                    )
                )
        depth, depth_known = self.depth_reference(struct, names)
        items += depth
        chained, chain_known = self.chained(struct, names)
        return SubpassNode(
            mapping([*items, *chained], head), complete and depth_known and chain_known
        )

    def depth_reference(self, struct: Struct, names: Sequence[str]) -> tuple[list[Item], bool]:
        """Returns the depth/stencil attachment of a subpass, and whether it is known."""
        if not (struct.zeroed or "depthStencilAttachment" in struct.fields or self.fragments):
            return [], False
        value, at = self.get(struct, "depthStencilAttachment")
        if value is None or (value is UNKNOWN and "depthStencilAttachment" not in struct.fields):
            return [], True
        node = self.reference(self.struct(struct, "depthStencilAttachment"), names)
        return ([("depthStencilAttachment", at, node)], True) if node is not None else ([], False)

    def chained(self, struct: Struct, names: Sequence[str]) -> tuple[list[Item], bool]:
        """Returns what the pNext chain of a subpass states, and whether all of the chain is
        known.
        """
        items: list[Item] = []
        structs, known = self.chain(struct)
        for chained in structs:
            name, node = "", None
            if chained.kind == "SubpassDescriptionDepthStencilResolve":
                name, node = "depthStencilResolve", self.depth_resolve(chained, names)
            elif chained.kind == "MultisampledRenderToSingleSampledInfo":
                name, node = "multisampledRenderToSingleSampled", self.single_sampled(chained)
            elif chained.kind == "FragmentShadingRateAttachmentInfo":
                name, node = (
                    "fragmentShadingRateAttachment",
                    self.chained_reference(chained, "fragmentShadingRateAttachment", names),
                )
            if node is not None:
                items.append((name, head_of(chained.at), node))
            known = known and node is not None
        return (items, True) if known else ([*items, self.unread(struct)], False)

    def chained_reference(self, struct: Struct, name: str, names: Sequence[str]) -> Node | None:
        """Returns the attachment that a structure of a pNext chain refers to, null for none; None
        if it is unknown.
        """
        value, at = self.get(struct, name)
        target = self.dereference(value)
        if target is None or (target == 0 and type(target) is int):
            # A pointer that is null, or a reference whose members are all zero.
            return (
                scalar(None, at) if name != "fragmentDensityMapAttachment" else scalar(names[0], at)
            )
        if isinstance(target, Array) and target.items:
            # `{2, layout}` is assigned to a member.
            items = target.items
            target = Struct("AttachmentReference", at, True)
            target.fields["attachment"] = items[0]
        return self.reference(target, names) if isinstance(target, Struct) else None

    def single_sampled(self, struct: Struct) -> Node:
        count, place = self.samples(struct, "rasterizationSamples")
        items = [*self.item(struct, "multisampledRenderToSingleSampledEnable")]
        if count is not None:
            items.append(("rasterizationSamples", place, scalar(count, place)))
        return mapping(items, head_of(struct.at))

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

    def references(
        self, struct: Struct, name: str, names: Sequence[str]
    ) -> list[Node | None] | None:
        """Returns a list of references, with None for unknown ones; None if the list is unknown."""
        if name not in struct.fields:
            return [] if struct.zeroed or self.fragments else None
        structs = self.structs(struct, name)
        return [self.reference(item, names) for item in structs] if structs is not None else None

    def reference(self, struct: Struct | None, names: Sequence[str]) -> Node | None:
        if struct is None:
            return None
        index, at = self.get(struct, "attachment")
        if index is UNKNOWN and self.fragments:
            # Pages that modify a program do not repeat that `colorAttachmentRef` refers to
            # `colorAttachment`.
            indices = [
                n
                for n, name in enumerate(names)
                if struct.name and struct.name.startswith(name) and struct.name != name
            ]
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

"""Vulkano's macros that create render passes: `single_pass_renderpass!` and
`ordered_passes_renderpass!`.

The grammar does not read the arguments of macros, only their tokens. Vulkano, documentation of both
macros in `vulkano::render_pass`.
"""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import BRACES, CALL, LITERAL, NAME, UNPARSED, Term
from msaa_lint.input.code.parsing import SyntaxNode, span

from .expressions import Items, stencil_operations
from .statements import Statements

MACROS = frozenset({"single_pass_renderpass", "ordered_passes_renderpass"})

_MEMBERS = {
    "load_op": "load_op", "load": "load_op", "store_op": "store_op", "store": "store_op",
    "format": "format", "samples": "samples",
    "initial_layout": "initial_layout", "final_layout": "final_layout",
    "stencil_load_op": "stencil_load_op",
    "stencil_store_op": "stencil_store_op",
}  # fmt: skip
_ENUMS = {"load_op": "AttachmentLoadOp", "store_op": "AttachmentStoreOp",
"stencil_load_op": "AttachmentLoadOp",
          "stencil_store_op": "AttachmentStoreOp"}  # fmt: skip
_LISTS = {
    "color": "color_attachments",
    "color_resolve": "resolve_attachments",
    "resolve": "resolve_attachments",
    "input": "input_attachments",
}

Members = dict[str, list[SyntaxNode]]
"""The tokens of each member of a list in braces, by its name."""


class RenderPassMacros(Statements):
    """The macros of one file."""

    def render_pass(self, node: SyntaxNode) -> Term | None:
        name, tokens = (
            node.child_by_field_name("macro"),
            next((child for child in node.named_children if child.type == "token_tree"), None),
        )
        if name is None or tokens is None or self.text_of(name).rpartition("::")[2] not in MACROS:
            return None
        at = span(node)
        members = self.members_of(tokens)
        attachments = _braced(members.get("attachments"))
        passes = _braced(members.get("passes"))
        parts = [_braced(members.get("pass")), *(_trees(passes) if passes is not None else ())]
        subpasses = [part for part in parts if part is not None]
        if attachments is None or not subpasses:
            return (UNPARSED, "", at)
        by_name = self.members_of(attachments)
        numbers = {name: number for number, name in enumerate(by_name)}
        info = (
            (
                ("attachments",),
                self.list_term([self.attachment(value) for value in by_name.values()], at),
            ),
            (
                ("subpasses",),
                self.list_term([self.subpass(part, numbers) for part in subpasses], at),
            ),
        )
        return (
            CALL,
            (NAME, "create_render_pass", at),
            ((BRACES, "vk::RenderPassCreateInfo", info, at),),
            at,
        )

    def list_term(self, items: Sequence[Term], at: Span) -> Term:
        return (BRACES, "", tuple((None, item) for item in items), at)

    def members_of(self, tokens: SyntaxNode) -> Members:
        """Returns the members in braces by name."""
        members: Members = {}
        children = tokens.children
        name, start = "", 0
        for number, child in enumerate(children):
            if child.type == ":" and number and children[number - 1].type in ("identifier", "self"):
                name, start = self.text_of(children[number - 1]), number + 1
            elif name and (child.type in (",", "}", ")", "]")):
                members[name] = children[start:number]
                name = ""
        return members

    def attachment(self, nodes: list[SyntaxNode]) -> Term:
        tokens = _braced(nodes)
        if tokens is None:
            return (UNPARSED, "", Span(0, 0))
        items: Items = []
        for name, value in self.members_of(tokens).items():
            member = _MEMBERS.get(name)
            if member is not None:
                items.append(((member,), self.value(member, value)))
        stated = {path[0] for path, _ in items if path is not None}
        # The macro derives layouts from the passes that use the attachment.
        items += [
            ((name,), (UNPARSED, "", span(tokens)))
            for name in ("initial_layout", "final_layout")
            if name not in stated
        ]
        return (
            BRACES,
            "vk::AttachmentDescription",
            (*items, *stencil_operations(items)),
            span(tokens),
        )

    def value(self, member: str, nodes: list[SyntaxNode]) -> Term:
        """Returns the value of a member, which is an expression or, for an operation, a variant
        without its enum.
        """
        at = Span(nodes[0].start_byte, nodes[-1].end_byte) if nodes else Span(0, 0)
        text = self.text[at.start : at.end]
        if member in _ENUMS and text.isidentifier():
            return (NAME, f"vk::{_ENUMS[member]}::{text}", at)
        if text.isdigit() and len(text) < 10:
            return (LITERAL, int(text), at)
        path = "".join(text.split())
        if path.replace("::", "_").isidentifier():
            return (NAME, "::".join(self.imports.resolved(path.split("::"))), at)
        return (UNPARSED, text[:100], at)

    def subpass(self, tokens: SyntaxNode, numbers: dict[str, int]) -> Term:
        members = self.members_of(tokens)
        items: list[tuple[tuple[str], Term]] = []
        for name, member in _LISTS.items():
            value = _braced(members.get(name))
            if value is not None:
                items.append(
                    (
                        (member,),
                        self.list_term(
                            [
                                self.attachment_reference(child, numbers)
                                for child in self.names_in(value)
                            ],
                            span(value),
                        ),
                    )
                )
        depth = _braced(members.get("depth_stencil"))
        if depth is not None:
            items += [
                (("depth_stencil_attachment",), self.attachment_reference(child, numbers))
                for child in self.names_in(depth)[:1]
            ]
        return (BRACES, "vk::SubpassDescription", tuple(items), span(tokens))

    @staticmethod
    def names_in(tokens: SyntaxNode) -> list[SyntaxNode]:
        return [child for child in tokens.named_children if child.type == "identifier"]

    def attachment_reference(self, name: SyntaxNode, numbers: dict[str, int]) -> Term:
        at = span(name)
        number = numbers.get(self.text_of(name))
        index: Term = (LITERAL, number, at) if number is not None else (UNPARSED, "", at)
        return (BRACES, "vk::AttachmentReference", ((("attachment",), index),), at)


def _braced(nodes: list[SyntaxNode] | None) -> SyntaxNode | None:
    """Returns the only node of a value if it is a list in brackets, or None."""
    return (
        nodes[0]
        if nodes is not None and len(nodes) == 1 and nodes[0].type == "token_tree"
        else None
    )


def _trees(tokens: SyntaxNode) -> list[SyntaxNode]:
    """Returns the lists in brackets among the tokens of a list."""
    return [child for child in tokens.named_children if child.type == "token_tree"]

"""The outline of a description: its images, passes with their attachments and subpasses, pipelines,
and commands in their passes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import Command

from .names import SECTIONS
from .places import Place, children, content, descriptions, root_place

if TYPE_CHECKING:
    from .view import View

BEGINS, ENDS = (
    frozenset({"beginRenderPass", "beginRendering"}),
    frozenset({"endRenderPass", "endRendering"}),
)

_SECTIONS = frozenset({*SECTIONS, "renderTargets", "sampleCountChoices", "metal.renderPipelines"})
"""The sections whose entries have names."""

_PARTS_OF_PASSES = frozenset({"colorAttachments", "depthAttachment", "stencilAttachment"})


class Symbol(NamedTuple):
    """An entry of the outline: its name, a few words, a section or the key that it stands for, its
    whole place, and that of its name.
    """

    name: str
    detail: str
    section: str
    span: Span
    head: Span
    children: tuple[Symbol, ...] = ()


def symbols(view: View) -> list[Symbol]:
    """The outline of all documents; of several, each under its own entry."""
    roots = descriptions(view.roots)
    documents = [tuple(_sections(view.text, root_place(root))) for root in roots]
    if len(documents) == 1:
        return list(documents[0])
    return [
        Symbol(
            f"document {number}",
            "",
            "document",
            root.span,
            Span(root.start, min(root.start + 1, root.end)),
            parts,
        )
        for number, (root, parts) in enumerate(zip(roots, documents, strict=True), 1)
    ]


def _sections(text: str, root: Place) -> Iterator[Symbol]:
    for place in children(root):
        name = place.path[-1]
        parts = children(place) if name == "metal" else (place,)
        for part in parts:
            section = ".".join(part.path)
            yield _symbol(text, part, section, section, _entries(text, part, section))


def _entries(text: str, place: Place, section: str) -> tuple[Symbol, ...]:
    """The entries of a section."""
    if section.endswith("commands"):
        return _commands(text, list(children(place)))
    if section not in _SECTIONS:
        return ()
    return tuple(
        _symbol(text, entry, entry.path[-1], section, _parts(text, entry))
        for entry in children(place)
    )


def _parts(text: str, entry: Place) -> tuple[Symbol, ...]:
    """The attachments and subpasses of a pass."""
    found = []
    for place in children(entry) if entry.path[-2] == "renderPasses" else ():
        member = place.path[-1]
        if member in ("attachments", "subpasses", "colorAttachments"):
            label = (
                member.removesuffix("s").removesuffix("e")
                if member == "subpasses"
                else member.removesuffix("s")
            )
            for item in children(place):
                name = (
                    item.path[-1]
                    if item.key is not None and member == "attachments"
                    else f"{label} {item.path[-1]}"
                )
                found.append(_symbol(text, item, name, member))
        elif member in _PARTS_OF_PASSES:
            found.append(_symbol(text, place, member, member))
    return tuple(found)


def _commands(text: str, places: Sequence[Place]) -> tuple[Symbol, ...]:
    """The commands in order, those of a pass below the command that begins it."""
    found: list[Symbol] = []
    begun: Symbol | None = None
    inside: list[Symbol] = []
    for place in places:
        symbol = _command(text, place)
        if begun is None:
            begun, inside = (symbol, []) if symbol.name in BEGINS else (None, [])
            found += [symbol] if begun is None else []
            continue
        if symbol.name in BEGINS:
            found.append(_enclosing(begun, inside))
            begun, inside = symbol, []
            continue
        inside.append(symbol)
        if symbol.name in ENDS:
            found.append(_enclosing(begun, inside))
            begun = None
    return (*found, _enclosing(begun, inside)) if begun is not None else tuple(found)


def _enclosing(begun: Symbol, inside: Sequence[Symbol]) -> Symbol:
    end = max((symbol.span.end for symbol in inside), default=begun.span.end)
    return begun._replace(
        span=Span(begun.span.start, max(end, begun.span.end)), children=(*begun.children, *inside)
    )


def _command(text: str, place: Place) -> Symbol:
    node = place.node
    is_command = place.shape[0] == "command" and issubclass(place.shape[1], Command)
    name = next(iter(node.value), "") if node.kind == "mapping" and is_command else node.text
    parts: tuple[Symbol, ...] = ()
    if name == "beginRendering":
        body = next(iter(children(place)), None)
        members = children(body) if body is not None else ()
        parts = tuple(
            _symbol(text, member, member.path[-1], member.path[-1])
            for member in members
            if member.path[-1] in _PARTS_OF_PASSES
        )
    return _symbol(text, place, name or "command", "command", parts)


def _symbol(
    text: str, place: Place, name: str, section: str, parts: tuple[Symbol, ...] = ()
) -> Symbol:
    node, key = place.node, place.key
    head = content(text, key) if key is not None else _head(text, node)
    start = key.start if key is not None else node.start
    inside = max((part.span.end for part in parts), default=0)
    span = Span(start, max(node.end, head.end, inside))
    return Symbol(name.strip() or "?", _detail(node), section, span, head, parts)


def _head(text: str, node: Node) -> Span:
    start = content(text, node).start
    return Span(start, node.end if node.kind == "scalar" else min(start + 1, node.end))


_TELLING = (
    "format",
    "pixelFormat",
    "samples",
    "sampleCount",
    "image",
    "texture",
    "loadOp",
    "storeOp",
    "loadAction",
    "storeAction",
    "renderPass",
    "pipeline",
)


def _detail(node: Node) -> str:
    """What identifies an entry: its format and samples, its image and operations, its pass."""
    if node.kind != "mapping":
        return ""
    inner = next(iter(node.value.values())) if len(node.value) == 1 else node
    values = inner.value if inner.kind == "mapping" else node.value
    stated = [
        (member, values[member])
        for member in _TELLING
        if member in values and values[member].kind == "scalar"
    ]
    return " ".join(
        f"{value.text}x"
        if member in ("samples", "sampleCount") and value.text.isdigit()
        else value.text
        for member, value in stated
    )[:120]

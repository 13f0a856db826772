"""What a key of a description, or the value of an enumerant, means: the texts of the JSON Schema
and of editors.

Nothing on the path of `check` imports this module.
"""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from ..models import AttachmentReference, Command, Description
from ..record import Record
from ..scalars import enumerant
from ..shapes import Shape
from .commands import COMMAND_STRUCTURES
from .entries import SECTIONS, Key, Structure
from .enumerants import ENUMERANTS
from .frame import FRAME_STRUCTURES
from .metal import METAL_STRUCTURES
from .pipelines import PIPELINE_STRUCTURES
from .render_passes import RENDER_PASS_STRUCTURES

STRUCTURES: dict[str, Structure] = {
    **RENDER_PASS_STRUCTURES, **PIPELINE_STRUCTURES, **COMMAND_STRUCTURES, **FRAME_STRUCTURES,
    **METAL_STRUCTURES
}  # fmt: skip
"""By the name of the record class."""

SPECIFICATION = "https://docs.vulkan.org/spec/latest/chapters"
REFERENCE_PAGES = "https://docs.vulkan.org/refpages/latest/refpages/source"
METAL_REFERENCE = "https://developer.apple.com/documentation/metal"

_BY_VALUE = frozenset({"extent", "renderArea", "shadingRateAttachmentTexelSize"})
"""The members of the specification's structures that are structures themselves; others are pointers
to them.
"""


class KeyText(NamedTuple):
    """A key's title and description; `markdown` is the description with links to the
    specification.
    """

    title: str
    description: str
    markdown: str


class KeyParts(NamedTuple):
    """What a key's text says beside its meaning; `references` are links to the specification, in
    Markdown.
    """

    unit: str
    absent: str
    sources: str
    references: str


def key_parts(kind: type[Record], name: str) -> KeyParts:
    """The parts of the text of a key of a structure. KeyError if it does not have the key."""
    key = STRUCTURES[kind.__name__].keys[name]
    source, section = source_of(kind, name), key.section or _section(kind, key)
    page, title = SECTIONS.get(section, ("", ""))
    chapter = f"Vulkan specification, {title}" if title else ""
    links = (
        _link(source, _source_page(source)),
        _link(chapter, f"{SPECIFICATION}/{page}.html#{section}"),
    )
    return KeyParts(
        unit_of(kind, name), absence_of(kind, name), _joined(source, chapter), _joined(*links)
    )


def structure_text(kind: type[Record]) -> str:
    """What a structure states, on one line: the first paragraph of its docstring."""
    return " ".join((inspect.getdoc(kind) or "").partition("\n\n")[0].split())


def key_text(kind: type[Record], name: str) -> KeyText:
    """The text of a key of a structure. KeyError if it does not have the key."""
    key, parts = STRUCTURES[kind.__name__].keys[name], key_parts(kind, name)
    text = (
        key.meaning
        + (f" Unit: {parts.unit}." if parts.unit else "")
        + (f" If absent: {parts.absent}." if parts.absent else "")
    )
    return KeyText(
        key.title,
        *(
            f"{text} {references}." if references else text
            for references in (parts.sources, parts.references)
        ),
    )


def unit_of(kind: type[Record], name: str) -> str:
    """The unit of a key's numbers; empty if its values are not numbers."""
    key = STRUCTURES[kind.__name__].keys[name]
    return key.unit or ("samples per texel" if _counts_samples(kind.SHAPE[name]) else "")


def absence_of(kind: type[Record], name: str) -> str:
    """What holds without the key; empty for commands, each of which has one of its keys."""
    if issubclass(kind, Command):
        return ""
    absent = STRUCTURES[kind.__name__].keys[name].absent
    return absent or ("unknown" if getattr(kind, name) is None else "none")


def source_of(kind: type[Record], name: str) -> str:
    """The specification's term for a key, such as `VkAttachmentDescription2::storeOp`; empty for a
    key of msaa-lint's own.
    """
    structure = STRUCTURES[kind.__name__]
    source = structure.keys[name].source
    if source is not None:
        return source
    if not structure.source or issubclass(kind, Command):
        return ""
    if not structure.source.startswith("Vk"):
        return f"{structure.source}.{name}"
    pointed = name not in _BY_VALUE and _is_pointed_to(kind.SHAPE[name])
    return f"{structure.source}::{f'p{name[0].upper()}{name[1:]}' if pointed else name}"


def enumerant_text(enum: str, value: str) -> str | None:
    """What a value of an enum means, in any of its spellings; None if there is no text for it."""
    name = enumerant(enum, value)
    return None if name is None else ENUMERANTS.get(enum, {}).get(name)


def path_text(path: Sequence[str | int]) -> KeyText | None:
    """The text of the key at a path from the root of a description (`("images", "color",
    "format")`); None if it leads to no such key.
    """
    found = key_at(path)
    return None if found is None else key_text(*found)


def key_at(path: Sequence[str | int]) -> tuple[type[Record], str] | None:
    """The structure that the last key of a path belongs to, and the key."""
    if not path:
        return None
    shapes: list[Shape] = [("record", Description)]
    for step in path[:-1]:
        shapes = [inner for shape in shapes for inner in _inside(shape, step)]
    name = str(path[-1])
    records = (record for shape in shapes for record in _records(shape))
    return next(((record, name) for record in records if name in record.SHAPE), None)


def _inside(shape: Shape, step: str | int) -> Iterator[Shape]:
    """The shapes of what is at a key or an index of a value."""
    match shape:
        case ("null", inner):
            yield from _inside(inner, step)
        case ("either", *shapes):
            for inner in shapes:
                yield from _inside(inner, step)
        case ("list" | "map" | "numbered" | "counted", item, *_):
            yield item
        case _:
            for record in _records(shape):
                if step in record.SHAPE:
                    yield record.SHAPE[step]


def _records(shape: Shape) -> Iterator[type[Record]]:
    """The structures that a value may be."""
    match shape:
        case ("record" | "command", kind):
            yield kind
        case ("slot",):
            yield AttachmentReference
        case ("null" | "either", *shapes):
            for inner in shapes:
                yield from _records(inner)


def _counts_samples(shape: Shape) -> bool:
    return shape == ("samples",) or (shape[0] == "list" and shape[1] == ("samples",))


def _is_pointed_to(shape: Shape) -> bool:
    """Whether the specification's member is a pointer: a list, a structure, or a text."""
    return shape[0] in ("list", "counted", "record", "slot", "text") or (
        shape[0] == "either" and _is_pointed_to(shape[1])
    )


def _section(kind: type[Record], key: Key) -> str:
    return "" if key.source == "" else STRUCTURES[kind.__name__].section


def _source_page(source: str) -> str:
    term = source.split("::")[0].split(".")[0]
    if term[:3].lower() == "mtl":
        return f"{METAL_REFERENCE}/{term.lower()}"
    return f"{REFERENCE_PAGES}/{term}.html" if term[:2].lower() == "vk" else ""


def _link(text: str, address: str) -> str:
    return f"[{text}]({address})" if text and address else text


def _joined(*references: str) -> str:
    return "; ".join(filter(None, references))

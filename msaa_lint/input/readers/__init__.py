"""What files are read as: one module per input format, told by content, never by a file's name.

The readers of texts have `claims(root)` and `read(source, root)`. Those of captures, which are streams, have `claims(head)`, `calls(stream,
wanted, path)`; they are imported when one is met.
"""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Node
from msaa_lint.frame.description.document import Document

from . import description, vulkan_sc

FORMATS: dict[str, ModuleType] = {"vulkan-sc": vulkan_sc, "description": description}
"""By the name that `--input-format` takes, in the order in which they are asked; the last reads what none claims."""

CAPTURES: dict[str, tuple[str, ...]] = {
    "gfxreconstruct": ('"vkFunc"', '"gfxrecon-version"'),
    "api-dump": ('"apiCalls"',),
    "renderdoc": ("<rdc>",),
    "fossilize": ("FOSSILIZEDB",),
}
"""The readers of captures by the name that `--input-format` takes (a module each, with `_` for `-`), and what a capture has near its
beginning."""

HEADS = (
    "images:",
    "renderPasses:",
    "pipelines:",
    "commands:",
    "framebuffers:",
    "renderTargets:",
    "sampleCountChoices:",
    "metal:",
    '"renderPasses"',
    '"images"',
    '"renderTargets"',
    '"metal"',
    "PipelineState",
)
"""What a file of ours has near its beginning: a folder's other files are passed over."""


def read(source: Source, root: Node, format: str | None = None) -> Document:
    """A document by the format that is named, or that claims it."""
    module = FORMATS[format] if format is not None else next((m for m in FORMATS.values() if m.claims(root)), description)
    made: Document = module.read(source, root)
    return made


CAPTURE_HEADS = tuple(word for words in CAPTURES.values() for word in words)

# What one of them has before its reader is asked: also what stands in other files, and in parts of a capture that have no header.
_MARKS = (*(word.encode() for word in CAPTURE_HEADS), b"gfxrecon", b"vkFunc", b'"function"', b"apiCalls", b"<rdc", b'"meta"')


def capture_format(head: bytes) -> str | None:
    """The name of the capture format that the beginning of a file is of; None where it is of none."""
    if head[:1] not in (b"{", b"[", b"<", b"\x81", b"\xef", b" ", b"\n", b"\r", b"\t") or not any(mark in head for mark in _MARKS):
        return None
    for name in CAPTURES:
        if import_module(f".{name.replace('-', '_')}", __package__).claims(head):
            return name
    return None


def looks_like(head: str) -> bool:
    """Whether the beginning of a file looks like one that a reader claims."""
    return any(word in head for word in HEADS) or any(word in head for word in CAPTURE_HEADS)

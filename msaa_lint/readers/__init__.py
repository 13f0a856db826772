"""What files are read as: one module per input format, each with `claims(root)` and `read(source, root)`.

A format is told by content, never by a file's name.
"""

from __future__ import annotations

from types import ModuleType

from ..document.document import Document
from ..source.text import Source
from ..source.tree import Node
from . import description, vulkan_sc

FORMATS: dict[str, ModuleType] = {"vulkan-sc": vulkan_sc, "description": description}
"""By the name that `--input-format` takes, in the order in which they are asked; the last reads what none claims."""

HEADS = ("images:", "renderPasses:", "pipelines:", "commands:", "framebuffers:", '"renderPasses"', '"images"', "PipelineState")
"""What a file of ours has near its beginning: a folder's other files are passed over."""


def read(source: Source, root: Node, format: str | None = None) -> Document:
    """A document by the format that is named, or that claims it."""
    module = FORMATS[format] if format is not None else next((m for m in FORMATS.values() if m.claims(root)), description)
    made: Document = module.read(source, root)
    return made


def looks_like(head: str) -> bool:
    """Whether the beginning of a file looks like one that a reader claims."""
    return any(word in head for word in HEADS)

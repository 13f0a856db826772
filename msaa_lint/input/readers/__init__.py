"""Input formats, one module each. A format is detected from content, never from a file name.

Readers of text documents define `claims(root)` and `read(source, root)`. Readers of captures, which
are streams, define `claims(head)` and `calls(stream, wanted, path)`; they are imported on first
use.
"""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Node
from msaa_lint.frame.description.document import Document

from . import description, vulkan_sc
from .partial import rest_of

FORMATS: dict[str, ModuleType] = {"vulkan-sc": vulkan_sc, "description": description}
"""Document readers by `--input-format` name, in detection order. The last one reads documents that
no reader claims.
"""

CAPTURES = ("gfxreconstruct", "api-dump", "renderdoc", "fossilize")
"""Capture readers by `--input-format` name: the module name, with `-` for `_`."""


def read(source: Source, root: Node, format: str | None = None) -> Document:
    """Reads a document in the given format, or in the detected one."""
    name = (
        format
        if format is not None
        else next((name for name, module in FORMATS.items() if module.claims(root)), "description")
    )
    document: Document = FORMATS[name].read(source, root)
    if document.problems:
        rest = rest_of(source, root, document) if name == "description" else None
        document = document._replace(rest=rest._replace(format=name) if rest is not None else None)
    return document._replace(format=name)


# A cheap test before any reader is imported. It also accepts parts of a capture without a header,
# and some files that are not captures.
_MARKS = (b"gfxrecon", b"vkFunc", b'"function"', b"apiCalls", b"<rdc", b'"meta"', b"FOSSILIZEDB")


def capture_format(head: bytes) -> str | None:
    """The name of the capture format that a file starts with; None if it is not a capture."""
    if head[:1] not in (b"{", b"[", b"<", b"\x81", b"\xef", b" ", b"\n", b"\r", b"\t") or not any(
        mark in head for mark in _MARKS
    ):
        return None
    for name in CAPTURES:
        if import_module(f".{name.replace('-', '_')}", __package__).claims(head):
            return name
    return None

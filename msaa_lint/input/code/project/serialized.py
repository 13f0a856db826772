"""The syntax of a file as bytes, and read again at its place in the text of a program.

The files of a program are read as if they were one text: each place in a file has the offset of the
file added to it.
"""

from __future__ import annotations

from msaa_lint.core import serialized
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import Basis
from msaa_lint.input.code.core.terms import Function, Parameter, Unit
from msaa_lint.input.code.parsing import Read, Unread
from msaa_lint.input.code.places import Piece
from msaa_lint.input.code.programs import FileSyntax

_TYPES = serialized.by_name(
    Basis, FileSyntax, Function, Node, Parameter, Piece, Read, Span, Unit, Unread
)


def dumps(content: FileSyntax | list[Read]) -> bytes:
    """Returns the syntax of a file, or what a program creates, as bytes. Raises RecursionError if
    it nests too deeply.
    """
    return serialized.dumps(content)


def loads(data: bytes, offset: int) -> FileSyntax:
    """Returns the syntax of a file that bytes hold, with an offset added to each place. Raises
    ValueError for other bytes.
    """
    syntax = serialized.loads(
        data, {**_TYPES, (Span.__module__, Span.__name__): _span_type(offset)} if offset else _TYPES
    )
    if not isinstance(syntax, FileSyntax):
        raise ValueError("not the syntax of a file")
    for _, _, node in syntax.choices if offset else ():
        move(node, offset)
    return syntax


def loads_reads(data: bytes) -> list[Read]:
    """Returns what a program creates that bytes hold. Raises ValueError for other bytes."""
    reads = serialized.loads(data, _TYPES)
    if not isinstance(reads, list) or not all(isinstance(read, Read) for read in reads):
        raise ValueError("not what a program creates")
    return reads


def _span_type(offset: int) -> type[Span]:
    # There may be a million of them.
    new = tuple.__new__

    class Moved(Span):
        """Creates places with the offset added."""

        def __new__(cls, start: int, end: int) -> Span:  # type: ignore[misc]
            return new(Span, (start + offset, end + offset))

    return Moved


def move(node: Node, offset: int) -> None:
    """Adds an offset to the places of a tree. Nodes are visited once, also if they are in several
    places of it.
    """
    waiting = [node]
    moved: set[int] = set()
    while waiting:
        at = waiting.pop()
        if id(at) in moved:
            continue
        moved.add(id(at))
        at.start += offset
        at.end += offset
        waiting += at.keys.values()
        waiting += (
            at.value.values() if at.kind == "mapping" else at.value if at.kind == "sequence" else ()
        )

"""What is known of the files of a program before it is executed, in any language, and what it
creates.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import Basis

from .core.assumed_values import Assume, nothing
from .core.limits import Work
from .core.terms import Unit
from .metal.description_trees import metal_reads
from .parsing import Read, Unread
from .places import Piece, Places
from .sample_counts.program_formats import with_formats
from .vulkan.creation import VulkanInterpreter
from .vulkan.rust import RustInterpreter
from .vulkan.tree_writer import DescriptionWriter

CPP = ("cpp", "objcpp")
"""The languages with references."""


class FileSyntax(NamedTuple):
    """What is known of a file, or of the files of a program, before it is executed.

    `choices` are sample count choices: name, place, and entry. `fills_structures` says that the
    code fills in Vulkan structures, `waits` that it synchronizes frames, `begins_frames` that it
    starts them. `length` is the number of characters after preprocessing, in which all places are;
    `pieces` say where they come from. `unread` exceeds a limit; its places are those in the file.
    `calls_metal` says that the code calls Metal, `platform` where it states that it runs on Apple
    GPUs alone. `language` is one of `file_types.LANGUAGES`.
    """

    unit: Unit
    choices: Sequence[tuple[str, Span, Node]]
    fills_structures: bool
    waits: bool
    begins_frames: bool
    length: int
    pieces: Sequence[Piece] = ()
    unread: Sequence[Unread] = ()
    calls_metal: bool = False
    platform: Span | None = None
    language: str = ""


def located(reads: Sequence[Read], places: Places, unread: Sequence[Unread] = ()) -> list[Read]:
    """Returns what was read from preprocessed text with its places in the files, and what else
    exceeds a limit.
    """
    moved = [
        read._replace(
            tree=places.moved(read.tree),
            assumed=tuple((what, places.original(at), value) for what, at, value in read.assumed),
            unread=tuple(item._replace(at=places.original(item.at)) for item in read.unread),
            basis=_moved(read.basis, places),
        )
        for read in reads
    ]
    return [*moved, Read(mapping([], Span(0, 0)), unread=tuple(unread))] if unread else moved


def _moved(basis: Basis, places: Places) -> Basis:
    conditions: dict[Span, set[str]] = {}
    for at, subjects in basis.conditions.items():
        conditions.setdefault(places.original(at), set()).update(subjects)
    return Basis(conditions, {places.original(at): words for at, words in basis.assumed.items()})


def executed(syntax: FileSyntax, fragments: bool, assume: Assume = nothing) -> list[Read]:
    """Returns the trees of a file, of the files of a program, or of a page's fragments: at most one
    for each API. `assume` states what the user assumes about it.
    """
    length = Span(0, syntax.length)
    is_cpp = syntax.language in CPP
    metal = (
        metal_reads(syntax.unit, fragments, is_cpp, length, syntax.platform, assume)
        if syntax.calls_metal
        else []
    )
    # Swift calls Vulkan only through code in other languages.
    vulkan = _vulkan_reads(syntax, fragments, is_cpp, assume) if syntax.language != "swift" else []
    return [*vulkan, *metal]


def _vulkan_reads(syntax: FileSyntax, fragments: bool, is_cpp: bool, assume: Assume) -> list[Read]:
    kind = RustInterpreter if syntax.language == "rust" else VulkanInterpreter
    interpreter = kind(syntax.unit, fragments, is_cpp, Work(syntax.length))
    assume(interpreter)
    if fragments or syntax.fills_structures:
        interpreter.run()
    read = DescriptionWriter(
        interpreter, fragments, syntax.waits or not syntax.begins_frames
    ).read()
    unread = (interpreter.unread,) if interpreter.unread is not None else ()
    if not syntax.choices:
        return (
            [(read or Read(mapping([], Span(0, 0))))._replace(unread=unread)]
            if read is not None or unread
            else []
        )
    at = syntax.choices[0][1].start
    start = Span(at, at)
    node = read.tree if read is not None else mapping([], Span(0, 0))
    items = [(key, node.keys[key].span, value) for key, value in node.value.items()]
    items.append(
        ("sampleCountChoices", start, mapping(with_formats(syntax.choices, syntax.unit), start))
    )
    return [
        Read(
            mapping(items, Span(0, 0)),
            read.assumed if read is not None else (),
            unread=unread,
            basis=read.basis if read is not None else Basis(),
        )
    ]

"""Reads C and C++ that fills in Vulkan structures as descriptions."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import Basis
from msaa_lint.input.code.core.assumed_values import Assume, assuming, nothing
from msaa_lint.input.code.core.limits import Work
from msaa_lint.input.code.core.terms import Unit
from msaa_lint.input.code.metal.description_trees import metal_reads, platform_of
from msaa_lint.input.code.parsing import Code, Read, SyntaxNode, Unread, tree
from msaa_lint.input.code.sample_counts.choices import choices
from msaa_lint.input.code.vulkan.creation import VulkanInterpreter
from msaa_lint.input.code.vulkan.tree_writer import DescriptionWriter

from .annotations import without_annotations, without_objective_c
from .directives import clear_list_directives
from .macros import NO_MACROS, Macros
from .modules import without_modules
from .places import Piece, Places
from .preprocessor import preprocessed
from .relevance import without_irrelevant_bodies
from .syntax import unit

_VULKAN = re.compile(r"\b(?:Vk|vk)[A-Z]|\bvk\w*\s*::|=\s*vk\b|VULKAN_HPP")
"""What code contains that fills in Vulkan structures, unless it is a page's; compilers of shaders, too, speak of samples."""

_WAITS = re.compile(r"ipelineBarrier|Queue(?:Submit|Present)[^}]{0,1500}WaitIdle")
"""Synchronization that can replace the dependencies of a render pass between frames."""

_FRAMES = re.compile(r"cquireNextImage")
"""Where a program starts its frames."""


CPP = ("cpp", "objcpp")
"""The languages with references."""


class FileSyntax(NamedTuple):
    """What is known of a file, or of the files of a program, before it is executed.

    `choices` are sample count choices: name, place, and entry. `fills_structures` says that the code fills in Vulkan structures, `waits`
    that it synchronizes frames, `begins_frames` that it starts them. `length` is the number of characters after preprocessing, in which all
    places are; `pieces` say where they come from. `unread` exceeds a limit; its places are those in the file. `calls_metal` says that
    the code calls Metal, `platform` where it states that it runs on Apple GPUs alone.
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


def file_syntax(code: Code, macros: Macros = NO_MACROS) -> FileSyntax:
    """Returns what is known of a file or of a page's fragments; `macros` are defined elsewhere.

    Raises `Missing` if the grammar is not installed.
    """
    whole = without_modules(code.text)
    if code.language in ("c", "cpp"):
        whole = without_objective_c(whole)
    code, places, unread = preprocessed(code._replace(text=whole if code.fragments else without_irrelevant_bodies(whole, macros)), macros)
    code = code._replace(text=without_annotations(code.text))
    root = tree(code).root_node
    text, sections = clear_list_directives(code.text, root)
    if sections:
        code = code._replace(text=text)
        root = tree(code).root_node
    # metal-cpp's names have Metal's namespace.
    syntax = syntax_of(code, whole, unit(code, root, sections), root, "MTL::" in whole)
    return syntax._replace(pieces=places.pieces, unread=unread)


def syntax_of(code: Code, whole: str, unit: Unit, root: SyntaxNode, calls_metal: bool) -> FileSyntax:
    """Returns what is known of a file of any of the languages that C is a part of. `whole` is its text as written."""
    return FileSyntax(
        unit,
        # Sample count masks have this in their name, whatever their source.
        choices(root, code) if "ampleCounts" in code.text else (),
        _VULKAN.search(whole) is not None,
        _WAITS.search(whole) is not None,
        _FRAMES.search(whole) is not None,
        len(code.text),
        calls_metal=calls_metal,
        platform=platform_of(code.text) if calls_metal else None,
    )


def trees(code: Code) -> list[Read]:
    """Returns the trees of a file or of a page's fragments: at most one for each API. Raises `Missing` if the grammar is not installed."""
    syntax = file_syntax(code)
    places = Places(syntax.pieces)
    return located(
        executed(syntax, code.fragments, code.language in CPP, assuming(code.assumptions, places.original)), places, syntax.unread
    )


def located(reads: Sequence[Read], places: Places, unread: Sequence[Unread] = ()) -> list[Read]:
    """Returns what was read from preprocessed text with its places in the files, and what else exceeds a limit."""
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


def executed(syntax: FileSyntax, fragments: bool, is_cpp: bool, assume: Assume = nothing) -> list[Read]:
    """Returns the trees of a file, of the files of a program, or of a page's fragments: at most one for each API. `assume` states what the
    user assumes about it."""
    length = Span(0, syntax.length)
    metal = metal_reads(syntax.unit, fragments, is_cpp, length, syntax.platform, assume) if syntax.calls_metal else []
    return [*_vulkan_reads(syntax, fragments, is_cpp, assume), *metal]


def _vulkan_reads(syntax: FileSyntax, fragments: bool, is_cpp: bool, assume: Assume) -> list[Read]:
    interpreter = VulkanInterpreter(syntax.unit, fragments, is_cpp, Work(syntax.length))
    assume(interpreter)
    if fragments or syntax.fills_structures:
        interpreter.run()
    read = DescriptionWriter(interpreter, fragments, syntax.waits or not syntax.begins_frames).read()
    unread = (interpreter.unread,) if interpreter.unread is not None else ()
    if not syntax.choices:
        return [(read or Read(mapping([], Span(0, 0))))._replace(unread=unread)] if read is not None or unread else []
    at = syntax.choices[0][1].start
    start = Span(at, at)
    node = read.tree if read is not None else mapping([], Span(0, 0))
    items = [(key, node.keys[key].span, value) for key, value in node.value.items()]
    items.append(("sampleCountChoices", start, mapping(syntax.choices, start)))
    return [
        Read(
            mapping(items, Span(0, 0)),
            read.assumed if read is not None else (),
            unread=unread,
            basis=read.basis if read is not None else Basis(),
        )
    ]

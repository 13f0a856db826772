"""Reads C and C++ that fills in Vulkan structures as descriptions."""

from __future__ import annotations

import re

from msaa_lint.input.code.core.assumed_values import assuming
from msaa_lint.input.code.core.terms import Unit
from msaa_lint.input.code.metal.description_trees import platform_of
from msaa_lint.input.code.parsing import Code, Read, SyntaxNode, tree
from msaa_lint.input.code.places import Places
from msaa_lint.input.code.programs import FileSyntax, executed, located
from msaa_lint.input.code.sample_counts.choices import choices

from .annotations import without_annotations, without_objective_c
from .directives import clear_list_directives
from .macros import NO_MACROS, Macros
from .modules import without_modules
from .preprocessor import preprocessed
from .relevance import without_irrelevant_bodies
from .syntax import unit

_VULKAN = re.compile(r"\b(?:Vk|vk)[A-Z]|\bvk\w*\s*::|=\s*vk\b|VULKAN_HPP")
"""What code contains that fills in Vulkan structures, unless it is a page's; compilers of shaders,
too, speak of samples.
"""

_WAITS = re.compile(r"ipelineBarrier|Queue(?:Submit|Present)[^}]{0,1500}WaitIdle")
"""Synchronization that can replace the dependencies of a render pass between frames."""

_FRAMES = re.compile(r"cquireNextImage")
"""Where a program starts its frames."""


def file_syntax(code: Code, macros: Macros = NO_MACROS) -> FileSyntax:
    """Returns what is known of a file or of a page's fragments; `macros` are defined elsewhere.

    Raises `Missing` if the grammar is not installed.
    """
    whole = without_modules(code.text)
    if code.language in ("c", "cpp"):
        whole = without_objective_c(whole)
    code, places, unread = preprocessed(
        code._replace(text=whole if code.fragments else without_irrelevant_bodies(whole, macros)),
        macros,
    )
    code = code._replace(text=without_annotations(code.text))
    root = tree(code).root_node
    text, sections = clear_list_directives(code.text, root)
    if sections:
        code = code._replace(text=text)
        root = tree(code).root_node
    # metal-cpp's names have Metal's namespace.
    syntax = syntax_of(code, whole, unit(code, root, sections), root, "MTL::" in whole)
    return syntax._replace(pieces=places.pieces, unread=unread)


def syntax_of(
    code: Code, whole: str, unit: Unit, root: SyntaxNode, calls_metal: bool
) -> FileSyntax:
    """Returns what is known of a file of any of the languages that C is a part of. `whole` is its
    text as written.
    """
    return FileSyntax(
        unit,
        # Sample count masks have this in their name or type, whatever their source.
        choices(unit, code.text)
        if "ampleCounts" in code.text or "ampleCountFlags" in code.text
        else (),
        ("Vk" in whole or "vk" in whole or "VULKAN" in whole) and _VULKAN.search(whole) is not None,
        _WAITS.search(whole) is not None,
        _FRAMES.search(whole) is not None,
        len(code.text),
        calls_metal=calls_metal,
        platform=platform_of(code.text) if calls_metal else None,
        language=code.language,
    )


def trees(code: Code) -> list[Read]:
    """Returns the trees of a file or of a page's fragments: at most one for each API. Raises
    `Missing` if the grammar is not installed.
    """
    syntax = file_syntax(code)
    places = Places(syntax.pieces)
    return located(
        executed(syntax, code.fragments, assuming(code.assumptions, places.original)),
        places,
        syntax.unread,
    )

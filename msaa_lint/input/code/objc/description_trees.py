"""Reads Objective-C and Objective-C++ that calls Metal or Vulkan as descriptions."""

from __future__ import annotations

from msaa_lint.input.code.c.description_trees import syntax_of
from msaa_lint.input.code.c.macros import NO_MACROS, Macros
from msaa_lint.input.code.c.preprocessor import preprocessed
from msaa_lint.input.code.core.assumed_values import assuming
from msaa_lint.input.code.metal.description_trees import calls_metal
from msaa_lint.input.code.parsing import Code, Read, tree
from msaa_lint.input.code.places import Places
from msaa_lint.input.code.programs import FileSyntax, executed, located

from .messages import rewrite
from .syntax import unit


def file_syntax(code: Code, macros: Macros = NO_MACROS) -> FileSyntax:
    """Returns what is known of a file or of a page's fragments; `macros` are defined elsewhere.

    Raises `Missing` if the grammar is not installed.
    """
    whole = code.text
    code, places, unread = preprocessed(code, macros)
    rewritten = rewrite(code.text)
    root = tree(code._replace(text=rewritten.text)).root_node
    known = unit(code._replace(text=rewritten.text), root, rewritten)
    return syntax_of(code, whole, known, root, calls_metal(code))._replace(
        pieces=places.pieces, unread=unread
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

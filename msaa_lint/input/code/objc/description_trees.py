"""Reads Objective-C and Objective-C++ that calls Metal or Vulkan as descriptions."""

from __future__ import annotations

from msaa_lint.input.code.c.description_trees import syntax_of
from msaa_lint.input.code.core.assumed_values import assuming
from msaa_lint.input.code.metal.description_trees import calls_metal
from msaa_lint.input.code.parsing import Code, Read, tree
from msaa_lint.input.code.programs import FileSyntax, executed

from .messages import rewrite
from .syntax import unit


def file_syntax(code: Code) -> FileSyntax:
    """Returns what is known of a file or of a page's fragments. Raises `Missing` if the grammar is not installed."""
    rewritten = rewrite(code.text)
    root = tree(code._replace(text=rewritten.text)).root_node
    return syntax_of(code, code.text, unit(code._replace(text=rewritten.text), root, rewritten), root, calls_metal(code))


def trees(code: Code) -> list[Read]:
    """Returns the trees of a file or of a page's fragments: at most one for each API. Raises `Missing` if the grammar is not installed."""
    return executed(file_syntax(code), code.fragments, assuming(code.assumptions))

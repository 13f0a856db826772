"""Reads Swift that builds Metal descriptors as descriptions in Metal's terms."""

from __future__ import annotations

from msaa_lint.input.code.core.assumed_values import assuming
from msaa_lint.input.code.metal.description_trees import calls_metal, platform_of
from msaa_lint.input.code.parsing import Code, Read, tree
from msaa_lint.input.code.programs import FileSyntax, executed

from .syntax import unit


def file_syntax(code: Code) -> FileSyntax:
    """Returns what is known of a file or of a page's fragments. Raises `Missing` if the grammar is
    not installed.
    """
    program = unit(code, tree(code).root_node)
    platform = platform_of(code.text)
    return FileSyntax(
        program,
        (),
        False,
        False,
        False,
        len(code.text),
        calls_metal=calls_metal(code),
        platform=platform,
        language=code.language,
    )


def trees(code: Code) -> list[Read]:
    """Returns the description of a Swift file or a page's fragments: one tree with the section
    `metal`, or none.
    """
    return (
        executed(file_syntax(code), code.fragments, assuming(code.assumptions))
        if calls_metal(code)
        else []
    )

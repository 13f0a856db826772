"""Reads Swift that builds Metal descriptors as descriptions in Metal's terms."""

from __future__ import annotations

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.assumed_values import assuming
from msaa_lint.input.code.metal.description_trees import calls_metal, metal_reads, platform_of
from msaa_lint.input.code.parsing import Code, Read, tree

from .syntax import unit


def trees(code: Code) -> list[Read]:
    """Returns the description of a Swift file or a page's fragments: one tree with the section `metal`, or none."""
    if not calls_metal(code):
        return []
    program = unit(code, tree(code).root_node)
    return metal_reads(program, code.fragments, False, Span(0, len(code.text)), platform_of(code.text), assuming(code.assumptions))

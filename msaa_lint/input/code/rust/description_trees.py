"""Reads Rust that calls Vulkan through ash, vulkanalia, or vulkano as descriptions."""

from __future__ import annotations

import re

from msaa_lint.input.code.core.assumed_values import assuming
from msaa_lint.input.code.parsing import Code, Read, tree
from msaa_lint.input.code.programs import FileSyntax, executed
from msaa_lint.input.code.sample_counts.choices import choices

from .syntax import prepared, unit

_VULKAN = re.compile(r"\b(?:vk|ash|vulkanalia|vulkano|erupt)::|renderpass!")


def file_syntax(code: Code) -> FileSyntax:
    """Returns what is known of a file or of a page's fragments. Raises `Missing` if the grammar is
    not installed.
    """
    code = prepared(code)
    known = unit(code, tree(code).root_node)
    counts = choices(known, code.text) if "ample_counts" in code.text else ()
    return FileSyntax(
        known,
        counts,
        _VULKAN.search(code.text) is not None,
        True,
        False,
        len(code.text),
        language=code.language,
    )


def trees(code: Code) -> list[Read]:
    """Returns the tree of a file or of a page's fragments: one or none. Raises `Missing` if the
    grammar is not installed.
    """
    syntax = file_syntax(code)
    return (
        executed(syntax, code.fragments, assuming(code.assumptions))
        if syntax.fills_structures
        else []
    )

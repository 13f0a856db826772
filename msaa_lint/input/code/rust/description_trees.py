"""Reads Rust that calls Vulkan through ash, vulkanalia, or vulkano as descriptions."""

from __future__ import annotations

import re

from msaa_lint.input.code.core.assumed_values import assuming
from msaa_lint.input.code.core.limits import Work
from msaa_lint.input.code.parsing import Code, Read, tree
from msaa_lint.input.code.vulkan.rust import RustInterpreter
from msaa_lint.input.code.vulkan.tree_writer import DescriptionWriter

from .syntax import prepared, unit

_VULKAN = re.compile(r"\b(?:vk|ash|vulkanalia|vulkano|erupt)::|renderpass!")


def trees(code: Code) -> list[Read]:
    """Returns the tree of a file or of a page's fragments: one or none. Raises `Missing` if the grammar is not installed."""
    if _VULKAN.search(code.text) is None:
        return []
    code = prepared(code)
    interpreter = RustInterpreter(unit(code, tree(code).root_node), code.fragments, Work(len(code.text)))
    assuming(code.assumptions)(interpreter)
    interpreter.run()
    read = DescriptionWriter(interpreter, code.fragments, True).read()
    return [read] if read is not None else []

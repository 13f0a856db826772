"""Reads programs that call Metal as descriptions, in any language."""

from __future__ import annotations

import re

from msaa_lint.core.text.node_builder import mapping
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.assumed_values import Assume, nothing
from msaa_lint.input.code.core.limits import Work
from msaa_lint.input.code.core.terms import Unit
from msaa_lint.input.code.parsing import Code, Read

from .creation import MetalInterpreter
from .tree_writer import DescriptionWriter

_SPEAKS = re.compile(r"MTL|[aA]ttachment|[sS]ampleCount")
_METAL = re.compile(r"\bMTL(?:::|[A-Z])|\bMTKView\b|\bCAMetal")
_APPLE_ONLY = re.compile(
    r"^[ \t]*(?:#[ \t]*|@)?import[ \t]+<?(?:UIKit|ARKit|CompositorServices)\b[^\n]*", re.MULTILINE
)
_OTHERS_TOO = re.compile(
    r"#[ \t]*if|^[ \t]*(?:#[ \t]*|@)?import[ \t]+<?(?:AppKit|Cocoa)\b", re.MULTILINE
)


def calls_metal(code: Code) -> bool:
    """Returns whether code may call Metal."""
    return (_SPEAKS if code.language == "swift" else _METAL).search(code.text) is not None


def platform_of(text: str) -> Span | None:
    """Returns where code states that it runs on Apple GPUs alone, or None."""
    only = _APPLE_ONLY.search(text)
    return (
        Span(only.start(), only.end())
        if only is not None and not _OTHERS_TOO.search(text)
        else None
    )


def metal_reads(
    unit: Unit,
    fragments: bool,
    is_cpp: bool,
    whole: Span,
    platform: Span | None,
    assume: Assume = nothing,
) -> list[Read]:
    """Returns what a program states in Metal's terms: one tree with the section `metal`, or none.
    `assume` states what the user assumes.
    """
    interpreter = MetalInterpreter(unit, fragments, is_cpp, Work(whole.end))
    assume(interpreter)
    interpreter.run()
    if interpreter.unread is not None:
        return [Read(mapping([], Span(0, 0)), unread=(interpreter.unread,))]
    read = DescriptionWriter(interpreter, not fragments, platform).read(whole)
    return [read] if read is not None else []

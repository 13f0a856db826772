"""Node types of the C and C++ grammars, and functions that read single nodes."""

from __future__ import annotations

import re

from msaa_lint.input.code.parsing import SyntaxNode

MAX_DEPTH = 120
"""The maximum nesting of expressions and blocks."""


WORD = re.compile(r"(?<![\w:])[A-Za-z_]\w*")
"""An unqualified identifier."""

BLANKS = re.compile(r"\s+")


NUMBER = re.compile(r"(0[xX][0-9a-fA-F']+|0[bB][01']+|[0-9][0-9']*)[uUlLzZ]*")


REAL = re.compile(r"[0-9']*\.?[0-9']*(?:[eE][-+]?[0-9]+)?[fFlL]?")


NAMES = frozenset({
    "identifier", "field_identifier", "type_identifier", "qualified_identifier", "namespace_identifier", "this", "template_function",
    "primitive_type", "template_type", "template_method", "dependent_name",
})  # fmt: skip


CLASSES = frozenset({"class_specifier", "struct_specifier", "union_specifier"})


CHAIN_TESTS = frozenset({"preproc_if", "preproc_ifdef", "preproc_elif", "preproc_elifdef"})


def function_declarator(node: SyntaxNode) -> tuple[SyntaxNode | None, SyntaxNode | None]:
    """Returns the function declarator of a declaration and the name in it; None if there is none."""
    declarator = node.child_by_field_name("declarator")
    for _ in range(MAX_DEPTH):
        if declarator is None or declarator.type == "function_declarator":
            break
        inner = declarator.child_by_field_name("declarator")
        declarator = inner or next((child for child in declarator.named_children if child.type.endswith("declarator")), None)
    else:
        declarator = None
    return declarator, declarator.child_by_field_name("declarator") if declarator is not None else None


def number(text: str) -> int | float | None:
    match = NUMBER.fullmatch(text)
    if match is not None:
        digits = match[1].replace("'", "")
        try:
            return int(digits, 0) if not (len(digits) > 1 and digits[0] == "0" and digits.isdigit()) else int(digits, 8)
        except ValueError:
            return None
    try:
        return float(text.replace("'", "").rstrip("fFlL")) if REAL.fullmatch(text) else None
    except ValueError:
        return None

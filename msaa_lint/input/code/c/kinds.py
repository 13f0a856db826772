"""Node types of the C and C++ grammars, and numbers."""

from __future__ import annotations

import re

MAX_DEPTH = 120
"""The maximum nesting of expressions and blocks."""

MAX_NAME = 500
"""The maximum length of a name or type; longer ones are unknown."""

WORD = re.compile(r"(?<![\w:])[A-Za-z_]\w*")
"""An unqualified identifier."""

BLANKS = re.compile(r"\s+")

NUMBER = re.compile(r"(0[xX][0-9a-fA-F']+|0[bB][01']+|[0-9][0-9']*)[uUlLzZ]*")

REAL = re.compile(r"[0-9']*\.?[0-9']*(?:[eE][-+]?[0-9]+)?[fFlL]?")

NAMES = frozenset({
    "identifier", "field_identifier", "type_identifier", "qualified_identifier",
    "namespace_identifier", "this", "template_function",
    "primitive_type", "template_type", "template_method", "dependent_name",
})  # fmt: skip

CLASSES = frozenset({"class_specifier", "struct_specifier", "union_specifier"})

BLOCKS = frozenset({
    "compound_statement", "try_statement", "catch_clause", "labeled_statement", "else_clause",
    "ERROR", "preproc_else", "init_statement",
})  # fmt: skip

CHAIN_TESTS = frozenset({"preproc_if", "preproc_ifdef", "preproc_elif", "preproc_elifdef"})


MAX_DIGITS = 100
"""The maximum length of a number; no type of C has longer ones."""


def number(text: str) -> int | float | None:
    """Returns the value of a literal, or None."""
    if len(text) > MAX_DIGITS:
        return None
    if text.isdecimal() and (text[0] != "0" or len(text) == 1):
        return int(text)
    match = NUMBER.fullmatch(text)
    if match is not None:
        digits = match[1].replace("'", "")
        try:
            return int(digits, 8 if digits[0] == "0" and digits.isdigit() else 0)
        except ValueError:
            return None
    try:
        return float(text.replace("'", "").rstrip("fFlL")) if REAL.fullmatch(text) else None
    except ValueError:
        return None

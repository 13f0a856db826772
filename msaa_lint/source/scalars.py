"""Plain scalars by YAML 1.2's core schema: `on` and `no` are texts, `010` is ten."""

from __future__ import annotations

import re

Scalar = str | int | float | bool | None

WORDS: dict[str, Scalar] = {
    "": None, "~": None, "null": None, "Null": None, "NULL": None,
    "true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False,
    ".inf": float("inf"), ".Inf": float("inf"), ".INF": float("inf"),
    "+.inf": float("inf"), "+.Inf": float("inf"), "+.INF": float("inf"),
    "-.inf": float("-inf"), "-.Inf": float("-inf"), "-.INF": float("-inf"),
    ".nan": float("nan"), ".NaN": float("nan"), ".NAN": float("nan"),
}  # fmt: skip

MAX_DIGITS = 40
"""Digits of a whole number: a longer one stays text, as turning it into an integer takes time that grows with its square."""

MAX_FLOAT = 400
"""Characters of a number with a point or an exponent: the longest that C's `%f` writes has 317. A longer one stays text."""

_STARTS = frozenset("0123456789+-.")
_INT = re.compile(rf"[-+]?[0-9]{{1,{MAX_DIGITS}}}")
_OCT = re.compile(rf"0o[0-7]{{1,{MAX_DIGITS}}}")
_HEX = re.compile(rf"0x[0-9a-fA-F]{{1,{MAX_DIGITS}}}")
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+\.[0-9]*|[0-9]+(?=[eE]))(?:[eE][-+]?[0-9]+)?")


def resolve(text: str) -> Scalar:
    """The value of a plain scalar."""
    if text in WORDS:
        return WORDS[text]
    if text[0] not in _STARTS or len(text) > MAX_FLOAT:
        return text
    if _INT.fullmatch(text):
        return int(text)
    if _HEX.fullmatch(text):
        return int(text, 16)
    if _OCT.fullmatch(text):
        return int(text[2:], 8)
    if _FLOAT.fullmatch(text):
        return float(text)
    return text

"""Integer literals and operators of C, C++, and GLSL."""

from __future__ import annotations

import re

from msaa_lint.input.code.core.operators import COMPARISONS

_NUMBER = re.compile(r"([-+]?)(0[xX][0-9a-fA-F]+|0[bB][01]+|[0-9]+)[uUlL]*")


def whole(text: str) -> int | None:
    """Returns the value of an integer literal of up to about 2^32, or None."""
    match = _NUMBER.fullmatch(text)
    if match is None or len(match[2]) > 12:
        return None
    try:
        number = int(match[2], 8 if match[2][0] == "0" and match[2].isdigit() else 0)
    except ValueError:
        return None
    return -number if match[1] == "-" else number


def arithmetic(operator: str, left: int, right: int) -> int | None:
    """Returns the result of an operator on sample counts or bit indices, or None."""
    if operator in ("<<", ">>"):
        return (
            (left << right if operator == "<<" else left >> right)
            if 0 <= right < 32 and 0 <= left < 1 << 32
            else None
        )
    if operator == "/":
        return left // right if right > 0 and left >= 0 else None
    if operator in COMPARISONS:
        return int(COMPARISONS[operator](left, right))
    if operator in ("&&", "||"):
        return int(bool(left and right) if operator == "&&" else bool(left or right))
    if abs(left) >= 1 << 32 or abs(right) >= 1 << 32:
        return None
    return {
        "&": left & right,
        "|": left | right,
        "^": left ^ right,
        "+": left + right,
        "-": left - right,
        "*": left * right,
    }.get(operator)


_TOKENS = re.compile(r"\s*(\d\w*|\?|&&|\|\||[<>=!]=|<<|>>|[-+*/%<>!()&|^])")
_LEVELS = (
    ("||",),
    ("&&",),
    ("|",),
    ("^",),
    ("&",),
    ("==", "!="),
    ("<", ">", "<=", ">="),
    ("<<", ">>"),
    ("+", "-"),
    ("*", "/"),
)
MAX_TOKENS = 60
"""The maximum number of tokens in a preprocessor condition."""


def condition_holds(text: str) -> bool | None:
    """Returns whether a condition of integers holds; None if it is not one, or if it depends on an
    unknown one, written `?`.
    """
    tokens: list[str] = []
    at = 0
    text = text.rstrip()
    while at < len(text):
        match = _TOKENS.match(text, at)
        if match is None or len(tokens) > MAX_TOKENS:
            return None
        tokens.append(match[1])
        at = match.end()
    value, rest = _level(tokens, 0, 0)
    return None if value is None or rest != len(tokens) else value != 0


def _level(tokens: list[str], at: int, level: int) -> tuple[int | None, int]:
    if level == len(_LEVELS):
        return _primary(tokens, at)
    value, at = _level(tokens, at, level + 1)
    while at < len(tokens) and tokens[at] in _LEVELS[level]:
        operator = tokens[at]
        other, at = _level(tokens, at + 1, level + 1)
        value = _combined(operator, value, other)
    return value, at


def _combined(operator: str, left: int | None, right: int | None) -> int | None:
    """Returns the result of an operator; of a logical one, also if it depends on one side alone."""
    if left is not None and right is not None:
        return arithmetic(operator, left, right)
    known = right if left is None else left
    if operator == "&&" and known == 0:
        return 0
    return 1 if operator == "||" and known else None


def _primary(tokens: list[str], at: int) -> tuple[int | None, int]:
    if at >= len(tokens):
        return None, at
    if tokens[at] == "(":
        value, after = _level(tokens, at + 1, 0)
        return (value, after + 1) if after < len(tokens) and tokens[after] == ")" else (None, after)
    if tokens[at] in ("!", "-", "+"):
        value, after = _primary(tokens, at + 1)
        return (
            None
            if value is None
            else int(not value)
            if tokens[at] == "!"
            else -value
            if tokens[at] == "-"
            else value
        ), after
    return whole(tokens[at]), at + 1

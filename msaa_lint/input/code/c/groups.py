"""Groups of preprocessor conditions, from #if to #endif."""

from __future__ import annotations

import re
from typing import NamedTuple

_BLANKED = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)|\\\r?\n", re.DOTALL)
_FIRST_BRACE = re.compile(r"[{}]")
_CUT_START = re.compile(r"\s*(?:\|\|?|&&|[?+/^=<>]|==)")
_CUT_END = re.compile(
    r"(?:(?:^|[;{}]|\belse)\s*(?:if|while|switch)\b[^;{}]*\)|\belse|&&|[|=(?+])\s*\Z"
)
MAX_CUT = 400
"""The number of characters at the ends of a text that tell whether it cuts a statement."""

_NEGATED = re.compile(r"!\s*defined\s*(?:\(\s*(\w+)\s*\)|(\w+))")

Balance = tuple[int, int, int, bool]
"""The open braces, parentheses, and brackets of a text less the closed ones, and whether it closes
a brace that it does not open.
"""


def balance(text: str) -> Balance:
    """Returns the balance of a text without comments and literals."""
    first = _FIRST_BRACE.search(text)
    return (
        text.count("{") - text.count("}"),
        text.count("(") - text.count(")"),
        text.count("[") - text.count("]"),
        first is not None and first[0] == "}",
    )


def cuts_statement(text: str) -> bool:
    """Returns whether a text begins or ends within a statement: with an operator, or after the
    condition of an `if`.
    """
    start, end = _BLANKED.sub(" ", text[:MAX_CUT]), _BLANKED.sub(" ", text[-MAX_CUT:])
    return _CUT_START.match(start) is not None or _CUT_END.search(end) is not None


class Line(NamedTuple):
    """A directive: its range from the `#` on, its word, what follows, and the offset of that."""

    start: int
    end: int
    word: str
    rest: str
    at: int

    @property
    def condition(self) -> str:
        """What follows the word, without comments."""
        return _BLANKED.sub(" ", self.rest).strip()


class Arm:
    """A part of a group: its directive, and whether it exists if no earlier one does; None if that
    is open.
    """

    __slots__ = ("brackets", "exists", "line")

    def __init__(self, line: Line, exists: bool | None) -> None:
        self.line = line
        self.exists = exists
        self.brackets: Balance = (0, 0, 0, False)

    def count(self, more: Balance) -> None:
        """Adds the brackets of a further part of the text."""
        before = self.brackets
        closes = before[3] or (more[3] and before[0] <= 0)
        self.brackets = (before[0] + more[0], before[1] + more[1], before[2] + more[2], closes)


class Group:
    """A group while it is read. `outer` is whether the text around it exists, `depth` the number of
    brackets that are open before it.
    """

    def __init__(self, outer: bool | None, depth: int = 0) -> None:
        self.outer = outer
        self.depth = depth
        self.arms: list[Arm] = []
        self.taken = False
        """Whether an arm is certain to exist if those before it do not, so that those after it do
        not exist.
        """

    def add(self, line: Line, exists: bool | None) -> None:
        """Starts an arm."""
        self.arms.append(Arm(line, exists))
        self.taken = self.taken or exists is True

    def state(self) -> bool | None:
        """Returns whether the text in the current arm exists."""
        arm = self.arms[-1]
        if self.outer is False or arm.exists is False:
            return False
        return (
            True
            if self.outer and arm.exists and not any(item.exists is None for item in self.arms)
            else None
        )

    def default(self) -> str:
        """Returns the name that the current arm is for the absence of, or an empty string."""
        line = self.arms[-1].line
        if len(self.arms) > 1:
            return ""
        match = _NEGATED.fullmatch(line.condition) if line.word == "if" else None
        return (
            line.condition
            if line.word == "ifndef"
            else (match[1] or match[2])
            if match is not None
            else ""
        )

    def is_structural(self) -> bool:
        """Returns whether an arm has brackets that only text outside of it closes, so that the
        grammar cannot read the arms together.
        """
        return any(arm.brackets != (0, 0, 0, False) for arm in self.arms if arm.exists is not False)

"""What all parts of going through a file share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

from msaa_lint.core.text.span import Span

from .names import elements, structure
from .scope import MOST_STEPS, Around, Stop
from .terms import Term, Unit
from .values import Array, Cell, Ref, Struct, Value, copied, one

if TYPE_CHECKING:
    from .calls import Calls


class Machine(ABC):
    """What all parts of going through a file share."""

    unit: Unit
    plus: bool
    """Whether it is C++, where an argument may be a reference."""
    fragments: bool
    """Whether it is pieces of a page, not a whole program."""
    globals: dict[str, Term]
    members: dict[str, dict[str, Term]]
    summary: dict[str, Value]
    """What members hold, by what all functions write to them."""
    overlay: dict[str, Cell]
    """What they hold in the function that is gone through."""
    initial: dict[str, Value]
    """What they held when it began."""
    known: dict[str, Value]
    parts: dict[str, dict[str, None]]
    """By a member, the members of it that are named anywhere."""
    steps: int
    calls: Calls

    @abstractmethod
    def value(self, term: Term, around: Around, kind: str = "") -> Value:
        """What an expression may be. `kind` is the type that it is for, where braces need one."""

    @abstractmethod
    def bare(self, kind: str, name: str, place: Span, indirect: bool, around: Around) -> Value:
        """A variable without a value."""

    def step(self) -> None:
        self.steps += 1
        if self.steps > MOST_STEPS:
            raise Stop

    def taken(self, value: Any, kind: str, name: str) -> Any:
        """A value as a variable has it: structures are copied, and called by the variable's name."""
        value = copied(value)
        if isinstance(value, Struct):
            value.kind = value.kind or structure(kind)
            value.name = name or value.name
        if isinstance(value, Array):
            value.kind = value.kind or elements(kind) or ""
            value.name = name or value.name
        return value

    def aimed(self, value: Any) -> Any:
        """What a pointer points to; anything else is itself."""
        for _ in range(4):
            if not isinstance(value, Ref):
                return value
            value = one(value.cell.writes)
        return value

"""What all parts of following calls share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

from msaa_lint.core.text.span import Span

from .scope import Around
from .terms import Term
from .values import Guards, Made, Struct, Value

if TYPE_CHECKING:
    from .run import Run


class Calling(ABC):
    """What all parts of following calls share."""

    def __init__(self, run: Run) -> None:
        self.run = run
        self.made: dict[tuple[Any, ...], Made] = {}
        self.met: dict[tuple[Any, ...], Made] = {}
        self.born: list[tuple[Struct, Guards]] = []
        self.used: set[int] = set()
        self.resolves: dict[Span, tuple[Value, Value]] = {}
        self.followed: dict[Span, int] = {}

    @abstractmethod
    def object_made(self, kind: str, term: Term, around: Around) -> Value | None:
        """An object of a class of the file's, by its constructor."""

    def begin(self) -> None:
        """Forgets what an earlier turn made, but not which object is which."""
        self.met = {}
        self.born.clear()
        self.used.clear()
        self.resolves.clear()
        self.followed.clear()

"""What all parts of following calls share."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ...finding import Span
from .values import Guards, Made, Struct, Value

if TYPE_CHECKING:
    from .run import Run


class Calling:
    """What all parts of following calls share."""

    def __init__(self, run: Run) -> None:
        self.run = run
        self.made: dict[tuple[Any, ...], Made] = {}
        self.met: dict[tuple[Any, ...], Made] = {}
        self.born: list[tuple[Struct, Guards]] = []
        self.used: set[int] = set()
        self.resolves: dict[Span, tuple[Value, Value]] = {}
        self.followed: dict[Span, int] = {}

    def begin(self) -> None:
        """Forgets what an earlier turn made, but not which object is which."""
        self.met = {}
        self.born.clear()
        self.used.clear()
        self.resolves.clear()
        self.followed.clear()

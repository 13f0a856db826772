"""What functions are gone through in, and how far."""

from __future__ import annotations

from msaa_lint.core.text.span import Span

from .values import Alternative, Cell, Guards

MAX_STEPS = 80_000
"""Terms that are evaluated in one file: with more, the rest of it is not followed."""


MAX_TURNS = 16
"""Turns of a loop over a list, or with a counter, that are gone through one by one."""


MAX_PASSES = 3
"""Times that a file is gone through: what a member holds may come from another, which holds what a third does."""


MEMBER = "member"
"""The kind of a cell that is a member of some object, or a variable outside of functions."""


Scopes = tuple[dict[str, Cell], ...]


MAX_CALLS = 5
"""How deep calls of the file's own functions are followed."""


MAX_WAYS = 4
"""How often one call is followed, by whatever other calls it is come to."""


class StepLimitExceeded(Exception):
    """There is too much of it."""


class Scope:
    """What a function is gone through in: its variables, its class, the calls that lead to it."""

    __slots__ = (
        "active_functions",
        "calls",
        "class_name",
        "guards",
        "iterations",
        "namespace",
        "return_type",
        "return_values",
        "scopes",
        "this_object",
        "unknown_loops",
        "unreachable",
    )

    def __init__(self, class_name: str, scopes: Scopes, guards: Guards, calls: tuple[Span, ...]) -> None:
        self.class_name = class_name
        self.scopes = scopes
        self.guards = guards
        self.calls = calls
        self.return_values: list[Alternative] = []
        self.return_type = ""
        self.namespace = ""
        """The namespace, with `::` at its end."""
        self.unreachable = False
        """Whether what follows is not reached."""
        self.unknown_loops = 0
        self.iterations: tuple[int, ...] = ()
        """Which turns of loops it is in, of those that are gone through one by one."""
        self.this_object: Cell | None = None
        """The object whose method it is, where that is known."""
        self.active_functions: tuple[Span, ...] = ()
        """The functions that are being gone through."""

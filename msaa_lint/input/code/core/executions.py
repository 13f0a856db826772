"""What the entry points of a program do, and which of them do something else once more is known of
the program's members.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Set
from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span

from .limits import Work
from .values import (
    MAX_ALTERNATIVES,
    Alternative,
    ApiObject,
    Array,
    Closure,
    Flags,
    Ref,
    Routine,
    Struct,
    Symbol,
    Value,
    inner_cells,
)

Results = list[dict[Any, Any] | list[Any]]

MAX_DEPTH = 3
"""The depth to which structures are compared."""


class Execution(NamedTuple):
    """What an entry point did: the members whose values it may have used, what it wrote to members,
    and what it added to the results.
    """

    used: Set[str]
    writes: list[tuple[str, Alternative]]
    results: Results


def emptied(results: Results) -> Results:
    """Returns copies of results, which are then empty."""
    copies: Results = [container.copy() for container in results]
    for container in results:
        container.clear()
    return copies


def add(results: Results, more: Results) -> None:
    """Adds results to others of the same kinds."""
    for container, other in zip(results, more, strict=True):
        if isinstance(container, dict) and isinstance(other, dict):
            container.update(other)
        elif isinstance(container, list):
            container.extend(other)


class Summary:
    """What all entry points together write to members."""

    def __init__(self) -> None:
        self.writes: dict[str, dict[tuple[Any, ...], Alternative]] = {}
        self.writers: dict[str, set[Span]] = {}
        """The entry points that write each member."""

    def add(self, entry: Span, writes: Iterable[tuple[str, Alternative]]) -> None:
        for key, write in writes:
            self.writers.setdefault(key, set()).add(entry)
            self.writes.setdefault(key, {}).setdefault(mark(write), write)

    def values(self) -> dict[str, Value]:
        return {key: joined(key, list(writes.values())) for key, writes in self.writes.items()}


def joined(key: str, writes: list[Alternative]) -> Value:
    """Returns the union of what all functions write to a member. Null is ignored if the member is
    assigned an object.
    """
    objects = [write for write in writes if isinstance(write.value, (ApiObject, Struct, Array))]
    union = tuple(objects or writes)
    return (
        union
        if len(union) <= MAX_ALTERNATIVES
        else (Alternative(Symbol(key, key.rpartition("::")[2]), union[0].at),)
    )


def mark(write: Alternative) -> tuple[Any, ...]:
    """Returns what tells a write from others."""
    value = write.value
    if isinstance(value, ApiObject):
        return (value.signature(), write.guards)
    return (
        id(value) if isinstance(value, (Struct, Array, Closure)) else repr(value),
        write.at,
        write.guards,
    )


Known = frozenset[Any]
"""What is known of a member, to be compared with what is known of it after another execution."""

_NOTHING: Known = frozenset({"unknown"})


def contents(summary: Mapping[str, Value], work: Work) -> dict[str, Known]:
    """Returns what is known of members."""
    return {key: _contents(writes, 0, work) for key, writes in summary.items()}


class Seen:
    """What the executions of a program have shown so far."""

    def __init__(self) -> None:
        self._known: dict[str, Known] = {}
        self._parts: dict[str, int] = {}
        self._callables: frozenset[str] = frozenset()

    def news(
        self, known: dict[str, Known], parts: Mapping[str, Collection[str]], callables: Set[str]
    ) -> set[str]:
        """Returns the members of which an execution has shown something else: a value, a member of
        theirs, or that they are functions.
        """
        news = {
            key for key, values in known.items() if not values <= self._known.get(key, _NOTHING)
        }
        news.update(key for key, names in parts.items() if len(names) != self._parts.get(key))
        news.update(map(callable_key, callables - self._callables))
        self._known, self._parts = known, {key: len(names) for key, names in parts.items()}
        self._callables = frozenset(callables)
        return news


def callable_key(name: str) -> str:
    """Returns the key of what is known of the variables and members of a name as functions."""
    return f"{name}()"


def _contents(writes: Value, depth: int, work: Work) -> Known:
    return frozenset(_content(write.value, depth, work) for write in writes) or _NOTHING


def _content(value: Any, depth: int, work: Work) -> Any:
    if isinstance(value, (bool, int, float, str, Flags)) or value is None:
        return (type(value).__name__, value)
    if isinstance(value, ApiObject):
        # What it is created from changes with it.
        return (value.kind, value.at)
    if isinstance(value, (Struct, Array, Ref)) and depth < MAX_DEPTH:
        cells = inner_cells(value)
        work.spend(1 + len(cells))
        return (
            type(value).__name__,
            *(_contents(cell.writes, depth + 1, work) for cell in cells),
            *((value.complete,) if isinstance(value, Array) else ()),
        )
    return (
        type(value).__name__
        if isinstance(value, (Closure, Routine, Struct, Array, Ref))
        else "unknown"
    )

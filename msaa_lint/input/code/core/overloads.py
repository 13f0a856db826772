"""The functions of a C or C++ file by what a call of them states: their name, the number of arguments, their class or namespace."""

from __future__ import annotations

from collections.abc import Iterable

from .terms import Function


class Group:
    """Functions that a call may refer to, in order; `fixed` are those that no derived class may override."""

    __slots__ = ("every", "fixed")

    def __init__(self) -> None:
        self.every: list[Function] = []
        self.fixed: list[Function] = []

    def add(self, function: Function) -> None:
        self.every.append(function)
        if not function.open:
            self.fixed.append(function)

    def sole(self) -> Function | None:
        """Returns the only one that can be followed, or None."""
        return self.fixed[0] if len(self.fixed) == 1 else None


_NONE = Group()


class Overloads:
    """The functions of one file."""

    def __init__(self, functions: Iterable[Function]) -> None:
        self._by_count: dict[tuple[str, int], Group] = {}
        self._by_owner: dict[tuple[str, int, str | None, str | None], Group] = {}
        for function in functions:
            required = sum(parameter.default is None for parameter in function.parameters)
            for count in range(required, len(function.parameters) + 1):
                key = (function.name, count)
                self._by_count.setdefault(key, Group()).add(function)
                self._by_owner.setdefault((*key, function.class_name, None), Group()).add(function)
                if not function.class_name:
                    self._by_owner.setdefault((*key, None, function.namespace), Group()).add(function)

    def of_count(self, name: str, count: int) -> Group:
        """Returns the functions of a name that take a number of arguments."""
        return self._by_count.get((name, count), _NONE)

    def of_class(self, name: str, count: int, class_name: str) -> Group:
        """Returns those of a class; for the empty name, those of no class."""
        return self._by_owner.get((name, count, class_name, None), _NONE)

    def of_scope(self, name: str, count: int, class_name: str, namespace: str) -> Group:
        """Returns those of a class or, if it has none, those of a namespace."""
        return self._by_owner.get((name, count, class_name, None)) or self._by_owner.get((name, count, None, namespace), _NONE)

"""The functions of a C or C++ file by what a call of them states: their name, the number of
arguments, their class or namespace.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from .terms import Function, Parameter, Term, labeled


class Group:
    """Functions that a call may refer to, in order; `fixed` are those that no derived class may
    override.
    """

    __slots__ = ("every", "fixed", "labels")

    def __init__(self) -> None:
        self.every: list[Function] = []
        self.fixed: list[Function] = []
        self.labels = False
        """Whether a parameter has a label."""

    def add(self, function: Function) -> None:
        self.every.append(function)
        self.labels = self.labels or any(parameter.label for parameter in function.parameters)
        if not function.open:
            self.fixed.append(function)

    def of_labels(self, labels: Sequence[str]) -> Group:
        """Returns the functions whose parameters have the labels of a call's arguments."""
        if not self.labels and not any(labels):
            return self
        group = Group()
        for function in self.every:
            if matches(function.parameters, labels):
                group.add(function)
        return group

    def sole(self) -> Function | None:
        """Returns the only one that can be followed, or None."""
        return self.fixed[0] if len(self.fixed) == 1 else None


_NONE = Group()


def matches(parameters: Sequence[Parameter], labels: Sequence[str]) -> bool:
    """Returns whether arguments have the labels of parameters in order. Those with a default may be
    left out; a last argument without a label may be a closure after the call.
    """
    n = 0
    for parameter in parameters:
        if n < len(labels) and (
            labels[n] == parameter.label
            or (not labels[n] and n == len(labels) - 1 and "->" in parameter.type)
        ):
            n += 1
        elif parameter.default is None:
            return False
    return n == len(labels)


def bound(
    parameters: Sequence[Parameter], arguments: Sequence[Term]
) -> Iterator[tuple[Parameter, Term | None]]:
    """Yields parameters with their arguments: by label where parameters have labels, otherwise by
    position.
    """
    names = any(parameter.label for parameter in parameters)
    n = 0
    for parameter in parameters:
        argument = arguments[n] if n < len(arguments) else None
        label, expression = labeled(argument) if argument is not None else ("", None)
        if names and label != parameter.label and (label or "->" not in parameter.type):
            yield parameter, None
            continue
        n += 1
        yield parameter, expression


class Overloads:
    """The functions of one file."""

    def __init__(self, functions: Iterable[Function]) -> None:
        self._by_count: dict[tuple[str, int], Group] = {}
        self.free: dict[str, Function] = {}
        """The functions outside of classes that no other one has the name of."""
        names: dict[str, int] = {}
        self._by_owner: dict[tuple[str, int, str | None, str | None], Group] = {}
        for function in functions:
            if not function.class_name:
                names[function.name] = names.get(function.name, 0) + 1
                self.free[function.name] = function
            required = sum(parameter.default is None for parameter in function.parameters)
            for count in range(required, len(function.parameters) + 1):
                key = (function.name, count)
                self._by_count.setdefault(key, Group()).add(function)
                self._by_owner.setdefault((*key, function.class_name, None), Group()).add(function)
                if not function.class_name:
                    self._by_owner.setdefault((*key, None, function.namespace), Group()).add(
                        function
                    )
        self.free = {name: function for name, function in self.free.items() if names[name] == 1}

    def of_count(self, name: str, count: int) -> Group:
        """Returns the functions of a name that take a number of arguments."""
        return self._by_count.get((name, count), _NONE)

    def of_class(self, name: str, count: int, class_name: str) -> Group:
        """Returns those of a class; for the empty name, those of no class."""
        return self._by_owner.get((name, count, class_name, None), _NONE)

    def of_scope(self, name: str, count: int, class_name: str, namespace: str) -> Group:
        """Returns those of a class or, if it has none, those of a namespace."""
        return self._by_owner.get((name, count, class_name, None)) or self._by_owner.get(
            (name, count, None, namespace), _NONE
        )

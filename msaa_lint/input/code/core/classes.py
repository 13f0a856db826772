"""The classes of a program: their members, what they derive from, and what derives from them."""

from __future__ import annotations

import re
from collections.abc import Iterator

from .aliases import resolved
from .terms import DECLARE, Function, Term, Unit

_POINTER = re.compile(
    r"(?:\w+::)*\w*(?:_ptr|Ptr|Pointer|Ref|RefPtr|Handle|_wrapper|optional|Optional)<([\w:]+)>$"
)
"""Types that stand for an object of another type."""

MAX_BASES = 16
"""The maximum depth of a hierarchy of classes."""


def pointed(type_text: str) -> str:
    """Returns the type that a pointer or reference type refers to; any other type is returned as
    is.
    """
    type_text = type_text.rstrip("*&")
    match = _POINTER.match(type_text)
    return match[1] if match is not None else type_text


class Classes:
    """The classes of a program."""

    def __init__(self, unit: Unit) -> None:
        self.members = {
            name: {term[2]: term for term in terms if term[0] == DECLARE}
            for name, terms in unit.members.items()
        }
        self._aliases = unit.aliases
        self._of_type: dict[tuple[str, str], str | None] = {}
        self._owners: dict[tuple[str, str], str] = {}
        self._names: dict[str, list[str]] = {}
        """The classes by the last part of their names."""
        for name in dict.fromkeys(
            (
                *self.members,
                *unit.bases,
                *(function.class_name for function in unit.functions if function.class_name),
            )
        ):
            self._names.setdefault(name.rpartition("::")[2], []).append(name)
        self._bases = {
            name: tuple(self._base(name, base) for base in bases)
            for name, bases in unit.bases.items()
        }
        self._derived: dict[str, list[str]] = {}
        for name, bases in self._bases.items():
            for base in bases:
                self._derived.setdefault(base, []).append(name)
        self.methods: dict[tuple[str, str], list[Function]] = {}
        """The methods of each class by their names."""
        self.with_methods: set[str] = set()
        for function in unit.functions:
            if function.class_name:
                self.with_methods.add(function.class_name)
                self.methods.setdefault((function.class_name, function.name), []).append(function)

    def _base(self, name: str, base: str) -> str:
        return self.of_type(base.partition("<")[0], name.rpartition("::")[0]) or base

    def of_type(self, kind: str, namespace: str = "") -> str | None:
        """Returns the class that a type refers to, or None."""
        key = (kind, namespace)
        if key not in self._of_type:
            self._of_type[key] = self._find(pointed(resolved(kind, self._aliases)), namespace)
        return self._of_type[key]

    def _find(self, kind: str, namespace: str) -> str | None:
        named = self._names.get(kind.rpartition("::")[2], ())
        if not named and kind.endswith(">"):
            # An instance of a template.
            kind = kind.partition("<")[0]
            named = self._names.get(kind.rpartition("::")[2], ())
        if not named:
            return None
        prefix = namespace.removesuffix("::")
        while True:
            name = f"{prefix}::{kind}" if prefix else kind
            if name in named:
                return name
            if not prefix:
                return named[0] if len(named) == 1 else None
            prefix = prefix.rpartition("::")[0]

    def chain(self, name: str) -> Iterator[str]:
        """Yields a class and the classes that it derives from, each once, the nearest first."""
        level = [name]
        seen = set(level)
        for _ in range(MAX_BASES):
            yield from level
            level = [base for each in level for base in self._bases.get(each, ())]
            level = [base for base in dict.fromkeys(level) if base not in seen]
            seen.update(level)
            if not level:
                return

    def has_bases(self, name: str) -> bool:
        return bool(self._bases.get(name))

    def derived(self, name: str) -> Iterator[str]:
        """Yields the classes that derive from a class."""
        stack = list(self._derived.get(name, ()))
        seen = set(stack)
        while stack:
            each = stack.pop()
            yield each
            fresh = [other for other in self._derived.get(each, ()) if other not in seen]
            seen.update(fresh)
            stack += fresh

    def namespace(self, class_name: str) -> str:
        """Returns the namespace of a class, with a trailing `::`."""
        prefix = class_name.rpartition("::")[0]
        return f"{prefix}::" if prefix else ""

    def owner(self, class_name: str, member: str) -> str:
        """Returns the class that declares a member of a class; the class itself if none does."""
        key = (class_name, member)
        if key not in self._owners:
            self._owners[key] = next(
                (name for name in self.chain(class_name) if member in self.members.get(name, ())),
                class_name,
            )
        return self._owners[key]

    def member(self, class_name: str, member: str) -> Term | None:
        """Returns the declaration of a member of a class or of its bases, or None."""
        return self.members.get(self.owner(class_name, member), {}).get(member)

"""Members of a Metal description with their locations in Swift, and unique names."""

from __future__ import annotations

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import scalar, words
from msaa_lint.core.text.span import Span

from .values import Constant, Field

Entry = tuple[str, Span, Node]

COUNTS = (1, 2, 4, 8, 16, 32, 64)

_USAGES = frozenset({"renderTarget", "shaderRead", "shaderWrite", "pixelFormatView", "shaderAtomic"})


class Names:
    """Unique names; equal names are qualified by their context."""

    def __init__(self) -> None:
        self.of: dict[int, str] = {}
        self.taken: set[str] = set()
        self.numbers: dict[str, int] = {}

    def assign(self, items: list[tuple[object, str, str]]) -> None:
        """Assigns names to items by their own name and context."""
        often: dict[str, int] = {}
        for _, name, _ in items:
            often[name] = often.get(name, 0) + 1
        for item, name, type_name in items:
            unique = f"{type_name}.{name}" if often[name] > 1 and type_name else name
            while unique in self.taken:
                number = self.numbers[unique] = self.numbers.get(unique, 1) + 1
                candidate = f"{unique} {number}"
                if candidate not in self.taken:
                    unique = candidate
            self.taken.add(unique)
            self.of[id(item)] = unique


def type_of(fields: dict[str, Field]) -> object:
    field = fields.get("textureType")
    return field.value.value if field is not None and isinstance(field.value, Constant) else None


def word(name: str, field: Field, allowed: frozenset[str]) -> list[Entry]:
    """Returns a member that has one of some values, or nothing."""
    if isinstance(field.value, Constant) and isinstance(field.value.value, str) and field.value.value in allowed:
        return [(name, field.key, scalar(field.value.value, field.at))]
    return []


def plain(name: str, field: Field) -> list[Entry]:
    """Returns a member that is a positive number, a boolean, or a word, or nothing."""
    value = field.value.value if isinstance(field.value, Constant) else None
    if isinstance(value, str) and value.isidentifier():
        return [(name, field.key, scalar(value, field.at))]
    if isinstance(value, bool) or (isinstance(value, int) and 0 < value < 1 << 31):
        return [(name, field.key, scalar(value, field.at))]
    return []


def usage(field: Field) -> list[Entry]:
    """Returns the stated usage, or nothing. `unknown` is 0, and alone it allows every usage."""
    value = field.value.value if isinstance(field.value, Constant) else None
    usages = (value,) if isinstance(value, str) else value if isinstance(value, tuple) else ()
    named = [word for word in dict.fromkeys(usages) if word != "unknown"]
    if not named or not _USAGES.issuperset(named):
        return []
    return [("usage", field.key, words(named, field.at))]

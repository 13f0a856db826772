"""What Swift's variables hold, as far as a reading of the source can tell, and the objects of Metal among them."""

from __future__ import annotations

from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span

from .terms import Function, Term

Scalar = str | bool | int | float | None | tuple[str, ...]


class Constant(NamedTuple):
    """A value that is known: an enumerant's name, a number, None for nil, the names in an option set."""

    value: Scalar


class Symbol(NamedTuple):
    """A value that only the run knows: what it is called, and whose it is."""

    text: str
    function_name: str


class OneOf(NamedTuple):
    """A value that is not known: one of these enumerants, or something else."""

    names: frozenset[str]


class MetalObject:
    """An object that code builds up or hands on: a descriptor, an attachment, a view, a drawable, an encoder.

    `fields` has what it was given, each with its places and the function that gave it; `complete` says that its beginning is seen, so
    that what it was never given has Metal's default; `loose` that code which is not read may have changed it.
    """

    __slots__ = ("at", "complete", "fields", "kind", "loose", "name", "of", "type_name")

    def __init__(self, kind: str, name: str, at: Span, complete: bool) -> None:
        self.kind = kind
        self.name = name
        self.type_name = ""
        self.at = at
        self.complete = complete
        self.loose = False
        self.fields: dict[str, Field] = {}
        self.of: Any = None


class Texture:
    """A texture: what it is made with, each time that the code makes it; `rank` is the depth of the calls in which it got its name. One
    that is `open` other files may read."""

    __slots__ = ("at", "drawable", "key", "made", "name", "open", "owner", "rank", "type_name")

    def __init__(self, name: str, type_name: str, at: Span) -> None:
        self.name = name
        self.type_name = type_name
        self.at = at
        self.rank = 1 << 30
        self.key: tuple[object, ...] = ()
        self.drawable = False
        self.open = False
        self.owner: MetalObject | None = None
        self.made: list[dict[str, Field]] = []

    @property
    def multisampled(self) -> bool:
        """Whether it is seen to be made with several samples."""
        types = [fields["textureType"].value for fields in self.made if "textureType" in fields]
        return any(isinstance(type_, Constant) and type_.value in MULTISAMPLED_TYPES for type_ in types)


MAX_ITEMS = 32
"""Items of a tuple or a structure that are followed."""


class Aggregate(NamedTuple):
    """A tuple or a structure: its items by label and by index."""

    items: dict[str, Value]


class Code(NamedTuple):
    """A closure in a variable, or a function that is declared in another."""

    term: Term
    function: Function | None = None


class Instance(NamedTuple):
    """An object of a type that the file declares."""

    type: str


class Unknown:
    """Nothing is known."""

    __slots__ = ()


UNKNOWN = Unknown()
NIL = Constant(None)

Value = Constant | Symbol | OneOf | MetalObject | Texture | Aggregate | Code | Instance | Unknown


class Field(NamedTuple):
    """What a member holds; the places of its name and of its value; the function that gave it; whether nothing gave it."""

    value: Value
    key: Span
    at: Span
    by: int = 0
    default: bool = False


MULTISAMPLED_TYPES = frozenset({"type2DMultisample", "type2DMultisampleArray"})


def _is_known(field: Field | None) -> bool:
    return field is not None and isinstance(field.value, Constant)


def join(first: Value, second: Value, name: str = "", optional: bool = False) -> Value:
    """What a variable holds that has one of two values.

    Where a sample count or a texture type is one thing with multisampling and another without, it is what it is with. An `optional` that is
    sometimes nil counts as what it is else.
    """
    if first is second or first == second:
        return first
    if optional and NIL in (first, second):
        return second if first == NIL else first
    if isinstance(first, Constant) and isinstance(second, Constant):
        low = name.lower()
        if "sample" in low or "msaa" in low:
            if first.value == 1 and type(second.value) is int:
                return second
            if second.value == 1 and type(first.value) is int:
                return first
        if first.value in MULTISAMPLED_TYPES and second.value in ("type2D", "type2DArray"):
            return first
        if second.value in MULTISAMPLED_TYPES and first.value in ("type2D", "type2DArray"):
            return second
    if isinstance(first, Texture) and isinstance(second, Texture) and first.multisampled != second.multisampled:
        return first if first.multisampled else second
    if isinstance(first, Symbol) and second == Constant(1):
        return first
    if isinstance(second, Symbol) and first == Constant(1):
        return second
    if isinstance(first, Aggregate) and isinstance(second, Aggregate) and first.items.keys() == second.items.keys():
        return Aggregate({label: join(value, second.items[label], label) for label, value in first.items.items()})
    names = _names(first) | _names(second)
    return OneOf(names) if 0 < len(names) <= MAX_NAMES else UNKNOWN


MAX_NAMES = 8
"""Of enumerants that a value may be."""


def _names(value: Value) -> frozenset[str]:
    if isinstance(value, OneOf):
        return value.names
    return frozenset((value.value,)) if isinstance(value, Constant) and isinstance(value.value, str) else frozenset()


def join_fields(first: dict[str, Field], second: dict[str, Field]) -> dict[str, Field]:
    """What an object has been given that was given the one or the other."""
    fields: dict[str, Field] = {}
    for name in {**first, **second}:
        one, other = first.get(name), second.get(name)
        if one is None or other is None:
            known = one or other
            assert known is not None
            fields[name] = known._replace(value=join(known.value, UNKNOWN))
        else:
            value = join(one.value, other.value, name)
            fields[name] = (other if value == other.value else one)._replace(value=value)
    return fields


Writes = dict[tuple[int, str], tuple[dict[str, Any], Any]]
"""By the variables and the name: what a branch left there."""


class UndoLog:
    """Writes to variables and members that can be taken back, so that both branches of a condition start alike and are then joined.

    Every write costs the same, however much there is.
    """

    def __init__(self) -> None:
        self.writes: list[tuple[dict[str, Any], str, Any]] = []

    def write(self, where: dict[str, Any], name: str, value: Any) -> None:
        self.writes.append((where, name, where.get(name)))
        if value is None:
            where.pop(name, None)
        else:
            where[name] = value

    def mark(self) -> int:
        return len(self.writes)

    def undo(self, mark: int) -> Writes:
        """Takes back what was written since the mark; gives what it was, by place."""
        last: Writes = {}
        while len(self.writes) > mark:
            where, name, before = self.writes.pop()
            last.setdefault((id(where), name), (where, where.get(name)))
            if before is None:
                where.pop(name, None)
            else:
                where[name] = before
        return last

    def join(self, then: Writes, otherwise: Writes) -> None:
        """Writes what is left after one of two branches."""
        for key, (where, _) in {**then, **otherwise}.items():
            name = key[1]
            one = then[key][1] if key in then else where.get(name)
            other = otherwise[key][1] if key in otherwise else where.get(name)
            if one is None and other is None:
                self.write(where, name, None)
            elif isinstance(one, Field) or isinstance(other, Field):
                self.write(where, name, _field(one, other, name))
            else:
                self.write(where, name, join(one or NIL, other or NIL, name, optional=True))

    def redo(self, writes: Writes) -> None:
        """Writes what one branch left."""
        for (_, name), (where, value) in writes.items():
            self.write(where, name, value)


def _field(one: Field | None, other: Field | None, name: str) -> Field:
    if one is None or other is None:
        known = one or other
        assert known is not None
        return known._replace(value=join(known.value, UNKNOWN))
    value = join(one.value, other.value, name)
    return (other if value == other.value else one)._replace(value=value)

"""Values of Swift variables, the Metal objects among them, and the call frames that hold them."""

from __future__ import annotations

from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span

from .terms import Function, Term

Scalar = str | bool | int | float | None | tuple[str, ...]


class Constant(NamedTuple):
    """A known value: the name of an enumerant, a number, None for nil, the names in an option set."""

    value: Scalar


class Symbol(NamedTuple):
    """A value that is known only at run time: its name and context."""

    text: str
    function_name: str


class OneOf(NamedTuple):
    """An unknown value that may be one of these enumerants."""

    names: frozenset[str]


class MetalObject:
    """A Metal object that code creates or uses: a descriptor, attachment, view, drawable, or encoder.

    `fields` are the members that are set, with their locations and the function that set them. `complete` is set if the object is created
    in the file, so that unset members have Metal's defaults; `loose` if external code may have changed it.
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
    """A texture: its members at each creation, and `rank`, the call depth at which it was named.

    An `open` texture can be read by other files.
    """

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
        """Whether it is created with several samples."""
        types = [fields["textureType"].value for fields in self.made if "textureType" in fields]
        return any(isinstance(type_, Constant) and type_.value in MULTISAMPLED_TYPES for type_ in types)


class Aggregate(NamedTuple):
    """A tuple or a structure: its items by label and by index, and the number of values in it."""

    items: dict[str, Value]
    size: int


class Code(NamedTuple):
    """A closure in a variable, or a nested function."""

    term: Term
    function: Function | None = None


class Instance(NamedTuple):
    """An object of a type that the file declares."""

    type: str


class Unknown:
    """An unknown value."""

    __slots__ = ()


UNKNOWN = Unknown()
NIL = Constant(None)

Value = Constant | Symbol | OneOf | MetalObject | Texture | Aggregate | Code | Instance | Unknown


class Field(NamedTuple):
    """The value of a member, the locations of its name and value, the function that set it, and whether it is a default."""

    value: Value
    key: Span
    at: Span
    by: int = 0
    default: bool = False


MULTISAMPLED_TYPES = frozenset({"type2DMultisample", "type2DMultisampleArray"})


class CallFrame:
    """A call frame: its variables, the enclosing frame of a closure, `self`, the call depth, and the call path."""

    __slots__ = ("depth", "enclosing", "function", "locals", "path", "rank", "returned", "self_value", "type_name")

    def __init__(
        self, type_name: str, function: str, rank: int, path: int, enclosing: CallFrame | None = None, self_value: Value | None = None
    ) -> None:
        self.type_name = type_name
        self.function = function
        self.rank = rank
        self.path = path
        self.enclosing = enclosing
        self.self_value = self_value
        self.depth = 0
        self.locals: dict[str, Value] = {}
        self.returned: list[Value] = []

    @property
    def function_name(self) -> str:
        """The name of the function, which qualifies the names in it."""
        return f"{self.type_name}.{self.function}".lstrip(".")

    def find(self, name: str) -> tuple[CallFrame, Value] | None:
        """Returns a variable and the frame that holds it, or None."""
        frame: CallFrame | None = self
        while frame is not None:
            value = frame.locals.get(name)
            if value is not None:
                return frame, value
            frame = frame.enclosing
        return None


class Pass:
    """A render pass when it was encoded: its descriptor and attachments."""

    __slots__ = ("at", "attachments", "complete", "descriptor")

    def __init__(self, descriptor: MetalObject, at: Span, attachments: dict[str, dict[str, Field]], complete: bool) -> None:
        self.descriptor = descriptor
        self.at = at
        self.attachments = attachments
        self.complete = complete


class Pipeline:
    """A pipeline when it was created: its descriptor, name, and state."""

    __slots__ = ("at", "colors", "descriptor", "fields", "name", "passes", "type_name")

    def __init__(
        self, descriptor: MetalObject, at: Span, fields: dict[str, Field], colors: dict[str, dict[str, Field]], type_name: str
    ) -> None:
        self.descriptor = descriptor
        self.at = at
        self.fields = fields
        self.colors = colors
        self.name = descriptor.name
        self.type_name = type_name
        self.passes: list[Pass] = []


def constant_of(field: Field | None) -> Scalar:
    """Returns the value of a member if it is known, or None."""
    return field.value.value if field is not None and isinstance(field.value, Constant) else None


def options(value: str | tuple[str, ...]) -> tuple[str, ...]:
    """Returns the names in an option set, which may be a single name."""
    return value if isinstance(value, tuple) else (value,)


MAX_SIZE = 256
"""The maximum number of values in a tuple or a structure, and of names in an option set; larger ones are unknown."""


def aggregate(items: dict[str, Value]) -> Value:
    """Returns a tuple or a structure."""
    size = 1 + sum(item.size if isinstance(item, Aggregate) else 1 for item in items.values())
    return Aggregate(items, size) if size <= MAX_SIZE else UNKNOWN


def option_set(names: tuple[str, ...]) -> Value:
    """Returns the set of some options."""
    distinct = tuple(dict.fromkeys(names))
    return Constant(distinct) if len(distinct) <= MAX_SIZE else UNKNOWN


def join(first: Value, second: Value, name: str = "", optional: bool = False) -> Value:
    """Returns the value of a variable that has one of two values.

    If a sample count or texture type differs with multisampling, the multisampled value is returned. For `optional`, nil is ignored.
    """
    if first is second or first == second:
        return first
    if optional and NIL in (first, second):
        return second if first == NIL else first
    counts = "sample" in name.lower() or "msaa" in name.lower()
    for one, other in ((first, second), (second, first)):
        if isinstance(one, Constant) and isinstance(other, Constant):
            if counts and one.value == 1 and type(other.value) is int:
                return other
            if one.value in MULTISAMPLED_TYPES and other.value in ("type2D", "type2DArray"):
                return one
        if isinstance(one, Texture) and isinstance(other, Texture) and one.multisampled and not other.multisampled:
            return one
        if isinstance(one, Symbol) and other == Constant(1):
            return one
    if isinstance(first, Aggregate) and isinstance(second, Aggregate) and first.items.keys() == second.items.keys():
        return aggregate({label: join(value, second.items[label], label) for label, value in first.items.items()})
    names = _names(first) | _names(second)
    return OneOf(names) if 0 < len(names) <= MAX_NAMES else UNKNOWN


MAX_NAMES = 8
"""The maximum number of enumerants in `OneOf`."""


def _names(value: Value) -> frozenset[str]:
    if isinstance(value, OneOf):
        return value.names
    return frozenset((value.value,)) if isinstance(value, Constant) and isinstance(value.value, str) else frozenset()


def join_fields(first: dict[str, Field], second: dict[str, Field]) -> dict[str, Field]:
    """Returns the members of an object that has one of two states."""
    return {name: _join_field(first.get(name), second.get(name), name) for name in {**first, **second}}


Writes = dict[tuple[int, str], tuple[dict[str, Any], Any]]
"""The state that a branch left, by variables and name."""


class UndoLog:
    """A log of writes to variables and members.

    Writes can be undone, so that both branches of a condition start from the same state and are then joined. The cost of a write is
    constant.
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
        """Undoes the writes since a mark. Returns what they had written."""
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
        """Writes the joined state of two branches."""
        for key, (where, _) in {**then, **otherwise}.items():
            name = key[1]
            one = then[key][1] if key in then else where.get(name)
            other = otherwise[key][1] if key in otherwise else where.get(name)
            if one is None and other is None:
                self.write(where, name, None)
            elif isinstance(one, Field) or isinstance(other, Field):
                self.write(where, name, _join_field(one, other, name))
            else:
                self.write(where, name, join(one or NIL, other or NIL, name, optional=True))

    def redo(self, writes: Writes) -> None:
        """Repeats the writes of a branch."""
        for (_, name), (where, value) in writes.items():
            self.write(where, name, value)


def _join_field(one: Field | None, other: Field | None, name: str) -> Field:
    if one is None or other is None:
        known = one or other
        assert known is not None
        return known._replace(value=join(known.value, UNKNOWN))
    value = join(one.value, other.value, name)
    return (other if value == other.value else one)._replace(value=value)

"""The state while an entry point is followed: values by id, memory, and the uses of multisampled
images.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce

from . import numbers as op
from .bodies import Body
from .constants import Constants
from .module import Module
from .values import Extreme, Opaque, Pointer, Sum, Value, plain, small, weight

MAX_STEPS = 300_000
"""Instructions followed in the largest modules; smaller modules get fewer."""

UNWRITTEN = Opaque()
"""The value of a variable before anything is stored to it."""


class GivenUp(Exception):
    """The shader needs more steps than are followed, or uses an unsupported feature."""


ImageKey = tuple[int, tuple[Value, ...]]
"""An image: its variable, and the indices into an array of images."""


class Seen:
    """The uses of a multisampled image: the fetched samples, whether others may be fetched, and the
    uses of the values.
    """

    __slots__ = ("always", "queried", "samples", "unknown", "uses")

    def __init__(self) -> None:
        self.samples: set[int] = set()
        self.always: set[int] = set()
        """The samples that are fetched under every condition."""
        self.unknown = False
        self.queried = False
        self.uses: set[tuple[str, frozenset[int]]] = set()


class Site:
    """The uses of one instruction that fetches: the image (None if unknown) and the sample
    operands.
    """

    __slots__ = ("current", "images", "samples", "unknown")

    def __init__(self) -> None:
        self.images: set[ImageKey | None] = set()
        self.samples: list[int] = []
        self.unknown = False
        self.current = False
        """The sample that the invocation shades."""


class State:
    """The state at a place of an entry point."""

    def __init__(self, module: Module, constants: Constants, bodies: dict[int, Body]) -> None:
        self.module = module
        self.words = module.words
        self.constants = constants
        self.bodies = bodies
        self.steps = min(50_000 + len(module.words) // 2, MAX_STEPS)
        self.values: dict[int, Value] = {}
        self.assigned: list[int] = []
        """The ids with values, in the order of assignment."""
        self.memory: dict[int, Value] = {}
        """The values of variables that only this invocation can write."""
        self.holds: dict[int, int] = {}
        """The types of variables."""
        self.guarded = 0
        """The undecided conditions on the path to this place."""
        self.images: dict[ImageKey, Seen] = {}
        self.sites: dict[int, Site] = {}
        self._fetched: list[ImageKey] = []
        self._places: dict[tuple[object, ...], int] = {}
        """The numbers of fetched texels, by image and place."""
        self._known: dict[tuple[object, ...], Opaque] = {}
        self._lengths = {
            identity: length
            for body in bodies.values()
            for identity, length in body.vectors.items()
        }
        """The lengths of the vectors that instructions create."""

    def _take(self, steps: int) -> None:
        self.steps -= steps
        if self.steps < 0:
            raise GivenUp

    def _copy(self, value: Value) -> Value:
        """A value, for whose size steps are taken."""
        if type(value) is tuple or type(value) is Sum or type(value) is Extreme:
            self._take(weight(value) >> 3)
        return value

    def _assign(self, identity: int, value: Value) -> None:
        self.values[identity] = self._copy(value) if small(value) else Opaque((value,))
        self.assigned.append(identity)

    def _value(self, identity: int) -> Value:
        if identity in self.values:
            return self.values[identity]
        if identity in self.constants.values:
            return self.constants.values[identity]
        return (
            Pointer(identity, ())
            if identity in self.module.variables
            else self._same_as("id", identity)
        )

    def _same_as(self, *origin: object) -> Opaque:
        """An unknown value that is equal whenever it is created from the same origin."""
        value = self._known.get(origin)
        if value is None:
            value = self._known[origin] = Opaque()
            value.origin = origin
        return value

    def _kind(self, type_id: int) -> tuple[int, ...]:
        return self.module.types.get(type_id, ())

    def _width(self, type_id: int) -> int:
        """The number of components of a vector; 1 for a scalar, 0 for anything else."""
        kind = self._kind(type_id)
        if kind and kind[0] in (op.TYPE_BOOL, op.TYPE_INT, op.TYPE_FLOAT):
            return 1
        return kind[2] if len(kind) > 2 and kind[0] == op.TYPE_VECTOR and 0 < kind[2] <= 16 else 0

    def _length(self, identity: int, value: Value) -> int:
        """The number of components of a vector; 0 for a scalar."""
        return len(value) if type(value) is tuple else self._lengths.get(identity, 0)

    def _components(self, value: Value, count: int) -> tuple[Value, ...] | None:
        """The parts of a value with a given number of them; None if it does not have that many."""
        if type(value) is tuple:
            return value if len(value) == count else None
        if value is UNWRITTEN:
            return (UNWRITTEN,) * count
        if type(value) is not Opaque:
            return None
        if value.held:
            return tuple(Opaque((value,)) for _ in range(count))
        return tuple(self._same_as("part", value, n) for n in range(count))

    def _escape(self, *values: Value) -> None:
        """Records that values are used in a way that is not followed."""
        waiting = list(values)
        roots: set[int] = set()
        while waiting:
            each = self._copy(waiting.pop())
            if type(each) is tuple:
                waiting.extend(each)
            elif type(each) is Opaque:
                if each.held:
                    self._take(len(each.held))
                    waiting.extend(each.held)
                    each.held = ()
            elif type(each) is Sum:
                for fetched in {term[0] for term in each.terms}:
                    self._used(fetched, "OTHER", ())
            elif type(each) is Extreme:
                sources = {(term[0], term[1]) for term in each.terms}
                for fetched, _ in sources:
                    self._used(
                        fetched,
                        each.kind if len(sources) == 1 else "OTHER",
                        (term[2] for term in each.terms),
                    )
            elif type(each) is Pointer:
                waiting.extend(each.path)
                if each.root in self.memory and each.root not in roots:
                    # A variable may contain a pointer to itself.
                    roots.add(each.root)
                    self._take(1)
                    waiting.append(self.memory[each.root])

    def _used(self, fetched: int, kind: str, samples: Iterable[int]) -> None:
        self.images[self._fetched[fetched]].uses.add((kind, frozenset(samples)))

    def _settled(self, value: Sum) -> Value:
        """Records a sum that averages all samples; the uses of the average do not matter."""
        average = value.average()
        if average is None:
            return value
        fetched, count = average
        self._used(fetched, "AVERAGE", range(count))
        return self._same_as("average", fetched, next(iter(value.terms))[1], count)

    def _loaded(self, pointer: Value) -> Value:
        if not isinstance(pointer, Pointer):
            self._escape(pointer)
            return Opaque()
        if pointer.root not in self.memory:
            variable = self.module.variables.get(pointer.root)
            self._escape(*pointer.path)
            if variable is None or not self._read_only(variable.storage, variable.holds):
                return Opaque()
            return self._same_as("load", pointer.root, tuple(map(keyed, pointer.path)))
        return reduce(self._part, pointer.path, self.memory[pointer.root])

    def _part(self, value: Value, index: Value) -> Value:
        """The part of a composite value at an index."""
        if type(index) is int:
            if type(value) is tuple:
                return value[index] if 0 <= index < len(value) else Opaque()
            if value is UNWRITTEN:
                return value
            if type(value) is Opaque and not value.held:
                return self._same_as("part", value, index)
        self._escape(value, index)
        return Opaque()

    def _read_only(self, storage: int, holds: int) -> bool:
        """Whether a variable has the same value at every read."""
        if storage != op.UNIFORM:
            return storage in op.READ_ONLY
        kind = self._kind(holds)
        inner = kind[1] if len(kind) > 1 and kind[0] == op.TYPE_ARRAY else holds
        return self.module.decoration(inner, op.BUFFER_BLOCK) is None

    def _stored(self, pointer: Value, value: Value) -> None:
        if not isinstance(pointer, Pointer) and self.module.capabilities.isdisjoint(
            op.ANY_POINTERS
        ):
            raise GivenUp
        if not isinstance(pointer, Pointer) or pointer.root not in self.memory:
            self._escape(pointer, value)
            return
        whole = self._put(
            self.memory[pointer.root], pointer.path, value, self.holds.get(pointer.root, 0)
        )
        self.memory[pointer.root] = self._copy(whole) if small(whole) else Opaque((whole,))

    def _put(self, before: Value, path: tuple[Value, ...], value: Value, type_id: int) -> Value:
        """A value with one part replaced."""
        if not path:
            return value
        kind, index = self._kind(type_id), path[0]
        parts = self.constants.parts(kind) if kind else None
        own = self._components(before, len(parts)) if parts is not None else None
        if parts is None or own is None or type(index) is not int or not 0 <= index < len(parts):
            self._escape(index)
            return Opaque((before, value))
        return (
            *own[:index],
            self._put(own[index], path[1:], value, parts[index]),
            *own[index + 1 :],
        )

    def _image(self, value: Value) -> ImageKey | None:
        """The image that a value refers to; None if it is unknown."""
        origin = value.origin if type(value) is Opaque else ()
        return (origin[1], origin[2]) if origin and origin[0] == "load" else None


def met(one: Value, other: Value) -> Value:
    """What two paths agree on. A variable that one of them never wrote has the other's value."""
    if one is other or other is UNWRITTEN:
        return one
    if one is UNWRITTEN:
        return other
    if type(one) is type(other):
        if type(one) is tuple and len(one) == len(other):
            return tuple(met(a, b) for a, b in zip(one, other, strict=True))
        if type(one) is Sum and one.terms == other.terms:
            return one
        if type(one) is Extreme and (one.kind, one.terms) == (other.kind, other.terms):
            return one
        if (plain(one) or type(one) is Pointer) and one == other:
            return one
    return Opaque((one, other))


def keyed(value: Value) -> object:
    """A value as part of a key, in which 1, 1.0 and true differ."""
    if type(value) is tuple:
        return tuple(map(keyed, value))
    return (type(value), value) if plain(value) else value

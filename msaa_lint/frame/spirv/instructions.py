"""Instructions that move values: memory, composites, fetches from images."""

from __future__ import annotations

from functools import reduce

from . import numbers as op
from .arithmetic import Arithmetic
from .state import UNWRITTEN, Seen, Site, keyed
from .values import Opaque, Pointer, Sum, Value

MAX_SAMPLE = 63

QUERIED = 5
"""The assumed result of a query for an image's sample count. No image has it, so a bound by it
differs from a constant.
"""


class Instructions(Arithmetic):
    """The instructions that compute no numbers. Every method for one returns the value of its
    result, None if it has no result.
    """

    def _same(self, at: int, end: int) -> Value:
        return self._value(self.words[at + 3])

    def _variable(self, at: int, end: int) -> Pointer:
        words = self.words
        identity = words[at + 2]
        pointer = self._kind(words[at + 1])
        self.holds[identity] = pointer[2] if len(pointer) > 2 else 0
        self.memory[identity] = (
            self.constants.values.get(words[at + 4], UNWRITTEN) if end > at + 4 else UNWRITTEN
        )
        return Pointer(identity, ())

    def _chain(self, at: int, end: int) -> Value:
        base, *indices = (self._value(each) for each in self.words[at + 3 : end])
        path = tuple(map(self._index, indices))
        if isinstance(base, Pointer) and len(base.path) + len(path) <= 16:
            return Pointer(base.root, (*base.path, *path))
        self._escape(base)
        return Opaque()

    def _index(self, value: Value) -> Value:
        """A value as an index: a number, or unknown."""
        if type(value) is int or (type(value) is Opaque and not value.held):
            return value
        self._escape(value)
        return Opaque()

    def _load(self, at: int, end: int) -> Value:
        return self._loaded(self._value(self.words[at + 3]))

    def _store(self, at: int, end: int) -> None:
        self._stored(self._value(self.words[at + 1]), self._value(self.words[at + 2]))

    def _copy_memory(self, at: int, end: int) -> None:
        self._stored(self._value(self.words[at + 1]), self._loaded(self._value(self.words[at + 2])))

    def _construct(self, at: int, end: int) -> tuple[Value, ...]:
        words = self.words
        parts: list[Value] = []
        kind = self._kind(words[at + 1])
        for each in words[at + 3 : end]:
            value = self._value(each)
            length = self._length(each, value) if kind and kind[0] == op.TYPE_VECTOR else 0
            inner = self._components(value, length) if length else None
            parts.extend((value,) if inner is None else inner)
        return tuple(parts)

    def _extract(self, at: int, end: int) -> Value:
        return reduce(self._part, self.words[at + 4 : end], self._value(self.words[at + 3]))

    def _insert(self, at: int, end: int) -> Value:
        words = self.words
        return self._put(
            self._value(words[at + 4]),
            tuple(words[at + 5 : end]),
            self._value(words[at + 3]),
            words[at + 1],
        )

    def _shuffle(self, at: int, end: int) -> tuple[Value, ...]:
        words = self.words
        both: list[Value] = []
        for each in words[at + 3 : at + 5]:
            value = self._value(each)
            parts = self._components(value, self._length(each, value))
            if parts is None:
                self._escape(value)
                parts = (Opaque(),) * self._lengths.get(each, 4)
            both.extend(parts)
        return tuple(
            both[index] if index < len(both) else Opaque() for index in words[at + 5 : end]
        )

    def _fetch(self, at: int, end: int) -> Value:
        words = self.words
        number = words[at] & 0xFFFF
        image, place = self._value(words[at + 3]), self._value(words[at + 4])
        mask = words[at + 5] if end > at + 5 else 0
        operand = at + 6 + sum(1 + (bit == 4) for bit in (1, 2, 4, 8, 16, 32) if mask & bit)
        operands = [self._value(each) for each in words[at + 6 : end]]
        self._escape(place, *operands)
        if not mask & op.SAMPLE_OPERAND or operand >= end:
            self._escape(image)
            return Opaque()
        site = self.sites.setdefault(at, Site())
        key = self._image(image)
        site.images.add(key)
        sample = self._value(words[operand])
        known = type(sample) is int and 0 <= sample <= MAX_SAMPLE
        if known:
            site.samples.append(sample)
        elif self._is_current(sample):
            site.current = True
        else:
            site.unknown = True
        if key is None:
            return Opaque()
        seen = self.images.setdefault(key, Seen())
        if not known:
            seen.unknown = True
            return Opaque()
        seen.samples.add(sample)
        if not self.guarded:
            seen.always.add(sample)
        # Offsets are part of the place; the sample is not.
        before = tuple(map(keyed, operands[: operand - at - 6]))
        fetched = self._places.setdefault((key, keyed(place), before), len(self._fetched))
        if fetched == len(self._fetched):
            self._fetched.append(key)
        kind = self._kind(words[at + 1])
        sparse = number in (op.SPARSE_FETCH, op.SPARSE_READ)
        width = self._width(kind[2] if sparse and len(kind) > 2 else words[at + 1])
        parts = tuple(Sum({(fetched, part, sample): 1.0}) for part in range(width))
        value: Value = parts if width > 1 else parts[0] if width else Opaque()
        if not width:
            self._used(fetched, "OTHER", ())
        return (Opaque(), value) if sparse else value

    def _is_current(self, value: Value) -> bool:
        """Whether a value is SampleId."""
        origin = value.origin if type(value) is Opaque else ()
        return (
            len(origin) == 3
            and origin[0] == "load"
            and self.module.decoration(origin[1], op.BUILT_IN) == op.SAMPLE_ID
        )

    def _query(self, at: int, end: int) -> Value:
        key = self._image(self._value(self.words[at + 3]))
        if key is None:
            return Opaque()
        self.images.setdefault(key, Seen()).queried = True
        return QUERIED

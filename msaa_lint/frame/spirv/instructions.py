"""Instructions that move values: memory, composites, fetches from images."""

from __future__ import annotations

from . import numbers as op
from .arithmetic import Arithmetic
from .state import UNWRITTEN, Seen, Site, keyed
from .values import Opaque, Pointer, Sum, Value

MAX_SAMPLE = 63

QUERIED = 5
"""The assumed result of a query for an image's sample count. No image has it, so a bound by it differs from a constant."""


class Instructions(Arithmetic):
    """The instructions that compute no numbers."""

    def _same(self, at: int, end: int) -> None:
        self._assign(self.words[at + 2], self._value(self.words[at + 3]))

    def _variable(self, at: int, end: int) -> None:
        words = self.words
        identity = words[at + 2]
        pointer = self._kind(words[at + 1])
        self.holds[identity] = pointer[2] if len(pointer) > 2 else 0
        initial = self.constants.values.get(words[at + 4]) if end > at + 4 else None
        self.memory[identity] = UNWRITTEN if initial is None else initial
        self._assign(identity, Pointer(identity, ()))

    def _chain(self, at: int, end: int) -> None:
        words = self.words
        base = self._value(words[at + 3])
        indices = [self._index(self._value(each)) for each in words[at + 4 : end]]
        if isinstance(base, Pointer) and len(base.path) + len(indices) <= 16:
            self._assign(words[at + 2], Pointer(base.root, (*base.path, *indices)))
        else:
            self._escape(base)
            self._assign(words[at + 2], Opaque())

    def _index(self, value: Value) -> Value:
        """A value as an index: a number, or unknown."""
        if type(value) is int or (type(value) is Opaque and not value.held):
            return value
        self._escape(value)
        return Opaque()

    def _load(self, at: int, end: int) -> None:
        self._assign(self.words[at + 2], self._loaded(self._value(self.words[at + 3])))

    def _store(self, at: int, end: int) -> None:
        self._stored(self._value(self.words[at + 1]), self._value(self.words[at + 2]))

    def _copy_memory(self, at: int, end: int) -> None:
        self._stored(self._value(self.words[at + 1]), self._loaded(self._value(self.words[at + 2])))

    def _construct(self, at: int, end: int) -> None:
        words = self.words
        parts: list[Value] = []
        kind = self._kind(words[at + 1])
        for each in words[at + 3 : end]:
            value = self._value(each)
            length = self._length(each, value) if kind and kind[0] == op.TYPE_VECTOR else 0
            inner = self._components(value, length) if length else None
            parts.extend((value,) if inner is None else inner)
        self._assign(words[at + 2], tuple(parts))

    def _extract(self, at: int, end: int) -> None:
        words = self.words
        value = self._value(words[at + 3])
        for index in words[at + 4 : end]:
            if type(value) is tuple:
                value = value[index] if index < len(value) else Opaque()
            elif type(value) is Opaque and not value.held and value is not UNWRITTEN:
                value = self._same_as("part", value, index)
            elif value is not UNWRITTEN:
                self._escape(value)
                value = Opaque()
        self._assign(words[at + 2], value)

    def _insert(self, at: int, end: int) -> None:
        words = self.words
        part, whole = self._value(words[at + 3]), self._value(words[at + 4])
        self._assign(words[at + 2], self._put(whole, tuple(words[at + 5 : end]), part, words[at + 1]))

    def _shuffle(self, at: int, end: int) -> None:
        words = self.words
        both: list[Value] = []
        for each in words[at + 3 : at + 5]:
            value = self._value(each)
            own = self._components(value, self._length(each, value))
            if own is None:
                self._escape(value)
                own = (Opaque(),) * self._lengths.get(each, 4)
            both.extend(own)
        self._assign(words[at + 2], tuple(both[index] if index < len(both) else Opaque() for index in words[at + 5 : end]))

    def _fetch(self, at: int, end: int) -> None:
        words = self.words
        number = words[at] & 0xFFFF
        image, place = self._value(words[at + 3]), self._value(words[at + 4])
        mask = words[at + 5] if end > at + 5 else 0
        operand = at + 6 + sum(1 + (bit == 4) for bit in (1, 2, 4, 8, 16, 32) if mask & bit)
        given = [self._value(each) for each in words[at + 6 : end]]
        for value in (place, *given):
            self._escape(value)
        if not mask & op.SAMPLE_OPERAND or operand >= end:
            self._escape(image)
            self._assign(words[at + 2], Opaque())
            return
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
            self._assign(words[at + 2], Opaque())
            return
        seen = self.images.setdefault(key, Seen())
        if not known:
            seen.unknown = True
            self._assign(words[at + 2], Opaque())
            return
        seen.samples.add(sample)
        if not self.guarded:
            seen.always.add(sample)
        # Offsets are part of the place; the sample is not.
        before = tuple(keyed(value) for value in given[: operand - at - 6])
        fetched = self._places.setdefault((key, keyed(place), before), len(self._fetched))
        if fetched == len(self._fetched):
            self._fetched.append(key)
        kind = self._kind(words[at + 1])
        sparse = number in (op.SPARSE_FETCH, op.SPARSE_READ)
        texel = kind[2] if sparse and len(kind) > 2 else words[at + 1]
        width = self._width(texel)
        parts: Value = tuple(Sum({(fetched, part, sample): 1.0}) for part in range(width))
        value = parts if width > 1 else parts[0] if width else Opaque()
        if not width:
            self._used(fetched, "OTHER", ())
        self._assign(words[at + 2], (Opaque(), value) if sparse else value)

    def _is_current(self, value: Value) -> bool:
        """Whether a value is SampleId."""
        origin = value.origin if type(value) is Opaque else ()
        return len(origin) == 3 and origin[0] == "load" and self.module.decoration(origin[1], op.BUILT_IN) == op.SAMPLE_ID

    def _query(self, at: int, end: int) -> None:
        words = self.words
        key = self._image(self._value(words[at + 3]))
        if key is not None:
            self.images.setdefault(key, Seen()).queried = True
        self._assign(words[at + 2], QUERIED if key is not None else Opaque())

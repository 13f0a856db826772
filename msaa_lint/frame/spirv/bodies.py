"""The functions that an entry point reaches: their blocks, the variables they refer to, and where
they write.
"""

from __future__ import annotations

from bisect import bisect_left
from operator import itemgetter
from typing import NamedTuple

from . import numbers as op
from .module import Function, Module
from .words import SpirvError

ANYWHERE = 0
"""In place of a variable: the one that is written is unknown."""

GLOBALS = -1
"""In place of a variable: a call writes any of those declared outside of functions."""


class Block(NamedTuple):
    """A block: its first instruction, and the labels that its merge instruction names (None if it
    has none).
    """

    start: int
    merge: int | None
    continues: int | None


class Body:
    """A reached function. `writes` has pairs of a place and the variables written there, in the
    order of places.
    """

    __slots__ = (
        "blocks",
        "calls",
        "discards",
        "fetches",
        "first",
        "function",
        "locals",
        "uses",
        "vectors",
        "writes",
    )

    def __init__(self, function: Function) -> None:
        self.function = function
        self.first = 0
        """The label of the first block."""
        self.blocks: dict[int, Block] = {}
        self.calls: list[tuple[int, int]] = []
        self.fetches: list[int] = []
        """The places where samples are fetched, or a function that fetches them is called."""
        self.writes: list[tuple[int, int]] = []
        self.uses: dict[int, set[int | None]] = {}
        """By pointer: the members that are referred to, as the ids of their indices; None for all
        of them.
        """
        self.locals: set[int] = set()
        self.vectors: dict[int, int] = {}
        """The lengths of the vectors that the instructions create."""
        self.discards = False

    def written(self, start: int, end: int) -> set[int]:
        """The variables that are written between two places."""
        first, last = (bisect_left(self.writes, place, key=itemgetter(0)) for place in (start, end))
        return {root for _, root in self.writes[first:last]}

    def fetching(self, start: int, end: int) -> bool:
        """Whether samples are fetched, directly or by a call, between two places."""
        return bisect_left(self.fetches, start) < bisect_left(self.fetches, end)


MAX_WORDS = 0xFFFF
"""Words of an instruction."""

_LEAST = {
    op.EXT_INST: 5, op.FUNCTION_CALL: 4, op.VARIABLE: 4, op.IMAGE_TEXEL_POINTER: 6, op.LOAD: 4,
    op.STORE: 3, op.COPY_MEMORY: 3,
    op.ACCESS_CHAIN: 4, op.IN_BOUNDS_ACCESS_CHAIN: 4, op.PTR_ACCESS_CHAIN: 5, op.VECTOR_SHUFFLE: 5,
    op.COMPOSITE_CONSTRUCT: 3,
    op.COMPOSITE_EXTRACT: 4, op.COMPOSITE_INSERT: 5, op.COPY_OBJECT: 4, op.COPY_LOGICAL: 4,
    op.SAMPLED_IMAGE: 5, op.IMAGE_FETCH: 5,
    op.IMAGE_READ: 5, op.SPARSE_FETCH: 5, op.SPARSE_READ: 5, op.IMAGE: 4,
    op.IMAGE_QUERY_SAMPLES: 4, op.PHI: 3, op.LOOP_MERGE: 4,
    op.SELECTION_MERGE: 3, op.LABEL: 2, op.BRANCH: 2, op.BRANCH_CONDITIONAL: 4, op.SWITCH: 3,
    op.RETURN_VALUE: 2,
    115: 4, 127: 4, 129: 5, 131: 5, 133: 5, 136: 5, 142: 5, 169: 6,
}  # fmt: skip
"""The minimum number of words of instructions in functions."""

_USED = {
    op.LOAD: (3, 4), op.STORE: (1, 3), op.FUNCTION_CALL: (4, MAX_WORDS), op.EXT_INST: (5,
    MAX_WORDS), op.COPY_OBJECT: (3, 4),
    op.COPY_MEMORY: (1, 3), op.IMAGE_TEXEL_POINTER: (3, 4),
}  # fmt: skip
"""The words (first and end) of instructions that may be pointers to variables that are used as a
whole.
"""

_CHAINS = (op.ACCESS_CHAIN, op.IN_BOUNDS_ACCESS_CHAIN, op.PTR_ACCESS_CHAIN)

_NOTED = frozenset({
    op.LABEL, op.STORE, op.SELECTION_MERGE, op.LOOP_MERGE, op.FUNCTION_CALL, op.VARIABLE,
    op.EXT_INST, op.COPY_OBJECT, op.COPY_MEMORY,
    *_CHAINS, *op.FETCHES, *op.DISCARDS,
})  # fmt: skip
"""The instructions that the analysis of bodies records beyond such uses."""


def reached(module: Module, start: int) -> dict[int, Body]:
    """A function and those that it calls, directly or indirectly. Raises SpirvError if one is
    missing or truncated.
    """
    found: dict[int, Body] = {}
    waiting = [start]
    lengths = {
        each: kind[2]
        for each, kind in module.types.items()
        if kind[0] == op.TYPE_VECTOR and len(kind) > 2 and kind[2] <= 16
    }
    while waiting:
        identity = waiting.pop()
        if identity in found:
            continue
        function = module.functions.get(identity)
        if function is None:
            raise SpirvError("not SPIR-V: a function that is called is not there")
        found[identity] = _body(module, function, lengths)
        waiting.extend(target for _, target in found[identity].calls)
    fetching = {identity for identity, body in found.items() if body.fetches}
    callers: dict[int, set[int]] = {}
    for identity, body in found.items():
        for _, target in body.calls:
            callers.setdefault(target, set()).add(identity)
    waiting = list(fetching)
    while waiting:
        new = callers.get(waiting.pop(), set()) - fetching
        fetching |= new
        waiting.extend(new)
    for body in found.values():
        body.fetches = sorted(
            [*body.fetches, *(at for at, target in body.calls if target in fetching)]
        )
    return found


def _body(module: Module, function: Function, lengths: dict[int, int]) -> Body:
    words, at, end = module.words, function.start, function.end
    body = Body(function)
    roots: dict[int, int] = {}
    label = start = 0
    merge: int | None = None
    continues: int | None = None
    while at < end:
        first = words[at]
        length, number = first >> 16, first & 0xFFFF
        if length < _LEAST.get(number, 1):
            raise SpirvError("not SPIR-V: an instruction is too short")
        after = at + length
        if length > 2 and words[at + 1] in lengths:
            body.vectors[words[at + 2]] = lengths[words[at + 1]]
        if number in _USED:
            begin, limit = _USED[number]
            for pointer in words[at + begin : min(at + limit, after)]:
                body.uses.setdefault(pointer, set()).add(None)
        if number not in _NOTED:
            at = after
            continue
        if number == op.LABEL:
            if label:
                body.blocks[label] = Block(start, merge, continues)
            label, start, merge, continues = words[at + 1], after, None, None
            body.first = body.first or label
        elif number in (op.STORE, op.COPY_MEMORY):
            root = words[at + 1]
            body.writes.append((at, roots.get(root, root)))
        elif number in _CHAINS:
            base = words[at + 3]
            roots[words[at + 2]] = roots.get(base, base)
            body.uses.setdefault(base, set()).add(
                words[at + 4] if after > at + 4 and number != op.PTR_ACCESS_CHAIN else None
            )
        elif number == op.SELECTION_MERGE:
            merge, continues = words[at + 1], None
        elif number == op.LOOP_MERGE:
            merge, continues = words[at + 1], words[at + 2]
        elif number == op.FUNCTION_CALL:
            body.calls.append((at, words[at + 3]))
            body.writes.append((at, GLOBALS))
            body.writes.extend((at, roots.get(each, each)) for each in words[at + 4 : after])
        elif number == op.VARIABLE:
            body.locals.add(words[at + 2])
        elif number in op.FETCHES:
            if length > 6 and words[at + 5] & op.SAMPLE_OPERAND:
                body.fetches.append(at)
        elif number in op.DISCARDS:
            body.discards = True
        elif number == op.EXT_INST:
            # Modf and Frexp write to their last operand.
            if words[at + 4] in (35, 51) and after > at + 5:
                root = words[after - 1]
                body.writes.append((at, roots.get(root, root)))
        elif number == op.COPY_OBJECT:
            roots[words[at + 2]] = roots.get(words[at + 3], words[at + 3])
        at = after
    if label:
        body.blocks[label] = Block(start, merge, continues)
    return body

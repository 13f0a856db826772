"""Follows an entry point from block to block: the samples of multisampled images that it fetches,
their uses, and its outputs.

Conditions and loops that constants decide are followed as a GPU would; of others every way is
followed, and what they disagree on is unknown. It takes a bounded number of steps; a shader that
takes more is given up.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import reduce
from typing import NamedTuple

from . import numbers as op
from .bodies import ANYWHERE, GLOBALS, Block, Body
from .constants import Constants
from .instructions import Instructions
from .module import Module
from .state import UNWRITTEN, GivenUp, met
from .values import Opaque, Pointer, Value, plain

MAX_NESTED = 100
"""Levels of nested constructs and calls."""

MAX_ROUNDS, MAX_IDLE_ROUNDS = 128, 16
"""Iterations of a loop with constant bounds, if it fetches samples and if not; after them, what it
changes is unknown.
"""

MAX_DOUBTFUL = 16
"""Iterations of a loop that fetches and may end after any of them; in practice no image has more
samples.
"""

RETURNED = 0
"""In place of a label: the function returns."""

_ENDS = frozenset(
    {
        op.BRANCH,
        op.BRANCH_CONDITIONAL,
        op.SWITCH,
        op.RETURN,
        op.RETURN_VALUE,
        *op.DEAD_ENDS,
        op.FUNCTION_END,
        op.COPY_MEMORY_SIZED,
    }
)
"""Instructions that end a block, and those after which nothing is followed."""

_SILENT = frozenset({0, 8, op.LABEL, op.PHI, op.SELECTION_MERGE, op.LOOP_MERGE, 317, op.DEMOTE})
"""Instructions without an effect here: no-ops, lines, merges, and phis, whose values are known
already.
"""


class _Ended(Exception):
    """Nothing follows, as a call does not return."""


class Exit(NamedTuple):
    """An exit of a construct: its label, the memory, the values for the label's phis, and the
    returned value.
    """

    label: int
    memory: dict[int, Value]
    phis: tuple[tuple[int, Value], ...]
    value: Value = None


class Follower(Instructions):
    """Follows one entry point, once."""

    def __init__(self, module: Module, constants: Constants, bodies: dict[int, Body]) -> None:
        super().__init__(module, constants, bodies)
        self._calling: list[int] = []
        self._nested = 0

    def follow(self, function: int) -> dict[int, Value] | None:
        """The values of variables where the entry point returns; None if it never does. Raises
        GivenUp if they cannot be found.
        """
        for identity, variable in self.module.variables.items():
            if variable.storage in op.LOCAL:
                self.holds[identity] = variable.holds
                self.memory[identity] = self.constants.values.get(variable.initial, UNWRITTEN)
        exits = self._function(function, ())
        if not exits:
            return None
        self._resume(exits)
        for identity, variable in self.module.variables.items():
            if variable.storage == op.OUTPUT:
                self._escape(self.memory[identity])
        return self.memory

    def _function(self, identity: int, passed: Sequence[Value]) -> list[Exit]:
        if identity in self._calling or len(self._calling) > MAX_NESTED:
            raise GivenUp
        body = self.bodies[identity]
        for parameter, value in zip(body.function.parameters, passed, strict=False):
            self._assign(parameter, value)
        self._calling.append(identity)
        exits = self._run(body, body.first, frozenset())
        self._calling.pop()
        return [exit for exit in exits if exit.label == RETURNED]

    def _call(self, at: int, end: int) -> Value:
        words = self.words
        identity = words[at + 3]
        if identity not in self.bodies:
            raise GivenUp
        exits = self._function(identity, [self._value(each) for each in words[at + 4 : end]])
        if not exits:
            raise _Ended
        self._resume(exits)
        value = reduce(met, (exit.value for exit in exits))
        for root in self.bodies[identity].locals:
            self.memory.pop(root, None)
        return Opaque() if value is None else value

    def _run(self, body: Body, label: int, stops: frozenset[int], header: int = 0) -> list[Exit]:
        """Follows from a label, whose phis have values, to the labels that stop it. `header` is
        that of the loop being iterated.
        """
        self._nested += 1
        if self._nested > MAX_NESTED:
            raise GivenUp
        guarded = self.guarded
        exits = self._path(body, label, stops, header)
        self.guarded = guarded
        self._nested -= 1
        return exits

    def _path(self, body: Body, label: int, stops: frozenset[int], header: int) -> list[Exit]:
        exits: list[Exit] = []
        while True:
            block = body.blocks.get(label)
            if block is None:
                raise GivenUp
            if block.continues is not None and label != header:
                merge, conditional = block.merge, False
                left = self._loop(body, label, block, stops)
            else:
                try:
                    at = self._execute(block.start, body.function.end)
                except _Ended:
                    return exits
                targets = self._targets(at, exits)
                if not targets:
                    return exits
                if len(targets) == 1:
                    if not self._go(body, label, targets[0], stops, exits):
                        return exits
                    label, header = targets[0], 0
                    continue
                merge = block.merge if block.continues is None else None
                left = self._ways(body, label, targets, stops if merge is None else stops | {merge})
                # If one branch leaves the construct, the rest is reached conditionally.
                conditional = any(exit.label != merge for exit in left)
            arrived = [exit for exit in left if exit.label == merge]
            if merge is None or merge in stops or not arrived:
                return exits + left
            exits += [exit for exit in left if exit.label != merge]
            self._resume(arrived)
            self.guarded += conditional
            label, header = merge, 0

    def _ways(
        self, body: Body, label: int, targets: Sequence[int], stops: frozenset[int]
    ) -> list[Exit]:
        """Follows every target of an undecided branch."""
        before = self.memory
        exits: list[Exit] = []
        self.guarded += 1
        for target in targets:
            self._take(1 + (len(before) >> 3))
            self.memory = dict(before)
            if self._go(body, label, target, stops, exits):
                exits += self._run(body, target, stops)
        self.guarded -= 1
        return exits

    def _loop(self, body: Body, label: int, block: Block, stops: frozenset[int]) -> list[Exit]:
        """Follows the iterations of a loop to its exits."""
        merge, continues = block.merge, block.continues
        assert merge is not None and continues is not None
        begin, end = block.start, body.blocks[merge].start if merge in body.blocks else 0
        self._take(len(self.memory) >> 3)
        begun, before = len(self.assigned), dict(self.memory)
        fetching = body.fetching(begin, end)
        left: list[Exit] = []
        rounds = doubtful = 0
        widened = False
        while True:
            exits = self._run(body, label, stops | {merge, continues, label}, label)
            again = [exit for exit in exits if exit.label == continues]
            if again and continues != label:
                exits = [exit for exit in exits if exit.label != continues]
                self._resume(again)
                exits += self._run(body, continues, stops | {merge, label})
            back = [exit for exit in exits if exit.label == label]
            out = [exit for exit in exits if exit.label != label]
            left += out
            if not back:
                break
            self._resume(back)
            rounds += 1
            doubtful += bool(out)
            self.guarded += bool(out)
            if widened:
                self._forget(body, label, begin, end, before, True)
                break
            if doubtful > (MAX_DOUBTFUL if fetching else 0) or rounds >= (
                MAX_ROUNDS if fetching else MAX_IDLE_ROUNDS
            ):
                widened = True
                self._forget(body, label, begin, end, before, False)
        self.guarded -= doubtful
        if doubtful or len(left) > 1:
            self._take((len(self.assigned) - begun) >> 3)
            # Values from one iteration are not those of the last one.
            for identity in set(self.assigned[begun:]):
                self.values[identity] = Opaque((self.values[identity],))
        return left

    def _forget(
        self, body: Body, label: int, begin: int, end: int, before: dict[int, Value], used: bool
    ) -> None:
        """Forgets what a loop may change before an iteration; `used` marks the present values as
        used.
        """
        self._take(len(self.memory) >> 3)
        roots = {root for root, value in self.memory.items() if before.get(root) is not value}
        for root in body.written(begin, end) if end > begin else {ANYWHERE}:
            pointer = self.values.get(root)
            roots.add(pointer.root if isinstance(pointer, Pointer) else root)
        self._take(len(roots) >> 3)
        if GLOBALS in roots:
            self._take(len(self.module.variables) >> 3)
            roots.update(self.module.variables)
        unknown = ANYWHERE in roots or any(
            root > 0 and root not in self.memory and root not in self.module.variables
            for root in roots
        )
        for root in (
            list(self.memory) if unknown else [root for root in roots if root in self.memory]
        ):
            if used:
                self._escape(self.memory[root])
            self.memory[root] = Opaque((self.memory[root],))
        for identity, _ in self._phis(body, label, 0):
            value = self.values.get(identity)
            if used:
                self._escape(value)
            self._assign(identity, Opaque((value,)))

    def _targets(self, at: int, exits: list[Exit]) -> list[int]:
        """The labels that a block branches to; none if the function ends there."""
        words = self.words
        number, end = words[at] & 0xFFFF, at + (words[at] >> 16)
        if number == op.BRANCH:
            return [words[at + 1]]
        if number == op.BRANCH_CONDITIONAL:
            condition = self._value(words[at + 1])
            if plain(condition):
                return [words[at + 2] if condition else words[at + 3]]
            self._escape(condition)
            return list(dict.fromkeys(words[at + 2 : at + 4]))
        if number == op.SWITCH:
            if op.INT64 in self.module.capabilities:
                # Literals may have two words.
                raise GivenUp
            selector = self._value(words[at + 1])
            pairs = list(zip(words[at + 3 : end : 2], words[at + 4 : end : 2], strict=False))
            if plain(selector):
                wanted = int(selector) & 0xFFFFFFFF
                return [
                    next((label for literal, label in pairs if literal == wanted), words[at + 2])
                ]
            self._escape(selector)
            return list(dict.fromkeys([words[at + 2], *(label for _, label in pairs)]))
        if number == op.RETURN:
            exits.append(Exit(RETURNED, self.memory, ()))
        elif number == op.RETURN_VALUE:
            exits.append(Exit(RETURNED, self.memory, (), self._value(words[at + 1])))
        elif number not in op.DEAD_ENDS:
            raise GivenUp
        return []

    def _go(
        self, body: Body, source: int, target: int, stops: frozenset[int], exits: list[Exit]
    ) -> bool:
        """Continues at a label, or records an exit if following stops there."""
        phis = tuple(self._phis(body, target, source))
        if target in stops:
            exits.append(Exit(target, self.memory, phis))
            return False
        for identity, value in phis:
            self._assign(identity, value)
        return True

    def _phis(self, body: Body, label: int, source: int) -> Iterable[tuple[int, Value]]:
        """The values of a label's phis on the path from another label."""
        block = body.blocks.get(label)
        if block is None:
            raise GivenUp
        words, at = self.words, block.start
        found = []
        while words[at] & 0xFFFF in (op.PHI, 8, 317):
            end = at + (words[at] >> 16)
            self._take((end - at) >> 4)
            if words[at] & 0xFFFF == op.PHI:
                pairs = zip(words[at + 3 : end : 2], words[at + 4 : end : 2], strict=False)
                value = next(
                    (self._value(value) for value, parent in pairs if parent == source), None
                )
                found.append((words[at + 2], Opaque() if value is None else value))
            at = end
        return found

    def _resume(self, exits: Sequence[Exit]) -> None:
        """Continues where several paths meet, with what they agree on."""
        memory = exits[0].memory
        if len(exits) > 1:
            self._take(sum(len(exit.memory) for exit in exits) >> 3)
            memory = dict(memory)
            for exit in exits[1:]:
                for root, value in exit.memory.items():
                    own = memory.get(root, UNWRITTEN)
                    if own is not value:
                        memory[root] = met(self._copy(own), self._copy(value))
        self.memory = memory
        for n, (identity, value) in enumerate(exits[0].phis):
            self._assign(identity, reduce(met, (exit.phis[n][1] for exit in exits[1:]), value))

    def _execute(self, at: int, end: int) -> int:
        """The instructions of a block from a place up to the one that ends it."""
        words, known = self.words, _INSTRUCTIONS
        while at < end:
            first = words[at]
            number, after = first & 0xFFFF, at + (first >> 16)
            self._take(1 + (first >> 20))
            value: Value = None
            if number in known:
                value = known[number](self, at, after)
            elif number in _ENDS:
                return at
            elif number not in _SILENT:
                value = self._other(number, at, after)
            if value is not None:
                self._assign(words[at + 2], value)
            at = after
        raise GivenUp


_INSTRUCTIONS: dict[int, Callable[[Follower, int, int], Value]] = {
    op.LOAD: Follower._load, op.STORE: Follower._store, op.VARIABLE: Follower._variable,
    op.FUNCTION_CALL: Follower._call,
    op.ACCESS_CHAIN: Follower._chain, op.IN_BOUNDS_ACCESS_CHAIN: Follower._chain,
    op.COPY_MEMORY: Follower._copy_memory,
    op.COPY_OBJECT: Follower._same, op.COPY_LOGICAL: Follower._same, op.IMAGE: Follower._same,
    op.SAMPLED_IMAGE: Follower._same,
    op.COMPOSITE_CONSTRUCT: Follower._construct, op.COMPOSITE_EXTRACT: Follower._extract,
    op.COMPOSITE_INSERT: Follower._insert,
    op.VECTOR_SHUFFLE: Follower._shuffle, op.IMAGE_FETCH: Follower._fetch,
    op.IMAGE_READ: Follower._fetch, op.SPARSE_FETCH: Follower._fetch,
    op.SPARSE_READ: Follower._fetch, op.IMAGE_QUERY_SAMPLES: Follower._query,
    op.EXT_INST: Follower._extended, 115: Follower._same,
    127: Follower._negate, 129: Follower._arithmetic, 131: Follower._arithmetic,
    133: Follower._arithmetic, 136: Follower._arithmetic,
    142: Follower._arithmetic, 169: Follower._select,
}  # fmt: skip
"""The instructions that are followed. Not an attribute of the follower, which would refer to itself
and live until garbage is collected.
"""

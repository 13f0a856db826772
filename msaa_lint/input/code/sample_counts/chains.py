"""The tests that a program makes of the bits of a mask of sample counts, and the count that comes of them."""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
from typing import NamedTuple

from msaa_lint.core.text.span import Span

from .masks import Mask

MAX_TESTS = 64
"""Tests of one chain; no mask has more than seven bits."""


class Test(NamedTuple):
    """A test of the bit of a count: what it gives, where it stands, which `if` it is of, and whether the chain ends where it holds."""

    mask: Mask
    bit: int
    gives: int
    at: Span
    group: int
    leaves: bool
    spelled: bool


class Chain:
    """The tests that give their counts to one variable, or return them; `pure` says that nothing else gives it one."""

    def __init__(self) -> None:
        self.tests: list[Test] = []
        self.pure = True
        self.groups = 0

    def ordered(self) -> list[Test]:
        """The tests, the one that decides first."""
        if self.groups < 2 or all(test.leaves for test in self.tests):
            return self.tests
        # Each that holds writes over those before.
        tests_by_bit: dict[int, Test] = {}
        for test in sorted(self.tests, key=lambda test: -test.group):
            tests_by_bit.setdefault(test.bit, test)
        return list(tests_by_bit.values())


def greatest(tests: list[Test]) -> int:
    """The greatest count that a chain gives: none behind the test of a count that every device offers."""
    counts = []
    for test in tests:
        counts.append(test.gives)
        weak = any("Integer" in name or name == "storageImageSampleCounts" for name, _ in test.mask.limits)
        if test.bit == 1 or (test.bit == 4 and not weak):
            break
    return max(counts)

"""Chains of tests of the bits of a sample count mask, and the counts that they select."""

from typing import NamedTuple

from msaa_lint.core.text.span import Span

from .masks import Mask

MAX_TESTS = 64
"""The maximum number of tests in a chain; masks have seven bits."""


class Test(NamedTuple):
    """A test of a bit: the count that it selects, its location, the `if` that it belongs to, and
    whether the chain ends if it holds.
    """

    mask: Mask
    bit: int
    gives: int
    at: Span
    group: int
    leaves: bool
    spelled: bool


class Chain:
    """The tests that assign counts to a variable or return them. `pure` is set if nothing else
    assigns it.
    """

    def __init__(self) -> None:
        self.tests: list[Test] = []
        self.pure = True
        self.groups = 0

    def ordered(self) -> list[Test]:
        """Returns the tests in the order of precedence."""
        if self.groups < 2 or all(test.leaves for test in self.tests):
            return self.tests
        # Later tests overwrite the results of earlier ones.
        tests_by_bit: dict[int, Test] = {}
        for test in sorted(self.tests, key=lambda test: -test.group):
            tests_by_bit.setdefault(test.bit, test)
        return list(tests_by_bit.values())


def greatest(tests: list[Test]) -> int:
    """Returns the highest count that a chain selects; tests after one of a count that every device
    supports are unreachable.
    """
    counts = []
    for test in tests:
        counts.append(test.gives)
        weak = any(
            "Integer" in name or name == "storageImageSampleCounts" for name, _ in test.mask.limits
        )
        if test.bit == 1 or (test.bit == 4 and not weak):
            break
    return max(counts)

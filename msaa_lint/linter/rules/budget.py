"""What the user's own rule pages may take in one run: a page may come from an untrusted branch.

A step is that of `condition_cost`, about 50 ns; reading, compiling and reporting are counted in the
same unit. All pages of a run draw on one budget, whatever configuration names them. A page is
turned off for the rest of the run once it has used more than is left for all: a page that takes
much cannot turn off one that takes little.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

MAX_STEPS = 150_000_000
"""Of all pages of a run, however small its inputs: some 8 seconds."""

INPUT = 200
"""Steps more for each byte of the inputs: fifty pages take about 70 in a frame."""

MAX_EVALUATION = 2_000_000
"""Steps of one evaluation: some 0.1 seconds, and less than 200 MB."""

READ = 20
"""Steps for each character of the front matter that is read and checked."""

COMPILE = 200
"""Steps for each character of a condition that is checked and compiled; in memory it takes some 250
bytes.
"""

MISTAKE = 40_000
"""Steps of a mistake in a page: most of them search for the word that was meant."""

EVALUATE, UNDECIDED, REPORT = 200, 400, 2000
"""Steps of an evaluation, of a rule that stays undecided, and of a finding, beyond what depends on
their sizes.
"""


class OverBudget(ArithmeticError):
    """A page takes too much; the message says what."""


class Spent(NamedTuple):
    """What an input added to the budget, what pages took of it, by path, and whether one was turned
    off.
    """

    added: int = 0
    used: Mapping[str, int] = {}
    turned_off: bool = False


class Budget:
    """What is left of the steps of a run, and the pages that are turned off."""

    def __init__(self, steps: int = MAX_STEPS) -> None:
        self.steps = steps
        self.left = steps
        self.off: set[str] = set()
        """The paths of pages that are turned off."""
        self._used: dict[str, int] = {}

    def copy(self) -> Budget:
        """A budget of its own that begins where this one is."""
        other = Budget(self.steps)
        other.left, other.off, other._used = self.left, set(self.off), dict(self._used)
        return other

    def spent_since(self, before: Budget) -> Spent:
        """What was spent since this budget was as `before`."""
        used = {
            page: steps - before._used.get(page, 0)
            for page, steps in self._used.items()
            if steps != before._used.get(page, 0)
        }
        return Spent(self.steps - before.steps, used, self.off != before.off)

    def restore(self, before: Budget) -> None:
        """Makes this budget as `before` is."""
        self.steps, self.left, self.off, self._used = (
            before.steps,
            before.left,
            set(before.off),
            dict(before._used),
        )

    def include(self, spent: Spent) -> bool:
        """Counts what was spent elsewhere; False, without counting it, if it may be more than a
        page has here.
        """
        used = {page: self._used.get(page, 0) + steps for page, steps in spent.used.items()}
        left = self.left + spent.added - sum(spent.used.values())
        if spent.turned_off or any(
            page in self.off or steps > left for page, steps in used.items()
        ):
            return False
        self.steps += spent.added
        self.left = left
        self._used |= used
        return True

    def extend(self, size: int) -> None:
        """Adds the steps for an input of that many bytes."""
        self.steps += INPUT * size
        self.left += INPUT * size

    def charge(self, page: str, steps: int) -> None:
        """Counts steps of a page, by its path. Raises: OverBudget, before they are taken."""
        used = self._used.get(page, 0) + steps
        if used > self.left - steps or page in self.off:
            self.off.add(page)
            raise OverBudget(
                f"it has used up its part of the {self.steps} steps that the custom rules of a run "
                "may take"
            )
        self.spend(page, steps)

    def spend(self, page: str, steps: int) -> None:
        """Counts steps that a page has taken."""
        self._used[page] = self._used.get(page, 0) + steps
        self.left = max(self.left - steps, 0)

    def charge_evaluation(self, page: str, steps: int) -> None:
        """Counts an evaluation of a condition. Raises: OverBudget."""
        if steps > MAX_EVALUATION:
            self.off.add(page)
            raise OverBudget(
                f"evaluating the condition may take {steps} steps, more than the limit of "
                f"{MAX_EVALUATION}"
            )
        self.charge(page, EVALUATE + steps)

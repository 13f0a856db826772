"""What inputs add to a report that is rendered input by input: its text, and what its summary
counts.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

Level = tuple[str, str, bool]
"""The severity of a finding, its confidence, and whether it is fatal."""


Lack = tuple[str, str, str]
"""The code of an undecided rule, `fact` or `key`, and what it lacks; the last two are empty if that
is unknown.
"""


class Counts(NamedTuple):
    """What the summary of a report counts.

    `levels` are the numbers of findings by level, and `files` what they are about. `numbers` are
    counts by what is counted. `undecided` has the codes of the undecided rules with what they lack.
    """

    levels: dict[Level, int]
    files: set[str]
    numbers: dict[str, int]
    undecided: set[Lack]

    def add_finding(self, level: Level, file: str) -> None:
        """Counts a finding."""
        self.levels[level] = self.levels.get(level, 0) + 1
        self.files.add(file)

    def add(self, other: "Counts") -> None:
        """Adds what others are."""
        for level, number in other.levels.items():
            self.levels[level] = self.levels.get(level, 0) + number
        self.files.update(other.files)
        for name, number in other.numbers.items():
            self.numbers[name] = self.numbers.get(name, 0) + number
        self.undecided.update(other.undecided)


def no_counts() -> Counts:
    """What a report without inputs counts."""
    return Counts({}, set(), {}, set())


class RenderedFinding(NamedTuple):
    """A finding as text."""

    text: str
    file: str
    level: Level


class RenderedPart(NamedTuple):
    """What an input, or the files of a program, add to a report. `suppressed` and `undecided` are
    texts of all of them, or empty; `inputs` are those of the inputs, by name. `counts` are those of
    all but the findings.
    """

    findings: Sequence[RenderedFinding]
    suppressed: str
    undecided: str
    inputs: Mapping[str, str]
    counts: Counts


class RenderedReport(NamedTuple):
    """The texts of a report in their order, and what its summary counts."""

    findings: Iterable[str]
    suppressed: Iterable[str]
    undecided: Iterable[str]
    inputs: Iterable[str]
    counts: Counts

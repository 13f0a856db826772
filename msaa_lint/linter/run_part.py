"""What one input, or the files of a program, add to the result of a run."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.finding import (
    Finding,
    InputSummary,
    PassTraffic,
    Savings,
    Suppressed,
    Undecided,
)
from msaa_lint.core.rendered import RenderedPart
from msaa_lint.core.text.source import Source

from .rules.budget import Spent

if TYPE_CHECKING:
    from msaa_lint.frame.cost.input_cost import CostedFrame

    from .fixes.file_fixes import FixedText


class RunPart(NamedTuple):
    """What one input, or the files of a program, add to the result of a run.

    `findings` are those after settings and before the baseline, which does not apply to
    `diagnostics`. `sources` has the texts that reports show. `savings`, `failing`, and `untried`
    are by file. `problems` are the findings about files that cannot be read. `frames` are the
    frames with their costs, if a report shows them. `notes` are lines for standard error, `fixed`
    the fixed texts, `passes` what passes move, if an output has rows of them, which are of the
    `owners` of the other files of a program, and `spent` is what custom rules took. `rendered`
    takes the place of findings except `problems`, undecided rules, summaries, and sources in a
    report that is rendered input by input.
    """

    diagnostics: Sequence[Finding] = ()
    findings: Sequence[Finding] = ()
    undecided: Sequence[Undecided] = ()
    suppressed: Sequence[Suppressed] = ()
    summaries: Sequence[InputSummary] = ()
    sources: Mapping[str, Source] = {}
    savings: Mapping[str, Savings] = {}
    failing: Mapping[str, Savings] = {}
    untried: Mapping[str, bool] = {}
    problems: Sequence[Finding] = ()
    frames: "Sequence[CostedFrame]" = ()
    notes: Sequence[str] = ()
    fixed: "Sequence[FixedText]" = ()
    passes: Sequence[PassTraffic] = ()
    owners: Mapping[str, str] = {}
    spent: Spent = Spent()
    rendered: RenderedPart | None = None

    def __add__(self, other: "RunPart") -> "RunPart":  # type: ignore[override]
        """Both together."""
        return RunPart(
            [*self.diagnostics, *other.diagnostics],
            [*self.findings, *other.findings],
            [*self.undecided, *other.undecided],
            [*self.suppressed, *other.suppressed],
            [*self.summaries, *other.summaries],
            {**self.sources, **other.sources},
            {**self.savings, **other.savings},
            {**self.failing, **other.failing},
            {**self.untried, **other.untried},
            [*self.problems, *other.problems],
            [*self.frames, *other.frames],
            [*self.notes, *other.notes],
            [*self.fixed, *other.fixed],
            [*self.passes, *other.passes],
            {**self.owners, **other.owners},
        )

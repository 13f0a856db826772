"""What one input, or the files of a program, add to the result of a run."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.finding import Finding, InputSummary, Savings, Suppressed, Undecided
from msaa_lint.core.text.source import Source

if TYPE_CHECKING:
    from msaa_lint.frame.cost.input_cost import CostedFrame


class RunPart(NamedTuple):
    """What one input, or the files of a program, add to the result of a run.

    `findings` are those after settings and before the baseline, which does not apply to `diagnostics`. `sources` has the texts that
    reports show. `savings`, `failing`, and `untried` are by file. `problems` and `failed` are the findings about files that cannot be
    read, and these files. `frames` are the frames with their costs, if a report shows them.
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
    failed: frozenset[str] = frozenset()
    frames: "Sequence[CostedFrame]" = ()

"""Prints a lint result: one module per output, each with `render(result, out, options)`.

A reporter knows findings alone. `out` is called with pieces of text, as `sys.stdout.write` is; what the pieces hold never depends on
anything but the result and the options, so the same run gives the same bytes.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from msaa_lint.core.finding import Result

Write = Callable[[str], object]

FORMATS = {
    "full": "msaa_lint.cli.report.full",
    "concise": "msaa_lint.cli.report.concise",
    "json": "msaa_lint.cli.report.json",
    "sarif": "msaa_lint.cli.report.sarif",
    "github": "msaa_lint.cli.report.github",
    "gitlab": "msaa_lint.cli.report.gitlab",
    "junit": "msaa_lint.cli.report.junit",
    "markdown": "msaa_lint.cli.report.markdown",
}
"""Name of an output -> the module that prints it, imported when it is asked for."""


class Options(NamedTuple):
    """How to print.

    `root` is the folder that paths are shown relative to (empty: as given). `width` is in terminal cells (0: lines are never cut).
    `max_undecided` is how many missing facts a summary names. `sarif_category` tells several runs on one commit apart.
    `step_summary` is the file that the GitHub output appends a table to: None asks GITHUB_STEP_SUMMARY, empty writes none.
    `fail_confidence` is what a finding needs to fail the run: summaries say how many have less.
    """

    color: bool = False
    width: int = 140
    root: str = ""
    version: str = ""
    edition: str = ""
    show_suppressed: bool = False
    statistics: bool = False
    max_undecided: int = 5
    sarif_category: str = ""
    step_summary: str | None = None
    fail_confidence: str = "low"


def render(name: str, result: Result, out: Write, options: Options) -> None:
    """Prints `result` as the output called `name`; ValueError where there is none of that name."""
    if name not in FORMATS:
        raise ValueError(f"no output is called {name!r}; there are {', '.join(FORMATS)}")
    __import__(FORMATS[name], fromlist=["render"]).render(result, out, options)

"""Reports: one module per output format, each with `render(result, out, options)`.

A reporter knows findings alone. It calls `out` with pieces of text, as `sys.stdout.write` is
called; they depend on nothing but the result and the options, so the same run prints the same
bytes.
"""

from collections.abc import Callable
from importlib import import_module
from typing import NamedTuple

from msaa_lint.core.finding import Result
from msaa_lint.linter.settings.settings import OUTPUT_FORMATS

Write = Callable[[str], object]


class Options(NamedTuple):
    """How to print.

    `root` is the folder that paths are shown relative to (empty: as given). `width` is in terminal
    cells (0: lines are never cut). `max_undecided` is the number of missing keys that a summary
    names, `max_unread` that of inputs without a pass to check. `step_summary` is the file that the
    GitHub output appends a table to: None uses GITHUB_STEP_SUMMARY, empty writes none.
    `fail_confidence` is the confidence that findings need to fail the run; summaries count those
    below it. `explain_undecided` lists the keys that undecided rules lack. `quiet` leaves out
    summaries and remarks; `verbose` adds to the text of `confirm` what only msaa-lint reports, and
    noise of the layer. `docs_url` is the address of the documentation, whose pages of rules are
    linked to (empty: none); `hyperlinks` says that the stream is a terminal that shows text as a
    link (OSC 8).
    """

    color: bool = False
    width: int = 140
    root: str = ""
    version: str = ""
    edition: str = ""
    show_suppressed: bool = False
    statistics: bool = False
    max_undecided: int = 5
    max_unread: int = 5
    step_summary: str | None = None
    fail_confidence: str = "low"
    explain_undecided: bool = False
    quiet: bool = False
    verbose: bool = False
    docs_url: str = ""
    hyperlinks: bool = False


def render(name: str, result: Result, out: Write, options: Options) -> None:
    """Prints `result` in the format called `name`, with the module of that name. ValueError for an
    unknown format.
    """
    if name not in OUTPUT_FORMATS:
        raise ValueError(f"unknown output format {name!r}: use one of {', '.join(OUTPUT_FORMATS)}")
    import_module(".html.check" if name == "html" else f".{name}", __name__).render(
        result, out, options
    )

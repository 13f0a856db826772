"""`msaa-lint corpus`."""

from __future__ import annotations

from functools import partial
from importlib.util import find_spec
from typing import IO, Any

from msaa_lint.core.extras import needs_extra

from .common import (
    Target,
    UsageError,
    parse_outputs,
    refuse_inputs,
    report_module,
    report_options,
    run_command,
    write_output,
)
from .options import COST_FORMATS, Arguments

DEFAULT_TOP = 20
"""Rows of a table for a person."""


def corpus(arguments: Arguments) -> int:
    """Prints what there is to learn from the rows of runs; returns 0, or 2 if a file, an option, or
    a query cannot be used.
    """
    if find_spec("duckdb") is None or find_spec("pyarrow") is None:
        return run_command(_without_extra, arguments)
    from msaa_lint.linter.corpus.files import CorpusError

    return run_command(summarize_files, arguments, (CorpusError,))


def _without_extra(arguments: Arguments) -> int:
    raise UsageError(needs_extra("`msaa-lint corpus`", "corpus"))


def summarize_files(arguments: Arguments) -> int:
    """Answers what the arguments ask of corpora."""
    from msaa_lint.linter.corpus.database import Database
    from msaa_lint.linter.corpus.files import corpus_files
    from msaa_lint.linter.corpus.summary import summarize

    targets = parse_outputs(arguments.get("output", ()), COST_FORMATS, "markdown=corpus.md") or [
        Target("full", None)
    ]
    sql = arguments.get("sql")
    if sql is not None and ("by" in arguments or "top" in arguments):
        raise UsageError(
            "`--sql` is instead of `--by` and `--top`: write ORDER BY and LIMIT in the query"
        )
    files = corpus_files(arguments["paths"])
    since = corpus_files([arguments["since"]]) if "since" in arguments else []
    read = [path for file in (*files, *since) for path in (file.paths or {"": file.path}).values()]
    refuse_inputs([target.path for target in targets], read)
    with Database(files, since) as database:
        for target in targets:
            report = report_module("corpus", target.format)
            if sql is not None:
                write_output(
                    target.path,
                    partial(
                        _render, report.render_query, database.query(sql), arguments, target.format
                    ),
                )
                continue
            # JSON has all rows unless it is asked for fewer.
            top = arguments.get("top", None if target.format == "json" else DEFAULT_TOP)
            summary = summarize(database, arguments.get("by", "rule"), top)
            write_output(
                target.path, partial(_render, report.render, summary, arguments, target.format)
            )
    return 0


def _render(render: Any, answer: object, arguments: Arguments, format: str, out: IO[str]) -> None:
    render(answer, out.write, report_options(arguments, out, color=format == "full"))

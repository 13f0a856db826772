"""The outputs of `check` that are tables: `--output parquet=FILE` and `sqlite=FILE`."""

from __future__ import annotations

import os
from collections.abc import Sequence
from importlib.util import find_spec
from typing import TYPE_CHECKING

from msaa_lint.core.quote import quoted
from msaa_lint.linter.rules.rule import EDITIONS
from msaa_lint.linter.settings.settings import TABLE_FORMATS

from .common import Target, UsageError, report_module, report_options, writes

if TYPE_CHECKING:
    from msaa_lint.linter.run import Outcome

    from .options import Arguments


def check_table(target: Target) -> None:
    """UsageError if a target is tables, and cannot be written: they need a file, and Parquet its
    extension and the extra `corpus`.
    """
    if target.format not in TABLE_FORMATS:
        return
    flag, path = f"--output {target.format}", target.path
    if path is None:
        raise UsageError(f"`{flag}` needs a file: write `{flag}=findings.{target.format}`")
    if os.path.exists(path) and not os.path.isfile(path):
        raise UsageError(f"`{flag}` must name a regular file, found {quoted(path)}")
    if target.format == "parquet":
        if not path.endswith(".parquet"):
            raise UsageError(f"`{flag}` must name a .parquet file, found {quoted(path)}")
        if find_spec("pyarrow") is None:
            from msaa_lint.core.extras import needs_extra

            raise UsageError(needs_extra(flag, "corpus"))


def paths_of(target: Target) -> Sequence[str | None]:
    """The files that a target is written to; None is standard output."""
    if target.format != "parquet" or target.path is None:
        return [target.path]
    from msaa_lint.linter.corpus.tables import parquet_paths

    return list(parquet_paths(target.path).values())


def write_tables(target: Target, outcome: Outcome, arguments: Arguments) -> None:
    """Writes the tables of a run. UsageError if a file cannot be written."""
    import sys

    from .report.rows import rows

    assert target.path is not None
    options = report_options(arguments, sys.stdout)._replace(
        edition=outcome.settings.edition or EDITIONS[-1]
    )
    with writes(target.path):
        tables = rows(
            outcome.result, outcome.passes, outcome.configuration, options, outcome.owners
        )
        report_module("check", target.format).write(target.path, tables, options.version)

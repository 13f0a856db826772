"""`msaa-lint baseline`: records the current findings."""

from __future__ import annotations

import os

from msaa_lint.core.project import project_root
from msaa_lint.linter.request import Request
from msaa_lint.linter.run import run
from msaa_lint.linter.suppress import baseline as baselines

from .common import log, note, overrides, refuse_inputs, run_command, warn, writes
from .options import Arguments
from .report.summary import plural

FILE = "msaa-lint-baseline.json"
"""The baseline file unless `--file` names one."""


def baseline(arguments: Arguments) -> int:
    """Writes the baseline that the arguments name; returns the exit code."""
    return run_command(_baseline, arguments)


def _baseline(arguments: Arguments) -> int:
    isolated = bool(arguments.get("isolated"))
    request = Request(
        arguments["paths"],
        overrides(arguments),
        arguments.get("config"),
        isolated,
        without_baseline=True,
        log=log(arguments),
    )
    return write_baseline(request, arguments.get("file"), bool(arguments.get("prune")))


def write_baseline(request: Request, stated: str | None, prune: bool) -> int:
    """Writes the baseline of the current findings of a request, or with `prune` removes fixed
    findings from it; returns 2 if it cannot.

    A file that msaa-lint did not write is replaced only if it is `stated`.
    """
    file = stated or FILE
    result = run(request).result
    refuse_inputs([file], result.files)
    fatal = [finding for finding in result.findings if finding.fatal]
    for finding in fatal:
        warn(f"{finding.file}: {finding.message}")
    if fatal:
        warn("no baseline is written: fix these errors first")
        return 2
    before = 0
    if prune:
        loaded = baselines.load(file, project_root(os.curdir) if stated is None else None)
        if isinstance(loaded, baselines.Refused):
            warn(f"{file}: {loaded.findings[0].message}")
            return 2
        new = baselines.prune(loaded, result.findings, result.files)
        before = _count(loaded)
    else:
        new = baselines.build(result.findings, os.path.dirname(os.path.abspath(file)))
    with writes(file):
        baselines.save(new, file, force=stated is not None)
    after = _count(new)
    change = (
        f"removed {before - after} of {before}"
        if prune
        else f"{plural(after, 'finding')} in {plural(len(new.entries), 'file')}"
    )
    note(f"{file}: {change}. To use it: msaa-lint check --baseline {file} ...")
    return 0


def _count(baseline: baselines.Baseline) -> int:
    return sum(sum(rules.values()) for rules in baseline.entries.values())

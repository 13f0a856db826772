"""`msaa-lint baseline`: writes down what is found today."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from msaa_lint.linter.run import Request, run
from msaa_lint.linter.suppress import baseline as counts

from .report.escape import visible
from .report.summary import plural


def baseline(paths: Sequence[str], file: str, prune: bool, config: str | None, isolated: bool) -> int:
    """Writes the baseline of today's findings, or takes away from it what is no longer found; 2 where that cannot be."""
    outcome = run(Request(paths, {}, config, isolated, without_baseline=True))
    for found in outcome.result.findings:
        if found.fatal:
            print(f"msaa-lint: {visible(found.file)}: {visible(found.message)}", file=sys.stderr)
    if any(found.fatal for found in outcome.result.findings):
        print("msaa-lint: mend these first: what cannot be read cannot be counted", file=sys.stderr)
        return 2
    made: counts.Baseline
    if prune:
        loaded = counts.load(file)
        if isinstance(loaded, counts.Refused):
            print(f"msaa-lint: {visible(loaded.findings[0].message)}", file=sys.stderr)
            return 2
        made = counts.prune(loaded, outcome.result.findings, outcome.result.files)
        before = sum(sum(rules.values()) for rules in loaded.entries.values())
    else:
        made = counts.build(outcome.result.findings, os.path.dirname(os.path.abspath(file)))
        before = 0
    try:
        counts.save(made, file)
    except OSError as error:
        print(f"msaa-lint: {visible(file)} cannot be written: {error.strerror}", file=sys.stderr)
        return 2
    after = sum(sum(rules.values()) for rules in made.entries.values())
    counted = f"{plural(after, 'finding')} in {plural(len(made.entries), 'file')}"
    said = f"{before - after} of {before} taken away" if prune else counted
    print(f"{visible(file)}: {said}. Use it: msaa-lint check --baseline {visible(file)} …", file=sys.stderr)
    return 0

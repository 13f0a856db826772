"""`msaa-lint check`."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from typing import IO, Any

from msaa_lint.core.finding import is_confident, rank
from msaa_lint.core.package import VERSION
from msaa_lint.input.discovery import STDIN
from msaa_lint.linter.run import Outcome, Request, run
from msaa_lint.linter.settings.settings import OUTPUT_FORMATS

from .common import Target, colored, ended, outputs, settings, utf_8

EXAMPLE = "sarif=findings.sarif"
LIMITS = {"max_depth": "depth", "max_nodes": "nodes", "max_bytes": "bytes"}

ERRORS = "<standard error>"
"""In place of an output's file: the standard error stream."""


def check(given: Mapping[str, Any]) -> int:
    """Lints what the arguments name and prints it; the exit code."""
    return ended(_check, given)


def _check(given: Mapping[str, Any]) -> int:
    targets = outputs(given.get("output", ()), OUTPUT_FORMATS, EXAMPLE)
    fallback = "full" if sys.stdout.isatty() else "concise"
    outcome = run(request(given, targets, fallback), _progress())
    if not targets:
        targets = outputs(outcome.settings.output, OUTPUT_FORMATS, EXAMPLE) or [Target(fallback, None)]
    from .report.escape import visible

    for note in outcome.notes:
        print(f"msaa-lint: {visible(note)}", file=sys.stderr)
    if given.get("fix") or given.get("diff"):
        code = _fixed(targets, outcome, given)
        if code is not None:
            return code
    for target in targets:
        if not _print(target, outcome, given):
            return 2
    code = exit_code(outcome, bool(given.get("exit_zero")))
    for file in _dear(outcome) if code == 1 else ():
        print(f"msaa-lint: the findings of {visible(file)} cost {outcome.settings.fail_on_cost} together, or more", file=sys.stderr)
    return code


def _fixed(targets: list[Target], outcome: Outcome, given: Mapping[str, Any]) -> int | None:
    """Prints what fixes did, or would do; the exit code where that is all. What goes to standard output then has it for itself."""
    from .fixing import print_diff, print_text, remarks
    from .report.escape import visible

    written = not given.get("diff")
    if not written or STDIN in given["paths"]:
        others = [target for target in targets if target.path is not None]
        if written:
            print_text(outcome, given.get("stdin_filename") or "<stdin>")
            others += [target._replace(path=ERRORS) for target in targets if target.path is None]
        targets[:] = others
    changed = not written and print_diff(outcome, colored(given.get("color", "auto"), sys.stdout.isatty()))
    for line in remarks(outcome, written, bool(given.get("unsafe_fixes"))):
        print(f"msaa-lint: {visible(line)}", file=sys.stderr)
    if written:
        return None
    for target in targets:
        if not _print(target, outcome, given):
            return 2
    if any(found.fatal for found in outcome.result.findings):
        return 2
    return int(changed and not given.get("exit_zero"))


def request(given: Mapping[str, Any], targets: Sequence[Target] = (), fallback: str = "concise") -> Request:
    """What the arguments ask of a run. `fallback` is the output where neither they nor a configuration name one."""
    overrides = settings(given)
    limits = {limit: given[name] for name, limit in LIMITS.items() if name in given}
    if limits:
        overrides["limits"] = limits
    return Request(
        paths=given["paths"],
        overrides=overrides,
        config=given.get("config"),
        isolated=bool(given.get("isolated")),
        ignores=not given.get("no_ignores"),
        format=given.get("input_format"),
        stdin_filename=given.get("stdin_filename"),
        full_rules=any(target.format == "sarif" for target in targets),
        formats=[*(target.format for target in targets), *(["statistics"] if given.get("statistics") else [])],
        fallback=fallback,
        by_price=given.get("sort") == "price",
        fix="show" if given.get("diff") else "write" if given.get("fix") else None,
        unsafe_fixes=bool(given.get("unsafe_fixes")),
    )


def exit_code(outcome: Outcome, exit_zero: bool = False) -> int:
    """2 where an input or the configuration could not be used, 1 where a finding is as severe as `fail-on`, or findings as dear as
    `fail-on-cost`, of those with the confidence `fail-confidence`, else 0."""
    if any(found.fatal for found in outcome.result.findings):
        return 2
    if exit_zero:
        return 0
    least, confidence = rank(outcome.settings.fail_on), outcome.settings.fail_confidence
    failing = any(rank(found.severity) >= least and is_confident(found, confidence) for found in outcome.result.findings)
    return int(failing or bool(_dear(outcome)))


def _dear(outcome: Outcome) -> list[str]:
    """The inputs whose findings cost together what `fail-on-cost` allows, or more."""
    if outcome.settings.fail_on_cost is None:
        return []
    from msaa_lint.linter.settings.cost_limit import budget, reached

    limit = budget(outcome.settings.fail_on_cost)
    return [file for file, price in outcome.charged.items() if reached(price, limit)]


def _print(target: Target, outcome: Outcome, given: Mapping[str, Any]) -> bool:
    from .report import render

    if target.path not in (None, ERRORS):
        try:
            with open(target.path, "w", encoding="utf-8", newline="\n") as file:
                render(target.format, outcome.result, file.write, _options(target, outcome, given, file))
        except OSError as error:
            print(f"msaa-lint: {target.path} cannot be written: {error.strerror}", file=sys.stderr)
            return False
        return True
    out = sys.stdout if target.path is None else sys.stderr
    utf_8(out)
    options = _options(target, outcome, given, out)
    if given.get("statistics") and target.format in ("full", "concise"):
        from .report.statistics import render as count

        count(outcome.result, out.write, options)
    else:
        render(target.format, outcome.result, out.write, options)
    out.flush()
    return True


def _options(target: Target, outcome: Outcome, given: Mapping[str, Any], out: IO[str]) -> Any:
    from .report import Options

    terminal = out.isatty()
    width = 0
    if terminal:
        import shutil

        width = shutil.get_terminal_size().columns
    edition = outcome.settings.edition
    return Options(
        color=target.format in ("full", "concise") and colored(given.get("color", "auto"), terminal),
        width=width or 140,
        root=os.environ.get("GITHUB_WORKSPACE", "") if target.format in ("github", "sarif") else _gitlab_root(target.format),
        version=VERSION,
        edition=edition or "",
        show_suppressed=bool(given.get("show_suppressed")),
        statistics=bool(given.get("statistics")),
        fail_confidence=outcome.settings.fail_confidence,
    )


def _gitlab_root(format: str) -> str:
    return os.environ.get("CI_PROJECT_DIR", "") if format == "gitlab" else ""


MANY = 200
"""Inputs from which a progress bar is worth the 40 ms that importing rich takes."""


def _progress() -> Any:
    """A progress bar on a terminal's standard error stream, once there are many inputs."""
    if not sys.stderr.isatty():
        return None
    bar: Any = None

    def advance(done: int, total: int, name: str) -> None:
        nonlocal bar
        if total < MANY:
            return
        if bar is None:
            from rich.console import Console
            from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

            bar = Progress(
                TextColumn("linting", markup=False), BarColumn(), MofNCompleteColumn(), console=Console(stderr=True), transient=True
            )
            bar.start()
            bar.add_task("linting", total=total)
        bar.update(0, completed=done + 1)
        if done + 1 == total:
            bar.stop()

    return advance

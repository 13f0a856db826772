"""`msaa-lint device`: what a built-in device, a report or the running driver offers for multisampling."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

from msaa_lint.core.text.source import Unreadable
from msaa_lint.frame.devices import builtin, names
from msaa_lint.frame.devices.mapping import description
from msaa_lint.frame.devices.offer import Offer, builtin_offer, record
from msaa_lint.frame.devices.paths import is_path, split
from msaa_lint.frame.devices.reports import EXPECTED, MAX_BYTES, NotAReport, pick
from msaa_lint.frame.devices.reports.members import Report
from msaa_lint.frame.profiles import Problem, parsed, profile_of, reports

from .report.escape import shown

if TYPE_CHECKING:
    from rich.console import Console

Output = Literal["text", "json", "description"]
SCHEMA = "msaa-lint/device-v1"
WIDTH = 140
"""Columns where there is no terminal to ask."""

MOST_SECONDS = 30.0


class Missing(Exception):
    """A device that cannot be had; its text is for the user."""


def device(stated: Sequence[str], output: Output = "text", listing: bool = False) -> int:
    """Prints what devices offer; 0, or 2 where one cannot be had."""
    try:
        code = _list(output) if listing else _show(stated, output)
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 2
    except KeyboardInterrupt:
        return 130
    except Exception as error:
        print(f"msaa-lint: the program failed: {type(error).__name__}: {shown(str(error)[:300])}", file=sys.stderr)
        return 2


def _show(stated: Sequence[str], output: Output) -> int:
    offers: list[Offer] = []
    failed = False
    for name in stated:
        try:
            offers += _named(name)
        except Missing as error:
            failed = True
            print(f"msaa-lint: {shown(str(error))}", file=sys.stderr)
    if not stated:
        try:
            offers = _running()
        except Missing as error:
            failed = True
            print(f"msaa-lint: {shown(str(error))}", file=sys.stderr)
    if output == "json":
        import json

        print(json.dumps({"schema": SCHEMA, "devices": [record(offer) for offer in offers]}, indent=2))
    elif output == "description":
        _utf_8()
        print("---\n".join(description(offer) for offer in offers), end="")
    else:
        _print(offers)
    return 2 if failed else 0


def _named(name: str) -> list[Offer]:
    """The devices that an argument means: a built-in one, or all of a report unless it picks one; `-` is a report on standard input."""
    found = builtin_offer(name)
    if found is not None:
        return [found]
    path, which = split(name)
    if name == "-":
        path, listed = "<stdin>", _stdin()
    elif os.path.isfile(name) or is_path(name):
        if os.path.isfile(name):
            path, which = name, ""
        read = reports(path, path)
        if isinstance(read, Problem):
            raise Missing(_worded(read))
        listed = read
    else:
        known = profile_of(name)
        if isinstance(known, Problem):
            raise Missing(_worded(known))
        return [Offer(Report(known), name)]
    if which:
        chosen = pick(listed, which)
        if chosen is None:
            raise Missing(_worded(profile_problem(name)))
        listed = [chosen]
    if name == "-":
        return [Offer(each) for each in listed]
    several = len(listed) > 1
    return [Offer(each, f"{path}#{number}" if several else name) for number, each in enumerate(listed, 1)]


def profile_problem(name: str) -> Problem:
    """Why a report has no device of that name."""
    found = profile_of(name)
    assert isinstance(found, Problem)
    return found


def _worded(problem: Problem) -> str:
    return f"{problem.message}; {problem.help}" if problem.help else problem.message


def _stdin() -> list[Report]:
    data = sys.stdin.buffer.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise Missing(f"the report on standard input is larger than {MAX_BYTES >> 20} MiB")
    try:
        return parsed(data, "<stdin>")
    except (NotAReport, Unreadable) as error:
        raise Missing(f"standard input: {error}; expected {EXPECTED}") from None


def _running() -> list[Offer]:
    from msaa_lint.experiments.confirm.devices import running
    from msaa_lint.experiments.confirm.results import Unusable

    try:
        return [Offer(report) for report in running(MOST_SECONDS)]
    except Unusable as error:
        raise Missing(f"{error}; `msaa-lint device --list` names the built-in devices") from None


def _list(output: Output) -> int:
    if output == "json":
        import json

        found = [profile for profile in map(builtin, names()) if profile is not None]
        rows = [{"key": key, "name": p.name, "source": p.source} for key, p in zip(names(), found, strict=True)]
        print(json.dumps({"schema": SCHEMA, "profiles": rows}, indent=2))
        return 0
    from rich.table import Table

    table = Table("name", "device", "source", box=None, pad_edge=False)
    for key in names():
        profile = builtin(key)
        if profile is not None:
            table.add_row(key, profile.name, profile.source)
    console = _console()
    with console.capture() as captured:
        console.print(table)
    _write(captured.get())
    return 0


def _print(offers: Sequence[Offer]) -> None:
    from rich.table import Table

    from msaa_lint.frame.devices import wording as words

    console = _console()
    with console.capture() as captured:
        for number, offer in enumerate(offers):
            console.print(*([""] if number else []), shown(words.title(offer)), sep="\n", style="bold")
            counts = words.table(offer)
            table = Table(*counts.heads, box=None, pad_edge=False)
            for row in counts.rows:
                table.add_row(*row)
            console.print(table)
            for line in counts.legend:
                console.print(line, style="dim")
            facts = Table("", "", box=None, pad_edge=False, show_header=False)
            for fact in words.rows(offer):
                facts.add_row(shown(fact.label), shown(fact.text))
            console.print(facts)
    _write(captured.get())


def _write(text: str) -> None:
    """Prints what was laid out, without the blanks that fill up its lines."""
    sys.stdout.write("".join(line.rstrip() + "\n" for line in text.splitlines()))


def _console() -> Console:
    from rich.console import Console

    _utf_8()
    return Console(markup=False, highlight=False, emoji=False, width=None if sys.stdout.isatty() else WIDTH)


def _utf_8() -> None:
    if hasattr(sys.stdout, "reconfigure"):
        # The console's own encoding may not have what a device is called.
        sys.stdout.reconfigure(encoding="utf-8", errors="backslashreplace")

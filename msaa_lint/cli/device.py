"""`msaa-lint device`: what a built-in device, a report, or an installed driver supports for
multisampling.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import Literal, TypeVar

from msaa_lint.core.text.source import Unreadable
from msaa_lint.frame.devices import builtin, names
from msaa_lint.frame.devices import wording as words
from msaa_lint.frame.devices.mapping import description
from msaa_lint.frame.devices.offer import Offer, builtin_offer, record
from msaa_lint.frame.devices.paths import is_path, split
from msaa_lint.frame.devices.reports import EXPECTED, MAX_BYTES, NotAReport, pick
from msaa_lint.frame.devices.reports.members import Report
from msaa_lint.frame.profiles import Problem, parsed, profile_of, reports

from .common import UsageError, report_options, run_command, warn
from .options import Arguments
from .report.console import cell
from .report.data import dump_indented
from .report.tables import Column, Table, print_tables

Answer = TypeVar("Answer")
Output = Literal["text", "json", "description"]
SCHEMA = "msaa-lint/device-v1"
MAX_SECONDS = 30.0
"""Time limit for the drivers to report their devices."""


def device(arguments: Arguments) -> int:
    """Prints what the arguments ask for; returns the exit code."""
    return run_command(_device, arguments)


def _device(arguments: Arguments) -> int:
    return print_devices(
        arguments["paths"], arguments.get("output", "text"), bool(arguments.get("list"))
    )


def print_devices(stated: Sequence[str], output: Output = "text", listing: bool = False) -> int:
    """Prints what devices support; returns 0, or 2 if one is unknown or cannot be read."""
    if listing:
        return _list(output)
    offers: list[Offer] = []
    failed = False
    for name in stated or (None,):
        try:
            offers += _installed() if name is None else _named(name)
        except UsageError as error:
            failed = True
            warn(str(error).strip())
    if output == "json":
        print(dump_indented({"schema": SCHEMA, "devices": [record(offer) for offer in offers]}))
    elif output == "description":
        print("---\n".join(description(offer) for offer in offers), end="")
    else:
        _print(offers)
    sys.stdout.flush()
    return 2 if failed else 0


def _named(name: str) -> list[Offer]:
    """The devices that an argument names: a built-in one, or all devices of a report unless it
    picks one; `-` reads standard input.
    """
    offer = builtin_offer(name)
    if offer is not None:
        return [offer]
    path, selector = split(name)
    if name == "-":
        path, devices = "<stdin>", _stdin()
    elif os.path.isfile(name) or is_path(name):
        if os.path.isfile(name):
            path, selector = name, ""
        devices = _usable(reports(path, path, None))
    else:
        return [Offer(Report(_usable(profile_of(name))), name)]
    if selector:
        chosen = pick(devices, selector)
        # If the report has no such device, its profile says so.
        devices = [chosen if chosen is not None else Report(_usable(profile_of(name)))]
    if name == "-":
        return [Offer(report) for report in devices]
    several = len(devices) > 1
    return [
        Offer(report, f"{path}#{number}" if several else name)
        for number, report in enumerate(devices, 1)
    ]


def _usable(answer: Answer | Problem) -> Answer:
    """The answer. UsageError if it is a problem."""
    if isinstance(answer, Problem):
        raise UsageError(f"{answer.message}; {answer.help}" if answer.help else answer.message)
    return answer


def _stdin() -> list[Report]:
    data = sys.stdin.buffer.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise UsageError(f"the report on standard input is larger than {MAX_BYTES >> 20} MiB")
    try:
        return parsed(data, "<stdin>")
    except (NotAReport, Unreadable) as error:
        raise UsageError(f"standard input: {error}; expected {EXPECTED}") from None


def _installed() -> list[Offer]:
    """The devices of the installed drivers."""
    from msaa_lint.experiments.confirm.devices import running
    from msaa_lint.experiments.confirm.vulkan_errors import Unusable

    try:
        return [Offer(report) for report in running(MAX_SECONDS)]
    except Unusable as error:
        raise UsageError(f"{error}; `msaa-lint device --list` names the built-in devices") from None


def _list(output: Output) -> int:
    profiles = {name: profile for name in names() if (profile := builtin(name)) is not None}
    if output == "json":
        rows = [
            {"key": key, "name": profile.name, "source": profile.source}
            for key, profile in profiles.items()
        ]
        print(dump_indented({"schema": SCHEMA, "profiles": rows}))
        return 0
    columns = [Column("name"), Column("device"), Column("source")]
    lines = [
        ("", list(map(cell, (key, profile.name, profile.source))))
        for key, profile in profiles.items()
    ]
    print_tables(sys.stdout.write, report_options({}, sys.stdout), [Table(columns, lines)])
    return 0


def _print(offers: Sequence[Offer]) -> None:
    out, options = sys.stdout.write, report_options({}, sys.stdout)
    for number, offer in enumerate(offers):
        counts = words.table(offer)
        out("\n" if number else "")
        for columns, rows, style in (
            ([""], [[words.title(offer)]], "bold"),
            (counts.heads, counts.rows, ""),
            ([""], [[line] for line in counts.legend], "dim"),
            (["", ""], words.rows(offer), ""),
        ):
            print_tables(
                out,
                options,
                [
                    Table(
                        list(map(Column, columns)), [(style, list(map(cell, row))) for row in rows]
                    )
                ],
            )

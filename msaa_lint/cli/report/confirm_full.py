"""The text report of `msaa-lint confirm`: a table per device, then details of single passes."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console
from rich.text import Text

from msaa_lint.core.finding import Finding
from msaa_lint.experiments.confirm.outcome import FAILED, WRONG, DeviceRun

from . import Options, Write
from .confirm_text import (
    CREATED,
    PIXELS,
    agreement_of,
    details,
    heading,
    summary,
    time_text,
    times_of,
)
from .console import cell, open_console
from .escape import display
from .tables import FIGURE, NAME, Column, Table, print_tables

STYLES = {
    "confirmed": "green",
    "refused": "yellow",
    "skipped": "",
    **dict.fromkeys((*WRONG, FAILED), "bold red"),
}


def render(
    runs: Sequence[DeviceRun], errors: Sequence[Finding], out: Write, options: Options
) -> None:
    """Prints a table per device and the details below it; for several devices, a table of all of
    them first.

    `errors` go to the standard error stream instead.
    """
    console = open_console(out, options)
    usable = [run for run in runs if not run.unusable]
    if len(usable) > 1:
        _print_comparison(usable, out, options)
        console.print()
    for number, run in enumerate(runs):
        if number:
            console.print()
        _device(run, console, out, options)


def _device(run: DeviceRun, console: Console, out: Write, options: Options) -> None:
    if run.unusable:
        console.print(
            f"{display(run.title)}: cannot be used: {display(run.unusable)}", soft_wrap=True
        )
        return
    console.print(heading(run), style="bold", soft_wrap=True)
    for note in run.notes:
        console.print(display(note), soft_wrap=True)
    console.print()
    _print_verdicts(run, out, options)
    console.print()
    lines = [line for verdict in run.verdicts for line in details(verdict, options.verbose)]
    for line in lines:
        console.print(line, soft_wrap=True)
    if lines:
        console.print()
    if any(verdict.times is not None for verdict in run.verdicts) and run.cannot_show:
        console.print(f"What this device cannot show: {display(run.cannot_show)}.", soft_wrap=True)
    for line in () if options.quiet else summary(run):
        console.print(line, soft_wrap=True)


def _print_verdicts(run: DeviceRun, out: Write, options: Options) -> None:
    """Prints the verdicts and times of a device: in one table if it fits, else in a table each."""
    names = [Column("file", NAME), Column("pass", NAME)]
    heads = [
        Column(title)
        for title in ("status", "created", "mistakes reported by", "pixels after fixes")
    ]
    times: list[Column] = []
    if any(verdict.times is not None for verdict in run.verdicts):
        times += [
            Column("as written, ms", FIGURE),
            Column("fixed, ms", FIGURE),
            Column("difference here"),
        ]
        if any(verdict.model is not None for verdict in run.verdicts):
            times.append(Column("cost model, MB/s", FIGURE))
    verdicts = [
        [
            cell(verdict.status, STYLES[verdict.status]),
            cell(CREATED[verdict.created]),
            cell(agreement_of(verdict)),
            cell(PIXELS[verdict.pixels_equal]),
        ]
        for verdict in run.verdicts
    ]
    timings = [[cell(text) for text in times_of(verdict)][: len(times)] for verdict in run.verdicts]
    files = [[cell(verdict.file), cell(verdict.name)] for verdict in run.verdicts]
    whole = Table(
        [*names, *heads, *times],
        [
            ("", [*file, *row, *time])
            for file, row, time in zip(files, verdicts, timings, strict=True)
        ],
    )
    parts = [
        Table(
            [
                Column("pass", NAME),
                *(column._replace(title=column.title.replace(", ", ",\n")) for column in columns),
            ],
            [("", [Text(": ").join(file), *row]) for file, row in zip(files, rows, strict=True)],
            1,
        )
        for columns, rows in ((heads, verdicts), (times, timings))
        if columns
    ]
    print_tables(out, options, [whole], parts)


def _print_comparison(runs: Sequence[DeviceRun], out: Write, options: Options) -> None:
    rows: dict[tuple[str, str], list[Text]] = {}
    for column, run in enumerate(runs, 2):
        for verdict in run.verdicts:
            cells = rows.setdefault(
                (verdict.file, verdict.path),
                [cell(verdict.file), cell(verdict.name), *(cell("-") for _ in runs)],
            )
            time = verdict.times.as_written if verdict.times is not None else None
            cells[column] = cell(
                verdict.status + (f", {time_text(time)} ms" if time is not None else ""),
                STYLES[verdict.status],
            )
    columns = [
        Column("file", NAME),
        Column("pass", NAME),
        *(Column(display(run.title)) for run in runs),
    ]
    print_tables(out, options, [Table(columns, [("", cells) for cells in rows.values()])])

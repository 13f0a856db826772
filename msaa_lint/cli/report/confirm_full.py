"""The text report of `msaa-lint confirm`: a table per device, then details of single passes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rich.console import Console
from rich.text import Text

from msaa_lint.core.finding import Finding
from msaa_lint.experiments.confirm.outcome import FAILED, STATUSES, WRONG, AgreementRow, DeviceRun, Verdict
from msaa_lint.experiments.confirm.timing import Timing

from . import Options, Write
from .console import cell, open_console
from .escape import display
from .summary import plural
from .tables import FIGURE, NAME, Column, Table, print_tables

STYLES = {"confirmed": "green", "refused": "yellow", "skipped": "", **dict.fromkeys((*WRONG, FAILED), "bold red")}
_WORDS = {"both": "both", "ours": "only msaa-lint", "theirs": "only the layer", "explained": "explained", "noise": "noise"}
"""Who reports a mistake, by the verdict on it."""


def render(runs: Sequence[DeviceRun], errors: Sequence[Finding], out: Write, options: Options) -> None:
    """Prints a table per device and the details below it; for several devices, a table of all of them first.

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
        console.print(f"{display(run.title)}: cannot be used: {display(run.unusable)}", soft_wrap=True)
        return
    console.print(_heading(run), style="bold", soft_wrap=True)
    for note in run.notes:
        console.print(display(note), soft_wrap=True)
    console.print()
    _print_verdicts(run, out, options)
    console.print()
    details = [line for verdict in run.verdicts for line in _details(verdict, options.verbose)]
    for line in details:
        console.print(line, soft_wrap=True)
    if details:
        console.print()
    if any(verdict.times is not None for verdict in run.verdicts) and run.cannot_show:
        console.print(f"What this device cannot show: {display(run.cannot_show)}.", soft_wrap=True)
    for line in () if options.quiet else _summary(run):
        console.print(line, soft_wrap=True)


def _heading(run: DeviceRun) -> str:
    assert run.device is not None
    device = run.device
    words = [display(device.name)]
    if device.api_version:
        words.append(f"Vulkan {display(device.api_version)}")
    if device.driver:
        words.append(display(device.driver))
    if device.software:
        words.append("software")
    if run.layer is not None:
        words.append("validation layer " + display(str(run.layer.get("version", "")) or str(run.layer.get("name", ""))))
    return " · ".join(words)


def _print_verdicts(run: DeviceRun, out: Write, options: Options) -> None:
    """Prints the verdicts and times of a device: in one table if it fits, else in a table each."""
    names = [Column("file", NAME), Column("pass", NAME)]
    heads = [Column(title) for title in ("status", "created", "mistakes reported by", "pixels after fixes")]
    times: list[Column] = []
    if any(verdict.times is not None for verdict in run.verdicts):
        times += [Column("as written, ms", FIGURE), Column("fixed, ms", FIGURE), Column("difference here")]
        if any(verdict.model is not None for verdict in run.verdicts):
            times.append(Column("cost model, MB/s", FIGURE))
    verdicts = [
        [
            cell(verdict.status, STYLES[verdict.status]),
            cell({True: "yes", False: "no", None: "-"}[verdict.created]),
            cell(_agreement(verdict)),
            cell({True: "same", False: "differ", None: "-"}[verdict.pixels_equal]),
        ]
        for verdict in run.verdicts
    ]
    timings = [[cell(text) for text in _times(verdict)][: len(times)] for verdict in run.verdicts]
    files = [[cell(verdict.file), cell(verdict.name)] for verdict in run.verdicts]
    whole = Table([*names, *heads, *times], [("", [*file, *row, *time]) for file, row, time in zip(files, verdicts, timings, strict=True)])
    parts = [
        Table(
            [Column("pass", NAME), *(column._replace(title=column.title.replace(", ", ",\n")) for column in columns)],
            [("", [Text(": ").join(file), *row]) for file, row in zip(files, rows, strict=True)],
            1,
        )
        for columns, rows in ((heads, verdicts), (times, timings))
        if columns
    ]
    print_tables(out, options, [whole], parts)


def _times(verdict: Verdict) -> list[str]:
    before, after, difference = verdict.times if verdict.times is not None else (None, None, None)
    return [_time(before), _time(after), difference.text if difference is not None else "-", _traffic(verdict)]


def _print_comparison(runs: Sequence[DeviceRun], out: Write, options: Options) -> None:
    rows: dict[tuple[str, str], list[Text]] = {}
    for column, run in enumerate(runs, 2):
        for verdict in run.verdicts:
            cells = rows.setdefault((verdict.file, verdict.path), [cell(verdict.file), cell(verdict.name), *(cell("-") for _ in runs)])
            time = verdict.times.as_written if verdict.times is not None else None
            cells[column] = cell(verdict.status + (f", {_time(time)} ms" if time is not None else ""), STYLES[verdict.status])
    columns = [Column("file", NAME), Column("pass", NAME), *(Column(display(run.title)) for run in runs)]
    print_tables(out, options, [Table(columns, [("", cells) for cells in rows.values()])])


def _agreement(verdict: Verdict) -> str:
    counts = {kind: sum(row.verdict == kind for row in verdict.agreement) for kind in ("both", "ours", "theirs", "explained")}
    words = ", ".join(f"{count} {_WORDS[kind]}" for kind, count in counts.items() if count)
    return words or ("-" if verdict.agrees is None else "none")


def _time(time: Timing | None) -> str:
    return "-" if time is None else f"{time.median:.3g} [{time.low:.3g}, {time.high:.3g}]"


def _traffic(verdict: Verdict) -> str:
    amounts = [amount for version in ("as_written", "fixed") if (amount := (verdict.model or {}).get(version)) is not None]
    return " → ".join(f"{amount['read_mb_per_s'] + amount['write_mb_per_s']:.0f}" for amount in amounts) or "-"


def _details(verdict: Verdict, verbose: bool) -> Iterator[str]:
    """The details of a pass, one per line, after a line that names it."""
    lines = [display(verdict.reason)] if verdict.reason else []
    for kind in ("theirs", "both", "explained", *(("ours", "noise") if verbose else ())):
        lines += [_message(row) for row in verdict.agreement if row.verdict == kind]
    lines += [f"{display(image.image)}: {display(image.text)}" for image in verdict.images if image.equal is not True or image.differing]
    lines += [display(note) for note in verdict.notes]
    lines += [f"picture: {display(path)}" for path in verdict.pictures]
    if lines:
        yield f"{display(verdict.file)}: {display(verdict.name)}: {verdict.status}"
        yield from (f"  {line}" for line in lines)


def _message(row: AgreementRow) -> str:
    """Who reports a mistake, the layer's message ID, the rule, and the layer's text if no rule covers it."""
    words = f"{_WORDS[row.verdict]}: " + " = ".join(display(name) for name in (row.id, row.rule) if name)
    if row.reason:
        words += f" ({display(row.reason)})"
    return f"{words}: {display(row.text)}" if row.verdict == "theirs" and row.text else words


def _summary(run: DeviceRun) -> Iterator[str]:
    counts = {status: sum(verdict.status == status for verdict in run.verdicts) for status in STATUSES}
    words = ", ".join(f"{count} {status}" for status, count in counts.items() if count)
    yield plural(len(run.verdicts), "pass") + (f": {words}" if words else "")
    if run.layer is not None:
        yield "mistakes reported by: " + ", ".join(f"{run.agreement[kind]} {word}" for kind, word in _WORDS.items())

"""What a person reads of `msaa-lint confirm`: a table by device, then what is to be said of single passes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from msaa_lint.experiments.confirm.outcome import DeviceRun
from msaa_lint.experiments.confirm.timing import Timing
from msaa_lint.experiments.confirm.verdict import STATUSES, WRONG, Said, Verdict

from . import Options, Write
from .console import opened
from .escape import shown

STYLES = {"confirmed": "green", "refused": "yellow", "skipped": "", **dict.fromkeys(WRONG, "bold red")}
_WORDS = {"both": "both", "ours": "ours alone", "theirs": "theirs alone", "explained": "explained", "noise": "noise"}


def render(runs: Sequence[DeviceRun], out: Write, options: Options) -> None:
    """Prints every device's table and what there is to say below it; of several devices first one table with all of them."""
    console = opened(out, options)
    usable = [run for run in runs if not run.unusable]
    if len(usable) > 1:
        console.print(_side_by_side(usable))
        console.print()
    for number, run in enumerate(runs):
        if number:
            console.print()
        _device(run, console, options)


def _device(run: DeviceRun, console: Any, options: Options) -> None:
    if run.unusable:
        console.print(f"{shown(run.title)}: cannot be used: {shown(run.unusable)}", soft_wrap=True)
        return
    console.print(_heading(run), style="bold", soft_wrap=True)
    for note in run.notes:
        console.print(shown(note), soft_wrap=True)
    console.print()
    console.print(_table(run))
    console.print()
    said = False
    for verdict in run.verdicts:
        for line in _details(verdict, options):
            console.print(line, soft_wrap=True)
            said = True
    if said:
        console.print()
    if any(verdict.times is not None for verdict in run.verdicts) and run.cannot_show:
        console.print(f"What this device cannot show: {shown(run.cannot_show)}.", soft_wrap=True)
    for line in _summary(run):
        console.print(line, soft_wrap=True)


def _heading(run: DeviceRun) -> str:
    assert run.device is not None
    device = run.device
    words = [shown(device.name)]
    if device.api_version:
        words.append(f"Vulkan {shown(device.api_version)}")
    if device.driver:
        words.append(shown(device.driver))
    if device.software:
        words.append("software")
    if run.layer is not None:
        words.append("validation layer " + shown(str(run.layer.get("version", "")) or str(run.layer.get("name", ""))))
    return " · ".join(words)


def _new_table() -> Any:
    from rich import box
    from rich.table import Table

    return Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)


def _cell(text: str, style: str = "") -> Any:
    from rich.text import Text

    return Text(shown(text), style=style)


def _table(run: DeviceRun) -> Any:
    timed = any(verdict.times is not None for verdict in run.verdicts)
    modelled = timed and any(verdict.model is not None for verdict in run.verdicts)
    table = _new_table()
    for name in ("file", "pass", "status", "created", "layer and we", "pixels of the fixed version"):
        table.add_column(name, overflow="fold")
    if timed:
        for name in ("as written, ms", "fixed, ms", "difference here"):
            table.add_column(name, overflow="fold", justify="right")
    if modelled:
        table.add_column("cost model, MB/s", overflow="fold", justify="right")
    for verdict in run.verdicts:
        cells = [
            _cell(verdict.file),
            _cell(verdict.name),
            _cell(verdict.status, STYLES[verdict.status]),
            _cell({True: "yes", False: "no", None: "-"}[verdict.created]),
            _cell(_agreement(verdict)),
            _cell({True: "same", False: "differ", None: "-"}[verdict.pixels_equal]),
        ]
        if timed:
            times = verdict.times
            cells += [_cell(_time(each)) for each in (times[:2] if times is not None else (None, None))]
            apart = times.difference if times is not None else None
            cells.append(_cell(apart.words if apart is not None else "-"))
        if modelled:
            cells.append(_cell(_model(verdict)))
        table.add_row(*cells)
    return table


def _side_by_side(runs: Sequence[DeviceRun]) -> Any:
    table = _new_table()
    for name in ("file", "pass", *(run.title for run in runs)):
        table.add_column(_cell(name), overflow="fold")
    rows: dict[tuple[str, str], list[Any]] = {}
    for number, run in enumerate(runs):
        for verdict in run.verdicts:
            names = [_cell(verdict.file), _cell(verdict.name)]
            cells = rows.setdefault((verdict.file, verdict.path), [*names, *(_cell("-") for _ in runs)])
            time = verdict.times.as_written if verdict.times is not None else None
            words = verdict.status + (f", {_time(time)} ms" if time is not None else "")
            cells[2 + number] = _cell(words, STYLES[verdict.status])
    for cells in rows.values():
        table.add_row(*cells)
    return table


def _agreement(verdict: Verdict) -> str:
    kinds = ("both", "ours", "theirs", "explained")
    counted = {kind: sum(each.verdict == kind for each in verdict.said) for kind in kinds}
    words = ", ".join(f"{count} {_WORDS[kind]}" for kind, count in counted.items() if count)
    return words or ("-" if verdict.agrees is None else "nothing")


def _time(time: Timing | None) -> str:
    return "-" if time is None else f"{time.median:.3g} [{time.low:.3g}, {time.high:.3g}]"


def _model(verdict: Verdict) -> str:
    model = verdict.model or {}
    texts = []
    for version in ("as_written", "fixed"):
        amount = model.get(version)
        if amount is not None:
            texts.append(f"{amount['read_mb_per_s'] + amount['write_mb_per_s']:.0f}")
    return " → ".join(texts) or "-"


def _details(verdict: Verdict, options: Options) -> Iterator[str]:
    """What is to be said of a pass, its name first, each on a line of its own."""
    lines = [shown(verdict.reason)] if verdict.reason else []
    order = ("theirs", "both", "explained", *(("ours", "noise") if options.statistics else ()))
    for kind in order:
        lines += [_said(each) for each in verdict.said if each.verdict == kind]
    lines += [f"{shown(each.image)}: {shown(each.words)}" for each in verdict.images if each.equal is not True or each.differing]
    lines += [shown(note) for note in verdict.notes]
    lines += [f"picture: {shown(path)}" for path in verdict.pictures]
    if lines:
        yield f"{shown(verdict.file)}: {shown(verdict.name)}: {verdict.status}"
        yield from (f"  {line}" for line in lines)


def _said(said: Said) -> str:
    """One line of the agreement: whose it is, the layer's id, our rule, and of what we do not say all that the layer says."""
    words = f"{_WORDS[said.verdict]}: " + " = ".join(shown(each) for each in (said.id, said.rule) if each)
    if said.reason:
        words += f" ({shown(said.reason)})"
    return f"{words}: {shown(said.text)}" if said.verdict == "theirs" and said.text else words


def _summary(run: DeviceRun) -> Iterator[str]:
    counted = {status: sum(verdict.status == status for verdict in run.verdicts) for status in STATUSES}
    total = len(run.verdicts)
    words = ", ".join(f"{count} {status}" for status, count in counted.items() if count)
    yield f"{total} {'pass' if total == 1 else 'passes'}{': ' + words if words else ''}"
    agreement = run.agreement
    if run.layer is not None:
        yield (
            f"layer and we: {agreement['both']} both, {agreement['ours']} ours alone, {agreement['theirs']} theirs alone, "
            f"{agreement['explained']} explained, {agreement['noise']} noise"
        )

"""What `msaa-lint corpus` shows, before layout: lines about the runs, and tables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from msaa_lint.linter.corpus.database import Rows
from msaa_lint.linter.corpus.summary import Group, Run, Since, Summary

from .cost_rows import LINE, MAX_ROWS, PASS, Row, Table, figure
from .escape import display
from .words import plural

MAX_RUNS = 5
"""Runs with a line of their own."""

NOT_STATED = "(not stated)"

_MORE_ROWS = "more rows: --output json has all"

Captioned = tuple[str, Table]
"""A table with its caption."""


def heads(summary: Summary) -> list[str]:
    """The runs, each with its rows and what wrote it."""
    lines = [_head(run) for run in summary.runs[:MAX_RUNS]]
    rest = summary.runs[MAX_RUNS:]
    return [*lines, *([f"{plural(len(rest), 'more corpus')}: {_counts(rest)}"] if rest else [])]


def _head(run: Run) -> str:
    return f"{run.file}: {_counts([run])} (msaa-lint {run.version}, edition {run.edition})"


def _counts(runs: Sequence[Run]) -> str:
    inputs, findings, passes = (
        sum(getattr(run, name) for run in runs) for name in ("inputs", "findings", "passes")
    )
    return f"{plural(inputs, 'input')}, {plural(findings, 'finding')}, {plural(passes, 'pass')}"


def remarks(summary: Summary) -> list[tuple[str, str]]:
    """What to know of the figures, each with a word before it."""
    found = (
        [("note", "what several fixes save of the same bytes counts for each of them")]
        if summary.groups
        else []
    )
    if summary.suppressed:
        found.append(("note", f"{plural(summary.suppressed, 'suppressed finding')} not counted"))
    return [
        *found,
        *(("since", remark) for remark in (summary.since.remarks if summary.since else ())),
    ]


def tables(summary: Summary) -> list[Captioned]:
    """The tables, each with its caption; none of those that would be empty."""
    title = ", ".join(summary.keys)
    shown = _shown(len(summary.groups), summary.group_count)
    caption = (
        f"{summary.keys[0].capitalize()}s{' with their rules' if summary.wholes else ''}, "
        f"most expensive first{shown}"
    )
    inputs = f"Inputs, most expensive first{_shown(len(summary.top_inputs), summary.input_count)}"
    groups = list(_nested(summary))
    found = [
        (caption, _sums(groups, title, "rules" if summary.keys == ("input",) else "inputs")),
        ("Prices of single findings in MB/s", _prices(groups, title)),
        (inputs, _sums([(LINE, group) for group in summary.top_inputs], "input", "rules")),
    ]
    return [
        each for each in [*found, *(_since(summary.since) if summary.since else ())] if each[1].rows
    ]


def _nested(summary: Summary) -> Iterator[tuple[str, Group]]:
    """The groups with the kinds of their rows: each whole before its groups."""
    if not summary.wholes:
        yield from ((LINE, group) for group in summary.groups)
    for whole in summary.wholes:
        yield PASS, whole
        yield from ((LINE, group) for group in summary.groups if group.names[0] == whole.names[0])


def _shown(count: int, total: int) -> str:
    return f" ({count} of {total}; --top has more)" if count < total else ""


def _sums(groups: Iterable[tuple[str, Group]], title: str, counted: str) -> Table:
    """The numbers of findings and of the inputs, or rules, that they are of, and what fixes
    save.
    """
    rows = []
    for kind, group in groups:
        saved = (group.traffic_mb_per_s, group.memory_mib, group.milliwatts)
        figures = (
            str(group.findings),
            str(getattr(group, counted)),
            *(figure(value, 1) for value in saved),
        )
        rows.append(Row(kind, (_name(group),), figures))
    return Table((title,), ("findings", counted, "MB/s", "MiB", "mW"), rows)


def _prices(groups: Iterable[tuple[str, Group]], title: str) -> Table:
    rows = [
        Row(
            kind,
            (_name(group),),
            (
                str(group.priced),
                *("" if value is None else figure(value, 1) for value in group.prices),
            ),
        )
        for kind, group in groups
        if group.prices.max
    ]
    return Table((title,), ("priced", "p50", "p90", "p99", "max"), rows)


def _name(group: Group) -> str:
    """The last of the names of a group."""
    return _stated(group.names[-1])


def _stated(name: str | None) -> str:
    return NOT_STATED if name is None else display(name)


def since_line(since: Since) -> str:
    """What is new and what is gone since an earlier run, in numbers."""
    inputs = (
        f"; {plural(since.new_inputs, 'new input')}, {since.gone_inputs} gone"
        if since.new_inputs or since.gone_inputs
        else ""
    )
    inputs += (
        f"; {plural(since.moved_inputs, 'input')} moved or renamed" if since.moved_inputs else ""
    )
    return (
        f"since {', '.join(file.name for file in since.files)}: "
        f"{plural(since.new, 'new finding')}, {since.gone} gone{inputs}"
    )


def _since(since: Since) -> list[Captioned]:
    changes = [
        Row(
            LINE,
            (_stated(each.rule),),
            (
                str(each.new),
                str(each.gone),
                figure(each.new_mb_per_s, 1),
                figure(each.gone_mb_per_s, 1),
            ),
        )
        for each in since.changes
    ]
    places = [
        Row(
            LINE,
            (
                _stated(each.rule),
                _stated(each.input) + (f":{each.line}" if each.line is not None else ""),
            ),
            ("" if each.traffic_mb_per_s is None else figure(each.traffic_mb_per_s, 1),),
        )
        for each in since.new_findings
    ]
    return [
        (
            "What has changed by rule",
            Table(("rule",), ("new", "gone", "new MB/s", "gone MB/s"), changes),
        ),
        (
            f"New findings, most expensive first{_shown(len(places), since.new)}",
            Table(("rule", "place"), ("MB/s",), places),
        ),
    ]


def query_table(result: Rows) -> Table:
    """The rows of a query, as many as a person reads, and a last one that says that there are more.
    The numeric columns at the end are figures.
    """
    width = len(result.columns)
    while width > 1 and result.numeric[width - 1]:
        width -= 1
    rows = []
    for number, values in enumerate(result.rows):
        cells = (
            [_cell(value) for value in values]
            if number < MAX_ROWS
            else [_MORE_ROWS, *[""] * (len(result.columns) - 1)]
        )
        rows.append(Row(LINE, tuple(cells[:width]), tuple(cells[width:])))
        if number == MAX_ROWS:
            break
    heads = list(map(display, result.columns))
    return Table(tuple(heads[:width]), tuple(heads[width:]), rows)


def _cell(value: Any) -> str:
    return (
        "" if value is None else f"{value:.6g}" if isinstance(value, float) else display(str(value))
    )

"""Findings by rule, as a text table."""

from __future__ import annotations

from operator import add

from rich.text import Text

from msaa_lint.core.finding import Finding, Price, Result, rank

from . import Options, Write
from .escape import display
from .summary import ON_TILER, converted_saving, files_saving, is_summed, usable_price
from .tables import FIGURE, NAME, TEXT, Column, Table, print_tables

UNITS = ("MB/s", "MiB", "mW")
_KINDS = {"code": TEXT, "rule": NAME, "severity": TEXT}


def render(result: Result, out: Write, options: Options) -> None:
    """Prints the table, the most frequent rule first; nothing if there is no finding. A rule has a
    line for each severity of its findings.

    If findings have prices, more columns have their sums, without those of choices and of fixes
    that cannot be made. The last lines have what `--fix` and `--fix --unsafe-fixes` save, which is
    less than the sums if findings are about the same bytes.
    """
    groups: dict[tuple[str, str, str], _Group] = {}
    for finding in result.findings:
        groups.setdefault(
            (display(finding.code), display(finding.rule), finding.severity), _Group()
        ).add(finding)
    if not groups:
        return
    rows = sorted(groups.items(), key=lambda item: (-item[1].findings, -rank(item[0][2]), item[0]))
    cells = [["count", "code", "rule", "severity", *UNITS]]
    for (code, rule, severity), group in rows:
        cells.append(
            [
                str(group.findings),
                code,
                rule,
                severity,
                *(_figures(group.price) if group.price else [""] * len(UNITS)),
            ]
        )
    for savings, words in (
        (files_saving(result), "saved by "),
        (converted_saving(result), "converted, by "),
    ):
        for saving, option in ((savings.safe, "--fix"), (savings.all, "--unsafe-fixes")):
            if saving.price is not None:
                title = words + option + (ON_TILER if saving.assumes_tiler else "")
                cells.append([str(saving.findings), "", title, "", *_figures(saving.price)])
    if all(cell == "" for row in cells[1:] for cell in row[4:]):
        cells = [row[:4] for row in cells]
    # The count comes first, so that no line begins with text from an input.
    columns = [Column(title, _KINDS.get(title, FIGURE)) for title in cells[0]]
    lines = [("", [Text(cell) for cell in row]) for row in cells[1:]]
    print_tables(out, options, [Table(columns, lines)], [Table(columns, lines, 1)])


class _Group:
    """The number of findings of a rule, and the sum of their prices, if there are any."""

    def __init__(self) -> None:
        self.findings = 0
        self.price: Price | None = None

    def add(self, finding: Finding) -> None:
        """Counts a finding."""
        self.findings += 1
        price = usable_price(finding) if is_summed(finding) else None
        if price is not None:
            self.price = Price(*map(add, self.price, price)) if self.price is not None else price


def _figures(price: Price) -> list[str]:
    """Traffic, memory, and power."""
    return [
        f"{value:.1f}"
        for value in (
            price.read_mb_per_s + price.write_mb_per_s,
            price.memory_mib,
            price.milliwatts,
        )
    ]

"""Findings by rule, as a text table."""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.core.finding import Finding, Price, Result, rank

from .escape import display
from .summary import together, usable_price

UNITS = ("MB/s", "MiB", "mW")


def table(result: Result) -> str:
    """The table, the most frequent rule first; empty if there is no finding. A rule has a line for each severity of its findings.

    If findings have prices, more columns have their sums, and the last line what all findings cost together, which is at most the sum.
    """
    groups: dict[tuple[str, str, str], list[Finding]] = {}
    for finding in result.findings:
        groups.setdefault((display(finding.code), display(finding.rule), finding.severity), []).append(finding)
    if not groups:
        return ""
    rows = sorted(groups.items(), key=lambda item: (-len(item[1]), -rank(item[0][2]), item[0]))
    cells = [["count", "code", "rule", "severity", *UNITS]]
    for (code, rule, severity), findings in rows:
        prices = [price for price in map(usable_price, findings) if price is not None]
        cells.append([str(len(findings)), code, rule, severity, *(_figures(prices) if prices else [""] * len(UNITS))])
    total = together(result)
    if total is not None:
        cells.append(["", "", "together", "", *_figures([total])])
    else:
        cells = [row[:4] for row in cells]
    # The count comes first, so that no line begins with text from an input.
    widths = [max(len(row[column]) for row in cells) for column in range(len(cells[0]))]
    return "".join("  ".join(map(_aligned, row, widths, range(len(row)))).rstrip() + "\n" for row in cells)


def _aligned(cell: str, width: int, column: int) -> str:
    return f"{cell:<{width}}" if column in (1, 2, 3) else f"{cell:>{width}}"


def _figures(prices: Sequence[Price]) -> list[str]:
    """Sums of prices: total traffic, memory, power."""
    traffic = sum(price.read_mb_per_s + price.write_mb_per_s for price in prices)
    return [f"{value:.1f}" for value in (traffic, sum(p.memory_mib for p in prices), sum(p.milliwatts for p in prices))]

"""The chart of `cost --chart`: a frame as written, fixed, and with other sample counts, resolved inline and separately."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from msaa_lint.frame.cost.amounts import FrameCost
from msaa_lint.frame.cost.input_cost import CostComparison, CostedFrame
from msaa_lint.frame.cost.variants import AS_WRITTEN, NONE, Variant

from .figure import save_figure

READ_COLOR, WRITE_COLOR = "#56B4E9", "#D55E00"
"""Sky blue and vermilion of Okabe and Ito's palette, distinct for all kinds of color blindness and in grayscale; reads are also hatched."""

_BAR, _GAP = 0.72, 0.55


class Bar(NamedTuple):
    """A frame's traffic in MB/s and power in mW; there is a gap between bars of different groups."""

    name: str
    group: str
    read: float
    write: float
    milliwatts: float


def bars(frame: CostedFrame) -> list[Bar]:
    """The bars of a frame, from top to bottom."""
    after = "" if frame.fixed is None else ", same fixes"
    return [*(_bar(title, "", cost) for title, cost in frame.states), *_variants(frame.counts, after)]


def compared_bars(comparison: CostComparison) -> list[Bar]:
    """The bars of two inputs with one frame each: the old one as written, then all of the new one."""
    old = [_bar("old, as written", "", frame.cost) for frame in comparison.old]
    new = [bar if bar.group else bar._replace(name=f"new, {bar.name}") for frame in comparison.new for bar in bars(frame)]
    return old + new


def _variants(variants: Sequence[Variant], after: str) -> Iterator[Bar]:
    placed = {variant.samples for variant in variants if variant.resolve not in (AS_WRITTEN, NONE)}
    for variant in variants:
        if variant.resolve == AS_WRITTEN and variant.samples in placed:
            continue
        place = f", {variant.resolve}" if variant.samples in placed else ""
        offered = " (not supported)" if variant.offered is False else ""
        yield _bar(f"{variant.samples}x{place}{offered}{after}", str(variant.samples), variant.cost)


def _bar(name: str, group: str, cost: FrameCost) -> Bar:
    total = cost.total
    return Bar(name, group, total.read_mb_per_s, total.write_mb_per_s, total.milliwatts)


def draw(bars: Sequence[Bar], title: str, subtitle: str, cost: FrameCost, format: str) -> bytes:
    """The chart as SVG or PNG; `title` and `subtitle` are already escaped. ModuleNotFoundError if matplotlib is not installed."""
    positions = _positions(bars)

    def draw_on(figure: Any) -> None:
        axes = figure.add_subplot()
        _draw_bars(axes, bars, positions, cost)
        figure.suptitle(title, x=0.01, ha="left", fontweight="bold")
        axes.set_title(subtitle, loc="left", fontsize=9)

    return save_figure(10, 1.9 + 0.36 * (positions[-1] if positions else 0), draw_on, format)


def _positions(bars: Sequence[Bar]) -> list[float]:
    positions: list[float] = []
    at, group = 0.0, bars[0].group if bars else ""
    for bar in bars:
        at += _GAP if bar.group != group else 0.0
        group = bar.group
        positions.append(at)
        at += 1
    return positions


def _draw_bars(axes: Any, bars: Sequence[Bar], positions: Sequence[float], cost: FrameCost) -> None:
    reads, writes = [bar.read for bar in bars], [bar.write for bar in bars]
    edge: dict[str, Any] = {"height": _BAR, "edgecolor": "black", "linewidth": 0.6}
    axes.barh(positions, reads, color=READ_COLOR, hatch="///", label="read", **edge)
    axes.barh(positions, writes, left=reads, color=WRITE_COLOR, label="write", **edge)
    longest = max((bar.read + bar.write for bar in bars), default=0.0) or 1.0
    for bar, at in zip(bars, positions, strict=True):
        share = 100 * bar.milliwatts / cost.budget_milliwatts
        text = f"{bar.read + bar.write:.0f} MB/s, {bar.milliwatts:.0f} mW ({share:.1f} %)"
        box = {"facecolor": "white", "edgecolor": "none", "pad": 1}
        axes.text(bar.read + bar.write + longest * 0.01, at, text, va="center", fontsize=9, bbox=box)
    axes.set_yticks(positions, [bar.name for bar in bars])
    axes.invert_yaxis()
    axes.set_xlim(0, longest * 1.4)
    axes.set_xlabel(f"traffic with external memory, MB/s (share of {cost.budget_milliwatts:g} mW in parentheses)")
    axes.ticklabel_format(axis="x", style="plain", useOffset=False)
    axes.grid(axis="x", color="#CCCCCC", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=2, frameon=False)

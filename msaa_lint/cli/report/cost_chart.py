"""The chart of `cost --chart`: a frame as written, fixed, and with other sample counts, resolved
inline and separately.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from msaa_lint.frame.cost.amounts import FrameCost
from msaa_lint.frame.cost.input_cost import CostComparison, CostedFrame
from msaa_lint.frame.cost.variants import AS_WRITTEN, NONE, Variant

from .figure import INK, Figure, Spec, title

COLORS = {"read": "#56B4E9", "write": "#D55E00"}
"""Sky blue and vermilion of Okabe and Ito's palette: distinct for all kinds of color blindness, and
one lighter than the other.
"""

_WIDTH, _STEP = 420, 20
"""The length of the longest bar, and the distance of bars, in pixels."""


class Bar(NamedTuple):
    """A frame's traffic in MB/s and power in mW; there is a gap between bars of different
    groups.
    """

    name: str
    group: str
    read: float
    write: float
    milliwatts: float


def bars(frame: CostedFrame) -> list[Bar]:
    """The bars of a frame, from top to bottom."""
    after = "" if frame.fixed is None else ", same fixes"
    return [
        *(_bar(title, "", cost) for title, cost in frame.states),
        *_variants(frame.counts, after),
    ]


def compared_bars(comparison: CostComparison) -> list[Bar]:
    """The bars of two inputs with one frame each: the old one as written, then all of the new
    one.
    """
    old = [_bar("old, as written", "", frame.cost) for frame in comparison.old]
    new = [
        bar if bar.group else bar._replace(name=f"new, {bar.name}")
        for frame in comparison.new
        for bar in bars(frame)
    ]
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


def chart(bars: Sequence[Bar], heading: str, subheading: str, cost: FrameCost) -> Spec:
    """The chart; `heading` and `subheading` are already escaped."""
    import altair

    rows = _rows(bars)
    amounts = [
        {"row": row, "access": access, "start": start, "end": start + amount, "amount": amount}
        for row, bar in zip(rows, bars, strict=True)
        for access, start, amount in (("read", 0.0, bar.read), ("write", bar.read, bar.write))
    ]
    texts = [
        {
            "row": row,
            "start": 0.0,
            "end": bar.read + bar.write,
            "name": bar.name,
            "text": _text(bar, cost),
        }
        for row, bar in zip(rows, bars, strict=True)
    ]
    longest = max((bar.read + bar.write for bar in bars), default=0.0) or 1.0
    share = (
        ""
        if cost.budget_milliwatts is None
        else f" (share of {cost.budget_milliwatts:g} mW in parentheses)"
    )
    units = f"traffic with external memory, MB/s{share}"
    # Names can be equal, so that the vertical axis is of rows.
    y = altair.Y(
        "row:O",
        axis=None,
        scale=altair.Scale(domain=list(range(rows[-1] + 1 if rows else 1)), paddingInner=0.25),
    )

    def x(field: str) -> Any:
        # The bars have figures beside them, which lines would cross.
        axis = altair.Axis(labelExpr="format(datum.value, ',~f')", tickCount=6, grid=False)
        return altair.X(
            field,
            type="quantitative",
            title=units,
            scale=altair.Scale(domain=[0, longest], nice=False),
            axis=axis,
        )

    color = altair.Color(
        "access:N",
        scale=altair.Scale(domain=list(COLORS), range=list(COLORS.values())),
        legend=altair.Legend(orient="top"),
    )
    tooltip = [altair.Tooltip("access:N"), altair.Tooltip("amount:Q", title="MB/s", format=".1f")]
    figure = Figure()
    beside = figure.chart(texts)
    layers = [
        figure.chart(amounts)
        .mark_bar(stroke=INK, strokeWidth=0.6)
        .encode(x("start"), y, x2="end", color=color, tooltip=tooltip),
        beside.mark_text(align="right", dx=-6, limit=_WIDTH, aria=False).encode(
            x("start"), y, text="name:N", tooltip="name:N"
        ),
        beside.mark_text(align="left", dx=6, aria=False).encode(x("end"), y, text="text:N"),
    ]
    panel = altair.layer(*layers).properties(width=_WIDTH, height=altair.Step(_STEP))
    figure.add([panel], title(heading, [subheading], 1.5 * _WIDTH, size=13))
    return figure.spec()


def _text(bar: Bar, cost: FrameCost) -> str:
    share = (
        ""
        if cost.budget_milliwatts is None
        else f" ({100 * bar.milliwatts / cost.budget_milliwatts:.1f} %)"
    )
    return f"{bar.read + bar.write:.0f} MB/s, {bar.milliwatts:.0f} mW{share}"


def _rows(bars: Sequence[Bar]) -> list[int]:
    """The row of each bar; one is free between groups."""
    rows: list[int] = []
    for before, bar in zip([None, *bars], bars, strict=False):
        apart = before is not None and bar.group != before.group
        rows.append((rows[-1] if rows else -1) + (2 if apart else 1))
    return rows

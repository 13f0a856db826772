"""The waterfall: from the cost of a frame as written, fix by fix, to its cost as fixed, and with
one sample.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Finding
from msaa_lint.frame.cost.amounts import Amount
from msaa_lint.frame.cost.compare import NOTHING, SAME, Comparison
from msaa_lint.frame.cost.input_cost import CostedFrame, FixStep, added
from msaa_lint.frame.cost.model import difference
from msaa_lint.frame.cost.variants import NONE
from msaa_lint.linter.costed_frames import MAX_STEPS

from ..cost_rows import figure
from ..words import plural

_EXACT = 5e-4
"""What remains is shown from this many MB/s, MiB, or mW."""


class Step(NamedTuple):
    """A change of the cost: negative where it saves. `finding` is the one that a fix removes."""

    name: str
    detail: str
    change: Amount
    finding: Finding | None = None


class Bar(NamedTuple):
    """A row. The bar goes from `start` to `start + length`, in per cent of the longest; figures are
    text.

    `kind` is `total`, `saving`, `addition`, or `single` for the frame with one sample.
    """

    name: str
    detail: str
    kind: str
    start: float
    length: float
    traffic: str
    milliwatts: str
    memory: str
    finding: Finding | None


def of_frame(frame: CostedFrame) -> list[Bar]:
    """The rows of a frame: empty if nothing is fixed, and it is not multisampled."""
    totals: list[tuple[str, str, Amount]] = []
    single = next((each.cost.total for each in frame.counts if each.resolve == NONE), None)
    if single is not None:
        totals.append(
            (
                "with 1x",
                "the same frame without multisampling"
                + ("" if frame.fixed is None else ", with the same fixes"),
                single,
            )
        )
    if frame.fixed is None:
        return _bars([], frame.cost.total, ("as written", ""), totals) if totals else []
    steps = _fix_steps(frame.fix_steps, frame.cost.total, frame.fixed.total)
    title, _ = frame.states[-1]
    return _bars(
        steps,
        frame.cost.total,
        ("as written", ""),
        [("as fixed", title, frame.fixed.total), *totals],
    )


def of_comparison(comparison: Comparison) -> list[Bar]:
    """The rows of a comparison: from the old total, pass by pass, to the new one; empty if both
    cost the same.
    """
    total = comparison.total
    if total.status == SAME:
        return []
    steps = [
        Step(each.name, each.status, each.difference)
        for each in comparison.passes
        if each.status != SAME
    ]
    # Passes count the memory of the images that they use, also if others use them: only totals add
    # up.
    steps = [step._replace(change=step.change._replace(memory_mib=0.0)) for step in steps]
    steps = [step for step in steps if any(step.change)]
    steps = [
        *_largest(steps),
        *_rest("images", "memory that no pass alone accounts for", steps, total.difference),
    ]
    return _bars(steps, total.old or NOTHING, ("old", ""), [("new", "", total.new or NOTHING)])


def _fix_steps(fixes: Sequence[FixStep], written: Amount, fixed: Amount) -> list[Step]:
    """The fixes that change the cost; and what the others change, or all of them only together."""
    steps = [
        Step(fix.finding.rule, fix.finding.subject, fix.change, fix.finding)
        for fix in fixes
        if any(fix.change)
    ]
    return [
        *steps,
        *_rest(
            "other fixes", "and what fixes change only together", steps, difference(fixed, written)
        ),
    ]


def _rest(name: str, detail: str, steps: Sequence[Step], whole: Amount) -> list[Step]:
    """What the steps leave of the whole change; nothing if they add up."""
    rest = difference(whole, added(step.change for step in steps))
    return [Step(name, detail, rest)] if any(abs(value) >= _EXACT for value in rest) else []


def _largest(steps: Sequence[Step]) -> list[Step]:
    """The steps that change most, in this order, and the others in one."""
    ordered = sorted(
        steps, key=lambda step: (-abs(step.change.traffic_mb_per_s), -abs(step.change.memory_mib))
    )
    if len(ordered) <= MAX_STEPS:
        return ordered
    others = ordered[MAX_STEPS - 1 :]
    return [
        *ordered[: MAX_STEPS - 1],
        Step(plural(len(others), "smaller change"), "", added(step.change for step in others)),
    ]


def _bars(
    steps: Sequence[Step],
    first: Amount,
    name: tuple[str, str],
    totals: Sequence[tuple[str, str, Amount]],
) -> list[Bar]:
    levels = [first.traffic_mb_per_s]
    for step in steps:
        levels.append(levels[-1] + step.change.traffic_mb_per_s)
    scale = max([*levels, *(total.traffic_mb_per_s for _, _, total in totals)], default=0.0) or 1.0

    def bar(
        name: str,
        detail: str,
        kind: str,
        start: float,
        end: float,
        amount: Amount,
        finding: Finding | None = None,
    ) -> Bar:
        low, high = (min(max(value / scale, 0.0), 1.0) for value in sorted((start, end)))
        signed = kind in ("saving", "addition")
        texts = (
            figure(amount.traffic_mb_per_s, 2, signed),
            figure(amount.milliwatts, 1, signed),
            figure(amount.memory_mib, 2, signed),
        )
        return Bar(
            name,
            detail,
            kind,
            round(100 * low, 3),
            round(100 * (high - low), 3),
            *texts,
            finding=finding,
        )

    rows = [bar(*name, "total", 0.0, first.traffic_mb_per_s, first)]
    for step, start in zip(steps, levels, strict=False):
        change = step.change.traffic_mb_per_s
        kind = "addition" if change > 0 or (not change and step.change.memory_mib > 0) else "saving"
        rows.append(
            bar(step.name, step.detail, kind, start, start + change, step.change, step.finding)
        )
    for title, detail, amount in totals:
        kind = "single" if title == "with 1x" else "total"
        rows.append(bar(title, detail, kind, 0.0, amount.traffic_mb_per_s, amount))
    return rows

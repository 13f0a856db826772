"""What fixes save of an input, determined by making them: the cost of its frames before them minus
their cost after them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from msaa_lint.core.finding import Finding, Price, Saving, Savings
from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.input_cost import InputTotal, input_total
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.frame import Frame

from .fixes.fixer import FixResult, Lint, fix_text
from .programs import merge
from .results import FileResult, finding_kind

_DECIMALS = 6
"""Smaller differences are rounding errors: a MB has 10^6 bytes."""


class Trials(NamedTuple):
    """The results of making the safe fixes of a text, and of making all that can be made."""

    safe: FixResult
    all: FixResult


def try_fixes(result: FileResult, lint: Lint, selects: Callable[[Finding], bool]) -> Trials:
    """Makes the fixes of a linted text as `--fix` and `--fix --unsafe-fixes` do; `lint` lints its
    text after fixes.
    """
    safe = fix_text(result, lint, False, selects)
    if any(_is_unsafe(finding) for finding in (*result.findings, *safe.result.findings)):
        return Trials(safe, fix_text(result, lint, True, selects))
    return Trials(safe, safe)


def _is_unsafe(finding: Finding) -> bool:
    return finding.fix is not None and not finding.fix.safe and not finding.fix.shown


def savings(result: FileResult, trials: Trials, prices: bool, converted: bool = False) -> Savings:
    """What the fixes of a text save; without `prices`, only how many findings they remove."""
    before = total(result) if prices else None
    safe = _saving(trials.safe, before, converted)
    return Savings(
        safe,
        safe if trials.all is trials.safe else _saving(trials.all, before, converted),
        converted,
    )


def _saving(fixes: FixResult, before: InputTotal | None, converted: bool) -> Saving:
    findings = merge(fixes.fixed_findings, fixes.result.documents)
    # The parts of source code share findings.
    count = len(
        {(finding_kind(finding), finding.message) for finding in findings}
        if converted
        else findings
    )
    price = difference(before, total(fixes.result)) if before is not None and count else None
    on_tiler = (
        price is not None
        and any(price)
        and any(assumes_tiler(document.device) for document in fixes.result.documents)
    )
    return Saving(count, price, on_tiler)


def assumes_tiler(device: DeviceProfile | None) -> bool:
    """Whether the cost model takes a device for a tile-based GPU without knowing that it is one."""
    return device is None or device.tiler is None


def total(result: FileResult, terms: Terms | None = None) -> InputTotal:
    """The cost of all frames of an input."""
    return input_total(
        [
            frame_cost(Frame(document.document), document.device, terms)
            for document in result.documents
        ]
    )


def difference(before: InputTotal, after: InputTotal) -> Price | None:
    """What the first costs more than the second; None if they cost the same as far as is known, but
    not all is known.
    """
    price = Price(
        *(round(a - b, _DECIMALS) + 0.0 for a, b in zip(before.amount, after.amount, strict=True))
    )
    return None if not any(price) and (before.unknown or after.unknown) else price

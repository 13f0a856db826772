"""What is to be said of each pass: from the gate, the run, the layer's messages, our findings, the pictures and the clock."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from .frame_results import Ran
from .pixels import Compared
from .timing import Difference, Timing

CONFIRMED = "confirmed"
DISAGREES = "disagrees"
REFUSED = "refused"
DIED = "driver-died"
TIMED_OUT = "timed-out"
SKIPPED = "skipped"
STATUSES = (CONFIRMED, DISAGREES, REFUSED, DIED, TIMED_OUT, SKIPPED)
WRONG = frozenset({DISAGREES, DIED, TIMED_OUT})
"""Those that end a run with 1."""

AGREEING = frozenset({"both", "ours", "explained", "noise"})


class Said(NamedTuple):
    """One line of the agreement between the layer and us about a pass.

    `verdict` is `both`, `ours` (the layer says nothing of it), `theirs` (we say nothing of it), `explained` (theirs, and `reason` why we
    are right not to) or `noise`. Of `ours` there is no `id` and no `family`; of `theirs` no `rule`. `expected` is true of `ours` where the
    layer looks at the very thing and should have said it.
    """

    verdict: str
    id: str = ""
    family: str = ""
    rule: str = ""
    text: str = ""
    reason: str = ""
    expected: bool = False


class Times(NamedTuple):
    """How long a pass takes as written and fixed, and what is to be made of it."""

    as_written: Timing | None
    fixed: Timing | None = None
    difference: Difference | None = None


class Verdict(NamedTuple):
    """All of one pass on one device. None is: not found out, and `notes` say why where that is not plain."""

    file: str
    name: str
    path: str
    status: str
    reason: str = ""
    created: bool | None = None
    said: tuple[Said, ...] = ()
    findings: tuple[str, ...] = ()
    agrees: bool | None = None
    pixels_equal: bool | None = None
    images: tuple[Compared, ...] = ()
    times: Times | None = None
    model: Mapping[str, Any] | None = None
    notes: tuple[str, ...] = ()
    pictures: tuple[str, ...] = ()


def agrees(said: Sequence[Said]) -> bool:
    """Whether all that the layer says is either found by us, noise, or explained."""
    return all(each.verdict in AGREEING for each in said)


def settled(made: Verdict, ran: Ran | None, fixed: Ran | None, errors: bool) -> Verdict:
    """A verdict with its status and the reason for it, of a pass that was let through the gate.

    `ran` and `fixed` are the runs as written and fixed (None: there was none); `errors` says whether a finding of severity error was
    there, which a failed creation answers to.
    """
    if ran is None:
        return made._replace(status=SKIPPED, reason=made.reason or "there is nothing to do")
    made = made._replace(created=ran.created)
    for run, version in ((ran, ""), (fixed, "the fixed version: ")):
        if run is not None and run.end == "died":
            return made._replace(status=DIED, reason=version + run.reason)
        if run is not None and run.end == "timed-out":
            return made._replace(status=TIMED_OUT, reason=version + run.reason)
    if ran.end == "left":
        return made._replace(status=SKIPPED, reason=ran.reason)
    reasons = []
    if ran.created is False and not errors:
        reasons.append(f"it cannot be created ({ran.error or 'no reason given'}), and we found no error")
    if ran.created and fixed is not None and fixed.created is False:
        reasons.append(f"the fixed version cannot be created ({fixed.error or 'no reason given'})")
    theirs = [each for each in made.said if each.verdict == "theirs"]
    if theirs:
        more = f" and {len(theirs) - 1} more" if len(theirs) > 1 else ""
        reasons.append(f"the layer says what we do not: {theirs[0].id}{more}")
    if made.pixels_equal is False:
        spoilt = next(each for each in made.images if each.equal is False)
        reasons.append(f"a fix that is marked safe changes the picture: {spoilt.image}: {spoilt.words}")
    return made._replace(status=DISAGREES if reasons else CONFIRMED, reason="; ".join(reasons), agrees=not theirs)


def pixels_equal(compared: Sequence[Compared]) -> bool | None:
    """Whether the pictures of two versions are the same; None where none was compared."""
    told = [each.equal for each in compared if each.equal is not None]
    return all(told) if told else None


def counts(verdicts: Sequence[Verdict]) -> dict[str, int]:
    """How much both say, we alone, they alone, and what of theirs is explained or noise."""
    found = dict.fromkeys(("both", "ours", "theirs", "explained", "noise"), 0)
    for verdict in verdicts:
        for each in verdict.said:
            found[each.verdict] += 1
    return found

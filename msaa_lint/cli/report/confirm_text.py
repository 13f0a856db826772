"""What the reports of `confirm` say: about a device, about a pass, and in all."""

from __future__ import annotations

from collections.abc import Iterator

from msaa_lint.experiments.confirm.outcome import STATUSES, AgreementRow, DeviceRun, Verdict
from msaa_lint.experiments.confirm.timing import Timing

from .escape import display
from .summary import plural

WORDS = {
    "both": "both",
    "ours": "only msaa-lint",
    "theirs": "only the layer",
    "explained": "explained",
    "noise": "noise",
}
"""Who reports a mistake, by the verdict on it."""

PIXELS = {True: "same", False: "differ", None: "-"}
CREATED = {True: "yes", False: "no", None: "-"}


def heading(run: DeviceRun) -> str:
    """The device, its driver, and the validation layer."""
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
        words.append(
            "validation layer "
            + display(str(run.layer.get("version", "")) or str(run.layer.get("name", "")))
        )
    return " · ".join(words)


def times_of(verdict: Verdict) -> list[str]:
    """The times as written and fixed, their difference, and the traffic that the cost model
    estimates.
    """
    before, after, difference = verdict.times if verdict.times is not None else (None, None, None)
    return [
        time_text(before),
        time_text(after),
        difference.text if difference is not None else "-",
        traffic(verdict),
    ]


def agreement_of(verdict: Verdict) -> str:
    """How many mistakes both, or one of msaa-lint and the layer, report."""
    counts = {
        kind: sum(row.verdict == kind for row in verdict.agreement)
        for kind in ("both", "ours", "theirs", "explained")
    }
    words = ", ".join(f"{count} {WORDS[kind]}" for kind, count in counts.items() if count)
    return words or ("-" if verdict.agrees is None else "none")


def time_text(time: Timing | None) -> str:
    """A median in milliseconds, with its interval."""
    return "-" if time is None else f"{time.median:.3g} [{time.low:.3g}, {time.high:.3g}]"


def traffic(verdict: Verdict) -> str:
    """The estimated MB/s as written and fixed."""
    amounts = [
        amount
        for version in ("as_written", "fixed")
        if (amount := (verdict.model or {}).get(version)) is not None
    ]
    return (
        " → ".join(
            f"{amount['read_mb_per_s'] + amount['write_mb_per_s']:.0f}" for amount in amounts
        )
        or "-"
    )


def details(verdict: Verdict, verbose: bool) -> Iterator[str]:
    """The details of a pass, one per line, after a line that names it."""
    lines = reasons(verdict, verbose)
    if lines:
        yield f"{display(verdict.file)}: {display(verdict.name)}: {verdict.status}"
        yield from (f"  {line}" for line in lines)


def reasons(verdict: Verdict, verbose: bool) -> list[str]:
    """What there is to say about a pass: the reason of its status, who reports which mistake,
    differences of pictures, and notes.
    """
    lines = [display(verdict.reason)] if verdict.reason else []
    for kind in ("theirs", "both", "explained", *(("ours", "noise") if verbose else ())):
        lines += [message_text(row) for row in verdict.agreement if row.verdict == kind]
    lines += [
        f"{display(image.image)}: {display(image.text)}"
        for image in verdict.images
        if image.equal is not True or image.differing
    ]
    lines += [display(note) for note in verdict.notes]
    return [*lines, *(f"picture: {display(path)}" for path in verdict.pictures)]


def message_text(row: AgreementRow) -> str:
    """Who reports a mistake, the layer's message ID, the rule, and the layer's text if no rule
    covers it.
    """
    words = f"{WORDS[row.verdict]}: " + " = ".join(
        display(name) for name in (row.id, row.rule) if name
    )
    if row.reason:
        words += f" ({display(row.reason)})"
    return f"{words}: {display(row.text)}" if row.verdict == "theirs" and row.text else words


def summary(run: DeviceRun) -> Iterator[str]:
    """How many passes have which status, and who reports how many mistakes."""
    counts = {
        status: sum(verdict.status == status for verdict in run.verdicts) for status in STATUSES
    }
    words = ", ".join(f"{count} {status}" for status, count in counts.items() if count)
    yield plural(len(run.verdicts), "pass") + (f": {words}" if words else "")
    if run.layer is not None:
        yield "mistakes reported by: " + ", ".join(
            f"{run.agreement[kind]} {word}" for kind, word in WORDS.items()
        )

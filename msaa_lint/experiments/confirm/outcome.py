"""The outcome of `msaa-lint confirm`: how the validation layer and the rules agree, the verdict on
each pass, and the run on each device.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from .frame_results import PassOutcome
from .pixels import ImageComparison
from .timing import Difference, Timing

CONFIRMED = "confirmed"
DISAGREES = "disagrees"
REFUSED = "refused"
DIED = "driver-died"
TIMED_OUT = "timed-out"
FAILED = "failed"
SKIPPED = "skipped"
STATUSES = (CONFIRMED, DISAGREES, REFUSED, DIED, TIMED_OUT, FAILED, SKIPPED)
WRONG = frozenset({DISAGREES, DIED, TIMED_OUT})
"""The statuses for which the exit code is 1; for FAILED, it is 2: nothing was learned about the
pass.
"""

AGREEMENTS = ("both", "ours", "theirs", "explained", "noise")

DEVICE_TYPES = ("OTHER", "INTEGRATED_GPU", "DISCRETE_GPU", "VIRTUAL_GPU", "CPU")
"""VkPhysicalDeviceType by number."""


class AgreementRow(NamedTuple):
    """A message of the layer about a pass, a finding of the rules, or both.

    `verdict` is `both`, `ours` (the layer does not report it), `theirs` (no rule reports it),
    `explained` (no rule reports it, and `reason` says why that is right) or `noise`. Rows of `ours`
    have no `id` and no `family`, rows of `theirs` no `rule`. `expected` is true for `ours` where
    the layer checks exactly this and should have reported it.
    """

    verdict: str
    id: str = ""
    family: str = ""
    rule: str = ""
    text: str = ""
    reason: str = ""
    expected: bool = False


class Times(NamedTuple):
    """The times of a pass as written and fixed, and their difference."""

    as_written: Timing | None
    fixed: Timing | None = None
    difference: Difference | None = None


class ShownImage(NamedTuple):
    """An image for a report, as PNG files: as written; and fixed, with the difference, where both
    versions can be compared.
    """

    image: str
    width: int
    height: int
    as_written: bytes
    fixed: bytes = b""
    difference: bytes = b""


class Verdict(NamedTuple):
    """The verdict on one pass on one device. None means that something was not determined; `notes`
    say why unless it is obvious. `pictures` are the paths of the files written, and `shown` the
    images themselves, if a report asked for them. `rules` are the codes and names of the rules
    whose findings are about the pass.
    """

    file: str
    name: str
    path: str
    status: str
    reason: str = ""
    created: bool | None = None
    agreement: tuple[AgreementRow, ...] = ()
    findings: tuple[str, ...] = ()
    agrees: bool | None = None
    pixels_equal: bool | None = None
    images: tuple[ImageComparison, ...] = ()
    times: Times | None = None
    model: Mapping[str, Any] | None = None
    notes: tuple[str, ...] = ()
    pictures: tuple[str, ...] = ()
    shown: tuple[ShownImage, ...] = ()
    rules: tuple[tuple[str, str], ...] = ()

    def with_status(
        self,
        outcome: PassOutcome | None,
        fixed: PassOutcome | None,
        has_errors: bool,
        left_out: str = "",
    ) -> Verdict:
        """The verdict with its status and reason, for a pass that the device supports.

        `outcome` and `fixed` are those of the pass as written and fixed, None where it did not run;
        `has_errors` says whether there is a finding of severity error, which accounts for a failed
        creation; `left_out` says which of its commands Vulkan forbids, so that nothing confirms
        them.
        """
        if outcome is None:
            return self._replace(status=SKIPPED, reason=self.reason or "there is nothing to do")
        verdict = self._replace(created=outcome.created)
        for run, version in ((outcome, ""), (fixed, "the fixed version: ")):
            status = end_status(run)
            if run is not None and status is not None:
                return verdict._replace(status=status, reason=version + run.reason)
        if outcome.end == "left":
            return verdict._replace(status=SKIPPED, reason=outcome.reason)
        reasons = []
        if outcome.created is False and not has_errors:
            reasons.append(
                f"it cannot be created ({outcome.error or 'no reason given'}), but no rule reports "
                "an error"
            )
        if outcome.created and fixed is not None and fixed.created is False:
            reasons.append(
                f"the fixed version cannot be created ({fixed.error or 'no reason given'})"
            )
        theirs = [row for row in self.agreement if row.verdict == "theirs"]
        if theirs:
            more = f" and {len(theirs) - 1} more" if len(theirs) > 1 else ""
            reasons.append(f"the layer reports what no rule does: {theirs[0].id}{more}")
        if self.pixels_equal is False:
            changed = next(image for image in self.images if image.equal is False)
            reasons.append(
                f"a fix that is marked safe changes the picture: {changed.image}: {changed.text}"
            )
        status = DISAGREES if reasons else REFUSED if left_out else CONFIRMED
        return verdict._replace(
            status=status,
            reason="; ".join([*reasons, *([left_out] if left_out else [])]),
            agrees=not theirs,
        )


def pixels_equal(comparisons: Sequence[ImageComparison]) -> bool | None:
    """Whether the pictures of two versions are equal; None where none was compared, or where one
    could not be.
    """
    results = [comparison.equal for comparison in comparisons if comparison.equal is not None]
    if False in results:
        return False
    return True if results and not any(comparison.missing for comparison in comparisons) else None


class DeviceInfo(NamedTuple):
    """A device, as reports name it. `type` is one of DEVICE_TYPES."""

    name: str
    type: str = "OTHER"
    api_version: str = ""
    driver: str = ""
    vendor_id: int = 0

    @property
    def software(self) -> bool:
        """Whether the device is the CPU."""
        return self.type == "CPU"


class DeviceRun(NamedTuple):
    """The verdicts on all passes on one device, or why the device could not be used (`unusable`).
    `asked` is the device name that the user asked for, `cannot_show` what the times on this device
    do not show, and `printed` the output of driver and layer.
    """

    device: DeviceInfo | None
    layer: Mapping[str, Any] | None = None
    verdicts: Sequence[Verdict] = ()
    notes: Sequence[str] = ()
    unusable: str = ""
    asked: str = ""
    cannot_show: str = ""
    printed: Sequence[str] = ()

    @property
    def agreement(self) -> dict[str, int]:
        """The number of agreement rows by verdict."""
        counts = dict.fromkeys(AGREEMENTS, 0)
        for verdict in self.verdicts:
            for row in verdict.agreement:
                counts[row.verdict] += 1
        return counts

    @property
    def title(self) -> str:
        """The driver's name for the device, otherwise the name that the user asked for."""
        return self.device.name if self.device is not None else self.asked or "no device"


def about(device: Mapping[str, Any]) -> DeviceInfo:
    """A device as its child process describes it. A driver may report anything, so values of the
    wrong type are ignored.
    """
    properties = device.get("properties")
    stated: Mapping[str, Any] = properties if isinstance(properties, dict) else device
    name = _text(stated.get("deviceName")) or _text(device.get("name")) or "unnamed device"
    kind = stated.get("deviceType", device.get("type"))
    if isinstance(kind, int):
        kind = DEVICE_TYPES[kind] if 0 <= kind < len(DEVICE_TYPES) else "OTHER"
    kind = _text(kind).removeprefix("VK_PHYSICAL_DEVICE_TYPE_").upper()
    version = stated.get("apiVersion", device.get("api_version", ""))
    if isinstance(version, int):
        version = f"{version >> 22 & 0x7F}.{version >> 12 & 0x3FF}.{version & 0xFFF}"
    chained = device.get("VkPhysicalDeviceDriverProperties")
    driver = (
        " ".join(_text(chained.get(key)) for key in ("driverName", "driverInfo")).strip()
        if isinstance(chained, dict)
        else ""
    )
    vendor = stated.get("vendorID", 0)
    kind = kind if kind in DEVICE_TYPES else "OTHER"
    return DeviceInfo(
        name,
        kind,
        _text(version),
        driver or _text(device.get("driver")),
        vendor if isinstance(vendor, int) else 0,
    )


def _text(value: object) -> str:
    return value if isinstance(value, str) else ""


def end_status(outcome: PassOutcome | None) -> str | None:
    """The status of a pass that did not go through; None for another one."""
    if outcome is None:
        return None
    return FAILED if outcome.failed else {"died": DIED, "timed-out": TIMED_OUT}.get(outcome.end)


def exit_code(runs: Sequence[DeviceRun], wrong: bool) -> int:
    """2 where an input, a device, or a pass could not be tried, 1 where a pass on some device is
    wrong, otherwise 0.
    """
    if wrong or any(
        run.unusable or any(verdict.status == FAILED for verdict in run.verdicts) for run in runs
    ):
        return 2
    return int(any(verdict.status in WRONG for run in runs for verdict in run.verdicts))

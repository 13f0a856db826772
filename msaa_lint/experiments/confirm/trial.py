"""The trial of inputs on one device: planned, checked against the device, run as written and as
fixed, compared, timed, and judged.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from msaa_lint.core.diagnostics import internal_error
from msaa_lint.core.finding import Finding
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Pass

from . import parts
from .frame_results import FrameRun
from .inputs import Input, of_pass
from .outcome import (
    CONFIRMED,
    DISAGREES,
    FAILED,
    REFUSED,
    SKIPPED,
    AgreementRow,
    DeviceInfo,
    DeviceRun,
    ShownImage,
    Verdict,
    about,
    end_status,
    pixels_equal,
)
from .pixels import ImageComparison, RawImage, compare, read
from .planner import Planner
from .png import Album, PictureFolder, file_name, png, show, version_pictures
from .protocol import Event
from .session import Session
from .timing import cannot_show
from .version_timing import TimedPasses, Version, measure_times
from .vulkan_errors import NotWritten, Unusable

MAX_IMAGE = 256 << 20
"""Maximum size in bytes of an image that is read back."""

MAX_SHOWN = 32 << 20
"""Maximum size in bytes of all pictures that a run keeps for a report."""

NOTHING_TO_COMPARE = (
    "there is no picture to compare: no single-sampled image holds the result of the pass"
)


class TrialOptions(NamedTuple):
    """The options of a trial.

    `gate` skips what the device does not support; `image` is the folder for pictures, which replace
    other files if `force` is true; `time` measures times (None: on a GPU only) with `repeats`;
    `size` and `samples` replace the described ones; `several` gives each device its own folder of
    pictures; `resolves` checks the color resolves too. `shows` keeps the images for a report.
    `traceback` raises the exceptions of internal errors.
    """

    gate: bool = True
    image: str | None = None
    force: bool = False
    time: bool | None = None
    repeats: int = 15
    size: tuple[int, int] | None = None
    samples: int | None = None
    several: bool = False
    resolves: bool = False
    shows: bool = False
    traceback: bool = False


def trial(
    session: Session,
    inputs: Callable[[], Sequence[Input]],
    options: TrialOptions,
    planner: Planner | None = None,
    meanwhile: Callable[[], None] | None = None,
) -> DeviceRun:
    """The outcome of every pass of some inputs on the device of a session, which is closed
    afterwards.

    `inputs` is called while the child process opens the device, and `meanwhile` once while it
    draws.
    """
    asked = session.name or ""
    try:
        session.start()
        sources = inputs()
        session.meanwhile = meanwhile
        device_trial = DeviceTrial(session, options, session.open(), planner or Planner())
        if options.image is not None:
            device_trial.album = picture_folder(options, device_trial.info)
        shown = ShownPictures()
        verdicts = [
            verdict
            for source in sources
            for verdict in shown.limited(device_trial.try_input(source))
        ]
    except Unusable as error:
        return DeviceRun(None, unusable=str(error), asked=asked)
    finally:
        session.close()
    run = device_run(
        device_trial.info, session.layer, verdicts, shown, options, session.validation, asked
    )
    return run._replace(printed=session.printed)


def device_run(
    info: DeviceInfo,
    layer: Mapping[str, Any] | None,
    verdicts: Sequence[Verdict],
    shown: ShownPictures,
    options: TrialOptions,
    validation: bool,
    asked: str,
) -> DeviceRun:
    """The verdicts on all inputs, with notes on the device as a whole."""
    notes = []
    if layer is None and validation:
        missing = (
            "the validation layer is not installed, so its agreement with the rules is unknown"
        )
        notes.append(f"{missing}; on Debian run `apt install vulkan-validationlayers`")
    if info.software and options.time is None and verdicts:
        notes.append("times are not measured on a software driver unless --time requests them")
    if shown.bytes > MAX_SHOWN:
        kept = f"the report has pictures of {MAX_SHOWN >> 20} MiB"
        notes.append(f"{kept}; the others are left out: confirm fewer inputs, or a smaller --size")
    if not options.gate:
        notes.append(
            "the gate is off: what the device does not support was tried too, and those results "
            "are meaningless"
        )
    return DeviceRun(
        info, layer, verdicts, notes, "", asked, cannot_show({"type": info.type}, _is_tiler(info))
    )


class ShownPictures:
    """The pictures that a run keeps for a report: the first ones, up to `MAX_SHOWN` bytes."""

    def __init__(self) -> None:
        self.bytes = 0

    def limited(self, verdicts: Sequence[Verdict]) -> list[Verdict]:
        """The verdicts on an input without the pictures that exceed the limit; one that several
        passes write counts once.
        """
        kept: dict[int, bool] = {}
        for image in (image for verdict in verdicts for image in verdict.shown):
            if id(image) not in kept:
                self.bytes += len(image.as_written) + len(image.fixed) + len(image.difference)
                kept[id(image)] = self.bytes <= MAX_SHOWN
        return [
            verdict._replace(shown=tuple(image for image in verdict.shown if kept[id(image)]))
            for verdict in verdicts
        ]


class DeviceTrial:
    """The trial of inputs on a device, of which `album` gets the pictures."""

    def __init__(
        self, session: Session, options: TrialOptions, device: Mapping[str, Any], planner: Planner
    ) -> None:
        self.session = session
        self.options = options
        self.device = device
        self.info: DeviceInfo = about(device)
        self.planner = planner
        self.timed = options.time if options.time is not None else not self.info.software
        self.album: Album | None = None

    def try_input(self, source: Input) -> list[Verdict]:
        """The verdicts on the passes of one input; if they cannot be determined, one that says why.

        Unusable if the device is gone, NotWritten if a picture cannot be written.
        """
        try:
            return self.verdicts(source)
        except (Unusable, NotWritten):
            raise
        except Exception as error:
            if self.options.traceback:
                raise
            return [
                Verdict(source.file, "", source.prefix.rstrip("."), FAILED, internal_error(error))
            ]

    def verdicts(self, source: Input) -> list[Verdict]:
        """The verdicts on the passes of one input."""
        before = self._version(source.frame, source.file)
        after = self._version(source.fixed, source.file) if source.fixed is not None else None
        comparisons, not_compared = self._compare(source, before, after)
        pictures, shown = self._pictures(source, before, after, comparisons)
        passes = before.planned.passes
        if not passes:
            return [Verdict(source.file, "", source.prefix.rstrip("."), SKIPPED, "it has no pass")]
        versions = {"as written": before, **({"fixed": after} if after is not None else {})}
        measured = (
            measure_times(self.session, versions, self.options.repeats, self.info.software)
            if self.timed
            else TimedPasses({}, {})
        )
        # The cost model's figures are shown next to times only, and take a while to compute.
        agreement, model = self._agreement(source, before), _model(source) if self.timed else {}
        deviations = (
            self.planner.deviations(
                self.session, before.planned, self.device, self.options.resolves
            )
            if before.run.passes
            else {}
        )
        verdicts = []
        for number, planned in enumerate(passes):
            verdict = self._verdict(source, before, number)
            verdict = verdict._replace(
                agreement=tuple(agreement.get(number, ())), times=measured.times.get(number),
                model=model.get(planned.name)
            )  # fmt: skip
            if planned.refused or number in before.refused:
                verdicts.append(
                    verdict._replace(
                        status=REFUSED, reason=planned.refused or before.refused[number]
                    )
                )
                continue
            if planned.failed:
                verdicts.append(verdict._replace(status=FAILED, reason=planned.failed))
                continue
            images = [
                image
                for image in comparisons
                if _concerns(image.image, planned, source.frame, len(passes))
            ]
            equal = pixels_equal(images)
            note = not_compared or (
                NOTHING_TO_COMPARE if after is not None and equal is None else ""
            )
            notes = (*verdict.notes, *([note] if note else ()), *deviations.get(number, ()))
            of_pass = tuple(
                image
                for image in shown
                if _concerns(image.image, planned, source.frame, len(passes))
            )
            verdict = verdict._replace(
                images=tuple(images), pixels_equal=equal, notes=notes, shown=of_pass
            )
            fixed_number = after.number(planned.name) if after is not None else None
            fixed = (
                after.run.passes.get(fixed_number)
                if after is not None and fixed_number is not None
                else None
            )
            has_errors = any(finding.severity == "error" for finding in _findings(source, planned))
            left_out = "; ".join(
                dict.fromkeys(text for at, text in before.planned.left_out if at == number)
            )
            verdict = verdict.with_status(
                before.run.passes.get(number), fixed, has_errors, left_out
            )
            untimed = measured.failures.get(planned.name)
            if untimed is not None and verdict.status in (CONFIRMED, DISAGREES):
                verdict = verdict._replace(
                    status=end_status(untimed) or FAILED,
                    reason=f"while it was timed: {untimed.reason}",
                )
            verdicts.append(verdict)
        if verdicts[-1].status != REFUSED:
            verdicts[-1] = verdicts[-1]._replace(pictures=tuple(pictures))
        return verdicts

    def _version(self, frame: Frame, file: str) -> Version:
        """A frame planned, checked against the device, and run."""
        planned = self.planner.supported(
            self.planner.plan(frame, file, self.options.size, self.options.samples), self.device
        )
        refused = self.planner.gate(planned, self.device) if self.options.gate else {}
        runnable = [
            number
            for number, planned_pass in enumerate(planned.passes)
            if not planned_pass.refused and not planned_pass.failed and number not in refused
        ]
        if not runnable:
            return Version(planned, refused, FrameRun({}), {})
        folder = self.session.folder("pixels")
        try:
            run = self.session.run(planned.plan, runnable, {"pixels": folder})
            return Version(planned, refused, run, dict(_raw_images(run.images, folder)))
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def _compare(
        self, source: Input, before: Version, after: Version | None
    ) -> tuple[list[ImageComparison], str]:
        """The images of both versions compared, or why they cannot be."""
        if after is None or not before.run.passes:
            return [], ""
        if not before.run.whole or not after.run.whole or before.run.failed or after.run.failed:
            reason = before.run.failed or after.run.failed or "not every pass went through"
            return [], f"the pictures are not compared: {reason}"
        if any(
            outcome.created is False
            for version in (before, after)
            for outcome in version.run.passes.values()
        ):
            return [], "the pictures are not compared: a pass could not be created"
        if len(before.run.passes) != len(after.run.passes):
            return (
                [],
                "the pictures are not compared: the device does not support the same passes of "
                "both versions",
            )
        resolves, fixed_resolves = (
            _averages(source.frame),
            _averages(source.fixed) if source.fixed is not None else {},
        )
        moved = {
            name for name, kinds in resolves.items() if fixed_resolves.get(name, kinds) != kinds
        }
        why = "each way of resolving rounds an average in its own way"
        others, tolerances = (before.run.defined, after.run.defined), dict.fromkeys(moved, (1, why))
        return compare(
            before.images, after.images, tolerances, others=others, read=before.planned.read
        ), ""

    def _pictures(
        self,
        source: Input,
        before: Version,
        after: Version | None,
        comparisons: Sequence[ImageComparison],
    ) -> tuple[list[str], list[ShownImage]]:
        """The paths of the pictures written, and the images kept for a report."""
        if self.album is None and not self.options.shows:
            return [], []
        paths, shown = [], []
        first = {comparison.image: comparison.first for comparison in comparisons}
        stem = (source.file, *([str(source.number)] if source.many > 1 else ()))
        for name, raw in sorted(before.images.items()):
            texels = read(raw) if raw.defined else None
            fixed = after.images.get(name) if after is not None else None
            if texels is not None and texels.planes:
                pictures = version_pictures(texels, read(fixed) if fixed is not None else None)
                if self.album is not None:
                    paths += show(self.album, (*stem, name), pictures, first.get(name))
                if self.options.shows:
                    files = [png(each) if each is not None else b"" for each in pictures]
                    shown.append(ShownImage(name, texels.width, texels.height, *files))
        return paths, shown

    def _agreement(self, source: Input, before: Version) -> Mapping[int, Sequence[AgreementRow]]:
        """How the layer and the rules agree, by pass."""
        if self.session.layer is None or not before.run.passes:
            return {}
        return self.planner.agreement(source, before.planned, before.run, self.session)

    def _verdict(self, source: Input, before: Version, number: int) -> Verdict:
        """What is known about a pass before it is judged."""
        planned = before.planned.passes[number]
        outcome = before.run.passes.get(number)
        notes = list(before.planned.defaults) if number == 0 else []
        if outcome is not None and outcome.dropped:
            notes.append(f"{outcome.dropped} more messages of the layer are omitted")
        rules = tuple(
            dict.fromkeys((finding.code, finding.rule) for finding in _findings(source, planned))
        )
        codes = tuple(dict.fromkeys(code for code, _ in rules))
        return Verdict(
            source.file,
            planned.name,
            source.prefix + planned.path,
            "",
            findings=codes,
            notes=tuple(notes),
            rules=rules,
        )


def picture_folder(options: TrialOptions, info: DeviceInfo) -> PictureFolder:
    """The folder for the pictures of a device. NotWritten if it cannot be created."""
    assert options.image is not None
    return PictureFolder(
        os.path.join(options.image, file_name(info.name)) if options.several else options.image,
        options.force,
    )


def _findings(source: Input, planned: parts.Pass) -> list[Finding]:
    """All findings about a pass, suppressed ones included."""
    described = next(
        (frame_pass for frame_pass in source.frame.passes if frame_pass.name == planned.name), None
    )
    findings = [*source.findings, *source.silenced]
    return of_pass(source.frame, described, findings) if described is not None else findings


def _concerns(image: str, planned: parts.Pass, frame: Frame, passes: int) -> bool:
    """Whether an image is reported with a pass that renders or resolves to it; images of no pass
    are reported with every pass.
    """
    owners = [described.name for described in frame.passes if _writes(described, image)]
    return passes == 1 or not owners or planned.name in owners


def _writes(described: Pass, image: str) -> bool:
    targets = {target.name for attachment in described.attachments for target in attachment.targets}
    targets.update(
        resolve.target_image.name
        for resolve in described.resolves
        if resolve.target_image is not None
    )
    return image.partition(":")[0] in targets


def _averages(frame: Frame) -> dict[str, set[str]]:
    """By image that samples are averaged into: whether in a pass or by a command."""
    kinds: dict[str, set[str]] = {}
    resolves = [resolve for described in frame.passes for resolve in described.resolves]
    for resolve in (*resolves, *(resolve for _, resolve in frame.resolve_commands)):
        if resolve.target_image is not None and resolve.mode == "AVERAGE":
            kinds.setdefault(resolve.target_image.name, set()).add(
                "command" if resolve.kind == "command" else "pass"
            )
    return kinds


def _raw_images(images: Mapping[str, Event], folder: str) -> Iterator[tuple[str, RawImage]]:
    """The images of a run, read only from files of its own folder, up to the maximum size."""
    for name, event in images.items():
        path = os.path.realpath(event["path"])
        if os.path.dirname(path) != os.path.realpath(folder):
            continue
        try:
            with open(path, "rb") as file:
                data = file.read(MAX_IMAGE)
        except OSError:
            continue
        size, aspect = (event["width"], event["height"]), str(event.get("aspect") or "")
        yield (
            name,
            RawImage(
                event["format"],
                *size,
                data,
                aspect,
                bool(event.get("defined")),
                bool(event.get("discarded")),
            ),
        )


def _model(source: Input) -> dict[str, dict[str, Any]]:
    """The cost model's figures for passes as written and fixed, by name."""
    from msaa_lint.frame.cost.model import frame_cost

    frames = [frame for frame in (source.frame, source.fixed) if frame is not None]
    written, *fixed = (
        {cost.name: cost.amount._asdict() for cost in frame_cost(frame, source.device).passes}
        for frame in frames
    )
    return {
        name: {"as_written": amount, "fixed": fixed[0].get(name) if fixed else None}
        for name, amount in written.items()
    }


def _is_tiler(device: DeviceInfo) -> bool | None:
    """Whether a device renders by tiles, judging by its vendor; None if unknown."""
    from msaa_lint.frame.devices.vendors import TILERS, vendor_of

    vendor = vendor_of(device.vendor_id)
    return True if vendor in TILERS else False if vendor in IMMEDIATE else None


IMMEDIATE = ("amd", "intel", "nvidia")
"""Vendors whose GPUs keep the samples of a pass in memory."""

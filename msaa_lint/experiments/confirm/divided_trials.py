"""The trials of inputs by several processes at once, each of which has driver processes of its own.
The outcome is that of one process.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from functools import partial
from threading import Lock, Timer
from typing import Any, NamedTuple

from msaa_lint.core.finding import Finding
from msaa_lint.core.scratch import remove_abandoned
from msaa_lint.linter.request import Request
from msaa_lint.linter.rules.budget import Spent
from msaa_lint.linter.unit_parts import parts
from msaa_lint.linter.workspace import Unit, Workspace

from .inputs import Input, Inputs, errors, of_file
from .outcome import DeviceInfo, DeviceRun, Verdict
from .planner import Planner
from .png import PictureFolder, PictureList
from .session import Session, SessionOptions
from .trial import DeviceTrial, ShownPictures, TrialOptions, device_run, picture_folder
from .vulkan_errors import Unusable

IDLE_SECONDS = 10.0
"""How long a device of a worker stays open without an input: the worker of a cluster is not told
that a run has ended.
"""


class Outcome(NamedTuple):
    """The outcome of an input on a device: its verdicts, and the pictures that they name by number;
    or why the device is `unusable`.
    """

    device: DeviceInfo | None = None
    layer: Mapping[str, Any] | None = None
    verdicts: Sequence[Verdict] = ()
    pictures: Sequence[tuple[bytes, tuple[str, ...]]] = ()
    unusable: str = ""


class TrialPart(NamedTuple):
    """What an input adds: why it cannot be confirmed, its outcome on each device, and what custom
    rules took.
    """

    errors: Sequence[Finding] = ()
    outcomes: Sequence[Outcome] = ()
    spent: Spent = Spent()


def divided_trials(
    request: Request, devices: Sequence[SessionOptions], options: TrialOptions
) -> tuple[list[DeviceRun], Inputs]:
    """The outcome of the inputs of a request on devices, without times, and what else is known of
    the inputs, without their documents.

    Raises `core.execution.backend.Unusable` if the cluster that the request names cannot be used.
    """
    workspace = Workspace(request)
    discovered = workspace.discover()
    merged = [_Merged(device, options) for device in devices]
    findings: list[Finding] = []
    try:
        linter = TrialLinter(workspace, devices, options._replace(time=False))
        with (
            closing(linter),
            closing(parts(linter, discovered.files, request.division, per_task=1)) as found,
        ):
            for part in found:
                findings += part.errors
                for device, outcome in zip(merged, part.outcomes, strict=False):
                    device.add(outcome)
    finally:
        # The processes have been killed, and left their folders.
        remove_abandoned()
    wrong = errors(workspace, findings)
    return [device.run() for device in merged], Inputs(
        [], wrong, list(discovered.notes), workspace.current.settings.docs_url
    )


class TrialLinter:
    """Reads and tries the inputs of a workspace one by one. A device stays open for `idle_seconds`
    without an input (None: until `close`).
    """

    def __init__(
        self,
        workspace: Workspace,
        devices: Sequence[SessionOptions],
        options: TrialOptions,
        idle_seconds: float | None = None,
    ) -> None:
        self.workspace = workspace
        self._terms = devices, options
        self._devices = [_Device(device, options, idle_seconds) for device in devices]

    def part(self, unit: Unit) -> TrialPart:
        """The outcome of an input on each device."""
        found: list[Input] = []
        with self.workspace.reading(unit) as read, self.workspace.guard(str(unit)):
            found = of_file(self.workspace, str(unit))
        return TrialPart(
            read.findings, [device.outcome(found) for device in self._devices], read.spent
        )

    def known(self, units: Sequence[Unit]) -> Mapping[int, TrialPart]:
        """Outcomes are not kept between runs."""
        return {}

    def included(self, part: TrialPart) -> bool:
        """Whether custom rules may take what they took for a part in another process, which then
        counts here.
        """
        return self.workspace.include(part.spent)

    def failed(self, unit: Unit, reason: str) -> TrialPart:
        """What an input adds that ended the processes that read it."""
        return TrialPart([self.workspace.not_read(unit, reason)])

    def travelling(self) -> Callable[[Workspace], TrialLinter]:
        """Creates such a linter in another process."""
        devices, options = self._terms
        return partial(TrialLinter, devices=devices, options=options, idle_seconds=IDLE_SECONDS)

    def close(self) -> None:
        """Ends the driver processes of this process."""
        for device in self._devices:
            device.close()


class _Device:
    """A device of this process, which opens when the first input is tried, and after it was
    idle.
    """

    def __init__(
        self, given: SessionOptions, options: TrialOptions, idle_seconds: float | None
    ) -> None:
        self._given = given
        self._options = options
        self._idle_seconds = idle_seconds
        self._lock = Lock()
        self._timer: Timer | None = None
        self._session: Session | None = None
        self._trial: DeviceTrial | None = None
        self._unusable = ""

    def outcome(self, inputs: Sequence[Input]) -> Outcome:
        """The outcome of the documents of an input."""
        if self._timer is not None:
            self._timer.cancel()
        with self._lock:
            outcome = self._outcome(inputs)
        if self._idle_seconds is not None:
            self._timer = Timer(self._idle_seconds, self.close)
            self._timer.daemon = True
            self._timer.start()
        return outcome

    def _outcome(self, inputs: Sequence[Input]) -> Outcome:
        pictures = PictureList()
        try:
            if self._session is None:
                self._session = self._given.session().__enter__()
            if self._trial is None and not self._unusable:
                self._trial = DeviceTrial(
                    self._session, self._options, self._session.open(), Planner()
                )
            if self._trial is None:
                return Outcome(unusable=self._unusable)
            self._trial.album = pictures if self._options.image is not None else None
            verdicts = [verdict for each in inputs for verdict in self._trial.try_input(each)]
        except Unusable as error:
            self._unusable, self._trial = str(error), None
            return Outcome(unusable=self._unusable)
        return Outcome(self._trial.info, self._session.layer, verdicts, pictures.files)

    def close(self) -> None:
        """Ends the driver process, if there is one."""
        with self._lock:
            session, self._session, self._trial = self._session, None, None
            if session is not None:
                session.__exit__(None, None, None)


class _Merged:
    """The outcomes of inputs on a device, in their order."""

    def __init__(self, given: SessionOptions, options: TrialOptions) -> None:
        self._given = given
        self._options = options
        self._last = Outcome()
        self._verdicts: list[Verdict] = []
        self._shown = ShownPictures()
        self._album: PictureFolder | None = None

    def add(self, outcome: Outcome) -> None:
        """Adds the outcome of an input, and writes its pictures. NotWritten if they cannot be."""
        known, found = self._last.device, outcome.device
        if self._last.unusable:
            return
        if known is not None and found is not None and known != found:
            devices = f"{known.name} ({known.driver}) and {found.name} ({found.driver})"
            self._last = Outcome(
                unusable=f"the workers of the cluster have different devices, {devices}: name one "
                "with `--device`"
            )
            return
        self._last = outcome._replace(verdicts=(), pictures=())
        if outcome.device is None:
            return
        if self._options.image is not None and self._album is None:
            self._album = picture_folder(self._options, outcome.device)
        paths = (
            [self._album.write_file(data, *parts) for data, parts in outcome.pictures]
            if self._album is not None
            else []
        )
        verdicts = [
            verdict._replace(pictures=tuple(paths[int(number)] for number in verdict.pictures))
            for verdict in outcome.verdicts
        ]
        self._verdicts += self._shown.limited(verdicts)

    def run(self) -> DeviceRun:
        """The outcome of all inputs."""
        last, asked = self._last, self._given.device or ""
        if last.device is None:
            return DeviceRun(
                None,
                unusable=last.unusable or "every process that tried an input ended",
                asked=asked,
            )
        return device_run(
            last.device,
            last.layer,
            self._verdicts,
            self._shown,
            self._options,
            self._given.validation,
            asked,
        )

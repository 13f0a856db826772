"""The cost of a technique: time by a device's clock, bytes and power by the cost model. The
simulator's own time is neither.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import TracebackType
from typing import Any, NamedTuple, Protocol

from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.cost.samples import is_multisampled, remove_multisampling, set_samples
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.frame import Frame

from .points import SSAA, Technique
from .shading import Shading
from .technique_frames import frame_of

REPEATS = 15
"""Rounds of a measurement."""

SECONDS, LEAST_ROUNDS = 20.0, 7
"""Unless the number of repeats is stated, a measurement ends after so many seconds, but has at
least so many rounds: of fewer than six, no interval contains the median with a probability of 95
%.
"""

SOFTWARE_SECONDS, LEAST_SOFTWARE_ROUNDS = 4.0, 3
"""The same for a software driver, whose times decide nothing."""

CALIBRATION_WARM_SECONDS = 1.0


class Cost(NamedTuple):
    """The cost of a technique at a size under a cost of shading; None where unknown. `reason` says
    why a device does not support the technique, or, with `failed`, why it could not be timed. The
    times and invocations are those of a Point. `rounds` are the medians of each round, and `terms`
    what the model of times depends on (study/time_model.py).
    """

    time_ms: float | None = None
    bytes_per_frame: float | None = None
    milliwatts: float | None = None
    memory_mib: float | None = None
    low_ms: float | None = None
    high_ms: float | None = None
    fill_ms: float | None = None
    shading_ms: float | None = None
    resolve_ms: float | None = None
    invocations: int | None = None
    expected_invocations: int | None = None
    rounds: tuple[float, ...] = ()
    terms: tuple[float, ...] = ()
    reason: str = ""
    failed: bool = False


Costs = Mapping[tuple[Technique, str], Cost]
"""Costs by technique and by the name of the cost of shading."""


class CostSource(Protocol):
    """A source of costs. `name` identifies the device in reports; it is empty where there are no
    times.
    """

    name: str

    def costs(
        self, techniques: Sequence[Technique], shadings: Sequence[Shading], size: tuple[int, int]
    ) -> Costs:
        """The cost of each technique under each cost of shading."""
        ...


class CostModel:
    """The cost model alone: bytes, memory and power of a device's traffic with external memory, and
    no time.

    Traffic is one of many things that determine the time of a frame, so the model does not estimate
    it. With `described`, the traffic is that of a described frame at its own size with a
    technique's sample count, otherwise that of a single pass.
    """

    name = ""

    def __init__(
        self,
        device: DeviceProfile | None = None,
        *,
        hdr: bool = False,
        depth: bool = False,
        fps: float = 60.0,
        described: Frame | None = None,
    ) -> None:
        self.device, self.described = device, described
        self.hdr, self.depth, self.fps = hdr, depth, fps

    def of(self, technique: Technique, width: int, height: int) -> Cost:
        """Bytes per frame, milliwatts, MiB."""
        if self.described is not None:
            return self._of_described(self.described, technique)
        frame = frame_of(technique, width, height, hdr=self.hdr, depth=self.depth, fps=self.fps)
        total = frame_cost(frame, self.device, Terms(fps=self.fps)).total
        return Cost(
            None, round(total.traffic_mb_per_s * 1e6 / self.fps), total.milliwatts, total.memory_mib
        )

    def _of_described(self, described: Frame, technique: Technique) -> Cost:
        """The same of a described frame; unknown for supersampling and for samples that it does not
        have, as its description has no images for them, and where it leaves out what traffic
        depends on.
        """
        frame = Frame(described.document)
        if technique.kind == SSAA or (technique.samples > 1 and not is_multisampled(frame)):
            return Cost()
        if technique.samples == 1:
            remove_multisampling(frame)
        else:
            set_samples(frame, technique.samples)
        found = frame_cost(frame, self.device)
        if any(each.unknown for each in found.passes) or any(
            image.bytes is None for image in found.images
        ):
            return Cost()
        return Cost(
            None,
            round(found.total.traffic_mb_per_s * 1e6 / found.fps),
            found.total.milliwatts,
            found.total.memory_mib,
        )

    def costs(
        self, techniques: Sequence[Technique], shadings: Sequence[Shading], size: tuple[int, int]
    ) -> Costs:
        """The same under each cost of shading."""
        found = {technique: self.of(technique, *size) for technique in techniques}
        return {
            (technique, shading.name): found[technique]
            for technique in techniques
            for shading in shadings
        }


class DeviceClock:
    """A device whose clock times plans in turn.

    `with DeviceClock(name) as clock:`; `name` is a part of the device's name, None for lavapipe if
    it is installed. Raises the device errors of `confirm` where there is no device. `repeats` are
    the rounds of a measurement; by default REPEATS, or fewer where those take too long. `unstable`
    says that times had not settled when one was measured.
    """

    def __init__(self, name: str | None = None, *, repeats: int = 0, seconds: float = 60.0) -> None:
        from msaa_lint.experiments.confirm.child import Limits
        from msaa_lint.experiments.confirm.session import Session, environment

        self.session = Session(
            name, validation=False, limits=Limits(seconds=seconds), environment=environment(name)
        )
        self.repeats = repeats
        self.name, self.software, self.unstable = "", True, False
        self.device: Mapping[str, Any] = {}

    def __enter__(self) -> DeviceClock:
        from msaa_lint.experiments.confirm.outcome import about

        self.session.__enter__()
        try:
            self.device = self.session.open()
        except BaseException:
            self.session.__exit__(None, None, None)
            raise
        info = about(self.device)
        self.name, self.software = info.name, info.software
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.session.__exit__(kind, value, trace)

    def time(self, plans: Sequence[tuple[Any, Sequence[Shading]]], rounds: int = 0) -> Any:
        """Times plans (confirm/parts.py) in turn, each under costs of shading: a TimedRun
        (confirm/timed.py). `rounds` are those of a calibration; by default, there are as many as
        repeats, or as fit into the time limit.
        """
        from msaa_lint.experiments.confirm.timed import Item, TimingOptions, Work

        items = [
            Item(
                plan,
                tuple(Work(each.operations, each.fetches, each.footprint) for each in shadings),
            )
            for plan, shadings in plans
        ]
        if rounds:
            return self.session.time(
                items, TimingOptions(rounds, warm_seconds=CALIBRATION_WARM_SECONDS)
            )
        options = TimingOptions(self.repeats or REPEATS)
        if not self.repeats:
            seconds, least = (
                (SOFTWARE_SECONDS, LEAST_SOFTWARE_ROUNDS)
                if self.software
                else (SECONDS, LEAST_ROUNDS)
            )
            options = options._replace(seconds=seconds, least_rounds=least)
        run = self.session.time(items, options)
        self.unstable = self.unstable or not run.stable
        return run

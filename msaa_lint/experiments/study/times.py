"""The cost of a technique: time by a device's clock, bytes and power by the cost model. The simulator's own time is neither."""

from __future__ import annotations

from collections.abc import Mapping
from types import TracebackType
from typing import Any, NamedTuple, Protocol

from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.devices import DeviceProfile

from .points import Technique
from .technique_frames import frame_of


class Cost(NamedTuple):
    """The cost of a technique at a size; None where unknown. `reason` says why a device does not support the technique, or, with
    `failed`, why it could not be timed."""

    time_ms: float | None = None
    bytes_per_frame: float | None = None
    milliwatts: float | None = None
    memory_mib: float | None = None
    low_ms: float | None = None
    high_ms: float | None = None
    reason: str = ""
    failed: bool = False


class CostSource(Protocol):
    """A source of costs. `name` identifies the device in reports; it is empty where there are no times."""

    name: str

    def of(self, technique: Technique, width: int, height: int) -> Cost:
        """The cost of a technique."""
        ...


class CostModel:
    """The cost model alone: bytes, memory and power of a device's traffic with external memory, and no time.

    Traffic is one of many things that determine the time of a frame, so the model does not estimate it.
    """

    name = ""

    def __init__(self, device: DeviceProfile | None = None, *, hdr: bool = False, depth: bool = False, fps: float = 60.0) -> None:
        self.device = device
        self.hdr, self.depth, self.fps = hdr, depth, fps

    def of(self, technique: Technique, width: int, height: int) -> Cost:
        """Bytes per frame, milliwatts, MiB."""
        frame = frame_of(technique, width, height, hdr=self.hdr, depth=self.depth, fps=self.fps)
        total = frame_cost(frame, self.device, Terms(fps=self.fps)).total
        return Cost(None, round(total.traffic_mb_per_s * 1e6 / self.fps), total.milliwatts, total.memory_mib)


class DeviceClock:
    """A device's clock: the median time of every technique that the device supports, over several repeats.

    `with DeviceClock(name) as clock:`; `name` is a part of the device's name, None for lavapipe if it is installed. Raises the device
    errors of `confirm` where there is no device.
    """

    def __init__(self, name: str | None = None, model: CostModel | None = None, *, repeats: int = 15, seconds: float = 60.0) -> None:
        from msaa_lint.experiments.confirm.child import Limits
        from msaa_lint.experiments.confirm.session import Session, environment

        self.session = Session(name, validation=False, limits=Limits(seconds=seconds), environment=environment(name))
        self.model = model or CostModel()
        self.repeats = repeats
        self.name, self.software = "", True
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

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None) -> None:
        self.session.__exit__(kind, value, trace)

    def of(self, technique: Technique, width: int, height: int, vertices: str = "") -> Cost:
        """The device's time and the model's bytes. `vertices` is a file of triangles to draw (confirm/parts.py)."""
        from msaa_lint.experiments.confirm import gate, plan
        from msaa_lint.experiments.confirm.timing import timing

        cost = self.model.of(technique, width, height)
        frame = frame_of(technique, width, height, hdr=self.model.hdr, depth=self.model.depth)
        frame_plan = plan.plan(frame)._replace(vertices=vertices)
        refused = gate.gate(frame_plan, self.device)
        if refused:
            return cost._replace(reason=next(iter(refused.values())))
        # An idle GPU takes a while to raise its clock rate.
        warmups = 3 if self.software else 100
        run = self.session.run(frame_plan, [0], {"repeats": self.repeats, "warmups": warmups})
        outcome = run.passes[0]
        if run.failed or outcome.end or not outcome.times:
            return cost._replace(reason=run.failed or outcome.reason or outcome.error or "no time was measured", failed=True)
        times = timing(outcome.times, outcome.source)
        return cost._replace(time_ms=times.median, low_ms=times.low, high_ms=times.high)

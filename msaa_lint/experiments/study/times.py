"""What a technique takes: time by a device's own clock, bytes and power by the cost model. The simulator's time is neither."""

from __future__ import annotations

from collections.abc import Mapping
from types import TracebackType
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.devices import DeviceProfile

from .points import Technique
from .technique_frames import frame_of

if TYPE_CHECKING:
    from msaa_lint.experiments.confirm.session import Session


class Cost(NamedTuple):
    """What a technique takes at a size; None is not known. `reason` says why a device does not do it."""

    time_ms: float | None = None
    bytes_per_frame: float | None = None
    milliwatts: float | None = None
    memory_mib: float | None = None
    low_ms: float | None = None
    high_ms: float | None = None
    reason: str = ""


class Source(Protocol):
    """Where times come from: `name` says it in reports, empty where there are none."""

    name: str

    def of(self, technique: Technique, width: int, height: int) -> Cost:
        """What a technique takes."""
        ...


class Model:
    """The cost model alone: bytes, memory and power of a device's traffic with external memory, and no time.

    The time of a frame is the longest of many things that traffic is but one of, so that a time from it would be made up.
    """

    name = ""

    def __init__(self, device: DeviceProfile | None = None, *, hdr: bool = False, depth: bool = False, fps: float = 60.0) -> None:
        self.device = device
        self.hdr, self.depth, self.fps = hdr, depth, fps

    def of(self, technique: Technique, width: int, height: int) -> Cost:
        """Bytes a frame, milliwatts, MiB."""
        frame = frame_of(technique, width, height, hdr=self.hdr, depth=self.depth, fps=self.fps)
        found = frame_cost(frame, self.device, Terms(fps=self.fps))
        total = found.total
        return Cost(None, round(total.traffic_mb_per_s * 1e6 / self.fps), total.milliwatts, total.memory_mib)


class Clock:
    """A device's clock: every technique that it supports is drawn, repeated in rounds that change order, and the median taken.

    `with Clock(name) as clock:`; `name` is a part of the device's name, None lavapipe where it is there. Unusable where there is no device.
    """

    def __init__(self, name: str | None = None, model: Model | None = None, *, repeats: int = 15, seconds: float = 60.0) -> None:
        from msaa_lint.experiments.confirm.child import Limits
        from msaa_lint.experiments.confirm.session import Session, environment

        self.session: Session = Session(name, validation=False, limits=Limits(seconds=seconds), environment=environment(name))
        self.model = model or Model()
        self.repeats = repeats
        self.name, self.software = "", True
        self.device: Mapping[str, Any] = {}

    def __enter__(self) -> Clock:
        from msaa_lint.experiments.confirm.outcome import about

        self.session.__enter__()
        try:
            self.device = self.session.open()
        except BaseException:
            self.session.__exit__(None, None, None)
            raise
        own = about(self.device)
        self.name, self.software = own.name, own.software
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None) -> None:
        self.session.__exit__(kind, value, trace)

    def of(self, technique: Technique, width: int, height: int, vertices: str = "") -> Cost:
        """The device's time and the model's bytes. `vertices` is a file of triangles to draw (confirm/parts.py)."""
        from msaa_lint.experiments.confirm import gate, plan
        from msaa_lint.experiments.confirm.timing import timing

        model = self.model.of(technique, width, height)
        made = plan.plan(frame_of(technique, width, height, hdr=self.model.hdr, depth=self.model.depth))._replace(vertices=vertices)
        refused = gate.gate(made, self.device)
        if refused:
            return model._replace(reason=next(iter(refused.values())))
        # A GPU that was idle takes a while to raise its clock.
        warmups = 3 if self.software else 100
        want = {"pixels": None, "repeats": self.repeats, "warmups": warmups, "size": None, "samples_of": None}
        run = self.session.run(plan.to_json(made), [0], want)
        ran = run.passes[0]
        if run.failed or ran.end or not ran.times:
            return model._replace(reason=run.failed or ran.reason or ran.error or "no time was measured")
        found = timing(ran.times, ran.source)
        return model._replace(time_ms=found.median, low_ms=found.low, high_ms=found.high)

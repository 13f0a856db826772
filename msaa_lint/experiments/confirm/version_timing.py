"""Both versions of a frame timed alternately, in fresh processes, without the layer."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from .frame_results import FrameRun, PassOutcome
from .outcome import Times, end_status
from .pixels import RawImage
from .planner import PlannedFrame
from .session import Session
from .timing import difference, rounds, timing

WARMUPS = 2


class Version(NamedTuple):
    """A frame as written or fixed: its plan, the passes that the device does not support, and its
    run.
    """

    planned: PlannedFrame
    refused: Mapping[int, str]
    run: FrameRun
    images: Mapping[str, RawImage]

    def number(self, name: str) -> int | None:
        """The number of a pass by its name, which fixes do not change."""
        return next(
            (number for number, planned in enumerate(self.planned.passes) if planned.name == name),
            None,
        )


class TimedPasses(NamedTuple):
    """The times of passes by their number as written, and the first outcome of each pass that did
    not go through, by its name.
    """

    times: Mapping[int, Times]
    failures: Mapping[str, PassOutcome]


def measure_times(
    session: Session, versions: Mapping[str, Version], repeats: int, software: bool
) -> TimedPasses:
    """The times of the passes that went through. `versions` are `as written` and, if there is one,
    `fixed`.
    """
    failures: dict[str, PassOutcome] = {}
    values: dict[str, dict[int, list[float]]] = {name: {} for name in versions}
    source = "wall"
    # The layer would be timed too: use a session without it.
    with Session(
        session.name, validation=False, limits=session.limits, environment=session.environment,
        execute=session.execute
    ) as timed_session:  # fmt: skip
        previous = 0
        for process, order, count in rounds(repeats):
            if process != previous:
                timed_session.close()
            previous = process
            options = {"repeats": count, "warmups": WARMUPS}
            for name in order:
                version = versions.get(name)
                passes = version.run.passes.items() if version is not None else ()
                runnable = [
                    number
                    for number, outcome in passes
                    if outcome.end == "" and outcome.created is not False
                ]
                if version is None or not runnable:
                    continue
                for number, outcome in timed_session.run(
                    version.planned.plan, runnable, options
                ).passes.items():
                    values[name].setdefault(number, []).extend(outcome.times)
                    source = outcome.source or source
                    if end_status(outcome) is not None:
                        failures.setdefault(version.planned.passes[number].name, outcome)
    times = {}
    for number, written_values in values["as written"].items():
        if not written_values:
            continue
        written, fixed = timing(written_values, source), None
        if "fixed" in versions:
            twin = versions["fixed"].number(versions["as written"].planned.passes[number].name)
            fixed_values = values["fixed"].get(twin, []) if twin is not None else []
            fixed = timing(fixed_values, source) if fixed_values else None
        times[number] = Times(
            written, fixed, difference(written, fixed, software) if fixed is not None else None
        )
    return TimedPasses(times, failures)

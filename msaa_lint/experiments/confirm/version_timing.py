"""Both versions of a frame timed in turns, in fresh processes, without the layer."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from .frame_results import FrameRun
from .pixels import Raw
from .planning import Planned
from .session import Session
from .timing import difference, rounds, timing
from .verdict import Times

WARMUPS = 2


class Version(NamedTuple):
    """A frame as written or fixed: its plan, which passes the gate refuses, and its run."""

    planned: Planned
    refused: Mapping[int, str]
    run: FrameRun
    images: Mapping[str, Raw]

    def number(self, name: str) -> int | None:
        """The number of a pass by its name, which fixes leave as it is."""
        return next((n for n, each in enumerate(self.planned.passes) if each.name == name), None)


def times(session: Session, versions: Mapping[str, Version], repeats: int, software: bool) -> dict[int, Times]:
    """The times of the passes that went through, by their number as written. `versions` are `as written` and, if there is one, `fixed`."""
    found: dict[str, dict[int, list[float]]] = {name: {} for name in versions}
    source = "wall"
    with _without_layer(session) as timed:
        last = 0
        for process, order, count in rounds(repeats):
            if process != last:
                timed.close()
            last = process
            for name in (each for each in order if each in versions):
                version = versions[name]
                going = [n for n, ran in version.run.passes.items() if ran.end == "" and ran.created is not False]
                want = {"pixels": None, "repeats": count, "warmups": WARMUPS, "size": None, "samples_of": None}
                for n, ran in (timed.run(version.planned.data, going, want).passes if going else {}).items():
                    found[name].setdefault(n, []).extend(ran.times)
                    source = ran.source or source
    made = {}
    for number, values in found["as written"].items():
        if not values:
            continue
        twin = versions["fixed"].number(versions["as written"].planned.passes[number].name) if "fixed" in versions else None
        other = found["fixed"].get(twin, []) if twin is not None else []
        written, fixed = timing(values, source), timing(other, source) if other else None
        made[number] = Times(written, fixed, difference(written, fixed, software) if fixed is not None else None)
    return made


def _without_layer(session: Session) -> Session:
    """A session of the same device without the layer, which would be timed with it."""
    return Session(session.name, validation=False, limits=session.limits, environment=session.environment, execute=session.execute)

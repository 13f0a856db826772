"""Calibrates costs of shading on a device: the work with which a full screen takes as much longer
as each cost says.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import struct
from collections.abc import Iterator, Sequence
from statistics import median
from typing import Any

from .points import MSAA, Technique
from .scene_timing import own_shaders, shaded
from .shading import NONE, Shading, calibrated, target
from .technique_frames import frame_of
from .times import DeviceClock

QUICK_ROUNDS, ROUNDS = 3, 9
"""Rounds of the first guesses, and of the last ones."""

QUICK_GUESSES = 2

PROBE, SOFTWARE_PROBE = 256, 16
"""Operations of the first guess of a calibration."""

CLOSE, SOFTWARE_CLOSE = 0.02, 0.2
"""A calibrated time may differ from its target by this share. On a CPU, the time of a single
operation is a large share of one.
"""

MAX_GUESSES, MAX_SOFTWARE_GUESSES = 8, 3

MAX_FETCHES = 0.9
"""The largest share of a cost that texture fetches take: where they take more, there are fewer of
them.
"""


GROWTH = 16
"""How many times as many operations the next guess has at most."""

MAX_OPERATIONS = 1 << 20
"""The most operations of a guess: where noise hides the time of that many, more would only hang the
device.
"""


class Calibration:
    """The costs of shading on a device, each calibrated once at each size of a picture."""

    def __init__(self, clock: DeviceClock) -> None:
        self.clock = clock
        self._calibrated: dict[tuple[str, tuple[int, int]], Shading] = {}

    def shadings(self, names: Sequence[str], size: tuple[int, int]) -> list[Shading]:
        """The costs of shading of these names for pictures of a size in pixels, calibrated on the
        device: the number of operations with which a full screen takes as much longer as the name
        says. ValueError for an unknown name.
        """
        missing = [name for name in names if (name, size) not in self._calibrated]
        if missing:
            self._calibrated |= {
                (name, size): found
                for name, found in zip(missing, self._calibrate(missing, size), strict=True)
            }
        return [self._calibrated[name, size] for name in names]

    def measured(self, name: str, stages: tuple[Any, ...], size: tuple[int, int]) -> Shading:
        """The cost of a fragment shader with these stages (confirm/parts.py), as measured on a full
        screen.
        """
        with _full_screen(self.clock, size) as plan:
            run = self.clock.time(
                [(plan, [Shading(NONE)]), (own_shaders(plan, stages), [Shading(NONE)])], ROUNDS
            )
        if any(item.reason for item in run.items):
            return Shading(name)
        none, own = (median(item.times[0]) for item in run.items)
        return calibrated(Shading(name), own - none, size)

    def _calibrate(self, names: Sequence[str], size: tuple[int, int]) -> list[Shading]:
        targets = [target(name, size) for name in names]
        software = self.clock.software
        probe, close, guesses = (
            (SOFTWARE_PROBE, SOFTWARE_CLOSE, MAX_SOFTWARE_GUESSES)
            if software
            else (PROBE, CLOSE, MAX_GUESSES)
        )
        tried = [
            each.shading
            if each.added_ms in (None, 0.0)
            else each.shading._replace(operations=probe)
            for each in targets
        ]
        found: list[tuple[float, float]] | None = None
        with _full_screen(self.clock, size) as plan:
            for guess in range(guesses):
                rounds = QUICK_ROUNDS if software or guess < QUICK_GUESSES else ROUNDS
                found = self._added(plan, tried, rounds)
                if found is None:
                    break
                next_tried = []
                for each, shading, (added, fetches) in zip(targets, tried, found, strict=True):
                    is_close = (
                        not each.added_ms or abs(added - each.added_ms) <= close * each.added_ms
                    )
                    next_tried.append(
                        shading
                        if is_close
                        else _next_guess(each.added_ms or 0.0, shading, added, fetches, probe)
                    )
                if guess == guesses - 1 or (next_tried == tried and (software or rounds == ROUNDS)):
                    break
                tried = next_tried
        if found is None:
            return [each.shading for each in targets]
        return [
            calibrated(shading, added, size)
            for shading, (added, _) in zip(tried, found, strict=True)
        ]

    def _added(
        self, plan: Any, shadings: Sequence[Shading], rounds: int
    ) -> list[tuple[float, float]] | None:
        """The milliseconds that each cost adds to a plan, and that its texture fetches add; None if
        it cannot be timed.
        """
        works = [shading._replace(name=NONE) for shading in shadings]
        # Each only once: several costs may have the same fetches, or none.
        timed = list(
            dict.fromkeys([Shading(NONE), *(work._replace(operations=0) for work in works), *works])
        )
        (item,) = self.clock.time([(plan, timed)], rounds).items
        if item.reason:
            return None
        medians = dict(zip(timed, map(median, item.times), strict=True))
        none = medians[Shading(NONE)]
        return [
            (medians[work] - none, medians[work._replace(operations=0)] - none) for work in works
        ]


def _next_guess(
    wanted_ms: float, shading: Shading, added_ms: float, fetches_ms: float, probe: int
) -> Shading:
    """The cost with the operations that would add the wanted time, where each takes as long as
    those of the last guess.
    """
    if shading.fetches and fetches_ms > MAX_FETCHES * wanted_ms:
        fetches = int(shading.fetches * MAX_FETCHES * wanted_ms / fetches_ms)
        return shading._replace(
            operations=probe, fetches=fetches, footprint=shading.footprint if fetches else 0
        )
    rate = (added_ms - fetches_ms) / shading.operations
    limit = min(GROWTH * shading.operations, MAX_OPERATIONS)
    operations = limit if rate <= 0 else min(round((wanted_ms - fetches_ms) / rate), limit)
    return shading._replace(operations=max(operations, 1))


@contextlib.contextmanager
def _full_screen(clock: DeviceClock, size: tuple[int, int]) -> Iterator[Any]:
    """The plan of a full screen at one sample."""
    from msaa_lint.experiments.confirm import plan

    # One triangle, as every pixel is then shaded once: the halves of a rectangle share quads.
    corners = (-1.0, -1.0, 0.5, 3.0, -1.0, 0.5, -1.0, 3.0, 0.5)
    folder = clock.session.folder("calibrated")
    path = os.path.join(folder, "vertices")
    with open(path, "wb") as file:
        file.write(struct.pack("<9f", *corners))
    try:
        yield shaded(plan.plan(frame_of(Technique(MSAA, 1), *size))._replace(vertices=path))
    finally:
        shutil.rmtree(folder, ignore_errors=True)

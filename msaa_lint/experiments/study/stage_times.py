"""How long the stages of a simulation take."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator, Sequence


class StageTimes:
    """The milliseconds that each effect's stage has taken; stages of other effects are not
    timed.
    """

    def __init__(self, effects: Sequence[str]) -> None:
        self._milliseconds = dict.fromkeys(effects, 0.0)

    @contextlib.contextmanager
    def stage(self, effect: str) -> Iterator[None]:
        """Adds the time of what is done inside to an effect's."""
        if effect not in self._milliseconds:
            yield
            return
        start = time.perf_counter()
        try:
            yield
        finally:
            self._milliseconds[effect] += 1000 * (time.perf_counter() - start)

    def table(self) -> tuple[tuple[str, float], ...]:
        """The effects with their milliseconds."""
        return tuple(self._milliseconds.items())

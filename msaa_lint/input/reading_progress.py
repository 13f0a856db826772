"""Tells an observer how far the reading of a capture is, once that takes a while."""

from __future__ import annotations

import os
from collections.abc import Callable
from time import monotonic
from typing import Any, BinaryIO, Protocol

DELAY = 0.5
"""Seconds after which the reading is observed."""

INTERVAL = 0.1
"""Seconds between two updates."""


class Observer(Protocol):
    """Shows how far the reading of a capture is."""

    def update(self, name: str, done: int, total: int | None, frames: int) -> None:
        """So many bytes are read, of `total` if that is known, and so many frames."""

    def finish(self) -> None:
        """The capture is read."""


observer: Observer | None = None
"""Observes the captures that this process reads."""


class ObservedStream:
    """A stream that reports how much was read of it. `frames` returns the number of frames so
    far.
    """

    def __init__(
        self, stream: BinaryIO, name: str, frames: Callable[[], int], observer: Observer
    ) -> None:
        self._stream = stream
        self._name = name
        self._frames = frames
        self._observer = observer
        self._total = _size(stream)
        self._done = 0
        self._next = monotonic() + DELAY

    def read(self, size: int = -1) -> bytes:
        """As the stream's."""
        data = self._stream.read(size)
        self._done += len(data)
        now = monotonic()
        if now >= self._next:
            self._next = now + INTERVAL
            self._observer.update(self._name, self._done, self._total, self._frames())
        return data

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


def _size(stream: BinaryIO) -> int | None:
    """The size of a file in bytes; None for anything else."""
    try:
        return os.fstat(stream.fileno()).st_size or None
    except (AttributeError, OSError, ValueError):
        return None

"""What tests let processes do; by name, for processes that are not copies."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Sequence

Chunk = tuple[int, ...]


def split(chunk: Chunk) -> Sequence[Chunk]:
    """The parts of a task: its numbers, one by one."""
    return [(number,) for number in chunk]


def squares(chunk: Chunk) -> list[int]:
    """The squares of numbers."""
    return [number * number for number in chunk]


def with_process(chunk: Chunk) -> tuple[int, float]:
    """The process that does a task, which takes a while, and when it began."""
    began = time.monotonic()
    time.sleep(0.01)
    return os.getpid(), began


def poisonous(chunk: Chunk) -> list[int]:
    """The squares of numbers; 13 ends the process, and 7 raises an exception."""
    if 13 in chunk:
        os.kill(os.getpid(), signal.SIGKILL)
    if 7 in chunk:
        raise ValueError("it is 7")
    return squares(chunk)


def sleep(chunk: Chunk) -> None:
    """Takes too long."""
    time.sleep(600)

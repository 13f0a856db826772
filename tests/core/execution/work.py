"""What tests let processes do; by name, for processes that are not copies."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Sequence

Chunk = tuple[int, ...]


def numbers(count: int) -> list[Chunk]:
    """Tasks of one number each."""
    return [(number,) for number in range(count)]


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


def process(milliseconds: int, chunk: Chunk) -> int:
    """The process that does a task."""
    time.sleep(milliseconds / 1000)
    return os.getpid()


BRIEF = 60


def brief_then_long(folder: str, chunk: Chunk) -> None:
    """Records the begin of a task, which takes a second if its number is not below BRIEF."""
    with open(os.path.join(folder, "begun"), "a", encoding="utf-8") as file:
        file.write(f"{chunk[0]}\n")
    time.sleep(1.0 if chunk[0] >= BRIEF else 0)


def recorded(folder: str, chunk: Chunk) -> int:
    """The process that does a task, which takes a while; the end of the task is recorded in a
    file.
    """
    time.sleep(0.02)
    with open(os.path.join(folder, "done"), "a", encoding="utf-8") as file:
        file.write(f"{chunk[0]}\n")
    return os.getpid()


def overlaps(folder: str, chunk: Chunk) -> bool:
    """Whether this process does another task at the same time."""
    path = os.path.join(folder, str(os.getpid()))
    try:
        os.close(os.open(path, os.O_CREAT | os.O_EXCL))
    except FileExistsError:
        return True
    time.sleep(0.02)
    os.remove(path)
    return False


class Unpicklable:
    """What cannot be sent."""

    def __reduce__(self) -> tuple[object, ...]:
        raise ValueError("it stays here")


def unpicklable(chunk: Chunk) -> object:
    """A result that cannot be sent, for 7."""
    return Unpicklable() if 7 in chunk else squares(chunk)


class Heavy:
    """Work that counts, in a file, how often it is loaded."""

    def __init__(self, folder: str) -> None:
        self.folder = folder

    def __setstate__(self, state: dict[str, str]) -> None:
        self.__dict__ |= state
        with open(os.path.join(self.folder, "loaded"), "a", encoding="utf-8") as file:
            file.write(f"{os.getpid()}\n")

    def __call__(self, chunk: Chunk) -> int:
        time.sleep(0.01)
        return os.getpid()


class Broken:
    """Work that no other process can load."""

    def __reduce__(self) -> tuple[object, ...]:
        return squares, (1, 2, 3)

    def __call__(self, chunk: Chunk) -> None: ...

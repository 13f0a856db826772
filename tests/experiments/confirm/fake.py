"""Runs plans as a driver of any temper would. A plan is a list of deeds, one a pass; each may name
the driver's death.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

Tell = Callable[[dict[str, Any]], None]


class RunOptions(NamedTuple):
    pixels: str | None = None
    repeats: int = 0
    warmups: int = 0
    size: list[int] | None = None
    samples_of: str | None = None


class Session:
    def __init__(self, device: str | None, validation: bool, vendors: Sequence[str]) -> None:
        if device == "dies":
            os.kill(os.getpid(), signal.SIGSEGV)
        if device == "sleeps":
            time.sleep(600)
        self.device = {"name": device or "fake", "type": "CPU"}
        self.layer = {"name": "fake layer"} if validation else None
        self.runs = 0


def devices() -> list[dict[str, Any]]:
    return [{"name": "fake", "type": "CPU"}]


def from_json(data: Any) -> Any:
    return data


def run(
    session: Session, plan: dict[str, Any], passes: Sequence[int], want: RunOptions, tell: Tell
) -> None:
    session.runs += 1
    before = plan.get("before")
    if before is not None:
        DEEDS[before](session, tell)
    for number in passes:
        deed = plan["passes"][number]
        tell({"event": "pass", "pass": number})
        if deed == "dies in company" and len(passes) > 1:
            deed = "SIGSEGV"
        if deed.startswith("SIG"):
            os.kill(os.getpid(), getattr(signal, deed))
            time.sleep(60)
        DEEDS.get(deed, lambda *_: None)(session, tell)
        tell(
            {
                "event": "created",
                "pass": number,
                "ok": deed != "refuses",
                "error": "VK_ERROR_UNKNOWN" if deed == "refuses" else "",
            }
        )
        tell(
            {
                "event": "message",
                "pass": number,
                "id": f"process {os.getpid()}",
                "severity": "warning",
                "text": f"run {session.runs}",
            }
        )
        for count in range(want.repeats):
            tell({"event": "time", "pass": number, "ms": 1 + count / 1000, "source": "timestamp"})
        for count in range(300 if deed == "chatters" else 0):
            tell(
                {
                    "event": "message",
                    "pass": number,
                    "id": "again",
                    "severity": "warning",
                    "text": str(count),
                }
            )
    if want.pixels is not None:
        path = os.path.join(want.pixels, "0.raw")
        with open(path, "wb") as file:
            file.write(bytes([plan.get("pixel", 0)]) + bytes(15))
        states = {"defined": True, "discarded": False}
        tell(
            {
                "event": "pixels",
                "image": "color",
                "format": 37,
                "width": 2,
                "height": 2,
                "path": path,
                **states,
            }
        )
    tell({"event": "done"})


def _sleep(*_: Any) -> None:
    time.sleep(600)


def _print(*_: Any) -> None:
    os.write(1, b"to standard output\n" * 100_000)
    os.write(2, b"to standard error\n" * 100_000)


def _abort(*_: Any) -> None:
    os.write(2, b"LLVM ERROR: \x1b[31mcannot select\n")
    os.abort()


def _garbage(*_: Any) -> None:
    for descriptor in range(3, 64):
        try:
            os.write(descriptor, b"\x00\xff not JSON \n")
        except OSError:
            continue


def _eat(*_: Any) -> None:
    eaten = [bytearray(1 << 30) for _ in range(1 << 10)]
    assert not eaten


def _raise(*_: Any) -> None:
    raise RuntimeError("a bug of ours")


def _exit(*_: Any) -> None:
    sys.stdout.flush()
    os._exit(7)


def _grandchild(*_: Any) -> None:
    if os.fork() == 0:
        time.sleep(600)
    time.sleep(600)


DEEDS: dict[str, Callable[..., None]] = {
    "sleeps": _sleep, "prints": _print, "aborts": _abort, "garbage": _garbage, "eats": _eat,
    "raises": _raise, "exits": _exit,
    "forks": _grandchild,
}  # fmt: skip

"""What came of a frame, collected from what its child says."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from .protocol import Event

MOST_MESSAGES = 200
"""Messages of the layer that are kept of one pass."""

SAMPLES_OF = ":samples"
"""What follows the name of an image whose samples were read back one by one."""


class Ran(NamedTuple):
    """What came of one pass. `end` is empty where it went through, else `died`, `timed-out` or `left`; `reason` says how.

    `created` is None where nothing was said of it. `times` are in milliseconds.
    """

    number: int
    created: bool | None = None
    error: str = ""
    messages: tuple[Event, ...] = ()
    dropped: int = 0
    times: tuple[float, ...] = ()
    source: str = ""
    end: str = ""
    signal: str = ""
    reason: str = ""


class FrameRun(NamedTuple):
    """What came of a frame: of each pass, messages that are of no pass, and the images that were read back, by name.

    `whole` where all passes that were asked for went through in one run; the images hold what they should only then. `failed` says why
    the frame as a whole could not be run.
    """

    passes: Mapping[int, Ran]
    messages: tuple[Event, ...] = ()
    images: Mapping[str, Event] = {}
    whole: bool = True
    failed: str = ""


class Collected:
    """The events of one run, taken apart."""

    def __init__(self) -> None:
        self.at: int | None = None
        self.failed = ""
        self.messages: list[Event] = []
        self.images: dict[str, Event] = {}
        self._passes: dict[int, Ran] = {}

    def ran(self, number: int) -> Ran:
        found = self._passes.get(number)
        if found is None:
            return Ran(number, end="left", reason=self.failed or "nothing was said of it")
        return found._replace(end="left", reason=self.failed) if self.failed and self.at == number else found

    def take(self, event: Event) -> None:
        kind, number = event["event"], event.get("pass")
        if kind == "pixels":
            self.images[event["image"]] = event
        elif kind == "sample":
            self.images[event["image"] + SAMPLES_OF] = event
        elif kind == "failed":
            self.failed = event["reason"]
        elif kind == "message" and number is None:
            if len(self.messages) < MOST_MESSAGES:
                self.messages.append(event)
        elif isinstance(number, int):
            ran = self._passes.get(number, Ran(number))
            if kind == "pass":
                self.at = number
            elif kind == "created":
                ran = ran._replace(created=event["ok"] and ran.created is not False, error=str(event.get("error") or ran.error))
            elif kind == "message" and len(ran.messages) < MOST_MESSAGES:
                ran = ran._replace(messages=(*ran.messages, event))
            elif kind == "message":
                ran = ran._replace(dropped=ran.dropped + 1)
            elif kind == "time":
                ran = ran._replace(times=(*ran.times, float(event["ms"])), source=str(event.get("source", "")))
            self._passes[number] = ran

"""The results of running a frame, collected from the events of its child process."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from .protocol import Event

MAX_MESSAGES = 200
"""Layer messages that are kept per pass."""

SAMPLES_OF = ":samples"
"""The suffix of the name of an image whose samples were read back one by one."""


class PassOutcome(NamedTuple):
    """The outcome of one pass. `end` is empty where it went through, otherwise `died`, `timed-out`
    or `left`, and `reason` says why. `failed` is whether this program failed at it.

    `created` is None where the child did not report it. `times` are in milliseconds.
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
    failed: bool = False


class FrameRun(NamedTuple):
    """The outcome of a frame: each pass, messages about no pass in particular, and the images that
    were read back, by name.

    `images` of which `defined` is false hold poison (scene.py), and `defined` are those with
    defined contents that were not read back. `whole` says whether all requested passes went through
    in one run; only then are the contents of the images meaningful. `failed` says why a pass, or
    the frame as a whole, failed inside this program.
    """

    passes: Mapping[int, PassOutcome]
    messages: tuple[Event, ...] = ()
    images: Mapping[str, Event] = {}
    whole: bool = True
    failed: str = ""
    defined: frozenset[str] = frozenset()


class RunCollector:
    """Collects the events of one run by pass. `at` is the last pass that the child announced."""

    def __init__(self) -> None:
        self.at: int | None = None
        self.failed = ""
        self.messages: list[Event] = []
        self.images: dict[str, Event] = {}
        self.defined: set[str] = set()
        self._passes: dict[int, PassOutcome] = {}

    def outcome(self, number: int) -> PassOutcome:
        """The outcome of a pass."""
        outcome = self._passes.get(number)
        if outcome is None:
            return PassOutcome(
                number,
                end="left",
                reason=self.failed or "the child process reported nothing about it",
                failed=True,
            )
        return (
            outcome._replace(end="left", reason=self.failed, failed=True)
            if self.failed and self.at == number
            else outcome
        )

    def add(self, event: Event) -> None:
        """Takes up an event."""
        kind, number = event["event"], event.get("pass")
        if kind == "pixels":
            self.images[event["image"]] = event
        elif kind == "defined":
            self.defined.add(event["image"])
        elif kind == "sample":
            self.images[event["image"] + SAMPLES_OF] = event
        elif kind == "failed":
            self.failed = event["reason"]
        elif kind == "message" and number is None:
            if len(self.messages) < MAX_MESSAGES:
                self.messages.append(event)
        elif isinstance(number, int):
            outcome = self._passes.get(number, PassOutcome(number))
            if kind == "pass":
                self.at = number
            elif kind == "created":
                created = event["ok"] and outcome.created is not False
                outcome = outcome._replace(
                    created=created, error=str(event.get("error") or outcome.error)
                )
            elif kind == "message" and len(outcome.messages) < MAX_MESSAGES:
                outcome = outcome._replace(messages=(*outcome.messages, event))
            elif kind == "message":
                outcome = outcome._replace(dropped=outcome.dropped + 1)
            elif kind == "time":
                outcome = outcome._replace(
                    times=(*outcome.times, float(event["ms"])), source=str(event.get("source", ""))
                )
            self._passes[number] = outcome

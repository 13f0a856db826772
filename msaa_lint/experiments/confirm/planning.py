"""What a trial needs of plans, of the gate and of the agreement; `planner.PLANNER` is the one there is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from msaa_lint.frame.facts.frame import Frame

from .inputs import Input
from .protocol import Event
from .session import Session
from .verdict import Said


class PlannedPass(NamedTuple):
    """A pass of a plan; `refused` says why it cannot be run on any device, empty where it can. `kind` is `renderPass`, `renderPass2` or
    `rendering`, by the call that makes it."""

    name: str
    path: str
    refused: str = ""
    kind: str = ""


class Planned(NamedTuple):
    """A frame's plan: as the child takes it, and as its maker has it; its passes, and the defaults that were taken, in words."""

    data: Mapping[str, Any]
    own: Any
    passes: Sequence[PlannedPass]
    defaults: Sequence[str] = ()


class Told(NamedTuple):
    """What the layer says of the passes of a frame that ran, with what it is, and the device that it ran on."""

    numbers: Sequence[int]
    messages: Sequence[Event]
    layer: Mapping[str, Any]
    vendors: Sequence[str]
    device: Mapping[str, Any]
    name: str


class Planner(Protocol):
    """What makes plans, and knows what a device does not support."""

    def plan(self, frame: Frame, file: str, size: tuple[int, int] | None, samples: int | None) -> Planned:
        """The plan of a frame; it never raises for what the frame holds."""
        ...

    def gate(self, planned: Planned, device: Mapping[str, Any]) -> dict[int, str]:
        """The passes that a device does not support, by their number, and why."""
        ...

    def deviations(self, session: Session, planned: Planned, device: Mapping[str, Any], color: bool) -> Mapping[int, Sequence[str]]:
        """What resolves of passes give that they should not, in words, by the pass; of colour too where that is asked for."""
        ...

    def rows(self, input: Input, planned: Planned, told: Told) -> Mapping[int, Sequence[Said]]:
        """The agreement of the layer and us about each pass that ran."""
        ...

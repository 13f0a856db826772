"""The tasks of a sweep, one per point."""

from typing import NamedTuple

from .points import Technique


class StudyInput(NamedTuple):
    """A scene by name, a mesh, or a document of a description. `name` identifies it in reports; `text` is a description's."""

    kind: str
    name: str
    path: str = ""
    text: str = ""
    number: int = 0
    format: str | None = None


class Task(NamedTuple):
    """A point to simulate."""

    input: StudyInput
    technique: Technique
    width: int
    height: int
    bits: int = 8
    ssim: bool = False


class FailedPoint(NamedTuple):
    """A point that could not be simulated, and why."""

    scene: str
    technique: Technique
    reason: str


class Unusable(Exception):
    """A sweep cannot do what was asked for; the message is for the user."""

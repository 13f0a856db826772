"""The tasks of a sweep, one per point."""

from typing import NamedTuple

from .points import MSAA, SAMPLE_SHADING, Technique


class StudyInput(NamedTuple):
    """A scene by name, a mesh, or a document of a description. `name` identifies it in reports;
    `text` is a description's.
    """

    kind: str
    name: str
    path: str = ""
    text: str = ""
    number: int = 0
    format: str | None = None


class Task(NamedTuple):
    """A point to simulate. `shader` says whether the scene has one: without it, sample shading
    gives the picture of multisampling, and one simulation gives the points of both.
    """

    input: StudyInput
    technique: Technique
    width: int
    height: int
    bits: int = 8
    ssim: bool = False
    flip: bool = False
    shader: bool = True

    @property
    def picture(self) -> "Task":
        """The task of the picture that this one needs, which others may share."""
        technique = self.technique
        if self.shader or technique.kind != SAMPLE_SHADING:
            return self
        return self._replace(technique=Technique(MSAA, technique.samples))


class FailedPoint(NamedTuple):
    """A point that could not be simulated, and why."""

    scene: str
    technique: Technique
    reason: str


class Unusable(Exception):
    """A sweep cannot do what was asked for; the message is for the user."""

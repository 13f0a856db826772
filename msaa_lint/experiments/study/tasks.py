"""What a sweep is asked for, point by point."""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
from typing import NamedTuple

from .points import Technique


class Asked(NamedTuple):
    """What is studied: a scene by name, a mesh, a document of a description. `name` is what reports call it; `text` is a description's."""

    kind: str
    name: str
    path: str = ""
    text: str = ""
    number: int = 0
    format: str | None = None


class Task(NamedTuple):
    """One point to be simulated."""

    asked: Asked
    technique: Technique
    width: int
    height: int
    bits: int = 8
    ssim: bool = False


class Failed(NamedTuple):
    """A point that could not be had, and why."""

    scene: str
    technique: Technique
    reason: str


class Unusable(Exception):
    """What a sweep was asked for cannot be; its text is for the user."""

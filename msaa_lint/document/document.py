"""A description as it was read: what every reader gives."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from ..source.text import Source
from .bind import Problem
from .records import Description


class Document(NamedTuple):
    """One frame, or part of one.

    `whole` says that what the description does not hold the frame does not have: the passes and pipelines listed are all there are. It is
    false for dumps of a single pipeline. `problems` are the mistakes in the description itself; a document with problems is not judged.
    """

    source: Source
    description: Description
    problems: tuple[Problem, ...]
    whole: bool = True
    path: str = ""
    """What stands before every structural path: `documents[1]` in a stream of several, else nothing."""
    modules: Mapping[str, bytes] = {}
    """The code of shaders that came with the input, by the names that `pipelines` have for them; those of a description lie beside it."""

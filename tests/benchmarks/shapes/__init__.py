"""The shapes that `scaling.py` doubles, a module for each kind of input."""

from .capture_texts import SHAPES as CAPTURE_TEXTS
from .captures import SHAPES as CAPTURES
from .description_texts import SHAPES as DESCRIPTION_TEXTS
from .descriptions import SHAPES as DESCRIPTIONS
from .rules import SHAPES as RULES
from .shaders import SHAPES as SHADERS
from .shape import Shape
from .source import SHAPES as SOURCE
from .source_projects import SHAPES as SOURCE_PROJECTS

SHAPES: tuple[Shape, ...] = (
    *DESCRIPTIONS,
    *DESCRIPTION_TEXTS,
    *CAPTURES,
    *CAPTURE_TEXTS,
    *RULES,
    *SHADERS,
    *SOURCE,
    *SOURCE_PROJECTS,
)

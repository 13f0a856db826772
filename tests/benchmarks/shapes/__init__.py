"""The shapes that `scaling.py` doubles, a module for each kind of input."""

from .descriptions import SHAPES as DESCRIPTIONS
from .shape import Shape

SHAPES: tuple[Shape, ...] = (*DESCRIPTIONS,)

"""What a description may hold: the structures, and the types of their members.

The names are Vulkan's structure members without the `p` prefix and without the `...Count` members.
In a structure that is stated, absent arrays, flags and optional structures are none; an absent
scalar, boolean or enumerant is unknown (None). The few arrays and flags whose absence says nothing
are None as well (`Image.usage`, `Image.memory`, the lists of a device).

Inputs are read into these classes (`bind`), without pydantic, which takes longer to import than a
run of `check`. The pydantic models and the JSON Schema are made from the same classes
(`pydantic_models`).
"""

from .commands import *  # noqa: F403
from .frame import *  # noqa: F403
from .metal import *  # noqa: F403
from .vulkan import *  # noqa: F403

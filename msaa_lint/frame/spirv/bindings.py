"""The images that an entry point of a shader declares, by descriptor set and binding."""

from __future__ import annotations

from . import numbers as op
from .module import Module

SUBPASS_DATA = 6
"""The dimensionality of input attachments."""

INTERFACE_OF_ALL = 0x10400
"""The version from which an interface lists all global variables that the entry point uses."""

MAX_ARRAYS = 8
"""How many arrays of arrays are followed."""


def image_bindings(code: bytes, name: str) -> tuple[dict[tuple[int, int], frozenset[bool]], int]:
    """The images by set and binding, each with whether it is multisampled, and the number of words that were read.

    Before SPIR-V 1.4 these are the images that the module declares. Input attachments are left out. Raises SpirvError if the module is
    invalid.
    """
    module = Module(code, declarations_only=True)
    uses = None
    if module.words[1] >= INTERFACE_OF_ALL:
        uses = frozenset().union(*(entry.interface for entry in module.entries if entry.name == name))
    found: dict[tuple[int, int], frozenset[bool]] = {}
    for variable, (holds, storage, _) in module.variables.items():
        number, binding = module.decoration(variable, op.DESCRIPTOR_SET), module.decoration(variable, op.BINDING)
        if storage != op.UNIFORM_CONSTANT or number is None or binding is None or (uses is not None and variable not in uses):
            continue
        image = _image_type(module, holds)
        if image is not None and image[2] != SUBPASS_DATA:
            # Several variables may share a binding.
            found[number, binding] = found.get((number, binding), frozenset()) | {image[5] == 1}
    return found, module.words_read


def _image_type(module: Module, identity: int) -> tuple[int, ...] | None:
    """The OpTypeImage of a variable: an image, a sampled image, or an array of them."""
    for _ in range(MAX_ARRAYS):
        kind = module.types.get(identity, ())
        if len(kind) > 6 and kind[0] == op.TYPE_IMAGE:
            return kind
        if len(kind) < 2 or kind[0] not in (op.TYPE_SAMPLED_IMAGE, op.TYPE_ARRAY, op.TYPE_RUNTIME_ARRAY):
            return None
        identity = kind[1]
    return None

"""The descriptors of a shader, by descriptor set and binding."""

from typing import NamedTuple

from . import numbers as op
from .layouts import Layouts
from .module import Module
from .uses import Uses
from .words import SpirvError

SUBPASS_DATA = 6
"""The dimensionality of input attachments."""

INTERFACE_OF_ALL = 0x10400
"""The version from which an interface lists all global variables that the entry point uses."""

MAX_ARRAYS = 8
"""How many arrays of arrays are followed."""

MAX_DESCRIPTORS = 1 << 20
"""Descriptors of a binding."""

SAMPLER, COMBINED, SAMPLED_IMAGE, STORAGE_IMAGE = (
    "SAMPLER",
    "COMBINED_IMAGE_SAMPLER",
    "SAMPLED_IMAGE",
    "STORAGE_IMAGE",
)
UNIFORM_TEXELS, STORAGE_TEXELS = "UNIFORM_TEXEL_BUFFER", "STORAGE_TEXEL_BUFFER"
UNIFORM_BUFFER, STORAGE_BUFFER, INPUT_ATTACHMENT = (
    "UNIFORM_BUFFER",
    "STORAGE_BUFFER",
    "INPUT_ATTACHMENT",
)
ACCELERATION_STRUCTURE = "ACCELERATION_STRUCTURE_KHR"
"""Short names of VkDescriptorType."""

DIMENSIONS = ("1D", "2D", "3D", "CUBE", "RECT", "BUFFER", "SUBPASS")


class ImageType(NamedTuple):
    """An OpTypeImage: a dimensionality of DIMENSIONS, the component type (`float`, `int`, `uint`;
    64-bit components have `64` at the end), whether it is a depth image, arrayed, multisampled, and
    the ImageFormat of SPIR-V (0: unknown).
    """

    dimension: str
    component: str
    depth: bool
    arrayed: bool
    multisampled: bool
    format: int


class Descriptor(NamedTuple):
    """A variable that is a descriptor. `set` and `binding` are None if they are not stated;
    `length` is 0 for a runtime array; `block` is the type of a buffer, `size` its size in bytes
    with `stride` bytes of a runtime array at its end (0 without). `compares` says that an image or
    a sampler is used with a depth reference, `unfiltered` that a sampler is used with images that
    cannot be filtered.
    """

    set: int | None
    binding: int | None
    kind: str
    length: int = 1
    image: ImageType | None = None
    block: int = 0
    size: int = 0
    stride: int = 0
    attachment: int = 0
    compares: bool = False
    unfiltered: bool = False
    reads: bool = False
    writes: bool = False


def descriptors(module: Module, used: Uses, layouts: Layouts) -> tuple[Descriptor, ...]:
    """The descriptors that an entry point refers to, in the order of set and binding. Raises
    SpirvError for an unknown kind.
    """
    found = []
    for variable, (holds, storage, _) in module.variables.items():
        if variable in used.referred and storage in (
            op.UNIFORM_CONSTANT,
            op.UNIFORM,
            op.STORAGE_BUFFER,
        ):
            descriptor = _descriptor(module, layouts, holds, storage)
            found.append(
                descriptor._replace(
                    set=module.decoration(variable, op.DESCRIPTOR_SET),
                    binding=module.decoration(variable, op.BINDING),
                    attachment=module.decoration(variable, op.INPUT_ATTACHMENT_INDEX) or 0,
                    compares=variable in used.compared,
                    unfiltered=variable in used.unfiltered,
                    reads=variable in used.read,
                    writes=variable in used.written,
                )
            )
    return tuple(sorted(found, key=lambda each: (each.set or 0, each.binding or 0)))


def _descriptor(module: Module, layouts: Layouts, type_id: int, storage: int) -> Descriptor:
    count = 1
    for _ in range(MAX_ARRAYS):
        kind = layouts.kind(type_id)
        if kind[0] not in (op.TYPE_ARRAY, op.TYPE_RUNTIME_ARRAY) or len(kind) < 2:
            break
        count *= layouts.count(kind)
        type_id = kind[1]
    if count > MAX_DESCRIPTORS:
        raise SpirvError(f"a binding has more than {MAX_DESCRIPTORS} descriptors")
    if kind[0] == op.TYPE_STRUCT and storage != op.UNIFORM_CONSTANT:
        is_uniform = storage == op.UNIFORM and op.BUFFER_BLOCK not in module.decorations.get(
            type_id, {}
        )
        tail = layouts.runtime_array(type_id)
        return Descriptor(
            None, None, UNIFORM_BUFFER if is_uniform else STORAGE_BUFFER, count, None, type_id,
            layouts.size(type_id),
            layouts.stride(tail.type_id) if tail is not None else 0,
        )  # fmt: skip
    if kind[0] in _OPAQUE:
        return Descriptor(None, None, _OPAQUE[kind[0]], count)
    image = _image_type(module, type_id)
    if image is None or image[2] >= len(DIMENSIONS):
        raise SpirvError("a descriptor is of an unknown type")
    component = module.types.get(image[1], ())
    if len(component) < 2 or component[0] not in (op.TYPE_FLOAT, op.TYPE_INT):
        raise SpirvError("an image has components of an unknown type")
    name = "float" if component[0] == op.TYPE_FLOAT else "int" if component[-1] else "uint"
    dimension = DIMENSIONS[image[2]]
    described = ImageType(
        dimension,
        name + ("64" if component[1] == 64 else ""),
        image[3] == 1,
        image[4] == 1,
        image[5] == 1,
        image[7],
    )
    if dimension == "SUBPASS":
        made = INPUT_ATTACHMENT
    elif dimension == "BUFFER":
        made = STORAGE_TEXELS if image[6] == 2 else UNIFORM_TEXELS
    else:
        made = (
            COMBINED
            if kind[0] == op.TYPE_SAMPLED_IMAGE
            else STORAGE_IMAGE
            if image[6] == 2
            else SAMPLED_IMAGE
        )
    return Descriptor(None, None, made, count, described)


_OPAQUE = {op.TYPE_SAMPLER: SAMPLER, op.TYPE_ACCELERATION_STRUCTURE: ACCELERATION_STRUCTURE}


def image_bindings(code: bytes, name: str) -> tuple[dict[tuple[int, int], frozenset[bool]], int]:
    """The images by set and binding, each with whether it is multisampled, and the number of words
    that were read.

    Before SPIR-V 1.4 these are the images that the module declares. Input attachments are left out.
    Raises SpirvError if the module is invalid.
    """
    module = Module(code, declarations_only=True)
    uses = None
    if module.words[1] >= INTERFACE_OF_ALL:
        uses = frozenset().union(
            *(entry.interface for entry in module.entries if entry.name == name)
        )
    found: dict[tuple[int, int], frozenset[bool]] = {}
    for variable, (holds, storage, _) in module.variables.items():
        number, binding = (
            module.decoration(variable, op.DESCRIPTOR_SET),
            module.decoration(variable, op.BINDING),
        )
        if (
            storage != op.UNIFORM_CONSTANT
            or number is None
            or binding is None
            or (uses is not None and variable not in uses)
        ):
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
        if len(kind) > 7 and kind[0] == op.TYPE_IMAGE:
            return kind
        if len(kind) < 2 or kind[0] not in (
            op.TYPE_SAMPLED_IMAGE,
            op.TYPE_ARRAY,
            op.TYPE_RUNTIME_ARRAY,
        ):
            return None
        identity = kind[1]
    return None

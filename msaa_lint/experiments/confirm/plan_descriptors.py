"""The descriptors of a shader in a plan, made from its interface: what is created for each, and
with which contents.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from msaa_lint.frame.spirv import bindings
from msaa_lint.frame.spirv.bindings import Descriptor as Reflected
from msaa_lint.frame.spirv.bindings import ImageType
from msaa_lint.frame.spirv.words import SpirvError
from msaa_lint.frame.vulkan.enums import VALUES

from .buffer_contents import BufferContents
from .parts import NONE, Descriptor, packed

RUNTIME_DESCRIPTORS = 16
"""Descriptors of a binding that is a runtime array."""

MAX_DESCRIPTORS = 4096
"""Descriptors of a binding."""

MAX_BINDINGS = 256
"""Bindings of a shader, each of which may take megabytes."""

SAMPLES = 4
"""Samples of a multisampled image."""

TEXELS = 4096
"""Texels of a texel buffer."""

_TYPES = {
    bindings.SAMPLER: 0, bindings.COMBINED: 1, bindings.SAMPLED_IMAGE: 2,
    bindings.STORAGE_IMAGE: 3, bindings.UNIFORM_TEXELS: 4,
    bindings.STORAGE_TEXELS: 5, bindings.UNIFORM_BUFFER: 6, bindings.STORAGE_BUFFER: 7,
    bindings.INPUT_ATTACHMENT: 10,
    bindings.ACCELERATION_STRUCTURE: 1000150000,
}  # fmt: skip
"""VkDescriptorType."""

_VIEWS = {"1D": (0, 4), "2D": (1, 5), "3D": (2, NONE), "CUBE": (3, 6)}
"""VkImageViewType, and that of arrays."""

_FORMATS = (
    "", "R32G32B32A32_SFLOAT", "R16G16B16A16_SFLOAT", "R32_SFLOAT", "R8G8B8A8_UNORM",
    "R8G8B8A8_SNORM", "R32G32_SFLOAT", "R16G16_SFLOAT",
    "B10G11R11_UFLOAT_PACK32", "R16_SFLOAT", "R16G16B16A16_UNORM", "A2B10G10R10_UNORM_PACK32",
    "R16G16_UNORM", "R8G8_UNORM", "R16_UNORM",
    "R8_UNORM", "R16G16B16A16_SNORM", "R16G16_SNORM", "R8G8_SNORM", "R16_SNORM", "R8_SNORM",
    "R32G32B32A32_SINT", "R16G16B16A16_SINT",
    "R8G8B8A8_SINT", "R32_SINT", "R32G32_SINT", "R16G16_SINT", "R8G8_SINT", "R16_SINT", "R8_SINT",
    "R32G32B32A32_UINT",
    "R16G16B16A16_UINT", "R8G8B8A8_UINT", "R32_UINT", "A2B10G10R10_UINT_PACK32", "R32G32_UINT",
    "R16G16_UINT", "R8G8_UINT", "R16_UINT",
    "R8_UINT",
)  # fmt: skip
"""Formats by SPIR-V's ImageFormat."""

_SAMPLED = {"float": "R8G8B8A8_UNORM", "int": "R8G8B8A8_SINT", "uint": "R8G8B8A8_UINT"}
_STORED = {"float": "R32G32B32A32_SFLOAT", "int": "R32G32B32A32_SINT", "uint": "R32G32B32A32_UINT"}
_DEPTH = "D32_SFLOAT"

_WORDS = {
    bindings.COMBINED: "sampled image", bindings.SAMPLED_IMAGE: "sampled image",
    bindings.STORAGE_IMAGE: "storage image",
    bindings.ACCELERATION_STRUCTURE: "acceleration structure",
}  # fmt: skip


class Unmakeable(Exception):
    """A shader needs what cannot be made; the message continues a sentence: `needs an acceleration
    structure, ...`.
    """


def planned(descriptors: Sequence[Reflected], contents: BufferContents) -> tuple[Descriptor, ...]:
    """The descriptors, one for each binding. Raises Unmakeable."""
    for each in descriptors:
        if each.set is None or each.binding is None:
            raise Unmakeable("has a descriptor without a set or binding")
    groups = [
        (place, list(group))
        for place, group in groupby(descriptors, lambda each: (each.set or 0, each.binding or 0))
    ]
    if len(groups) > MAX_BINDINGS:
        raise Unmakeable(f"has {len(groups)} bindings; at most {MAX_BINDINGS} are created")
    return tuple(_binding(*place, group, contents) for place, group in groups)


def _binding(
    number: int, binding: int, variables: Sequence[Reflected], contents: BufferContents
) -> Descriptor:
    where = f"set {number}, binding {binding}"
    first = variables[0]
    kinds = {each.kind for each in variables}
    if kinds <= {bindings.SAMPLER, bindings.SAMPLED_IMAGE, bindings.COMBINED} and len(kinds) > 1:
        first = next(each for each in variables if each.kind != bindings.SAMPLER)._replace(
            kind=bindings.COMBINED
        )
    elif len(kinds) > 1:
        raise Unmakeable(f"has descriptors of different types at {where}")
    images = {each.image for each in variables if each.image is not None}
    if len(images) > 1:
        raise Unmakeable(f"has images of different types at {where}")
    counts = [each.length or RUNTIME_DESCRIPTORS for each in variables]
    if max(counts) > MAX_DESCRIPTORS:
        raise Unmakeable(
            f"needs {max(counts)} descriptors at {where}; at most {MAX_DESCRIPTORS} are created"
        )
    made = Descriptor(
        number,
        binding,
        _TYPES[first.kind],
        max(counts),
        compares=any(each.compares for each in variables),
        nearest=any(each.unfiltered for each in variables)
        or any(image.component != "float" for image in images),
    )
    if first.kind == bindings.ACCELERATION_STRUCTURE:
        raise Unmakeable(f"needs an acceleration structure at {where}, which is not created")
    if first.image is not None:
        return _image(made, first, first.image, where)
    if first.kind in (bindings.UNIFORM_BUFFER, bindings.STORAGE_BUFFER):
        try:
            data = max((contents.of(each.block) for each in variables), key=len)
        except SpirvError as error:
            raise Unmakeable(f"has a buffer at {where} that cannot be created: {error}") from None
        # The size decides the length of a runtime array.
        unit = 16 if first.kind == bindings.UNIFORM_BUFFER else 4
        return made._replace(size=max(-(-len(data) // unit) * unit, unit), contents=packed(data))
    return made


def _image(made: Descriptor, reflected: Reflected, image: ImageType, where: str) -> Descriptor:
    if image.component not in _SAMPLED:
        raise Unmakeable(f"has an image with 64-bit components at {where}, which is not created")
    if reflected.kind == bindings.INPUT_ATTACHMENT:
        return made._replace(
            attachment=reflected.attachment, samples=SAMPLES if image.multisampled else 1
        )
    if reflected.kind in (bindings.UNIFORM_TEXELS, bindings.STORAGE_TEXELS):
        name = _stated(image, where) or _STORED[image.component]
        return made._replace(format=VALUES["VkFormat"][name], size=16 * TEXELS)
    view = _VIEWS.get(image.dimension, (NONE, NONE))[image.arrayed]
    if view == NONE:
        raise Unmakeable(
            f"has a {_WORDS[reflected.kind]} of the dimensionality {image.dimension} at {where}, "
            "which Vulkan does not have"
        )
    name = _SAMPLED[image.component]
    compares = made.compares or (image.depth and reflected.kind == bindings.COMBINED)
    if reflected.kind == bindings.STORAGE_IMAGE:
        name = _stated(image, where) or _STORED[image.component]
    elif compares:
        name = _DEPTH
    return made._replace(
        view=view,
        format=VALUES["VkFormat"][name],
        samples=SAMPLES if image.multisampled else 1,
        compares=compares,
    )


def _stated(image: ImageType, where: str) -> str:
    """The format that a storage image states; empty if it states none."""
    if image.format >= len(_FORMATS):
        raise Unmakeable(f"has an image of an unknown format at {where}")
    return _FORMATS[image.format]

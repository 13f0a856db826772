"""Stages of a plan for a fragment shader from outside: the shader with its descriptors, and a
vertex shader that writes its inputs.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from msaa_lint.core.quote import quoted
from msaa_lint.frame.spirv import numbers as op
from msaa_lint.frame.spirv.constants import Constants
from msaa_lint.frame.spirv.interface import Interface, interface
from msaa_lint.frame.spirv.layouts import Layouts
from msaa_lint.frame.spirv.module import Entry, Module
from msaa_lint.frame.spirv.words import SpirvError

from .buffer_contents import BufferContents
from .parts import Stage, packed
from .plan_descriptors import Unmakeable, planned
from .shader_features import EXTENSIONS, needed
from .shaders.vertex import vertex_shader

VERTEX, FRAGMENT = 1, 16
"""VkShaderStageFlagBits."""


class ReflectedStage(NamedTuple):
    """A stage, its interface, and the layouts of its types."""

    stage: Stage
    interface: Interface
    layouts: Layouts


def reflected_stage(
    module: Module, entry: Entry, number: int, path: str, constants: Sequence[tuple[int, float]]
) -> ReflectedStage:
    """A stage with the descriptors and push constants that it uses. Raises SpirvError for an
    invalid module, and Unmakeable if it needs what cannot be created on any device.
    """
    specialization: Mapping[int, float] = dict(constants)
    values = Constants(module, specialization)
    layouts = Layouts(module, values)
    found = interface(module, entry, values)
    features, unsupported = needed(found.capabilities)
    if unsupported:
        raise Unmakeable(f"needs the capability {unsupported}, which is not supported")
    extension = min(found.extensions - EXTENSIONS, default="")
    if extension:
        raise Unmakeable(f"needs the extension {quoted(extension)}, which is not supported")
    contents = BufferContents(layouts)
    pushed = packed(contents.of(found.push_constants)) if found.push_constants else ""
    if any(descriptor.writes for descriptor in found.descriptors):
        features = (
            *features,
            "fragmentStoresAndAtomics" if number == FRAGMENT else "vertexPipelineStoresAndAtomics",
        )
    stage = Stage(
        number, path, entry.name, tuple(constants), "", planned(found.descriptors, contents),
        pushed, features, found.version
    )  # fmt: skip
    return ReflectedStage(stage, found, layouts)


def scene_stage(fragment: ReflectedStage) -> Stage:
    """The vertex shader that draws the scene for a fragment shader. Raises Unmakeable if one of the
    inputs cannot be written.
    """
    try:
        code = vertex_shader(fragment.interface, fragment.layouts)
    except SpirvError as error:
        raise Unmakeable(
            f"has inputs that no vertex shader can be generated for: {error}"
        ) from None
    return Stage(VERTEX, "", "main", code=packed(code))


def fragment_entry(module: Module, name: str | None) -> Entry:
    """The fragment shader with a name; without one `main`, or the first. Raises SpirvError if there
    is none.
    """
    entries = [entry for entry in module.entries if entry.model == op.FRAGMENT]
    if not entries:
        raise SpirvError("it has no fragment shader")
    named = [entry for entry in entries if entry.name == (name or "main")]
    if not named and name is not None:
        return module.entry(name)
    return (named or entries)[0]

"""The described SPIR-V of pipelines: read from the project, with the specialization constants in
the types that the modules declare.
"""

from __future__ import annotations

import math
import os
import struct
import sys
from collections.abc import Sequence

from msaa_lint.core.project import Outside, project_root, real_path
from msaa_lint.core.quote import quoted_path
from msaa_lint.core.text.files import read
from msaa_lint.core.text.source import Unreadable
from msaa_lint.core.urls import is_url
from msaa_lint.frame.description.models import Pipeline, ShaderStage
from msaa_lint.frame.spirv import numbers as op
from msaa_lint.frame.spirv.module import MAX_BYTES, Module
from msaa_lint.frame.spirv.words import SpirvError

from .parts import Stage, packed
from .plan_descriptors import Unmakeable
from .plan_integers import number
from .plan_notes import Notes
from .shader_stages import VERTEX, ReflectedStage, fragment_entry, reflected_stage, scene_stage

_FLOATS = {16: "e", 32: "f", 64: "d"}
"""The formats of `struct` by width in bits."""


class UnusableShader(Exception):
    """A described shader that must not be replaced by a built-in one; the message is for the
    user.
    """


def stages(record: Pipeline, folder: str, notes: Notes) -> tuple[Stage, ...]:
    """The vertex and fragment stages whose files exist and whose needs can be met, with a generated
    vertex shader if only the fragment shader's can; notes say why others are left out.

    The instructions are not validated: the driver runs in its own process. UnusableShader for a
    file outside the project, one that cannot be read, and a constant that does not fit its type.
    """
    found: list[Stage] = []
    fragment: ReflectedStage | None = None
    for stage_record in record.stages:
        shader = f"the {(stage_record.stage or 'unnamed').lower()} shader of "
        title = shader + record.key
        if stage_record.stage is not None and stage_record.stage not in ("VERTEX", "FRAGMENT"):
            notes.append(
                f"{shader}{{}} is ignored: only vertex and fragment shaders are supported",
                record.key,
            )
            continue
        if stage_record.module is None and stage_record.stage is None:
            continue
        path = os.path.join(folder, stage_record.module or "")
        code = _code(path, title, folder) if stage_record.module else None
        if code is None or stage_record.stage is None:
            notes.append(f"{shader}{{}} does not exist: a built-in one is used", record.key)
            continue
        # The child process has another working folder, and reads no URLs.
        real = path if is_url(folder) else real_path(path, project_root(folder))
        try:
            reflected = _reflected(code, stage_record, real, title)
        except SpirvError as error:
            notes.append(f"{title} cannot be read ({error}): a built-in one is used")
            continue
        except Unmakeable as error:
            notes.append(f"{shader}{{}} {error}: a built-in one is used", record.key)
            continue
        found.append(
            reflected.stage._replace(code=packed(code)) if is_url(folder) else reflected.stage
        )
        if stage_record.stage == "FRAGMENT":
            fragment = reflected
    if fragment is not None and all(stage.stage != VERTEX for stage in found):
        try:
            found.append(scene_stage(fragment))
        except Unmakeable as error:
            notes.append(f"the fragment shader of {{}} {error}: a built-in one is used", record.key)
            return ()
    if any(stage.descriptors or stage.pushed for stage in found):
        notes.append(
            "the contents of the descriptors and push constants of {} are not described: patterns "
            "are assumed",
            record.key,
        )
    return tuple(found)


def _reflected(code: bytes, record: ShaderStage, path: str, title: str) -> ReflectedStage:
    """A stage with what it needs. Raises SpirvError; Unmakeable if it needs what a description does
    not state.
    """
    module = Module(code)
    entry = (
        fragment_entry(module, record.name or "main")
        if record.stage == "FRAGMENT"
        else module.entry(record.name or "main")
    )
    constants = _constants(module, record, title)
    reflected = reflected_stage(
        module, entry, number("VkShaderStageFlagBits", record.stage or ""), path, constants
    )
    if record.stage == "VERTEX":
        if reflected.interface.descriptors:
            raise Unmakeable("reads descriptors, which are not described")
        if reflected.interface.inputs:
            raise Unmakeable("has inputs, which are not described")
    feedback = next(
        (each for each in reflected.interface.descriptors if each.reads and each.writes), None
    )
    if feedback is not None:
        raise Unmakeable(
            f"reads what it writes to set {feedback.set}, binding {feedback.binding}, so that "
            "pictures may differ"
        )
    return reflected


def _code(path: str, title: str, folder: str) -> bytes | None:
    """The bytes of a shader; None if there is no such file."""
    try:
        return read(path, MAX_BYTES, project_root(folder))
    except FileNotFoundError:
        return None
    except Outside:
        raise UnusableShader(
            f"{title} is refused: {quoted_path(path)} is outside the project; move it into the "
            "project"
        ) from None
    except (OSError, Unreadable) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise UnusableShader(f"{title}, {quoted_path(path)}, cannot be read: {reason}") from None


def _constants(module: Module, record: ShaderStage, title: str) -> tuple[tuple[int, float], ...]:
    """The specialization constants, checked against the types that the module declares."""
    constants = tuple((int(name), value) for name, value in (record.specialization or {}).items())
    types = _types(module)
    for identity, value in constants:
        kind = types.get(identity)
        try:
            if kind:
                _packed(kind, value)
        except (ValueError, OverflowError, struct.error):
            problem = (
                f"specialization constant {identity} of {title} is {value!r}, which its type "
                f"{_type_name(kind or ())} cannot represent"
            )
            raise UnusableShader(problem) from None
    return constants


def specialization(
    module: Module, constants: Sequence[tuple[int, float]]
) -> list[tuple[int, bytes]]:
    """The ids and bytes of specialization constants, without those that the module does not have.
    ValueError, OverflowError, or struct.error if the type of a constant does not have its value.
    """
    types = _types(module)
    return [
        (identity, _packed(types[identity], value))
        for identity, value in constants
        if types.get(identity)
    ]


def _types(module: Module) -> dict[int | None, tuple[int, ...]]:
    """The types of specialization constants by id."""
    kinds = (op.SPEC_CONSTANT_TRUE, op.SPEC_CONSTANT_FALSE, op.SPEC_CONSTANT)
    declared = (
        (identity, type_id)
        for identity, (instruction, type_id, *_) in module.constants.items()
        if instruction in kinds
    )
    return {
        module.decoration(identity, op.SPEC_ID): module.types.get(type_id, ())
        for identity, type_id in declared
    }


def _packed(kind: tuple[int, ...], value: float | bool) -> bytes:
    """The bytes of a constant of a type. An integer may state the bits of either signedness.
    ValueError, OverflowError, or struct.error if the type does not have the value.
    """
    if not math.isfinite(value):
        raise ValueError
    if kind[0] == op.TYPE_BOOL:
        return struct.pack("=I", bool(value))
    if kind[0] == op.TYPE_FLOAT:
        return struct.pack("=" + _FLOATS.get(kind[1], ""), value)
    if kind[0] != op.TYPE_INT or int(value) != value:
        raise ValueError
    width, whole = kind[1], int(value)
    if not -(1 << width - 1) <= whole < 1 << width:
        raise OverflowError
    return (whole % (1 << width)).to_bytes(width // 8, sys.byteorder)


def _type_name(kind: tuple[int, ...]) -> str:
    if kind[0] == op.TYPE_FLOAT:
        return f"float{kind[1]}"
    return f"{'' if kind[2] else 'u'}int{kind[1]}" if kind[0] == op.TYPE_INT else "bool"

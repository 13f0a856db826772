"""What an entry point takes from outside and hands on: descriptors, push constants, inputs,
outputs, specialization constants.
"""

from collections.abc import Mapping
from typing import NamedTuple

from . import numbers as op
from .bindings import Descriptor, descriptors
from .constants import MAX_DEPTH, Constants
from .layouts import Layouts
from .module import Entry, Module
from .uses import Uses, uses
from .words import SpirvError

INTERPOLATIONS = {
    op.FLAT: "flat",
    op.NO_PERSPECTIVE: "noperspective",
    op.CENTROID: "centroid",
    op.SAMPLE: "sample",
}

MAX_LOCATIONS = 128
"""Locations of an interface; devices have 32 on the whole."""


class Varying(NamedTuple):
    """A user-defined input or output: the variable, its type by id and in GLSL's words, the
    location of a block's first member if the variable has none (None if none is stated), the first
    component, the index of dual-source blending, and how it is interpolated.
    """

    variable: int
    type_id: int
    type: str
    location: int | None
    component: int = 0
    blend_index: int = 0
    interpolation: frozenset[str] = frozenset()


class Interface(NamedTuple):
    """The interface of an entry point. `version` is that of SPIR-V; `built_ins` are numbers of the
    SPIR-V registry, of inputs, with the number of elements (1 if it is no array); `push_constants`
    is the id of the block (0 without) and `push_size` its size in bytes; `specialization` has the
    types, in GLSL's words, by constant id.
    """

    entry: Entry
    version: tuple[int, int]
    capabilities: frozenset[int]
    extensions: frozenset[str]
    descriptors: tuple[Descriptor, ...]
    push_constants: int
    push_size: int
    inputs: tuple[Varying, ...]
    built_ins: Mapping[int, int]
    outputs: tuple[Varying, ...]
    specialization: Mapping[int, str]


def interface(module: Module, entry: Entry, constants: Constants) -> Interface:
    """The interface of an entry point, with the descriptors that it refers to. Raises SpirvError
    for an invalid module.
    """
    used = uses(module, entry)
    layouts = Layouts(module, constants)
    push, push_size = _push_constants(module, used, layouts)
    version = module.words[1]
    return Interface(
        entry,
        (version >> 16 & 0xFF, version >> 8 & 0xFF),
        frozenset(module.capabilities),
        frozenset(module.extensions),
        descriptors(module, used, layouts),
        push,
        push_size,
        _varyings(module, entry, op.INPUT, layouts),
        _built_ins(module, entry, layouts),
        _varyings(module, entry, op.OUTPUT, layouts),
        {
            spec: type_name(layouts, type_id)
            for identity, (number, type_id, *_) in module.constants.items()
            if number in (op.SPEC_CONSTANT_TRUE, op.SPEC_CONSTANT_FALSE, op.SPEC_CONSTANT)
            and (spec := module.decoration(identity, op.SPEC_ID)) is not None
        },
    )


def _push_constants(module: Module, used: Uses, layouts: Layouts) -> tuple[int, int]:
    blocks = [
        v.holds
        for identity, v in module.variables.items()
        if v.storage == op.PUSH_CONSTANT and identity in used.referred
    ]
    return (blocks[0], layouts.size(blocks[0])) if blocks else (0, 0)


def _varyings(module: Module, entry: Entry, storage: int, layouts: Layouts) -> tuple[Varying, ...]:
    found = []
    for identity, variable in module.variables.items():
        if (
            variable.storage != storage
            or identity not in entry.interface
            or _is_built_in(module, identity)
        ):
            continue
        members = module.members.get(variable.holds, {}).values()
        decorations = {
            *module.decorations.get(identity, ()),
            *(number for member in members for number in member),
        }
        location = module.decoration(identity, op.LOCATION)
        if location is None and layouts.kind(variable.holds)[0] == op.TYPE_STRUCT:
            location = min(
                (member[op.LOCATION][0] for member in members if member.get(op.LOCATION)),
                default=None,
            )
        found.append(
            Varying(
                identity,
                variable.holds,
                type_name(layouts, variable.holds),
                location,
                module.decoration(identity, op.COMPONENT) or 0,
                module.decoration(identity, op.INDEX) or 0,
                frozenset(word for number, word in INTERPOLATIONS.items() if number in decorations),
            )
        )
    return tuple(
        sorted(
            found,
            key=lambda each: (
                each.location is None,
                each.location or 0,
                each.component,
                each.variable,
            ),
        )
    )


def _is_built_in(module: Module, identity: int) -> bool:
    members = module.members.get(module.variables[identity].holds, {}).values()
    return module.decoration(identity, op.BUILT_IN) is not None or any(
        op.BUILT_IN in member for member in members
    )


def _built_ins(module: Module, entry: Entry, layouts: Layouts) -> dict[int, int]:
    found: dict[int, int] = {}
    for identity, variable in module.variables.items():
        if variable.storage == op.INPUT and identity in entry.interface:
            kind = layouts.kind(variable.holds)
            stated = [(module.decorations.get(identity, {}), kind)]
            stated += [
                (each, layouts.kind(kind[1 + n]))
                for n, each in module.members.get(variable.holds, {}).items()
                if n + 1 < len(kind)
            ]
            for decorations, own in stated:
                if decorations.get(op.BUILT_IN):
                    found[decorations[op.BUILT_IN][0]] = (
                        layouts.count(own) if own[0] == op.TYPE_ARRAY else 1
                    )
    return found


_VECTORS = {"float": "vec", "int": "ivec", "uint": "uvec", "bool": "bvec", "double": "dvec"}


def type_name(layouts: Layouts, type_id: int, depth: int = 0) -> str:
    """A type in GLSL's words: `vec3`, `mat4x3`, `uint[4]`, `struct`."""
    kind = layouts.kind(type_id)
    if depth > MAX_DEPTH:
        raise SpirvError("the types are nested too deeply")
    if kind[0] == op.TYPE_BOOL:
        return "bool"
    if kind[0] == op.TYPE_FLOAT and len(kind) > 1:
        return {32: "float", 64: "double"}.get(kind[1], f"float{kind[1]}_t")
    if kind[0] == op.TYPE_INT and len(kind) > 2:
        return ("int" if kind[2] else "uint") + ("" if kind[1] == 32 else f"{kind[1]}_t")
    if kind[0] == op.TYPE_VECTOR and len(kind) > 2:
        component = type_name(layouts, kind[1], depth + 1)
        return (
            f"{_VECTORS[component]}{kind[2]}" if component in _VECTORS else f"{component}{kind[2]}"
        )
    if kind[0] == op.TYPE_MATRIX and len(kind) > 2:
        column = layouts.kind(kind[1])
        return f"mat{kind[2]}x{column[2] if len(column) > 2 else 0}"
    if kind[0] == op.TYPE_ARRAY and len(kind) > 1:
        return f"{type_name(layouts, kind[1], depth + 1)}[{layouts.count(kind)}]"
    return "struct" if kind[0] == op.TYPE_STRUCT else "unknown"

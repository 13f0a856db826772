"""What an entry point of a module does with multisampling."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from . import numbers as op
from .bodies import Body, reached
from .constants import Constants
from .follow import Follower
from .instructions import QUERIED
from .module import Entry, Module
from .state import UNWRITTEN, GivenUp, ImageKey, Seen, Site
from .values import Value, plain
from .words import SpirvError

CONSTANT, LOOP, CURRENT, UNKNOWN = "CONSTANT", "LOOP", "CURRENT", "UNKNOWN"
"""The kind of a sample operand: one constant; several, one after another; the shaded sample;
anything else.
"""

AVERAGE, MIN, MAX, OTHER = "AVERAGE", "MIN", "MAX", "OTHER"


class Where(NamedTuple):
    """Which image a shader reads: its descriptor set and binding, the index into an array of them,
    and the input attachment's index.

    None where it has none, or it is not known.
    """

    descriptor_set: int | None = None
    binding: int | None = None
    element: int | None = None
    input_attachment: int | None = None


class Fetch(NamedTuple):
    """An instruction that fetches from a multisampled image: the kind of its sample operand, and
    its known values.
    """

    image: Where
    operand: str
    samples: tuple[int, ...]


class Multisampled(NamedTuple):
    """A multisampled image that is fetched from.

    `samples` are all that are fetched, None where that is not known; `always` those of them that do
    not hang on a condition that constants do not decide. `total` is N where all are 0 to N-1;
    `queried` says that N is what the shader asks the image for (it is then None); `looped` that a
    loop goes over samples. `resolves` is what becomes of the values: the plain AVERAGE of all N,
    their MIN or MAX, OTHER for anything else and whatever is not certain; None where one sample is
    fetched.
    """

    image: Where
    samples: tuple[int, ...] | None
    always: tuple[int, ...]
    total: int | None
    queried: bool
    looped: bool
    resolves: str | None


class Alpha(NamedTuple):
    """The alpha of color output 0 (location 0, index 0, component 3): whether it exists, whether it
    is stored to, and its constant value if it always has the same one. None is unknown.
    """

    declared: bool | None
    written: bool | None
    constant: float | None


class Reflected(NamedTuple):
    """An entry point. `stage` is Vulkan's name; `built_ins` has SampleId, SamplePosition and
    SampleMask where they are read.

    `sample_inputs` are the locations (None where there is none) of the inputs decorated Sample that
    are read. `followed` is false where the shader was too much to follow, or did not have to be;
    what only that shows is then unknown. `fetching` says whether it may fetch samples at all;
    `steps` how many instructions were followed.
    """

    stage: str
    name: str
    capabilities: frozenset[int]
    built_ins: frozenset[str]
    sample_inputs: tuple[int | None, ...]
    sample_rate_shading: bool
    interlock: bool
    fetching: bool
    fetches: tuple[Fetch, ...]
    images: tuple[Multisampled, ...]
    alpha: Alpha
    discards: bool
    followed: bool
    steps: int
    exhausted: bool = False
    """Whether it was not followed to its end because it takes too many instructions."""


def reflect(
    code: bytes, entry: str | None = None, specialization: Mapping[int, float | bool] | None = None
) -> Reflected:
    """What an entry point does with multisampling; without a name, the only entry point or the only
    fragment shader.

    `specialization` has values by constant id. Raises SpirvError, and nothing else, where the bytes
    are no SPIR-V or have no such entry point; a module of 1 MB takes under a second.
    """
    return reflected(Module(code), entry, specialization or {})


def reflected(
    module: Module, name: str | None, specialization: Mapping[int, float | bool], alpha: bool = True
) -> Reflected:
    """As `reflect`, of a module that was read before. Without `alpha` what is stored to the
    output's alpha need not be found out: a shader that fetches no samples is then not followed.
    """
    entry = module.entry(name)
    bodies = reached(module, entry.function)
    constants = Constants(module, specialization)
    built_ins, sample_inputs = _inputs(module, constants, bodies)
    follower = Follower(module, constants, bodies)
    begun = follower.steps
    memory: dict[int, Value] | None = None
    followed = alpha or any(body.fetches for body in bodies.values())
    try:
        memory = follower.follow(entry.function) if followed else None
    except GivenUp:
        followed = False
    looped = {
        key for site in follower.sites.values() if len(set(site.samples)) > 1 for key in site.images
    }
    return Reflected(
        op.MODELS.get(entry.model, str(entry.model)),
        entry.name,
        frozenset(module.capabilities),
        built_ins,
        sample_inputs,
        op.SAMPLE_RATE_SHADING in module.capabilities,
        any(mode in op.INTERLOCKS for mode in module.modes.get(entry.function, ())),
        any(body.fetches for body in bodies.values()),
        tuple(
            fetch for site in follower.sites.values() for fetch in _fetches(module, site, followed)
        ),
        tuple(
            _image(module, key, seen, key in looped, followed)
            for key, seen in follower.images.items()
        ),
        _alpha(module, constants, entry, memory, followed),
        any(body.discards for body in bodies.values()),
        followed,
        begun - max(follower.steps, 0),
        follower.steps < 0,
    )


# Inputs


def _inputs(
    module: Module, constants: Constants, bodies: Mapping[int, Body]
) -> tuple[frozenset[str], tuple[int | None, ...]]:
    """The built-ins for samples, and the inputs decorated with Sample, that the functions refer
    to.
    """
    built_ins: set[str] = set()
    sampled: dict[tuple[int, int], int | None] = {}
    uses: dict[int, set[int | None]] = {}
    inputs = {
        identity: variable
        for identity, variable in module.variables.items()
        if variable.storage == op.INPUT
    }
    for body in bodies.values():
        for identity in inputs.keys() & body.uses.keys():
            uses.setdefault(identity, set()).update(body.uses[identity])
    # Variables of one structure, each of whose members would be looked at for each of them.
    members_left = len(module.words)
    for identity, indices in uses.items():
        variable = inputs[identity]
        built_in = module.decoration(identity, op.BUILT_IN)
        if built_in in op.BUILT_INS:
            built_ins.add(op.BUILT_INS[built_in])
        location = module.decoration(identity, op.LOCATION)
        if module.decoration(identity, op.SAMPLE) is not None:
            sampled[identity, -1] = location
        members = {index if index is None else constants.values.get(index) for index in indices}
        members_left -= len(module.members.get(variable.holds, ()))
        if members_left < 0:
            raise SpirvError("it has too many inputs of structures with decorated members")
        for member, decorations in module.members.get(variable.holds, {}).items():
            if (
                None not in members
                and member not in members
                and all(type(each) is int for each in members)
            ):
                continue
            if op.SAMPLE in decorations:
                own = decorations.get(op.LOCATION)
                sampled[identity, member] = (
                    own[0] if own else location if location is None else location + member
                )
            own = decorations.get(op.BUILT_IN)
            if own and own[0] in op.BUILT_INS:
                built_ins.add(op.BUILT_INS[own[0]])
    return frozenset(built_ins), tuple(
        sorted(sampled.values(), key=lambda location: (location is None, location or 0))
    )


# Images


def _where(module: Module, key: ImageKey | None) -> Where:
    if key is None:
        return Where()
    variable, indices = key
    index = (
        indices[0][1]
        if len(indices) == 1 and type(indices[0]) is tuple and indices[0][0] is int
        else None
    )
    return Where(
        module.decoration(variable, op.DESCRIPTOR_SET),
        module.decoration(variable, op.BINDING),
        index,
        module.decoration(variable, op.INPUT_ATTACHMENT_INDEX),
    )


def _fetches(module: Module, site: Site, followed: bool) -> list[Fetch]:
    samples = tuple(dict.fromkeys(site.samples))
    if site.unknown or not followed or (site.current and samples):
        operand = UNKNOWN
    elif site.current:
        operand = CURRENT
    else:
        operand = CONSTANT if len(samples) == 1 else LOOP
    return [Fetch(_where(module, key), operand, samples) for key in site.images]


def _image(module: Module, key: ImageKey, seen: Seen, looped: bool, followed: bool) -> Multisampled:
    where = _where(module, key)
    if seen.unknown or not followed or not seen.samples:
        return Multisampled(where, None, (), None, False, looped, OTHER)
    samples = tuple(sorted(seen.samples))
    count = len(samples) if samples[-1] == len(samples) - 1 else None
    queried = seen.queried and count == QUERIED
    resolves: str | None = OTHER
    if len(samples) == 1:
        resolves = None
    elif seen.uses and count is not None:
        kinds = {kind if own == seen.samples else OTHER for kind, own in seen.uses}
        resolves = kinds.pop() if len(kinds) == 1 else OTHER
    always = () if queried else tuple(sorted(seen.always))
    return Multisampled(
        where,
        None if queried else samples,
        always,
        None if queried else count,
        queried,
        looped,
        resolves,
    )


# Outputs


def _alpha(
    module: Module,
    constants: Constants,
    entry: Entry,
    memory: Mapping[int, Value] | None,
    followed: bool,
) -> Alpha:
    declared: bool | None = False
    written: bool | None = False
    values: list[Value] = []
    for identity, variable in module.variables.items():
        if variable.storage != op.OUTPUT or (entry.interface and identity not in entry.interface):
            continue
        kind = module.types.get(variable.holds, ())
        location = module.decoration(identity, op.LOCATION)
        if kind and kind[0] == op.TYPE_STRUCT:
            if identity in entry.interface and module.decoration(identity, op.BUILT_IN) is None:
                declared = written = None
            continue
        if location != 0 or (module.decoration(identity, op.INDEX) or 0) != 0:
            continue
        value = memory.get(identity) if memory is not None else None
        if kind and kind[0] == op.TYPE_ARRAY:
            kind = module.types.get(kind[1], ())
            value = (
                value[0]
                if type(value) is tuple and value
                else value
                if value is UNWRITTEN
                else None
            )
        first = module.decoration(identity, op.COMPONENT) or 0
        width = kind[2] if len(kind) > 2 and kind[0] == op.TYPE_VECTOR else 1
        if first <= 3 < first + width:
            declared = True
            if type(value) is tuple and len(value) == width:
                value = value[3 - first]
            elif width > 1 and value is not UNWRITTEN:
                value = None if value is None else ...
            values.append(value)
    if not declared:
        return Alpha(declared, declared and written, None)
    if not followed or None in values:
        return Alpha(True, None, None)
    written = any(value is not UNWRITTEN for value in values)
    constant = float(values[0]) if len(values) == 1 and plain(values[0]) else None
    return Alpha(True, written, constant)

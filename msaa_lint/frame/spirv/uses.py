"""What the functions that an entry point reaches do with the variables declared outside of
functions.
"""

from collections.abc import Iterable
from typing import NamedTuple

from . import numbers as op
from .bodies import reached
from .module import Entry, Module

_ALL = (1, 1 << 16)
_OPERANDS = {
    op.LOAD: (3, 4), op.STORE: (1, 3), op.COMPOSITE_EXTRACT: (3, 4), op.COMPOSITE_INSERT: (3, 5),
    op.VECTOR_SHUFFLE: (3, 5),
    op.EXT_INST: (5, 1 << 16), op.LINE: (0, 0), op.LABEL: (0, 0), op.LOOP_MERGE: (0, 0),
    op.SELECTION_MERGE: (0, 0), op.BRANCH: (0, 0),
    op.SWITCH: (1, 2), op.VARIABLE: (4, 5),
}  # fmt: skip
"""The words (first and end) that are ids of values; all words of other instructions."""

_SOURCES = {
    op.LOAD: (3, 4), op.ACCESS_CHAIN: (3, 4), op.IN_BOUNDS_ACCESS_CHAIN: (3, 4),
    op.PTR_ACCESS_CHAIN: (3, 4), op.COPY_OBJECT: (3, 4),
    op.COPY_LOGICAL: (3, 4), op.SAMPLED_IMAGE: (3, 5), op.IMAGE: (3, 4),
    op.IMAGE_TEXEL_POINTER: (3, 4), op.SELECT: (4, 6),
    op.PHI: (3, 1 << 16),
}  # fmt: skip
"""The words from which the result is derived: pointers, images, samplers."""

_HANDLES = frozenset(
    {op.TYPE_IMAGE, op.TYPE_SAMPLER, op.TYPE_SAMPLED_IMAGE, op.TYPE_ACCELERATION_STRUCTURE}
)


class Uses(NamedTuple):
    """The ids of variables: those that are referred to at all, those of images and samplers that
    compare with a depth reference, samplers of images that cannot be filtered (of integers, and
    depth images), and those whose contents are read and written.
    """

    referred: frozenset[int]
    compared: frozenset[int]
    unfiltered: frozenset[int]
    read: frozenset[int]
    written: frozenset[int]


def uses(module: Module, entry: Entry) -> Uses:
    """The variables that an entry point uses. Raises SpirvError if a function is missing or
    truncated.
    """
    sources: dict[int, list[int]] = {}
    referred: set[int] = set()
    seeds: dict[str, set[int]] = {
        "compared": set(),
        "unfiltered": set(),
        "read": set(),
        "written": set(),
    }
    pairs: set[tuple[int, int]] = set()
    for body in reached(module, entry.function).values():
        at, words = body.function.start, module.words
        while at < body.function.end:
            end = at + (words[at] >> 16)
            _instruction(module, words[at:end], sources, referred, seeds, pairs)
            at = end
    compared = _variables(module, seeds["compared"], sources)
    for image, sampler in pairs:
        if compared & _variables(module, [image], sources) and not compared & _variables(
            module, [sampler], sources
        ):
            seeds["unfiltered"].add(sampler)
    others = (
        _variables(module, seeds[name], sources) for name in ("unfiltered", "read", "written")
    )
    return Uses(frozenset(referred), compared, *others)


def _instruction(
    module: Module,
    words: Iterable[int],
    sources: dict[int, list[int]],
    referred: set[int],
    seeds: dict[str, set[int]],
    pairs: set[tuple[int, int]],
) -> None:
    operands = list(words)
    number = operands[0] & 0xFFFF
    begin, end = _OPERANDS.get(number, _ALL)
    referred.update(operand for operand in operands[begin:end] if operand in module.variables)
    if number in _SOURCES:
        begin, end = _SOURCES[number]
        sources.setdefault(operands[2], []).extend(operands[begin:end])
        if number == op.SAMPLED_IMAGE:
            pairs.add((operands[3], operands[4]))
            if _is_integer(module, operands[1]):
                seeds["unfiltered"].add(operands[4])
        elif number == op.LOAD and module.types.get(operands[1], (0,))[0] not in _HANDLES:
            seeds["read"].add(operands[3])
    elif number == op.FUNCTION_CALL:
        function = module.functions[operands[3]]
        for parameter, argument in zip(function.parameters, operands[4:], strict=False):
            sources.setdefault(parameter, []).append(argument)
    elif number in op.COMPARISONS:
        seeds["compared"].update(operands[3:4])
    elif number in (op.IMAGE_READ, op.SPARSE_READ):
        seeds["read"].update(operands[3:4])
    elif number in op.ATOMICS:
        seeds["read"].update(operands[3:4])
        seeds["written"].update(operands[3:4])
    elif number == op.COPY_MEMORY:
        seeds["read"].update(operands[2:3])
        seeds["written"].update(operands[1:2])
    elif number in (op.STORE, op.IMAGE_WRITE, op.ATOMIC_STORE):
        seeds["written"].update(operands[1:2])


def _is_integer(module: Module, sampled_image: int) -> bool:
    """Whether the components of the image of an OpTypeSampledImage are integers."""
    kind = module.types.get(sampled_image, ())
    image = module.types.get(kind[1], ()) if len(kind) > 1 else ()
    component = module.types.get(image[1], ()) if len(image) > 1 else ()
    return bool(component) and component[0] == op.TYPE_INT


def _variables(
    module: Module, seeds: Iterable[int], sources: dict[int, list[int]]
) -> frozenset[int]:
    """The variables that values are derived from."""
    found: set[int] = set()
    waiting = list(seeds)
    while waiting:
        value = waiting.pop()
        if value not in found:
            found.add(value)
            waiting.extend(sources.get(value, ()))
    return frozenset(found & module.variables.keys())

"""Values by the models: for every shape that a member has, what it may hold as JSON, in each of its
spellings.
"""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

from msaa_lint.frame.description import models
from msaa_lint.frame.description.models import MetalRecord
from msaa_lint.frame.description.pydantic_models import Structure, model_of
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.metal import names as metal_names
from msaa_lint.frame.vulkan.enums import BITLESS, ENUMS, PREFIXES, VALUES
from msaa_lint.frame.vulkan.names import VENDORS

Json = Any

NAMES = st.sampled_from(["a", "b", "color_ms", "0", "ünï", "with space", "a.b"])
TEXTS = st.text(st.characters(codec="utf-8", exclude_categories=("Cs", "Cc")), max_size=6)

RECORDS: dict[str, type[Record]] = {
    kind.__name__: kind
    for kind in vars(models).values()
    if isinstance(kind, type) and issubclass(kind, Record) and kind not in (Record, MetalRecord)
}
MODELS: dict[str, type[Structure]] = {name: model_of(kind) for name, kind in RECORDS.items()}


def spellings(enum: str) -> list[str]:
    """Every enumerant as the specification writes it, without the type's prefix, and without `VK_`
    alone; flags with and without `_BIT`.
    """
    found = []
    for name in ENUMS[enum]:
        shorts = [name]
        if "FlagBits" in enum and name not in BITLESS.get(enum, ()):
            head, _, vendor = name.rpartition("_")
            shorts.append(f"{head}_BIT_{vendor}" if head and vendor in VENDORS else f"{name}_BIT")
        prefixes = ["", PREFIXES[enum], PREFIXES[enum].removeprefix("VK_")]
        if enum.endswith("2"):
            prefixes += [f"{PREFIXES[enum]}2_"]
        found += [prefix + short for prefix in prefixes for short in shorts]
    return found


SPELLINGS = {enum: spellings(enum) for enum in VALUES}
METAL_SPELLINGS = {enum: metal_names.spellings(enum) for enum in metal_names.ENUMS}


def enumerants(enums: str) -> st.SearchStrategy[str]:
    return st.sampled_from(
        [name for enum in enums.split("|") for name in {**SPELLINGS, **METAL_SPELLINGS}[enum]]
    )


def flags(enum: str) -> st.SearchStrategy[Json]:
    names = st.lists(enumerants(enum), max_size=3)
    joined = names.filter(bool).map(" | ".join)
    return (
        names | joined | (st.sampled_from([0, "0", "0x0"]) if "FlagBits" in enum else st.nothing())
    )


def by_shape(shape: tuple[Any, ...]) -> st.SearchStrategy[Json]:
    """JSON values that a member of that shape may hold."""
    kind = shape[0]
    match kind:
        case "null":
            return st.none() | by_shape(shape[1])
        case "enum":
            return enumerants(shape[1])
        case "flags":
            return flags(shape[1])
        case "record":
            return structure(shape[1].__name__)
        case "list":
            return st.lists(by_shape(shape[1]), max_size=3 if len(shape) == 2 else shape[2])
        case "counted":
            return st.lists(by_shape(shape[1]), max_size=3) | st.dictionaries(
                NAMES, by_shape(shape[1]), max_size=3
            )
        case "map":
            return st.dictionaries(NAMES, by_shape(shape[1]), max_size=2)
        case "numbered":
            return st.dictionaries(
                st.integers(0, shape[2] if len(shape) > 2 else 2**32 - 1).map(str),
                by_shape(shape[1]),
                max_size=2,
            )
        case "slot":
            return st.none() | NAMES | st.integers(0, 2**32 - 1) | structure("AttachmentReference")
        case "subpass":
            return st.integers(0, 2**32 - 1) | st.sampled_from(["EXTERNAL", "VK_SUBPASS_EXTERNAL"])
        case "samples":
            return st.sampled_from(
                [
                    1,
                    2,
                    4,
                    8,
                    16,
                    32,
                    64,
                    "4",
                    "SAMPLE_COUNT_8",
                    "VK_SAMPLE_COUNT_16_BIT",
                    "VK_SAMPLE_COUNT_2",
                ]
            )
        case "shading":
            return st.sampled_from(
                ["none", "medium", 200, 0, "200", "200ops", "500000ns", "4.2ms", "0.5ns"]
            )
        case "bool":
            return st.booleans()
        case "int":
            return st.integers(shape[1], shape[2])
        case "number":
            low = 1e-300 if shape[1] else None
            return st.floats(low, allow_nan=False, allow_infinity=False) | st.integers(
                1 if shape[1] else None, 10**30
            )
        case "share":
            return st.floats(1e-300, 1) | st.just(1)
        case "text":
            return TEXTS
        case "name":
            return NAMES | st.integers(0, 9)
        case "word":
            return st.sampled_from(shape[1])
        case "caseless":
            return st.sampled_from(shape[1]).flatmap(
                lambda word: st.sampled_from([word, word.upper(), word.capitalize()])
            )
        case "either":
            return st.one_of(*(by_shape(arm) for arm in shape[1:]))
        case "command":
            members = shape[1].SHAPE
            words = [name for name, found in members.items() if found[0] == "null"]
            bare = st.sampled_from(words) if words else st.nothing()
            return bare | st.one_of(
                *(
                    by_shape(found).map(lambda value, name=name: {name: value})
                    for name, found in members.items()
                )
            )
    raise TypeError(kind)


def structure(name: str) -> st.SearchStrategy[dict[str, Json]]:
    """A structure by its model, each member stated or left out."""
    if name not in _structures:
        _structures[name] = st.deferred(lambda: _members(name))
    return _structures[name]


_structures: dict[str, st.SearchStrategy[dict[str, Json]]] = {}


def _members(name: str) -> st.SearchStrategy[dict[str, Json]]:
    return st.fixed_dictionaries(
        {}, optional={key: by_shape(shape) for key, shape in RECORDS[name].SHAPE.items()}
    )


def paths(value: Json, at: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """The path of every value within a value, and of itself."""
    found = [at]
    if isinstance(value, dict):
        for key, inner in value.items():
            found += paths(inner, (*at, key))
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            found += paths(inner, (*at, index))
    return found


def replaced(value: Json, path: tuple[Any, ...], by: Json) -> Json:
    """A copy of a value with what stands at a path replaced, or added to a mapping."""
    if not path:
        return by
    copy = dict(value) if isinstance(value, dict) else list(value)
    copy[path[0]] = replaced(copy[path[0]] if len(path) > 1 else None, path[1:], by)
    return copy


JUNK: st.SearchStrategy[Json] = st.sampled_from(
    [
        None,
        True,
        False,
        0,
        1,
        3,
        -1,
        2**31,
        2**32,
        10**39,
        0.5,
        1.0,
        4.0,
        "",
        "x",
        "STORE",
        "ALL",
        "1",
        "²",
        "4",
        [],
        {},
        [None],
        [[]],
        {"x": 1},
    ]
)

"""What keys of a description may hold, in words."""

from __future__ import annotations

from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.shapes import Shape


def spelled(record: Record, path: str) -> str:
    """A path from a record, with the first index of each list on the way."""
    names = path.split(".")
    kind: type[Record] = type(record)
    for number, name in enumerate(names[:-1]):
        shape = kind.SHAPE[name]
        if shape[0] == "list":
            names[number] += "[0]"
            shape = shape[1]
        shape = shape[1] if shape[0] == "null" else shape
        if shape[0] != "record":
            break
        kind = shape[1]
    return ".".join(names)


_IN_WORDS = {
    "device": "a device's name, or a mapping of what it supports",
    "commands": "the recorded commands of a whole frame",
    "dependencies": "a list of VkSubpassDependency",
    "module": "the path of a SPIR-V file",
    "memoryTypes": "a list of lists of VkMemoryPropertyFlagBits",
    "sampleCounts": "a mapping of lists of sample counts",
    "tests": "a list of the bits that are tested",
}
"""What keys hold that no Vulkan type tells."""

MAX_WORDS = 7


def values(shape: Shape, path: str) -> str:
    """What the key at the end of a path may hold, in words; `shape` is that of the path's first
    member.
    """
    return _IN_WORDS.get(path.rpartition(".")[2]) or _values(shape, path.partition(".")[2])


def _values(shape: Shape, rest: str = "") -> str:
    kind = shape[0]
    if kind == "record":
        name, _, below = rest.partition(".")
        inner = shape[1].SHAPE.get(name)
        return _values(inner, below) if inner is not None else "a mapping"
    if kind == "list" and rest:
        return _values(shape[1], rest)
    if kind == "null":
        return _values(shape[1], rest)
    if kind == "either":
        return " or ".join(dict.fromkeys(_values(each, rest) for each in shape[1:]))
    if kind in ("enum", "word", "caseless"):
        words = list(map(str, shape[1])) if kind != "enum" else _enumerants(shape[1])
        return (
            f"{', '.join(words[:-1])} or {words[-1]}"
            if 1 < len(words) <= MAX_WORDS
            else _type(shape)
        )
    return _type(shape)


def _enumerants(enums: str) -> list[str]:
    if enums.startswith("MTL"):
        from msaa_lint.frame.metal.names import ENUMS

        return list(ENUMS.get(enums, ()))
    from msaa_lint.frame.vulkan.enums import VALUES

    return [name for enum in enums.split("|") for name in VALUES[enum]]


def _type(shape: Shape) -> str:
    kind = shape[0]
    if kind == "enum":
        return f"{'an' if shape[1].startswith('MTL') else 'a'} {shape[1].split('|')[0]}"
    if kind == "flags":
        return f"a list of {shape[1]}"
    if kind == "name":
        return f"the name of an entry of `{shape[1]}`"
    words = {
        "bool": "true or false",
        "samples": "1, 2, 4, 8, 16, 32 or 64",
        "shading": "none, light, medium, heavy, or a cost such as 200ops",
        "int": "an integer",
        "number": "a number",
        "text": "a string",
        "list": "a list",
        "map": "a mapping by name",
        "numbered": "a mapping by number",
        "counted": "a list",
    }
    return words.get(kind, "one of the documented values")

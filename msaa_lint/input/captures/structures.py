"""Vulkan's structures, as calls pass them, in the words of a description: every member by the shape that descriptions are read by."""

from __future__ import annotations

from typing import Any

from msaa_lint.frame.description.bind import DECISIVE, OTHER_NAMES, PNEXT, WITHIN
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.scalars import ATTACHMENT_UNUSED
from msaa_lint.frame.description.shapes import Shape

from . import values

Tree = dict[str, Any]
"""A structure of a description as plain data: mappings, lists, texts, numbers, booleans and None."""

MAX_ITEMS = 4096
"""So many elements of an array are taken; Vulkan's own arrays in structures of interest have some tens."""

MAX_DEPTH = 8


def described(kind: type[Record], structure: object, depth: int = 0) -> Tree:
    """A structure as a description states it, its pNext chain included. Members that are unknown, or none, are left out."""
    made: Tree = {}
    given = values.record(structure)
    for member, shape in kind.SHAPE.items():
        stated = _stated(given, member)
        if stated is not None:
            value = _value(shape, stated, depth)
            if value is not None and not (value in ([], ()) and getattr(kind, member) is not None):
                made[member] = value
    following = given.get("pNext")
    for _ in range(64):
        if not isinstance(following, dict) or depth > MAX_DEPTH:
            break
        _chained(kind, made, following, depth)
        following = following.get("pNext")
    return made


def _stated(given: dict[str, Any], member: str) -> object:
    """A member by its name in a description or in C."""
    if member in given:
        return given[member]
    pointer = "p" + member[0].upper() + member[1:]
    if pointer in given:
        return given[pointer]
    for other, name in OTHER_NAMES.items():
        if name == member and other in given:
            return given[other]
    return None


def _chained(kind: type[Record], made: Tree, structure: dict[str, Any], depth: int) -> None:
    name = values.structure_type(structure)
    member = PNEXT.get(name)
    if WITHIN.get(name) is kind:
        made.update(described(kind, {key: value for key, value in structure.items() if key != "pNext"}, depth + 1))
    elif member is not None and member in kind.SHAPE and kind.SHAPE[member][0] == "record":
        made[member] = described(kind.SHAPE[member][1], {**structure, "pNext": None}, depth + 1)


def _value(shape: Shape, stated: object, depth: int) -> Any:
    """A value by its shape; None where it is unknown."""
    kind = shape[0]
    if kind == "enum":
        name = values.enum(shape[1], stated)
        # A format that is none.
        return None if name == "UNDEFINED" and shape[1] == "VkFormat" else name
    if kind == "flags":
        return _flags(shape[1], stated)
    if kind == "record":
        return described(shape[1], stated, depth + 1) if isinstance(stated, dict) and depth < MAX_DEPTH else None
    if kind in ("list", "counted"):
        return _items(shape[1], stated, depth)
    if kind == "slot":
        return slot(stated)
    if kind == "bool":
        return values.boolean(stated)
    if kind == "samples":
        return values.samples(stated)
    if kind == "int":
        found = values.integer(stated)
        within = found is not None and (shape[1] is None or found >= shape[1]) and (shape[2] is None or found <= shape[2])
        return found if within else None
    if kind == "number":
        return values.number(stated)
    if kind == "subpass":
        found = values.integer(stated)
        return "EXTERNAL" if found == ATTACHMENT_UNUSED else found
    if kind == "null":
        return _value(shape[1], stated, depth)
    return values.text(stated) if kind == "text" else None


def _items(shape: Shape, stated: object, depth: int) -> list[Any] | None:
    if not isinstance(stated, list):
        return None
    made = [_value(shape, item, depth) for item in stated[:MAX_ITEMS]]
    # An attachment that is unused stands as null; of other lists what is unknown may not shift what comes after it.
    nullable = shape[0] in ("slot", "null")
    return made if nullable or None not in made else None


def _flags(enums: str, stated: object) -> list[str] | None:
    if isinstance(stated, list):
        # Dynamic states are an array of enumerants.
        names = [values.enum(enums, item) for item in stated[:MAX_ITEMS]]
        return list(dict.fromkeys(name for name in names if name is not None))
    found = values.flags(enums, stated)
    if found is None:
        return None
    names_known, whole = found
    return names_known if whole or enums not in DECISIVE else None


def slot(stated: object) -> Any:
    """An attachment reference: its index with the layout where that is known; None for VK_ATTACHMENT_UNUSED."""
    given = stated if isinstance(stated, dict) else {"attachment": stated}
    index = values.integer(given.get("attachment"))
    if index is None or index == ATTACHMENT_UNUSED or index < 0:
        return None
    layout = values.enum("VkImageLayout", given.get("layout")) if "layout" in given else None
    return {"attachment": index, "layout": layout} if layout is not None else index

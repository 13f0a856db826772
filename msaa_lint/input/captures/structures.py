"""Converts Vulkan structures from calls to the form of a description, each member by its shape in
the description format.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from msaa_lint.frame.description.dumps import DECISIVE, OTHER_NAMES, PNEXT, WITHIN, is_unread
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.scalars import ATTACHMENT_UNUSED
from msaa_lint.frame.description.shapes import Shape

from . import values

Tree = dict[str, Any]
"""A structure of a description as plain data: mappings, lists, strings, numbers, booleans and
None.
"""

Members = list[tuple[str, Shape, tuple[str, ...]]]
"""Members by their description names, each with its shape and the names that it may have in a
call.
"""

MAX_ITEMS = 4096
"""Maximum number of array elements; real arrays in these structures have a few dozen."""

MAX_DEPTH = 8


def to_tree(kind: type[Record], structure: object, depth: int = 0) -> Tree:
    """A structure in the form of a description, including its pNext chain. Unknown and empty
    members are omitted.
    """
    tree: Tree = {}
    members = values.record(structure)
    for member, shape, names in _members(kind):
        for name in names:
            if name in members:
                given_value = members[name]
                value = _value(shape, given_value, depth) if given_value is not None else None
                if value is not None and not (
                    value in ([], ()) and getattr(kind, member) is not None
                ):
                    tree[member] = value
                break
    if members.get("pNext") and depth <= MAX_DEPTH:
        for chained in values.chain(members.get("pNext")):
            _add_chained(kind, tree, chained, depth)
    return tree


_MEMBERS: dict[type[Record], Members] = {}


def _members(kind: type[Record]) -> Members:
    """The members of a structure."""
    known = _MEMBERS.get(kind)
    if known is not None:
        return known
    others = {
        member: [other for other, name in OTHER_NAMES.items() if name == member]
        for member in kind.SHAPE
    }
    _MEMBERS[kind] = [
        (member, shape, (member, f"p{member[0].upper()}{member[1:]}", *others[member]))
        for member, shape in kind.SHAPE.items()
        if member != "pNext"
    ]
    return _MEMBERS[kind]


def _add_chained(kind: type[Record], tree: Tree, structure: dict[str, Any], depth: int) -> None:
    name = values.structure_type(structure)
    member = PNEXT.get(name)
    if WITHIN.get(name) is kind:
        tree.update(
            to_tree(
                kind, {key: value for key, value in structure.items() if key != "pNext"}, depth + 1
            )
        )
    elif member is not None and member in kind.SHAPE and kind.SHAPE[member][0] == "record":
        tree[member] = to_tree(kind.SHAPE[member][1], {**structure, "pNext": None}, depth + 1)
    elif is_unread(name, kind):
        tree["pNext"] = [*tree.get("pNext", ()), name or "UNKNOWN"]


def _value(shape: Shape, value: object, depth: int) -> Any:
    """A value by its shape; None if it is unknown."""
    kind = shape[0]
    if kind == "enum":
        name = values.enum(shape[1], value)
        # VK_FORMAT_UNDEFINED means that there is no format.
        return None if name == "UNDEFINED" and shape[1] == "VkFormat" else name
    if kind == "flags":
        return _flags(shape[1], value)
    if kind == "record":
        return (
            to_tree(shape[1], value, depth + 1)
            if isinstance(value, dict) and depth < MAX_DEPTH
            else None
        )
    if kind in ("list", "counted"):
        return _items(shape[1], value, depth)
    if kind in PARSERS:
        return PARSERS[kind](value)
    if kind == "int":
        number = values.integer(value)
        in_range = (
            number is not None
            and (shape[1] is None or number >= shape[1])
            and (shape[2] is None or number <= shape[2])
        )
        return number if in_range else None
    if kind == "subpass":
        number = values.integer(value)
        return "EXTERNAL" if number == ATTACHMENT_UNUSED else number
    if kind == "null":
        return _value(shape[1], value, depth)
    return None


def _items(shape: Shape, value: object, depth: int) -> list[Any] | None:
    if not isinstance(value, list):
        return None
    items = [_value(shape, item, depth) for item in value[:MAX_ITEMS]]
    # An unused attachment is null. In other lists, leaving out an unknown item would shift those
    # after it.
    nullable = shape[0] in ("slot", "null")
    return items if nullable or None not in items else None


def _flags(enums: str, value: object) -> list[str] | None:
    if isinstance(value, list):
        # Dynamic states are an array of enumerants.
        names = [values.enum(enums, item) for item in value[:MAX_ITEMS]]
        return list(dict.fromkeys(name for name in names if name is not None))
    parsed = values.flags(enums, value)
    if parsed is None:
        return None
    known_names, complete = parsed
    return known_names if complete or enums not in DECISIVE else None


def slot(value: object) -> Any:
    """An attachment reference: its index, with the layout if it is known; None for
    VK_ATTACHMENT_UNUSED.
    """
    reference = value if isinstance(value, dict) else {"attachment": value}
    index = values.integer(reference.get("attachment"))
    if index is None or index == ATTACHMENT_UNUSED or index < 0:
        return None
    layout = (
        values.enum("VkImageLayout", reference.get("layout")) if "layout" in reference else None
    )
    return {"attachment": index, "layout": layout} if layout is not None else index


PARSERS: dict[str, Callable[[object], Any]] = {
    "slot": slot,
    "bool": values.boolean,
    "samples": values.samples,
    "number": values.number,
    "text": values.text,
}
"""By kind of shape, for those without parameters."""


def containers(value: Any) -> int:
    """The number of mappings and lists in plain data."""
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return 1 + sum(containers(item) for item in inner if isinstance(item, (dict, list)))

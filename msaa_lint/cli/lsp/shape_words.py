"""Keys and values of a description in words: what documentation there is of them, and what they may
hold.
"""

from __future__ import annotations

from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.reference.lookup import enumerant_text, key_text
from msaa_lint.frame.description.scalars import SHADING_LEVELS, enumerant
from msaa_lint.frame.description.shapes import Shape
from msaa_lint.frame.devices import builtin
from msaa_lint.frame.vulkan.enums import PREFIXES
from msaa_lint.frame.vulkan.formats import format_of

from .places import Place

_SIMPLE = {
    "text": "text",
    "bool": "`true` or `false`",
    "share": "a fraction above 0 and up to 1",
    "samples": "a sample count: 1, 2, 4, 8, 16, 32 or 64",
    "shading": f"{', '.join(SHADING_LEVELS)}, or a cost such as `200ops`, `500000ns` or `4.2ms`",
    "slot": "an attachment of the render pass: its name, its index, `{attachment, layout}`, or "
    "`null` for VK_ATTACHMENT_UNUSED",
    "subpass": "the index of a subpass, or `EXTERNAL`",
    "record": "a mapping",
    "command": "a command",
}


def shape_words(shape: Shape) -> str:
    """What a member may hold."""
    kind = shape[0]
    if kind in _SIMPLE:
        return _SIMPLE[kind]
    if kind == "int":
        return f"an integer from {shape[1]} to {shape[2]}"
    if kind == "number":
        return "a number above 0" if shape[1] else "a number"
    if kind == "enum":
        return " or ".join(f"`{enum}`" for enum in shape[1].split("|"))
    if kind == "flags":
        return f"a list of `{shape[1]}`, or names joined by `|`"
    if kind in ("word", "caseless"):
        return "one of " + ", ".join(f"`{word}`" for word in shape[1])
    if kind == "name":
        return f"the name of an entry of `{shape[1]}`"
    if kind == "list":
        return f"a list, each item {shape_words(shape[1])}"
    if kind in ("map", "numbered"):
        return (
            f"a mapping by {'name' if kind == 'map' else 'number'}, each value "
            f"{shape_words(shape[1])}"
        )
    if kind == "counted":
        return f"a mapping by name in index order, or a list, each entry {shape_words(shape[1])}"
    if kind == "null":
        return f"{shape_words(shape[1])}, or `null`"
    return " or ".join(map(shape_words, shape[1:]))


def key_documentation(kind: type[Record], member: str) -> str:
    """What a member means, in Markdown."""
    text = key_text(kind, member)
    return f"**{text.title}** `{member}`\n\n{text.markdown}"


def value_documentation(place: Place) -> str:
    """What an enumerant or a built-in device is."""
    kind = place.shape[0]
    if place.path == ("device",) and kind == "text":
        return device_documentation(place.node.text)
    if kind not in ("enum", "flags") or place.node.value is None:
        return ""
    for enum in place.shape[1].split("|"):
        name = enumerant(enum, place.node.text)
        if name is not None:
            full = f"{PREFIXES[enum]}{name}" if enum in PREFIXES else f"{enum}.{name}"
            format = format_of(name) if enum == "VkFormat" else None
            size = (
                f", {format.bytes} bytes a {'texel' if format.block == (1, 1, 1) else 'block'}"
                if format is not None
                else ""
            )
            return "\n\n".join(
                filter(None, (f"`{full}`{size}", enumerant_documentation(enum, name)))
            )
    return ""


def enumerant_documentation(enums: str, name: str) -> str:
    """What a value of one of some enums, which `|` joins, means; empty if there is no text for
    it.
    """
    return next(
        (text for enum in enums.split("|") if enum and (text := enumerant_text(enum, name))), ""
    )


def device_documentation(name: str) -> str:
    """What a built-in device supports; empty if there is none of that name."""
    profile = builtin(name)
    if profile is None:
        return ""
    counts = ", ".join(map(str, profile.color_samples or ()))
    kind = {True: "tile-based", False: "immediate-mode", None: ""}[profile.tiler]
    facts = [
        kind,
        f"color sample counts {counts}" if counts else "",
        f"Vulkan {profile.api_version}" if profile.api_version else "",
    ]
    return f"**{profile.name}**: " + "; ".join(filter(None, facts))

"""What to write instead of a wrong key or value: the end of a message."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence

from msaa_lint.core.quote import quoted, shortened
from msaa_lint.core.suggestions import letters_and_digits, nearest
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.plain_lines import entry
from msaa_lint.frame.vulkan.names import from_value

from .problems import list_hint
from .record import Record
from .scalars import SAMPLE_COUNTS, enumerant, nearest_enumerant, shading_cost
from .shapes import Shape

MAX_LISTED = 20
"""Names that a message lists."""

MAX_WORDS = 16
"""Words of a value that are looked up one by one."""

_SAME = tuple(
    frozenset(group.split())
    for group in (
        "SAMPLES SAMPLECOUNT RASTERIZATIONSAMPLES RASTERSAMPLECOUNT MSAA MSAASAMPLES NUMSAMPLES "
        "MULTISAMPLECOUNT",
        "LOADOP LOADACTION",
        "STOREOP STOREACTION",
        "FPS FRAMERATE REFRESHRATE HZ",
        "WIDTH W",
        "HEIGHT H",
        "EXTENT SIZE RESOLUTION DIMENSIONS",
        "FORMAT PIXELFORMAT COLORFORMAT",
        "IMAGE TEXTURE IMAGEVIEW",
        "IMAGES TEXTURES RENDERTARGETS",
        "RENDERPASSES PASSES",
        "RENDERPASS PASS",
        "PIPELINES RENDERPIPELINES GRAPHICSPIPELINES",
        "RESOLVEIMAGE RESOLVETEXTURE RESOLVETARGET",
        "SRCIMAGE SOURCE SRC FROM",
        "DSTIMAGE DESTINATION DST TO",
        "DRAW DRAWINDEXED DRAWINDIRECT DRAWINDEXEDINDIRECT",
        "PRESENT PRESENTDRAWABLE QUEUEPRESENT QUEUEPRESENTKHR",
        "READIMAGE READTEXTURE SAMPLEIMAGE",
        "PRESENTABLE DRAWABLE SWAPCHAIN",
        "MEMORY STORAGEMODE MEMORYPROPERTIES MEMORYUSAGE",
        "COLOR FRAMEBUFFERCOLORSAMPLECOUNTS",
        "DEPTH FRAMEBUFFERDEPTHSAMPLECOUNTS",
        "STENCIL FRAMEBUFFERSTENCILSAMPLECOUNTS",
        "INTEGER FRAMEBUFFERINTEGERCOLORSAMPLECOUNTS",
        "DONTCARE DISCARD INVALIDATE",
        "KDONTCARE DISCARD INVALIDATE",
        "AVERAGE AVG MEAN",
        "FRAGMENT PIXEL",
        "GAMMA SRGB",
        "SAMPLEZERO FIRST NEAREST",
        "DEVICELOCAL GPUONLY PRIVATE VMAMEMORYUSAGEGPUONLY",
        "LAZILYALLOCATED LAZY MEMORYLESS TRANSIENT VMAMEMORYUSAGEGPULAZILYALLOCATED",
        "MEMORYLESS LAZY TRANSIENT",
        "KDEVICETRANSIENT MEMORYLESS LAZY",
    )
)
"""Names of other APIs and libraries, or of plain language, for the same thing, as
`letters_and_digits` leaves them.
"""

_TRUE = ("true", "yes", "on", "y", "1", "vk_true")
_FALSE = ("false", "no", "off", "n", "0", "vk_false")

_NUMBER = r"(0x[0-9A-Fa-f]{1,16}|-?[0-9][0-9_,']{0,20}(?:\.[0-9]{1,20})?) ?(%|[A-Za-z]{0,8})"
_SIZE = r"([1-9][0-9]{0,8}) ?[xX×*,/ ] ?([1-9][0-9]{0,8})"


def meant(
    name: str, candidates: Iterable[str], near: Callable[[str, Iterable[str]], str | None] = nearest
) -> str | None:
    """The candidate that a name means, in other words or misspelled; None if none is near."""
    known = list(candidates)
    plain = letters_and_digits(name) if len(name) <= 64 else ""
    groups = [group for group in _SAME if plain in group]
    by_letters = (
        {letters_and_digits(candidate): candidate for candidate in reversed(known)}
        if groups
        else {}
    )
    if plain not in by_letters:
        for group in groups:
            same = next(
                (candidate for letters, candidate in by_letters.items() if letters in group), None
            )
            if same is not None:
                return same
    return near(name, known)


def question_or_names(candidate: str | None, names: Sequence[str], separator: str) -> str:
    """The end of a message: the name that was most likely meant, or else all names, or as many as a
    line takes.
    """
    if candidate is not None:
        return f"{separator}did you mean `{candidate}`?"
    more = ", …" if len(names) > MAX_LISTED else ""
    return f"{separator}expected one of {', '.join(names[:MAX_LISTED])}{more}" if names else ""


def hidden_character(name: str) -> str | None:
    """The first character of a name that cannot be seen, but for ordinary spaces; None if all
    can.
    """
    return next(
        (char for char in name if char != " " and (char.isspace() or not char.isprintable())), None
    )


def key_hint(kind: type[Record], name: str, value: Node) -> str:
    """What to write for a key that a structure does not have."""
    stated = entry(name)
    if stated is not None and stated.partition(":")[0] in kind.SHAPE:
        return f"; write `{stated}`" + (", with a space after the `:`" if ":" in name else "")
    first, _, rest = name.partition(" ")
    if first in kind.SHAPE and rest:
        return f"; write {quoted(f'{first}: {rest}')}"
    hidden = hidden_character(name)
    if hidden is not None:
        return (
            f": it contains the invisible character U+{ord(hidden):04X}; write ordinary spaces, "
            "or delete it"
        )
    if value.kind == "mapping" and value.value and all(key in kind.SHAPE for key in value.value):
        return f": write its keys {', '.join(value.value)} directly"
    for member, shape in kind.SHAPE.items():
        if shape[0] == "record" and name in shape[1].SHAPE:
            return f": it is a key of `{member}`; write `{member}: {{{name}: ...}}`"
    return question_or_names(meant(name, kind.SHAPE), list(kind.SHAPE), ": ")


def joined_flags(enum: str, text: str) -> str:
    """`A, B` for flags that are joined by anything but `|`, in quotes or lacking a bracket; empty
    if not all words are flags.
    """
    words = re.split(r"[\s,;+&/|]+", text[:512].strip("[]{}\"'“”‘’` "))[: MAX_WORDS + 1]
    return (
        ", ".join(words)
        if 1 < len(words) <= MAX_WORDS and all(word and enumerant(enum, word) for word in words)
        else ""
    )


def enumerant_hint(enums: str, text: str) -> str:
    """What to write for a word that is not an enumerant."""
    joined = joined_flags(enums, text)
    if joined:
        return f"; write `{joined}`"
    if text.isascii() and text.isdigit() and len(text) < 20:
        named = (
            from_value(enums.partition("|")[0], int(text)) if not enums.startswith("MTL") else None
        )
        if named is not None:
            return f"; did you mean `{named}`?"
    if enums == "VkFormat" and enumerant(enums, f"{text}_UNORM"):
        return f"; did you mean `{text}_UNORM`?"
    names = _names(enums)
    close = meant(text, names, lambda word, _: nearest_enumerant(enums, word))
    return question_or_names(close, names if len(names) <= MAX_LISTED else [], "; ")


def _names(enums: str) -> list[str]:
    if enums.startswith("MTL"):
        from msaa_lint.frame.metal.names import ENUMS as METAL

        return list(METAL[enums])
    from msaa_lint.frame.vulkan.enums import ENUMS

    return [name for enum in enums.split("|") for name in dict.fromkeys(ENUMS[enum].values())]


def samples_hint(node: Node) -> str:
    """The count in `4x`, `MSAA4`, `4.0` or `[4]`."""
    if node.kind == "sequence":
        return single_hint(node)
    text = (
        str(int(node.value))
        if isinstance(node.value, float) and node.value.is_integer()
        else node.text[:64]
    )
    numbers = re.findall(r"[0-9]+", text)
    is_count = (
        len(numbers) == 1 and numbers[0] in map(str, SAMPLE_COUNTS) and not text.startswith("-")
    )
    return f"; write `{numbers[0]}`" if is_count else ""


def shading_hint(node: Node) -> str:
    """The cost in `200 operations`, `4.2 MS` or `[200]`."""
    if node.kind != "scalar":
        return single_hint(node)
    match = re.match(r"([0-9.]{1,20})\s*([onm])", node.text.lower())
    cost = shading_cost(match[1] + {"o": "ops", "n": "ns", "m": "ms"}[match[2]]) if match else None
    return f"; write `{cost}`" if cost else ""


def single_hint(node: Node) -> str:
    """How to write the only item of a list as a value."""
    if node.kind != "sequence":
        return ""
    items = node.value
    is_single = len(items) == 1 and items[0].kind == "scalar"
    return (
        f"; write `{shortened(items[0].text, 40)}`, without brackets"
        if is_single
        else "; write one value, without brackets"
    )


def number_hint(node: Node, low: float, high: float) -> str:
    """The number in `1920px`, `"1920"`, `1_920` or `25%`, if it is in a range."""
    if node.kind == "sequence":
        return single_hint(node)
    match = re.fullmatch(_NUMBER, node.text) if isinstance(node.value, str) else None
    if match is None:
        return ""
    digits = match[1] if match[1].startswith("0x") else re.sub("[_,']", "", match[1])
    value = int(digits, 16) if digits.startswith("0x") else float(digits)
    if match[2] == "%":
        value, digits = value / 100, f"{value / 100:g}"
    if not low <= value <= high:
        return ""
    return f"; write {digits}{'' if node.plain else ' without quotes'}"


def boolean_hint(node: Node) -> str:
    """What to write instead of a word that means true or false."""
    if node.kind != "scalar":
        return single_hint(node)
    word = node.text[:16].lower()
    value = "true" if word in _TRUE else "false" if word in _FALSE else None
    return (
        f"; write `{value}`{'' if node.plain or value != word else ' without quotes'}"
        if value is not None
        else ""
    )


def mapping_hint(shape: Shape, node: Node) -> str:
    """How to write what was meant by a value that is not a mapping."""
    if shape[0] not in ("record", "command"):
        return (
            "; write `name: {...}` for each entry, without `- `"
            if node.kind == "sequence"
            else null_hint(node)
        )
    kind: type[Record] = shape[1]
    if not kind.SHAPE:
        return "; write the command alone"
    stated = entry(node.text) if node.kind == "scalar" else None
    if stated is not None and stated.partition(":")[0] in kind.SHAPE:
        return f"; write `{stated}`, with a space after the `:`"
    if "width" in kind.SHAPE and "height" in kind.SHAPE:
        text = (
            node.text
            if node.kind == "scalar"
            else ",".join(item.text for item in node.value[:3])
            if node.kind == "sequence"
            else ""
        )
        size = re.match(_SIZE, text[:64])
        if size is not None:
            return f"; write `{{width: {size[1]}, height: {size[2]}}}`"
    if len(kind.SHAPE) == 1 and node.kind == "scalar" and node.value is not None:
        return f"; write `{{{next(iter(kind.SHAPE))}: {shortened(node.text, 40)}}}`"
    if node.kind == "scalar" and node.value is None:
        return null_hint(node)
    names = list(kind.SHAPE)
    return f"; its keys are {', '.join(names[:MAX_LISTED])}"


def lacks_colon(key: Node) -> bool:
    """Whether a key was read that begins with a key, no `:`, and the bracket of its value: `color
    {samples`.
    """
    return key.plain and re.match(r"[\w.-]+ +[\[{]", key.text[:200]) is not None


def null_hint(node: Node) -> str:
    """What to do about a key without a value."""
    return "; leave it out if it is unknown" if node.kind == "scalar" and node.value is None else ""


def items_hint(node: Node) -> str:
    """How to write a value as a list."""
    return (
        "; begin each item with `- `, or write `[{...}]`"
        if node.kind == "mapping"
        else list_hint(node) or null_hint(node)
    )


def has_no_value(node: Node) -> bool:
    """Whether nothing is written as a value, or null."""
    return node.kind == "scalar" and node.value is None


def key_below(shape: Shape, kind: type[Record], node: Node, name: str) -> Node | None:
    """The key after one without a value, if it was meant to be in that value and lacks its
    indentation; None if there is none.
    """
    names = iter(node.value)
    below = next((next(names, None) for key in names if key == name), None)
    if below is None or below in kind.SHAPE:
        return None
    if hidden_character(below[:1]):
        return node.keys[below]
    is_member = (
        below in shape[1].SHAPE
        if shape[0] == "record"
        else shape[0] in ("map", "counted") and node.value[below].kind == "mapping"
    )
    return node.keys[below] if is_member else None


def commands_hint(node: Node, kind: type[Record]) -> str:
    """How to write a command that was written as a mapping with several keys, or with none."""
    names = list(node.value) if node.kind == "mapping" else []
    shape = kind.SHAPE.get(names[0]) if len(names) > 1 else None
    if shape is None:
        return ""
    if has_no_value(node.value[names[0]]) and shape[0] == "record" and names[1] in shape[1].SHAPE:
        return f"; indent `{names[1]}` deeper than `{names[0]}`"
    return f"; write `- ` before {quoted(names[1])}"

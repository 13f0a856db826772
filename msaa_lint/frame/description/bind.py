"""Tree to records: every member by its shape, every mistake with its place and the nearest right word.

Two spellings are read. The description format is strict: an unknown key is an error. The structures that tools dump (`dumped`) keep C's
names (`pAttachments`, `attachmentCount`, `pNext`), write "NULL", "VK_TRUE" and numbers as strings, and have members we do not ask for.
"""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from msaa_lint.core.suggestions import nearest
from msaa_lint.core.text.span import Label, Span
from msaa_lint.core.text.tree import Node
from msaa_lint.frame.vulkan.names import from_value

from .models import AttachmentDescription, AttachmentReference, Command, SubpassDependency
from .record import Record
from .scalars import ATTACHMENT_UNUSED, EXTERNAL, UNUSED, caseless, enumerant, finite, flags, nearest_enumerant, sample_count
from .shapes import Shape

MAX_PROBLEMS = 50
"""Problems of one document that are told; the rest would only bury them."""


class Problem(NamedTuple):
    """A mistake in the description itself, a 9xx finding to be."""

    code: str
    message: str
    span: Span
    path: str
    labels: tuple[Label, ...] = ()
    help: str = ""


class Mention(NamedTuple):
    """A name that must stand in a section: checked once the whole description is read."""

    section: str
    name: str
    node: Node
    path: str


PNEXT = {
    "SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE": "depthStencilResolve",
    "MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_INFO": "multisampledRenderToSingleSampled",
    "PIPELINE_RENDERING_CREATE_INFO": "rendering",
}
"""Structures of a pNext chain, by sType without its prefix and vendor suffix, and the member they are in a description."""

WITHIN: dict[str, type[Record]] = {
    "ATTACHMENT_DESCRIPTION_STENCIL_LAYOUT": AttachmentDescription,
    "MEMORY_BARRIER_2": SubpassDependency,
}
"""Structures of a pNext chain whose members are, in a description, the structure's own; they stand in for what it states itself."""

DECISIVE = ("VkAccessFlagBits2", "VkPipelineStageFlagBits2", "VkColorComponentFlagBits", "VkImageUsageFlagBits", "VkMemoryPropertyFlagBits")
"""Flags of which an unknown one, in a dump by a newer tool, may be any that a rule asks for; of others it is none."""

OTHER_NAMES = {"pDepthStencilResolveAttachment": "attachment"}
_NULLS = ("NULL", "VK_NULL_HANDLE")
_HEXADECIMAL = re.compile(r"0[xX][0-9a-fA-F]{1,16}")


class Binder:
    """Reads the records of one document. `problems` and `mentions` fill as it goes."""

    def __init__(self, dumped: bool = False) -> None:
        self.dumped = dumped
        self.problems: list[Problem] = []
        self.mentions: list[Mention] = []

    def report(self, code: str, message: str, span: Span, path: str, help: str = "") -> None:
        """Notes a problem."""
        if len(self.problems) < MAX_PROBLEMS:
            self.problems.append(Problem(code, message, span, path, (), help))

    def record(self, kind: type[Record], node: Node, path: str, key: str, head: Span | None = None) -> Any:
        """The record of that kind that a mapping holds."""
        made = kind(node, path, key, head if head is not None else head_of(node))
        if node.kind != "mapping":
            self.wrong(node, path, "a mapping")
            return made
        self.members(made, node, path)
        if self.dumped and "pNext" in node.value:
            self.chain(made, node.value["pNext"])
        return made

    def members(self, made: Record, node: Node, path: str) -> None:
        """Gives a record the members that a mapping states."""
        kind = type(made)
        for key_text, value in node.value.items():
            name = self.dumped_name(kind, key_text) if self.dumped else key_text
            if name is None:
                continue
            found = kind.SHAPE.get(name)
            key = node.keys[key_text]
            if found is None:
                self.unknown_key(kind, key, path)
            elif not (self.dumped and is_null(value)):
                made.spelled[name] = (key, value)
                setattr(made, name, self.value(found, value, f"{path}.{key_text}" if path else key_text, key_text, key.span))

    def chain(self, record: Record, node: Node) -> None:
        """Members of a record that a pNext chain holds."""
        path = f"{record.path}.pNext"
        while node.kind == "mapping":
            kind = node.value.get("sType")
            stype = kind.text.removeprefix("VK_STRUCTURE_TYPE_").removesuffix("_KHR").removesuffix("_EXT") if kind is not None else ""
            name = PNEXT.get(stype)
            if WITHIN.get(stype) is type(record):
                self.members(record, node, path)
            elif name is not None and name in record.SHAPE:
                key = node.keys["sType"]
                record.spelled[name] = (key, node)
                setattr(record, name, self.value(record.SHAPE[name], node, path, name, key.span))
            following = node.value.get("pNext")
            if following is None:
                break
            path += ".pNext"
            node = following

    @staticmethod
    def dumped_name(kind: type[Record], key: str) -> str | None:
        """The member that a C name states; None for counts, sType and what no rule asks for."""
        name = OTHER_NAMES.get(key)
        if name is None:
            name = key[1].lower() + key[2:] if len(key) > 1 and key[0] == "p" and key[1].isupper() else key
        return name if name in kind.SHAPE else None

    def unknown_key(self, kind: type[Record], key: Node, path: str) -> None:
        close = nearest(key.text, kind.SHAPE)
        where = path or "a description"
        help = f"did you mean `{close}`?" if close else f"it may hold {', '.join(sorted(kind.SHAPE))}"
        self.report(
            "MSAA902", f"unknown key `{shortened(key.text)}` in {where}", key.span, f"{path}.{shortened(key.text)}".lstrip("."), help
        )

    def wrong(self, node: Node, path: str, wanted: str, help: str = "") -> None:
        """Notes a value of the wrong type, or that no member of its type has."""
        seen = {"mapping": "a mapping", "sequence": "a list"}.get(node.kind) or _shown(node)
        self.report("MSAA903", f"{wanted} is due here, not {seen}", head_of(node), path, help)

    def value(self, shape: Shape, node: Node, path: str, key: str, head: Span | None = None) -> Any:
        """What a node holds by a shape; None (unknown) where it is wrong, which is noted."""
        kind = shape[0]
        if kind == "enum":
            return self.enumerant(shape[1], node, path)
        if kind == "flags":
            return self.flags(shape[1], node, path)
        if kind == "record":
            return self.record(shape[1], node, path, key, head)
        if kind == "list":
            return self.items(shape[1], node, path, shape[2] if len(shape) > 2 else None)
        if kind == "slot":
            return self.slot(node, path, key, head)
        if kind == "bool":
            return self.boolean(node, path)
        if kind == "samples":
            count = sample_count(node.text if self.dumped else node.value)
            if count is None:
                self.wrong(node, path, "a sample count (1, 2, 4, 8, 16, 32, 64)")
            return count
        if kind == "int":
            return self.integer(shape[1], shape[2], node, path)
        if kind == "number":
            return self.number(shape[1], node, path)
        if kind == "text":
            if node.kind != "scalar" or not (isinstance(node.value, str) or self.dumped):
                self.wrong(node, path, "a text", _quote_hint(node))
                return None
            return node.text
        if kind == "name":
            return self.name(shape[1], node, path)
        if kind == "word":
            return self.word(shape[1], node, path)
        if kind in ("map", "numbered"):
            return self.mapping(shape[1], node, path, kind == "numbered", shape[2] if len(shape) > 2 else None)
        if kind == "subpass":
            return self.subpass(node, path)
        if kind == "counted":
            if node.kind == "sequence":
                return self.items(shape[1], node, path)
            return tuple(v for v in self.mapping(shape[1], node, path).values())
        if kind == "null":
            return None if node.kind == "scalar" and node.value is None else self.value(shape[1], node, path, key, head)
        if kind == "either":
            return self.either(shape[1:], node, path, key, head)
        if kind == "caseless":
            return caseless(shape[1], node.value) or self.word(shape[1], node, path)
        return self.command(node, path, key, shape[1])

    def items(self, shape: Shape, node: Node, path: str, most: int | None = None) -> tuple[Any, ...]:
        if node.kind != "sequence":
            self.wrong(node, path, "a list")
            return ()
        if most is not None and len(node.value) > most:
            self.report("MSAA903", f"there are at most {most} here", head_of(node.value[most]), f"{path}[{most}]")
        return tuple(self.value(shape, item, f"{path}[{n}]", str(n)) for n, item in enumerate(node.value))

    def mapping(self, shape: Shape, node: Node, path: str, numbered: bool = False, last: int | None = None) -> dict[str, Any]:
        if node.kind != "mapping":
            self.wrong(node, path, "a mapping of numbers" if numbered else "a mapping of names")
            return {}
        for key in node.keys.values() if numbered else ():
            if not _is_number(key.text):
                self.wrong(key, path, "a number as key")
            elif last is not None and (int(key.text) > last or len(key.text) > len(str(last))):
                self.wrong(key, path, f"a number from 0 to {last} as key")
        return {
            name: self.value(shape, value, f"{path}.{shortened(name)}", name, node.keys[name].span) for name, value in node.value.items()
        }

    def either(self, shapes: tuple[Shape, ...], node: Node, path: str, key: str, head: Span | None) -> Any:
        for shape in shapes:
            if _fits(shape, node):
                return self.value(shape, node, path, key, head)
        self.wrong(node, path, " or ".join(_wanted(shape) for shape in shapes))
        return None

    def enumerant(self, enum: str, node: Node, path: str) -> str | None:
        text = node.text if node.kind == "scalar" else None
        name = enumerant(enum, text) if text else None
        if name is None and self.dumped and text is not None and _is_number(text):
            name = from_value(enum.partition("|")[0], int(text))
        if name is None:
            if text is None or node.value is None:
                self.wrong(node, path, f"one of {enum}")
            elif not self.dumped:
                self.no_enumerant(enum, text, node, path)
        return name

    def no_enumerant(self, enum: str, text: str, node: Node, path: str) -> None:
        close = nearest_enumerant(enum, text)
        help = f"did you mean `{close}`?" if close else ""
        self.report("MSAA903", f"`{shortened(text)}` is no {enum.replace('|', ' or ')}", node.span, path, help)

    def flags(self, enum: str, node: Node, path: str) -> tuple[str, ...] | None:
        if node.kind == "sequence":
            bits = [self.enumerant(enum, item, f"{path}[{n}]") for n, item in enumerate(node.value)]
            whole = None not in bits or (self.dumped and enum not in DECISIVE)
            return tuple(dict.fromkeys(bit for bit in bits if bit is not None and bit != "NONE")) if whole else None
        plain = isinstance(node.value, str) or (isinstance(node.value, int) and (self.dumped or node.text == "0"))
        if node.kind != "scalar" or not plain:
            self.wrong(node, path, f"a list of {enum}")
            return None
        try:
            return tuple(flags(enum, node.text))
        except ValueError as error:
            if not self.dumped:
                self.no_enumerant(enum, str(error), node, path)
                return None
        if enum in DECISIVE:
            return None
        bits = [enumerant(enum, part.strip()) for part in node.text.split("|")]
        return tuple(dict.fromkeys(bit for bit in bits if bit is not None and bit != "NONE"))

    def boolean(self, node: Node, path: str) -> bool | None:
        if isinstance(node.value, bool):
            return node.value
        if self.dumped and node.kind == "scalar" and node.text in ("VK_TRUE", "VK_FALSE", "1", "0", "true", "false"):
            return node.text in ("VK_TRUE", "1", "true")
        self.wrong(node, path, "true or false", _boolean_hint(node))
        return None

    def integer(self, low: int | None, high: int | None, node: Node, path: str) -> int | None:
        value = node.value
        if self.dumped and isinstance(value, str) and (_is_number(value) or _HEXADECIMAL.fullmatch(value)):
            value = int(value, 16 if value[:2] in ("0x", "0X") else 10)
        if isinstance(value, bool) or not isinstance(value, int):
            self.wrong(node, path, "a whole number")
            return None
        if (low is not None and value < low) or (high is not None and value > high):
            self.wrong(node, path, f"a whole number from {low} to {high}")
            return None
        return value

    def number(self, above_zero: bool, node: Node, path: str) -> float | None:
        value = node.value
        if self.dumped and node.kind == "scalar":
            try:
                value = float(node.text)
            except ValueError:
                value = None
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not finite(value):
            self.wrong(node, path, "a finite number")
            return None
        if above_zero and value <= 0:
            self.wrong(node, path, "a number above 0")
            return None
        return value

    def name(self, section: str, node: Node, path: str) -> str | None:
        if node.kind != "scalar" or node.value is None or isinstance(node.value, (bool, float)):
            self.wrong(node, path, f"the name of an entry of `{section}`", _quote_hint(node))
            return None
        self.mentions.append(Mention(section, node.text, node, path))
        return node.text

    def word(self, words: tuple[Any, ...], node: Node, path: str) -> Any:
        if _is_word(node, words):
            return node.value
        close = nearest(node.text, [w for w in words if isinstance(w, str)]) if node.kind == "scalar" else None
        self.wrong(node, path, f"one of {', '.join(str(word) for word in words)}", f"did you mean `{close}`?" if close else "")
        return None

    def slot(self, node: Node, path: str, key: str, head: Span | None) -> AttachmentReference:
        """An attachment of the same pass: a name, an index, `{attachment, layout}`, or null."""
        if node.kind == "mapping":
            made: AttachmentReference = self.record(AttachmentReference, node, path, key, head)
        else:
            made = AttachmentReference(node, path, key, node.span)
            if node.kind != "scalar" or isinstance(node.value, (bool, float)):
                self.wrong(node, path, "an attachment: a name, an index, {attachment, layout} or null")
            elif isinstance(node.value, int):
                made.attachment = self.integer(0, ATTACHMENT_UNUSED, node, path)
            elif node.value is not None:
                made.attachment = node.text
        if self.dumped and isinstance(made.attachment, str) and _is_number(made.attachment):
            made.attachment = int(made.attachment)
        if made.attachment == ATTACHMENT_UNUSED or made.attachment in UNUSED:
            made.attachment = None
        return made

    def subpass(self, node: Node, path: str) -> int | str | None:
        """The index of a subpass, or EXTERNAL."""
        if isinstance(node.value, str) and node.text in EXTERNAL:
            return "EXTERNAL"
        if isinstance(node.value, str) and not (self.dumped and _is_number(node.text)):
            close = nearest(node.text, EXTERNAL)
            self.wrong(node, path, "EXTERNAL or the index of a subpass", f"did you mean `{close}`?" if close else "")
            return None
        index = self.integer(0, ATTACHMENT_UNUSED, node, path)
        return "EXTERNAL" if index == ATTACHMENT_UNUSED else index

    def command(self, node: Node, path: str, key: str, of: type[Command]) -> Command | None:
        """A recorded command: a mapping with one key, or a bare word for one without parameters."""
        kind, parameters, span = "", None, head_of(node)
        if node.kind == "mapping" and len(node.value) == 1:
            kind, parameters = next(iter(node.value.items()))
            span = node.keys[kind].span
        elif node.kind == "scalar" and isinstance(node.value, str):
            kind = node.value
        else:
            self.wrong(node, path, "one command")
            return None
        shape = of.SHAPE.get(kind)
        if shape is None:
            close = nearest(kind, of.SHAPE)
            help = f"did you mean `{close}`?" if close else f"it is one of {', '.join(of.SHAPE)}"
            self.report("MSAA902", f"unknown command `{shortened(kind)}`", span, path, help)
            return None
        made = of(node, f"{path}.{kind}", key, span)
        made.kind = kind
        made.body = None
        if parameters is None or (parameters.kind == "scalar" and parameters.value is None):
            if shape[0] != "null":
                self.report("MSAA903", f"`{kind}` is due with its parameters", span, made.path)
                return None
            return made
        made.body = self.value(shape, parameters, made.path, kind, span)
        return made if made.body is not None else None


def head_of(node: Node) -> Span:
    """Where a reader sees a value: a scalar whole, a mapping's first key, a list's first character."""
    if node.kind == "scalar":
        return node.span
    if node.kind == "mapping" and node.keys:
        return next(iter(node.keys.values())).span
    return Span(node.start, min(node.start + 1, node.end))


def is_null(node: Node) -> bool:
    """Whether a tool's dump means a null pointer."""
    return node.kind == "scalar" and (node.value is None or node.text in _NULLS)


def shortened(text: str, limit: int = 80) -> str:
    """A text of the input as messages quote it."""
    return text if len(text) <= limit else text[: limit - 1] + "…"


def _shown(node: Node) -> str:
    return "nothing" if node.value is None else f"`{shortened(node.text)}`"


def _is_number(text: str) -> bool:
    """Whether a text is a whole number of a size that Vulkan has somewhere."""
    return text.isascii() and text.isdigit() and len(text) <= 20


def _is_word(node: Node, words: tuple[Any, ...]) -> bool:
    """Whether a scalar is one of some words, of which some may be whole numbers."""
    return node.kind == "scalar" and type(node.value) in (str, int) and node.value in words


def _boolean_hint(node: Node) -> str:
    """What to say of the words that YAML 1.1 took for booleans."""
    words = node.kind == "scalar" and node.plain and node.text.lower() in ("yes", "no", "on", "off", "y", "n")
    return "YAML 1.2 knows only `true` and `false`" if words else ""


def _quote_hint(node: Node) -> str:
    """What to say of numbers and booleans that were meant as texts."""
    meant = node.kind == "scalar" and not isinstance(node.value, str) and node.value is not None
    return f'quote it: "{shortened(node.text, 20)}"' if meant else ""


def _fits(shape: Shape, node: Node) -> bool:
    """Whether a node is of the kind that a shape asks for, whatever its value."""
    kind = shape[0]
    if kind in ("record", "map", "numbered"):
        return node.kind == "mapping"
    if kind == "list":
        return node.kind == "sequence"
    if kind == "word":
        return _is_word(node, shape[1])
    if kind == "name":
        return type(node.value) in (str, int)
    if kind == "int":
        return isinstance(node.value, int) and not isinstance(node.value, bool)
    if kind == "number":
        return isinstance(node.value, (int, float)) and not isinstance(node.value, bool)
    if kind == "bool":
        return isinstance(node.value, bool)
    return node.kind == "scalar" and isinstance(node.value, str)


def _wanted(shape: Shape) -> str:
    words = {
        "record": "a mapping",
        "map": "a mapping",
        "list": "a list",
        "int": "a whole number",
        "number": "a number",
        "bool": "true or false",
    }
    if shape[0] == "word":
        return ", ".join(str(word) for word in shape[1])
    if shape[0] == "name":
        return f"the name of an entry of `{shape[1]}`"
    return words.get(shape[0], "a text")

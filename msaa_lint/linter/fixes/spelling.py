"""Values as a text spells them: Vulkan's full names or short ones, numbers, `VK_TRUE` or `true`, in the quotes that stand around them."""

from __future__ import annotations

import re
from functools import cached_property
from typing import Any, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.scalars import resolve
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.shapes import Shape
from msaa_lint.frame.vulkan.enums import BITLESS, PREFIXES, VALUES
from msaa_lint.frame.vulkan.names import VENDORS, parse_enum

_COUNT = re.compile(r"((?:VK_)?SAMPLE_COUNT_)[0-9]+((?:_BIT)?)")
_PLAIN = re.compile(r"\.?[A-Za-z0-9_][A-Za-z0-9_.-]*")
_BOOLEANS = {"true": "false", "True": "False", "TRUE": "FALSE", "VK_TRUE": "VK_FALSE", "1": "0"}
_OPPOSITES = {**_BOOLEANS, **{false: true for true, false in _BOOLEANS.items()}}


class Form(NamedTuple):
    """How enumerants are written: what stands before the short name (0: nothing, 1: the prefix without VK_, 2: all of it), and `_BIT`."""

    prefix: int
    bit: bool
    second: bool = False
    """Stages and accesses: `VK_PIPELINE_STAGE_2_`."""


def form_of(enum: str, text: str) -> Form | None:
    """The form of an enumerant's spelling; None where it is a number, or no name of the enum."""
    if parse_enum(enum, text) is None or text[:1].isdigit():
        return None
    prefix = PREFIXES[enum]
    kind = 2 if text.startswith(prefix) else 1 if text.startswith(prefix[3:]) else 0
    rest = text[len(prefix) - (3 if kind == 1 else 0) :] if kind else text
    second = kind > 0 and enum.endswith("2") and rest.startswith("2_")
    bit = re.search(r"_BIT(?:_[A-Z]+)?$", text) is not None
    return Form(kind, bit, second)


def enumerant(enum: str, name: str, form: Form) -> str:
    """A canonical name in a form; the short name itself where the form does not give one of its spellings."""
    bare = name
    if form.bit and "FlagBits" in enum and name not in BITLESS.get(enum, ()):
        head, _, vendor = name.rpartition("_")
        bare = f"{head}_BIT_{vendor}" if head and vendor in VENDORS else f"{name}_BIT"
    prefix = PREFIXES[enum]
    before = (prefix, prefix[3:])[2 - form.prefix] if form.prefix else ""
    text = before + ("2_" if form.second else "") + bare
    return text if parse_enum(enum, text) == name else name


class Spelling:
    """How a document spells things. `dumped` says that it is a tool's dump, with C's names."""

    def __init__(self, records: list[Record], dumped: bool) -> None:
        self._records = records
        self.dumped = dumped
        self._forms: dict[bool, Form | None] = {}

    def scalar(self, shape: Shape, value: Any, like: Node | None, record: Record) -> str:
        """The text of a scalar, without quotes. `like` is what it takes the place of, or stands beside."""
        kind = shape[0]
        if isinstance(value, bool):
            text = like.text if like is not None else ""
            if text in _OPPOSITES:
                is_true = text in _BOOLEANS
                return text if is_true == value else _OPPOSITES[text]
            return ("VK_TRUE" if value else "VK_FALSE") if self.dumped else str(value).lower()
        if kind in ("enum", "flags"):
            return self.name(shape[1].partition("|")[0], str(value), like.text if like is not None else "", record)
        if kind == "samples":
            match = _COUNT.fullmatch(like.text) if like is not None else None
            if match is not None:
                return f"{match[1]}{value}{match[2]}"
            return f"VK_SAMPLE_COUNT_{value}_BIT" if self.dumped and like is None else str(value)
        return str(value)

    def name(self, enum: str, name: str, like: str, record: Record) -> str:
        """An enumerant in the form of another one, else in that of the record, else in that of the document."""
        if enum.startswith("MTL"):
            from msaa_lint.frame.metal.names import spelled

            return spelled(enum, name, like or _metal_form(record) or self._usual_metal)
        flags = "FlagBits" in enum
        if like.isdecimal():
            return str(VALUES[enum][name])
        form = form_of(enum, like) if like else None
        return enumerant(enum, name, form or _form(record, flags) or self._usual(flags) or Form(2 if self.dumped else 0, self.dumped))

    @cached_property
    def _usual_metal(self) -> str:
        return next((form for record in self._records if (form := _metal_form(record))), "")

    def _usual(self, flags: bool) -> Form | None:
        if flags not in self._forms:
            self._forms[flags] = next((form for record in self._records if (form := _form(record, flags)) is not None), None)
        return self._forms[flags]


def _metal_form(record: Record) -> str:
    """The first enumerant of Metal's that a record states, as it is written."""
    for member, (_, value) in record.spelled.items():
        if record.SHAPE[member][0] in ("enum", "flags"):
            items = value.value if value.kind == "sequence" else [value]
            return next((item.text.partition("|")[0].strip() for item in items if item.kind == "scalar"), "")
    return ""


def _form(record: Record, flags: bool) -> Form | None:
    """The form of the first enumerant that a record states; for flags of the first flag, else of any, with `_BIT` beside full names."""
    fallback = None
    for member, (_, value) in record.spelled.items():
        shape = record.SHAPE[member]
        if shape[0] not in ("enum", "flags"):
            continue
        items = value.value if value.kind == "sequence" else [value]
        for item in items[:1]:
            if item.kind != "scalar" or item.value is None:
                continue
            form = form_of(shape[1].partition("|")[0], item.text.partition("|")[0].strip())
            if form is None:
                continue
            if flags == (shape[0] == "flags"):
                return form
            fallback = fallback or Form(form.prefix, flags and form.prefix == 2)
    return fallback


def quoted(text: str, quote: str, plain: bool = False) -> str:
    """A scalar in quotes, or without where it needs none (`plain`: where it is meant as what it looks like, a number or a boolean)."""
    if quote == "'":
        return "'" + text.replace("'", "''") + "'"
    if not quote and (plain or (_PLAIN.fullmatch(text) is not None and isinstance(resolve(text), str))):
        return text
    return '"' + "".join(_escaped(character) for character in text) + '"'


def _escaped(character: str) -> str:
    if character in '"\\':
        return "\\" + character
    if character.isprintable():
        return character
    return f"\\u{ord(character):04x}" if ord(character) < 0x10000 else character

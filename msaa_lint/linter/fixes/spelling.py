"""How a document spells its scalars: enumerants with or without prefix and `_BIT`, sample counts,
`VK_TRUE` or `true`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property
from typing import Any, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.shapes import Shape
from msaa_lint.frame.vulkan.enums import BITLESS, PREFIXES, VALUES
from msaa_lint.frame.vulkan.names import VENDORS, parse_enum

_COUNT = re.compile(r"((?:VK_)?SAMPLE_COUNT_)[0-9]+((?:_BIT)?)")
_BIT = re.compile(r"_BIT(?:_[A-Z]+)?$")
_FALSE = {"true": "false", "True": "False", "TRUE": "FALSE", "VK_TRUE": "VK_FALSE", "1": "0"}
_TRUE = {false: true for true, false in _FALSE.items()}


class Form(NamedTuple):
    """The form of an enumerant's spelling.

    `start` is where the enum's full prefix is cut off: 0 for all of it, 3 for it without `VK_`,
    None for no prefix. `bit` says whether the spelling has `_BIT`, `second` whether a stage or an
    access has the prefix of the 64-bit enums, as in `VK_PIPELINE_STAGE_2_`.
    """

    start: int | None
    bit: bool
    second: bool = False


def form_of(enum: str, text: str) -> Form | None:
    """The form of an enumerant's spelling, or None if it is a number or not a name of the enum."""
    if parse_enum(enum, text) is None or text[:1].isdigit():
        return None
    prefix = PREFIXES[enum]
    start = 0 if text.startswith(prefix) else 3 if text.startswith(prefix[3:]) else None
    rest = text if start is None else text[len(prefix) - start :]
    second = start is not None and enum.endswith("2") and rest.startswith("2_")
    return Form(start, _BIT.search(text) is not None, second)


def in_form(enum: str, name: str, form: Form) -> str:
    """A canonical name in a form, or unchanged if the enum has no such spelling."""
    text = name
    if form.bit and "FlagBits" in enum and name not in BITLESS.get(enum, ()):
        head, _, vendor = name.rpartition("_")
        text = f"{head}_BIT_{vendor}" if head and vendor in VENDORS else f"{name}_BIT"
    prefix = PREFIXES[enum][form.start :] if form.start is not None else ""
    text = prefix + ("2_" if form.second else "") + text
    return text if parse_enum(enum, text) == name else name


class Spelling:
    """The spelling of a document. `is_dump` says that it is a tool's dump, which has C's names."""

    def __init__(self, records: list[Record], is_dump: bool) -> None:
        self._records = records
        self.is_dump = is_dump
        self._document_forms: dict[bool, Form | None] = {}

    def scalar(self, shape: Shape, value: Any, model: Node | None, record: Record) -> str:
        """The text of a scalar, without quotes, spelled like the node `model` if there is one."""
        kind = shape[0]
        text = model.text if model is not None else ""
        if isinstance(value, bool):
            if text in _FALSE or text in _TRUE:
                return _TRUE.get(text, text) if value else _FALSE.get(text, text)
            return ("VK_TRUE" if value else "VK_FALSE") if self.is_dump else str(value).lower()
        if kind in ("enum", "flags"):
            return self.name(_enum(shape), str(value), text, record)
        if kind == "samples":
            match = _COUNT.fullmatch(text)
            if match is not None:
                return f"{match[1]}{value}{match[2]}"
            return f"VK_SAMPLE_COUNT_{value}_BIT" if self.is_dump and model is None else str(value)
        return str(value)

    def name(self, enum: str, name: str, model: str, record: Record) -> str:
        """An enumerant in the form of the spelling `model`; without one in the form of the record,
        else of the document.
        """
        if enum.startswith("MTL"):
            from msaa_lint.frame.metal.names import spelled

            return spelled(enum, name, model or _metal_model(record) or self._metal_model)
        is_flag = "FlagBits" in enum
        if model.isdecimal():
            return str(VALUES[enum][name])
        form = form_of(enum, model) if model else None
        default = Form(0 if self.is_dump else None, self.is_dump)
        return in_form(
            enum, name, form or _form(record, is_flag) or self._document_form(is_flag) or default
        )

    @cached_property
    def _metal_model(self) -> str:
        return next((model for record in self._records if (model := _metal_model(record))), "")

    def _document_form(self, is_flag: bool) -> Form | None:
        if is_flag not in self._document_forms:
            forms = (_form(record, is_flag) for record in self._records)
            self._document_forms[is_flag] = next((form for form in forms if form is not None), None)
        return self._document_forms[is_flag]


def _enum(shape: Shape) -> str:
    enum: str = shape[1].partition("|")[0]
    return enum


def _enumerants(record: Record) -> Iterator[tuple[Shape, str]]:
    """The first enumerant of each member that has any, as it is spelled."""
    for member, (_, value) in record.spelled.items():
        shape = record.SHAPE[member]
        first = (value.value or [None])[0] if value.kind == "sequence" else value
        if (
            shape[0] in ("enum", "flags")
            and first is not None
            and first.kind == "scalar"
            and first.value is not None
        ):
            yield shape, first.text.partition("|")[0].strip()


def _metal_model(record: Record) -> str:
    """The spelling of the first Metal enumerant that a record states; empty if it states none."""
    return next((text for _, text in _enumerants(record)), "")


def _form(record: Record, is_flag: bool) -> Form | None:
    """The form of the first enumerant of a record, preferably of a flag if `is_flag`, else of
    another one.
    """
    fallback = None
    for shape, text in _enumerants(record):
        form = form_of(_enum(shape), text)
        if form is None:
            continue
        if is_flag == (shape[0] == "flags"):
            return form
        fallback = fallback or Form(form.start, is_flag and form.start == 0)
    return fallback

"""How a member of the format is spelled: the field types that `models` is written in.

Each is an `Annotated` marker that pydantic validates by and writes JSON Schema from, and that `generate` turns into a shape of the same
meaning for the lint path, which does without pydantic's 110 ms of start-up.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, NamedTuple

from annotated_types import Ge, Gt, Le
from pydantic import AllowInfNan, GetCoreSchemaHandler, GetJsonSchemaHandler, StrictBool, StrictFloat, StrictInt, StrictStr
from pydantic_core import CoreSchema, core_schema

from ..vulkan.enums import ENUMS, PREFIXES
from ..vulkan.names import parse_enum, parse_flags
from .scalars import SAMPLE_COUNTS, enumerant, sample_count

JsonSchema = dict[str, Any]


def _validated(check: Callable[[Any], Any]) -> CoreSchema:
    return core_schema.no_info_plain_validator_function(check)


class Enumerant(NamedTuple):
    """One enumerant of a Vulkan enum, by its full name or without the type's prefix and the `_BIT` suffix.

    Several enums, joined by `|`, are asked in turn.
    """

    enum: str

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        def check(value: object) -> str:
            name = enumerant(self.enum, value) if isinstance(value, str) else None
            if name is None:
                raise ValueError(f"{value!r} is no {self.enum}")
            return name

        return _validated(check)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchema:
        return {"anyOf": [_spellings(enum) for enum in self.enum.split("|")]}


class FlagBits(NamedTuple):
    """Bits of a Vulkan flags type: a list of names, or one string joined by `|`."""

    enum: str

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        def check(value: object) -> tuple[str, ...]:
            if isinstance(value, str):
                return tuple(parse_flags(self.enum, value))
            if not isinstance(value, (list, tuple)):
                raise ValueError(f"{value!r} is no list of {self.enum}")
            bits = [parse_enum(self.enum, bit) if isinstance(bit, str) else None for bit in value]
            if None in bits:
                raise ValueError(f"{value!r} has what is no {self.enum}")
            return tuple(bit for bit in bits if bit is not None)

        return _validated(check)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchema:
        return {"anyOf": [{"type": "array", "items": _spellings(self.enum)}, {"type": "string"}]}


def _spellings(enum: str) -> JsonSchema:
    """The short names, which an editor completes, and the full ones."""
    return {"anyOf": [{"enum": sorted(ENUMS[enum])}, {"type": "string", "pattern": f"^{PREFIXES[enum]}[A-Z0-9_]+$"}]}


class Count:
    """A sample count: `4`, `SAMPLE_COUNT_4` or `VK_SAMPLE_COUNT_4_BIT`."""

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        def check(value: object) -> int:
            count = sample_count(value)
            if count is None:
                raise ValueError(f"{value!r} is no sample count")
            return count

        return _validated(check)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchema:
        return {"anyOf": [{"enum": list(SAMPLE_COUNTS)}, {"type": "string", "pattern": r"^(VK_)?SAMPLE_COUNT_(1|2|4|8|16|32|64)(_BIT)?$"}]}


class NameOf(NamedTuple):
    """The name of an entry of another section of the description, e.g. `images`."""

    section: str


class Slot:
    """An attachment of the same render pass: a name, an index, `{attachment, layout}`, or null for VK_ATTACHMENT_UNUSED."""


class Counted:
    """A mapping whose names are in index order, or a list, whose entries are known by their index."""


Bool = StrictBool
Text = StrictStr
Number = Annotated[StrictFloat | StrictInt, AllowInfNan(False)]
PositiveNumber = Annotated[StrictFloat | StrictInt, Gt(0), AllowInfNan(False)]
Index = Annotated[StrictInt, Ge(0), Le(2**32 - 1)]
Size = Annotated[StrictInt, Ge(1), Le(2**31 - 1)]
Offset = Annotated[StrictInt, Ge(-(2**31)), Le(2**31 - 1)]
Samples = Annotated[int, Count()]
ImageName = Annotated[StrictStr, NameOf("images")]
RenderPassName = Annotated[StrictStr, NameOf("renderPasses")]
FramebufferName = Annotated[StrictStr, NameOf("framebuffers")]
PipelineName = Annotated[StrictStr, NameOf("pipelines")]

"""How a member of the format is spelled: the field types that `models` is written in.

Each is an `Annotated` marker that pydantic validates by and writes JSON Schema from, and that `generate` turns into a shape of the same
meaning for the lint path, which does without pydantic's 110 ms of start-up.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, NamedTuple

from annotated_types import Ge, Gt, Le
from pydantic import (
    AfterValidator,
    AllowInfNan,
    BeforeValidator,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    StrictBool,
    StrictFloat,
    StrictInt,
    StrictStr,
    StringConstraints,
    WithJsonSchema,
)
from pydantic_core import CoreSchema, core_schema

from .scalars import EXTERNAL, SAMPLE_COUNTS, enumerant, finite, flags, sample_count

JsonSchema = dict[str, Any]


def _validated(check: Callable[[Any], Any]) -> CoreSchema:
    return core_schema.no_info_plain_validator_function(check)


class Enumerant(NamedTuple):
    """One enumerant of a Vulkan enum, by its full name or without the type's prefix and the `_BIT` suffix; or of one of Metal's.

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
        named = [{ENUMERANT: enum} for enum in self.enum.split("|")]
        return named[0] if len(named) == 1 else {"anyOf": named}


class FlagBits(NamedTuple):
    """Bits of a Vulkan flags type: a list of names, one string joined by `|`, or 0 for none."""

    enum: str

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        def check(value: object) -> tuple[str, ...]:
            if isinstance(value, str):
                return tuple(flags(self.enum, value))
            if value == 0 and type(value) is int and "FlagBits" in self.enum:
                return ()
            if not isinstance(value, (list, tuple)):
                raise ValueError(f"{value!r} is no list of {self.enum}")
            bits = [enumerant(self.enum, bit) if isinstance(bit, str) else None for bit in value]
            if None in bits:
                raise ValueError(f"{value!r} has what is no {self.enum}")
            return tuple(dict.fromkeys(bit for bit in bits if bit is not None and bit != "NONE"))

        return _validated(check)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchema:
        none = [{"const": 0}] if "FlagBits" in self.enum else []
        return {"anyOf": [{"type": "array", "items": {ENUMERANT: self.enum}}, {FLAGS: self.enum}, *none]}


ENUMERANT, FLAGS = "enumerant of", "flags of"
"""What stands in a schema for the spellings of an enum's names, alone or joined, until `msaa-lint schema` writes each out once."""


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
        spelled = f"^((VK_)?SAMPLE_COUNT_)?({'|'.join(map(str, SAMPLE_COUNTS))})(_BIT)?$"
        return {"anyOf": [{"enum": list(SAMPLE_COUNTS)}, {"type": "string", "pattern": spelled}]}


class NameOf(NamedTuple):
    """The name of an entry of another section of the description, e.g. `images`. Names may be numbers, as keys may."""

    section: str

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        def check(value: object) -> str:
            if isinstance(value, bool) or not isinstance(value, (str, int)):
                raise ValueError(f"{value!r} is no name")
            return str(value)

        return _validated(check)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchema:
        return {"type": ["string", "integer"]}


class SubpassIndex:
    """The index of a subpass, or VK_SUBPASS_EXTERNAL."""

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        def check(value: object) -> int | str:
            if isinstance(value, str) and value in EXTERNAL:
                return "EXTERNAL"
            if type(value) is not int or not 0 <= value < 2**32:
                raise ValueError(f"{value!r} is no subpass")
            return "EXTERNAL" if value == 2**32 - 1 else value

        return _validated(check)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchema:
        return {"anyOf": [{"enum": list(EXTERNAL)}, {"type": "integer", "minimum": 0, "maximum": 2**32 - 1}]}


class Null:
    """A member that may be null: it then says that there is none."""


class Slot:
    """An attachment of the same render pass: a name, an index, `{attachment, layout}`, or null for VK_ATTACHMENT_UNUSED."""


class Counted:
    """A mapping whose names are in index order, or a list, whose entries are known by their index."""


def _number(value: float) -> float:
    if not finite(value):
        raise ValueError("a number that is not finite")
    return value


def _word(value: object) -> object:
    if type(value) not in (str, int):
        raise ValueError(f"{value!r} is no word")
    return value


Word = BeforeValidator(_word)
"""For a Literal with a number in it: 1 is neither true nor 1.0."""

Bool = StrictBool
Text = StrictStr
Number = Annotated[StrictFloat | StrictInt, AllowInfNan(False), AfterValidator(_number)]
PositiveNumber = Annotated[
    StrictFloat | StrictInt,
    Gt(0),
    AllowInfNan(False),
    AfterValidator(_number),
    WithJsonSchema({"type": "number", "exclusiveMinimum": 0}),
]
Index = Annotated[StrictInt, Ge(0), Le(2**32 - 1)]
Size = Annotated[StrictInt, Ge(1), Le(2**31 - 1)]
Offset = Annotated[StrictInt, Ge(-(2**31)), Le(2**31 - 1)]
Samples = Annotated[int, Count()]
ImageName = Annotated[str, NameOf("images")]
RenderPassName = Annotated[str, NameOf("renderPasses")]
FramebufferName = Annotated[str, NameOf("framebuffers")]
PipelineName = Annotated[str, NameOf("pipelines")]
TextureName = Annotated[str, NameOf("metal.textures")]
MetalPassName = Annotated[str, NameOf("metal.renderPasses")]
SubpassNumber = Annotated[int | str, SubpassIndex()]
MAX_COLOR_ATTACHMENTS = 8
"""Of a render pass and a pipeline of Metal's."""

ColorIndex = Annotated[str, StringConstraints(strict=True, pattern=r"^[0-7]$")]
ConstantId = Annotated[str, StringConstraints(strict=True, pattern=r"^(0|[1-9][0-9]{0,9})$")]

"""pydantic models of the structures of a description: its JSON Schema, and checks of what a program
hands in.

Each is made from a class in `models` by the shapes that inputs are read by, so that both accept and
refuse the same values. Nothing on the path of `check` imports this module: pydantic alone takes
longer to import than the rest of a run.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from functools import cache, reduce
from operator import or_
from types import GenericAlias
from typing import Annotated, Any, Literal

from annotated_types import Ge, Gt, Le, MaxLen
from pydantic import (
    AfterValidator,
    AllowInfNan,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    PlainValidator,
    StrictBool,
    StrictFloat,
    StrictInt,
    StrictStr,
    StringConstraints,
    WithJsonSchema,
    create_model,
    model_validator,
)
from pydantic_core import CoreSchema

from .members import MAX_UINT32
from .models import AttachmentReference, Command
from .record import Record
from .reference.lookup import STRUCTURES, key_text, structure_text
from .scalars import (
    EXTERNAL,
    MAX_SHADING,
    SAMPLE_COUNTS,
    SHADING_LEVELS,
    caseless,
    enumerant,
    finite,
    flags,
    sample_count,
    shading_cost,
)
from .shapes import Shape

JsonSchema = dict[str, Any]

ENUMERANT, FLAGS = "enumerant of", "flags of"
"""What stands in a schema for the spellings of an enum's names, alone or joined, until `msaa-lint
schema` writes each out once.
"""


class Structure(BaseModel):
    """The base of the models: an unknown member is an error, and so is null where a value is
    expected.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    @model_validator(mode="before")
    @classmethod
    def _states_values(cls, data: Any) -> Any:
        for name, value in data.items() if isinstance(data, dict) else ():
            if value is None and name in cls.model_fields and not _is_nullable(cls, name):
                raise ValueError(f"`{name}` is null; leave out what is unknown")
        return data

    @classmethod
    def __get_pydantic_json_schema__(
        cls, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchema:
        json_schema = handler(schema)
        members: dict[str, JsonSchema] = handler.resolve_ref_schema(json_schema).get(
            "properties", {}
        )
        for name, member in members.items():
            if member.get("default", ...) is None:
                del member["default"]
            arms = member.get("anyOf", [])
            if {"type": "null"} in arms and not _is_nullable(cls, name):
                others = [arm for arm in arms if arm != {"type": "null"}]
                del member["anyOf"]
                member.update(others[0] if len(others) == 1 else {"anyOf": others})
        return json_schema


class OneCommand(Structure):
    """The base of the models of recorded commands: a mapping with one key."""

    model_config = ConfigDict(json_schema_extra={"minProperties": 1, "maxProperties": 1})

    @model_validator(mode="before")
    @classmethod
    def _is_one(cls, data: Any) -> Any:
        if isinstance(data, dict) and len(data) != 1:
            raise ValueError("expected one command")
        return data


def _is_nullable(model: type[BaseModel], name: str) -> bool:
    return NULL in model.model_fields[name].metadata


NULL = "may be null"
"""Marks a member for which null says something: that an attachment is unused, that a command has no
parameters.
"""


@cache
def model_of(kind: type[Record]) -> type[Structure]:
    """The model of a structure."""
    members: dict[str, Any] = {}
    for name, shape in kind.SHAPE.items():
        annotation = type_of(shape)
        absent = getattr(kind, name, None)
        if absent is None and shape[0] not in ("null", "slot"):
            annotation = annotation | None
        text = key_text(kind, name)
        markdown: JsonSchema = {"markdownDescription": text.markdown}
        members[name] = (
            annotation,
            Field(
                default=absent,
                title=text.title,
                description=text.description,
                json_schema_extra=markdown,
            ),
        )
    base = OneCommand if issubclass(kind, Command) else Structure
    with warnings.catch_warnings():
        # `copy` is a method of every model, and the name of a command of Metal's.
        warnings.simplefilter("ignore", UserWarning)
        model = create_model(
            kind.__name__,
            __base__=base,
            __doc__=structure_text(kind),
            **members,
        )
    model.model_config["title"] = STRUCTURES[kind.__name__].title
    return model


def type_of(shape: Shape) -> Any:
    """The type by which pydantic accepts what a shape accepts."""
    match shape:
        case ("text",):
            return StrictStr
        case ("bool",):
            return StrictBool
        case ("int", low, high):
            return Annotated[StrictInt, Ge(low), Le(high)]
        case ("number", False):
            return Annotated[StrictFloat | StrictInt, AllowInfNan(False), AfterValidator(_finite)]
        case ("number", True):
            positive = WithJsonSchema({"type": "number", "exclusiveMinimum": 0})
            return Annotated[
                StrictFloat | StrictInt,
                Gt(0),
                AllowInfNan(False),
                AfterValidator(_finite),
                positive,
            ]
        case ("share",):
            fraction = WithJsonSchema({"type": "number", "exclusiveMinimum": 0, "maximum": 1})
            return Annotated[StrictFloat | StrictInt, Gt(0), Le(1), AllowInfNan(False), fraction]
        case ("samples",):
            pattern = f"^((VK_)?SAMPLE_COUNT_)?({'|'.join(map(str, SAMPLE_COUNTS))})(_BIT)?$"
            return _checked(
                sample_count,
                {"anyOf": [{"enum": list(SAMPLE_COUNTS)}, {"type": "string", "pattern": pattern}]},
            )
        case ("shading",):
            pattern = f"^({'|'.join(SHADING_LEVELS)}|[0-9]{{1,12}}(ops)?|[0-9]{{1,12}}(\\.[0-9]{{1,9}})?(ns|ms))$"  # noqa: E501
            operations = {"type": "integer", "minimum": 0, "maximum": MAX_SHADING["ops"]}
            return _checked(
                shading_cost,
                {
                    "anyOf": [
                        {"enum": list(SHADING_LEVELS)},
                        {"type": "string", "pattern": pattern},
                        operations,
                    ]
                },
            )
        case ("enum", enums):
            names = [{ENUMERANT: enum} for enum in enums.split("|")]
            return _checked(
                lambda value: _enumerant(enums, value),
                names[0] if len(names) == 1 else {"anyOf": names},
            )
        case ("flags", enum):
            spellings = [{"type": "array", "items": {ENUMERANT: enum}}, {FLAGS: enum}]
            none = [{"const": 0}] if "FlagBits" in enum else []
            return _checked(lambda value: _flags(enum, value), {"anyOf": [*spellings, *none]})
        case ("word", words):
            literal = _literal(words)
            # 1 is neither true nor 1.0.
            return (
                literal
                if all(isinstance(word, str) for word in words)
                else Annotated[literal, BeforeValidator(_word)]
            )
        case ("caseless", words):
            pattern = (
                "^(?:"
                + "|".join(
                    re.sub("[a-z]", lambda letter: f"[{letter[0].upper()}{letter[0]}]", word)
                    for word in words
                )
                + ")$"
            )
            spellings = [{"enum": list(words)}, {"type": "string", "pattern": pattern}]
            return _checked(lambda value: caseless(words, value), {"anyOf": spellings})
        case ("name", _):
            return _checked(
                lambda value: str(value) if type(value) in (str, int) else None,
                {"type": ["string", "integer"]},
            )
        case ("subpass",):
            index = {"type": "integer", "minimum": 0, "maximum": MAX_UINT32}
            return _checked(_subpass, {"anyOf": [{"enum": list(EXTERNAL)}, index]})
        case ("slot",):
            return Annotated[
                model_of(AttachmentReference) | StrictStr | type_of(("int", 0, MAX_UINT32)) | None,
                NULL,
            ]
        case ("record", kind):
            return model_of(kind)
        case ("command", kind):
            words = tuple(
                name for name, parameters in kind.SHAPE.items() if parameters[0] == "null"
            )
            return model_of(kind) | _literal(words) if words else model_of(kind)
        case ("list", item):
            return GenericAlias(tuple, (type_of(item), ...))
        case ("list", item, maximum):
            return Annotated[type_of(("list", item)), MaxLen(maximum)]
        case ("counted", item):
            return type_of(("map", item)) | type_of(("list", item))
        case ("map", item):
            return GenericAlias(dict, (str, type_of(item)))
        case ("numbered", item, *highest):
            pattern = f"^[0-{highest[0]}]$" if highest else "^(0|[1-9][0-9]{0,9})$"
            numbered = GenericAlias(
                dict,
                (Annotated[str, StringConstraints(strict=True, pattern=pattern)], type_of(item)),
            )
            return (
                numbered
                if highest
                else Annotated[numbered, Field(json_schema_extra={"additionalProperties": False})]
            )
        case ("null", item):
            return Annotated[type_of(item) | None, NULL]
        case ("either", *items):
            return reduce(or_, map(type_of, items))
    raise TypeError(f"no type for {shape!r}")


def _literal(words: tuple[object, ...]) -> Any:
    literal: Any = Literal
    return literal[words]


def _checked(read: Callable[[Any], object], json_schema: JsonSchema) -> Any:
    """The type of what `read` accepts; it returns None for any other value."""

    def check(value: object) -> object:
        result = read(value)
        if result is None:
            raise ValueError(f"{value!r} is not accepted")
        return result

    return Annotated[Any, PlainValidator(check), WithJsonSchema(json_schema)]


def _enumerant(enums: str, value: object) -> str | None:
    return enumerant(enums, value) if isinstance(value, str) else None


def _flags(enum: str, value: object) -> tuple[str, ...] | None:
    if isinstance(value, str):
        return tuple(flags(enum, value))
    if type(value) is int and value == 0 and "FlagBits" in enum:
        return ()
    names = (
        [_enumerant(enum, item) for item in value] if isinstance(value, (list, tuple)) else [None]
    )
    return (
        None
        if None in names
        else tuple(dict.fromkeys(name for name in names if name is not None and name != "NONE"))
    )


def _subpass(value: object) -> int | str | None:
    if isinstance(value, str):
        return "EXTERNAL" if value in EXTERNAL else None
    if type(value) is not int or not 0 <= value <= MAX_UINT32:
        return None
    return "EXTERNAL" if value == MAX_UINT32 else value


def _finite(value: float) -> float:
    if not finite(value):
        raise ValueError("the number is not finite")
    return value


def _word(value: object) -> object:
    if type(value) not in (str, int):
        raise ValueError(f"{value!r} is not a word")
    return value

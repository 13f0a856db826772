"""What the models of a description are made of."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, GetJsonSchemaHandler, model_validator
from pydantic_core import CoreSchema

from .fields import JsonSchema, Null, Slot


class Struct(BaseModel):
    """A structure: unknown members are errors, and so is null where a value is due."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    @model_validator(mode="before")
    @classmethod
    def _states_values(cls, given: Any) -> Any:
        nulls = [name for name, value in given.items() if value is None] if isinstance(given, dict) else []
        for name in nulls:
            if name in cls.model_fields and not cls._nullable(name):
                raise ValueError(f"{name} is null: what is unknown is left out")
        return given

    @classmethod
    def _nullable(cls, name: str) -> bool:
        return any(isinstance(marker, (Null, Slot)) for marker in cls.model_fields[name].metadata)

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchema:
        made = handler(schema)
        members: dict[str, JsonSchema] = handler.resolve_ref_schema(made).get("properties", {})
        for name, member in members.items():
            if member.get("default", ...) is None:
                del member["default"]
            arms = member.get("anyOf", [])
            if {"type": "null"} in arms and not cls._nullable(name):
                rest = [arm for arm in arms if arm != {"type": "null"}]
                del member["anyOf"]
                member.update(rest[0] if len(rest) == 1 else {"anyOf": rest})
        return made

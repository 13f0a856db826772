"""`msaa-lint schema`: JSON Schemas."""

from __future__ import annotations

import json
import os
import re
from typing import Any

from msaa_lint.frame.description.models import Description
from msaa_lint.frame.description.pydantic_models import ENUMERANT, FLAGS, model_of
from msaa_lint.frame.description.reference.enumerants import ENUMERANTS
from msaa_lint.frame.metal import names as metal
from msaa_lint.frame.vulkan.enums import BITLESS, ENUMS, PREFIXES, VALUES
from msaa_lint.frame.vulkan.names import VENDORS

from .common import run_command
from .options import Arguments

_KINDS = {
    "array": "a list",
    "object": "a mapping",
    "string": "text",
    "integer": "a number",
    "number": "a number",
    "null": "null",
}


def schema(arguments: Arguments) -> int:
    """Prints the schema that the arguments name; returns the exit code."""
    return run_command(_schema, arguments)


def _schema(arguments: Arguments) -> int:
    return print_schema(*arguments["paths"] or ["description"])


def print_schema(which: str) -> int:
    """Prints the schema of the description format, or of the JSON output of a command: json-v1 is
    that of `check`.
    """
    if which == "description":
        print(json.dumps(description_schema(), indent=2))
    else:
        path = os.path.join(
            os.path.dirname(__file__), "report", f"{which.replace('-', '_')}.schema.json"
        )
        with open(path, encoding="utf-8") as file:
            print(file.read(), end="")
    return 0


def description_schema() -> dict[str, object]:
    """The JSON Schema of a description, from the models."""
    enums: dict[str, object] = {}
    root = _with_enums(model_of(Description).model_json_schema(), enums)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:msaa-lint:description-v1",
        **root,
        "title": "msaa-lint description",
        "$defs": {**root["$defs"], **dict(sorted(enums.items()))},
    }


def _with_enums(node: Any, enums: dict[str, object]) -> Any:
    """A schema with references to its enums, whose definitions it adds to `enums`."""
    if isinstance(node, list):
        return [_with_enums(item, enums) for item in node]
    if not isinstance(node, dict):
        return node
    rest = {
        name: _with_enums(value, enums)
        for name, value in node.items()
        if name not in (FLAGS, ENUMERANT)
    }
    if FLAGS in node:
        enum = node[FLAGS]
        enums[f"{enum}Flags"] = {"type": "string", "pattern": joined(enum)}
        return {"$ref": f"#/$defs/{enum}Flags", **rest}
    if ENUMERANT in node:
        enum = node[ENUMERANT]
        enums[enum] = _enum_schema(enum)
        return {"$ref": f"#/$defs/{enum}", **rest}
    if "title" in rest and "anyOf" in rest:
        rest["anyOf"] = [_titled(arm, rest["title"]) for arm in rest["anyOf"]]
    return rest


def _titled(arm: dict[str, object], title: str) -> dict[str, object]:
    """One of several forms of a value, with a title of its own: the YAML language server takes
    forms without one for the same.
    """
    kind = arm.get("type", "integer" if "enum" in arm or "const" in arm else None)
    return (
        {**arm, "title": f"{title}, as {_KINDS[kind]}"}
        if isinstance(kind, str) and "title" not in arm
        else arm
    )


def _enum_schema(enum: str) -> dict[str, object]:
    """The schema of an enumerant: an editor completes the short names, with their descriptions, and
    accepts the other spellings.
    """
    names = list(VALUES[enum] if enum in VALUES else metal.ENUMS[enum])
    short: dict[str, object] = {"enum": names}
    if enum in ENUMERANTS:
        short["enumDescriptions"] = [ENUMERANTS[enum].get(name, "") for name in names]
    return {"anyOf": [short, {"type": "string", "pattern": f"^{spellings(enum)}$"}]}


def spellings(enum: str) -> str:
    """A regular expression for the names of an enum that `vulkan.names.parse_enum`, or
    `metal.names.parse`, accepts.
    """
    if enum not in VALUES:
        return "(?:" + "|".join(map(re.escape, metal.spellings(enum))) + ")"
    flags, bitless = "FlagBits" in enum, BITLESS.get(enum, ())
    prefix = PREFIXES[enum].removeprefix("VK_") + ("(?:2_)?" if enum.endswith("2") else "")
    words = "|".join(
        _with_bit(name) if flags and name not in bitless else name for name in ENUMS[enum]
    )
    return f"(?:(?:VK_)?{prefix})?(?:{words})"


def _with_bit(name: str) -> str:
    """A pattern for a flag bit's name with or without `_BIT`, which stands before a vendor's
    suffix.
    """
    head, _, vendor = name.rpartition("_")
    return f"{head}(?:_BIT)?_{vendor}" if head and vendor in VENDORS else f"{name}(?:_BIT)?"


def joined(enum: str) -> str:
    """A regular expression for the names of an enum joined by `|`, and for masks, that
    `vulkan.names.parse_flags` accepts.
    """
    if "FlagBits" not in enum:
        return f"^\\s*{_joined(spellings(enum))}\\s*$"
    mask = "(?:0|[1-9][0-9]*|0[xX][0-9a-fA-F]+)"
    several = _joined(f"(?:{spellings(enum)}|{mask})")
    return f"^\\s*(?:{several}|{mask}\\s*\\((?:\\s*{several})?\\s*\\))\\s*$"


def _joined(name: str) -> str:
    return f"{name}(?:\\s*\\|\\s*{name})*"

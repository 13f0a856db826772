"""`msaa-lint schema`: JSON Schemas."""

from __future__ import annotations

import json
import os
import re

from msaa_lint.frame.description.models import Description
from msaa_lint.frame.description.pydantic_models import ENUMERANT, FLAGS, model_of
from msaa_lint.frame.metal import names as metal
from msaa_lint.frame.vulkan.enums import BITLESS, ENUMS, PREFIXES, VALUES
from msaa_lint.frame.vulkan.names import VENDORS

from .common import run_command
from .options import Arguments


def schema(arguments: Arguments) -> int:
    """Prints the schema that the arguments name; returns the exit code."""
    return run_command(_schema, arguments)


def _schema(arguments: Arguments) -> int:
    return print_schema(*arguments["paths"] or ["description"])


def print_schema(which: str) -> int:
    """Prints the schema of the description format, or of the JSON output of `check` (json-v1) or `cost` (cost-v1)."""
    if which == "description":
        print(json.dumps(description_schema(), indent=2))
    else:
        path = os.path.join(os.path.dirname(__file__), "report", f"{which.replace('-', '_')}.schema.json")
        with open(path, encoding="utf-8") as file:
            print(file.read(), end="")
    return 0


def description_schema() -> dict[str, object]:
    """The JSON Schema of a description, from the models."""
    enums: dict[str, object] = {}
    root = _with_enums(model_of(Description).model_json_schema(), enums)
    assert isinstance(root, dict)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:msaa-lint:description-v1",
        **root,
        "title": "msaa-lint description",
        "$defs": {**root["$defs"], **dict(sorted(enums.items()))},
    }


def _with_enums(node: object, enums: dict[str, object]) -> object:
    """A schema with references to its enums, whose definitions it adds to `enums`."""
    if isinstance(node, list):
        return [_with_enums(item, enums) for item in node]
    if not isinstance(node, dict):
        return node
    if FLAGS in node:
        enum = node[FLAGS]
        enums[f"{enum}Flags"] = {"type": "string", "pattern": joined(enum)}
        return {"$ref": f"#/$defs/{enum}Flags"}
    if ENUMERANT in node:
        enum = node[ENUMERANT]
        # An editor completes the short names and accepts the others.
        short = VALUES[enum] if enum in VALUES else metal.ENUMS[enum]
        enums[enum] = {"anyOf": [{"enum": list(short)}, {"type": "string", "pattern": f"^{spellings(enum)}$"}]}
        return {"$ref": f"#/$defs/{enum}"}
    return {name: _with_enums(value, enums) for name, value in node.items()}


def spellings(enum: str) -> str:
    """A regular expression for the names of an enum that `vulkan.names.parse_enum`, or `metal.names.parse`, accepts."""
    if enum not in VALUES:
        return "(?:" + "|".join(map(re.escape, metal.spellings(enum))) + ")"
    flags, bitless = "FlagBits" in enum, BITLESS.get(enum, ())
    prefix = PREFIXES[enum].removeprefix("VK_") + ("(?:2_)?" if enum.endswith("2") else "")
    words = "|".join(_with_bit(name) if flags and name not in bitless else name for name in ENUMS[enum])
    return f"(?:(?:VK_)?{prefix})?(?:{words})"


def _with_bit(name: str) -> str:
    """A pattern for a flag bit's name with or without `_BIT`, which stands before a vendor's suffix."""
    head, _, vendor = name.rpartition("_")
    return f"{head}(?:_BIT)?_{vendor}" if head and vendor in VENDORS else f"{name}(?:_BIT)?"


def joined(enum: str) -> str:
    """A regular expression for the names of an enum joined by `|`, and for masks, that `vulkan.names.parse_flags` accepts."""
    if "FlagBits" not in enum:
        return f"^\\s*{_joined(spellings(enum))}\\s*$"
    mask = "(?:0|[1-9][0-9]*|0[xX][0-9a-fA-F]+)"
    several = _joined(f"(?:{spellings(enum)}|{mask})")
    return f"^\\s*(?:{several}|{mask}\\s*\\((?:\\s*{several})?\\s*\\))\\s*$"


def _joined(name: str) -> str:
    return f"{name}(?:\\s*\\|\\s*{name})*"

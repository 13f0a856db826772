"""`msaa-lint schema`: JSON Schemas."""

from __future__ import annotations

import os
import re

from msaa_lint.frame.vulkan.enums import BITLESS, ENUMS, PREFIXES, VALUES
from msaa_lint.frame.vulkan.names import VENDORS


def schema(which: str) -> int:
    """Prints the schema of the description format, or of the JSON that `check` (json-v1) or `cost` (cost-v1) prints."""
    import json

    if which == "description":
        print(json.dumps(description_schema(), indent=2))
    else:
        path = os.path.join(os.path.dirname(__file__), "report", f"{which.replace('-', '_')}.schema.json")
        with open(path, encoding="utf-8") as file:
            print(file.read(), end="")
    return 0


def description_schema() -> dict[str, object]:
    """The JSON Schema of a description, from the models."""
    from msaa_lint.frame.description.models import Description
    from msaa_lint.frame.description.pydantic_models import model_of

    enums: dict[str, object] = {}
    made = _spelled(model_of(Description).model_json_schema(), enums)
    assert isinstance(made, dict)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:msaa-lint:description-v1",
        **made,
        "title": "msaa-lint description",
        "$defs": {**made["$defs"], **dict(sorted(enums.items()))},
    }


def _spelled(node: object, enums: dict[str, object]) -> object:
    """A schema with references to the spellings of its enums, which it adds to `enums`."""
    from msaa_lint.frame.description.pydantic_models import ENUMERANT, FLAGS

    if isinstance(node, list):
        return [_spelled(item, enums) for item in node]
    if not isinstance(node, dict):
        return node
    if FLAGS in node:
        enum = node[FLAGS]
        enums[f"{enum}Flags"] = {"type": "string", "pattern": joined(enum)}
        return {"$ref": f"#/$defs/{enum}Flags"}
    if ENUMERANT in node:
        enum = node[ENUMERANT]
        # An editor completes the short names and takes the others.
        short = VALUES[enum] if enum in VALUES else of_metal(enum)
        enums[enum] = {"anyOf": [{"enum": list(short)}, {"type": "string", "pattern": f"^{spellings(enum)}$"}]}
        return {"$ref": f"#/$defs/{enum}"}
    return {name: _spelled(value, enums) for name, value in node.items()}


def spellings(enum: str) -> str:
    """A regular expression for the names of an enum as `names.parse_enum` takes them; of one of Metal's, as `metal.names.parse`."""
    if enum not in VALUES:
        return "(?:" + "|".join(re.escape(each) for each in of_metal(enum, every=True)) + ")"
    flags, bitless = "FlagBits" in enum, BITLESS.get(enum, ())
    prefix = PREFIXES[enum].removeprefix("VK_") + ("(?:2_)?" if enum.endswith("2") else "")
    words = "|".join(_with_bit(name) if flags and name not in bitless else name for name in ENUMS[enum])
    return f"(?:(?:VK_)?{prefix})?(?:{words})"


def of_metal(enum: str, every: bool = False) -> list[str]:
    """Swift's names of an enum of Metal's; `every` spelling of them."""
    from msaa_lint.frame.metal import names

    return names.spellings(enum) if every else list(names.ENUMS[enum])


def _with_bit(name: str) -> str:
    """A flag bit's name with `_BIT` where Vulkan has it, before a vendor's suffix, or without."""
    head, _, vendor = name.rpartition("_")
    return f"{head}(?:_BIT)?_{vendor}" if head and vendor in VENDORS else f"{name}(?:_BIT)?"


def joined(enum: str) -> str:
    """A regular expression for names of an enum joined by `|`, and for masks, as `names.parse_flags` takes them."""
    if "FlagBits" not in enum:
        return _list_of(spellings(enum), "^\\s*{}\\s*$")
    mask = "(?:0|[1-9][0-9]*|0[xX][0-9a-fA-F]+)"
    several = _list_of(f"(?:{spellings(enum)}|{mask})", "{}")
    return f"^\\s*(?:{several}|{mask}\\s*\\((?:\\s*{several})?\\s*\\))\\s*$"


def _list_of(one: str, form: str) -> str:
    return form.format(f"{one}(?:\\s*\\|\\s*{one})*")

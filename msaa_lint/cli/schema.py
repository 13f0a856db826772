"""`msaa-lint schema`: JSON Schemas."""

from __future__ import annotations

import os


def schema(which: str) -> int:
    """Prints the schema of the description format, or of the JSON output."""
    import json

    if which == "description":
        print(json.dumps(description_schema(), indent=2))
    else:
        path = os.path.join(os.path.dirname(os.path.dirname(__file__)), "report", "json_v1.schema.json")
        with open(path, encoding="utf-8") as file:
            print(file.read(), end="")
    return 0


def description_schema() -> dict[str, object]:
    """The JSON Schema of a description, from the models."""
    from ..document.models import Description

    made = without_null(Description.model_json_schema())
    assert isinstance(made, dict)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": "urn:msaa-lint:description-v1",
        **made,
        "title": "msaa-lint description",
    }


_NULLABLE = ("attachment", "depthStencilAttachment", "items", "additionalProperties")


def without_null(node: object, key: str = "") -> object:
    """A schema in which members may be absent but not null, which says nothing; items of lists and attachment slots may be null."""
    if isinstance(node, list):
        return [without_null(item, key) for item in node]
    if not isinstance(node, dict):
        return node
    out = {name: without_null(value, name) for name, value in node.items() if not (name == "default" and value is None)}
    arms = out.get("anyOf")
    if isinstance(arms, list) and key not in _NULLABLE and {"type": "null"} in arms:
        rest = [arm for arm in arms if arm != {"type": "null"}]
        del out["anyOf"]
        out = {**rest[0], **out} if len(rest) == 1 and isinstance(rest[0], dict) else {**out, "anyOf": rest}
    return out

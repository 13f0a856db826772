"""Labels of a finding that lie in another file of the same program."""

from __future__ import annotations

import json

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Label
from tests.cli.report.sample import finding, printed, result, span
from tests.cli.report.schemas import json_validator

PASS = "void create() {\n  attachment.samples = settings.samples;\n}\n"
SETTINGS = "struct Settings {\n  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;\n};\n"
LABEL = Label(span(SETTINGS, "VK_SAMPLE_COUNT_4_BIT"), "4 samples", "settings.h")
RESULT = result(
    finding(file="pass.cpp", span=span(PASS, "settings.samples"), labels=(LABEL,)),
    sources={"pass.cpp": Source("pass.cpp", PASS), "settings.h": Source("settings.h", SETTINGS)},
)


def test_text_shows_the_lines_of_both_files() -> None:
    lines = printed("full", RESULT).split("\n")
    at = lines.index(" ::: settings.h:2:35")
    assert any(line.startswith(" --> pass.cpp:2:24") for line in lines[:at])
    assert lines[at + 2].endswith("VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;")
    assert lines[at + 3].endswith("--------------------- 4 samples")
    assert sum("settings.samples;" in line for line in lines) == 1


def test_json_names_the_file_of_each_label() -> None:
    data = json.loads(printed("json", RESULT))
    json_validator().validate(data)
    assert data["findings"][0]["labels"] == [
        {
            "file": "settings.h",
            "line": 2,
            "column": 35,
            "end_line": 2,
            "end_column": 56,
            "text": "4 samples",
        }
    ]


def test_sarif_relates_the_other_file() -> None:
    (found,) = json.loads(printed("sarif", RESULT))["runs"][0]["results"]
    (related,) = found["relatedLocations"]
    assert related["physicalLocation"]["artifactLocation"]["uri"] == "settings.h"
    assert related["physicalLocation"]["region"]["startLine"] == 2
    assert found["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "pass.cpp"

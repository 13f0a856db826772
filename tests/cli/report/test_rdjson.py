import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from msaa_lint.core.finding import Fix
from msaa_lint.core.text.source import Origin, Source
from msaa_lint.core.text.span import Edit, Span
from tests.cli.report.hostile import TOKENS
from tests.cli.report.sample import finding, frame, printed, result
from tests.cli.report.schemas import rdjson_validator
from tests.command import run
from tests.paths import ROOT


def diagnostics(text: str) -> list[dict[str, Any]]:
    data = json.loads(text)
    rdjson_validator().validate(data)
    assert data["source"] == {"name": "msaa-lint"}
    found: list[dict[str, Any]] = data["diagnostics"]
    return found


def applied(text: str, suggestion: dict[str, Any]) -> str:
    """The text with a suggestion applied, as reviewdog does it: by lines, and by bytes of their
    UTF-8.
    """
    start, end = (suggestion["range"][key] for key in ("start", "end"))
    lines = [line.encode() for line in text.split("\n")]
    before, after = (
        lines[start["line"] - 1][: start["column"] - 1],
        lines[end["line"] - 1][end["column"] - 1 :],
    )
    changed = before + suggestion["text"].encode() + after
    return b"\n".join([*lines[: start["line"] - 1], changed, *lines[end["line"] :]]).decode()


def test_diagnostics() -> None:
    broken, stored, loaded, binary, unread = diagnostics(printed("rdjson", frame()))
    place = {"start": {"line": 9, "column": 18}, "end": {"line": 9, "column": 23}}
    assert stored == {
        "message": "multisampled attachment `color` is resolved and also stored\n"
        "cost: +2248 MB/s written, +31.6 MiB of memory, +225 mW\nhelp: set `storeOp: DONT_CARE`",
        "location": {"path": "passes/forward.yaml", "range": place},
        "severity": "WARNING",
        "code": {"value": "multisampled-attachment-stored"},
        "suggestions": [{"range": place, "text": "DONT_CARE"}],
    }
    assert (broken["severity"], binary["severity"]) == ("ERROR", "INFO")
    assert "suggestions" not in loaded  # its fix is unsafe
    assert binary["location"] == {"path": "trace.rdc"}
    assert (unread["code"]["value"], unread["location"]["path"], unread["severity"]) == (
        "unread-input",
        "src/render.cpp",
        "INFO",
    )


def test_clean_run_is_an_empty_list() -> None:
    assert diagnostics(printed("rdjson", result(files=("a.yaml",)))) == []


def test_the_schema_refuses_what_reviewdog_does() -> None:
    data = json.loads(printed("rdjson", frame()))
    data["diagnostics"][0]["severity"] = "NOTE"
    assert not rdjson_validator().is_valid(data)
    data["diagnostics"][0] |= {
        "severity": "INFO",
        "location": {"path": "a", "range": {"start": {"line": "1"}}},
    }
    with pytest.raises(jsonschema.ValidationError):
        rdjson_validator().validate(data)


def test_columns_are_bytes_of_utf_8() -> None:
    text = "é: 1\n日本: [\U0001f600, x, y]\n"
    spans = [Span(text.index(part), text.index(part) + 1) for part in "xy日"]
    run = result(*(finding(span=span) for span in (*spans, Span(0, len(text)))), text=text)
    ranges = [each["location"]["range"] for each in diagnostics(printed("rdjson", run))]
    lines = text.encode().split(b"\n")
    for place, part in zip(ranges, "xy日", strict=False):
        start, end = place["start"], place["end"]
        assert lines[start["line"] - 1][start["column"] - 1 : end["column"] - 1].decode() == part
    assert ranges[-1] == {"start": {"line": 1, "column": 1}, "end": {"line": 3, "column": 1}}


def test_all_edits_of_a_fix_are_one_suggestion() -> None:
    text = "a: é 1\nb: 2\nc: 3\n"
    one, two = (Span(text.index(part), text.index(part) + 1) for part in "13")
    fix = Fix("both", True, (Edit(two, "30"), Edit(one, "ü")))
    (found,) = diagnostics(printed("rdjson", result(finding(span=one, fix=fix), text=text)))
    (suggestion,) = found["suggestions"]
    assert applied(text, suggestion) == "a: é ü\nb: 2\nc: 30\n"


@pytest.mark.parametrize(
    "fix",
    [
        Fix("unsafe", False, (Edit(Span(0, 1), "x"),)),
        Fix("shown", True, (Edit(Span(0, 1), "x"),), shown=True),
        Fix("without edits", True),
        Fix("far apart", True, (Edit(Span(0, 1), "x"), Edit(Span(5000, 5001), "x"))),
    ],
    ids=lambda fix: fix.title,
)
def test_fixes_that_are_no_suggestions(fix: Fix) -> None:
    (found,) = diagnostics(
        printed("rdjson", result(finding(span=Span(0, 1), fix=fix), text="a\n" * 3000))
    )
    assert "suggestions" not in found


def test_a_line_of_a_capture_has_no_columns() -> None:
    source = Source("a.jsonl", "line\n", [Origin(7, 3, 1, "vkCmdDraw")])
    run = result(finding(file="a.jsonl", span=Span(0, 2)), sources={"a.jsonl": source})
    (found,) = diagnostics(printed("rdjson", run))
    assert found["location"] == {"path": "a.jsonl", "range": {"start": {"line": 7}}}


def test_suggestions_of_a_run_fix_the_file(tmp_path: Path) -> None:
    path = tmp_path / "frame.msaa.yaml"
    path.write_bytes(
        (ROOT / "examples" / "khronos-msaa" / "stored-and-resolved.msaa.yaml").read_bytes()
    )
    count = 0
    while found := diagnostics(run(tmp_path, "check", "--output", "rdjson", path.name).stdout):
        suggestion = next(each["suggestions"][0] for each in found if "suggestions" in each)
        path.write_text(applied(path.read_text(encoding="utf-8"), suggestion), encoding="utf-8")
        count += 1
    assert count >= 2


@pytest.mark.parametrize("token", TOKENS)
def test_any_text_is_json_of_ascii(token: str) -> None:
    fix = Fix(token, True, (Edit(Span(1, 2), token),))
    found = finding(token, file=token or "x", rule=token, help=token, span=Span(0, 1), fix=fix)
    text = printed("rdjson", result(found, text=f"a{token}b"))
    assert text.isascii() and "##[" not in text
    assert len(diagnostics(text)) == 1

"""No text of an input can act on a terminal, a log or a reader of a report."""

import json
import re
from itertools import pairwise
from unicodedata import category, east_asian_width
from xml.etree import ElementTree

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from msaa_lint.cli.report.escape import escape_surrogates
from msaa_lint.core.finding import Result
from msaa_lint.core.text.span import Label, Span
from msaa_lint.linter.settings.settings import OUTPUT_FORMATS
from tests.cli.report.hostile import TOKENS, results
from tests.cli.report.sample import finding, printed, result
from tests.cli.report.schemas import check_sarif, json_validator, rdjson_validator
from tests.strength import examples

TEXT_FORMATS = ("full", "concise", "github", "azure", "teamcity", "junit", "markdown")
COMMANDS = {"azure": r"##vso\[task\.logissue ", "teamcity": r"##teamcity\[inspection(Type)? "}
EVERYTHING = {
    "show_suppressed": True,
    "statistics": True,
    "edition": "2026.1",
    "explain_undecided": True,
}


@examples(0.8, suppress_health_check=[HealthCheck.too_slow])
@given(results(), st.integers(0, 80))
def test_text_outputs_are_harmless(run: Result, width: int) -> None:
    outputs = {name: printed(name, run, width=width, **EVERYTHING) for name in TEXT_FORMATS}
    for name, text in outputs.items():
        for line in text.split("\n"):
            assert line.isprintable(), line
            assert not re.search(
                r"##\w*\[", re.sub(f"\\A{COMMANDS[name]}", "", line) if name in COMMANDS else line
            )
            assert name == "github" or not line.lstrip().startswith("::"), line
    for name in ("full", "concise"):
        colored = printed(name, run, color=True, width=width, **EVERYTHING)
        assert re.sub("\x1b\\[[0-9;]*m", "", colored) == outputs[name]
    for line in outputs["full"].split("\n") if width else ():
        number = re.match(r" *\d+ \| ", line)
        assert not number or cells(line) <= max(width, 30 + number.end() + 6)
    github_prints_commands_alone(outputs["github"], run)
    junit_is_xml_with_a_case_for_each_finding(outputs["junit"], run)


def cells(line: str) -> int:
    return sum(
        0 if category(c) in ("Mn", "Me") else 2 if east_asian_width(c) in "WF" else 1 for c in line
    )


def github_prints_commands_alone(text: str, run: Result) -> None:
    lines = text.split("\n")
    assert lines.pop() == ""
    for line in lines:
        parts = re.fullmatch(r"::(?:error|warning|notice) (.*?)::(.*)", line)
        assert parts
        keys = [pair.split("=", 1)[0] for pair in parts[1].split(",")]
        assert keys in (
            ["file", "line", "endLine", "col", "endColumn", "title"],
            ["file", "line", "endLine", "title"],
            ["file", "title"],
        )
        assert all(re.match("(25|0A|3A|2C)", rest) for rest in parts[1].split("%")[1:])
        assert all(re.match("(25|0A)", rest) for rest in parts[2].split("%")[1:])
    assert len(lines) == len(run.findings) + sum(each.unread is not None for each in run.inputs)


def junit_is_xml_with_a_case_for_each_finding(text: str, run: Result) -> None:
    root = ElementTree.fromstring(text)
    clean = set(run.files) - {f.file for f in run.findings}
    assert (
        len(root.findall("./testsuite/testcase"))
        == len(run.findings) + len(clean)
        == int(root.attrib["tests"])
    )


@examples(0.6, suppress_health_check=[HealthCheck.too_slow])
@given(results())
def test_machine_outputs_parse(run: Result) -> None:
    outputs = {
        name: printed(name, run, **EVERYTHING) for name in ("json", "sarif", "gitlab", "rdjson")
    }
    for text in outputs.values():
        assert re.fullmatch(r"[\n -~]*", text) and not re.search(r"##\w*\[", text)
    data = json.loads(outputs["json"])
    json_validator().validate(data)
    assert [item["message"] for item in data["findings"]] == [
        escape_surrogates(f.message) for f in run.findings
    ]
    sarif = json.loads(outputs["sarif"])
    check_sarif(sarif)
    assert len(sarif["runs"][0]["results"]) == len(run.findings) + len(run.suppressed)
    diagnostics = json.loads(outputs["rdjson"])
    rdjson_validator().validate(diagnostics)
    assert len(diagnostics["diagnostics"]) >= len(run.findings)
    issues = json.loads(outputs["gitlab"])
    assert len({issue["fingerprint"] for issue in issues}) == len(run.findings)


@examples(0.3, suppress_health_check=[HealthCheck.too_slow])
@given(results())
def test_same_result_same_bytes(run: Result) -> None:
    for name in OUTPUT_FORMATS:
        assert printed(name, run, **EVERYTHING) == printed(name, run, **EVERYTHING)


@pytest.mark.parametrize("token", TOKENS)
@pytest.mark.parametrize("name", ("full", "concise"))
def test_no_text_adds_a_line(name: str, token: str) -> None:
    """A text that is all blank takes its lines away: those of the label, the note and the help."""

    def lines(text: str) -> int:
        found = finding(
            text,
            file=text,
            span=Span(2, 3),
            subject=text,
            labels=(Label(Span(0, 1), text),),
            notes=(text,),
            help=text,
        )
        return printed(name, result(found, text="a b")).count("\n")

    assert lines(token) == lines("plain") - (4 if name == "full" and not token.strip() else 0)


def test_a_line_of_64_mib_shows_a_window_of_it() -> None:
    text = '{"a":[' + '{"samples":4},' * (64 * 1024 * 1024 // 14) + "1]}"
    start = text.index("4", len(text) // 2)
    run = result(
        finding(span=Span(start, start + 1), labels=(Label(Span(0, len(text)), "all of it"),)),
        text=text,
    )
    for name in OUTPUT_FORMATS:
        # A page has its style and script.
        assert (
            len(printed(name, run)) - (len(printed(name, result())) if name == "html" else 0) < 4000
        )
    lines = printed("full", run, width=60).split("\n")
    source, carets = next((a, b) for a, b in pairwise(lines) if "^" in b)
    assert source[carets.index("^")] == "4"
    assert source.startswith("1 | ...") and source.endswith("...") and len(source) <= 60


def test_a_line_of_combining_marks_is_cut_too() -> None:
    run = result(finding(span=Span(500_000, 500_001)), text="e" + "\u0301" * 1_000_000)
    assert len(printed("full", run)) < 2000


def test_a_message_of_a_mebibyte_is_cut() -> None:
    long = "x" * (1 << 20)
    run = result(
        finding(
            long,
            subject=long,
            notes=(long,),
            help=long,
            labels=(Label(Span(0, 1), long),),
            span=Span(1, 2),
        ),
        text="abc",
    )
    for name in OUTPUT_FORMATS:
        assert len(printed(name, run)) < 8 * 4096 * 2

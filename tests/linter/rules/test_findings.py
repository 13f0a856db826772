"""What a rule's page makes of what it finds: its place, labels, texts, cases, and what it leaves
out.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from msaa_lint import lint
from msaa_lint.core.finding import Finding

FRAME = """\
images:
  color: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]}
  other: {format: R8G8B8A8_UNORM, samples: 2}
renderPasses:
  main:
    attachments:
      first: {image: color, loadOp: CLEAR, storeOp: STORE}
      second: {image: other, loadOp: LOAD, storeOp: DONT_CARE}
    subpasses:
      - {colorAttachments: [first]}
      - {colorAttachments: [second]}
"""


def page(folder: Path, front: str, code: str = "OWN101", name: str = "own-rule") -> Path:
    path = folder / f"{name}.md"
    stated = {"code": code, "severity": "warning", "subject": "attachment", "message": '"found"'}
    lines = [
        f"{key}: {value}"
        for key, value in stated.items()
        if not re.search(rf"^{key}:", front, re.MULTILINE)
    ]
    path.write_text("\n".join(["---", *lines, front, "---", "Summary.", ""]), encoding="utf-8")
    return path


def found(folder: Path, front: str, text: str = FRAME, code: str = "OWN101") -> list[Finding]:
    result = lint(text=text, rules=[str(page(folder, front))], select=[code], isolated=True)
    assert [each.message for each in result.findings if each.fatal] == []
    return [each for each in result.findings if each.code == code]


def meant(finding: Finding, text: str = FRAME) -> str:
    assert finding.span is not None
    return text[finding.span.start : finding.span.end]


def test_a_finding_stands_where_the_first_fact_of_its_condition_is_stated(tmp_path: Path) -> None:
    (one,) = found(
        tmp_path, 'when: attachment.samples == 4 && aspect.store == "STORE"\nsubject: aspect'
    )
    assert (meant(one), one.subject) == ("4", "renderPasses.main.attachments.first")


def test_at_names_another_place(tmp_path: Path) -> None:
    front = 'subject: aspect\nwhen: aspect.store == "STORE"\nat: [aspect.load, aspect.store]'
    (one,) = found(tmp_path, front)
    assert meant(one) == "CLEAR"


def test_labels_point_at_other_places_that_are_known(tmp_path: Path) -> None:
    front = """subject: aspect
when: aspect.store == "STORE"
at: aspect.store
labels:
  aspect.store: the place of the finding itself
  aspect.load: "loaded: {aspect.load}"
  attachment.samples: "{attachment.samples} samples"
  aspect.initial_layout: not stated"""
    (one,) = found(tmp_path, front)
    labels = [(FRAME[label.span.start : label.span.end], label.text) for label in one.labels]
    assert sorted(labels) == [("4", "4 samples"), ("CLEAR", "loaded: CLEAR")]


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("{attachment.samples}", "4"),
        ("{image.usage}", "COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT"),
        ("{frame.fps}", "unknown"),
        ("{attachment.samples} of {attachment.samples}", "4 of 4"),
        ("{image.transient}", "true"),
    ],
)
def test_facts_in_braces_are_filled_in(tmp_path: Path, text: str, shown: str) -> None:
    (one,) = found(
        tmp_path,
        f'subject: image\nwhen: image.samples == 4\nmessage: "{text}"'.replace(
            "attachment.", "image."
        ),
    )
    assert one.message == shown


@pytest.mark.parametrize(("fps", "shown"), [("60", "60"), ("59.94", "59.94"), ("30.0", "30")])
def test_numbers_are_written_without_needless_decimals(
    tmp_path: Path, fps: str, shown: str
) -> None:
    (one,) = found(
        tmp_path,
        'when: attachment.samples == 4\nmessage: "{frame.fps}"',
        f"frame: {{fps: {fps}}}\n{FRAME}",
    )
    assert one.message == shown


CASES = """when: attachment.samples > 1
message: plain
help: plain help
cases:
  - {when: attachment.samples == 4, severity: error, message: four}
  - {when: attachment.samples > 2, confidence: low, message: more}
  - {when: attachment.samples == 2, confidence: low, help: two help}"""


def test_the_first_case_that_holds_changes_what_it_states(tmp_path: Path) -> None:
    four, two = found(tmp_path, CASES)
    assert (four.severity, four.confidence, four.message, four.help) == (
        "error",
        "high",
        "four",
        "plain help",
    )
    assert (two.severity, two.confidence, two.message, two.help) == (
        "warning",
        "low",
        "plain",
        "two help",
    )


def test_a_severity_of_the_configuration_outweighs_the_case(tmp_path: Path) -> None:
    page(tmp_path, CASES)
    (tmp_path / "msaa-lint.toml").write_text(
        'rules = ["own-rule.md"]\n[severity]\nOWN101 = "note"\n', encoding="utf-8"
    )
    result = lint(text=FRAME, select=["OWN101"], config=str(tmp_path / "msaa-lint.toml"))
    assert [each.severity for each in result.findings] == ["note", "note"]


def test_a_superseded_rule_is_left_out_and_named_by_the_one_that_stays(tmp_path: Path) -> None:
    page(tmp_path, "when: attachment.samples > 1", "OWN102", "general")
    page(tmp_path, "when: attachment.samples == 4\nsupersedes: [general]", "OWN103", "special")
    rules = [str(tmp_path / name) for name in ("general.md", "special.md")]
    result = lint(text=FRAME, rules=rules, select=["OWN102", "OWN103"], isolated=True)
    assert [(each.code, each.subject.rpartition(".")[2]) for each in result.findings] == [
        ("OWN103", "first"),
        ("OWN102", "second"),
    ]
    assert [("OWN102" in note, "general" in note) for note in result.findings[0].notes] == [
        (True, True)
    ]
    assert result.findings[1].notes == ()


def test_an_error_of_arithmetic_is_of_the_page_and_the_other_rules_go_on(tmp_path: Path) -> None:
    page(tmp_path, "when: 9223372036854775807 + attachment.samples > 1", "OWN104", "overflows")
    page(tmp_path, "when: attachment.samples == 4", "OWN105", "works")
    rules = [str(tmp_path / name) for name in ("overflows.md", "works.md")]
    result = lint(text=FRAME, rules=rules, select=["OWN104", "OWN105"], isolated=True)
    assert [each.code for each in result.findings if each.fatal] == ["MSAA921"]
    (failed,) = [each for each in result.findings if each.fatal]
    assert "overflows" in failed.message and failed.file.endswith("overflows.md")
    source = result.sources[failed.file].text
    assert failed.span is not None
    assert source[failed.span.start : failed.span.end].startswith("9223372036854775807")
    assert [each.code for each in result.findings if not each.fatal] == ["OWN105"]


def test_what_two_subjects_share_is_found_once(tmp_path: Path) -> None:
    text = FRAME.replace("R8G8B8A8_UNORM, samples: 4", "D24_UNORM_S8_UINT, samples: 4").replace(
        "{colorAttachments: [first]}", "{depthStencilAttachment: first}"
    )
    assert (
        len(
            found(
                tmp_path,
                "subject: aspect\nwhen: attachment.samples == 4\nat: attachment.samples",
                text,
            )
        )
        == 1
    )


def test_a_fact_that_is_missing_leaves_the_rule_undecided(tmp_path: Path) -> None:
    front = 'subject: aspect\nwhen: aspect.initial_layout == "UNDEFINED"'
    result = lint(text=FRAME, rules=[str(page(tmp_path, front))], select=["OWN101"], isolated=True)
    assert result.findings == []
    assert {(each.code, each.missing) for each in result.undecided} == {
        ("OWN101", ("aspect.initial_layout",))
    }

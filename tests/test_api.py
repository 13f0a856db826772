"""`msaa_lint.lint`, the whole Python interface."""

from __future__ import annotations

import os
import sys
import threading
from pathlib import Path

import pytest

import msaa_lint
from msaa_lint import lint
from msaa_lint.core.finding import Finding, Result

BAD = """\
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [LAZILY_ALLOCATED]}
  out: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
renderPasses:
  main:
    attachments:
      color: {image: ms, loadOp: CLEAR, storeOp: DONT_CARE}
      output: {image: out, loadOp: DONT_CARE, storeOp: DONT_CARE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output]}
"""
RULE = "resolve-target-not-stored"


def place(result: Result, found: Finding) -> tuple[int, int, str]:
    source = result.sources[found.file]
    assert found.span is not None
    position = source.position(found.span.start)
    return position.line, position.column, source.text[found.span.start : found.span.end]


def test_a_text() -> None:
    result = lint(text=BAD)
    (found,) = result.findings
    assert (found.code, found.rule, found.severity, found.confidence) == (
        "MSAA206",
        RULE,
        "error",
        "high",
    )
    assert (found.file, found.subject) == ("<text>", "renderPasses.main.attachments.output")
    assert place(result, found) == (8, 56, "DONT_CARE")
    assert list(result.files) == ["<text>"]
    assert not found.fatal
    assert {rule.code for rule in result.rules} >= {"MSAA201", "MSAA206"}
    assert all(rule.summary for rule in result.rules)


def test_bytes_are_decoded_as_files_are() -> None:
    for encoding in ("utf-8", "utf-8-sig", "utf-16"):
        assert [found.rule for found in lint(text=BAD.encode(encoding)).findings] == [RULE]
    (found,) = lint(text=b"\xff\xfe\xff").findings
    assert (found.code, found.span) == ("MSAA901", None)
    assert found.fatal


def test_a_text_that_no_encoding_has_is_a_finding() -> None:
    assert {found.code for found in lint(text="images: {'\ud800': {}}").findings} == {"MSAA901"}


def test_files_and_folders(tmp_path: Path) -> None:
    (tmp_path / "b.msaa.yaml").write_text(BAD, encoding="utf-8")
    (tmp_path / "a.msaa.yaml").write_text(BAD, encoding="utf-8")
    result = lint(str(tmp_path))
    assert [(Path(found.file).name, found.rule) for found in result.findings] == [
        ("a.msaa.yaml", RULE),
        ("b.msaa.yaml", RULE),
    ]
    both = lint(
        str(tmp_path / "b.msaa.yaml"),
        str(tmp_path / "b.msaa.yaml"),
        text=BAD,
        filename="third.yaml",
    )
    assert [Path(file).name for file in both.files] == ["b.msaa.yaml", "third.yaml"]


def test_options() -> None:
    assert lint(text=BAD, ignore=[RULE]).findings == []
    assert lint(text=BAD, select=["MSAA4"]).findings == []
    assert [found.rule for found in lint(text=BAD, select=[RULE]).findings] == [RULE]
    extended = lint(
        text=BAD.replace("samples: 4", "samples: 16"),
        select=[],
        extend_select=["sixteen-samples-biased"],
    )
    assert {found.rule for found in extended.findings} <= {"sixteen-samples-biased"}
    assert [
        found.code for found in lint(text=BAD, select=["nonsense"]).findings if found.fatal
    ] == ["MSAA921"]
    assert [found.code for found in lint(text=BAD, edition="1066.1").findings if found.fatal] == [
        "MSAA921"
    ]
    assert [
        found.code for found in lint(text=BAD, profile="no-such-phone").findings if found.fatal
    ] == ["MSAA921"]
    assert [
        found.code for found in lint(text=BAD, rules=["no/such/page.md"]).findings if found.fatal
    ] == ["MSAA921"]


def test_a_profile_stands_in_for_a_device() -> None:
    text = (
        "images: {a: {format: R8G8B8A8_UNORM, samples: 8, usage: [COLOR_ATTACHMENT, "
        "TRANSIENT_ATTACHMENT], memory: [LAZILY_ALLOCATED]}}"
    )
    unknown = {found.rule for found in lint(text=text).findings}
    phone = {found.rule for found in lint(text=text, profile="mali-g76").findings}
    assert "sample-count-not-portable" in unknown
    assert "sample-count-not-portable" not in phone


def test_a_configuration(tmp_path: Path) -> None:
    (tmp_path / "frame.yaml").write_text(BAD, encoding="utf-8")
    (tmp_path / "msaa-lint.toml").write_text(f'[severity]\n{RULE} = "note"\n', encoding="utf-8")
    assert [found.severity for found in lint(str(tmp_path)).findings] == ["note"]
    assert [found.severity for found in lint(str(tmp_path), isolated=True).findings] == ["error"]
    other = tmp_path / "other.toml"
    other.write_text(f'ignore = ["{RULE}"]\n', encoding="utf-8")
    assert lint(str(tmp_path), config=str(other)).findings == []
    assert [
        found.code
        for found in lint(str(tmp_path), config=str(tmp_path / "none.toml")).findings
        if found.fatal
    ] == ["MSAA921"]


def test_suppressions_are_told_apart() -> None:
    text = BAD.replace(
        "storeOp: DONT_CARE}\n    sub",
        f"storeOp: DONT_CARE}} # msaa-lint: ignore[{RULE}] a test\n    sub",
    )
    result = lint(text=text)
    assert result.findings == []
    assert [(each.finding.rule, each.how, each.reason) for each in result.suppressed] == [
        (RULE, "inline", "a test")
    ]


def test_undecided_rules_say_what_they_lack() -> None:
    result = lint(text="images: {a: {format: R8_UNORM}}", select=["sample-count-above-four"])
    assert [(each.rule, each.subject) for each in result.undecided] == [
        ("sample-count-above-four", "images.a")
    ]
    assert "image.samples" in result.undecided[0].missing


def test_nothing_raises_for_what_an_input_holds(tmp_path: Path) -> None:
    for given in (
        "",
        "# comment",
        "[",
        "null",
        "a: b: c",
        "\x00",
        "- " * 500,
        "&a [*a]",
        "{" * 10_000,
        "images: " + "[" * 99,
    ):
        result = lint(text=given, isolated=True)
        assert [found for found in result.findings if found.fatal], given[:20]
    for path in ("missing.yaml", "", "a\x00b", str(tmp_path), "x" * 5000):
        assert [found for found in lint(path, isolated=True).findings if found.fatal], path[:20]


def test_no_paths_and_no_text() -> None:
    assert lint(isolated=True).findings == []


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_a_named_pipe_is_no_input_that_is_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.yaml")
    done: list[Result] = []
    thread = threading.Thread(
        target=lambda: done.append(lint(str(tmp_path), isolated=True)), daemon=True
    )
    thread.start()
    thread.join(10)
    assert done, "a folder with a pipe in it is linted without waiting for the pipe"
    assert [found.code for found in done[0].findings] == ["MSAA921"]


def test_the_interface_is_what_is_listed() -> None:
    assert msaa_lint.__all__ == ["__version__", "lint"]
    assert "pydantic" not in sys.modules or lint(text=BAD).findings


def test_runs_are_alike() -> None:
    assert lint(text=BAD).findings == lint(text=BAD).findings


def test_a_configuration_is_read_anew_by_every_run(tmp_path: Path) -> None:
    frame, configuration = tmp_path / "frame.yaml", tmp_path / "msaa-lint.toml"
    frame.write_text(BAD, encoding="utf-8")
    configuration.write_text(f'ignore = ["{RULE}"]\n', encoding="utf-8")
    assert lint(str(frame)).findings == []
    configuration.write_text(f'[severity]\n{RULE} = "note"\n', encoding="utf-8")
    assert [found.severity for found in lint(str(frame)).findings] == ["note"]
    configuration.unlink()
    assert [found.severity for found in lint(str(frame)).findings] == ["error"]
    (tmp_path / "other.toml").write_text(f'ignore = ["{RULE}"]\n', encoding="utf-8")
    assert lint(str(frame), config=str(tmp_path / "other.toml")).findings == []
    (tmp_path / "other.toml").unlink()
    assert [
        found.code for found in lint(str(frame), config=str(tmp_path / "other.toml")).findings
    ] == ["MSAA921", "MSAA206"]


@pytest.mark.parametrize("mark", ["msaalint", "msaa_lint", "msaa lint", "MSAALint"])
def test_a_misspelled_suppression_is_reported_wherever_it_is(mark: str) -> None:
    text = BAD.replace(
        "storeOp: DONT_CARE}\n    sub", f"storeOp: DONT_CARE}} # {mark}: ignore[{RULE}]\n    sub"
    )
    assert [found.code for found in lint(text=text).findings] == ["MSAA206", "MSAA913"]

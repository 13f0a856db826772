from pathlib import Path

import pytest

from msaa_lint.cli.report import github
from msaa_lint.core.finding import Fix, Price
from msaa_lint.core.text.span import Span
from tests.cli.report.sample import finding, frame, printed, result
from tests.command import run
from tests.paths import ROOT


def test_worst_first_and_one_command_each() -> None:
    lines = printed("github", frame()).splitlines()
    assert [line.split(" ")[0] for line in lines] == [
        "::error",
        "::error",
        "::warning",
        "::notice",
        "::notice",
    ]
    assert lines[2] == (
        "::warning "
        "file=passes/forward.yaml,line=9,endLine=9,col=18,endColumn=23,title=multisampled-attachment-stored (MSAA201)"
        "::multisampled attachment `color` is resolved and also stored%0Acost: +2248 MB/s written, "
        "+31.6 MiB of memory, +225 mW"
        "%0Ahelp: set `storeOp: DONT_CARE`"
    )
    assert lines[3] == "::notice file=trace.rdc,title=sample-count-above-four (MSAA101)::8 samples"
    assert (
        lines[4]
        == "::notice file=src/render.cpp,line=2,endLine=2,col=8,endColumn=23,title=unread-input "
        "(MSAA931)::`samples = count` is in no pass"
    )


@pytest.mark.parametrize("name", ["github", "gitlab", "azure", "teamcity", "rdjson", "junit"])
def test_check_prints_the_price_of_a_finding(name: str, tmp_path: Path) -> None:
    example = str(ROOT / "examples" / "khronos-msaa" / "color-separate.msaa.yaml")
    done = run(
        tmp_path,
        "check",
        "--output",
        name,
        example,
        GITHUB_STEP_SUMMARY=str(tmp_path / "summary.md"),
    )
    assert "+2248 MB/s written, +2248 MB/s read, " in done.stdout
    if name == "github":
        summary = (tmp_path / "summary.md").read_text()
        assert (
            "+2248 MB/s written, +2248 MB/s read, " in summary
            and "1 fixable with --fix --unsafe-fixes: saves " in summary
        )


def test_nothing_found_prints_nothing() -> None:
    assert printed("github", result(files=("a.yaml",))) == ""


def test_escapes() -> None:
    line = printed(
        "github",
        result(
            finding(
                "100% a:b,c\n\r::error::x", file="a,b:c%.yaml", rule="r:,", fix=Fix("50%", True)
            )
        ),
    )
    assert line == (
        "::warning file=a%2Cb%3Ac%25.yaml,title=r%3A%2C (MSAA201)::100%25 "
        "a:b,c\\n\\r::error::x%0Ahelp: 50%25\n"
    )


@pytest.mark.parametrize(
    ("text", "start", "end", "expected"),
    [
        ("a: b\nc: d\n", 3, 4, "line=1,endLine=1,col=4,endColumn=5,"),
        ("a: b\nc: d\n", 0, 9, "line=1,endLine=2,"),
        ("a: b\nc: d\n", 5, 10, "line=2,endLine=2,col=1,endColumn=5,"),
        ("a: b\nc: d\n\n\n", 0, 12, "line=1,endLine=2,"),
        ("a: b\n\n\n", 6, 7, "line=1,endLine=1,col=5,endColumn=5,"),
        ("a: b\n", 5, 5, "line=1,endLine=1,col=5,endColumn=5,"),
        ("a: b\r\n", 6, 99, "line=1,endLine=1,col=5,endColumn=5,"),
        ("", 0, 0, "line=1,endLine=1,col=1,endColumn=1,"),
        ("\n\n", 1, 1, "line=1,endLine=1,col=1,endColumn=1,"),
        ("日本: x", 4, 5, "line=1,endLine=1,col=5,endColumn=6,"),
    ],
)
def test_region_ends_at_the_last_line_with_text(
    text: str, start: int, end: int, expected: str
) -> None:
    line = printed("github", result(finding(span=Span(start, end)), text=text))
    assert line.startswith(f"::warning file=frame.yaml,{expected}title=")


def test_ten_of_a_level_and_a_count_of_the_rest(tmp_path: Path) -> None:
    many = [
        finding(f"{severity} {n}", severity=severity)
        for n in range(12)
        for severity in ("note", "warning", "error")
    ]
    lines = printed("github", result(*many)).splitlines()
    assert [line.split(" ")[0] for line in lines] == ["::error"] * 10 + ["::warning"] * 10 + [
        "::notice"
    ] * 10
    assert (
        lines[-1]
        == "::notice title=msaa-lint::7 more findings, GitHub shows at most ten per level and step"
    )
    summary = tmp_path / "summary.md"
    lines = printed("github", result(*many), step_summary=str(summary)).splitlines()
    assert lines[-1] == "::notice title=msaa-lint::7 more findings, see the summary of this step"
    assert summary.read_text().count("\n| error |") == 12


def test_the_most_expensive_of_a_level_are_among_the_ten() -> None:
    many = [
        finding(str(n), price=Price(0.0, 0.0, float(n % 2), float(n // 2))) for n in range(24)
    ] + [
        finding("none"),
        finding("error", severity="error"),
    ]
    lines = printed("github", result(*many)).splitlines()
    assert [line.rpartition("::")[2].partition("%0A")[0] for line in lines[:-1]] == [
        "error",
        *map(str, range(23, 13, -1)),
    ]


def test_ten_of_each_level_need_no_count() -> None:
    many = [
        finding(severity=severity) for _ in range(10) for severity in ("note", "warning", "error")
    ]
    assert len(printed("github", result(*many)).splitlines()) == 30


def test_summary_is_appended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    summary = tmp_path / "summary.md"
    summary.write_text("before\n")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(summary))
    printed("github", frame(), step_summary=None)
    text = summary.read_text()
    assert text.startswith(
        "before\n### msaa-lint\n\nFound 4 findings &#40;2 errors, 1 warning, 1 note&#41; in 3 of 5 "
        "files "
    )
    assert (
        "\n| error | resolve-target-loaded | passes/forward.yaml:10:60 | resolve target is loaded "
        "| +562 MB/s read, +5.62 mW |\n" in text
    )
    printed("github", frame(), step_summary="")
    assert summary.read_text() == text


def test_summary_of_a_clean_run(tmp_path: Path) -> None:
    printed("github", result(files=("a.yaml",)), step_summary=str(tmp_path / "s"))
    assert (tmp_path / "s").read_text() == "### msaa-lint\n\nNo findings in 1 file\n\n\n"


def test_summary_stays_below_what_github_drops(tmp_path: Path) -> None:
    summary = tmp_path / "summary.md"
    summary.write_bytes(b"x" * 500_000)
    many = result(*(finding("é" * 1000) for _ in range(1000)))
    printed("github", many, step_summary=str(summary))
    size = summary.stat().st_size
    assert github.MAX_SUMMARY_BYTES - 3000 < size <= github.MAX_SUMMARY_BYTES
    assert summary.read_text().rstrip().endswith("more findings not shown.")
    summary.write_bytes(b"x" * (github.MAX_SUMMARY_BYTES - 50))
    lines = printed("github", many, step_summary=str(summary)).splitlines()
    assert summary.stat().st_size == github.MAX_SUMMARY_BYTES - 50
    assert (
        lines[-1] == "::warning title=msaa-lint::cannot write the summary of this step: it is full"
    )


def test_summary_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    lines = printed("github", result(finding()), step_summary=str(tmp_path)).splitlines()
    assert len(lines) == 2
    assert lines[1].startswith("::warning title=msaa-lint::cannot write the summary of this step: ")


def test_places_are_relative_to_the_root() -> None:
    assert "file=%3A%3Ax.yaml," in printed("github", result(finding(file="./::x.yaml")))
    assert "file=a/b.yaml," in printed(
        "github", result(finding(file="/work/a/b.yaml")), root="/work"
    )

"""The full and the concise output, the summary, the statistics."""

import pytest

from msaa_lint.cli.report import Options, render
from msaa_lint.cli.report.statistics import table
from msaa_lint.core.finding import Fix, Price, Undecided
from msaa_lint.core.text.span import Edit, Label, Span
from tests.cli.report.sample import finding, frame, printed, result, span

TEXT = "a: 4\nb: STORE\n"


def test_concise_is_one_line_a_finding_and_a_summary() -> None:
    run = result(
        finding("too much", span=span(TEXT, "STORE")), finding("what", severity="note", file="b.rdc", subject="images.a"), text=TEXT
    )
    run = run._replace(sources={"frame.yaml": run.sources["frame.yaml"]})
    assert printed("concise", run) == (
        "frame.yaml:2:4: warning[multisampled-attachment-stored] too much (MSAA201)\n"
        "b.rdc: images.a: note[multisampled-attachment-stored] what (MSAA201)\n"
        "Found 2 findings (1 warning, 1 note) in 2 files\n"
    )


def test_nothing_found() -> None:
    run = result(files=("a.yaml", "b.yaml"))
    assert printed("full", run) == printed("concise", run) == "No findings in 2 files\n"
    assert printed("concise", result(files=("a.yaml",))) == "No findings in 1 file\n"


def test_summary_names_the_missing_facts_most_lacked_first() -> None:
    undecided = (
        Undecided("MSAA401", "a", "f", "x", ("image.usage",)),
        Undecided("MSAA401", "a", "f", "y", ("image.usage",)),
        Undecided("MSAA402", "b", "f", "x", ("image.memory", "device.name")),
        Undecided("MSAA403", "c", "f", "x", ("image.memory",)),
    )
    run = result(files=("f",), undecided=undecided)
    assert printed("concise", run) == (
        "No findings in 1 file\n3 rules undecided, missing facts: image.memory (2), device.name (1), image.usage (1)\n"
    )
    assert printed("concise", run, max_undecided=1) == (
        "No findings in 1 file\n3 rules undecided, missing facts: image.memory (2), and 2 more\n"
    )


@pytest.mark.parametrize(
    ("safe", "expected"),
    [
        ((), ""),
        ((True,), "1 fixable with --fix\n"),
        ((False, False), "2 fixable with --fix --unsafe-fixes\n"),
        ((True, False), "2 fixable: 1 with --fix, 1 more with --unsafe-fixes\n"),
    ],
)
def test_summary_counts_fixes_that_have_edits(safe: tuple[bool, ...], expected: str) -> None:
    stated = finding(fix=Fix("rewrite it", True))
    run = result(stated, *(finding(fix=Fix("mend", one, (Edit(Span(0, 1), "x"),))) for one in safe))
    assert "".join(printed("concise", run).splitlines(keepends=True)[len(safe) + 2 :]) == expected


def remarks(**values: object) -> list[str]:
    text = printed("full", result(finding(**values), rules=()))
    return [line[4:] for line in text.split("\n") if line.startswith("  = ")][1:]


def test_price_shows_what_there_is_of_it() -> None:
    assert remarks(price=Price(1.5, 2248.12, 0.0, 0.25)) == ["cost: +2248 MB/s written, +1.5 MB/s read, +0.25 mW"]
    assert remarks(price=Price(-12.0, 0.0, 31.64, 0.0)) == ["cost: -12 MB/s read, +31.6 MiB of memory"]
    assert remarks(price=Price(123456789.0, 0.0, 0.0, 0.0)) == ["cost: +1.23e+08 MB/s read"]
    for out_of_range in (float("inf"), float("-inf"), float("nan")):
        assert remarks(price=Price(1.0, out_of_range, 1.0, 1.0)) == []
    assert remarks(price=Price(0.0, 0.0, 0.0, 0.0)) == []


def test_help_and_fix() -> None:
    edits = (Edit(Span(0, 1), "x"),)
    assert remarks(help="write less") == ["help: write less"]
    assert remarks(fix=Fix("do it", True)) == ["help: do it"]
    assert remarks(fix=Fix("do it", True, edits)) == ["help: do it (safe: --fix)"]
    assert remarks(fix=Fix("do it", False, edits)) == ["help: do it (unsafe: --fix --unsafe-fixes)"]
    assert remarks(help="do it", fix=Fix("do it", True, edits)) == ["help: do it (safe: --fix)"]
    assert remarks(help="why", fix=Fix("do it", False, (), True)) == ["help: why", "fix: do it (not applied automatically)"]
    assert remarks(help="why", fix=Fix("do it", True, edits)) == ["help: why", "fix: do it (safe: --fix)"]


def test_docs_are_named_for_rules_that_have_a_page() -> None:
    assert "= docs: msaa-lint rule multisampled-attachment-stored" in printed("full", result(finding()))
    assert "= docs" not in printed("full", result(finding(rule="syntax")))


def test_label_at_the_place_of_the_finding_is_what_the_carets_say() -> None:
    place = span(TEXT, "STORE")
    run = result(finding(span=place, labels=(Label(place, "one"), Label(place, "two"))), text=TEXT)
    assert "2 | b: STORE\n  |    ^^^^^ one; two\n" in printed("full", run)


def test_places_that_are_not_drawn_are_counted() -> None:
    text = "k\n" * 50
    labels = tuple(Label(Span(2 * n, 2 * n + 1), "") for n in range(40))
    run = result(finding(span=Span(98, 99), labels=labels), text=text)
    assert "= note: 11 more places are not shown\n" in printed("full", run)


def test_suppressed_are_shown_when_asked_for() -> None:
    assert "suppressed:" not in printed("concise", frame())
    text = printed("concise", frame(), show_suppressed=True)
    assert "resolve target is loaded (MSAA101) [suppressed: inline, measured on the device]\n" in text
    assert "8 samples (MSAA101) [suppressed: baseline]\n" in text


def test_statistics_are_sorted_by_count_then_severity() -> None:
    run = result(
        finding(severity="note"),
        finding(severity="note"),
        finding(),
        finding(code="MSAA1", rule="x", severity="error"),
        *(finding(code="MSAA9", rule="y") for _ in range(10)),
    )
    assert table(run).split("\n") == [
        "count  code     rule                            severity",
        "   10  MSAA9    y                               warning",
        "    2  MSAA201  multisampled-attachment-stored  note",
        "    1  MSAA1    x                               error",
        "    1  MSAA201  multisampled-attachment-stored  warning",
        "",
    ]
    assert table(run) in printed("concise", run, statistics=True)
    assert table(result()) == ""


def test_statistics_add_up_prices_and_say_what_all_cost_together() -> None:
    stored = finding(price=Price(0.0, 2247.78, 31.6, 224.8))
    run = result(stored, stored._replace(message="other"), finding(code="MSAA1", rule="x"))
    run = run._replace(together={"frame.yaml": Price(100.0, 2247.78, 31.6, 234.8)})
    assert table(run).split("\n") == [
        "count  code     rule                            severity    MB/s   MiB     mW",
        "    2  MSAA201  multisampled-attachment-stored  warning   4495.6  63.2  449.6",
        "    1  MSAA1    x                               warning",
        "                together                                  2347.8  31.6  234.8",
        "",
    ]


def test_summary_says_what_the_findings_of_all_files_cost_together() -> None:
    one, other = Price(0.0, 2247.78, 0.0, 224.8), Price(1.0, 0.0, 31.6, 0.1)
    run = result(finding(), files=("a", "b"), together={"a": one, "b": other})
    assert "Fixing it saves 2248 MB/s written, 1 MB/s read, 31.6 MiB of memory, 225 mW\n" in printed("concise", run)
    assert "saves" not in printed("concise", result(finding(), together={"a": Price(0.0, 0.0, 0.0, 0.0)}))
    assert "saves" not in printed("concise", result(finding(), together={"a": Price(float("inf"), 0.0, 0.0, 0.0)}))


def test_unknown_output_is_refused() -> None:
    with pytest.raises(ValueError, match="unknown output format 'yaml': use one of full, concise, json,"):
        render("yaml", result(), print, Options())

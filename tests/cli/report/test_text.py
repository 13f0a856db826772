"""The full and the concise output, the summary, the statistics."""

import re

import pytest

from msaa_lint.cli.report import Options, render, statistics
from msaa_lint.core.finding import Fix, MissingKey, Price, Result, Saving, Savings, Undecided
from msaa_lint.core.text.span import Edit, Label, Span
from tests.cli.report.sample import finding, frame, printed, result, span

TEXT = "a: 4\nb: STORE\n"


def table(run: Result, width: int = 140) -> str:
    """The table of `--statistics`."""
    parts: list[str] = []
    statistics.render(run, parts.append, Options(width=width))
    return "".join(parts)


def test_concise_is_one_line_a_finding_and_a_summary() -> None:
    run = result(
        finding("too much", span=span(TEXT, "STORE")),
        finding("what", severity="note", file="b.rdc", subject="images.a"),
        text=TEXT,
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


def key(structure: str, name: str) -> MissingKey:
    return MissingKey(structure, name, "a list", Span(0, 1))


def test_summary_names_the_missing_keys_most_lacked_first() -> None:
    undecided = (
        Undecided("MSAA401", "a", "f", "x", ("image.usage",), (key("images.x", "usage"),)),
        Undecided("MSAA401", "a", "f", "y", ("image.usage",), (key("images.y", "usage"),)),
        Undecided(
            "MSAA402",
            "b",
            "f",
            "x",
            ("image.memory", "device.name"),
            (key("images.x", "memory"), key("", "device")),
        ),
        Undecided("MSAA403", "c", "f", "x", ("image.memory",), (key("images.x", "memory"),)),
        Undecided("MSAA403", "c", "f", "x", ("aspect.store_wasted",)),
    )
    run = result(files=("f",), undecided=undecided)
    assert printed("concise", run) == (
        "No findings in 1 file\n"
        "3 rules undecided, missing keys: images.*.memory (2), device (1), images.*.usage (1); "
        "--explain-undecided lists what to add\n"
    )
    assert printed("concise", run, max_undecided=1) == (
        "No findings in 1 file\n3 rules undecided, missing keys: images.*.memory (2), and 2 more; "
        "--explain-undecided lists what to add\n"
    )


@pytest.mark.parametrize(
    ("safe", "everything", "expected"),
    [
        (0, 0, ""),
        (1, 1, "1 fixable with --fix\n"),
        (0, 2, "2 fixable with --fix --unsafe-fixes\n"),
        (1, 2, "1 fixable with --fix\n2 fixable with --fix --unsafe-fixes\n"),
    ],
)
def test_summary_counts_the_findings_that_fixes_remove(
    safe: int, everything: int, expected: str
) -> None:
    fixable = finding(fix=Fix("mend", True, (Edit(Span(0, 1), "x"),)))
    run = result(
        fixable, fixable, savings={"frame.yaml": Savings(Saving(safe), Saving(everything))}
    )
    assert "".join(printed("concise", run).splitlines(keepends=True)[3:]) == expected


def test_summary_tells_descriptions_of_captures_from_files() -> None:
    run = result(
        finding(),
        savings={
            "a.jsonl": Savings(Saving(1, Price(0.0, 100.0, 0.0, 10.0)), Saving(1, None), True)
        },
    )
    (line,) = printed("concise", run).splitlines()[2:]
    assert (
        line
        == "1 fixable in the description that `msaa-lint convert` writes, with --fix: saves 100 "
        "MB/s written, 10 mW"
    )


def test_a_choice_has_a_price_of_its_own_outside_of_every_sum() -> None:
    choice = Fix("clear it", False, shown=True, choice=True)
    (price, fix) = remarks(fix=choice, price=Price(622.1, 0.0, 0.0, 62.2))
    assert (price, fix) == (
        "price: if chosen: -622 MB/s read, -62.2 mW",
        "help: clear it (a choice: not applied)",
    )
    run = result(finding(fix=choice, price=Price(622.1, 0.0, 0.0, 62.2)))
    assert "MB/s" not in table(run)
    assert "if chosen: -622 MB/s read" in printed("markdown", run)


def test_a_refused_fix_says_why() -> None:
    refused = Fix(
        "resolve in the pass", False, (Edit(Span(0, 1), "x"),), refusal="it overlaps another fix"
    )
    assert remarks(fix=refused) == ["help: resolve in the pass (not made: it overlaps another fix)"]


def remarks(**values: object) -> list[str]:
    text = printed("full", result(finding(**values), rules=()))
    return [line[4:] for line in text.split("\n") if line.startswith("  = ")][1:]


def test_price_shows_what_there_is_of_it() -> None:
    assert remarks(price=Price(1.5, 2248.12, 0.0, 0.25)) == [
        "cost: +2248 MB/s written, +1.5 MB/s read, +0.25 mW"
    ]
    assert remarks(price=Price(-12.0, 0.0, 31.64, 0.0)) == [
        "cost: -12 MB/s read, +31.6 MiB of memory"
    ]
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
    assert remarks(help="why", fix=Fix("do it", False, (), True)) == [
        "help: why",
        "fix: do it (not applied automatically)",
    ]
    assert remarks(help="why", fix=Fix("do it", True, edits)) == [
        "help: why",
        "fix: do it (safe: --fix)",
    ]


def test_docs_are_named_for_rules_that_have_a_page() -> None:
    assert "= docs: msaa-lint rule multisampled-attachment-stored" in printed(
        "full", result(finding())
    )
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
    assert (
        "resolve target is loaded (MSAA101) [suppressed: inline, measured on the device]\n" in text
    )
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


def test_statistics_fit_80_columns() -> None:
    name = "depth-resolve-mode-against-depth-direction-and-more"
    price = Price(0.0, 12345678.9, 1234.5, 123456.7)
    run = result(finding(rule=name, price=price, fix=Fix("x", True, (Edit(Span(0, 1), "5"),))))
    lines = table(run, 80).splitlines()
    assert max(map(len, lines)) <= 80
    assert lines[1].split()[-3:] == ["12345678.9", "1234.5", "123456.7"]
    assert "".join(re.findall("[a-z]+-[-a-z]+", " ".join(lines))) == name
    assert len(table(run, 200).splitlines()) == 2


def test_statistics_add_up_prices_and_say_what_fixes_save() -> None:
    stored = finding(price=Price(0.0, 2247.78, 31.6, 224.8), fix=Fix("fix it", True))
    run = result(stored, stored._replace(message="other"), finding(code="MSAA1", rule="x"))
    safe, everything = (
        Saving(1, Price(0.0, 2247.78, 31.6, 224.8)),
        Saving(3, Price(100.0, 2247.78, 31.6, 234.8)),
    )
    run = run._replace(
        savings={"frame.yaml": Savings(safe, everything), "a.jsonl": Savings(Saving(), safe, True)}
    )
    assert table(run).split("\n") == [
        "count  code     rule                            severity    MB/s   MiB     mW",
        "    2  MSAA201  multisampled-attachment-stored  warning   4495.6  63.2  449.6",
        "    1  MSAA1    x                               warning",
        "    1           saved by --fix                            2247.8  31.6  224.8",
        "    3           saved by --unsafe-fixes                   2347.8  31.6  234.8",
        "    1           converted, by --unsafe-fixes              2247.8  31.6  224.8",
        "",
    ]


def test_summary_says_what_fixes_of_all_files_save() -> None:
    def saved(*prices: Price) -> str:
        savings = {
            str(number): Savings(Saving(1, price), Saving(1, price))
            for number, price in enumerate(prices)
        }
        return printed("concise", result(finding(), savings=savings))

    both = saved(Price(0.0, 2247.78, 0.0, 224.8), Price(1.0, 0.0, 31.6, 0.1))
    assert (
        "2 fixable with --fix: saves 2248 MB/s written, 1 MB/s read, 31.6 MiB of memory, 225 mW\n"
        in both
    )
    assert "saves 1 MB/s read; adds 31.6 MiB of memory\n" in saved(Price(1.0, 0.0, -31.6, 0.0))
    assert "saves" not in saved(Price(0.0, 0.0, 0.0, 0.0)) + saved(
        Price(float("inf"), 0.0, 0.0, 0.0)
    )


def test_unknown_output_is_refused() -> None:
    with pytest.raises(
        ValueError, match="unknown output format 'yaml': use one of full, concise, json,"
    ):
        render("yaml", result(), print, Options())

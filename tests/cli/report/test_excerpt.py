"""Where carets stand. Whole layouts are in golden/report/excerpts.txt."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.cli.report.excerpt import MAX_MARKS, Mark, excerpt
from tests.cli.report.sample import Source


def lines(text: str, *marks: tuple[int, int, str], width: int = 0) -> list[str]:
    made = [Mark(start, end, said, "", n == 0) for n, (start, end, said) in enumerate(marks)]
    return excerpt(Source("x", text), made, width, False)[1]


def test_one_mark() -> None:
    assert lines("a: 1\nb: 22\n", (8, 10, "too much")) == ["  |", "2 | b: 22", "  |    ^^ too much"]


def test_the_primary_mark_may_come_last_in_the_file() -> None:
    assert lines("a: 1\nb: 2\n", (8, 9, "here"), (0, 1, "there")) == [
        "  |",
        "1 | a: 1",
        "  | - there",
        "2 | b: 2",
        "  |    ^ here",
    ]


def test_line_numbers_are_aligned() -> None:
    text = "k\n" * 12
    assert lines(text, (0, 1, ""), (22, 23, "")) == ["   |", " 1 | k", "   | ^", "12 | k", "   | -"]
    assert excerpt(Source("x", text), [Mark(22, 23, "", "", True)], 0, False)[0] == 2


@pytest.mark.parametrize(
    ("text", "start", "end", "expected"),
    [
        ("", 0, 0, ["1 |", "  | ^"]),
        ("ab", 2, 2, ["1 | ab", "  |   ^"]),
        ("ab", 1, 1, ["1 | ab", "  |  ^"]),
        ("ab\ncd", 2, 3, ["1 | ab", "  |   ^"]),
        ("ab\ncd", 0, 3, ["1 | ab", "  | ^^"]),
        ("ab\r\ncd", 0, 4, ["1 | ab", "  | ^^"]),
        ("ab\r\ncd", 3, 4, ["1 | ab", "  |   ^"]),
        ("ab\rcd", 3, 5, ["2 | cd", "  | ^^"]),
        ("ab\u2028cd", 3, 4, ["1 | ab\\u2028cd", "  |         ^"]),
        ("ab", 7, 9, ["1 | ab", "  |   ^"]),
        ("ab", -3, 1, ["1 | ab", "  | ^"]),
    ],
)
def test_ends_of_lines_and_of_the_file(
    text: str, start: int, end: int, expected: list[str]
) -> None:
    assert lines(text, (start, end, "")) == ["  |", *expected]


@pytest.mark.parametrize(
    ("before", "part", "carets"),
    [
        ("\t", "x", "    ^"),
        ("日本", "x", "    ^"),
        ("e\u0301", "x", " ^"),
        ("\x1b", "x", "    ^"),
        ("\u202e", "x", "      ^"),
        ("", "日", "^^"),
        ("", "\u202e", "^^^^^^"),
        ("", "\t", "^^^^"),
        ("##[", "x", "      ^"),
        ("🙂", "x", "  ^"),
    ],
)
def test_carets_stand_under_what_is_shown(before: str, part: str, carets: str) -> None:
    text = f"{before}{part}z"
    assert lines(text, (len(before), len(before) + len(part), ""))[2] == "  | " + carets


def test_at_most_so_many_marks_are_drawn() -> None:
    text = "k\n" * 100
    rows = lines(text, *((2 * n, 2 * n + 1, "") for n in range(100)))
    assert sum(row.endswith(("^", "-")) for row in rows) == MAX_MARKS


def test_more_long_marks_than_bars_fall_back_to_their_first_line() -> None:
    text = "aa\nbb\ncc\n"
    rows = lines(text, *((n % 2, 7, str(n)) for n in range(5)))
    assert len([row for row in rows if row.startswith("1 |")]) == 1
    assert all(len(row) < 30 for row in rows)


@given(st.text("ab ,", min_size=0, max_size=400), st.data())
def test_the_caret_is_under_the_character_whatever_the_width(
    text: str, data: st.DataObject
) -> None:
    start = data.draw(st.integers(0, max(0, len(text) - 1)))
    width = data.draw(st.integers(1, 120))
    source, carets = lines(text, (start, start + 1, ""), width=width)[1:]
    assert carets.endswith("^") and carets.count("^") == 1
    column = carets.index("^")
    assert source[column : column + 1].strip() == text[start : start + 1].strip()
    assert len(source) <= max(width, 34)
    context = text[max(0, start - 3) : start + 4]
    assert context.strip() in source

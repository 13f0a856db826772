import pytest
from hypothesis import given

from msaa_lint.cli.report.escape import (
    MAX_LENGTH,
    clip,
    display,
    escape,
    escape_each,
    escape_surrogates,
)
from tests.cli.report.hostile import texts


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("plain text: [a] `b` é 日本", "plain text: [a] `b` é 日本"),
        ("\x1b[31m", "\\x1b[31m"),
        ("a\nb\r\tc", "a\\nb\\r\\tc"),
        ("\x00\x7f\x85\x9b", "\\x00\\x7f\\x85\\x9b"),
        ("\u202eevil\u2066", "\\u202eevil\\u2066"),
        ("\u2028\u2029\ufeff\u200b\u200d", "\\u2028\\u2029\\ufeff\\u200b\\u200d"),
        ("\ud800\udcff", "\\ud800\\udcff"),
        ("\U000e0041", "\\U000e0041"),
        ("\ufe0f\u3164\u2800\u034f", "\\ufe0f\\u3164\\u2800\\u034f"),
        ("\xa0\u3000", "\\xa0\\u3000"),
        (
            "##[stop-commands]x ##vso[task] ### ## [a]",
            "\\x23#[stop-commands]x \\x23#vso[task] ### ## [a]",
        ),
        ("###[x]", "#\\x23#[x]"),
    ],
)
def test_visible(text: str, expected: str) -> None:
    assert escape(text) == expected


@given(texts)
def test_visible_is_printable_and_stays_as_it_is(text: str) -> None:
    made = escape(text)
    assert made.isprintable() and isinstance(made.encode("utf-8"), bytes)
    assert escape(made) == made
    assert len(escape_each(text)) == len(text)


def test_shown_trims_and_cuts() -> None:
    assert display("  a\n") == "a"
    assert display("x" * MAX_LENGTH) == "x" * MAX_LENGTH
    assert display("x" * (MAX_LENGTH + 1)) == "x" * (MAX_LENGTH - 3) + "..."
    assert clip("abcdef", 5) == "ab..."


def test_whole_touches_lone_surrogates_alone() -> None:
    assert escape_surrogates("a\x1b\u202e\udc80é") == "a\x1b\u202e\\udc80é"

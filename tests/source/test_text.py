"""Decoding, and places in a text."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.source.text import Source, Unreadable, decode


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (b"a: 1", "a: 1"),
        (b"\xef\xbb\xbfa: 1", "a: 1"),
        ("a: \u00e9".encode("utf-16"), "a: \u00e9"),
        (b"\xfe\xff" + "a: \U0001d11e".encode("utf-16-be"), "a: \U0001d11e"),
        (b"", ""),
    ],
)
def test_decodes(data: bytes, text: str) -> None:
    assert decode(data) == text


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"a: 1\nb: \xff", "no UTF-8: byte 8 (line 2, column 4)"),
        (b"\xef\xbb\xbfab\x80", "byte 2 (line 1, column 3)"),
        (b"\xff\xfea", "no UTF-16"),
        (b"\xed\xa0\x80", "no UTF-8: byte 0"),
    ],
)
def test_says_where_bytes_are_no_text(data: bytes, said: str) -> None:
    with pytest.raises(Unreadable, match=r".*") as error:
        decode(data)
    assert said in str(error.value)


@given(st.text(alphabet="ab\r\n\u0085\u2028\U0001d11e", max_size=40))
def test_positions_agree_with_lines(text: str) -> None:
    """Every offset is in its line at its column; lines end at \\n, \\r\\n and \\r alone."""
    source = Source("x", text)
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    for offset, character in enumerate(text):
        line, column = source.position(offset)
        if character not in "\r\n":
            assert lines[line - 1][column - 1] == character
            assert source.line(line) == lines[line - 1]
    assert source.line_count == max(len(lines) - (lines[-1] == ""), 1)


def test_the_end_of_a_text_has_a_place() -> None:
    assert Source("x", "ab\n").position(3) == (2, 1)
    assert Source("x", "").position(0) == (1, 1)

from __future__ import annotations

import codecs

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.text.source import Position, Source, Unreadable, decode, encode, forbidden

TEXTS = st.text(st.characters(exclude_categories=["Cs"]))


@pytest.mark.parametrize(
    "data",
    [
        "é: 𝄞".encode(),
        codecs.BOM_UTF8 + "é: 𝄞".encode(),
        codecs.BOM_UTF16_LE + "é: 𝄞".encode("utf-16-le"),
        codecs.BOM_UTF16_BE + "é: 𝄞".encode("utf-16-be"),
    ],
)
def test_encodings(data: bytes) -> None:
    assert decode(data) == "é: 𝄞"
    assert encode("é: 𝄞", data) == data


def test_only_one_mark_is_taken_off() -> None:
    assert decode(2 * codecs.BOM_UTF8) == "\ufeff"


@pytest.mark.parametrize(
    ("data", "offset", "said"),
    [
        (b"a: 1\nb: \xff\n", 8, "not UTF-8: byte 8 (line 2, column 4)"),
        (b"\xef\xbb\xbfa\r\n\xc3(", 6, "not UTF-8: byte 6 (line 2, column 1)"),
        ("é".encode() + b"\xed\xa0\x80", 2, "not UTF-8: byte 2 (line 1, column 2)"),
        (b"\xc0\x80", 0, "not UTF-8: byte 0 (line 1, column 1)"),
        (b"a\xe2\x82", 1, "not UTF-8: byte 1 (line 1, column 2)"),
        (codecs.BOM_UTF16_LE + b"a\0\n\0\0\xd8b\0", 6, "not UTF-16: byte 6 (line 2, column 1)"),
        (codecs.BOM_UTF16_BE + b"\0a\0", 4, "not UTF-16: byte 4 (line 1, column 2)"),
    ],
)
def test_what_is_no_text_is_refused_at_its_byte(data: bytes, offset: int, said: str) -> None:
    with pytest.raises(Unreadable) as caught:
        decode(data)
    assert caught.value.offset == offset
    assert said in str(caught.value)


@given(TEXTS, st.sampled_from([b"", codecs.BOM_UTF8, codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE]))
def test_decode_undoes_encode(text: str, mark: bytes) -> None:
    if mark or not text.startswith("\ufeff"):
        assert decode(encode(text, mark)) == text


@given(st.binary())
def test_any_bytes_are_a_text_or_unreadable_within_them(data: bytes) -> None:
    try:
        text = decode(data)
    except Unreadable as error:
        assert error.offset is not None
        assert 0 <= error.offset < len(data)
    else:
        assert encode(text, data) == data


def test_lines_end_as_in_yaml() -> None:
    source = Source("x", "one\ntwo\r\nthree\rfour\x85\u2028five")
    assert source.line_count == 4
    assert [source.line(n) for n in range(1, 5)] == ["one", "two", "three", "four\x85\u2028five"]


@pytest.mark.parametrize(
    ("text", "count"), [("", 1), ("a", 1), ("a\n", 1), ("a\n\n", 2), ("\n", 1), ("a\r\r", 2)]
)
def test_line_count(text: str, count: int) -> None:
    assert Source("x", text).line_count == count


@pytest.mark.parametrize(
    ("offset", "place"),
    [
        (0, (1, 1)),
        (1, (1, 2)),
        (3, (1, 4)),
        (4, (2, 1)),
        (5, (2, 2)),
        (7, (2, 4)),
        (8, (3, 1)),
        (9, (3, 2)),
    ],
)
def test_columns_count_code_points(offset: int, place: tuple[int, int]) -> None:
    # Offsets: 𝄞 0, e 1, combining acute 2, \n 3; é 4, \t 5, \r 6, \n 7; z 8.
    assert Source("x", "𝄞e\u0301\né\t\r\nz").position(offset) == Position(*place)


@given(st.text("a𝄞\r\n", max_size=30), st.data())
def test_position_finds_the_character_in_its_line(text: str, data: st.DataObject) -> None:
    source = Source("x", text)
    offset = data.draw(st.integers(0, len(text)))
    line, column = source.position(offset)
    assert source.starts[line - 1] + column - 1 == offset
    if offset < len(text) and text[offset] not in "\r\n":
        assert source.line(line)[column - 1] == text[offset]


@pytest.mark.parametrize(
    "bad",
    ["\0", "\x08", "\x0b", "\x1b", "\x7f", "\x80", "\x9f", "\ud800", "\udfff", "\ufffe", "\uffff"],
)
def test_forbidden_characters(bad: str) -> None:
    assert forbidden(bad) == 0
    assert forbidden("ab" + bad + bad) == 2
    assert forbidden("é𝄞" + bad) == 2


@pytest.mark.parametrize("good", ["", "\t\n\r ~", "\x85\xa0", "\u2028\ufeff\ufffd", "𝄞\U0010ffff"])
def test_allowed_characters(good: str) -> None:
    assert forbidden(good) is None

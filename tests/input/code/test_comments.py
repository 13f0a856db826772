"""Comments in source code, as opposed to strings that look like comments."""

from __future__ import annotations

import time

import pytest

from msaa_lint.input.code.comments import comments, spans
from msaa_lint.input.code.parsing import Code


def found(text: str, language: str = "cpp") -> list[str]:
    return [text[start:end] for start, end in spans(Code(text, language))]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a // b\nc", ["// b"]),
        ("a // b\r\nc", ["// b"]),
        ("a // b \\\n c\nd", ["// b \\\n c"]),
        ("/* a\nb */ c /* d */", ["/* a\nb */", "/* d */"]),
        ("/* a", ["/* a"]),
        ("/*/ a */", ["/*/ a */"]),
        ("/* a /* b */ c */", ["/* a /* b */"]),
        ('"// a" // b', ["// b"]),
        ('"\\"// a" // b', ["// b"]),
        ('"a\n// b', ["// b"]),
        ("'\"' // b", ["// b"]),
        ("1'000'000 // b", ["// b"]),
        ("'\\'' // b", ["// b"]),
        ('R"(// a " )" // b', ["// b"]),
        ('R"x(// a )" // )x" // b', ["// b"]),
        ('u8R"(")" // b', ["// b"]),
        ('xR"(" // b', ["// b"]),
        ("a / b * c", []),
    ],
)
def test_of_c(text: str, expected: list[str]) -> None:
    assert found(text) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a // b\nc", ["// b"]),
        ("/* a /* b */ c */ d", ["/* a /* b */ c */"]),
        ('"""\n// a "x"\n""" // b', ["// b"]),
        ('#"// a"# // b', ["// b"]),
        ('##"// "# a"## // b', ["// b"]),
        ('#"""\n // a """ \n"""# // b', ["// b"]),
        ("let c = 'a' // b", ["// b"]),
    ],
)
def test_of_swift(text: str, expected: list[str]) -> None:
    assert found(text, "swift") == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a // b\nc", ["// b"]),
        ("/* a /* b */ c */ d", ["/* a /* b */ c */"]),
        ('"\n// a \\" x" // b', ["// b"]),
        ('r"// a \\" // b', ["// b"]),
        ('r#"// "a"# // b', ["// b"]),
        ("fn a<'a>(x: &'a u8, y: char) { y == '\"' } // b", ["// b"]),
        ("'\\'' // b", ["// b"]),
    ],
)
def test_of_rust(text: str, expected: list[str]) -> None:
    assert found(text, "rust") == expected


def test_a_comment_reads_as_that_of_a_description_would() -> None:
    text = "int a; // one \n/* two\n * three\n four\n */\n"
    made = comments([Code(text, "cpp")])
    assert [each.text for each in made.comments] == ["#  one", "#  two", "#three", "#four"]
    for each in made.comments:
        assert each.span.end - each.span.start == len(each.text)
        assert text[each.span.start + 2 : each.span.end] == each.text[2:]


@pytest.mark.parametrize(
    ("text", "alone"),
    [
        ("// a\nb // c\n  /* d */\n", {1, 3}),
        ("/* a\nb\n\n*/\n", {1, 2, 3, 4}),
        ("a /* b\nc */\n/* d */ e\n/* f */ /* g */ // h\n", {2, 4}),
        ("/* a */ b /* c\n*/ d", set()),
        ("// a", {1}),
        ("\r\n// a\r\n\r// b\r", {2, 4}),
    ],
)
def test_lines_that_hold_nothing_else(text: str, alone: set[int]) -> None:
    assert comments([Code(text, "c")]).alone == alone


@pytest.mark.parametrize("language", ["cpp", "swift"])
@pytest.mark.parametrize(
    "piece", ["/*", "/* */ ", '"', 'R"(', 'R"a(', "'", '#"', '"""', '#"""', '\\"', "//", "\n/*\n"]
)
def test_hostile_code_takes_no_time(piece: str, language: str) -> None:
    begun = time.process_time()
    comments([Code(piece * 100_000, language)])
    assert time.process_time() - begun < 5

"""Code in Markdown pages, by CommonMark's rules for fences and containers."""

from __future__ import annotations

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.input.code.fences import NAMES, blocks, codes
from tests.strength import examples


def code(text: str) -> list[tuple[str, list[str]]]:
    return [(block.language, [text[start:end] for start, end in block.lines]) for block in blocks(text)]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("```cpp\na\n```\n", [("cpp", ["a"])]),
        ("~~~c\na\n```\n~~~\nb", [("c", ["a", "```"])]),
        ("````swift\na\n```\nb\n`````\nc", [("swift", ["a", "```", "b"])]),
        ("   ```glsl\n   a\n   ```\nb", [("glsl", ["a"])]),
        ("    ```cpp\n    a\n    ```\n", []),
        ("```cpp\na\n    ```\nb\n```", [("cpp", ["a", "    ```", "b"])]),
        ("```cpp\na\n``` b\n```", [("cpp", ["a", "``` b"])]),
        ("```cpp `x`\na\n```\n", []),
        ("~~~ cpp `x` ~~~\na\n~~~\n", [("cpp", ["a"])]),
        ("```cpp\na\n", [("cpp", ["a"])]),
        ("```cpp\r\na\r\n```\r\nb", [("cpp", ["a"])]),
        ("```cpp\ra\r```\rb", [("cpp", ["a"])]),
        ("text ```cpp\na\n```\nb\n```\n", []),
        ("```\n```cpp\n```\n```cpp\na\n```", [("cpp", ["a"])]),
        ("- ```cpp\n  a\n\n   b\n  ```\n", [("cpp", ["a", "", " b"])]),
        ("- ```cpp\n  a\nb\n", [("cpp", ["a"])]),
        ("10. x\n\n    ```cpp\n    a\n    ```\n", [("cpp", ["a"])]),
        ("10. x\n\n        ```cpp\n        a\n        ```\n", []),
        ("- a\n  - b\n\n    ~~~cpp\n    c\n    ~~~\n  ~~~cpp\n  d\n  ~~~\n", [("cpp", ["c"]), ("cpp", ["d"])]),
        ("> ```cpp\n> a\n>b\n> ```\n", [("cpp", ["a", "b"])]),
        ("> ```cpp\n> a\nb\n", [("cpp", ["a"])]),
        ("> - x\n>\n>   ```cpp\n>   a\n>   ```\n", [("cpp", ["a"])]),
        ("-\n  ```cpp\n  a\n  ```", [("cpp", ["a"])]),
        ("* * *\n```cpp\na\n```", [("cpp", ["a"])]),
        ("", []),
    ],
)
def test_blocks(text: str, found: list[tuple[str, list[str]]]) -> None:
    assert code(text) == found


@pytest.mark.parametrize(
    ("info", "language"),
    [
        ("cpp", "cpp"), ("C++", "cpp"), ("c++", "cpp"), ("cc", "cpp"), ("CPP", "cpp"), ("c", "c"), ("Swift", "swift"), ("glsl", "glsl"),
        ("cpp title=\"a\"", "cpp"), (" cpp ", "cpp"), ("cpp{1,3}", "cpp"), ("cpp,ignore", "cpp"), ("{.cpp .numberLines}", "cpp"),
        ("{ .cpp }", "cpp"), ("cpp:a.cpp", "cpp"),
        ("hlsl", None), ("", None), ("c#", None), ("objc", None), ("text cpp", None), ("yaml", None), ("python", None),
    ],
)  # fmt: skip
def test_info_strings(info: str, language: str | None) -> None:
    assert code(f"```{info}\na\n```\n") == ([] if language is None else [(language, ["a"])])


def test_blocks_of_a_language_are_one_code_at_their_offsets() -> None:
    text = "# µ\n\n```cpp\nint a; // µ\n...\n```\n\n```glsl\nvoid main()\n```\n> ```c++\n> b();\n> // ...\n>   …\n> ```\n"
    cpp, glsl = codes(text)
    assert (cpp.language, glsl.language) == ("cpp", "glsl")
    assert cpp.fragments
    assert glsl.fragments
    for each in (cpp, glsl):
        assert len(each.text) == len(text)
        assert each.text.isascii()
        assert [n for n, char in enumerate(each.text) if char == "\n"] == [n for n, char in enumerate(text) if char == "\n"]
    assert cpp.text.split() == ["int", "a;", "//", "_", "b();"]
    assert cpp.text.index("b();") == text.index("b();")
    assert glsl.text.split() == ["void", "main()"]


PIECES = ("```", "~~~", "cpp", "\n", "\n", "> ", "- ", "1. ", "  ", "x", "\t", "\r", "...", "µ")


@given(st.lists(st.sampled_from(PIECES), max_size=60).map("".join))
@examples(2)
def test_any_text_keeps_its_length_and_its_lines(text: str) -> None:
    for each in codes(text):
        assert len(each.text) == len(text)
        for mine, theirs in zip(each.text, text, strict=True):
            assert mine in (" ", "_", theirs)
            assert (mine in "\r\n") == (theirs in "\r\n")


@pytest.mark.parametrize("text", ["- " * 200_000, "> " * 200_000, "```" * 100_000, "```cpp\n" * 50_000, "  - x\n" * 20_000, ">" * 300_000])
def test_hostile_pages_take_no_time(text: str) -> None:
    begun = time.process_time()
    codes(text)
    assert time.process_time() - begun < 5


def test_every_name_is_of_a_language() -> None:
    assert set(NAMES.values()) == {"c", "cpp", "swift", "glsl"}

"""Code in Markdown pages, by CommonMark's rules for fences and containers."""

from __future__ import annotations

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.input.code.fences import blocks, codes
from msaa_lint.input.code.pages import BLOCKS, NAMES, asciidoc, restructured
from tests.strength import examples


def code(text: str) -> list[tuple[str, list[str]]]:
    return [
        (block.language, [text[start:end] for start, end in block.lines]) for block in blocks(text)
    ]


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
        (
            "- a\n  - b\n\n    ~~~cpp\n    c\n    ~~~\n  ~~~cpp\n  d\n  ~~~\n",
            [("cpp", ["c"]), ("cpp", ["d"])],
        ),
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
        ("cpp", "cpp"), ("C++", "cpp"), ("c++", "cpp"), ("cc", "cpp"), ("CPP", "cpp"), ("c", "c"),
        ("Swift", "swift"), ("glsl", "glsl"),
        ("cpp title=\"a\"", "cpp"), (" cpp ", "cpp"), ("cpp{1,3}", "cpp"), ("cpp,ignore", "cpp"),
        ("{.cpp .numberLines}", "cpp"),
        ("{ .cpp }", "cpp"), ("cpp:a.cpp", "cpp"),
        ("hlsl", None), ("", None), ("c#", None), ("objc", "objc"), ("objective-c++", "objcpp"),
        ("text cpp", None), ("yaml", None), ("python", None),
    ],
)  # fmt: skip
def test_info_strings(info: str, language: str | None) -> None:
    assert code(f"```{info}\na\n```\n") == ([] if language is None else [(language, ["a"])])


def test_blocks_of_a_language_are_one_code_at_their_offsets() -> None:
    text = (
        "# µ\n\n```cpp\nint a; // µ\n...\n```\n\n```glsl\nvoid main()\n```\n> ```c++\n> b();\n> "
        "// ...\n>   …\n> ```\n"
    )
    cpp, glsl = codes(text)
    assert (cpp.language, glsl.language) == ("cpp", "glsl")
    assert cpp.fragments
    assert glsl.fragments
    for each in (cpp, glsl):
        assert len(each.text) == len(text)
        assert each.text.isascii()
        assert [n for n, char in enumerate(each.text) if char == "\n"] == [
            n for n, char in enumerate(text) if char == "\n"
        ]
    assert cpp.text.split() == ["int", "a;", "//", "_", "b();"]
    assert cpp.text.index("b();") == text.index("b();")
    assert glsl.text.split() == ["void", "main()"]


PIECES = (
    "```",
    "~~~",
    "cpp",
    "[source,cpp]\n",
    "----",
    ".. code:: cpp\n",
    "\n",
    "\n",
    "> ",
    "- ",
    "1. ",
    "  ",
    "x",
    "\t",
    "\r",
    "...",
    "µ",
)


@given(
    st.lists(st.sampled_from(PIECES), max_size=60).map("".join),
    st.sampled_from(["markdown", *BLOCKS]),
)
@examples(2)
def test_any_text_keeps_its_length_and_its_lines(text: str, page: str) -> None:
    for each in codes(text, page):
        assert len(each.text) == len(text)
        for mine, theirs in zip(each.text, text, strict=True):
            assert mine in (" ", "_", theirs)
            assert (mine in "\r\n") == (theirs in "\r\n")


@pytest.mark.parametrize(
    "text",
    [
        "- " * 100_000,
        "> " * 100_000,
        "```" * 50_000,
        "```cpp\n" * 25_000,
        "  - x\n" * 10_000,
        ">" * 150_000,
        "[source,cpp]\n" * 10_000,
        "[source,cpp]\n----\n" * 10_000,
        "[source%a%a" * 15_000,
        ".. code:: cpp\n  a\n" * 10_000,
    ],
)
@pytest.mark.parametrize("page", ["markdown", *BLOCKS])
def test_hostile_pages_take_no_time(text: str, page: str) -> None:
    begun = time.process_time()
    codes(text, page)
    assert time.process_time() - begun < 5


def test_every_name_is_of_a_language() -> None:
    assert set(NAMES.values()) == {"c", "cpp", "objc", "objcpp", "swift", "glsl", "rust"}


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("[source,cpp]\n----\na\n\nb\n----\nc\n", [("cpp", ["a", "", "b"])]),
        ("[source,c++,linenums]\n.A title\n----\na\n----\n", [("cpp", ["a"])]),
        (
            "[source%linenums,cpp,indent=0]\n[[anchor]]\n------\na\n----\n------\n",
            [("cpp", ["a", "----"])],
        ),
        (
            '[,c]\n--\na\n--\n[source,language="glsl"]\n....\nb\n....\n',
            [("c", ["a"]), ("glsl", ["b"])],
        ),
        ("[source,swift]\na\nb\n\nc\n", [("swift", ["a", "b"])]),
        (
            "[source,cpp]\n----\na; // <1>\nb; <2> <3>\nc > d\n----\n",
            [("cpp", ["a; //", "b;", "c > d"])],
        ),
        ("```cpp\na\n```\n", [("cpp", ["a"])]),
        ("[source,cpp]\n----\na", [("cpp", ["a", ""])]),
        (
            "[source,python]\n----\na\n----\n----\nb\n----\n[source,c]\n----\nc\n----\n",
            [("c", ["c"])],
        ),
        ("[quote]\n----\na\n----\n", []),
    ],
)
def test_blocks_of_asciidoc(text: str, found: list[tuple[str, list[str]]]) -> None:
    assert [
        (block.language, [text[start:end] for start, end in block.lines])
        for block in asciidoc(text)
    ] == found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (".. code-block:: cpp\n   :linenos:\n\n   a\n\n     b\nc\n", ["a", "b"]),
        ("  .. code:: c++\n\n     a\n  b\n", ["a"]),
        (".. sourcecode:: cpp\n\n\ta\n", ["a"]),
        (".. code-block:: python\n\n   a\n", []),
        (".. note::\n\n   a\n", []),
    ],
)
def test_blocks_of_restructured_text(text: str, found: list[str]) -> None:
    assert [
        text[start:end].strip()
        for block in restructured(text)
        for start, end in block.lines
        if text[start:end].strip()
    ] == found

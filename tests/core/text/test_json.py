"""JSON by the path of YAML: what json.loads reads is read the same."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.text.source import Source, forbidden
from msaa_lint.core.text.tree import Limits, parse
from tests.core.text.reading import one, plain, spelled, trouble, without_libyaml
from tests.paths import SAMPLES
from tests.strength import examples


@pytest.mark.usefixtures("stack")
class TestSpelling:
    @pytest.mark.parametrize(
        "text",
        [
            '{"a":1,"b":-1,"c":[],"d":{},"e":"","f":null,"g":true,"h":1.5e+3}',
            '{\n\t"a":\t1,\n\t"b":\t[\n\t\t1\t,\t2\n\t]\t,\n\t"c"\t: "x\\ty"\n}',
            '\t{\r\n\t"a": 1\r\n\t}\t\r\n\t\r\n',
            ' \n\t["a" , "b"]\n\t',
            '{"a/b":"\\/ \\\\ \\" \\b\\f\\n\\r\\t \\u00e9 \\u0000"}',
            '"text"',
            "[[[[]]]]",
            '{"a":\n"b"\n,\n"c":\n[\n{\n}\n]\n}',
            '["# no comment", "- no entry", "a: b", "{", "*a", "&a", "!a", "%a", "@a", "`a`", "--- '
            '", "| ", "> "]',
            '{"yes":"no","1":"1","null":"null","~":"~","<":"<"}',
            '{"x":[1,2,3],"y":{"z":[{"a":1},{"a":2}]}}',
        ],
    )
    def test_as_json_reads_it(self, text: str) -> None:
        assert plain(one(text)) == json.loads(text)

    def test_trailing_commas(self) -> None:
        assert plain(one('{"a":[1,2,],"b":{"c":1,},\n}')) == {"a": [1, 2], "b": {"c": 1}}

    def test_a_tab_in_a_text_stays(self) -> None:
        assert plain(one('\t["x\ty\t"]\t')) == ["x\ty\t"]

    def test_places_among_tabs(self) -> None:
        text = '\t{\r\n\t"a":\t1\r\n\t}\t\r\n'
        root = one(text)
        assert (root.start, root.end) == (1, 15)
        assert (root.value["a"].start, root.value["a"].end) == (10, 11)


@pytest.mark.usefixtures("stack")
class TestSurrogates:
    @pytest.mark.parametrize(
        "written",
        [
            "\\ud83d\\ude00",
            "\\uD83D\\uDE00",
            "x\\uD834\\udd1e\\ud834\\uDD1Ey",
            "\\udbff\\udfff",
            "\\ud800\\udc00",
        ],
    )
    def test_a_pair_is_a_character(self, written: str) -> None:
        text = f'{{"a{written}": ["{written}", 1]}}'
        assert plain(one(text)) == json.loads(text)
        assert spelled(text)[1:] == [f'"a{written}"', f'["{written}", 1]', f'"{written}"', "1"]

    def test_only_in_double_quotes(self) -> None:
        text = (
            "a: \\ud83d\\ude00 # \"\nb: '\\ud83d'\nc: |\n  \\ud83d\\ude00\n"
            'd: "\\ud83d\\ude00 \\ue000"\ne: "\\\\ud83d"\nf: "\\\\\\ud83d\\ude00"\n'
        )
        assert plain(one(text)) == {
            "a": "\\ud83d\\ude00", "b": "\\ud83d", "c": "\\ud83d\\ude00\n", "d": "😀 \ue000",
            "e": "\\ud83d", "f": "\\😀",
        }  # fmt: skip

    def test_characters_that_stand_in_for_them_are_not_the_texts_own(self) -> None:
        own = "".join(map(chr, range(0xE000, 0xF900)))
        assert plain(one(f'["{own}", "\\ud83d\\ude00", "\x85"]')) == [own, "😀", "\x85"]

    @pytest.mark.parametrize(
        ("text", "at"),
        [
            ('["\\ud83d"]', 2),
            ('["x\\udc00 \\ud83d"]', 3),
            ('["\\ud83d\\ude00", "\\ud83d\\ude00 \\ud83d \\ude00"]', 31),
            ('{"\\ude00\\ud83d": 1}', 2),
            ('["\\\\\\ud83d\\\\ude00"]', 4),
        ],
    )
    def test_half_a_pair_is_no_character(self, text: str, at: int) -> None:
        problem = trouble(text)
        assert (problem.code, tuple(problem.span)) == ("MSAA901", (at, at + 6))
        assert (
            problem.message == f"`{text[at : at + 6]}` is half of a surrogate pair, not a character"
        )


CHARACTERS = st.characters(exclude_categories=["Cs"]).filter(lambda c: forbidden(c) is None)
KEYS = st.text(CHARACTERS, max_size=12).filter(lambda key: key != "<<")
NUMBERS = st.integers(-(10**39), 10**39) | st.floats(allow_nan=False, allow_infinity=False)
VALUES = st.recursive(
    st.none()
    | st.booleans()
    | NUMBERS
    | st.text(
        CHARACTERS | st.sampled_from("\x00\x1b\x7f\x80\\\"'/#\t\n \x85\u2028\ufeff"), max_size=20
    ),
    lambda inner: st.lists(inner, max_size=5) | st.dictionaries(KEYS, inner, max_size=5),
    max_leaves=25,
)


@examples(0.8)
@given(
    VALUES,
    st.booleans(),
    st.sampled_from([None, 0, 2, "\t"]),
    st.sampled_from([None, (",", ":"), (" , ", " : "), (",\t", "\t:\t")]),
    st.sampled_from(["\n", "\r\n", "\r"]),
    st.booleans(),
)
def test_what_json_dumps_is_read_as_json_loads(
    value: Any, ascii_only: bool, indent: Any, separators: Any, end: str, pure: bool
) -> None:
    text = json.dumps(value, ensure_ascii=ascii_only, indent=indent, separators=separators).replace(
        "\n", end
    )
    at = forbidden(text)
    if at is not None:
        assert trouble(text).span.start == at
    elif pure:
        with without_libyaml():
            assert_same(text)
    else:
        assert_same(text)


def assert_same(text: str) -> None:
    expected = json.loads(text)
    found = plain(one(text))
    assert found == expected
    assert json.dumps(found) == json.dumps(expected)  # 1, 1.0 and True are equal, but not the same


@pytest.mark.skipif(
    not (SAMPLES / "vulkan_sc").is_dir(),
    reason="the folder of samples is not there: MSAA_LINT_SAMPLES names it",
)
def test_real_pipeline_files() -> None:
    files = sorted((SAMPLES / "vulkan_sc").rglob("*.json"))
    assert files
    for file in files:
        text = file.read_text(encoding="utf-8")
        documents, problems = parse(Source(file.name, text), Limits())
        assert problems == []
        (root,) = documents
        assert plain(root) == json.loads(re.sub(r",(?=\s*[\]}])", "", text))
        assert text[root.start : root.end] == text.strip()

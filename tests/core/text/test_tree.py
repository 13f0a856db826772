"""Values and exact places. A place is checked by its offsets, or by the text there where that text
stands only once.
"""

from __future__ import annotations

import gc
from typing import Any

import pytest

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Label, Span
from msaa_lint.core.text.tree import Limits, parse
from tests.core.text.reading import nodes, one, plain, reading, spelled, trouble

pytestmark = pytest.mark.usefixtures("stack")


def test_a_block_collection_ends_with_its_last_child() -> None:
    text = "a:\n  b: 1\n\n  # said of c\n  c:\n    - x\n    - y   # why\n\n\n# end\nd: 2\n"
    root = one(text)
    inner = root.value["a"]
    assert (root.start, root.end) == (0, len(text) - 1)
    assert text[inner.start : inner.end] == "b: 1\n\n  # said of c\n  c:\n    - x\n    - y"
    assert (inner.value["c"].start, inner.value["c"].end) == (34, 45)
    assert text[34:45] == "- x\n    - y"
    assert root.keys["d"].span == Span(62, 63)
    assert root.value["d"].span == Span(65, 66)


def test_flow_collections_end_with_their_bracket() -> None:
    text = "{a: [1, 2 , ], b: {} , c: [ ] }  "
    assert spelled(text) == [text.rstrip(), "a", "[1, 2 , ]", "1", "2", "b", "{}", "c", "[ ]"]


def test_a_pair_in_a_list_is_a_mapping() -> None:
    text = "[a: 1 , ? b : 2, c]"
    assert spelled(text) == [text, "a: 1", "a", "1", "? b : 2", "b", "2", "c"]
    assert plain(one(text)) == [{"a": 1}, {"b": 2}, "c"]


def test_a_list_that_is_not_indented() -> None:
    text = "a:\n- 1\n-   - 2\n    - 3\nb: 4\n"
    assert spelled(text) == [
        text[:-1],
        "a",
        "- 1\n-   - 2\n    - 3",
        "1",
        "- 2\n    - 3",
        "2",
        "3",
        "b",
        "4",
    ]


@pytest.mark.parametrize(
    ("text", "at"),
    [
        ("a:\nb: 1", 2),
        ("a:   # none\nb: 1", 2),
        ("{a: , b: 1}", 3),
        ("{a , b: 1}", 2),
        ("{a :  # x\n\n, b: 1}", 4),
        ("a:\n  x:\n\n\nb: 1", 7),
        ("? a\n? b\n", 3),
        ("? a # x: y\n:\nb: 1", 12),
        ("-\n- 1", 1),
        ("- \n\n- 1", 1),
    ],
)
def test_nothing_stands_after_its_colon_or_dash(text: str, at: int) -> None:
    (nothing,) = [
        node for node in nodes(one(text)) if node.kind == "scalar" and node.value is None
    ][:1]
    assert nothing.span == Span(at, at)
    assert (nothing.text, nothing.plain) == ("", True)


def test_a_collection_that_ends_with_nothing() -> None:
    assert spelled("a:\n  b:\n\n# c\nd:\n") == ["a:\n  b:\n\n# c\nd:", "a", "b:", "b", "", "d", ""]


@pytest.mark.parametrize(
    ("body", "end", "value"),
    [
        ("|\n  x\n  y\n\n\n", "y", "x\ny\n"),
        ("|-\n  x\n\n", "x", "x"),
        ("|+\n  x\n\n", "x", "x\n\n"),
        (">\n  x\n  y\n \n", "y", "x y\n"),
        ("|  # why\n  x\n", "x", "x\n"),
        ("|2\n   x\n", "x", " x\n"),
        ("|\n  x  \n\n", "x  ", "x  \n"),
        ("|\n  x\n   \n", "   ", "x\n \n"),
        ("|\r\n  x\r\n\r\n", "x", "x\n"),
        ("|\n\n", "|", ""),
        (">-  # nothing\n\n", ">-", ""),
    ],
)
def test_block_scalars_end_with_their_text(body: str, end: str, value: str) -> None:
    for text in ("a: " + body + "b: 1", "a: " + body + "# c\nb: 1", "a: " + body):
        node = one(text).value["a"]
        assert node.value == node.text == value
        assert (node.start, node.plain) == (3, False)
        assert node.end == 3 + body.index(end) + len(end)


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("one\n  two\n\n  three", "one two\nthree"),
        ('"one\n\n  two \\\n   three"', "one\ntwo three"),
        ("'it''s\n  # no comment'", "it's # no comment"),
        ('"\\x41\\u00e9\\U0001F600\\t\\e\\N\\L\\0"', "Aé😀\t\x1b\x85\u2028\0"),
        ("x\ty", "x\ty"),
    ],
)
def test_scalars_of_several_lines_and_escapes(written: str, value: str) -> None:
    text = f"a: {written}   # comment\nb: 1\n"
    node = one(text).value["a"]
    assert text[node.start : node.end] == written
    assert node.value == node.text == value


def test_text_and_plain() -> None:
    root = one("{a: 010, b: '010', c: \"010\", d: on, 0x10: ~}")
    assert [(n.value, n.text, n.plain) for n in root.value.values()] == [
        (10, "010", True),
        ("010", "010", False),
        ("010", "010", False),
        ("on", "on", True),
        (None, "~", True),
    ]
    assert [key.value for key in root.keys.values()] == ["a", "b", "c", "d", 16]


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_offsets_are_code_points_of_the_text(end: str, mark: str) -> None:
    text = mark + end.join(["𝄞: é", "𝄢é:", "  - {z: '𝄞𝄞', y: 1}", ""])
    root = one(text)
    source = Source("x", text)
    last = root.value["𝄢é"].value[0].value
    assert text[last["z"].start : last["z"].end] == "'𝄞𝄞'"
    assert source.position(last["y"].start) == (3, 18)
    assert source.position(last["y"].end) == (3, 19)
    assert root.start == len(mark)
    assert plain(root) == {"𝄞": "é", "𝄢é": [{"z": "𝄞𝄞", "y": 1}]}


def test_yaml_1_2_has_three_line_ends_less() -> None:
    # YAML 1.1 ends the comment at U+0085, and so hides `b` from whoever reads it in an editor that
    # does not.
    text = "a: 1 # x\x85b: 2\u2028c: 3\n'd \u2028 e': \"f\x85  g\u2029\"\nh: i\u2029j\n"
    root = one(text)
    assert plain(root) == {"a": 1, "d \u2028 e": "f\x85  g\u2029", "h": "i\u2029j"}
    assert spelled(text)[1:] == ["a", "1", "'d \u2028 e'", '"f\x85  g\u2029"', "h", "i\u2029j"]


class TestDocuments:
    @pytest.mark.parametrize(
        "text",
        [
            "",
            " ",
            "\n\n",
            "# only\n# this",
            "---\n",
            "---\n# nothing\n...\n",
            "\ufeff",
            "%YAML 1.2\n---\n",
        ],
    )
    def test_nothing_is_no_document(self, text: str) -> None:
        assert reading(text) == ([], [])

    def test_several(self) -> None:
        text = (
            "%YAML 1.2\n--- # one\na: &x 1\n...\n---\n- 2\n---\n# none\n--- null\n--- ''\n--- "
            "{a: 3}"
        )
        documents, problems = reading(text)
        assert problems == []
        assert [plain(document) for document in documents] == [{"a": 1}, [2], None, "", {"a": 3}]
        assert [text[d.start : d.end] for d in documents] == [
            "a: &x 1",
            "- 2",
            "null",
            "''",
            "{a: 3}",
        ]

    def test_an_anchor_ends_with_its_document(self) -> None:
        problem = trouble("a: &x 1\n---\nb: *x\n")
        assert (problem.code, problem.span) == ("MSAA901", Span(15, 17))
        assert "anchor `&x` is not defined" in problem.message

    def test_those_before_a_mistake_are_kept(self) -> None:
        documents, problems = reading("a: 1\n---\nb: 2\n---\nc: [\n---\nd: 4\n")
        assert [plain(document) for document in documents] == [{"a": 1}, {"b": 2}]
        assert [problem.code for problem in problems] == ["MSAA901"]


class TestAliases:
    def test_an_alias_has_its_own_place_and_the_anchors_value(self) -> None:
        text = "a: &a-1 {x: [1]}\nb: [*a-1, *a-1]\n"
        root = one(text)
        anchored, (first, second) = root.value["a"], root.value["b"].value
        assert text[anchored.start : anchored.end] == "&a-1 {x: [1]}"
        assert (first.span, second.span) == (Span(21, 25), Span(27, 31))
        assert first.value is anchored.value
        assert first.keys is anchored.keys
        assert first.anchor is second.anchor is anchored
        assert anchored.anchor is None

    def test_scalars_and_keys(self) -> None:
        text = "&k a: &x '4'\nb: [*x, *k]\n*x : 1"
        root = one(text)
        assert plain(root) == {"a": "4", "b": ["4", "a"], "4": 1}
        assert text[root.keys["4"].start : root.keys["4"].end] == "*x"
        assert [(n.text, n.plain) for n in (*root.value["b"].value, root.keys["4"])] == [
            ("4", False),
            ("a", True),
            ("4", False),
        ]

    def test_an_alias_of_what_has_an_alias(self) -> None:
        root = one("a: &a 1\nb: &b [*a]\nc: *b")
        assert plain(root) == {"a": 1, "b": [1], "c": [1]}
        assert root.value["c"].value[0].anchor is root.value["a"]

    def test_the_latest_anchor_counts(self) -> None:
        assert plain(one("[&a 1, *a, &a 2, *a, &a [&a 3], *a]")) == [1, 1, 2, 2, [3], [3]]

    @pytest.mark.parametrize(
        ("text", "span", "said"),
        [
            ("a: &a [*a]", (7, 9), "the anchor `&a` contains itself"),
            ("a: &a {b: {c: [1, *a]}}", (18, 20), "the anchor `&a` contains itself"),
            ("&a a: *a\nb: &b\n  c: *b", (20, 22), "the anchor `&b` contains itself"),
            ("a: *b\nb: &b 1", (3, 5), "the anchor `&b` is not defined before this alias"),
        ],
    )
    def test_aliases_of_nothing_whole(self, text: str, span: tuple[int, int], said: str) -> None:
        problem = trouble(text)
        assert (problem.code, problem.span) == ("MSAA901", span)
        assert said in problem.message


class TestMerge:
    @pytest.mark.parametrize(
        ("text", "merged"),
        [
            ("{<<: *one}", {"x": 1, "y": 2}),
            ("{<<: *one, y: 9}", {"x": 1, "y": 9}),
            ("{y: 9, <<: *one, z: 8}", {"y": 9, "x": 1, "z": 8}),
            ("{<<: [*one, *two]}", {"x": 1, "y": 2, "z": 4}),
            ("{<<: [*two, *one], x: 0}", {"y": 3, "z": 4, "x": 0}),
            ("{<<: {k: {l: 5}, m: 6}, m: 7}", {"k": {"l": 5}, "m": 7}),
            ("{<<: []}", {}),
            ("{<<: {<<: *one, z: 5}, y: 6}", {"x": 1, "y": 6, "z": 5}),
            ("{'<<': *one}", {"<<": {"x": 1, "y": 2}}),
        ],
    )
    def test_what_is_stated_wins_then_the_earlier(self, text: str, merged: dict[str, Any]) -> None:
        root = one(f"one: &one {{x: 1, y: 2}}\ntwo: &two {{y: 3, z: 4}}\nit: {text}")
        assert plain(root.value["it"]) == merged
        assert list(plain(root.value["it"])) == list(merged)

    def test_an_overridden_key_keeps_its_turn(self) -> None:
        root = one("base: &base {a: 1, b: 2, c: 3}\nit: {<<: *base, b: 4, d: 5}")
        assert list(plain(root.value["it"]).items()) == [("a", 1), ("b", 4), ("c", 3), ("d", 5)]

    def test_places_are_those_of_the_base(self) -> None:
        text = "base: &base {a: 1}\nit:\n  <<: *base\n  b: 2\n\nend: 3"
        root = one(text)
        it = root.value["it"]
        assert text[it.start : it.end] == "<<: *base\n  b: 2"
        assert it.value["a"] is root.value["base"].value["a"]
        assert it.keys["a"] is root.value["base"].keys["a"]

    def test_a_merged_mapping_can_be_merged_on(self) -> None:
        root = one("a: &a {x: 1}\nb: &b {<<: *a, y: 2}\nc: {<<: *b, z: 3}\nd: *b")
        assert plain(root.value["c"]) == {"x": 1, "y": 2, "z": 3}
        assert plain(root.value["d"]) == {"x": 1, "y": 2}

    @pytest.mark.parametrize(
        ("text", "span"),
        [("{<<: 1}", (5, 6)), ("{<<: [{}, [1]]}", (10, 13)), ("<<:\na: 1", (3, 4))],
    )
    def test_only_mappings_are_merged(self, text: str, span: tuple[int, int]) -> None:
        problem = trouble(text)
        assert (problem.code, problem.span) == ("MSAA903", span)


class TestKeys:
    def test_the_first_of_two_equal_keys_is_kept(self) -> None:
        text = "a: 1\nb: {c: 1}\n'a': {d: 2}\na:\n- 3\n\nb: 4 # end\n"
        root, problems = reading(text).documents[0], reading(text).problems
        assert plain(root) == {"a": 1, "b": {"c": 1}}
        assert text[root.start : root.end] == text[:-7]
        assert [(p.code, p.span, p.labels) for p in problems] == [
            ("MSAA905", Span(15, 18), (Label(Span(0, 1), "first defined here"),)),
            ("MSAA905", Span(27, 28), (Label(Span(0, 1), "first defined here"),)),
            ("MSAA905", Span(35, 36), (Label(Span(5, 6), "first defined here"),)),
        ]
        assert "`a`" in problems[0].message

    def test_an_anchor_in_a_value_that_is_not_kept_still_counts(self) -> None:
        documents, problems = reading("{a: 1, a: &x [2], b: *x}")
        assert plain(documents[0]) == {"a": 1, "b": [2]}
        assert [p.code for p in problems] == ["MSAA905"]

    def test_equal_keys_of_different_mappings(self) -> None:
        assert plain(one("[{a: 1}, {a: 2, b: {a: 3}}]")) == [{"a": 1}, {"a": 2, "b": {"a": 3}}]

    def test_only_so_many_are_told(self) -> None:
        assert len(reading("a: 1\n" * 1000).problems) == 50

    @pytest.mark.parametrize(
        ("text", "span", "kind"),
        [
            ("? [a, b]\n: 1", (2, 3), "sequence"),
            ("{a: 1}: 2", (0, 1), "mapping"),
            ("x: {? {y: 1} : 2}", (6, 7), "mapping"),
            ("a: &a [1]\n*a : 2", (10, 12), "sequence"),
        ],
    )
    def test_a_key_is_a_scalar(self, text: str, span: tuple[int, int], kind: str) -> None:
        problem = trouble(text)
        assert (problem.code, problem.span) == ("MSAA901", span)
        assert problem.message == f"a {kind} cannot be a key; use a scalar"

    def test_odd_keys(self) -> None:
        assert plain(one('{"": 1, 0: 2, ~: 3, true: 4, "a\\nb": 5, ? x : 6, 1.5: 7}')) == {
            "": 1, "0": 2, "~": 3, "true": 4, "a\nb": 5, "x": 6, "1.5": 7,
        }  # fmt: skip


class TestTags:
    @pytest.mark.parametrize(
        ("written", "value"),
        [
            ("!!str 4", "4"),
            ("!!str", ""),
            ("!!str 'x'", "x"),
            ("! 4", "4"),
            ("!!int 0x10", 16),
            ("!!int '4'", 4),
            ("!!float 4", 4.0),
            ("!!float .inf", float("inf")),
            ("!!bool true", True),
            ("!!null ~", None),
            ("!!null", None),
            ("!<tag:yaml.org,2002:str> 4", "4"),
            ("!<tag:yaml.org,2002:float> 4", 4.0),
            ("&a !!str 4", "4"),
            ("!!str &a 4", "4"),
            ("!!seq [1]", [1]),
            ("!!map {a: 1}", {"a": 1}),
            ("! [1]", [1]),
            ("!!seq &a\n  - 1", [1]),
            ("&a !!map\n  b: 1", {"b": 1}),
        ],
    )
    def test_core_tags_that_agree(self, written: str, value: Any) -> None:
        text = f"k: {written}\nl: 1"
        node = one(text).value["k"]
        assert plain(node) == value
        assert type(plain(node)) is type(value)
        assert text[node.start : node.end] == written
        if isinstance(value, str):
            assert not node.plain

    def test_a_handle_for_the_core_tags(self) -> None:
        assert plain(one("%TAG !y! tag:yaml.org,2002:\n---\n[!y!str 4, !y!int 5]")) == ["4", 5]

    @pytest.mark.parametrize(
        ("written", "tag"),
        [
            ("!!python/object/apply:os.system ['true']", "!!python/object/apply:os.system"),
            ("!!python/name:os.system ''", "!!python/name:os.system"),
            ("!local x", "!local"),
            ("!<tag:example.org,2000:x> x", "!<tag:example.org,2000:x>"),
            ("!<!local> [1, 2]", "!<!local>"),
            ("&a !local {b: 1}", "!local"),
            ("!local &a\n  b: 1", "!local"),
            ("&a  # why\n  !local\n  b: 1", "!local"),
            ("!!set {a}", "!!set"),
            ("!!binary aGk=", "!!binary"),
            ("!!timestamp 2020-01-01", "!!timestamp"),
            ("!!merge <<", "!!merge"),
        ],
    )
    def test_other_tags_are_refused_where_they_stand(self, written: str, tag: str) -> None:
        text = f"k: {written}\nl: 1"
        problem = trouble(text)
        assert problem.code == "MSAA903"
        assert text[problem.span.start : problem.span.end] == tag
        assert problem.span.start == 3 + written.index(tag)
        assert f"`{tag}` is not supported" in problem.message

    @pytest.mark.parametrize(
        "written",
        [
            "!!int x",
            "!!int 1.5",
            "!!float x",
            "!!bool yes",
            "!!bool 1",
            "!!null x",
            "!!map [1]",
            "!!seq {a: 1}",
            "!!str [1]",
            "!!map x",
            "!!int",
        ],
    )
    def test_core_tags_that_do_not_agree(self, written: str) -> None:
        text = f"k: {written}\nl: 1"
        problem = trouble(text)
        assert (problem.code, problem.span) == ("MSAA903", Span(3, 3 + len(written.split()[0])))
        assert "does not match" in problem.message

    def test_all_are_told_and_the_rest_is_read(self) -> None:
        documents, problems = reading("a: !x 1\nb: [!y {c: 2}]\n!z d: 3\n")
        assert [p.span for p in problems] == [Span(3, 5), Span(12, 14), Span(23, 25)]
        assert plain(documents[0]) == {"a": 1, "b": [{"c": 2}], "d": 3}


class TestSyntax:
    @pytest.mark.parametrize(
        ("text", "span", "said"),
        [
            ("a:\n\t- 1", (3, 4), "a tab cannot be used here"),
            ("a: 1\n\tb: 2", (5, 6), "a tab cannot be used here"),
            ("\ta: 1", (0, 1), "a tab cannot be used here"),
            (
                "a: b: c",
                (4, 5),
                "a second `:` on the line of `a`: write `a` and `b` on lines of their own",
            ),
            (
                "a: [1, 2",
                (3, 4),
                "`[` is never closed: the text ends at line 1, column 9 before its `]`",
            ),
            ('a: "x', (3, 4), 'the quote `"x` is never closed; add the closing `"`'),
            ("a: 'x\n", (3, 4), "the quote `'x` is never closed; add the closing `'`"),
            (
                "a: 1\n- b",
                (5, 6),
                "a list item cannot stand among the keys of the mapping that `a: 1` begins",
            ),
            ("a: }", (3, 4), ""),
            ("a: `x`", (3, 4), "a value cannot begin with a backtick"),
            ("a: @x", (3, 4), 'a value cannot begin with `@`; write "@x"'),
            ("a: &x &y 1", (6, 7), ""),
            ('a: "\\q"', (4, 6), "`\\q` is not an escape in double quotes"),
            ('a: "\\xZZ"', (4, 6), "`\\x` must be followed by two hexadecimal digits"),
            ('a: "\\uD800"', (4, 10), "`\\uD800` is half of a surrogate pair"),
            ('a: "\\U0000D800"', (4, 14), "`\\U0000D800` is not a character"),
            ('a: "\\U00110000"', (4, 14), "`\\U00110000` is not a character"),
            ('a: "\\UFFFFFFFF"', (4, 14), "`\\UFFFFFFFF` is not a character"),
            ("%YAML 2.0\n---\na: 1", (0, 9), "`%YAML 2.0` is not a version of YAML that is read"),
            ("%YAML 1.3\n---\na: 1", (0, 9), "`%YAML 1.3` is not a version of YAML that is read"),
            ('{"a"\n: 1}', (5, 6), "a key must be on the line of its `:`"),
            ('{"a": 1} {"b": 2}', (9, 10), "a second JSON value begins here"),
        ],
    )
    def test_one_problem_at_its_place(self, text: str, span: tuple[int, int], said: str) -> None:
        problem = trouble(text)
        assert problem.code == "MSAA901"
        # Within a quoted scalar the two parsers stop at different characters.
        assert problem.span == span or (
            text[3:4] == '"'
            and span[0] <= problem.span.start <= problem.span.end <= max(span[1], len(text))
        )
        assert said in problem.message

    def test_where_the_broken_thing_begins_is_a_label(self) -> None:
        problem = trouble("a:\n  - x\n  - [1, 2\nb: 3\n")
        assert problem.span == Span(13, 14)
        assert problem.labels == (Label(Span(19, 20), "expected `]` before this"),)

    @pytest.mark.parametrize("bad", ["\0", "\x07", "\x1b", "\x7f", "\x9b", "\ufffe", "\ud800"])
    @pytest.mark.parametrize("text", ["a: ", "é: 1\n# ", "'x", "]", "[" * 200, "- a\n---\n"])
    def test_forbidden_characters_are_told_first(self, text: str, bad: str) -> None:
        problem = trouble(text + bad)
        assert (problem.code, problem.span) == ("MSAA901", Span(len(text), len(text) + 1))
        assert f"U+{ord(bad):04X}" in problem.message
        assert reading(text + bad).documents == []


@pytest.mark.parametrize("text", ["a: 1", "a: [", "\0"])
def test_garbage_collection_is_as_it_was(text: str) -> None:
    assert gc.isenabled()
    parse(Source("x", text), Limits())
    assert gc.isenabled()
    gc.disable()
    try:
        parse(Source("x", text), Limits())
        assert not gc.isenabled()
    finally:
        gc.enable()

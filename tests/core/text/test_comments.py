from __future__ import annotations

import string

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.text.comments import Comment, comments
from msaa_lint.core.text.edits import apply
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.core.text.tree import Limits, parse
from tests.core.text.reading import plain, reading
from tests.strength import examples


def found(text: str) -> list[Comment]:
    source = Source("x", text)
    made = comments(source, parse(source, Limits()).documents)
    assert all(text[comment.span.start : comment.span.end] == comment.text for comment in made)
    return made


@pytest.mark.usefixtures("stack")
@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", []),
        ("# one", ["# one"]),
        ("#\n##\n #x\n\t# not read: a tab\n", ["#", "##", "#x"]),
        ("# one\na: 1 # two\n#three", ["# one", "# two", "#three"]),
        ("a: b#c\nd: 'e#f'#g", ["#g"]),
        ("a: 'x # y' # z", ["# z"]),
        ('a: "x # y \\" # z" #"', ['#"']),
        ('"a # b": 1 # c', ["# c"]),
        ("a # b: 1", ["# b: 1"]),
        ("'a\n  # b\n  c' # d\n", ["# d"]),
        ("a: |\n  # text\n  more # text\n# comment\n", ["# comment"]),
        (
            "a: |  # head\n  # text\n\n # less\nb: >2- # head\n   # text\n",
            ["# head", "# less", "# head"],
        ),
        ("a: >-\n  # text\nb: 1 # yes", ["# yes"]),
        ("a: !!str # tagged\n  # still\n  |\n  # text\n", ["# tagged", "# still"]),
        ("a: &x # anchored\n  'x # y'\nb: *x # alias\n", ["# anchored", "# alias"]),
        ("a: [1, # in\n  2 # too\n  ,#close\n]#end\n", ["# in", "# too", "#close", "#end"]),
        ("a: x\n  y # after two lines\n", ["# after two lines"]),
        ("a: x\n# between\nb: y", ["# between"]),
        ("a:\t1\t# tab\r\nb: 2 # cr\r# three\r", ["# tab", "# cr", "# three"]),
        ("? a # key\n: b # value\n", ["# key", "# value"]),
        (
            "%YAML 1.2 # version\n--- # begin\na: 1\n... # end\n# after\n--- # empty\n# last",
            ["# version", "# begin", "# end", "# after", "# empty", "# last"],
        ),
        ("a: 1\n--- # between\nb: 2\n", ["# between"]),
        ("a: 1 # x\x85b: 2 # y\u2028z\n", ["# x\x85b: 2 # y\u2028z"]),
        ("a: \x85 # x", ["# x"]),
        ('["\\ud83d\\ude00 # x", 1] # y', ["# y"]),
        ("\ufeff# bom\na: 1", ["# bom"]),
        # What the tree does not hold is no comment either.
        ("a: 1\na: 'x # twice'\n", []),
        ("a: 1\n<<: {a: 'x # overridden', b: 2} # merge\n", ["# merge"]),
        ("--- ''\n--- 'x # y'\n", []),
    ],
)
def test_comments(text: str, expected: list[str]) -> None:
    assert [comment.text for comment in found(text)] == expected


def test_places() -> None:
    assert found("é: '𝄞 #' # x\r\n  # 𝄞\r") == [
        Comment(Span(9, 12), "# x"),
        Comment(Span(16, 19), "# 𝄞"),
    ]


@pytest.mark.usefixtures("stack")
@pytest.mark.parametrize(
    "rest",
    [
        "'x # y",
        "a: [\n # y",
        "a: 'x\n# y'\nb: [",
        "- a\n'b # c'",
        "[" * 200 + " # y",
        "{a: 'x # y', [",
        "a: *b # c",
        "\0 # x",
        "'\n---\n# x",
    ],
)
def test_a_document_that_could_not_be_read_has_none(rest: str) -> None:
    text = "# one\na: 1 # two\n--- # three\n"
    assert [comment.text for comment in found(text + rest)][:2] in (["# one", "# two"], [])
    assert all(comment.text in ("# one", "# two", "# three") for comment in found(text + rest))
    assert [comment.text for comment in found("# alone\n" + rest)] in (["# alone"], [])


def test_many_at_once() -> None:
    text = "- a # b\n" * 5_000
    assert len(found(text)) == 5_000
    assert found("[" + "'#'," * 5_000 + "] # x")[0].span == Span(20_003, 20_006)


NOTES = st.text(string.printable[:95] + "é𝄞", max_size=12)
KEYS = st.text(string.ascii_letters + " #'\":", min_size=1, max_size=6)
VALUES = st.text(string.ascii_letters + " #'\"\n:-|>", max_size=30)


@examples(0.8)
@given(
    st.dictionaries(KEYS, VALUES | st.lists(VALUES, max_size=3), min_size=1, max_size=5), st.data()
)
def test_what_is_written_between_values_is_found_and_changes_nothing(
    value: dict[str, object], data: st.DataObject
) -> None:
    style = data.draw(st.sampled_from([None, "'", '"', "|", ">"]))
    notes = ["# " + data.draw(NOTES) for _ in value]
    text = ""
    for note, (key, entry) in zip(notes, value.items(), strict=True):
        text += (
            note
            + "\n"
            + yaml.safe_dump({key: entry}, default_style=style, width=20, default_flow_style=False)
        )
    assert [comment.text for comment in found(text)] == notes
    without = apply(text, [Edit(Span(start, end + 1), "") for (start, end), _ in found(text)])
    assert [plain(d) for d in reading(without).documents] == [
        plain(d) for d in reading(text).documents
    ]

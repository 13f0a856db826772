"""Comments between scalars, and edits by span."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.finding import Edit, Span
from msaa_lint.source.comments import comments
from msaa_lint.source.edits import Overlap, apply
from msaa_lint.source.text import Source
from msaa_lint.source.tree import Limits, parse


def found(text: str) -> list[str]:
    source = Source("x", text)
    return [comment.text for comment in comments(source, parse(source, Limits()).documents)]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("# one\na: 1 # two\n#three", ["# one", "# two", "#three"]),
        ("a: b#c", []),
        ("a: 'x # y' # z", ["# z"]),
        ('a: "x # y"', []),
        ("a: |\n  # text\n  more\n# comment\n", ["# comment"]),
        ("a: >-\n  # text\nb: 1 # yes", ["# yes"]),
        ("a: [1, # in\n  2]\n", ["# in"]),
        ("a: &x 1 # anchored\nb: *x # alias\n", ["# anchored", "# alias"]),
        ("a: x\n  y # after two lines\n", ["# after two lines"]),
        ("a:\t1\t# tab\r\nb: 2 # cr\r", ["# tab", "# cr"]),
        ('"a # b": 1', []),
        ("a: 1\n--- # between\nb: 2\n", ["# between"]),
    ],
)
def test_comments(text: str, expected: list[str]) -> None:
    assert found(text) == expected


def test_places_of_comments() -> None:
    text = "é: 1 # x\r\n"
    source = Source("x", text)
    (comment,) = comments(source, parse(source, Limits()).documents)
    assert comment.span == Span(5, 8)
    assert text[5:8] == "# x"


def test_edits_are_made_whatever_their_order() -> None:
    text = "a: STORE # why\r\nb: STORE\n"
    edits = [Edit(Span(19, 24), "NONE"), Edit(Span(3, 8), "DONT_CARE")]
    assert apply(text, edits) == "a: DONT_CARE # why\r\nb: NONE\n"
    assert apply(text, []) == text


@pytest.mark.parametrize("edits", [[(0, 3), (2, 4)], [(0, 2), (0, 2)], [(1, 1), (1, 1)]])
def test_edits_that_overlap_are_refused(edits: list[tuple[int, int]]) -> None:
    with pytest.raises(Overlap):
        apply("abcd", [Edit(Span(*span), "x") for span in edits])


def test_edits_outside_are_refused() -> None:
    with pytest.raises(ValueError, match="not within"):
        apply("ab", [Edit(Span(1, 3), "")])


@given(st.text(max_size=30), st.lists(st.integers(0, 30), max_size=8, unique=True), st.data())
def test_what_is_not_edited_stays(text: str, cuts: list[int], data: st.DataObject) -> None:
    places = sorted(cut for cut in cuts if cut <= len(text))
    spans = [Span(a, b) for a, b in zip(places[::2], places[1::2], strict=False)]
    edits = [Edit(span, data.draw(st.text(max_size=3))) for span in spans]
    kept = "".join(text[a:b] for a, b in zip([0, *(s.end for s in spans)], [*(s.start for s in spans), len(text)], strict=True))
    made = apply(text, edits)
    assert len(made) == len(kept) + sum(len(edit.text) for edit in edits)
    assert apply(text, [edit._replace(text="") for edit in edits]) == kept
    assert made == apply(text, reversed(edits))

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.text.edits import Overlap, apply
from msaa_lint.core.text.span import Edit, Span


def edit(start: int, end: int, text: str = "x") -> Edit:
    return Edit(Span(start, end), text)


def test_edits_are_made_whatever_their_order() -> None:
    text = "a: STORE # why\r\nb: STORE\n\tc: é𝄞 \r"
    edits = [edit(19, 24, "NONE"), edit(29, 30, ""), edit(3, 8, "DONT_CARE")]
    assert (
        apply(text, edits) == apply(text, edits[::-1]) == "a: DONT_CARE # why\r\nb: NONE\n\tc: 𝄞 \r"
    )


def test_no_edits() -> None:
    assert apply("a\r\n", []) == "a\r\n"
    assert apply("", iter([])) == ""


@pytest.mark.parametrize(
    ("edits", "made"),
    [
        ([edit(0, 0), edit(4, 4, "y")], "xabcdy"),
        ([edit(0, 4, "")], ""),
        ([edit(1, 1, "x"), edit(1, 3, "yz")], "axyzd"),
        ([edit(1, 3, "yz"), edit(3, 3, "x")], "ayzxd"),
        ([edit(0, 2, "1"), edit(2, 4, "2")], "12"),
        ([edit(0, 2, "1"), edit(2, 2, "+"), edit(2, 4, "2")], "1+2"),
    ],
)
def test_edits_that_touch(edits: list[Edit], made: str) -> None:
    assert apply("abcd", edits) == apply("abcd", edits[::-1]) == made


@pytest.mark.parametrize(
    "edits",
    [
        [edit(0, 3), edit(2, 4)],
        [edit(0, 4), edit(1, 2)],
        [edit(0, 2), edit(0, 2)],
        [edit(0, 2), edit(0, 3)],
        [edit(1, 1), edit(1, 1)],
        [edit(1, 1, "a"), edit(1, 1, "b")],
        [edit(0, 2), edit(1, 1)],
    ],
)
def test_edits_that_overlap_are_refused(edits: list[Edit]) -> None:
    for order in (edits, edits[::-1]):
        with pytest.raises(Overlap):
            apply("abcd", order)


@pytest.mark.parametrize("wrong", [edit(1, 3), edit(-1, 1), edit(2, 1), edit(3, 3)])
def test_edits_outside_of_the_text_are_refused(wrong: Edit) -> None:
    with pytest.raises(ValueError, match="is not within the text"):
        apply("ab", [wrong])


TEXTS = st.text("ab\r\né𝄞", max_size=30)
WORDS = st.text("xyz\n", max_size=3)


@given(TEXTS, st.lists(st.integers(0, 30), max_size=10, unique=True), st.data())
def test_what_is_not_edited_stays(text: str, cuts: list[int], data: st.DataObject) -> None:
    places = sorted(cut for cut in cuts if cut <= len(text))
    edits = [
        edit(start, end, data.draw(WORDS))
        for start, end in zip(places[::2], places[1::2], strict=False)
    ]
    made = apply(text, data.draw(st.permutations(edits)))
    by_hand = text
    for each in reversed(edits):
        by_hand = by_hand[: each.span.start] + each.text + by_hand[each.span.end :]
    assert made == by_hand
    undone, grown = [], 0
    for each in edits:
        start = each.span.start + grown
        undone.append(edit(start, start + len(each.text), text[each.span.start : each.span.end]))
        grown += len(each.text) - (each.span.end - each.span.start)
    assert apply(made, undone) == text


@given(
    st.lists(
        st.tuples(st.integers(0, 12), st.integers(0, 12)).map(
            lambda pair: edit(min(pair), max(pair))
        ),
        max_size=4,
    )
)
def test_edits_are_refused_exactly_where_two_overlap(edits: list[Edit]) -> None:
    def overlap(one: Span, two: Span) -> bool:
        return one == two or (one.start < two.end and two.start < one.end)

    clash = any(overlap(a.span, b.span) for n, a in enumerate(edits) for b in edits[:n])
    try:
        made = apply("abcdefghijkl", edits)
    except Overlap:
        assert clash
    else:
        assert not clash
        assert len(made) == 12 + sum(
            len(each.text) - (each.span.end - each.span.start) for each in edits
        )

"""The name that was meant by an unknown one, and the bounds of the search for it."""

from __future__ import annotations

import difflib
import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.suggestions import (
    CUTOFF,
    MAX_CANDIDATES,
    MAX_LENGTH,
    MAX_SEARCHES,
    Suggestions,
    _candidates,
    did_you_mean,
    letters_and_digits,
    nearest,
)


@pytest.mark.parametrize(
    ("word", "words", "meant"),
    [
        ("load_op", ["storeOp", "loadOp"], "loadOp"),
        ("sampels", ["format", "samples"], "samples"),
        ("pAttachments", ["subpasses", "attachments"], "attachments"),
        ("Forward", ["backward", "forward"], "forward"),
        ("zzz", ["loadOp", "storeOp"], None),
        (
            "multisampled-stored",
            ["multisampled-attachment-stored"],
            "multisampled-attachment-stored",
        ),
        ("RGBA16F", ["D16_UNORM", "R16G16B16A16_SFLOAT"], "R16G16B16A16_SFLOAT"),
        ("NOPE", ["sample-count-not-portable", "nonlinear-values-averaged-for-people"], None),
        ("test", ["rasterization-samples-mismatch"], None),
        ("loadOp", [], None),
        ("colorMS", ["\0", "--"], None),
    ],
)
def test_nearest_key(word: str, words: list[str], meant: str | None) -> None:
    assert nearest(word, words) == meant


def test_long_and_many_words_are_bounded() -> None:
    assert nearest("x" * (MAX_LENGTH + 1), ["x" * (MAX_LENGTH + 1)]) is None
    assert nearest("xy", ["x" * 1_000_000, "xz", "XY"]) == "XY"

    def words() -> object:
        for n in range(MAX_CANDIDATES + 1):
            assert n < MAX_CANDIDATES
            yield f"word{n}"

    assert nearest("wrd5", words()) is not None  # type: ignore[arg-type]


def test_a_message_ends_in_the_question() -> None:
    assert did_you_mean("sampels", ["format", "samples"]) == "; did you mean `samples`?"
    assert did_you_mean("sampels", ["format", "samples"], ": ") == ": did you mean `samples`?"
    assert did_you_mean("zzz", ["format", "samples"]) == ""


def test_a_limited_number_of_names_is_searched_for() -> None:
    suggestions = Suggestions(["samples"])
    for _ in range(2):
        found = [suggestions.nearest(f"sample{number}") for number in range(MAX_SEARCHES + 1)]
        assert found == ["samples"] * MAX_SEARCHES + [None]


def test_few_candidates_are_compared_letter_by_letter(monkeypatch: pytest.MonkeyPatch) -> None:
    compared: list[str] = []
    matches = difflib.get_close_matches

    def counted(word: str, candidates: list[str], n: int, cutoff: float) -> list[str]:
        compared.extend(candidates)
        return matches(word, candidates, n, cutoff)

    monkeypatch.setattr(difflib, "get_close_matches", counted)
    words = [
        "".join(chars) for chars in itertools.product("abcdefghij", "klmnopqrst", "uvwxyz")
    ] + ["samples"]
    assert nearest("smaples", words) == "samples"
    assert compared == ["SAMPLES"]


@given(st.text("abCD_é-", max_size=12), st.lists(st.text("abcDE_é-", max_size=12), max_size=8))
def test_no_candidate_is_left_out_that_is_near(name: str, words: list[str]) -> None:
    bare = letters_and_digits(name)
    known = _candidates(tuple(words), letters_and_digits)
    near = difflib.get_close_matches(bare, known.simplified, len(words) + 1, CUTOFF)
    assert near == difflib.get_close_matches(bare, known.alike(bare), len(words) + 1, CUTOFF)

"""The name that was most likely meant by an unknown one."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import lru_cache
from itertools import islice
from typing import NamedTuple

MAX_LENGTH = 128
"""Characters of a name: no suggestion is made for a longer one, as the time to compare two grows
with the product of their lengths.
"""

MAX_CANDIDATES = 1000
"""Candidates that a name is compared with; an input may hold millions."""

MAX_SEARCHES = 50
"""Unknown names that suggestions are searched for among the same candidates."""


CUTOFF = 0.7
"""Twice the letters that two names have in common, as a share of all their letters, from which they
are near.
"""


def letters_and_digits(name: str) -> str:
    """What is left of a name without separators and in one case."""
    return "".join(filter(str.isalnum, name.upper()))


class _Candidates(NamedTuple):
    """Candidates by their letters and digits, and simplified; the letters of the latter as bits."""

    by_letters: dict[str, str]
    simplified: dict[str, str]
    letters: dict[str, int]

    def alike(self, bare: str) -> list[str]:
        """The simplified candidates that may be near a name: not those whose length, or whose
        letters that the other lacks, exclude it. difflib takes a hundred times as long for each.
        """
        bits, length = _letter_bits(bare), len(bare)
        return [
            key
            for key, others in self.letters.items()
            if 2
            * min(length - (bits & ~others).bit_count(), len(key) - (others & ~bits).bit_count())
            >= CUTOFF * (length + len(key))
        ]


@lru_cache(maxsize=32)
def _candidates(known: tuple[str, ...], simplify: Callable[[str], str]) -> _Candidates:
    """Prepared once for the names that are searched for among the same candidates."""
    by_letters: dict[str, str] = {}
    simplified: dict[str, str] = {}
    for candidate in known:
        by_letters.setdefault(letters_and_digits(candidate), candidate)
        simplified.setdefault(simplify(candidate), candidate)
    # A name of separators alone is meant by no other.
    simplified.pop("", None)
    return _Candidates(by_letters, simplified, {key: _letter_bits(key) for key in simplified})


def _letter_bits(name: str) -> int:
    """A bit for each letter; different letters may share one."""
    bits = 0
    for letter in name:
        bits |= 1 << (ord(letter) & 63)
    return bits


def nearest(
    name: str, candidates: Iterable[str], simplify: Callable[[str], str] = letters_and_digits
) -> str | None:
    """The candidate that was most likely meant by a name that is not among them; None if none is
    near.

    Names are compared by what `simplify` leaves of them. A candidate that differs in case or
    separators only comes first; then one that is equal when simplified, the shortest one that
    begins with the name, one with a single typo, the first one that begins with the same letter and
    has the others in their order (`RGBA16F`), if these are a third of its letters, and one with a
    few typos.
    """
    bare = simplify(name) if len(name) <= MAX_LENGTH else ""
    if not bare:
        return None
    known = _candidates(
        tuple(
            candidate
            for candidate in islice(candidates, MAX_CANDIDATES)
            if len(candidate) <= MAX_LENGTH
        ),
        simplify,
    )
    plain = letters_and_digits(name)
    if plain in known.by_letters:
        return known.by_letters[plain]
    simplified = known.simplified
    if bare in simplified:
        return simplified[bare]
    if len(bare) >= 3:
        longer = [candidate for key, candidate in simplified.items() if key.startswith(bare)]
        if longer:
            return min(longer, key=len)
    import difflib

    close = difflib.get_close_matches(bare, known.alike(bare), n=1, cutoff=CUTOFF)
    if close and difflib.SequenceMatcher(None, close[0], bare).ratio() > 0.9:
        return simplified[close[0]]
    if len(bare) >= 4:
        for key, candidate in simplified.items():
            letters = iter(key)
            if (
                key[0] == bare[0]
                and len(key) <= 3 * len(bare)
                and all(letter in letters for letter in bare)
            ):
                return candidate
    return simplified[close[0]] if close else None


def did_you_mean(name: str, candidates: Iterable[str], separator: str = "; ") -> str:
    """The end of a message about an unknown name: "; did you mean `samples`?", or nothing if no
    candidate is near.
    """
    return question(nearest(name, candidates), separator)


def question(candidate: str | None, separator: str = "; ") -> str:
    """The end of a message that suggests a name; nothing for None."""
    return f"{separator}did you mean `{candidate}`?" if candidate is not None else ""


def near_or_all(name: str, words: Sequence[str]) -> str:
    """What to write for an unknown word: the one that was most likely meant, or else all words."""
    close = nearest(name, words)
    return f"did you mean `{close}`?" if close else f"expected one of {', '.join(words)}"


class Suggestions:
    """Suggestions for several unknown names among the same candidates. Each name is searched for
    once, and at most MAX_SEARCHES are.
    """

    def __init__(self, candidates: Iterable[str]) -> None:
        self._candidates = candidates
        self._nearest: dict[str, str | None] = {}

    def nearest(self, name: str) -> str | None:
        """The candidate that was most likely meant by a name; None if none is near, or if too many
        names were searched for.
        """
        if name not in self._nearest and len(self._nearest) < MAX_SEARCHES:
            self._nearest[name] = nearest(name, self._candidates)
        return self._nearest.get(name)

"""What the record of a study beside a description says of sample counts."""

from collections.abc import Callable, Mapping
from typing import NamedTuple

from .facts import Facts
from .frame import Frame

NONE, JUSTIFIES, DECLINES, STALE, UNUSABLE = "NONE", "JUSTIFIES", "DECLINES", "STALE", "UNUSABLE"


class Measured(NamedTuple):
    """What a study found of a sample count: whether it is worth having above four, and why, in
    words with numbers.
    """

    justified: bool
    says: str


class Studied(NamedTuple):
    """The record of a study as it stands to a frame: `state` is NONE, STALE, UNUSABLE (`says` then
    has why), or empty where it is of this very frame; `counts` is what it found, by sample count,
    and `says` then has what it measured at all.
    """

    state: str
    says: str
    counts: Mapping[int, Measured] = {}


UNSTUDIED = Studied(NONE, "no study of it is recorded")

Finder = Callable[[Frame], Studied]
"""Finds the record of a frame's study. It is asked only where a sample count is above what the
device takes at full rate.
"""


def put_study(facts: Facts, samples: int | None, studied: Studied) -> None:
    """Adds what the record says of an image's sample count."""
    state, says = studied.state, studied.says
    if not state:
        measured = studied.counts.get(samples or 0)
        state = JUSTIFIES if measured is not None and measured.justified else DECLINES
        says = (
            measured.says
            if measured is not None
            else f"it did not measure {samples}x; {studied.says}"
        )
    facts.put("image.study", state)
    facts.put("image.study_says", says)

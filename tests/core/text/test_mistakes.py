"""Texts with a mistake made at random: one problem, in our words, where the mistake is; and in a
time that grows as the text does.
"""

from __future__ import annotations

import random
import re
import time

import pytest

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import parse
from tests.cli.test_wrong_inputs import FOREIGN
from tests.core.text.reading import Limits, reading, trouble
from tests.paths import ROOT

TEXTS = [
    path.read_text(encoding="utf-8")
    for path in (
        *sorted((ROOT / "examples" / "impeller").glob("*.yaml")),
        *sorted((ROOT / "tests" / "data").glob("*.*")),
    )
    if path.suffix in (".yaml", ".json")
]
INDICATORS = ":,[]{}\"'-#\t &*!|>%@`="


def mistaken(text: str, chance: random.Random) -> tuple[str, int]:
    """A text without one of its characters, or with one more, and the place of that."""
    at = chance.randrange(len(text))
    return (
        text[:at] + text[at + 1 :]
        if chance.random() < 0.5
        else text[:at] + chance.choice(INDICATORS) + text[at:]
    ), at


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.usefixtures("stack")
def test_a_character_more_or_less(seed: int) -> None:
    chance = random.Random(seed)
    far = count = 0
    for _ in range(25):
        text, at = mistaken(chance.choice(TEXTS), chance)
        problems = [problem for problem in reading(text).problems if problem.code == "MSAA901"]
        assert len(problems) <= 1
        for problem in problems:
            assert 0 <= problem.span.start <= problem.span.end <= len(text)
            assert all(
                0 <= label.span.start <= label.span.end <= len(text) for label in problem.labels
            )
            assert FOREIGN.search(re.sub("`[^`]*`", "", problem.message)) is None
            assert len(problem.message) < 400
            count += 1
            far += abs(text.count("\n", 0, problem.span.start) - text.count("\n", 0, at)) > 1
    # Some mistakes make another text that is right up to a later place.
    assert count > 3
    assert far <= count // 8 + 1


def elapsed(text: str) -> float:
    before = time.perf_counter()
    problems = parse(Source("x", text), Limits()).problems
    assert [problem.code for problem in problems] == ["MSAA901"]
    return time.perf_counter() - before


BODY = "  image_{n}: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}}\n"


@pytest.mark.parametrize(
    ("begin", "line", "end"),
    [
        ("images:\n", BODY, "  last 4\nframe: {}\n"),
        ("images: {\n", BODY.replace("}}\n", "}},\n"), "\n"),
        ("images:\n", BODY, "  last: [a, b\n"),
        ("images:\n", BODY, "\tlast: 4\n"),
        ('"images:\n', BODY, ""),
        ("images\n", "# {n}\n", "  last: 4\n"),
        ("images\n", "\n", "  last: 4\n"),
        ("images: a", " a: {n}", "\n"),
        ("images: [", " [{n}],", " }\n"),
        ("images: [\n", "[{n}\n],", " }\n"),
        ("images: {", " a b", ": 4}\n"),
        ("images:", " ", "@\n"),
        ("images: 'a' ", "'", "\n"),
        ("images: // ", "/ ", ": 4\n"),
        ("images: [a", " ", ": : b]\n"),
        ("images\n", "- ", ": 4\n"),
    ],
)
def test_a_long_text_with_a_mistake(begin: str, line: str, end: str) -> None:
    """Ten times the text takes about ten times as long, not a hundred times."""

    def text(size: int) -> str:
        return begin + "".join(line.format(n=n) for n in range(size // len(line))) + end

    short, long = min(elapsed(text(20_000)) for _ in range(2)), elapsed(text(200_000))
    assert long < 0.3 + 40 * short


def test_a_message_shows_little_of_a_long_line() -> None:
    for text in (
        "images " + "x" * 100_000 + "\nframe: {}\n",
        "images: [" + "x " * 50_000 + ": 4]",
        "images: {" + "é\x85" * 50_000 + "]",
    ):
        problem = trouble(text)
        assert len(problem.message) < 300

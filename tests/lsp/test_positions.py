"""Every position of every example has an answer, and what the answers change leaves the document
whole.
"""

from __future__ import annotations

import re
from contextlib import suppress
from itertools import cycle, islice
from pathlib import Path
from random import Random

import pytest
from yaml import safe_load_all

from msaa_lint.cli.lsp import completion, hover, inlay_hints, navigation, rename, symbols
from msaa_lint.cli.lsp.view import View
from msaa_lint.core.text.node import Limits
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import parse

from .views import descriptions, edited, engine, view

MAX_POSITIONS = 40
"""Positions of an example at which completions are asked for; of a short text they are at every
third.
"""

NEW = ("renamed", "with: colon", "12", "ünïcode name")
"""The new names, one for each name of an example in turn."""

PIECES = (
    "{",
    "}",
    "[",
    "]",
    ":",
    ", ",
    "\n",
    "  ",
    "- ",
    "&a ",
    "*a ",
    "<<: *a",
    "'",
    '"',
    "#",
    "|",
    ">",
    "!!str ",
    "\t",
    "---\n",
    "\ufeff",
    "é😀",
    "",
)
"""What random edits insert."""

FILES = pytest.mark.parametrize(
    "path", descriptions(), ids=lambda path: f"{path.parent.name}/{path.name}"
)

SHORT = """\
device: mali-g76
frame: {width: 1920, height: 1080, fps: 60}
images:
  ms: &ms {format: D32_SFLOAT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]}
  out:
    format: R8G8B8A8_UNORM
    samples: 1
    usage:
      - COLOR_ATTACHMENT
  "a: b": {<<: *ms, samples: 1}
renderPasses:
  main:
    attachments:
      color: {image: out, loadOp: CLEAR, storeOp: STORE}
    subpasses:
      - colorAttachments: [color]
        depthStencilAttachment: null
commands:
  - beginRenderPass: {renderPass: main}
  - endRenderPass
"""
SHORT_JSON = """\
{"images": {"ms": {"format": "D32_SFLOAT", "samples": 4, "usage": ["SAMPLED"]}},
 "commands": [{"present": {"image": "ms"}}, "endRendering"]}
"""


def problems(text: str) -> int:
    """The errors of a text's syntax."""
    return sum(
        problem.code in ("MSAA901", "MSAA906")
        for problem in parse(Source("", text), Limits()).problems
    )


def tokens(text: str) -> list[int]:
    """The offsets at which words and other characters begin, and the end of the text: all of a word
    has the same answers.
    """
    return [*(match.start() for match in re.finditer(r"[\w.-]+|[^\w\s.-]|\s+", text)), len(text)]


def typed(item: completion.Completion, text: str) -> int:
    """The errors of the syntax with anything else in its place: what follows may lack a comma
    before it.
    """
    return problems(f"{text[: item.start]} x: 1 {text[item.end :]}")


def inserted(item: completion.Completion, text: str) -> str:
    return text[: item.start] + item.text.replace("$0", "") + text[item.end :]


@FILES
def test_every_position_of_an_example_has_an_answer(path: Path) -> None:
    text = path.read_text()
    seen = view(text)
    for offset in tokens(text):
        answer = hover.hover(seen, offset)
        assert answer is None or (
            answer.markdown and answer.span.start <= offset <= answer.span.end
        )
        for span in (*navigation.definition(seen, offset), *navigation.references(seen, offset)):
            assert 0 <= span.start <= span.end <= len(text)
        found = rename.prepare(seen, offset)
        assert found is None or found.span.start <= offset + 2
    for hint in inlay_hints.hints(seen, Span(0, len(text))):
        assert hint.text.endswith(("MB/s", "mW", "(resolve)", "the resolve"))


@FILES
def test_completions_of_an_example_leave_its_syntax_whole(path: Path) -> None:
    text = path.read_text()
    seen = view(text)
    for offset in Random(path.name).sample(range(len(text) + 1), MAX_POSITIONS):
        for item in completion.complete(seen, offset, snippets=bool(offset % 2))[:12]:
            assert not problems(inserted(item, text)) or typed(item, text), (
                item,
                text[max(0, offset - 60) : offset],
            )


@pytest.mark.parametrize("text", [SHORT, SHORT_JSON], ids=["yaml", "json"])
@pytest.mark.parametrize("snippets", [False, True])
def test_completions_of_a_short_text_leave_its_syntax_whole(text: str, snippets: bool) -> None:
    seen = view(text)
    for offset in range(0, len(text) + 1, 3):
        for item in completion.complete(seen, offset, snippets)[:20]:
            assert not problems(inserted(item, text)) or typed(item, text), (
                item,
                text[max(0, offset - 60) : offset],
            )


@pytest.mark.parametrize("text", [SHORT, SHORT_JSON], ids=["yaml", "json"])
def test_completions_of_a_text_that_is_cut_off_add_no_error(text: str) -> None:
    for end in range(0, len(text), 3):
        seen = View(text[:end], "description", None, engine().registry)
        for item in completion.complete(seen, end)[:12]:
            assert problems(inserted(item, text[:end])) <= max(problems(text[:end]), 1), (
                item,
                text[max(0, end - 60) : end],
            )


@FILES
def test_symbols_enclose_their_parts(path: Path) -> None:
    pending = symbols.symbols(view(path.read_text()))
    assert pending
    while pending:
        symbol = pending.pop()
        assert symbol.name
        assert symbol.span.start <= symbol.head.start <= symbol.head.end <= symbol.span.end
        for part in symbol.children:
            assert symbol.span.start <= part.span.start <= part.span.end <= symbol.span.end, (
                symbol.name,
                part.name,
            )
        pending += symbol.children


@FILES
def test_a_name_is_renamed_and_back(path: Path) -> None:
    text = path.read_text()
    seen = view(text)
    news = cycle(NEW)
    before = [(found.code, found.severity) for found in seen.findings]
    for name, places in islice(seen.names.items(), 30):
        if not any(place.is_definition and not place.is_index for place in places):
            continue
        new = next(news)
        offset = places[0].node.end
        edits = rename.rename(seen, offset, new)
        renamed = edited(text, edits)
        assert list(safe_load_all(renamed))
        again = view(renamed)
        assert sorted((found.code, found.severity) for found in again.findings) == sorted(before), (
            name
        )
        start = min(edit.span.start for edit in edits)
        restored = edited(renamed, rename.rename(again, start + 1, name.text))
        assert list(safe_load_all(restored)) == list(safe_load_all(text))
        if new == "renamed":
            assert restored == text


@FILES
def test_a_text_after_random_edits_has_answers(path: Path) -> None:
    random = Random(path.name)
    text = path.read_text()
    for _ in range(6):
        start = random.randrange(len(text))
        text = text[:start] + random.choice(PIECES) + text[start + random.choice((0, 1, 3)) :]
        seen = view(text)
        for offset in (start, *(random.randrange(len(text) + 1) for _ in range(3))):
            hover.hover(seen, offset)
            completion.complete(seen, offset)
            navigation.references(seen, offset)
            if rename.prepare(seen, offset) is not None:
                with suppress(rename.Refused):
                    edits = rename.rename(seen, offset, "a: b")
                    assert problems(edited(text, edits)) <= problems(text)
        symbols.symbols(seen)
        inlay_hints.hints(seen, Span(0, len(text)))

"""The parts of a rule page: YAML front matter between two fences, then Markdown."""

from __future__ import annotations

import re

from msaa_lint.core.quote import quoted
from msaa_lint.core.text.span import Span

FENCE = "---"

_LIKE_A_FENCE = r"^[-.=+~]{2,}[ \t]*$"


def split(text: str) -> tuple[str | None, str]:
    """The front matter, padded with blanks so that offsets are those of the page, and the Markdown
    after it.
    """
    first = text.find("\n") + 1
    if text[:first].rstrip() != FENCE:
        return None, text
    start = text.find("\n" + FENCE, first - 1) + 1
    while start > 0:
        body = text.find("\n", start) + 1 or len(text)
        if text[start:body].rstrip() == FENCE:
            return " " * (first - 1) + "\n" + text[first:start], text[body:]
        start = text.find("\n" + FENCE, start) + 1
    return None, text


def mistake(text: str) -> tuple[str, Span]:
    """What is wrong with a page that `split` finds no front matter in, and where."""
    expected = "a rule page must begin with front matter between two `---` lines"
    if not text.strip():
        return f"{expected}, but it is empty", Span(0, 0)
    start = len(text) - len(text.lstrip())
    first = text[start:].split("\n", 1)[0].rstrip()
    if first != FENCE:
        return f"{expected}: expected `---`, found {quoted(first)}", Span(start, start + len(first))
    if start:
        return f"{expected}: remove what precedes the first one", Span(start, start + len(FENCE))
    second = re.compile(_LIKE_A_FENCE, re.MULTILINE).search(text, len(FENCE))
    if second is not None:
        return (
            f"{expected}: the second one must be `---`, found {quoted(second[0].rstrip())}",
            Span(*second.span()),
        )
    return f"{expected}: the second one is missing", Span(0, len(FENCE))


def first_sentence(body: str) -> str:
    """The first sentence of the first paragraph."""
    paragraph: list[str] = []
    for line in body.splitlines():
        text = line.strip()
        if text.startswith(("#", "```")) and not paragraph:
            continue
        if not text:
            if paragraph:
                break
            continue
        paragraph.append(text)
    joined = " ".join(paragraph)
    end = joined.find(". ")
    return joined if end < 0 else joined[: end + 1]

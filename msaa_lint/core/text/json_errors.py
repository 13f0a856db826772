"""Says which mistake makes a text invalid JSON, for texts that are read by a stricter parser than
that of descriptions.
"""

from __future__ import annotations

from .excerpts import line_end, line_start, shown, syntax
from .node import Limits, Problem
from .source import Source
from .tree import parse

MAX_DIAGNOSED = 1 << 20
"""Characters of a text that is parsed again for its mistake."""


def json_problem(text: str, at: int) -> Problem:
    """The mistake in a text that a parser of JSON refused at an offset."""
    if text.startswith(("//", "/*", "#"), at):
        return syntax("JSON has no comments; remove this one", at)
    if len(text) <= MAX_DIAGNOSED:
        syntax_errors = [
            problem
            for problem in parse(Source("", text), Limits()).problems
            if problem.code == "MSAA901"
        ]
        if syntax_errors:
            return syntax_errors[0]
    # It is YAML, but not JSON.
    at = min(at, len(text))
    while at < len(text) and text[at] in " \t\r\n":
        at += 1
    char = text[at : at + 1]
    if not char:
        return syntax("the text ends where a value is expected; the file may be truncated", at, at)
    if char == "'":
        return syntax("`'` does not begin a text in JSON; write `\"`", at)
    if char in "]}" or (char == "," and text[:at].rstrip()[-1:] in ("[", "{", ",")):
        comma = text.rfind(",", line_start(text, max(at - 1, 0)) - 1 if at else 0, at)
        at = comma if comma >= 0 and not text[comma + 1 : at].strip() else at
        return syntax(f"expected a value before `{char}`; remove the `,` before it", at)
    if char < " ":
        return syntax(
            f"the character U+{ord(char):04X} is not allowed in a JSON text; write "
            f"`\\u{ord(char):04x}`",
            at,
        )
    word = shown(
        text,
        at,
        min(
            line_end(text, at),
            next((i for i in range(at, len(text)) if text[i] in " \t\r\n,:]}"), len(text)),
        ),
    )
    if line_start(text, at) == 0 and not text[:at].strip():
        return syntax(f"expected JSON, which begins with `{{`, found {word}", at)
    return syntax(f"{word} is not a JSON value; put a text in double quotes", at)

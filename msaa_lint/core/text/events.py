"""The parser's events of a text, and its errors as problems.

libyaml reads YAML 1.1. Where YAML 1.2 and JSON differ, characters of the text are replaced before
it is parsed, one by one so that offsets stay valid: the additional line breaks of 1.1 (U+0085,
U+2028, U+2029) and JSON's escaped surrogates become characters that the text does not use, and are
replaced back in the events; tabs around a JSON text become spaces.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from yaml.error import MarkedYAMLError, YAMLError
from yaml.events import ScalarEvent

from .node import Problem, Stop
from .span import Span

Get = Callable[[], Any]

MAX_TAG_DIRECTIVES = 100
"""`%TAG` lines of a text; libyaml compares each with all the ones before it."""

# Compiled where they are used, which is rare.
_TAG_DIRECTIVE = r"(?:^|(?<=[\r\n]))%TAG"
_SURROGATE = r"(?<!\\)((?:\\\\)*+)\\u(?=[dD][89a-fA-F][0-9a-fA-F]{2})"
_PRIVATE = (range(0xE000, 0xF900), range(0xF0000, 0xFFFFE))
_BREAKS = "\x85\u2028\u2029"


def readable(text: str) -> tuple[str, str]:
    """The text for the parser, and the characters in it that stand for the `\\u` of a surrogate and
    for _BREAKS; empty if it has neither.

    Raises Stop if parsing would take too long.
    """
    # Single characters are found fastest, so they are looked for first.
    if "%" in text and text.count("%TAG") > MAX_TAG_DIRECTIVES:
        directives = list(re.finditer(_TAG_DIRECTIVE, text))[MAX_TAG_DIRECTIVES:]
        if directives:
            raise Stop(
                "MSAA906", f"more than {MAX_TAG_DIRECTIVES} %TAG directives", *directives[0].span()
            )
    if text.startswith("\ufeff"):
        text = "\n" + text[1:]
    if "\t" in text:
        text = _without_outer_tabs(text)
    if ("\\" in text and ("\\ud" in text or "\\uD" in text)) or (
        not text.isascii() and any(mark in text for mark in _BREAKS)
    ):
        return _marked(text)
    return text, ""


def parser(text: str) -> Any:
    """libyaml's parser; PyYAML's own where it was built without libyaml."""
    try:
        from yaml._yaml import CParser
    except ImportError:
        from .pure_parser import PureParser

        return PureParser(text)
    return CParser(text)


def events(text: str) -> Get:
    """A function that returns the next event. Raises Stop as `readable` does; the function raises
    it for half of a surrogate pair.
    """
    text, marks = readable(text)
    get: Get = parser(text).get_event
    return _unmarked(get, text, marks) if marks else get


def problem_of(error: Exception, text: str, max_depth: int) -> Problem:
    """The mistake behind a parser's error."""
    if not isinstance(error, MarkedYAMLError) or error.problem_mark is None:
        return Problem("MSAA901", "the text cannot be read as YAML or JSON", Span(0, 0))
    if error.problem == "exceeded maximum nesting depth":
        # libyaml from 0.2.6 on reads ahead to its own limit, 1000, before it gives the event that
        # exceeds ours.
        at = error.problem_mark.index
        return Problem("MSAA906", f"the nesting exceeds the limit of {max_depth}", Span(at, at + 1))
    from .outline import outline
    from .syntax_errors import syntax_problem

    problem = syntax_problem(
        error, text, outline(parser(readable(text)[0]), text, error.problem_mark.index)
    )
    start, end = problem.span
    return problem._replace(span=Span(min(start, len(text)), min(end, len(text))))


ERRORS = (YAMLError, ValueError)
"""What a parser raises for an invalid text."""


def _without_outer_tabs(text: str) -> str:
    """The text without tabs before and after a JSON value, which YAML does not allow there."""
    inner = text.strip(" \t\r\n")
    if inner[:1] not in ("{", "["):
        return text
    start = text.index(inner[0])
    end = start + len(inner)
    return text[:start].replace("\t", " ") + inner + text[end:].replace("\t", " ")


def _marked(text: str) -> tuple[str, str]:
    used = set(text)
    free = (chr(number) for private in _PRIVATE for number in private if chr(number) not in used)
    marks = "".join(next(free, "") for _ in range(1 + len(_BREAKS)))
    if len(marks) <= len(_BREAKS):
        return text, ""
    text = re.sub(_SURROGATE, lambda match: match[1] + 2 * marks[0], text)
    return text.translate(str.maketrans(_BREAKS, marks[1:])), marks


def _unmarked(get: Get, text: str, marks: str) -> Get:
    """The events with the marks replaced by what they stand for."""
    escape = 2 * marks[0]
    half = re.compile(f"{escape}....")
    pair = re.compile(f"{escape}([dD][89abAB]..){escape}([dD][c-fC-F]..)")
    breaks = str.maketrans(marks[1:], _BREAKS)

    def character(match: re.Match[str]) -> str:
        return chr(0x10000 + ((int(match[1], 16) - 0xD800) << 10) + int(match[2], 16) - 0xDC00)

    def lone_half(start: int, end: int) -> Stop:
        # Pairs are replaced by as many other characters, so that the first lone half keeps its
        # offset.
        match = half.search(pair.sub(12 * "_", text[start:end]))
        at = start + match.start() if match is not None else start
        escaped = text[at : at + 6].replace(escape, "\\u")
        return Stop(
            "MSAA901", f"`{escaped}` is half of a surrogate pair, not a character", at, at + 6
        )

    def unmarked() -> Any:
        event = get()
        kind = type(event)
        if kind is not ScalarEvent or event.value.isascii():
            return event
        value: str = event.value.translate(breaks)
        if escape in value and event.style == '"':
            value = pair.sub(character, value)
            if escape in value:
                raise lone_half(event.start_mark.index, event.end_mark.index)
        event.value = value.replace(escape, "\\u")
        return event

    return unmarked

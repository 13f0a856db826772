"""The parser's events of a text, and its errors in words.

libyaml reads YAML 1.1. Where 1.2, and with it JSON, is read otherwise, the text is changed for the parser, one character for one so that
places stay: the line ends that 1.1 knows besides (U+0085, U+2028, U+2029) and the escaped surrogates of JSON become characters that the
text does not use, and become what they mean again in the events; tabs around a JSON text become blanks.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from yaml.error import MarkedYAMLError, YAMLError
from yaml.events import ScalarEvent

from .node import Problem, Stop
from .span import Label, Span

Get = Callable[[], Any]

MAX_TAG_DIRECTIVES = 100
"""`%TAG` lines of a text: libyaml compares each with all before it."""

# Compiled where they are used, as most runs use none of them.
_TAG_DIRECTIVE = r"(?:^|(?<=[\r\n]))%TAG"
_SURROGATE = r"(?<!\\)((?:\\\\)*+)\\u(?=[dD][89a-fA-F][0-9a-fA-F]{2})"
_PRIVATE = (range(0xE000, 0xF900), range(0xF0000, 0xFFFFE))
_BREAKS = "\x85\u2028\u2029"
_CONTEXT = r"while (?:parsing|scanning) an? (.+)"


def readable(text: str) -> tuple[str, str]:
    """The text for the parser, and the characters that stand in it for `\\u` of a surrogate and for _BREAKS; none where there are none.

    Stop where it would take the parser too long.
    """
    # Single characters are looked for first: that takes no time.
    if "%" in text and text.count("%TAG") > MAX_TAG_DIRECTIVES:
        directives = list(re.finditer(_TAG_DIRECTIVE, text))[MAX_TAG_DIRECTIVES:]
        if directives:
            raise Stop("MSAA906", f"more %TAG directives than {MAX_TAG_DIRECTIVES}", *directives[0].span())
    if text.startswith("\ufeff"):
        text = "\n" + text[1:]
    if "\t" in text:
        text = _without_outer_tabs(text)
    if ("\\" in text and ("\\ud" in text or "\\uD" in text)) or (not text.isascii() and any(mark in text for mark in _BREAKS)):
        return _marked(text)
    return text, ""


def parser(text: str) -> Any:
    """libyaml's parser or, where PyYAML is without it, PyYAML's own."""
    try:
        from yaml._yaml import CParser
    except ImportError:
        from .pure_parser import PureParser

        return PureParser(text)
    return CParser(text)


def events(text: str) -> Get:
    """What gives the next event. Stop as `readable`, and later for half of a surrogate pair."""
    text, marks = readable(text)
    get: Get = parser(text).get_event
    return _unmarked(get, text, marks) if marks else get


def trouble(error: Exception, text: str) -> Problem:
    """A parser's error: what it is about is a label, where it says so."""
    mark = error.problem_mark if isinstance(error, MarkedYAMLError) else None
    if not isinstance(error, MarkedYAMLError) or mark is None:
        return Problem("MSAA901", f"this cannot be read: {str(error).partition(chr(10))[0][:200]}", Span(0, 0))
    start = min(mark.index, len(text))
    span = Span(start, min(start + 1, len(text)))
    problem, context = error.problem or "this cannot be read", error.context or ""
    message = _plainly(problem, text[start : start + 1]) or f"{problem} {context}".rstrip()
    begin = start if error.context_mark is None else error.context_mark.index
    about = re.fullmatch(_CONTEXT, context)
    if about is None or begin >= start:
        return Problem("MSAA901", message, span)
    return Problem("MSAA901", message, span, (Label(Span(begin, begin + 1), f"the {about[1]} begins here"),))


ERRORS = (YAMLError, ValueError)
"""What a parser raises for what a text holds."""


def _plainly(problem: str, at: str) -> str:
    """What a parser's words leave out, and how it is mended."""
    if at == "\t" and ("cannot start any token" in problem or "violates indentation" in problem):
        return "a tab cannot stand here: YAML is indented with blanks"
    if at == ":" and "',' or '}'" in problem:
        return "this `:` has no key: a key is on one line with its `:`, and has at most 1024 characters"
    return ""


def _without_outer_tabs(text: str) -> str:
    """JSON has tabs before and after the value too; within, the parser takes them."""
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
    """The events with what the marks stand for."""
    escape = 2 * marks[0]
    half = re.compile(f"{escape}....")
    pair = re.compile(f"{escape}([dD][89abAB]..){escape}([dD][c-fC-F]..)")
    breaks = str.maketrans(marks[1:], _BREAKS)

    def whole(match: re.Match[str]) -> str:
        return chr(0x10000 + ((int(match[1], 16) - 0xD800) << 10) + int(match[2], 16) - 0xDC00)

    def alone(start: int, end: int) -> Stop:
        # Pairs become as many other characters, so that the first half that is left is found at its place.
        match = half.search(pair.sub(12 * "_", text[start:end]))
        at = start + match.start() if match is not None else start
        written = text[at : at + 6].replace(escape, "\\u")
        return Stop("MSAA901", f"`{written}` is half of a surrogate pair, and no character", at, at + 6)

    def unmarked() -> Any:
        event = get()
        kind = type(event)
        if kind is not ScalarEvent or event.value.isascii():
            return event
        value: str = event.value.translate(breaks)
        if escape in value and event.style == '"':
            value = pair.sub(whole, value)
            if escape in value:
                raise alone(event.start_mark.index, event.end_mark.index)
        event.value = value.replace(escape, "\\u")
        return event

    return unmarked

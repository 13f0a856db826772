"""Mistakes in `[...]` and `{...}`, in YAML and in JSON."""

from __future__ import annotations

import re
from typing import Any

from yaml.tokens import (
    FlowEntryToken,
    FlowMappingStartToken,
    FlowSequenceStartToken,
    KeyToken,
    ScalarToken,
    ValueToken,
)

from .excerpts import indent_of, line_start, place, shown, syntax, unclosed_quote
from .node import Problem
from .outline import Bracket, Outline
from .span import Label, Span

MAX_KEY = 200
"""Characters in which the key is looked for that a plain text ends with."""

CLOSING = {"[": "]", "{": "}"}


def in_brackets(text: str, at: int, outline: Outline) -> Problem:
    """The mistake in the innermost open bracket before an offset at which a parser could not go
    on.
    """
    bracket = outline.misaligned or outline.brackets[-1]
    opening, char = text[outline.brackets[-1].start], text[at : at + 1]
    last = outline.tokens[-1]
    if type(last) is ScalarToken:
        comment = _comment(text, last)
        if comment is not None:
            return comment
        quote = text[last.start_mark.index : last.start_mark.index + 1]
        if (
            quote in ('"', "'")
            and last.style
            and "\n" in text[last.start_mark.index : last.end_mark.index]
        ):
            return unclosed_quote(text, last.start_mark.index)
    if at >= len(text.rstrip()):
        return _unclosed(
            text,
            at,
            bracket,
            len(outline.brackets),
            f"the text ends at {place(text, len(text.rstrip()))}",
        )
    if char in ("]", "}") and char != CLOSING[opening]:
        return _closed_by_another(text, at, bracket if outline.misaligned else outline.brackets[-1])
    if char == ":":
        return _at_colon(text, at, outline)
    end = last.end_mark.index
    if type(last) in (FlowEntryToken, FlowMappingStartToken, FlowSequenceStartToken) or char == ",":
        after = shown(text, last.start_mark.index, end)
        return syntax(
            f"expected a value or a key after {after}, found {shown(text, at, at + 1)}; remove one "
            "of them",
            at,
            at + 1,
        )
    if type(last) is ValueToken or type(last) is KeyToken:
        return syntax(f"expected a value, found {shown(text, at, at + 1)}", at, at + 1)
    if (
        text[end - 1 : end] in ('"', "'")
        and type(last) is ScalarToken
        and end == at
        and not text[at : at + 1].isspace()
    ):
        quotes = f"the closing quote of {shown(text, last.start_mark.index, end)}"
        message = (
            f'{shown(text, at)} follows {quotes}; a quote is missing, or a `\\"` for one in '
            "the text"
        )
        return syntax(
            message, at, at + 1, Label(Span(last.start_mark.index, end), "the quotes end here")
        )
    if opening == "{" and type(last) is ScalarToken and not _is_value(outline):
        return _missing_colon(text, at, last)
    if _continues_below(text, at, outline.brackets[-1], end):
        return _unclosed(text, at, outline.brackets[-1], 1, f"{shown(text, at)} follows")
    return missing_comma(text, last.start_mark.index, end, at)


def missing_comma(text: str, start: int, end: int, at: int) -> Problem:
    """A comma that is missing right after a value, before what stands at `at`."""
    value = shown(text, start, end) if end - start > 1 else f"`{text[start:end]}`"
    return syntax(
        f"`,` is missing after {value}, before {shown(text, at, _word_end(text, at))}", end, end
    )


def _word_end(text: str, at: int) -> int:
    match = re.compile(r"\"[^\"\r\n]{0,60}\"|'[^'\r\n]{0,60}'|[^\s,:\[\]{}]{1,60}|.").match(
        text, at
    )
    return match.end() if match is not None else at


def _unclosed(text: str, at: int, bracket: Bracket, count: int, why: str) -> Problem:
    opening = text[bracket.start]
    others = (
        f", nor are {count - 1} brackets around it"
        if count > 2
        else ", nor is the bracket around it"
        if count == 2
        else ""
    )
    closing = CLOSING[opening]
    message = f"`{opening}` is never closed{others}: {why} before its `{closing}`"
    end = min(at + 1, len(text))
    labels = (Label(Span(at, end), f"expected `{closing}` before this"),) if at < end else ()
    return syntax(message, bracket.start, bracket.start + 1, *labels)


def _closed_by_another(text: str, at: int, bracket: Bracket) -> Problem:
    opening = text[bracket.start]
    closing = CLOSING[opening]
    if line_start(text, at) == line_start(text, bracket.start):
        column = bracket.start - line_start(text, at) + 1
        message = (
            f"`{text[at]}` does not close the `{opening}` at column {column}; write "
            f"`{closing}` before it or for it"
        )
        return syntax(
            message,
            at,
            at + 1,
            Label(Span(bracket.start, bracket.start + 1), f"this `{opening}` is open"),
        )
    message = (
        f"`{opening}` is never closed: expected its `{closing}` before the `{text[at]}` at "
        f"{place(text, at)}"
    )
    return syntax(
        message,
        bracket.start,
        bracket.start + 1,
        Label(Span(at, at + 1), f"this `{text[at]}` closes another bracket"),
    )


def _at_colon(text: str, at: int, outline: Outline) -> Problem:
    """A `:` that follows no key: the key was read as part of the value before it, or there is
    none.
    """
    last, bracket = outline.tokens[-1], outline.brackets[-1]
    start, end = last.start_mark.index, last.end_mark.index
    if type(last) is not ScalarToken:
        if type(last) in (FlowEntryToken, FlowMappingStartToken, FlowSequenceStartToken):
            return syntax("expected a key before this `:`", at, at + 1)
        if type(last) is ValueToken:
            return syntax("expected a value, found another `:`; remove one of them", at, at + 1)
        return syntax(
            "this `:` has no key; a key must be on the line of its `:` and have at most 1024 "
            "characters",
            at,
            at + 1,
        )
    value = text[start:end]
    match = re.compile(r"(?<=\s)(?:\"[^\"]*\"|'[^']*'|\S+)\Z").search(
        value, max(0, len(value) - MAX_KEY)
    )
    key = start + match.start() if match is not None else start
    before = start + len(text[start:key].rstrip())
    if last.style or before <= start:
        return syntax(
            "this `:` has no key; a key must be on the line of its `:` and have at most 1024 "
            "characters",
            at,
            at + 1,
        )
    if "\n" in text[before:key] and _continues_below(text, key, bracket, before):
        return _unclosed(text, key, bracket, 1, f"the key {shown(text, key, end)} follows")
    if text[before - 1] == ";":
        return syntax("`;` does not separate entries; write `,`", before - 1, before)
    return missing_comma(text, start, before, key)


def _continues_below(text: str, at: int, bracket: Bracket, end: int) -> bool:
    """Whether what stands at an offset begins a line that is indented no deeper than the line of
    the bracket, as after a block's entry.
    """
    is_next_line = "\n" in text[end:at] and not text[line_start(text, at) : at].strip()
    begins_text = not text[: bracket.start].strip()
    return is_next_line and not begins_text and indent_of(text, at) <= bracket.indent


def _is_value(outline: Outline) -> bool:
    """Whether the last token is the value of a key, and not a key without its `:`."""
    return len(outline.tokens) > 1 and type(outline.tokens[-2]) is ValueToken


def _missing_colon(text: str, at: int, key: Any) -> Problem:
    start, end = key.start_mark.index, key.end_mark.index
    sign = re.compile(r"=>?").match(text, at)
    if sign is not None:
        return syntax(
            f"`{sign[0]}` does not separate a key and its value; write `:`", at, sign.end()
        )
    return syntax(f"`:` is missing after the key {shown(text, start, end)}", end, end)


def _comment(text: str, scalar: Any) -> Problem | None:
    """A comment as in C that was read as part of a plain text; None if there is none."""
    if scalar.style:
        return None
    match = re.compile(r"(?<!\S)(?://|/\*)").search(
        text, scalar.start_mark.index, scalar.end_mark.index
    )
    if match is None:
        return None
    return syntax(
        f"`{match[0]}` does not begin a comment here; write `#`, or remove the comment",
        *match.span(),
    )

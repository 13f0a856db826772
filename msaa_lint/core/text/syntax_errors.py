"""Says which mistake makes a text invalid YAML or JSON, in words for who wrote the text.

A parser reports where it could not go on, which is often not where the mistake is, and what it
needed there. The mistake is determined from the tokens before that place and the lines around it.
Only what is certain is said; else what was expected at that place.
"""

from __future__ import annotations

import re
from typing import Any

from yaml.error import MarkedYAMLError

from msaa_lint.core.quote import quoted

from .bracket_errors import in_brackets
from .excerpts import MAX_SHOWN, line_end, line_start, place, shown, syntax, unclosed_quote
from .node import Problem
from .outline import Outline
from .plain_lines import keyless, word_at
from .span import Label, Span

_CONFLICT = re.compile(r"^(?:<{7}|={7}|>{7})(?= |\r?$)", re.MULTILINE)
_UNCLOSED_QUOTE = (
    "unexpected end of stream",
    "unexpected document separator",
    "unexpected document indicator",
)
_HEX = {"x": "two", "u": "four", "U": "eight"}


def syntax_problem(error: MarkedYAMLError, text: str, outline: Outline) -> Problem:
    """The mistake behind a parser's error that has a place."""
    mark = error.problem_mark
    at = min(mark.index, len(text)) if mark is not None else 0
    said, context = (error.problem or "").lower(), (error.context or "").lower()
    begin = min(error.context_mark.index, at) if error.context_mark is not None else at
    conflict = _CONFLICT.search(text, line_start(text, begin), line_end(text, at))
    if conflict is not None:
        return syntax(
            "this is a merge conflict's marker; keep one side of the conflict and delete the "
            "markers",
            conflict.start(),
            conflict.end(),
        )
    if "quoted scalar" in context or "double-quoted" in context or "single-quoted" in context:
        return _in_quotes(text, at, begin, said)
    if (
        text[at : at + 1] == "\t"
        or (text[:at].endswith("\t") and "indentation" in said)
        or "tab character" in said
    ):
        return _tab(text, at)
    if "directive" in said + context or "yaml document" in said or "yaml version" in context:
        return _directive(text, at)
    name = _indicator(text, at, begin, said, context)
    if name is not None:
        return name
    if outline.brackets:
        return in_brackets(text, at, outline)
    return _in_blocks(text, at, begin, said, outline)


def _in_quotes(text: str, at: int, begin: int, said: str) -> Problem:
    quote = text[begin : begin + 1]
    if any(each in said for each in _UNCLOSED_QUOTE):
        return unclosed_quote(text, begin)
    start = text.rfind("\\", begin, at + 1)
    if start < 0 or quote != '"':
        return syntax(f"this text in quotes is invalid; check its `{quote}` and `\\`", at)
    letter = text[start + 1 : start + 2]
    if "escape code" in said:
        escape = re.compile(r"\\u?U?[0-9a-fA-F]{0,8}").match(text, start)
        end = escape.end() if escape is not None else at
        return syntax(f"`{text[start:end]}` is not a character", start, end)
    if letter and letter in _HEX:
        message = (
            f"`\\{letter}` must be followed by {_HEX[letter]} hexadecimal digits of a "
            "character; write `\\\\` for a backslash"
        )
        return syntax(message, start, start + 2)
    return syntax(
        f"`\\{letter}` is not an escape in double quotes; write `\\\\` for a backslash, or `/` in "
        "a path",
        start,
        start + 2,
    )


def _tab(text: str, at: int) -> Problem:
    while text[at - 1 : at] == "\t":
        at -= 1
    return syntax("a tab cannot be used here; indent YAML with spaces", at)


def _directive(text: str, at: int) -> Problem:
    start = at if text[at : at + 1] == "%" else text.rfind("%", 0, at + 1)
    start = max(start, 0)
    line = text[start : line_end(text, start)]
    if re.match(r"%YAML\b", line):
        return syntax(
            f"{quoted(line, MAX_SHOWN)} is not a version of YAML that is read; remove the line, or "
            "write `%YAML 1.2`",
            start,
            start + len(line),
        )
    if line.startswith("%"):
        return syntax(
            "a line that begins with `%` is a YAML directive; write `#` for a comment, or remove "
            "the line",
            start,
        )
    return syntax("expected `---` after the YAML directives", at)


def _indicator(text: str, at: int, begin: int, said: str, context: str) -> Problem | None:
    """A value that begins with a character that YAML reserves; None if the error is another."""
    if "cannot start any token" in said:
        if text.startswith("```", at):
            return syntax(
                "a Markdown fence is not YAML; remove the lines that begin with three backticks",
                at,
                at + 3,
            )
        char = "a backtick" if text[at] == "`" else f"`{text[at]}`"
        hint = (
            f'; write "{_rest(text, at)}"'
            if text[at] != "`"
            else "; remove it, or put the value in quotes"
        )
        return syntax(f"a value cannot begin with {char}{hint}", at)
    if "while scanning an alias" in context or "while scanning an anchor" in context:
        star = text[begin : begin + 1]
        kind = "an alias" if star == "*" else "an anchor"
        return syntax(
            f"`{star}` begins {kind}, so a name must follow; put the value in quotes if `{star}` "
            "is part of it",
            begin,
        )
    if " tag" in context:
        return syntax("`!` begins a YAML tag; put the value in quotes if `!` is part of it", begin)
    if "block scalar" in context:
        return syntax(
            f"{shown(text, begin)} begins a text on the following lines, and nothing may follow it "
            "on its line; put the value in quotes",
            begin,
        )
    if "mapping keys are not allowed" in said:
        return syntax("a value cannot begin with `? `; put it in quotes", at)
    return None


def _rest(text: str, at: int) -> str:
    """What stands from an offset to the end of its value."""
    match = re.compile(r"[^\s,\[\]{}\"]{0,30}").match(text, at)
    return match[0] if match is not None else ""


def _in_blocks(text: str, at: int, begin: int, said: str, outline: Outline) -> Problem:
    char = text[at : at + 1]
    last: Any = outline.tokens[-1] if outline.tokens else None
    end = last.end_mark.index if last is not None else 0
    if "mapping values are not allowed" in said:
        return _second_colon(text, at)
    if "could not find expected ':'" in said:
        return keyless(text, begin) or syntax(
            f"expected `:` after {shown(text, begin)}", begin, line_end(text, begin)
        )
    if "sequence entries are not allowed" in said:
        return syntax(
            "a list cannot begin on the line of its key; put each `- ` on a line of its own, or "
            "write `[...]`",
            at,
        )
    if char in ("]", "}"):
        opening = "[" if char == "]" else "{"
        return syntax(
            f"this `{char}` closes nothing; remove it, or add the `{opening}` that it closes", at
        )
    if "document start" in said:
        return _after_document(text, at)
    if last is not None and end > 0 and _same_line(text, end, at) and text[at] not in ",:":
        return _after_value(text, at, last)
    if char == ":":
        return syntax("expected a key before this `:`", at)
    if char == "-" and text[at + 1 : at + 2] in (" ", "\n", "\r", ""):
        return _stray_item(text, at, outline)
    return _indentation(text, at, outline)


def _second_colon(text: str, at: int) -> Problem:
    """A `:` in the value of a key on the same line, or in a line that continues the value on the
    line before it.
    """
    start = line_start(text, at)
    line = text[start:at]
    body = start + len(line) - len(line.lstrip(" "))
    same = re.match(r"(?:- +)*+(\"[^\"]*\"|'[^']*'|[^\s:#][^:#]*): +(\S.*)", text[body:at])
    if same is not None:
        bare = re.match(r"([\w.-]+) +[\[{]", same[1])
        if bare is not None:
            head = body + same.start(1)
            written = quoted(f"{bare[1]}:", MAX_SHOWN)
            return syntax(
                f"`:` is missing after the key {quoted(bare[1], MAX_SHOWN)}; write {written}",
                head,
                head + len(bare[1]),
            )
        words = same[2].split()
        key, last = quoted(same[1].strip("\"'"), MAX_SHOWN), quoted(words[-1], MAX_SHOWN)
        hint = (
            f"write {key} and {last} on lines of their own"
            if len(words) == 1
            else f"put the value in quotes, or {last} on a line of its own"
        )
        return syntax(f"a second `:` on the line of {key}: {hint}", at)
    if re.match(r"(?:- +)*+[A-Za-z_]\w*:[^\s:/\\]", text[body:at]):
        # `frame:{width: 1920}`.
        return keyless(text, body) or syntax("a space is missing after this `:`", at)
    before = _line_before(text, start)
    if before is None:
        return syntax("this `:` is not expected; put the value in quotes if it is part of it", at)
    head, tail = before
    found = keyless(text, head)
    if found is not None:
        return found
    key, column = word_at(text, head)
    if key.endswith(":") and column is not None:
        message = (
            f"{shown(text, body, at)} is indented deeper than {quoted(key[:-1], MAX_SHOWN)}, "
            "which has a value already; align them"
        )
        return syntax(
            message,
            body,
            at,
            Label(Span(head, tail), "this is the value that the line would continue"),
        )
    return syntax("this `:` is not expected; put the value in quotes if it is part of it", at)


def _line_before(text: str, start: int) -> tuple[int, int] | None:
    """The last line before an offset that is neither blank nor a comment, from its first character
    to its last.
    """
    while start > 0:
        end = start - 1
        start = line_start(text, end)
        line = text[start:end].rstrip()
        body = line.lstrip(" ")
        if body and body[0] != "#":
            return start + len(line) - len(body), start + len(line)
    return None


def _same_line(text: str, end: int, at: int) -> bool:
    between = text[end:at]
    return not between.strip() and "\n" not in between and "\r" not in between and at < len(text)


def _after_value(text: str, at: int, last: Any) -> Problem:
    """What follows a value in quotes or brackets on its line."""
    start, end = last.start_mark.index, last.end_mark.index
    quote = text[start : start + 1]
    if quote in ('"', "'") and end - start > 1:
        if "\n" in text[start:end]:
            return unclosed_quote(text, start)
        rest, closing = shown(text, at), f"the closing `{quote}` of {shown(text, start, end)}"
        hint = (
            "write `''` for an apostrophe in single quotes"
            if quote == "'"
            else 'put the whole value in quotes, and write `\\"` for a quote in it'
        )
        return syntax(
            f"{rest} follows {closing}; {hint}",
            at,
            None,
            Label(Span(start, end), "the quotes end here"),
        )
    after = f"`{text[end - 1]}`" if text[end - 1 : end] in ("]", "}") else shown(text, start, end)
    return syntax(
        f"{shown(text, at)} follows {after} on the same line; remove it, or put it on a line of "
        "its own",
        at,
    )


def _after_document(text: str, at: int) -> Problem:
    char = text[at : at + 1]
    first = re.compile(r"[ \t\r\n]*").match(text)
    begin = first.end() if first is not None else 0
    if text[begin : begin + 1] in ("{", "["):
        if char in ("{", "["):
            return syntax(
                "a second JSON value begins here; keep one value in a file, or put a line `---` "
                "before each",
                at,
            )
        if char == ",":
            return syntax(
                "this `,` follows the end of the JSON value; remove it, or put the values in one",
                at,
            )
        return syntax(
            f"{shown(text, at)} follows the end of the value that `{text[begin]}` begins at "
            f"{place(text, begin)}; remove it",
            at,
        )
    found = keyless(text, begin)
    if found is not None:
        return found
    column, least = at - line_start(text, at), begin - line_start(text, begin)
    if column < least:
        message = (
            f"{shown(text, at)} is indented less than the first line, {shown(text, begin)}; "
            "align them"
        )
        return syntax(
            message, at, None, Label(Span(begin, begin + 1), "the first line begins here")
        )
    return syntax(
        f"{shown(text, at)} follows the end of the document; indent it as the other keys, or put a "
        "line `---` before it",
        at,
    )


def _stray_item(text: str, at: int, outline: Outline) -> Problem:
    """A list item that begins at an offset where keys, or items in another column, are expected."""
    column = at - line_start(text, at)
    items = next((block for block in outline.closed if block.is_list), None)
    if items is None and outline.blocks and outline.blocks[-1].is_list:
        items = outline.blocks[-1]
    elif (
        items is None
        and len(outline.blocks) > 1
        and outline.blocks[-2].is_list
        and outline.blocks[-1].column == outline.blocks[-2].column + 2
    ):
        # The item above is a mapping that begins on the line of its `- `.
        items = outline.blocks[-2]
    if items is not None:
        first = f"the item of its list at {place(text, items.start)} by {items.column}"
        message = f"this `- ` is indented by {column} spaces, but {first}; align them"
        return syntax(
            message, at, None, Label(Span(items.start, items.start + 1), "the list begins here")
        )
    above = outline.blocks[-1] if outline.blocks else None
    among = (
        f" among the keys of the mapping that {shown(text, above.start)} begins"
        if above is not None
        else ""
    )
    return syntax(
        f"a list item cannot stand{among}; remove its `- `, or indent it below the key that it "
        "belongs to",
        at,
    )


def _indentation(text: str, at: int, outline: Outline) -> Problem:
    """A line whose indentation matches no block, or a key among list items."""
    column = at - line_start(text, at)
    above = outline.blocks[-1] if outline.blocks else None
    if above is not None and above.is_list and column == above.column:
        label = Label(Span(above.start, above.start + 1), "the list begins here")
        return syntax(
            f"{shown(text, at)} stands among list items; write `- ` before it, as at "
            f"{place(text, above.start)}",
            at,
            None,
            label,
        )
    deeper = outline.closed[-1] if outline.closed else None
    if above is not None and deeper is not None and above.column < column < deeper.column:
        message = (
            f"{shown(text, at)} is indented by {column} spaces; write {deeper.column}, as "
            f"{shown(text, deeper.start)} "
            f"at {place(text, deeper.start)} has, or {above.column}"
        )
        return syntax(
            message,
            at,
            None,
            Label(Span(deeper.start, deeper.start + 1), f"indented by {deeper.column}"),
        )
    if above is not None and not above.is_list and column > above.column and deeper is None:
        beside = (
            f"the keys beside it, as {shown(text, above.start)} at "
            f"{place(text, above.start)}, by {above.column}"
        )
        label = Label(Span(above.start, above.start + 1), f"indented by {above.column}")
        return syntax(
            f"{shown(text, at)} is indented by {column} spaces, but {beside}; align them",
            at,
            None,
            label,
        )
    if at >= len(text.rstrip()):
        return syntax("the text ends where a value or a key is expected", at, at)
    return syntax(
        f"expected a line with `key: value`, found {shown(text, at)}; check its indentation", at
    )

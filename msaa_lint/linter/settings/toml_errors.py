"""Says which mistake makes a text invalid TOML, where tomllib says what it could not read."""

from __future__ import annotations

import re

from msaa_lint.core.quote import quoted
from msaa_lint.core.text.excerpts import MAX_SHOWN, line_end, line_start, place, shown
from msaa_lint.core.text.span import Span

_TOKEN = re.compile(
    r'"""(?:[^"\\]|\\.|"{1,2}(?!"))*+"{3,5}'
    r"|'''(?:[^']|'{1,2}(?!'))*+'{3,5}"
    r'|"(?:[^"\\\r\n]|\\.)*+"'
    r"|'[^'\r\n]*+'|#[^\r\n]*+|[\[\]{}\"']",
    re.DOTALL,
)
_KEY = re.compile(r"[ \t]*((?:[\w.-]|\"[^\"\r\n]*\")+)[ \t]*")


def mistake(text: str, at: int, said: str) -> tuple[str, Span]:
    """The mistake behind tomllib's error at an offset, and its place."""
    start, rest = line_start(text, at), text[at : line_end(text, at)].strip()
    message, begin, end = _mistake(text, at, start, rest, said.lower())
    end = begin + 1 if end is None else end
    return message, Span(min(begin, len(text)), min(end, len(text)))


def _mistake(text: str, at: int, start: int, rest: str, said: str) -> tuple[str, int, int | None]:
    key = _KEY.match(text, start)
    name, after = (
        (quoted(key[1], MAX_SHOWN), text[key.end() : key.end() + 1])
        if key is not None
        else ("", "")
    )
    opened = _opened(text, at)
    opening = text[opened] if opened is not None else ""
    if "escape" in said or "hex value" in said or "unescaped" in said or "unicode scalar" in said:
        slash = max(text.rfind("\\", start, at + 1), start)
        return (
            f"`{text[slash : slash + 2]}` is not an escape in double quotes; write `\\\\`, or put "
            "the text in single quotes",
            slash,
            slash + 2,
        )
    if opened is not None and opening in "\"'":
        return (
            f"the quote {shown(text, opened)} is never closed; add the closing `{opening}`",
            opened,
            None,
        )
    if opened is not None and opening == "{" and "\n" in text[opened : at + 1]:
        return (
            "a table in `{...}` must be on one line; close it there, or write it as `[name]` with "
            "a line for each key",
            opened,
            None,
        )
    if (
        opened is not None
        and opening == "["
        and "'='" not in said
        and not said.startswith("expected ']")
    ):
        is_next_line = "\n" in text[opened:at] and not text[start:at].strip(" \t[")
        if at >= len(text.rstrip()) or (
            is_next_line
            and re.match(r"\[?[\w.\"-]+\]?\s*(?:=|$)", text[start : line_end(text, at)])
        ):
            return "`[` is never closed; add its `]`", opened, None
        if said.startswith("unclosed"):
            word = re.split(r"[\s,\]}]", rest, maxsplit=1)[0]
            return f"`,` is missing before {quoted(word, MAX_SHOWN)} in the list", at, None
    if "'='" in said:
        if after == ":":
            colon = text.index(":", start)
            entry = quoted(f"{text[start:colon].strip()} = ...", MAX_SHOWN)
            return f"`:` does not separate a key and its value in TOML; write {entry}", colon, None
        return f"`=` is missing after the key {name}", at, None
    if "overwrite" in said or "duplicate" in said or "mutate" in said:
        at_key = key.start(1) if key is not None else at
        return (
            f"duplicate key {name}; remove one of the two",
            at_key,
            key.end(1) if key is not None else None,
        )
    if "twice" in said or "redefine" in said:
        header = text[start : line_end(text, start)].strip()
        return (
            f"duplicate table {quoted(header, MAX_SHOWN)}; put the keys of both in one",
            start,
            start + len(header),
        )
    if said.startswith("expected ']"):
        return "`]` is missing at the end of the table's name", at, None
    if "invalid value" in said:
        return _value(text, at, rest)
    if "statement" in said and "after" in said:
        return (
            f"{quoted(rest, MAX_SHOWN)} follows the value; put it on a line of its own, or after "
            "`#`",
            at,
            None,
        )
    if rest.startswith(("//", "/*", ";", "--")):
        return f"`{rest[:2]}` does not begin a comment; write `#`", at, at + 2
    if rest.startswith("{"):
        return "this is JSON, not TOML; write `key = value` on each line", at, None
    if "illegal character" in said and rest:
        return f"the character U+{ord(text[at]):04X} is not allowed in TOML", at, None
    return (
        f"expected `key = value` or `[table]`, found {quoted(rest, MAX_SHOWN)} at "
        f"{place(text, at)}",
        at,
        None,
    )


def _value(text: str, at: int, rest: str) -> tuple[str, int, int | None]:
    word = re.split(r"[\s,\]}#]", rest, maxsplit=1)[0]
    if not word:
        char = rest[:1]
        if char and char != "#":
            return (
                f"a value is missing before `{char}`; remove the `,` before it, or add the value",
                at,
                None,
            )
        return "a value is missing after the `=`", at, None
    if word.lower() in ("true", "false"):
        return f"{quoted(word)} is not a value in TOML; write `{word.lower()}`", at, at + len(word)
    if word.lower() in ("null", "none", "nil"):
        return f"TOML has no {quoted(word)}; leave the key out", at, at + len(word)
    return (
        f"{quoted(word, MAX_SHOWN)} is not a value in TOML; put a text in quotes",
        at,
        at + len(word),
    )


def _opened(text: str, at: int) -> int | None:
    """The innermost bracket or quote that is open at an offset; None if none is."""
    stack: list[int] = []
    for match in _TOKEN.finditer(text, 0, at):
        token = match[0]
        if token in ('"', "'"):
            return match.start()
        if token in ("[", "{"):
            stack.append(match.start())
        elif token in ("]", "}") and stack:
            stack.pop()
    while len(stack) > 1 and line_start(text, stack[-1]) == stack[-1]:
        # The name of a table, after a list that is not closed.
        stack.pop()
    return stack[-1] if stack else None

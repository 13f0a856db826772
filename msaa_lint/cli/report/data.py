"""JSON text of a report: ASCII only, one list element per line, no NaN."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping

from msaa_lint.core.finding import Result
from msaa_lint.core.text.span import Span

from . import Write
from .escape import MAX_LENGTH, clip, escape_json, escape_surrogates
from .place import place

Json = dict[str, object]

SEPARATOR = ",\n    "
"""What is between the elements of a list of a report."""


class Dumped(str):
    """JSON of an element of a list of a report, or of several with `SEPARATOR` between them."""


_ENCODER = json.JSONEncoder(ensure_ascii=True, allow_nan=False)
"""Made once: `json.dumps` with these options makes one for each value."""


def dump(value: object) -> str:
    """`value` on one line. It is ASCII, so every encoding of an output stream can hold it, and no
    terminal and no CI runner acts on it.
    """
    return value if isinstance(value, Dumped) else escape_json(_ENCODER.encode(value))


def dump_indented(value: object) -> str:
    """`value` on as many lines as it has members, otherwise as `dump`."""
    return escape_json(json.dumps(value, indent=2))


def text(value: str) -> str:
    """Text of an input, a driver, or a layer: unchanged, except lone surrogates and what exceeds
    `escape.MAX_LENGTH`.
    """
    # Nearly all of them are short and ASCII, and a large report has millions.
    return value if len(value) <= MAX_LENGTH and value.isascii() else escape_surrogates(clip(value))


def rounded(value: float | None) -> float | None:
    """A figure with six decimals, which JSON can hold; `-0.0` becomes 0."""
    return None if value is None else round(value, 6) + 0.0


def write_object(members: Mapping[str, object], out: Write) -> None:
    """A JSON object with one member per line. Lists and iterators have one element per line, so
    that a large report is neither built as a whole nor one endless line.
    """
    separator = "{\n"
    for key, value in members.items():
        out(f"{separator}  {dump(key)}: ")
        separator = ",\n"
        if isinstance(value, (list, Iterator)):
            write_list(value, out, "  ")
        else:
            out(dump(value))
    out("\n}\n")


def write_list(items: Iterable[object], out: Write, indent: str = "") -> None:
    """A JSON list with one element per line."""
    separator = "["
    for item in items:
        out(f"{separator}\n{indent}  {dump(item)}")
        separator = ","
    out("[]" if separator == "[" else f"\n{indent}]")


def head(schema: str, version: str) -> Json:
    """The members that every report begins with."""
    return {"schema": schema, "version": version} if version else {"schema": schema}


def start(result: Result, file: str, span: Span | None) -> Json:
    """The line and column where a span begins; null for an input without text."""
    at = place(result, file, span)
    return {"line": at.line if at else None, "column": at.column if at else None}

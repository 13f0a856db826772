"""JSON text of a report: ASCII alone, one element of a list per line, no NaN."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from . import Write


def dump(value: object) -> str:
    """`value` on one line. ASCII, so that any encoding of an output stream holds it and no terminal acts on it."""
    import json

    return json.dumps(value, ensure_ascii=True, allow_nan=False)


def write_list(items: Iterable[object], out: Write, indent: str = "") -> None:
    """A JSON list with an element per line, so that a large report is neither built whole nor one endless line."""
    first = True
    for item in items:
        out(("[" if first else ",") + f"\n{indent}  {dump(item)}")
        first = False
    out("[]" if first else f"\n{indent}]")

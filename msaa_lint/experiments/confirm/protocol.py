"""What parent and child say to each other: JSON objects, one a line.

The child is asked on its standard input and answers on what was its standard output; what its driver and its layer print goes elsewhere.
Neither trusts the other's lines to be whole: a driver may write over the child's memory, or over its pipes.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

MAX_LINE = 8 << 20
"""Bytes of one line, at most: a plan of many passes, or a long message of the layer."""

EVENTS = frozenset({"opened", "devices", "failed", "pass", "created", "message", "pixels", "time", "sample", "done"})
"""What the child may say. `opened`: the device and the layer there are; `failed`: why a request cannot be done, `kind` says by whom
(`environment`, `memory`, `program`); the others are `execute.run`'s."""

Event = dict[str, Any]


class ProtocolError(Exception):
    """A line that no sane child writes, in words."""


def line(request: Mapping[str, Any]) -> bytes:
    """A request or an answer as its line."""
    return json.dumps(request, separators=(",", ":"), allow_nan=False).encode("ascii") + b"\n"


def event(text: bytes) -> Event:
    """The answer that a line holds. Garbage where it holds none."""
    if not text.endswith(b"\n"):
        raise ProtocolError("a line that is cut off" if len(text) < MAX_LINE else "a line without an end")
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        raise ProtocolError("a line that is no JSON") from None
    if not isinstance(found, dict) or found.get("event") not in EVENTS:
        raise ProtocolError("an answer to nothing that was asked")
    if not _WELL_FORMED[found["event"]](found):
        raise ProtocolError(f"an answer `{found['event']}` that lacks a part")
    return found


def _number(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 1 << 31


def _any(_: Event) -> bool:
    return True


def _numbered(found: Event) -> bool:
    return _number(found.get("pass"))


_WELL_FORMED: dict[str, Callable[[Event], bool]] = {
    **dict.fromkeys(EVENTS, _any),
    "pass": _numbered,
    "created": lambda found: _numbered(found) and isinstance(found.get("ok"), bool),
    "message": lambda found: (
        (found.get("pass") is None or _numbered(found)) and isinstance(found.get("id"), str) and isinstance(found.get("text"), str)
    ),
    "pixels": lambda found: (
        all(isinstance(found.get(name), str) for name in ("image", "path"))
        and all(_number(found.get(name)) for name in ("format", "width", "height"))
    ),
    "sample": lambda found: (
        all(isinstance(found.get(name), str) for name in ("image", "path"))
        and all(_number(found.get(name)) for name in ("format", "width", "height", "samples"))
    ),
    "time": lambda found: _numbered(found) and isinstance(found.get("ms"), (int, float)) and 0 <= found["ms"] < 1e9,
    "failed": lambda found: isinstance(found.get("reason"), str),
    "opened": lambda found: isinstance(found.get("device"), dict),
    "devices": lambda found: isinstance(found.get("devices"), list),
}

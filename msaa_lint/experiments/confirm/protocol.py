"""The messages between parent and child: JSON objects, one per line.

The child reads requests from its standard input and writes answers to its original standard output;
the output of driver and layer goes elsewhere. Lines may be corrupt: a driver may overwrite the
child's memory or write to its pipes.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from types import NoneType
from typing import Any

MAX_LINE = 8 << 20
"""Maximum size of a line in bytes: a plan with many passes, or a long message of the layer."""

EVENTS = frozenset(
    {
        "opened",
        "devices",
        "failed",
        "pass",
        "created",
        "message",
        "pixels",
        "defined",
        "time",
        "sample",
        "warmed",
        "invocations",
        "done",
    }
)
"""The child's answers. `opened` has the device and the layer; `failed` has the reason and its
`kind` (`environment`, `memory`, `program`); the others come from `execute.run` and
`interleaved.run`.
"""

Event = dict[str, Any]


class ProtocolError(Exception):
    """A line that a working child would not write; the message describes it."""


def line(request: Mapping[str, Any]) -> bytes:
    """The line of a request or an answer."""
    return json.dumps(request, separators=(",", ":"), allow_nan=False).encode("ascii") + b"\n"


def event(text: bytes) -> Event:
    """The answer in a line. ProtocolError for a malformed line."""
    if not text.endswith(b"\n"):
        raise ProtocolError(
            "a truncated line" if len(text) < MAX_LINE else "a line that is too long"
        )
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        raise ProtocolError("a line that is not JSON") from None
    if not isinstance(found, dict) or found.get("event") not in EVENTS:
        raise ProtocolError("an unknown answer")
    if not _WELL_FORMED[found["event"]](found):
        raise ProtocolError(f"a malformed answer `{found['event']}`")
    return found


def _number(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 1 << 31


def _numbered(found: Event) -> bool:
    return _number(found.get("pass"))


def _image(found: Event, *numbers: str) -> bool:
    return all(isinstance(found.get(name), str) for name in ("image", "path")) and all(
        _number(found.get(name)) for name in numbers
    )


_WELL_FORMED: dict[str, Callable[[Event], bool]] = {
    "done": lambda _: True,
    "pass": _numbered,
    "created": lambda found: _numbered(found) and isinstance(found.get("ok"), bool),
    "message": lambda found: (
        (found.get("pass") is None or _numbered(found))
        and isinstance(found.get("image"), (str, NoneType))
        and isinstance(found.get("id"), str)
        and isinstance(found.get("text"), str)
    ),
    "pixels": lambda found: (
        _image(found, "format", "width", "height")
        and all(isinstance(found.get(name), bool) for name in ("defined", "discarded"))
    ),
    "defined": lambda found: isinstance(found.get("image"), str),
    "sample": lambda found: _image(found, "format", "width", "height", "samples"),
    "time": lambda found: (
        _numbered(found) and isinstance(found.get("ms"), (int, float)) and 0 <= found["ms"] < 1e9
    ),
    "warmed": lambda found: isinstance(found.get("stable"), bool),
    "invocations": lambda found: (
        _numbered(found)
        and _number(found.get("of", 0))
        and isinstance(found.get("count"), int)
        and found["count"] >= 0
    ),
    "failed": lambda found: isinstance(found.get("reason"), str),
    "opened": lambda found: isinstance(found.get("device"), dict),
    "devices": lambda found: isinstance(found.get("devices"), list),
}

"""A capture read to its end, or as far as it goes, and the findings of it."""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
import re
from collections.abc import Hashable, Mapping, Sequence
from importlib import import_module
from typing import BinaryIO, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import CaptureLocation, Finding
from msaa_lint.core.text.source import Origin, Source
from msaa_lint.core.text.span import Span

from .captures.call import CaptureError
from .captures.description_text import describe_capture
from .captures.tracker import Tracker

_DOCUMENT = re.compile(r"documents\[\d+\]\.")
_COMMAND = re.compile(r"commands\[\d+\]")


class CaptureInput(NamedTuple):
    """A capture as a description.

    `source` is its text, which leads back to the calls; `modules` the code of the shaders that it names. `broken` says why the rest could
    not be read, and stands at the last line of the text; empty where the capture is whole. `notes` are lines for people: what the capture
    leaves out.
    """

    source: Source
    modules: Mapping[str, bytes]
    frames: int
    broken: str
    notes: tuple[str, ...]


def captured(stream: BinaryIO, format: str, name: str, path: str | None) -> CaptureInput:
    """Reads a capture of a format (one of `readers.CAPTURES`) from a binary stream.

    `name` is what findings call it, `path` where it lies, for the files that belong to it; None for a stream. Nothing raises for what the
    capture holds. Memory does not grow with its length.
    """
    module = import_module(f".readers.{format.replace('-', '_')}", __package__)
    tracker = Tracker()
    broken: CaptureError | None = None
    try:
        for call in module.calls(stream, tracker.wanted, path):
            tracker.feed(call)
    except CaptureError as error:
        broken = error
    tracker.finish()
    made = describe_capture(tracker)
    text, origins = made.text, made.origins
    notes = []
    if tracker.frames.truncated:
        notes.append(f"{name}: the last entry is truncated and was skipped")
    if made.dropped:
        notes.append(f"{name}: {made.dropped} of {made.frames} frames were not linted because the capture has too many kinds of frames")
    if broken is not None:
        text += "# the capture is readable up to here\n"
        origins.append(Origin(*broken.place, ""))
    return CaptureInput(Source(name, text, origins), made.modules, made.frames, broken.message if broken is not None else "", tuple(notes))


def capture_findings(capture: CaptureInput, findings: Sequence[Finding]) -> list[Finding]:
    """The findings as a capture's. One that ends in the middle has an error more, where it ends."""
    kept: dict[Hashable, Finding] = {}
    for found in findings:
        own = _seen(capture, found)
        if own.fix is not None:
            # The text that an edit would change is no file's.
            own = own._replace(fix=own.fix._replace(edits=(), shown=True))
        key = (own.rule, own.severity, own.message, _COMMAND.sub("commands", _DOCUMENT.sub("", own.subject, count=1)))
        before = kept.get(key)
        if before is None or before.subject == own.subject:
            kept[key if before is None else (key, len(kept))] = own
        elif before.seen is not None and own.seen is not None and _COMMAND.search(own.subject):
            # Another kind of frame records the same.
            frames = (before.seen.frames or 0) + (own.seen.frames or 0)
            kept[key] = before._replace(seen=before.seen._replace(frames=min(frames, before.seen.of) or None))
    made = list(kept.values())
    if capture.broken:
        text = capture.source.text
        start = text.rfind("\n", 0, len(text) - 1) + 1
        made.append(diagnostic("MSAA901", f"the capture ends here: {capture.broken}", capture.source.name, Span(start, len(text) - 1)))
    return made


def _seen(capture: CaptureInput, found: Finding) -> Finding:
    origin = capture.source.origin(found.span.start) if found.span is not None else None
    if origin is None or not origin.by:
        return found
    return found._replace(seen=CaptureLocation(origin.by, origin.call, origin.frames, origin.of))

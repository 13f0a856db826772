"""Captures read as descriptions, and findings about them."""

from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import BinaryIO, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import CaptureLocation, CaptureSummary, Finding
from msaa_lint.core.quote import quoted
from msaa_lint.core.suggestions import did_you_mean
from msaa_lint.core.text.source import Origin, Source, Unreadable
from msaa_lint.core.text.span import Span

from . import reading_progress
from .capture_stream import CaptureStream
from .captures.call import CaptureError, Place
from .captures.description_text import describe_capture
from .captures.summary import capture_summary
from .captures.tracker import Tracker
from .reading_progress import ObservedStream


class CaptureInput(NamedTuple):
    """A capture converted to a description.

    `format` is one of `readers.CAPTURES`. `source` is the text of the description, whose origins
    are the captured calls; `modules` is the code of its shaders by name. `broken` says why the rest
    of the capture could not be read, which the last line of the text stands for; empty if all was
    read. `limits` say what is not checked because it exceeds a limit, with the lines of the text
    that stand for it. `notes` are lines for the user about what is missing.
    """

    format: str
    source: Source
    modules: Mapping[str, bytes]
    frames: int
    broken: str
    limits: tuple[tuple[str, Span], ...]
    notes: tuple[str, ...]
    summary: CaptureSummary

    @property
    def description(self) -> str:
        """The text of the description."""
        return self.source.text


def read_capture(
    stream: BinaryIO,
    format: str,
    name: str,
    path: str | None,
    is_binary: bool = False,
    frame_end: str | None = None,
) -> CaptureInput:
    """Reads a capture of a format (one of `readers.CAPTURES`) from a binary stream, in memory that
    does not grow with its length.

    `name` is the capture's name in findings. `path` locates the files that belong to it; None for a
    stream. The lines of the stream are not those of the capture if it `is_binary`. `frame_end` says
    what ends a frame: `present`, `submit`, or `label:` and the text of a debug label; None if the
    capture shows it. An invalid capture does not raise; Unreadable if a capture lacks the label.
    """
    module = import_module(f".readers.{format.replace('-', '_')}", __package__)
    tracker = Tracker(frame_end)
    broken: CaptureError | None = None
    place = Place(1, 1)
    observer = reading_progress.observer
    observed = (
        stream
        if observer is None
        else ObservedStream(stream, name, lambda: tracker.frames.total, observer)
    )
    try:
        for call in module.calls(observed, tracker.wanted, path):
            tracker.feed(call)
            place = call.at
    except CaptureError as error:
        broken = error
        place = error.place
    if observer is not None:
        observer.finish()
    failure = stream.failure if isinstance(stream, CaptureStream) else None
    if failure is not None:
        # The reader only saw that the text ended, perhaps between two calls.
        broken = None if failure.is_limit else CaptureError(str(failure), place)
        if failure.is_limit:
            tracker.frames.limits[str(failure)] = place
    tracker.finish()
    text, origins, modules, left_out = describe_capture(tracker)
    notes = _frame_end_notes(tracker, name)
    if tracker.frames.truncated:
        notes.append(f"{name}: the last entry is truncated and was skipped")
    if tracker.frames.dropped:
        count = f"{tracker.frames.dropped} of {tracker.frames.total} frames"
        notes.append(
            f"{name}: {count} were not linted because the capture has too many kinds of frames"
        )
    limits = []
    for limit, place in tracker.frames.limits.items():
        comment = f"# {limit}"
        limits.append((limit, Span(len(text), len(text) + len(comment))))
        text += f"{comment}\n"
        origins.append(Origin(*place, ""))
    if broken is not None:
        text += "# the capture is readable up to here\n"
        origins.append(Origin(*broken.place, ""))
    if is_binary:
        origins = [origin and origin._replace(line=None, column=None) for origin in origins]
    message = broken.message if broken is not None else ""
    source, summary = Source(name, text, origins), capture_summary(tracker, left_out)
    return CaptureInput(
        format, source, modules, tracker.frames.total, message, tuple(limits), tuple(notes), summary
    )


def _frame_end_notes(tracker: Tracker, name: str) -> list[str]:
    """What the option for the end of frames did not do. Unreadable if the capture lacks the
    label.
    """
    frames = tracker.frames
    if frames.frame_end is None:
        return []
    if frames.frameless:
        return [f"{name}: `--frame-end` is ignored: the capture is a single frame"]
    label = frames.frame_label
    if label is not None and not label.is_found:
        others = list(label.others)
        hint = did_you_mean(label.text, others) or (
            f"; it has {', '.join(map(quoted, others[:5]))}" if others else "; it has no labels"
        )
        raise Unreadable(
            f"the capture has no debug label {quoted(label.text)}, which `--frame-end` names{hint}"
        )
    if frames.frame_end == "present" and frames.total and not frames.is_marked:
        return [
            f"{name}: the capture presents nothing, so that it is one frame: `--frame-end submit` "
            "ends frames at submissions"
        ]
    return []


def located_findings(capture: CaptureInput, findings: Sequence[Finding]) -> list[Finding]:
    """The findings of the description of a capture, with their locations in the capture."""
    located = []
    for finding in findings:
        if finding.fix is not None:
            # There is no file with the text that the fix would edit.
            finding = finding._replace(fix=finding.fix._replace(edits=(), shown=True))
        origin = capture.source.origin(finding.span.start) if finding.span is not None else None
        if origin is not None and origin.by:
            finding = finding._replace(
                capture_location=CaptureLocation(origin.by, origin.call, origin.frames, origin.of)
            )
        located.append(finding)
    return located


def capture_problems(capture: CaptureInput) -> list[Finding]:
    """The findings about what of a capture is not checked."""
    result = limit_findings(capture)
    if capture.broken:
        text = capture.source.text
        start = text.rfind("\n", 0, len(text) - 1) + 1
        result.append(
            diagnostic(
                "MSAA901",
                f"the capture ends here: {capture.broken}",
                capture.source.name,
                Span(start, len(text) - 1),
            )
        )
    return result


def limit_findings(capture: CaptureInput) -> list[Finding]:
    """The findings about what of a capture is not checked because it exceeds a limit."""
    return [
        diagnostic("MSAA906", f"limit exceeded: {limit}", capture.source.name, span)
        for limit, span in capture.limits
    ]

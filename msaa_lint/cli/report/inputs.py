"""What of the inputs was checked, in words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from msaa_lint.core.finding import InputSummary, Result
from msaa_lint.input.file_types import LANGUAGES

from . import Options
from .escape import display
from .paths import display_path
from .place import place
from .words import plural

COUNTS = ("images", "passes", "pipelines", "shaders", "choices")
"""The counts of an `InputSummary`."""

_FORMATS = {
    "description": "description",
    "vulkan-sc": "Vulkan SC pipeline",
    "gfxreconstruct": "gfxreconstruct capture",
    "api-dump": "api_dump capture",
    "renderdoc": "RenderDoc capture",
    "fossilize": "Fossilize archive",
    "c": "C file",
    "cpp": "C++ file",
    "objc": "Objective-C file",
    "objcpp": "Objective-C++ file",
    "swift": "Swift file",
    "rust": "Rust file",
    "glsl": "GLSL file",
    "markdown": "Markdown page",
    "asciidoc": "AsciiDoc page",
    "rst": "reStructuredText page",
    "": "unreadable file",
}
"""What an input of each format is called."""

_NOUNS = ("image", "pass", "pipeline", "shader", "sample count choice")

SOURCE = frozenset(LANGUAGES)
"""The formats of source code."""


def checked(inputs: Iterable[InputSummary]) -> str:
    """`2 descriptions: 5 images, 3 passes; 1 C++ file: nothing read`; empty if nothing is known of
    the inputs.
    """
    by_format: dict[str, Counter[str]] = {}
    for each in inputs:
        totals = by_format.setdefault(each.format, Counter())
        counts = {count: getattr(each, count) for count in COUNTS}
        totals.update(counts)
        totals["inputs"] += 1
        if each.failed:
            totals["failed in part" if any(counts.values()) else "failed"] += 1
        totals["unread"] += each.unread is not None
    ordered = sorted(by_format.items(), key=lambda item: list(_FORMATS).index(item[0]))
    return "; ".join(_of_format(format, totals) for format, totals in ordered)


def _of_format(format: str, totals: Counter[str]) -> str:
    """`2 descriptions: 5 images, 3 passes, 1 not checked because of errors`."""
    name = plural(totals["inputs"], _FORMATS[format])
    if not format:
        return name
    parts = [
        plural(totals[count], noun)
        for count, noun in zip(COUNTS, _NOUNS, strict=True)
        if totals[count]
    ]
    for key, words in (
        ("failed", "not checked because of errors"),
        ("failed in part", "checked in part because of errors"),
    ):
        if totals[key]:
            parts.append(f"{totals[key]} {words}")
    if format in SOURCE and totals["unread"] and parts:
        parts.append(f"{totals['unread']} not understood")
    return (
        f"{name}: "
        f"{', '.join(parts) or ('nothing read' if format in SOURCE else 'nothing to check')}"
    )


def captured(result: Result, options: Options) -> list[str]:
    """A line for each capture: the program, the device, the frames, and the passes; and what of it
    was left out.

    None for a capture of which nothing was read: its error says why.
    """
    inputs = [
        each
        for each in result.inputs
        if each.capture and (each.capture.frames or each.capture.passes or not each.failed)
    ]
    lines = [_capture_line(each, options) for each in inputs[: options.max_unread]]
    return [
        *lines,
        *(
            [f"{plural(len(inputs) - len(lines), 'more capture')}"]
            if len(inputs) > len(lines)
            else []
        ),
    ]


def _capture_line(summary: InputSummary, options: Options) -> str:
    """`game.jsonl: glxgears (mesa zink) on llvmpipe: 10 frames of 2 kinds, 3 passes, 1 with 4x`."""
    capture = summary.capture
    assert capture is not None
    program = (
        f"{capture.program} ({capture.engine})"
        if capture.program and capture.engine
        else capture.program or capture.engine
    )
    origin = " on ".join(
        filter(None, (program or ("a program" if capture.device else ""), capture.device))
    )
    multisampled = [
        f"{count} with {samples}x" for samples, count in capture.passes.items() if samples > 1
    ]
    passes = sum(capture.passes.values())
    kinds = f" of {capture.kinds} kinds" if capture.kinds > 1 else ""
    frames = f"{plural(capture.frames, 'frame')}{kinds}" if capture.frames else "no frames"
    parts = [frames, plural(passes, "pass") if passes else "no passes"]
    if multisampled:
        parts += multisampled
    elif capture.multisampled_pipelines and not passes:
        parts.append(f"{plural(capture.multisampled_pipelines, 'multisampled pipeline')}")
    elif capture.multisampled_images or capture.multisampled_pipelines:
        parts.append("none multisampled")
    else:
        parts.append("nothing is multisampled")
    if capture.dropped_frames:
        parts.append(
            f"{plural(capture.dropped_frames, 'frame')} not checked, because there are too many "
            "kinds of frame"
        )
    if capture.left_out:
        parts.append(f"without {display(capture.left_out)}")
    return ": ".join(
        filter(None, (display_path(summary.file, options.root), display(origin), ", ".join(parts)))
    )


def unread_inputs(result: Result) -> list[InputSummary]:
    """The inputs that create something multisampled of which no pass was checked, unless a finding
    says so.
    """
    reported = {finding.file for finding in result.findings if finding.code == "MSAA931"}
    return [each for each in result.inputs if each.unread is not None and each.file not in reported]


def unread(result: Result, options: Options) -> list[str]:
    """A line for each of `unread_inputs`, as far as there is room."""
    inputs = unread_inputs(result)
    lines = [unread_line(each, result, options) for each in inputs[: options.max_unread]]
    if len(inputs) > len(lines):
        lines.append(f"{plural(len(inputs) - len(lines), 'more file')} not checked")
    if lines:
        lines.append("--strict-inputs makes inputs that are not checked an error")
    return lines


def unread_line(summary: InputSummary, result: Result, options: Options) -> str:
    """`src/main.cpp:12:5: not checked: ...`."""
    assert summary.unread is not None
    at = place(result, summary.file, summary.unread.span)
    where = display_path(summary.file, options.root) + (
        f":{at.line}:{at.column}" if at is not None else ""
    )
    return f"{where}: not checked: {display(summary.unread.message)}"

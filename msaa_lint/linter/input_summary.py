"""What of an input was checked: how many images, passes, and pipelines, and what it creates that no
rule saw.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Hashable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from msaa_lint.core.finding import InputSummary, Unread
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import BeginRendering, ReadImage
from msaa_lint.frame.description.record import Record

from .results import FileResult

if TYPE_CHECKING:
    from msaa_lint.input.capture_input import CaptureInput
    from msaa_lint.input.code.parsing import Code
    from msaa_lint.input.code.unknowns import Unknowns
    from msaa_lint.input.source_file import CodeFile, SourceFile


def input_summaries(
    data: bytes | CaptureInput | SourceFile, result: FileResult
) -> list[InputSummary]:
    """The summaries of an input that was linted: of a program, one for each of its files that is an
    input.
    """
    device = next((each.device.name for each in result.documents if each.device is not None), "")
    return [summary._replace(device=device) for summary in _input_summaries(data, result)]


def _input_summaries(
    data: bytes | CaptureInput | SourceFile, result: FileResult
) -> list[InputSummary]:
    files = () if isinstance(data, bytes) else getattr(data, "files", ())
    if isinstance(data, bytes) or len(files) < 2:
        return [input_summary(data, result)]
    documents = [each.document for each in result.documents if each.checked]
    fatal = {finding.file for finding in result.findings if finding.fatal}
    unknowns = _unknowns(files)
    stated = _starts(documents)
    summaries = []
    for file in files:
        if file.is_input:
            within = Span(file.start, file.start + len(file.source.text))
            counts = _summary(
                file.source.name, file.language, documents, file.source.name in fatal, None, within
            )
            # What a file states may be of images and passes that another file creates.
            is_read = bisect_left(stated, within.start) < bisect_left(stated, within.end)
            unread = _unread_code(file.codes, documents if is_read else (), False, unknowns)
            summaries.append(counts._replace(unread=unread))
    return summaries


def input_summary(data: bytes | CaptureInput | SourceFile, result: FileResult) -> InputSummary:
    """The summary of one input that was linted."""
    documents = [each.document for each in result.documents if each.checked]
    failed = len(documents) < len(result.documents) or any(
        finding.fatal for finding in result.findings
    )
    if isinstance(data, bytes):
        format = next((each.document.format for each in result.documents), "")
        # What an error hides may be the pass.
        unread = (
            _unread_frame(documents, "add `renderPasses` or `beginRendering` commands")
            if not failed
            else None
        )
        count = len(result.documents) if format == "description" else None
        return _summary(result.file, format, documents, failed, unread)._replace(frames=count)
    from msaa_lint.input.source_file import SourceFile

    if isinstance(data, SourceFile):
        # What is known of the images that a shader reads, and of its pipeline, is that they are
        # there.
        shaders = [document for document in documents if _is_shader(document)]
        frames = [document for document in documents if not _is_shader(document)]
        unread = _unread_code(data.program.codes, frames, bool(shaders), _unknowns(data.files))
        return _summary(result.file, data.language, frames, failed, unread)._replace(
            shaders=len(shaders)
        )
    unread = _unread_frame(documents, "capture a whole frame")
    return _summary(result.file, data.format, documents, failed, unread)._replace(
        capture=data.summary
    )


def _summary(
    file: str,
    format: str,
    documents: Iterable[Document],
    failed: bool,
    unread: Unread | None,
    within: Span | None = None,
) -> InputSummary:
    """The summary of documents, of a program what they state `within` one of its files."""
    images, passes, pipelines, choices = (
        set[Hashable](),
        set[Hashable](),
        set[Hashable](),
        set[Hashable](),
    )
    for document in documents:
        frame = document.description
        sections: list[tuple[set[Hashable], Mapping[str, Record]]] = [
            (images, frame.images),
            (passes, frame.renderPasses),
            (pipelines, frame.pipelines),
            (choices, frame.sampleCountChoices),
        ]
        for distinct, section in sections:
            distinct.update(
                _identity(document.source, record, name)
                for name, record in section.items()
                if _is_in(record, within)
            )
        renderings = _commands(document, BeginRendering)
        passes.update(
            _identity(document.source, rendering)
            for rendering in renderings
            if _is_in(rendering, within)
        )
    return InputSummary(
        file, format, len(images), len(passes), len(pipelines), 0, len(choices), failed, unread
    )


def _is_in(record: Record, within: Span | None) -> bool:
    """Whether a record is stated in a range of the text."""
    return within is None or within.start <= record.head.start <= within.end


def _commands(document: Document, kind: type[Record]) -> list[Record]:
    """The parameters of the commands that have parameters of a type."""
    return [
        command.body
        for command in document.description.commands or ()
        if command is not None and isinstance(command.body, kind)
    ]


def _identity(source: Source, record: Record, name: str = "") -> Hashable:
    """What tells a record from others of its input: where it is stated; in a capture, the call that
    creates it.
    """
    origin = source.origin(record.head.start) if source.origins is not None else None
    return record.head if origin is None else (origin[:3], name)


def _is_shader(document: Document) -> bool:
    """Whether a document of source code is a shader that reads samples."""
    return bool(_commands(document, ReadImage))


def _unread_frame(documents: Iterable[Document], help: str) -> Unread | None:
    """The first multisampled image of an input without a pass; `help` says how to give it one."""
    first: Unread | None = None
    for document in documents:
        frame = document.description
        if frame.renderPasses or _commands(document, BeginRendering):
            return None
        image = next((image for image in frame.images.values() if (image.samples or 1) > 1), None)
        if image is not None and first is None:
            message = (
                f"{quoted(image.key)} has {image.samples} samples, but the input has no pass "
                f"that uses it; {help}"
            )
            first = Unread(image.place("samples"), message)
    return first


def _starts(documents: Iterable[Document]) -> list[int]:
    """The places in the text of a program, in order, at which it states what documents contain."""
    stack = [document.tree for document in documents if document.tree is not None]
    starts = []
    while stack:
        node = stack.pop()
        if node.kind == "mapping":
            stack += node.value.values()
        elif node.kind == "sequence":
            stack += node.value
        else:
            starts.append(node.span.start)
    return sorted(starts)


def _unknowns(files: Iterable[CodeFile]) -> Unknowns:
    from msaa_lint.input.code.unknowns import SearchedFile, Unknowns

    return Unknowns([SearchedFile(file.source.name, file.codes) for file in files])


def _unread_code(
    codes: Sequence[Code], documents: Iterable[Document], reads: bool, unknowns: Unknowns
) -> Unread | None:
    """The first code that creates something multisampled of which no pass, or no pipeline, was
    read.
    """
    from msaa_lint.input.code.creations import IMAGES, READS, Creation, creations

    passes = unknown = pipelines = 0
    for document in documents:
        known = _known_passes(document)
        passes += known.count(True)
        unknown += known.count(False)
        pipelines += len(document.description.pipelines)
    if passes:
        return None
    found: dict[str, Creation] = {}
    for creation in creations(codes):
        found.setdefault(creation.kind, creation)
        if creation.kind == IMAGES:
            break
    for kind, creation in sorted(found.items()):
        quote = quoted(creation.text)
        if kind == READS:
            message = "" if reads else f"{quote} is read, but how was not understood"
        elif kind == IMAGES:
            what = (
                f"of its {unknown} passes no sample count was read"
                if unknown
                else "no pass was read"
            )
            message = f"{quote} creates multisampled attachments, but {what}"
        else:
            message = (
                "" if pipelines else f"{quote} creates multisampled pipelines, but none was read"
            )
        if message:
            first = unknowns.first(creation.text.partition(" = ")[2]) if kind != READS else None
            advice = (
                f"; {first.reason}: state it with `// msaa-lint: assume {first.name}=VALUE`, or"
                if first is not None
                else ";"
            )
            message += f"{advice} check a capture or a description of the frame instead"
            return Unread(
                Span(creation.start, creation.end), message, first.name if first is not None else ""
            )
    return None


def _known_passes(document: Document) -> list[bool]:
    """For each pass of a document, whether the sample count of one of its attachments is known."""
    from msaa_lint.frame.facts.frame import Frame

    return [
        any(attachment.samples is not None for attachment in each.attachments)
        for each in Frame(document).passes
    ]

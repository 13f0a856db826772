"""What inputs are converted to: descriptions, the shader modules that they name, and lines for the
user.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from msaa_lint.core.text.emitter import emit
from msaa_lint.core.text.source import Source, Unreadable, decode
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.input.capture_input import CaptureInput
from msaa_lint.input.source_file import SourceFile
from msaa_lint.linter.source_programs import ProgramInput
from msaa_lint.linter.workspace import Unit, Workspace

from .programs import finding_line, names, place
from .report.escape import escape


class Conversion(NamedTuple):
    """What an input is converted to.

    `text` is the description, None if there is none, and `modules` are the shader modules that it
    names. `notes` and `errors` are lines for the user. `has_nothing` says that there is nothing to
    convert in the input, which is an error only of an input that is named.
    """

    text: str | None = None
    modules: Mapping[str, bytes] = {}
    notes: Sequence[str] = ()
    errors: Sequence[str] = ()
    has_nothing: bool = False


def converted(name: str, data: bytes | CaptureInput | SourceFile, format: str | None) -> Conversion:
    """What the contents of an input are converted to. Raises Unreadable for a text that is not
    UTF-8.
    """
    if isinstance(data, bytes):
        return _of_text(name, data, format)
    if isinstance(data, SourceFile):
        return of_programs([data])
    notes = (*data.notes, *(f"{name}: limit exceeded: {limit}" for limit, _ in data.limits))
    return Conversion(
        data.source.text,
        data.modules,
        notes,
        (f"{name}: the capture is truncated: {data.broken}",) if data.broken else (),
    )


def of_programs(files: Sequence[SourceFile]) -> Conversion:
    """What programs state, a document for each part, with what had to be assumed."""
    described = [code for code in files if code.description]
    notes = [text for code in described or files[:1] for text in _notes(code)]
    if not described:
        errors = [
            f"{names(code)}: found no attachment, image, pipeline, or sample count"
            for code in files[:1]
        ]
        return Conversion(notes=notes, errors=errors, has_nothing=True)
    modules = {name: module for code in described for name, module in code.modules.items()}
    return Conversion("---\n".join(map(_description, described)), modules, notes)


def _of_text(name: str, data: bytes, format: str | None) -> Conversion:
    """The descriptions that the documents of a text stand for."""
    from msaa_lint.input import readers

    source = Source(name, decode(data))
    parsed = parse(source, Limits())
    documents = [readers.read(source, root, format) for root in parsed.documents]
    problems = [(problem.code, problem.message, problem.span) for problem in parsed.problems]
    problems += [
        (problem.code, problem.message, problem.span)
        for document in documents
        for problem in document.problems
    ]
    if problems:
        places = [source.position(span.start) for _, _, span in problems]
        lines = zip(problems, places, strict=True)
        return Conversion(
            errors=[
                f"{name}:{line}:{column}: {message} ({code})"
                for (code, message, _), (line, column) in lines
            ]
        )
    if all(document.tree is None for document in documents):
        return Conversion(
            errors=[f"{name}: nothing to convert: `check` reads this input directly"],
            has_nothing=True,
        )
    trees = [
        document.tree if document.tree is not None else root
        for document, root in zip(documents, parsed.documents, strict=True)
    ]
    return Conversion("---\n".join(map(emit, trees)))


def _description(code: SourceFile) -> str:
    """The description of a program, and where it is from."""
    return (
        f"# Read from {escape(names(code))}; what it does not state is left out.\n"
        f"{code.description}"
    )


def _notes(code: SourceFile) -> list[str]:
    """What of a program is not read, and what had to be assumed."""
    lines = [f"{place(code, part.at)}: {part.message}" for part in code.program.unread]
    name = names(code)
    for number, assumptions in enumerate(code.program.assumed, 1):
        where = f"{name}, document {number}" if len(code.program.documents) > 1 else name
        lines += [f"{where}: {text}" for text in assumptions]
    return lines


class ConvertLinter:
    """Converts the inputs of a workspace one by one."""

    def __init__(self, workspace: Workspace) -> None:
        self.workspace = workspace

    def part(self, unit: Unit) -> Conversion:
        """What an input or a program is converted to."""
        found = Conversion()
        with self.workspace.reading(unit) as read, self.workspace.guard(input_path(unit)):
            found = self._converted(unit)
        problems = [
            finding_line(finding) for finding in dict.fromkeys(read.findings) if finding.fatal
        ]
        return found._replace(errors=[*problems, *found.errors])

    def known(self, units: Sequence[Unit]) -> Mapping[int, Conversion]:
        """Descriptions are not kept between runs."""
        return {}

    def included(self, part: Conversion) -> bool:
        """True: converting runs no custom rules."""
        return True

    def failed(self, unit: Unit, reason: str) -> Conversion:
        """What an input is converted to that ended the processes that read it."""
        return Conversion(
            errors=[
                f"{self.workspace.request.input_name(input_path(unit))}: not converted: {reason}"
            ]
        )

    def travelling(self) -> Callable[[Workspace], ConvertLinter]:
        """Creates such a linter in another process."""
        return ConvertLinter

    def _converted(self, unit: Unit) -> Conversion:
        workspace = self.workspace
        if isinstance(unit, str):
            file = workspace.open(unit)
            try:
                return (
                    converted(file.name, file.data, workspace.request.format)
                    if file is not None
                    else Conversion()
                )
            except Unreadable as error:
                return Conversion(errors=[f"{workspace.request.input_name(unit)}: {error}"])
        together = workspace.open_program(unit)
        files = (
            [together]
            if together is not None
            else [workspace.open(path) for path in unit.inputs if path not in workspace.failed]
        )
        return of_programs(
            [file.data for file in files if file is not None and isinstance(file.data, SourceFile)]
        )


def input_path(unit: Unit) -> str:
    """The path of an input, of a program that of its first input."""
    return unit.inputs[0] if isinstance(unit, ProgramInput) else unit

"""`msaa-lint convert`: a capture, source code, or a frame in other terms as a description to read, edit, fix, and confirm."""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import partial

from msaa_lint.core import atomic_write
from msaa_lint.core.text.emitter import emit
from msaa_lint.core.text.source import Source, Unreadable, decode
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.input.opening import load
from msaa_lint.input.source_file import SourceFile

from .common import UsageError, internal_errors_of, note, refuse_inputs, run_command, warn, write_output, writes
from .options import Arguments
from .programs import are_programs, assumed_values, names, place, read_programs
from .report.escape import escape
from .report.words import plural


def convert(arguments: Arguments) -> int:
    """Converts what the arguments name; returns the exit code."""
    return run_command(_convert, arguments)


def _convert(arguments: Arguments) -> int:
    if are_programs(arguments):
        return convert_programs(arguments, arguments.get("output"), bool(arguments.get("force")))
    if len(arguments["paths"]) > 1:
        raise UsageError("only source code is converted together; convert each of the other inputs by itself")
    (path,) = arguments["paths"]
    format, frame_end = arguments.get("input_format"), arguments.get("frame_end")
    return convert_input(path, arguments.get("output"), format, bool(arguments.get("force")), frame_end)


def convert_input(path: str, output: str | None, format: str | None, force: bool, frame_end: str | None = None) -> int:
    """Writes the description to a file, with the shader modules that it names in `shaders/` next to it, or prints it.

    Returns 2 if the input cannot be read, has mistakes, or is a plain description already; and if a capture is truncated, whose readable
    part is still written.
    """
    name = "<stdin>" if path == "-" else path
    if output is not None:
        refuse_inputs([output], [path])
    with internal_errors_of(name):
        return _convert_file(name, path, output, format, force, frame_end)


def convert_programs(arguments: Arguments, output: str | None, force: bool) -> int:
    """Writes the descriptions of the programs in folders and source files, as `convert_input` does."""
    programs = read_programs(arguments)
    if output is not None:
        refuse_inputs([output], [file.source.name for code in programs.files for file in code.files])
    for line in programs.errors:
        warn(line)
    if programs.others:
        note(f"{plural(len(programs.others), 'input')} that is not source code is left out, the first one {programs.others[0]}")
    described = [code for code in programs.files if code.description]
    try:
        for code in described or programs.files[:1]:
            _print_notes(code)
        if described:
            modules = {name: module for code in described for name, module in code.modules.items()}
            _write("---\n".join(map(_description, described)), modules, output, force)
        elif programs.files:
            raise _ConvertError(f"{names(programs.files[0])}: found no attachment, image, pipeline, or sample count")
    except _ConvertError as error:
        for line in error.args:
            warn(line)
    return 2 if programs.errors or not described else 0


def _convert_file(name: str, path: str, output: str | None, format: str | None, force: bool, frame_end: str | None) -> int:
    try:
        data = load(path, Limits(), format=format, frame_end=frame_end, assumed=assumed_values(path))
        if isinstance(data, bytes):
            _write(_convert_text(name, data, format), {}, output, force)
        elif isinstance(data, SourceFile):
            _convert_source(data, output, force)
        else:
            _write(data.source.text, data.modules, output, force)
            for text in (*data.notes, *(f"{name}: limit exceeded: {limit}" for limit, _ in data.limits)):
                note(text)
            if data.broken:
                raise _ConvertError(f"{name}: the capture is truncated: {data.broken}")
    except _ConvertError as error:
        for line in error.args:
            warn(line)
        return 2
    except (OSError, Unreadable) as error:
        warn(f"{name}: {getattr(error, 'strerror', None) or error}")
        return 2
    return 0


class _ConvertError(Exception):
    """Why nothing, or not all, is converted: each argument is a line for the user."""


def _convert_text(name: str, data: bytes, format: str | None) -> str:
    """The descriptions that the documents of a text stand for."""
    from msaa_lint.input import readers

    source = Source(name, decode(data))
    parsed = parse(source, Limits())
    documents = [readers.read(source, root, format) for root in parsed.documents]
    problems = [(problem.code, problem.message, problem.span) for problem in parsed.problems]
    problems += [(problem.code, problem.message, problem.span) for document in documents for problem in document.problems]
    if problems:
        places = [source.position(span.start) for _, _, span in problems]
        lines = zip(problems, places, strict=True)
        raise _ConvertError(*(f"{name}:{line}:{column}: {message} ({code})" for (code, message, _), (line, column) in lines))
    if all(document.tree is None for document in documents):
        raise _ConvertError(f"{name}: nothing to convert: `check` reads this input directly")
    trees = [document.tree if document.tree is not None else root for document, root in zip(documents, parsed.documents, strict=True)]
    return "---\n".join(map(emit, trees))


def _convert_source(code: SourceFile, output: str | None, force: bool) -> None:
    """Writes what source code states, a document for each part, and prints what had to be assumed."""
    if not code.description:
        _print_notes(code)
        raise _ConvertError(f"{code.source.name}: found no attachment, image, pipeline, or sample count")
    _print_notes(code)
    _write(_description(code), code.modules, output, force)


def _description(code: SourceFile) -> str:
    """The description of a program, and where it is from."""
    return f"# Read from {escape(names(code))}; what it does not state is left out.\n{code.description}"


def _print_notes(code: SourceFile) -> None:
    """Prints what of a program is not read, and what had to be assumed."""
    for part in code.program.unread:
        note(f"{place(code, part.at)}: {part.message}")
    name = names(code)
    for number, assumptions in enumerate(code.program.assumed, 1):
        where = f"{name}, document {number}" if len(code.program.documents) > 1 else name
        for text in assumptions:
            note(f"{where}: {text}")


def _write(text: str, modules: Mapping[str, bytes], output: str | None, force: bool) -> None:
    """Writes a description and the shader modules that it names, or prints it without them."""
    if output in (None, "-", "/dev/stdout"):
        write_output(None, lambda out: out.write(text))
        if modules:
            note(f"{plural(len(modules), 'shader')} not written; -o FILE writes shaders next to the description")
        return
    if (os.path.isfile(output) or os.path.islink(output)) and not force:
        raise UsageError(f"{output} already exists; --force overwrites it")
    folder = os.path.dirname(output)
    for name, code in modules.items():
        path = os.path.join(folder, *name.split("/"))
        with writes(path):
            os.makedirs(os.path.dirname(path) or os.curdir, exist_ok=True)
            atomic_write.write_file(path, code, None if force else partial(_holds, code))
    # The description comes last: it is whole only with its shaders.
    with writes(output):
        atomic_write.write_file(output, text.encode())


def _holds(data: bytes, path: str) -> bool:
    """Whether a file holds these bytes."""
    with open(path, "rb") as file:
        return file.read(len(data) + 1) == data

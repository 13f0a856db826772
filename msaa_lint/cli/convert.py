"""`msaa-lint convert`: a capture, source code, or a frame in other terms as a description to read,
edit, fix, and confirm.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from functools import partial
from typing import NamedTuple

from msaa_lint.core import atomic_write
from msaa_lint.core.execution.backend import Unusable
from msaa_lint.core.text.source import Unreadable
from msaa_lint.core.text.tree import Limits
from msaa_lint.core.urls import is_url, name_of
from msaa_lint.input.file_types import DESCRIPTIONS, STDIN
from msaa_lint.input.opening import load
from msaa_lint.linter.request import ALONE, Request
from msaa_lint.linter.source_programs import units_of
from msaa_lint.linter.unit_parts import parts
from msaa_lint.linter.workspace import Unit, Workspace

from .common import (
    UsageError,
    input_options,
    internal_errors_of,
    note,
    refuse_inputs,
    run_command,
    warn,
    write_output,
    writes,
)
from .conversion import Conversion, ConvertLinter, converted, input_path, of_programs
from .options import Arguments
from .programs import are_programs, assumed_values, finding_line, read_programs
from .report.words import plural


def convert(arguments: Arguments) -> int:
    """Converts what the arguments name; returns the exit code."""
    return run_command(_convert, arguments, (Unusable,), terminable="backend" in arguments)


def _convert(arguments: Arguments) -> int:
    output, force = arguments.get("output"), bool(arguments.get("force"))
    if output is not None and (os.path.isdir(output) or output.endswith(("/", os.sep))):
        return convert_each(arguments, output, force)
    if are_programs(arguments):
        return convert_programs(arguments, output, force)
    if len(arguments["paths"]) > 1:
        raise UsageError(
            "only source code is converted together; write other descriptions to a folder, as in "
            "-o descriptions/"
        )
    (path,) = arguments["paths"]
    return convert_input(
        path, output, arguments.get("input_format"), force, arguments.get("frame_end")
    )


def convert_input(
    path: str, output: str | None, format: str | None, force: bool, frame_end: str | None = None
) -> int:
    """Writes the description to a file, with the shader modules that it names in `shaders/` next to
    it, or prints it.

    Returns 2 if the input cannot be read, has mistakes, or is a plain description already; and if a
    capture is truncated, whose readable part is still written.
    """
    name = "<stdin>" if path == "-" else path
    if output is not None:
        refuse_inputs([output], [path])
    with internal_errors_of(name):
        try:
            found = converted(
                name,
                load(
                    path, Limits(), format=format, frame_end=frame_end, assumed=assumed_values(path)
                ),
                format,
            )
        except (OSError, Unreadable) as error:
            warn(f"{name}: {getattr(error, 'strerror', None) or error}")
            return 2
        return _finish(found, output, force)


def convert_programs(arguments: Arguments, output: str | None, force: bool) -> int:
    """Writes the descriptions of the programs in folders and source files, as `convert_input`
    does.
    """
    programs = read_programs(arguments)
    if output is not None:
        refuse_inputs(
            [output], [file.source.name for code in programs.files for file in code.files]
        )
    for line in programs.errors:
        warn(line)
    if programs.others:
        left_out = (
            f"{plural(len(programs.others), 'input')} that is not source code is left out, "
            f"the first one {programs.others[0]}"
        )
        note(f"{left_out}; -o FOLDER/ writes a description of each")
    code = _finish(of_programs(programs.files), output, force)
    return 2 if programs.errors else code


def convert_each(arguments: Arguments, folder: str, force: bool) -> int:
    """Writes a description of each input and each program to a folder, and shader modules next to
    it.

    Returns 2 if one of them could not be converted; the others are. An input in which there is
    nothing to convert is left out, unless it is named.
    """
    workspace = Workspace(Request(**input_options(arguments)))
    planned = _planned(workspace, arguments["paths"], folder, force)
    waiting = [each.unit for each in planned if not each.problem]
    found = parts(
        ConvertLinter(workspace),
        waiting,
        ALONE if workspace.request.traceback else workspace.request.division,
    )
    written, failed, left_out = 0, False, []
    for each in planned:
        conversion = Conversion(errors=[each.problem]) if each.problem else next(found)
        if conversion.has_nothing and workspace.project(input_path(each.unit)) is not None:
            left_out.append(input_path(each.unit))
            continue
        try:
            if conversion.text is not None:
                with writes(each.target):
                    os.makedirs(os.path.dirname(each.target), exist_ok=True)
            failed |= _finish(conversion, each.target, force) != 0
            written += conversion.text is not None
        except UsageError as error:
            warn(str(error))
            failed = True
    workspace.close()
    for line in dict.fromkeys(
        finding_line(finding) for finding in workspace.findings if finding.fatal
    ):
        warn(line)
        failed = True
    if left_out:
        note(
            f"{plural(len(left_out), 'input')} left out, with nothing to convert, the first one "
            f"{left_out[0]}"
        )
    note(f"{plural(written, 'description')} written to {folder}")
    return 2 if failed else 0


class _Planned(NamedTuple):
    """What is converted to which file, or why it is not."""

    unit: Unit
    target: str
    problem: str


def _planned(
    workspace: Workspace, named: Sequence[str], folder: str, force: bool
) -> list[_Planned]:
    """The inputs and programs that paths name, in their order. Descriptions that an earlier run
    wrote of them are not inputs.
    """
    discovered = workspace.discover(sources=True)
    for text in discovered.notes:
        note(text)
    folders = [name for name in map(name_of, named) if is_url(name) or os.path.isdir(name)]
    units = units_of(discovered.files, workspace.programs(discovered))
    targets = {
        unit: os.path.join(folder, _description_name(input_path(unit), folders)) for unit in units
    }
    outputs = set(map(os.path.abspath, targets.values()))
    planned: list[_Planned] = []
    first: dict[str, str] = {}
    for unit, target in targets.items():
        path, problem = input_path(unit), ""
        if os.path.abspath(path) in outputs:
            if workspace.project(path) is not None:
                continue
            problem = (
                f"{path} is an input, and the description of another one; write that to "
                "another folder"
            )
        elif target in first:
            problem = (
                f"{path}: its description and that of {first[target]} would both be "
                f"{target}; write one to another folder"
            )
        elif os.path.lexists(target) and not force:
            problem = f"{target} already exists; --force overwrites it"
        first.setdefault(target, path)
        planned.append(_Planned(unit, target, problem))
    return planned


def _description_name(path: str, folders: Sequence[str]) -> str:
    """The path of the description of an input, in the folder of descriptions: the input's in the
    folder that is named, or in the current one. It depends on no other input.
    """
    if path == STDIN:
        return "stdin" + DESCRIPTIONS[0]
    names = [os.path.relpath(path, folder) for folder in folders] + [
        os.path.relpath(path.partition("://")[2] if is_url(path) else path)
    ]
    # A storage may have objects with any name.
    inside = next(
        (name for name in names if name != os.curdir and name.split(os.sep)[0] != os.pardir),
        os.path.basename(path),
    )
    return inside + DESCRIPTIONS[0]


def _finish(found: Conversion, output: str | None, force: bool) -> int:
    """Writes a description, or prints it, and prints the lines for the user. Returns 2 if not all
    of the input was converted.
    """
    if found.text is not None:
        _write(found.text, found.modules, output, force)
    for text in found.notes:
        note(text)
    for text in found.errors:
        warn(text)
    return 2 if found.errors or found.text is None else 0


def _write(text: str, modules: Mapping[str, bytes], output: str | None, force: bool) -> None:
    """Writes a description and the shader modules that it names, or prints it without them."""
    if output in (None, "-", "/dev/stdout"):
        write_output(None, lambda out: out.write(text))
        if modules:
            note(
                f"{plural(len(modules), 'shader')} not written; -o FILE writes shaders next to the "
                "description"
            )
        return
    if (os.path.isfile(output) or os.path.islink(output)) and not force:
        raise UsageError(f"{output} already exists; --force overwrites it")
    for name, code in modules.items():
        path = os.path.join(os.path.dirname(output), *name.split("/"))
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

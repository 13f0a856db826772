"""The source code that paths name, for commands that read programs: folders, and files with what
they include.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.finding import Finding
from msaa_lint.input.file_types import LANGUAGES, PAGES, STDIN
from msaa_lint.linter.source_programs import is_read_together

from .options import Arguments

if TYPE_CHECKING:
    from msaa_lint.core.text.span import Span
    from msaa_lint.input.source_file import SourceFile

_ENDINGS = tuple(
    ending for language, endings in LANGUAGES.items() if language not in PAGES for ending in endings
)

_PAGE_ENDINGS = tuple(ending for language in PAGES for ending in LANGUAGES[language])

MAX_NAMED = 5
"""The number of files that are named of a program."""


class Programs(NamedTuple):
    """The programs that were read, what went wrong, and the inputs that are not source code."""

    files: list[SourceFile]
    errors: list[str]
    others: list[str]


def are_programs(arguments: Arguments) -> bool:
    """Whether the paths of a command are folders or source files that are read together."""
    paths: Sequence[str] = arguments["paths"]
    return arguments.get("input_format") is None and any(
        os.path.isdir(path) or is_read_together(path) for path in paths
    )


def read_programs(arguments: Arguments) -> Programs:
    """The programs of folders and source files."""
    from msaa_lint.input.source_file import SourceFile
    from msaa_lint.linter.request import Request
    from msaa_lint.linter.workspace import Workspace

    workspace = Workspace(
        Request(
            arguments["paths"],
            cache=not arguments.get("no_cache"),
            traceback=bool(arguments.get("traceback")),
        )
    )
    discovered = workspace.discover(sources=True)
    files: list[SourceFile] = []
    done: set[str] = set()
    others: list[str] = []
    programs = {
        path: program for program in workspace.programs(discovered) for path in program.inputs
    }
    for path in discovered.files:
        if path in done:
            continue
        program = programs.get(path)
        read = workspace.open_program(program) if program is not None else None
        if program is not None and read is not None and isinstance(read.data, SourceFile):
            done.update(program.inputs)
            files.append(read.data)
        elif path == STDIN or not path.lower().endswith(_ENDINGS):
            others.append(path)
        elif path not in workspace.failed:
            alone = workspace.open(path)
            if alone is not None and isinstance(alone.data, SourceFile):
                files.append(alone.data)
    workspace.close()
    return Programs(
        files,
        [finding_line(finding) for finding in dict.fromkeys(workspace.findings) if finding.fatal],
        others,
    )


def assumed_values(path: str) -> Mapping[str, bool | int | str]:
    """What the configuration states about the code of a page, by name; nothing for other inputs,
    which are no source code, or are read by `read_programs`.
    """
    if not path.lower().endswith(_PAGE_ENDINGS):
        return {}
    from msaa_lint.linter.request import Request
    from msaa_lint.linter.workspace import Workspace

    return Workspace(Request([path])).resolve(path).settings.source


def finding_line(finding: Finding) -> str:
    """A finding without a place, as a line for the user."""
    return f"{finding.file}: {finding.message}" if finding.file else finding.message


def names(code: SourceFile) -> str:
    """The names of the files of a program that are inputs."""
    inputs = [file.source.name for file in code.files if file.is_input]
    more = len(inputs) - MAX_NAMED
    return ", ".join(inputs[:MAX_NAMED]) + (f", and {more} more" if more > 0 else "")


def place(code: SourceFile, at: Span) -> str:
    """The file and line of a place in the text of a program."""
    file, span = code.place(at)
    return f"{file.source.name}:{file.source.position(span.start).line}"

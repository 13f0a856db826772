"""Which of the inputs of a run are source files of one program, and the texts of its files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.files import open_file
from msaa_lint.input.file_types import HEAD_BYTES, LANGUAGES

if TYPE_CHECKING:
    from msaa_lint.input.code.project.programs import Program, Project
    from msaa_lint.input.source_file import SourceText

MAX_BYTES = (4 << 20) + 1
"""The number of bytes of a file that are read to see what it defines; a longer one is not read."""

TOGETHER = ("c", "cpp", "objc", "objcpp")
"""The languages whose files are read together."""

_ENDINGS = tuple(ending for language in TOGETHER for ending in LANGUAGES[language])


class ProgramInput(NamedTuple):
    """The source files of a program, by path, in the order of reading. Findings are reported in `inputs`; `includes` has the numbers of the
    files that each file includes, and `headers` says which are headers."""

    paths: tuple[str, ...]
    inputs: tuple[str, ...]
    includes: tuple[tuple[int, ...], ...]
    headers: tuple[bool, ...]


def is_read_together(path: str) -> bool:
    """Whether a file is source code in a language whose files form programs, by its name."""
    return path.lower().endswith(_ENDINGS)


def programs(inputs: Iterable[str], related: Mapping[str, str], projects: Mapping[str, str]) -> list[ProgramInput]:
    """The programs of source files, by their first file. `related` are the other source files, with their projects; `projects` has those of
    inputs that are not named. A file that cannot be read is in none."""
    from msaa_lint.input.code.project.index import words
    from msaa_lint.input.code.project.programs import Entry, Project

    entries: list[Entry] = []
    named = set(inputs)
    for path in sorted({*named, *related}):
        if is_read_together(path):
            data = _data(path, related.get(path) or projects.get(path))
            if data is not None:
                entries.append(Entry(path, len(data), words(data), path in named))
    project = Project(entries)
    return [_input(project, program) for program in project.programs()]


def _input(project: Project, program: Program) -> ProgramInput:
    """The files of a program that are read: headers before sources."""
    own = [number for number in program.files if project.entries[number].is_input or project.entries[number].words.is_related]
    numbers = sorted((*own, *program.seen), key=lambda number: (not project.headers[number], number))
    position = {number: at for at, number in enumerate(numbers)}
    inputs = [number for number in own if project.entries[number].is_input]
    return ProgramInput(
        tuple(project.entries[number].path for number in numbers),
        tuple(project.entries[number].path for number in inputs),
        tuple(tuple(position[other] for other in project.includes[number] if other in position) for number in numbers),
        tuple(project.headers[number] for number in numbers),
    )


def _data(path: str, project: str | None) -> bytes | None:
    """The beginning of a file; None if it cannot be read. A pipe is not read twice."""
    try:
        file, size = open_file(path, project)
        with file:
            return file.read(min(size, MAX_BYTES)) if size is not None else None
    except OSError:
        return None


def related_text(path: str, project: str | None) -> SourceText | None:
    """The text of a file that is only read for what it defines; None if it cannot be read."""
    from msaa_lint.input.code import language_of
    from msaa_lint.input.source_file import source_text

    data = _data(path, project)
    if data is None or len(data) >= MAX_BYTES:
        return None
    language = language_of(path, data[:HEAD_BYTES].decode("latin-1"))
    return source_text(data, path, language)._replace(is_input=False) if language in TOGETHER else None

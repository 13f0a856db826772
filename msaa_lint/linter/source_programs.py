"""Which of the inputs of a run are source files of one program, and the texts of its files."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.project import folder_of, project_root, shown
from msaa_lint.core.text.files import open_file
from msaa_lint.core.urls import is_url
from msaa_lint.input.file_types import HEAD_BYTES, LANGUAGES

if TYPE_CHECKING:
    from msaa_lint.input.code.project.compile_commands import BuildEntry
    from msaa_lint.input.code.project.index import Index
    from msaa_lint.input.code.project.nearby import Nearby
    from msaa_lint.input.code.project.programs import Entry, Program, Project
    from msaa_lint.input.code.project.swift_modules import SwiftModules
    from msaa_lint.input.source_file import SourceText

MAX_BYTES = (4 << 20) + 1
"""The number of bytes of a file that are read to see what it defines; a longer one is not read."""

MAX_ELSEWHERE = 1000
"""The number of files that are read because inputs include them."""

FAMILIES = (("c", "cpp", "objc", "objcpp"), ("swift",), ("rust",))
"""The languages whose files are read together."""

TOGETHER = tuple(language for family in FAMILIES for language in family)

_FAMILY_ENDINGS = tuple(
    tuple(ending for language in family for ending in LANGUAGES[language]) for family in FAMILIES
)
_ENDINGS = tuple(ending for endings in _FAMILY_ENDINGS for ending in endings)


class ProgramInput(NamedTuple):
    """The source files of a program, by path, in the order of reading. Findings are reported in
    `inputs`; `includes` has the numbers of the files that each file includes, `headers` says which
    are headers, and `roots` has the projects that they must be in, and `definitions` has the
    directives that define the macros of their builds.
    """

    paths: tuple[str, ...]
    inputs: tuple[str, ...]
    includes: tuple[tuple[int, ...], ...]
    headers: tuple[bool, ...]
    roots: tuple[str | None, ...]
    definitions: tuple[str, ...]


def is_read_together(path: str) -> bool:
    """Whether a file is source code in a language whose files form programs, by its name. Files at
    URLs are read one at a time.
    """
    return path.lower().endswith(_ENDINGS) and not is_url(path)


def units_of(files: Sequence[str], programs: Sequence[ProgramInput]) -> list[str | ProgramInput]:
    """What is read at once, in the order of the files: a program comes where its first input
    does.
    """
    of = {path: program for program in programs for path in program.inputs}
    return list(dict.fromkeys(of.get(path, path) for path in files))


def programs(
    inputs: Iterable[str], related: Mapping[str, str], projects: Mapping[str, str], index: Index
) -> list[ProgramInput]:
    """The programs of source files, by their first file.

    `related` are the other source files of folders, with their projects; `projects` has those of
    inputs that are not named; `index` has the words of files. What the inputs include elsewhere in
    their projects is read, too. A file that cannot be read is in no program.
    """
    inputs = list(inputs)
    found: list[ProgramInput] = []
    for endings in _FAMILY_ENDINGS:
        search = _Search(
            {path for path in inputs if path.lower().endswith(endings)},
            {**projects, **related},
            index,
        )
        candidates = [path for path in related if path.lower().endswith(endings)]
        if not search.inputs and not any(
            words.has_api
            for path in candidates
            if (words := index.of(path, related[path])) is not None
        ):
            continue
        from msaa_lint.input.code.project.programs import Project

        search.add(sorted({*search.inputs, *candidates}), related)
        project = Project([search.entries[path] for path in sorted(search.entries)])
        found += [_input(project, program, search) for program in project.programs()]
    return sorted(found, key=lambda program: program.inputs)


class _Search:
    """The files of programs. `roots` has the projects that files must be in; a named file may be
    anywhere.
    """

    def __init__(self, inputs: set[str], roots: dict[str, str], index: Index) -> None:
        self.index = index
        self.inputs = inputs
        self.roots = roots
        self.entries: dict[str, Entry] = {}
        self.nearby: dict[str, Nearby] = {}
        self.builds: dict[str, dict[str, BuildEntry]] = {}
        self.projects: dict[str, str] = {}
        self.modules: dict[str, SwiftModules] = {}

    def add(self, paths: Sequence[str], candidates: Container[str]) -> None:
        """Reads files, and searches the files that inputs include, and that these include."""
        from msaa_lint.input.code.project.programs import Entry

        waiting = list(paths)
        known = set(paths)
        names = {path.rpartition("/")[2] for path in paths}
        elsewhere: set[str] = set()
        for path in waiting:
            found = self.index.of(path, self.roots.get(path))
            if found is None:
                continue
            target, folder = self.build(path).target, self.module(path)
            entry = self.entries[path] = Entry(
                path, found, path in self.inputs, path in candidates, target, folder
            )
            if path not in self.inputs and path not in elsewhere:
                continue
            near = self.near(path)
            stated = (
                name
                for name in entry.words.includes
                if "." in name and name.rpartition("/")[2] not in names
            )
            for header in map(shown, near.included(path, stated)):
                for other in (header, *map(shown, near.sources(header))):
                    if (
                        other not in known
                        and is_read_together(other)
                        and len(elsewhere) < MAX_ELSEWHERE
                    ):
                        known.add(other)
                        elsewhere.add(other)
                        self.roots[other] = near.root
                        waiting.append(other)

    def build(self, path: str) -> BuildEntry:
        """How a file is compiled, as far as its project says."""
        from msaa_lint.input.code.project.compile_commands import BuildEntry, build_entries

        root = self.near(path).root
        if root not in self.builds:
            self.builds[root] = build_entries(root)
        return self.builds[root].get(path, BuildEntry("", ""))

    def module(self, path: str) -> str:
        """The folder of the Swift module of a file, or an empty string."""
        if not path.endswith(".swift"):
            return ""
        from msaa_lint.input.code.project.swift_modules import SwiftModules

        root = self.near(path).root
        if root not in self.modules:
            self.modules[root] = SwiftModules(root)
        return self.modules[root].folder(path)

    def near(self, path: str) -> Nearby:
        """The search in the project of a file."""
        from msaa_lint.input.code.project.nearby import Nearby

        folder = folder_of(path)
        if folder not in self.projects:
            self.projects[folder] = project_root(folder)
        root = self.roots.get(path) or self.projects[folder]
        return self.nearby.setdefault(root, Nearby(root))


def _input(project: Project, program: Program, search: _Search) -> ProgramInput:
    """The files of a program that are read: headers before sources."""
    inputs = set(program.inputs)
    own = [
        number for number in program.files if number in inputs or project.entries[number].is_related
    ]
    numbers = sorted(
        (*own, *program.seen), key=lambda number: (not project.headers[number], number)
    )
    position = {number: at for at, number in enumerate(numbers)}
    return ProgramInput(
        tuple(project.entries[number].path for number in numbers),
        tuple(project.entries[number].path for number in program.inputs),
        tuple(
            tuple(position[other] for other in project.includes[number] if other in position)
            for number in numbers
        ),
        tuple(project.headers[number] for number in numbers),
        tuple(search.roots.get(project.entries[number].path) for number in numbers),
        tuple(search.build(project.entries[number].path).definitions for number in numbers),
    )


def related_text(path: str, project: str | None) -> SourceText | None:
    """The text of a file that is only read for what it defines; None if it cannot be read."""
    from msaa_lint.input.code import language_of
    from msaa_lint.input.source_file import source_text

    try:
        file, size = open_file(path, project)
        with file:
            data = file.read(MAX_BYTES) if size is not None and size < MAX_BYTES else None
    except OSError:
        return None
    if data is None:
        return None
    language = language_of(path, data[:HEAD_BYTES].decode("latin-1"))
    return (
        source_text(data, path, language)._replace(is_input=False) if language in TOGETHER else None
    )

"""Finds the inputs: the named files, and the inputs in the named folders."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from typing import NamedTuple, Protocol

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.globs import Glob, excluding
from msaa_lint.core.project import is_inside, project_root, shown
from msaa_lint.core.quote import quoted

from .file_types import BINARY, CAPTURES, DATA, DESCRIPTIONS, INPUT, NEAR, OTHER, PAGE_ENDINGS, SOURCES, STDIN, missing_extra
from .ignore_files import IgnoreFiles, above

MAX_DEPTH = 64
SKIPPED_FOLDERS = frozenset({"node_modules", "bower_components", "__pycache__", "__pypackages__", "site-packages", "venv", "CVS"})
_OUTPUTS = (".json", ".sarif", ".xml", ".md")
"""Endings of files that msaa-lint may have written and that are not inputs; other files are not opened to see."""


class Scope(Protocol):
    """The settings that discovery needs: the globs of inputs in folders and of files that are not linted; whether .gitignore applies."""

    @property
    def include(self) -> Sequence[Glob]: ...
    @property
    def exclude(self) -> Sequence[Glob]: ...
    @property
    def respect_gitignore(self) -> bool: ...


InputsAmong = Callable[[Mapping[str, str | None], Mapping[str, str]], Iterable[str]]
"""Of the inputs and the other source files of folders, with their projects: those of the latter that are inputs, too."""


class Discovered(NamedTuple):
    """The input files, each once and sorted, as findings name them; findings about paths; notes for the user.

    `projects` has the projects in which the files of folders must be; a file that is named may be anywhere. `related` has the other source
    code in the folders, which may define what that of `files` uses, with its project.
    """

    files: list[str]
    findings: list[Finding]
    notes: list[str]
    projects: Mapping[str, str] = {}
    related: Mapping[str, str] = {}


def discover(
    paths: Iterable[str],
    settings_for: Callable[[str], Scope],
    sources: bool = False,
    log: Callable[[str], None] | None = None,
    inputs_among: InputsAmong | None = None,
    speaks: Callable[[str], bool] | None = None,
) -> Discovered:
    """The files to lint.

    A named file is linted whatever its name, unless `exclude` matches it; that is only a note, since commit hooks name every file. A
    folder contributes the files that `include` matches, or by default those called `*.msaa.yaml` (yml, json) and data files with content
    that only a frame has; a note counts those that nearly have it. `sources` adds source code that mentions multisampling, or a note if
    the extra that reads it is missing. Hidden folders and those of tools and environments, what .gitignore ignores, and what msaa-lint
    itself wrote are skipped. Links to folders are not followed; links to files are if they stay in the project. A missing path and a
    folder without inputs are findings (MSAA921).

    `speaks` says whether a source file mentions multisampling. `inputs_among` says which of the other source files of folders are inputs
    because of the programs that they belong to.
    `settings_for` gives the settings of a file or folder. `-` stays as it is. `log` is called with a line for each path that is skipped.
    """
    walk = _Walk(settings_for, sources, log)
    walk.speaks = speaks or _speaks
    for path in paths:
        if path == STDIN:
            walk.files[STDIN] = None
        elif os.path.isdir(path):
            walk.add_folder(path)
        elif os.path.exists(path):
            glob = excluding(path, settings_for(path).exclude)
            if glob is None:
                walk.files[shown(path)] = None
            else:
                walk.notes.append(_excluded(path, glob))
        else:
            reason = ": it is a broken link" if os.path.lexists(path) else ""
            walk.findings.append(diagnostic("MSAA921", f"no such file or folder {quoted(path)}{reason}", shown(path)))
    if walk.related and inputs_among is not None:
        for name in inputs_among(walk.files, {name: search.project for name, search in walk.related.items()}):
            if name in walk.related:
                search = walk.related.pop(name)
                walk.files[name] = search.project
                search.inputs += 1
    for search in walk.searches:
        walk.check_inputs(search)
    if walk.unreadable_sources:
        walk.notes.append(f"{_count(walk.unreadable_sources, 'source file')} skipped: {missing_extra()}")
    near = sorted(walk.near.keys() - walk.files.keys(), key=_by_folder)
    for name in near:
        walk.skip(name, "it looks a little like a description")
    if near:
        walk.notes.append(_nearly(near))
    binary = sorted(walk.binary.keys() - walk.files.keys(), key=_by_folder)
    for name in binary:
        walk.skip(name, "a binary capture that is not named")
    if binary:
        walk.notes.append(_unconverted(binary))
    projects = {file: project for file, project in walk.files.items() if project is not None}
    related = {name: walk.related[name].project for name in sorted(walk.related.keys() - walk.files.keys(), key=_by_folder)}
    return Discovered(sorted(walk.files, key=_by_folder), walk.findings, list(dict.fromkeys(walk.notes)), projects, related)


def _by_folder(name: str) -> tuple[list[str], str]:
    return name.split("/"), name


def _nearly(names: Sequence[str]) -> str:
    if len(names) == 1:
        return f"{names[0]} looks a little like a description and was skipped: to lint it, name it or rename it to *{DESCRIPTIONS[0]}"
    return (
        f"{len(names)} files look a little like descriptions and were skipped, the first one {names[0]}: "
        f"to lint them, name them or rename them to *{DESCRIPTIONS[0]}"
    )


def _unconverted(names: Sequence[str]) -> str:
    if len(names) == 1:
        return f"{names[0]} is a binary capture and was skipped: name it to convert and lint it"
    return f"{len(names)} binary captures were skipped, the first one {names[0]}: name them to convert and lint them"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def _excluded(path: str, glob: Glob) -> str:
    return f"{shown(path)} is excluded by {quoted(glob.pattern)}"


def _speaks(path: str) -> bool:
    from .code.mentions import file_speaks

    return file_speaks(path)


class _Folder(NamedTuple):
    """A folder to search, how deep it is in the named one, and the ignore files of the folders above it."""

    path: str
    depth: int
    above: IgnoreFiles


class _Search:
    """The search of one named folder: its project, the numbers of inputs, problems, and files that are no inputs, and the candidates that
    `exclude` and ignore files skip."""

    def __init__(self, top: str) -> None:
        self.top = top
        self.project = project_root(top)
        self.inputs = 0
        self.problems = 0
        self.unreadable = 0
        self.near = 0
        self.excluded: list[tuple[os.DirEntry[str], str, Sequence[Glob]]] = []
        self.ignored: list[str] = []


class _Walk:
    """The files found so far, with their projects (None for a named file). `related` has the other source code, `near` the files that are
    nearly inputs, and `binary` the binary captures, in order."""

    def __init__(self, settings_for: Callable[[str], Scope], sources: bool, log: Callable[[str], None] | None) -> None:
        self.settings_for = settings_for
        self.sources = sources
        self.log = log
        self.speaks: Callable[[str], bool] = _speaks
        self.unreadable_sources = 0
        self.files: dict[str, str | None] = {}
        self.related: dict[str, _Search] = {}
        self.searches: list[_Search] = []
        self.near: dict[str, None] = {}
        self.binary: dict[str, None] = {}
        self.findings: list[Finding] = []
        self.notes: list[str] = []

    def add_folder(self, top: str) -> None:
        """Adds the inputs of a folder and of the folders in it."""
        glob = excluding(top, self.settings_for(top).exclude, folder=True)
        if glob is not None:
            self.notes.append(_excluded(top, glob))
            return
        search = _Search(top)
        findings, unreadable, near = len(self.findings), self.unreadable_sources, len(self.near)
        waiting = [_Folder(top, 0, above(top))]
        while waiting:
            folder = waiting.pop()
            if folder.depth > MAX_DEPTH:
                self.notes.append(f"{shown(folder.path)} is more than {MAX_DEPTH} folders deep: name it to lint it")
                continue
            try:
                with os.scandir(folder.path) as scan:
                    entries = sorted(scan, key=lambda entry: entry.name)
            except OSError as error:
                self.findings.append(diagnostic("MSAA921", f"cannot read the folder: {error.strerror or error}", shown(folder.path)))
                continue
            if folder.path == top or all(entry.name != "pyvenv.cfg" for entry in entries):
                self._add_entries(folder, entries, search, waiting)
        search.problems = len(self.findings) - findings
        search.unreadable, search.near = self.unreadable_sources - unreadable, len(self.near) - near
        self.searches.append(search)

    def check_inputs(self, search: _Search) -> None:
        """Adds a finding for a folder without inputs, unless another one says why."""
        if not search.inputs and not search.problems:
            reason = missing_extra() if search.unreadable else self._reason(search, search.near)
            self.findings.append(diagnostic("MSAA921", f"nothing to lint in {quoted(search.top)}: {reason}", shown(search.top)))

    def _add_entries(self, folder: _Folder, entries: Sequence[os.DirEntry[str]], search: _Search, waiting: list[_Folder]) -> None:
        """Adds the inputs among the entries of a folder, and its folders to `waiting`."""
        settings = self.settings_for(folder.path)
        ignore_files = folder.above.below(folder.path, {entry.name for entry in entries if entry.name.startswith(".")})
        in_force = ignore_files if settings.respect_gitignore else IgnoreFiles()
        prefix = os.path.abspath(folder.path).replace(os.sep, "/").rstrip("/") + "/"
        for entry in entries:
            # Without the `./` that joining `.` would give: globs and names do not have it.
            path = entry.name if folder.path == os.curdir else os.path.join(folder.path, entry.name)
            if entry.is_dir(follow_symlinks=False):
                if entry.name.startswith(".") or entry.name in SKIPPED_FOLDERS:
                    self.skip(path, "a folder that is hidden or of tools")
                elif excluding(path, settings.exclude, folder=True):
                    self.skip(path, "excluded")
                elif in_force.ignores(f"{prefix}{entry.name}/"):
                    self.skip(path, "listed in .gitignore or .ignore")
                    search.ignored.append(path)
                else:
                    waiting.append(_Folder(path, folder.depth + 1, ignore_files))
            elif not self._is_candidate(entry.name.lower(), path, settings.include):
                continue
            elif in_force.ignores(prefix + entry.name):
                self.skip(path, "listed in .gitignore or .ignore")
                search.ignored.append(path)
            elif excluding(path, settings.exclude):
                self.skip(path, "excluded")
                search.excluded.append((entry, path, settings.include))
            else:
                self._add_file(entry, path, settings.include, search)

    def skip(self, path: str, reason: str) -> None:
        """Logs a path that is skipped."""
        if self.log is not None:
            self.log(f"skipped {shown(path)}: {reason}")

    def _is_candidate(self, name: str, path: str, include: Sequence[Glob]) -> bool:
        """Whether a file may be an input, by its name."""
        if include:
            return excluding(path, include) is not None
        return not name.startswith(".") and name.endswith((*DESCRIPTIONS, *DATA, *CAPTURES, *(SOURCES if self.sources else ())))

    def _add_file(self, entry: os.DirEntry[str], path: str, include: Sequence[Glob], search: _Search) -> None:
        """Adds a candidate if it is an input."""
        try:
            kind = self._kind(entry, path, include)
        except OSError:
            self.notes.append(f"{shown(path)} cannot be read to see if it is an input")
            return
        if kind == OTHER:
            self.skip(path, "not an input")
            if entry.name.lower().endswith(SOURCES) and entry.is_file(follow_symlinks=False):
                self.related[shown(path)] = search
        if kind == NEAR:
            self.near[shown(path)] = None
        elif kind == BINARY:
            self.binary[shown(path)] = None
        elif kind == INPUT and entry.is_symlink() and not (is_inside(path, search.project) and os.path.isfile(path)):
            self.notes.append(f"{shown(path)} is a link that is broken or leaves the project: name it to lint it")
        elif kind == INPUT and os.path.isfile(path):
            if entry.name.lower().endswith((*SOURCES, *PAGE_ENDINGS)) and not self._can_read_sources:
                self.unreadable_sources += 1
            else:
                self.files.setdefault(shown(path), search.project)
                search.inputs += 1
        elif kind == INPUT and not entry.is_dir():
            self.notes.append(f"{shown(path)} is not a regular file: not linted")

    def _kind(self, entry: os.DirEntry[str], path: str, include: Sequence[Glob]) -> str:
        """Whether a candidate is an input. A link's target is not read: it may be anywhere."""
        name = entry.name.lower()
        is_regular = entry.is_file(follow_symlinks=False)
        if include or name.endswith(DESCRIPTIONS):
            if not (is_regular and name.endswith(_OUTPUTS)):
                return INPUT
            from .content import is_own_output

            return OTHER if is_own_output(path) else INPUT
        if not is_regular:
            return OTHER
        if name.endswith(SOURCES):
            return INPUT if self.speaks(path) else OTHER
        from .content import kind_of

        return kind_of(path)

    def _reason(self, search: _Search, near: int) -> str:
        """Why a folder has no inputs."""
        excluded = 0
        for candidate in search.excluded:
            with suppress(OSError):
                excluded += self._kind(*candidate) == INPUT
        if excluded and not search.ignored and not near:
            return f"all inputs are excluded ({excluded})"
        names = ", ".join("*" + ending for ending in DESCRIPTIONS)
        skipped = [
            f"{_count(excluded, 'excluded input')}" if excluded else "",
            f"{_count(len(search.ignored), 'path')} that .gitignore or .ignore lists" if search.ignored else "",
            f"{_count(near, 'file')} that look a little like descriptions" if near else "",
        ]
        skips = ", ".join(filter(None, skipped))
        advice = f"inputs are called {names} or contain a Vulkan or Metal frame; name other files"
        return f"{advice} (skipped: {skips})" if skips else advice

    @cached_property
    def _can_read_sources(self) -> bool:
        from .code import installed

        return installed()

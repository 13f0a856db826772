"""The search of folders for inputs, and what is found in them."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import cached_property
from typing import NamedTuple, Protocol, TypeVar

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.globs import Glob, excluding
from msaa_lint.core.project import is_inside, project_root, shown
from msaa_lint.core.quote import quoted
from msaa_lint.core.urls import is_url

from .file_types import (
    BINARY,
    CAPTURES,
    DATA,
    DESCRIPTIONS,
    INPUT,
    NEAR,
    OTHER,
    PAGE_ENDINGS,
    SOURCES,
    missing_extra,
)
from .ignore_files import IgnoreFiles, above

MAX_DEPTH = 64
SKIPPED_FOLDERS = frozenset(
    {
        "node_modules",
        "bower_components",
        "__pycache__",
        "__pypackages__",
        "site-packages",
        "venv",
        "CVS",
    }
)
MIN_ENTRIES = 20
"""The number of entries of folders from which on it may be known what files are: opening a few
takes less time than looking them up.
"""
_OUTPUTS = (".json", ".sarif", ".xml", ".md")
"""Endings of files that msaa-lint may have written and that are not inputs; other files are not
opened to see.
"""


class Scope(Protocol):
    """The settings that discovery needs: the globs of inputs in folders and of files that are not
    linted; whether .gitignore applies.
    """

    @property
    def include(self) -> Sequence[Glob]: ...
    @property
    def exclude(self) -> Sequence[Glob]: ...
    @property
    def respect_gitignore(self) -> bool: ...


def count(number: int, noun: str) -> str:
    """A number of things in words."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def excluded_note(path: str, glob: Glob) -> str:
    """The note that a named path is excluded."""
    return f"{shown(path)} is excluded by {quoted(glob.pattern)}"


class Entry(Protocol):
    """What `os.DirEntry` and `urls.Entry` have."""

    @property
    def name(self) -> str: ...
    def is_dir(self, *, follow_symlinks: bool = True) -> bool: ...
    def is_file(self, *, follow_symlinks: bool = True) -> bool: ...
    def is_symlink(self) -> bool: ...


KnownKind = Callable[[str, Callable[[str], str]], str]
"""Returns what a file is according to a function, which need not be called."""

AnEntry = TypeVar("AnEntry", bound=Entry)


class Folder(NamedTuple):
    """A folder to search, how deep it is in the named one, and the ignore files of the folders
    above it.
    """

    path: str
    depth: int
    above: IgnoreFiles


class Search:
    """The search of one named folder: its project, the numbers of inputs, problems, and files that
    are no inputs, and the candidates that `exclude` and ignore files skip.
    """

    def __init__(self, top: str) -> None:
        self.top = top
        self.project = project_root(top)
        self.inputs = 0
        self.problems = 0
        self.unreadable = 0
        self.near = 0
        self.excluded: list[tuple[Entry, str, Sequence[Glob]]] = []
        self.ignored: list[str] = []


class FolderSearch:
    """The files found so far, with their projects (None for a named file). `related` has the other
    source code, `near` the files that are nearly inputs, and `binary` the binary captures, in
    order. `known_kind` may know what `content` says of a file from an earlier run.
    """

    def __init__(
        self,
        settings_for: Callable[[str], Scope],
        sources: bool,
        log: Callable[[str], None] | None,
        speaks: Callable[[str], bool] | None,
        known_kind: KnownKind | None = None,
    ) -> None:
        self.settings_for = settings_for
        self.sources = sources
        self.log = log
        self.speaks = speaks or _file_speaks
        self.known_kind = known_kind or _call
        self.entries = 0
        self.unreadable_sources = 0
        self.files: dict[str, str | None] = {}
        self.related: dict[str, Search] = {}
        self.searches: list[Search] = []
        self.near: dict[str, None] = {}
        self.binary: dict[str, None] = {}
        self.findings: list[Finding] = []
        self.notes: list[str] = []

    def add_folder(self, top: str) -> None:
        """Adds the inputs of a folder and of the folders in it."""
        glob = excluding(top, self.settings_for(top).exclude, folder=True)
        if glob is not None:
            self.notes.append(excluded_note(top, glob))
            return
        self.search(Search(top), above(top), _scan, self._add_entries)

    def search(
        self,
        search: Search,
        ignore_files: IgnoreFiles,
        scan: Callable[[str], Sequence[AnEntry]],
        add: Callable[[Folder, Sequence[AnEntry], Search, list[Folder]], None],
    ) -> None:
        """Searches a folder and the folders in it: `scan` lists one, and `add` adds the inputs
        among what is in it.
        """
        findings, unreadable, near = len(self.findings), self.unreadable_sources, len(self.near)
        waiting = [Folder(search.top, 0, ignore_files)]
        while waiting:
            folder = waiting.pop()
            if folder.depth > MAX_DEPTH:
                self.notes.append(
                    f"{shown(folder.path)} is more than {MAX_DEPTH} folders deep: name it to lint "
                    "it"
                )
                continue
            try:
                entries = scan(folder.path)
            except OSError as error:
                self.findings.append(
                    diagnostic(
                        "MSAA921",
                        f"cannot read the folder: {error.strerror or error}",
                        shown(folder.path),
                    )
                )
                continue
            if folder.path == search.top or all(entry.name != "pyvenv.cfg" for entry in entries):
                add(folder, entries, search, waiting)
        search.problems = len(self.findings) - findings
        search.unreadable, search.near = self.unreadable_sources - unreadable, len(self.near) - near
        self.searches.append(search)

    def check_inputs(self, search: Search) -> None:
        """Adds a finding for a folder without inputs, unless another one says why."""
        if not search.inputs and not search.problems:
            reason = missing_extra() if search.unreadable else self._reason(search, search.near)
            self.findings.append(
                diagnostic(
                    "MSAA921",
                    f"nothing to lint in {quoted(search.top)}: {reason}",
                    shown(search.top),
                )
            )

    def _add_entries(
        self,
        folder: Folder,
        entries: Sequence[os.DirEntry[str]],
        search: Search,
        waiting: list[Folder],
    ) -> None:
        """Adds the inputs among the entries of a folder, and its folders to `waiting`."""
        self.entries += len(entries)
        settings = self.settings_for(folder.path)
        ignore_files = folder.above.below(
            folder.path, {entry.name for entry in entries if entry.name.startswith(".")}
        )
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
                    waiting.append(Folder(path, folder.depth + 1, ignore_files))
            elif not self.is_candidate(entry.name.lower(), path, settings.include):
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

    def is_candidate(self, name: str, path: str, include: Sequence[Glob]) -> bool:
        """Whether a file may be an input, by its name."""
        if include:
            return excluding(path, include) is not None
        return not name.startswith(".") and name.endswith(
            (*DESCRIPTIONS, *DATA, *CAPTURES, *(SOURCES if self.sources else ()))
        )

    def _add_file(self, entry: Entry, path: str, include: Sequence[Glob], search: Search) -> None:
        """Adds a candidate if it is an input."""
        kind: str | None = None
        with suppress(OSError):
            kind = self.kind(entry, path, include)
        self.add_kind(kind, entry, path, search)

    def add_kind(self, kind: str | None, entry: Entry, path: str, search: Search) -> None:
        """Adds a candidate of a kind; None is that of one that cannot be read."""
        if kind is None:
            self.notes.append(f"{shown(path)} cannot be read to see if it is an input")
        if kind == OTHER:
            self.skip(path, "not an input")
            if (
                not is_url(path)
                and entry.name.lower().endswith(SOURCES)
                and entry.is_file(follow_symlinks=False)
            ):
                self.related[shown(path)] = search
        if kind == NEAR:
            self.near[shown(path)] = None
        elif kind == BINARY:
            self.binary[shown(path)] = None
        elif (
            kind == INPUT
            and entry.is_symlink()
            and not (is_inside(path, search.project) and entry.is_file())
        ):
            self.notes.append(
                f"{shown(path)} is a link that is broken or leaves the project: name it to lint it"
            )
        elif kind == INPUT and entry.is_file():
            if (
                entry.name.lower().endswith((*SOURCES, *PAGE_ENDINGS))
                and not self._can_read_sources
            ):
                self.unreadable_sources += 1
            else:
                self.files.setdefault(shown(path), search.project)
                search.inputs += 1
        elif kind == INPUT and not entry.is_dir():
            self.notes.append(f"{shown(path)} is not a regular file: not linted")

    def kind(self, entry: Entry, path: str, include: Sequence[Glob]) -> str:
        """Whether a candidate is an input. A link's target is not read: it may be anywhere."""
        name = entry.name.lower()
        is_regular = entry.is_file(follow_symlinks=False)
        if include or name.endswith(DESCRIPTIONS):
            if not (is_regular and name.endswith(_OUTPUTS)):
                return INPUT
            return self._data_kind(path, _kind_of_description)
        if not is_regular:
            return OTHER
        if name.endswith(SOURCES):
            return INPUT if (_file_speaks if is_url(path) else self.speaks)(path) else OTHER
        return self._data_kind(path, _kind_of_data)

    def _data_kind(self, path: str, find: Callable[[str], str]) -> str:
        return self.known_kind(path, find) if self.entries >= MIN_ENTRIES else find(path)

    def _reason(self, search: Search, near: int) -> str:
        """Why a folder has no inputs."""
        excluded = 0
        for candidate in search.excluded:
            with suppress(OSError):
                excluded += self.kind(*candidate) == INPUT
        if excluded and not search.ignored and not near:
            return f"all inputs are excluded ({excluded})"
        names = ", ".join("*" + ending for ending in DESCRIPTIONS)
        skipped = [
            f"{count(excluded, 'excluded input')}" if excluded else "",
            f"{count(len(search.ignored), 'path')} that .gitignore or .ignore lists"
            if search.ignored
            else "",
            f"{count(near, 'file')} that look a little like descriptions" if near else "",
        ]
        skips = ", ".join(filter(None, skipped))
        advice = f"inputs are called {names} or contain a Vulkan or Metal frame; name other files"
        return f"{advice} (skipped: {skips})" if skips else advice

    @cached_property
    def _can_read_sources(self) -> bool:
        from .code import installed

        return installed()


def _scan(folder: str) -> Sequence[os.DirEntry[str]]:
    with os.scandir(folder) as scan:
        return sorted(scan, key=lambda entry: entry.name)


def _call(path: str, find: Callable[[str], str]) -> str:
    return find(path)


def _kind_of_description(path: str) -> str:
    from .content import is_own_output

    return OTHER if is_own_output(path) else INPUT


def _kind_of_data(path: str) -> str:
    from .content import kind_of

    return kind_of(path)


def _file_speaks(path: str) -> bool:
    from .code.mentions import file_speaks

    return file_speaks(path)

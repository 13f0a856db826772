"""Finds the inputs: the named files, and the inputs in the named folders."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from typing import NamedTuple, Protocol

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.globs import Glob, excluding
from msaa_lint.core.project import inside, project_root, shown
from msaa_lint.core.quote import quoted

from .file_types import DATA, DESCRIPTIONS, HEAD_BYTES, LANGUAGES, SOURCES, STDIN, missing_extra

MAX_DEPTH = 64
_SKIPPED = frozenset({"node_modules", "bower_components", "__pycache__", "__pypackages__", "site-packages", "venv", "CVS"})


class Scope(Protocol):
    """The settings that discovery needs: the globs of inputs in folders, and of files that are not linted."""

    @property
    def include(self) -> Sequence[Glob]: ...
    @property
    def exclude(self) -> Sequence[Glob]: ...


class Discovered(NamedTuple):
    """The input files, each once and sorted, as findings name them; findings about paths; notes for the user."""

    files: list[str]
    findings: list[Finding]
    notes: list[str]


def discover(
    paths: Iterable[str], settings_for: Callable[[str], Scope], looks_like: Callable[[str], bool], sources: bool = False
) -> Discovered:
    """The files to lint.

    A named file is linted whatever its name, unless `exclude` matches it; that is only a note, since commit hooks name every file. A
    folder contributes the files that `include` matches, or by default those called `*.msaa.yaml` (yml, json) and data files whose first
    64 KiB satisfy `looks_like`. `sources` adds source code that mentions multisampling, or a note if the extra that reads it is missing.
    Hidden folders and those of tools and environments are skipped. Links to folders are not followed; links to files are if they stay in
    the project. A missing path and a folder without inputs are findings (MSAA921).

    `settings_for` gives the settings of a file or folder. `-` stays as it is.
    """
    walk = _Walk(settings_for, looks_like, sources)
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
    if walk.unreadable_sources:
        many = "1 source file" if walk.unreadable_sources == 1 else f"{walk.unreadable_sources} source files"
        walk.notes.append(f"{many} skipped: {missing_extra()}")
    return Discovered(sorted(walk.files, key=lambda name: (name.split("/"), name)), walk.findings, list(dict.fromkeys(walk.notes)))


def _excluded(path: str, glob: Glob) -> str:
    return f"{shown(path)} is excluded by {quoted(glob.pattern)}"


class _Walk:
    """The files found so far."""

    def __init__(self, settings_for: Callable[[str], Scope], looks_like: Callable[[str], bool], sources: bool) -> None:
        self.settings_for = settings_for
        self.looks_like = looks_like
        self.sources = sources
        self.unreadable_sources = 0
        self.files: dict[str, None] = {}
        self.findings: list[Finding] = []
        self.notes: list[str] = []

    def add_folder(self, top: str) -> None:
        """Adds the inputs of a folder and of the folders in it."""
        glob = excluding(top, self.settings_for(top).exclude, folder=True)
        if glob is not None:
            self.notes.append(_excluded(top, glob))
            return
        project = project_root(top)
        findings, unreadable, excluded, inputs = len(self.findings), self.unreadable_sources, 0, 0
        waiting = [(top, 0)]
        while waiting:
            folder, depth = waiting.pop()
            if depth > MAX_DEPTH:
                self.notes.append(f"{shown(folder)} is more than {MAX_DEPTH} folders deep: name it to lint it")
                continue
            settings = self.settings_for(folder)
            try:
                with os.scandir(folder) as scan:
                    entries = sorted(scan, key=lambda entry: entry.name)
            except OSError as error:
                self.findings.append(diagnostic("MSAA921", f"cannot read the folder: {error.strerror or error}", shown(folder)))
                continue
            if folder != top and any(entry.name == "pyvenv.cfg" for entry in entries):
                continue
            for entry in entries:
                # Without the `./` that joining `.` would give: globs and names do not have it.
                path = entry.name if folder == os.curdir else os.path.join(folder, entry.name)
                if entry.is_dir(follow_symlinks=False):
                    if not (entry.name.startswith(".") or entry.name in _SKIPPED or excluding(path, settings.exclude, folder=True)):
                        waiting.append((path, depth + 1))
                elif not self._is_input(entry, path, settings.include):
                    continue
                elif excluding(path, settings.exclude):
                    excluded += 1
                elif entry.is_symlink() and not (os.path.isfile(path) and inside(path, project)):
                    self.notes.append(f"{shown(path)} is a link that is broken or leaves the project: name it to lint it")
                elif os.path.isfile(path):
                    if entry.name.lower().endswith((*SOURCES, *LANGUAGES["markdown"])) and not self._can_read_sources:
                        self.unreadable_sources += 1
                    else:
                        self.files[shown(path)] = None
                        inputs += 1
        if not inputs and len(self.findings) == findings:
            if self.unreadable_sources > unreadable:
                reason = missing_extra()
            elif excluded:
                reason = f"all inputs are excluded ({excluded})"
            else:
                names = ", ".join("*" + ending for ending in DESCRIPTIONS)
                reason = f"inputs are called {names} or look like one; name other files"
            self.findings.append(diagnostic("MSAA921", f"nothing to lint in {quoted(top)}: {reason}", shown(top)))

    def _is_input(self, entry: os.DirEntry[str], path: str, include: Sequence[Glob]) -> bool:
        if include:
            return excluding(path, include) is not None
        name = entry.name.lower()
        if name.startswith("."):
            return False
        if name.endswith(DESCRIPTIONS):
            return True
        # A link's target is not read: it may be anywhere.
        is_source = self.sources and name.endswith(SOURCES)
        if not (is_source or name.endswith(DATA)) or not entry.is_file(follow_symlinks=False):
            return False
        try:
            if is_source:
                from .code.mentions import file_speaks

                return file_speaks(path)
            return self.looks_like(_head(path))
        except OSError:
            if not is_source:
                self.notes.append(f"{shown(path)} cannot be read to see if it is an input")
            return False

    @cached_property
    def _can_read_sources(self) -> bool:
        from .code import installed

        return installed()


def _head(path: str) -> str:
    with open(path, "rb") as file:
        data = file.read(HEAD_BYTES)
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    return data.decode(encoding, "replace")

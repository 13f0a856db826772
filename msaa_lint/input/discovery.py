"""What is linted: the files named, and the inputs in the folders named."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple, Protocol

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.globs import Glob, excluding
from msaa_lint.core.project import inside, project_root, shown
from msaa_lint.core.quote import quoted

STDIN = "-"
ENDINGS = (".msaa.yaml", ".msaa.yml", ".msaa.json")
"""Of the files of a folder that are inputs by their name."""

MAYBE = (".yaml", ".yml", ".json", ".jsonl", ".xml", ".foz")
"""Of those that are inputs if they look like one."""

SOURCES = (
    ".c", ".h", ".cc", ".cpp", ".cxx", ".hpp", ".hh", ".hxx", ".inl", ".ipp", ".h++", ".swift",
    ".glsl", ".vert", ".frag", ".comp", ".tesc", ".tese", ".geom", ".mesh", ".task",
)  # fmt: skip
"""Of those that are inputs if they speak of multisampling: source code, `programs.LANGUAGES` without Markdown, which is no program."""

PAGES = (".md", ".markdown", ".mdx")
"""Of those whose code is read where they are asked for."""

EXTRA = 'reading source code requires an extra; install it with `pip install "msaa-lint[source]"`'

HEAD_BYTES = 64 << 10
MAX_DEPTH = 64
_PASSED_OVER = frozenset({"node_modules", "bower_components", "__pycache__", "__pypackages__", "site-packages", "venv", "CVS"})


class Scope(Protocol):
    """The settings that discovery needs: the globs of files to lint and to leave out."""

    @property
    def include(self) -> Sequence[Glob]: ...
    @property
    def exclude(self) -> Sequence[Glob]: ...


class Discovered(NamedTuple):
    """The files, each once and in order, as findings name them; what cannot be linted; and what a person may want to know (one line
    each, for the standard error stream)."""

    files: list[str]
    findings: list[Finding]
    notes: list[str]


def discover(
    paths: Iterable[str], settings_for: Callable[[str], Scope], looks_like: Callable[[str], bool], sources: bool = False
) -> Discovered:
    """The files to lint.

    A file named is linted whatever its name, unless `exclude` has it: that is noted and no error, since hooks name every file. Of a
    folder, its inputs are: by `include`, else those called `*.msaa.yaml` (yml, json) and the YAML and JSON files whose first 64 KiB
    satisfy `looks_like`; with `sources` the source code that speaks of multisampling, too, where the extra that reads it is installed: else
    it is counted in a note. Hidden folders and those of tools and environments are passed over; links to folders are not followed, links
    to files are where they stay in the project. A path that is not there and a folder without inputs are findings (MSAA921).

    `settings_for` gives the settings that govern a file or folder. `-` is handed on as it is.
    """
    walk = _Walk(settings_for, looks_like, sources)
    for path in paths:
        if path == STDIN:
            walk.files[STDIN] = None
        elif os.path.isdir(path):
            walk.folder(path)
        elif os.path.exists(path):
            glob = excluding(path, settings_for(path).exclude)
            if glob is None:
                walk.files[shown(path)] = None
            else:
                walk.notes.append(_excluded(path, glob))
        else:
            help = "a link to nothing" if os.path.lexists(path) else ""
            walk.findings.append(diagnostic("MSAA921", f"no such file or folder {quoted(path)}", shown(path), help=help))
    if walk.unread:
        many = "1 file" if walk.unread == 1 else f"{walk.unread} files"
        walk.notes.append(f"{many} of source code passed over: {EXTRA}")
    return Discovered(sorted(walk.files, key=_order), walk.findings, list(dict.fromkeys(walk.notes)))


def _order(name: str) -> tuple[list[str], str]:
    return name.split("/"), name


def _excluded(path: str, glob: Glob) -> str:
    return f"{shown(path)} is excluded by {quoted(glob.pattern)}"


class _Walk:
    """The folders of one run."""

    def __init__(self, settings_for: Callable[[str], Scope], looks_like: Callable[[str], bool], sources: bool) -> None:
        self.settings_for = settings_for
        self.looks_like = looks_like
        self.sources = sources
        self.unread = 0
        self._code: bool | None = None
        self.files: dict[str, None] = {}
        self.findings: list[Finding] = []
        self.notes: list[str] = []

    def folder(self, top: str) -> None:
        """Takes the inputs of a folder and of those in it."""
        glob = excluding(top, self.settings_for(top).exclude, folder=True)
        if glob is not None:
            self.notes.append(_excluded(top, glob))
            return
        project = project_root(top)
        before, excluded, unread = len(self.findings), 0, self.unread
        taken: list[str] = []
        waiting = [(top, 0)]
        while waiting:
            folder, depth = waiting.pop()
            if depth > MAX_DEPTH:
                self.notes.append(f"{shown(folder)} is more than {MAX_DEPTH} folders deep: name it to lint it")
                continue
            settings = self.settings_for(folder)
            try:
                with os.scandir(folder) as entries:
                    inner = sorted(entries, key=lambda entry: entry.name)
            except OSError as error:
                self.findings.append(diagnostic("MSAA921", f"the folder cannot be read: {error.strerror or error}", shown(folder)))
                continue
            if folder != top and any(entry.name == "pyvenv.cfg" for entry in inner):
                continue
            for entry in inner:
                # Joined without the `./` that `.` would give: globs and names need none.
                path = entry.name if folder == os.curdir else os.path.join(folder, entry.name)
                if entry.is_dir(follow_symlinks=False):
                    if not (entry.name.startswith(".") or entry.name in _PASSED_OVER or excluding(path, settings.exclude, folder=True)):
                        waiting.append((path, depth + 1))
                elif self._is_input(entry, path, settings.include):
                    if excluding(path, settings.exclude):
                        excluded += 1
                    elif entry.is_symlink() and not (os.path.isfile(path) and inside(path, project)):
                        self.notes.append(f"{shown(path)} is a link that leaves the project, or to no file: name it to lint it")
                    elif os.path.isfile(path):
                        if entry.name.lower().endswith((*SOURCES, *PAGES)) and not self._reads_code():
                            self.unread += 1
                        else:
                            taken.append(path)
        self.files.update((shown(path), None) for path in taken)
        if not taken and len(self.findings) == before:
            names = ", ".join("*" + ending for ending in ENDINGS)
            help = f"its inputs are excluded ({excluded})" if excluded else f"inputs are called {names}, or look like one; name others"
            if self.unread > unread:
                help = EXTRA
            self.findings.append(diagnostic("MSAA921", f"nothing to lint in {quoted(top)}", shown(top), help=help))

    def _is_input(self, entry: os.DirEntry[str], path: str, include: Sequence[Glob]) -> bool:
        if include:
            return excluding(path, include) is not None
        name = entry.name.lower()
        if name.startswith("."):
            return False
        if name.endswith(ENDINGS):
            return True
        if self.sources and name.endswith(SOURCES):
            return entry.is_file(follow_symlinks=False) and self._speaks(path)
        # The target of a link is not looked into: it may lie anywhere.
        if not name.endswith(MAYBE) or not entry.is_file(follow_symlinks=False):
            return False
        try:
            return self.looks_like(_head(path))
        except OSError:
            self.notes.append(f"{shown(path)} cannot be read, and its name does not say that it is an input")
            return False

    def _speaks(self, path: str) -> bool:
        from .code.mentions import file_speaks

        try:
            return file_speaks(path)
        except OSError:
            return False

    def _reads_code(self) -> bool:
        """Whether the extra that reads source code is installed."""
        if self._code is None:
            from .code import installed

            self._code = installed()
        return self._code


def _head(path: str) -> str:
    """The beginning of a file as text, whatever is in it."""
    with open(path, "rb") as file:
        data = file.read(HEAD_BYTES)
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    return data.decode(encoding, "replace")

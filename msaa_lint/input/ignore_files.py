"""Which files and folders `.gitignore`, `.ignore`, and `.git/info/exclude` exclude, as git,
ripgrep, and ruff read them.

`.gitignore` applies in a git repository only, from the repository's root downward; a repository
within another one begins anew. `.ignore` applies everywhere, in all parent folders too, and takes
precedence. In each case the nearest file decides, and in a file the last pattern that matches.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection
from typing import NamedTuple

from msaa_lint.core.globs import compiled
from msaa_lint.core.text.files import read
from msaa_lint.core.text.source import Unreadable

MAX_PATTERNS = 4096
"""The number of patterns of a file that are used: every path is compared with all of them."""

_MAX_BYTES = 1 << 20
_REPOSITORIES = (".git", ".jj")


class Patterns(NamedTuple):
    """Patterns as one expression with a group each, and the line of each, negative for a negated
    one; the last line comes first.
    """

    expression: re.Pattern[str]
    lines: tuple[int, ...]

    def line(self, path: str, start: int) -> int:
        """The last line whose pattern matches a path from an offset on, negative if it is negated;
        0 if none does.
        """
        match = self.expression.match(path, start)
        return 0 if match is None or match.lastindex is None else self.lines[match.lastindex - 1]


class Rules(NamedTuple):
    """The patterns of a file: those that match names in any folder, and those of paths. `root` is
    the file's folder with a slash.
    """

    root: str
    names: Patterns
    paths: Patterns

    def ignores(self, path: str) -> bool | None:
        """Whether the file ignores an absolute path below its folder; None if no pattern matches.
        The path of a folder ends in a slash.
        """
        line = max(
            self.names.line(path, path.rfind("/", 0, -1) + 1),
            self.paths.line(path, len(self.root)),
            key=abs,
        )
        return line > 0 if line else None


class IgnoreFiles(NamedTuple):
    """The rules that apply in a folder, in order of precedence: of `.ignore` files, and of
    git's.
    """

    ignore: tuple[Rules, ...] = ()
    git: tuple[Rules, ...] = ()
    in_repository: bool = False

    def ignores(self, path: str) -> bool:
        """Whether to skip an entry of the folder, by its absolute path with `/`; the path of a
        folder ends in a slash.
        """
        for rules in (*self.ignore, *self.git):
            ignored = rules.ignores(path)
            if ignored is not None:
                return ignored
        return False

    def below(self, folder: str, names: Collection[str]) -> IgnoreFiles:
        """The rules that apply in a folder, given those of its parent and the names in it."""
        ignore, git, in_repository = self
        repository = next((name for name in _REPOSITORIES if name in names), None)
        if repository is not None:
            git, in_repository = (
                _rules(_exclude_file(folder), folder) if repository == ".git" else (),
                True,
            )
        if in_repository and ".gitignore" in names:
            git = (*_rules(os.path.join(folder, ".gitignore"), folder), *git)
        if ".ignore" in names:
            ignore = (*_rules(os.path.join(folder, ".ignore"), folder), *ignore)
        return IgnoreFiles(ignore, git, in_repository)


def above(folder: str) -> IgnoreFiles:
    """The rules of the folders above a folder."""
    at, parents = os.path.abspath(folder), []
    while (parent := os.path.dirname(at)) != at:
        parents.append(parent)
        at = parent
    files = IgnoreFiles()
    for parent in reversed(parents):
        names = [
            name
            for name in (*_REPOSITORIES, ".gitignore", ".ignore")
            if os.path.lexists(os.path.join(parent, name))
        ]
        files = files.below(parent, names)
    return files


def _rules(path: str, folder: str) -> tuple[Rules, ...]:
    """The rules of a file that are relative to a folder; none if it has none, cannot be read, or is
    a link, as git does not follow it.
    """
    if os.path.islink(path):
        return ()
    try:
        data = read(path, _MAX_BYTES, os.path.dirname(path))
    except (OSError, Unreadable):
        return ()
    lines: dict[bool, list[tuple[int, str]]] = {False: [], True: []}
    for number, text in enumerate(
        os.fsdecode(data.removeprefix(b"\xef\xbb\xbf")).split("\n")[:MAX_PATTERNS], 1
    ):
        pattern = _pattern(text)
        try:
            glob = compiled(pattern) if pattern else None
        except ValueError:
            continue  # Git ignores nothing by it either.
        if glob is not None:
            lines[glob.anchored].append((-number if glob.negated else number, glob.exact.pattern))
    if not lines[False] and not lines[True]:
        return ()
    root = os.path.abspath(folder).replace(os.sep, "/")
    return (
        Rules(
            root if root.endswith("/") else root + "/",
            _patterns(lines[False]),
            _patterns(lines[True]),
        ),
    )


def _patterns(lines: list[tuple[int, str]]) -> Patterns:
    lines = lines[::-1]
    # Without patterns, an expression that matches nothing.
    expression = "|".join(f"({pattern})" for _, pattern in lines) or r"(?!)"
    return Patterns(re.compile(expression, re.DOTALL), tuple(line for line, _ in lines))


def _pattern(line: str) -> str:
    """The glob of a line; empty for a comment, for a blank line, and for a path that leaves its
    folder.
    """
    line = line.removesuffix("\r")
    text = line.rstrip(" ")
    if len(text) < len(line) and (len(text) - len(text.rstrip("\\"))) % 2:
        text += " "
    return "" if text.startswith(("#", "./", "!./")) else text


def _exclude_file(folder: str) -> str:
    """`info/exclude` of a repository. In a worktree, `.git` is a file that names the folder; nobody
    can commit a file of that name.
    """
    repository = os.path.join(folder, ".git")
    if os.path.isfile(repository):
        repository = os.path.join(
            os.path.dirname(repository), _line(repository).removeprefix("gitdir:").strip()
        )
        repository = os.path.join(repository, _line(os.path.join(repository, "commondir")))
    return os.path.join(repository, "info", "exclude")


def _line(path: str) -> str:
    try:
        return os.fsdecode(read(path, 1 << 16, os.path.dirname(path))).strip()
    except (OSError, Unreadable):
        return ""

"""Which files and folders `.gitignore`, `.ignore`, and `.git/info/exclude` exclude, as git, ripgrep, and ruff read them.

`.gitignore` applies in a git repository only, from the repository's root downward; a repository within another one begins anew. `.ignore`
applies everywhere, in all parent folders too, and takes precedence. In each case the nearest file decides, and in a file the last pattern
that matches.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection
from typing import NamedTuple

from msaa_lint.core.globs import compiled
from msaa_lint.core.text.files import read
from msaa_lint.core.text.node import Limits
from msaa_lint.core.text.source import Unreadable

MAX_PATTERNS = 4096
"""The number of patterns of a file that are used: every path is compared with all of them."""

_LIMITS = Limits(bytes=1 << 20)
_REPOSITORIES = (".git", ".jj")


class Rules(NamedTuple):
    """The patterns of a file, the last one first, each a group of `pattern`; and which of them are negated. `root` ends in a slash."""

    root: str
    pattern: re.Pattern[str]
    negated: tuple[bool, ...]

    def ignores(self, path: str) -> bool | None:
        """Whether the file ignores an absolute path below its folder; None if no pattern matches. The path of a folder ends in a slash."""
        match = self.pattern.match(path, len(self.root))
        return None if match is None or match.lastindex is None else not self.negated[match.lastindex - 1]


class IgnoreFiles(NamedTuple):
    """The rules that apply in a folder, in order of precedence: of `.ignore` files, and of git's."""

    ignore: tuple[Rules, ...] = ()
    git: tuple[Rules, ...] = ()
    in_repository: bool = False

    def ignores(self, path: str) -> bool:
        """Whether to skip an entry of the folder, by its absolute path with `/`; the path of a folder ends in a slash."""
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
            git, in_repository = _rules(_exclude_file(os.path.join(folder, repository)), folder), True
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
        names = [name for name in (*_REPOSITORIES, ".gitignore", ".ignore") if os.path.lexists(os.path.join(parent, name))]
        files = files.below(parent, names)
    return files


def _rules(path: str, folder: str) -> tuple[Rules, ...]:
    """The rules of a file that are relative to a folder; none if it has none, cannot be read, or is a link, as git does not follow it."""
    if os.path.islink(path):
        return ()
    try:
        data = read(path, _LIMITS)
    except (OSError, Unreadable):
        return ()
    groups, negated = [], []
    for line in reversed(os.fsdecode(data.removeprefix(b"\xef\xbb\xbf")).split("\n")[:MAX_PATTERNS]):
        pattern = _pattern(line)
        try:
            glob = compiled(pattern) if pattern else None
        except ValueError:
            continue  # Git ignores nothing by it either.
        if glob is not None:
            groups.append(f"({glob.exact.pattern})")
            negated.append(glob.negated)
    root = os.path.abspath(folder).replace(os.sep, "/")
    root = root if root.endswith("/") else root + "/"
    return (Rules(root, re.compile("|".join(groups), re.DOTALL), tuple(negated)),) if groups else ()


def _pattern(line: str) -> str:
    """The glob of a line; empty for a comment, for a blank line, and for a path that leaves its folder."""
    line = line.removesuffix("\r")
    text = line.rstrip(" ")
    if len(text) < len(line) and (len(text) - len(text.rstrip("\\"))) % 2:
        text += " "
    return "" if text.startswith(("#", "./", "!./")) else text


def _exclude_file(repository: str) -> str:
    """`info/exclude` of a repository, whose `.git` may be a file that names the folder, as in a worktree."""
    if os.path.isfile(repository):
        repository = os.path.join(os.path.dirname(repository), _line(repository).removeprefix("gitdir:").strip())
        repository = os.path.join(repository, _line(os.path.join(repository, "commondir")))
    return os.path.join(repository, "info", "exclude")


def _line(path: str) -> str:
    try:
        return os.fsdecode(read(path, Limits(bytes=1 << 16))).strip()
    except (OSError, Unreadable):
        return ""

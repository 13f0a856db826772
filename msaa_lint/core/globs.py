"""Globs with the syntax of .gitignore, matched in linear time: a configuration may come from an
untrusted branch.

`*` and `?` do not match `/`; `**` between slashes matches any number of folders; `[a-z]`, `[!a-z]`
and `[[:digit:]]` match one character; a backslash escapes the next character. A glob with a slash
at its start or in the middle is relative to its root, any other matches at every depth; one that
ends in a slash matches folders only. A glob that matches a folder matches everything in it. A
leading `!` negates a glob.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from functools import lru_cache
from itertools import groupby
from typing import NamedTuple

MAX_LENGTH = 256
_ANY = "[^/]"
_NAME = "[^/]+"
_POSIX = {
    "alnum": "0-9A-Za-z", "alpha": "A-Za-z", "blank": " \\t", "cntrl": "\\0-\\x1f\\x7f",
    "digit": "0-9", "graph": "!-~", "lower": "a-z",
    "print": " -~", "punct": "!-/:-@\\[-`{-~", "space": "\\t-\\r ", "upper": "A-Z",
    "xdigit": "0-9A-Fa-f",
}  # fmt: skip
_POSIX_CLASS = re.compile(r"\[:(\w+):\]")


class Glob(NamedTuple):
    """A pattern and its root, the absolute path of the folder that it is relative to."""

    pattern: str
    root: str


class Compiled(NamedTuple):
    """`exact` matches a path itself, `below` also everything in it. The path of a folder must end
    in a slash. A glob that is not `anchored` matches the last name of a path, whatever folder it is
    in.
    """

    negated: bool
    anchored: bool
    exact: re.Pattern[str]
    below: re.Pattern[str]


@lru_cache(maxsize=1024)
def compiled(pattern: str) -> Compiled:
    """Compiles a pattern. Raises ValueError for one that cannot match anything."""
    negated = pattern.startswith("!")
    text = pattern[1:] if negated else pattern
    if len(text) > MAX_LENGTH:
        raise ValueError(f"it is longer than {MAX_LENGTH} characters")
    if text.startswith("./"):
        text = text[1:]
    folder = text.endswith("/")
    anchored = "/" in text[:-1]
    parts = (text[:-1] if folder else text).removeprefix("/").split("/")
    if "" in parts:
        raise ValueError("it has an empty name")
    if "." in parts or ".." in parts:
        raise ValueError("it leaves its folder")
    all_within = parts[-1] == "**"
    if all_within:
        parts[-1] = "*"
    if not anchored:
        parts.insert(0, "**")
    # Each run of names between two `**` matches at the first position where it fits. A later
    # position cannot do better, so the group is atomic and never backtracks, which keeps the time
    # linear.
    runs = [
        [_name(part) for part in run]
        for is_any, run in groupby(parts, key="**".__eq__)
        if not is_any
    ]
    if parts[0] == "**":
        runs.insert(0, [])
    out = "".join(name + "/" for name in runs[0]) if len(runs) > 1 else "/".join(runs[0])
    for run in runs[1:-1]:
        out += "(?>(?:[^/]+/)*?" + "".join(name + "/" for name in run) + ")"
    if len(runs) > 1:
        out += "(?:[^/]+/)*?" + "/".join(runs[-1])
    below, exact = ("/", r"/\Z") if folder else (r"(?:/|\Z)", r"/?\Z")
    whole = out.removesuffix(_NAME) + ".+" if all_within else out
    return Compiled(
        negated, anchored, re.compile(whole + exact, re.DOTALL), re.compile(out + below, re.DOTALL)
    )


def _name(part: str) -> str:
    """The expression of one name. Each piece between two stars matches at the first position where
    it fits.
    """
    pieces = [""]
    at = 0
    while at < len(part):
        char = part[at]
        at += 1
        if char == "*":
            if pieces[-1] or len(pieces) == 1:
                pieces.append("")
        elif char == "?":
            pieces[-1] += _ANY
        elif char == "[":
            piece, at = _class(part, at)
            pieces[-1] += piece
        elif char == "\\":
            if at == len(part):
                raise ValueError("it ends in a backslash")
            pieces[-1] += re.escape(part[at])
            at += 1
        else:
            pieces[-1] += re.escape(char)
    if len(pieces) == 1:
        return pieces[0]
    if not any(pieces):
        return _NAME
    first, *middle, last = pieces
    return first + "".join(f"(?>{_ANY}*?{piece})" for piece in middle) + f"{_ANY}*{last}"


def _class(part: str, at: int) -> tuple[str, int]:
    """The expression of a `[...]` that is open before `at`, and the offset after it."""
    negated = part[at : at + 1] in ("!", "^")
    at += negated
    chars: list[tuple[str, bool]] = []
    out = ""
    while True:
        if at >= len(part):
            raise ValueError("a `[` without its `]`")
        posix = _POSIX_CLASS.match(part, at)
        if posix is not None:
            if posix[1] not in _POSIX:
                raise ValueError(f"unknown character class `{posix[0]}`")
            out += _POSIX[posix[1]]
            at = posix.end()
            continue
        char = part[at]
        at += 1
        if char == "]" and (chars or out):
            break
        if char == "\\" and at < len(part):
            char, at = part[at], at + 1
            chars.append((char, False))
        else:
            chars.append((char, char == "-"))
    i = 0
    while i < len(chars):
        if i + 2 < len(chars) and chars[i + 1][1]:
            low, high = chars[i][0], chars[i + 2][0]
            if low > high:
                raise ValueError(f"the range `{low}-{high}` is reversed")
            out += f"{re.escape(low)}-{re.escape(high)}"
            i += 3
        else:
            out += re.escape(chars[i][0])
            i += 1
    return f"(?!/)[{'^' if negated else ''}{out}]", at


def relative(file: str, root: str) -> str:
    """`file` relative to `root`, with `/`. A file outside of it is relative to the folder that both
    share.
    """
    try:
        path = os.path.relpath(file, root)
    except ValueError:  # another drive on Windows, or a NUL character
        path = os.path.basename(file)
    path = path.replace(os.sep, "/")
    while path.startswith("../"):
        path = path[3:]
    return path


def matches(file: str, glob: Glob) -> bool:
    """Whether a glob matches a file or, with `!`, does not match it. The root itself never
    matches.
    """
    ready = compiled(glob.pattern)
    path = relative(file, glob.root)
    return path != os.curdir and (ready.below.match(path) is not None) != ready.negated


def excluding(file: str, globs: Sequence[Glob], folder: bool = False) -> Glob | None:
    """The glob that excludes a file or folder, or a folder that it is in; None if none does.

    The last glob that matches decides, so that a later `!` includes files again, except in a folder
    that is excluded itself.
    """
    paths = {glob.root: relative(file, glob.root) + ("/" if folder else "") for glob in globs}
    ready = [(glob, compiled(glob.pattern)) for glob in globs if paths[glob.root] != "./"]
    if not any(each.negated for _, each in ready):
        return next((glob for glob, each in ready if each.below.match(paths[glob.root])), None)
    prefixes = {glob.root: _prefixes(paths[glob.root]) for glob, _ in ready}
    for level in range(max(map(len, prefixes.values())), 0, -1):
        for glob, each in reversed(ready):
            own = prefixes[glob.root]
            if level <= len(own) and each.exact.match(own[-level]):
                if not each.negated:
                    return glob
                break
    return None


def _prefixes(path: str) -> list[str]:
    """`a/`, `a/b/`, `a/b/c` of `a/b/c`."""
    ends = [i + 1 for i, char in enumerate(path) if char == "/"]
    return [path[:end] for end in ends if end < len(path)] + [path]

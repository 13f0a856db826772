"""What a compile_commands.json says of the files of a project: the macros that the build defines,
and the target that a file belongs to.

No command of it is run. It may come from a stranger, so that paths outside the project are passed
over.
"""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from msaa_lint.core.project import shown
from msaa_lint.core.text.files import open_file

NAME = "compile_commands.json"

FOLDERS = ("", "build", "out", "Build", "cmake-build-debug", "cmake-build-release", "builddir")
"""The folders in that of a project in which the file is searched."""

MAX_BYTES = 64 << 20

MAX_WORDS = 4000
"""The maximum number of words of a command that are read."""

_TARGET = re.compile(r"(?:^|[/\\])CMakeFiles[/\\]([^/\\]+)\.dir[/\\]")
_DEFINITION = re.compile(r"([A-Za-z_]\w*)(?:=(.*))?", re.DOTALL)


class BuildEntry(NamedTuple):
    """How a build compiles a file: the target (empty: unknown), and the macros that it defines, as
    directives.
    """

    target: str
    definitions: str


def build_entries(root: str) -> dict[str, BuildEntry]:
    """Returns how a project is built, by the paths of its files as findings name them; an empty
    dictionary if nothing says so.
    """
    for folder in FOLDERS:
        try:
            file, size = open_file(os.path.join(root, folder, NAME), root)
            with file:
                data = file.read(MAX_BYTES + 1) if size is not None and size <= MAX_BYTES else b""
        except OSError:
            continue
        return dict(_entries(data, os.path.join(root, folder), root))
    return {}


def _entries(data: bytes, folder: str, root: str) -> Iterator[tuple[str, BuildEntry]]:
    import orjson

    try:
        commands = orjson.loads(data)
    except ValueError:
        return
    inside = os.path.join(root, "")
    seen: set[str] = set()
    for command in commands if isinstance(commands, list) else ():
        if not isinstance(command, dict) or not isinstance(command.get("file"), str):
            continue
        stated = command.get("directory")
        try:
            base = os.path.realpath(os.path.join(folder, stated if isinstance(stated, str) else ""))
        except (OSError, ValueError):
            continue
        path = os.path.normpath(os.path.join(base, command["file"]))
        if path.startswith(inside) and path not in seen:
            seen.add(path)
            yield shown(path), _entry(command)


def _entry(command: dict[str, Any]) -> BuildEntry:
    words = _words(command)
    output = command.get("output")
    outputs = [output] if isinstance(output, str) else words
    target = next((match[1] for match in map(_TARGET.search, outputs) if match is not None), "")
    return BuildEntry(target, "".join(_directives(words)))


def _words(command: dict[str, Any]) -> list[str]:
    arguments = command.get("arguments")
    if isinstance(arguments, list):
        return [word for word in arguments[:MAX_WORDS] if isinstance(word, str)]
    text = command.get("command")
    if not isinstance(text, str):
        return []
    try:
        return shlex.split(text[: 1 << 16])[:MAX_WORDS]
    except ValueError:
        return []


def _directives(words: Sequence[str]) -> Iterator[str]:
    """Yields the macros that the words of a command define, as directives. `-DN` defines N as 1."""
    for number, word in enumerate(words):
        text = word[2:] if word[:2] in ("-D", "/D") else ""
        if word in ("-D", "/D") and number + 1 < len(words):
            text = words[number + 1]
        match = _DEFINITION.fullmatch(text)
        if match is not None and "\n" not in text and "\r" not in text:
            yield f"#define {match[1]} {'1' if match[2] is None else match[2]}\n"

"""The version of msaa-lint, which results that are kept between runs depend on."""

from __future__ import annotations

import os
from collections.abc import Iterator
from importlib.util import find_spec

from msaa_lint.core.package import FOLDER, VERSION
from msaa_lint.input.code.languages import GRAMMARS


def version(*folders: str) -> str:
    """Returns a text that differs if the tool, one of its modules or a file of `folders`, or a
    grammar differs.
    """
    parts = [VERSION]
    for name in sorted({"tree_sitter", *GRAMMARS.values()}):
        spec = find_spec(name)
        parts.append(
            f"{name} {_changed(spec.origin) if spec is not None and spec.origin is not None else ''}"  # noqa: E501
        )
    for folder in (FOLDER, *folders):
        parts += _files(folder)
    return "\n".join(parts)


def _files(folder: str) -> Iterator[str]:
    """Yields the files in a folder, when each was changed, and its size."""
    with os.scandir(folder) as scan:
        entries = sorted(scan, key=lambda entry: entry.name)
    for entry in entries:
        if not entry.is_dir(follow_symlinks=False):
            yield f"{entry.name} {_changed(entry)}"
        elif entry.name != "__pycache__":
            yield from _files(entry.path)


def _changed(file: str | os.DirEntry[str]) -> str:
    """Returns when a file changed, and its size."""
    try:
        status = os.stat(file) if isinstance(file, str) else file.stat()
    except OSError:
        return ""
    return f"{status.st_mtime_ns} {status.st_size}"

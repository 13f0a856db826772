"""The version of msaa-lint, which results that are kept between runs depend on."""

from __future__ import annotations

import os
from importlib.util import find_spec

from msaa_lint.core.package import FOLDER, VERSION
from msaa_lint.input.code.languages import GRAMMARS


def version(*folders: str) -> str:
    """Returns a text that differs if the tool, one of its modules or a file of `folders`, or a grammar differs."""
    parts = [VERSION]
    for name in sorted({"tree_sitter", *GRAMMARS.values()}):
        spec = find_spec(name)
        parts.append(f"{name} {_changed(spec.origin) if spec is not None and spec.origin is not None else ''}")
    for folder in (FOLDER, *folders):
        for path, inner, names in os.walk(folder):
            inner[:] = sorted(name for name in inner if name != "__pycache__")
            parts += [f"{name} {_changed(os.path.join(path, name))}" for name in sorted(names)]
    return "\n".join(parts)


def _changed(path: str) -> str:
    """Returns when a file changed, and its size."""
    try:
        status = os.stat(path)
    except OSError:
        return ""
    return f"{status.st_mtime_ns} {status.st_size}"

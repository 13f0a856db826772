"""The version of what reads source code, which results that are kept between runs depend on."""

from __future__ import annotations

import os
from importlib.util import find_spec

from msaa_lint.core.package import VERSION
from msaa_lint.input.code.languages import GRAMMARS

_ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
_FOLDERS = ("input/code", "core/text", "frame/vulkan", "frame/metal")
"""The folders of the package, relative to it, whose modules read source code."""


def version() -> str:
    """Returns a text that differs if the tool, a module that reads source code, or a grammar differs."""
    parts = [VERSION]
    for name in sorted({"tree_sitter", *GRAMMARS.values()}):
        spec = find_spec(name)
        parts.append(f"{name} {_changed(spec.origin) if spec is not None and spec.origin is not None else ''}")
    for folder in _FOLDERS:
        for path, _, names in sorted(os.walk(os.path.join(_ROOT, *folder.split("/")))):
            parts += [f"{name} {_changed(os.path.join(path, name))}" for name in sorted(names) if name.endswith(".py")]
    return "\n".join(parts)


def _changed(path: str) -> str:
    """Returns when a file changed, and its size."""
    try:
        status = os.stat(path)
    except OSError:
        return ""
    return f"{status.st_mtime_ns} {status.st_size}"

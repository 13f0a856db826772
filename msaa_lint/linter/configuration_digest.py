"""A name for everything but inputs that findings depend on, so that two runs can be told to have
had the same settings.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING

from msaa_lint.core.cache import text_digest

if TYPE_CHECKING:
    from .input_file import ResolvedSettings
    from .request import Request


def configuration_digest(request: Request, resolved: Iterable[ResolvedSettings]) -> str:
    """The digest of the settings of a run: options, configurations by their place below the current
    folder, and rule pages and devices by their content. It is the same wherever the folder is.
    """
    stated = (request.ignores, request.format, request.frame_end, bool(request.without_baseline))
    parts = sorted(repr((_place(each.configuration), _values(each))) for each in resolved)
    return text_digest(repr((stated, parts)))


def _values(resolved: ResolvedSettings) -> tuple[object, ...]:
    settings = resolved.settings
    # What says where something is, or how it is shown, is left out.
    stated = settings._replace(
        root="",
        baseline=None,
        rules=(),
        output=(),
        docs_url="",
        origin={},
        per_file_ignores=tuple(
            (glob._replace(root=_place(glob.root) or ""), rules)
            for glob, rules in settings.per_file_ignores
        ),
        exclude=tuple(glob._replace(root=_place(glob.root) or "") for glob in settings.exclude),
        include=tuple(glob._replace(root=_place(glob.root) or "") for glob in settings.include),
        command_line=settings.command_line._replace(pages=()),
    )
    pages = sorted(text_digest(source.text) for source in resolved.engine.registry.sources.values())
    return stated, resolved.device, resolved.limits, pages


def _place(path: str | None) -> str | None:
    """A path relative to the current folder."""
    try:
        return path and os.path.relpath(path).replace(os.sep, "/")
    except ValueError:
        return path

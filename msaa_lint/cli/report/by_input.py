"""The formats in which a report can be put together from the texts of its inputs."""

from __future__ import annotations

from msaa_lint.core.finding import Result
from msaa_lint.core.rendered import RenderedPart

from . import Options


def _json_part(result: Result, docs_url: str) -> RenderedPart:
    from .json import part

    return part(result, Options(docs_url=docs_url))


RENDERERS = {"json": _json_part}
"""What renders what an input adds to a report, by format."""

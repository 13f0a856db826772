"""The syntax of files, kept between runs."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING

from .serialized import dumps, loads

if TYPE_CHECKING:
    from msaa_lint.core.cache import Cache
    from msaa_lint.input.code.c.macros import Macros
    from msaa_lint.input.code.parsing import Code
    from msaa_lint.input.code.programs import FileSyntax

MIN_LENGTH = 4000
"""The number of characters of a file from which on it is kept; a shorter one is read as fast."""


def kept_syntax(
    cache: Cache | None, code: Code, macros: Macros, offset: int, read: Callable[[], FileSyntax]
) -> FileSyntax:
    """Returns the syntax of a file, with an offset added to each place: as in an earlier run if its
    text and the macros that it sees are the same, or else from `read`.
    """
    if cache is None or len(code.text) < MIN_LENGTH:
        return loads(dumps(read()), offset)
    from msaa_lint.core.cache import digest

    key = digest(
        code.language.encode(),
        code.text.encode(),
        repr(sorted(macros.items())).encode("utf-8", "surrogatepass"),
    )
    data = cache.read("syntax", key)
    if data is not None:
        with suppress(ValueError, RecursionError):
            return loads(data, offset)
    syntax = dumps(read())
    cache.write("syntax", key, syntax)
    return loads(syntax, offset)

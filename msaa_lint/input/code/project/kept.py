"""What programs create, kept between runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from msaa_lint.core.cache import digest

from .serialized import dumps, loads_reads

if TYPE_CHECKING:
    from msaa_lint.core.cache import Cache
    from msaa_lint.input.code.parsing import Read

    from .reading import ProgramFile

MIN_LENGTH = 4000
"""The number of characters of a program from which on it is kept; a shorter one is read as fast."""


def kept_reads(
    cache: Cache | None,
    files: Sequence[ProgramFile],
    headers: Sequence[bool],
    read: Callable[[], list[Read]],
) -> list[Read]:
    """Returns what a program creates: as in an earlier run if its files are the same, or else from
    `read`.
    """
    if cache is None or sum(len(file.source.text) for file in files) < MIN_LENGTH:
        return read()
    parts = []
    for file, header in zip(files, headers, strict=True):
        parts += [
            f"{file.language} {header} {list(file.includes)} {file.definitions}".encode(
                "utf-8", "surrogatepass"
            ),
            file.source.text.encode("utf-8", "surrogatepass"),
        ]
    key = digest(*parts)
    data = cache.read("program", key)
    if data is not None:
        with suppress(ValueError, RecursionError):
            return loads_reads(data)
    reads = read()
    with suppress(RecursionError):
        cache.write("program", key, dumps(reads))
    return reads

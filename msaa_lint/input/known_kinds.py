"""What the files of folders are, kept between runs: to find out, each file has to be opened, which
takes longer than everything else in a run from the cache.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, Any, cast

from msaa_lint.core.serialized import dumps, loads
from msaa_lint.core.text.files import file_state, is_settled

if TYPE_CHECKING:
    from msaa_lint.core.cache import Cache


class KnownKinds:
    """What the files of a search are, folder by folder. `cache` opens the cache when it is
    needed.
    """

    def __init__(self, cache: Callable[[], Cache | None]) -> None:
        self._open = cache
        self._start = time.time_ns()
        self._folder = ""
        self._known: dict[str, Any] = {}
        self._used: dict[str, Any] = {}

    def of(self, path: str, find: Callable[[str], str]) -> str:
        """What a file is according to `find`, which was asked in an earlier run if the file has not
        been written since. Raises OSError.
        """
        if os.name != "posix":
            return find(path)
        folder, name = os.path.split(os.path.abspath(path))
        if folder != self._folder:
            self._enter(folder)
        key, state = f"{find.__name__} {name}", file_state(os.lstat(path))
        known = self._known.get(key)
        kind: str = known[0] if known is not None and known[1:] == state else find(path)
        if is_settled(state, self._start):
            self._used[key] = [kind, *state]
        return kind

    def close(self) -> None:
        """Keeps what the files of the last folder are."""
        self._enter("")

    def _enter(self, folder: str) -> None:
        if self._used != self._known and (cache := self._open()) is not None:
            cache.write("kinds", self._folder, dumps(self._used))
        data = (
            cache.read("kinds", folder) if folder and (cache := self._open()) is not None else None
        )
        self._folder, self._known, self._used = folder, {}, {}
        with suppress(ValueError):
            self._known = cast(dict[str, Any], loads(data, {})) if data is not None else {}

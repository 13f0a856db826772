"""What a worker of a cluster imports to do tasks."""

from __future__ import annotations

import pickle
import threading
import time
from collections.abc import Callable
from typing import Any

from msaa_lint.core.garbage import collect_garbage, not_collecting

from .backend import Failure, Work, attempt

_LOCK = threading.Lock()
"""Tasks of one process take turns: `work` may not be safe to do in several threads, which Dask's
workers have unless told otherwise.
"""

_loaded: tuple[str, Work[Any, Any]] | None = None
"""The last work with the name of its run."""


def perform(run: str, load: Callable[[], bytes], task: bytes) -> bytes | str:
    """The pickled result of a pickled task, with the seconds that it took; a string says why this
    worker can do none. `load` returns the pickled work, and is called once per run.
    """
    global _loaded
    with _LOCK:
        if _loaded is None or _loaded[0] != run:
            # The work of an earlier run may be large.
            _loaded = None
            try:
                _loaded = run, pickle.loads(load())
            except Exception as error:
                return f"cannot load what it should do: {type(error).__name__}: {error}"
        work = _loaded[1]
        began = time.perf_counter()
        with not_collecting():
            result = attempt(lambda data: work(pickle.loads(data)), task)
            collect_garbage()
        seconds = time.perf_counter() - began
    pickled = attempt(pickle.dumps, (result, seconds))
    return pickle.dumps((pickled, seconds)) if isinstance(pickled, Failure) else pickled

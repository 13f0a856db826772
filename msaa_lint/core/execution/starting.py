"""What holds while processes start."""

from __future__ import annotations

import contextlib
import os
import signal
from collections.abc import Iterator

from msaa_lint.core.extras import pip_install

from .backend import Unusable


def missing_package(error: ImportError) -> Unusable:
    """What to say of a package that a backend needs."""
    package = (error.name or "").partition(".")[0]
    return Unusable(f"{package} is not installed: run `{pip_install(package)}`")


def outside_the_working_folder() -> contextlib.AbstractContextManager[None]:
    """While workers start: Ray's import modules from the working folder."""
    return contextlib.chdir(os.sep)


@contextlib.contextmanager
def interrupts_held() -> Iterator[None]:
    """Holds interrupts back while processes start, which inherit that: an interrupt of the terminal
    is for this process, which ends them.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)

"""Interrupts that are not lost: Ctrl-C and the signals that end the process raise exceptions, which some code cannot pass on."""

import _thread
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

DELAY = 0.01
"""Seconds after which a deferred signal is sent again."""

_held = 0


def install() -> None:
    """Makes SIGINT raise KeyboardInterrupt wherever that is not lost; no change if it is ignored, or handled otherwise."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _interrupt)


@contextmanager
def held() -> Iterator[None]:
    """Holds signals back, for C++ code that calls Python and ends the process on an exception."""
    global _held
    _held += 1
    try:
        yield
    finally:
        _held -= 1


def deferred(number: int, frame: FrameType | None) -> bool:
    """Whether an exception that the handler of a signal raises would be lost; the signal is then sent again after DELAY."""
    if not _held and not _is_lost(frame):
        return False
    # Handlers of signals run in the main thread.
    _thread.start_new_thread(_send, (number, _thread.get_ident()))
    return True


def _interrupt(number: int, frame: FrameType | None) -> None:
    if not deferred(number, frame):
        raise KeyboardInterrupt


def _is_lost(frame: FrameType | None) -> bool:
    while frame is not None:
        # Imports release their locks in a callback of a weak reference, where Python prints and ignores exceptions.
        if frame.f_code.co_name == "cb" and frame.f_code.co_filename == "<frozen importlib._bootstrap>":
            return True
        frame = frame.f_back
    return False


def _send(number: int, main: int) -> None:
    time.sleep(DELAY)
    if hasattr(signal, "pthread_kill"):
        signal.pthread_kill(main, number)
    else:
        signal.raise_signal(number)

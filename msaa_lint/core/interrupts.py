"""Interrupts that are not lost: Ctrl-C and the signals that end the process raise exceptions, which
some code cannot pass on.
"""

import _thread
import signal
import time
from types import FrameType

DELAY = 0.01
"""Seconds after which a deferred signal is sent again."""


def install() -> None:
    """Makes SIGINT raise KeyboardInterrupt wherever that is not lost; no change if it is ignored,
    or handled otherwise.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _interrupt)


class _Held:
    """Holds signals back around C++ code that calls Python, and that ends the process or fails if
    Python raises an exception.
    """

    def __init__(self) -> None:
        # A list, as threads may change it at the same time.
        self.by: list[None] = []

    def __enter__(self) -> None:
        self.by.append(None)

    def __exit__(self, *_: object) -> None:
        self.by.pop()


HELD = _Held()


def deferred(number: int, frame: FrameType | None) -> bool:
    """Whether an exception that the handler of a signal raises would be lost; the signal is then
    sent again after DELAY.
    """
    if not HELD.by and not _is_lost(frame):
        return False
    # Handlers of signals run in the main thread.
    _thread.start_new_thread(_send, (number, _thread.get_ident()))
    return True


def _interrupt(number: int, frame: FrameType | None) -> None:
    if not deferred(number, frame):
        raise KeyboardInterrupt


def _is_lost(frame: FrameType | None) -> bool:
    while frame is not None:
        # Imports release their locks in a callback of a weak reference, where Python prints and
        # ignores exceptions.
        if (
            frame.f_code.co_name == "cb"
            and frame.f_code.co_filename == "<frozen importlib._bootstrap>"
        ):
            return True
        frame = frame.f_back
    return False


def _send(number: int, main: int) -> None:
    time.sleep(DELAY)
    if hasattr(signal, "pthread_kill"):
        signal.pthread_kill(main, number)
    else:
        signal.raise_signal(number)

"""The end of a child process with its parent."""

import os
import signal
import sys

_PR_SET_PDEATHSIG = 1


def end_with_parent(parent: int) -> None:
    """Lets the system kill this process when `parent`, which started it, ends, whatever it is doing
    then. Only on Linux.
    """
    if sys.platform != "linux":
        return
    import ctypes

    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        # It has already ended.
        os._exit(1)

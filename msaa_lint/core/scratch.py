"""A folder for temporary files. What a killed process left is removed when the next one starts."""

from __future__ import annotations

import os
import shutil
import stat
import tempfile
import time
from contextlib import suppress

try:
    import fcntl
except ImportError:
    # Windows: what a killed process leaves stays.
    fcntl = None  # type: ignore[assignment]

PREFIX = "msaa-lint-scratch-"

_LOCK = "lock"
"""A file that the owner of a folder holds a lock on. The system releases it however the owner
ends.
"""

_UNLOCKED_SECONDS = 3600.0
"""The age of a folder without a lock file, from which on its owner is assumed to have ended between
creating both.
"""


class ScratchFolder:
    """A new folder that only this user can read. The creator must remove it."""

    def __init__(self) -> None:
        remove_abandoned()
        self.path = tempfile.mkdtemp(prefix=PREFIX)
        self._lock = -1
        if fcntl is not None:
            # Under its final name, another process could lock it first.
            unlocked = os.path.join(self.path, f".{_LOCK}")
            self._lock = os.open(unlocked, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600)
            fcntl.flock(self._lock, fcntl.LOCK_EX)
            os.rename(unlocked, os.path.join(self.path, _LOCK))

    def remove(self) -> None:
        """Removes the folder with everything in it."""
        shutil.rmtree(self.path, ignore_errors=True)
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1


def remove_abandoned() -> None:
    """Removes the folders of this user whose owners have ended. Links are not followed, and folders
    of other users are left alone.
    """
    if fcntl is None:
        return
    with suppress(OSError), os.scandir(tempfile.gettempdir()) as entries:
        for entry in entries:
            if entry.name.startswith(PREFIX):
                with suppress(OSError):
                    _remove_if_abandoned(entry.path)


def _remove_if_abandoned(path: str) -> None:
    status = os.lstat(path)
    if not stat.S_ISDIR(status.st_mode) or status.st_uid != os.getuid():
        return
    try:
        lock = os.open(
            os.path.join(path, _LOCK), os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
        )
    except FileNotFoundError:
        if time.time() - status.st_mtime > _UNLOCKED_SECONDS:
            shutil.rmtree(path, ignore_errors=True)
        return
    try:
        # BlockingIOError while the owner runs.
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        shutil.rmtree(path, ignore_errors=True)
    finally:
        os.close(lock)

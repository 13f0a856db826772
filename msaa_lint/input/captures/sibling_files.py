"""Reads files that a capture names, but only in its own folder or below."""

from __future__ import annotations

import os
import stat

MAX_FILE = 16 << 20
"""Maximum size of a file in bytes; larger ones are skipped."""

MAX_PATH = 4096


class Folder:
    """The folder of a capture; a stream without a name has none."""

    def __init__(self, name: str | None) -> None:
        self.path = os.path.realpath(os.path.dirname(os.path.abspath(name))) if name else None

    def read(self, path: str) -> bytes | None:
        """The contents of a regular file at a relative path; None if it is outside the folder, unreadable, or larger than 16 MiB."""
        if self.path is None or not 0 < len(path) <= MAX_PATH:
            return None
        try:
            # A converter on Windows writes backslashes.
            target = os.path.realpath(os.path.join(self.path, path.replace("\\", "/")), strict=True)
            if os.path.commonpath((self.path, target)) != self.path:
                return None
            status = os.stat(target)
            if not stat.S_ISREG(status.st_mode) or status.st_size > MAX_FILE:
                return None
            with open(target, "rb") as file:
                content = file.read(MAX_FILE + 1)
        except (OSError, ValueError):
            return None
        return content if len(content) <= MAX_FILE else None

"""Files beside a capture: what it names in its own folder or below, never what lies elsewhere."""

from __future__ import annotations

import os
import stat

MAX_FILE = 16 << 20
"""Bytes of a shader module; larger ones are left out."""

MAX_PATH = 4096


class Folder:
    """The folder that a capture lies in; of a stream without a name there is none."""

    def __init__(self, name: str | None) -> None:
        self.path = os.path.realpath(os.path.dirname(os.path.abspath(name))) if name else None

    def read(self, path: str) -> bytes | None:
        """The bytes of a file by its path from here; None where it is not here, is no file, cannot be read, or is larger than 16 MiB."""
        if self.path is None or not 0 < len(path) <= MAX_PATH:
            return None
        try:
            # A converter on Windows parts folders by backslashes.
            found = os.path.realpath(os.path.join(self.path, path.replace("\\", "/")), strict=True)
            if os.path.commonpath((self.path, found)) != self.path:
                return None
            known = os.stat(found)
            if not stat.S_ISREG(known.st_mode) or known.st_size > MAX_FILE:
                return None
            with open(found, "rb") as file:
                text = file.read(MAX_FILE + 1)
        except (OSError, ValueError):
            return None
        return text if len(text) <= MAX_FILE else None

"""Results that are kept between runs, in the cache folder of the user. Deleting it loses nothing but time.

An entry is named by what it was made from. It is written under another name first, so that processes can use the folder at the same time,
and an entry that is incomplete or damaged is like none. Nothing is read that another user could have written.
"""

from __future__ import annotations

import os
import stat
import sys
import time
from contextlib import suppress
from hashlib import blake2b

MAX_BYTES = 256 << 20
"""The size of all entries together, from which on the oldest ones are removed."""

KEPT_SHARE = 0.75
"""The share of `MAX_BYTES` that is left then."""

_FRESH_SECONDS = 86_400.0
"""How long an entry that is used counts as used without being marked again."""

_DIGEST_BYTES = 16


def digest(*parts: bytes) -> str:
    """A name for what consists of these parts."""
    hasher = blake2b(digest_size=_DIGEST_BYTES)
    for part in parts:
        hasher.update(len(part).to_bytes(8, "little"))
        hasher.update(part)
    return hasher.hexdigest()


def text_digest(text: str) -> str:
    """A name for a text, which need not be valid Unicode."""
    return digest(text.encode("utf-8", "surrogatepass"))


class Cache:
    """The entries in one folder. `version` is part of the name of each: entries of other versions are not used."""

    def __init__(self, folder: str, version: str) -> None:
        self.folder = folder
        self._version = digest(version.encode()).encode()
        self._written = False

    def read(self, kind: str, name: str) -> bytes | None:
        """The entry of a kind and name; None if there is none that can be used."""
        path = self._path(kind, name)
        try:
            with open(os.open(path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)), "rb") as file:
                status = os.fstat(file.fileno())
                if not _is_private(status) or not stat.S_ISREG(status.st_mode):
                    return None
                data = file.read()
            if time.time() - status.st_mtime > _FRESH_SECONDS:
                os.utime(path)
        except OSError:
            return None
        check, content = data[:_DIGEST_BYTES], data[_DIGEST_BYTES:]
        return content if check == blake2b(content, digest_size=_DIGEST_BYTES).digest() else None

    def write(self, kind: str, name: str, content: bytes) -> None:
        """Keeps an entry. Without room or permission, nothing is kept."""
        with suppress(OSError):
            os.makedirs(self.folder, mode=0o700, exist_ok=True)
            if _is_private(os.lstat(self.folder)):
                path = self._path(kind, name)
                unfinished = f"{path}-{os.getpid()}"
                with open(os.open(unfinished, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o600), "wb") as file:
                    file.write(blake2b(content, digest_size=_DIGEST_BYTES).digest() + content)
                os.replace(unfinished, path)
                self._written = True

    def close(self) -> None:
        """Removes the entries that were not used for the longest time, if there are too many."""
        if not self._written:
            return
        with suppress(OSError), os.scandir(self.folder) as scan:
            entries = [(status.st_mtime, entry.name, status.st_size) for entry in scan if (status := entry.stat(follow_symlinks=False))]
            total = sum(size for _, _, size in entries)
            if total <= MAX_BYTES:
                return
            for _, name, size in sorted(entries):
                with suppress(OSError):
                    os.unlink(os.path.join(self.folder, name))
                total -= size
                if total <= MAX_BYTES * KEPT_SHARE:
                    return

    def _path(self, kind: str, name: str) -> str:
        return os.path.join(self.folder, f"{kind}-{digest(self._version, name.encode())}")


def user_cache(version: str) -> Cache | None:
    """The user's cache; None if there is no folder for it that is the user's own."""
    base = _base()
    if base is None or not os.path.isabs(base):
        return None
    folder = os.path.join(base, "msaa-lint")
    try:
        status = os.lstat(folder)
    except OSError:
        return Cache(folder, version)
    return Cache(folder, version) if stat.S_ISDIR(status.st_mode) and _is_private(status) else None


def _base() -> str | None:
    """The folder for the caches of programs, as the system defines it."""
    stated = os.environ.get("XDG_CACHE_HOME")
    if stated:
        return stated
    if sys.platform == "win32":
        return os.environ.get("LOCALAPPDATA")
    home = os.path.expanduser("~")
    if not os.path.isabs(home):
        return None
    return os.path.join(home, "Library", "Caches") if sys.platform == "darwin" else os.path.join(home, ".cache")


def _is_private(status: os.stat_result) -> bool:
    """Whether only this user could have written a file or folder."""
    return os.name != "posix" or (status.st_uid == os.getuid() and not status.st_mode & (stat.S_IWGRP | stat.S_IWOTH))

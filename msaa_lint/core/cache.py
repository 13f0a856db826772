"""Results that are kept between runs, in a database in the cache folder of the user. Deleting it
loses nothing but time.

An entry is named by what it was made from. Processes can use the database at the same time; one
that is damaged is begun anew, and an entry that is damaged is like none. Nothing is read that
another user could have written.
"""

from __future__ import annotations

import os
import stat
import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from hashlib import blake2b
from importlib.util import find_spec
from itertools import accumulate
from operator import sub
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sqlite3 import Connection

FILE = "cache-1.sqlite"
"""The name of the database in the folder; one with other columns has another."""

MAX_BYTES = 256 << 20
"""The size of all entries together, from which on the oldest ones are removed."""

KEPT_SHARE = 0.75
"""The share of `MAX_BYTES` that is left then."""

MAX_UNWRITTEN = 1 << 20
"""The number of bytes of entries that wait to be written together."""

MAX_NAMES = 500
"""The number of entries that are looked up together: more than SQLite's oldest versions take."""

LEVEL = 1
"""The level of compression, which is among the fastest."""

WAIT_SECONDS = 2.0
"""How long to wait for other processes that write."""

_DAY = 86_400
_DIGEST_BYTES = 16
_NUMBER_BYTES = 8


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
    """The entries in the database of one folder. `version` is part of the name of each: entries of
    other versions are not used. `notes` are lines for the user.
    """

    def __init__(self, folder: str, version: str) -> None:
        self.folder = folder
        self.notes: list[str] = []
        self._version = digest(version.encode())
        self._path = os.path.join(folder, FILE)
        self._process = -1
        self._is_usable = True
        self._database: Connection | None = None
        self._inherited: list[Connection | None] = []
        """Those of the processes that this one is a copy of; closing one would affect theirs."""
        self._unwritten: dict[int, bytes] = {}
        self._length = 0
        self._used: set[int] = set()

    def read(self, kind: str, name: str) -> bytes | None:
        """The entry of a kind and name; None if there is none that can be used."""
        return self.read_all(kind, [name]).get(name)

    def read_all(self, kind: str, names: Iterable[str]) -> dict[str, bytes]:
        """The entries of a kind by name, those that there are."""
        wanted = {self._number(kind, name): name for name in names}
        found: dict[str, bytes] = {}
        numbers, today = list(wanted), int(time.time()) // _DAY
        for start in range(0, len(numbers), MAX_NAMES):
            some = numbers[start : start + MAX_NAMES]
            for number, day, data in self._rows(some):
                if data[:_DIGEST_BYTES] == _check(number, data[_DIGEST_BYTES:]):
                    found[wanted[number]] = data
                    if day != today:
                        self._used.add(number)
            found |= {
                wanted[number]: self._unwritten[number]
                for number in some
                if number in self._unwritten
            }
        if not found:
            return {}
        from .zstd import decompress

        return {name: decompress(data[_DIGEST_BYTES:]) for name, data in found.items()}

    def write(self, kind: str, name: str, content: bytes) -> None:
        """Keeps an entry. Without room or permission, nothing is kept."""
        from .zstd import compress

        self._enter()
        number, data = self._number(kind, name), compress(content, LEVEL)
        self._unwritten[number] = _check(number, data) + data
        self._length += len(data)
        if self._length > MAX_UNWRITTEN:
            self.flush()

    def flush(self) -> None:
        """Writes the entries that wait for it."""
        unwritten, used, today = self._unwritten, self._used, int(time.time()) // _DAY
        self._unwritten, self._used, self._length = {}, set(), 0
        if (unwritten or used) and (database := self._open(create=True)) is not None:
            with self._errors(), database:
                database.executemany(
                    "update entries set day = ? where number = ?",
                    ((today, number) for number in used),
                )
                rows = ((number, today, data) for number, data in unwritten.items())
                database.executemany("insert or replace into entries values (?, ?, ?)", rows)
                if unwritten:
                    _make_room(database)

    def close(self) -> None:
        """Writes the entries that wait for it; the cache can still be used."""
        self.flush()
        if self._database is not None:
            self._database.close()
        self._process = -1

    def _rows(self, numbers: list[int]) -> list[tuple[int, int, bytes]]:
        database = self._open(create=False)
        if database is not None:
            with self._errors():
                marks = ",".join("?" * len(numbers))
                return database.execute(
                    f"select number, day, data from entries where number in ({marks})", numbers
                ).fetchall()
        return []

    def _enter(self) -> None:
        """Forgets what belongs to the process that this one is a copy of."""
        if self._process != os.getpid():
            self._inherited.append(self._database)
            self._process, self._database = os.getpid(), None
            self._unwritten, self._used, self._length = {}, set(), 0

    def _open(self, create: bool) -> Connection | None:
        """The database; None if it cannot be used, or is not there and not to be created."""
        self._enter()
        if self._database is None and self._is_usable:
            from sqlite3 import connect

            with self._errors(), suppress(OSError):
                if create:
                    os.makedirs(self.folder, mode=0o700, exist_ok=True)
                    if _is_private(os.lstat(self.folder)):
                        with suppress(FileExistsError):
                            os.close(
                                os.open(self._path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
                            )
                status = os.lstat(self._path)
                if (
                    stat.S_ISREG(status.st_mode)
                    and _is_private(status)
                    and (create or status.st_size)
                ):
                    # Without a log beside it, it may be on a file system of several machines. What
                    # is written need not outlive this one.
                    database = connect(self._path, timeout=WAIT_SECONDS, check_same_thread=False)
                    database.execute("pragma synchronous = off")
                    database.execute(
                        "create table if not exists entries (number integer primary key, day "
                        "integer, data blob)"
                    )
                    self._database = database
        return self._database

    @contextmanager
    def _errors(self) -> Iterator[None]:
        """Begins a damaged database anew, and does without one that cannot be used."""
        from sqlite3 import DatabaseError, OperationalError

        try:
            yield
        except OperationalError:
            # It is locked, or there is no room, or no permission.
            self._is_usable = False
        except DatabaseError:
            self._database = None
            with suppress(OSError):
                os.unlink(self._path)
                self.notes.append(
                    f"{self._path} was damaged and is begun anew: all inputs are read"
                )
            with suppress(OSError):
                os.unlink(f"{self._path}-journal")

    def _number(self, kind: str, name: str) -> int:
        name_of_all = f"{self._version} {kind} {name}".encode("utf-8", "surrogatepass")
        return int.from_bytes(
            blake2b(name_of_all, digest_size=_NUMBER_BYTES).digest(), "big", signed=True
        )


def _check(number: int, content: bytes) -> bytes:
    """What shows that an entry is undamaged, and that of this name."""
    key = number.to_bytes(_NUMBER_BYTES, "big", signed=True)
    return blake2b(content, digest_size=_DIGEST_BYTES, key=key).digest()


def _make_room(database: Connection) -> None:
    """Removes the entries that were not used for the longest time, if there are too many."""
    pages, free, size = (
        database.execute(f"pragma {name}").fetchone()[0]
        for name in ("page_count", "freelist_count", "page_size")
    )
    total = (pages - free) * size
    if total <= MAX_BYTES:
        return
    oldest = database.execute(
        "select number, length(data) from entries order by day, number"
    ).fetchall()
    left = accumulate((length for _, length in oldest), sub, initial=total)
    removed = (
        (number,)
        for (number, _), rest in zip(oldest, left, strict=False)
        if rest > MAX_BYTES * KEPT_SHARE
    )
    database.executemany("delete from entries where number = ?", removed)


def user_cache(version: str) -> Cache | None:
    """The user's cache; None if there is no folder for it that is the user's own, or no SQLite."""
    base = _base()
    if base is None or not os.path.isabs(base) or find_spec("_sqlite3") is None:
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
    return (
        os.path.join(home, "Library", "Caches")
        if sys.platform == "darwin"
        else os.path.join(home, ".cache")
    )


def _is_private(status: os.stat_result) -> bool:
    """Whether only this user could have written a file or folder."""
    return os.name != "posix" or (
        status.st_uid == os.getuid() and not status.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
    )

"""Sequences and mappings of any length. Short ones are in memory; of longer ones all but the last
values are in a temporary file.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import count
from operator import itemgetter
from typing import TYPE_CHECKING, Any, Generic, TypeVar, overload

if TYPE_CHECKING:
    import sqlite3

T = TypeVar("T")

MAX_VALUES = 500
"""The number of values that a sequence or a mapping writes at once."""

MAX_UNWRITTEN = 4
"""How many times as many values are in memory before the first are written, unless a limit is
stated: most runs write none.
"""

MAX_READ = 16
"""The number of values of a mapping that stay in memory after they were read."""


class SpoolError(Exception):
    """The temporary file cannot be written or read; the message says why, and what to do."""


class Spool:
    """The temporary file of the values that leave memory. It has no name, so that the system
    removes it however this process ends.

    Without SQLite, all values stay in memory.
    """

    def __init__(self) -> None:
        self._names = count()

    @cached_property
    def database(self) -> sqlite3.Connection | None:
        """The database in the file, which is created when it is first used; None without SQLite."""
        try:
            import sqlite3
        except ImportError:
            return None
        # A database without a name is in a file in the folder of temporary files, and only what is
        # used of it in memory.
        database = sqlite3.connect("", isolation_level=None, check_same_thread=False)
        for setting in (
            "journal_mode = off",
            "synchronous = off",
            "temp_store = file",
            "cache_size = -1000",
        ):
            database.execute(f"pragma {setting}")
        return database

    def has_to_write(self, number: int, limit: int | None, has_written: bool) -> bool:
        """Whether so many values are too many for memory: at least `limit`, or MAX_VALUES if that
        is less; without a limit, MAX_UNWRITTEN times as many if none of them are written yet.
        """
        most = (
            min(limit, MAX_VALUES)
            if limit is not None
            else MAX_VALUES * (1 if has_written else MAX_UNWRITTEN)
        )
        return number >= most and self.database is not None

    def table(self, columns: str) -> str:
        """The name of a new table."""
        name = f"table_{next(self._names)}"
        self.execute(f"create table {name} ({columns})")
        return name

    def execute(self, statement: str, *values: object) -> sqlite3.Cursor:
        """The result of a statement. Raises SpoolError."""
        assert self.database is not None
        try:
            return self.database.execute(statement, values)
        except self.database.Error as error:
            raise _error(error) from None

    def execute_all(self, statement: str, rows: Iterable[Sequence[object]]) -> None:
        """Executes a statement for each row. Raises SpoolError."""
        assert self.database is not None
        try:
            self.database.execute("begin")
            self.database.executemany(statement, rows)
            self.database.execute("commit")
        except self.database.Error as error:
            raise _error(error) from None


def _error(error: Exception) -> SpoolError:
    return SpoolError(
        f"cannot keep results in a temporary file: {error}; set TMPDIR to a folder with more room"
    )


class SpooledList(Sequence[T]):
    """A sequence to append to. Read in order, each value is read once from the file. `limit` values
    stay in memory, or MAX_VALUES.
    """

    def __init__(self, spool: Spool, values: Iterable[T] = (), limit: int | None = None) -> None:
        self._spool = spool
        self._limit = limit
        self._table = ""
        self._written = 0
        """The number of pages in the file. They have equally many values."""
        self._size = 0
        self._last: list[T] = []
        self._read: tuple[int, list[T]] = (-1, [])
        self.extend(values)

    def append(self, value: T) -> None:
        """Adds a value. Raises SpoolError."""
        self._last.append(value)
        if self._spool.has_to_write(len(self._last), self._limit, bool(self._table)):
            if not self._table:
                self._table, self._size = (
                    self._spool.table("page integer primary key, data blob"),
                    min(self._limit or MAX_VALUES, MAX_VALUES),
                )
            pages = [
                self._last[start : start + self._size]
                for start in range(0, len(self._last), self._size)
            ]
            rows = [(self._written + number, _dumps(page)) for number, page in enumerate(pages)]
            self._spool.execute_all(f"insert into {self._table} values (?, ?)", rows)
            self._written += len(pages)
            self._last = []

    def extend(self, values: Iterable[T]) -> None:
        """Adds values. Raises SpoolError."""
        for value in values:
            self.append(value)

    def finished(self) -> Sequence[T]:
        """The sequence, as a list if it is in memory."""
        return self if self._table else self._last

    def __len__(self) -> int:
        return self._written * self._size + len(self._last)

    def __iter__(self) -> Iterator[T]:
        for page in range(self._written):
            yield from self._page(page)
        yield from self._last

    @overload
    def __getitem__(self, index: int) -> T: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[T]: ...
    def __getitem__(self, index: int | slice) -> T | Sequence[T]:
        at = range(len(self))[index]
        if isinstance(at, range):
            return [self[number] for number in at]
        page, offset = divmod(at, self._size) if self._size else (0, at)
        if page == self._written:
            return self._last[offset]
        if self._read[0] != page:
            self._read = page, self._page(page)
        return self._read[1][offset]

    def _page(self, number: int) -> list[T]:
        values: list[T] = _loads(
            self._spool.execute(
                f"select data from {self._table} where page = ?", number
            ).fetchone()[0]
        )
        return values


class SpooledDict(Mapping[str, T]):
    """A mapping from strings to values, in the order of their first addition. `limit` values stay
    in memory, or MAX_VALUES.
    """

    def __init__(self, spool: Spool, limit: int | None = None) -> None:
        self._spool = spool
        self._limit = limit
        self._table = ""
        self._last: dict[str, T] = {}
        self._read: dict[str, T] = {}

    def update(self, values: Mapping[str, T]) -> None:
        """Adds values, or replaces those of the same keys. Raises SpoolError."""
        self._last.update(values)
        if self._spool.has_to_write(len(self._last), self._limit, bool(self._table)):
            self._write()

    def pop(self, key: str) -> T:
        """Removes a value. KeyError if there is none."""
        value = self[key]
        self._last.pop(key, None)
        self._read.pop(key, None)
        if self._table:
            self._spool.execute(f"delete from {self._table} where key = ?", _stored(key))
        return value

    def finished(self) -> Mapping[str, T]:
        """The mapping, as a dict if it is in memory."""
        return self if self._table else self._last

    def __len__(self) -> int:
        if not self._table:
            return len(self._last)
        self._write()
        number: int = self._spool.execute(f"select count(*) from {self._table}").fetchone()[0]
        return number

    def __iter__(self) -> Iterator[str]:
        if self._table:
            self._write()
            for (key,) in self._spool.execute(f"select key from {self._table} order by rowid"):
                yield key.decode("utf-8", "surrogatepass")
        yield from self._last

    def __getitem__(self, key: str) -> T:
        if key in self._last:
            return self._last[key]
        if key not in self._read:
            if not self._table:
                raise KeyError(key)
            row = self._spool.execute(
                f"select data from {self._table} where key = ?", _stored(key)
            ).fetchone()
            if row is None:
                raise KeyError(key)
            if len(self._read) == MAX_READ:
                del self._read[next(iter(self._read))]
            self._read[key] = _loads(row[0])
        return self._read[key]

    def _write(self) -> None:
        if not self._table:
            self._table = self._spool.table("key blob unique, data blob")
        rows = ((_stored(key), _dumps(value)) for key, value in self._last.items())
        self._spool.execute_all(
            f"insert into {self._table} values (?, ?) on conflict (key) do update set data = "
            "excluded.data",
            rows,
        )
        self._last = {}
        self._read = {}


class SpooledSort(Generic[T]):
    """Groups of values to read in the order of their keys, and of their addition if keys are equal.
    A key is a tuple of integers, floating point numbers, and bytes.
    """

    def __init__(self, spool: Spool, width: int) -> None:
        self._spool = spool
        self._columns = [f"key_{number}" for number in range(width)]
        self._table = ""
        self._last: list[tuple[tuple[Any, ...], Sequence[T]]] = []

    def add(self, key: tuple[Any, ...], values: Sequence[T]) -> None:
        """Adds values. Raises SpoolError."""
        self._last.append((key, values))
        if self._spool.has_to_write(len(self._last), None, bool(self._table)):
            self._write()

    def __iter__(self) -> Iterator[tuple[tuple[Any, ...], Sequence[T]]]:
        if not self._table:
            yield from sorted(self._last, key=itemgetter(0))
            return
        self._write()
        for *key, data in self._spool.execute(
            f"select * from {self._table} order by {', '.join(self._columns)}, rowid"
        ):
            yield tuple(key), _loads(data)

    def _write(self) -> None:
        if not self._table:
            self._table = self._spool.table(", ".join([*self._columns, "data blob"]))
        marks = ", ".join("?" * (len(self._columns) + 1))
        self._spool.execute_all(
            f"insert into {self._table} values ({marks})",
            ((*key, _dumps(values)) for key, values in self._last),
        )
        self._last = []


def _stored(key: str) -> bytes:
    """A key as the file has it: a name of a file need not be valid Unicode."""
    return key.encode("utf-8", "surrogatepass")


def _dumps(value: object) -> bytes:
    import pickle

    return pickle.dumps(value, pickle.HIGHEST_PROTOCOL)


def _loads(data: bytes) -> Any:
    # What was written is this process's own, and nobody else can open the file.
    import pickle

    return pickle.loads(data)

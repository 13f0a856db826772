"""Tables as one SQLite database."""

from __future__ import annotations

import errno
import sqlite3
from collections.abc import Iterable, Mapping
from contextlib import closing

from msaa_lint.core import atomic_write
from msaa_lint.linter.corpus.tables import BOOLEAN, INTEGER, NUMBER, TABLES, TEXT, Row, Table

_TYPES = {TEXT: "TEXT", INTEGER: "INTEGER", NUMBER: "REAL", BOOLEAN: "INTEGER"}
"""SQLite has no type for truth: 0 and 1."""


def write(path: str, tables: Mapping[str, Iterable[Row]], version: str) -> None:
    """Writes all tables to a file. OSError if it cannot be written."""
    with atomic_write.new_path(path) as new:
        try:
            with closing(sqlite3.connect(new, isolation_level=None)) as connection:
                # The file gets its name only when it is whole: a journal would protect nothing.
                for setting in (
                    "page_size = 4096",
                    "journal_mode = OFF",
                    "synchronous = OFF",
                    "locking_mode = EXCLUSIVE",
                ):
                    connection.execute(f"PRAGMA {setting}")
                connection.execute("BEGIN")
                for table in TABLES:
                    connection.execute(_creation(table))
                    marks = ", ".join("?" * len(table.columns))
                    connection.executemany(
                        f"INSERT INTO {table.name} VALUES ({marks})", tables[table.name]
                    )
                connection.execute("COMMIT")
        except sqlite3.Error as error:
            raise OSError(errno.EIO, str(error), path) from None


def _creation(table: Table) -> str:
    columns = ", ".join(f'"{column.name}" {_TYPES[column.kind]}' for column in table.columns)
    return f"CREATE TABLE {table.name} ({columns})"

"""Files of corpora: which there are, which version of msaa-lint wrote them, and whether they are
whole.
"""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from typing import NamedTuple
from urllib.parse import quote

import pyarrow as pa
import pyarrow.parquet as pq

from msaa_lint.core.package import VERSION

from .tables import BOOLEAN, FINDINGS, RUN, SCHEMA, TABLES, Row, Table, parquet_paths
from .types import arrow_schema

_SQLITE = b"SQLite format 3\0"
_PARQUET = b"PAR1"
_ENDINGS = (".parquet", ".sqlite", ".sqlite3", ".db")


class CorpusError(Exception):
    """A file that cannot be used as a corpus, or a query that fails; its text is for the user."""


class CorpusFile(NamedTuple):
    """A file with the findings of a run. `name` is its path as text, `paths` those of the Parquet
    files of its tables; None for SQLite.
    """

    path: str
    name: str
    paths: Mapping[str, str] | None


def corpus_files(paths: Sequence[str]) -> list[CorpusFile]:
    """The corpora at paths: files, and those in folders, in order. CorpusError if one cannot be
    used, or there is none.
    """
    found = []
    for path in dict.fromkeys(paths):
        if not os.path.isdir(path):
            found.append(_file(path))
            continue
        inside = [_file(each) for each in _in_folder(path)]
        if not inside:
            raise CorpusError(
                f"{path}: no corpus in this folder; `msaa-lint check --output "
                "parquet=findings.parquet` writes one"
            )
        found += inside
    return found


def _in_folder(folder: str) -> Iterator[str]:
    """The corpora in a folder: databases, and the Parquet files beside which there is a table of
    the run.
    """
    for root, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            path = os.path.join(root, name)
            if not name.endswith(_ENDINGS) or not os.path.isfile(path):
                continue
            if (
                os.path.isfile(parquet_paths(path)[RUN.name])
                if name.endswith(".parquet")
                else _head(path) == _SQLITE
            ):
                yield path


def _file(path: str) -> CorpusFile:
    """A corpus that was checked. CorpusError if it cannot be used."""
    name = path.encode("utf-8", "backslashreplace").decode()
    head = _head(path)
    if head[:4] == _PARQUET:
        paths = parquet_paths(path)
        for table in TABLES:
            _check_parquet(paths[table.name], table, name)
        return CorpusFile(path, name, paths)
    if head == _SQLITE:
        _check_sqlite(path, name)
        return CorpusFile(path, name, None)
    raise CorpusError(
        f"{name}: not a corpus: expected a file that `msaa-lint check` wrote with `--output "
        "parquet=FILE` or `sqlite=FILE`"
    )


def _head(path: str) -> bytes:
    try:
        if not os.path.isfile(path) and os.path.exists(path):
            raise CorpusError(f"{path}: not a regular file")
        with open(path, "rb") as file:
            return file.read(len(_SQLITE))
    except (OSError, ValueError) as error:
        raise CorpusError(f"{path}: {getattr(error, 'strerror', None) or error}") from None


def _check_parquet(path: str, table: Table, name: str) -> None:
    """CorpusError unless a file has a table in this version."""
    if table is not FINDINGS and not os.path.isfile(path):
        raise CorpusError(f"{name}: the table `{table.name}` is missing: expected it in {path}")
    try:
        schema = pq.read_schema(path)
    except (pa.ArrowException, OSError) as error:
        raise CorpusError(f"{path}: {str(error).splitlines()[0]}") from None
    stated = {
        key: value.decode("utf-8", "replace") for key, value in (schema.metadata or {}).items()
    }
    if b"schema" not in stated or b"table" not in stated:
        raise CorpusError(f"{path}: a Parquet file, but not of msaa-lint")
    _check_version(path, stated[b"schema"], stated.get(b"version", ""))
    if stated[b"table"] != table.name:
        raise CorpusError(
            f"{path}: the table `{stated[b'table']}` of a corpus; name the file of its findings"
        )
    if schema.remove_metadata() != arrow_schema(table):
        raise CorpusError(f"{path}: the columns are not those of the table `{table.name}`")


def _check_sqlite(path: str, name: str) -> None:
    """CorpusError unless a database has the tables in this version."""
    with _database(path) as connection:
        tables = {
            row[0]
            for row in connection.execute(
                "SELECT name FROM sqlite_schema WHERE type = 'table' AND rootpage > 0"
            )
        }
        missing = [table.name for table in TABLES if table.name not in tables]
        if len(missing) == len(TABLES):
            raise CorpusError(f"{name}: a SQLite database, but not of msaa-lint")
        if RUN.name not in missing:
            _check_version(name, *_version(connection, name))
        if missing:
            raise CorpusError(f"{name}: the table `{missing[0]}` is missing")
        for table in TABLES:
            columns = [row[1] for row in connection.execute(f"PRAGMA table_info({table.name})")]
            if columns != [column.name for column in table.columns]:
                raise CorpusError(f"{name}: the columns are not those of the table `{table.name}`")


def _version(connection: sqlite3.Connection, name: str) -> tuple[str, str]:
    columns = {row[1] for row in connection.execute(f"PRAGMA table_info({RUN.name})")}
    row = (
        connection.execute(f"SELECT schema, version FROM {RUN.name}").fetchone()
        if {"schema", "version"} <= columns
        else None
    )
    if row is None:
        raise CorpusError(f"{name}: a SQLite database, but not of msaa-lint")
    return str(row[0]), str(row[1])


def _check_version(name: str, schema: str, version: str) -> None:
    if schema != SCHEMA:
        raise CorpusError(
            f"{name}: written by msaa-lint {version} as `{schema}`; msaa-lint {VERSION} reads "
            f"`{SCHEMA}`: check the inputs again"
        )


def sqlite_rows(path: str, table: Table) -> Iterator[Row]:
    """The rows of a table of a database. CorpusError if it cannot be read."""
    truths = [number for number, column in enumerate(table.columns) if column.kind == BOOLEAN]
    names = ", ".join(f'"{column.name}"' for column in table.columns)
    with _database(path) as connection:
        for row in connection.execute(f"SELECT {names} FROM {table.name}"):
            values = list(row)
            for number in truths:
                values[number] = None if values[number] is None else bool(values[number])
            yield tuple(values)


@contextmanager
def _database(path: str) -> Iterator[sqlite3.Connection]:
    """A database that is only read, and of which nothing is executed. CorpusError if that fails."""
    try:
        with closing(
            sqlite3.connect(f"file:{quote(os.fsencode(path))}?mode=ro&immutable=1", uri=True)
        ) as connection:
            connection.execute("PRAGMA trusted_schema = OFF")
            yield connection
    except sqlite3.Error as error:
        raise CorpusError(f"{path}: {error}") from None

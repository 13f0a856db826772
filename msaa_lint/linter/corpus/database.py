"""Opens files of corpora as tables of one DuckDB database that reaches nothing else, so that SQL of
a stranger can only read them.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import takewhile
from typing import Any, NamedTuple

import duckdb
import pyarrow as pa
import pyarrow.dataset
import pyarrow.fs

from .files import CorpusError, CorpusFile, sqlite_rows
from .tables import TABLES, Table, batches
from .types import arrow_schema

SINCE = "since"
"""The schema of the tables of an earlier run."""

_TABLE_OF_FILE = re.compile(rf"'_(main|{SINCE})_([0-9]+)_\w+'")

MAX_MESSAGE = 400
"""Characters of a message of DuckDB, which may list all columns."""

_BATCH = 1 << 16
"""Rows that are copied at once."""

_SETTINGS = (
    "temp_directory = ''",
    "autoinstall_known_extensions = false",
    "autoload_known_extensions = false",
    "python_enable_replacements = false",
    "enable_external_access = false",
    "lock_configuration = true",
)
"""Nothing is read or written but the tables, not even a temporary file, and SQL cannot change
that.
"""


class Rows(NamedTuple):
    """The result of a query: the names of its columns, whether each is numeric, and its rows."""

    columns: list[str]
    numeric: list[bool]
    rows: Iterator[tuple[Any, ...]]


class Database:
    """The tables of corpora: of all `files` together, and in the schema `since` those of an earlier
    run, if there are any.

    Each table has the column `corpus` before its own: the file that the row is of, as it was named.
    Use it as a context manager.
    """

    def __init__(self, files: Sequence[CorpusFile], since: Sequence[CorpusFile] = ()) -> None:
        self.files = files
        self.since = since
        self._connection = duckdb.connect(":memory:")
        try:
            self._load("main", files)
            if since:
                self._connection.execute(f"CREATE SCHEMA {SINCE}")
                self._load(SINCE, since)
            for setting in _SETTINGS:
                self._connection.execute(f"SET {setting}")
        except BaseException:
            self._connection.close()
            raise

    def __enter__(self) -> Database:
        return self

    def __exit__(self, *_: object) -> None:
        self._connection.close()

    def rows(self, sql: str, values: Sequence[object] = ()) -> list[tuple[Any, ...]]:
        """All rows of a query of our own. CorpusError if a file cannot be read."""
        try:
            with _errors(""):
                return self._connection.execute(sql, values).fetchall()
        except CorpusError as error:
            # Parquet is read only now: DuckDB names the table that a file has become.
            found = _TABLE_OF_FILE.search(str(error))
            if found is None:
                raise
            file = (self.files if found[1] == "main" else self.since)[int(found[2])]
            raise CorpusError(f"{file.name}: {str(error).rpartition(' failed: ')[2]}") from None

    def query(self, sql: str) -> Rows:
        """The result of a query of the user's. CorpusError if it is not one SELECT, or fails."""
        with _errors("--sql"):
            statements = self._connection.extract_statements(sql)
            if len(statements) != 1 or statements[0].type != duckdb.StatementType.SELECT:
                raise CorpusError("`--sql` must be one SELECT: tables are only read")
            result = self._connection.execute(statements[0])
            numeric = [_is_numeric(str(column[1])) for column in result.description]
            return Rows([column[0] for column in result.description], numeric, _fetch(result))

    def _load(self, schema: str, files: Sequence[CorpusFile]) -> None:
        """Creates the tables of files in a schema."""
        for table in TABLES:
            parts = []
            for number, file in enumerate(files):
                name = f"_{schema}_{number}_{table.name}"  # as `_TABLE_OF_FILE` reads it
                with _errors(file.name):
                    self._load_table(name, table, file)
                parts.append(f"SELECT {_literal(file.name)} AS corpus, * FROM {name}")
            self._connection.execute(
                f"CREATE VIEW {schema}.{table.name} AS {' UNION ALL '.join(parts)}"
            )

    def _load_table(self, name: str, table: Table, file: CorpusFile) -> None:
        """Makes a table of a file known by a name: Parquet is read when it is queried, SQLite is
        copied.
        """
        schema = arrow_schema(table)
        if file.paths is not None:
            # A dataset is read by its path alone: in one of DuckDB's, `*` and `[` would be
            # patterns.
            path = os.path.abspath(file.paths[table.name])
            data = pyarrow.dataset.dataset(
                path, schema, format="parquet", filesystem=pyarrow.fs.LocalFileSystem()
            )
            self._connection.register(name, data)
            return
        self._connection.register("_empty", schema.empty_table())
        self._connection.execute(f"CREATE TABLE {name} AS SELECT * FROM _empty")
        for batch in batches(sqlite_rows(file.path, table), _BATCH):
            arrays = [
                pa.array(values, field.type)
                for values, field in zip(zip(*batch, strict=True), schema, strict=True)
            ]
            self._connection.register("_batch", pa.Table.from_arrays(arrays, schema=schema))
            self._connection.execute(f"INSERT INTO {name} SELECT * FROM _batch")


@contextmanager
def _errors(subject: str) -> Iterator[None]:
    """CorpusError for what DuckDB and Arrow raise, on one line."""
    try:
        yield
    except (duckdb.Error, pa.ArrowException, OSError, OverflowError) as error:
        # The lines before the quoted query say what is wrong, and what may have been meant.
        lines = takewhile(lambda line: not line.startswith("LINE "), str(error).splitlines())
        message = " ".join(" ".join(lines).split())[:MAX_MESSAGE] or type(error).__name__
        raise CorpusError(f"{subject}: {message}" if subject else message) from None


def _fetch(result: duckdb.DuckDBPyConnection) -> Iterator[tuple[Any, ...]]:
    while True:
        with _errors("--sql"):
            rows = result.fetchmany(1000)
        if not rows:
            return
        yield from rows


def _is_numeric(kind: str) -> bool:
    return (
        kind.startswith(("DECIMAL", "UTINYINT", "USMALLINT", "UINTEGER", "UBIGINT", "UHUGEINT"))
        or kind in _NUMERIC
    )


_NUMERIC = {"TINYINT", "SMALLINT", "INTEGER", "BIGINT", "HUGEINT", "FLOAT", "DOUBLE", "NUMBER"}


def _literal(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"

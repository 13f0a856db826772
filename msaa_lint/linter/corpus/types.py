"""The types of the columns in Arrow and in SQLite."""

from __future__ import annotations

import pyarrow as pa

from .tables import BOOLEAN, INTEGER, NUMBER, TEXT, Table

_ARROW = {TEXT: pa.string(), INTEGER: pa.int64(), NUMBER: pa.float64(), BOOLEAN: pa.bool_()}


def arrow_schema(table: Table) -> pa.Schema:
    """The columns of a table as Parquet has them."""
    return pa.schema([pa.field(column.name, _ARROW[column.kind]) for column in table.columns])

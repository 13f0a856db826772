"""Tables as Parquet files, one for each."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import ExitStack

import pyarrow as pa
import pyarrow.parquet as pq

from msaa_lint.core import atomic_write
from msaa_lint.linter.corpus.tables import SCHEMA, TABLES, Row, batches, parquet_paths
from msaa_lint.linter.corpus.types import arrow_schema

_GROUP = 1 << 14
"""Rows of a row group, which are in memory together."""


def write(path: str, tables: Mapping[str, Iterable[Row]], version: str) -> None:
    """Writes the table of findings to a file, and the others beside it. All are written before the
    first gets its name, and that of findings gets it last. OSError if one cannot be written.
    """
    paths = parquet_paths(path)
    with ExitStack() as stack:
        files = {
            table.name: stack.enter_context(atomic_write.new_binary(paths[table.name]))
            for table in TABLES
        }
        for table in TABLES:
            schema = arrow_schema(table).with_metadata(
                {"schema": SCHEMA, "version": version, "table": table.name}
            )
            with pq.ParquetWriter(files[table.name], schema, compression="zstd") as writer:
                for batch in batches(tables[table.name], _GROUP):
                    columns = zip(*batch, strict=True)
                    arrays = [
                        pa.array(values, field.type)
                        for values, field in zip(columns, schema, strict=True)
                    ]
                    writer.write_batch(pa.RecordBatch.from_arrays(arrays, schema=schema))

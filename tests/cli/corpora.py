"""Inputs of a small corpus, and what is in the files that a run writes of them."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

from msaa_lint.linter.corpus.tables import TABLES, parquet_paths
from tests.descriptions import CLEAN, STORED
from tests.paths import ROOT

SIZE = "frame: {width: 1920, height: 1080, fps: 60}\n"

FRAMES = f"""\
{SIZE}device: mali-g76
{STORED}---
{SIZE}{STORED.replace("color_ms", "glow_ms").replace("forward:", "glow:")}"""
"""Two frames with the same mistake."""

IGNORED = STORED.replace(
    "storeOp: STORE, initialLayout",
    "storeOp: STORE, # msaa-lint: ignore[multisampled-attachment-stored] read back\n initialLayout",
    1,
)
"""A frame whose mistake a comment suppresses."""

Rows = list[tuple[Any, ...]]


def write_inputs(folder: Path) -> None:
    """Two frames, a capture, a frame without findings, one with a suppressed one, and one that
    cannot be read.
    """
    folder.mkdir(exist_ok=True)
    (folder / "frames.msaa.yaml").write_text(FRAMES)
    (folder / "capture.jsonl").write_bytes((ROOT / "examples/capture/forward.jsonl").read_bytes())
    (folder / "clean.msaa.yaml").write_text(CLEAN)
    (folder / "ignored.msaa.yaml").write_text(IGNORED)
    (folder / "wrong.msaa.yaml").write_text("images: [\n")


def sqlite_tables(path: Path) -> dict[str, Rows]:
    """The rows of each table of a database."""
    with closing(sqlite3.connect(path)) as connection:
        return {
            table.name: connection.execute(f"SELECT * FROM {table.name}").fetchall()
            for table in TABLES
        }


def parquet_tables(path: Path) -> dict[str, Rows]:
    """The rows of each table of Parquet files."""
    import pyarrow.parquet as pq

    found = {}
    for name, file in parquet_paths(str(path)).items():
        columns = pq.read_table(file).to_pydict()
        found[name] = list(zip(*columns.values(), strict=True))
    return found

"""The tables of a corpus and their columns: what `--output parquet` and `sqlite` write, `corpus`
reads, and docs/rows.md says.
"""

import os
from collections.abc import Iterable, Iterator
from typing import NamedTuple

SCHEMA = "msaa-lint/rows-v1"
"""The version of the tables, which every row of `run` names."""

TEXT, INTEGER, NUMBER, BOOLEAN = "text", "integer", "number", "boolean"

Value = str | int | float | bool | None
Row = tuple[Value, ...]
"""A value for each column of a table."""


class Column(NamedTuple):
    """A column: its name, the kind of its values, their unit, and what they mean. Every value may
    be null.
    """

    name: str
    kind: str
    unit: str
    meaning: str


class Table(NamedTuple):
    """A table: its name, what a row is, and its columns."""

    name: str
    meaning: str
    columns: tuple[Column, ...]


_INPUT = Column("input", TEXT, "", "The input, as `check` names it.")
_FRAME = Column(
    "frame",
    INTEGER,
    "",
    "The index of the frame in the input, from 0: of its document, or of its kind of frame in a "
    "capture.",
)

FINDINGS = Table(
    "findings",
    "One row for each finding, those that are suppressed included, in the order of inputs and of "
    "places in them.",
    (
        Column(
            "input",
            TEXT,
            "",
            "The file that the finding is in: an input, or a file of its program, its "
            "configuration, or a rule page.",
        ),
        _FRAME._replace(
            meaning=f"{_FRAME.meaning} Of several with the same mistake, the first. Null for a "
            "finding about a file."
        ),
        Column(
            "pass",
            TEXT,
            "",
            "The name of the pass that the subject belongs to. Null without one, and if programs "
            "that share the file differ in it.",
        ),
        Column("rule", TEXT, "", "The name of the rule."),
        Column("code", TEXT, "", "The code of the rule: MSAA201."),
        Column("severity", TEXT, "", "`note`, `warning`, or `error`."),
        Column("confidence", TEXT, "", "`low`, `medium`, or `high`."),
        Column(
            "read_mb_per_s",
            NUMBER,
            "MB/s",
            "The price: what the fix saves of reads. Null without a price.",
        ),
        Column("write_mb_per_s", NUMBER, "MB/s", "What the fix saves of writes."),
        Column("memory_mib", NUMBER, "MiB", "What the fix saves of memory."),
        Column("milliwatts", NUMBER, "mW", "What the fix saves of power."),
        Column(
            "is_saving",
            BOOLEAN,
            "",
            "Whether the price counts: there is one, and its fix can be made and is not a choice.",
        ),
        Column(
            "line", INTEGER, "", "The line of the place, from 1. Null for an input without text."
        ),
        Column("column_number", INTEGER, "code points", "The column of the place, from 1."),
        Column(
            "call",
            TEXT,
            "",
            "The captured call that the finding is about. Null if the input is not a capture.",
        ),
        Column(
            "call_number",
            INTEGER,
            "",
            "The index of that call in the capture. Null if the capture does not number calls.",
        ),
        Column(
            "call_frames",
            INTEGER,
            "frames",
            "The number of frames of the capture that use what the call creates.",
        ),
        Column(
            "subject",
            TEXT,
            "",
            "The structural path of what the finding is about: "
            "`renderPasses.forward.attachments.color`.",
        ),
        Column("message", TEXT, "", "The message."),
        Column(
            "suppressed",
            TEXT,
            "",
            "How the finding is suppressed: `inline` or `baseline`. Null if it is not.",
        ),
        Column("reason", TEXT, "", "The reason that the suppression comment states."),
        Column(
            "fingerprint",
            TEXT,
            "",
            "An identifier of the finding in its input that stays when lines move.",
        ),
    ),
)

PASSES = Table(
    "passes",
    "One row for each pass of a frame, and for each command outside of passes that moves an image, "
    "in the order of inputs and frames. "
    "A document with errors has none. The figures are those of `msaa-lint cost`.",
    (
        _INPUT,
        _FRAME,
        Column(
            "pass",
            TEXT,
            "",
            "The name of the pass; of a command, what it is and the images that it moves.",
        ),
        Column("path", TEXT, "", "The structural path of the pass: `renderPasses.forward`."),
        Column("kind", TEXT, "", "`renderPass`, `rendering` (dynamic), or `command`."),
        Column(
            "width", INTEGER, "pixels", "The width of what it renders to. Null if it is not stated."
        ),
        Column("height", INTEGER, "pixels", "The height."),
        Column(
            "times", INTEGER, "", "How often a frame begins it; the traffic is that of all times."
        ),
        Column(
            "samples",
            INTEGER,
            "",
            "The most samples that an attachment has, or that a command moves for a pixel.",
        ),
        Column("read_mb_per_s", NUMBER, "MB/s", "What it reads from memory."),
        Column("write_mb_per_s", NUMBER, "MB/s", "What it writes to memory."),
        Column(
            "memory_mib", NUMBER, "MiB", "The memory of its images, which other passes may use too."
        ),
        Column("milliwatts", NUMBER, "mW", "The power that its traffic takes."),
        Column(
            "unknown",
            TEXT,
            "",
            "What could not be counted: the figures are then lower bounds. Null if everything was.",
        ),
    ),
)

INPUTS = Table(
    "inputs",
    "One row for each input, in their order.",
    (
        _INPUT,
        Column("format", TEXT, "", "Its `--input-format`. Null if it could not be read."),
        Column(
            "program",
            TEXT,
            "",
            "The program that a capture is of, with its version if the capture states it.",
        ),
        Column("engine", TEXT, "", "The engine of that program."),
        Column("engine_version", TEXT, "", "The version of the engine."),
        Column(
            "device",
            TEXT,
            "",
            "The device that the capture was made on, else the profile that the input was checked "
            "for.",
        ),
        Column(
            "frames",
            INTEGER,
            "frames",
            "The number of frames of a capture, or of documents of a description. Null for other "
            "inputs.",
        ),
        Column(
            "frame_kinds",
            INTEGER,
            "",
            "The number of kinds of frame of a capture, or of documents of a description.",
        ),
        Column("images", INTEGER, "", "The number of images that were checked."),
        Column("passes", INTEGER, "", "The number of passes that were checked."),
        Column("pipelines", INTEGER, "", "The number of pipelines that were checked."),
        Column("shaders", INTEGER, "", "The number of shaders of source code that were checked."),
        Column("choices", INTEGER, "", "The number of sample count choices that were checked."),
        Column(
            "failed",
            BOOLEAN,
            "",
            "Whether an error kept the input, or a document of it, from being checked.",
        ),
        Column(
            "unread",
            TEXT,
            "",
            "What the input creates multisampled of which it shows no pass to check. Null if there "
            "is nothing.",
        ),
    ),
)

RUN = Table(
    "run",
    "One row. It has no time of day: a release of msaa-lint writes the same rows for the same "
    "inputs and settings.",
    (
        Column("schema", TEXT, "", f"The version of these tables: `{SCHEMA}`."),
        Column("version", TEXT, "", "The version of msaa-lint that wrote them."),
        Column("edition", TEXT, "", "The edition of the default rules of the current folder."),
        Column(
            "configuration",
            TEXT,
            "",
            "A digest of the settings, configurations, custom rules, and devices of the run.",
        ),
        Column("inputs", INTEGER, "", "The number of rows of `inputs`."),
        Column("findings", INTEGER, "", "The number of rows of `findings`."),
        Column("passes", INTEGER, "", "The number of rows of `passes`."),
    ),
)

TABLES = (FINDINGS, PASSES, INPUTS, RUN)


def parquet_paths(path: str) -> dict[str, str]:
    """The files of the tables by their names: `findings.parquet`, and beside it
    `findings.passes.parquet` and so on.
    """
    root, extension = os.path.splitext(path)
    return {
        table.name: path if table is FINDINGS else f"{root}.{table.name}{extension}"
        for table in TABLES
    }


def batches(rows: Iterable[Row], length: int) -> Iterator[list[Row]]:
    """The rows in lists of this length; the last one may be shorter."""
    batch: list[Row] = []
    for row in rows:
        batch.append(row)
        if len(batch) == length:
            yield batch
            batch = []
    if batch:
        yield batch

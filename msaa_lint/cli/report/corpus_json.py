"""The versioned JSON of `msaa-lint corpus`; `corpus_v1.schema.json` next to this file is its
schema. Figures have six decimals.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from decimal import Decimal
from typing import Any

from msaa_lint.linter.corpus.database import Rows
from msaa_lint.linter.corpus.summary import Group, Since, Summary

from . import Options, Write
from .data import Json, head, rounded, text, write_object

SCHEMA = "msaa-lint/corpus-v1"


def render(summary: Summary, out: Write, options: Options) -> None:
    """Prints one JSON object: the runs, the groups, the inputs of which fixes save the most, and
    what has changed.
    """
    members = {
        **head(SCHEMA, options.version),
        "runs": [
            {name: _value(value) for name, value in run._asdict().items()} for run in summary.runs
        ],
        "findings": summary.findings,
        "suppressed": summary.suppressed,
        "by": list(summary.keys),
        "wholes": [_group(group, summary.keys[:1]) for group in summary.wholes],
        "groups": (_group(group, summary.keys) for group in summary.groups),
        "group_count": summary.group_count,
        "top_inputs": (_group(group, ("input",)) for group in summary.top_inputs),
        "input_count": summary.input_count,
        "since": _since(summary.since) if summary.since is not None else None,
    }
    write_object(members, out)


def render_query(result: Rows, out: Write, options: Options) -> None:
    """Prints one JSON object: the names of the columns of a query, and its rows as lists."""
    rows = ([_value(value) for value in row] for row in result.rows)
    write_object(
        {**head(SCHEMA, options.version), "columns": list(map(text, result.columns)), "rows": rows},
        out,
    )


def _group(group: Group, keys: Sequence[str]) -> Json:
    return {
        **{key: _value(name) for key, name in zip(keys, group.names, strict=True)},
        "findings": group.findings,
        "inputs": group.inputs,
        "rules": group.rules,
        "priced": group.priced,
        "traffic_mb_per_s": rounded(group.traffic_mb_per_s),
        "memory_mib": rounded(group.memory_mib),
        "milliwatts": rounded(group.milliwatts),
        "prices_mb_per_s": {name: rounded(value) for name, value in group.prices._asdict().items()},
    }


def _since(since: Since) -> Json:
    return {
        "files": [text(file.name) for file in since.files],
        "new": since.new,
        "gone": since.gone,
        "new_inputs": since.new_inputs,
        "gone_inputs": since.gone_inputs,
        "moved_inputs": since.moved_inputs,
        "rules": [
            {name: _value(value) for name, value in each._asdict().items()}
            for each in since.changes
        ],
        "new_findings": [
            {name: _value(value) for name, value in each._asdict().items()}
            for each in since.new_findings
        ],
        "remarks": list(map(text, since.remarks)),
    }


def _value(value: Any) -> object:
    """A value of a query as JSON has it: what JSON does not have becomes text."""
    if value is None or isinstance(value, (bool, int)):
        return value
    if isinstance(value, (float, Decimal)):
        return rounded(float(value)) if math.isfinite(value) else None
    return text(str(value))

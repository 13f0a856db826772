"""Inputs that two runs name differently: they were renamed or moved, or the runs named their folder
in another way.
"""

from __future__ import annotations

from collections.abc import Iterable

from .database import SINCE, Database
from .tables import FINDINGS, INPUTS, PASSES, Column

_TABLES = (FINDINGS, PASSES, INPUTS)


def moved_inputs(database: Database) -> dict[str, str]:
    """The names in the earlier run of inputs that only the later one has under theirs.

    They have the same rows in both, or as many folders at the end of their paths in common as no
    other two, and at least one.
    """
    before, after = _rows_by_name(database, SINCE, "main"), _rows_by_name(database, "main", SINCE)
    named: dict[int, list[str]] = {}
    for name, rows in before.items():
        named.setdefault(rows, []).append(name)
    moved = {}
    for name, rows in after.items():
        if named.get(rows):
            moved[name] = named[rows].pop(0)
    return moved | _same_ends(
        [name for name in after if name not in moved], before.keys() - moved.values()
    )


def _rows_by_name(database: Database, schema: str, other: str) -> dict[str, int]:
    """The inputs and other files that only one run names, in order, each with a number that stands
    for its rows.
    """
    hashes = " UNION ALL ".join(
        f"SELECT input, hash(row('{table.name}', {', '.join(_values(table.columns))})) AS hashed "
        f"FROM {schema}.{table.name}"
        for table in _TABLES
    )
    names = " UNION ".join(f"SELECT input FROM {{0}}.{table.name}" for table in _TABLES)
    return dict(
        database.rows(f"""
            SELECT input, sum(hashed)::HUGEINT FROM ({hashes})
            WHERE input IN ({names.format(schema)} EXCEPT ({names.format(other)})) GROUP BY input
            ORDER BY input
        """)
    )


def _values(columns: Iterable[Column]) -> list[str]:
    return [f'"{column.name}"' for column in columns if column.name not in ("input", "fingerprint")]


def _same_ends(after: Iterable[str], before: Iterable[str]) -> dict[str, str]:
    """Paths with the earlier ones that have the same file name and folders at the end, the longest
    first.
    """
    left, ended = (
        {name: name.split("/") for name in after},
        {name: name.split("/") for name in before},
    )
    moved = {}
    for length in range(max(map(len, left.values()), default=0), 1, -1):
        ends, earlier = _by_end(left, length), _by_end(ended, length)
        for end, names in ends.items():
            if len(names) == len(earlier.get(end, ())) == 1:
                moved[names[0]] = earlier[end][0]
                del left[names[0]], ended[earlier[end][0]]
    return moved


def _by_end(paths: dict[str, list[str]], length: int) -> dict[tuple[str, ...], list[str]]:
    found: dict[tuple[str, ...], list[str]] = {}
    for name, parts in paths.items():
        if len(parts) >= length:
            found.setdefault(tuple(parts[-length:]), []).append(name)
    return found

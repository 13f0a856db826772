"""What is asked of corpora: where the most can be saved, how prices are distributed, and what has
changed since an earlier run.

Only prices that are savings count, of findings that are not suppressed. Sums are those of single
fixes: what several findings of an input save of the same bytes is counted for each.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from msaa_lint.linter.results import NUMBERS

from .database import Database
from .files import CorpusFile
from .moved import moved_inputs

_DECIMAL = "TRY_CAST({} AS DECIMAL(38, 6))"
"""Sums of these do not depend on their order, which those of DOUBLE do."""

_SHOWN = f"""
    SELECT f.corpus, coalesce(m.input, f.input) AS input, f.rule, f.code, i.engine, i.device,
    f.line,
        regexp_replace(coalesce(f.subject, ''), '{NUMBERS}', '', 'g') AS object,
        {_DECIMAL.format("f.read_mb_per_s + f.write_mb_per_s")} AS traffic,
        {_DECIMAL.format("f.memory_mib")} AS memory, {_DECIMAL.format("f.milliwatts")} AS power,
        coalesce(f.is_saving, false) AS priced,
        row_number() OVER (
            PARTITION BY coalesce(m.input, f.input), f.rule, object ORDER BY f.corpus, f.line,
            f.column_number, f.call_number, f.subject
        ) AS number
    FROM {{schema}}.findings f LEFT JOIN {{schema}}.inputs i ON i.corpus = f.corpus AND i.input =
    f.input
        LEFT JOIN {{moved}} m ON m.earlier = f.input
    WHERE f.suppressed IS NULL
"""
"""The findings that count. Those of an input about the same are told apart by `number`, as in
fingerprints. Inputs that have `moved` have their names of now.
"""

_NOT_MOVED = "(SELECT NULL AS input, NULL AS earlier)"

_PERCENTILES = (0.5, 0.9, 0.99)


class Distribution(NamedTuple):
    """The prices of a group in MB/s of reads and writes: percentiles and the highest one; None
    without any.
    """

    p50: float | None
    p90: float | None
    p99: float | None
    max: float | None


class Group(NamedTuple):
    """Findings of one rule, engine, device, or input, by the names of the summary's `keys`.

    `inputs` and `rules` are the numbers of different ones, `priced` that of the findings with a
    price. `traffic_mb_per_s`, `memory_mib`, and `milliwatts` are sums of their prices.
    """

    names: tuple[str | None, ...]
    findings: int
    inputs: int
    rules: int
    priced: int
    traffic_mb_per_s: float
    memory_mib: float
    milliwatts: float
    prices: Distribution


class Change(NamedTuple):
    """The findings of a rule that are new since an earlier run, and those that are gone, with the
    sums of their prices.
    """

    rule: str | None
    new: int
    gone: int
    new_mb_per_s: float
    gone_mb_per_s: float


class NewFinding(NamedTuple):
    """A finding that an earlier run does not have, and its price."""

    rule: str | None
    input: str | None
    line: int | None
    traffic_mb_per_s: float | None


class Since(NamedTuple):
    """What has changed since an earlier run. `new_findings` are the most expensive ones;
    `new_inputs`, `gone_inputs`, and `moved_inputs`, which have another name, count inputs.

    `remarks` say what makes the runs hard to compare.
    """

    files: Sequence[CorpusFile]
    changes: Sequence[Change]
    new_findings: Sequence[NewFinding]
    new: int
    gone: int
    new_inputs: int
    gone_inputs: int
    moved_inputs: int
    remarks: Sequence[str]


class Run(NamedTuple):
    """A run that wrote a corpus, and how many rows it has."""

    file: str
    version: str
    edition: str
    configuration: str
    inputs: int
    findings: int
    passes: int


class Summary(NamedTuple):
    """The answers. `groups` are by `keys`, most expensive first, and `group_count` is the number of
    all. If there are two keys, `wholes` are the groups by the first one. `top_inputs` are the
    inputs of which fixes save the most.
    """

    runs: Sequence[Run]
    findings: int
    suppressed: int
    keys: tuple[str, ...]
    wholes: Sequence[Group]
    groups: Sequence[Group]
    group_count: int
    top_inputs: Sequence[Group]
    input_count: int
    since: Since | None


def summarize(database: Database, by: str, top: int | None) -> Summary:
    """Answers what is asked of corpora, with at most `top` rows in each answer; None for all.
    Findings are grouped `by` rule, by input, or by engine or device and then by rule.
    """
    database.rows(f"CREATE TEMP TABLE shown AS {_SHOWN.format(schema='main', moved=_NOT_MOVED)}")
    runs = _runs(database, "main", database.files)
    findings, suppressed = database.rows("SELECT count(*), count(suppressed) FROM findings")[0]
    keys = (by, "rule") if by in ("engine", "device") else (by,)
    groups, count = _groups(database, keys, top)
    wholes: list[Group] = []
    if len(keys) > 1:
        wholes, _ = _groups(database, keys[:1], top)
        shown = {group.names[0] for group in wholes}
        groups = [group for group in groups if group.names[0] in shown]
    inputs, input_count = ([], count) if by == "input" else _groups(database, ("input",), top)
    since = _since(database, runs, top) if database.since else None
    return Summary(
        runs, findings, suppressed, keys, wholes, groups, count, inputs, input_count, since
    )


def _groups(database: Database, keys: tuple[str, ...], top: int | None) -> tuple[list[Group], int]:
    """The groups by some columns, most expensive first, and the number of all. With two columns,
    the value of the first for which fixes save the most comes first, and each has at most `top`
    groups.
    """
    # Inputs of several corpora may have the same name.
    grouping = "input, corpus" if keys == ("input",) else ", ".join(keys)
    quantiles = ", ".join(
        f"quantile_cont(traffic::DOUBLE, {fraction}) FILTER (priced)" for fraction in _PERCENTILES
    )
    order = (
        "sum(power) FILTER (priced) DESC NULLS LAST, sum(memory) FILTER (priced) DESC NULLS "
        f"LAST, count(*) DESC, {grouping}"
    )
    limit = f"ORDER BY {order} {_limit(top)}"
    if len(keys) > 1:
        ranked = (
            ""
            if top is None
            else f"QUALIFY row_number() OVER (PARTITION BY {keys[0]} ORDER BY {order}) <= {top:d}"
        )
        whole = f"sum(sum(power) FILTER (priced)) OVER (PARTITION BY {keys[0]})"
        limit = f"{ranked} ORDER BY {whole} DESC NULLS LAST, {keys[0]} NULLS LAST, {order}"
    rows = database.rows(f"""
        SELECT {", ".join(keys)}, count(*), count(DISTINCT (corpus, input)), count(DISTINCT rule),
        count(*) FILTER (priced),
            coalesce(sum(traffic) FILTER (priced), 0)::DOUBLE, coalesce(sum(memory) FILTER (priced),
            0)::DOUBLE,
            coalesce(sum(power) FILTER (priced), 0)::DOUBLE, {quantiles}, max(traffic) FILTER
            (priced)::DOUBLE, count(*) OVER ()
        FROM shown GROUP BY {grouping} {limit}
    """)
    width = len(keys)
    return [_group(row, width) for row in rows], rows[0][-1] if rows else 0


def _group(row: Sequence[Any], width: int) -> Group:
    """A group from its row, whose first `width` values are its names."""
    findings, inputs, rules, priced, traffic, memory, power, p50, p90, p99, most, _ = row[width:]
    return Group(
        tuple(row[:width]),
        findings,
        inputs,
        rules,
        priced,
        traffic,
        memory,
        power,
        Distribution(p50, p90, p99, most),
    )


def _since(database: Database, runs: Sequence[Run], top: int | None) -> Since:
    """What differs from the tables of the earlier run: findings are the same if their input, rule,
    and object are.
    """
    moved = moved_inputs(database)
    database.rows(
        "CREATE TEMP TABLE moved AS SELECT unnest($1) AS input, unnest($2) AS earlier",
        [list(moved), list(moved.values())],
    )
    database.rows(
        f"CREATE TEMP TABLE shown_since AS {_SHOWN.format(schema='since', moved='moved')}"
    )
    for name, these, others in (
        ("new_findings", "shown", "shown_since"),
        ("gone_findings", "shown_since", "shown"),
    ):
        database.rows(
            f"CREATE TEMP TABLE {name} AS SELECT * FROM {these} ANTI JOIN {others} USING (input, "
            "rule, object, number)"
        )
    changes = database.rows(f"""
        SELECT rule, count(*) FILTER (is_new), count(*) FILTER (NOT is_new),
            coalesce(sum(traffic) FILTER (priced AND is_new), 0)::DOUBLE, coalesce(sum(traffic)
            FILTER (priced AND NOT is_new), 0)::DOUBLE
        FROM (SELECT *, true AS is_new FROM new_findings UNION ALL SELECT *, false AS is_new FROM
        gone_findings)
        GROUP BY rule ORDER BY 4 DESC, 2 DESC, 5 DESC, 3 DESC, rule {_limit(top)}
    """)
    findings = database.rows(f"""
        SELECT rule, input, line, CASE WHEN priced THEN traffic::DOUBLE END FROM new_findings
        ORDER BY 4 DESC NULLS LAST, rule, input, line, object, number {_limit(top)}
    """)
    (new,), (gone,) = database.rows(
        "SELECT count(*) FROM new_findings UNION ALL SELECT count(*) FROM gone_findings"
    )
    new_inputs, gone_inputs = (
        database.rows(
            f"SELECT count(*) FROM (SELECT input FROM {these}.inputs EXCEPT SELECT input FROM "
            f"{others}.inputs)"
        )[0][0]
        for these, others in (("main", "since"), ("since", "main"))
    )
    # Other files of programs may have moved, too.
    ((moved_count,),) = database.rows(
        "SELECT count(*) FROM moved SEMI JOIN (SELECT DISTINCT input FROM main.inputs) USING "
        "(input)"
    )
    return Since(
        database.since,
        [Change(*row) for row in changes],
        [NewFinding(*row) for row in findings],
        new,
        gone,
        new_inputs - moved_count,
        gone_inputs - moved_count,
        moved_count,
        _remarks(_runs(database, "since", database.since), runs),
    )


def _runs(database: Database, schema: str, files: Sequence[CorpusFile]) -> list[Run]:
    """The runs that wrote files, in their order."""
    texts = (f"coalesce({name}, '')" for name in ("version", "edition", "configuration"))
    counts = (f"coalesce({name}, 0)" for name in ("inputs", "findings", "passes"))
    rows = database.rows(f"SELECT corpus, {', '.join((*texts, *counts))} FROM {schema}.run")
    order = {file.name: number for number, file in enumerate(files)}
    return sorted((Run(*row) for row in rows), key=lambda run: order[run.file])


def _remarks(old: Sequence[Run], new: Sequence[Run]) -> list[str]:
    """What of the runs besides their inputs differs."""
    remarks = []
    for word in ("version", "edition", "configuration"):
        before, after = ({getattr(run, word) for run in runs} for runs in (old, new))
        if before != after:
            stated = (
                ""
                if word == "configuration"
                else f" ({', '.join(sorted(before))}; now {', '.join(sorted(after))})"
            )
            remarks.append(
                f"the earlier run had another {word}{stated}: findings may be new or gone because "
                "of it"
            )
    return remarks


def _limit(top: int | None) -> str:
    return "" if top is None else f"LIMIT {top:d}"

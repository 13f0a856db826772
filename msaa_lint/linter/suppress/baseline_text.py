"""Reads the text of a baseline, which may come from an untrusted branch."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.span import Span

if TYPE_CHECKING:
    from msaa_lint.core.text.source import Source

MAX_COUNT = 1 << 31
MAX_FINDINGS = 50


def read_entries(source: Source, schema: str) -> tuple[dict[str, dict[str, int]], list[Finding]]:
    """The counts by file and rule, and the problems of the text (MSAA921, each at its place)."""
    value = _parse(source)
    if isinstance(value, Finding):
        return {}, [value]
    findings: list[Finding] = []

    def problem(path: tuple[str, ...], message: str) -> None:
        if len(findings) < MAX_FINDINGS:
            findings.append(
                diagnostic(
                    "MSAA921", f"invalid baseline: {message}", source.name, _location(source, path)
                )
            )

    files = value.get("entries") if isinstance(value, dict) else None
    if not isinstance(value, dict):
        problem(
            (), "expected an object with `schema` and `entries`; `msaa-lint baseline` writes one"
        )
    elif value.get("schema") != schema:
        problem(("schema",), f'expected the schema "{schema}"')
    elif not isinstance(files, dict):
        problem(("entries",), "`entries` must be an object with an object for each file")
    if findings:
        return {}, findings
    assert isinstance(value, dict) and isinstance(files, dict)
    for key in value:
        if key not in ("schema", "entries"):
            problem((key,), f"unknown key {quoted(key)}: expected `schema` and `entries`")
    for file, rules in files.items():
        if not isinstance(rules, dict):
            problem(
                ("entries", file), f"{quoted(file)} must be an object with a count for each rule"
            )
            continue
        for rule, count in rules.items():
            if not isinstance(count, int) or isinstance(count, bool) or not 1 <= count < MAX_COUNT:
                message = (
                    f"the count of {quoted(rule)} in {quoted(file)} must be an integer from "
                    f"1 to {MAX_COUNT - 1}"
                )
                problem(("entries", file, rule), message)
    return files, findings


def _parse(source: Source) -> Any:
    """The JSON value of a text, or a finding that says why it has none."""
    import json
    from itertools import pairwise

    def unique_keys(items: list[tuple[str, Any]]) -> dict[str, Any]:
        mapping = dict(items)
        if len(mapping) < len(items):
            names = sorted(key for key, _ in items)
            repeated = next(key for key, following in pairwise(names) if key == following)
            raise ValueError(f"duplicate key {quoted(repeated)}")
        return mapping

    try:
        return json.loads(source.text, object_pairs_hook=unique_keys)
    except json.JSONDecodeError as error:
        from msaa_lint.core.text.json_errors import json_problem

        problem = json_problem(source.text, error.pos)
        return diagnostic(
            "MSAA921",
            f"invalid baseline: not valid JSON: {problem.message}",
            source.name,
            problem.span,
            labels=problem.labels,
        )
    except RecursionError:
        return diagnostic("MSAA921", "invalid baseline: nested too deeply", source.name)
    except ValueError as error:
        return diagnostic(
            "MSAA921", f"invalid baseline: {str(error)[:200]}; remove one of the two", source.name
        )


def _location(source: Source, path: tuple[str, ...]) -> Span | None:
    """The span of a value or of the nearest value around it, from the parser of descriptions, which
    reads JSON too.
    """
    from msaa_lint.core.text.tree import Limits, parse

    parsed = parse(source, Limits())
    node = parsed.documents[0] if parsed.documents else None
    for key in path:
        if node is None or node.kind != "mapping" or key not in node.value:
            break
        node = node.value[key]
    return None if node is None else node.span

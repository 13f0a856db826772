"""Reads a baseline's text, which may come from a stranger's branch."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.span import Span

if TYPE_CHECKING:
    from msaa_lint.core.text.source import Source

MAX_COUNT = 1 << 31
MAX_PROBLEMS = 50


def entries(source: Source, schema: str) -> tuple[dict[str, dict[str, int]], list[Finding]]:
    """The counts by file and rule of a baseline's text, and what is wrong with it (MSAA921, at its place)."""
    read = _parsed(source)
    if isinstance(read, Finding):
        return {}, [read]
    problems: list[Finding] = []

    def wrong(path: tuple[str, ...], message: str) -> None:
        if len(problems) < MAX_PROBLEMS:
            problems.append(diagnostic("MSAA921", f"baseline: {message}", source.name, _place(source, path)))

    if not isinstance(read, dict):
        wrong((), "an object is due")
        return {}, problems
    if read.get("schema") != schema:
        wrong(("schema",), f'the schema is not "{schema}"')
        return {}, problems
    for key in read:
        if key not in ("schema", "entries"):
            wrong((key,), f"unknown key {quoted(key)}")
    files = read.get("entries")
    if not isinstance(files, dict):
        wrong(("entries",), "`entries` is an object of files")
        return {}, problems
    for file, own in files.items():
        if not isinstance(own, dict):
            wrong(("entries", file), f"{quoted(file)} has no object of rules and counts")
            continue
        for rule, count in own.items():
            if not isinstance(count, int) or isinstance(count, bool) or not 1 <= count < MAX_COUNT:
                wrong(("entries", file, rule), f"the count of {quoted(rule)} in {quoted(file)} is no whole number of at least 1")
    return files, problems


def _parsed(source: Source) -> Any:
    """The JSON value of a text, or the finding that it is none."""
    import json
    from itertools import pairwise

    def pairs(items: list[tuple[str, Any]]) -> dict[str, Any]:
        made = dict(items)
        if len(made) < len(items):
            names = sorted(key for key, _ in items)
            again = next(key for key, after in pairwise(names) if key == after)
            raise ValueError(f"the key {quoted(again)} stands twice")
        return made

    try:
        return json.loads(source.text, object_pairs_hook=pairs)
    except json.JSONDecodeError as error:
        at = min(error.pos, len(source.text))
        return diagnostic("MSAA921", f"the baseline is no JSON: {error.msg}", source.name, Span(at, min(at + 1, len(source.text))))
    except RecursionError:
        return diagnostic("MSAA921", "the baseline is nested too deeply", source.name)
    except ValueError as error:
        return diagnostic("MSAA921", f"the baseline cannot be used: {str(error)[:200]}", source.name)


def _place(source: Source, path: tuple[str, ...]) -> Span | None:
    """Where a value stands: the parser of descriptions knows, and reads JSON too."""
    from msaa_lint.core.text.tree import Limits, parse

    parsed = parse(source, Limits())
    node = parsed.documents[0] if parsed.documents else None
    for key in path:
        if node is None or node.kind != "mapping" or key not in node.value:
            break
        node = node.value[key]
    return None if node is None else Span(node.start, node.end)

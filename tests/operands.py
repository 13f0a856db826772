"""Conditions of rules without one of their operands: each must make an example of its page fail.

`python -m tests.operands [RULE...]` lists the operands of `&&` and `||` that no example holds, and
exits with 1 if more than 3 % of all are so. An operand that no example holds is either not needed,
or lacks a `good` example that looks bad (or a `bad` one that looks good).
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from typing import NamedTuple

from msaa_lint.input.source_file import read_source_file
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules.registry import Registry, built_in
from msaa_lint.linter.rules.rule import Rule
from tests.pages import DESCRIPTIONS, PROGRAMS, RULES, Example, examples

SHARE = 0.97
"""The share of operands that examples must hold."""

_TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)*\'|&&|\|\||[()\[\],?:]|.', re.DOTALL)


class Operand(NamedTuple):
    """An operand of a condition, and the condition without it."""

    text: str
    rest: str


def operands(condition: str) -> list[Operand]:
    """The operands of every `&&` and `||` of a condition, those of its parts included."""
    found: list[Operand] = []
    for start, end in _groups(condition):
        disjuncts = [*_split(condition, start, end, "||")]
        for parts in (
            disjuncts,
            *([*_split(condition, *disjunct, "&&")] for disjunct in disjuncts),
        ):
            for number, (first, last) in enumerate(parts if len(parts) > 1 else ()):
                # With the operator before it; of the first, with the one after.
                cut = (parts[number - 1][1], last) if number else (first, parts[1][0])
                found.append(
                    Operand(
                        condition[first:last].strip(),
                        f"{condition[: cut[0]]} {condition[cut[1] :]}",
                    )
                )
    return found


def _tokens(text: str, start: int, end: int) -> Iterator[tuple[str, int, int]]:
    """The tokens of a part of a condition: each with its depth in brackets, and its offset."""
    depth = 0
    for match in _TOKEN.finditer(text, start, end):
        token = match[0]
        depth -= token in ")]"
        yield token, depth, match.start()
        depth += token in "(["


def _groups(text: str) -> Iterator[tuple[int, int]]:
    """The parts of a condition that brackets, commas, `?` and `:` separate."""
    opened = [0]
    for token, _, offset in _tokens(text, 0, len(text)):
        if token in ("(", "["):
            opened.append(offset + 1)
        elif token in (")", "]"):
            yield opened.pop(), offset
        elif token in (",", "?", ":"):
            yield opened[-1], offset
            opened[-1] = offset + 1
    yield opened[0], len(text)


def _split(text: str, start: int, end: int, operator: str) -> Iterator[tuple[int, int]]:
    """The parts of a range between an operator that stands outside of brackets."""
    first = start
    for token, depth, offset in _tokens(text, start, end):
        if token == operator and depth == 0:
            yield first, offset
            first = offset + len(operator)
    yield first, end


def lint(engine: Engine, example: Example) -> FileResult:
    """The result of linting an example, as if it stood beside its page."""
    name = str(RULES / f"example.{example.language}")
    options = LintOptions(lambda rule, suggested, vendor: suggested)
    data = example.text.encode()
    return engine.lint(
        read_source_file(data, name, example.language) if example.language in PROGRAMS else data,
        name,
        options,
    )


def not_held(rule: Rule) -> tuple[int, list[Operand]]:
    """How many operands a rule's condition has, and those that it can lose while every example of
    its page gives what it gave.
    """
    every = operands(rule.when)
    variants = [
        rule._replace(code=f"{rule.code}-{n}", name=f"{rule.name}-{n}", when=text)
        for n, text in enumerate([rule.when, *(o.rest for o in every)])
    ]
    # One run of all conditions, as most of the time goes into reading an example.
    engine = Engine(Registry(tuple(variants), ()))
    remaining = dict(enumerate(every, 1))
    for example in examples(RULES / f"{rule.name}.md", (*DESCRIPTIONS, *PROGRAMS)):
        places: dict[str, list[object]] = {variant.name: [] for variant in variants}
        for finding in lint(engine, example).findings:
            places[finding.rule].append(finding.span)
        remaining = {
            n: operand
            for n, operand in remaining.items()
            if places[variants[n].name] == places[variants[0].name]
        }
    return len(every), list(remaining.values())


def main(names: list[str]) -> int:
    total = 0
    loose: list[str] = []
    for rule in built_in().rules:
        if names and not {rule.name, rule.code}.intersection(names):
            continue
        count, found = not_held(rule)
        total += count
        loose += [f"{rule.code} {rule.name}: {operand.text}" for operand in found]
    print("\n".join(loose))
    print(f"{total - len(loose)} of {total} operands are held by an example")
    return int(total - len(loose) < SHARE * total)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Statements: blocks without their braces, and `if` chains."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msaa_lint.input.code.core.terms import BLOCK, IF, LEAVE, RETURN, SOME, Term

MAX_LINKS = 64
"""The maximum number of conditions in an `if` chain."""


def statements(body: Sequence[Term]) -> Iterator[Term]:
    """Yields the statements of a body, including those in preprocessor blocks, but not the dead
    code after a `return` or `throw`.
    """
    if len(body) == 1 and body[0][0] == BLOCK:
        body = body[0][1]
    end = next((n for n, term in enumerate(body, 1) if term[0] in (RETURN, LEAVE)), len(body))
    # A block may have a label.
    body = body if any(term[0] == BLOCK for term in body[end:]) else body[:end]
    stack = [*reversed(body)]
    while stack:
        term = stack.pop()
        if term[0] == SOME:
            stack += (*reversed(term[3]), *reversed(term[2]))
        else:
            yield term


def links(term: Term) -> Iterator[tuple[Term | None, Sequence[Term]]]:
    """Yields the conditions of an `if` chain with their branches; the condition of a final `else`
    is None.
    """
    for _ in range(MAX_LINKS):
        yield term[1], term[2]
        otherwise = term[3]
        if len(otherwise) != 1 or otherwise[0][0] != IF:
            if otherwise:
                yield None, otherwise
            return
        term = otherwise[0]

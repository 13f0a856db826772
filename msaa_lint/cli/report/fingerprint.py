"""Identifiers of findings that survive edits: a mistake keeps its fingerprint when lines move, or
entries before it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from hashlib import sha256

from msaa_lint.core.finding import Finding
from msaa_lint.linter.results import NUMBERS

from .paths import relative

_NUMBERS = re.compile(NUMBERS)


def fingerprint(finding: Finding, n: int, root: str = "") -> str:
    """32 hexadecimal digits from the rule, the file relative to `root`, the subject without
    `NUMBERS`, and `n`, the number of earlier findings with the same three.
    """
    text = "\0".join((*_key(finding, root), str(n)))
    return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:32]


def fingerprints(findings: Iterable[Finding], root: str = "") -> Iterator[str]:
    """A distinct fingerprint for each finding, in order."""
    # Most findings are the first of their kind, of which a number is kept: a run may have millions.
    firsts: set[int] = set()
    counts: dict[int, int] = {}
    for finding in findings:
        first = fingerprint(finding, 0, root)
        number = int(first[:16], 16)
        if number not in firsts:
            firsts.add(number)
            yield first
        else:
            counts[number] = counts.get(number, 0) + 1
            yield fingerprint(finding, counts[number], root)


def _key(finding: Finding, root: str) -> tuple[str, str, str]:
    return (finding.rule, relative(finding.file, root), _NUMBERS.sub("", finding.subject))

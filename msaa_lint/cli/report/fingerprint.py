"""Identifiers of findings that survive edits: a mistake keeps its fingerprint when lines move."""

from __future__ import annotations

from collections.abc import Iterable
from hashlib import sha256

from msaa_lint.core.finding import Finding

from .paths import relative


def fingerprint(finding: Finding, n: int, root: str = "") -> str:
    """32 hexadecimal digits from the rule, the file relative to `root`, the subject, and `n`, the number of earlier findings with the same
    three."""
    text = "\0".join((finding.rule, relative(finding.file, root), finding.subject, str(n)))
    return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:32]


def fingerprints(findings: Iterable[Finding], root: str = "") -> list[str]:
    """A distinct fingerprint for each finding, in order."""
    counts: dict[tuple[str, str, str], int] = {}
    names = []
    for finding in findings:
        key = (finding.rule, relative(finding.file, root), finding.subject)
        n = counts.get(key, 0)
        counts[key] = n + 1
        names.append(fingerprint(finding, n, root))
    return names

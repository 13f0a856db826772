"""Names for findings that outlive edits: the same mistake keeps its name when lines move."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from .paths import relative

if TYPE_CHECKING:
    from msaa_lint.core.finding import Finding


def fingerprint(finding: Finding, n: int, root: str = "") -> str:
    """32 hexadecimal digits from the rule, the file relative to `root`, the subject and `n`, the count of findings before it that agree in
    these three."""
    from hashlib import sha256

    text = "\0".join((finding.rule, relative(finding.file, root), finding.subject, str(n)))
    return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:32]


def fingerprints(findings: Iterable[Finding], root: str = "") -> list[str]:
    """A fingerprint for each finding, in order, no two alike."""
    seen: dict[tuple[str, str, str], int] = {}
    made = []
    for finding in findings:
        key = (finding.rule, relative(finding.file, root), finding.subject)
        n = seen.get(key, 0)
        seen[key] = n + 1
        made.append(fingerprint(finding, n, root))
    return made

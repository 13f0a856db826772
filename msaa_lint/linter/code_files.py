"""The files of a program in source code: which of its findings lie in each, and what its text has
of its own.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

from msaa_lint.core.finding import Finding
from msaa_lint.core.hidden_characters import hidden_characters
from msaa_lint.core.text.source import Source
from msaa_lint.input.file_types import PAGES

from .results import location_order

if TYPE_CHECKING:
    from msaa_lint.input.source_file import CodeFile, SourceFile

_LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|\Z)")


def in_file(code: SourceFile, finding: Finding) -> tuple[CodeFile, Finding]:
    """The file that a finding of a program lies in, and the finding with its places there. A label
    in another file names that file.
    """
    if finding.span is None:
        return code.files[0], finding._replace(file=code.files[0].source.name)
    file, span = code.place(finding.span)
    labels = []
    for label in finding.labels:
        other, at = code.place(label.span)
        labels.append(label._replace(span=at, file=None if other is file else other.source.name))
    return file, finding._replace(file=file.source.name, span=span, labels=tuple(labels))


def hidden_in(file: CodeFile) -> Iterable[Finding]:
    """Notes about characters of code; those of a page's prose are its author's."""
    findings = hidden_characters(file.source)
    if not findings or file.language not in PAGES:
        return findings
    lines = _LINE.findall(code_only(file).text)
    # The blanked text may have fewer lines: it has none for what follows the last code.
    numbers = [found.span and file.source.position(found.span.start).line for found in findings]
    return [
        found
        for found, number in zip(findings, numbers, strict=True)
        if number and any(map(str.strip, lines[number - 1 : number]))
    ]


def code_only(file: CodeFile) -> Source:
    """The text of a file with everything but its code blanked out, at the same offsets."""
    texts = [each.text for each in file.codes]
    if len(texts) > 1:
        lines = zip(*(_LINE.findall(text) for text in texts), strict=True)
        # No line belongs to two codes: at most one of them is not blank.
        texts = [next((line for line in same if line.strip()), same[0]) for same in lines]
    return Source(file.source.name, "".join(texts))


def in_order(code: SourceFile, findings: Iterable[Finding]) -> list[Finding]:
    """Findings in the order of the files of a program, and of their places."""
    order = {file.source.name: number for number, file in enumerate(code.files)}
    return sorted(
        findings, key=lambda finding: (order.get(finding.file, -1), location_order(finding))
    )

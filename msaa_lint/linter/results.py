"""The result of linting one input, and what is needed to fix and price its findings."""

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.finding import Finding, Suppressed, Undecided
from msaa_lint.core.text.source import Source
from msaa_lint.frame.devices import DeviceProfile

if TYPE_CHECKING:
    from msaa_lint.frame.description.document import Document

    from .rules.rule_runner import FixSpecs

_INDEX = re.compile(r"\[[0-9]+\]")

NUMBERS = r"^documents\[[0-9]+\]\.|\[[0-9]+\]| #[0-9]+"
"""A pattern of the numbers in a subject that say nothing of it: the document, which is not stated
of a single one, indices, which shift when an entry before them is removed, and those of captured
objects without a name, which every capture gives anew. RE2 reads it as well.
"""


MAX_TRIED = 1 << 20
"""Characters of a text up to which its fixes are tried for a summary; `--fix`, `--diff`, and
`--fail-on-cost` try them for any.
"""


class DocumentResult(NamedTuple):
    """One document of an input, with the fixes of its findings by finding.

    `number` is its index in a multi-document stream; `device` is the profile it was linted for;
    `checked` is false if problems of the document kept rules from running.
    """

    document: "Document"
    fix_specs: "FixSpecs"
    number: int = 0
    device: DeviceProfile | None = None
    checked: bool = True


class FileResult(NamedTuple):
    """The result of linting one input.

    `source` is None if the input could not be decoded. `is_code` is true for source code; `sources`
    has the text of each file of a program, whose findings name their files. `description` is the
    result that fixes work with, if it is another: that of the description of a capture, or with the
    findings of each document of a program; `documents` are the same.
    """

    file: str
    source: Source | None
    findings: list[Finding]
    undecided: list[Undecided]
    suppressed: list[Suppressed]
    documents: Sequence[DocumentResult] = ()
    is_code: bool = False
    description: "FileResult | None" = None
    sources: Mapping[str, Source] = {}


def unmerged(result: FileResult) -> FileResult:
    """The result of linting the text that fixes edit, with the findings of each document."""
    return result.description or result


def can_try_fixes(result: FileResult) -> bool:
    """Whether the text that was linted, of a capture its description, is small enough to try its
    fixes for a summary.
    """
    return result.source is not None and len(result.source.text) <= MAX_TRIED


def finding_kind(finding: Finding) -> tuple[str, str]:
    """A finding's code and the structural path of its subject without indices, which shift when an
    entry before them is removed.
    """
    return (finding.code, _INDEX.sub("[]", finding.subject))


def location_order(finding: Finding) -> tuple[int, int, str, str]:
    """The sort key of the findings of one file: location, then code and message; findings without a
    location come first.
    """
    start, end = finding.span if finding.span is not None else (-1, -1)
    return (start, end, finding.code, finding.message)


def price_order(finding: Finding) -> tuple[float, float]:
    """The sort key by price, highest first; a choice costs nothing."""
    price, fix = finding.price, finding.fix
    return (
        (-price.milliwatts, -price.memory_mib)
        if price is not None and not (fix is not None and fix.choice)
        else (0.0, 0.0)
    )

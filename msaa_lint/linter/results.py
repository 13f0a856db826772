"""The result of linting one input, and what is needed to fix and price its findings."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Finding, Price, Suppressed, Undecided
from msaa_lint.core.text.source import Source
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.devices import DeviceProfile

from .rules.rule_runner import FixSpecs

CombinedPrice = Callable[[Sequence[Finding]], Price | None]
"""The price of several findings of one input together; None if none of them has a price."""


class DocumentResult(NamedTuple):
    """One document of an input, with the fixes of its findings by finding.

    `number` is its index in a multi-document stream; `device` is the profile it was linted for; `checked` is false if problems of the
    document kept rules from running.
    """

    document: Document
    fix_specs: FixSpecs
    number: int = 0
    device: DeviceProfile | None = None
    checked: bool = True


class FileResult(NamedTuple):
    """The result of linting one input.

    `source` is None if the input could not be decoded. `combined_price` is None if no finding has a price. `is_code` is true for source
    code, whose findings are never fixed in place.
    """

    file: str
    source: Source | None
    findings: list[Finding]
    undecided: list[Undecided]
    suppressed: list[Suppressed]
    combined_price: CombinedPrice | None = None
    documents: Sequence[DocumentResult] = ()
    is_code: bool = False


def location_order(finding: Finding) -> tuple[int, int, str, str]:
    """The sort key of the findings of one file: location, then code and message; findings without a location come first."""
    start, end = finding.span if finding.span is not None else (-1, -1)
    return (start, end, finding.code, finding.message)

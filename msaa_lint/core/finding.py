"""What a lint run gives: findings, what stayed undecided, and what was silenced.

Every other module either makes these (rules, readers, suppressions) or prints them (reports); this one imports nothing of ours.
Texts in here may hold raw text of an input: whoever prints them escapes them for the output they go to.
"""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from .text.span import Edit, Label, Span

if TYPE_CHECKING:
    from .text.source import Source

SEVERITIES = ("note", "warning", "error")
"""In rising order, so that an index compares."""

CONFIDENCES = ("low", "medium", "high")


class Fix(NamedTuple):
    """A mend: what it does in words, whether the picture cannot change by it, and the edits (none: stated, not computed).

    One that is `shown` says what would cost less, and is never made: it is for people to decide.
    """

    title: str
    safe: bool
    edits: tuple[Edit, ...] = ()
    shown: bool = False


class Price(NamedTuple):
    """What a finding costs, by the cost model. MB is 10^6 bytes, MiB 2^20."""

    read_mb_per_s: float
    write_mb_per_s: float
    memory_mib: float
    milliwatts: float


class CaptureLocation(NamedTuple):
    """Where in a capture a finding is from: the call by its name and index, and in how many frames of how many what it speaks of is in use.

    `call` is None where the capture numbers nothing, `frames` where they are not counted.
    """

    by: str
    call: int | None
    frames: int | None
    of: int


class Finding(NamedTuple):
    """One mistake at one place.

    `span` is None where the input has no text (binary captures) or could not be decoded; `subject` is the structural path of what is
    judged, e.g. `renderPasses.forward.attachments.color`.
    """

    code: str
    rule: str
    severity: str
    confidence: str
    message: str
    file: str
    span: Span | None
    subject: str = ""
    labels: tuple[Label, ...] = ()
    notes: tuple[str, ...] = ()
    help: str = ""
    fix: Fix | None = None
    price: Price | None = None
    seen: CaptureLocation | None = None

    @property
    def fatal(self) -> bool:
        """True where an input, a page or the configuration could not be used (9xx of severity error): the run ends with 2."""
        return self.code.startswith("MSAA9") and self.severity == "error"


class Undecided(NamedTuple):
    """A rule that could say neither yes nor no for a subject, and the facts it lacked."""

    code: str
    rule: str
    file: str
    subject: str
    missing: tuple[str, ...]


class Suppressed(NamedTuple):
    """A finding that was silenced: `how` is `inline` or `baseline`; `reason` is the comment's, or empty."""

    finding: Finding
    how: str
    reason: str = ""


class RuleInfo(NamedTuple):
    """What a report says about a rule. `summary` is one sentence, `markdown` the page without its front matter."""

    code: str
    name: str
    severity: str
    confidence: str
    summary: str
    markdown: str = ""
    references: tuple[str, ...] = ()
    fixable: bool = False


class Result(NamedTuple):
    """A whole lint run. Findings are in the order of files, places and codes; `rules` are the enabled ones by code.

    `together` is what the findings of a file cost together, by file: less than the sum of their prices where two of them cost the same
    bytes. A file without a price is not in it.
    """

    findings: Sequence[Finding]
    undecided: Sequence[Undecided]
    suppressed: Sequence[Suppressed]
    files: Sequence[str]
    sources: Mapping[str, "Source"]
    rules: Sequence[RuleInfo]
    together: Mapping[str, Price] = {}


def is_confident(found: Finding, confidence: str) -> bool:
    """Whether a finding is of a confidence, or a higher one."""
    return CONFIDENCES.index(found.confidence) >= CONFIDENCES.index(confidence)


def rank(severity: str) -> int:
    """0 for note, 1 for warning, 2 for error."""
    return SEVERITIES.index(severity)

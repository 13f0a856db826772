"""The results of a lint run: findings, undecided rules, and suppressed findings.

Their texts may contain raw text of an input: a report must escape them for its output.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from .rendered import Level, RenderedReport
from .text.span import Edit, Label, Span

if TYPE_CHECKING:
    from .text.source import Source

SEVERITIES = ("note", "warning", "error")
"""In increasing order."""

CONFIDENCES = ("low", "medium", "high")


class Fix(NamedTuple):
    """A fix of a finding. A `safe` fix cannot change the picture. `edits` is empty if they are not
    computed.

    A fix that is `shown` is never applied. It is a `choice` if its rule leaves it to the user,
    because it changes what the frame does; otherwise the input cannot be edited. `refusal` is the
    reason why `--fix --unsafe-fixes` does not make a fix that is not shown.
    """

    title: str
    safe: bool
    edits: tuple[Edit, ...] = ()
    shown: bool = False
    choice: bool = False
    refusal: str = ""


class Price(NamedTuple):
    """The estimated saving from a fix, or from several. MB is 10^6 bytes, MiB is 2^20 bytes."""

    read_mb_per_s: float
    write_mb_per_s: float
    memory_mib: float
    milliwatts: float


class Saving(NamedTuple):
    """The number of findings that fixes remove, and the cost of the input before them minus its
    cost after; None if that is unknown.

    `assumes_tiler`: some of the price is that on a tile-based GPU, since the input names no device
    that is known to be one or not.
    """

    findings: int = 0
    price: Price | None = None
    assumes_tiler: bool = False


class Savings(NamedTuple):
    """What fixes save of one input, determined by making them.

    `safe` is the result of `--fix`, `all` that of `--fix --unsafe-fixes`. If `converted`, the input
    is a capture or source code, and the fixes are those of the description that `msaa-lint convert`
    writes.
    """

    safe: Saving
    all: Saving
    converted: bool = False


class CaptureLocation(NamedTuple):
    """The captured call that a finding is about, `by` name and index, and the number of frames that
    use its subject, `of` all frames.

    `call` is None if the capture does not number calls, `frames` if frames were not counted.
    """

    by: str
    call: int | None
    frames: int | None
    of: int


class Finding(NamedTuple):
    """One mistake at one location.

    `span` is None if the input has no text (binary captures) or could not be decoded. `subject` is
    the structural path of the object that the finding is about, such as
    `renderPasses.forward.attachments.color`; `images` are the names of the images that it concerns.
    `context` is the beginning of the message, which names the debug labels of its pass.
    `assumes_tiler`: the price is that on a tile-based GPU, since the input names no device that is
    known to be one or not.
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
    capture_location: CaptureLocation | None = None
    images: frozenset[str] = frozenset()
    context: str = ""
    assumes_tiler: bool = False

    @property
    def fatal(self) -> bool:
        """Whether an input, a rule page or the configuration cannot be used (a 9xx error): the exit
        code is then 2.
        """
        return self.code.startswith("MSAA9") and self.severity == "error"

    @property
    def level(self) -> Level:
        """What the exit code depends on."""
        return self.severity, self.confidence, self.fatal


class MissingKey(NamedTuple):
    """A key that an input lacks: the path of its structure (empty: the input), its name there, what
    it may hold, and where it goes.

    `converted` says that the structure is one of the description that `msaa-lint convert` writes,
    since the input is not a description.
    """

    structure: str
    name: str
    values: str
    span: Span
    converted: bool = False

    @property
    def path(self) -> str:
        """The whole path: `images.color.usage`."""
        return f"{self.structure}.{self.name}" if self.structure else self.name


class Undecided(NamedTuple):
    """A rule that could not be decided for a subject, the facts that were missing, and the keys to
    write next, which state them.
    """

    code: str
    rule: str
    file: str
    subject: str
    missing: tuple[str, ...]
    keys: tuple[MissingKey, ...] = ()


class Suppressed(NamedTuple):
    """A suppressed finding. `how` is `inline` or `baseline`; `reason` is that of the comment, or
    empty.
    """

    finding: Finding
    how: str
    reason: str = ""


class Unread(NamedTuple):
    """Something multisampled of which an input shows no pass or pipeline to check: its place, None
    without a text, and the problem.

    `unknown` is the first name in source code on the way to its sample count that nothing gives a
    value; empty if there is none.
    """

    span: Span | None
    message: str
    unknown: str = ""


class CaptureSummary(NamedTuple):
    """What a capture contains.

    `program`, `engine`, and `device` are empty if the capture does not state them. `kinds` is the
    number of kinds of frame, `passes` the number of different passes that frames begin (without
    frames, of render passes), by their sample count. `multisampled_images` counts images created
    alike once. `dropped_frames` were not checked, because there are too many kinds of frame.
    `left_out` is what has nothing to do with multisampling and was not checked; empty if that is
    nothing.
    """

    program: str
    engine: str
    device: str
    frames: int
    kinds: int
    passes: Mapping[int, int]
    multisampled_images: int
    dropped_frames: int
    left_out: str = ""
    multisampled_pipelines: int = 0


class InputSummary(NamedTuple):
    """What of one input was checked.

    `format` is its `--input-format`; empty if it could not be read. Objects that several documents
    of the input share count once; `shaders` are those of source code that read samples, `choices`
    the sample count choices. `failed` says that an error kept a document of it from being checked.
    `capture` is None for an input that is not a capture. `frames` is the number of documents of a
    description, each of which is a frame; None for other inputs. `device` is the profile that it
    was checked for; empty without one.
    """

    file: str
    format: str = ""
    images: int = 0
    passes: int = 0
    pipelines: int = 0
    shaders: int = 0
    choices: int = 0
    failed: bool = False
    unread: Unread | None = None
    capture: CaptureSummary | None = None
    frames: int | None = None
    device: str = ""


class PassTraffic(NamedTuple):
    """What one pass of a frame, or one command outside of passes, moves and keeps in memory, as the
    cost model estimates it.

    `frame` is the index of the frame's document in its input, `path` the structural path of the
    pass, `kind` `renderPass`, `rendering`, or `command`. `times` is how often a frame begins it;
    `samples` are the most that an attachment has. MB is 10^6 bytes, MiB 2^20; the traffic is that
    of all times. `unknown` says what could not be counted.
    """

    file: str
    frame: int
    name: str
    path: str
    kind: str
    width: int | None
    height: int | None
    times: int
    samples: int | None
    read_mb_per_s: float
    write_mb_per_s: float
    memory_mib: float
    milliwatts: float
    unknown: str


class RuleInfo(NamedTuple):
    """A rule as reports describe it. `summary` is one sentence, `markdown` the page without its
    front matter.
    """

    code: str
    name: str
    severity: str
    confidence: str
    summary: str
    markdown: str = ""
    references: tuple[str, ...] = ()
    fixable: bool = False


class Result(NamedTuple):
    """The result of a lint run. Findings are sorted by file, location and code; `rules` are the
    enabled rules by code.

    `savings` are those of each file with findings that have fixes, if the run determined them.
    `has_baseline` is whether the findings were compared with a baseline. `inputs` says what of each
    file was checked. `untried` are the files that are too large to try their fixes, each with
    whether it has to be converted first. `rendered` takes the place of findings, undecided rules,
    inputs, and sources in a report that is rendered input by input.
    """

    findings: Sequence[Finding]
    undecided: Sequence[Undecided]
    suppressed: Sequence[Suppressed]
    files: Sequence[str]
    sources: Mapping[str, "Source"]
    rules: Sequence[RuleInfo]
    savings: Mapping[str, Savings] = {}
    has_baseline: bool = False
    inputs: Sequence[InputSummary] = ()
    untried: Mapping[str, bool] = {}
    rendered: RenderedReport | None = None


def is_confident(finding: Finding, confidence: str) -> bool:
    """Whether the confidence of a finding is at least `confidence`."""
    return CONFIDENCES.index(finding.confidence) >= CONFIDENCES.index(confidence)


def rank(severity: str) -> int:
    """0 for note, 1 for warning, 2 for error."""
    return SEVERITIES.index(severity)

"""Documents times rules: one input read, judged, and its suppressions applied."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding, Price, RuleInfo, Suppressed, Undecided
from msaa_lint.core.text.source import Source, Unreadable, decode
from msaa_lint.core.text.tree import Limits, Node, parse
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.records import ShaderStage
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.profiles import Problem as Unknown
from msaa_lint.frame.profiles import device_for

from .rules.registry import Registry
from .rules.rule_file import Rule
from .rules.rule_runner import FixSpecs, RuleRunner, Verdicts

if TYPE_CHECKING:
    from msaa_lint.core.text.comments import Comment
    from msaa_lint.frame.facts.frame import Frame
    from msaa_lint.frame.facts.study import Studied
    from msaa_lint.frame.spirv.reflect import Reflected
    from msaa_lint.input.capture_input import CaptureInput
    from msaa_lint.input.shader_modules import Modules
    from msaa_lint.input.source_file import SourceFile

Severity = Callable[[Rule, str, str | None], str | None]

CombinedPrice = Callable[[Sequence[Finding]], Price | None]
"""What some findings of an input cost together."""


WITHOUT_LIMITS = Limits(depth=100, nodes=1 << 40, bytes=1 << 40)
"""For a text that is our own."""


class DocumentResult(NamedTuple):
    """A document of an input, the fixes of its findings, which document of a stream it is, and the device that it was judged for."""

    document: Document
    mends: FixSpecs
    number: int = 0
    device: DeviceProfile | None = None


class FileResult(NamedTuple):
    """What one input gave. `source` is None where it could not be decoded, `together` where no finding has a price; `code` says that it is
    source code, which is not fixed."""

    file: str
    source: Source | None
    findings: list[Finding]
    undecided: list[Undecided]
    suppressed: list[Suppressed]
    together: CombinedPrice | None = None
    judged: Sequence[DocumentResult] = ()
    code: bool = False


class Engine:
    """Rules made ready once, for any number of inputs."""

    def __init__(self, catalogue: Registry) -> None:
        self.catalogue = catalogue
        self.judge = RuleRunner(catalogue.rules)

    def lint(
        self,
        data: bytes | CaptureInput | SourceFile,
        file: str,
        severity: Severity,
        *,
        limits: Limits | None = None,
        format: str | None = None,
        device: DeviceProfile | None = None,
        ignores: bool = True,
        prices: bool = False,
    ) -> FileResult:
        """The findings of one input, in the order of their places: the bytes of a file, or a capture or source code that was read.

        `format` names a reader where content does not tell; `device` the profile for descriptions that state none; `ignores` says whether
        suppression comments count; `prices` whether findings are priced.
        """
        capture: CaptureInput | None = None
        if not isinstance(data, bytes):
            from msaa_lint.input.source_file import SourceFile, linted

            if isinstance(data, SourceFile):
                return linted(self, data, file, severity, device, ignores, prices)
            capture = data
        if capture is not None:
            # The limits are for what people write; a capture's own text is as long as what it was made of is varied.
            source, limits, format, ignores = capture.source, WITHOUT_LIMITS, None, False
        else:
            assert isinstance(data, bytes)
            try:
                source = Source(file, decode(data))
            except Unreadable as error:
                return FileResult(file, None, [diagnostic("MSAA901", str(error), file)], [], [])
        parsed = parse(source, limits or Limits())
        findings = [diagnostic(p.code, p.message, file, p.span, "", tuple(p.labels)) for p in parsed.problems]
        undecided: list[Undecided] = []
        judged: list[DocumentResult] = []
        if not parsed.documents and not parsed.problems:
            findings.append(diagnostic("MSAA901", "the input is empty", file))
        for number, root in enumerate(parsed.documents):
            document = _document(source, root, format)
            if capture is not None:
                document = _of_capture(document, capture, device)
            prefix = f"documents[{number}]." if len(parsed.documents) > 1 else ""
            (found, unknown, mends), own = self.of_document(document, file, severity, device, bool(parsed.problems))
            findings.extend(_within(found, prefix))
            undecided.extend(u._replace(subject=prefix + u.subject) for u in unknown)
            judged.append(DocumentResult(document, mends, number, own))
        suppressed: list[Suppressed] = []
        if ignores and "msaa-lint" in source.text.lower():
            from msaa_lint.core.text.comments import comments

            said = comments(source, parsed.documents)
            findings, suppressed = self.suppress(findings, said, source, severity, {u.rule for u in undecided})
        findings.sort(key=place_order)
        together = None
        mended = [each for each in judged if each.mends]
        if mended:
            findings, together = _mended(source, mended, findings, prices, format)
        if capture is not None:
            from msaa_lint.input.capture_input import of_capture

            findings = of_capture(capture, findings)
        return FileResult(file, source, findings, undecided, suppressed, together, judged)

    def of_document(
        self, document: Document, file: str, severity: Severity, device: DeviceProfile | None, broken: bool = False
    ) -> tuple[Verdicts, DeviceProfile | None]:
        """A document's own mistakes; where it has none, what the rules say, and the device they judge for.

        What was misread is not judged.
        """
        if document.problems or broken:
            found = [diagnostic(p.code, p.message, file, p.span, p.path, p.labels, p.help) for p in document.problems]
            return Verdicts(found, [], {}), None
        from msaa_lint.frame.facts.subjects import subjects

        own = device_for(document.description, file, device)
        if isinstance(own, Unknown):
            at = document.description.place("device")
            return Verdicts([diagnostic(own.code, own.message, file, at, "device", help=own.help)], [], {}), None

        def study(frame: Frame) -> Studied:
            # Where a count is above what devices do efficiently; nothing of it is loaded otherwise.
            from .study_record import studied

            return studied(frame, file)

        modules: list[Modules] = []

        def shader(stage: ShaderStage, alpha: bool) -> Reflected | None:
            # Where a rule may ask for a shader; nothing of it is loaded otherwise.
            from msaa_lint.input.shader_modules import Modules

            if not modules:
                modules.append(Modules(document, file))
            return modules[0].reflected(stage, alpha)

        verdicts = self.judge.judge(subjects(document, own, study, shader), file, severity, document.api)
        verdicts.findings.extend(found for each in modules for found in each.findings)
        return verdicts, own

    def suppress(
        self,
        findings: Sequence[Finding],
        comments: Sequence[Comment],
        source: Source,
        severity: Severity,
        undecided: set[str],
        alone: Collection[int] | None = None,
    ) -> tuple[list[Finding], list[Suppressed]]:
        """The findings that comments leave, what is wrong with the comments, and the findings that they silence.

        Of a rule that is off, or that stayed undecided, nothing can be said of a suppression being unused.
        """
        from .suppress.suppressions import apply

        enabled = {rule.name for rule in self.catalogue.rules if severity(rule, rule.severity, None) is not None} - undecided
        kept, suppressed, extra = apply(findings, comments, source, self.catalogue.rules, enabled, alone)
        return [*kept, *extra], suppressed


def _mended(
    source: Source, judged: Sequence[DocumentResult], findings: list[Finding], prices: bool, format: str | None
) -> tuple[list[Finding], CombinedPrice | None]:
    """The findings with the edits of their fixes, and their prices where asked for; then also what works out prices of several together."""
    from .fixes.document_fixes import DocumentFixes

    offers = [DocumentFixes(source, each, format) for each in judged]
    together: CombinedPrice | None = None
    if prices:
        from .prices import priced

        findings, together = priced(offers, findings)
    for each in offers:
        findings = each.with_edits(findings)
    return findings, together


def _of_capture(document: Document, capture: CaptureInput, device: DeviceProfile | None) -> Document:
    """The document with the shaders that the capture holds. A device that is asked for stands in for the one that was captured on."""
    if device is not None:
        document.description.device = None
    return document._replace(modules=capture.modules)


def _document(source: Source, root: Node, format: str | None) -> Document:
    from msaa_lint.input import readers

    return readers.read(source, root, format)


def _within(findings: list[Finding], prefix: str) -> list[Finding]:
    return [found._replace(subject=prefix + found.subject) for found in findings] if prefix else findings


def place_order(found: Finding) -> tuple[int, int, str, str]:
    """Findings of one file by their place, then by code."""
    span = found.span
    return (span.start, span.end, found.code, found.message) if span is not None else (-1, -1, found.code, found.message)


def rule_infos(catalogue: Registry, severity: Severity, full: bool) -> list[RuleInfo]:
    """What reports say of the enabled rules, by code."""
    from .rules.registry import info

    out = []
    for rule in catalogue.rules:
        weight = severity(rule, rule.severity, None)
        if weight is not None:
            out.append(info(rule, weight, full))
    return out

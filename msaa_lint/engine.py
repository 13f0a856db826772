"""Documents times rules: one input read, judged, and its suppressions applied."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING, NamedTuple

from .catalogue import Catalogue
from .devices import DeviceProfile
from .diagnostics import diagnostic
from .document.document import Document
from .document.records import ShaderStage
from .finding import Finding, Price, RuleInfo, Suppressed, Undecided
from .judge import Judge, Mends, Verdicts
from .page import Rule
from .profiles import Problem as Unknown
from .profiles import device_for
from .source.text import Source, Unreadable, decode
from .source.tree import Limits, Node, parse

if TYPE_CHECKING:
    from .captured import Captured
    from .facts.frame import Frame
    from .facts.study import Studied
    from .modules import Modules
    from .programmed import Programmed
    from .source.comments import Comment
    from .spirv.reflect import Reflected

Severity = Callable[[Rule, str, str | None], str | None]

Together = Callable[[Sequence[Finding]], Price | None]
"""What some findings of an input cost together."""


WITHOUT_LIMITS = Limits(depth=100, nodes=1 << 40, bytes=1 << 40)
"""For a text that is our own."""


class Judged(NamedTuple):
    """A document of an input, the fixes of its findings, which document of a stream it is, and the device that it was judged for."""

    document: Document
    mends: Mends
    number: int = 0
    device: DeviceProfile | None = None


class Linted(NamedTuple):
    """What one input gave. `source` is None where it could not be decoded, `together` where no finding has a price; `code` says that it is
    source code, which is not fixed."""

    file: str
    source: Source | None
    findings: list[Finding]
    undecided: list[Undecided]
    suppressed: list[Suppressed]
    together: Together | None = None
    judged: Sequence[Judged] = ()
    code: bool = False


class Engine:
    """Rules made ready once, for any number of inputs."""

    def __init__(self, catalogue: Catalogue) -> None:
        self.catalogue = catalogue
        self.judge = Judge(catalogue.rules)

    def lint(
        self,
        data: bytes | Captured | Programmed,
        file: str,
        severity: Severity,
        *,
        limits: Limits | None = None,
        format: str | None = None,
        device: DeviceProfile | None = None,
        ignores: bool = True,
        prices: bool = False,
    ) -> Linted:
        """The findings of one input, in the order of their places: the bytes of a file, or a capture or source code that was read.

        `format` names a reader where content does not tell; `device` the profile for descriptions that state none; `ignores` says whether
        suppression comments count; `prices` whether findings are priced.
        """
        capture: Captured | None = None
        if not isinstance(data, bytes):
            from .programmed import Programmed, linted

            if isinstance(data, Programmed):
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
                return Linted(file, None, [diagnostic("MSAA901", str(error), file)], [], [])
        parsed = parse(source, limits or Limits())
        findings = [diagnostic(p.code, p.message, file, p.span, "", tuple(p.labels)) for p in parsed.problems]
        undecided: list[Undecided] = []
        judged: list[Judged] = []
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
            judged.append(Judged(document, mends, number, own))
        suppressed: list[Suppressed] = []
        if ignores and "msaa-lint" in source.text.lower():
            from .source.comments import comments

            said = comments(source, parsed.documents)
            findings, suppressed = self.suppress(findings, said, source, severity, {u.rule for u in undecided})
        findings.sort(key=place_order)
        together = None
        mended = [each for each in judged if each.mends]
        if mended:
            findings, together = _mended(source, mended, findings, prices, format)
        if capture is not None:
            from .captured import of_capture

            findings = of_capture(capture, findings)
        return Linted(file, source, findings, undecided, suppressed, together, judged)

    def of_document(
        self, document: Document, file: str, severity: Severity, device: DeviceProfile | None, broken: bool = False
    ) -> tuple[Verdicts, DeviceProfile | None]:
        """A document's own mistakes; where it has none, what the rules say, and the device they judge for.

        What was misread is not judged.
        """
        if document.problems or broken:
            found = [diagnostic(p.code, p.message, file, p.span, p.path, p.labels, p.help) for p in document.problems]
            return Verdicts(found, [], {}), None
        from .facts.subjects import subjects

        own = device_for(document.description, file, device)
        if isinstance(own, Unknown):
            at = document.description.place("device")
            return Verdicts([diagnostic(own.code, own.message, file, at, "device", help=own.help)], [], {}), None

        def study(frame: Frame) -> Studied:
            # Where a count is above what devices do efficiently; nothing of it is loaded otherwise.
            from .studied import studied

            return studied(frame, file)

        modules: list[Modules] = []

        def shader(stage: ShaderStage, alpha: bool) -> Reflected | None:
            # Where a rule may ask for a shader; nothing of it is loaded otherwise.
            from .modules import Modules

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
        from .suppressions import apply

        enabled = {rule.name for rule in self.catalogue.rules if severity(rule, rule.severity, None) is not None} - undecided
        kept, suppressed, extra = apply(findings, comments, source, self.catalogue.rules, enabled, alone)
        return [*kept, *extra], suppressed


def _mended(
    source: Source, judged: Sequence[Judged], findings: list[Finding], prices: bool, format: str | None
) -> tuple[list[Finding], Together | None]:
    """The findings with the edits of their fixes, and their prices where asked for; then also what works out prices of several together."""
    from .fixes.offers import Offers

    offers = [Offers(source, each, format) for each in judged]
    together: Together | None = None
    if prices:
        from .price import priced

        findings, together = priced(offers, findings)
    for each in offers:
        findings = each.with_edits(findings)
    return findings, together


def _of_capture(document: Document, capture: Captured, device: DeviceProfile | None) -> Document:
    """The document with the shaders that the capture holds. A device that is asked for stands in for the one that was captured on."""
    if device is not None:
        document.description.device = None
    return document._replace(modules=capture.modules)


def _document(source: Source, root: Node, format: str | None) -> Document:
    from . import readers

    return readers.read(source, root, format)


def _within(findings: list[Finding], prefix: str) -> list[Finding]:
    return [found._replace(subject=prefix + found.subject) for found in findings] if prefix else findings


def place_order(found: Finding) -> tuple[int, int, str, str]:
    """Findings of one file by their place, then by code."""
    span = found.span
    return (span.start, span.end, found.code, found.message) if span is not None else (-1, -1, found.code, found.message)


def rule_infos(catalogue: Catalogue, severity: Severity, full: bool) -> list[RuleInfo]:
    """What reports say of the enabled rules, by code."""
    from .catalogue import info

    out = []
    for rule in catalogue.rules:
        weight = severity(rule, rule.severity, None)
        if weight is not None:
            out.append(info(rule, weight, full))
    return out

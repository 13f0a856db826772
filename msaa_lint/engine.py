"""Documents times rules: one input read, judged, and its suppressions applied."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

from .catalogue import Catalogue
from .devices import DeviceProfile
from .diagnostics import diagnostic
from .document.document import Document
from .finding import Finding, Price, RuleInfo, Suppressed, Undecided
from .judge import Judge, Mends, Verdicts
from .page import Rule
from .profiles import Problem as Unknown
from .profiles import device_for
from .source.text import Source, Unreadable, decode
from .source.tree import Limits, Node, parse

if TYPE_CHECKING:
    from .facts.frame import Frame
    from .facts.study import Studied

Severity = Callable[[Rule, str, str | None], str | None]

Together = Callable[[Sequence[Finding]], Price | None]
"""What some findings of an input cost together."""


class Judged(NamedTuple):
    """A document of an input, the fixes of its findings, which document of a stream it is, and the device that it was judged for."""

    document: Document
    mends: Mends
    number: int = 0
    device: DeviceProfile | None = None


class Linted(NamedTuple):
    """What one input gave. `source` is None where it could not be decoded, `together` where no finding has a price."""

    file: str
    source: Source | None
    findings: list[Finding]
    undecided: list[Undecided]
    suppressed: list[Suppressed]
    together: Together | None = None
    judged: Sequence[Judged] = ()


class Engine:
    """Rules made ready once, for any number of inputs."""

    def __init__(self, catalogue: Catalogue) -> None:
        self.catalogue = catalogue
        self.judge = Judge(catalogue.rules)

    def lint(
        self,
        data: bytes,
        file: str,
        severity: Severity,
        *,
        limits: Limits | None = None,
        format: str | None = None,
        device: DeviceProfile | None = None,
        ignores: bool = True,
        prices: bool = False,
    ) -> Linted:
        """The findings of one input, in the order of their places.

        `format` names a reader where content does not tell; `device` the profile for descriptions that state none; `ignores` says whether
        suppression comments count; `prices` whether findings are priced.
        """
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
            prefix = f"documents[{number}]." if len(parsed.documents) > 1 else ""
            (found, unknown, mends), own = self._judge(document, file, severity, device, bool(parsed.problems))
            findings.extend(_within(found, prefix))
            undecided.extend(u._replace(subject=prefix + u.subject) for u in unknown)
            judged.append(Judged(document, mends, number, own))
        suppressed: list[Suppressed] = []
        if ignores and "msaa-lint" in source.text.lower():
            findings, suppressed = self._suppress(findings, source, parsed.documents, severity, {u.rule for u in undecided})
        findings.sort(key=place_order)
        together = None
        mended = [each for each in judged if each.mends]
        if mended:
            findings, together = _mended(source, mended, findings, prices, format)
        return Linted(file, source, findings, undecided, suppressed, together, judged)

    def _judge(
        self, document: Document, file: str, severity: Severity, device: DeviceProfile | None, broken: bool
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

        return self.judge.judge(subjects(document, own, study), file, severity), own

    def _suppress(
        self, findings: Sequence[Finding], source: Source, documents: Sequence[Node], severity: Severity, undecided: set[str]
    ) -> tuple[list[Finding], list[Suppressed]]:
        """Of a rule that is off, or that stayed undecided, nothing can be said of a suppression being unused."""
        from .source.comments import comments
        from .suppressions import apply

        enabled = {rule.name for rule in self.catalogue.rules if severity(rule, rule.severity, None) is not None} - undecided
        kept, suppressed, extra = apply(findings, comments(source, documents), source, self.catalogue.rules, enabled)
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

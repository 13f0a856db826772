"""Source code read as documents, and the findings of it.

What code does cannot be known from its text alone: its findings are of low confidence, have no edits, and what stays undecided is not told.
"""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.finding import CONFIDENCES, Finding, Suppressed
from msaa_lint.core.text.source import Source, Unreadable, decode

from . import code as programs

if TYPE_CHECKING:
    from msaa_lint.frame.devices import DeviceProfile
    from msaa_lint.linter.engine import CombinedPrice, Engine, FileResult, Severity


class SourceFile(NamedTuple):
    """Source code and what it is read as. `data` are its bytes, `language` is one of `programs.LANGUAGES`; `notes` are lines for people."""

    data: bytes
    source: Source
    language: str
    program: programs.Program
    notes: tuple[str, ...] = ()


def programmed(data: bytes, name: str, language: str) -> SourceFile:
    """Reads source code. Nothing raises for what it says, nor for bytes that are no text; Unreadable where there is more of it than is
    parsed, `programs.parsing.Missing` where the extra is not installed."""
    try:
        text = decode(data)
    except Unreadable:
        # Names of people in comments, mostly.
        text = data.decode("utf-8", "replace")
    source = Source(name, text)
    return SourceFile(data, source, language, programs.read(source, language))


def linted(
    engine: "Engine",
    code: SourceFile,
    file: str,
    severity: "Severity",
    device: "DeviceProfile | None",
    ignores: bool,
    prices: bool,
) -> "FileResult":
    """The findings of source code. `ignores` says whether its comments silence any, `prices` whether they are priced."""
    from msaa_lint.linter.engine import DocumentResult, FileResult, place_order

    source, program = code.source, code.program
    findings: list[Finding] = []
    undecided: set[str] = set()
    judged: list[DocumentResult] = []
    for number, document in enumerate(program.documents):
        (found, unknown, mends), own = engine.of_document(document, file, severity, device)
        prefix = f"documents[{number}]." if len(program.documents) > 1 else ""
        notes = program.assumed[number]
        findings += (each._replace(subject=prefix + each.subject, notes=(*each.notes, *notes)) for each in found if not each.fatal)
        undecided.update(each.rule for each in unknown)
        judged.append(DocumentResult(document, mends, number, own))
    findings = _distinct(findings)
    suppressed: list[Suppressed] = []
    if ignores and "msaa-lint" in source.text.lower():
        from .code.comments import comments

        said = comments(program.codes)
        findings, suppressed = engine.suppress(findings, said.comments, _visible(code), severity, undecided, said.alone)
    findings.sort(key=place_order)
    together: CombinedPrice | None = None
    mended = [each for each in judged if each.mends] if prices else []
    if mended:
        from msaa_lint.linter.fixes.document_fixes import DocumentFixes
        from msaa_lint.linter.prices import priced

        findings, together = priced([DocumentFixes(source, each, rewritten=False) for each in mended], findings)
    silenced = [each._replace(finding=_of_code(each.finding)) for each in suppressed]
    return FileResult(file, source, [_of_code(each) for each in findings], [], silenced, together, judged, True)


def _of_code(found: Finding) -> Finding:
    """A finding as it can be told of code."""
    fix = found.fix and found.fix._replace(edits=(), shown=True)
    return found._replace(confidence=CONFIDENCES[0], fix=fix)


def _distinct(findings: Iterable[Finding]) -> list[Finding]:
    """The first of findings that say the same at the same place: functions that share a structure are documents of their own."""
    kept: dict[object, Finding] = {}
    for found in findings:
        kept.setdefault((found.code, found.span, found.message), found)
    return list(kept.values())


def _visible(code: SourceFile) -> Source:
    """The text with nothing but its code."""
    texts = [each.text for each in code.program.codes]
    if len(texts) < 2:
        return Source(code.source.name, "".join(texts))
    lines = (_LINE.findall(text) for text in texts)
    return Source(code.source.name, "".join(map(_lines_of_one, zip(*lines, strict=True))))


_LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|\Z)")


def _lines_of_one(lines: Sequence[str]) -> str:
    """Of the same line in the codes of a page the one that is not blank."""
    return next((line for line in lines if line.strip()), lines[0])

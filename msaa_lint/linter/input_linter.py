"""Lints one input: reads its documents, runs the rules on them, applies suppression comments, and
attaches fixes and prices.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from msaa_lint.core.allowance import Allowance
from msaa_lint.core.diagnostics import DIAGNOSTICS, HIDDEN_CHARACTER, diagnostic
from msaa_lint.core.finding import CONFIDENCES, Finding, Suppressed, Undecided
from msaa_lint.core.hidden_characters import hidden_characters
from msaa_lint.core.text.source import Source, Unreadable, decode
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.core.text.tree import Problem as TextProblem
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import ShaderStage
from msaa_lint.frame.description.problems import Problem as DocumentProblem
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.profiles import Problem, device_for, replace_captured

from .code_confidence import Qualifier
from .code_files import code_only, hidden_in, in_file, in_order
from .lint_options import LintOptions
from .mistakes import one_per_mistake
from .programs import merge, merged, of_turns
from .results import DocumentResult, FileResult, location_order
from .rules.registry import Registry, built_in
from .rules.rule import Rule
from .rules.rule_runner import RuleRunner, Verdicts, distinct, finding_key
from .rules.rule_runner import Severity as RuleSeverity
from .run_limits import RunLimits
from .settings.selection import Severity

if TYPE_CHECKING:
    from msaa_lint.core.text.comments import Comment
    from msaa_lint.frame.facts.facts import Subject
    from msaa_lint.frame.facts.frame import Frame
    from msaa_lint.frame.facts.study import Studied
    from msaa_lint.frame.facts.subjects import FrameAnalysis
    from msaa_lint.frame.spirv.reflect import Reflected
    from msaa_lint.input.capture_input import CaptureInput
    from msaa_lint.input.shader_modules import Modules
    from msaa_lint.input.source_file import SourceFile

UNLIMITED = Limits(depth=100, nodes=1 << 40, bytes=1 << 40)
"""For text that msaa-lint itself wrote: the limits are for text that people write."""

MAX_UNDECODABLE = 200
"""Bytes that an excerpt shows from the first one that is not text."""

ResultType = TypeVar("ResultType", Finding, Undecided)

_COMMENT_MARKS = ("msaa-lint", "msaalint", "msaa_lint", "msaa lint")
"""What a suppression comment contains, in lower case, misspelled ones included."""


class _Analysis(NamedTuple):
    """A document, the device that it is linted for, what is known of its frame, and its shader
    modules once one of them is read.
    """

    document: Document
    device: DeviceProfile | None
    frame: FrameAnalysis
    modules: list[Modules]


@cache
def _built_in_runner() -> RuleRunner:
    """The runner of the built-in rules, which no budget limits: what it evaluates is the same in
    all runs of a process.
    """
    return RuleRunner(built_in().rules)


class InputLinter:
    """Lints inputs by the rules of a registry, which are compiled once.

    The `limits` are those of the run. Without them, it belongs to no run, and reads shaders anew
    for each document.
    """

    def __init__(self, registry: Registry, limits: RunLimits | None) -> None:
        self.registry = registry
        self._limits = limits
        self._runner = (
            _built_in_runner()
            if limits is not None and registry is built_in()
            else RuleRunner(registry.rules, (limits or RunLimits()).rules)
        )

    def lint(
        self, data: bytes | CaptureInput | SourceFile, file: str, options: LintOptions
    ) -> FileResult:
        """The findings of one input in order of location. `data` is a file's bytes, or a capture or
        source code already read.
        """
        if isinstance(data, bytes):
            try:
                source = Source(file, decode(data))
            except Unreadable as error:
                return _undecodable(data, file, error)
            return merged(self._lint_text(source, file, options))
        from msaa_lint.input.source_file import SourceFile

        if isinstance(data, SourceFile):
            return self._lint_code(data, file, options)
        from msaa_lint.input.capture_input import capture_problems, located_findings

        result = self.lint_description(data.source, file, options, data.modules)
        findings = merge(located_findings(data, result.findings), result.documents)
        return result._replace(findings=[*findings, *capture_problems(data)], description=result)

    def lint_description(
        self, source: Source, file: str, options: LintOptions, modules: Mapping[str, bytes]
    ) -> FileResult:
        """The findings of a description that msaa-lint wrote, of a capture or source code;
        `modules` are its shaders by name.
        """
        return self._lint_text(
            source, file, options._replace(limits=UNLIMITED, format=None, ignores=False), modules
        )

    def _lint_text(
        self,
        source: Source,
        file: str,
        options: LintOptions,
        modules: Mapping[str, bytes] | None = None,
    ) -> FileResult:
        """The findings of a text; `modules` are the shaders of a capture that the text was written
        from.
        """
        from msaa_lint.input import readers

        parsed = parse(source, options.limits)
        findings = [
            diagnostic(p.code, p.message, file, p.span, "", tuple(p.labels))
            for p in parsed.problems
        ]
        undecided: list[Undecided] = []
        results: list[DocumentResult] = []
        if not parsed.documents and not parsed.problems:
            findings.append(
                diagnostic(
                    "MSAA901", "the input is empty; it must contain a description", file, Span(0, 0)
                )
            )
        documents: list[Document] = []
        for root in parsed.documents:
            document = readers.read(source, root, options.format)
            if parsed.problems and document.problems:
                document = document._replace(problems=_apart(document.problems, parsed.problems))
            documents.append(document if modules is None else document._replace(modules=modules))
        frames = {} if parsed.problems else self._frames_of_program(documents, file, options)
        for number, document in enumerate(documents):
            prefix = f"documents[{number}]." if len(documents) > 1 else ""
            if number in frames:
                verdicts, device = self._verdicts(*frames.pop(number), file, options)
            else:
                verdicts, device = self.lint_document(
                    document, file, options, bool(parsed.problems)
                )
            findings.extend(_prefixed(verdicts.findings, prefix))
            undecided.extend(_prefixed(verdicts.undecided, prefix))
            results.append(
                DocumentResult(
                    document.rest or document, verdicts.fix_specs, number, device, verdicts.checked
                )
            )
        if modules is None:
            findings += _untold(hidden_characters(source), findings)
        suppressed: list[Suppressed] = []
        if options.ignores and _has_suppressions(source.text):
            from msaa_lint.core.text.comments import comments

            findings, suppressed = self._suppress(
                findings,
                comments(source, parsed.documents),
                source,
                options.severity,
                {rule.rule for rule in undecided},
            )
        findings.sort(key=location_order)
        findings = _with_fixes(results, findings, options)
        return FileResult(file, source, findings, undecided, suppressed, results)

    def _lint_code(self, code: SourceFile, file: str, options: LintOptions) -> FileResult:
        """The findings of source code.

        Its text alone does not determine what it does: confidence is low or medium, fixes have no
        edits, and undecided rules are not reported.
        """
        program = code.program
        findings: list[Finding] = []
        undecided: set[str] = set()
        results: list[DocumentResult] = []
        for number, document in enumerate(program.documents):
            verdicts, device = self.lint_document(document, file, options)
            prefix = f"documents[{number}]." if len(program.documents) > 1 else ""
            notes = program.assumed[number]
            usable = (
                found._replace(notes=(*found.notes, *notes))
                if found.confidence == CONFIDENCES[0]
                else found
                for found in verdicts.findings
                if not found.fatal
            )
            findings.extend(_prefixed(usable, prefix))
            undecided.update(rule.rule for rule in verdicts.undecided)
            results.append(
                DocumentResult(document, verdicts.fix_specs, number, device, verdicts.checked)
            )
        # Functions that share a structure are separate documents with the same finding.
        in_program, suppressed = self._by_file(
            code, distinct(findings), results, options, undecided
        )
        if options.prices:
            own = [found for _, found in in_program if found is not None]
            priced = iter(_with_fixes(results, own, options, editable=False))
            in_program = [
                (in_file(code, next(priced))[1], found) if found is not None else (each, None)
                for each, found in in_program
            ]
        limits = [
            in_file(code, diagnostic("MSAA906", part.message, file, part.at))[1]
            for part in program.unread
        ]
        limits += [
            in_file(code, diagnostic(remark.code, remark.message, file, remark.at))[1]
            for remark in program.remarks
        ]
        suppressed = [each._replace(finding=_of_code(each.finding)) for each in suppressed]
        findings = in_order(code, [*(_of_code(found) for found, _ in in_program), *limits])
        sources = {part.source.name: part.source for part in code.files}
        return FileResult(
            file, code.source, findings, [], suppressed, results, True, sources=sources
        )

    def _by_file(
        self,
        code: SourceFile,
        findings: Sequence[Finding],
        results: Sequence[DocumentResult],
        options: LintOptions,
        undecided: Collection[str],
    ) -> tuple[list[tuple[Finding, Finding | None]], list[Suppressed]]:
        """The findings of a program that are not suppressed where they lie, one for each mistake,
        and the suppressed findings.

        With each of them is the finding whose places are in the program's text, None if it is about
        the file.
        """
        by_file: dict[int, list[tuple[Finding, Finding]]] = {}
        for found in findings:
            part, located = in_file(code, found)
            by_file.setdefault(part.start, []).append((located, found))
        remaining: list[tuple[Finding, Finding | None]] = []
        suppressed: list[Suppressed] = []
        for part in code.files:
            if not part.is_input:
                continue
            severity = (
                options.severity
                if options.severity_in is None
                else options.severity_in(part.source.name)
            )
            disabled = {
                rule.code
                for rule in self.registry.rules
                if severity(rule, rule.severity, None) is None
            }
            enabled = [
                found
                for located, found in by_file.get(part.start, [])
                if located.code not in disabled
            ]
            merged = one_per_mistake(enabled, results, self._place_of)
            pairs = [(in_file(code, found)[1], found) for found in merged]
            covered = {found.rule for found in enabled} - {found.rule for found in merged}
            every = [*(located for located, _ in pairs), *hidden_in(part)]
            if options.ignores and _has_suppressions(part.source.text):
                from msaa_lint.input.code.comments import comments

                found_comments = comments(part.codes)
                every, hidden = self._suppress(
                    every,
                    found_comments.comments,
                    code_only(part),
                    severity,
                    {*undecided, *covered},
                    found_comments.alone,
                )
                suppressed += hidden
            origins = {id(located): found for located, found in pairs}
            remaining += [(each, origins.get(id(each))) for each in every]
        return remaining, suppressed

    def _place_of(self, code: str) -> str:
        """The fact at whose place a rule reports; empty if there is none."""
        rule = next((rule for rule in self.registry.rules if rule.code == code), None)
        return next(iter(rule.at), "") if rule is not None else ""

    def lint_document(
        self, document: Document, file: str, options: LintOptions, broken: bool = False
    ) -> tuple[Verdicts, DeviceProfile | None]:
        """The verdicts on one document, and the device they are for.

        No rule runs on a document with problems of its own, or on one from a `broken` text.
        """
        if document.problems or broken:
            problems = [
                diagnostic(p.code, p.message, file, p.span, p.path, p.labels, p.help)
                for p in document.problems
            ]
            if broken or document.rest is None:
                return Verdicts(problems, [], {}, False), None
            verdicts, device = self.lint_document(
                document.rest._replace(problems=()), file, options
            )
            verdicts = _without_fixes(verdicts)
            return verdicts._replace(findings=[*problems, *verdicts.findings], undecided=[]), device
        analysis = self._analysis(document, file, options)
        if isinstance(analysis, Problem):
            span = document.description.place("device")
            message = f"{analysis.message}; {analysis.help}" if analysis.help else analysis.message
            return Verdicts(
                [diagnostic(analysis.code, message, file, span, "device")], [], {}, False
            ), None
        return self._verdicts(analysis, analysis.frame.subjects(), file, options)

    def _frames_of_program(
        self, documents: Sequence[Document], file: str, options: LintOptions
    ) -> dict[int, tuple[_Analysis, list[Subject]]]:
        """The analyses and subjects of documents, by number, that are the kinds of frame of one
        program; none if there is only one.
        """
        numbers = [
            number for number, document in enumerate(documents) if document.is_frame_of_program
        ]
        if len(numbers) < 2:
            return {}
        from msaa_lint.frame.facts.program import join

        analyses = {number: self._analysis(documents[number], file, options) for number in numbers}
        valid = {
            number: analysis
            for number, analysis in analyses.items()
            if not isinstance(analysis, Problem)
        }
        subjects = join([analysis.frame for analysis in valid.values()])
        return {
            number: (analysis, own)
            for (number, analysis), own in zip(valid.items(), subjects, strict=True)
        }

    def _analysis(self, document: Document, file: str, options: LintOptions) -> _Analysis | Problem:
        """What is known of a document's frame, or the problem of its device."""
        from msaa_lint.frame.facts.frame import Frame
        from msaa_lint.frame.facts.global_facts import profile
        from msaa_lint.frame.facts.subjects import FrameAnalysis

        replace_captured(document.description, options.device)
        device = device_for(document.description, file, options.device)
        if isinstance(device, Problem):
            return device

        # Both are imported only if a rule asks: for a sample count above what devices do
        # efficiently, and for a shader.
        def study(frame: Frame) -> Studied:
            from .study_record import studied

            return studied(frame, file)

        modules: list[Modules] = []

        def shader(stage: ShaderStage, alpha: bool) -> Reflected | None:
            from msaa_lint.input.shader_modules import Modules

            if not modules:
                modules.append(
                    Modules(document, file, self._limits.shaders if self._limits else None)
                )
            return modules[0].reflected(stage, alpha)

        return _Analysis(
            document,
            device,
            FrameAnalysis(Frame(document), profile(document.description, device), study, shader),
            modules,
        )

    def _verdicts(
        self, analysis: _Analysis, subjects: Iterable[Subject], file: str, options: LintOptions
    ) -> tuple[Verdicts, DeviceProfile | None]:
        """The verdicts on the subjects of a document, and the device they are for."""
        from msaa_lint.frame.facts.missing_keys import MissingKeys

        document, device, frame, modules = analysis
        # Nobody writes keys into source code.
        missing_keys = MissingKeys(frame).of if document.whole or document.format else None
        qualify = (
            Qualifier(document, frame.bindings.attachments)
            if document.tree is not None and not document.format
            else None
        )
        severity = (
            options.severity
            if document.complete
            else _of_parts(options.severity, self.registry.rules)
        )
        verdicts = self._runner.run(
            subjects,
            file,
            severity,
            document.api,
            missing_keys,
            options.all_keys,
            options.keys or Allowance(0),
            qualify,
        )
        if document.has_unread_structures:
            verdicts = _without_safe_fixes(verdicts)
        verdicts = of_turns(verdicts, frame.turns.of.values()) if verdicts.findings else verdicts
        at = document.description.place("commands", "renderPasses")
        verdicts.findings.extend(
            diagnostic("MSAA906", f"limit exceeded: {text}", file, at) for text in frame.limits()
        )
        for loaded in modules:
            verdicts.findings.extend(loaded.findings)
        return verdicts, device

    def _suppress(
        self,
        findings: Sequence[Finding],
        comments: Sequence[Comment],
        source: Source,
        severity: Severity,
        undecided: Collection[str],
        comment_lines: Collection[int] | None = None,
    ) -> tuple[list[Finding], list[Suppressed]]:
        """The findings that remain, with those about the comments, and the suppressed findings.

        A suppression of a rule that is off, undecided or over budget is not reported as unused.
        """
        from .suppress.suppressions import apply

        enabled = {DIAGNOSTICS[HIDDEN_CHARACTER].name}
        enabled |= {
            rule.name
            for rule in self.registry.rules
            if severity(rule, rule.severity, None) is not None
        }
        remaining, suppressed, about_comments = apply(
            findings,
            comments,
            source,
            self.registry.names,
            enabled.difference(undecided, self._runner.turned_off()),
            comment_lines,
        )
        return [*remaining, *about_comments], suppressed


def _of_parts(severity: Severity, rules: Iterable[Rule]) -> RuleSeverity:
    """The severities in a frame that was not wholly read: rules that ask for facts of the whole
    frame are off, and what they supersede.
    """
    from msaa_lint.frame.facts.table_keys import OF_THE_FRAME

    from .rules.condition import named

    off: set[str] = set()
    for rule in rules:
        conditions = (rule.when, *(case.when for case in rule.cases))
        if any(not OF_THE_FRAME.isdisjoint(named(condition)) for condition in conditions):
            off |= {rule.name, *rule.supersedes}
    return lambda rule, suggested, vendor: (
        None if rule.name in off else severity(rule, suggested, vendor)
    )


def _without_safe_fixes(verdicts: Verdicts) -> Verdicts:
    """The verdicts on a document that was not wholly read: no fix is safe, as what was not read may
    use what a fix takes away.
    """
    findings = [
        found._replace(fix=found.fix._replace(safe=False)) if found.fix else found
        for found in verdicts.findings
    ]
    specs = {
        key: [
            (spec._replace(safety="unsafe") if spec.safe else spec, subject)
            for spec, subject in fixes
        ]
        for key, fixes in verdicts.fix_specs.items()
    }
    return verdicts._replace(findings=findings, fix_specs=specs)


def _without_fixes(verdicts: Verdicts) -> Verdicts:
    """The verdicts on what could be read of a document with errors, whose fixes are only shown:
    none is made before the errors are gone.
    """
    findings = [
        found._replace(fix=found.fix._replace(safe=False, shown=True)) if found.fix else found
        for found in verdicts.findings
    ]
    specs = {
        key: [(spec._replace(safety="shown"), subject) for spec, subject in fixes]
        for key, fixes in verdicts.fix_specs.items()
    }
    return verdicts._replace(findings=findings, fix_specs=specs)


def _apart(
    problems: Sequence[DocumentProblem], others: Sequence[TextProblem]
) -> tuple[DocumentProblem, ...]:
    """The problems of a document at places of which its text has no problem."""
    spans = [other.span for other in others]
    return tuple(
        found
        for found in problems
        if not any(span.start <= found.span.start <= span.end for span in spans)
    )


def _undecodable(data: bytes, file: str, error: Unreadable) -> FileResult:
    """The result of an input that is not text: what stands before the invalid byte, if anything,
    gives the finding its place.
    """
    if error.before is None:
        return FileResult(file, None, [diagnostic("MSAA901", str(error), file)], [], [])
    at = len(error.before)
    text = error.before + data[error.offset : (error.offset or 0) + MAX_UNDECODABLE].decode(
        "cp1252", "replace"
    )
    return FileResult(
        file,
        Source(file, text),
        [diagnostic("MSAA901", str(error), file, Span(at, at + 1))],
        [],
        [],
    )


def _has_suppressions(text: str) -> bool:
    lowered = text.lower()
    return any(mark in lowered for mark in _COMMENT_MARKS)


def _with_fixes(
    results: Iterable[DocumentResult],
    findings: list[Finding],
    options: LintOptions,
    editable: bool = True,
) -> list[Finding]:
    """The findings with their prices if asked for and, if the text is `editable`, the edits of
    their fixes.
    """
    fixable = [result for result in results if result.fix_specs]
    if not fixable or not (options.prices or (editable and options.edits)):
        return findings
    from .fixes.document_fixes import DocumentFixes, documents_by_key

    fixes = [DocumentFixes(result, options.format, editable) for result in fixable]
    by_key = documents_by_key(fixable)
    if options.prices:
        from .prices import price_findings

        findings = price_findings(fixes, by_key, findings)
    if editable and options.edits:
        for index, finding in enumerate(findings):
            for number in by_key.get(finding_key(finding), ()):
                findings[index] = fixes[number].with_edits(findings[index])
    return findings


def _prefixed(results: Iterable[ResultType], prefix: str) -> Iterable[ResultType]:
    """Findings, or undecided rules, whose subjects' paths begin with the document's."""
    return (each._replace(subject=prefix + each.subject) for each in results) if prefix else results


def _of_code(finding: Finding) -> Finding:
    if finding.code == HIDDEN_CHARACTER:
        return finding
    fix = finding.fix and finding.fix._replace(edits=(), shown=True)
    # Code that is not understood may have the finding that a comment suppresses.
    return finding._replace(
        fix=fix, confidence=CONFIDENCES[0] if finding.code in DIAGNOSTICS else finding.confidence
    )


def _untold(hidden: Iterable[Finding], findings: Iterable[Finding]) -> list[Finding]:
    """The notes about hidden characters that no error about the same word names: an unknown key may
    have one.
    """
    told = [
        found.span
        for found in findings
        if found.span is not None and "invisible character U+" in found.message
    ]
    return [
        note
        for note in hidden
        if not any(note.span and span.start <= note.span.start < span.end for span in told)
    ]

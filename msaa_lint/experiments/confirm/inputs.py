"""The documents to confirm: found, read and judged as `check` does it, each with the version that the safe fixes make of it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding, Undecided
from msaa_lint.core.text.source import Unreadable
from msaa_lint.core.text.tree import Limits
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.frame import Frame, Pass
from msaa_lint.frame.facts.global_facts import profile
from msaa_lint.frame.profiles import device_of
from msaa_lint.input.discovery import STDIN, discover
from msaa_lint.input.opening import load, refused
from msaa_lint.input.readers import looks_like
from msaa_lint.input.source_file import SourceFile
from msaa_lint.linter.engine import LintOptions
from msaa_lint.linter.fixes.file_fixes import FixedText, fix_input
from msaa_lint.linter.results import DocumentResult, FileResult, Severity
from msaa_lint.linter.run import Request, ResolvedSettings, Run


class Input(NamedTuple):
    """One document: its frame as written and, where safe fixes change its text, as fixed.

    `findings` are those of the document, `silenced` those that a comment suppresses, `undecided` rules that could say nothing of it;
    `mended` are those that the fixes took away. `device` is the profile that it is judged for. `number` of `many` says which document of a
    stream it is. `by_vulkan` is, of a frame in Metal's words, what the rules for Vulkan say of the frame of the same meaning that is drawn:
    its findings, and what is undecided.
    """

    file: str
    frame: Frame
    findings: tuple[Finding, ...]
    silenced: tuple[Finding, ...] = ()
    fixed: Frame | None = None
    mended: tuple[Finding, ...] = ()
    undecided: tuple[Undecided, ...] = ()
    device: DeviceProfile | None = None
    number: int = 0
    many: int = 1
    by_vulkan: tuple[Sequence[Finding], Sequence[Undecided]] | None = None

    @property
    def prefix(self) -> str:
        """What the paths of a document of a stream begin with."""
        return f"documents[{self.number}]." if self.many > 1 else ""


class Inputs(NamedTuple):
    """What there is to confirm, findings that say why some of it cannot be, and lines for the standard error stream."""

    inputs: list[Input]
    wrong: list[Finding]
    notes: list[str]


def inputs(request: Request) -> Inputs:
    """The documents of a request, in the order of the files."""
    this = Run(request)
    this.governed(os.curdir)
    found = discover(request.paths, this.settings, looks_like)
    this.findings.extend(found.findings)
    made: list[Input] = []
    for path in found.files:
        made.extend(_of_file(this, path))
    wrong = [finding for finding in dict.fromkeys(this.findings) if finding.fatal]
    return Inputs(made, wrong, list(found.notes))


def _of_file(this: Run, path: str) -> list[Input]:
    request, stdin = this.request, path == STDIN
    name = (request.stdin_filename or "<stdin>") if stdin else path
    governed = this.governed(request.stdin_filename or os.curdir if stdin else path)
    limits = Limits(**{**Limits()._asdict(), **governed.settings.limits})
    try:
        loaded = load(path, limits, name, request.format, request.data)
    except (OSError, Unreadable) as error:
        this.findings.append(refused(error, name))
        return []
    if isinstance(loaded, SourceFile):
        what = "source code states too little to be drawn: `msaa-lint convert` writes what is read of it, to complete"
        this.findings.append(diagnostic("MSAA921", what, name))
        return []
    # Of a capture the description that it becomes is confirmed.
    data = loaded if isinstance(loaded, bytes) else loaded.source.text.encode()
    format = request.format if isinstance(loaded, bytes) else None
    if not isinstance(loaded, bytes) and loaded.broken:
        this.findings.append(diagnostic("MSAA901", f"the capture ends in the middle: {loaded.broken}", name))
    device = device_of(governed.settings.profile)
    severity = governed.selection.for_file(name, device.vendor if device is not None else None)

    options = LintOptions(severity, limits, format, device, request.ignores)

    def judge(data: bytes) -> FileResult:
        return governed.engine.lint(data, name, options)

    linted = judge(data)
    this.findings.extend(finding for finding in linted.findings if finding.fatal)
    if any(finding.fatal for finding in linted.findings) or linted.source is None:
        return []
    mended = fix_input(data, linted, judge, lambda _: True, False, None) if any(f.fix is not None for f in linted.findings) else None
    found = [_input(name, linted, judged, mended, governed, device) for judged in linted.documents]
    return [each if each.frame.document.metal is None else _as_vulkan(each, governed, severity) for each in found]


def _as_vulkan(input: Input, governed: ResolvedSettings, severity: Severity) -> Input:
    """The same with what Vulkan's rules say: it is Vulkan's layer that it is compared with."""
    document, metal = input.frame.document, input.frame.document.metal
    assert metal is not None
    of_vulkan = document._replace(metal=metal._replace(api="VULKAN"))
    verdicts, _ = governed.engine.lint_document(of_vulkan, input.file, LintOptions(severity, device=input.device))
    return input._replace(by_vulkan=(verdicts.findings, verdicts.undecided))


def _input(
    name: str,
    linted: FileResult,
    judged: DocumentResult,
    mended: FixedText | None,
    governed: ResolvedSettings,
    device: DeviceProfile | None,
) -> Input:
    many = len(linted.documents)
    made = Input(name, Frame(judged.document), (), number=judged.number, many=many)
    settled = [found for found in map(governed.selection.settle, linted.findings) if found is not None]
    return made._replace(
        findings=_own(settled, made.prefix),
        silenced=_own([each.finding for each in linted.suppressed], made.prefix),
        fixed=_fixed(judged.document, mended, judged.number),
        mended=_own(mended.fixed_findings if mended is not None else (), made.prefix),
        undecided=tuple(
            each._replace(subject=each.subject.removeprefix(made.prefix))
            for each in linted.undecided
            if each.subject.startswith(made.prefix)
        ),
        device=profile(judged.document.description, device),
    )


def _fixed(before: Document, mended: FixedText | None, number: int) -> Frame | None:
    """The frame of a document after the fixes; None where they leave that document as it is."""
    if mended is None or not mended.changed or number >= len(mended.result.documents):
        return None
    if not any(found.subject.startswith(f"documents[{number}].") for found in mended.fixed_findings) and len(mended.result.documents) > 1:
        return None
    return Frame(mended.result.documents[number].document)


def _own(findings: Sequence[Finding], prefix: str) -> tuple[Finding, ...]:
    """The findings of one document of a stream, their subjects without its number."""
    if not prefix:
        return tuple(findings)
    return tuple(f._replace(subject=f.subject.removeprefix(prefix)) for f in findings if f.subject.startswith(prefix))


def of_pass(frame: Frame, each: Pass, findings: Sequence[Finding]) -> list[Finding]:
    """The findings that have to do with a pass: of itself, of its images, framebuffers and pipelines, and of the commands about those.

    What is of no pass in particular is every pass's.
    """
    owners = _owners(frame)
    return [found for found in findings if owners.has(each, found.subject)]


class _Owners:
    """The passes of a frame that have to do with what is at a path."""

    def __init__(self, frame: Frame) -> None:
        self._by_path: dict[str, set[int]] = {}
        self._known: dict[str, frozenset[int]] = {}
        for each in frame.passes:
            for path in _paths(frame, each):
                self._by_path.setdefault(path, set()).add(id(each))

    def has(self, each: Pass, subject: str) -> bool:
        """Whether a path, or what it is within, is a pass's; what is of no pass is every pass's."""
        owners = self.of(subject)
        return not owners or id(each) in owners

    def of(self, path: str) -> frozenset[int]:
        """The passes of a path, by their identity."""
        if path not in self._known:
            cut = max(path.rfind("."), path.rfind("["))
            above = self.of(path[:cut]) if cut > 0 else frozenset()
            self._known[path] = above | self._by_path.get(path, set())
        return self._known[path]


@lru_cache(maxsize=4)
def _owners(frame: Frame) -> _Owners:
    return _Owners(frame)


def _paths(frame: Frame, each: Pass) -> set[str]:
    images = {target.name for attachment in each.attachments for target in attachment.targets if target.image is not None}
    for subpass in each.subpasses:
        images.update(r.target_image.name for r in subpass.resolves if r.target_image is not None and r.target_image.image is not None)
    paths = {each.path, *(frame.targets[name].path for name in images if name in frame.targets)}
    paths.update(pipeline.path for pipeline, of in frame.pipelines if of is each or of is None)
    paths.update(framebuffer.path for framebuffer in frame.framebuffers.get(each.name, ()))
    for position in each.begun:
        paths.add(frame.commands[position].path)
    for command in frame.commands:
        named = {getattr(command.body, member, None) for member in ("image", "srcImage", "dstImage")}
        if named & images:
            paths.add(command.path)
    return paths

"""The documents to confirm: found, read and linted as by `check`, each with its version after safe
fixes.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding, Undecided
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.commands import accesses
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.global_facts import profile
from msaa_lint.frame.facts.parts import Pass
from msaa_lint.frame.facts.program import subjects_of
from msaa_lint.frame.facts.subjects import FrameAnalysis
from msaa_lint.input.capture_input import limit_findings
from msaa_lint.input.source_file import SourceFile
from msaa_lint.linter.fixes.file_fixes import FixedText, fix_input
from msaa_lint.linter.input_file import InputFile
from msaa_lint.linter.input_linter import UNLIMITED
from msaa_lint.linter.request import Request
from msaa_lint.linter.results import DocumentResult, FileResult, unmerged
from msaa_lint.linter.workspace import Workspace


class Input(NamedTuple):
    """A document: its frame as written and, if safe fixes change its text, as fixed.

    `findings` are those of the document, `silenced` those that a comment suppresses, `undecided`
    the undecided rules; `mended` are the findings that the fixes removed. `device` is the profile
    that it is linted for. `number` is its index among the `many` documents of a stream. For a frame
    described in terms of Metal, `by_vulkan` has the findings and the undecided rules of the
    equivalent Vulkan frame. `subjects` are the frame's, with the facts that hold for all kinds of
    frame of its program; None if only the frame is known.
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
    subjects: tuple[Subject, ...] | None = None

    @property
    def prefix(self) -> str:
        """The prefix of the paths of a document in a stream."""
        return _prefix(self.number, self.many)


class Inputs(NamedTuple):
    """The documents to confirm, findings that say why others cannot be, lines for standard error,
    and the address of the documentation in the settings of the current folder.
    """

    inputs: list[Input]
    wrong: list[Finding]
    notes: list[str]
    docs_url: str = ""


def inputs(request: Request) -> Inputs:
    """The documents of a request, in the order of the files."""
    workspace = Workspace(request)
    discovered = workspace.discover()
    found: list[Input] = []
    findings: list[Finding] = []
    for path in discovered.files:
        with workspace.reading(path) as read, workspace.guard(path):
            found += of_file(workspace, path)
        findings += read.findings
    return Inputs(
        found,
        errors(workspace, findings),
        list(discovered.notes),
        workspace.current.settings.docs_url,
    )


def errors(workspace: Workspace, findings: Sequence[Finding]) -> list[Finding]:
    """The findings of a workspace and of its inputs that say why inputs cannot be used."""
    return [finding for finding in dict.fromkeys([*workspace.findings, *findings]) if finding.fatal]


def of_file(workspace: Workspace, path: str) -> list[Input]:
    """The documents of an input, none after adding a finding to the workspace if it cannot be
    confirmed.
    """
    file = workspace.open(path)
    if file is None:
        return []
    data = file.data
    if isinstance(data, SourceFile):
        message = (
            "source code does not describe a complete frame: complete the description that "
            "`msaa-lint convert` writes of it"
        )
        workspace.findings.append(diagnostic("MSAA921", message, file.name))
        return []
    if not isinstance(data, bytes):
        # What is confirmed is the description that a capture is converted to.
        if data.broken:
            workspace.findings.append(
                diagnostic("MSAA901", f"the capture ends in the middle: {data.broken}", file.name)
            )
        workspace.findings.extend(limit_findings(data))
        data = data.source.text.encode()
        file = file._replace(
            data=data, options=file.options._replace(format=None, limits=UNLIMITED)
        )
    result = unmerged(file.lint())
    errors = [finding for finding in result.findings if finding.fatal]
    workspace.findings.extend(errors)
    if errors or result.source is None:
        return []
    has_fix = any(finding.fix is not None for finding in result.findings)
    fixed = fix_input(data, result, file.lint, lambda _: True, False, None) if has_fix else None
    frames = [Frame(document.document) for document in result.documents]
    devices = [
        profile(document.document.description, file.resolved.device)
        for document in result.documents
    ]
    facts = subjects_of(
        [FrameAnalysis(frame, device) for frame, device in zip(frames, devices, strict=True)]
    )
    # Each frame has the findings about it, also those that `check` reports once for several frames.
    each = unmerged(result)
    return [
        _input(file, each, document, fixed, frame, tuple(subjects))
        for document, frame, subjects in zip(result.documents, frames, facts, strict=True)
    ]


def _input(
    file: InputFile,
    result: FileResult,
    document: DocumentResult,
    fixed: FixedText | None,
    frame: Frame,
    subjects: tuple[Subject, ...],
) -> Input:
    many = len(result.documents)
    prefix = _prefix(document.number, many)
    settled = [
        finding
        for finding in map(file.resolved.selection.settle, result.findings)
        if finding is not None
    ]
    input = Input(
        file.name,
        frame,
        _own(settled, prefix),
        silenced=_own([each.finding for each in result.suppressed], prefix),
        fixed=_fixed(fixed, document.number),
        mended=_own(fixed.fixed_findings if fixed is not None else (), prefix),
        undecided=tuple(
            rule._replace(subject=rule.subject.removeprefix(prefix))
            for rule in result.undecided
            if rule.subject.startswith(prefix)
        ),
        device=profile(document.document.description, file.resolved.device),
        number=document.number,
        many=many,
        subjects=subjects,
    )
    if document.document.metal is None:
        return input
    # The validation layer that the rules are compared with is Vulkan's.
    vulkan = document.document._replace(metal=document.document.metal._replace(api="VULKAN"))
    verdicts, _ = file.resolved.engine.linter.lint_document(
        vulkan, file.name, file.options._replace(device=input.device)
    )
    # Metal has no usage for copies and resolves.
    findings = [finding for finding in verdicts.findings if finding.rule != "image-usage-missing"]
    return input._replace(by_vulkan=(findings, verdicts.undecided))


def _prefix(number: int, many: int) -> str:
    return f"documents[{number}]." if many > 1 else ""


def _fixed(mended: FixedText | None, number: int) -> Frame | None:
    """The frame of a document after the fixes; None if they leave the document unchanged."""
    if mended is None or not mended.changed or number >= len(mended.result.documents):
        return None
    if (
        not any(
            finding.subject.startswith(f"documents[{number}].") for finding in mended.fixed_findings
        )
        and len(mended.result.documents) > 1
    ):
        return None
    return Frame(mended.result.documents[number].document)


def _own(findings: Sequence[Finding], prefix: str) -> tuple[Finding, ...]:
    """The findings of one document of a stream, with subjects relative to it."""
    if not prefix:
        return tuple(findings)
    return tuple(
        f._replace(subject=f.subject.removeprefix(prefix))
        for f in findings
        if f.subject.startswith(prefix)
    )


def of_pass(frame: Frame, described: Pass, findings: Sequence[Finding]) -> list[Finding]:
    """The findings that concern a pass."""
    return [finding for finding in findings if concerns(frame, described, finding.subject)]


def concerns(frame: Frame, described: Pass, path: str) -> bool:
    """Whether a path concerns a pass: the pass itself, its images, framebuffers and pipelines, and
    the commands on them. A path of no pass in particular concerns every pass.
    """
    return _owners(frame).has(described, path)


class _Owners:
    """The passes of a frame that a path concerns."""

    def __init__(self, frame: Frame) -> None:
        self._by_path: dict[str, set[int]] = {}
        self._known: dict[str, frozenset[int]] = {}
        for described in frame.passes:
            for path in _paths(frame, described):
                self._by_path.setdefault(path, set()).add(id(described))

    def has(self, described: Pass, subject: str) -> bool:
        """Whether a path concerns a pass; a path of no pass concerns every pass."""
        owners = self.of(subject)
        return not owners or id(described) in owners

    def of(self, path: str) -> frozenset[int]:
        """The passes that a path concerns, by identity."""
        if path not in self._known:
            cut = max(path.rfind("."), path.rfind("["))
            above = self.of(path[:cut]) if cut > 0 else frozenset()
            self._known[path] = above | self._by_path.get(path, set())
        return self._known[path]


@lru_cache(maxsize=4)
def _owners(frame: Frame) -> _Owners:
    return _Owners(frame)


def _paths(frame: Frame, described: Pass) -> set[str]:
    images = {
        target.name
        for attachment in described.attachments
        for target in attachment.targets
        if target.image is not None
    }
    images.update(
        r.target_image.name
        for r in described.resolves
        if r.target_image is not None and r.target_image.image is not None
    )
    paths = {
        described.path,
        *(frame.targets[name].path for name in images if name in frame.targets),
    }
    paths.update(pipeline.path for pipeline, of in frame.pipelines if of is described or of is None)
    paths.update(framebuffer.path for framebuffer in frame.framebuffers.get(described.name, ()))
    for position in described.begun:
        paths.add(frame.commands[position].path)
    paths.update(
        command.path
        for command in frame.commands
        if any(name in images for name, _ in accesses(command))
    )
    return paths

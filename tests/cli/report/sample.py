"""Results to print: a real looking frame, and builders for odd ones."""

from __future__ import annotations

from msaa_lint.cli.report import Options, render
from msaa_lint.core.finding import (
    CaptureSummary,
    Finding,
    Fix,
    InputSummary,
    MissingKey,
    Price,
    Result,
    RuleInfo,
    Saving,
    Savings,
    Suppressed,
    Undecided,
    Unread,
)
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Label, Span

FORWARD = """\
frame: {width: 2168, height: 1080, fps: 60}
renderPasses:
  forward:
    attachments:
      color:
        format: R8G8B8A8_UNORM
        samples: 4
        loadOp: CLEAR
        storeOp: STORE
      output: {format: R8G8B8A8_UNORM, samples: 1, loadOp: LOAD, storeOp: STORE}
    subpasses:
      - colorAttachments: [color]
        resolveAttachments: [output]
"""

RULES = (
    RuleInfo(
        "MSAA205",
        "resolve-target-loaded",
        "warning",
        "high",
        "A resolve target is loaded although the resolve overwrites it.",
        "# resolve-target-loaded\n\nThe resolve writes every pixel of its target.\n",
        ("VUID-none", "https://docs.vulkan.org/spec/latest/chapters/renderpass.html"),
        True,
    ),
    RuleInfo("MSAA101", "sample-count-above-four", "warning", "medium", "More than four samples."),
    RuleInfo(
        "MSAA201",
        "multisampled-attachment-stored",
        "warning",
        "high",
        "A multisampled attachment is stored and nothing reads it.",
    ),
)

CODE = "void create() {\n  info.samples = count;\n}\n"


def span(text: str, part: str, after: str = "") -> Span:
    """Where `part` first is in `text`, behind the first `after`."""
    start = text.index(part, text.index(after) if after else 0)
    return Span(start, start + len(part))


def finding(message: str = "something is wrong", **others: object) -> Finding:
    values: dict[str, object] = {
        "code": "MSAA201",
        "rule": "multisampled-attachment-stored",
        "severity": "warning",
        "confidence": "high",
        "message": message,
        "file": "frame.yaml",
        "span": None,
    }
    return Finding(**{**values, **others})


def result(*findings: Finding, text: str | None = None, **others: object) -> Result:
    """A run that gave `findings`; `text` is what every file of theirs holds, None where they have
    none.
    """
    files = list(dict.fromkeys(f.file for f in findings))
    values: dict[str, object] = {
        "findings": findings,
        "undecided": (),
        "suppressed": (),
        "files": files,
        "sources": {} if text is None else {file: Source(file, text) for file in files},
        "rules": RULES,
    }
    return Result(**{**values, **others})


def frame() -> Result:
    """Two files with text, one binary, one clean; every part of a finding in use."""
    file = "passes/forward.yaml"
    stored = Finding(
        "MSAA201",
        "multisampled-attachment-stored",
        "warning",
        "high",
        "multisampled attachment `color` is resolved and also stored",
        file,
        span(FORWARD, "STORE", "storeOp"),
        "renderPasses.forward.attachments.color",
        (
            Label(
                span(FORWARD, "STORE", "storeOp"),
                "4x samples written to memory although only the resolve is read",
            ),
            Label(span(FORWARD, "color:\n"[:5], "attachments"), "4x attachment declared here"),
            Label(span(FORWARD, "[output]"), "resolved here"),
        ),
        ("1920x1080 at 60 frames a second",),
        "set `storeOp: DONT_CARE`",
        Fix(
            "set storeOp to DONT_CARE",
            True,
            (Edit(span(FORWARD, "STORE", "storeOp"), "DONT_CARE"),),
        ),
        Price(0.0, 2248.1, 31.64, 224.8),
    )
    loaded = Finding(
        "MSAA205",
        "resolve-target-loaded",
        "error",
        "medium",
        "resolve target is loaded",
        file,
        span(FORWARD, "LOAD", "output:"),
        "renderPasses.forward.attachments.output",
        (Label(span(FORWARD, "output"), "this attachment"),),
        fix=Fix(
            "set loadOp to DONT_CARE", False, (Edit(span(FORWARD, "LOAD", "output:"), "DONT_CARE"),)
        ),
        price=Price(562.0, 0.0, 0.0, 5.62),
    )
    broken = Finding(
        "MSAA901", "syntax", "error", "high", "the mapping is not closed", "broken.yaml", Span(5, 5)
    )
    binary = Finding(
        "MSAA101",
        "sample-count-above-four",
        "note",
        "low",
        "8 samples",
        "trace.rdc",
        None,
        "images.color_ms",
    )
    silenced = Suppressed(
        loaded._replace(code="MSAA101", rule="sample-count-above-four"),
        "inline",
        "measured on the device",
    )
    baseline = Suppressed(binary._replace(subject="images.depth_ms"), "baseline")
    at, flags = span(FORWARD, "color", "attachments"), "a list of VkImageUsageFlagBits"
    usage = MissingKey("images.color_ms", "usage", flags, at)
    depth_usage = MissingKey("images.depth_ms", "usage", flags, at)
    memory = MissingKey("images.color_ms", "memory", "a list of VkMemoryPropertyFlagBits", at, True)
    undecided = (
        Undecided(
            "MSAA401",
            "multisampled-image-not-transient",
            file,
            "images.color_ms",
            ("image.usage",),
            (usage,),
        ),
        Undecided(
            "MSAA401",
            "multisampled-image-not-transient",
            file,
            "images.depth_ms",
            ("image.usage",),
            (depth_usage,),
        ),
        Undecided(
            "MSAA402",
            "transient-not-lazily-allocated",
            file,
            "images.color_ms",
            ("image.memory", "image.usage"),
            (memory, usage),
        ),
    )
    code = "src/render.cpp"
    sources = {
        file: Source(file, FORWARD),
        "broken.yaml": Source("broken.yaml", "a: {b"),
        code: Source(code, CODE),
    }
    files = ("broken.yaml", "passes/clean.yaml", file, code, "trace.rdc")
    savings = {
        file: Savings(
            Saving(1, Price(0.0, 2248.1, 31.64, 224.8)),
            Saving(2, Price(562.0, 2248.1, 31.64, 281.0)),
        )
    }
    trace = CaptureSummary("game 1.2.0", "engine", "Mali-G76", 30, 2, {1: 2, 4: 1}, 2, 3)
    inputs = (
        InputSummary("broken.yaml", "description", failed=True),
        InputSummary("passes/clean.yaml", "description", 1, 1, 0),
        InputSummary(file, "description", 2, 1, 1),
        InputSummary(
            code,
            "cpp",
            images=1,
            unread=Unread(span(CODE, "samples = count"), "`samples = count` is in no pass"),
        ),
        InputSummary("trace.rdc", "renderdoc", 4, 2, 12, capture=trace),
    )
    return Result(
        (broken, stored, loaded, binary),
        undecided,
        (silenced, baseline),
        files,
        sources,
        RULES,
        savings,
        inputs=inputs,
    )


def printed(name: str, run: Result, **options: object) -> str:
    """What the output called `name` prints of `run`."""
    parts: list[str] = []
    render(name, run, parts.append, Options(**{"version": "1.2.3", "step_summary": "", **options}))
    return "".join(parts)

"""Which fixes are applied together, which one after another, and which not at all."""

from __future__ import annotations

import time

import pytest

from msaa_lint.core.finding import Finding, Fix
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.linter.fixes.fixer import MAX_TRIALS, _Fix, _join, _without_overlaps
from tests.linter.fixes.linting import fix_findings, lint, rules
from tests.paths import ROOT

STORED = """\
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]}
  out: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
renderPasses:
  main:
    attachments:
      color: {image: ms, loadOp: CLEAR, storeOp: STORE}
      output: {image: out, loadOp: LOAD, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output]}
"""
FIXED = STORED.replace("CLEAR, storeOp: STORE", "CLEAR, storeOp: DONT_CARE").replace(
    "LOAD", "DONT_CARE"
)


PASS = """\
renderPasses:
  main:
    attachments: [{format: R8_UNORM, samples: 4, loadOp: CLEAR}]
    subpasses: [{colorAttachments: [0]}]
"""


def test_one_edit_fixes_two_findings() -> None:
    done = fix_findings(STORED)
    assert rules(done.fixed_findings) == [
        "multisampled-attachment-stored",
        "resolve-target-loaded",
        "transient-needs-memory",
    ]
    assert done.text == FIXED
    assert done.result.findings == []


def test_only_selected_findings_are_fixed() -> None:
    from msaa_lint.linter.fixes.fixer import fix_text

    done = fix_text(lint(STORED), lint, False, lambda found: found.code == "MSAA205")
    assert rules(done.fixed_findings) == ["resolve-target-loaded"]


def test_suppressed_finding_stays() -> None:
    text = STORED.replace(
        "storeOp: STORE}\n      output",
        "storeOp: STORE}  # msaa-lint: ignore[MSAA201, MSAA403] a viewer reads it\n      output",
    )
    done = fix_findings(text)
    assert rules(done.fixed_findings) == ["resolve-target-loaded"]
    assert done.text == text.replace("loadOp: LOAD", "loadOp: DONT_CARE")


def test_suppression_that_a_fix_leaves_unused_is_removed() -> None:
    """The fix of the store also removes the finding that the comment suppresses."""
    text = STORED.replace(
        "storeOp: STORE}\n      output",
        "storeOp: STORE}  # msaa-lint: ignore[transient-needs-memory] once\n      output",
    )
    done = fix_findings(text)
    assert rules(done.fixed_findings) == [
        "multisampled-attachment-stored",
        "resolve-target-loaded",
        "unused-suppression",
    ]
    assert done.text == FIXED


def test_overlapping_fixes_are_applied_in_turn() -> None:
    """Both insert a member at the end of the same mapping."""
    text = """\
renderPasses:
  main:
    attachments: [{format: R8_UNORM, samples: 4}]
    subpasses: [{colorAttachments: [0]}]
    dependencies:
      - srcSubpass: EXTERNAL
        dstSubpass: 0
"""
    done = fix_findings(text)
    assert rules(done.fixed_findings) == ["reused-attachment-unsynchronised"]
    added = (
        "        srcStageMask: [COLOR_ATTACHMENT_OUTPUT]\n        srcAccessMask: "
        "[COLOR_ATTACHMENT_WRITE]\n"
    )
    assert done.text == text + added


def test_fix_that_introduces_a_finding_is_not_applied() -> None:
    text = """\
renderPasses:
  main:
    attachments: [{format: R8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}]
    subpasses: [{colorAttachments: [0], flags: [CUSTOM_RESOLVE_EXT]}]
pipelines:
  glass: {renderPass: main, multisampleState: {rasterizationSamples: 4, sampleShadingEnable: true, minSampleShading: 4}}
"""
    done = fix_findings(text, True)
    assert (done.text, done.fixed_findings) == (text, ())
    (failed,) = done.failed_fixes
    assert failed.finding.code == "MSAA510"
    assert failed.reason.startswith("it would introduce sample-shading-everywhere: `glass` runs")


def test_failed_fix_does_not_prevent_others() -> None:
    bad = (
        "    g{0}: {{renderPass: main, multisampleState: {{rasterizationSamples: 4, "
        "sampleShadingEnable: {1}, minSampleShading: 4}}}}\n"
    )
    text = (
        PASS
        + "pipelines:\n"
        + "".join(bad.format(n, "true" if n == 5 else "false") for n in range(9))
    )
    done = fix_findings(text, True)
    assert len(done.fixed_findings) == 8
    assert [each.finding.subject for each in done.failed_fixes] == ["pipelines.g5"]
    assert done.text.count("minSampleShading: 1.0") == 8


def test_all_documents_of_a_stream_are_fixed() -> None:
    text = f"{STORED}---\n# two\n{STORED}...\n"
    done = fix_findings(text)
    assert len(done.fixed_findings) == 6
    assert done.text == f"{FIXED}---\n# two\n{FIXED}...\n"


@pytest.mark.parametrize("text", ["", "a: [", "images: {a: {smaples: 4}}", "\x00", "images: null"])
def test_unreadable_text_is_not_changed(text: str) -> None:
    assert fix_findings(text, True).text == text


def test_document_with_errors_does_not_prevent_fixes_of_others() -> None:
    done = fix_findings(f"{STORED}---\nimages: {{a: {{smaples: 4}}}}\n")
    assert len(done.fixed_findings) == 3


def test_thousands_of_fixes_are_applied_in_time() -> None:
    lines = "".join(
        f"      c{n}: {{format: R8_UNORM, samples: 4, loadOp: CLEAR, storeOp: STORE}}\n"
        for n in range(1000)
    )
    references = ", ".join(f"c{n}" for n in range(1000))
    text = (
        f"renderPasses:\n  main:\n    attachments:\n{lines}      out: {{format: R8_UNORM, "
        f"samples: 1, loadOp: DONT_CARE}}\n"
    )
    text += (
        f"    subpasses:\n      - {{colorAttachments: [{references}], resolveAttachments: "
        f"[{', '.join(['out'] * 1000)}]}}\n"
    )
    start = time.process_time()
    done = fix_findings(text, True)
    assert len(done.fixed_findings) == 1000
    assert time.process_time() - start < 30


def test_many_failing_fixes_are_given_up() -> None:
    each = (
        "  g{0}: {{renderPass: main, multisampleState: {{rasterizationSamples: 4, "
        "sampleShadingEnable: true, minSampleShading: 4}}}}\n"
    )
    text = PASS + "pipelines:\n" + "".join(each.format(n) for n in range(200))
    start = time.process_time()
    done = fix_findings(text, True)
    assert done.fixed_findings == ()
    assert len(done.failed_fixes) == 200
    assert done.failed_fixes[-1].reason == "too many fixes of this input failed"
    assert time.process_time() - start < 30
    assert MAX_TRIALS == 60


def fix(*edits: tuple[int, int, str]) -> _Fix:
    found = Finding("MSAA201", "x", "note", "high", "", "f", Span(0, 0), fix=Fix("", True))
    return _Fix((found,), tuple(Edit(Span(start, end), text) for start, end, text in edits))


def test_fixes_that_share_an_edit_are_joined() -> None:
    one, two, three = fix((0, 1, "a")), fix((5, 6, "b"), (8, 8, "c")), fix((0, 1, "a"), (8, 8, "c"))
    (joined,) = _join([one, two, three])
    assert len(joined.findings) == 3
    assert joined.edits == ((Span(0, 1), "a"), (Span(5, 6), "b"), (Span(8, 8), "c"))
    assert len(_join([one, two])) == 2


@pytest.mark.parametrize(
    ("taken", "other", "apart"),
    [
        ((2, 5, ""), (5, 7, ""), True),
        ((2, 5, ""), (5, 5, "x"), True),
        ((2, 5, ""), (2, 2, "x"), True),
        ((2, 5, ""), (3, 3, "x"), False),
        ((2, 5, ""), (4, 9, ""), False),
        ((2, 9, ""), (4, 5, ""), False),
        ((4, 4, "x"), (4, 4, "y"), False),
        ((2, 5, "x"), (2, 5, "y"), False),
    ],
)
def test_overlaps(taken: tuple[int, int, str], other: tuple[int, int, str], apart: bool) -> None:
    for one, two in ((taken, other), (other, taken)):
        assert len(_without_overlaps([fix(one), fix(two)])) == (2 if apart else 1)


def test_fix_that_a_failed_one_blocked_is_applied() -> None:
    from msaa_lint.core.text.source import Source
    from msaa_lint.linter.fixes.fixer import fix_text
    from msaa_lint.linter.results import FileResult

    def finding(code: str, severity: str, fix: Fix | None = None) -> Finding:
        return Finding(code, code.lower(), severity, "high", "", "f", Span(0, 1), code, fix=fix)

    def lint_letters(text: str) -> FileResult:
        found = []
        if text[0] == "a":
            found.append(finding("MSAA1", "error", Fix("both", True, (Edit(Span(0, 2), "cd"),))))
        if text[1] == "b":
            found.append(finding("MSAA2", "warning", Fix("one", True, (Edit(Span(1, 2), "B"),))))
        if text == "cd":
            found.append(finding("MSAA3", "warning"))
        return FileResult("f", Source("f", text), found, [], [])

    done = fix_text(lint_letters("ab"), lint_letters, False, lambda _: True)
    assert done.text == "aB"
    assert rules(done.fixed_findings) == ["msaa2"]
    assert [(each.finding.code, each.reason) for each in done.failed_fixes] == [
        ("MSAA1", "it would introduce msaa3: ")
    ]


def test_flags_that_a_fix_replaces_and_removes_in_one_list() -> None:
    """TRANSIENT_ATTACHMENT takes the place of the first of three usages that it excludes."""
    text = """\
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [TRANSFER_SRC, TRANSFER_DST, SAMPLED, COLOR_ATTACHMENT]}
  out: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
renderPasses:
  main:
    attachments:
      color: {image: ms, loadOp: CLEAR, storeOp: STORE}
      out: {image: out, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [out]}
commands:
  - beginRenderPass: {renderPass: main}
  - endRenderPass
  - present: {image: out}
"""
    done = fix_findings(text, unsafe=True)
    assert [failed.reason for failed in done.failed_fixes] == []
    assert "usage: [TRANSIENT_ATTACHMENT, COLOR_ATTACHMENT]" in done.text
    assert "color: {image: ms, loadOp: CLEAR, storeOp: DONT_CARE}" in done.text


def test_a_finding_may_move_with_a_fix() -> None:
    """The resolve has the same problem before and after it becomes part of the pass: that is no
    reason to leave it outside.
    """
    text = (ROOT / "examples/phone/frame.msaa.yaml").read_text(encoding="utf-8")
    done = fix_findings(text, unsafe=True)
    assert "resolveImage" not in done.text and "resolveAttachments: [scene]" in done.text
    assert rules(done.result.findings) == [
        "framebuffer-readback",
        "hdr-resolved-before-tone-mapping",
    ]

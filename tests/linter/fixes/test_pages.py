"""The fixes in rule pages: their checks, and what those of the built-in rules do."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import pytest

from msaa_lint.core.text.span import Edit
from msaa_lint.frame.facts.table import FACTS, SUBJECTS
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.fixes.actions import ACTIONS, PRICE_ONLY
from msaa_lint.linter.fixes.fact_sources import FACT_SOURCES, ONLY_VALUES
from msaa_lint.linter.fixes.fix_checks import problems
from msaa_lint.linter.fixes.metal import METAL_ACTIONS, METAL_FACT_SOURCES
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.rules.registry import load
from msaa_lint.linter.rules.rule_runner import finding_key
from tests.linter.fixes.linting import fix_findings, lint
from tests.marked import unmarked
from tests.pages import RULES, examples

PAGE = """---
code: ACME001
severity: warning
subject: aspect
when: aspect.store == "STORE"
message: "`{{attachment.name}}` is stored"
{fix}
---
Nothing is stored.
"""


def loaded(folder: Path, fix: str) -> tuple[list[tuple[str, str]], list[str]]:
    """The problems of a page with a fix, each with the text that it points at; and the marked
    texts.
    """
    text, spans = unmarked(PAGE.format(fix=fix).rstrip("\n"))
    path = folder / "no-store.md"
    path.write_text(f"{text}\n", encoding="utf-8")
    catalogue = load([str(path)], problems)
    found = [
        (each.message.removeprefix("rule page `no-store`: "), text[each.span.start : each.span.end])
        for each in catalogue.problems
        if each.span
    ]
    assert bool(found) == ("no-store" not in {rule.name for rule in catalogue.rules})
    return found, [text[span.start : span.end] for span in spans]


@pytest.mark.parametrize(
    ("fix", "message"),
    [
        (
            "fix: {title: x, safety: safe, set: {⟦aspect.stor⟧: DONT_CARE}}",
            "unknown fact `aspect.stor`: did you mean `aspect.store`?",
        ),
        (
            "fix: {title: x, safety: safe, set: {⟦aspect.name⟧: color}}",
            "fixes cannot change `aspect.name`; use one of ",
        ),
        (
            "fix: {title: x, safety: safe, set: {⟦resolve.mode⟧: MIN}}",
            "unknown fact resolve.mode of aspect; it is a fact of resolve",
        ),
        (
            "fix: {title: x, safety: safe, set: {aspect.store: ⟦DONTCARE⟧}}",
            "`aspect.store` is never `DONTCARE`; did you mean `DONT_CARE`?",
        ),
        (
            "fix: {title: x, safety: safe, set: {aspect.store: ⟦4⟧}}",
            "expected a value of aspect.store (STRING), found ",
        ),
        (
            "fix: {title: x, safety: safe, set: {⟦image.usage⟧: SAMPLED}}",
            "image.usage is a list: it cannot be changed with `set`",
        ),
        (
            "fix: {title: x, safety: safe, add: {⟦aspect.store⟧: STORE}}",
            "aspect.store is not a list: it cannot be changed with `add`",
        ),
        (
            "fix: {title: x, safety: safe, add: {image.usage: [SAMPLED, ⟦SMAPLED⟧]}}",
            "`image.usage` is never `SMAPLED`; did you mean `SAMPLED`?",
        ),
        (
            'fix: {title: x, safety: safe, set: {aspect.store: ⟦"{image.samples}"⟧}}',
            "`{image.samples}` does not refer to a fact of type STRING",
        ),
        (
            "fix: ⟦{title: x, safety: safe}⟧",
            "a fix must state what it changes: `set`, `add`, `remove` or `do`",
        ),
        (
            "fix: {title: x, safety: safe, do: ⟦nothing⟧}",
            "unknown action `nothing`: expected one of make-transient, resolve-in-pass",
        ),
        (
            "fix: {title: x, safety: safe, do: ⟦make_transient⟧}",
            "unknown action `make_transient`: did you mean `make-transient`?",
        ),
        (
            "cases: [{when: image.samples > 1, fix: ⟦{safety: unsafe}⟧}]",
            "a fix must be a mapping with `title`, `safety` (safe, unsafe, shown)",
        ),
        (
            "fix: {title: x, safety: safe, set: {aspect.store: NONE}}\ncases: [{when: "
            "image.samples > 1, fix: {safety: ⟦often⟧}}]",
            "`safety`: expected one of safe, unsafe, shown, found `often`",
        ),
        (
            'fix: {title: "{image.sample}", safety: safe, set: {aspect.store: NONE}}',
            "unknown fact image.sample of aspect",
        ),
    ],
)
def test_problems_of_fixes_and_their_places(tmp_path: Path, fix: str, message: str) -> None:
    (found, *_), marked = loaded(tmp_path, fix)
    assert found[0].startswith(message)
    if marked:
        assert found[1] == marked[0]


def test_cases_change_the_fix(tmp_path: Path) -> None:
    """A case may change the safety, replace the fix, or remove it."""
    fix = """fix: {title: "store {aspect.name}: DONT_CARE", safety: safe, set: {aspect.store: DONT_CARE}}
cases:
  - {when: image.samples == 2, fix: {safety: unsafe}}
  - {when: image.samples == 4, fix: {title: none, safety: shown, set: {aspect.store: NONE}}}
  - {when: image.samples == 8, fix: null}
  - {when: image.samples == 16, severity: note}"""
    assert loaded(tmp_path, fix)[0] == []
    engine = Engine(load([str(tmp_path / "no-store.md")]))
    entries = ", ".join(
        f"a{n}: {{format: R8_UNORM, samples: {n}, storeOp: STORE}}" for n in (1, 2, 4, 8, 16)
    )
    text = f"renderPasses: {{p: {{attachments: {{{entries}}}}}}}"
    findings = engine.lint(
        text.encode(), "x", LintOptions(lambda rule, suggested, vendor: suggested)
    ).findings
    fixes = [found.fix for found in findings if found.rule == "no-store"]
    assert [
        (each.title, each.safe, each.shown, bool(each.edits)) if each else None for each in fixes
    ] == [
        ("store color: DONT_CARE", True, False, True),
        ("store color: DONT_CARE", False, False, True),
        ("none", False, True, False),
        None,
        ("store color: DONT_CARE", True, False, True),
    ]


def test_fact_sources_are_of_known_facts() -> None:
    assert set(FACT_SOURCES) <= set(FACTS)
    assert set(ONLY_VALUES) <= set(FACT_SOURCES)


def test_built_in_rules() -> None:
    rules = load().rules
    assert [each for rule in rules for each in problems(rule)] == []
    assert {spec.do for rule in rules for spec in rule.fix_specs if spec.do} == {
        *ACTIONS,
        *METAL_ACTIONS,
    }
    changed = {
        setting.fact
        for rule in rules
        for spec in rule.fix_specs
        for setting in (*spec.set, *spec.add, *spec.remove)
    }
    assert changed <= {*FACT_SOURCES, *METAL_FACT_SOURCES}
    for rule in rules:
        assert {fact.name for fact in SUBJECTS[rule.subject]}


WRITTEN = [
    rule for rule in load().rules if any(spec.do not in PRICE_ONLY for spec in rule.fix_specs)
]


@pytest.mark.parametrize("rule", WRITTEN, ids=lambda rule: rule.name)
def test_fixed_examples_are_what_the_fix_writes(rule: object) -> None:
    """The fixed example of a page is exactly what the rule's fix makes of a bad one."""
    from msaa_lint.core.text.edits import apply
    from msaa_lint.linter.fixes.changes import NoFix
    from msaa_lint.linter.fixes.document_fixes import DocumentFixes

    name = getattr(rule, "name", "")
    results = []
    expected = [example for example in examples(RULES / f"{name}.md") if example.kind == "fixed"]
    for example in examples(RULES / f"{name}.md"):
        if example.kind != "bad":
            continue
        text = "".join(
            line
            for line in example.text.splitlines(keepends=True)
            if not line.startswith("#") or "^" not in line
        )
        result = lint(text)
        assert result.source is not None
        fixes = DocumentFixes(result.documents[0])
        edits: set[Edit] = set()
        for finding in result.findings:
            if finding.rule == name and finding_key(finding) in fixes.result.fix_specs:
                with suppress(NoFix):
                    edits.update(fixes.edits(fixes.changes(finding)))
        results.append(apply(text, edits))
    assert expected
    assert {example.text for example in expected} <= set(results)


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        (
            "backbuffer: {format: R8_UNORM",
            "backbuffer: {format: R8_SRGB",
            "the sample counts and formats do not show that a pass can resolve the image",
        ),
        (
            "  - endRenderPass\n",
            "  - endRenderPass\n  - clearColorImage: {image: backbuffer}\n",
            "other commands use the images between the pass and the resolve",
        ),
        (
            "  - endRenderPass\n",
            "  - endRenderPass\n  - beginRenderPass: {renderPass: scene}\n  - endRenderPass\n",
            "the pass that draws the image does not run exactly once, right before the command",
        ),
    ],
)
def test_resolve_outside_a_pass_stays_if_in_doubt(old: str, new: str, reason: str) -> None:
    text = RESOLVED.replace(old, new, 1)
    assert text != RESOLVED
    done = fix_findings(text, True)
    assert [
        (each.finding.rule, each.reason)
        for each in done.failed_fixes
        if each.finding.code == "MSAA301"
    ] == [("resolve-outside-pass", reason)]


RESOLVED = """\
images:
  other: {format: R16_SFLOAT, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]}
  ms: {format: R8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSFER_SRC], memory: [DEVICE_LOCAL]}
  backbuffer: {format: R8_UNORM, samples: 1, usage: [TRANSFER_DST], presentable: true}
renderPasses:
  scene:
    attachments:
      - {format: R16_SFLOAT, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      - {format: R8_UNORM, samples: 4, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: TRANSFER_SRC_OPTIMAL}
    subpasses:
      - colorAttachments: [0, 1]
framebuffers:
  fb: {renderPass: scene, attachments: [other, ms]}
commands:
  - beginRenderPass: {renderPass: scene, framebuffer: fb}
  - endRenderPass
  - resolveImage: {srcImage: ms, dstImage: backbuffer}   # at the end
  - present: {image: backbuffer}
"""


INSIDE = """\
images:
  other: {format: R16_SFLOAT, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]}
  ms: {format: R8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [DEVICE_LOCAL, LAZILY_ALLOCATED]}
  backbuffer: {format: R8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
renderPasses:
  scene:
    attachments:
      - {format: R16_SFLOAT, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      - {format: R8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      - {format: R8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: PRESENT_SRC_KHR}
    subpasses:
      - colorAttachments: [0, 1]
        resolveAttachments: [null, 2]
framebuffers:
  fb: {renderPass: scene, attachments: [other, ms, backbuffer]}
commands:
  - beginRenderPass: {renderPass: scene, framebuffer: fb}
  - endRenderPass
  # at the end
  - present: {image: backbuffer}
"""


def test_resolve_moves_into_a_pass_with_a_framebuffer() -> None:
    from msaa_lint.linter.fixes.fixer import fix_text

    done = fix_text(lint(RESOLVED), lint, True, lambda found: found.code == "MSAA301")
    assert [found.rule for found in done.fixed_findings] == ["resolve-outside-pass"]
    assert done.text == INSIDE


def test_store_of_samples_with_other_readers_stays() -> None:
    text = RESOLVED.replace(
        "  - present",
        "  - readImage: {image: ms, stage: FRAGMENT, access: SHADER_READ}\n  - present",
    ).replace("TRANSFER_SRC]", "TRANSFER_SRC, SAMPLED]")
    done = fix_findings(text, True)
    assert "resolve-outside-pass" in {found.rule for found in done.fixed_findings}
    assert (
        "loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: "
        "TRANSFER_SRC_OPTIMAL}" in done.text
    )
    assert "usage: [COLOR_ATTACHMENT, SAMPLED]" in done.text

"""The fixes that pages state: what can be changed, with which values; what the catalogue's own do."""

from __future__ import annotations

from pathlib import Path

import pytest

from msaa_lint.frame.facts.table import FACTS, SUBJECTS
from msaa_lint.linter.engine import Engine, LintOptions
from msaa_lint.linter.fixes.actions import DEEDS
from msaa_lint.linter.fixes.fact_sources import CHANGEABLE, ONLY
from msaa_lint.linter.fixes.fix_checks import problems
from msaa_lint.linter.fixes.metal import CHANGEABLE as METAL_CHANGEABLE
from msaa_lint.linter.fixes.metal import DEEDS as METAL_DEEDS
from msaa_lint.linter.rules.registry import load
from tests.linter.fixes.judging import fixed, lint
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
    """What is wrong with a page that has a fix, each with the text that it points at; and the marked texts."""
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
        ("fix: {title: x, safety: safe, set: {⟦aspect.stor⟧: DONT_CARE}}", "there is no fact aspect.stor"),
        ("fix: {title: x, safety: safe, set: {aspect.name: ⟦color⟧}}", "aspect.name cannot be changed by a fix; what can is "),
        ("fix: {title: x, safety: safe, set: {resolve.mode: ⟦MIN⟧}}", "there is no fact resolve.mode of aspect"),
        ("fix: {title: x, safety: safe, set: {aspect.store: ⟦DONTCARE⟧}}", "aspect.store is never 'DONTCARE'; did you mean 'DONT_CARE'?"),
        ("fix: {title: x, safety: safe, set: {aspect.store: ⟦4⟧}}", "a value of aspect.store (STRING) is due here"),
        ("fix: {title: x, safety: safe, set: {⟦image.usage⟧: SAMPLED}}", "image.usage is a list: `set` is not for it"),
        ("fix: {title: x, safety: safe, add: {⟦aspect.store⟧: STORE}}", "aspect.store is no list: `add` is not for it"),
        (
            "fix: {title: x, safety: safe, add: {image.usage: [SAMPLED, ⟦SMAPLED⟧]}}",
            "image.usage is never 'SMAPLED'; did you mean 'SAMPLED'?",
        ),
        ('fix: {title: x, safety: safe, set: {aspect.store: ⟦"{image.samples}"⟧}}', "{image.samples} is no fact of the same type"),
        ("fix: ⟦{title: x, safety: safe}⟧", "a fix states what it changes: `set`, `add`, `remove` or `do`"),
        ("fix: ⟦{title: x, safety: safe, do: nothing}⟧", "no `do: nothing`; there are make-transient, resolve-in-pass"),
        ("cases: [{when: image.samples > 1, fix: ⟦{safety: unsafe}⟧}]", "a fix is a mapping with `title`, `safety` (safe, unsafe, shown)"),
        (
            "fix: {title: x, safety: safe, set: {aspect.store: NONE}}\ncases: [{when: image.samples > 1, fix: {safety: ⟦often⟧}}]",
            "one of safe, unsafe, shown is due here",
        ),
        ('fix: {title: "{image.sample}", safety: safe, set: {aspect.store: NONE}}', "there is no fact image.sample of aspect"),
    ],
)
def test_what_is_wrong_with_a_fix_and_where(tmp_path: Path, fix: str, message: str) -> None:
    (found, *_), marked = loaded(tmp_path, fix)
    assert found[0].startswith(message)
    if marked:
        assert found[1] == marked[0]


def test_cases_may_change_the_fix(tmp_path: Path) -> None:
    """By its safety alone, by another one, by none."""
    fix = """fix: {title: "store {aspect.name}: DONT_CARE", safety: safe, set: {aspect.store: DONT_CARE}}
cases:
  - {when: image.samples == 2, fix: {safety: unsafe}}
  - {when: image.samples == 4, fix: {title: none, safety: shown, set: {aspect.store: NONE}}}
  - {when: image.samples == 8, fix: null}
  - {when: image.samples == 16, severity: note}"""
    assert loaded(tmp_path, fix)[0] == []
    engine = Engine(load([str(tmp_path / "no-store.md")]))
    entries = ", ".join(f"a{n}: {{format: R8_UNORM, samples: {n}, storeOp: STORE}}" for n in (1, 2, 4, 8, 16))
    text = f"renderPasses: {{p: {{attachments: {{{entries}}}}}}}"
    findings = engine.lint(text.encode(), "x", LintOptions(lambda rule, suggested, vendor: suggested)).findings
    fixes = [found.fix for found in findings if found.rule == "no-store"]
    assert [(each.title, each.safe, each.shown, bool(each.edits)) if each else None for each in fixes] == [
        ("store color: DONT_CARE", True, False, True),
        ("store color: DONT_CARE", False, False, True),
        ("none", False, True, False),
        None,
        ("store color: DONT_CARE", True, False, True),
    ]


def test_the_facts_that_can_be_changed_are_facts() -> None:
    assert set(CHANGEABLE) <= set(FACTS)
    assert set(ONLY) <= set(CHANGEABLE)


def test_the_catalogue() -> None:
    rules = load().rules
    assert [each for rule in rules for each in problems(rule)] == []
    assert {mend.do for rule in rules for mend in rule.fix_specs if mend.do} == {*DEEDS, *METAL_DEEDS}
    changed = {setting.fact for rule in rules for mend in rule.fix_specs for setting in (*mend.set, *mend.add, *mend.remove)}
    assert changed <= {*CHANGEABLE, *METAL_CHANGEABLE}
    for rule in rules:
        assert {fact.name for fact in SUBJECTS[rule.subject]}


@pytest.mark.parametrize("rule", [rule for rule in load().rules if rule.fix_specs], ids=lambda rule: rule.name)
def test_a_fixed_example_is_what_the_fix_writes(rule: object) -> None:
    """The page shows a bad example and, below it, exactly what this rule's fix makes of it."""
    from msaa_lint.core.text.edits import apply
    from msaa_lint.linter.fixes.changes import Refused
    from msaa_lint.linter.fixes.document_fixes import DocumentFixes

    name = getattr(rule, "name", "")
    results = []
    wanted = [example for example in examples(RULES / f"{name}.md") if example.kind == "fixed"]
    for example in examples(RULES / f"{name}.md"):
        if example.kind != "bad":
            continue
        text = "".join(line for line in example.text.splitlines(keepends=True) if not line.startswith("#") or "^" not in line)
        linted = lint(text)
        assert linted.source is not None
        offers = DocumentFixes(linted.source, linted.documents[0])
        made = [offers.changes(found) for found in linted.findings if found.rule == name]
        edits = [offers.edits(each) for each in made if each is not None and not isinstance(each, Refused)]
        results.append(apply(text, {edit for each in edits if not isinstance(each, Refused) for edit in each}))
    assert wanted
    assert {example.text for example in wanted} <= set(results)


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        (
            "backbuffer: {format: R8_UNORM",
            "backbuffer: {format: R8_SRGB",
            "sample counts and formats do not show that a pass can resolve it",
        ),
        (
            "  - endRenderPass\n",
            "  - endRenderPass\n  - pipelineBarrier: {images: [ms]}\n",
            "the images have other uses, or barriers, in between",
        ),
        (
            "  - endRenderPass\n",
            "  - endRenderPass\n  - clearColorImage: {image: backbuffer}\n",
            "the images have other uses, or barriers, in between",
        ),
        (
            "  - endRenderPass\n",
            "  - endRenderPass\n  - beginRenderPass: {renderPass: scene}\n  - endRenderPass\n",
            "the pass that draws it does not come once, just before it",
        ),
    ],
)
def test_a_resolve_stays_outside_where_there_is_a_doubt(old: str, new: str, reason: str) -> None:
    text = RESOLVED.replace(old, new, 1)
    assert text != RESOLVED
    done = fixed(text, True)
    assert [(each.finding.rule, each.reason) for each in done.unfixed if each.finding.code == "MSAA301"] == [
        ("resolve-outside-pass", reason)
    ]


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


def test_a_resolve_moves_into_a_pass_with_a_framebuffer() -> None:
    from msaa_lint.linter.fixes import fixer as rounds

    done = rounds.fix(lint(RESOLVED), lint, True, lambda found: found.code == "MSAA301")
    assert [found.rule for found in done.fixed] == ["resolve-outside-pass"]
    assert done.text == INSIDE


def test_of_samples_that_are_read_again_the_store_stays() -> None:
    text = RESOLVED.replace("  - present", "  - readImage: {image: ms, stage: FRAGMENT, access: SHADER_READ}\n  - present").replace(
        "TRANSFER_SRC]", "TRANSFER_SRC, SAMPLED]"
    )
    done = fixed(text, True)
    assert "resolve-outside-pass" in {found.rule for found in done.fixed}
    assert "loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: TRANSFER_SRC_OPTIMAL}" in done.text
    assert "usage: [COLOR_ATTACHMENT, SAMPLED]" in done.text

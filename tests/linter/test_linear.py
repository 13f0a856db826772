"""Work grows as the input does: calls are counted, not seconds, and what a budget ends is a finding
or a note.
"""

from __future__ import annotations

import cProfile
import json
import pstats
from pathlib import Path

import pytest

from msaa_lint.frame.facts.missing_keys import MissingKeys
from msaa_lint.linter import prices
from msaa_lint.linter.fixes.fixer import fix_text
from msaa_lint.linter.lint_options import LintOptions
from tests.benchmarks.shapes.description_texts import SHAPES as TEXTS
from tests.benchmarks.shapes.description_texts import STORED
from tests.benchmarks.shapes.descriptions import BEGINS, IMAGES, PASSES, many
from tests.benchmarks.shapes.descriptions import SHAPES as LISTS
from tests.command import run
from tests.linter.fixes.linting import ENGINE, as_written, lint

BY_NAME = {shape.name: shape for shape in (*LISTS, *TEXTS)}
MOST = 1.4
"""What a byte of the second doubling may take of calls, in terms of what one of the first takes: 1
where they are proportional, 2 where quadratic.
"""

WATCHED = (
    "attachments of alternating framebuffers",
    "attachments of a subpass",
    "framebuffers begun",
    "subpasses begun",
    "subpasses with attachments of their own",
    "pipelines times subpasses",
    "resolves of one image to one",
    "resolves that are read",
    "barriers of no image",
    "render targets",
    "Metal pipelines",
    "resolves with prices",
    "documents with prices",
    "fixes of documents",
    "unsafe fixes of documents",
    "unsafe fixes",
    "undecided pipelines as JSON",
    "costs as JSON",
    "misspelt names of documents",
    "unknown keys of merges",
)


def work(name: str, size: int, folder: Path) -> tuple[int, int]:
    """How many bytes a shape of a size has, and how many functions it calls."""
    shape = BY_NAME[name]
    folder.mkdir()
    shape.write(folder, size)
    length = sum(path.stat().st_size for path in folder.iterdir())
    profile = cProfile.Profile()
    profile.enable()
    done = run(folder, *shape.arguments)
    profile.disable()
    assert done.returncode in shape.codes, done.stderr
    total: int = pstats.Stats(profile).total_calls  # type: ignore[attr-defined]
    return length, total


@pytest.mark.parametrize("name", WATCHED)
def test_calls_grow_as_the_input_does(name: str, tmp_path: Path) -> None:
    work(name, 2, tmp_path / "imports")
    lengths, calls = zip(
        *(work(name, size, tmp_path / str(size)) for size in (16, 32, 64)), strict=True
    )
    first, second = ((calls[n + 1] - calls[n]) / (lengths[n + 1] - lengths[n]) for n in range(2))
    assert second <= MOST * first


FAILING = many(*IMAGES, *PASSES, "commands:", BEGINS)


@pytest.mark.parametrize(
    "text", [FAILING(40), "---\n".join([FAILING(1)] * 40)], ids=["one document", "documents"]
)
def test_failing_fixes_are_told_by_what_their_result_has_findings_about(text: str) -> None:
    """Each of 40 fixes would lose a result: one trial shows it of all, where bisection takes 79."""
    trials = 0

    def trial(text: str) -> object:
        nonlocal trials
        trials += 1
        return lint(text)

    done = fix_text(lint(text), trial, True)  # type: ignore[arg-type]
    assert trials <= 6
    lost = [
        failed
        for failed in done.failed_fixes
        if failed.reason.startswith("it would introduce multisampled-result-lost: `color` is")
    ]
    assert len(lost) == 40


def test_one_failing_fix_leaves_the_others() -> None:
    begin = "- beginRenderPass: {renderPass: pass7}\n"
    text = FAILING(8).replace(begin, f"- readImage: {{image: ms0, stage: FRAGMENT}}\n{begin}")
    done = fix_text(lint(text), lint, True)
    assert {finding.subject for finding in done.fixed_findings}.isdisjoint({"images.ms0"})


def test_findings_beyond_the_budget_of_prices_say_so(monkeypatch: pytest.MonkeyPatch) -> None:
    stored = STORED(20)
    monkeypatch.setattr(prices, "MAX_COSTED", 300)
    options = LintOptions(as_written, prices=True)
    found = [
        found
        for found in ENGINE.lint(stored.encode(), "a.yaml", options).findings
        if found.fix is not None
    ]
    priced = [finding for finding in found if finding.price is not None]
    unpriced = [finding for finding in found if prices.NOT_PRICED in finding.notes]
    assert priced and unpriced and len(priced) + len(unpriced) == len(found)


def test_a_price_concerns_its_own_pass_alone() -> None:
    """The same findings have the same prices, however many passes stand beside theirs."""
    options = LintOptions(as_written, prices=True)
    one, many_more = (
        ENGINE.lint(STORED(count).encode(), "a.yaml", options).findings for count in (1, 30)
    )
    expected = {(finding.code, finding.subject): finding.price for finding in one}
    assert expected
    assert {
        (f.code, f.subject): f.price for f in many_more if (f.code, f.subject) in expected
    } == expected


def test_missing_keys_are_looked_up_where_they_are_listed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.msaa.yaml").write_text(
        many(*IMAGES[:1], "  i@: {samples: 4}", "renderPasses: {}")(800)
    )
    lookups: list[str] = []
    find = MissingKeys.of
    monkeypatch.setattr(
        MissingKeys,
        "of",
        lambda self, subject, fact: lookups.append(fact) or find(self, subject, fact),
    )  # type: ignore[func-returns-value]
    done = run(tmp_path, "check", "--isolated", "a.msaa.yaml")
    assert "rules undecided, missing keys: " in done.stderr + done.stdout
    assert 0 < len(lookups) <= 1000
    lookups.clear()
    listed = json.loads(
        run(tmp_path, "check", "--isolated", "--output", "json", "a.msaa.yaml").stdout
    )
    assert len(listed["undecided"]) > 1000
    assert len(lookups) > len(listed["undecided"]) / 2


def test_passes_that_use_images_too_often_are_not_followed_and_said_to_be() -> None:
    attachments = "".join(
        f"      a{number}: {{format: R8_UNORM, samples: 4, loadOp: CLEAR, storeOp: STORE}}\n"
        for number in range(300)
    )
    begins = "- beginRenderPass: {renderPass: pass}\n- endRenderPass\n" * 600
    text = (
        f"renderPasses:\n  pass:\n    attachments:\n{attachments}    subpasses: "
        f"[{{colorAttachments: [a0]}}]\ncommands:\n{begins}"
    )
    result = lint(text)
    start = "limit exceeded: passes use images 181200 times, more than the limit of "
    (limit,) = [finding for finding in result.findings if finding.message.startswith(start)]
    assert limit.code == "MSAA906"
    assert limit.span is not None and result.source is not None
    assert result.source.position(limit.span.start) == (305, 1)

"""Properties of every fix, on all examples of the repository in random spellings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from random import Random

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from msaa_lint.core.text.edits import apply
from msaa_lint.frame.description.models import MetalRecord
from msaa_lint.linter.fixes.changes import Change, NoFix, apply_temporarily
from msaa_lint.linter.fixes.document_fixes import DocumentFixes
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules.rule_runner import finding_key
from tests.linter.fixes.linting import (
    _meaning,
    comments_of,
    fix_findings,
    kinds,
    lint,
    meaning,
    rules,
)
from tests.linter.fixes.spellings import data_of, written
from tests.pages import all_examples
from tests.paths import ROOT
from tests.strength import examples

EXAMPLES = sorted((ROOT / "examples").rglob("*.msaa.yaml"))
TEXTS = {str(each): each.text for each in all_examples() if each.kind == "bad"}
TEXTS |= {path.stem: path.read_text(encoding="utf-8") for path in EXAMPLES}
DATA = {name: data_of(text) for name, text in TEXTS.items() if "\n---\n" not in text}
"""The data of the texts that hold one document."""
FIXABLE = st.deferred(
    lambda: st.sampled_from(
        sorted(
            name
            for name, text in TEXTS.items()
            if name in DATA and fix_findings(text, True).fixed_findings
        )
    )
)
BESIDE = (
    "a comment stands between the entries",
    "comments or merge keys stand between the entries",
)


@pytest.mark.parametrize("unsafe", [False, True])
@pytest.mark.parametrize("name", TEXTS)
def test_fixes_remove_findings_and_add_none(name: str, unsafe: bool) -> None:
    check(TEXTS[name], unsafe)


def check(text: str, unsafe: bool) -> None:
    """Fixed findings are gone, no finding is new, remaining ones cannot be fixed, and fixing again
    changes nothing.

    A finding may move: a resolve that becomes part of a pass has the same problem there.
    """
    before = lint(text)
    done = fix_findings(text, unsafe)
    after = lint(done.text)
    assert [found for found in after.findings if found.fatal] == []
    assert after.findings == done.result.findings
    gone = kinds(before) - kinds(after)
    assert not Counter(found.rule for found in after.findings) - Counter(
        found.rule for found in before.findings
    )
    assert {found.rule for found in done.fixed_findings} <= {rule for rule, _ in gone}
    assert len(done.fixed_findings) <= gone.total()
    assert (done.text == text) == (not done.fixed_findings)
    refused = {(each.finding.rule, each.finding.span) for each in done.failed_fixes}
    for found in after.findings:
        may = found.fix is not None and not found.fix.shown and (found.fix.safe or unsafe)
        assert not may or (found.rule, found.span) in refused
    again = fix_findings(done.text, unsafe)
    assert (again.text, again.fixed_findings) == (done.text, ())
    assert comments_of(done.text) == comments_of(text)


@examples(4)
@given(FIXABLE, st.integers(0, 2**32), st.booleans())
@example("clear-command-instead-of-load-op-bad-2", 0, True)
def test_fixes_do_not_depend_on_spelling(name: str, seed: int, unsafe: bool) -> None:
    """The same findings are fixed with the same meaning; comments and line breaks stay."""
    text = written(DATA[name], Random(seed))
    assert not [found for found in lint(text).findings if found.fatal], text
    check(text, unsafe)
    plain, done = fix_findings(TEXTS[name], unsafe), fix_findings(text, unsafe)
    if any(each.reason in BESIDE for each in done.failed_fixes):
        return
    assert rules(done.fixed_findings) == rules(plain.fixed_findings), text
    assert meaning(done.result) == meaning(plain.result)
    if "\r\n" in text:
        assert done.text.count("\n") == done.text.count("\r\n")
    assert done.text.endswith("\n") == text.endswith("\n")


@examples(3)
@given(FIXABLE, st.integers(0, 2**32), st.sampled_from([0.0, 0.2, 0.6]))
def test_edits_make_the_changes_and_no_others(name: str, seed: int, shared: float) -> None:
    """The text after the edits means what the records after the changes mean, also if anchors share
    what changes.
    """
    edits_make_changes(written(DATA[name], Random(seed), shared))


def edits_make_changes(text: str) -> int:
    """Checks the property for each finding of a text. Returns the number of findings checked."""
    result = lint(text)
    assert not [found for found in result.findings if found.fatal], text
    assert result.source is not None
    (document,) = result.documents
    fixes = DocumentFixes(document)
    count = 0
    for found in result.findings:
        if finding_key(found) not in fixes.result.fix_specs:
            continue
        try:
            changes = fixes.changes(found)
            if any(change.structural for change in changes):
                continue
            edits = fixes.edits(changes)
        except NoFix:
            continue
        count += 1
        after = apply(text, edits)
        if any(isinstance(change.record, MetalRecord) for change in changes):
            assert stated(lint(after)) == stated_with(result, changes), after
        else:
            with apply_temporarily(changes):
                meant = meaning(result)
            assert meaning(lint(after)) == meant, after
        assert comments_of(after) == comments_of(text)
    return count


def stated(result: FileResult) -> object:
    """What a Metal description states, without the Vulkan records derived from it."""
    return _meaning(result.documents[0].document.description.metal)


def stated_with(result: FileResult, changes: Sequence[Change]) -> object:
    before = [
        (change.record, change.member, getattr(change.record, change.member)) for change in changes
    ]
    for change in changes:
        setattr(
            change.record, change.member, change.applied_to(getattr(change.record, change.member))
        )
    found = stated(result)
    for record, member, value in reversed(before):
        setattr(record, member, value)
    return found


@examples(1.5)
@given(FIXABLE, st.integers(0, 2**32), st.booleans())
def test_fixes_of_texts_with_anchors(name: str, seed: int, unsafe: bool) -> None:
    check(written(DATA[name], Random(seed), 0.4), unsafe)

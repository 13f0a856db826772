"""What holds for every fix, on every example of the repository, however it is written."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from msaa_lint.core.text.edits import apply
from msaa_lint.frame.description.models import MetalRecord
from msaa_lint.linter.fixes.changes import Change, NoFix, applied
from msaa_lint.linter.fixes.document_fixes import DocumentFixes
from msaa_lint.linter.results import FileResult
from tests.linter.fixes.judging import _meaning, comments_of, fixed, kinds, lint, meaning, rules
from tests.linter.fixes.spelled import data_of, written
from tests.pages import all_examples
from tests.paths import ROOT
from tests.strength import examples

EXAMPLES = sorted((ROOT / "examples").rglob("*.msaa.yaml"))
TEXTS = {str(each): each.text for each in all_examples() if each.kind == "bad"}
TEXTS |= {path.stem: path.read_text(encoding="utf-8") for path in EXAMPLES}
DATA = {name: data_of(text) for name, text in TEXTS.items() if "\n---\n" not in text}
"""What is no stream of several documents."""
MENDABLE = sorted(name for name, text in TEXTS.items() if name in DATA and fixed(text, True).fixed_findings)
BESIDE = ("a comment stands between the entries", "comments or merge keys may stand between the entries")


@pytest.mark.parametrize("unsafe", [False, True])
@pytest.mark.parametrize("name", TEXTS)
def test_fixes_mend_and_bring_nothing(name: str, unsafe: bool) -> None:
    check(TEXTS[name], unsafe)


def check(text: str, unsafe: bool) -> None:
    """The laws: what is mended is gone and nothing came; what is left has no fix that would do; a second run finds nothing to do."""
    before = lint(text)
    done = fixed(text, unsafe)
    after = lint(done.text)
    assert [found for found in after.findings if found.fatal] == []
    assert after.findings == done.result.findings
    gone = kinds(before) - kinds(after)
    assert not kinds(after) - kinds(before)
    assert {found.rule for found in done.fixed_findings} <= {rule for rule, _ in gone}
    assert len(done.fixed_findings) <= gone.total()
    assert (done.text == text) == (not done.fixed_findings)
    refused = {(each.finding.rule, each.finding.span) for each in done.failed_fixes}
    for found in after.findings:
        may = found.fix is not None and not found.fix.shown and (found.fix.safe or unsafe)
        assert not may or (found.rule, found.span) in refused
    again = fixed(done.text, unsafe)
    assert (again.text, again.fixed_findings) == (done.text, ())
    assert comments_of(done.text) == comments_of(text)


@examples(4)
@given(st.sampled_from(MENDABLE), st.integers(0, 2**32), st.booleans())
@example("clear-command-instead-of-load-op-bad-2", 0, True)
def test_however_it_is_written(name: str, seed: int, unsafe: bool) -> None:
    """The same is mended, and means the same after it; comments, line ends and the end of the text stay."""
    text = written(DATA[name], Random(seed))
    assert not [found for found in lint(text).findings if found.fatal], text
    check(text, unsafe)
    plain, done = fixed(TEXTS[name], unsafe), fixed(text, unsafe)
    if any(each.reason in BESIDE for each in done.failed_fixes):
        return
    assert rules(done.fixed_findings) == rules(plain.fixed_findings), text
    assert meaning(done.result) == meaning(plain.result)
    if "\r\n" in text:
        assert done.text.count("\n") == done.text.count("\r\n")
    assert done.text.endswith("\n") == text.endswith("\n")


@examples(3)
@given(st.sampled_from(MENDABLE), st.integers(0, 2**32), st.sampled_from([0.0, 0.2, 0.6]))
def test_an_edit_makes_its_changes_and_no_others(name: str, seed: int, shared: float) -> None:
    """The text with a fix's edits means what the records with its changes mean, also where anchors share what it changes."""
    edits_make_changes(written(DATA[name], Random(seed), shared))


def edits_make_changes(text: str) -> int:
    """The law for each finding of a text; how many have been looked at."""
    linted = lint(text)
    assert not [found for found in linted.findings if found.fatal], text
    assert linted.source is not None
    (judged,) = linted.documents
    fixes = DocumentFixes(judged)
    count = 0
    for found in linted.findings:
        if not fixes.covers(found):
            continue
        try:
            made = fixes.changes(found)
            if any(change.structural for change in made):
                continue
            edits = fixes.edits(made)
        except NoFix:
            continue
        count += 1
        after = apply(text, edits)
        if any(isinstance(change.record, MetalRecord) for change in made):
            assert stated(lint(after)) == stated_with(linted, made), after
        else:
            with applied(made):
                meant = meaning(linted)
            assert meaning(lint(after)) == meant, after
        assert comments_of(after) == comments_of(text)
    return count


def stated(linted: FileResult) -> object:
    """What a frame in Metal's words states, and not what it is made into."""
    return _meaning(linted.documents[0].document.description.metal)


def stated_with(linted: FileResult, made: Sequence[Change]) -> object:
    before = [(change.record, change.member, getattr(change.record, change.member)) for change in made]
    for change in made:
        setattr(change.record, change.member, change.applied_to(getattr(change.record, change.member)))
    found = stated(linted)
    for record, member, value in reversed(before):
        setattr(record, member, value)
    return found


@examples(1.5)
@given(st.sampled_from(MENDABLE), st.integers(0, 2**32), st.booleans())
def test_what_anchors_share_is_mended_by_the_same_laws(name: str, seed: int, unsafe: bool) -> None:
    check(written(DATA[name], Random(seed), 0.4), unsafe)

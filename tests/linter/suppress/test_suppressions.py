from collections.abc import Iterable
from typing import NamedTuple

import pytest
from hypothesis import HealthCheck, given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding, Suppressed
from msaa_lint.core.text.comments import Comment, comments
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Label, Span
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.linter.suppress import comments as suppression_comments
from msaa_lint.linter.suppress.suppressions import MAX_FINDINGS, apply


class Rule(NamedTuple):
    code: str
    name: str


STORED = Rule("MSAA201", "stored")
LOADED = Rule("MSAA202", "loaded")
RESOLVE = Rule("MSAA301", "resolve-outside-pass")
RULES = [STORED, LOADED, RESOLVE]
NAMES = {rule.name for rule in RULES}
FILE = "a.msaa.yaml"


class Outcome(NamedTuple):
    text: str
    kept: list[Finding]
    suppressed: list[Suppressed]
    extra: list[Finding]

    def problems(self) -> list[tuple[str, int, int, int, str]]:
        """Code, line, columns and the text there of what is wrong with the comments."""
        source = Source(FILE, self.text)
        out = []
        for each in self.extra:
            assert each.span is not None
            start, end = source.position(each.span.start), source.position(each.span.end)
            assert start.line == end.line
            out.append(
                (
                    each.code,
                    start.line,
                    start.column,
                    end.column,
                    self.text[each.span.start : each.span.end],
                )
            )
        return out

    def mended(self) -> str:
        """The text with the first fix applied."""
        fix = next(each.fix for each in self.extra if each.fix is not None)
        (edit,) = fix.edits
        return self.text[: edit.span.start] + edit.text + self.text[edit.span.end :]


def finding(
    text: str, word: str, rule: Rule = STORED, labels: Iterable[str] = (), file: str = FILE
) -> Finding:
    """A finding at the first `word` of a text, with labels at others."""

    def at(what: str) -> Span:
        start = text.index(what)
        return Span(start, start + len(what))

    return Finding(
        rule.code,
        rule.name,
        "warning",
        "high",
        "",
        file,
        at(word),
        labels=tuple(Label(at(each), "") for each in labels),
    )


def run(text: str, *findings: Finding, enabled: Iterable[str] = NAMES) -> Outcome:
    source = Source(FILE, text)
    parsed = parse(source, Limits())
    assert not parsed.problems
    return Outcome(
        text, *apply(findings, comments(source, parsed.documents), source, RULES, set(enabled))
    )


def silenced(text: str, found: Finding, reason: str = "") -> bool:
    """Whether a text's comments silence a finding; nothing may be wrong with them where they do."""
    outcome = run(text, found)
    if outcome.suppressed:
        assert outcome == Outcome(text, [], [Suppressed(found, "inline", reason)], [])
        return True
    assert outcome.kept == [found]
    return False


# --- where a comment counts
# -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("comment", "reason"),
    [
        ("# msaa-lint: ignore[stored]", ""),
        ("# msaa-lint: ignore[MSAA201] it is read by a tool", "it is read by a tool"),
        ("# msaa-lint: ignore[ loaded , stored ] -- both [sic]", None),
        ("#msaa-lint:ignore[stored]—why", "why"),
        ("## MSAA-Lint:  ignore [stored]: why  ", "why"),
        ("# yes, really # msaa-lint: ignore[stored] why", "why"),
        ("# msaa-lint: ignore[stored,]", ""),
    ],
)
def test_a_comment_on_the_line_silences(comment: str, reason: str | None) -> None:
    text = f"a: 1\nb: 2  {comment}\nc: 3\n"
    outcome = run(text, finding(text, "2"), finding(text, "1"), enabled={"stored"})
    assert outcome.suppressed == [
        Suppressed(finding(text, "2"), "inline", "both [sic]" if reason is None else reason)
    ]
    assert (outcome.kept, outcome.extra) == ([finding(text, "1")], [])


def test_a_comment_alone_on_its_line_silences_the_next_one_and_no_other() -> None:
    text = "a: 1\n  # msaa-lint: ignore[stored] why\nb: 2\nc: 3\n"
    assert silenced(text, finding(text, "2"), "why")
    assert not silenced(text, finding(text, "1"))
    assert not silenced(text, finding(text, "3"))


def test_comments_may_stack_above_a_line() -> None:
    text = (
        "# msaa-lint: ignore[stored] one\n# a word between\n# msaa-lint: ignore[loaded] two\na: 1\n"
    )
    outcome = run(text, finding(text, "1"), finding(text, "1", LOADED))
    assert [(each.finding.rule, each.reason) for each in outcome.suppressed] == [
        ("stored", "one"),
        ("loaded", "two"),
    ]
    assert (outcome.kept, outcome.extra) == ([], [])


def test_a_blank_line_parts_a_comment_from_what_follows() -> None:
    text = "# msaa-lint: ignore[stored]\n\na: 1\n"
    outcome = run(text, finding(text, "1"))
    assert outcome.kept == [finding(text, "1")]
    assert outcome.problems() == [("MSAA911", 1, 21, 27, "stored")]


def test_a_comment_behind_a_value_does_not_reach_the_next_line() -> None:
    text = "a: 1 # msaa-lint: ignore[stored]\nb: 2\n"
    assert not silenced(text, finding(text, "2"))


def test_any_line_of_the_place_or_of_a_label_counts() -> None:
    text = "a:\n  b: 1\n  c: 2 # msaa-lint: ignore[stored]\nd: 3\ne: 4\n"
    assert silenced(text, finding(text, "a:\n  b: 1\n  c: 2"))
    assert silenced(text, finding(text, "e", labels=["3", "c"]))
    assert not silenced(text, finding(text, "a:\n  b: 1", labels=["d:"]))


def test_a_place_that_ends_with_its_line_is_not_on_the_next() -> None:
    text = "a: 1\nb: 2 # msaa-lint: ignore[stored]\n"
    assert not silenced(text, finding(text, "a: 1\n"))
    assert silenced(text, finding(text, "a: 1\nb"))


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_lines_end_as_in_yaml(end: str) -> None:
    text = end.join(["a: 'x\u2028y'", "# msaa-lint: ignore[stored] why", "b: 2", ""])
    assert silenced(text, finding(text, "2"), "why")
    assert not silenced(text, finding(text, "x"))


def test_a_comment_within_a_scalar_is_none() -> None:
    text = 'a: "# msaa-lint: ignore[stored]"\nb: |\n  # msaa-lint: ignore[stored]\n'
    outcome = run(text, finding(text, "a"))
    assert (outcome.kept, outcome.suppressed, outcome.extra) == ([finding(text, "a")], [], [])


def test_only_the_rules_named_are_silenced() -> None:
    text = "a: 1 # msaa-lint: ignore[stored]\n"
    outcome = run(text, finding(text, "1", LOADED), finding(text, "1"))
    assert [each.rule for each in outcome.kept] == ["loaded"]
    assert [each.finding.rule for each in outcome.suppressed] == ["stored"]


def test_a_whole_file_is_silenced_from_its_top_alone() -> None:
    top = "%YAML 1.2\n# about\n---\n\n# msaa-lint: ignore-file[stored, MSAA202] generated\n"
    text = top + "a: 1\nb: 2\n"
    outcome = run(
        text, finding(text, "1\n"), finding(text, "2\n", LOADED), finding(text, "b", RESOLVE)
    )
    assert [(each.finding.rule, each.reason) for each in outcome.suppressed] == [
        ("stored", "generated"),
        ("loaded", "generated"),
    ]
    assert ([each.rule for each in outcome.kept], outcome.extra) == (["resolve-outside-pass"], [])

    text = "a: 1 # msaa-lint: ignore-file[stored]\nb: 2\n# msaa-lint: ignore-file[stored]\n"
    outcome = run(text, finding(text, "1"), finding(text, "2"))
    assert outcome.suppressed == []
    assert outcome.problems() == [
        ("MSAA911", 1, 6, 38, "# msaa-lint: ignore-file[stored]"),
        ("MSAA911", 3, 1, 33, "# msaa-lint: ignore-file[stored]"),
    ]


def test_findings_without_a_place_or_of_another_file_are_left_alone() -> None:
    text = "# msaa-lint: ignore[stored]\na: 1\n"
    nowhere = finding(text, "1")._replace(span=None)
    other = finding(text, "1", file="b.yaml")
    assert run(text, nowhere, other).kept == [nowhere, other]
    text = "# msaa-lint: ignore-file[stored]\na: 1\n"
    assert run(text, nowhere, other)[1:] == ([other], [Suppressed(nowhere, "inline", "")], [])


# --- what is wrong with a comment
# -----------------------------------------------------------------------------------------------


def test_each_unused_name_is_reported_at_its_place_unless_its_rule_was_not_judged() -> None:
    text = "a: 1 # msaa-lint: ignore[loaded, stored,MSAA301]\n"
    outcome = run(text, finding(text, "1"))
    assert outcome.problems() == [
        ("MSAA911", 1, 26, 32, "loaded"),
        ("MSAA911", 1, 41, 48, "MSAA301"),
    ]
    assert [(each.rule, each.severity, each.fatal, each.file) for each in outcome.extra] == [
        ("unused-suppression", "warning", False, FILE)
    ] * 2
    messages = [f"unused suppression: no `{name}` finding here" for name in ("loaded", "MSAA301")]
    assert [each.message for each in outcome.extra] == messages
    assert run(text, finding(text, "1"), enabled={"stored", "resolve-outside-pass"}).problems() == [
        ("MSAA911", 1, 41, 48, "MSAA301")
    ]


def test_every_comment_that_could_silence_is_used() -> None:
    text = (
        "# msaa-lint: ignore-file[stored]\n# msaa-lint: ignore[MSAA201] line\na: 1 # msaa-lint: "
        "ignore[stored, MSAA201]\n"
    )
    outcome = run(text, finding(text, "a:"))
    assert (outcome.suppressed, outcome.extra) == (
        [Suppressed(finding(text, "a:"), "inline", "line")],
        [],
    )


def test_nothing_is_unused_in_a_file_that_was_not_judged() -> None:
    text = "a: 1 # msaa-lint: ignore[stored, nope]\n"
    broken = diagnostic("MSAA902", "unknown key", FILE, Span(0, 1))
    outcome = run(text, broken)
    assert outcome.kept == [broken]
    assert outcome.problems() == [("MSAA912", 1, 34, 38, "nope")]


def test_errors_of_the_description_cannot_be_silenced() -> None:
    text = "# msaa-lint: ignore-file[unknown-key, MSAA201]\na: 1 # msaa-lint: ignore[MSAA902]\n"
    broken = diagnostic(
        "MSAA902", "unknown key", FILE, Span(text.index("a: 1"), text.index("a: 1") + 1)
    )
    outcome = run(text, broken)
    assert outcome.kept == [broken]
    assert outcome.problems() == [
        ("MSAA911", 1, 26, 37, "unknown-key"),
        ("MSAA911", 2, 26, 33, "MSAA902"),
    ]
    assert outcome.extra[0].message == "`unknown-key` is an error and cannot be suppressed"


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("resolve-outside-pas", "; did you mean `resolve-outside-pass`?"),
        ("msaa201", "; did you mean `MSAA201`?"),
        ("zzzz", ""),
        ("stored loaded", "; separate rules with commas"),
    ],
)
def test_an_unknown_rule_is_reported_with_the_nearest(name: str, hint: str) -> None:
    text = f"a: 1 # msaa-lint: ignore[stored, {name}] why\n"
    outcome = run(text, finding(text, "1"))
    assert len(outcome.suppressed) == 1
    assert outcome.problems() == [("MSAA912", 1, 34, 34 + len(name), name)]
    assert outcome.extra[0].message == f"unknown rule `{name}` in a suppression{hint}"


WRITE = "write `# msaa-lint: ignore[rule-name] reason`"
EXPECTED = "expected `ignore[rule-name]` or `ignore-file[rule-name]`"


@pytest.mark.parametrize(
    ("comment", "at", "message"),
    [
        ("# msaa-lint: ignore", "# msaa-lint: ignore", f"`ignore` names no rule; {WRITE}"),
        (
            "# msaa-lint: ignore because I say so",
            "# msaa-lint: ignore",
            f"`ignore` names no rule; {WRITE}",
        ),
        (
            "# msaa-lint: ignore-file",
            "# msaa-lint: ignore-file",
            "`ignore-file` names no rule; write `# msaa-lint: ignore-file[rule-name] reason`",
        ),
        (
            "# msaa-lint: ignore[] why",
            "# msaa-lint: ignore[]",
            f"`ignore[]` names no rule; {WRITE}",
        ),
        (
            "# msaa-lint: ignore[ , ]",
            "# msaa-lint: ignore[ , ]",
            f"`ignore[]` names no rule; {WRITE}",
        ),
        (
            "# msaa-lint: ignore[stored",
            "# msaa-lint: ignore[stored",
            f"suppression without a closing `]`; {WRITE}",
        ),
        (
            "# msaa-lint: ignore(stored)",
            "# msaa-lint: ignore(stored)",
            f"suppression without square brackets; {WRITE}",
        ),
        (
            "# msaa-lint: ignore: stored",
            "# msaa-lint: ignore: stored",
            f"suppression without square brackets; {WRITE}",
        ),
        (
            "# msaa-lint: ingore[stored]",
            "ingore",
            "unknown word `ingore` after `msaa-lint:`; did you mean `ignore`?",
        ),
        (
            "# msaa-lint: disable[stored]",
            "disable",
            f"unknown word `disable` after `msaa-lint:`; {EXPECTED}",
        ),
        ("# msaa-lint: [stored]", "# msaa-lint: ", f"no word after `msaa-lint:`; {EXPECTED}"),
        (
            "# msaa-lint ignore[stored] x",
            "# msaa-lint ignore[stored] x",
            f"invalid suppression; {WRITE}",
        ),
        (
            "# msaa_lint: ignore[stored]",
            "# msaa_lint: ignore[stored]",
            f"invalid suppression; {WRITE}",
        ),
        (
            "# msaa-lint: ignore[ALL]",
            "ALL",
            "`ALL` names a group of rules; name each rule to suppress",
        ),
        (
            "# msaa-lint: ignore[MSAA2]",
            "MSAA2",
            "`MSAA2` names a group of rules; name each rule to suppress",
        ),
    ],
)
def test_what_silences_nothing_says_so(comment: str, at: str, message: str) -> None:
    text = f"a: 1 {comment}\nb: 2\n"
    outcome = run(text, finding(text, "1"))
    assert (outcome.kept, outcome.suppressed) == ([finding(text, "1")], [])
    start = text.index(at) + 1
    assert outcome.problems() == [("MSAA913", 1, start, start + len(at), at)]
    assert (outcome.extra[0].message, outcome.extra[0].severity) == (message, "warning")


def test_a_misspelt_word_is_recognised() -> None:
    text = "a: 1 # msaa-lint: ingore[stored]\n"
    assert run(text).extra[0].message.endswith("; did you mean `ignore`?")


@pytest.mark.parametrize(
    "comment",
    [
        "# msaa-lint found this",
        "# see msaa-lint: it helps",
        "# ignore[stored]",
        "# msaa-linter: ignore[stored]",
    ],
)
def test_prose_is_no_suppression(comment: str) -> None:
    text = f"a: 1 {comment}\n"
    assert run(text, finding(text, "1"))[1:] == ([finding(text, "1")], [], [])


def test_two_in_one_comment_both_count() -> None:
    text = "a: 1 # msaa-lint: ignore[stored] one # msaa-lint: ignore[loaded] two\n"
    outcome = run(text, finding(text, "1"), finding(text, "1", LOADED))
    assert [(each.finding.rule, each.reason) for each in outcome.suppressed] == [
        ("stored", "one"),
        ("loaded", "two"),
    ]


def test_what_is_wrong_with_comments_can_be_silenced_too() -> None:
    text = (
        "# msaa-lint: ignore-file[unused-suppression] kept for other devices\na: 1 # msaa-lint: "
        "ignore[stored]\n"
    )
    outcome = run(text)
    assert (outcome.kept, outcome.extra) == ([], [])
    assert [(each.finding.code, each.reason) for each in outcome.suppressed] == [
        ("MSAA911", "kept for other devices")
    ]
    text = "a: 1 # msaa-lint: ignore[MSAA912]\n"
    assert run(text, enabled=()).problems() == [("MSAA911", 1, 26, 33, "MSAA912")]


# --- taking a suppression out
# ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "mended"),
    [
        ("a: 1  # msaa-lint: ignore[loaded] why\nb: 2\n", "a: 1\nb: 2\n"),
        ("a: 1\n  # msaa-lint: ignore[loaded]\r\nb: 2\n", "a: 1\nb: 2\n"),
        ("a: 1\r# msaa-lint: ignore[loaded]\rb: 2\r", "a: 1\rb: 2\r"),
        ("a: 1\n# msaa-lint: ignore[loaded]", "a: 1\n"),
        ("a: 1 # note # msaa-lint: ignore[loaded]\n", "a: 1 # note\n"),
        (
            "a: 1 # x # msaa-lint: ignore[loaded] # msaa-lint: ignore[stored]\n",
            "a: 1 # x # msaa-lint: ignore[stored]\n",
        ),
        (
            "a: 1 # msaa-lint: ignore[loaded] x # msaa-lint: ignore[stored]\n",
            "a: 1 # msaa-lint: ignore[stored]\n",
        ),
        (
            "a: 1 # msaa-lint: ignore[loaded, stored] why\n",
            "a: 1 # msaa-lint: ignore[stored] why\n",
        ),
        (
            "a: 1 # msaa-lint: ignore[stored,  loaded] why\n",
            "a: 1 # msaa-lint: ignore[stored] why\n",
        ),
        (
            "a: 1 # msaa-lint: ignore[stored, loaded, MSAA201]\n",
            "a: 1 # msaa-lint: ignore[stored, MSAA201]\n",
        ),
        (
            "a: 1 # msaa-lint: ignore[stored, resolve-outside-pas]\n",
            "a: 1 # msaa-lint: ignore[stored, resolve-outside-pass]\n",
        ),
    ],
)
def test_a_fix_takes_out_what_is_not_needed(text: str, mended: str) -> None:
    outcome = run(text, finding(text, "1"))
    assert len(outcome.extra) == 1
    assert outcome.mended() == mended


def test_removal_is_safe_and_a_guess_is_not() -> None:
    text = "a: 1 # msaa-lint: ignore[loaded, resolve-outside-pas]\n"
    assert [(each.code, each.fix.safe if each.fix else None) for each in run(text).extra] == [
        ("MSAA911", True),
        ("MSAA912", False),
    ]


# --- bounds and laws
# ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "comment",
    [
        "# msaa-lint: ignore[stored]\n",
        "# msaa-lint: ignore[stored,stored]\n",
        "#m # msaa-lint: ignore[stored]\n",
    ],
)
def test_suppressions_beyond_a_limit_are_not_read(
    comment: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(suppression_comments, "MAX_ENTRIES", 10)
    outcome = run("a: 1\n" + comment * 11)
    message = (
        "limit exceeded: suppressions name more than 10 rules; this one and those after it "
        "are not read"
    )
    assert [each.message for each in outcome.extra if each.code == "MSAA906"] == [message]


def test_a_flood_of_comments_gives_a_bounded_number_of_findings() -> None:
    text = "a: 1\n" + "# msaa-lint: ignore[zz, stored, ALL]\n# msaa-lint: ignore\n" * 3000
    outcome = run(text)
    counts = {
        code: sum(each.code == code for each in outcome.extra)
        for code in ("MSAA911", "MSAA912", "MSAA913")
    }
    assert counts == dict.fromkeys(counts, MAX_FINDINGS)
    last = [each for each in outcome.extra if each.code == "MSAA912"][-1]
    assert last.notes == ("more findings of this kind are not shown",)
    assert next(each.span for each in outcome.extra if each.code == "MSAA912") == Span(25, 27)


def test_overlapping_findings_and_comments_by_the_thousand() -> None:
    lines = [f"k{i}: 1 # msaa-lint: ignore[stored]" for i in range(3000)]
    text = "\n".join(lines)
    source = Source(FILE, text)
    at = [
        Comment(
            Span(source.starts[i] + line.index("#"), source.starts[i] + len(line)),
            line[line.index("#") :],
        )
        for i, line in enumerate(lines)
    ]
    found = [
        Finding("MSAA201", "stored", "warning", "high", "", FILE, Span(i, len(text) - i))
        for i in range(3000)
    ]
    kept, suppressed, extra = apply(found, at, source, RULES, NAMES)
    assert (len(kept), len(suppressed), len(extra)) == (0, 3000, 0)


lines_of = st.lists(
    st.tuples(
        st.booleans(),
        st.sampled_from(
            [
                "",
                "# msaa-lint: ignore[{}]",
                "# msaa-lint: ignore-file[{}]",
                "# msaa-lint: ignore",
                "# x",
            ]
        ),
        st.lists(
            st.sampled_from(
                [
                    "stored",
                    "MSAA202",
                    "nope",
                    "resolve-outside-pass",
                    "unused-suppression",
                    "syntax",
                ]
            ),
            min_size=1,
            max_size=3,
        ),
    ),
    max_size=8,
)


@hypothesis_settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    lines_of,
    st.lists(st.tuples(st.integers(0, 7), st.integers(0, 7), st.sampled_from(RULES)), max_size=6),
)
def test_every_finding_is_kept_or_silenced_and_what_silences_is_not_unused(
    lines: list[tuple[bool, str, list[str]]], places: list[tuple[int, int, Rule]]
) -> None:
    text = "".join(
        f"{f'k{i}: v ' if keyed else ''}{comment.format(', '.join(names))}\n"
        for i, (keyed, comment, names) in enumerate(lines)
    )
    source = Source(FILE, text)
    starts = [*source.starts, len(text)]
    found = [
        Finding(
            rule.code,
            rule.name,
            "warning",
            "high",
            "",
            FILE,
            Span(starts[min(a, b, len(starts) - 1)], starts[min(max(a, b), len(starts) - 1)]),
        )
        for a, b, rule in places
    ]
    outcome = run(text, *found)
    own = [each.finding for each in outcome.suppressed if not each.finding.code.startswith("MSAA9")]
    assert sorted([*outcome.kept, *own]) == sorted(found)
    assert [each for each in found if each in outcome.kept] == outcome.kept
    # Taking a comment's unused names out changes nothing that it silences.
    if any(
        each.code == "MSAA911" and each.fix is not None and each.fix.edits for each in outcome.extra
    ):
        removed = next(
            each for each in outcome.extra if each.code == "MSAA911" and each.fix is not None
        )
        assert removed.span is not None
        name = text[removed.span.start : removed.span.end]
        blank = (
            text[: removed.span.start]
            + "MSAA299".ljust(len(name), " ")[: len(name)]
            + text[removed.span.end :]
        )
        assert [
            each.finding
            for each in run(blank, *found).suppressed
            if not each.finding.code.startswith("MSAA9")
        ] == own

import os
from collections.abc import Mapping
from typing import NamedTuple

import pytest
from hypothesis import HealthCheck, given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from msaa_lint.core.diagnostics import DIAGNOSTICS, diagnostic
from msaa_lint.core.globs import Glob
from msaa_lint.linter.settings.selection import Selection
from msaa_lint.linter.settings.selectors import EXACT, max_specificity, specificity
from msaa_lint.linter.settings.settings import Settings, override


class Rule(NamedTuple):
    code: str
    name: str
    severity: str = "warning"
    edition: str = "2026.1"
    vendors: tuple[str, ...] = ()


STORED = Rule("MSAA201", "multisampled-attachment-stored")
LOADED = Rule("MSAA202", "multisampled-attachment-loaded")
RESOLVE = Rule("MSAA301", "resolve-outside-pass", "note")
NEWER = Rule("MSAA218", "something-new", edition="2026.10")
OWN = Rule("ACME1", "own-rule", "error", "")
RULES = [STORED, LOADED, RESOLVE, NEWER, OWN]
NOT_OF_FRAMES = {
    "unused-suppression",
    "unknown-rule-in-suppression",
    "blanket-suppression",
    "unused-assumption",
    "hidden-character",
}
"""What can be turned off that is no rule about a frame."""


def selected(settings: Settings, *rules: Rule) -> Selection:
    """The selection among rules, by default RULES."""
    return Selection(settings, lambda: rules or RULES)


def names(settings: Settings, file: str | None = None) -> set[str]:
    """Those of the frame's rules that are on."""
    return set(selected(settings).names(file)) - NOT_OF_FRAMES


def codes(settings: Settings) -> str:
    return " ".join(rule.code for rule in RULES if selected(settings).enabled(rule))


@pytest.mark.parametrize(
    ("selector", "rule", "closeness"),
    [
        ("MSAA201", STORED, EXACT),
        ("multisampled-attachment-stored", STORED, EXACT),
        ("MSAA20", STORED, 7),
        ("MSAA2", STORED, 6),
        ("MSAA", STORED, 5),
        ("ALL", STORED, 1),
        ("ACME", OWN, 5),
        ("MSA", STORED, 0),
        ("MSAA3", STORED, 0),
        ("msaa2", STORED, 0),
        ("multisampled", STORED, 0),
        ("MSAA2011", STORED, 0),
    ],
)
def test_specificity(selector: str, rule: Rule, closeness: int) -> None:
    assert specificity(selector, rule) == closeness
    assert max_specificity(["ALL", selector], rule) == max(closeness, 1)


@pytest.mark.parametrize(
    ("settings", "on"),
    [
        (Settings(), "MSAA201 MSAA202 MSAA301 MSAA218 ACME1"),
        (Settings(edition="2026.1"), "MSAA201 MSAA202 MSAA301 ACME1"),
        (Settings(edition="2026.10"), "MSAA201 MSAA202 MSAA301 MSAA218 ACME1"),
        (Settings(edition="2026.2"), "MSAA201 MSAA202 MSAA301 ACME1"),
        (Settings(edition="2026.1", select=("ALL",)), "MSAA201 MSAA202 MSAA301 ACME1"),
        (Settings(edition="2026.1", extend_select=("MSAA21",)), "MSAA201 MSAA202 MSAA301 ACME1"),
        (
            Settings(edition="2026.1", extend_select=("MSAA218",)),
            "MSAA201 MSAA202 MSAA301 MSAA218 ACME1",
        ),
        (
            Settings(edition="2026.1", extend_select=("something-new",)),
            "MSAA201 MSAA202 MSAA301 MSAA218 ACME1",
        ),
        (Settings(select=("MSAA2",)), "MSAA201 MSAA202 MSAA218"),
        (Settings(select=()), ""),
        (Settings(select=("MSAA3",), extend_select=("ACME",)), "MSAA301 ACME1"),
        (Settings(ignore=("MSAA2",)), "MSAA301 ACME1"),
        (Settings(ignore=("ALL",)), ""),
        (Settings(select=("MSAA2",), ignore=("MSAA201",)), "MSAA202 MSAA218"),
        (Settings(select=("MSAA201",), ignore=("MSAA2",)), "MSAA201"),
        (Settings(extend_select=("multisampled-attachment-stored",), ignore=("ALL",)), "MSAA201"),
        (Settings(select=("MSAA201",), ignore=("multisampled-attachment-stored",)), ""),
        (Settings(select=("MSAA2",), ignore=("MSAA2",)), ""),
        (
            Settings(select=("ALL",), ignore=("MSAA2",), extend_select=("MSAA20",)),
            "MSAA201 MSAA202 MSAA301 ACME1",
        ),
        (Settings(severity={"MSAA2": "off"}), "MSAA301 ACME1"),
        (Settings(severity={"MSAA2": "off", "MSAA201": "note"}), "MSAA201 MSAA301 ACME1"),
        (Settings(severity={"MSAA2": "off"}, select=("MSAA202", "ALL")), "MSAA202 MSAA301 ACME1"),
        (Settings(severity={"MSAA202": "off"}, select=("MSAA202",)), ""),
        (Settings(severity={"MSAA201": "error"}, select=("MSAA3",)), "MSAA301"),
    ],
)
def test_which_rules_are_on(settings: Settings, on: str) -> None:
    assert codes(settings) == on


def test_the_command_line_has_the_last_word() -> None:
    file = Settings(select=("MSAA2",), ignore=("MSAA201",), severity={"MSAA202": "off"})
    assert codes(file) == "MSAA218"
    assert codes(override(file, select=["MSAA201"])) == "MSAA201"
    assert codes(override(file, select=["MSAA20"])) == "MSAA201 MSAA202"
    assert codes(override(file, extend_select=["MSAA201", "MSAA3"])) == "MSAA201 MSAA301 MSAA218"
    assert codes(override(file, extend_select=["MSAA2"])) == "MSAA201 MSAA202 MSAA218"
    assert codes(override(file, ignore=["ALL"])) == ""
    assert codes(override(file, ignore=["ALL"], extend_select=["MSAA3"])) == "MSAA301"
    assert codes(override(file, select=["MSAA2"], ignore=["MSAA201"])) == "MSAA202 MSAA218"
    assert codes(override(file, severity={"MSAA218": "off"})) == ""
    assert (
        selected(
            override(Settings(severity={"MSAA201": "note"}), severity={"MSAA2": "error"})
        ).severity(STORED)
        == "error"
    )


@pytest.mark.parametrize(
    ("severity", "suggested", "weight"),
    [
        ({}, None, "warning"),
        ({}, "note", "note"),
        ({"ALL": "error"}, "note", "error"),
        ({"ALL": "error", "MSAA": "note"}, None, "note"),
        ({"MSAA20": "error", "MSAA2": "note"}, None, "error"),
        ({"MSAA201": "note", "multisampled-attachment-stored": "error"}, None, "error"),
        ({"MSAA201": "off", "multisampled-attachment-stored": "note"}, None, "note"),
        ({"MSAA201": "off", "MSAA2": "error"}, None, None),
    ],
)
def test_what_a_finding_weighs(
    severity: Mapping[str, str], suggested: str | None, weight: str | None
) -> None:
    assert selected(Settings(severity=severity)).severity(STORED, None, suggested) == weight


def test_a_rule_that_is_selected_more_closely_than_turned_off_keeps_another_severity() -> None:
    settings = Settings(severity={"MSAA2": "off", "ALL": "note"}, select=("MSAA201",))
    assert selected(settings).severity(STORED) == "note"


def test_per_file_ignores_count_from_their_root() -> None:
    root = os.path.abspath("project")
    ignores = ((Glob("tests/**", root), ("MSAA2",)), (Glob("!frames/", root), ("own-rule",)))
    settings = Settings(per_file_ignores=ignores, select=("ALL",))
    assert names(settings, "project/tests/a.yaml") == {"resolve-outside-pass"}
    assert names(settings, os.path.join(root, "frames/a.yaml")) == {rule.name for rule in RULES}
    assert names(settings, "project/a.yaml") == {rule.name for rule in RULES} - {"own-rule"}
    assert names(settings) == {rule.name for rule in RULES}
    assert names(override(settings, select=["MSAA201"]), "project/tests/a.yaml") == set()


def test_what_is_not_about_frames_stays_on_unless_ignored() -> None:
    assert selected(Settings(select=("MSAA201",))).names() == {STORED.name, *NOT_OF_FRAMES}
    assert selected(override(Settings(), select=["MSAA201"])).names() == {
        STORED.name,
        *NOT_OF_FRAMES,
    }
    assert selected(Settings(select=(), ignore=("MSAA91",))).names() == set()
    assert selected(
        Settings(select=(), severity={"unused-suppression": "off"})
    ).names() == NOT_OF_FRAMES - {"unused-suppression"}


def test_settle_gives_9xx_warnings_the_configured_severity_and_leaves_the_errors() -> None:
    settings = Settings(
        ignore=("MSAA9",),
        extend_select=("MSAA911",),
        severity={"MSAA9": "note"},
        per_file_ignores=((Glob("x", os.getcwd()), ("ALL",)),),
    )
    selection = selected(settings)
    unused, blanket, syntax = (
        diagnostic(code, "", "a") for code in ("MSAA911", "MSAA913", "MSAA901")
    )
    assert selection.settle(unused) == unused._replace(severity="note")
    assert selection.settle(unused._replace(file="x")) is None
    assert selection.settle(blanket) is None
    assert selection.settle(syntax) == syntax
    assert selection.enabled(DIAGNOSTICS["MSAA901"], "x")
    assert not selection.enabled(Rule("MSAA999", "not-known"))


def test_for_file_makes_a_vendors_rule_a_note_elsewhere() -> None:
    arm = Rule("MSAA201", "multisampled-attachment-stored", "warning", "2026.1", ("arm",))
    severity = selected(Settings(), arm).for_file("a.yaml")
    assert [severity(arm, "warning", vendor) for vendor in ("arm", "img", None)] == [
        "warning",
        "note",
        "note",
    ]
    assert selected(Settings(), arm).for_file("a.yaml", "arm")(arm, "error", None) == "error"
    assert (
        selected(Settings(severity={"MSAA2": "error"}), arm).for_file("a.yaml")(
            arm, "warning", None
        )
        == "error"
    )
    ignored = Settings(per_file_ignores=((Glob("a.yaml", os.getcwd()), ("ALL",)),))
    assert selected(ignored, arm).for_file("a.yaml")(arm, "warning", "arm") is None


selectors = st.lists(
    st.sampled_from(
        [
            "ALL",
            "MSAA",
            "MSAA2",
            "MSAA20",
            "MSAA201",
            "MSAA3",
            "resolve-outside-pass",
            "ACME",
            "MSAA218",
        ]
    ),
    max_size=5,
    unique=True,
)
levels = st.dictionaries(
    st.sampled_from(["ALL", "MSAA2", "MSAA201", "multisampled-attachment-stored"]),
    st.sampled_from(["note", "error", "off"]),
)


@hypothesis_settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    st.none() | selectors,
    selectors,
    selectors,
    levels,
    st.booleans(),
    st.randoms(use_true_random=False),
)
def test_the_order_of_selectors_does_not_matter(
    select: list[str] | None,
    extend: list[str],
    ignore: list[str],
    severity: dict[str, str],
    pinned: bool,
    random: object,
) -> None:
    def verdicts(shuffle: bool) -> list[str | None]:
        def order(items: list[str]) -> tuple[str, ...]:
            copy = list(items)
            if shuffle:
                random.shuffle(copy)  # type: ignore[attr-defined]
            return tuple(copy)

        settings = Settings(
            edition="2026.1" if pinned else None,
            select=None if select is None else order(select),
            extend_select=order(extend),
            ignore=order(ignore),
            severity={key: severity[key] for key in order(list(severity))},
        )
        return [selected(settings).severity(rule) for rule in RULES]

    assert verdicts(True) == verdicts(False)


@hypothesis_settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(selectors, selectors)
def test_ignore_takes_away_and_never_adds(select: list[str], ignore: list[str]) -> None:
    without = names(Settings(select=tuple(select)))
    assert names(Settings(select=tuple(select), ignore=tuple(ignore))) <= without
    assert names(Settings(select=tuple(select), extend_select=tuple(ignore))) >= without

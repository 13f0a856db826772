"""Rule pages of strangers: what they may take in a run is counted in steps, and ends with a finding
on the page.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.linter.rules import budget, rule_file
from msaa_lint.linter.rules.condition import Condition, ConditionError, check
from msaa_lint.linter.rules.condition_cost import MAX_ITERATIONS, pattern_instructions
from tests.command import run

PAGE = """\
---
code: {code}
severity: note
subject: image
when: {when}
message: {message}
{front}---
Text.
"""
LONG = "n" * 100_000


def frame(*names: str) -> str:
    """A description of images of 4 samples."""
    return "images:\n" + "".join(f"  ? {name}\n  : {{samples: 4}}\n" for name in names)


def page(
    code: str = "ACME001",
    when: str = "image.samples > 1",
    message: str = "'`{image.name}`'",
    front: str = "",
) -> str:
    return PAGE.format(code=code, when=when, message=message, front=front)


def reported(
    folder: Path, pages: Sequence[str], *files: str
) -> tuple[list[tuple[str, str]], list[str], int]:
    """What is said of the pages, as a place and a message each, the rules that fired, and the exit
    code.
    """
    (folder / "rules").mkdir(exist_ok=True)
    for number, text in enumerate(pages):
        (folder / "rules" / f"page-{number}.md").write_text(text, encoding="utf-8")
    for number, text in enumerate(files):
        (folder / f"{number}.msaa.yaml").write_text(text, encoding="utf-8")
    done = run(folder, "check", "--isolated", "--rules", "rules", "--output", "json", ".")
    found: list[dict[str, Any]] = json.loads(done.stdout)["findings"]
    place = "{file}:{line}:{column}"
    pages_said = [
        (place.format(**each), each["message"])
        for each in found
        if each["file"].startswith("rules/")
    ]
    assert {each["code"] for each in found if each["file"].startswith("rules/")} <= {"MSAA921"}
    return (
        pages_said,
        [each["code"] for each in found if each["code"].startswith("ACME")],
        done.returncode,
    )


def steps(when: str, **facts: Any) -> int:
    return Condition(when, "image").cost.steps(
        {name.replace("__", "."): value for name, value in facts.items()}
    )


@pytest.mark.parametrize(
    ("when", "growth"),
    [
        ("image.name == 'x'", 1),
        ("image.name + image.name == 'x'", 1),
        ("image.name.contains('x') && image.name.startsWith('y')", 1),
        ("image.usage.all(u, u == image.name)", 2),
        ("image.usage.map(u, image.name + u).size() > 2", 2),
        ("image.usage.filter(u, u != image.name).size() > 2", 2),
        ("image.usage.map(u, image.usage.map(v, u + v)).size() > 2", 3),
        ("{'a': image.name}.a == image.name", 1),
        ("(image.samples > 1 ? image.name : image.format) == 'x'", 1),
        ("string(image.name) == 'x' && image.name in [image.name]", 1),
        ("image.name.matches('(a|b)*c')", 1),
    ],
)
def test_steps_grow_with_the_sizes_of_the_facts(when: str, growth: float) -> None:
    """Doubled sizes double the steps, or square and cube them: what CEL does is no less."""

    def at(size: int) -> int:
        return steps(
            when,
            image__name="n" * size * 100,
            image__usage=["u" * 100] * size,
            image__format="x",
            image__samples=4,
        )

    assert 0.8 * 2**growth < at(800) / at(400) < 1.3 * 2**growth


def test_steps_of_iterations_stop_where_cel_stops() -> None:
    when = "image.usage.all(u, u == 'x')"
    assert (
        steps(when, image__usage=["u"] * MAX_ITERATIONS * 4)
        < 1.5 * steps(when, image__usage=["u"] * MAX_ITERATIONS) + 80_000 + 1
    )


@pytest.mark.parametrize(
    ("pattern", "least"),
    [
        ("a", 1),
        ("(a*)*b", 3),
        ("a{1000}", 1000),
        ("(a{0,100}){0,10}", 1000),
        ("a{2,}", 2),
        (r"\pL{100}", 10_000),
        ("((a{9}){9}){9}", 729),
    ],
)
def test_instructions_of_a_pattern(pattern: str, least: int) -> None:
    assert least <= pattern_instructions(pattern) <= 1000 * 200 * (len(pattern) + 1)


def test_a_pattern_is_a_literal() -> None:
    check("image.name.matches(r'^a.*\\d$')", "image")
    for when in (
        "image.name.matches(image.format)",
        "matches(image.name, 'a' + image.format)",
        "['a'].exists(p, image.name.matches(p))",
    ):
        with pytest.raises(
            ConditionError, match="the pattern of `matches` must be a text in quotes"
        ):
            check(when, "image")


HOSTILE = [
    "'[1, 2, 3, 4, 5, 6, 7, 8, 9].map(a, [1, 2, 3, 4, 5, 6, 7, 8, 9].map(b, image.name + "
    "image.name)).size() > 0'",
    "'[image.name, image.name].map(a, a + a).map(a, a + a + a + a + a + a + a + a + a + a + a + a "
    "+ a + a + a + a).size() > 0'",
    "image.name.matches('(n|nn)*(n{0,100}){0,10}q')",
    "image.name.matches(r'\\pL{1000}')",
    "'("
    + " + ".join(["image.name"] * 20)
    + ').contains("q") && [1].map(x, ['
    + ",".join("1" * 300)
    + "].map(y, image.name)).size() > 0'",
]


@pytest.mark.parametrize("when", HOSTILE, ids=[when[:30] for when in HOSTILE])
def test_a_costly_condition_is_a_finding_on_its_page(tmp_path: Path, when: str) -> None:
    """Once, at the condition; the page is off from there on, and the others are not."""
    frames = [frame(f"{LONG}{number}") for number in range(3)]
    said, fired, code = reported(tmp_path, [page(when=when), page("ACME002")], *frames)
    assert [place for place, _ in said] == ["rules/page-0.md:5:7"]
    assert (
        "steps, more than the limit of 2000000; it was turned off at 0.msaa.yaml, and not run from "
        "there on" in said[0][1]
    )
    assert said[0][1].startswith("rule page `page-0`: evaluating the condition may take ")
    assert (fired, code) == (["ACME002"] * 3, 2)


def test_a_costly_case_is_a_finding_at_the_case(tmp_path: Path) -> None:
    front = (
        f"cases:\n  - when: image.samples > 8\n    message: many\n  - when: {HOSTILE[0]}\n    "
        "message: long\n"
    )
    said, fired, code = reported(tmp_path, [page(front=front), page("ACME002")], frame(LONG))
    assert [place for place, _ in said] == ["rules/page-0.md:10:11"]
    assert (fired, code) == (["ACME002"], 2)


def test_the_budget_is_that_of_the_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Pages together, over documents and files: who takes most is turned off first, and who takes
    little goes on.
    """
    monkeypatch.setattr(budget.Budget.__init__, "__defaults__", (300_000,))
    monkeypatch.setattr(budget, "INPUT", 0)
    when = (
        "'[1, 2, 3, 4, 5, 6, 7, 8, 9].map(a, [1, 2, 3].map(b, image.name + image.name)).size() "
        "> 0 && image.samples < 0'"
    )
    frames = [
        "---\n".join(
            f"images: {{{'n' * 400}{file}{number}: {{samples: 4}}}}\n" for number in range(2)
        )
        for file in range(8)
    ]
    said, fired, code = reported(
        tmp_path, [page(when=when), page("ACME002", when), page("ACME003")], *frames
    )
    assert [place for place, _ in said] == ["rules/page-0.md:5:7", "rules/page-1.md:5:7"]
    assert all(
        "it has used up its part of the 300000 steps that the custom rules of a run may take; it "
        "was turned off at " in text
        for _, text in said
    )
    assert (fired, code) == (["ACME003"] * 16, 2)


def test_findings_count_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(budget.Budget.__init__, "__defaults__", (200_000,))
    monkeypatch.setattr(budget, "INPUT", 0)
    rows = ", ".join(f"i{number}: {{samples: 4}}" for number in range(500))
    said, fired, code = reported(
        tmp_path,
        [page(message="'{image.samples} {image.name} " + "m" * 1000 + "'")],
        f"images: {{{rows}}}",
    )
    assert [place for place, _ in said] == ["rules/page-0.md:6:10"]
    assert 10 < len(fired) < 50
    assert code == 2


def test_pages_of_two_configurations_share_the_budget(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(budget.Budget.__init__, "__defaults__", (60_000,))
    monkeypatch.setattr(budget, "INPUT", 0)
    for name in "abcdef":
        (tmp_path / name / "rules").mkdir(parents=True)
        (tmp_path / name / "msaa-lint.toml").write_text('rules = ["rules"]\n')
        (tmp_path / name / "rules" / f"{name}.md").write_text(
            page(when="image.samples > 1 && " * 5 + "true")
        )
        (tmp_path / name / "a.msaa.yaml").write_text("images: {i: {samples: 4}}")
    done = run(tmp_path, "check", "--output", "json", ".")
    found = json.loads(done.stdout)["findings"]
    assert done.returncode == 2
    assert [each["file"] for each in found if each["code"] == "MSAA921"] == [
        f"{name}/rules/{name}.md" for name in "bcdef"
    ]
    assert [each["file"] for each in found if each["code"] == "ACME001"] == ["a/a.msaa.yaml"]


def test_a_value_in_a_message_is_shortened(tmp_path: Path) -> None:
    (tmp_path / "a.md").write_text(page(message="'<{image.name}>'"))
    (tmp_path / "a.msaa.yaml").write_text(frame(LONG))
    done = run(
        tmp_path, "check", "--isolated", "--rules", "a.md", "--output", "json", "a.msaa.yaml"
    )
    (found,) = (each for each in json.loads(done.stdout)["findings"] if each["code"] == "ACME001")
    assert found["message"] == f"<{'n' * 499}…>"


LIMITS = [
    (page(message="'" + "{image.name}" * 80_000 + "'"), ["6:10"], "`message` is longer than 2000 "
        "characters"),
    (page(front=f"help: '{'h' * 2001}'\n"), ["7:7"], "`help` is longer than 2000 characters"),
    (page(when="'" + "image.samples > 1 || " * 100 + "true'"), ["5:7"], "the condition is longer "
        "than 2000 characters"),
    (page(front="cases:\n" + "  - {when: 'true'}\n" * 400), ["8:3"], "`cases`: expected at most "
        "100 items, found 400"),
    (page(front="labels:\n" + "".join(f"  l{n}: x\n" for n in range(101))), ["8:3"], "`labels`: "
        "expected at most 100 items, found 101"),
    (page(front="references:\n" + "  - x\n" * 101), ["8:3"], "`references`: expected at most 100 "
        "items, found 101"),
    (
        page(front="fix:\n  title: t\n  safety: unsafe\n  add:\n    image.usage: [" + "SAMPLED, " * 101 + "]\n"),
        ["11:18"],
        "`image.usage`: expected at most 100 items, found 101",
    ),
    (
        page(front="a: &a [x,x,x,x,x,x,x,x,x,x]\n" + "".join(f"{b}: &{b} [" + f"*{a}," * 9 + f"*{a}]\n" for a, b in ("ab", "bc", "cd"))),
        ["10:29"],
        "the number of nodes with aliases expanded exceeds the limit of 10000",
    ),
    (page(front="help: " + "[" * 30 + "]" * 30 + "\n"), ["7:26"], "the nesting exceeds the limit "
        "of 20"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "places", "message"), LIMITS, ids=[message[:30] for _, _, message in LIMITS]
)
def test_the_front_matter_is_limited(
    tmp_path: Path, text: str, places: list[str], message: str
) -> None:
    said, fired, code = reported(tmp_path, [text, page("ACME002")], "images: {i: {samples: 4}}")
    assert said == [
        (f"rules/page-0.md:{place}", f"rule page `page-0`: {message}") for place in places
    ]
    assert (fired, code) == (["ACME002"], 2)


def test_mistakes_of_a_page_are_limited(tmp_path: Path) -> None:
    """Those of its texts, and those of its keys."""
    texts = page(message="'" + "".join(f"{{image.n{n}}}" for n in range(150)) + "'")
    keys = page("ACME002", front="".join(f"mesage{n}: x\n" for n in range(1000)))
    said, _, code = reported(tmp_path, [texts, keys], "images: {i: {samples: 4}}")
    assert [sum(place.startswith(f"rules/page-{n}.md") for place, _ in said) for n in range(2)] == [
        rule_file.MAX_PROBLEMS
    ] * 2
    assert code == 2


def test_aliases_count_as_often_as_they_are_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A page of 7 kB that states 600 kB is charged for 600 kB."""
    charged: list[int] = []
    charge = budget.Budget.charge
    monkeypatch.setattr(
        budget.Budget,
        "charge",
        lambda self, page, steps: (charged.append(steps), charge(self, page, steps))[1],
    )
    long, condition = "m" * 1990, "image.samples > 4 || " * 90 + "false"
    front = (
        f"cases:\n  - {{when: &w '{condition}', message: &m '{long}', help: *m}}\n"
        + "  - {when: *w, message: *m, help: *m}\n" * 99
    )
    reported(tmp_path, [page(front=front)], "images: {i: {samples: 2}}")
    assert charged[0] > 100 * (budget.COMPILE * len(condition) + 2 * budget.READ * len(long))


def test_pages_beyond_the_budget_are_not_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(budget.Budget.__init__, "__defaults__", (2 * budget.MISTAKE,))
    said, _, code = reported(
        tmp_path, [page(when="image.sampels > 2")] * 3, "images: {i: {samples: 4}}"
    )
    assert [place for place, _ in said] == [
        "rules/page-0.md:5:7",
        "rules/page-1.md:5:7",
        "rules/page-2.md:None:None",
    ]
    assert said[2][1].endswith(
        "it was not read: the pages before it took the 80000 steps that the custom rules of a run "
        "may take"
    )
    assert code == 2


def test_suppressions_of_a_page_that_is_off_are_not_unused(tmp_path: Path) -> None:
    frames = [
        f"images: {{{LONG}: {{samples: 4}}}} # msaa-lint: ignore[page-0]\n",
        "images: {i: {samples: 4}} # msaa-lint: ignore[page-0]\n",
    ]
    reported(tmp_path, [page(when=HOSTILE[0])], *frames)
    done = run(tmp_path, "check", "--isolated", "--rules", "rules", "--output", "concise", ".")
    assert "unused" not in done.stdout


def test_trials_for_missing_keys_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(budget.Budget.__init__, "__defaults__", (200_000,))
    monkeypatch.setattr(budget, "INPUT", 0)
    when = " || ".join(f"image.samples == {n} && image.width == {n}" for n in range(40))
    (tmp_path / "a.md").write_text(page(when=when))
    (tmp_path / "a.msaa.yaml").write_text(
        "images: {" + ", ".join(f"i{n}: {{}}" for n in range(100)) + "}"
    )
    done = run(
        tmp_path, "check", "--isolated", "--rules", "a.md", "--explain-undecided", "a.msaa.yaml"
    )
    assert "it has used up its part of the 200000 steps" in done.stdout
    assert done.returncode == 2


def test_large_inputs_have_a_larger_budget(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What many pages take of a large corpus is no attack."""
    monkeypatch.setattr(budget.Budget.__init__, "__defaults__", (200_000,))
    rows = ", ".join(f"i{number}: {{samples: 4}}" for number in range(500))
    said, fired, _ = reported(tmp_path, [page()], f"images: {{{rows}}}")
    assert (said, len(fired)) == ([], 500)

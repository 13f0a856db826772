"""Every mistake in a custom rule page is one finding, at its place, which says what to write."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command import run

PAGE = """\
---
code: ACME001
severity: warning
subject: image
when: image.samples > 2 && image.is_color
message: "`{image.name}` has {image.samples} samples"
---
The studio's limit for eye buffers.
"""
WARNING = "severity: warning"
WHEN = "when: image.samples > 2 && image.is_color"
MESSAGE = 'message: "`{image.name}` has {image.samples} samples"'
FENCES = "a rule page must begin with front matter between two `---` lines"
CODE = "the code must be 2 to 12 capital letters other than MSAA and a number, for example ACME001"
SUBJECTS = (
    "image, attachment, aspect, pass, subpass, resolve, pipeline, dependency, read, copy, choice"
)
KEYS = (
    "code, severity, confidence, subject, when, message, at, labels, cases, help, fix, vendors, "
    "edition, references, supersedes, apis, "
)
KEYS += "passes"


def and_also(line: str) -> tuple[str, str]:
    """A page with one more key."""
    return WARNING, f"{WARNING}\n{line}"


def fix(text: str) -> tuple[str, str]:
    return and_also(f"fix: {{title: x, safety: unsafe, {text}}}")


CASES: list[tuple[tuple[str, str] | str, str, str]] = [
    # The page, or what is replaced in it by what; the line and columns of the finding; its message.
    ("", "1:1-1", f"{FENCES}, but it is empty"),
    ("# Budget\n", "1:1-9", f"{FENCES}: expected `---`, found `# Budget`"),
    ("+++\ncode = 'ACME001'\n+++\n", "1:1-4", f"{FENCES}: expected `---`, found `+++`"),
    (f"\n{PAGE}", "2:1-4", f"{FENCES}: remove what precedes the first one"),
    (('samples"\n---', 'samples"\n'), "1:1-4", f"{FENCES}: the second one is missing"),
    (
        ('samples"\n---', 'samples"\n----'),
        "7:1-5",
        f"{FENCES}: the second one must be `---`, found `----`",
    ),
    (
        ('samples"\n---', 'samples"\n...'),
        "7:1-4",
        f"{FENCES}: the second one must be `---`, found `...`",
    ),
    ("---\n---\nText.\n", "1:1-4", "the front matter must be a mapping of keys, it is empty"),
    (
        "---\n- code: ACME001\n---\n",
        "2:1-16",
        "the front matter must be a mapping of keys, found a list",
    ),
    ("---\nACME001\n---\n", "2:1-8", "the front matter must be a mapping of keys, found `ACME001`"),
    # Keys.
    ((WARNING, "severty: warning"), "3:1-8", "unknown key `severty`: did you mean `severity`?"),
    ((WARNING, "Severity: warning"), "3:1-9", "unknown key `Severity`: did you mean `severity`?"),
    (
        and_also("label: {image.samples: here}"),
        "4:1-6",
        "unknown key `label`: did you mean `labels`?",
    ),
    (and_also("zzz: 1"), "4:1-4", f"unknown key `zzz`: expected one of {KEYS}"),
    ((f"{WARNING}\n", ""), "1:1-4", "missing `severity` in the front matter"),
    (
        "---\ncode: ACME001\nsubject: image\n---\n",
        "1:1-4",
        "missing `severity`, `when`, `message` in the front matter",
    ),
    (and_also(WARNING), "4:1-9", "duplicate key `severity`; remove one of the two"),
    # Values.
    (
        (WARNING, "severity: warn"),
        "3:11-15",
        "`severity`: expected one of note, warning, error, found `warn`; did you mean `warning`?",
    ),
    (
        (WARNING, "severity: [warning]"),
        "3:11-20",
        "`severity`: expected one of note, warning, error, found a list",
    ),
    (
        (WARNING, "severity:"),
        "3:10-10",
        "`severity`: expected one of note, warning, error, found nothing",
    ),
    (
        and_also("confidence: hihg"),
        "4:13-17",
        "`confidence`: expected one of low, medium, high, found `hihg`; did you mean `high`?",
    ),
    (
        ("subject: image", "subject: images"),
        "4:10-16",
        f"`subject`: expected one of {SUBJECTS}, found `images`; did you mean `image`?",
    ),
    (and_also("apis: [opengl]"), "4:8-14", "`apis`: expected one of vulkan, metal, found `opengl`"),
    (and_also("apis: metal"), "4:7-12", "`apis`: expected a list, found `metal`; write `[metal]`"),
    (and_also("passes: every"), "4:9-14", "`passes`: expected one of begun, all, found `every`"),
    (
        and_also("passes: all"),
        "4:9-12",
        "`passes` is for subjects that are parts of passes (pass, attachment, aspect, subpass, "
        "resolve, dependency), not for image",
    ),
    (and_also('edition: "2025.1"'), "4:10-18", "unknown edition `2025.1`: expected one of 2026.1"),
    (("code: ACME001", "code: acme1"), "2:7-12", f"{CODE}; found `acme1`"),
    (("code: ACME001", "code: MSAA201"), "2:7-14", f"{CODE}; found `MSAA201`"),
    (("code: ACME001", "code: [ACME001]"), "2:7-16", "`code`: expected a string, found a list"),
    (and_also("supersedes: [my-rule]"), "4:14-21", "the rule supersedes itself"),
    (
        and_also("supersedes: [sample-count-above-for]"),
        "4:14-36",
        "`supersedes`: unknown rule `sample-count-above-for`; did you mean "
        "`sample-count-above-four`?",
    ),
    ((MESSAGE, 'message: ""'), "6:10-12", "`message` must not be empty"),
    ((MESSAGE, "message: [a]"), "6:10-13", "`message`: expected a string, found a list"),
    # Conditions.
    (
        ("image.is_color", "image.is_colour"),
        "5:28-43",
        "unknown fact image.is_colour of image; did you mean image.is_color?",
    ),
    (
        ("image.is_color", "attachment.drawn"),
        "5:28-44",
        "unknown fact attachment.drawn of image; it is a fact of attachment, aspect",
    ),
    (
        ("image.is_color", 'image.format == "R8G8B8A8_UNROM"'),
        "5:44-60",
        "image.format is never 'R8G8B8A8_UNROM'; did you mean 'R8G8B8A8_UNORM'?",
    ),
    (
        ("image.samples > 2", 'image.samples > "2"'),
        "5:21-22",
        "`>` cannot be applied to int and string",
    ),
    (("&&", "and"), "5:25-28", "unexpected `and` in the condition: write `&&`"),
    (
        (WHEN, "when: image.samples"),
        "5:7-20",
        "the condition must be a boolean expression, found int",
    ),
    (
        (WHEN, "when: >-\n  image.samples > 2\n  && image.sampels < 9"),
        "7:6-19",
        "unknown fact image.sampels of image; did you mean image.samples?",
    ),
    (
        and_also("cases: [{when: image.sampels > 4}]"),
        "4:16-29",
        "unknown fact image.sampels of image; did you mean image.samples?",
    ),
    # Facts in texts.
    (
        ("{image.samples}", "{image.sampels}"),
        "6:31-44",
        "unknown fact image.sampels of image; did you mean image.samples?",
    ),
    (
        (MESSAGE, "message: >-\n  `{image.name}` has\n  {image.sampels} samples"),
        "8:4-17",
        "unknown fact image.sampels of image; did you mean image.samples?",
    ),
    (
        ("{image.samples}", "{aspect.load}"),
        "6:31-42",
        "unknown fact aspect.load of image; it is a fact of aspect",
    ),
    (
        ("{image.samples}", "{ image.samples }"),
        "6:30-47",
        "`{ image.samples }` must be written `{image.samples}`",
    ),
    (
        ("{image.samples}", "{{image.samples}}"),
        "6:30-32",
        "write one brace, not two, around a fact",
    ),
    (
        ("image.is_color", 'image.format == "D16_UNORM'),
        "5:44-45",
        "the quote of a text is not closed",
    ),
    (("image.is_color", "is_color(image.samples)"), "5:28-36", "unknown function is_color"),
    (("{image.samples}", "{}"), "6:30-32", "`{}` names no fact"),
    (("{image.samples}", "{image.samples"), "6:30-44", "`{image.samples` has no closing brace"),
    (
        and_also('help: "at most {image.sampels}"'),
        "4:17-30",
        "unknown fact image.sampels of image; did you mean image.samples?",
    ),
    (
        and_also("at: [image.samples, image.formt]"),
        "4:21-32",
        "unknown fact image.formt of image; did you mean image.format?",
    ),
    (
        and_also("labels: {image.formt: here}"),
        "4:10-21",
        "unknown fact image.formt of image; did you mean image.format?",
    ),
    (
        and_also("labels: {image.format: 'is {image.formt}'}"),
        "4:29-40",
        "unknown fact image.formt of image; did you mean image.format?",
    ),
    (
        and_also("cases: [{when: image.samples > 4, message: '{image.nam}'}]"),
        "4:46-55",
        "unknown fact image.nam of image; did you mean image.name?",
    ),
    # Cases and fixes.
    (
        and_also("cases: [{severity: note}]"),
        "4:9-25",
        "a case must be a mapping with `when` and what differs",
    ),
    (
        and_also("cases: [{wen: image.samples > 4}]"),
        "4:10-13",
        "unknown key `wen`: did you mean `when`?",
    ),
    (
        and_also("cases: [{when: image.samples > 4, mesage: x}]"),
        "4:35-41",
        "unknown key `mesage`: did you mean `message`?",
    ),
    (
        and_also("fix: {title: x, set: {image.samples: 2}}"),
        "4:6-41",
        "a fix must be a mapping with `title`, `safety` (safe, unsafe, shown) and what it changes; "
        "missing `safety`",
    ),
    (
        and_also("fix: {title: x, saftey: safe, set: {image.samples: 2}}"),
        "4:17-23",
        "unknown key `saftey`: did you mean `safety`?",
    ),
    (
        and_also("fix: {title: x, safety: unsafe}"),
        "4:6-32",
        "a fix must state what it changes: `set`, `add`, `remove` or `do`",
    ),
    (fix("sets: {image.samples: 2}"), "4:33-37", "unknown key `sets`: did you mean `set`?"),
    (
        fix("set: {image.sampels: 2}"),
        "4:39-52",
        "unknown fact `image.sampels`: did you mean `image.samples`?",
    ),
    (
        fix("set: {aspect.store: NONE}"),
        "4:39-51",
        "unknown fact aspect.store of image; it is a fact of aspect",
    ),
    (
        fix("set: {image.is_color: true}"),
        "4:39-53",
        "fixes cannot change `image.is_color`; use one of image.samples, image.usage, "
        "image.memory, image.flags, image.tiling, image.type, "
        "image.sharing_mode, image.mip_levels",
    ),
    (
        fix("set: {image.samples: two}"),
        "4:54-57",
        "expected a value of image.samples (INT), found `two`",
    ),
    (
        fix("set: {image.usage: SAMPLED}"),
        "4:39-50",
        "image.usage is a list: it cannot be changed with `set`; use `add` or `remove`",
    ),
    (
        fix("add: {image.usage: SMAPLED}"),
        "4:52-59",
        "`image.usage` is never `SMAPLED`; did you mean `SAMPLED`?",
    ),
    (
        fix("do: make_transient"),
        "4:37-51",
        "unknown action `make_transient`: did you mean `make-transient`?",
    ),
    (
        and_also('fix: {title: "use {image.sampels}", safety: unsafe, set: {image.samples: 2}}'),
        "4:20-33",
        "unknown fact image.sampels of image; did you mean image.samples?",
    ),
]


def problems(
    folder: Path, page: str, name: str = "my-rule", *arguments: str
) -> list[tuple[str, str]]:
    """The places and messages of the findings of `check` with a page, in its only place: before all
    other findings.
    """
    (folder / f"{name}.md").write_text(page, encoding="utf-8")
    (folder / "frame.msaa.yaml").write_text("images: {a: {samples: 2}}\n", encoding="utf-8")
    done = run(
        folder,
        "check",
        "--isolated",
        "--rules",
        f"{name}.md",
        *arguments,
        "--output",
        "json",
        "frame.msaa.yaml",
    )
    assert done.returncode == 2, done.stdout
    assert "Traceback" not in done.stderr
    found = []
    for each in json.loads(done.stdout)["findings"]:
        if each["code"] == "MSAA921":
            assert (each["file"], each["line"]) == (f"{name}.md", each["end_line"])
            found.append((f"{each['line']}:{each['column']}-{each['end_column']}", each["message"]))
    return found


@pytest.mark.parametrize(
    ("change", "place", "message"), CASES, ids=[message[:60] for _, _, message in CASES]
)
def test_a_mistake_in_a_page_is_one_finding(
    tmp_path: Path, change: tuple[str, str] | str, place: str, message: str
) -> None:
    if isinstance(change, tuple):
        assert PAGE.count(change[0]) == 1
        change = PAGE.replace(*change)
    assert problems(tmp_path, change) == [(place, f"rule page `my-rule`: {message}")]


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ((WHEN, "when image.samples > 2"), 5),
        ((MESSAGE, "message: {image.name} has too many samples"), 6),
        ((MESSAGE, "message: `{image.name}` has too many samples"), 6),
        ((MESSAGE, "message: too many samples: at most two"), 6),
        ((WHEN, "when: !image.is_color"), 5),
        (and_also("cases:\n\t- when: image.samples > 4"), 5),
    ],
)
def test_what_is_not_yaml_is_one_finding_of_the_page(
    tmp_path: Path, change: tuple[str, str], line: int
) -> None:
    ((place, message),) = problems(tmp_path, PAGE.replace(*change))
    assert place.startswith(f"{line}:")
    assert message.startswith("rule page `my-rule`: ")


def test_several_mistakes_are_found_at_once_in_order(tmp_path: Path) -> None:
    page = (
        PAGE.replace("{image.name}", "{image.nam}")
        .replace("{image.samples}", "{image.sampels}")
        .replace("image.is_color", "image.colour")
    )
    assert [place for place, _ in problems(tmp_path, page)] == ["5:28-40", "6:13-22", "6:30-43"]


def test_a_broken_page_is_the_first_finding(tmp_path: Path) -> None:
    (tmp_path / "team").mkdir()
    (tmp_path / "team" / "My_Rule.md").write_text(PAGE, encoding="utf-8")
    (tmp_path / "msaa-lint.toml").write_text(
        'rules = ["team"]\nignore = ["my-rule"]\n', encoding="utf-8"
    )
    (tmp_path / "frame.msaa.yaml").write_text("images: {a: {samples: 2}}\n", encoding="utf-8")
    done = run(tmp_path, "check", "--output", "concise", ".")
    assert [line.split(":")[0] for line in done.stdout.splitlines()[:3]] == [
        "team/My_Rule.md",
        "msaa-lint.toml",
        "frame.msaa.yaml",
    ]


@pytest.mark.parametrize(
    ("code", "name"), [("MSAA105", "my-rule"), ("ACME001", "sample-count-not-portable")]
)
def test_a_broken_page_does_not_stand_for_a_built_in_rule(
    tmp_path: Path, code: str, name: str
) -> None:
    (tmp_path / f"{name}.md").write_text(PAGE.replace("ACME001", code), encoding="utf-8")
    text = (
        "images: {a: {samples: 2}}  # msaa-lint: ignore[MSAA105, sample-count-not-portable] "
        "agreed\n"
    )
    (tmp_path / "frame.msaa.yaml").write_text(text, encoding="utf-8")
    done = run(
        tmp_path,
        "check",
        "--isolated",
        "--rules",
        f"{name}.md",
        "--output",
        "json",
        "frame.msaa.yaml",
    )
    result = json.loads(done.stdout)
    assert [each["finding"]["code"] for each in result["suppressed"]] == ["MSAA105"]
    assert [each["file"] for each in result["findings"]] == [f"{name}.md"]


@pytest.mark.parametrize(
    "broken", ["severty: warning", "severity: warning\ncode: [", "severity: warning\n: :"]
)
def test_a_broken_page_does_not_make_its_rule_unknown(tmp_path: Path, broken: str) -> None:
    """What names the rule in the configuration, on the command line, and in a comment is right."""
    (tmp_path / "team").mkdir()
    (tmp_path / "team" / "my-rule.md").write_text(PAGE.replace(WARNING, broken), encoding="utf-8")
    (tmp_path / "msaa-lint.toml").write_text(
        'rules = ["team"]\nextend-select = ["ACME001", "my-rule", "ACME"]\n', encoding="utf-8"
    )
    (tmp_path / "frame.msaa.yaml").write_text(
        "images: {a: {samples: 2}}  # msaa-lint: ignore[my-rule, ACME001] agreed\n",
        encoding="utf-8",
    )
    done = run(tmp_path, "check", "--extend-select", "ACME001", "--output", "json", ".")
    findings = [
        each for each in json.loads(done.stdout)["findings"] if each["code"].startswith("MSAA9")
    ]
    assert {(each["file"], each["code"]) for each in findings} == {("team/my-rule.md", "MSAA921")}
    assert done.returncode == 2

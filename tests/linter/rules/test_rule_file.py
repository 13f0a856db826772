"""Rule pages as a user writes them, and as somebody hostile does."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.finding import Finding
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from msaa_lint.linter.rules.registry import Registry, load, markdown
from msaa_lint.linter.rules.rule import Rule
from msaa_lint.linter.rules.rule_file import KEYS, MAX_CONDITION, first_sentence, read_page, split
from tests.marked import unmarked
from tests.strength import examples

PAGE = """---
code: ACME001
severity: warning
subject: image
when: image.samples > 2
message: "`{image.name}` has {image.samples} samples"
---
We have at most two. The rest of the page.
"""


def loaded(folder: Path, text: str, name: str = "too-many-samples.md") -> Registry:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return load([str(path)])


def own(catalogue: Registry) -> list[str]:
    return [rule.name for rule in catalogue.rules if not rule.code.startswith("MSAA")]


def lint(catalogue: Registry, text: str) -> FileResult:
    return Engine(catalogue).lint(
        text.encode(), "frame.yaml", LintOptions(lambda rule, suggested, vendor: suggested)
    )


def said(linted: FileResult) -> list[tuple[str, str, str, str]]:
    out = []
    for found in linted.findings:
        if not found.code.startswith("MSAA"):
            assert linted.source is not None and found.span is not None
            out.append(
                (
                    found.code,
                    found.severity,
                    found.message,
                    linted.source.text[found.span.start : found.span.end],
                )
            )
    return out


def test_a_page_is_a_rule(tmp_path: Path) -> None:
    catalogue = loaded(tmp_path, PAGE)
    assert catalogue.problems == ()
    assert own(catalogue) == ["too-many-samples"]
    (rule,) = (rule for rule in catalogue.rules if rule.code == "ACME001")
    assert (rule.confidence, rule.edition, rule.vendors, rule.cases, rule.fix, rule.at) == (
        "high",
        "",
        (),
        (),
        None,
        (),
    )
    assert rule.summary == "We have at most two."
    assert markdown(rule) == "We have at most two. The rest of the page.\n"
    linted = lint(catalogue, "images: {a: {samples: 4}, b: {samples: 2}, c: {}}")
    assert said(linted) == [("ACME001", "warning", "`a` has 4 samples", "4")]
    assert [(u.subject, u.missing) for u in linted.undecided if u.code == "ACME001"] == [
        ("images.c", ("image.samples",))
    ]


def test_everything_that_a_page_may_have(tmp_path: Path) -> None:
    text = PAGE.replace(
        "message:",
        """confidence: medium
at: [image.name, image.samples]
labels: {image.format: "its format is {image.format}"}
cases:
  - when: image.samples > 8
    severity: error
    confidence: high
    message: far too many
  - {when: image.samples > 4, severity: note}
help: have 2
fix: {title: two samples, safety: unsafe, set: {image.samples: 2}}
vendors: [arm, img]
references: [VUID-1]
supersedes: [sample-count-above-four]
message:""",
    )
    catalogue = loaded(tmp_path, text)
    assert catalogue.problems == ()
    linted = lint(
        catalogue,
        "images: {a: {format: R8_UNORM, samples: 4}, b: {format: R8_UNORM, samples: 8}, c: "
        "{format: R8_UNORM, samples: 16}}",
    )
    found = [f for f in linted.findings if f.code == "ACME001"]
    assert [(f.severity, f.confidence, f.message) for f in found] == [
        ("warning", "medium", "`a` has 4 samples"),
        ("note", "medium", "`b` has 8 samples"),
        ("error", "high", "far too many"),
    ]
    assert all(
        f.help == "have 2" and f.fix is not None and not f.fix.safe and f.fix.title == "two samples"
        for f in found
    )
    assert [label.text for label in found[0].labels] == ["its format is R8_UNORM"]
    # The rule that it stands for is told with it, and not by itself.
    assert found[1].notes == ("covers sample-count-above-four (MSAA101) too",)
    assert "sample-count-above-four" not in {f.rule for f in linted.findings}


VULKAN = "images: {a: {samples: 4}}"
METAL = "metal: {textures: {a: {sampleCount: 4}}}"


@pytest.mark.parametrize(
    ("apis", "vulkan", "metal"),
    [
        ("", True, False),
        ("[vulkan]", True, False),
        ("[metal]", False, True),
        ("[metal, vulkan, metal]", True, True),
    ],
)
def test_a_rule_is_asked_of_its_apis_alone(
    tmp_path: Path, apis: str, vulkan: bool, metal: bool
) -> None:
    catalogue = loaded(
        tmp_path, PAGE.replace("subject:", f"apis: {apis}\nsubject:") if apis else PAGE
    )
    assert catalogue.problems == ()
    # One engine for both: what it remembers of one API's frames it does not tell of the other's.
    engine = Engine(catalogue)
    for text, asked in (
        (VULKAN, vulkan),
        (METAL, metal),
        (VULKAN, vulkan),
        ("metal: {textures: {a: {}}}", metal),
    ):
        linted = engine.lint(text.encode(), "frame.yaml", LintOptions(as_suggested))
        told = [
            (found.severity, found.message) for found in linted.findings if found.code == "ACME001"
        ]
        undecided = [unknown.missing for unknown in linted.undecided if unknown.code == "ACME001"]
        stated = "4" in text
        assert told == ([("warning", "`a` has 4 samples")] if asked and stated else [])
        assert undecided == ([("image.samples",)] if asked and not stated else []), (
            "not asked, and so not undecided"
        )


def as_suggested(rule: Rule, suggested: str, vendor: str | None) -> str:
    return suggested


def test_a_case_words_a_finding_for_its_api(tmp_path: Path) -> None:
    text = PAGE.replace(
        "message:",
        """apis: [vulkan, metal]
help: "samples: 2 in {frame.api}"
fix: {title: two samples, safety: unsafe, set: {image.samples: 2}}
cases:
  - {when: image.samples > 4, message: far too many}
  - when: frame.api == "METAL"
    message: "`{image.name}` has a sampleCount of {image.samples}"
    help: "sampleCount: 2 in {frame.api}"
    fix: {title: "sampleCount: 2", safety: unsafe, set: {image.samples: 2}}
message:""",
    )
    catalogue = loaded(tmp_path, text)
    assert catalogue.problems == ()
    found = [
        (each.message, each.help, each.fix.title if each.fix is not None else "")
        for frame in (VULKAN, METAL, METAL.replace("4", "8"))
        for each in lint(catalogue, frame).findings
        if each.code == "ACME001"
    ]
    assert found == [
        ("`a` has 4 samples", "samples: 2 in VULKAN", "two samples"),
        ("`a` has a sampleCount of 4", "sampleCount: 2 in METAL", "sampleCount: 2"),
        # A case without a help has the rule's.
        ("far too many", "samples: 2 in METAL", "two samples"),
    ]


@pytest.mark.parametrize("member", ["message", "help"])
def test_the_texts_of_a_case_name_facts(tmp_path: Path, member: str) -> None:
    catalogue = loaded(
        tmp_path,
        PAGE.replace(
            "message:",
            f"cases: [{{when: image.samples > 4, {member}: '{{image.nmae}}'}}]\nmessage:",
        ),
    )
    (found,) = catalogue.problems
    assert (
        found.message
        == "rule page `too-many-samples`: unknown fact image.nmae of image; did you mean "
        "image.name?"
    )


def problem(
    folder: Path, marked: str, name: str = "too-many-samples.md"
) -> tuple[Finding, str, list[str]]:
    """The one problem of a page, the text that it points at, and the marked texts."""
    # `unmarked` takes the line ends around a text away.
    text, spans = unmarked(marked)
    catalogue = loaded(folder, f"{text}\n", name)
    assert own(catalogue) == []
    (found,) = catalogue.problems
    assert found.code == "MSAA921"
    assert found.span is not None
    return (
        found,
        text[found.span.start : found.span.end],
        [text[span.start : span.end] for span in spans],
    )


CONDITION = "when: image.samples > 2"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            CONDITION,
            "when: ⟦image.sampels⟧ > 2",
            "unknown fact image.sampels of image; did you mean image.samples?",
        ),
        (
            CONDITION,
            "when: |\n  image.samples > 2 &&\n  ⟦image.sampels⟧ > 4",
            "unknown fact image.sampels of image; did you mean",
        ),
        (
            CONDITION,
            "when: >\n  image.samples > 2 &&\n  ⟦image.sampels⟧ > 4",
            "unknown fact image.sampels of image; did you mean",
        ),
        (
            CONDITION,
            "when: 'image.format == ⟦\"D17_UNORM\"⟧'",
            "image.format is never 'D17_UNORM'; did you mean 'D16_UNORM'?",
        ),
        (CONDITION, "when: ⟦image.samples⟧", "the condition must be a boolean expression"),
        (CONDITION, "when: ⟦~⟧", "expected a string, found "),
        (
            CONDITION,
            f"when: ⟦'{'x' * (MAX_CONDITION + 1)}'⟧",
            f"the condition is longer than {MAX_CONDITION} characters",
        ),
        (
            CONDITION,
            f"{CONDITION}\ncases: [{{when: ⟦'{'x' * (MAX_CONDITION + 1)}'⟧}}]",
            f"the condition is longer than {MAX_CONDITION} characters",
        ),
        (
            CONDITION,
            f"{CONDITION}\ncases:\n  - when: true\n  - when: ⟦image.sample⟧ > 2",
            "unknown fact image.sample of image",
        ),
        (CONDITION, f"{CONDITION}\ncases: ⟦7⟧", "expected a list, found "),
        (
            CONDITION,
            f"{CONDITION}\ncases: [⟦7⟧]",
            "a case must be a mapping with `when` and what differs",
        ),
        (
            CONDITION,
            f"{CONDITION}\ncases: [{{when: 'true', ⟦level⟧: error}}]",
            "unknown key `level`",
        ),
        (
            CONDITION,
            f"{CONDITION}\ncases: [{{when: 'true', severity: ⟦fatal⟧}}]",
            "expected one of note, warning, error, found `fatal`",
        ),
        (CONDITION, f"{CONDITION}\nat: ⟦{{a: 1}}⟧", "expected a string, found "),
        (CONDITION, f"{CONDITION}\napis: ⟦metal⟧", "expected a list, found "),
        (
            CONDITION,
            f"{CONDITION}\napis: [vulkan, ⟦directx⟧]",
            "expected one of vulkan, metal, found `directx`",
        ),
        (
            CONDITION,
            f"{CONDITION}\ncases: [{{when: 'true', help: ⟦[a]⟧}}]",
            "expected a string, found ",
        ),
        (CONDITION, f"{CONDITION}\nlabels: ⟦[a]⟧", "expected a mapping, found "),
        (CONDITION, f"{CONDITION}\n⟦whn⟧: 1", "unknown key `whn`"),
        (
            CONDITION,
            f"{CONDITION}\nfix: ⟦[]⟧",
            "a fix must be a mapping with `title`, `safety` (safe, unsafe, shown) and what it "
            "changes",
        ),
        (
            CONDITION,
            f"{CONDITION}\nfix: {{title: x, safety: ⟦yes⟧, set: {{image.samples: 2}}}}",
            "expected one of safe, unsafe, shown, found `yes`",
        ),
        (
            CONDITION,
            f"{CONDITION}\nvendors: [⟦ARM⟧]",
            "one of arm, img, amd, nvidia, qualcomm, apple, intel, broadcom, samsung, mesa, "
            "khronos",
        ),
        (CONDITION, f"{CONDITION}\nsupersedes: [too-many-samples]", "the rule supersedes itself"),
        (
            "severity: warning",
            "severity: ⟦fatal⟧",
            "expected one of note, warning, error, found `fatal`",
        ),
        (
            "subject: image",
            "subject: ⟦images⟧",
            "expected one of image, attachment, aspect, pass, subpass, resolve, pipeline, "
            "dependency, read, copy, choice, found ",
        ),
        (
            "code: ACME001",
            "code: MSAA999",
            "the code must be 2 to 12 capital letters other than MSAA and a number",
        ),
        (
            "code: ACME001",
            "code: acme",
            "the code must be 2 to 12 capital letters other than MSAA and a number",
        ),
        ("code: ACME001", "code: ⟦[ACME001]⟧", "expected a string, found "),
        (f"{CONDITION}\n", "", "missing `when` in the front matter"),
        (
            "{image.samples} samples",
            "{image.sampels} samples",
            "unknown fact image.sampels of image",
        ),
        ("{image.samples} samples", "{aspect.load} samples", "unknown fact aspect.load of image"),
        ("code: ACME001", "code: ACME001\n⟦code⟧: ACME002", None),
        ("code: ACME001", "code: ⟦!!python/object:os.system⟧ ACME001", None),
    ],
)
def test_what_is_wrong_with_a_page_and_where(
    tmp_path: Path, old: str, new: str, message: str | None
) -> None:
    assert PAGE.count(old) == 1
    found, at, marks = problem(tmp_path, PAGE.replace(old, new))
    if message is not None:
        assert message in found.message
    if marks:
        assert at == marks[0]


@pytest.mark.parametrize(
    ("name", "message"),
    [
        (
            "Too Many.md",
            "the file name must be lowercase words with hyphens; rename it to too-many.md",
        ),
        (
            "tooMany.md",
            "the file name must be lowercase words with hyphens; rename it to too-many.md",
        ),
        (
            "-.md",
            "the file name must be lowercase words with hyphens, for example "
            "no-multisampled-storage.md",
        ),
        ("syntax.md", "the name syntax is that of a diagnostic; rename the file"),
    ],
)
def test_names_that_no_selector_could_name(tmp_path: Path, name: str, message: str) -> None:
    found, _, _ = problem(tmp_path, PAGE, name)
    assert found.message.endswith(f": {message}")


def test_a_code_and_a_name_are_one_rules_own(tmp_path: Path) -> None:
    (tmp_path / "one.md").write_text(PAGE, encoding="utf-8")
    (tmp_path / "two.md").write_text(PAGE, encoding="utf-8")
    (tmp_path / "multisampled-attachment-stored.md").write_text(
        PAGE.replace("001", "002"), encoding="utf-8"
    )
    catalogue = load([str(tmp_path)])
    assert sorted(found.message for found in catalogue.problems) == [
        "rule page `multisampled-attachment-stored`: "
        "the name multisampled-attachment-stored is already used by a built-in rule; rename the "
        "file",
        "rule page `two`: the code ACME001 is already used by `one`",
    ]
    assert own(catalogue) == ["one"]


def test_a_page_that_is_named_twice_is_one_rule(tmp_path: Path) -> None:
    (tmp_path / "one.md").write_text(PAGE, encoding="utf-8")
    (tmp_path / "README.md").write_text("No page.", encoding="utf-8")
    catalogue = load([str(tmp_path), str(tmp_path / "one.md"), f"{tmp_path}/./one.md"])
    assert (catalogue.problems, own(catalogue)) == ((), ["one"])


def test_a_folder_without_pages_is_told(tmp_path: Path) -> None:
    (found,) = load([str(tmp_path)]).problems
    assert (found.code, found.message) == ("MSAA921", "no rule pages in this folder")


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"# No front matter\n",
        b"---\n",
        b"---\ncode: A1\n",
        b"---\n---\n",
        b"---\n[1, 2]\n---\n",
        b"---\nwords\n---\n",
        b"---\ncode: [\n---\n",
        b"---\na: &a [*a]\n---\n",
        b"---\n" + b"[" * 5000 + b"\n---\n",
        b"---\na: &a [x,x,x,x,x,x,x,x,x]\nb: &b [*a,*a,*a,*a,*a,*a,*a,*a,*a]\nc: &c "
        b"[*b,*b,*b,*b,*b,*b,*b,*b,*b]\n---\n",
        b"\xff\xfe\x00",
        b"---\ncode: \x00\n---\n",
        b"---\n" + b"x" * (1 << 20) + b"\n---\n",
        b"\n---\ncode: A1\n---\n",
    ],
)
def test_what_is_no_page(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "page.md"
    path.write_bytes(data)
    page = read_page(str(path), "page.md", None)
    assert page.rule is None
    assert {found.code for found in page.problems} == {"MSAA921"}


def test_a_page_that_is_not_there(tmp_path: Path) -> None:
    for path in (tmp_path / "none.md", tmp_path):
        page = read_page(str(path), "none.md", None)
        assert [found.code for found in page.problems] == ["MSAA921"]


VALUES: st.SearchStrategy[Any] = st.sampled_from(
    [
        "1",
        "~",
        "[]",
        "{}",
        "[a]",
        "{a: b}",
        "text",
        "'{'",
        "'{x}'",
        "image",
        "error",
        "[{}]",
        "[~]",
        "true",
        "!!str x",
        "*x",
        "&x y",
    ]
)


@examples(1.5)
@given(st.dictionaries(st.sampled_from(KEYS), VALUES, max_size=6))
def test_garbage_in_a_page_is_told_and_never_a_failure(
    tmp_path_factory: pytest.TempPathFactory, given_values: dict[str, str]
) -> None:
    lines = dict(line.split(": ", 1) for line in PAGE.split("---")[1].strip().splitlines())
    front = "\n".join(f"{key}: {value}" for key, value in {**lines, **given_values}.items())
    path = tmp_path_factory.getbasetemp() / "garbage-page.md"
    path.write_text(f"---\n{front}\n---\nWhy.\n", encoding="utf-8")
    catalogue = load([str(path)])
    assert {found.code for found in catalogue.problems} <= {"MSAA921"}
    assert bool(catalogue.problems) != (own(catalogue) == ["garbage-page"])
    lint(catalogue, "images: {a: {samples: 4}}")


def test_front_matter_keeps_its_place() -> None:
    front, body = split("---\na: 1\n---\nBody --- here\n---\n")
    assert front == "   \na: 1\n"
    assert body == "Body --- here\n---\n"
    assert split("---\r\na: 1\r\n---\r\nBody")[1] == "Body"
    assert split("no front")[0] is None
    assert split("---\na: 1\n----\n")[0] is None


@pytest.mark.parametrize(
    ("body", "sentence"),
    [
        ("One. Two.", "One."),
        ("# Title\n\nOne line\nand another. Two.\n", "One line and another."),
        ("One", "One"),
        ("", ""),
        ("```yaml\n", ""),
        ("Costs 1.5 MB. Much.", "Costs 1.5 MB."),
    ],
)
def test_the_first_sentence(body: str, sentence: str) -> None:
    assert first_sentence(body) == sentence

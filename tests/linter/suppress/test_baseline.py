import json
import os
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding, Suppressed
from msaa_lint.core.text.span import Span
from msaa_lint.linter.suppress.baseline import (
    MAX_BYTES,
    Baseline,
    Refused,
    Stale,
    apply,
    build,
    dump,
    load,
    prune,
    save,
    stale,
)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def finding(file: str = "a.yaml", rule: str = "stored", start: int = 0) -> Finding:
    return Finding("MSAA201", rule, "warning", "high", "", file, Span(start, start + 1))


def baseline(**counts: dict[str, int]) -> Baseline:
    return Baseline({file.replace("_", "."): own for file, own in counts.items()}, os.getcwd())


BROKEN = diagnostic("MSAA901", "broken", "a.yaml", Span(0, 1))


def test_up_to_the_count_is_silenced_and_beyond_it_all_is_shown() -> None:
    three = [finding(start=i) for i in range(3)]
    other = finding(rule="loaded")
    held = baseline(a_yaml={"stored": 3})
    assert apply([*three, other], held) == (
        [other],
        [Suppressed(each, "baseline") for each in three],
    )
    four = [*three, finding(start=9)]
    assert apply(four, held) == (four, [])


def test_an_entry_with_fewer_findings_than_counted_is_stale() -> None:
    held = baseline(a_yaml={"stored": 3, "loaded": 1}, b_yaml={"stored": 1})
    entries = stale(held, [finding()])
    assert entries == [
        Stale("a.yaml", "loaded", 1, 0),
        Stale("a.yaml", "stored", 3, 1),
        Stale("b.yaml", "stored", 1, 0),
    ]
    assert [str(each) for each in entries][:2] == [
        "the baseline counts 1 of loaded in a.yaml, but there are 0",
        "the baseline counts 3 of stored in a.yaml, but there is 1",
    ]


def test_what_was_not_judged_is_not_stale() -> None:
    Path("b.yaml").write_text("")
    held = baseline(
        a_yaml={"stored": 1, "loaded": 1}, b_yaml={"stored": 1}, gone_yaml={"stored": 1}
    )
    assert stale(held, [], files=["a.yaml"], rules=["stored"]) == [
        Stale("a.yaml", "stored", 1, 0),
        Stale("gone.yaml", "stored", 1, 0),
    ]
    assert [each.file for each in stale(held, [BROKEN])] == ["b.yaml", "gone.yaml"]
    assert prune(held, [BROKEN], files=["a.yaml", "./c/../b.yaml"]).entries == {
        "a.yaml": {"stored": 1, "loaded": 1}
    }


def test_errors_of_the_description_never_enter() -> None:
    warning = diagnostic("MSAA911", "unused", "a.yaml", Span(0, 1))
    assert build([BROKEN, warning, finding()]).entries == {
        "a.yaml": {"unused-suppression": 1, "stored": 1}
    }
    held = baseline(a_yaml={"syntax": 5})
    assert apply([BROKEN], held) == ([BROKEN], [])


def test_files_are_named_from_the_baselines_folder(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    Path("ci").mkdir()
    made = build(
        [finding("frames/a.yaml"), finding(str(folder / "b.yaml")), finding("<stdin>")], root="ci"
    )
    assert made.entries == {
        "../frames/a.yaml": {"stored": 1},
        "../b.yaml": {"stored": 1},
        "<stdin>": {"stored": 1},
    }
    save(made, "ci/baseline.json")
    (folder / "frames").mkdir()
    monkeypatch.chdir("frames")
    read = load("../ci/baseline.json", None)
    assert read == made
    assert isinstance(read, Baseline)
    assert apply([finding("a.yaml")], read)[0] == []


def test_prune_lowers_and_never_adds() -> None:
    held = baseline(a_yaml={"stored": 3, "loaded": 1}, b_yaml={"stored": 1})
    assert prune(
        held, [finding(), finding(start=4), *[finding("c.yaml")] * 2, *[finding("b.yaml")] * 5]
    ) == baseline(a_yaml={"stored": 2}, b_yaml={"stored": 1})


def test_the_file_is_sorted_and_ends_in_a_newline() -> None:
    made = baseline(b_yaml={"x": 1}, a_yaml={"stored": 2, "loaded": 1})
    assert dump(made) == (
        "{\n"
        '  "entries": {\n'
        '    "a.yaml": {\n'
        '      "loaded": 1,\n'
        '      "stored": 2\n'
        "    },\n"
        '    "b.yaml": {\n'
        '      "x": 1\n'
        "    }\n"
        "  },\n"
        '  "schema": "msaa-lint/baseline-v1"\n'
        "}\n"
    )


def test_saving_replaces_whole_and_leaves_nothing_beside(folder: Path) -> None:
    save(baseline(a_yaml={"x": 1}), "b.json")
    save(baseline(a_yaml={"x": 2}), "b.json")
    assert os.listdir(folder) == ["b.json"]
    assert load("b.json", None) == baseline(a_yaml={"x": 2})
    with pytest.raises(OSError):
        save(baseline(), "no/b.json")


def test_a_name_that_is_no_utf_8_is_written_and_read() -> None:
    name = os.fsdecode(b"caf\xe9.yaml")
    save(build([finding(name)]), "b.json")
    read = load("b.json", None)
    assert isinstance(read, Baseline)
    assert apply([finding(name)], read)[0] == []


# --- a stranger's file
# ----------------------------------------------------------------------------------------------------------

FILES = "`entries` must be an object with an object for each file"
HEAD = '{"schema": "msaa-lint/baseline-v1", "entries": '


@pytest.mark.parametrize(
    ("text", "at", "message"),
    [
        (
            "{,}",
            (1, ","),
            "not valid JSON: expected a value or a key after `{`, found `,`; remove one of them",
        ),
        (
            "",
            (0, ""),
            "not valid JSON: the text ends where a value is expected; the file may be truncated",
        ),
        (
            HEAD + "{",
            (47, "{"),
            "not valid JSON: `{` is never closed, nor is the bracket around it: the text ends at "
            "line 1, column 49 before its `}`",
        ),
        (
            "[]",
            (0, "[]"),
            "expected an object with `schema` and `entries`; `msaa-lint baseline` writes one",
        ),
        ("{}", (0, "{}"), 'expected the schema "msaa-lint/baseline-v1"'),
        (
            '{"schema": "msaa-lint/baseline-v2"}',
            (11, '"msaa-lint/baseline-v2"'),
            'expected the schema "msaa-lint/baseline-v1"',
        ),
        (
            '{"schema": "msaa-lint/baseline-v1"}',
            (0, '{"schema": "msaa-lint/baseline-v1"}'),
            FILES,
        ),
        (HEAD + "[]}", (47, "[]"), FILES),
        (HEAD + '{}, "more": 1}', (59, "1"), "unknown key `more`: expected `schema` and `entries`"),
        (HEAD + '{"a": 3}}', (53, "3"), "`a` must be an object with a count for each rule"),
        (
            HEAD + '{"a": {"x": 1, "y": -2}}}',
            (67, "-2"),
            "the count of `y` in `a` must be an integer from 1 to 2147483647",
        ),
        (
            HEAD + '{"a": {"x": 0}}}',
            (59, "0"),
            "the count of `x` in `a` must be an integer from 1 to 2147483647",
        ),
        (
            HEAD + '{"a": {"x": true}}}',
            (59, "true"),
            "the count of `x` in `a` must be an integer from 1 to 2147483647",
        ),
        (
            HEAD + '{"a": {"x": 1.0}}}',
            (59, "1.0"),
            "the count of `x` in `a` must be an integer from 1 to 2147483647",
        ),
        (
            HEAD + '{"a": {"x": 1e99}}}',
            (59, "1e99"),
            "the count of `x` in `a` must be an integer from 1 to 2147483647",
        ),
    ],
)
def test_a_mistake_is_at_its_place(text: str, at: tuple[int, str], message: str) -> None:
    Path("b.json").write_text(text)
    read = load("b.json", None)
    assert isinstance(read, Refused)
    (found,) = read.findings
    assert found.span is not None
    assert (found.span.start, read.sources["b.json"].text[found.span.start : found.span.end]) == at
    assert (found.message, found.code, found.file, found.fatal) == (
        f"invalid baseline: {message}",
        "MSAA921",
        "b.json",
        True,
    )


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (None, "no such baseline `b.json`"),
        (b"\xff", "cannot read the baseline: the input is not UTF-8: byte 0"),
        (
            b" " * (MAX_BYTES + 1),
            "cannot read the baseline: it is larger than the limit of 16777216 bytes",
        ),
        (b"[" * 200_000, "invalid baseline: nested too deeply"),
        (
            HEAD.encode() + b'{"a": {"x": ' + b"9" * 5000 + b"}}}",
            "invalid baseline: Exceeds the limit",
        ),
        (HEAD.encode() + b'{"a": {"x": 1, "x": 2}}}', "invalid baseline: duplicate key `x`"),
        (
            HEAD.encode() + b"NaN}",
            "invalid baseline: `entries` must be an object with an object for each file",
        ),
    ],
)
def test_what_cannot_be_read_is_one_error(data: bytes | None, message: str) -> None:
    if data is not None:
        Path("b.json").write_bytes(data)
    read = load("b.json", None)
    assert isinstance(read, Refused)
    assert [each.message.startswith(message) for each in read.findings] == [True], read.findings


def test_the_mistakes_of_a_file_are_bounded() -> None:
    Path("b.json").write_text(HEAD + json.dumps({f"f{i}": 0 for i in range(1000)}) + "}")
    read = load("b.json", None)
    assert isinstance(read, Refused)
    assert len(read.findings) == 50


# --- laws
# -----------------------------------------------------------------------------------------------------------------------

findings = st.lists(
    st.builds(
        finding,
        st.sampled_from(["a.yaml", "b/c.yaml", "é\n.yaml"]),
        st.sampled_from(["stored", "loaded"]),
        st.integers(0, 3),
    )
    | st.just(BROKEN),
    max_size=12,
)
held = st.dictionaries(
    st.sampled_from(["a.yaml", "b/c.yaml", "gone.yaml"]),
    st.dictionaries(st.sampled_from(["stored", "loaded", "x"]), st.integers(1, 4)),
    max_size=3,
).map(lambda entries: Baseline(entries, os.getcwd()))
quick = hypothesis_settings(
    deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture]
)


@quick
@given(findings)
def test_a_baseline_silences_what_it_was_built_from_and_nothing_is_stale(
    found: list[Finding],
) -> None:
    made = build(found)
    kept, suppressed = apply(found, made)
    assert kept == [each for each in found if each.fatal]
    assert [each.finding for each in suppressed] == [each for each in found if not each.fatal]
    assert stale(made, found) == []
    assert prune(made, found) == made
    assert build(reversed(found)).entries == made.entries
    assert dump(build(reversed(found))) == dump(made)


@quick
@given(held, findings)
def test_pruning_twice_is_pruning_once_and_leaves_nothing_stale(
    base: Baseline, found: list[Finding]
) -> None:
    pruned = prune(base, found)
    assert prune(pruned, found) == pruned
    assert stale(pruned, found) == []
    assert apply(found, pruned) == apply(found, base)
    for file, own in pruned.entries.items():
        assert all(0 < count <= base.entries[file][rule] for rule, count in own.items())


@quick
@given(held, findings)
def test_every_finding_is_kept_or_silenced_in_order(base: Baseline, found: list[Finding]) -> None:
    kept, suppressed = apply(found, base)
    silenced = [each.finding for each in suppressed]
    assert sorted([*kept, *silenced], key=repr) == sorted(found, key=repr)
    assert not any(each.fatal for each in silenced)


@quick
@given(
    st.dictionaries(
        st.text(max_size=5),
        st.dictionaries(st.text(max_size=5), st.integers(1, 2**31 - 1), min_size=1),
        max_size=4,
    )
)
def test_what_is_saved_is_what_is_read(entries: dict[str, Any]) -> None:
    made = Baseline(entries, os.getcwd())
    save(made, "b.json")
    assert load("b.json", None) == made

import os
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from hypothesis import HealthCheck, given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from msaa_lint.core.finding import Finding
from msaa_lint.core.globs import Glob
from msaa_lint.core.project import Outside, project_root, real_path, shown
from msaa_lint.linter.settings import config
from msaa_lint.linter.settings.config import Configurations, Loaded
from msaa_lint.linter.settings.selectors import unknown_selectors
from msaa_lint.linter.settings.settings import Choice, Settings, override
from msaa_lint.linter.settings.toml_text import places
from tests.paths import ROOT


class Rule(NamedTuple):
    code: str
    name: str
    severity: str = "warning"
    edition: str = "2026.1"


quick = hypothesis_settings(
    deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture]
)
RULES = [Rule("MSAA201", "multisampled-attachment-stored"), Rule("MSAA301", "resolve-outside-pass")]


@pytest.fixture(autouse=True)
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project of its own as the current folder."""
    (tmp_path / ".git").mkdir()
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv(config.VARIABLE, raising=False)
    return tmp_path


def load(path: str, explicit: str | None = None, isolated: bool = False) -> Loaded:
    return Configurations(explicit, isolated).load(path)


def write(path: str, text: str) -> str:
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    Path(path).write_bytes(text.encode())
    return path


def place(loaded: Loaded, found: Finding) -> tuple[str, int, int, int, int, str]:
    """The file, where it starts and ends, and the text there."""
    assert found.span is not None
    source = loaded.sources[found.file]
    start, end = source.position(found.span.start), source.position(found.span.end)
    return found.file, *start, *end, source.text[found.span.start : found.span.end]


def only(loaded: Loaded) -> Finding:
    assert len(loaded.findings) == 1, [each.message for each in loaded.findings]
    found = loaded.findings[0]
    assert (found.code, found.rule, found.severity, found.fatal) == (
        "MSAA921",
        "configuration",
        "error",
        True,
    )
    return found


# --- what governs
# ---------------------------------------------------------------------------------------------------------------


def test_without_a_file_the_defaults_hold(project: Path) -> None:
    assert load("frames/a.yaml") == Loaded(Settings(root=str(project)), None, (), {})


def test_the_nearest_file_governs_and_nothing_is_merged(project: Path) -> None:
    write("msaa-lint.toml", 'fail-on = "error"\nignore = ["MSAA2"]\n')
    write("a/b/pyproject.toml", '[tool.msaa-lint]\nprofile = "tiler"\n')
    below = load("a/b/c/x.yaml")
    assert below.path == str(project / "a/b/pyproject.toml")
    assert (below.settings.profile, below.settings.fail_on, below.settings.ignore) == (
        "tiler",
        "warning",
        (),
    )
    assert below.settings.root == str(project / "a/b")
    assert load("a/x.yaml").settings.fail_on == "error"
    Path("a/b/c").mkdir()
    configurations = Configurations()
    assert configurations.load("a/b/c") is configurations.load("a/b/x.yaml")


def test_a_pyproject_without_our_table_is_passed_over() -> None:
    write("msaa-lint.toml", 'fail-on = "note"\n')
    write(
        "a/pyproject.toml",
        '[project]\nname = "x"\ndependencies = ["msaa-lint"]\n[tool.other]\nx = 1\n',
    )
    write("b/pyproject.toml", "this is no TOML at all, and not ours\n")
    assert load("a/x.yaml").settings.fail_on == "note"
    assert load("b/x.yaml").settings.fail_on == "note"


@pytest.mark.parametrize(
    "text",
    [
        '[tool.msaa-lint]\nfail-on = "note"\n',
        '[tool]\nmsaa-lint = {fail-on = "note"}\n',
        'tool.msaa-lint.fail-on = "note"\n',
        '[ "tool" . \'msaa-lint\' ]\nfail-on = "note"\n',
        '[tool]\nmsaa-lint.fail-on = "note"\n',
    ],
)
def test_our_table_is_found_however_toml_writes_it(text: str) -> None:
    write("pyproject.toml", text)
    assert load("x.yaml").settings.fail_on == "note"


def test_in_one_folder_our_own_file_wins() -> None:
    write("pyproject.toml", '[tool.msaa-lint]\nfail-on = "error"\n')
    write("msaa-lint.toml", 'fail-on = "note"\n')
    assert load("x.yaml").settings.fail_on == "note"


def test_each_folder_is_searched_once() -> None:
    configurations = Configurations()
    write("msaa-lint.toml", 'fail-on = "error"\n')
    assert configurations.load("x.yaml").settings.fail_on == "error"
    write("msaa-lint.toml", 'fail-on = "note"\n')
    assert configurations.load("x.yaml").settings.fail_on == "error"
    assert Configurations().load("x.yaml").settings.fail_on == "note"


def test_an_explicit_file_and_the_variable_go_before_what_lies_around(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    write("msaa-lint.toml", 'profile = "near"\n')
    write("ci/lint.toml", 'profile = "explicit"\n')
    write("ci/env.toml", 'profile = "variable"\n')
    monkeypatch.setenv("MSAA_LINT_CONFIG", "ci/env.toml")
    assert load("x.yaml").settings.profile == "variable"
    assert load("x.yaml", explicit="ci/lint.toml").settings.profile == "explicit"
    assert load("x.yaml", explicit="ci/lint.toml", isolated=True).settings.profile is None


RELATIVE = "write a path relative to the folder of the configuration"


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("none.toml", None, "cannot read the configuration: no such file"),
        (".", None, "cannot read the configuration: it is a folder, not a regular file"),
        (
            "bad.toml",
            "x = '\ufffd'".encode("latin-1", "replace") + b"\xff",
            "cannot read the configuration: the input is not UTF-8",
        ),
        ("pyproject.toml", b"[project]\n", "the configuration has no table [tool.msaa-lint]"),
        ("pyproject.toml", b"[tool]\nmsaa-lint = 1\n", "[tool.msaa-lint] is not a table"),
    ],
)
def test_an_explicit_file_that_cannot_be_used_is_an_error(
    name: str, text: bytes | None, message: str
) -> None:
    if text is not None:
        Path(name).write_bytes(text)
    loaded = load("x.yaml", explicit=name)
    assert only(loaded).message.startswith(message)
    assert loaded.settings == Settings(root=loaded.settings.root)


def test_every_key_is_read() -> None:
    write("ci/pages/a.md", "")
    path = write(
        "pyproject.toml",
        """
[tool.msaa-lint]
edition = "2026.1"
select = ["ALL"]
extend-select = ["MSAA2"]
ignore = ["MSAA201"]
fail-on = "error"
min-severity = "warning"
profile = "mali-g76"
rules = ["ci/pages"]
exclude = ["build/"]
include = ["*.frame"]
baseline = "ci/baseline.json"
output = ["full", "json"]
limits = {depth = 50, nodes = 10, bytes = 4096}

[tool.msaa-lint.severity]
MSAA3 = "note"
resolve-outside-pass = "off"

[tool.msaa-lint.per-file-ignores]
"tests/**" = ["MSAA2", "ALL"]
""",
    )
    loaded = load("x.yaml")
    root = os.path.dirname(os.path.abspath(path))
    assert loaded.findings == ()
    assert loaded.settings._replace(origin={}) == Settings(
        edition="2026.1",
        select=("ALL",),
        extend_select=("MSAA2",),
        ignore=("MSAA201",),
        per_file_ignores=((Glob("tests/**", root), ("MSAA2", "ALL")),),
        severity={"MSAA3": "note", "resolve-outside-pass": "off"},
        fail_on="error",
        min_severity="warning",
        profile="mali-g76",
        rules=(os.path.join(root, "ci/pages"),),
        exclude=(Glob("build/", root),),
        include=(Glob("*.frame", root),),
        baseline=os.path.join(root, "ci/baseline.json"),
        limits={"depth": 50, "nodes": 10, "bytes": 4096},
        output=("full", "json"),
        root=root,
    )


# --- mistakes, each at its place
# ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "at", "message"),
    [
        (
            'selct = ["ALL"]\n',
            (1, 1, 1, 6, "selct"),
            "unknown key `selct` in msaa-lint.toml: did you mean `select`?",
        ),
        (
            '# a comment\nfail-on = "warn"  # x\n',
            (2, 11, 2, 17, '"warn"'),
            "unknown value `warn` in `fail-on` of msaa-lint.toml: did you mean `warning`?",
        ),
        (
            "fail-on = true\n",
            (1, 11, 1, 15, "true"),
            "expected one of error, warning, note, found a boolean in `fail-on` of msaa-lint.toml",
        ),
        (
            'select = "ALL"\n',
            (1, 10, 1, 15, '"ALL"'),
            "expected a list of rules, found a string in `select` of msaa-lint.toml",
        ),
        (
            'ignore = [\n  "ALL",\n  7,\n]\n',
            (3, 3, 3, 4, "7"),
            "expected a rule, found a number in `ignore` of msaa-lint.toml",
        ),
        (
            'ignore = ["a b"]\n',
            (1, 11, 1, 16, '"a b"'),
            "`a b` is not a rule selector in `ignore` of msaa-lint.toml: expected a rule name, a "
            "code, a code prefix such as MSAA2, or ALL",
        ),
        (
            "edition = 2026.1\n",
            (1, 11, 1, 17, "2026.1"),
            "expected a string, found a number in `edition` of msaa-lint.toml: write edition = "
            '"2026.1"',
        ),
        (
            'edition = "1.0"\n',
            (1, 11, 1, 16, '"1.0"'),
            "unknown value `1.0` in `edition` of msaa-lint.toml: expected one of 2026.1",
        ),
        (
            '[severity]\nMSAA2 = "warning"\nMSAA3 = "fatal"\n',
            (3, 9, 3, 16, '"fatal"'),
            "unknown value `fatal` in `severity` of msaa-lint.toml: expected one of error, "
            "warning, note, off",
        ),
        (
            'severity = {"a b" = "off"}\n',
            (1, 13, 1, 18, '"a b"'),
            "`a b` is not a rule selector in `severity` of msaa-lint.toml: "
            "expected a rule name, a code, a code prefix such as MSAA2, or ALL",
        ),
        (
            "[limits]\ndepth = 101\n",
            (2, 9, 2, 12, "101"),
            "`depth` must be an integer from 1 to 100, found `101` in `limits` of msaa-lint.toml: "
            "a configuration file can only lower limits",
        ),
        (
            "limits.depth = 0\n",
            (1, 16, 1, 17, "0"),
            "`depth` must be an integer from 1 to 100, found `0` in `limits` of msaa-lint.toml: a "
            "configuration file can only lower limits",
        ),
        (
            "limits = {dept = 5}\n",
            (1, 11, 1, 15, "dept"),
            "unknown key `dept` in `limits` of msaa-lint.toml: did you mean `depth`?",
        ),
        (
            "limits = {depth = true}\n",
            (1, 19, 1, 23, "true"),
            "expected an integer, found a boolean in `limits` of msaa-lint.toml",
        ),
        (
            'exclude = ["ok", "[a"]\n',
            (1, 18, 1, 22, '"[a"'),
            "invalid glob `[a` in `exclude` of msaa-lint.toml: a `[` without its `]`",
        ),
        (
            'per-file-ignores = {"../x" = ["ALL"]}\n',
            (1, 21, 1, 27, '"../x"'),
            "invalid glob `../x` in `per-file-ignores` of msaa-lint.toml: it leaves its folder",
        ),
        (
            'rules = ["none"]\n',
            (1, 10, 1, 16, '"none"'),
            "no such file or folder `none` in `rules` of msaa-lint.toml: write a path relative to "
            "the folder of the configuration",
        ),
        (
            'rules = ["../../etc"]\n',
            (1, 10, 1, 21, '"../../etc"'),
            "`../../etc` is outside the project in `rules` of msaa-lint.toml: only the command "
            "line can name such a file",
        ),
        (
            'baseline = "/b.json"\n',
            (1, 12, 1, 21, '"/b.json"'),
            "`/b.json` is outside the project in `baseline` of msaa-lint.toml: only the command "
            "line can name such a file",
        ),
        (
            'baseline = "a.sh"\n',
            (1, 12, 1, 18, '"a.sh"'),
            "`a.sh` is not a .json file in `baseline` of msaa-lint.toml: write a name that ends in "
            ".json",
        ),
        (
            'output = ["json=x"]\n',
            (1, 11, 1, 19, '"json=x"'),
            "`json=x` names a file in `output` of msaa-lint.toml: only the command line can name "
            "output files",
        ),
        (
            'output = ["jsn"]\n',
            (1, 11, 1, 16, '"jsn"'),
            "unknown value `jsn` in `output` of msaa-lint.toml: did you mean `json`?",
        ),
        (
            'profile = " "\n',
            (1, 11, 1, 14, '" "'),
            "expected a device class, a device name, or the path of a device report, found an "
            "empty string in `profile` of msaa-lint.toml",
        ),
        (
            '[tool.msaa-lint]\nfail-on = "note"\n',
            (1, 2, 1, 6, "tool"),
            "unknown key `tool` in msaa-lint.toml: in this file the keys are at the top level, "
            "without [tool.msaa-lint]; remove that line",
        ),
    ],
)
def test_a_mistake_is_at_its_place(
    text: str, at: tuple[int, int, int, int, str], message: str
) -> None:
    write("msaa-lint.toml", text)
    loaded = load("x.yaml")
    found = only(loaded)
    assert place(loaded, found) == ("msaa-lint.toml", *at)
    assert found.message == message


def test_the_rest_of_a_file_with_mistakes_counts() -> None:
    write(
        "pyproject.toml", '[tool.msaa-lint]\nselect = ["MSAA2", 3]\nnope = 1\nfail-on = "error"\n'
    )
    loaded = load("x.yaml")
    assert [place(loaded, found)[1:] for found in loaded.findings] == [
        (2, 20, 2, 21, "3"),
        (3, 1, 3, 5, "nope"),
    ]
    assert loaded.findings[1].message.startswith(
        "unknown key `nope` in [tool.msaa-lint] of pyproject.toml: expected one of edition, "
    )
    assert (loaded.settings.select, loaded.settings.fail_on) == (("MSAA2",), "error")


@pytest.mark.parametrize(
    ("text", "at", "message"),
    [
        (
            'a = "x"\nb = [1,,2]\n',
            (2, 8, 2, 9, ","),
            "a value is missing before `,`; remove the `,` before it, or add the value",
        ),
        ("a = 1\r\na = 2\r\n", (2, 1, 2, 2, "a"), "duplicate key `a`; remove one of the two"),
        ('a = "', (1, 5, 1, 6, '"'), 'the quote `"` is never closed; add the closing `"`'),
    ],
)
def test_broken_toml_says_where(
    text: str, at: tuple[int, int, int, int, str], message: str
) -> None:
    write("sub/msaa-lint.toml", text)
    loaded = load("sub/x.yaml")
    found = only(loaded)
    assert place(loaded, found) == ("sub/msaa-lint.toml", *at)
    assert found.message == f"the configuration is not valid TOML: {message}"


def test_a_broken_pyproject_that_names_our_table_is_an_error() -> None:
    write("pyproject.toml", "[tool.msaa-lint]\nselect = [\n")
    assert only(load("x.yaml")).message.startswith("the configuration is not valid TOML")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a = " + "[" * 100_000, "the configuration is nested too deeply"),
        ("a = " + "9" * 5000, "the configuration is not valid TOML"),
        (".".join("a" * 100_000) + " = 1", "too many dots in one line of the configuration"),
        (
            "#" * (1 << 20) + "#",
            "cannot read the configuration: it is larger than the limit of 1048576 bytes",
        ),
        ("a = '\0'", "the configuration is not valid TOML"),
        (
            "limits.depth = 0x" + "f" * 5000,
            "`depth` must be an integer from 1 to 100, found a longer number in `limits`",
        ),
        (
            "ignore = [" + '"x",' * 1001 + "]",
            "expected at most 1000 elements, found 1001 in `ignore`",
        ),
        (
            "exclude = [" + '"x",' * 201 + "]",
            "expected at most 200 elements, found 201 in `exclude`",
        ),
    ],
)
def test_hostile_files_end_in_one_error(text: str, message: str) -> None:
    write("msaa-lint.toml", text)
    assert only(load("x.yaml")).message.startswith(message)


def test_findings_are_bounded() -> None:
    write("msaa-lint.toml", "".join(f"key{i} = 1\n" for i in range(2000)))
    assert len(load("x.yaml").findings) == 50
    write("msaa-lint.toml", f"ignore = {list(range(900))}\nselect = {list(range(900))}\n")
    assert len(load("x.yaml").findings) == 50
    write("msaa-lint.toml", "ignore = [" + ", ".join(f'"no-{i}"' for i in range(1000)) + "]")
    assert len(unknown_selectors(load("x.yaml").settings, lambda: RULES)) == 50


# --- extends
# --------------------------------------------------------------------------------------------------------------------


def test_extends_comes_first_and_its_globs_count_from_it(project: Path) -> None:
    write(
        "base/lint.toml",
        'fail-on = "error"\nignore = ["MSAA1"]\nexclude = ["gen/"]\nseverity = {MSAA2 = "note", '
        'MSAA3 = "off"}\n'
        'per-file-ignores = {"a" = ["ALL"], "b" = ["ALL"]}\n',
    )
    write(
        "frames/msaa-lint.toml",
        'extends = "../base/lint.toml"\nignore = []\nseverity = {MSAA3 = "error"}\n'
        'per-file-ignores = {"b" = []}\n',
    )
    loaded = load("frames/x.yaml")
    settings = loaded.settings
    assert loaded.findings == ()
    assert (settings.fail_on, settings.ignore, settings.severity) == (
        "error",
        (),
        {"MSAA2": "note", "MSAA3": "error"},
    )
    assert settings.exclude == (Glob("gen/", str(project / "base")),)
    assert settings.per_file_ignores == (
        (Glob("a", str(project / "base")), ("ALL",)),
        (Glob("b", str(project / "frames")), ()),
    )
    assert list(loaded.sources) == ["frames/msaa-lint.toml", "base/lint.toml"]


def test_a_mistake_in_an_extended_file_is_reported_there() -> None:
    write("base.toml", "\nfail-on = 3\n")
    write("msaa-lint.toml", 'extends = "base.toml"\n')
    loaded = load("x.yaml")
    assert place(loaded, only(loaded)) == ("base.toml", 2, 11, 2, 12, "3")


def test_a_circle_is_reported_where_it_closes() -> None:
    write("msaa-lint.toml", 'extends = "a.toml"\nfail-on = "note"\n')
    write("a.toml", 'extends = "b/b.toml"\n')
    write("b/b.toml", 'extends = "../a.toml"\nprofile = "tiler"\n')
    loaded = load("x.yaml")
    found = only(loaded)
    assert place(loaded, found) == ("b/b.toml", 1, 11, 1, 22, '"../a.toml"')
    assert found.message == "cycle a.toml > b/b.toml > a.toml in `extends` of b/b.toml"
    assert (loaded.settings.fail_on, loaded.settings.profile) == ("note", "tiler")


def test_a_file_that_extends_itself() -> None:
    write("msaa-lint.toml", 'extends = "./msaa-lint.toml"\n')
    assert (
        only(load("x.yaml")).message
        == "cycle msaa-lint.toml > msaa-lint.toml in `extends` of msaa-lint.toml"
    )


def test_a_chain_is_bounded() -> None:
    write("msaa-lint.toml", 'extends = "0.toml"\n')
    for i in range(40):
        write(f"{i}.toml", f'extends = "{i + 1}.toml"\n')
    loaded = load("x.yaml")
    assert only(loaded).message == "chain of more than 16 files in `extends` of 14.toml"


@pytest.mark.parametrize(
    ("target", "message"),
    [
        ("none.toml", f"no such file `none.toml` in `extends` of msaa-lint.toml: {RELATIVE}"),
        (
            "../other.toml",
            "`../other.toml` is outside the project in `extends` of msaa-lint.toml: only the "
            "command line can name such a file",
        ),
        (
            "link.toml",
            "`link.toml` is outside the project in `extends` of msaa-lint.toml: only the command "
            "line can name such a file",
        ),
        (
            "/etc/passwd",
            "`/etc/passwd` is not a .toml file in `extends` of msaa-lint.toml: write a name that "
            "ends in .toml",
        ),
        (
            "folder.toml",
            "cannot read the configuration: it is a folder, not a regular file: folder.toml",
        ),
    ],
)
def test_what_cannot_be_extended(target: str, message: str, project: Path) -> None:
    outside = project.parent / "other.toml"
    outside.write_text("fail-on = 'note'\n")
    Path("link.toml").symlink_to(outside)
    Path("folder.toml").mkdir()
    write("msaa-lint.toml", f'extends = "{target}"\n')
    loaded = load("x.yaml")
    found = only(loaded)
    assert found.message == message
    assert place(loaded, found) == ("msaa-lint.toml", 1, 11, 1, 13 + len(target), f'"{target}"')
    assert loaded.settings.fail_on == "warning"


def test_extending_a_pyproject_reads_our_table() -> None:
    write("pyproject.toml", '[tool.msaa-lint]\nfail-on = "note"\n')
    write("a/msaa-lint.toml", 'extends = "../pyproject.toml"\n')
    assert load("a/x.yaml").settings.fail_on == "note"


def test_a_found_file_that_links_out_of_the_project_is_not_read(project: Path) -> None:
    outside = project.parent / "secret.toml"
    outside.write_text("token = 'hidden'\n")
    Path("msaa-lint.toml").symlink_to(outside)
    found = only(load("x.yaml"))
    assert (found.message, found.span) == (
        "cannot read the configuration: it is outside the project; pass it with --config to use it",
        None,
    )
    assert (
        load("x.yaml", explicit="msaa-lint.toml")
        .findings[0]
        .message.startswith("unknown key `token` in msaa-lint.toml: expected one of ")
    )


def test_the_project_is_the_repository_or_the_outermost_configuration(project: Path) -> None:
    write("pyproject.toml", "")
    Path("a/b/c").mkdir(parents=True)
    assert project_root("a/b/c") == str(project)
    Path(".git").rmdir()
    assert project_root("a/b/c") == str(project)
    write("a/b/.git", "gitdir: elsewhere")
    assert project_root("a/b/c") == str(project / "a/b")
    assert real_path("a/b/../x", str(project)) == str(project / "a/x")
    with pytest.raises(Outside):
        real_path(f"{project}-other/x", str(project))


def test_paths_are_shown_from_the_current_folder(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert shown("./a//b.yaml") == shown(str(project / "a/b.yaml")) == "a/b.yaml"
    assert shown("/nowhere/x") == "/nowhere/x"
    Path("sub").mkdir()
    monkeypatch.chdir("sub")
    assert shown("../a.yaml") == "../a.yaml"


# --- selectors and the command line
# ---------------------------------------------------------------------------------------------


def test_unknown_selectors_are_at_their_places() -> None:
    write(
        "pyproject.toml",
        '[tool.msaa-lint]\nselect = ["MSAA2", "ALL", "MSAA9"]\nextend-select = ["MSAA201", '
        '"MSAA8"]\n'
        'ignore = ["resolve-outside-pas"]\nper-file-ignores = {"a" = ["MS"]}\n'
        '[tool.msaa-lint.severity]\n"multisampled-atachment-stored" = "off"\n',
    )
    loaded = load("x.yaml")
    assert loaded.findings == ()
    found = unknown_selectors(loaded.settings, lambda: RULES)
    assert [(place(loaded, each)[1:], each.message) for each in found] == [
        (
            (3, 29, 3, 36, '"MSAA8"'),
            "unknown rule `MSAA8` in `extend-select` of pyproject.toml: `msaa-lint rule --all` "
            "lists the rules",
        ),
        (
            (4, 11, 4, 32, '"resolve-outside-pas"'),
            "unknown rule `resolve-outside-pas` in `ignore` of pyproject.toml: did you mean "
            "`resolve-outside-pass`?",
        ),
        (
            (5, 28, 5, 32, '"MS"'),
            "unknown rule `MS` in `per-file-ignores` of pyproject.toml: `msaa-lint rule --all` "
            "lists the rules",
        ),
        (
            (7, 1, 7, 32, '"multisampled-atachment-stored"'),
            "unknown rule `multisampled-atachment-stored` in `severity` of pyproject.toml: did you "
            "mean `multisampled-attachment-stored`?",
        ),
    ]
    assert {each.code for each in found} == {"MSAA921"}


def test_an_unknown_selector_in_an_extended_file_is_reported_there() -> None:
    write("base.toml", 'severity = {nope = "off"}\n')
    write("msaa-lint.toml", 'extends = "base.toml"\nseverity = {MSAA2 = "off"}\n')
    loaded = load("x.yaml")
    (found,) = unknown_selectors(loaded.settings, lambda: RULES)
    assert place(loaded, found) == ("base.toml", 1, 13, 1, 17, "nope")


def test_unknown_selectors_of_the_command_line_say_so() -> None:
    settings = override(Settings(), select=["MSAA201", "MSAA77"], severity={"nope": "off"})
    found = unknown_selectors(settings, lambda: RULES)
    assert [(each.file, each.span, each.message) for each in found] == [
        (
            "<command line>",
            None,
            "unknown rule `MSAA77` in `--select`: `msaa-lint rule --all` lists the rules",
        ),
        (
            "<command line>",
            None,
            "unknown rule `nope` in `--severity`: `msaa-lint rule --all` lists the rules",
        ),
    ]


def test_the_command_line_overrides(project: Path) -> None:
    write(
        "msaa-lint.toml",
        'fail-on = "error"\nprofile = "tiler"\nexclude = ["a"]\noutput = ["json"]\nlimits = {depth '
        '= 9}\nignore = ["MSAA2"]\n',
    )
    before = load("x.yaml").settings
    Path("sub").mkdir()
    after = override(
        before,
        fail_on="note",
        exclude=["b"],
        output=["full"],
        limits={"nodes": 5},
        rules=["sub"],
        baseline="b.json",
        ignore=["MSAA3"],
        select=["ALL"],
    )
    assert (after.fail_on, after.profile, after.output, after.ignore) == (
        "note",
        "tiler",
        ("full",),
        ("MSAA2",),
    )
    assert after.exclude == (Glob("a", str(project)), Glob("b", str(project)))
    assert after.limits == {"depth": 9, "nodes": 5}
    assert (after.rules, after.baseline) == ((str(project / "sub"),), str(project / "b.json"))
    assert after.command_line == Choice(("ALL",), (), ("MSAA3",), {}, (str(project / "sub"),))
    assert override(before) == before
    with pytest.raises(ValueError, match="empty name"):
        override(before, exclude=["a//b"])


def test_a_value_found_wrong_later_is_at_its_place() -> None:
    write("msaa-lint.toml", 'profile = "mali-g67"\n')
    loaded = load("x.yaml")
    found = loaded.settings.problem("profile", "no device `mali-g67`", "did you mean `mali-g76`?")
    assert place(loaded, found) == ("msaa-lint.toml", 1, 11, 1, 21, '"mali-g67"')
    assert (
        found.message
        == "no device `mali-g67` in `profile` of msaa-lint.toml: did you mean `mali-g76`?"
    )
    later = override(loaded.settings, profile="x").problem("profile", "no device `x`")
    assert (later.file, later.span, later.message) == (
        "<command line>",
        None,
        "no device `x` in `--profile`",
    )


# --- places in TOML
# -------------------------------------------------------------------------------------------------------------


def test_places_of_a_text_with_everything_in_it() -> None:
    text = (
        "# c = 1\n"
        'a."b.c" = """x\n# no = "y"""""  # d = 2\n'
        "[ t . 'u' ] # [v]\n"
        "k = [ 1, # ]\n  [2.5, {x = \"}\", y.z = 'a,b'}], 1979-05-27 07:32:00, ]\n"
        "[[t.w]]\r\nq = '''\n'quoted' ''''\r\n"
    )
    found = {
        path: (text[p.key.start : p.key.end], text[p.value.start : p.value.end])
        for path, p in places(text).items()
    }
    assert found == {
        ("a",): ("a", "a"),
        ("a", "b.c"): ('"b.c"', '"""x\n# no = "y"""""'),
        ("t",): ("t", "t"),
        ("t", "u"): ("'u'", "'u'"),
        ("t", "u", "k"): (
            "k",
            "[ 1, # ]\n  [2.5, {x = \"}\", y.z = 'a,b'}], 1979-05-27 07:32:00, ]",
        ),
        ("t", "u", "k", 0): ("1", "1"),
        ("t", "u", "k", 1): ("[", "[2.5, {x = \"}\", y.z = 'a,b'}]"),
        ("t", "u", "k", 1, 0): ("2.5", "2.5"),
        ("t", "u", "k", 1, 1): ("{", "{x = \"}\", y.z = 'a,b'}"),
        ("t", "u", "k", 1, 1, "x"): ("x", '"}"'),
        ("t", "u", "k", 1, 1, "y"): ("y", "y"),
        ("t", "u", "k", 1, 1, "y", "z"): ("z", "'a,b'"),
        ("t", "u", "k", 2): ("1979-05-27 07:32:00", "1979-05-27 07:32:00"),
        ("t", "w"): ("w", "w"),
        ("t", "w", "q"): ("q", "'''\n'quoted' ''''"),
    }


texts = st.text("aé𝄞\"\\\n]}#,='", max_size=6)
scalars = (
    st.integers(-(10**12), 10**12)
    | st.booleans()
    | st.floats(allow_nan=False, allow_infinity=False)
    | texts
)
values = st.recursive(
    scalars,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.text('ab."\\ #]', max_size=4), inner, max_size=3)
    ),
)


def toml(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return (
            '"'
            + "".join(
                f"\\U{ord(char):08x}"
                if char in '"\\' or ord(char) < 32 or ord(char) == 127
                else char
                for char in value
            )
            + '"'
        )
    if isinstance(value, list):
        return "[" + ", # x\n ".join(map(toml, value)) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{toml(key)} = {toml(item)}" for key, item in value.items()) + "}"
    return repr(value)


def each(path: tuple[str | int, ...], value: Any) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    yield path, value
    items = (
        value.items()
        if isinstance(value, dict)
        else enumerate(value)
        if isinstance(value, list)
        else ()
    )
    for key, item in items:
        yield from each((*path, key), item)


@quick
@given(
    st.dictionaries(st.text("abc-_\"'. ", max_size=5), values, max_size=4),
    st.sampled_from(["", "[tool.x]\n", "[[t]]\n"]),
)
def test_every_value_stands_where_it_is_said(table: dict[str, Any], header: str) -> None:
    text = header + "".join(
        f" {toml(key)}\t= {toml(value)} # {key!a}\n" for key, value in table.items()
    )
    prefix = {"": (), "[tool.x]\n": ("tool", "x"), "[[t]]\n": ("t",)}[header]
    found = places(text)
    wanted = dict(pair for key, value in table.items() for pair in each((*prefix, key), value))
    assert set(wanted) == {path for path in found if len(path) > len(prefix)}
    for path, value in wanted.items():
        span = found[path].value
        assert tomllib.loads("x = " + text[span.start : span.end])["x"] == value


@quick
@given(st.text("[]{}=,.\"'#\\ \n\ra1_-", max_size=60))
def test_places_of_any_text_end(text: str) -> None:
    for place in places(text).values():
        assert 0 <= place.value.start <= place.value.end <= len(text)


def test_without_a_configuration_nothing_heavy_is_imported() -> None:
    code = (
        "import sys; from msaa_lint.linter.settings import config, selection; from msaa_lint.input "
        "import discovery;"
        "from msaa_lint.linter.suppress import baseline, suppressions;"
        "load = config.Configurations().load; load('x.yaml'); "
        "discovery.discover(['pyproject.toml'], lambda p: load(p).settings, bool);"
        "heavy = {'tomllib', 'pathlib', 'pathspec', 'difflib', 'json', 'inspect', 'dataclasses', "
        "'hashlib', 'yaml', 'pydantic'};"
        "print(sorted(heavy & set(sys.modules)))"
    )
    write("pyproject.toml", "[project]\nname = 'x'\n")
    path = str(ROOT)
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": path},
    )
    assert done.stdout == "[]\n"

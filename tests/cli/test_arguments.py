"""The command line: what is read, what is refused and in which words, and help."""

from __future__ import annotations

from pathlib import Path

import pytest

from msaa_lint.cli.arguments import parse
from msaa_lint.cli.commands import COMMANDS
from tests.command import run

FLAGS = [(name, option) for name, command in COMMANDS.items() for option in command.options]


@pytest.mark.parametrize(
    ("command", "words", "expected"),
    [
        ("check", ["a.yaml", "-"], {"paths": ["a.yaml", "-"]}),
        ("check", ["--", "-a", "--fix"], {"paths": ["-a", "--fix"]}),
        ("check", ["a", "--select", "X", "--select=Y,Z", "--max-depth", "7"], {"paths": ["a"],
        "select": ["X", "Y,Z"], "max_depth": 7}),
        ("check", ["a", "-q"], {"paths": ["a"], "quiet": True}),
        ("check", ["a", "--fail-on=note", "--fail-on", "error"], {"paths": ["a"],
        "fail_on": "error"}),
        ("check", ["--config", "-", "a"], {"paths": ["a"], "config": "-"}),
        ("check", ["--output=sarif=a=b", "a"], {"paths": ["a"], "output": ["sarif=a=b"]}),
        ("check", ["--fail-on", "none", "-h"], None),
        ("check", ["-vh", "--nope"], {"paths": [], "verbose": True, "help": True}),
        ("cost", ["a", "--fps", "59.94"], {"paths": ["a"], "fps": 59.94}),
        ("confirm", ["--list-devices"], {"paths": [], "list_devices": True}),
        ("convert", ["a", "-o", "b"], {"paths": ["a"], "output": "b"}),
        ("convert", ["a", "-o=b"], {"paths": ["a"], "output": "b"}),
        ("rule", [], {"paths": []}),
        ("schema", ["cost-v1"], {"paths": ["cost-v1"]}),
    ],
)  # fmt: skip
def test_arguments(command: str, words: list[str], expected: dict[str, object] | None) -> None:
    if expected is None:
        with pytest.raises(Exception, match="unknown value"):
            parse(command, words)
    else:
        assert parse(command, words) == expected


WRONG = [
    ("chek a", "unknown command `chek`: did you mean `check`?"),
    ("lint a", "unknown command `lint`: did you mean `check`?"),
    ("frame.yaml", "unknown command `frame.yaml`: to lint a file or folder, write `msaa-lint check "
        "frame.yaml`"),
    (".", "unknown command `.`: to lint a file or folder, write `msaa-lint check .`"),
    ("-", "unknown command `-`: to lint a file or folder, write `msaa-lint check -`"),
    (
        "zzzz",
        "unknown command `zzzz`: expected one of check, cost, confirm, study, corpus, rule, "
        "device, facts, convert, schema, lsp, "
        "baseline, init",
    ),
    ("--fix check a", "`--fix` is an option of a command: write it after the command, as in "
        "`msaa-lint check --fix ...`"),
    ("-q check a", "`-q` is an option of a command: write it after the command, as in `msaa-lint "
        "check -q ...`"),
    ("--versoin", "unknown option `--versoin`: did you mean `--version`?"),
    ("check", "`check` needs an argument: write `msaa-lint check PATH...`"),
    ("confirm", "`confirm` needs an argument: write `msaa-lint confirm PATH...`, or "
        "`--list-devices`"),
    ("study", "`study` needs an argument: write `msaa-lint study INPUT...`, or `--list-scenes`"),
    ("convert", "`convert` needs an argument: write `msaa-lint convert INPUT...`"),
    ("init a b", "unexpected argument `b`: `init` takes only one FOLDER"),
    ("schema json", "unknown argument `json` of `schema`: did you mean `json-v1`?"),
    ("check a --outptu json", "unknown option `--outptu` of `check`: did you mean `--output`?"),
    ("check a -fix", "unknown option `-fix` of `check`: did you mean `--fix`?"),
    ("check a -x", "unknown option `-x` of `check`: see `msaa-lint check --help`"),
    ("check a --zzzz", "unknown option `--zzzz` of `check`: see `msaa-lint check --help`"),
    ("check a --output", "`--output` needs a value: write `--output FORMAT[=FILE]`"),
    ("check a --baseline --fix", "`--baseline` needs a value: write `--baseline FILE`"),
    ("check a --fix=yes", "`--fix` takes no value, found `yes`: write `--fix` alone"),
    ("check a --fail-on warn", "unknown value `warn` of `--fail-on`: did you mean `warning`?"),
    ("check a --color on", "unknown value `on` of `--color`: expected one of auto, always, never"),
    ("check a --max-depth 0", "`--max-depth` must be an integer from 1 to 99999999999, found `0`"),
    ("check a -q -v", "`--quiet` and `--verbose` contradict each other: write one of them"),
    ("check a --output sraif", "unknown output format `sraif`: did you mean `sarif`?"),
    (
        "check a --output=",
        "unknown output format ``: expected one of full, concise, json, sarif, github, gitlab, "
        "azure, teamcity, rdjson, junit, "
        "markdown, html, parquet, sqlite",
    ),
    ("check a --\x1b[31m\u202e", "unknown option `--\\x1b[31m\\u202e` of `check`: see `msaa-lint "
        "check --help`"),
    ("check a --fail-on \udcff", "unknown value `\\udcff` of `--fail-on`: expected one of note, "
        "warning, error"),
    (
        "\x1b]0;x",
        "unknown command `\\x1b]0;x`: expected one of check, cost, confirm, study, corpus, rule, "
        "device, facts, convert, schema, lsp, "
        "baseline, init",
    ),
    ("cost a --budget 2500", "invalid power `2500` in `--budget`: a unit is missing; write 2500mW "
        "or 2.5W"),
    ("cost a --budget 50MB/s", "invalid power `50MB/s` in `--budget`: unknown unit `MB/s`; "
        "expected one of mW, W"),
    ("cost a --chart a.pdf", "`--chart` must be the name of an .svg, .png, or .json file, found "
        "`a.pdf`"),
    ("cost a --fps abc", "`--fps` must be a number above 0, found `abc`"),
    ("cost a --fps 0", "`--fps` must be a number above 0, found `0`"),
    ("cost a --fps -5", "`--fps` must be a number above 0, found `-5`"),
    ("cost a --fps nan", "`--fps` must be a number above 0, found `nan`"),
    ("cost a --size 1920",
    "`--size` must be WIDTHxHEIGHT in pixels, as in 1920x1080; found `1920`"),
    ("cost a --samples 3", "`--samples` must be a comma-separated list of 1, 2, 4, 8, 16, 32, 64; "
        "found `3`"),
    (
        "study edge-fan --techniques msaaa",
        "`--techniques` must be a comma-separated list of msaa, sample-shading, ssaa; found "
        "`msaaa`; did you mean `msaa`?",
    ),
    ("confirm a --samples 3", "`--samples` must be one of 1, 2, 4, 8, 16, 32, 64; found `3`"),
]  # fmt: skip


@pytest.mark.parametrize(("line", "message"), WRONG)
def test_a_wrong_command_line_is_refused_on_one_line(
    tmp_path: Path, line: str, message: str
) -> None:
    (tmp_path / "a").write_text("images: {}\n", encoding="utf-8")
    done = run(tmp_path, *line.split(" "))
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"msaa-lint: {message}\n")


@pytest.mark.parametrize("command", COMMANDS)
def test_help(tmp_path: Path, command: str) -> None:
    shown = run(tmp_path, command, "--help", COLUMNS="80").stdout
    assert [
        run(tmp_path, *words, COLUMNS="80").stdout
        for words in ([command, "-h"], ["help", command], [command, "-qh"])
    ] == [shown] * 3
    assert max(map(len, shown.splitlines())) <= 80
    for option in COMMANDS[command].options:
        assert f" {option.flag}" in shown
        assert all(choice in shown for choice in option.choices)
    assert "list[str]" not in shown


def test_help_of_the_program(tmp_path: Path) -> None:
    shown = run(tmp_path, "--help")
    assert shown.returncode == 0
    assert [run(tmp_path, *words).stdout for words in (["-h"], ["help"])] == [shown.stdout] * 2
    assert all(f"\n  {name} " in shown.stdout for name in COMMANDS)
    assert "..." not in shown.stdout.replace("[ARGS]...", "")


def test_no_two_options_of_a_command_have_one_name() -> None:
    for command in COMMANDS.values():
        flags = [flag for option in command.options for flag in (option.flag, option.short) if flag]
        assert len(set(flags)) == len(flags)

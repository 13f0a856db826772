"""`msaa-lint rule`: pages and the list of rules, custom ones included."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import pytest

from msaa_lint.linter.rules.registry import load
from tests.command import environment_of, run

PAGE = """\
---
code: ACME001
severity: error
subject: image
when: image.samples > 2
message: "`{image.name}` has {image.samples} samples"
---
The studio's limit for eye buffers. More of it.
"""
NAME = "eye-buffer-samples"
NAMES = [rule.name for rule in load().rules]


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project with a custom rule, and a folder in it."""
    (tmp_path / "team").mkdir()
    (tmp_path / "src").mkdir()
    (tmp_path / "team" / f"{NAME}.md").write_text(PAGE, encoding="utf-8")
    (tmp_path / "msaa-lint.toml").write_text('rules = ["team"]\n', encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("name", [NAME, "ACME001", "acme001", NAME.upper()])
def test_a_custom_rule_is_found_by_the_configuration(project: Path, name: str) -> None:
    for folder in (project, project / "src"):
        done = run(folder, "rule", name)
        assert (done.returncode, done.stderr) == (0, "")
        assert done.stdout.startswith(
            f"# {NAME}\n\n**ACME001** {NAME}, error, confidence high, a custom rule in `"
        )
        assert "image.samples > 2" in done.stdout
    assert (
        json.loads(run(project, "rule", name, "--output", "json").stdout)["page_path"]
        == f"team/{NAME}.md"
    )


def test_the_options_of_a_configuration_apply(project: Path) -> None:
    other = project / "other"
    other.mkdir()
    assert run(project, "rule", NAME, "--isolated").returncode == 2
    assert run(project, "rule", NAME, "--isolated", "--rules", "team").returncode == 0
    (other / "msaa-lint.toml").write_text("", encoding="utf-8")
    assert run(other, "rule", NAME).returncode == 2
    assert run(other, "rule", NAME, "--config", "../msaa-lint.toml").returncode == 0
    missing = run(other, "rule", NAME, "--config", "missing.toml")
    assert (
        missing.returncode,
        "missing.toml: cannot read the configuration" in missing.stderr,
    ) == (2, True)


@pytest.mark.parametrize(
    "name",
    ["msaa201", "MSAA201", "multisampled-attachment-stored", "Multisampled-Attachment-Stored"],
)
def test_names_and_codes_in_any_case(tmp_path: Path, name: str) -> None:
    assert run(tmp_path, "rule", name).stdout.startswith("# multisampled-attachment-stored\n")
    assert run(tmp_path, "rule", "msaa901").stdout.startswith("# syntax\n")


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("NOPE", None),
        ("test", None),
        ("help", None),
        ("eye-bufer-samples", NAME),
        ("acme-01", "ACME001"),
        ("sample-count-above-for", None),
    ],
)
def test_an_unknown_rule_gets_a_suggestion_only_if_one_is_near(
    project: Path, name: str, meant: str | None
) -> None:
    done = run(project, "rule", name)
    assert (done.returncode, done.stdout) == (2, "")
    if name.endswith("above-for"):
        meant = "sample-count-above-four"
    assert done.stderr == f"msaa-lint: unknown rule `{name}`: " + (
        f"did you mean `{meant}`?\n" if meant else "`msaa-lint rule --all` lists the rules\n"
    )


def test_a_broken_page_comes_first(project: Path) -> None:
    (project / "team" / f"{NAME}.md").write_text(
        PAGE.replace("severity", "severty"), encoding="utf-8"
    )
    (project / "msaa-lint.toml").write_text(
        'rules = ["team"]\nextend-select = ["ACME001"]\n', encoding="utf-8"
    )
    problem = (
        f"msaa-lint: team/{NAME}.md:3:1: rule page `{NAME}`: unknown key `severty`: did you "
        "mean `severity`?\n"
    )
    for name in (NAME, "acme001"):
        done = run(project, "rule", name)
        assert (done.returncode, done.stdout, done.stderr) == (2, "", problem)
    assert (
        run(project, "rule", "NOPE").stderr
        == f"{problem}msaa-lint: unknown rule `NOPE`: `msaa-lint rule --all` lists the rules\n"
    )
    listed = run(project, "rule", "--all")
    assert (listed.returncode, listed.stderr) == (2, problem)
    assert "multisampled-attachment-stored" in listed.stdout
    # A built-in rule has nothing to do with it.
    assert run(project, "rule", "MSAA201").stderr == ""


def test_the_list_has_custom_rules(project: Path) -> None:
    lines = run(project, "rule", "--all").stdout.splitlines()
    (line,) = (line for line in lines if NAME in line)
    assert line.split(maxsplit=3) == [
        "ACME001",
        NAME,
        "error",
        f"(team/{NAME}.md) The studio's limit for eye buffers.",
    ]
    rows = {
        row["code"]: row
        for row in json.loads(run(project, "rule", "--all", "--output", "json").stdout)
    }
    assert (rows["ACME001"]["page_path"], rows["MSAA201"]["page_path"]) == (f"team/{NAME}.md", None)
    page = run(project, "rule", "--all", "--output", "markdown").stdout
    assert (
        "## Custom\n\n| code | rule | severity | summary |\n|---|---|---|---|\n| ACME001 | "
        f"[{NAME}](team/{NAME}.md) | error |" in page
    )


@pytest.mark.parametrize("columns", ["", "80", "40"])
def test_the_list_has_one_line_for_each_rule_in_a_pipe(tmp_path: Path, columns: str) -> None:
    lines = run(
        tmp_path, "rule", "--all", **({"COLUMNS": columns} if columns else {})
    ).stdout.splitlines()
    assert [line.split()[1] for line in lines][: len(NAMES)] == NAMES
    assert all(line.startswith("MSAA") for line in lines)


@pytest.mark.skipif(sys.platform == "win32", reason="a pseudoterminal")
@pytest.mark.parametrize("width", [60, 80, 100, 240])
def test_the_list_fits_a_terminal_with_whole_names(tmp_path: Path, width: int) -> None:
    import fcntl
    import pty
    import struct
    import subprocess
    import termios

    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
    command = [sys.executable, "-m", "msaa_lint", "rule", "--all"]
    with subprocess.Popen(
        command, stdout=theirs, cwd=tmp_path, env=environment_of({}), close_fds=True
    ) as process:
        os.close(theirs)
        shown = b""
        while True:
            try:
                data = os.read(ours, 65536)
            except OSError:
                break
            shown += data
            if not data:
                break
    os.close(ours)
    assert process.returncode == 0
    lines = shown.decode().replace("\r", "").splitlines()
    assert max(map(len, lines)) <= max(width, 62)
    assert {name for name in NAMES if not any(name in line.split() for line in lines)} == set()
    assert "…" not in shown.decode()


def test_a_missing_folder_of_rules_is_said_where_it_is_named(project: Path) -> None:
    unknown = "msaa-lint: unknown rule `x`: `msaa-lint rule --all` lists the rules\n"
    stated = "msaa-lint: <command line>: no such file or folder `nope` in `--rules`\n"
    assert run(project, "rule", "x", "--rules", "nope").stderr == f"{stated}{unknown}"
    (project / "msaa-lint.toml").write_text('rules = ["tean"]\n', encoding="utf-8")
    assert run(project, "rule", "x").stderr.startswith(
        "msaa-lint: msaa-lint.toml:1:10: no such file or folder `tean`"
    )
    (project / "msaa-lint.toml").write_text("", encoding="utf-8")
    assert run(project, "rule", "").stderr == unknown.replace("`x`", "``")

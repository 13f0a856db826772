"""Links to the page of a rule: the setting `docs-url`, and each output that has them."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from msaa_lint.core.package import DOCUMENTATION
from msaa_lint.linter.rules.reference_links import rule_address
from tests.cli.test_verbosity import STORED
from tests.command import environment_of, read_terminal, run
from tests.paths import ROOT

SITE = "https://example.com/msaa-lint"
RULE = "multisampled-attachment-stored"
ADDRESS = f"{SITE}/rules/{RULE}/"

CUSTOM = """\
---
code: ACME001
severity: warning
subject: image
when: image.samples == 4
message: "`{image.name}` has four samples"
---
Ours.
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "frame.msaa.yaml").write_text(STORED, encoding="utf-8")
    (tmp_path / "pages").mkdir()
    (tmp_path / "pages" / "four-samples.md").write_text(CUSTOM, encoding="utf-8")
    configure(tmp_path, SITE + "/")
    return tmp_path


def configure(folder: Path, address: str) -> None:
    (folder / "msaa-lint.toml").write_text(
        f"docs-url = {json.dumps(address)}\nrules = ['pages']\n", encoding="utf-8"
    )


def printed(folder: Path, format: str, **environment: str) -> str:
    return run(folder, "check", ".", "--output", format, **environment).stdout


def test_the_default_is_the_address_that_the_package_states() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project.get("urls", {}).get("Documentation", "") == DOCUMENTATION


def test_only_built_in_rules_have_a_page() -> None:
    assert rule_address(SITE, "MSAA201", RULE) == ADDRESS
    assert (
        rule_address("", "MSAA201", RULE)
        == rule_address(SITE, "ACME001", RULE)
        == rule_address(SITE, "MSAA901", "syntax")
        == ""
    )


def test_json_has_the_address_of_each_finding(folder: Path) -> None:
    urls = {
        finding["rule"]: finding["url"]
        for finding in json.loads(printed(folder, "json"))["findings"]
    }
    assert urls[RULE] == ADDRESS
    assert urls["four-samples"] is None


def test_sarif_has_it_as_help_uri_and_in_the_page(folder: Path) -> None:
    (sarif,) = json.loads(printed(folder, "sarif"))["runs"]
    rules = {rule["name"]: rule for rule in sarif["tool"]["driver"]["rules"]}
    assert rules[RULE]["helpUri"] == ADDRESS
    assert f"- [Documentation]({ADDRESS})\n" in rules[RULE]["help"]["markdown"]
    assert "helpUri" not in rules["four-samples"]
    assert {
        name for name, rule in rules.items() if not rule.get("helpUri", "").startswith(SITE)
    } == {"four-samples"}


def test_annotations_and_comments_have_it(folder: Path) -> None:
    summary = folder / "summary"
    annotations = printed(folder, "github", GITHUB_STEP_SUMMARY=str(summary)).splitlines()
    (stored,) = [line for line in annotations if f"title={RULE} " in line]
    assert stored.endswith(f"%0Adocs: {ADDRESS}")
    assert not any("docs:" in line for line in annotations if "title=four-samples " in line)
    assert f"[{RULE}](<{ADDRESS}>)" in summary.read_text(encoding="utf-8")
    assert f"[{RULE}](<{ADDRESS}>)" in printed(folder, "markdown")
    issues = {issue["check_name"]: issue for issue in json.loads(printed(folder, "gitlab"))}
    assert issues[RULE]["content"] == {"body": f"[{RULE}]({ADDRESS})"}
    assert "content" not in issues["four-samples"]
    codes = {
        each["code"]["value"]: each["code"]
        for each in json.loads(printed(folder, "rdjson"))["diagnostics"]
    }
    assert codes[RULE]["url"] == ADDRESS and "url" not in codes["four-samples"]
    assert f"%0Adocs: {ADDRESS}" in printed(folder, "azure")
    assert f"|ndocs: {ADDRESS}" in printed(folder, "teamcity")


@pytest.mark.parametrize(
    "format",
    ["json", "sarif", "github", "gitlab", "azure", "teamcity", "rdjson", "markdown", "full"],
)
def test_without_an_address_nothing_is_linked(folder: Path, format: str) -> None:
    configure(folder, "")
    assert "/rules/" not in printed(folder, format)


def test_files_and_pipes_have_no_hyperlinks(folder: Path) -> None:
    done = run(
        folder,
        "check",
        ".",
        "--output",
        "full",
        "--color",
        "always",
        "--output",
        "concise=out.txt",
        FORCE_HYPERLINK="1",
    )
    assert "\x1b[1;33m" in done.stdout
    assert "\x1b]8" not in done.stdout + (folder / "out.txt").read_text(encoding="utf-8")


def on_terminal(folder: Path, *arguments: str, **variables: str) -> str:
    """What `check` writes to a pseudoterminal."""
    import pty

    master, terminal = pty.openpty()
    command = [sys.executable, "-m", "msaa_lint", "check", ".", *arguments]
    environment = environment_of({"TERM": "xterm-256color", **variables})
    with subprocess.Popen(
        command,
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=terminal,
        stderr=subprocess.DEVNULL,
    ):
        os.close(terminal)
        return read_terminal(master).decode()


@pytest.mark.skipif(sys.platform == "win32", reason="terminals are POSIX")
@pytest.mark.parametrize(
    ("variables", "arguments", "linked"),
    [
        ({"TERM_PROGRAM": "vscode"}, (), True),
        ({"TERM_PROGRAM": "WezTerm"}, ("--output", "concise"), True),
        ({"TERM": "xterm-kitty"}, (), True),
        ({"VTE_VERSION": "7200"}, (), True),
        ({"VTE_VERSION": "4602"}, (), False),
        ({"VTE_VERSION": "a"}, (), False),
        ({"WT_SESSION": "1"}, (), True),
        ({}, (), False),
        ({"FORCE_HYPERLINK": "1"}, (), True),
        ({"FORCE_HYPERLINK": "0", "TERM_PROGRAM": "vscode"}, (), False),
        ({"FORCE_HYPERLINK": "1", "TERM": "dumb"}, ("--color", "always"), False),
        ({"TERM_PROGRAM": "vscode", "NO_COLOR": "1"}, (), False),
        ({"TERM_PROGRAM": "vscode"}, ("--color", "never"), False),
    ],
)
def test_terminals_that_show_links_get_them(
    folder: Path, variables: dict[str, str], arguments: tuple[str, ...], linked: bool
) -> None:
    text = on_terminal(folder, *arguments, **variables)
    links = re.findall(r"\x1b\]8;;([^\x1b]+)\x1b\\([^\x1b]*)\x1b\]8;;\x1b\\", text)
    assert RULE in text and "four-samples" in text
    assert ((ADDRESS, RULE) in links) == linked == ("\x1b]8" in text)
    assert "four-samples" not in {name for _, name in links}


@pytest.mark.parametrize(
    "address",
    [
        *(
            "javascript:alert(1)",
            "file:///etc/passwd",
            "example.com",
            "https://",
            "https://a b",
            "https://user@example.com/",
        ),
        *(
            f"https://example.com/{end}"
            for end in ("?q", "#a", "\x1b]8", "é", "\n", "a" * 500, '"', "<")
        ),
    ],
)
def test_another_value_is_an_error_at_its_place(folder: Path, address: str) -> None:
    configure(folder, address)
    done = run(folder, "check", ".", "--output", "concise")
    assert done.returncode == 2
    (error,) = [line for line in done.stdout.splitlines() if "MSAA921" in line]
    assert error.startswith("msaa-lint.toml:1:12: error[configuration] ")
    assert (
        "is not an http or https address in `docs-url` of msaa-lint.toml: expected the address of "
        "the documentation, such as https:" in error
    )
    assert "/rules/" not in printed(folder, "json")


def test_a_number_is_an_error(folder: Path) -> None:
    (folder / "msaa-lint.toml").write_text("docs-url = 4\n", encoding="utf-8")
    assert (
        "expected the address of the documentation, such as https://example.com/msaa-lint, found a "
        "number" in printed(folder, "concise")
    )

"""`msaa-lint check` as a process: exit codes, inputs, outputs, configuration."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command import run

BAD = """\
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [LAZILY_ALLOCATED]}
  out: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
renderPasses:
  main:
    attachments:
      color: {image: ms, loadOp: CLEAR, storeOp: DONT_CARE}
      output: {image: out, loadOp: DONT_CARE, storeOp: DONT_CARE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output]}
"""
GOOD = BAD.replace("loadOp: DONT_CARE, storeOp: DONT_CARE", "loadOp: DONT_CARE, storeOp: STORE")
RULE = "resolve-target-not-stored"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "bad.msaa.yaml").write_text(BAD, encoding="utf-8")
    (tmp_path / "good.msaa.yaml").write_text(GOOD, encoding="utf-8")
    (tmp_path / "warned.msaa.yaml").write_text(
        GOOD.replace("storeOp: DONT_CARE", "storeOp: STORE"), encoding="utf-8"
    )
    return tmp_path


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (["good.msaa.yaml"], 0),
        (["bad.msaa.yaml"], 1),
        (["."], 1),
        (["bad.msaa.yaml", "--exit-zero"], 0),
        (["bad.msaa.yaml", "--fail-on", "error"], 1),
        (["warned.msaa.yaml"], 1),
        (["warned.msaa.yaml", "--fail-on", "error"], 0),
        (["bad.msaa.yaml", "--ignore", RULE], 0),
        (["bad.msaa.yaml", "--ignore=MSAA2"], 0),
        (["bad.msaa.yaml", "--select", "MSAA4,MSAA706"], 0),
        (["good.msaa.yaml", "missing.yaml"], 2),
        (["good.msaa.yaml", "--select", "no-such-rule"], 2),
        (["good.msaa.yaml", "--profile", "mali-g67"], 2),
        (["good.msaa.yaml", "--edition", "1999.1"], 2),
        (["good.msaa.yaml", "--output", "jsn"], 2),
        (["good.msaa.yaml", "--output", "json", "--output", "sarif"], 2),
        (["good.msaa.yaml", "--output", "json=no/such/folder/x.json"], 2),
        (["good.msaa.yaml", "--baseline", "none.json"], 2),
        (["good.msaa.yaml", "--nonsense"], 2),
        (["good.msaa.yaml", "--max-depth", "2"], 2),
        ([], 2),
    ],
)
def test_exit_codes(folder: Path, arguments: list[str], code: int) -> None:
    assert run(folder, "check", *arguments).returncode == code


@pytest.mark.parametrize(
    "text",
    ["", "# nothing\n", "a: [", "images: {a: {smaples: 4}}", "\x00", "[" * 5000, "images: null"],
)
def test_input_that_cannot_be_used_ends_with_2_and_the_others_are_linted(
    folder: Path, text: str
) -> None:
    (folder / "a.msaa.yaml").write_text(text, encoding="utf-8")
    done = run(folder, "check", ".")
    assert done.returncode == 2
    assert "a.msaa.yaml" in done.stdout
    assert RULE in done.stdout


def test_standard_input(folder: Path) -> None:
    done = run(folder, "check", "-", "--stdin-filename", "pass.yaml", stdin=BAD.encode())
    assert done.returncode == 1
    assert done.stdout.splitlines()[0].startswith(f"pass.yaml:8:56: error[{RULE}] ")


@pytest.mark.parametrize("format", ["json", "sarif", "gitlab", "rdjson"])
@pytest.mark.parametrize("broken", [False, True])
def test_machine_formats_are_whole_and_alone(folder: Path, format: str, broken: bool) -> None:
    if broken:
        (folder / "a.msaa.yaml").write_bytes(b"\xff\xfe\xff")
        (folder / "b.msaa.yaml").write_text("x: {", encoding="utf-8")
    done = run(folder, "check", ".", "--output", format)
    assert json.loads(done.stdout)
    assert done.returncode == (2 if broken else 1)


def test_several_outputs_at_once(folder: Path) -> None:
    done = run(
        folder,
        "check",
        ".",
        "--output",
        "sarif=s.json",
        "--output",
        "junit=j.xml",
        "--output",
        "concise",
    )
    assert RULE in done.stdout
    assert json.loads((folder / "s.json").read_text(encoding="utf-8"))["version"] == "2.1.0"
    assert (folder / "j.xml").read_text(encoding="utf-8").startswith("<?xml")


def test_the_same_input_gives_the_same_bytes(folder: Path) -> None:
    for format in ("full", "json", "sarif", "markdown", "junit"):
        assert (
            run(folder, "check", ".", "--output", format).stdout
            == run(folder, "check", ".", "--output", format).stdout
        )


def test_configuration(folder: Path) -> None:
    (folder / "msaa-lint.toml").write_text(
        f'[severity]\n{RULE} = "note"\n\n[per-file-ignores]\n"other*" = ["{RULE}"]\n',
        encoding="utf-8",
    )
    (folder / "other.msaa.yaml").write_text(BAD, encoding="utf-8")
    done = run(folder, "check", ".")
    assert f"bad.msaa.yaml:8:56: note[{RULE}]" in done.stdout
    assert "other.msaa.yaml" not in done.stdout
    (folder / "msaa-lint.toml").write_text('selct = ["ALL"]\n', encoding="utf-8")
    done = run(folder, "check", "good.msaa.yaml")
    assert done.returncode == 2
    assert "msaa-lint.toml:1:1" in done.stdout
    assert run(folder, "check", "good.msaa.yaml", "--isolated").returncode == 0


def test_suppressions(folder: Path) -> None:
    comment = f"  # msaa-lint: ignore[{RULE}] the target is a test's"
    (folder / "bad.msaa.yaml").write_text(
        BAD.replace("storeOp: DONT_CARE}\n    sub", f"storeOp: DONT_CARE}}{comment}\n    sub"),
        encoding="utf-8",
    )
    assert run(folder, "check", "bad.msaa.yaml").returncode == 0
    assert run(folder, "check", "bad.msaa.yaml", "--no-ignores").returncode == 1
    (folder / "good.msaa.yaml").write_text(
        f"# msaa-lint: ignore-file[{RULE}] why\n{GOOD}", encoding="utf-8"
    )
    done = run(folder, "check", "good.msaa.yaml")
    assert done.returncode == 1
    assert "good.msaa.yaml:1:26: warning[unused-suppression]" in done.stdout


def test_baseline_round_trip(folder: Path) -> None:
    (folder / "warned.msaa.yaml").unlink()
    assert run(folder, "baseline", ".").returncode == 0
    baseline = ["--baseline", "msaa-lint-baseline.json"]
    assert run(folder, "check", ".", *baseline).returncode == 0
    (folder / "bad.msaa.yaml").write_text(GOOD, encoding="utf-8")
    done = run(folder, "check", ".", *baseline)
    assert "counts 1" in done.stderr
    assert run(folder, "baseline", ".", "--prune").returncode == 0
    assert (
        json.loads((folder / "msaa-lint-baseline.json").read_text(encoding="utf-8"))["entries"]
        == {}
    )


def test_rules_of_ones_own(folder: Path) -> None:
    front = (
        "code: ACME001\nseverity: error\nsubject: image\nwhen: image.samples > 2\nmessage: "
        '"`{image.name}` has {image.samples}"'
    )
    page = f"---\n{front}\n---\nOurs.\n"
    rules = folder / "ci"
    rules.mkdir()
    (rules / "too-many.md").write_text(page, encoding="utf-8")
    done = run(folder, "check", "good.msaa.yaml", "--rules", "ci")
    assert done.returncode == 1
    assert "good.msaa.yaml:2:41: error[too-many] `ms` has 4 (ACME001)" in done.stdout
    (rules / "too-many.md").write_text(
        page.replace("image.samples > 2", "image.sampels > 2"), encoding="utf-8"
    )
    done = run(folder, "check", "good.msaa.yaml", "--rules", "ci")
    assert done.returncode == 2
    assert "ci/too-many.md:5:" in done.stdout
    assert "did you mean image.samples" in done.stdout


def test_terminal_escapes_of_an_input_do_not_reach_the_terminal(folder: Path) -> None:
    (folder / "a\x1b[31m.msaa.yaml").write_text(
        'images: {"\\e[2Jx": {samples: 3}}\n', encoding="utf-8"
    )
    for format in ("full", "concise", "github", "markdown", "junit"):
        assert "\x1b" not in run(folder, "check", ".", "--output", format).stdout


def test_color(folder: Path) -> None:
    assert "\x1b[" in run(folder, "check", "bad.msaa.yaml", "--color", "always").stdout
    assert "\x1b[" not in run(folder, "check", "bad.msaa.yaml").stdout
    assert "\x1b[" in run(folder, "check", "bad.msaa.yaml", FORCE_COLOR="1").stdout
    assert (
        "\x1b[" not in run(folder, "check", "bad.msaa.yaml", FORCE_COLOR="1", NO_COLOR="1").stdout
    )

"""`--quiet` and `--verbose`: what they leave out and add, and that standard output is the same with
`--verbose`.
"""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from msaa_lint.linter.settings.settings import OUTPUT_FORMATS
from tests.command import Done, run
from tests.paths import ROOT

STORED = """\
frame: {width: 64, height: 64, fps: 60}
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT], memory: [DEVICE_LOCAL]}
  color: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED], memory: [DEVICE_LOCAL]}
renderPasses:
  main:
    attachments:
      color_ms: {image: color_ms, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      color: {image: color, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}
    subpasses:
      - {colorAttachments: [color_ms], resolveAttachments: [color]}
"""
CLEAN = (
    STORED.replace("storeOp: STORE", "storeOp: DONT_CARE", 1)
    .replace("[COLOR_ATTACHMENT]", "[COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]")
    .replace("[DEVICE_LOCAL]", "[DEVICE_LOCAL, LAZILY_ALLOCATED]", 1)
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "stored.msaa.yaml").write_text(STORED, encoding="utf-8")
    (tmp_path / "clean.msaa.yaml").write_text(CLEAN, encoding="utf-8")
    return tmp_path


def lines(done: Done) -> tuple[int, list[str], list[str]]:
    return done.returncode, done.stdout.splitlines(), done.stderr.splitlines()


def test_quiet_check_prints_findings_only(folder: Path) -> None:
    code, printed, errors = lines(run(folder, "check", "-q", "stored.msaa.yaml"))
    assert (code, errors) == (1, [])
    assert printed and all(re.match(r"stored\.msaa\.yaml:\d+:\d+: \w+\[", line) for line in printed)
    assert run(folder, "check", "stored.msaa.yaml").stdout.splitlines()[: len(printed)] == printed
    assert lines(run(folder, "check", "--quiet", "clean.msaa.yaml")) == (0, [], [])
    assert lines(run(folder, "check", "-q", "clean.msaa.yaml", "--statistics")) == (0, [], [])
    full = run(folder, "check", "-q", "stored.msaa.yaml", "--output", "full").stdout
    assert "Found" not in full and "fixable" not in full and "storeOp: STORE" in full


def test_quiet_leaves_out_notes(folder: Path) -> None:
    assert (
        "is excluded"
        in run(
            folder,
            "check",
            "stored.msaa.yaml",
            "clean.msaa.yaml",
            "--config",
            str(excluding(folder)),
        ).stderr
    )
    code, _, errors = lines(
        run(
            folder,
            "check",
            "-q",
            "stored.msaa.yaml",
            "clean.msaa.yaml",
            "--config",
            str(excluding(folder)),
        )
    )
    assert (code, errors) == (1, [])


def excluding(folder: Path) -> Path:
    path = folder / "other.toml"
    path.write_text('exclude = ["clean.msaa.yaml"]\n', encoding="utf-8")
    return path


def test_quiet_keeps_errors(folder: Path) -> None:
    code, printed, errors = lines(run(folder, "check", "-q", "missing.yaml", "--select", "MSAA77"))
    assert (code, len(printed), errors) == (2, 2, [])
    code, printed, errors = lines(run(folder, "cost", "-q", "missing.yaml"))
    assert (code, printed) == (2, [])
    assert "no such file or folder" in errors[0]


def test_quiet_fixes(folder: Path) -> None:
    code, printed, errors = lines(run(folder, "check", "-q", "--diff", "stored.msaa.yaml"))
    assert (code, errors, printed[0]) == (1, [], "--- a/stored.msaa.yaml")
    code, _, errors = lines(run(folder, "check", "-q", "--fix", "stored.msaa.yaml"))
    assert errors == []
    assert "DONT_CARE" in (folder / "stored.msaa.yaml").read_text(encoding="utf-8")


def test_quiet_commands_that_write(folder: Path) -> None:
    assert lines(run(folder, "init", "-q", "new")) == (0, [], [])
    assert (folder / "new" / "msaa-lint.toml").exists()
    assert lines(run(folder, "baseline", "-q", "stored.msaa.yaml")) == (0, [], [])
    assert "To use it" in run(folder, "baseline", "stored.msaa.yaml").stderr


def test_quiet_cost_prints_tables_only(folder: Path) -> None:
    plain, quiet = (
        run(folder, "cost", *words, "stored.msaa.yaml").stdout for words in ([], ["-q"])
    )
    assert plain.startswith(quiet.rstrip("\n"))
    assert "shading: " in plain and "shading: " not in quiet


@pytest.mark.parametrize("output", OUTPUT_FORMATS)
def test_verbose_leaves_standard_output_alone(folder: Path, output: str) -> None:
    words = ["check", "stored.msaa.yaml", "clean.msaa.yaml", "--output", output]
    plain, verbose = run(folder, *words), run(folder, *words, "-v")
    assert (plain.returncode, plain.stdout) == (verbose.returncode, verbose.stdout)
    assert plain.stderr == ""


def test_verbose_names_configurations_and_inputs(folder: Path) -> None:
    (folder / "new").mkdir()
    (folder / "new" / "msaa-lint.toml").write_text(
        'profile = "mali-g76"\nselect = ["MSAA2"]\n', encoding="utf-8"
    )
    (folder / "new" / "a.msaa.yaml").write_text(CLEAN, encoding="utf-8")
    for command in ("check", "cost"):
        errors = run(folder, command, "-v", "clean.msaa.yaml", "new").stderr
        text = re.sub(r"\d+ (?=rules)", "N ", errors)
        assert "msaa-lint: no configuration file: edition 2026.1, N rules enabled\n" in text
        assert (
            "msaa-lint: configuration new/msaa-lint.toml: edition 2026.1, N rules enabled, profile "
            "mali-g76\n" in text
        )
        assert "msaa-lint: clean.msaa.yaml: read as description\n" in text
        assert (
            "msaa-lint: new/a.msaa.yaml: read as description, configuration new/msaa-lint.toml\n"
            in text
        )
    assert re.search(
        r"msaa-lint: checked 1 input in \d+\.\d\d s\n\Z",
        run(folder, "check", "-v", "clean.msaa.yaml").stderr,
    )
    assert (
        "clean.msaa.yaml: read as description"
        in run(folder, "baseline", "-v", "clean.msaa.yaml").stderr
    )


def test_verbose_names_what_is_skipped(folder: Path) -> None:
    for name, text in {
        ".git/HEAD": "ref: refs/heads/main\n",
        ".gitignore": "ignored.msaa.yaml\n/build/\n",
        "ignored.msaa.yaml": CLEAN,
        "build/a.msaa.yaml": CLEAN,
        ".hidden/a.msaa.yaml": CLEAN,
        "other.yaml": "on: push\n",
        "frame.json": '{"images": {"a": {"samples": 4}}}',
        "excluded.msaa.yaml": CLEAN,
        "msaa-lint.toml": 'exclude = ["excluded.*"]\n',
        "shader.glsl": "void main() {}\n",
    }.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    lines = run(folder, "check", "-v", ".").stderr.splitlines()
    assert sorted(line for line in lines if line.startswith("msaa-lint: skipped")) == [
        "msaa-lint: skipped .git: a folder that is hidden or of tools",
        "msaa-lint: skipped .hidden: a folder that is hidden or of tools",
        "msaa-lint: skipped build: listed in .gitignore or .ignore",
        "msaa-lint: skipped excluded.msaa.yaml: excluded",
        "msaa-lint: skipped frame.json: it looks a little like a description",
        "msaa-lint: skipped ignored.msaa.yaml: listed in .gitignore or .ignore",
        "msaa-lint: skipped other.yaml: not an input",
        "msaa-lint: skipped shader.glsl: not an input",
    ]


def test_verbose_names_formats(folder: Path) -> None:
    (folder / "a.cpp").write_text(
        "VkSampleCountFlagBits s = VK_SAMPLE_COUNT_4_BIT;\n", encoding="utf-8"
    )
    (folder / "b.yaml").write_text("{", encoding="utf-8")
    shutil.copy(ROOT / "examples" / "capture" / "forward.jsonl", folder / "c.jsonl")
    errors = run(folder, "check", "-v", "a.cpp", "b.yaml", "c.jsonl").stderr
    assert (
        "a.cpp: read as cpp\n" in errors
        and "b.yaml: read as nothing\n" in errors
        and "c.jsonl: read as gfxreconstruct\n" in errors
    )


def test_statistics_of_a_clean_input_say_so(folder: Path) -> None:
    done = run(folder, "check", "clean.msaa.yaml", "--statistics", "--select", "MSAA2")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("No findings in 1 file")


def test_statistics_print_errors_too(folder: Path) -> None:
    done = run(folder, "check", "stored.msaa.yaml", "--statistics", "--profile", "adrno")
    assert done.returncode == 2
    assert done.stderr.startswith("<command line>: error[configuration] no profile `adrno`")
    assert "MSAA921" in done.stdout


def test_the_command_line_is_not_a_file(folder: Path) -> None:
    done = run(folder, "check", "clean.msaa.yaml", "--select", "MSAA77")
    assert done.stdout.splitlines()[-1].startswith("Found 1 finding (1 error) in the command line")
    done = run(folder, "check", "clean.msaa.yaml", "stored.msaa.yaml", "--profile", "nope")
    assert " in 1 of 2 files and the command line" in done.stdout

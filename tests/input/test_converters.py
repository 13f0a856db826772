"""Binary captures through converters: programs that behave like the tools, in versions that are not
installed and in states that are rare.

tests/integration/test_capture_example.py runs the tools themselves.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from msaa_lint.input import converters
from tests.command import Done, environment_of, run
from tests.paths import ROOT

pytestmark = pytest.mark.skipif(os.name != "posix", reason="the programs are shell scripts")

FORWARD = ROOT / "examples/capture/forward.jsonl"
XML = ROOT / "examples/capture/forward.xml"

OLD = f"""
case "$*" in
--help) echo "Usage: gfxrecon-convert [--output file] <file>";;
"--output stdout "/*) test -e "$3" && cat '{FORWARD}';;
*) echo "unexpected: $*" >&2; exit 9;;
esac
"""
"""Version 0.9."""

NEW = f"""
case "$*" in
--help) echo "  --format <format>   JSON format to write.";;
"--format jsonl --output stdout "/*)
    printf '[gfxrecon] INFO - a line before the first\\n'
    sed '200s/$/[gfxrecon] WARNING - a line beside the 200th call\\n/' '{FORWARD}';;
*) exit 9;;
esac
"""
"""Version 1: its log ends the line of the call before it."""

RENDERDOC = f"""
test "$1 $2 $3 $4 $6 $8 $9" = "convert -i rdc -f -o -c zip.xml" && test -e "$5" && cp '{XML}' "$7"
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A project with binary captures."""
    folder = tmp_path / "project"
    (folder / ".git").mkdir(parents=True)
    for name in ("game.gfxr", "-o a game.gfxr", "deep/game.gfxr"):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(b"GFXR" + bytes(100))
    (folder / "frame.rdc").write_bytes(b"RDOC" + bytes(100))
    return folder


def install(folder: Path, **programs: str) -> None:
    """Installs scripts as programs in a folder."""
    folder.mkdir(exist_ok=True)
    for name, text in programs.items():
        path = folder / name.replace("_", "-")
        path.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
        path.chmod(0o755)


@pytest.fixture
def bin(tmp_path: Path) -> Path:
    """A folder of programs, with those that scripts need and none of the tools."""
    folder = tmp_path / "bin"
    folder.mkdir()
    for name in ("cat", "cp", "sed", "test", "head", "sleep", "kill", "yes", "env", "mkdir", "tr"):
        found = next(path for path in (Path("/bin", name), Path("/usr/bin", name)) if path.exists())
        (folder / name).symlink_to(found)
    return folder


def check(folder: Path, bin: Path, name: str, *arguments: str) -> Done:
    return run(
        folder,
        "check",
        "--isolated",
        "--output",
        "concise",
        *arguments,
        name,
        PATH=str(bin),
        TMPDIR=str(folder.parent),
    )


def rules(done: Done) -> list[str]:
    """The messages of the findings, without places."""
    return sorted(
        line.partition(": ")[2].partition("warning[")[2]
        for line in done.stdout.splitlines()
        if "warning[" in line
    )


@pytest.fixture
def plain(folder: Path, bin: Path) -> list[str]:
    """What is found in the text that the programs write."""
    return rules(check(folder, bin, str(FORWARD)))


@pytest.mark.parametrize("program", [OLD, NEW])
@pytest.mark.parametrize("name", ["game.gfxr", "./-o a game.gfxr", "deep/game.gfxr"])
def test_either_version_of_gfxreconstruct_converts(
    folder: Path, bin: Path, plain: list[str], program: str, name: str
) -> None:
    install(bin, gfxrecon_convert=program)
    done = check(folder, bin, name)
    assert rules(done) == plain and len(plain) > 3
    assert "MSAA9" not in done.stdout and done.returncode == 1
    shown = name.removeprefix("./")
    assert done.stderr == (
        f"msaa-lint: {shown}: gfxrecon-convert: a line beside the 200th call\n"
        if program == NEW
        else ""
    )


def test_the_places_are_calls(folder: Path, bin: Path) -> None:
    """A binary file has no lines."""
    install(bin, gfxrecon_convert=OLD)
    done = run(folder, "check", "--isolated", "--output", "full", "game.gfxr", PATH=str(bin))
    assert "  --> game.gfxr: renderPasses.opaque.attachments[1]\n" in done.stdout
    assert re.search(r"from: vkCreateRenderPass, call \d+; in 4 of 4 frames", done.stdout)


def test_renderdoc_converts(folder: Path, bin: Path) -> None:
    install(bin, renderdoccmd=RENDERDOC)
    assert rules(check(folder, bin, "frame.rdc")) == rules(check(folder, bin, str(XML)))


@pytest.mark.parametrize(("program", "words"), [
    (f"head -c 170000 '{FORWARD}'; echo 'no space left' >&2; exit 3", "gfxrecon-convert failed "
        "with exit code 3: no space left"),
    (f"head -c 170000 '{FORWARD}'; kill -SEGV $$", "gfxrecon-convert was ended by SIGSEGV"),
    (f"head -n 550 '{FORWARD}'; echo '[gfxrecon] WARNING - Incomplete block'", "gfxrecon-convert: "
        "Incomplete block"),
    (f"head -n 550 '{FORWARD}'; echo '[gfxrecon] ERROR - Failed to read block' >&2",
    "gfxrecon-convert: Failed to read block"),
    (f"head -n 550 '{FORWARD}'; yes 'a message' | head -c 9000000 >&2; exit 1", "gfxrecon-convert "
        "failed with exit code 1: a message"),
])  # fmt: skip
def test_a_converter_that_fails_ends_the_capture(
    folder: Path, bin: Path, plain: list[str], program: str, words: str
) -> None:
    install(bin, gfxrecon_convert=f'test "$1" = --help && exit\n{program}')
    done = check(folder, bin, "game.gfxr")
    assert done.returncode == 2 and done.stderr == ""
    assert [line for line in done.stdout.splitlines() if "MSAA901" in line] == [
        f"game.gfxr: error[syntax] the capture ends here: {words} (MSAA901)"
    ]
    assert rules(done) == plain


def test_a_converter_that_writes_nothing_says_why(folder: Path, bin: Path) -> None:
    install(bin, renderdoccmd="echo \"Couldn't load '$5'\" >&2; exit 1")
    done = check(folder, bin, "frame.rdc")
    assert (
        "the capture ends here: renderdoccmd failed with exit code 1: Couldn't load "
        f"'{folder}/frame.rdc' (MSAA901)" in done.stdout
    )
    assert done.returncode == 2


def test_a_converter_that_hangs_is_stopped(
    folder: Path, bin: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(converters, "PATIENCE", 1.0)
    install(
        bin, gfxrecon_convert=f"test \"$1\" = --help && exit\nhead -n 500 '{FORWARD}'; sleep 100"
    )
    started = time.monotonic()
    done = check(folder, bin, "game.gfxr")
    assert (
        "the capture ends here: gfxrecon-convert wrote nothing for 1 s and was stopped"
        in done.stdout
    )
    assert time.monotonic() - started < 20


def test_at_a_limit_the_converter_is_stopped(folder: Path, bin: Path) -> None:
    """A call of more than 64 MiB: nothing after it is read."""
    install(
        bin,
        gfxrecon_convert=f"test \"$1\" = --help && exit\nhead -n 1 '{FORWARD}'; yes | tr -d '\\n'",
    )
    done = check(folder, bin, "game.gfxr")
    assert "exceeds 64 MiB" in done.stdout and done.returncode == 2


def test_extracted_shaders_are_read(folder: Path, bin: Path) -> None:
    """gfxrecon-extract names a file after the handle of a module; 0.9 writes no code otherwise."""
    shader = next((ROOT / "rules/shaders").glob("*.spv"))
    install(
        bin,
        gfxrecon_convert=OLD,
        gfxrecon_extract=f'mkdir -p "$2"; for n in 56 57 58 59; do cp \'{shader}\' "$2/sh$n"; done',
    )
    converted = run(folder, "convert", "game.gfxr", PATH=str(bin)).stdout
    assert "shaders/" in converted
    for name, beside in (
        ("game.jsonl", "game.gfxr.shaders"),
        ("x.jsonl", "forward.gfxr.shaders"),
        ("g.gfxr.jsonl", "g.gfxr.shaders"),
    ):
        (folder / name).write_bytes(FORWARD.read_bytes())
        (folder / beside).mkdir()
        for number in (56, 57, 58, 59):
            (folder / beside / f"sh{number}").write_bytes(shader.read_bytes())
        assert run(folder, "convert", name).stdout == converted.replace("game.gfxr", name)
    (folder / "other.jsonl").write_bytes(
        FORWARD.read_bytes().replace(b"forward.gfxr", b"../forward.gfxr")
    )
    assert "shaders/" in run(folder, "convert", "other.jsonl").stdout, "by the name alone"


def test_shaders_outside_the_folder_are_not_read(folder: Path) -> None:
    shader = next((ROOT / "rules/shaders").glob("*.spv"))
    (folder / "game.jsonl").write_bytes(FORWARD.read_bytes())
    outside = folder.parent / "outside"
    outside.mkdir()
    for number in (56, 57, 58, 59):
        (outside / f"sh{number}").write_bytes(shader.read_bytes())
    (folder / "game.gfxr.shaders").symlink_to(outside)
    assert "shaders/" not in run(folder, "convert", "game.jsonl").stdout


def test_without_the_converter_the_message_says_what_to_install(folder: Path, bin: Path) -> None:
    for name, words in (
        (
            "game.gfxr",
            (
                "gfxrecon-convert, which reads it, is not installed",
                "package `gfxreconstruct`",
                "Vulkan SDK",
                "--format jsonl",
            ),
        ),
        (
            "frame.rdc",
            (
                "renderdoccmd, which reads it, is not installed",
                "package `renderdoc`",
                "renderdoccmd convert -f FILE.rdc",
            ),
        ),
    ):
        done = check(folder, bin, name)
        (line, *_) = done.stdout.splitlines()
        assert line.startswith(f"{name}: error[syntax] unsupported input: this is a binary ")
        assert all(word in line for word in words), line
        assert done.returncode == 2


def test_nothing_in_the_project_is_run(folder: Path, bin: Path) -> None:
    marker = folder.parent / "ran"
    for place in (folder, folder / "tools"):
        install(
            place,
            gfxrecon_convert=f"echo > '{marker}'",
            gfxrecon_extract=f"echo > '{marker}'",
            renderdoccmd=f"echo > '{marker}'",
        )
    for path in (f"{folder}/tools:{bin}", f".:{bin}", f":{bin}", f"tools:{bin}", f"{folder}:{bin}"):
        for name in ("game.gfxr", "frame.rdc"):
            done = run(folder, "check", "--isolated", name, PATH=path)
            assert "is not installed" in done.stdout
    assert not marker.exists()


def test_a_capture_that_a_folder_holds_is_not_converted(folder: Path, bin: Path) -> None:
    """A stranger's file is not for a native parser, unless someone names it."""
    marker = folder.parent / "ran"
    install(bin, gfxrecon_convert=f"echo > '{marker}'", renderdoccmd=f"echo > '{marker}'")
    (folder / "frame.msaa.yaml").write_text("images: {}\n")
    done = check(folder, bin, ".")
    assert (
        "4 binary captures were skipped, the first one -o a game.gfxr: name them to convert and "
        "lint them" in done.stderr
    )
    done = check(folder, bin, "deep")
    assert (
        "deep/game.gfxr is a binary capture and was skipped: name it to convert and lint it"
        in done.stderr
    )
    (folder / "msaa-lint.toml").write_text('include = ["*.gfxr"]\n')
    done = run(folder, "check", "--output", "concise", "deep", PATH=str(bin))
    assert "which is only converted if it is named" in done.stdout and done.returncode == 2
    assert not marker.exists()


def test_a_pipe_is_not_converted(folder: Path, bin: Path) -> None:
    install(bin, gfxrecon_convert=OLD)
    done = run(folder, "check", "-", stdin=b"GFXR" + bytes(100), PATH=str(bin))
    assert "cannot be read from a pipe: name the file" in done.stdout and done.returncode == 2


def test_an_interrupt_leaves_neither_a_process_nor_a_folder(folder: Path, bin: Path) -> None:
    noted = folder.parent / "pid"
    # More than a pipe holds, so the process is noted while it is read.
    install(
        bin,
        gfxrecon_convert=f"test \"$1\" = --help && exit\nhead -n 500 '{FORWARD}'; echo $$ > "
        f"'{noted}'; sleep 100",
    )
    scratch = folder.parent / "scratch"
    scratch.mkdir()
    environment = environment_of({"PATH": str(bin), "TMPDIR": str(scratch)})
    command = [sys.executable, "-m", "msaa_lint", "check", "game.gfxr"]
    process = subprocess.Popen(
        command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    until = time.monotonic() + 30
    while not (noted.exists() and noted.read_text()) and time.monotonic() < until:
        time.sleep(0.05)
    assert list(scratch.iterdir())
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=30)
    assert b"Traceback" not in errors and process.returncode == 130
    assert list(scratch.iterdir()) == []
    with pytest.raises(ProcessLookupError):
        os.kill(int(noted.read_text()), 0)

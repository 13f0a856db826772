"""`convert -o FOLDER/`: a description of each input, by several processes, which write the same as
one.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from msaa_lint.cli.convert import _description_name
from tests.command import environment_of, run, run_process
from tests.descriptions import CLEAN
from tests.input.captures.test_converted import SHADER, capture_with_shader
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"
SHORTHAND = (EXAMPLES / "impeller" / "engine-shorthand.msaa.yaml").read_text(encoding="utf-8")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Captures, a program of two files, render targets, a plain description, and two inputs that
    cannot be converted.
    """
    for name in ("game/a", "game/b", "other"):
        (tmp_path / "inputs" / name).mkdir(parents=True)
        shutil.copy(
            EXAMPLES / "capture" / "forward.jsonl", tmp_path / "inputs" / name / "frame.jsonl"
        )
        (tmp_path / "inputs" / name / "targets.msaa.yaml").write_text(SHORTHAND, encoding="utf-8")
    (tmp_path / "inputs" / "game" / "a" / "game.foz").write_bytes(capture_with_shader())
    shutil.copy(EXAMPLES / "code" / "forward.cpp", tmp_path / "inputs" / "other" / "forward.cpp")
    (tmp_path / "inputs" / "other" / "plain.msaa.yaml").write_text(CLEAN)
    (tmp_path / "inputs" / "other" / "unreadable.msaa.yaml").write_bytes(b"images: \xff\n")
    (tmp_path / "inputs" / "game" / "broken.msaa.yaml").write_text(
        SHORTHAND.replace("sampleCount", "samplCount"), encoding="utf-8"
    )
    return tmp_path


def files(folder: Path) -> dict[str, bytes]:
    """The contents of the files in a folder, by path."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


@pytest.mark.skipif(sys.platform == "win32", reason="processes are copied")
def test_processes_write_what_one_writes(folder: Path) -> None:
    one, three = (
        run_process(folder, "convert", "inputs", "-o", f"out{jobs}/", "--jobs", jobs)
        for jobs in ("1", "3")
    )
    assert (one.returncode, one.stdout, one.stderr.replace("out1", "out3")) == (2, "", three.stderr)
    assert (three.returncode, three.stdout) == (2, "")
    written = files(folder / "out1")
    assert written == files(folder / "out3")
    (shader,) = (name for name in written if "shaders" in name)
    assert written.keys() == {
        shader,
        "game/a/game.foz.msaa.yaml",
        *(
            f"{name}/{file}.msaa.yaml"
            for name in ("game/a", "game/b", "other")
            for file in ("frame.jsonl", "targets.msaa.yaml")
        ),
        "other/forward.cpp.msaa.yaml",
    }
    assert Path(shader).parent.as_posix() == "game/a/shaders" and written[shader] == SHADER
    assert Path(shader).name in written["game/a/game.foz.msaa.yaml"].decode()
    assert (
        written["other/frame.jsonl.msaa.yaml"].decode()
        == run(folder, "convert", "inputs/other/frame.jsonl").stdout
    )
    lines = one.stderr.splitlines()
    assert [line for line in lines if "broken" in line] and [
        line for line in lines if "unreadable" in line
    ]
    assert lines[-2:] == [
        "msaa-lint: 1 input left out, with nothing to convert, the first one "
        "inputs/other/plain.msaa.yaml",
        "msaa-lint: 8 descriptions written to out1/",
    ]


@pytest.mark.skipif(sys.platform == "win32", reason="processes are ended by signals")
def test_an_input_that_ends_processes_is_the_only_one_lost(folder: Path) -> None:
    code = """if True:
        import os, signal, sys
        from msaa_lint.__main__ import main
        from msaa_lint.linter.workspace import Workspace
        read = Workspace.open
        def poisonous(self, path):
            if path == "inputs/game/b/frame.jsonl":
                os.kill(os.getpid(), signal.SIGKILL)
            return read(self, path)
        Workspace.open = poisonous
        sys.argv = ["msaa-lint", "convert", "inputs", "-o", "out/", "--jobs", "2"]
        main()
    """
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        env=environment_of({}),
    )
    expected = run(folder, "convert", "inputs", "-o", "expected/")
    reason = (
        "it ended the process that read it (SIGKILL): memory probably ran out; use fewer "
        "`--jobs` or more memory"
    )
    line = f"msaa-lint: inputs/game/b/frame.jsonl: not converted: {reason}"
    assert done.returncode == 2
    assert set(done.stderr.splitlines()) - set(expected.stderr.splitlines()) == {
        line,
        "msaa-lint: 7 descriptions written to out/",
    }
    written = files(folder / "expected")
    lost = {name for name in written if name.startswith("game/b/") and "targets" not in name}
    assert files(folder / "out") == {
        name: data for name, data in written.items() if name not in lost
    }


def test_an_existing_file_is_kept_unless_forced(folder: Path) -> None:
    kept = folder / "out" / "a" / "frame.jsonl.msaa.yaml"
    kept.parent.mkdir(parents=True)
    kept.write_text("mine\n")
    done = run(folder, "convert", "inputs/game/a", "inputs/game", "-o", "out")
    assert done.returncode == 2 and kept.read_text() == "mine\n"
    assert (
        not (folder / "out" / "game").exists()
        and (folder / "out" / "frame.jsonl.msaa.yaml").exists()
    )
    done = run(folder, "convert", "inputs/game", "-o", "out")
    assert (
        "msaa-lint: out/a/frame.jsonl.msaa.yaml already exists; --force overwrites it\n"
        in done.stderr
    )
    assert (
        kept.read_text() == "mine\n" and (folder / "out" / "b" / "frame.jsonl.msaa.yaml").exists()
    )
    run(folder, "convert", "inputs/game", "-o", "out", "--force")
    assert kept.read_text() == (folder / "out" / "b" / "frame.jsonl.msaa.yaml").read_text().replace(
        "game/b", "game/a"
    )


def test_two_descriptions_are_never_the_same_file(folder: Path) -> None:
    done = run(folder, "convert", "inputs/game/a", "inputs/game/b", "-o", "out/")
    assert done.returncode == 2
    message = (
        "its description and that of inputs/game/a/frame.jsonl would both be "
        "out/frame.jsonl.msaa.yaml; write one to another folder"
    )
    assert f"msaa-lint: inputs/game/b/frame.jsonl: {message}\n" in done.stderr
    done = run(
        folder, "convert", "inputs/game/a/frame.jsonl", "inputs/game/b/frame.jsonl", "-o", "named/"
    )
    assert (done.returncode, done.stderr) == (0, "msaa-lint: 2 descriptions written to named/\n")
    names = set(files(folder / "named"))
    assert {"inputs/game/a/frame.jsonl.msaa.yaml", "inputs/game/b/frame.jsonl.msaa.yaml"} <= names


def test_descriptions_beside_the_inputs_are_not_inputs(folder: Path) -> None:
    game = folder / "inputs" / "game"
    (game / "broken.msaa.yaml").unlink()
    first, second = (run(game, "convert", ".", "-o", ".", *force) for force in ((), ("--force",)))
    assert (
        (first.returncode, first.stderr)
        == (second.returncode, second.stderr)
        == (0, "msaa-lint: 5 descriptions written to .\n")
    )
    done = run(
        game,
        "convert",
        "a/targets.msaa.yaml",
        "a/targets.msaa.yaml.msaa.yaml",
        "-o",
        ".",
        "--force",
    )
    assert done.returncode == 2
    assert (
        "a/targets.msaa.yaml.msaa.yaml is an input, and the description of another one"
        in done.stderr
    )


def test_a_named_input_with_nothing_to_convert_is_an_error(folder: Path) -> None:
    done = run(folder, "convert", "inputs/other/plain.msaa.yaml", "missing.jsonl", "-o", "out/")
    assert (done.returncode, (folder / "out").exists()) == (2, False)
    assert (
        "inputs/other/plain.msaa.yaml: nothing to convert: `check` reads this input directly"
        in done.stderr
    )
    assert "missing.jsonl: no such file or folder" in done.stderr
    assert (
        "-o descriptions/"
        in run(folder, "convert", "inputs/game/a/frame.jsonl", "inputs/game/b/frame.jsonl").stderr
    )


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("s3://bucket/captures/a/b.jsonl", "a/b.jsonl"),
        ("s3://bucket/other/b.jsonl", "bucket/other/b.jsonl"),
        ("s3://bucket/captures/../../../b.jsonl", "b.jsonl"),
        ("s3://../../b.jsonl", "b.jsonl"),
        ("../b.jsonl", "b.jsonl"),
    ],
)
def test_a_description_is_in_the_folder_whatever_an_object_is_called(path: str, name: str) -> None:
    assert _description_name(path, ["s3://bucket/captures"]) == f"{name}.msaa.yaml"


def test_standard_input_is_named_stdin(folder: Path) -> None:
    assert run(folder, "convert", "-", "-o", "out/", stdin=SHORTHAND.encode()).returncode == 0
    assert list(files(folder / "out")) == ["stdin.msaa.yaml"]

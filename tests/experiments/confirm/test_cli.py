"""`msaa-lint confirm` as a process: what it refuses, what it misses, how it ends."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import jsonschema
import pytest

from msaa_lint.cli.arguments import parse
from msaa_lint.cli.commands import COMMANDS
from msaa_lint.cli.common import UsageError
from msaa_lint.core.extras import needs_extra
from tests.descriptions import CLEAN
from tests.paths import ROOT

SCHEMA = json.loads((ROOT / "msaa_lint" / "cli" / "report" / "confirm_v1.schema.json").read_text())
COMMAND = (sys.executable, "-m", "msaa_lint", "confirm", "--isolated")

GOOD = "frame: {width: 64, height: 64, fps: 60}\n" + CLEAN


def run(
    folder: Path, *arguments: str, text: str | None = None, **environment: str
) -> subprocess.CompletedProcess[str]:
    """The command in a folder; temporary files go to a folder of their own, in which nothing may be
    left.
    """
    scratch = folder / "scratch"
    scratch.mkdir(exist_ok=True)
    given = {
        **os.environ,
        "PYTHONPATH": str(ROOT),
        "TMPDIR": str(scratch),
        "NO_COLOR": "1",
        **environment,
    }
    done = subprocess.run(
        [*COMMAND, *arguments],
        cwd=folder,
        env=given,
        input=text,
        capture_output=True,
        text=True,
        check=False,
    )
    assert list(scratch.iterdir()) == []
    assert "Traceback" not in done.stderr
    return done


def frame(folder: Path, text: str = GOOD, name: str = "frame.msaa.yaml") -> str:
    (folder / name).write_text(text)
    return name


def report(done: subprocess.CompletedProcess[str]) -> dict[str, object]:
    data = json.loads(done.stdout)
    jsonschema.Draft202012Validator(SCHEMA).validate(data)
    assert isinstance(data, dict)
    return data


def test_schema_is_one() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            ["--timeout", "0"],
            "`--timeout` must be seconds, above 0 and at most a day (86400); found `0`",
        ),
        (["--timeout", "nan"], "at most a day (86400); found `nan`"),
        (
            ["--size", "1920"],
            "`--size` must be WIDTHxHEIGHT in pixels, as in 1920x1080; found `1920`",
        ),
        (["--size", "0x5"], "found `0x5`"),
        (["--size", "99999x5"], "`--size` must be at most 16384x16384; found `99999x5`"),
        (["--samples", "3"], "`--samples` must be one of 1, 2, 4, 8, 16, 32, 64; found `3`"),
        (["--time", "--no-time"], "`--time` and `--no-time` contradict each other"),
        (["--output", "sarif"], "unknown output format `sarif`: expected one of full, json"),
        (["--output", "json", "--output", "full"], "only one output can go to standard output"),
    ],
)
def test_options_that_say_nothing_end_with_2(
    tmp_path: Path, arguments: list[str], words: str
) -> None:
    done = run(tmp_path, frame(tmp_path), *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert words in done.stderr


def test_no_path_ends_with_2(tmp_path: Path) -> None:
    assert run(tmp_path).returncode == 2


def test_options_are_read_without_typer() -> None:
    given = parse(
        "confirm",
        [
            "a.yaml",
            "--device",
            "llvm",
            "--device=nvidia",
            "--no-gate",
            "--timeout",
            "3",
            "--repeats",
            "9",
        ],
    )
    assert given == {
        "paths": ["a.yaml"],
        "device": ["llvm", "nvidia"],
        "no_gate": True,
        "timeout": "3",
        "repeats": 9,
    }
    assert parse("confirm", ["--list-devices"]) == {"paths": [], "list_devices": True}
    for wrong in (
        ["a", "--repeats", "0"],
        ["a", "--nothing"],
        ["a", "--no-gate=1"],
        [],
        ["a", "--size"],
    ):
        with pytest.raises(UsageError):
            parse("confirm", wrong)
    options = COMMANDS["confirm"].options
    assert len({option.flag for option in options}) == len(options)


def test_help_names_every_option(tmp_path: Path) -> None:
    done = run(tmp_path, "--help")
    assert done.returncode == 0
    assert [
        option.flag for option in COMMANDS["confirm"].options if option.flag not in done.stdout
    ] == []


def test_no_driver_says_what_to_install(tmp_path: Path) -> None:
    done = run(tmp_path, frame(tmp_path), "--output", "json", VK_DRIVER_FILES="/nonexistent.json")
    assert done.returncode == 2
    assert (
        "apt install mesa-vulkan-drivers" in done.stderr and "VK_DRIVER_FILES is set" in done.stderr
    )
    assert report(done)["device"] is None


def test_no_package_says_what_to_install(tmp_path: Path) -> None:
    (tmp_path / "vulkan").mkdir()
    (tmp_path / "vulkan" / "__init__.py").write_text("raise ImportError('none', name='vulkan')")
    done = run(tmp_path, frame(tmp_path), PYTHONPATH=f"{ROOT}{os.pathsep}{tmp_path}")
    assert done.returncode == 2
    assert needs_extra("calling a Vulkan driver", "confirm") in done.stderr


def test_no_loader_says_what_to_install(tmp_path: Path) -> None:
    (tmp_path / "vulkan").mkdir()
    (tmp_path / "vulkan" / "__init__.py").write_text("raise OSError('Cannot find Vulkan SDK')")
    done = run(tmp_path, frame(tmp_path), PYTHONPATH=f"{ROOT}{os.pathsep}{tmp_path}")
    assert done.returncode == 2
    assert "apt install libvulkan1" in done.stderr


def test_unknown_device_names_those_there_are(tmp_path: Path) -> None:
    done = run(tmp_path, frame(tmp_path), "--device", "no such \x1b thing")
    assert done.returncode == 2
    assert (
        "no such \\x1b thing" in done.stderr
        and "llvmpipe" in done.stderr
        and "\x1b" not in done.stderr
    )


def test_devices_are_listed(tmp_path: Path) -> None:
    done = run(tmp_path, "--list-devices")
    assert done.returncode == 0 and "llvmpipe" in done.stdout and ", cpu" in done.stdout
    data = json.loads(run(tmp_path, "--list-devices", "--output", "json").stdout)
    assert any(each["type"] == "CPU" and "llvmpipe" in each["name"] for each in data["devices"])
    missing = run(tmp_path, "--list-devices", VK_DRIVER_FILES="/nonexistent.json")
    assert (missing.returncode, missing.stdout) == (
        2,
        "",
    ) and "mesa-vulkan-drivers" in missing.stderr


def test_broken_input_ends_with_2_and_the_others_are_tried(tmp_path: Path) -> None:
    names = [frame(tmp_path), frame(tmp_path, "images: [", "broken.msaa.yaml")]
    done = run(tmp_path, *names, "missing.yaml", "--output", "json")
    data = report(done)
    assert done.returncode == 2
    assert {error["file"] for error in data["errors"]} == {"broken.msaa.yaml", "missing.yaml"}  # type: ignore[attr-defined]
    assert [each["status"] for each in data["passes"]] == ["confirmed"]  # type: ignore[attr-defined]


def test_good_pass_is_confirmed(tmp_path: Path) -> None:
    done = run(tmp_path, frame(tmp_path), "--output", "json")
    data = report(done)
    assert done.returncode == 0, done.stdout + done.stderr
    (found,) = data["passes"]  # type: ignore[misc]
    assert (found["status"], found["created"], found["agrees"], found["findings"]) == (
        "confirmed",
        True,
        True,
        [],
    )
    assert data["layer"] is not None and "llvmpipe" in data["device"]["name"]  # type: ignore[index]


def test_standard_input_is_tried(tmp_path: Path) -> None:
    done = run(tmp_path, "-", "--stdin-filename", "here.msaa.yaml", "--output", "json", text=GOOD)
    assert [each["file"] for each in report(done)["passes"]] == ["here.msaa.yaml"]  # type: ignore[attr-defined]


def test_text_report_names_device_and_pass(tmp_path: Path) -> None:
    done = run(tmp_path, frame(tmp_path))
    assert done.returncode == 0
    assert "llvmpipe" in done.stdout.splitlines()[0] and "software" in done.stdout.splitlines()[0]
    assert "forward" in done.stdout and "1 pass: 1 confirmed" in done.stdout
    assert done.stderr == ""


def test_without_the_layer_the_run_goes_on_and_says_so(tmp_path: Path) -> None:
    name = frame(tmp_path)
    (tmp_path / "layers").mkdir()
    missing = run(tmp_path, name, "--output", "json", VK_LAYER_PATH=str(tmp_path / "layers"))
    data = report(missing)
    assert (missing.returncode, data["layer"]) == (0, None)
    assert any("apt install vulkan-validationlayers" in note for note in data["notes"])  # type: ignore[attr-defined]
    without = report(run(tmp_path, name, "--no-layer", "--output", "json"))
    assert without["layer"] is None and not any("missing" in note for note in without["notes"])  # type: ignore[attr-defined]


def test_same_run_gives_the_same_bytes(tmp_path: Path) -> None:
    name = frame(tmp_path, GOOD.replace("storeOp: DONT_CARE", "storeOp: STORE"))
    outputs = {
        run(tmp_path, name, "--output", "json", "--image", "pictures").stdout for _ in range(2)
    }
    assert len(outputs) == 1


def test_pictures_are_named_by_file_and_image(tmp_path: Path) -> None:
    name = frame(tmp_path, GOOD.replace("storeOp: DONT_CARE", "storeOp: STORE"))
    done = run(tmp_path, name, "--image", "pictures")
    assert done.returncode == 0, done.stdout
    names = sorted(path.name for path in (tmp_path / "pictures").iterdir())
    assert names == [
        f"frame.msaa.yaml-color-{kind}.png"
        for kind in ("as-written", "difference", "edge", "fixed")
    ]


def test_pictures_that_cannot_be_written_end_with_2(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    done = run(tmp_path, frame(tmp_path), "--image", "file/pictures")
    assert done.returncode == 2 and "file/pictures" in done.stderr


def test_report_goes_to_a_file(tmp_path: Path) -> None:
    done = run(tmp_path, frame(tmp_path), "--output", "json=out.json", "--output", "full")
    assert done.returncode == 0 and "1 confirmed" in done.stdout
    jsonschema.Draft202012Validator(SCHEMA).validate(
        json.loads((tmp_path / "out.json").read_text())
    )


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_interrupt_leaves_no_process_and_no_file(
    tmp_path: Path, number: signal.Signals, code: int
) -> None:
    names = [frame(tmp_path, name=f"{n}.msaa.yaml") for n in range(60)]
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "TMPDIR": str(scratch)}
    command = [*COMMAND, "--time", "--repeats", "200", *names]
    process = subprocess.Popen(
        command,
        cwd=tmp_path,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    for _ in range(200):
        if any(scratch.iterdir()):
            break
        time.sleep(0.05)
    time.sleep(0.5)
    process.send_signal(number)
    _, errors = process.communicate(timeout=30)
    assert (process.returncode, errors) == (code, "")
    assert list(scratch.iterdir()) == []

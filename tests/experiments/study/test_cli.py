"""`msaa-lint study` as a process: what it refuses, what it writes, how it ends."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from msaa_lint.cli import study as command
from msaa_lint.cli.arguments import parse
from msaa_lint.cli.commands import COMMANDS
from msaa_lint.cli.common import UsageError
from msaa_lint.core.extras import needs_extra
from msaa_lint.experiments.confirm.png import is_own_picture
from msaa_lint.experiments.study import measure
from msaa_lint.experiments.study.points import MSAA, Point, Technique, techniques
from msaa_lint.experiments.study.scenes import NAMES
from msaa_lint.experiments.study.scenes.scene import Scene
from tests.command import Done, read_terminal
from tests.command import run as run_command
from tests.descriptions import CLEAN
from tests.paths import ROOT

SCHEMA = json.loads((ROOT / "msaa_lint" / "cli" / "report" / "study_v1.schema.json").read_text())
COMMAND = (sys.executable, "-m", "msaa_lint", "study", "--isolated")
SMALL = ("--size", "64x48", "--jobs", "1")

FRAME = (
    "frame: {width: 64, height: 48, fps: 60}\n"
    + CLEAN.replace("samples: 4", "samples: 8")
    + "scene: {edges: true}\n"
)


def run(folder: Path, *arguments: str, text: str = "", **environment: str) -> Done:
    return run_command(
        folder, "study", "--isolated", *arguments, stdin=text.encode(), NO_COLOR="1", **environment
    )


def report(text: str) -> dict[str, Any]:
    data = json.loads(text)
    jsonschema.Draft202012Validator(SCHEMA).validate(data)
    assert isinstance(data, dict)
    return data


def test_schema_is_one() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


def test_options_are_read_without_typer() -> None:
    words = [
        "edge-fan",
        "--samples",
        "1,4",
        "--jobs=2",
        "--record",
        "--bits",
        "4",
        "--output",
        "json",
        "--output=full=a.txt",
    ]
    given = parse("study", words)
    assert given == {
        "paths": ["edge-fan"],
        "samples": "1,4",
        "jobs": 2,
        "record": True,
        "bits": "4",
        "output": ["json", "full=a.txt"],
    }
    assert parse("study", ["--list-scenes"]) == {"paths": [], "list_scenes": True}
    for wrong in (
        ["a", "--jobs", "0"],
        ["a", "--bits", "5"],
        ["a", "--nothing"],
        ["a", "--record=1"],
        [],
        ["a", "--size"],
        ["a", "--backend=x"],
    ):
        with pytest.raises(UsageError):
            parse("study", wrong)
    options = COMMANDS["study"].options
    assert len({option.flag for option in options}) == len(options)


def test_help_names_every_option(tmp_path: Path) -> None:
    done = run(tmp_path, "--help")
    assert done.returncode == 0
    assert [
        option.flag for option in COMMANDS["study"].options if option.flag not in done.stdout
    ] == []


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["edge-fun"], "no scene or file `edge-fun`; did you mean `edge-fan`?"),
        (["qqqq\x1b"], r"no scene or file `qqqq\x1b`; scenes are edge-fan, "),
        (
            ["edge-fan", "--samples", "3"],
            "`--samples` must be a comma-separated list of 1, 2, 4, 8, 16; found `3`",
        ),
        (
            ["edge-fan", "--samples", ""],
            "`--samples` must be a comma-separated list of 1, 2, 4, 8, 16; found ``",
        ),
        (
            ["edge-fan", "--techniques", "msaa,fxaa"],
            "`--techniques` must be a comma-separated list of msaa, sample-shading, ssaa; found "
            "`msaa,fxaa`",
        ),
        (
            ["edge-fan", "--techniques", "sample-shading", "--samples", "1"],
            "sample shading needs a count above 1",
        ),
        (
            ["edge-fan", "--size", "1920"],
            "`--size` must be WIDTHxHEIGHT in pixels, as in 1920x1080; found `1920`",
        ),
        (
            ["edge-fan", "--size", "8x8"],
            "edge-fan: a scene must be at least 32x32 pixels, found 8x8",
        ),
        (
            ["edge-fan", "--output", "sarif"],
            "unknown output format `sarif`: expected one of full, json",
        ),
        (
            ["edge-fan", "--plot", "a.gif"],
            "`--plot` must be the name of an .svg, .png, or .json file, found `a.gif`",
        ),
        (
            ["edge-fan", "--profile", "mali-g67"],
            "no profile `mali-g67` in `--profile`: did you mean `mali-g76`?",
        ),
        (["edge-fan", "--record"], "--record needs a description in a file"),
        *(
            (
                ["edge-fan", "--device", "llvmpipe", "--budget", text],
                "`--budget` must be a time above 0 and up to 1000ms, as in 0.5ms or 500us; found "
                f"`{text}`",
            )
            for text in ("0", "fast", "-1ms", "1001ms", "1s", "nan", "1e3")
        ),
        (
            ["edge-fan", "--budget", "1ms"],
            "--budget needs times: name the GPU that measures them with `--device NAME`",
        ),
        *(
            (
                ["edge-fan", "--device", "llvmpipe", "--budget", "1ms", *words],
                "--budget is added to the time of one sample: add 1 to --samples, and msaa to "
                "--techniques",
            )
            for words in (["--samples", "2,4"], ["--techniques", "ssaa"])
        ),
        (["edge-fan", "--bits", "5"], "unknown value `5` of `--bits`: expected one of 4, 8"),
    ],
)
def test_what_says_nothing_ends_with_2(tmp_path: Path, arguments: list[str], words: str) -> None:
    done = run(tmp_path, *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert words in done.stderr and "\x1b" not in done.stderr


@pytest.mark.parametrize(
    ("text", "milliseconds"),
    [("0.5ms", 0.5), ("500us", 0.5), ("500 µs", 0.5), (".5", 0.5), ("16.67", 16.67)],
)
def test_a_budget_is_a_time(text: str, milliseconds: float) -> None:
    assert command.parse_budget(text) == pytest.approx(milliseconds, rel=1e-12)


def test_no_path_ends_with_2(tmp_path: Path) -> None:
    done = run(tmp_path)
    assert done.returncode == 2 and "--list-scenes" in done.stderr


def test_scenes_are_listed(tmp_path: Path) -> None:
    done = run(tmp_path, "--list-scenes")
    assert done.returncode == 0
    assert [line.split()[0] for line in done.stdout.splitlines()] == list(NAMES)
    assert all(len(line.split()) > 2 for line in done.stdout.splitlines())


def test_every_technique_of_a_scene_has_a_point(tmp_path: Path) -> None:
    done = run(tmp_path, "edge-fan", *SMALL, "--output", "json")
    assert (done.returncode, done.stderr) == (0, "")
    data = report(done.stdout)
    assert [point["name"] for point in data["points"]] == [
        technique.name for technique in techniques()
    ]
    assert (data["device"], data["model"], data["size"], data["bits"]) == (None, None, [64, 48], 8)
    assert {(point["time_ms"], point["time_from"], point["ratio"]) for point in data["points"]} == {
        (None, "", None)
    }
    one, *_, sixteen = [point["rmse"] for point in data["points"] if point["technique"] == "msaa"]
    assert 0.2 < one < 0.35 and sixteen < one / 4
    assert data["points"][0]["bytes_per_frame"] == 64 * 48 * 4, (
        "samples stay on the tile: the picture alone is written"
    )
    (scene,) = data["scenes"]
    assert (scene["name"], scene["error_of"], scene["effects"]) == ("edge-fan", "coverage", [])
    assert scene["edge_pixels"] > 100
    assert any("4x" in each["says"] for each in data["advice"])


def test_the_same_input_gives_the_same_bytes_whatever_the_jobs(tmp_path: Path) -> None:
    alone = run(tmp_path, "edge-fan", *SMALL, "--output", "json").stdout
    three = run(tmp_path, "edge-fan", "--size", "64x48", "--jobs", "3", "--output", "json").stdout
    two = run(tmp_path, "edge-fan", "--size", "64x48", "--jobs", "2", "--output", "json").stdout
    assert alone == two == three


def test_counts_and_techniques_are_chosen(tmp_path: Path) -> None:
    data = report(
        run(
            tmp_path,
            "edge-fan",
            *SMALL,
            "--output",
            "json",
            "--samples",
            "8,4",
            "--techniques",
            "msaa",
        ).stdout
    )
    assert [(point["technique"], point["samples"]) for point in data["points"]] == [
        ("msaa", 4),
        ("msaa", 8),
    ]


def test_a_person_reads_a_table_with_its_sources(tmp_path: Path) -> None:
    done = run(tmp_path, "edge-fan", *SMALL, "--samples", "1,4", "--techniques", "msaa,ssaa")
    assert done.returncode == 0
    lines = done.stdout.splitlines()
    assert lines[0] == "edge-fan"
    assert "64x48, vertices snapped to 8 bits; no times: --device NAME measures them" in lines
    assert any(line.startswith("bytes, power, and memory: the cost model") for line in lines)
    assert any(
        re.fullmatch(r"  1x to 4x: error -[67]\d %, flicker -\d\d %", line) for line in lines
    )
    assert lines[-1] == "5 points of 1 scene"
    assert not any("to 1x" in line for line in lines), "no time is known, and none is shown"


def test_outputs_go_to_files(tmp_path: Path) -> None:
    done = run(
        tmp_path,
        "edge-fan",
        *SMALL,
        "--samples",
        "4",
        "--output",
        "json=a.json",
        "--output",
        "full=a.txt",
    )
    assert (done.returncode, done.stdout) == (0, "")
    report((tmp_path / "a.json").read_text())
    assert (tmp_path / "a.txt").read_text().startswith("edge-fan\n")
    refused = run(tmp_path, "edge-fan", *SMALL, "--samples", "4", "--output", "json=no/a.json")
    assert (
        refused.returncode == 2
        and "cannot write no/a.json: No such file or directory" in refused.stderr
    )


@pytest.mark.parametrize("ending", ["svg", "png"])
def test_plots_are_the_same_for_the_same_points(tmp_path: Path, ending: str) -> None:
    for name in ("a", "b"):
        assert (
            run(
                tmp_path, "edge-fan", *SMALL, "--samples", "1,4", "--plot", f"{name}.{ending}"
            ).returncode
            == 0
        )
    data = (tmp_path / f"a.{ending}").read_bytes()
    assert data.startswith(b"<svg" if ending == "svg" else b"\x89PNG\r\n")
    assert data == (tmp_path / f"b.{ending}").read_bytes()
    if ending == "svg":
        assert (
            b">4x</text>" in data and b">edge-fan</text>" in data and b"no times measured" in data
        )


def test_crops_are_side_by_side(tmp_path: Path) -> None:
    done = run(
        tmp_path,
        "edge-fan",
        *SMALL,
        "--samples",
        "1,4",
        "--techniques",
        "msaa,ssaa",
        "--crops",
        "pictures",
    )
    assert "written: pictures/edge-fan-crops.png" in done.stdout
    data = (tmp_path / "pictures" / "edge-fan-crops.png").read_bytes()
    assert is_own_picture(str(tmp_path / "pictures" / "edge-fan-crops.png"))
    again = run(
        tmp_path,
        "edge-fan",
        *SMALL,
        "--samples",
        "1,4",
        "--techniques",
        "msaa,ssaa",
        "--crops",
        "pictures",
    )
    assert (
        again.returncode == 0
        and (tmp_path / "pictures" / "edge-fan-crops.png").read_bytes() == data
    )


@pytest.mark.parametrize("option", ["--plot=a.svg", "--crops=pictures"])
def test_figures_without_their_extra_are_refused_before_anything_is_measured(
    option: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setitem(sys.modules, "vl_convert", None)
    name, value = option.removeprefix("--").split("=")
    with pytest.raises(UsageError, match=re.escape(needs_extra(f"--{name}", "chart"))):
        command.parse_options({"paths": ["edge-fan"], name: str(tmp_path / value)})
    assert os.listdir(tmp_path) == []


def test_a_specification_needs_nothing_that_draws_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "vl_convert", None)
    command.parse_options({"paths": ["edge-fan"], "plot": "a.json"})
    monkeypatch.setitem(sys.modules, "altair", None)
    with pytest.raises(UsageError, match=re.escape(needs_extra("--plot", "chart"))):
        command.parse_options({"paths": ["edge-fan"], "plot": "a.json"})


def test_a_plot_is_also_a_specification(tmp_path: Path) -> None:
    assert run(tmp_path, "edge-fan", *SMALL, "--samples", "1,4", "--plot", "a.json").returncode == 0
    spec = json.loads((tmp_path / "a.json").read_text())
    assert {
        row["technique"] for rows in spec["datasets"].values() for row in rows if "technique" in row
    } >= {"1x", "4x", "4x, each shaded"}
    refused = run(tmp_path, "edge-fan", "--plot", "a.pdf")
    assert (
        refused.stderr
        == "msaa-lint: `--plot` must be the name of an .svg, .png, or .json file, found `a.pdf`\n"
    )


def test_a_description_is_a_scene_of_its_own(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(FRAME)
    few = ("--jobs", "1", "--samples", "1,4", "--techniques", "msaa", "--output", "json")
    data = report(run(tmp_path, "frame.msaa.yaml", *few).stdout)
    assert data["size"] == [64, 48], "what the description states"
    assert [scene["name"] for scene in data["scenes"]] == ["frame.msaa.yaml"]
    same = run(tmp_path, "-", "--stdin-filename", "frame.msaa.yaml", *few, text=FRAME)
    assert report(same.stdout) == data
    two = run(
        tmp_path,
        "-",
        *SMALL,
        "--samples",
        "4",
        "--techniques",
        "msaa",
        "--output",
        "json",
        text=f"{FRAME}---\n{FRAME}",
    )
    assert [scene["name"] for scene in report(two.stdout)["scenes"]] == ["<stdin>#1", "<stdin>#2"]


def test_a_description_that_is_wrong_ends_with_2_and_the_others_go_on(tmp_path: Path) -> None:
    (tmp_path / "bad.msaa.yaml").write_text("images: [\n")
    (tmp_path / "frame.msaa.yaml").write_text(FRAME)
    done = run(
        tmp_path, "bad.msaa.yaml", "frame.msaa.yaml", *SMALL, "--samples", "4", "--output", "json"
    )
    assert done.returncode == 2
    assert "msaa-lint: bad.msaa.yaml: " in done.stderr
    data = report(done.stdout)
    assert [each["file"] for each in data["errors"]] == ["bad.msaa.yaml"]
    assert [scene["name"] for scene in data["scenes"]] == ["frame.msaa.yaml"]


def test_a_record_lies_beside_its_description(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(FRAME)
    done = run(tmp_path, "frame.msaa.yaml", "--jobs", "1", "--record", "--techniques", "msaa")
    assert done.returncode == 0
    assert "written: frame.msaa.yaml.msaa-study.json" in done.stdout
    checked = run_command(tmp_path, "check", "--isolated", "--select", "MSAA101", "frame.msaa.yaml")
    assert checked.returncode == 1
    assert "which its study does not justify: it leaves " in checked.stdout
    assert "its time was not measured; `--device NAME` measures it" in checked.stdout
    refused = run(tmp_path, "frame.msaa.yaml", *SMALL, "--record", "--techniques", "ssaa")
    assert refused.returncode == 2 and "--record: no sample count was measured" in refused.stderr


@pytest.mark.parametrize(("stated", "deciding"), [("", "medium"), (", shading: 100ops", "100ops")])
def test_a_record_is_made_under_the_description_s_own_cost(
    tmp_path: Path, stated: str, deciding: str
) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(FRAME.replace("edges: true", f"edges: true{stated}"))
    few = (
        "--samples",
        "1,4,8",
        "--techniques",
        "msaa",
        "--device",
        "llvmpipe",
        "--repeats",
        "3",
        "--shading",
        "none",
    )
    done = run(tmp_path, "frame.msaa.yaml", "--jobs", "1", *few, "--record", "--output", "json")
    assert done.returncode == 0, done.stderr
    data = report(done.stdout)
    assert [each["name"] for each in data["shadings"]] == ["none", deciding], (
        "beside what was asked for"
    )
    assert [point["shading"] for point in data["points"]] == ["none"] * 3 + [deciding] * 3
    assert data["software"] and data["recommendations"] == []
    (study,) = json.loads((tmp_path / "frame.msaa.yaml.msaa-study.json").read_text())["studies"]
    assert study["shading"]["name"] == deciding
    checked = run_command(tmp_path, "check", "--isolated", "--select", "MSAA101", "frame.msaa.yaml")
    assert checked.returncode == 1
    assert f"under {deciding} shading (" in checked.stdout and (
        ", the default)" in checked.stdout
    ) == (not stated)
    assert "its time is a software driver's, which says nothing about a GPU" in checked.stdout


def test_a_device_s_clock_is_named(tmp_path: Path) -> None:
    done = run(tmp_path, "edge-fan", *SMALL, "--samples", "1,4,8", "--techniques", "msaa",
    "--device", "llvmpipe", "--repeats", "3",
               "--output", "json")  # fmt: skip
    assert done.returncode == 0, done.stderr
    data = report(done.stdout)
    assert "llvmpipe" in data["device"]
    one, four, eight = data["points"][:3]
    assert [point["name"] for point in data["points"]] == ["1x", "4x", "8x"] * 3, (
        "a point for each technique under each cost of shading"
    )
    assert one["time_ms"] > 0 and four["time_ms"] > 0 and one["ratio"] == 1.0
    assert one["time_from"] == four["time_from"] == data["device"]
    assert (eight["time_ms"], eight["time_from"], eight["best"]) == (None, "", False)
    assert [each["name"] for each in data["untimed"]] == ["8x"]


def test_a_device_that_is_not_there_ends_with_2(tmp_path: Path) -> None:
    done = run(tmp_path, "edge-fan", *SMALL, "--device", "no such thing")
    assert (done.returncode, done.stdout) == (2, "")
    assert "no such thing" in done.stderr


def test_a_point_that_fails_is_told_and_ends_with_2(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    whole = measure.point

    def point(scene: Scene, technique: Technique, bits: int = 8, *more: bool) -> Point:
        if technique.samples == 4:
            raise MemoryError("no \x1b[31m room")
        return whole(scene, technique, bits, *more)

    monkeypatch.setattr(measure, "point", point)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "frame.msaa.yaml").write_text(FRAME)
    given = {
        "paths": ["frame.msaa.yaml"],
        "jobs": 1,
        "techniques": MSAA,
        "output": ["json"],
        "record": True,
    }
    assert command.study(given) == 2
    printed = capsys.readouterr()
    assert printed.err == "msaa-lint: frame.msaa.yaml: 4x: MemoryError: no \\x1b[31m room\n"
    data = report(printed.out)
    assert [each["samples"] for each in data["points"]] == [1, 2, 8, 16]
    assert data["failed"] == [
        {"scene": "frame.msaa.yaml", "name": "4x", "reason": "MemoryError: no \x1b[31m room"}
    ]
    assert not (tmp_path / "frame.msaa.yaml.msaa-study.json").exists(), (
        "no record is left of half a study"
    )


def test_a_failure_of_the_program_is_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(command, "_outcome", lambda *_: 1 / 0)
    given = {"paths": ["edge-fan"], "jobs": 1, "size": "64x48", "samples": "4", "techniques": MSAA}
    assert command.study(given) == 2
    assert (
        capsys.readouterr().err
        == "msaa-lint: internal error: ZeroDivisionError: division by zero (--traceback shows "
        "where)\n"
    )
    with pytest.raises(ZeroDivisionError):
        command.study({**given, "traceback": True})


@pytest.mark.parametrize(("missing", "arguments", "words"), [
    ("numpy", [], needs_extra("msaa-lint study", "study")),
    ("altair", ["--plot", "a.svg", "--jobs", "1"], needs_extra("--plot", "chart")),
])  # fmt: skip
def test_what_is_not_installed_is_said(
    tmp_path: Path, missing: str, arguments: list[str], words: str
) -> None:
    (tmp_path / missing).mkdir()
    (tmp_path / missing / "__init__.py").write_text(
        f"raise ModuleNotFoundError('none', name={missing!r})"
    )
    done = run(
        tmp_path,
        "edge-fan",
        "--size",
        "64x48",
        "--samples",
        "4",
        *arguments,
        PYTHONPATH=f"{ROOT}{os.pathsep}{tmp_path}",
    )
    assert done.returncode == 2
    assert words in done.stderr


@pytest.mark.parametrize(("option", "package"), [("ssim", "skimage"), ("flip", "flip_evaluator")])
def test_only_its_option_needs_a_package(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], option: str, package: str
) -> None:
    monkeypatch.setitem(sys.modules, package, None)
    given = {"paths": ["edge-fan"], "jobs": 1, "size": "64x48", "samples": "4", "techniques": MSAA}
    assert command.study(given) == 0
    capsys.readouterr()
    assert command.study({**given, option: True}) == 2
    wanted = f"msaa-lint: {needs_extra(f'--{option}', option)}\n"
    assert capsys.readouterr() == ("", wanted)


def test_flip_is_measured_where_it_is_asked_for(tmp_path: Path) -> None:
    points = json.loads(
        run(
            tmp_path,
            "hdr-emitter-before",
            *SMALL,
            "--techniques",
            "msaa",
            "--samples",
            "1,16",
            "--flip",
            "--output",
            "json",
        ).stdout
    )["points"]
    assert 0 < points[1]["flip"] < points[0]["flip"] < 1 and points[0]["ssim"] is None


@pytest.mark.skipif(sys.platform == "win32", reason="process groups are POSIX")
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_an_interrupted_sweep_loses_nothing_and_goes_on(tmp_path: Path, jobs: str) -> None:
    arguments = [
        "edge-fan",
        "near-horizontal",
        "--size",
        "320x240",
        "--output",
        "json",
        "--jobs",
        jobs,
    ]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "NO_COLOR": "1"}
    kept = tmp_path / "kept"
    with subprocess.Popen(
        [*COMMAND, *arguments, "--resume", "kept"], cwd=tmp_path, env=environment, text=True,
        start_new_session=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    ) as running:  # fmt: skip
        while running.poll() is None and len(list(kept.glob("edge-fan-*.json"))) < 2:
            time.sleep(0.01)
        os.killpg(running.pid, signal.SIGINT)
        out, error = running.communicate(timeout=60)
    assert running.returncode == 130, error
    assert out == ""
    assert (
        error
        == "msaa-lint: interrupted; finished points are in kept; run the same command to continue\n"
    )
    there = {path: path.read_bytes() for path in kept.iterdir()}
    assert (
        2
        <= len([path for path in there if not path.name.startswith("time-")])
        < 2 * len(techniques())
    )
    assert not any(path.suffix == ".tmp" for path in there)
    resumed = run(tmp_path, *arguments, "--resume", "kept")
    assert resumed.returncode == 0, resumed.stderr
    assert resumed.stdout == run(tmp_path, *arguments).stdout
    assert {path: path.read_bytes() for path in there} == there, "what was there was not had anew"


@pytest.mark.skipif(sys.platform == "win32", reason="terminals are POSIX")
def test_a_terminal_shows_progress(tmp_path: Path) -> None:
    import pty

    master, terminal = pty.openpty()
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "TERM": "xterm", "COLUMNS": "120"}
    with subprocess.Popen(
        [*COMMAND, "edge-fan", *SMALL, "--samples", "1,4"],
        cwd=tmp_path,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=terminal,
    ) as running:
        os.close(terminal)
        shown = read_terminal(master)
    assert running.returncode == 0
    assert b"/7" in shown and b"edge-fan" in shown


def test_nothing_heavy_is_imported_to_read_the_options() -> None:
    code = (
        "import sys, msaa_lint.cli.options, msaa_lint.experiments.study.points, "
        "msaa_lint.linter.study_record; print(*sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert {"numpy", "multiprocessing", "altair", "rich", "typer", "pydantic", "json"}.isdisjoint(
        done.stdout.split()
    )


def test_a_mesh_with_too_many_overlaps_is_one_error_and_others_are_studied(tmp_path: Path) -> None:
    corners = 600
    vertices = "".join(f"v {n} {n * n % 601} 0\n" for n in range(corners))
    (tmp_path / "dense.obj").write_text(
        vertices + f"f {' '.join(map(str, range(1, corners + 1)))}\n"
    )
    options = ("--size", "32x32", "--jobs", "1", "--samples", "2", "--techniques", "msaa")
    done = run(tmp_path, "dense.obj", "edge-fan", "--output", "json", *options)
    message = (
        "too many triangles overlap in the same pixels for an exact picture; simplify the "
        "mesh, or use a larger --size"
    )
    assert (done.returncode, done.stderr) == (2, f"msaa-lint: dense.obj: {message}\n")
    assert {point["scene"] for point in report(done.stdout)["points"]} == {"edge-fan"}

"""`msaa-lint cost` as a process: the published numbers, inputs, options, outputs, exit codes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.core.extras import needs_extra
from tests.command import run
from tests.frame.cost.test_reports import validator
from tests.paths import ROOT

EXAMPLES = ROOT / "examples" / "khronos-msaa"
INLINE, SEPARATE = str(EXAMPLES / "inline.msaa.yaml"), str(EXAMPLES / "color-separate.msaa.yaml")
ONE, FOUR = 561.9456, 2247.7824
"""MB/s: 2168 * 1080 * 4 B * 60 Hz, of one sample and of four."""

SMALL = """\
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4}
  out: {format: R8G8B8A8_UNORM, samples: 1}
renderPasses:
  main:
    attachments:
      color: {image: ms, loadOp: CLEAR, storeOp: STORE}
      output: {image: out, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output]}
"""
SIZED = "frame: {width: 100, height: 100, fps: 100}\n" + SMALL
MENDED = SIZED.replace("loadOp: CLEAR, storeOp: STORE", "loadOp: CLEAR, storeOp: DONT_CARE")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "a.msaa.yaml").write_text(SIZED, encoding="utf-8")
    (tmp_path / "b.msaa.yaml").write_text(MENDED, encoding="utf-8")
    (tmp_path / "unsized.msaa.yaml").write_text(SMALL, encoding="utf-8")
    return tmp_path


def report(
    folder: Path, *arguments: str, code: int = 0, stdin: bytes | None = None
) -> dict[str, Any]:
    done = run(folder, "cost", *arguments, "--output", "json", stdin=stdin)
    assert done.returncode == code, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    validator().validate(found)
    return found


def traffic(amount: dict[str, Any]) -> tuple[float, float]:
    return amount["read_mb_per_s"], amount["write_mb_per_s"]


def test_the_published_numbers(tmp_path: Path) -> None:
    found = report(tmp_path, SEPARATE)
    assert [each["name"] for each in found["passes"]] == ["scene", "resolveImage"]
    assert traffic(found["passes"][0]) == pytest.approx((0, FOUR))
    assert traffic(found["passes"][1]) == pytest.approx((FOUR, ONE))
    assert traffic(found["total"]) == pytest.approx((FOUR, FOUR + ONE))
    assert found["total"]["milliwatts"] == pytest.approx((2 * FOUR + ONE) / 10, abs=1e-5)
    assert (found["device"], found["fps"], found["milliwatts_per_gbps"]) == ("Mali-G76", 60, 100)
    costs = {(each["samples"], each["resolve"]): sum(traffic(each)) for each in found["variants"]}
    assert costs[1, "none"] == pytest.approx(ONE)
    assert costs[4, "inline"] == pytest.approx(ONE)
    assert costs[4, "separate"] - costs[4, "inline"] == pytest.approx(2 * FOUR)


def test_fixed_is_what_the_fixes_leave(folder: Path) -> None:
    found = report(folder, "a.msaa.yaml")
    assert traffic(found["total"]) == (0, 20)
    assert traffic(found["fixed"]) == (0, 4)
    assert report(folder, INLINE)["fixed"] is None, "nothing is found there"


def test_table_in_a_pipe(folder: Path) -> None:
    done = run(folder, "cost", "a.msaa.yaml")
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert (
        lines[0]
        == "a.msaa.yaml: 100 frames per second on no device (on a tile-based GPU), 100 mW per "
        "GB/s, budget 2500 mW"
    )
    total = next(line for line in lines if line.startswith("total"))
    assert total.split() == ["total", "0.00", "20.00", "0.19", "2.0", "0.1%"]
    assert "\x1b" not in done.stdout
    assert "\x1b[" in run(folder, "cost", "a.msaa.yaml", "--color", "always").stdout


def test_several_inputs_are_listed_with_their_totals(folder: Path) -> None:
    found = report(folder, ".")
    assert [each["file"] for each in found["frames"]] == [
        "a.msaa.yaml",
        "b.msaa.yaml",
        "unsized.msaa.yaml",
    ]
    assert "device" not in found, "what belongs to one frame stands with it"
    assert traffic(found["total"]) == (0, 24)
    assert [(each["file"], each["name"]) for each in found["passes"]] == [
        (each["file"], "main") for each in found["frames"]
    ]


def test_documents_of_one_file(folder: Path) -> None:
    (folder / "two.yaml").write_text(f"{SIZED}---\n{MENDED}", encoding="utf-8")
    found = report(folder, "two.yaml")
    assert [(each["document"], traffic(each["total"])) for each in found["frames"]] == [
        (0, (0, 20)),
        (1, (0, 4)),
    ]
    assert (
        "two.yaml, document 2: 100 frames per second on no device"
        in run(folder, "cost", "two.yaml").stdout
    )


def test_two_files_are_compared(folder: Path) -> None:
    found = report(folder, "b.msaa.yaml", "a.msaa.yaml")
    assert traffic(found["difference"]["total"]) == (0, 16)
    assert found["difference"]["total"]["percent"] == 400
    assert [(each["name"], each["status"]) for each in found["difference"]["passes"]] == [
        ("main", "changed")
    ]
    assert traffic(found["old"]["total"]) == (0, 4)
    done = run(folder, "cost", "b.msaa.yaml", "a.msaa.yaml")
    assert (
        "b.msaa.yaml -> a.msaa.yaml\nThis change: 0.00 MB/s read, +16.00 MB/s written, 0.00 MiB, "
        "+1.6 mW" in done.stdout
    )


def test_the_way_back_costs_the_opposite_and_the_same_file_nothing(folder: Path) -> None:
    there, back = (
        report(folder, *paths)["difference"]
        for paths in (("a.msaa.yaml", "b.msaa.yaml"), ("b.msaa.yaml", "a.msaa.yaml"))
    )
    assert traffic(there["total"]) == (0, -16)
    assert traffic(back["total"]) == (0, 16)
    same = report(folder, "a.msaa.yaml", "a.msaa.yaml")["difference"]
    assert [each["status"] for each in same["passes"]] == ["same"]
    assert traffic(same["total"]) == (0, 0)
    assert "This change costs nothing" in run(folder, "cost", "a.msaa.yaml", "a.msaa.yaml").stdout


def test_each_lists_two_files(folder: Path) -> None:
    assert len(report(folder, "a.msaa.yaml", "b.msaa.yaml", "--each")["frames"]) == 2


def test_standard_input_is_one_of_two(folder: Path) -> None:
    found = report(
        folder, "-", "a.msaa.yaml", "--stdin-filename", "old.yaml", stdin=MENDED.encode()
    )
    assert found["old"]["file"] == "old.yaml"
    assert traffic(found["difference"]["total"]) == (0, 16)


def test_markdown_for_a_comment(folder: Path) -> None:
    done = run(folder, "cost", "b.msaa.yaml", "a.msaa.yaml", "--output", "markdown")
    assert done.stdout.startswith(
        "<!-- msaa-lint cost -->\n### Cost of this change\n\nb.msaa.yaml → a.msaa.yaml\n"
    )
    assert (
        "| main | changed | 4.00 | 20.00 | 0.00 | +16.00 | 0.00 | +1.6 | +400.0 % |\n"
        in done.stdout
    )


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ([], (0.0, 0.0)),
        (["--size", "100x100"], (0.0, 12.0)),
        (["--size", "100X200", "--fps", "120"], (0.0, 48.0)),
    ],
)
def test_what_the_input_does_not_state_is_stated_by_options(
    folder: Path, options: list[str], expected: tuple[float, float]
) -> None:
    assert traffic(report(folder, "unsized.msaa.yaml", *options)["total"]) == expected


@pytest.mark.parametrize(
    ("text", "milliwatts"), [("5000mW", 5000), ("2.5W", 2500), ("0.5 mW", 0.5)]
)
def test_budget(folder: Path, text: str, milliwatts: float) -> None:
    assert report(folder, "a.msaa.yaml", "--budget", text)["budget_milliwatts"] == milliwatts


def test_power(folder: Path) -> None:
    assert report(folder, "a.msaa.yaml", "--milliwatts-per-gbps", "60")["total"][
        "milliwatts"
    ] == pytest.approx(1.2)


def test_profile_corrects(folder: Path) -> None:
    found = report(folder, "a.msaa.yaml", "--profile", "mali-g76")
    assert found["device"] == "Mali-G76"
    assert found["total"]["corrected"]["write_mb_per_s"] < found["total"]["write_mb_per_s"]
    assert report(folder, "a.msaa.yaml")["total"]["corrected"] is None


def test_samples(folder: Path) -> None:
    counts = {
        each["samples"]
        for each in report(folder, "a.msaa.yaml", "--samples", "1, 4,16")["variants"]
    }
    assert counts == {1, 4, 16}


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (
            ["--size", "100"],
            "`--size` must be WIDTHxHEIGHT in pixels, as in 1920x1080; found `100`",
        ),
        (["--size", "0x5"], "as in 1920x1080; found `0x5`"),
        (["--size", "9999999999x5"], "--size"),
        (["--size", "1x2x3"], "--size"),
        (["--fps", "0"], "`--fps` must be a number above 0, found `0`"),
        (["--fps", "nan"], "`--fps` must be a number above 0, found `nan`"),
        (
            ["--milliwatts-per-gbps", "inf"],
            "`--milliwatts-per-gbps` must be a number above 0, found `inf`",
        ),
        (
            ["--budget", "2500"],
            "invalid power `2500` in `--budget`: a unit is missing; write 2500mW or 2.5W",
        ),
        (
            ["--budget", "2.5w"],
            "invalid power `2.5w` in `--budget`: unknown unit `w`; did you mean `W`?",
        ),
        (
            ["--budget", "50MB/s"],
            "invalid power `50MB/s` in `--budget`: unknown unit `MB/s`; expected one of mW, W",
        ),
        (
            ["--budget", "0"],
            "invalid power `0` in `--budget`: expected a number above 0 with one of the units mW, "
            "W, as in 50mW",
        ),
        (
            ["--samples", "3"],
            "`--samples` must be a comma-separated list of 1, 2, 4, 8, 16, 32, 64; found `3`",
        ),
        (["--samples", ""], "--samples"),
        (["--samples", "\x1b[2J"], "`\\x1b[2J`"),
        (
            ["--output", "sarif"],
            "unknown output format `sarif`: expected one of full, json, markdown",
        ),
        (["--output", "json", "--output", "markdown"], "only one output can go to standard output"),
        (["--output", "json=no/such/folder/x.json"], "cannot write no/such/folder/x.json"),
        (["--chart", "x.pdf"], "must be the name of an .svg, .png, or .json file"),
        (["--profile", "mali-g67"], "no profile `mali-g67`"),
        (["--config", "none.toml"], "none.toml"),
    ],
)
def test_options_that_cannot_be_used(folder: Path, options: list[str], said: str) -> None:
    done = run(folder, "cost", "a.msaa.yaml", *options)
    assert done.returncode == 2
    assert said in done.stderr


@pytest.mark.parametrize(
    "text", ["", "# nothing\n", "a: [", "images: {a: {smaples: 4}}", "[" * 5000, "images: null"]
)
def test_an_input_that_cannot_be_used_is_said_as_check_says_it_and_the_others_are_shown(
    folder: Path, text: str
) -> None:
    (folder / "broken.msaa.yaml").write_text(text, encoding="utf-8")
    done = run(folder, "cost", "broken.msaa.yaml", "a.msaa.yaml", "b.msaa.yaml")
    assert done.returncode == 2
    checked = run(folder, "check", "broken.msaa.yaml", "--output", "concise").stdout.splitlines()
    assert done.stderr.splitlines() == [line for line in checked if ": error[" in line]
    assert "a.msaa.yaml: 100 frames per second on no device" in done.stdout
    found = report(folder, "broken.msaa.yaml", "a.msaa.yaml", code=2)
    assert [each["file"] for each in found["errors"]] == ["broken.msaa.yaml"] * len(found["errors"])
    assert found["file"] == "a.msaa.yaml", "what is left of two is listed"


def test_a_document_that_cannot_be_used_leaves_the_others(folder: Path) -> None:
    (folder / "two.yaml").write_text(
        f"images: {{a: {{smaples: 4}}}}\n---\n{SIZED}", encoding="utf-8"
    )
    found = report(folder, "two.yaml", code=2)
    assert [each["document"] for each in found["frames"]] == [1]


def test_no_input_that_can_be_used(folder: Path) -> None:
    found = report(folder, "missing.yaml", code=2)
    assert (found["passes"], found["frames"], len(found["errors"])) == ([], [], 1)
    assert run(folder, "cost").returncode == 2


def test_outputs_go_to_files(folder: Path) -> None:
    done = run(
        folder,
        "cost",
        "a.msaa.yaml",
        "--output",
        "json=cost.json",
        "--output",
        "markdown=cost.md",
        "--output",
        "full",
    )
    assert "total" in done.stdout
    validator().validate(json.loads((folder / "cost.json").read_text(encoding="utf-8")))
    assert (folder / "cost.md").read_text(encoding="utf-8").startswith("<!-- msaa-lint cost -->\n")


def test_names_are_shown_and_do_nothing(folder: Path) -> None:
    name = "\\e[2J\\u202e[red]::error::x|<script>"
    image = '"::stop-commands::x"'
    text = (
        SIZED.replace("main:", f'"{name}":')
        .replace("ms:", f"{image}:")
        .replace("image: ms", f"image: {image}")
    )
    (folder / "hostile.yaml").write_text(text, encoding="utf-8")
    text = (
        run(folder, "cost", "hostile.yaml", "--output", "markdown=x.md").stdout
        + run(folder, "cost", "hostile.yaml").stdout
    )
    for line in (text + (folder / "x.md").read_text(encoding="utf-8")).split("\n"):
        assert line.isprintable()
        assert not line.lstrip().startswith("::")
    assert "\\x1b[2J\\u202e[red]" in text


def test_the_same_input_gives_the_same_bytes(folder: Path) -> None:
    for format in ("full", "json", "markdown"):
        once, again = (run(folder, "cost", ".", "--output", format).stdout for _ in range(2))
        assert once == again


def test_a_reader_that_goes_away_is_no_failure_of_the_program(folder: Path) -> None:
    import subprocess
    import sys

    command = f"{sys.executable} -m msaa_lint cost {EXAMPLES.parent} | head -1"
    done = subprocess.run(
        ["sh", "-c", command], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert "Traceback" not in done.stderr and "failed" not in done.stderr


def test_chart(folder: Path) -> None:
    for paths in (["a.msaa.yaml"], ["b.msaa.yaml", "a.msaa.yaml"]):
        assert run(folder, "cost", *paths, "--chart", "x.svg").returncode == 0
        once = (folder / "x.svg").read_bytes()
        assert once.startswith(b"<svg")
        run(folder, "cost", *paths, "--chart", "x.svg", "--output", "json=x.json")
        assert (folder / "x.svg").read_bytes() == once
    assert run(folder, "cost", "a.msaa.yaml", "--chart", "x.PNG").returncode == 0
    assert (folder / "x.PNG").read_bytes().startswith(b"\x89PNG")
    done = run(folder, "cost", ".", "--chart", "y.svg")
    assert done.returncode == 2
    assert "--chart draws one frame, or two that are compared, not 3" in done.stderr
    assert (
        "cannot write no/such/x.svg"
        in run(folder, "cost", "a.msaa.yaml", "--chart", "no/such/x.svg").stderr
    )


def test_chart_without_its_extra_says_how_to_install_it(folder: Path) -> None:
    (folder / "shadow" / "altair").mkdir(parents=True)
    (folder / "shadow" / "altair" / "__init__.py").write_text(
        "raise ModuleNotFoundError(name='altair')\n", encoding="utf-8"
    )
    done = run(
        folder, "cost", "a.msaa.yaml", "--chart", "x.svg", PYTHONPATH=f"{folder / 'shadow'}:{ROOT}"
    )
    assert done.returncode == 2
    assert done.stderr == f"msaa-lint: {needs_extra('--chart', 'chart')}\n"
    assert "total" in done.stdout, "the table is shown all the same"
    assert not (folder / "x.svg").exists()


def test_help_says_what_two_files_and_exit_codes_mean(tmp_path: Path) -> None:
    shown = " ".join(run(tmp_path, "cost", "--help", COLUMNS="200").stdout.split())
    for option in [
        "each",
        "fps",
        "size",
        "profile",
        "milliwatts-per-gbps",
        "budget",
        "samples",
        "output",
        "chart",
        "color",
    ]:
        assert f"--{option}" in shown
    assert "Exactly two files are compared" in shown
    assert "Exits with 0" in shown


UNKNOWN = """\
images:
  a: {format: R8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
  b: {samples: 4, usage: [COLOR_ATTACHMENT]}
renderPasses:
  main:
    attachments:
      - {image: a, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      - {image: b, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
    subpasses:
      - {colorAttachments: [0, 1]}
"""


@pytest.mark.parametrize(
    "paths", [("a.msaa.yaml", "unknown.msaa.yaml"), ("unknown.msaa.yaml", "a.msaa.yaml")]
)
@pytest.mark.parametrize("output", ["full", "json", "markdown"])
def test_what_lacks_sizes_is_not_compared(
    folder: Path, paths: tuple[str, str], output: str
) -> None:
    (folder / "unknown.msaa.yaml").write_text(UNKNOWN, encoding="utf-8")
    done = run(folder, "cost", *paths, "--output", output)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        "msaa-lint: unknown.msaa.yaml: cannot be compared, because the cost of `main` is unknown: "
        "its size is not stated: write `frame: {width: ..., height: ...}`, or give --size WxH\n"
    )
    done = run(folder, "cost", *paths, "--output", output, "--size", "100x100")
    assert (done.returncode, done.stdout) == (2, "")
    assert (
        "the cost of `main` is unknown: `b (attachment 1)`: its format is not stated: write "
        "`format`\n" in done.stderr
    )
    (folder / "unknown.msaa.yaml").write_text(
        UNKNOWN.replace("b: {", "b: {format: R8_UNORM, "), encoding="utf-8"
    )
    assert run(folder, "cost", *paths, "--output", output, "--size", "100x100").returncode == 0


def test_what_lacks_sizes_is_shown_alone(folder: Path) -> None:
    (folder / "unknown.msaa.yaml").write_text(UNKNOWN, encoding="utf-8")
    for words in (["unknown.msaa.yaml"], ["a.msaa.yaml", "unknown.msaa.yaml", "--each"]):
        done = run(folder, "cost", *words)
        assert done.returncode == 0
        assert (
            "\nunknown: `main`: its size is not stated: write `frame: {width: ..., height: ...}`\n"
            in done.stdout
        )

"""Many inputs: divided among processes, and kept between runs. The output is the same bytes as that
of one process.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from msaa_lint.core.cache import FILE
from msaa_lint.core.text.files import FINE_CLOCK
from msaa_lint.linter.engine import Engine
from tests.command import environment_of, run, run_process
from tests.descriptions import CLEAN, STORED
from tests.paths import ROOT

pytestmark = pytest.mark.skipif(
    sys.platform == "win32", reason="processes are copied, and ended by signals"
)

FILLER = f"# {'filler ' * 60}\n"
BROKEN = "images: {color: {samples: 3}}\n"

RULE = """\
---
code: TEAM1
severity: warning
subject: image
when: image.samples == 4
message: "{image.name} has 4 samples"
---

# team-rule

Samples cost memory.
"""


@pytest.fixture
def corpus(tmp_path: Path) -> Path:
    """Forty descriptions under two configurations, a program, a broken input, an input that cannot
    be read, and a custom rule.
    """
    folder = tmp_path / "corpus"
    for number in range(40):
        path = folder / ("team" if number % 2 else "other") / f"{number:02}.msaa.yaml"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(
            (CLEAN, STORED, STORED + "# msaa-lint: ignore-file[MSAA201] here\n", BROKEN)[number % 4]
            + FILLER
        )
    (folder / "team" / "msaa-lint.toml").write_text('rules = ["pages"]\nignore = ["MSAA403"]\n')
    (folder / "team" / "pages").mkdir()
    (folder / "team" / "pages" / "team-rule.md").write_text(RULE)
    (folder / "other" / "unreadable.msaa.yaml").write_bytes(b"images: \xff\n")
    return folder


@pytest.fixture
def thread() -> Iterator[None]:
    """Another thread, with which a process is not copied."""
    end = threading.Event()
    other = threading.Thread(target=end.wait)
    other.start()
    yield
    end.set()
    other.join()


def check(corpus: Path, *options: str, **environment: str) -> tuple[int, str, str]:
    """The exit code and the output of a run in a process of its own."""
    done = run_process(corpus, "check", ".", "--output", "json", *options, **environment)
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize(
    "options",
    [
        (),
        ("--fail-on-cost", "1mW"),
        ("--baseline", "baseline.json"),
        ("--sort", "price"),
        ("--ignore", "MSAA2"),
    ],
)
def test_processes_say_what_one_says(corpus: Path, options: tuple[str, ...]) -> None:
    run(corpus, "baseline", "other/01.msaa.yaml", "other/02.msaa.yaml", "--file", "baseline.json")
    one = check(corpus, "--jobs", "1", "--no-cache", *options)
    assert "TEAM1" in one[1] and "unreadable" in one[1]
    assert check(corpus, "--jobs", "3", "--no-cache", *options) == one


@pytest.mark.parametrize("output", ["concise", "sarif", "html"])
def test_every_format_is_the_same(corpus: Path, output: str) -> None:
    one, three = (
        run_process(corpus, "check", ".", "--output", output, "--jobs", jobs, "--no-cache").stdout
        for jobs in ("1", "3")
    )
    assert one == three and "MSAA201" in one


def test_json_is_the_same_with_another_output(corpus: Path) -> None:
    """Beside one that needs all findings, it is not put together from the texts of the inputs."""
    pytest.importorskip("tree_sitter_cpp")
    from tests.input.code.project.test_folders import PASS, settings, write

    write(
        corpus / "code",
        {
            "a.cpp": PASS,
            "b.cpp": PASS,
            "settings.h": settings(4),
            "other.cpp": PASS.replace('"settings.h"', '"no.h"'),
        },
    )
    (corpus / "msaa-lint.toml").write_text(
        'select = ["MSAA2", "MSAA4", "MSAA999"]\nmin-severity = "warning"\n'
    )
    alone = run(corpus, "check", ".", "missing.msaa.yaml", "--output", "json", "--no-cache")
    run(
        corpus,
        "check",
        ".",
        "missing.msaa.yaml",
        "--output",
        "json=both.json",
        "--output",
        "concise",
        "--no-cache",
    )
    assert json.loads(alone.stdout)["summary"]["files_with_findings"] > 20
    assert {"code/a.cpp", "missing.msaa.yaml"} <= {
        finding["file"] for finding in json.loads(alone.stdout)["findings"]
    }
    assert (corpus / "both.json").read_text() == alone.stdout


@pytest.mark.usefixtures("thread")
def test_processes_that_are_not_copies_say_the_same(corpus: Path) -> None:
    done = run(corpus, "check", ".", "--output", "json", "--jobs", "2", "--no-cache")
    assert (done.returncode, done.stdout, done.stderr) == check(corpus, "--jobs", "1", "--no-cache")


def test_one_input_that_ends_processes_is_a_finding_of_it(corpus: Path) -> None:
    code = """if True:
        import os, signal, sys
        from msaa_lint.__main__ import main
        from msaa_lint.linter.engine import Engine
        lint = Engine.lint
        def poisonous(self, data, file, options):
            if file == "other/04.msaa.yaml":
                os.kill(os.getpid(), signal.SIGKILL)
            return lint(self, data, file, options)
        Engine.lint = poisonous
        sys.argv = ["msaa-lint", "check", ".", "--output", "json", "--jobs", "2", "--no-cache"]
        main()
    """
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=corpus,
        capture_output=True,
        text=True,
        check=False,
        env=environment_of({}),
    )
    assert (done.returncode, done.stderr) == (2, "")
    found, expected = (
        json.loads(done.stdout)["findings"],
        json.loads(check(corpus, "--jobs", "1")[1])["findings"],
    )
    assert [each for each in found if each not in expected] == [
        {**next(each for each in found if each["file"] == "other/04.msaa.yaml"), "code": "MSAA941"}
    ]
    (lost,) = [each for each in found if each["file"] == "other/04.msaa.yaml"]
    assert lost["message"] == (
        "not linted: it ended the process that read it (SIGKILL): memory probably ran out; use "
        "fewer `--jobs` or more memory"
    )
    assert [each for each in found if each != lost] == [
        each for each in expected if each["file"] != "other/04.msaa.yaml"
    ]


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_second_run_says_the_same(corpus: Path, tmp_path: Path, jobs: str) -> None:
    kept = {"XDG_CACHE_HOME": str(tmp_path / "kept")}
    first = check(corpus, "--jobs", jobs, **kept)
    assert any((tmp_path / "kept" / "msaa-lint").iterdir())
    assert check(corpus, "--jobs", jobs, **kept) == first == check(corpus, "--no-cache")


def test_a_damaged_cache_is_begun_anew(corpus: Path, tmp_path: Path) -> None:
    kept = {"XDG_CACHE_HOME": str(tmp_path / "kept")}
    first = check(corpus, **kept)
    database = tmp_path / "kept" / "msaa-lint" / FILE
    database.write_bytes(b"no database")
    code, out, errors = check(corpus, **kept)
    assert (code, out) == first[:2] and errors.count("was damaged and is begun anew") == 1
    assert check(corpus, **kept) == first


def linted(corpus: Path, kept: Path, monkeypatch: pytest.MonkeyPatch, *options: str) -> list[str]:
    """The inputs that a run lints, in this process."""
    names: list[str] = []
    lint = Engine.lint
    # What was written just before a run is not relied on.
    time.sleep(2 * FINE_CLOCK / 1e9)

    def noted(self: Engine, data: object, file: str, options: object) -> object:
        names.append(file)
        return lint(self, data, file, options)  # type: ignore[arg-type]

    with monkeypatch.context() as patch:
        patch.setattr(Engine, "lint", noted)
        run(
            corpus,
            "check",
            ".",
            "--output",
            "json",
            "--jobs",
            "1",
            *options,
            XDG_CACHE_HOME=str(kept),
        )
    return list(dict.fromkeys(names))


def test_a_second_run_reads_what_changed(
    corpus: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = tmp_path / "kept"
    first = linted(corpus, kept, monkeypatch)
    assert len(first) == 41
    assert linted(corpus, kept, monkeypatch) == []
    (corpus / "other" / "00.msaa.yaml").write_text(STORED)
    assert linted(corpus, kept, monkeypatch)[:1] == ["other/00.msaa.yaml"]
    # The same content under a new state: a checkout writes all files anew.
    for path in (corpus / "other").iterdir():
        os.utime(path, (2, 2))
    assert "other/02.msaa.yaml" not in linted(corpus, kept, monkeypatch)
    (corpus / "team" / "pages" / "team-rule.md").write_text(RULE.replace("has 4", "takes 4"))
    assert {name.split("/")[0] for name in linted(corpus, kept, monkeypatch)} == {"team"}
    (corpus / "team" / "msaa-lint.toml").write_text('rules = ["pages"]\n')
    assert sum(name.startswith("team") for name in linted(corpus, kept, monkeypatch)) == 20
    assert len(linted(corpus, kept, monkeypatch, "--no-ignores")) == 41
    monkeypatch.setattr("msaa_lint.input.code.project.version.VERSION", "another")
    assert len(linted(corpus, kept, monkeypatch)) == 41


def test_a_shader_beside_an_input_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """So is one that is missing, and appears."""
    folder = tmp_path / "frames"
    folder.mkdir()
    shader = "pipelines:\n  draw: {stages: [{stage: FRAGMENT, module: draw.spv}]}\n"
    for number in range(20):
        (folder / f"{number}.msaa.yaml").write_text(f"{CLEAN}{shader}{FILLER * 3}")
    kept = tmp_path / "kept"
    assert len(linted(folder, kept, monkeypatch)) == 20 and linted(folder, kept, monkeypatch) == []
    (folder / "draw.spv").write_bytes(b"\x03\x02\x23\x07")
    assert len(linted(folder, kept, monkeypatch)) == 20 and linted(folder, kept, monkeypatch) == []
    (folder / "draw.spv").write_bytes(b"\x03\x02\x23\x07\0\0\1\0")
    assert len(linted(folder, kept, monkeypatch)) == 20


def test_what_cannot_be_divided_is_linted_by_one_process(corpus: Path) -> None:
    """Standard input is read once, and fixes are made in order."""
    named = ("--stdin-filename", "in.msaa.yaml")
    done = run_process(
        corpus,
        "check",
        "other",
        "-",
        *named,
        "--jobs",
        "3",
        "--output",
        "concise",
        stdin=STORED.encode(),
    )
    assert "in.msaa.yaml:7:59: warning[multisampled-attachment-stored]" in done.stdout
    fixed = run_process(corpus, "check", ".", "--fix", "--unsafe-fixes", "--jobs", "3")
    assert "MSAA201" not in run_process(corpus, "check", ".").stdout and fixed.returncode == 2


def test_processes_of_no_use_are_not_started(tmp_path: Path) -> None:
    (tmp_path / "one.msaa.yaml").write_text(STORED)
    command = [sys.executable, "-X", "importtime", "-m", "msaa_lint", "check", "one.msaa.yaml"]
    done = subprocess.run(
        command,
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        env=environment_of({"PYTHONPATH": str(ROOT)}),
    )
    assert "multiprocessing" not in done.stderr and "msaa_lint.linter.kept_parts" not in done.stderr


@pytest.mark.parametrize("output", ["full", "json", "html"])
def test_costs_are_those_of_one_process(corpus: Path, output: str) -> None:
    one, three = (
        run_process(corpus, "cost", ".", "--each", "--output", output, "--jobs", jobs)
        for jobs in ("1", "3")
    )
    assert (one.returncode, one.stdout, one.stderr) == (
        three.returncode,
        three.stdout,
        three.stderr,
    )
    assert one.returncode == 2 and "forward" in one.stdout and "unreadable" in one.stderr

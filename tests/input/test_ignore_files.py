"""Ignore files, compared with what git and ruff find in the same trees."""

import os
import random
import shutil
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

import pytest

from msaa_lint.input.discovery import discover
from msaa_lint.linter.settings.settings import Settings
from tests.command import run


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "p/.git/info").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "p")
    return tmp_path / "p"


def write(*names: str, text: str = "images: {color: {format: R8G8B8A8_UNORM}}\n") -> None:
    for name in names:
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_text(text)


def files(*paths: str, respect: bool = True) -> list[str]:
    return discover(paths or (".",), lambda path: Settings(respect_gitignore=respect)).files


@pytest.mark.parametrize(
    ("lines", "skipped"),
    [
        ("gen/", ["gen/a.yaml", "gen/b/a.yaml", "x/gen/a.yaml"]),
        ("/gen", ["gen/a.yaml", "gen/b/a.yaml"]),
        ("gen/*.yaml", ["gen/a.yaml"]),
        ("gen/**", ["gen/a.yaml", "gen/b/a.yaml"]),
        ("**/b", ["gen/b/a.yaml"]),
        ("gen/**/a.yaml", ["gen/a.yaml", "gen/b/a.yaml"]),
        ("*.yaml\n!a.yaml", ["!.yaml", "#.yaml", "x.yaml"]),
        ("gen/*\n!gen/b/", ["gen/a.yaml"]),
        ("gen/\n!gen/a.yaml", ["gen/a.yaml", "gen/b/a.yaml", "x/gen/a.yaml"]),
        ("# a comment\n\n  \n/x.yaml  \r\n", ["x.yaml"]),
        ("\\#.yaml\n\\!.yaml\nx.yam[k-m]", ["!.yaml", "#.yaml", "x.yaml"]),
        ("[a-\n../x.yaml\n./x.yaml\na//b\n", []),
        ("\ufeffx.yaml", ["x.yaml"]),
        ("[[:lower:]].yaml", ["a.yaml", "gen/a.yaml", "gen/b/a.yaml", "x.yaml", "x/gen/a.yaml"]),
        ("[![:lower:][:space:]].yaml", ["!.yaml", "#.yaml"]),
    ],
)
def test_patterns_are_gits(project: Path, lines: str, skipped: list[str]) -> None:
    everything = [
        "!.yaml",
        "#.yaml",
        "a.yaml",
        "gen/a.yaml",
        "gen/b/a.yaml",
        "x.yaml",
        "x/gen/a.yaml",
    ]
    write(*everything)
    Path(".gitignore").write_bytes(lines.encode())
    assert sorted(set(everything) - set(files())) == skipped
    assert files(respect=False) == sorted(everything, key=lambda name: name.split("/"))


def test_the_nearest_file_decides_from_the_root_of_the_repository_downward(project: Path) -> None:
    write("a/x.yaml", "a/b/x.yaml", "a/b/y.yaml", "c/x.yaml")
    write("../.gitignore", text="*\n")
    write("../.ignore", text="c/\n")
    write("c/y.yaml", "d/x.yaml")
    write(".gitignore", text="x.yaml\n")
    write("a/b/.gitignore", text="!x.yaml\n/y.yaml\n")
    assert files() == ["a/b/x.yaml"]
    assert files("a/b", "c") == ["a/b/x.yaml", "c/y.yaml"]


def test_a_named_file_is_judged_and_a_named_folder_is_searched(project: Path) -> None:
    write(".gitignore", text="gen/\n*.json\n")
    write("gen/a.yaml", "gen/b.json", "c.json")
    assert files("gen/b.json", "c.json") == ["c.json", "gen/b.json"]
    assert files("gen") == ["gen/a.yaml"]


def test_a_repository_in_another_begins_anew_and_a_folder_without_one_reads_dot_ignore_alone(
    project: Path,
) -> None:
    write(".gitignore", ".git/info/exclude", text="*.yaml\n")
    write("a.yaml", "sub/b.yaml", "sub/c.yaml")
    assert files() == []
    write("sub/.git", text="gitdir: ../.git/modules/sub\n")
    write(".git/modules/sub/info/exclude", text="c.yaml\n")
    assert files() == ["sub/b.yaml"]
    shutil.rmtree(".git")
    Path("sub/.git").unlink()
    assert files() == ["a.yaml", "sub/b.yaml", "sub/c.yaml"]
    write(".ignore", text="c.yaml\n")
    assert files() == ["a.yaml", "sub/b.yaml"]


def test_the_exclude_file_of_a_worktree_is_that_of_its_repository(project: Path) -> None:
    write("main/.git/info/exclude", text="x.yaml\n")
    write("main/.git/worktrees/tree/commondir", text="../..\n")
    write("tree/.git", text=f"gitdir: {project}/main/.git/worktrees/tree\n")
    write("tree/x.yaml", "tree/y.yaml")
    assert files("tree") == ["tree/y.yaml"]


def test_dot_ignore_takes_precedence(project: Path) -> None:
    write(".gitignore", text="x.yaml\n/gen/\n")
    write(".ignore", text="!x.yaml\ny.yaml\n")
    write("x.yaml", "y.yaml", "gen/a.yaml", "sub/x.yaml")
    assert files() == ["sub/x.yaml", "x.yaml"]


def test_what_is_ignored_is_not_opened_and_hostile_ignore_files_do_no_harm(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write("gen/a.yaml", "b.yaml", "c.yaml")
    write(".gitignore", text="gen/\nb.yaml\n")
    opened: list[str] = []
    real = os.scandir
    monkeypatch.setattr(os, "scandir", lambda path: opened.append(str(path)) or real(path))
    assert files() == ["c.yaml"]
    assert "gen" not in opened
    Path(".gitignore").unlink()
    os.mkfifo(".gitignore")
    assert len(files()) == 3
    Path(".gitignore").unlink()
    Path(".gitignore").symlink_to("c.yaml")
    Path(".ignore").mkdir()
    assert len(files()) == 3
    Path(".gitignore").unlink()
    Path(".gitignore").write_bytes(b"\xff\xfe\0[\n" + b"*a" * 100_000 + b"\n" + b"b.yaml\n" * 2000)
    assert files() == ["c.yaml", "gen/a.yaml"]


def test_settings_and_options_turn_it_off(project: Path) -> None:
    write(".gitignore", text="gen/\n")
    write(
        "gen/a.yaml",
        "b.yaml",
        text="images: {c: {samples: 3, format: R8_UNORM, usage: [SAMPLED]}}\n",
    )
    for command in ("check", "cost", "confirm", "baseline"):
        done = run(project, command, ".")
        assert (
            "b.yaml" in done.stdout + done.stderr and "gen/a.yaml" not in done.stdout + done.stderr
        ), command
        done = run(project, command, ".", "--no-respect-gitignore")
        assert (
            "b.yaml" in done.stdout + done.stderr and "gen/a.yaml" in done.stdout + done.stderr
        ), command
    write("msaa-lint.toml", text="respect-gitignore = false\n")
    assert "gen/a.yaml" in run(project, "check", ".").stdout
    write("msaa-lint.toml", text='respect-gitignore = "no"\n')
    assert (
        "expected true or false, found a string in `respect-gitignore` of msaa-lint.toml"
        in run(project, "check", ".").stdout
    )


def test_a_folder_of_which_all_is_ignored_says_so(project: Path) -> None:
    write(".gitignore", text="gen/\nb.yaml\n")
    write("gen/a.yaml", "b.yaml")
    done = run(project, "check", ".")
    assert done.returncode == 2
    assert "name other files (skipped: 2 paths that .gitignore or .ignore lists)" in done.stdout


NAMES = ["a", "b", "ab", "*", "?", "**", "[ab]", "[!a]", "a*", "*b", "a.*", "?.*"]


def random_tree(root: Path, pick: random.Random, ignore_files: tuple[str, ...]) -> list[str]:
    """Writes `a`, `b`, and `ab`, each as an input and as a Python file, to random folders with
    random ignore files; returns the folders.
    """
    folders = ["/".join(pick.choices(["a", "b", "ab"], k=pick.randint(0, 4))) for _ in range(10)]
    for folder in folders:
        (root / folder).mkdir(parents=True, exist_ok=True)
        for name in ("a", "b", "ab"):
            (root / folder / f"{name}.msaa.yaml").write_text("images: {}\n")
            (root / folder / f"{name}.py").write_text("")
    for name in ignore_files:
        for folder in pick.sample(folders, 2):
            globs = ["/".join(pick.choices(NAMES, k=pick.randint(1, 2))) for _ in range(4)]
            lines = [
                pick.choice(["", "", "!"])
                + pick.choice(["", "", "/"])
                + glob
                + pick.choice(["", "/"])
                for glob in globs
            ]
            (root / folder / name).write_text("\n".join(lines) + "\n")
    return folders


@pytest.mark.skipif(shutil.which("git") is None, reason="git is the reference, and is not here")
def test_the_files_of_random_trees_are_those_that_git_lists(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pick = random.Random(11)
    for number in range(25):
        root = tmp_path / str(number)
        random_tree(root, pick, (".gitignore", ".gitignore"))
        subprocess.run(["git", "init", "-q", str(root)], check=True)
        (root / ".git/info/exclude").write_text("ab.msaa.yaml\n")
        command = [
            "git",
            "-C",
            str(root),
            "-c",
            "core.excludesFile=",
            "ls-files",
            "--others",
            "--exclude-standard",
        ]
        listed = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
        monkeypatch.chdir(root)
        assert set(files()) == {name for name in listed if name.endswith(".msaa.yaml")}, root


@pytest.mark.skipif(find_spec("ruff") is None, reason="ruff is the reference, and is not here")
def test_the_files_of_random_trees_are_those_that_ruff_lints(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pick = random.Random(5)
    for number in range(20):
        root = tmp_path / str(number)
        folders = random_tree(root, pick, (".gitignore", ".ignore"))
        for repository in ([root] if number % 3 else []) + (
            [root / folders[2]] if number % 5 == 0 else []
        ):
            (repository / ".git/info").mkdir(parents=True, exist_ok=True)
            (repository / ".git/info/exclude").write_text("/a/ab.*\n")
        monkeypatch.chdir(root)
        for top in (".", folders[0] or "."):
            command = [sys.executable, "-m", "ruff", "check", "--isolated", "--show-files", top]
            shown = subprocess.run(
                command, capture_output=True, text=True, check=True
            ).stdout.splitlines()
            linted = {
                os.path.relpath(line, root).removesuffix(".py")
                for line in shown
                if line.endswith(".py")
            }
            assert {name.removesuffix(".msaa.yaml") for name in files(top)} == linted, (root, top)


def test_time_grows_with_the_number_of_files_and_not_its_square(project: Path) -> None:
    write(
        ".gitignore",
        text="".join(f"/ignored{number}/*.yaml\n*.o{number}\n" for number in range(100)),
    )
    times = []
    for number in range(3):
        for folder in range(20 << number):
            Path(f"f{number}/{folder}").mkdir(parents=True)
            for file in range(50):
                Path(f"f{number}/{folder}/{file}.json").write_text("{}")
        started = time.process_time()
        assert files(f"f{number}") == []
        times.append(time.process_time() - started)
    assert times[2] < 8 * max(times[0], 0.05)

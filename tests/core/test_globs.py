import random
import shutil
import subprocess

import pytest

from msaa_lint.core.globs import MAX_LENGTH, Glob, compiled, excluding, matches, relative

ROOT = "/project"


def excluded(path: str, *patterns: str, folder: bool = False) -> str | None:
    found = excluding(f"{ROOT}/{path}", [Glob(pattern, ROOT) for pattern in patterns], folder)
    return found.pattern if found is not None else None


@pytest.mark.parametrize(
    ("pattern", "inside", "outside"),
    [
        ("build", ["build", "build/a.yaml", "x/build/a/b"], ["builds", "x/abuild"]),
        ("build/", ["build/a", "x/build/a"], ["build", "x/build"]),
        ("/build", ["build/a"], ["x/build/a"]),
        ("gen/*.yaml", ["gen/a.yaml", "gen/.yaml"], ["x/gen/a.yaml", "gen/x/a.yaml"]),
        ("*.gen.*", ["a.gen.yaml", "x/y/.gen."], ["a.gen", "gen.yaml"]),
        ("a/**/b", ["a/b", "a/x/b", "a/x/y/b/c"], ["b", "x/a/b", "a/xb"]),
        ("**/a/b", ["a/b", "x/y/a/b"], ["a/x/b"]),
        ("a/**", ["a/b", "a/b/c"], ["a", "b/a/c"]),
        ("?", ["a", "x/é"], ["ab"]),
        ("[a-c]x", ["ax", "cx"], ["dx", "-x"]),
        ("[!a-c]x", ["dx"], ["ax", "x"]),
        ("a*?", ["ab", "abc"], ["a", "b"]),
        ("a*[bc]d", ["abd", "axcd"], ["ad", "abc", "bad"]),
        ("[a-a]", ["a"], ["b", "-"]),
        ("[a-]x", ["ax", "-x"], ["bx"]),
        ("[]]x", ["]x"], ["[x"]),
        ("[[:digit:]_-]x", ["7x", "_x", "-x"], ["ax", ":x"]),
        ("[![:alpha:]b]x", ["7x"], ["ax", "bx", "Zx"]),
        ("[[:space:]]x", ["\tx", " x"], ["sx"]),
        ("[[:punct:]]x", ["!x", "[x", "~x"], ["ax", " x"]),
        (r"\!a", ["!a"], ["a"]),
        (r"\*", ["*"], ["a"]),
        ("./a", ["a"], ["x/a"]),
        ("**", ["a", "a/b"], []),
    ],
)
def test_globs_match_as_gitignore_does(pattern: str, inside: list[str], outside: list[str]) -> None:
    assert {path: excluded(path, pattern) for path in inside} == dict.fromkeys(inside, pattern)
    assert {path: excluded(path, pattern) for path in outside} == dict.fromkeys(outside)


def test_a_folder_is_one_only_where_it_is_said() -> None:
    assert excluded("build", "build/", folder=True) == "build/"
    assert excluded("build", "build/") is None


def test_a_later_glob_takes_back_but_not_in_an_excluded_folder() -> None:
    assert excluded("a.yaml", "*.yaml", "!a.yaml") is None
    assert excluded("a.yaml", "!a.yaml", "*.yaml") == "*.yaml"
    assert excluded("gen/a.yaml", "gen", "!a.yaml") == "gen"
    assert excluded("gen/a.yaml", "gen/*", "!a.yaml") is None


def test_a_single_glob_with_an_exclamation_mark_matches_the_others() -> None:
    assert matches(f"{ROOT}/a.yaml", Glob("!tests/", ROOT))
    assert not matches(f"{ROOT}/tests/a.yaml", Glob("!tests/", ROOT))
    assert not matches(ROOT, Glob("!tests/", ROOT))
    assert not matches(ROOT, Glob("**", ROOT))


def test_a_file_outside_the_root_counts_from_the_folder_they_share() -> None:
    assert relative("/project/frames/a.yaml", "/project/ci") == "frames/a.yaml"
    assert relative("/project/ci/a.yaml", "/project/ci") == "a.yaml"


@pytest.mark.parametrize(
    ("pattern", "reason"),
    [
        ("", "an empty name"),
        ("/", "an empty name"),
        ("a//b", "an empty name"),
        ("../a", "leaves its folder"),
        ("a/./b", "leaves its folder"),
        ("[a", "without its `]`"),
        ("[!]", "without its `]`"),
        ("[z-a]", "is reversed"),
        ("[[:digits:]]", "unknown character class"),
        ("a\\", "ends in a backslash"),
        ("a" * (MAX_LENGTH + 1), "longer than 256"),
    ],
)
def test_a_glob_that_can_match_nothing_is_refused(pattern: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason.replace("[", r"\[")):
        compiled(pattern)


@pytest.mark.parametrize(
    "pattern",
    [
        "a*" * 127 + "b",
        "*a" * 127 + "*b",
        "**/*a*/" * 30 + "b",
        "[!b]*" * 40 + "b",
        "**/a/" * 50 + "b",
    ],
)
def test_hostile_globs_do_not_backtrack(pattern: str) -> None:
    # A matcher that tries every split of this path would not come back.
    path = "/".join(["a" * 200] * 15)
    assert excluded(path, pattern) is None
    assert excluded(path, pattern, "!zz") is None


@pytest.mark.skipif(shutil.which("git") is None, reason="git is the reference, and is not here")
def test_globs_agree_with_git(tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.mktemp("reference")
    subprocess.run(["git", "init", "-q", str(folder)], check=True)
    pick = random.Random(7)
    names = ["a", "b", "ab", "*", "?", "**", "[ab]", "[!a]", "a*", "*b", "*a*b"]
    for _ in range(60):
        patterns = []
        for _ in range(pick.randint(1, 3)):
            body = "/".join(pick.choice(names) for _ in range(pick.randint(1, 4)))
            patterns.append(
                pick.choice(["", "", "", "!"])
                + pick.choice(["", "", "/"])
                + body
                + pick.choice(["", "", "/"])
            )
        paths = [
            "/".join(
                "".join(pick.choices("ab", k=pick.randint(1, 3))) for _ in range(pick.randint(1, 4))
            )
            for _ in range(40)
        ]
        (folder / ".gitignore").write_text("\n".join(patterns) + "\n")
        command = ["git", "-C", str(folder), "check-ignore", "--no-index", "--stdin"]
        told = subprocess.run(
            command, input="\n".join(paths) + "\n", capture_output=True, text=True, check=False
        ).stdout.split("\n")
        assert {path for path in paths if excluded(path, *patterns)} == set(filter(None, told)), (
            patterns
        )

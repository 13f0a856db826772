"""`msaa-lint check --fix`, `--unsafe-fixes` and `--diff`."""

from __future__ import annotations

import codecs
import json
from pathlib import Path

import pytest

from tests.command import run
from tests.linter.fixes.test_fixer import FIXED, STORED
from tests.linter.fixes.test_properties import EXAMPLES
from tests.pages import all_examples

UNSAFE = STORED.replace(
    "storeOp: STORE}\n    subpasses", "storeOp: DONT_CARE}\n    subpasses"
).replace("LOAD", "DONT_CARE")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "frame.msaa.yaml").write_text(STORED, encoding="utf-8")
    return tmp_path


def text(folder: Path, name: str = "frame.msaa.yaml") -> str:
    return (folder / name).read_bytes().decode()


def test_fix_writes_the_file_and_reports_the_rest(folder: Path) -> None:
    (folder / "frame.msaa.yaml").write_text(
        STORED.replace("samples: 4", "samples: 8"), encoding="utf-8"
    )
    done = run(folder, "check", ".", "--fix")
    assert text(folder) == FIXED.replace("samples: 4", "samples: 8")
    assert [
        line.split("[")[1].split("]")[0] for line in done.stdout.splitlines() if "[" in line
    ] == [
        "sample-count-above-four",
        "sample-count-not-portable",
    ]
    assert done.stderr == "msaa-lint: 3 fixed, 2 remaining\n"
    assert done.returncode == 1
    assert [each.name for each in folder.iterdir()] == ["frame.msaa.yaml"]


def test_exit_code_is_0_if_everything_is_fixed(folder: Path) -> None:
    done = run(folder, "check", ".", "--fix")
    assert (done.returncode, done.stderr) == (0, "msaa-lint: 3 fixed, 0 remaining\n")
    again = run(folder, "check", ".", "--fix")
    assert (again.returncode, again.stderr, text(folder)) == (
        0,
        "msaa-lint: 0 fixed, 0 remaining\n",
        FIXED,
    )


DIFF = """\
--- a/frame.msaa.yaml
+++ b/frame.msaa.yaml
@@ -4,7 +4,7 @@
 renderPasses:
   main:
     attachments:
-      color: {image: ms, loadOp: CLEAR, storeOp: STORE}
-      output: {image: out, loadOp: LOAD, storeOp: STORE}
+      color: {image: ms, loadOp: CLEAR, storeOp: DONT_CARE}
+      output: {image: out, loadOp: DONT_CARE, storeOp: STORE}
     subpasses:
       - {colorAttachments: [color], resolveAttachments: [output]}
"""


def test_diff_prints_and_writes_nothing(folder: Path) -> None:
    done = run(folder, "check", ".", "--diff")
    assert (done.stdout, done.returncode) == (DIFF, 1)
    assert done.stderr == "msaa-lint: 3 would be fixed, 0 remaining\n"
    assert text(folder) == STORED
    assert run(folder, "check", ".", "--diff", "--exit-zero").returncode == 0
    run(folder, "check", ".", "--fix")
    clean = run(folder, "check", ".", "--diff")
    assert (clean.stdout, clean.returncode) == ("", 0)


def test_diff_can_be_applied(folder: Path) -> None:
    import subprocess

    data = STORED.replace("\n", "\r\n").rstrip("\r\n").encode()
    (folder / "frame.msaa.yaml").write_bytes(data)
    done = run(folder, "check", "frame.msaa.yaml", "--diff")
    (folder / "d.patch").write_bytes(done.stdout.encode())
    subprocess.run(["git", "apply", "d.patch"], cwd=folder, check=True)
    assert (folder / "frame.msaa.yaml").read_bytes() == FIXED.replace("\n", "\r\n").rstrip(
        "\r\n"
    ).encode()


def test_diff_in_color(folder: Path) -> None:
    done = run(folder, "check", ".", "--diff", "--color", "always")
    assert (
        "\x1b[32m+      output: {image: out, loadOp: DONT_CARE, storeOp: STORE}\x1b[0m\n"
        in done.stdout
    )


def test_diff_beside_other_outputs(folder: Path) -> None:
    done = run(folder, "check", ".", "--diff", "--output", "json=found.json", "--output", "concise")
    assert done.stdout == DIFF
    assert len(json.loads(text(folder, "found.json"))["findings"]) == 3


def test_unsafe_fixes_need_the_option(folder: Path) -> None:
    (folder / "frame.msaa.yaml").write_text(UNSAFE, encoding="utf-8")
    done = run(folder, "check", ".", "--fix")
    assert done.stderr == "msaa-lint: 2 fixed, 1 remaining, 1 of them fixable with --unsafe-fixes\n"
    assert "storeOp: DONT_CARE}\n    subpasses" in text(folder)
    done = run(folder, "check", ".", "--fix", "--unsafe-fixes")
    assert done.stderr == "msaa-lint: 1 fixed, 0 remaining\n"
    assert text(folder) == FIXED


def test_unsafe_fixes_alone_change_nothing(folder: Path) -> None:
    assert run(folder, "check", ".", "--unsafe-fixes").stdout == run(folder, "check", ".").stdout
    assert text(folder) == STORED


def test_fixed_standard_input_is_printed(folder: Path) -> None:
    done = run(folder, "check", "-", "--fix", stdin=UNSAFE.encode())
    assert done.stdout == UNSAFE.replace("CLEAR, storeOp: STORE", "CLEAR, storeOp: DONT_CARE")
    assert "<stdin>:8:" in done.stderr
    assert "2 fixed, 1 remaining" in done.stderr
    assert done.returncode == 1
    assert run(folder, "check", "-", "--fix", stdin=FIXED.encode()).stdout == FIXED
    assert (
        run(
            folder,
            "check",
            "-",
            "--diff",
            "--stdin-filename",
            "frame.msaa.yaml",
            stdin=STORED.encode(),
        ).stdout
        == DIFF
    )
    broken = run(folder, "check", "-", "--fix", stdin=b"a: [")
    assert (broken.stdout, broken.returncode) == ("a: [", 2)
    assert text(folder) == STORED


@pytest.mark.parametrize(
    ("mark", "encoding"),
    [
        (b"", "utf-8"),
        (codecs.BOM_UTF8, "utf-8"),
        (codecs.BOM_UTF16_LE, "utf-16-le"),
        (codecs.BOM_UTF16_BE, "utf-16-be"),
    ],
)
@pytest.mark.parametrize("ending", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("last", [True, False])
def test_encoding_and_line_breaks_stay(
    folder: Path, mark: bytes, encoding: str, ending: str, last: bool
) -> None:
    def encoded(plain: str) -> bytes:
        return mark + (f"# é ☃ 𝄞\n{plain}" if last else f"# é ☃ 𝄞\n{plain}".rstrip("\n")).replace(
            "\n", ending
        ).encode(encoding)

    (folder / "frame.msaa.yaml").write_bytes(encoded(STORED))
    assert run(folder, "check", ".", "--fix").stderr == "msaa-lint: 3 fixed, 0 remaining\n"
    assert (folder / "frame.msaa.yaml").read_bytes() == encoded(FIXED)


def test_read_only_file_is_reported_and_others_are_fixed(folder: Path) -> None:
    (folder / "other.msaa.yaml").write_text(STORED, encoding="utf-8")
    (folder / "frame.msaa.yaml").chmod(0o444)
    done = run(folder, "check", ".", "--fix")
    assert done.returncode == 2
    assert "cannot write the fixed text: the file is read-only" in done.stdout
    assert (text(folder), text(folder, "other.msaa.yaml")) == (STORED, FIXED)
    assert "frame.msaa.yaml:7:" in done.stdout
    assert done.stderr.startswith("msaa-lint: 3 fixed, 3 remaining")


def test_symbolic_link_stays_a_link(folder: Path) -> None:
    (folder / "deep").mkdir()
    (folder / "frame.msaa.yaml").rename(folder / "deep" / "real.yaml")
    (folder / "frame.msaa.yaml").symlink_to(Path("deep") / "real.yaml")
    run(folder, "check", "frame.msaa.yaml", "--fix")
    assert (folder / "frame.msaa.yaml").is_symlink()
    assert text(folder, "deep/real.yaml") == FIXED


def test_hidden_findings_are_not_fixed(folder: Path) -> None:
    for arguments in (["--ignore", "MSAA2", "--ignore", "MSAA4"], ["--min-severity", "error"]):
        run(folder, "check", ".", "--fix", *arguments)
        assert text(folder) == STORED


def test_findings_of_the_baseline_are_fixed(folder: Path) -> None:
    """A baseline accepts findings for now; whoever asks for fixes gets these as well."""
    run(folder, "baseline", ".")
    (summary, fixable) = run(
        folder, "check", ".", "--baseline", "msaa-lint-baseline.json"
    ).stdout.splitlines()[:2]
    assert summary.startswith("No findings in 1 file") and "3 suppressed" in summary
    assert fixable == "3 fixable with --fix"
    done = run(folder, "check", ".", "--fix", "--baseline", "msaa-lint-baseline.json")
    assert done.returncode == 0 and text(folder) != STORED
    assert "the baseline counts 1 of " in done.stderr
    assert run(folder, "check", ".").stdout.startswith("No findings in 1 file")


def test_reason_of_a_failed_fix_is_reported(folder: Path) -> None:
    color = "{image: ms, loadOp: CLEAR, storeOp: STORE}"
    shared = STORED.replace(
        color, f"&c {color}\n      normals: {{<<: *c, # as it is\n        image: kept}}"
    )
    shared = shared.replace(
        "images:\n",
        "images:\n  kept: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, "
        "SAMPLED]}\n",
    )
    shared = shared.replace("[color]", "[color, normals]").replace("[output]", "[output, null]")
    (folder / "frame.msaa.yaml").write_text(shared, encoding="utf-8")
    done = run(folder, "check", ".", "--fix")
    reason = (
        "frame.msaa.yaml:8: multisampled-attachment-stored is not fixed: an anchor shares "
        "this `storeOp` with other structures"
    )
    assert reason in done.stderr


def test_json_has_the_edits(folder: Path) -> None:
    findings = json.loads(run(folder, "check", ".", "--output", "json").stdout)["findings"]
    assert [found["fixable"] for found in findings] == [True] * 3
    sarif = json.loads(run(folder, "check", ".", "--output", "sarif").stdout)
    replaced = sarif["runs"][0]["results"][0]["fixes"][0]["artifactChanges"][0]["replacements"][0]
    assert replaced["insertedContent"]["text"] == "DONT_CARE"
    assert (replaced["deletedRegion"]["startLine"], replaced["deletedRegion"]["startColumn"]) == (
        7,
        50,
    )


@pytest.mark.parametrize("unsafe", [[], ["--unsafe-fixes"]])
def test_all_examples_in_one_run(tmp_path: Path, unsafe: list[str]) -> None:
    """Fixing leaves fewer findings and adds none, and fixing again changes nothing."""
    for number, example in enumerate(each for each in all_examples() if each.kind == "bad"):
        (tmp_path / f"{number:03}-{example.rule}.msaa.yaml").write_text(
            example.text, encoding="utf-8"
        )
    for path in EXAMPLES:
        (tmp_path / f"{path.parent.name}-{path.name}").write_bytes(path.read_bytes())

    def found() -> dict[tuple[str, str], int]:
        counts: dict[tuple[str, str], int] = {}
        for each in json.loads(run(tmp_path, "check", ".", "--output", "json").stdout)["findings"]:
            key = (each["file"], each["rule"])
            counts[key] = counts.get(key, 0) + 1
        return counts

    before = found()
    done = run(tmp_path, "check", ".", "--fix", *unsafe)
    after = found()
    assert set(after) <= set(before)
    assert all(count <= before[key] for key, count in after.items())
    fixed = int(done.stderr.split()[1])
    assert fixed >= (60 if unsafe else 25)
    assert sum(before.values()) - sum(after.values()) >= fixed
    texts = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    again = run(tmp_path, "check", ".", "--fix", *unsafe)
    assert again.stderr.startswith("msaa-lint: 0 fixed, ")
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == texts

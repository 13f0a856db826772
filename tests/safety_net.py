"""What the commands print for inputs that stay the same, stored, and compared with what another
commit prints.

`python tests/safety_net.py store FOLDER` writes a file for each command and input: the output of
check (in every format, for several devices, and what fixes change), cost, convert, facts, rule, and
schema, for the examples, the examples of the rule pages, and tests/data.

`python tests/safety_net.py against COMMIT` runs a commit and the working tree on the inputs of that
commit, prints each difference as a diff, and exits with 1 if there is one. JSON is compared value
by value, in the order of its keys.
"""

from __future__ import annotations

import argparse
import contextlib
import difflib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

CHECK_FORMATS = (
    "full", "concise", "json", "sarif", "github", "gitlab", "azure", "teamcity", "rdjson", "junit",
    "markdown", "html",
)  # fmt: skip
COST_FORMATS = ("full", "json", "markdown", "html")
PROFILES = ("mali-g76", "adreno-650", "nvidia", "apple")
SCHEMAS = ("description", "json-v1", "cost-v1", "confirm-v1", "study-v1", "corpus-v1")
_EXAMPLE = re.compile(r"^```(\w+) (bad|fixed|good)\b[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_ENDINGS = {"yaml": "msaa.yaml", "json": "msaa.json"}

Commands = dict[str, list[str]]
"""By the name of the file that stores its output: the arguments of a command."""


def write_inputs(tree: Path, folder: Path) -> None:
    """Writes the inputs that a tree has: its examples, tests/data, and a file for each example of a
    rule page.
    """
    shutil.copytree(tree / "examples", folder / "examples")
    shutil.copytree(tree / "tests" / "data", folder / "data")
    (folder / "rules").mkdir()
    for page in sorted((tree / "rules").glob("*.md")):
        for number, match in enumerate(_EXAMPLE.finditer(page.read_text(encoding="utf-8"))):
            language, kind, text = match.groups()
            name = f"{page.stem}-{number}-{kind}.{_ENDINGS.get(language, language)}"
            (folder / "rules" / name).write_text(text, encoding="utf-8")


def commands(tree: Path, inputs: Path) -> Commands:
    """The commands to run in the folder of inputs."""
    found: Commands = {
        f"check/{format}": ["check", ".", "--output", format] for format in CHECK_FORMATS
    }
    found |= {
        f"check/profile-{name}": ["check", ".", "--profile", name, "--output", "json"]
        for name in PROFILES
    }
    found["check/statistics"] = ["check", ".", "--statistics"]
    found["check/explain-undecided"] = ["check", ".", "--explain-undecided"]
    found["check/fail-on-cost"] = ["check", ".", "--fail-on-cost", "50MB/s", "--output", "concise"]
    found["check/safe-fixes.diff"] = ["check", ".", "--diff"]
    found["check/unsafe-fixes.diff"] = ["check", ".", "--diff", "--unsafe-fixes"]
    found |= {f"cost/{format}": ["cost", ".", "--output", format] for format in COST_FORMATS}
    found |= {
        f"cost/profile-{name}": ["cost", ".", "--profile", name, "--output", "json"]
        for name in PROFILES
    }
    found |= {
        f"rule/{format}": ["rule", "--all", "--output", format]
        for format in ("text", "markdown", "json")
    }
    pages = sorted(page.stem for page in (tree / "rules").glob("*.md") if page.name != "README.md")
    found |= {f"rule/{name}.txt": ["rule", name] for name in pages}
    found |= {f"schema/{name}": ["schema", name] for name in SCHEMAS}
    found |= {
        f"facts/{format}": ["facts", "--output", format] for format in ("text", "json", "markdown")
    }
    for path in sorted(inputs.rglob("*")):
        name = path.relative_to(inputs).as_posix()
        if path.suffix in (".yaml", ".yml", ".json"):
            found[f"facts/{name}"] = ["facts", name, "--output", "json"]
        elif path.suffix in (".c", ".cpp", ".swift", ".glsl", ".frag", ".jsonl", ".xml"):
            found[f"convert/{name}"] = ["convert", name]
    return found


def run_all(tree: Path, inputs: Path, out: Path) -> subprocess.Popen[bytes]:
    """Starts a process that runs the commands by the package of a tree and stores what they
    print.
    """
    environment = {
        **{name: os.environ[name] for name in ("PATH", "HOME") if name in os.environ},
        "PYTHONPATH": str(tree),
        "XDG_CACHE_HOME": tempfile.mkdtemp(dir=out.parent),
        "COLUMNS": "100",
    }
    arguments = [sys.executable, str(Path(__file__).resolve()), "run", str(out)]
    process = subprocess.Popen(arguments, cwd=inputs, env=environment, stdin=subprocess.PIPE)
    assert process.stdin is not None
    process.stdin.write(json.dumps(commands(tree, inputs)).encode())
    process.stdin.close()
    return process


def run(out: Path) -> None:
    """Runs the commands that standard input names, in this process, and stores what each prints and
    its exit code.
    """
    from msaa_lint.__main__ import main

    for name, arguments in json.load(sys.stdin).items():
        stored = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
        errors = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
        sys.argv = ["msaa-lint", *arguments]
        code: object = 0
        with contextlib.redirect_stdout(stored), contextlib.redirect_stderr(errors):
            try:
                main()
            except SystemExit as ended:
                code = ended.code
            stored.flush()
            errors.flush()
        file = out / name
        file.parent.mkdir(parents=True, exist_ok=True)
        text = _comparable(stored.buffer.getvalue().decode())
        messages = errors.buffer.getvalue().decode()
        both = f"{text}\nexit code {code}\n{messages}".replace(os.getcwd(), "INPUTS")
        file.write_text(both, encoding="utf-8")


def _comparable(text: str) -> str:
    """JSON with a line for each value; any other text as it is."""
    if not text.startswith(("{", "[")):
        return text
    try:
        return json.dumps(json.loads(text), indent=1, ensure_ascii=False)
    except ValueError:
        return text


def store(tree: Path, inputs_of: Path, folder: Path) -> subprocess.Popen[bytes]:
    """Starts to store in a folder what the package of a tree prints for the inputs of a tree."""
    inputs, out = folder / "inputs", folder / "outputs"
    inputs.mkdir(parents=True)
    write_inputs(inputs_of, inputs)
    # The configuration of a folder above must not apply.
    (inputs / "msaa-lint.toml").touch()
    return run_all(tree, inputs, out)


def differences(before: Path, after: Path) -> list[str]:
    """The lines of a diff between the outputs in two folders."""
    found: list[str] = []
    names = sorted(
        {
            path.relative_to(folder).as_posix()
            for folder in (before, after)
            for path in folder.rglob("*")
            if path.is_file()
        }
    )
    for name in names:
        texts = [
            (folder / name).read_text(encoding="utf-8") if (folder / name).exists() else ""
            for folder in (before, after)
        ]
        if texts[0] != texts[1]:
            first, second = (text.splitlines() for text in texts)
            found += difflib.unified_diff(
                first, second, f"before/{name}", f"after/{name}", n=2, lineterm=""
            )
    return found


def against(commit: str) -> int:
    """Prints what the working tree prints otherwise than a commit; returns 1 if it does."""
    with tempfile.TemporaryDirectory() as folder:
        base = Path(folder, "tree")
        base.mkdir()
        archive = subprocess.run(
            ["git", "archive", commit], cwd=ROOT, capture_output=True, check=True
        )
        subprocess.run(["tar", "-x", "-C", str(base)], input=archive.stdout, check=True)
        sides = [
            store(tree, base, Path(folder, name))
            for name, tree in (("before", base), ("after", ROOT))
        ]
        codes = [side.wait() for side in sides]
        if any(codes):
            return 2
        found = differences(Path(folder, "before", "outputs"), Path(folder, "after", "outputs"))
    print("\n".join(found) if found else f"no output differs from {commit}")
    return 1 if found else 0


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    actions = parser.add_subparsers(dest="action", required=True)
    actions.add_parser("store").add_argument("folder", type=Path)
    actions.add_parser("against").add_argument("commit")
    actions.add_parser("run").add_argument("folder", type=Path)
    given = parser.parse_args()
    if given.action == "run":
        run(given.folder)
        return 0
    return (
        store(ROOT, ROOT, given.folder.resolve()).wait()
        if given.action == "store"
        else against(given.commit)
    )


if __name__ == "__main__":
    sys.exit(main())

"""What a run of `check` loads, and who knows whom.

Python starts in 15 ms and pydantic alone takes 70: what a start costs is what it imports. The clock
says little on a shared machine, so this looks at the imports themselves; tests/benchmarks has the
clock.
"""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

import pytest

from tests.descriptions import CLEAN, STORED
from tests.paths import ROOT

PACKAGE = ROOT / "msaa_lint"

HEAVY = frozenset({
    "annotated_types", "asyncio", "click", "concurrent", "dataclasses", "duckdb", "email",
    "hashlib", "html", "http", "importlib.metadata",
    "importlib.resources", "inspect", "jsonschema", "logging", "multiprocessing", "numpy",
    "pathlib", "pathspec", "pyarrow", "pydantic",
    "pydantic_core", "rich", "shellingham", "socket", "sqlite3", "ssl", "subprocess", "tempfile",
    "tomllib", "tree_sitter",
    "tree_sitter_c", "tree_sitter_cpp", "tree_sitter_glsl", "tree_sitter_swift", "typer",
    "unicodedata", "urllib", "vulkan", "xml",
    "msaa_lint.cli.app", "msaa_lint.frame.description.pydantic_models",
    "msaa_lint.frame.description.reference",
    "msaa_lint.frame.facts.metal", "msaa_lint.frame.metal", "msaa_lint.frame.spirv",
    "msaa_lint.input.code", "msaa_lint.input.compression", "msaa_lint.input.converters",
    "msaa_lint.input.impeller", "msaa_lint.input.readers.metal",
    "msaa_lint.input.shader_modules", "msaa_lint.input.source_file",
    "msaa_lint.linter.settings.config_keys",
    "msaa_lint.linter.settings.toml_text", "msaa_lint.linter.suppress.baseline",
})  # fmt: skip
"""Nothing of this, nor anything below it, on the way of a run without a configuration file,
whatever it finds.
"""

NEAREST = frozenset({"difflib"})
"""Only to say what was meant by a misspelt word."""

WRITING = frozenset({"json"})
"""Only for the outputs that need it."""

MISSPELT = CLEAN.replace("storeOp: DONT_CARE", "storeOp: DONT_CAER")


def imported(
    folder: Path, text: str, *arguments: str
) -> tuple[subprocess.CompletedProcess[str], frozenset[str]]:
    """A run of `check` on a description, and every module that it imported."""
    (folder / "one.msaa.yaml").write_text(text)
    environment = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("MSAA_LINT_", "COVERAGE", "COV_CORE"))
    }
    environment["PYTHONPATH"] = str(ROOT)
    command = [
        sys.executable,
        "-X",
        "importtime",
        "-m",
        "msaa_lint",
        "check",
        *arguments,
        "one.msaa.yaml",
    ]
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    found = frozenset(re.findall(r"^import time:.*\|\s*([\w.]+)\s*$", done.stderr, re.MULTILINE))
    assert {"msaa_lint.linter.run", "msaa_lint.core.text.tree", "yaml"} <= found, done.stderr
    return done, found


def below(found: frozenset[str], names: frozenset[str]) -> list[str]:
    """Those of the modules that are one of the names, or within one."""
    return sorted(
        module
        for module in found
        if any(module == name or module.startswith(f"{name}.") for name in names)
    )


@pytest.mark.parametrize("output", ["concise", "full"])
def test_clean_run_loads_nothing_heavy(tmp_path: Path, output: str) -> None:
    done, found = imported(tmp_path, CLEAN, "--output", output)
    assert done.returncode == 0, done.stdout
    assert below(found, HEAVY | NEAREST | WRITING) == []


@pytest.mark.parametrize("output", ["concise", "full"])
def test_run_with_findings_loads_nothing_heavy(tmp_path: Path, output: str) -> None:
    done, found = imported(tmp_path, STORED, "--output", output)
    assert done.returncode == 1
    assert "multisampled-attachment-stored" in done.stdout
    assert below(found, HEAVY | NEAREST | WRITING) == []


@pytest.mark.parametrize(("text", "code"), [(CLEAN, 0), (STORED, 1)])
def test_json_output_loads_nothing_heavy(tmp_path: Path, text: str, code: int) -> None:
    done, found = imported(tmp_path, text, "--output", "json")
    assert done.returncode == code
    assert '"msaa-lint/json-v1"' in done.stdout
    assert "json" in found
    assert below(found, (HEAVY | NEAREST)) == []


def test_misspelt_word_loads_difflib_and_nothing_else(tmp_path: Path) -> None:
    done, found = imported(tmp_path, MISSPELT, "--output", "full")
    assert done.returncode == 2
    assert "did you mean `DONT_CARE`?" in done.stdout
    assert "difflib" in found
    assert below(found, HEAVY | WRITING) == []


def test_source_code_that_is_passed_over_loads_no_grammar(tmp_path: Path) -> None:
    (tmp_path / "other.cpp").write_text("int main() {}\n")
    done, found = imported(tmp_path, CLEAN, ".")
    assert done.returncode == 0, done.stdout
    assert "msaa_lint.input.code.mentions" in found
    light = {
        f"msaa_lint.input.code{module}"
        for module in ("", ".languages", ".mentions", ".project", ".project.index")
    }
    assert below(found - light, HEAVY | NEAREST | WRITING) == []


def test_version_loads_nothing_of_ours(tmp_path: Path) -> None:
    command = [sys.executable, "-X", "importtime", "-m", "msaa_lint", "--version"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    found = re.findall(r"\|\s*(msaa_lint[\w.]*)\s*$", done.stderr, re.MULTILINE)
    assert done.stdout.startswith("msaa-lint ")
    assert set(found) == {"msaa_lint", "msaa_lint.core", "msaa_lint.core.package"}


ROOMS = ("core", "frame", "input", "linter", "experiments", "cli")
"""From the ground up: each imports only those before it."""

MAX_ENTRIES = 8
"""At the top of the package: the rooms, `__init__` and `__main__`."""

MAX_LEVELS = 9

MODULES = {
    ".".join(path.relative_to(PACKAGE).with_suffix("").parts): path
    for path in sorted(PACKAGE.rglob("*.py"))
}
"""By name below the package, `report.full` or `report.__init__`."""

ONLY_IN = {
    "pydantic": {"frame.description.pydantic_models"},
    "typer": {"cli.app"},
    "yaml": {"core.text"},
    "cel_expr_python": {"linter.rules.condition"},
    "orjson": {
        "input.captures.json_stream",
        "input.code.project",
        "input.readers.fossilize_objects",
    },
    "vulkan": {"experiments.confirm.binding"},
    "tree_sitter": {"input.code"},
    "backports": {"core.zstd"},
    "altair": {"cli.report"},
    "duckdb": {"linter.corpus.database"},
    "pyarrow": {"linter.corpus", "cli.report.check_parquet"},
    "vl_convert": {"cli.report.figure"},
    "numpy": {"experiments.study", "experiments.confirm.mesh_buffers"},
}
"""Packages of others, and the modules or rooms that may import them."""


def module_of(name: str) -> str | None:
    """The module that a dotted name below the package is."""
    package = f"{name}.__init__" if name else "__init__"
    return name if name in MODULES else package if package in MODULES else None


@cache
def imports(module: str) -> frozenset[str]:
    """What a module imports, anywhere in it: modules of ours with a dot in front, packages of
    others by their first name.
    """
    return frozenset(_imports(module))


def _imports(module: str) -> Iterator[str]:
    folder = module.split(".")[:-1]
    for node in ast.walk(ast.parse(MODULES[module].read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            for alias in node.names:
                own = alias.name.startswith("msaa_lint")
                yield (
                    f".{module_of(alias.name.partition('.')[2])}"
                    if own
                    else alias.name.split(".")[0]
                )
        elif isinstance(node, ast.ImportFrom):
            if not node.level and not (node.module or "").startswith("msaa_lint"):
                yield (node.module or "").split(".")[0]
                continue
            parts = (
                [*folder[: len(folder) - node.level + 1], *(node.module or "").split(".")]
                if node.level
                else (node.module or "").split(".")[1:]
            )
            base = ".".join(part for part in parts if part)
            for alias in node.names:
                found = module_of(f"{base}.{alias.name}" if base else alias.name) or module_of(base)
                assert found is not None, f"{module} imports {base} {alias.name}"
                yield f".{found}"


@cache
def arrows() -> frozenset[tuple[str, str]]:
    """Which module imports which."""
    return frozenset(
        (module, name[1:])
        for module in MODULES
        for name in imports(module)
        if name.startswith(".") and name[1:] != module
    )


def circles(targets_of: Mapping[str, set[str]]) -> set[str]:
    """Those that can be reached from themselves."""
    left = {name: set(targets) for name, targets in targets_of.items()}
    while free := {name for name, targets in left.items() if not targets & left.keys()}:
        left = {name: targets for name, targets in left.items() if name not in free}
    # What is left imports a circle or is on one.
    while free := {name for name in left if not any(name in targets for targets in left.values())}:
        left = {name: targets for name, targets in left.items() if name not in free}
    return set(left)


def within(folder: str) -> dict[str, set[str]]:
    """The arrows between the entries of a folder, a subfolder being one entry; `` is the package
    itself.
    """
    depth = len(folder.split(".")) if folder else 0
    found: dict[str, set[str]] = {}
    for source, target in arrows():
        ends = [source.split("."), target.split(".")]
        if all(not folder or end[:depth] == folder.split(".") for end in ends):
            a, b = (end[depth] for end in ends)
            if a != b:
                found.setdefault(a, set()).add(b)
    return found


def test_imports_are_found() -> None:
    assert {".core.finding", ".cli.report.escape", "__future__"} <= imports("cli.report.full")
    assert ".linter.run" in imports("__init__"), "within a function"


def test_the_top_is_easy_to_take_in() -> None:
    entries = {path.name for path in PACKAGE.iterdir() if path.name != "__pycache__"}
    assert entries == {*ROOMS, "__init__.py", "__main__.py"}
    assert len(entries) <= MAX_ENTRIES


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_imports_only_rooms_below_it(room: str) -> None:
    below = {*ROOMS[: ROOMS.index(room) + 1]}
    assert {
        arrow
        for arrow in arrows()
        if arrow[0].split(".")[0] == room and arrow[1].split(".")[0] not in below
    } == set()


def test_no_module_is_in_a_circle() -> None:
    targets: dict[str, set[str]] = {}
    for source, target in arrows():
        targets.setdefault(source, set()).add(target)
    assert circles(targets) == set()


@pytest.mark.parametrize("folder", sorted({name.rpartition(".")[0] for name in MODULES}))
def test_no_folder_has_a_circle(folder: str) -> None:
    assert circles(within(folder)) == set()


def test_rooms_are_few_levels_deep() -> None:
    targets = within("")
    levels: dict[str, int] = {}

    def level(name: str) -> int:
        if name not in levels:
            levels[name] = 1 + max(map(level, targets.get(name, ())), default=0)
        return levels[name]

    assert max(map(level, targets)) <= MAX_LEVELS


@pytest.mark.parametrize("package", ONLY_IN)
def test_a_package_is_known_in_one_place(package: str) -> None:
    knowing = {module for module in MODULES if package in imports(module)}
    assert {
        module
        for module in knowing
        if not any(f"{module}.".startswith(f"{place}.") for place in ONLY_IN[package])
    } == set()
    assert knowing

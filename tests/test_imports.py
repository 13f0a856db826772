"""What a run of `check` loads, and who knows whom.

Python starts in 15 ms and pydantic alone takes 70: what a start costs is what it imports. The clock says little on a shared machine, so
this looks at the imports themselves; tests/benchmarks has the clock.
"""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "msaa_lint"

HEAVY = frozenset({
    "annotated_types", "asyncio", "click", "concurrent", "dataclasses", "email", "hashlib", "html", "http", "importlib.metadata",
    "importlib.resources", "inspect", "jsonschema", "logging", "multiprocessing", "numpy", "pathlib", "pathspec", "pydantic",
    "pydantic_core", "rich", "shellingham", "socket", "sqlite3", "ssl", "subprocess", "tempfile", "tomllib", "tree_sitter",
    "tree_sitter_c", "tree_sitter_cpp", "tree_sitter_glsl", "tree_sitter_swift", "typer", "unicodedata", "urllib", "vulkan", "xml",
    "msaa_lint.baseline", "msaa_lint.cli.app", "msaa_lint.config_keys", "msaa_lint.document.fields", "msaa_lint.document.generate",
    "msaa_lint.document.models", "msaa_lint.facts.metal", "msaa_lint.impeller", "msaa_lint.metal", "msaa_lint.readers.metal",
    "msaa_lint.modules", "msaa_lint.programmed", "msaa_lint.programs", "msaa_lint.spirv",
    "msaa_lint.toml_text", "msaa_lint.vulkan.generate",
})  # fmt: skip
"""Nothing of this, nor anything below it, on the way of a run without a configuration file, whatever it finds."""

NEAREST = frozenset({"difflib"})
"""Only to say what was meant by a misspelt word."""

WRITING = frozenset({"json"})
"""Only for the outputs that need it."""

CLEAN = """\
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [DEVICE_LOCAL, LAZILY_ALLOCATED]}
  color: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED], memory: [DEVICE_LOCAL]}
renderPasses:
  forward:
    attachments:
      color_ms: {image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      color: {image: color, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}
    subpasses:
      - {colorAttachments: [color_ms], resolveAttachments: [color]}
"""
STORED = CLEAN.replace("loadOp: CLEAR, storeOp: DONT_CARE", "loadOp: CLEAR, storeOp: STORE")
MISSPELT = CLEAN.replace("storeOp: DONT_CARE", "storeOp: DONT_CAER")


def imported(folder: Path, text: str, *arguments: str) -> tuple[subprocess.CompletedProcess[str], frozenset[str]]:
    """A run of `check` on a description, and every module that it imported."""
    (folder / "one.msaa.yaml").write_text(text)
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("MSAA_LINT_", "COVERAGE", "COV_CORE"))}
    environment["PYTHONPATH"] = str(ROOT)
    command = [sys.executable, "-X", "importtime", "-m", "msaa_lint", "check", *arguments, "one.msaa.yaml"]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    found = frozenset(re.findall(r"^import time:.*\|\s*([\w.]+)\s*$", done.stderr, re.MULTILINE))
    assert {"msaa_lint.run", "msaa_lint.source.tree", "yaml"} <= found, done.stderr
    return done, found


def below(found: frozenset[str], names: frozenset[str]) -> list[str]:
    """Those of the modules that are one of the names, or within one."""
    return sorted(module for module in found if any(module == name or module.startswith(f"{name}.") for name in names))


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
    assert "msaa_lint.programs.mentions" in found
    light = {"msaa_lint.programs", "msaa_lint.programs.mentions"}
    assert below(found - light, HEAVY | NEAREST | WRITING) == []


def test_version_loads_nothing_of_ours(tmp_path: Path) -> None:
    command = [sys.executable, "-X", "importtime", "-m", "msaa_lint", "--version"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    found = re.findall(r"\|\s*(msaa_lint[\w.]*)\s*$", done.stderr, re.MULTILINE)
    assert done.stdout.startswith("msaa-lint ")
    assert found == ["msaa_lint"]


MODULES = sorted(PACKAGE.rglob("*.py"))


def name_of(path: Path) -> str:
    """`report.full` of msaa_lint/report/full.py; a package goes by its folder."""
    return ".".join(path.relative_to(PACKAGE).with_suffix("").parts).removesuffix(".__init__")


MAY_IMPORT = {
    "source": {"source", "finding"},
    "finding": {"source"},
    "vulkan": {"vulkan"},
    "devices": {"devices", "vulkan"},
    "spirv": {"spirv"},
    "metal": {"metal", "devices", "vulkan"},
    "document": {"document", "finding", "metal", "source", "vulkan"},
    "captures": {"captures", "devices", "document", "source", "vulkan"},
    "impeller": {"impeller", "devices", "document", "finding", "source"},
    "readers": {"readers", "captures", "devices", "document", "finding", "impeller", "metal", "source", "vulkan"},
    "programs": {"programs", "document", "finding", "readers", "source", "spirv", "vulkan"},
    "facts": {"facts", "devices", "document", "finding", "metal", "spirv", "vulkan"},
    "cost": {"cost", "devices", "document", "facts", "finding", "vulkan"},
    "confirm": {
        "confirm", "condition", "cost", "devices", "diagnostics", "discovery", "document", "engine", "facts", "finding", "fixes",
        "inputs", "profiles", "programmed", "readers", "run", "source", "spirv", "vulkan",
    },
    "study": {
        "__version__", "study", "confirm", "cost", "devices", "document", "facts", "finding", "readers", "source", "studied", "vulkan",
    },
    "report": {"report", "confirm", "cost", "finding", "source", "study"},
}  # fmt: skip
"""The arrows of CONTRIBUTING.md: a part, and all of ours that it may know."""

ONLY_IN = {
    "pydantic": {"document.metal_models", "document.models", "document.struct", "document.fields", "document.generate", "cli.schema"},
    "typer": {"cli.app"},
    "yaml": {"source.comments", "source.events", "source.pure", "source.tree"},
    "cel_expr_python": {"condition"},
    "vulkan_object": {"vulkan.generate"},
    "orjson": {"captures.json_stream", "readers.fossilize_objects"},
    "vulkan": {"confirm.binding"},
    "tree_sitter": {name_of(path) for path in MODULES if name_of(path).startswith("programs.")},
}
"""Packages of others, and the modules that may import them."""


def imports(path: Path) -> Iterator[str]:
    """What a module imports anywhere in it, whole names; of ours without `msaa_lint`, with a dot in front."""
    folder = ["", *path.relative_to(PACKAGE).parent.parts]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.name.replace("msaa_lint.", ".", 1) if alias.name.startswith("msaa_lint.") else alias.name
        elif isinstance(node, ast.ImportFrom):
            base = ".".join(folder[: len(folder) - node.level + 1]) if node.level else ""
            module = f"{base}.{node.module}" if node.level and node.module else node.module or base
            module = "." + module.removeprefix("msaa_lint.") if module.startswith("msaa_lint.") else module
            if module in ("", "msaa_lint"):
                yield from (f".{alias.name}" for alias in node.names)
            else:
                yield module


def test_reads_imports_of_every_form() -> None:
    assert {".finding", ".report.escape", "__future__"} <= set(imports(PACKAGE / "report" / "full.py"))
    assert ".run" in set(imports(PACKAGE / "__init__.py"))
    assert ".baseline" in set(imports(PACKAGE / "run.py")), "`from . import baseline`, within a function"


@pytest.mark.parametrize("part", MAY_IMPORT)
def test_a_part_knows_only_what_comes_before_it(part: str) -> None:
    modules = [path for path in MODULES if name_of(path).split(".")[0] == part]
    assert modules
    found = {f"{name_of(path)}: {name}" for path in modules for name in imports(path) if name.startswith(".")}
    assert {line for line in found if line.split(": .")[1].split(".")[0] not in MAY_IMPORT[part]} == set()


def test_only_the_commands_know_the_command_line() -> None:
    knowing = {name_of(path) for path in MODULES if any(name == ".cli" or name.startswith(".cli.") for name in imports(path))}
    assert {name for name in knowing if name != "__main__" and not name.startswith("cli.")} == set()


@pytest.mark.parametrize("package", ONLY_IN)
def test_a_package_is_known_in_one_place(package: str) -> None:
    knowing = {name_of(path) for path in MODULES if any(name.split(".")[0] == package for name in imports(path))}
    assert knowing <= ONLY_IN[package]
    assert knowing

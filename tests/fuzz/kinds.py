"""The kinds of input that are fuzzed: where they start from, and the commands that read them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import NamedTuple

from tests.input.readers.dialects_binary import renderdoc

from . import corpus
from .corpus import FRAME, STUDIED, STUDY, files, pages, samples

MAX_SEED = 120_000
"""Larger files are cut at a line: most of what a long file has is in its first part, too."""

_OUTPUTS = (
    "json",
    "json",
    "sarif",
    "full",
    "concise",
    "gitlab",
    "junit",
    "github",
    "markdown",
    "azure",
    "teamcity",
    "rdjson",
)
CHECKS = tuple(("check", "--output", form) for form in _OUTPUTS)
READS = (
    *CHECKS,
    ("check", "--diff"),
    ("check", "--diff", "--unsafe-fixes"),
    ("check", "--explain-undecided", "--show-suppressed", "--output", "json"),
    ("check", "--statistics"),
    ("cost", "--output", "json"),
    ("cost",),
    ("facts", "--output", "json"),
    ("facts", "--profile", "mali-g76"),
)
CAPTURES = (*READS, ("convert",))

PROJECTS = (
    ("check", "--no-cache", "--output", "json"),
    ("check", "--no-cache", "--output", "full"),
    ("facts",),
    ("convert",),
)
COMMANDS = b"""[
 {"directory": ".", "file": "frame.cpp", "command": "c++ -DSAMPLES=4 -D 'A(x)=x' -c frame.cpp", "output": "CMakeFiles/app.dir/frame.cpp.o"},
 {"directory": "/", "file": "../frame.cpp", "arguments": ["c++", "-DB", "-c", "frame.cpp"]}
]
"""


class Kind(NamedTuple):
    """A kind of input. `seeds` returns the contents of the file `name`, which is mutated; `files`
    lie beside it.

    `commands` are command lines without their last argument: `input`, or the file that is mutated.
    `languages` and `tree` are those of a `Mutator`.
    """

    name: str
    seeds: Callable[[], Iterable[bytes]]
    commands: tuple[tuple[str, ...], ...]
    languages: tuple[str, ...]
    tree: str = ""
    files: Mapping[str, bytes] = MappingProxyType({})
    input: str = ""


def seeds(kind: Kind) -> list[bytes]:
    """The inputs of a kind, without duplicates, in a fixed order, none too large."""
    cut = (
        seed
        if len(seed) <= MAX_SEED
        else seed[: seed.rfind(b"\n", 0, MAX_SEED) + 1] or seed[:MAX_SEED]
        for seed in kind.seeds()
    )
    found = list(dict.fromkeys(cut))
    assert found, f"{kind.name}: no seeds"
    return found


def _source(name: str, language: str, *patterns: str) -> Kind:
    return Kind(name, lambda: [*files(*patterns), *pages(language)], CAPTURES, ("code", "comment"))


KINDS = {
    "yaml": Kind(
        "frame.msaa.yaml", corpus.descriptions, READS, ("yaml", "yaml", "comment"), "yaml"
    ),
    "json": Kind("frame.msaa.json", corpus.json_descriptions, READS, ("json",), "json"),
    "metal": Kind("frame.msaa.yaml", corpus.metal, READS, ("yaml",), "yaml"),
    "impeller": Kind(
        "frame.msaa.yaml",
        lambda: files(
            "examples/impeller/*.yaml", "tests/data/render_targets*", "tests/data/wrong/impeller/*"
        ),
        CAPTURES,
        ("yaml",),
        "yaml",
    ),
    "vulkan-sc": Kind(
        "pipeline.json",
        lambda: [
            *files("tests/data/vulkan_sc*", "tests/data/wrong/vulkan-sc/*"),
            *samples("vulkan_sc/*/*.json"),
        ],
        CAPTURES,
        ("json",),
        "json",
    ),
    "gfxreconstruct": Kind("capture.jsonl", corpus.gfxreconstruct, CAPTURES, ("json",), "jsonl"),
    "api-dump": Kind("capture.json", corpus.api_dump, CAPTURES, ("json",), "json"),
    "renderdoc": Kind("capture.xml", corpus.renderdoc_captures, CAPTURES, ("xml",)),
    "renderdoc-zip": Kind(
        "capture.zip",
        corpus.zip,
        CHECKS,
        ("binary",),
        files={"capture.zip.xml": renderdoc(corpus.shader_program().calls).text()},
        input="capture.zip.xml",
    ),
    "compressed": Kind("capture", corpus.compressed, CAPTURES, ("binary",)),
    "fossilize": Kind("capture.foz", corpus.fossilize_databases, CAPTURES, ("binary",)),
    "c": _source("frame.c", "c", "tests/input/code/corpus/*.c", "examples/capture/*.c"),
    "cpp": _source("frame.cpp", "cpp", "tests/input/code/corpus/*.cpp", "examples/code/*.cpp"),
    "project": Kind(
        "frame.h",
        lambda: files("tests/input/code/corpus/*/*.h", "tests/input/code/corpus/*/*.cpp"),
        PROJECTS,
        ("code", "comment"),
        files={
            "frame.cpp": b'#include "frame.h"\n'
            + next(iter(files("tests/input/code/corpus/class_over_files/pass.cpp")))
        },
        input=".",
    ),
    "compile-commands": Kind(
        "compile_commands.json",
        lambda: [COMMANDS],
        PROJECTS[:1],
        ("json",),
        files={"frame.cpp": next(iter(files("tests/input/code/corpus/class_over_files/pass.cpp")))},
        input=".",
    ),
    "swift": _source("frame.swift", "swift", "tests/input/code/swift/*.swift"),
    "objc": _source("frame.m", "objc", "tests/input/code/objc/*.m"),
    "objcpp": _source("frame.mm", "objcpp", "tests/input/code/objc/*.mm"),
    "rust": _source("frame.rs", "rust", "tests/input/code/corpus/*.rs"),
    "glsl": _source(
        "shader.frag",
        "glsl",
        "tests/frame/spirv/shaders/*.frag",
        "rules/shaders/*.frag",
        "examples/capture/*.frag",
    ),
    "markdown": Kind(
        "page.md",
        lambda: files("docs/*.md", "README.md", "examples/**/*.md", "rules/*.md"),
        CAPTURES,
        ("code", "page", "yaml"),
    ),
    "spirv": Kind(
        "input.spv",
        corpus.shaders,
        CHECKS,
        ("binary",),
        files={"frame.msaa.yaml": corpus.SHADER_FRAME.encode()},
        input="frame.msaa.yaml",
    ),
    "config": Kind(
        "msaa-lint.toml",
        corpus.configuration,
        (*CHECKS, ("cost",), ("rule", "--all")),
        ("toml", "toml", "glob"),
        files={"frame.msaa.yaml": FRAME},
        input=".",
    ),
    "pyproject": Kind(
        "pyproject.toml",
        lambda: [
            b"[tool.msaa-lint]\n" + corpus.CONFIGURATION.replace(b"\n[", b"\n[tool.msaa-lint."),
            *files("tests/data/wrong/pyproject/*", "pyproject.toml"),
        ],
        CHECKS,
        ("toml",),
        files={"frame.msaa.yaml": FRAME},
        input=".",
    ),
    "rules": Kind(
        "custom.md",
        corpus.pages_of_rules,
        (
            *(("check", "--rules", "custom.md", *arguments[1:]) for arguments in CHECKS),
            ("rule", "--rules", "custom.md", "--output", "json", "custom"),
            ("rule", "--rules", "custom.md", "custom"),
            ("check", "--rules", "custom.md", "--diff"),
        ),
        ("page", "cel", "yaml"),
        files={"frame.msaa.yaml": FRAME},
        input="frame.msaa.yaml",
    ),
    "baseline": Kind(
        "baseline.json",
        corpus.baselines,
        (
            *(("check", "--baseline", "baseline.json", *arguments[1:]) for arguments in CHECKS),
            ("baseline", "--prune", "--file", "baseline.json"),
        ),
        ("json",),
        "json",
        files={"frame.msaa.yaml": FRAME},
        input="frame.msaa.yaml",
    ),
    "record": Kind(
        "frame.msaa.yaml.msaa-study.json",
        lambda: [corpus.records()["record"]],
        READS,
        ("json",),
        "json",
        files={"frame.msaa.yaml": STUDIED},
        input="frame.msaa.yaml",
    ),
    "points": Kind(
        "points/*",
        lambda: corpus.points().values(),
        ((*STUDY, "--resume", "points"),),
        ("json",),
        "json",
        files={"mesh.obj": next(iter(corpus.meshes()))},
        input="mesh.obj",
    ),
    "report": Kind(
        "report.json",
        corpus.reports,
        (
            ("device", "--output", "json"),
            ("device",),
            ("device", "--output", "description"),
            ("check", "frame.msaa.yaml", "--output", "json", "--profile"),
            ("cost", "frame.msaa.yaml", "--profile"),
            ("check", "--output", "json"),
        ),
        ("json",),
        "json",
        files={"frame.msaa.yaml": FRAME},
    ),
    "obj": Kind("mesh.obj", corpus.meshes, (STUDY,), ("mesh",)),
    "ply": Kind("mesh.ply", corpus.ply, (STUDY,), ("mesh", "binary")),
    "gitignore": Kind(
        ".gitignore",
        corpus.ignore_files,
        CHECKS,
        ("glob",),
        files={"frame.msaa.yaml": FRAME, "a/b/frame.msaa.yaml": FRAME},
        input=".",
    ),
    "suppressions": Kind(
        "frame.msaa.yaml",
        corpus.suppressed,
        (*CHECKS, ("check", "--diff"), ("check", "--show-suppressed", "--output", "json")),
        ("comment", "yaml"),
    ),
}
"""Each kind by name."""

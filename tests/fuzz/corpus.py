"""The inputs that the fuzzer starts from: those of the tests, the examples, and the rule pages.

`MSAA_LINT_SAMPLES` names a folder with further captures and reports.
"""

from __future__ import annotations

import functools
import json
import os
import re
from collections.abc import Iterator
from pathlib import Path

import yaml

from tests.frame.devices import reported
from tests.input.captures.program import Program
from tests.input.captures.test_hostile import CALLS
from tests.input.captures.test_reads import (
    COMPUTE,
    FRAGMENT,
    READ_ONLY,
    SAMPLER_TYPE,
    SHADER,
    pipeline,
    pipeline_layout,
    scene,
    set_layout,
    shape_of_data,
    template,
    unknown_set,
)  # fmt: skip
from tests.input.compressed import COMPRESS
from tests.input.readers import dialects
from tests.input.readers.dialects_binary import fossilize, renderdoc
from tests.pages import all_examples
from tests.paths import ROOT

FRAME = (ROOT / "tests/data/format.msaa.yaml").read_bytes()
STUDY = (
    "study",
    "--size",
    "32x32",
    "--samples",
    "1,4",
    "--techniques",
    "msaa",
    "--jobs",
    "1",
    "--output",
    "json",
)


def files(*patterns: str) -> Iterator[bytes]:
    for pattern in patterns:
        for path in sorted(ROOT.glob(pattern)):
            if path.is_file():
                yield path.read_bytes()


def samples(*patterns: str) -> Iterator[bytes]:
    folder = os.environ.get("MSAA_LINT_SAMPLES")
    for pattern in patterns if folder else ():
        for path in sorted(Path(str(folder)).glob(pattern)):
            yield path.read_bytes()


def pages(*languages: str) -> Iterator[bytes]:
    for example in all_examples(languages):
        yield example.text.encode()


def descriptions() -> Iterator[bytes]:
    yield from files("tests/data/*.yaml", "examples/**/*.msaa.yaml", "tests/data/wrong/**/*.yaml")
    yield from pages("yaml")
    for path in sorted(ROOT.glob("docs/*.md")):
        yield from (block.encode() for block in fences(path, "yaml"))


def fences(path: Path, language: str) -> list[str]:
    return re.findall(
        rf"^```{language}\n(.*?)^```$", path.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    )


def metal() -> Iterator[bytes]:
    return (seed for seed in descriptions() if b"metal:" in seed or b"METAL" in seed)


def json_descriptions() -> Iterator[bytes]:
    yield from files("tests/data/wrong/json/*.json")
    for seed in descriptions():
        try:
            yield json.dumps(yaml.safe_load(seed), indent=2, default=str).encode()
        except (yaml.YAMLError, ValueError, UnicodeError):
            continue


def gfxreconstruct() -> Iterator[bytes]:
    yield from files("tests/data/wrong/captures/gfx*", "examples/capture/*.jsonl")
    yield from (dialects.lined(lines(CALLS)) for lines in (dialects.old_lines, dialects.new_lines))
    yield dialects.lined(dialects.new_lines(CALLS, expand=True))
    yield dialects.new_array(CALLS[:60])
    yield unknown_reads().text()
    yield from samples("captures/gfxr*")


def unknown_reads() -> Program:
    """Draws with sets that templates write, and a pipeline whose layout is known."""
    program = Program()
    made = template(program, (0, SAMPLER_TYPE, 2))
    layout = pipeline_layout(
        program, set_layout(program, (0, SAMPLER_TYPE, 1, FRAGMENT), (1, SAMPLER_TYPE, 4, COMPUTE))
    )

    def bind(program: Program, buffer: int, view: int) -> None:
        unknown_set(program, buffer, view)
        pushed = {
            "descriptorUpdateTemplate": made,
            "layout": layout,
            "set": 0,
            "pData": shape_of_data([READ_ONLY, SHADER]),
        }
        program.call("vkCmdPushDescriptorSetWithTemplateKHR", commandBuffer=buffer, **pushed)

    return scene(bind, pipeline=pipeline(program, layout), program=program)


def compressed() -> Iterator[bytes]:
    """Captures of each format, compressed each in another way, in one member and in several."""
    text = dialects.lined(dialects.new_lines(CALLS[:60]))
    for compress in COMPRESS.values():
        yield compress(text)
        yield b"".join(map(compress, text.splitlines(keepends=True)))
        yield compress(fossilize(CALLS))


def api_dump() -> Iterator[bytes]:
    yield from files("tests/data/wrong/captures/api-dump*")
    yield dialects.api_dump(CALLS, 2)
    yield from samples("captures/apidump*")


def renderdoc_captures() -> Iterator[bytes]:
    yield from files("tests/data/wrong/captures/renderdoc*", "examples/capture/*.xml")
    yield renderdoc(CALLS).text()
    yield from samples("captures/*.xml")


def shaders() -> list[bytes]:
    return list(files("tests/frame/spirv/shaders/*.spv", "rules/shaders/*.spv"))


def shader_program() -> Program:
    program = Program()
    for number, code in enumerate(shaders()[:6]):
        program.call(
            "vkCreateShaderModule",
            device=1,
            pCreateInfo={"codeSize": len(code), "pCode": code},
            pShaderModule=5000 + number,
        )
    return program


def zip() -> Iterator[bytes]:
    yield renderdoc(shader_program().calls).zip()


def fossilize_databases() -> Iterator[bytes]:
    yield from files("tests/data/wrong/captures/*.foz")
    kinds = (
        "vkCreateInstance",
        "vkCreateShaderModule",
        "vkCreateRenderPass",
        "vkCreateRenderPass2",
        "vkCreateGraphicsPipelines",
    )
    calls = [call for call in (*shader_program().calls, *CALLS) if call[0] in kinds]
    yield from (fossilize(calls, deflated) for deflated in (True, False))
    yield from samples("captures/*.foz")


def reports() -> Iterator[bytes]:
    for report in (
        reported.gpuinfo,
        reported.vulkaninfo_json,
        reported.devsim,
        reported.vkjson,
        reported.profiles,
    ):
        yield json.dumps(report(), indent=1).encode()
    yield reported.text().encode()
    yield from samples("devices/*")


def pages_of_rules() -> Iterator[bytes]:
    for page in sorted((ROOT / "rules").glob("*.md")):
        if page.name != "README.md":
            text = page.read_text(encoding="utf-8")
            yield re.sub(r"\A---\ncode: MSAA(\d+)", r"---\ncode: ACME\1", text).encode()
    yield from (text.encode() for text in fences(ROOT / "docs/configuration.md", "markdown"))


def configuration() -> Iterator[bytes]:
    yield from files("tests/data/wrong/config/*.toml")
    for page in ("configuration.md", "ci.md"):
        yield from (text.encode() for text in fences(ROOT / "docs" / page, "toml"))
    yield CONFIGURATION


def ignore_files() -> Iterator[bytes]:
    yield from files(".gitignore", "examples/capture/.gitignore")
    yield b"*.yaml\n!frame.msaa.yaml\n/a/**/b\n**/c/\n# x\n\\#y\n[a-z]*\n"


def suppressed() -> Iterator[bytes]:
    """Descriptions with a comment for each form of a suppression."""
    comments = [
        f"# msaa-lint: {form}"
        for form in (
            "ignore",
            "ignore[all]",
            "ignore[MSAA101, resolve-outside-pass] -- reason",
            "ignore-file[MSAA1]",
        )
    ]
    for number, seed in enumerate(pages("yaml")):
        lines = seed.decode().splitlines()
        yield "\n".join(
            f"{line}  {comments[(at + number) % 4]}" if at % 3 == 0 else line
            for at, line in enumerate(lines)
        ).encode()


def baselines() -> Iterator[bytes]:
    yield from files("tests/data/wrong/baseline/*.json")
    yield (
        b'{"schema": "msaa-lint/baseline-v1", "entries": {"frame.msaa.yaml": {"MSAA101": 2, '
        b'"MSAA201": 1}, "a/b.yaml": {"MSAA301": 1}}}'
    )


def meshes() -> Iterator[bytes]:
    yield (
        b"# cube\no x\n"
        + b"".join(b"v %d %d %d\n" % (n & 1, n >> 1 & 1, n >> 2) for n in range(8))
        + b"f 1 2 4 3\nf 5 6 8 7\nf -1 -2 -4\nf 1/1 2/2/2 3//3\n"
    )
    yield (
        b"v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nvt 0 0\nvn 0 0 1\nusemtl a\nmtllib a.mtl\n"
        b"f 1/1/1 2/1/1 3/1/1\n"
    )


def ply() -> Iterator[bytes]:
    header = "ply\nformat %s 1.0\ncomment x\nelement vertex 3\n" + "".join(
        f"property float {axis}\n" for axis in "xyz"
    )
    header += "".join(f"property uchar {color}\n" for color in ("red", "green", "blue"))
    header += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    yield (header % "ascii").encode() + b"0 0 0 1 2 3\n1 0 0 255 0 0\n0 1 0 0 255 0\n3 0 1 2\n"
    vertices = b"".join(x.to_bytes(4, "little") for x in (0, 0, 0)) + b"\1\2\3"
    yield (
        (header % "binary_little_endian").encode()
        + vertices
        + b"\0\0\x80?"
        + vertices[4:]
        + b"\0\0\0\0\0\0\x80?"
        + vertices[8:]
        + b"\3"
        + bytes((0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0))
    )


CONFIGURATION = b"""\
edition = "2026.1"
select = ["ALL"]
ignore = ["MSAA1"]
extend-select = ["MSAA201"]
exclude = ["a/**", "*.json"]
min-severity = "note"
fail-on = "error"
fail-on-cost = "50MB/s"
profile = "mali-g76"
baseline = "baseline.json"
rules = ["rules"]
output = ["json"]
[severity]
MSAA301 = "error"
[per-file-ignores]
"*.yaml" = ["MSAA4"]
[limits]
depth = 50
nodes = 10000
bytes = 100000
"""

SHADER_FRAME = """\
pipelines:
  a:
    rendering: {colorAttachmentFormats: [R8G8B8A8_UNORM]}
    multisampleState: {rasterizationSamples: 4, sampleShadingEnable: true, minSampleShading: 0.5}
    stages: [{stage: FRAGMENT, module: input.spv, specialization: {0: 4}}]
  b:
    rendering: {colorAttachmentFormats: [R8G8B8A8_UNORM]}
    multisampleState: {rasterizationSamples: 1}
    stages: [{stage: COMPUTE, module: input.spv}]
"""


@functools.cache
def records() -> dict[str, bytes]:
    """What the command itself writes next to its inputs: a study's record, and the points that a
    study resumes from.
    """
    import tempfile

    from tests.command import run_process

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "frame.msaa.yaml").write_bytes(STUDIED)
        (folder / "mesh.obj").write_bytes(next(iter(meshes())))
        for arguments in (("frame.msaa.yaml", "--record"), ("mesh.obj", "--resume", "points")):
            done = run_process(folder, *STUDY, *arguments)
            assert done.returncode == 0, done.stderr
        found = {"record": (folder / "frame.msaa.yaml.msaa-study.json").read_bytes()}
        for path in sorted((folder / "points").iterdir()):
            found[path.name] = path.read_bytes()
    return found


STUDIED = (ROOT / "examples/phone/frame.msaa.yaml").read_bytes()


def points() -> dict[str, bytes]:
    return {name: data for name, data in records().items() if name != "record"}

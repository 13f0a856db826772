"""Rules that ask a shader's module: what is found, where, at which price; and modules that cannot
be used.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from msaa_lint import lint
from msaa_lint.core.finding import Finding, Result
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.input import readers
from msaa_lint.input.shader_modules import ANALYSIS, Modules
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.rules.registry import load
from tests.paths import ROOT

OWN = ROOT / "tests" / "frame" / "spirv" / "shaders"
RULES = ROOT / "rules" / "shaders"


def linted(folder: Path, text: str, *modules: str) -> Result:
    """What is found in a description beside which some modules lie, in `shaders/`."""
    (folder / "shaders").mkdir(exist_ok=True)
    for name in modules:
        source = next(
            path for path in (OWN / f"{name}.spv", RULES / f"{name}.spv") if path.exists()
        )
        shutil.copy(source, folder / "shaders" / f"{name}.spv")
    (folder / "frame.msaa.yaml").write_text(text, encoding="utf-8")
    return lint(str(folder / "frame.msaa.yaml"), isolated=True)


def of(result: Result, *rules: str) -> list[Finding]:
    return [found for found in result.findings if found.rule in rules]


def pointed(result: Result, found: Finding) -> str:
    """The text that a finding points at."""
    assert found.span is not None
    return result.sources[found.file].text[found.span.start : found.span.end]


def undecided(result: Result) -> set[str]:
    return {each.rule for each in result.undecided}


# Pipelines

SHADING = ("sample-shading-everywhere", "sample-shading-ineffective", "sample-shading-implied")


def pipeline(module: str, state: str, more: str = "") -> str:
    return f"""\
pipelines:
  own:
    rendering: {{colorAttachmentFormats: [R8G8B8A8_UNORM]}}
    multisampleState: {{{state}}}
    stages: [{{stage: FRAGMENT, module: shaders/{module}.spv}}]
{more}"""


@pytest.mark.parametrize(
    ("module", "state", "expected"),
    [
        ("glints.frag", "rasterizationSamples: 4", ["sample-shading-implied high"]),
        (
            "glints.frag",
            "rasterizationSamples: 4, sampleShadingEnable: false",
            ["sample-shading-implied high"],
        ),
        (
            "glints.frag",
            "rasterizationSamples: 4, sampleShadingEnable: true, minSampleShading: 0.25",
            ["sample-shading-implied high"],
        ),
        (
            "glints.frag",
            "rasterizationSamples: 4, sampleShadingEnable: true, minSampleShading: 0.5",
            ["sample-shading-everywhere high"],
        ),
        (
            "glints.frag",
            "rasterizationSamples: 4, sampleShadingEnable: true, minSampleShading: 1.0",
            ["sample-shading-everywhere high"],
        ),
        ("glints.frag", "rasterizationSamples: 4, sampleShadingEnable: true", []),
        (
            "glints.frag",
            "rasterizationSamples: 1, sampleShadingEnable: true, minSampleShading: 1.0",
            ["sample-shading-ineffective high"],
        ),
        ("glints.frag", "sampleShadingEnable: false", []),
        ("fur.frag", "rasterizationSamples: 4", ["sample-shading-implied medium"]),
        (
            "fur.frag",
            "rasterizationSamples: 4, sampleShadingEnable: true, minSampleShading: 0.2",
            ["sample-shading-implied medium"],
        ),
        ("per_sample.frag", "rasterizationSamples: 8", ["sample-shading-implied high"]),
        (
            "plain.frag",
            "rasterizationSamples: 4, sampleShadingEnable: true, minSampleShading: 0.25",
            ["sample-shading-ineffective high"],
        ),
        (
            "plain.frag",
            "rasterizationSamples: 4, sampleShadingEnable: true, minSampleShading: 1.0",
            ["sample-shading-everywhere high"],
        ),
        ("sample_mask.frag", "rasterizationSamples: 4", []),
        ("block_member.frag", "rasterizationSamples: 4", []),
        ("unreached.frag", "rasterizationSamples: 4", []),
    ],
)
def test_one_cause_of_sample_shading_is_one_finding(
    tmp_path: Path, module: str, state: str, expected: list[str]
) -> None:
    found = of(linted(tmp_path, pipeline(module, state), module), *SHADING)
    assert [f"{each.rule} {each.confidence}" for each in found] == expected


def test_what_is_read_is_said(tmp_path: Path) -> None:
    result = linted(
        tmp_path, pipeline("sample_inputs.frag", "rasterizationSamples: 4"), "sample_inputs.frag"
    )
    (found,) = of(result, *SHADING)
    assert found.message == (
        "`own` may run its fragment shader for each of 4 samples "
        "because it reads the `sample` input at location 1, the `sample` input at location 3"
    )
    assert pointed(result, found) == "shaders/sample_inputs.frag.spv"


def test_shading_by_state_and_shader_is_not_mended_by_the_state_alone(tmp_path: Path) -> None:
    state = "rasterizationSamples: 4, sampleShadingEnable: true, minSampleShading: 1.0"
    (found,) = of(linted(tmp_path, pipeline("glints.frag", state), "glints.frag"), *SHADING)
    assert found.fix is None
    assert found.message.endswith("its state requests it, and the shader reads SamplePosition")


COVERAGE = (
    "alpha-to-coverage-without-alpha",
    "alpha-to-coverage-blended",
    "alpha-to-coverage-single-sample",
)


@pytest.mark.parametrize(
    ("module", "state", "expected"),
    [
        (
            "opaque.frag",
            "rasterizationSamples: 4, alphaToCoverageEnable: true",
            ["alpha-to-coverage-without-alpha error"],
        ),
        (
            "no_alpha.frag",
            "rasterizationSamples: 1, alphaToCoverageEnable: true",
            ["alpha-to-coverage-without-alpha error"],
        ),
        (
            "alpha_elsewhere.frag",
            "rasterizationSamples: 4, alphaToCoverageEnable: true",
            ["alpha-to-coverage-without-alpha error"],
        ),
        (
            "depth_only.frag",
            "rasterizationSamples: 4, alphaToCoverageEnable: true",
            ["alpha-to-coverage-without-alpha error"],
        ),
        (
            "alpha_missing.frag",
            "alphaToCoverageEnable: true",
            ["alpha-to-coverage-without-alpha error"],
        ),
        (
            "alpha_one.frag",
            "rasterizationSamples: 4, alphaToCoverageEnable: true",
            ["alpha-to-coverage-without-alpha note"],
        ),
        (
            "alpha_one.frag",
            "rasterizationSamples: 1, alphaToCoverageEnable: true",
            ["alpha-to-coverage-single-sample warning"],
        ),
        ("alpha_stored.frag", "rasterizationSamples: 4, alphaToCoverageEnable: true", []),
        ("alpha_component.frag", "rasterizationSamples: 4, alphaToCoverageEnable: true", []),
        ("alpha_array.frag", "rasterizationSamples: 4, alphaToCoverageEnable: true", []),
        ("opaque.frag", "rasterizationSamples: 4, alphaToCoverageEnable: false", []),
    ],
)
def test_alpha_that_makes_coverage(
    tmp_path: Path, module: str, state: str, expected: list[str]
) -> None:
    found = of(linted(tmp_path, pipeline(module, state), module), *COVERAGE)
    assert [f"{each.rule} {each.severity}" for each in found] == expected


def test_without_alpha_the_blending_is_not_reported_as_well(tmp_path: Path) -> None:
    blending = (
        "    colorBlendState: {attachments: [{blendEnable: true, srcColorBlendFactor: "
        "SRC_ALPHA}]}\n"
    )
    text = pipeline("opaque.frag", "rasterizationSamples: 4, alphaToCoverageEnable: true", blending)
    (found,) = of(linted(tmp_path, text, "opaque.frag"), *COVERAGE)
    assert found.rule == "alpha-to-coverage-without-alpha"
    assert found.notes == ("covers alpha-to-coverage-blended (MSAA507) too",)


def test_without_a_module_a_rule_stays_undecided(tmp_path: Path) -> None:
    text = (
        "pipelines: {own: {multisampleState: {rasterizationSamples: 4, alphaToCoverageEnable: "
        "true}}}"
    )
    result = linted(tmp_path, text)
    assert of(result, *COVERAGE) == []
    assert "alpha-to-coverage-without-alpha" in undecided(result)
    assert "sample-shading-implied" not in undecided(result)


# Reads

FRAME = """\
frame: {{width: 2168, height: 1080, fps: 60}}
images:
  scene_ms: {{format: R16G16B16A16_SFLOAT, samples: {samples}, usage: [COLOR_ATTACHMENT, SAMPLED]}}
  other_ms: {{format: R16G16B16A16_SFLOAT, samples: {samples}, usage: [COLOR_ATTACHMENT, SAMPLED]}}
  picture: {{format: B8G8R8A8_SRGB, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}}
pipelines:
  resolve:
    rendering: {{colorAttachmentFormats: [B8G8R8A8_SRGB]}}
    multisampleState: {{rasterizationSamples: 1}}
    stages: [{{stage: FRAGMENT, module: shaders/{module}.spv, specialization: {{0: {count}}}}}]
  text:
    rendering: {{colorAttachmentFormats: [B8G8R8A8_SRGB]}}
    multisampleState: {{rasterizationSamples: 1}}
commands:
  - beginRendering:
      colorAttachments: [{{image: scene_ms, loadOp: CLEAR, storeOp: STORE}}, {{image: other_ms, loadOp: CLEAR, storeOp: STORE}}]
  - endRendering
  - beginRendering: {{colorAttachments: [{{image: picture, loadOp: DONT_CARE, storeOp: STORE}}]}}
{reads}
  - draw: {{pipeline: resolve, vertexCount: 3, instanceCount: 1}}
{draws}
  - endRendering
  - present: {{image: picture}}
"""
READ = "  - readImage: {image: scene_ms, stage: FRAGMENT, access: SHADER_READ}"
RESOLVES = ("shader-resolve-off-tile", "shader-resolve-sample-count")


def frame(
    module: str = "average.frag",
    count: int = 4,
    samples: int = 4,
    reads: str = READ,
    draws: str = "",
) -> str:
    return FRAME.format(module=module, count=count, samples=samples, reads=reads, draws=draws)


@pytest.mark.parametrize(
    ("module", "count", "samples", "expected"),
    [
        ("average.frag", 4, 4, ["shader-resolve-off-tile warning high"]),
        ("average.frag", 8, 8, ["shader-resolve-off-tile warning high"]),
        ("average_weights.frag", 4, 4, ["shader-resolve-off-tile warning high"]),
        ("average_unrolled.frag", 4, 4, ["shader-resolve-off-tile warning high"]),
        ("average_queried.frag", 4, 2, ["shader-resolve-off-tile warning high"]),
        ("average_branches.frag", 4, 4, ["shader-resolve-off-tile warning high"]),
        ("average.frag", 8, 4, ["shader-resolve-sample-count error high"]),
        ("average.frag", 4, 8, ["shader-resolve-sample-count warning high"]),
        ("average_unrolled.frag", 4, 2, ["shader-resolve-sample-count error high"]),
        ("average_unrolled.frag", 4, 8, ["shader-resolve-sample-count warning high"]),
        ("tone_mapped.frag", 4, 4, []),
        ("tone_mapped.frag", 4, 8, ["shader-resolve-sample-count warning medium"]),
        ("tone_mapped.frag", 4, 2, ["shader-resolve-sample-count error high"]),
        ("weighted.frag", 4, 4, []),
        ("used_twice.frag", 4, 4, []),
        ("neighbours.frag", 4, 4, []),
        ("wrong_divisor.frag", 4, 4, []),
        ("early_end.frag", 4, 8, []),
        # What hangs on a condition may hang on the image's count.
        ("early_end.frag", 4, 4, []),
        ("masked.frag", 4, 2, []),
        ("average_branches.frag", 4, 8, []),
        ("average_branches.frag", 4, 2, []),
        ("partly.frag", 4, 4, []),
        ("masked.frag", 4, 4, []),
        ("first_sample.frag", 4, 4, []),
        ("unknown_bound.frag", 4, 4, []),
        ("per_sample.frag", 4, 4, []),
        ("alpha_stored.frag", 4, 4, []),
    ],
)
def test_a_resolve_in_a_shader(
    tmp_path: Path, module: str, count: int, samples: int, expected: list[str]
) -> None:
    found = of(linted(tmp_path, frame(module, count, samples), module), *RESOLVES)
    assert [f"{each.rule} {each.severity} {each.confidence}" for each in found] == expected


def test_its_price_is_the_way_of_the_samples_through_memory(tmp_path: Path) -> None:
    """Three of four samples are neither stored nor read any more; the fix is shown and never
    made.
    """
    (found,) = of(linted(tmp_path, frame(), "average.frag"), "shader-resolve-off-tile")
    one = 2168 * 1080 * 8 * 60 / 1e6
    assert found.fix is not None and found.fix.shown and found.fix.edits == ()
    engine = Engine(load())
    text = (tmp_path / "frame.msaa.yaml").read_bytes()
    priced = engine.lint(
        text,
        str(tmp_path / "frame.msaa.yaml"),
        LintOptions(lambda rule, suggested, vendor: suggested, prices=True),
    )
    price = next(each.price for each in priced.findings if each.rule == "shader-resolve-off-tile")
    assert price is not None
    assert (price.read_mb_per_s, price.write_mb_per_s) == (
        pytest.approx(3 * one),
        pytest.approx(3 * one),
    )


def test_where_the_count_is_and_whose(tmp_path: Path) -> None:
    result = linted(tmp_path, frame(count=8), "average.frag")
    (found,) = of(result, "shader-resolve-sample-count")
    assert (
        found.message
        == "the shader of `resolve` fetches sample 7 of `scene_ms`, which has only 4, numbered "
        "from 0; use the image's sample count"
    )
    assert pointed(result, found) == "specialization"
    assert [
        result.sources[found.file].text[label.span.start : label.span.end] for label in found.labels
    ] == ["4"]


@pytest.mark.parametrize(
    ("reads", "draws", "expected"),
    [
        # Another shader that is not known draws as well: it may be the reader.
        (READ, "  - draw: {pipeline: text, vertexCount: 3}", []),
        (READ, "  - draw: {vertexCount: 3}", []),
        # The description says what is done.
        (
            "  - readImage: {image: scene_ms, stage: FRAGMENT, samples: ALL, resolves: AVERAGE}",
            "  - draw: {pipeline: text, vertexCount: 3}",
            ["shader-resolve-off-tile"],
        ),
        (
            "  - readImage: {image: scene_ms, stage: FRAGMENT, samples: ALL, resolves: OTHER}",
            "",
            [],
        ),
        # Which of two images the shader reads is not known.
        (f"{READ}\n  - readImage: {{image: other_ms, stage: FRAGMENT}}", "", []),
        # A compute shader reads the one, the fragment shader the other.
        (
            f"{READ}\n  - readImage: {{image: other_ms, stage: COMPUTE}}",
            "",
            ["shader-resolve-off-tile"],
        ),
        ("  - readImage: {image: scene_ms, stage: VERTEX}", "", []),
        ("  - readImage: {image: picture, stage: FRAGMENT}", "", []),
    ],
)
def test_who_reads_what(tmp_path: Path, reads: str, draws: str, expected: list[str]) -> None:
    found = of(linted(tmp_path, frame(reads=reads, draws=draws), "average.frag"), *RESOLVES)
    assert [each.rule for each in found] == expected


def test_two_images_read_alike_are_both_told(tmp_path: Path) -> None:
    both = f"{READ}\n  - readImage: {{image: other_ms, stage: FRAGMENT}}"
    found = of(
        linted(tmp_path, frame("average_two.frag", reads=both), "average_two.frag"), *RESOLVES
    )
    assert [each.rule for each in found] == ["shader-resolve-off-tile", "shader-resolve-off-tile"]
    found = of(linted(tmp_path, frame("average_two.frag", samples=8, reads=both)), *RESOLVES)
    assert [each.message.partition("`, which")[0].rpartition("`")[2] for each in found] == [
        "other_ms",
        "scene_ms",
    ]


def test_an_overflowing_sum_is_told_from_the_shader(tmp_path: Path) -> None:
    result = linted(tmp_path, "scene: {peak: 20000.0}\n" + frame(), "average.frag")
    (found,) = of(result, "half-float-resolve-overflow")
    assert pointed(result, found) == "shaders/average.frag.spv"
    assert (
        of(
            linted(
                tmp_path, "scene: {peak: 20000.0}\n" + frame("tone_mapped.frag"), "tone_mapped.frag"
            ),
            "half-float-resolve-overflow",
        )
        == []
    )


INPUTS = """\
images:
  scene_ms: {{format: R8G8B8A8_UNORM, samples: {samples}}}
  depth_ms: {{format: D32_SFLOAT, samples: {samples}}}
  picture: {{format: R8G8B8A8_UNORM, samples: 1}}
renderPasses:
  scene:
    attachments:
      depth: {{image: depth_ms, loadOp: CLEAR, storeOp: DONT_CARE}}
      color: {{image: scene_ms, loadOp: CLEAR, storeOp: DONT_CARE}}
      output: {{image: picture, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses:
      - {{colorAttachments: [color], depthStencilAttachment: depth}}
      - {{colorAttachments: [output], inputAttachments: {inputs}}}
pipelines:
  resolve:
    renderPass: scene
    subpass: 1
    multisampleState: {{rasterizationSamples: 1}}
    stages: [{{stage: FRAGMENT, module: shaders/average_input.frag.spv}}]
"""


@pytest.mark.parametrize(
    ("samples", "inputs", "expected"),
    [
        (4, "[depth, color]", []),
        (
            8,
            "[depth, color]",
            [
                "the shader of `resolve` averages 4 samples of `color`, which has 8; use the "
                "image's sample count"
            ],
        ),
        (
            2,
            "[depth, color]",
            [
                "the shader of `resolve` fetches sample 3 of `color`, which has only 2, numbered "
                "from 0; use the image's sample count"
            ],
        ),
        (
            2,
            "[null, 0]",
            [
                "the shader of `resolve` fetches sample 3 of `depth`, which has only 2, numbered "
                "from 0; use the image's sample count"
            ],
        ),
        (2, "[color]", []),
    ],
)
def test_an_input_attachment_by_its_index(
    tmp_path: Path, samples: int, inputs: str, expected: list[str]
) -> None:
    """The shader averages four samples of input attachment 1. It does so on the tile."""
    result = linted(tmp_path, INPUTS.format(samples=samples, inputs=inputs), "average_input.frag")
    assert [each.message for each in of(result, *RESOLVES)] == expected


# Modules that cannot be used


def problems(result: Result) -> list[Finding]:
    return [each for each in result.findings if each.code.startswith("MSAA9")]


def one_problem(folder: Path, text: str) -> tuple[str, str, str]:
    """The code, the message and the place of what is wrong with a module. The rest is linted."""
    result = linted(folder, text + "images: {a: {format: R8_UNORM, samples: 16}}\n")
    (found,) = problems(result)
    assert (found.severity, found.fatal) == ("warning", False)
    assert of(result, "sample-count-above-four"), "the rest is linted"
    assert "alpha-to-coverage-without-alpha" in undecided(result)
    return found.code, found.message, pointed(result, found)


NEEDED = "rasterizationSamples: 4, alphaToCoverageEnable: true"


def test_a_module_that_is_not_there(tmp_path: Path) -> None:
    code, message, at = one_problem(tmp_path, pipeline("gone.frag", NEEDED))
    assert (code, message, at) == (
        "MSAA904",
        "file not found: `shaders/gone.frag.spv`",
        "shaders/gone.frag.spv",
    )


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "not SPIR-V: its length is none of whole words"),
        (b"#version 450 core   ", "not SPIR-V: it does not begin with its number"),
        ((OWN / "average.frag.spv").read_bytes()[:-4], "not SPIR-V: a function does not end"),
        ((OWN / "average.frag.spv").read_bytes()[:20], "it has no entry point"),
    ],
)
def test_a_module_that_is_none(tmp_path: Path, content: bytes, message: str) -> None:
    (tmp_path / "shaders").mkdir()
    (tmp_path / "shaders" / "own.frag.spv").write_bytes(content)
    code, said, at = one_problem(tmp_path, pipeline("own.frag", NEEDED))
    assert said == f"`shaders/own.frag.spv`: {message}"
    assert (code, at) == (
        "MSAA904" if "entry point" in message else "MSAA903",
        "shaders/own.frag.spv",
    )


def test_a_module_that_is_a_folder(tmp_path: Path) -> None:
    (tmp_path / "shaders" / "own.frag.spv").mkdir(parents=True)
    code, message, _ = one_problem(tmp_path, pipeline("own.frag", NEEDED))
    assert (code, message) == (
        "MSAA903",
        "`shaders/own.frag.spv` cannot be read: it is a folder, not a regular file",
    )


def test_a_module_that_is_too_large(tmp_path: Path) -> None:
    (tmp_path / "shaders").mkdir()
    with (tmp_path / "shaders" / "own.frag.spv").open("wb") as file:
        file.truncate((16 << 20) + 4)
    code, message, _ = one_problem(tmp_path, pipeline("own.frag", NEEDED))
    assert (code, message) == (
        "MSAA903",
        "`shaders/own.frag.spv` cannot be read: it is larger than 16 MiB",
    )


@pytest.mark.parametrize("way", ["path", "link"])
def test_a_module_outside_of_the_project_is_not_looked_at(tmp_path: Path, way: str) -> None:
    project = tmp_path / "project"
    (project / ".git").mkdir(parents=True)
    (project / "shaders").mkdir()
    shutil.copy(OWN / "no_alpha.frag.spv", tmp_path / "no_alpha.frag.spv")
    if way == "link":
        (project / "shaders" / "no_alpha.frag.spv").symlink_to(tmp_path / "no_alpha.frag.spv")
    name = "no_alpha.frag" if way == "link" else "../../no_alpha.frag"
    code, message, _ = one_problem(project, pipeline(name, NEEDED))
    assert (code, message) == ("MSAA903", f"`shaders/{name}.spv` is outside the project")


def test_an_entry_point_that_is_not_there(tmp_path: Path) -> None:
    text = pipeline("no_alpha.frag", NEEDED).replace("spv}", "spv, name: shade}")
    (tmp_path / "shaders").mkdir()
    shutil.copy(OWN / "no_alpha.frag.spv", tmp_path / "shaders")
    code, message, at = one_problem(tmp_path, text)
    assert (code, at) == ("MSAA904", "shade")
    assert message == "`shaders/no_alpha.frag.spv`: it has no entry point `shade`, but `main`"


def test_a_shader_of_another_stage(tmp_path: Path) -> None:
    (tmp_path / "shaders").mkdir()
    shutil.copy(OWN / "resolve.comp.spv", tmp_path / "shaders")
    code, message, _ = one_problem(tmp_path, pipeline("resolve.comp", NEEDED))
    assert (code, message) == (
        "MSAA903",
        "`shaders/resolve.comp.spv`: `main` is a shader of stage COMPUTE, not FRAGMENT",
    )


@pytest.mark.parametrize(
    "text",
    [
        pipeline("gone.frag", "rasterizationSamples: 1"),
        pipeline(
            "gone.frag",
            "rasterizationSamples: 4",
            "    rasterizationState: {rasterizerDiscardEnable: true}\n",
        ),
        pipeline("gone.frag", "rasterizationSamples: 4").replace("FRAGMENT", "VERTEX"),
    ],
)
def test_a_module_that_nothing_asks_for_is_not_looked_at(tmp_path: Path, text: str) -> None:
    assert problems(linted(tmp_path, text)) == []


def test_a_module_that_a_read_asks_for_is_looked_at(tmp_path: Path) -> None:
    result = linted(tmp_path, frame("gone.frag"))
    (found,) = problems(result)
    assert (found.code, pointed(result, found)) == ("MSAA904", "shaders/gone.frag.spv")
    assert "shader-resolve-off-tile" in undecided(result)


def test_a_path_counts_from_the_description(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "frames"
    folder.mkdir()
    monkeypatch.chdir(tmp_path)
    found = of(linted(folder, pipeline("opaque.frag", NEEDED), "opaque.frag"), *COVERAGE)
    assert [each.rule for each in found] == ["alpha-to-coverage-without-alpha"]
    text = pipeline("opaque.frag", NEEDED)
    assert [each.code for each in problems(lint(text=text, isolated=True))] == ["MSAA904"]
    monkeypatch.chdir(folder)
    assert problems(lint(text=text, isolated=True)) == []


def test_modules_that_came_with_the_input_are_looked_at_first(tmp_path: Path) -> None:
    text = pipeline("opaque.frag", NEEDED)
    source = Source("capture", text)
    document = readers.read(source, parse(source, Limits()).documents[0])
    stage = document.description.pipelines["own"].stages[0]
    own = {"shaders/opaque.frag.spv": (OWN / "alpha_stored.frag.spv").read_bytes()}
    (tmp_path / "shaders").mkdir()
    shutil.copy(RULES / "opaque.frag.spv", tmp_path / "shaders")
    beside = Modules(document, str(tmp_path / "capture")).reflected(stage, True)
    within = Modules(document._replace(modules=own), str(tmp_path / "capture")).reflected(
        stage, True
    )
    assert beside is not None and within is not None
    assert (beside.alpha.declared, within.alpha.declared) == (False, True)


def test_many_large_modules_are_not_all_read(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    code = (OWN / "no_alpha.frag.spv").read_bytes()
    monkeypatch.setattr("msaa_lint.input.shader_modules.ANALYSES", 0)
    monkeypatch.setattr("msaa_lint.input.shader_modules.MAX_WORK", 2 * (len(code) // 4 + ANALYSIS))
    names = ["no_alpha.frag", "alpha_one.frag", "alpha_stored.frag"]
    pipelines = "".join(
        pipeline(name, NEEDED).replace("own:", f"own{n}:").replace("pipelines:\n", "")
        for n, name in enumerate(names)
    )
    result = linted(tmp_path, f"pipelines:\n{pipelines}", *names)
    found = problems(result)
    assert [(each.code, pointed(result, each)) for each in found] == [
        ("MSAA906", "shaders/alpha_one.frag.spv")
    ]
    assert [each.subject for each in of(result, *COVERAGE)] == ["pipelines.own0"]


def test_a_module_that_several_name_is_one_mistake(tmp_path: Path) -> None:
    own = pipeline("gone.frag", NEEDED).replace("pipelines:\n", "")
    text = "pipelines:\n" + "".join(
        own.replace("own:", f"own{n}:").replace("spv}", f"spv, specialization: {{0: {n}}}}}")
        for n in range(3)
    )
    result = linted(tmp_path, text)
    assert [(each.code, each.subject) for each in problems(result)] == [
        ("MSAA904", "pipelines.own0.stages[0].module")
    ]

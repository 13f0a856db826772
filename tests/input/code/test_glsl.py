"""GLSL: the same results as for glslang's modules, findings at their locations, and no findings for
unsupported shaders.
"""

from __future__ import annotations

import contextlib
import shutil
import tempfile
import time
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given

from msaa_lint.frame.spirv.reflect import Reflected, reflect
from msaa_lint.input.code.glsl.description_trees import trees
from msaa_lint.input.code.glsl.shader import shader
from msaa_lint.input.code.glsl.text import UnsupportedShader, preprocess
from msaa_lint.input.code.parsing import Code
from msaa_lint.input.source_file import read_source_file
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from tests.command import run
from tests.frame.spirv.generate import RULES, SHADERS, compiled, sources
from tests.frame.spirv.test_average import TERMS, Term
from tests.input.code.glsl_shaders import HEAD
from tests.input.code.glsl_shaders import SHADERS as STYLES
from tests.strength import examples
from tests.test_rules import ENGINE, as_written

needs_glslang = pytest.mark.skipif(
    shutil.which("glslangValidator") is None, reason="glslangValidator is not installed"
)

AVERAGES = """#version 450
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;
const int COUNT = 8;
void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < COUNT; i++)
        sum += texelFetch(scene, ivec2(gl_FragCoord.xy), i);
    color = sum / float(COUNT);
}
"""
FETCH = "texelFetch(scene, ivec2(gl_FragCoord.xy), i)"


def said(found: Reflected) -> dict[str, Any]:
    """The part of a result that matters: without duration and without the order of findings that
    have no location.
    """
    return {
        **found._asdict(),
        "steps": 0,
        "capabilities": 0,
        "fetches": sorted(map(repr, found.fetches)),
    }


@pytest.mark.parametrize("source", [*sources(SHADERS), *sources(RULES)], ids=lambda path: path.name)
def test_the_shaders_of_the_tests(source: Path) -> None:
    assert said(reflect(shader(source.read_text()).code)) == said(
        reflect(source.with_name(f"{source.name}.spv").read_bytes())
    )


@needs_glslang
@pytest.mark.parametrize("name", STYLES)
def test_as_glslang_reads_it(name: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "style.frag")
        path.write_text(STYLES[name], encoding="utf-8")
        assert said(reflect(shader(STYLES[name]).code)) == said(reflect(compiled(path)))


@needs_glslang
@examples(0.4)
@given(TERMS)
def test_sums_are_followed_alike(term: Term) -> None:
    text = f"{HEAD}void main() {{ ivec2 at = ivec2(gl_FragCoord.xy); color = {term.text}; }}\n"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "sum.frag")
        path.write_text(text, encoding="utf-8")
        assert said(reflect(shader(text).code)) == said(reflect(compiled(path)))


def test_specialization() -> None:
    made = shader(STYLES["specialized"])
    assert reflect(made.code).images[0].total == 4
    assert reflect(made.code, None, {3: 8}).images[0].total == 8


# Alone


def linted(text: str, language: str = "glsl") -> FileResult:
    return ENGINE.lint(
        read_source_file(text.encode(), f"shader.{language}", language),
        f"shader.{language}",
        LintOptions(as_written),
    )


def findings(text: str, language: str = "glsl") -> list[tuple[str, str, str, int, str]]:
    result = linted(text, language)
    assert result.source is not None
    found = []
    for each in result.findings:
        assert each.span is not None
        at = result.source.position(each.span.start)
        found.append(
            (
                each.code,
                each.severity,
                each.confidence,
                at.line,
                text[each.span.start : each.span.end],
            )
        )
    return found


def test_a_shader_that_averages() -> None:
    assert findings(AVERAGES) == [("MSAA313", "note", "low", 8, FETCH)]
    (found,) = linted(AVERAGES).findings
    assert (
        found.message
        == "a shader averages all samples of `scene` from memory; use a resolve attachment, which "
        "averages them on the tile"
    )
    assert found.fix is None


def test_a_compute_shader_that_averages() -> None:
    text = (SHADERS / "resolve.comp").read_text()
    assert findings(text) == [("MSAA313", "note", "low", 11, "texelFetch(scene, at, i)")]


def test_a_shader_of_opengl() -> None:
    text = (
        AVERAGES.replace("#version 450", "#version 330 core")
        .replace("layout(binding = 0) ", "")
        .replace("layout(location = 0) ", "")
    )
    assert findings(text) == [("MSAA313", "note", "low", 8, FETCH)]


def test_two_images_that_are_averaged() -> None:
    text = (SHADERS / "average_two.frag").read_text()
    assert [found[3:] for found in findings(text)] == [
        (10, FETCH),
        (11, FETCH.replace("scene", "other")),
    ]


AVERAGING = {
    "average.frag", "average_queried.frag", "average_two.frag", "average_unrolled.frag",
    "average_weights.frag", "resolve.comp",
    "resolve.frag", "resolve_any.frag", "spec_arithmetic.frag", "storage.frag",
}  # fmt: skip


@pytest.mark.parametrize("source", [*sources(SHADERS), *sources(RULES)], ids=lambda path: path.name)
def test_only_averages_are_found(source: Path) -> None:
    codes = {found[0] for found in findings(source.read_text())}
    assert codes == ({"MSAA313"} if source.name in AVERAGING else set())


CLEAN = [
    "mapped", "exposed", "powers", "squared", "edge", "least", "greatest", "compared", "one",
    "its own", "some", "weights of their own",
    "of a buffer", "switched by a buffer", "in one way", "offsets", "two texels", "difference",
    "last sample", "position", "mask",
    "integers", "overloads", "unused", "push constants", "sample inputs", "another texture",
    "early and",
]  # fmt: skip


@pytest.mark.parametrize("name", CLEAN)
def test_what_is_more_than_an_average(name: str) -> None:
    assert findings(STYLES[name]) == []


@pytest.mark.parametrize(
    "name", ["sceneDepth", "normals_ms", "g_Position", "velocityBuffer", "object_id"]
)
def test_names_of_images_without_color(name: str) -> None:
    assert findings(AVERAGES.replace("scene", name)) == []


@pytest.mark.parametrize(
    "change",
    [
        ("uniform sampler2DMS scene", "uniform sampler2D scene"),
        ("void main()", "void main_()"),
        ("sum / float(COUNT)", "undeclared(sum)"),
        ("sum += ", "sum = sum +* "),
        ("const int COUNT = 8;", '#include "count.glsl"'),
        ("const int COUNT = 8;", "#if COUNT_OF_ENGINE(x)\nconst int COUNT = 8;\n#endif"),
        ("#version 450", "#version 450\nstruct S { unknown_t x; };"),
    ],
)
def test_what_is_not_understood_is_not_judged(change: tuple[str, str]) -> None:
    assert change[0] in AVERAGES
    assert findings(AVERAGES.replace(*change)) == []


def test_places_under_macros() -> None:
    text = AVERAGES.replace("ivec2(gl_FragCoord.xy), i", "AT, i")
    text = text.replace(
        "const int COUNT = 8;", "#define COUNT 8\n#define AT ivec2(gl_FragCoord.xy)"
    )
    assert findings(text) == [("MSAA313", "note", "low", 9, "texelFetch(scene, AT, i)")]
    longer = "#define FETCH(i) \\\n  texelFetch(scene, ivec2(gl_FragCoord.xy), (i))\n"
    text = AVERAGES.replace("const int", longer + "const int").replace(FETCH, "FETCH(i)")
    assert [found[3:] for found in findings(text)] == [(10, "FETCH(i)")]


def test_line_ends_and_other_scripts() -> None:
    text = "// Die Mittelung über alle 样本\n" + AVERAGES
    assert findings(text) == [("MSAA313", "note", "low", 9, FETCH)]
    assert findings(text.replace("\n", "\r\n")) == [("MSAA313", "note", "low", 9, FETCH)]


# Pages

PART = """// Manual resolve
layout (constant_id = 0) const int NUM_SAMPLES = 8;
vec4 resolve(sampler2DMS tex, ivec2 uv)
{
    vec4 result = vec4(0.0);
    for (int i = 0; i < NUM_SAMPLES; i++)
    {
        vec4 val = texelFetch(tex, uv, i);
        result += val;
    }
    return result / float(NUM_SAMPLES);
}
"""
MADE = """VkImageCreateInfo info{};
info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
info.format = VK_FORMAT_R8G8B8A8_UNORM;
info.samples = VK_SAMPLE_COUNT_4_BIT;
info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
vkCreateImage(device, &info, nullptr, &color);
"""


def page(*blocks: tuple[str, str]) -> str:
    return "# A page\n\n" + "\nText.\n\n".join(
        f"```{language}\n{text}```\n" for language, text in blocks
    )


def test_a_part_of_a_shader() -> None:
    assert findings(page(("glsl", PART)), "markdown") == [
        ("MSAA313", "note", "low", 11, "texelFetch(tex, uv, i)")
    ]
    assert findings(page(("glsl", "...\n" + PART + "...\n")), "markdown") == [
        ("MSAA313", "note", "low", 12, "texelFetch(tex, uv, i)")
    ]
    assert (
        findings(
            page(("glsl", PART.replace("result += val", "result += val / (val + 1.0)"))), "markdown"
        )
        == []
    )


def test_several_shaders_of_a_page() -> None:
    vertex = "#version 450\nvoid main() {\n    gl_Position = vec4(0.0);\n}\n"
    text = page(("glsl", vertex), ("glsl", AVERAGES), ("glsl", PART))
    assert [found[4] for found in findings(text, "markdown")] == [FETCH, "texelFetch(tex, uv, i)"]


def test_the_count_of_the_image_beside_it() -> None:
    both = findings(page(("cpp", MADE), ("glsl", PART)), "markdown")
    assert [(code, severity, at) for code, severity, _, _, at in both if code == "MSAA314"] == [
        ("MSAA314", "error", "8")
    ]
    same = page(("cpp", MADE), ("glsl", PART.replace("= 8", "= 4")))
    assert [found[0] for found in findings(same, "markdown")] == ["MSAA313"]
    fewer = page(("cpp", MADE.replace("COUNT_4", "COUNT_8")), ("glsl", PART.replace("= 8", "= 4")))
    assert ("MSAA314", "warning") in [found[:2] for found in findings(fewer, "markdown")]


def test_the_count_of_an_image_that_is_not_known() -> None:
    second = MADE.replace("COUNT_4", "COUNT_8").replace("color", "other").replace("info", "second")
    for code in (
        MADE + second,
        MADE.replace("VK_SAMPLE_COUNT_4_BIT", "samples"),
        MADE + "VkSpecializationInfo spec{};\n",
    ):
        assert "MSAA314" not in [
            found[0] for found in findings(page(("cpp", code), ("glsl", PART)), "markdown")
        ]


# Modules of a description

FRAME = """
images: {scene_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, SAMPLED]}, target: {format: B8G8R8A8_SRGB, samples: 1}}
pipelines:
  resolve:
    rendering: {colorAttachmentFormats: [B8G8R8A8_SRGB]}
    multisampleState: {rasterizationSamples: 1}
    stages: [{stage: FRAGMENT, module: MODULE}]
commands:
  - beginRendering: {colorAttachments: [{image: scene_ms, loadOp: CLEAR, storeOp: STORE}]}
  - endRendering
  - beginRendering: {colorAttachments: [{image: target, loadOp: DONT_CARE, storeOp: STORE}]}
  - readImage: {image: scene_ms, stage: FRAGMENT, access: SHADER_READ}
  - draw: {pipeline: resolve, vertexCount: 3, instanceCount: 1}
  - endRendering
  - present: {image: target}
"""


def of_frame(folder: Path, module: str) -> list[tuple[str, str, str]]:
    path = folder / "frame.msaa.yaml"
    text = FRAME.replace("MODULE", module)
    path.write_text(text, encoding="utf-8")
    result = ENGINE.lint(text.encode(), str(path), LintOptions(as_written))
    told = [
        each for each in result.findings if each.code.startswith(("MSAA313", "MSAA314", "MSAA9"))
    ]
    return [(each.code, each.severity, each.message) for each in told]


def test_a_stage_that_names_a_text(tmp_path: Path) -> None:
    (tmp_path / "resolve.frag").write_text(AVERAGES, encoding="utf-8")
    assert [found[:2] for found in of_frame(tmp_path, "resolve.frag")] == [("MSAA314", "error")]
    (tmp_path / "resolve.frag").write_text(AVERAGES.replace("= 8", "= 4"), encoding="utf-8")
    assert [found[:2] for found in of_frame(tmp_path, "resolve.frag")] == [("MSAA313", "warning")]


def test_a_text_without_main(tmp_path: Path) -> None:
    (tmp_path / "resolve.glsl").write_text(PART, encoding="utf-8")
    assert [found[:2] for found in of_frame(tmp_path, "resolve.glsl")] == [("MSAA314", "error")]


def test_a_page_is_converted(tmp_path: Path) -> None:
    """The shaders are in files next to the description."""
    (tmp_path / "page.md").write_text(page(("cpp", MADE), ("glsl", PART)), encoding="utf-8")
    done = run(tmp_path, "convert", "page.md", "-o", "page.msaa.yaml")
    assert done.returncode == 0
    assert (tmp_path / "resolve.frag").read_text() == PART
    text = (tmp_path / "page.msaa.yaml").read_text()
    result = ENGINE.lint(text.encode(), str(tmp_path / "page.msaa.yaml"), LintOptions(as_written))
    assert {each.code for each in result.findings} == {"MSAA313", "MSAA314"}


def test_a_text_that_cannot_be_followed(tmp_path: Path) -> None:
    (tmp_path / "resolve.frag").write_text("void main() { nothing(); }", encoding="utf-8")
    ((code, severity, message),) = of_frame(tmp_path, "resolve.frag")
    assert (code, severity) == ("MSAA903", "warning")
    assert message == "`resolve.frag` cannot be analyzed: `nothing()` is not defined"
    assert of_frame(tmp_path, "gone.frag")[0][0] == "MSAA904"
    assert (
        of_frame(tmp_path, "../../outside.frag")[0][2]
        == "`../../outside.frag` is outside the project"
    )


def test_spirv_under_the_name_of_a_text(tmp_path: Path) -> None:
    (tmp_path / "resolve.frag").write_bytes((RULES / "resolve.frag.spv").read_bytes())
    assert [found[0] for found in of_frame(tmp_path, "resolve.frag")] == ["MSAA314"]


def test_without_the_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from msaa_lint.input.code import languages

    monkeypatch.setitem(languages.GRAMMARS, "glsl", "no_such_grammar")
    (tmp_path / "resolve.frag").write_text(AVERAGES, encoding="utf-8")
    ((code, severity, message),) = of_frame(tmp_path, "resolve.frag")
    assert (code, severity, message) == ("MSAA903", "warning", "`resolve.frag` is GLSL")


# Malicious texts

HOSTILE = {
    "parentheses": AVERAGES.replace("sum / float(COUNT)", "(" * 3000 + "sum" + ")" * 3000),
    "additions": AVERAGES.replace("sum / float(COUNT)", "sum + " * 3000 + "sum"),
    "blocks": AVERAGES.replace("color = sum",
    "{" * 2000 + "color = sum" + ";" + "}" * 2000 + "color = sum"),
    "ifs": AVERAGES.replace("color = sum", "if (sum.x > 0.5) color = sum; else " * 2000 + "color = "
        "sum"),
    "macros within macros": "#define A0 x x x x x x x x\n"
    + "".join(f"#define A{n} A{n - 1} A{n - 1} A{n - 1} A{n - 1}\n" for n in range(1, 16))
    + AVERAGES.replace("COUNT = 8", "COUNT = A15"),
    "a macro of itself": "#define COUNT COUNT + COUNT\n" + AVERAGES,
    "many macros": "".join(f"#define N{n} {n}\n" for n in range(20000)) + AVERAGES,
    "conditions": "#if " + "(" * 200 + "1" + ")" * 200 + "\n#endif\n" * 5000 + AVERAGES,
    "loops": AVERAGES.replace("COUNT = 8", "COUNT = 2000000000"),
    "loops in loops": AVERAGES.replace("for (", "for (int a = 0; a < 100; a++) for (int b = 0; b < "
        "100; b++) for (", 1),
    "itself": AVERAGES.replace("void main() {", "void main() { main();"),
    "arrays": AVERAGES.replace("vec4 sum =", "float big[65536][65536]; vec4 sum ="),
    "an array of arrays": AVERAGES.replace("vec4 sum =",
    "float big" + "[2]" * 200 + "; vec4 sum ="),
    "structures": "struct S0 { float a, b; };\n"
    + "".join(f"struct S{n} {{ S{n - 1} a, b; }};\n" for n in range(1, 60))
    + AVERAGES.replace("vec4 sum =", "S59 s; vec4 sum ="),
    "half a shader": AVERAGES[: len(AVERAGES) // 2],
    "nothing": "sampler2DMS \x00 ` @ \\",
    "numbers": AVERAGES.replace("COUNT = 8", "COUNT = " + "9" * 5000).replace("vec4(0.0)",
    "vec4(1e999)"),
    "calls": "float f0() { return 1.0; }\n"
    + "".join(f"float f{n}() {{ return f{n - 1}() + f{n - 1}(); }}\n" for n in range(1, 40))
    + AVERAGES.replace("vec4(0.0)", "vec4(f39())"),
}  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_text_ends_soon(name: str) -> None:
    begun = time.process_time()
    with contextlib.suppress(UnsupportedShader):
        reflect(shader(HOSTILE[name]).code)
    for fragments in (False, True):
        trees(Code(HOSTILE[name], "glsl", fragments))
    assert time.process_time() - begun < 10


def test_what_stands_where() -> None:
    """Each parsed character maps to the original one."""
    text = "#define N 4\n#define ADD(a, b) (a + b)\nint x = N; int y = ADD(N, 2) * N;\nint z;\n"
    made = preprocess(text)
    assert made.text.split() == [
        "int",
        "x",
        "=",
        "4;",
        "int",
        "y",
        "=",
        "(4",
        "+",
        "2)",
        "*",
        "4;",
        "int",
        "z;",
    ]
    for word in ("int x", "int y", "int z", "* "):
        assert text.startswith(word, made.place(made.text.index(word)))
    assert text.startswith("ADD(N, 2)", made.place(made.text.index("(4 + 2)")))
    assert text.startswith("N;", made.place(made.text.index("4;")))


def test_by_the_real_command(tmp_path: Path) -> None:
    """A file selected by its name, and a page; both are shown, and neither fails."""
    (tmp_path / "resolve.frag").write_text(AVERAGES, encoding="utf-8")
    done = run(tmp_path, "check", "--isolated", "--output", "concise", "resolve.frag")
    assert done.returncode == 0
    assert done.stdout.startswith(
        "resolve.frag:8:16: note[shader-resolve-off-tile] a shader averages all samples of `scene` "
        "from memory"
    )
    (tmp_path / "page.md").write_text(page(("cpp", MADE), ("glsl", PART)), encoding="utf-8")
    done = run(tmp_path, "check", "--isolated", "--output", "concise", "page.md")
    assert done.returncode == 0
    assert (
        "page.md:16:50: error[shader-resolve-sample-count] the shader of `resolve` fetches sample "
        "7 of `tex`, which has only 4" in done.stdout
    )

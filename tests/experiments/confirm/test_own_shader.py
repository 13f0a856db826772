"""Fragment shaders from outside, drawn on lavapipe under the validation layer: their descriptors,
their inputs, what cannot be created.
"""

from __future__ import annotations

import array
import struct
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.confirm import shader_features
from msaa_lint.experiments.confirm.gate import gate
from msaa_lint.experiments.confirm.own_shader import UnusableOwnShader, own_shader
from msaa_lint.experiments.confirm.parts import Plan, from_json, unpacked
from msaa_lint.experiments.confirm.session import Session
from msaa_lint.experiments.confirm.shader_support import supported, unsupported
from msaa_lint.experiments.confirm.shaders.vertex import vertex_shader
from msaa_lint.frame.spirv.constants import Constants
from msaa_lint.frame.spirv.interface import interface
from msaa_lint.frame.spirv.layouts import Layouts
from msaa_lint.frame.spirv.module import Module
from tests.experiments.confirm.frames import planned
from tests.experiments.confirm.test_execute import SIDE, SIZE, plain, well
from tests.experiments.confirm.test_shaders import validate
from tests.glsl import HEAD, spirv
from tests.strength import examples

__all__ = ["plain"]

COLOR = "layout(location = 0) out vec4 color;\n"
FRAME = f"""
images:
  output: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, TRANSFER_SRC], {SIZE}}}
renderPasses:
  p:
    attachments:
      output: {{image: output, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}}
    subpasses: [{{colorAttachments: [output]}}]
pipelines:
  own: {{renderPass: p, subpass: 0, stages: [{{stage: FRAGMENT, module: own.spv}}]}}
"""


def plan_of(folder: Path, code: bytes, text: str = FRAME) -> Plan:
    """A plan whose pipeline has a fragment shader."""
    (folder / "own.spv").write_bytes(code)
    made = planned(text, file=str(folder / "frame.msaa.yaml"))
    return from_json(made)


def drawn(
    session: Session, folder: Path, text: str, environment: str = "vulkan1.1"
) -> list[tuple[float, ...]]:
    """The pixels that a fragment shader draws over the whole picture and in the triangles of the
    scene.
    """
    made = plan_of(folder, spirv(text, environment=environment))
    assert len(made.passes[0].pipelines[0].stages) == 2, made.defaults
    # From the backdrop on: it covers every pixel.
    (step,) = made.steps
    made = made._replace(
        steps=(step._replace(inner=tuple(each._replace(backdrop=True) for each in step.inner)),)
    )
    assert supported(made, session.device) == made
    return well(session, made).pixels("output")


# Contents


def test_buffers_and_push_constants_have_the_stated_contents(
    plain: Session, tmp_path: Path
) -> None:
    text = """
layout(binding = 0) uniform U { vec4 floats; int one; mat3 identity; } u;
layout(binding = 1) readonly buffer S { uint count; float tail[]; } s;
layout(push_constant) uniform P { layout(offset = 32) vec4 pushed; };
void main() {
    bool right = u.floats == vec4(0.5, 0.625, 0.75, 0.875) && u.one == 1 && u.identity == mat3(1.0) && pushed == u.floats
        && s.count == 1u && s.tail.length() == 16384 && s.tail[7] == s.tail[16383];
    color = right ? vec4(u.floats.xyz, 1.0) : vec4(1.0, 0.0, 0.0, 1.0);
}
"""
    assert set(drawn(plain, tmp_path, COLOR + text)) == {(128, 159, 191, 255)}


def test_images_have_the_stated_contents(plain: Session, tmp_path: Path) -> None:
    """The pattern repeats every 32 texels, in every layer and level; other images are of one
    value.
    """
    text = """
layout(binding = 0) uniform sampler2D t;
layout(binding = 1) uniform sampler2DArray layers;
layout(binding = 2) uniform isampler3D numbers;
layout(binding = 3) uniform sampler2DMS samples;
layout(binding = 4, rgba16f) uniform readonly image2D stored;
layout(binding = 5, r32ui) uniform readonly uimageCube faces;
layout(binding = 6) uniform samplerBuffer texels;
layout(binding = 7) uniform sampler2DShadow shadow;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 value = texelFetch(t, at + 64, 0);
    bool right = value == texelFetch(t, at, 1) && value == texelFetch(layers, ivec3(at, 3), 2) && textureQueryLevels(t) == 11
        && texelFetch(numbers, ivec3(at, 5), 0) == ivec4(at & 1, (at.x ^ at.y) & 1, 1) && textureSize(numbers, 0) == ivec3(64)
        && texelFetch(samples, at, 3) == vec4(128.0 / 255.0) && textureSamples(samples) == 4
        && imageLoad(stored, at) == vec4(0.5) && imageLoad(faces, ivec3(at, 5)).x == 1u
        && texelFetch(texels, 4095) == vec4(0.5) && textureSize(texels) == 4096
        && textureLod(shadow, vec3((vec2(at) + 0.5) / 1024.0, 0.2), 0.0) == 1.0
        && textureLod(shadow, vec3((vec2(at) + 0.5) / 1024.0, 0.8), 0.0) == 0.0;
    color = right ? vec4(value.xyz, 1.0) : vec4(0.0);
}
"""
    pixels = drawn(plain, tmp_path, COLOR + text.replace("textureSamples(samples)", "4"))
    expected = [
        (x * 255 // 31, y * 255 // 31, (x ^ y) * 255 // 31, 255)
        for y in range(SIDE)
        for x in range(SIDE)
    ]
    assert pixels == expected


def test_inputs_vary_over_the_picture(plain: Session, tmp_path: Path) -> None:
    text = """
layout(location = 0) in vec2 across;
layout(location = 1) in vec2 down;
layout(location = 2) flat in uvec4 parity;
layout(location = 3) in Block { vec3 a; flat ivec2 b; } block;
layout(location = 6, component = 1) in vec3 late;
layout(location = 7) in mat4x2 columns[2];
void main() {
    bool right = across == down.yx && block.a.z == across.y && parity.x == uint(block.b.y) && columns[1][0] == down && late.x == across.x;
    color = right ? vec4(across, float(parity.w), 1.0) : vec4(0.0);
}
"""
    pixels = drawn(
        plain, tmp_path, COLOR + text.replace("block.a.z == across.y", "block.a.y == across.y")
    )
    assert {pixel[3] for pixel in pixels} == {255} and {pixel[2] for pixel in pixels} == {0, 255}
    for number, (red, green, _, _) in enumerate(pixels):
        # The centers of pixels, from 0 to 1 over the picture.
        assert (
            abs(red - 255 * (number % SIDE + 0.5) / SIDE) <= 1
            and abs(green - 255 * (number // SIDE + 0.5) / SIDE) <= 1
        )


# Shaders as programs have them

PBR = """
layout(set = 0, binding = 0) uniform Camera { mat4 view, projection; vec3 position; } camera;
struct Light { vec4 place; vec4 color; };
layout(set = 0, binding = 1) uniform Lights { Light lights[4]; int count; } scene;
layout(set = 1, binding = 0) uniform sampler2D albedo;
layout(set = 1, binding = 1) uniform sampler2D normals;
layout(set = 1, binding = 2) uniform sampler2D roughness;
layout(set = 2, binding = 0) uniform samplerCube sky;
layout(set = 2, binding = 1) uniform sampler2DArrayShadow cascades;
layout(push_constant) uniform Push { layout(offset = 64) float exposure; uint flags; };
layout(location = 0) in vec3 place; layout(location = 1) in vec3 normal; layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 tangent; layout(location = 4) flat in uint material;
void main() {
    vec3 n = normalize(mat3(tangent.xyz, cross(normal, tangent.xyz), normal) * (texture(normals, uv).xyz * 2.0 - 1.0));
    vec3 sum = texture(sky, n).rgb * texture(cascades, vec4(uv, 0.0, 0.5));
    for (int i = 0; i < scene.count; i++) sum += max(dot(n, normalize(scene.lights[i].place.xyz - place)), 0.0) * scene.lights[i].color.rgb;
    color = vec4(texture(albedo, uv).rgb * sum * exposure * texture(roughness, uv).g + float(material), 1.0);
}
"""
PROGRAMS = {
    "pbr": PBR,
    "separate samplers": """
layout(set = 0, binding = 0) uniform texture2D images[4];
layout(set = 0, binding = 8) uniform sampler linear;
layout(set = 3, binding = 1) uniform samplerShadow comparing;
layout(set = 3, binding = 2) uniform texture2D shadows;
layout(location = 0) in vec2 uv;
void main() { color = texture(sampler2D(images[2], linear), uv) * texture(sampler2DShadow(shadows, comparing), vec3(uv, 0.5)); }
""",
    "every dimensionality": """
layout(binding = 0) uniform sampler1D a; layout(binding = 1) uniform sampler1DArray b; layout(binding = 2) uniform sampler3D c;
layout(binding = 3) uniform samplerCubeArray d; layout(binding = 4) uniform isampler2DArray e; layout(binding = 5) uniform usampler2DMS f;
layout(binding = 6) uniform isamplerBuffer g; layout(binding = 7, rgba8) uniform image1DArray h;
layout(location = 0) in vec4 v;
void main() {
    color = texture(a, v.x) + texture(b, v.xy) + texture(c, v.xyz) + texture(d, v) + texture(e, v.xyz)
        + texelFetch(g, 1) + imageLoad(h, ivec2(1));
}
""",
    "order-independent transparency": """
struct Node { vec4 color; float depth; uint next; };
layout(binding = 0) buffer Counter { uint count; uint limit; };
layout(binding = 1, r32ui) uniform uimage2D heads;
layout(binding = 2) buffer Nodes { Node nodes[]; };
void main() {
    uint at = atomicAdd(count, 1u);
    if (at < limit) nodes[at] = Node(vec4(1.0), gl_FragCoord.z, imageAtomicExchange(heads, ivec2(gl_FragCoord.xy), at));
    color = vec4(0.5);
}
""",
    "built-in inputs": """
in float gl_ClipDistance[2];
in float gl_CullDistance[1];
void main() {
    color = gl_FragCoord + vec4(gl_ClipDistance[1], gl_CullDistance[0], gl_PrimitiveID, gl_SampleID);
    color += vec4(gl_FrontFacing, gl_SamplePosition, 1);
}
""",
    "no descriptors, derivatives, discard": """
layout(location = 3) in float edge;
void main() { if (edge < 0.25) discard; color = vec4(fwidth(edge)); }
""",
}


@pytest.mark.parametrize("environment", ["vulkan1.0", "vulkan1.1", "vulkan1.2", "vulkan1.3"])
@pytest.mark.parametrize("program", PROGRAMS)
def test_programs_are_drawn_without_a_word_of_the_layer(
    plain: Session, tmp_path: Path, program: str, environment: str
) -> None:
    code = spirv(COLOR + PROGRAMS[program], environment=environment)
    (tmp_path / "own.spv").write_bytes(code)
    stages = own_shader(str(tmp_path / "own.spv"))
    assert unsupported(stages, plain.device) == ""
    made = planned(FRAME)
    (frame_pass,) = made.passes
    pipelines = tuple(pipeline._replace(stages=stages) for pipeline in frame_pass.pipelines)
    well(plain, from_json(made._replace(passes=(frame_pass._replace(pipelines=pipelines),))))


INPUTS = f"""
images:
  first: {{format: R8G8B8A8_UNORM, samples: SAMPLES, usage: [COLOR_ATTACHMENT, INPUT_ATTACHMENT], {SIZE}}}
  output: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, TRANSFER_SRC], {SIZE}}}
renderPasses:
  p:
    attachments:
      first: {{image: first, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}}
      output: {{image: output, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}}
    subpasses:
      - {{colorAttachments: [first]}}
      - {{inputAttachments: [first], colorAttachments: [output]}}
    dependencies:
      - {{srcSubpass: 0, dstSubpass: 1, srcStageMask: COLOR_ATTACHMENT_OUTPUT, dstStageMask: FRAGMENT_SHADER,
         srcAccessMask: COLOR_ATTACHMENT_WRITE, dstAccessMask: INPUT_ATTACHMENT_READ, dependencyFlags: BY_REGION}}
pipelines:
  own: {{renderPass: p, subpass: 1, stages: [{{stage: FRAGMENT, module: own.spv}}]}}
"""
LOADS = (
    "layout(input_attachment_index = 0, binding = 0) uniform subpassInput first;\nvoid main() "
    "{ color = 1.0 - subpassLoad(first); }"
)


def test_input_attachments_are_those_of_the_subpass(plain: Session, tmp_path: Path) -> None:
    made = plan_of(tmp_path, spirv(COLOR + LOADS), INPUTS.replace("SAMPLES", "1"))
    assert supported(made, plain.device) == made
    # What is cleared to 32, 64, and 128 is read where a triangle of both subpasses is, and
    # elsewhere.
    assert len(set(well(plain, made).pixels("output"))) > 5


@pytest.mark.parametrize(
    ("frame", "shader", "reason"),
    [
        (INPUTS.replace("SAMPLES", "4"), LOADS, "reads input attachment 0 at set 0, binding 0, "
            "whose image has 4 samples"),
        (INPUTS.replace("SAMPLES", "1"), LOADS.replace("index = 0", "index = 1"),
         "reads input attachment 1 at set 0, binding 0, which the pass does not have"),
        (FRAME, LOADS,
        "reads input attachment 0 at set 0, binding 0, which the pass does not have"),
    ],
)  # fmt: skip
def test_input_attachments_that_do_not_fit_leave_the_built_in_shader(
    plain: Session, tmp_path: Path, frame: str, shader: str, reason: str
) -> None:
    made = supported(plan_of(tmp_path, spirv(COLOR + shader), frame), plain.device)
    assert f"the shader of own {reason}: a built-in one is used" in made.defaults
    assert all(pipeline.stages == () for pipeline in made.passes[0].pipelines)
    well(plain, made)


# What cannot be created


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("#extension GL_EXT_ray_query : enable\nlayout(binding = 0) uniform "
            "accelerationStructureEXT a;\nvoid main() { rayQueryEXT q; "
         "rayQueryInitializeEXT(q, a, 0u, 255u, vec3(0), 0.0, vec3(1), 1.0); color = vec4(0); }",
         "needs the capability RayQueryKHR, which is not supported"),
        ("layout(binding = 0) uniform U { double d[4]; };\nvoid main() { color = vec4(d[1]); }",
        ""),
        ("layout(location = 1) flat in dvec2 d;\nvoid main() { color = vec4(d.x); }",
         "the input at location 1, of type dvec2, cannot be written: only components of 32 bits "
         "are supported, not 64"),
        ("layout(binding = 0) buffer B { uint a[8000000]; };\nvoid main() { color = vec4(a[3]); }",
        "a block is larger than 16 MiB"),
        ("layout(binding = 0) uniform sampler2D t[5000];\nvoid main() { color = texture(t[3], "
            "vec2(0)); }",
         "needs 5000 descriptors at set 0, binding 0; at most 4096 are created"),
        (LOADS,
        "reads input attachment 0 at set 0, binding 0, and the passes of a study have none"),
    ],
)  # fmt: skip
def test_what_cannot_be_created_is_named(tmp_path: Path, text: str, reason: str) -> None:
    (tmp_path / "own.spv").write_bytes(spirv(COLOR + text, environment="vulkan1.2"))
    if not reason:
        assert own_shader(str(tmp_path / "own.spv"))[1].features == ("shaderFloat64",)
        return
    with pytest.raises(UnusableOwnShader) as raised:
        own_shader(str(tmp_path / "own.spv"))
    assert reason in str(raised.value) and "\n" not in str(raised.value)
    # In a description the built-in shader takes its place.
    made = plan_of(tmp_path, (tmp_path / "own.spv").read_bytes())
    if text != LOADS:
        assert made.passes[0].pipelines[0].stages == () and any(
            "a built-in one is used" in note for note in made.defaults
        )


def test_a_shader_of_a_description_that_reads_what_it_writes_is_replaced(tmp_path: Path) -> None:
    made = plan_of(tmp_path, spirv(COLOR + PROGRAMS["order-independent transparency"]))
    assert made.passes[0].pipelines[0].stages == ()
    reason = "reads what it writes to set 0, binding 0, so that pictures may differ"
    assert f"the fragment shader of own {reason}: a built-in one is used" in made.defaults


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (
            "layout(location = 1) out vec4 c;\nvoid main() { c = vec4(0); }",
            "it has no output at location 0",
        ),
        (
            "layout(location = 0) out uvec4 c;\nvoid main() { c = uvec4(0); }",
            "its output at location 0 is of type uvec4",
        ),
    ],
)
def test_a_shader_must_write_a_color(tmp_path: Path, text: str, reason: str) -> None:
    (tmp_path / "own.spv").write_bytes(spirv(text))
    with pytest.raises(UnusableOwnShader, match=reason):
        own_shader(str(tmp_path / "own.spv"))


def test_what_a_device_lacks_is_named(plain: Session, tmp_path: Path) -> None:
    text = (
        "layout(binding = 0) uniform samplerCubeArray t;\nlayout(push_constant) uniform P { vec4 "
        "v[8]; };\n" + COLOR
    )
    (tmp_path / "own.spv").write_bytes(
        spirv(text + "void main() { color = texture(t, v[7]); }", environment="vulkan1.3")
    )
    stages = own_shader(str(tmp_path / "own.spv"))
    assert unsupported(stages, plain.device) == ""
    device = plain.device
    without = {**device, "features": {**device["features"], "imageCubeArray": 0}}
    assert (
        unsupported(stages, without)
        == "needs the feature imageCubeArray, which the device does not have"
    )
    assert unsupported(stages, without, ["imageCubeArray"]) == ""
    limits = {**device["properties"]["limits"], "maxPushConstantsSize": 64}
    small = {**device, "properties": {**device["properties"], "limits": limits}}
    assert (
        unsupported(stages, small)
        == "needs 128 bytes of push constants, and the device has maxPushConstantsSize 64"
    )
    old = {**device, "properties": {**device["properties"], "apiVersion": 1 << 22 | 1 << 12}}
    assert unsupported(stages, old) == "is SPIR-V 1.6, and the device takes at most 1.3"


def test_subgroup_operations_are_those_of_the_device(plain: Session, tmp_path: Path) -> None:
    text = (
        "#extension GL_KHR_shader_subgroup_quad : enable\n#extension "
        "GL_KHR_shader_subgroup_clustered : enable\n" + COLOR
    )
    for operation, capability, bit in (
        ("subgroupQuadBroadcast(color.x, 1u)", "Quad", 0x80),
        ("subgroupClusteredAdd(1.0, 4u)", "Clustered", 0x40),
    ):
        (tmp_path / "own.spv").write_bytes(
            spirv(f"{text}void main() {{ color = vec4({operation}); }}")
        )
        stages = own_shader(str(tmp_path / "own.spv"))
        properties = {"subgroupSupportedStages": 0x10, "subgroupSupportedOperations": 0xFF}
        able = {**plain.device, "VkPhysicalDeviceVulkan11Properties": properties}
        unable = {
            **plain.device,
            "VkPhysicalDeviceVulkan11Properties": {
                **properties,
                "subgroupSupportedOperations": 0xFF - bit,
            },
        }
        assert unsupported(stages, able) == ""
        reason = (
            f"needs the subgroup operations of GroupNonUniform{capability}, which the device "
            "does not have"
        )
        assert unsupported(stages, unable) == reason


def test_extensions_of_spirv_that_are_not_enabled_are_named(tmp_path: Path) -> None:
    words = array.array("I", spirv(COLOR + "void main() { color = vec4(1); }"))
    name = b"SPV_KHR_maximal_reconvergence\0\0\0"
    # After the only capability.
    words[7:7] = array.array(
        "I", [(len(name) // 4 + 1) << 16 | 10, *struct.unpack(f"<{len(name) // 4}I", name)]
    )
    (tmp_path / "own.spv").write_bytes(words.tobytes())
    with pytest.raises(
        UnusableOwnShader,
        match="needs the extension `SPV_KHR_maximal_reconvergence`, which is not supported",
    ):
        own_shader(str(tmp_path / "own.spv"))


def test_the_gate_refuses_shaders_that_do_not_fit(plain: Session, tmp_path: Path) -> None:
    """As where another sample count makes an input attachment multisampled."""
    made = plan_of(tmp_path, spirv(COLOR + LOADS), INPUTS.replace("SAMPLES", "4"))
    assert gate(made, plain.device) == {
        0: "the shader of own reads input attachment 0 at set 0, binding 0, whose image has 4 "
        "samples"
    }
    assert gate(supported(made, plain.device), plain.device) == {}


def test_every_feature_that_capabilities_need_is_enabled_or_of_the_first_version(
    plain: Session,
) -> None:
    enabled = set().union(*shader_features.ENABLED.values())
    for feature in shader_features.FEATURES.values():
        assert (
            feature in plain.device["features"]
            or feature in enabled
            or feature in shader_features.SUBGROUPS
        ), feature
    for structure, names in shader_features.ENABLED.items():
        assert names <= plain.device[structure].keys(), structure


# GLSL


def test_glsl_is_compiled(tmp_path: Path) -> None:
    path = tmp_path / "own.frag"
    # Neither the input nor the image states a location or a binding.
    path.write_text(
        HEAD
        + "uniform sampler2D t;\nin vec2 uv;\n"
        + COLOR
        + "void main() { color = texture(t, uv); }\n"
    )
    vertex, fragment = own_shader(str(path))
    assert (vertex.stage, fragment.stage, [each.type for each in fragment.descriptors]) == (
        1,
        16,
        [1],
    )


def test_the_first_error_of_the_compiler_is_told_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "own.frag"
    path.write_text(HEAD + COLOR + "void main() {\n    color = vec4(missing);\n}\n")
    with pytest.raises(
        UnusableOwnShader,
        match=r"own.frag` cannot be used: line 4: 'missing' : undeclared identifier$",
    ):
        own_shader(str(path))


def test_glslc_is_used_where_it_is_the_only_compiler(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, bin = tmp_path / "own.frag", tmp_path / "bin"
    path.write_text(HEAD)
    bin.mkdir()
    program = bin / "glslc"
    program.write_text(
        f"#!/bin/sh\necho \"$*\" > {tmp_path}/arguments\necho '{path}:7: error: '\"'x'\"' : wrong' "
        ">&2\nexit 1\n"
    )
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(bin))
    with pytest.raises(UnusableOwnShader, match="line 7: 'x' : wrong"):
        own_shader(str(path))
    assert (
        "-fshader-stage=fragment" in (tmp_path / "arguments").read_text()
        and str(path) in (tmp_path / "arguments").read_text()
    )


def test_without_a_compiler_the_message_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "own.frag").write_text(HEAD)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(
        UnusableOwnShader, match="no compiler is installed: install glslangValidator or glslc"
    ):
        own_shader(str(tmp_path / "own.frag"))


@pytest.mark.parametrize(
    ("name", "data", "reason"),
    [
        ("own.spv", b"#version 450", "cannot be used: it is not SPIR-V"),
        (
            "own.hlsl",
            b"float4 main() : SV_Target { return 1; }",
            "only SPIR-V and GLSL are supported: compile it to SPIR-V",
        ),
        (
            "own.spv",
            struct.pack("<5I", 0x07230203, 0x10000, 0, 1, 0),
            "cannot be used: it has no fragment shader",
        ),
        (
            "own.spv",
            spirv("void main() { gl_Position = vec4(0); }", stage="vert"),
            "cannot be used: it has no fragment shader",
        ),
        ("none.spv", None, "cannot be read: No such file or directory"),
        ("own.spv", bytes(5 << 20), "cannot be read"),
    ],
)
def test_files_that_cannot_be_used(
    tmp_path: Path, name: str, data: bytes | None, reason: str
) -> None:
    if data is not None:
        (tmp_path / name).write_bytes(data)
    with pytest.raises(UnusableOwnShader, match=reason):
        own_shader(str(tmp_path / name))


# The generated vertex shader

TYPES = (
    "float",
    "vec2",
    "vec3",
    "vec4",
    "int",
    "ivec2",
    "uint",
    "uvec3",
    "uvec4",
    "mat2",
    "mat3",
    "mat4x2",
    "vec2[3]",
    "mat2[2]",
    "int[2]",
)


@pytest.fixture(scope="module")
def scratch(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    yield tmp_path_factory.mktemp("vertex")


@examples(0.2)
@given(
    types=st.lists(st.sampled_from(TYPES), max_size=5),
    block=st.lists(st.sampled_from(TYPES), max_size=3),
)
def test_the_vertex_shader_is_valid_and_writes_every_input(
    scratch: Path, types: list[str], block: list[str]
) -> None:
    declared = [
        (kind, "flat " if "int" in kind or kind.startswith(("i", "u")) else "") for kind in types
    ]
    lines = [f"layout(location = {8 * n}) {flat}in {kind.partition('[')[0]} "
        f"i{n}{kind[len(kind.partition('[')[0]):]};"
             for n, (kind, flat) in enumerate(declared)]  # fmt: skip
    members = " ".join(
        f"flat {kind.partition('[')[0]} m{n}{kind[len(kind.partition('[')[0]) :]};"
        for n, kind in enumerate(block)
    )
    lines += [f"layout(location = 48) in Block {{ {members} }} block;"] if block else []
    module = Module(spirv("\n".join(lines) + "\n" + COLOR + "void main() { color = vec4(0); }"))
    constants = Constants(module, {})
    found = interface(module, module.entry("main"), constants)
    code = vertex_shader(found, Layouts(module, constants))
    (scratch / "made.spv").write_bytes(code)
    validate(scratch / "made.spv")
    made = Module(code)
    outputs = interface(made, made.entry("main"), Constants(made, {})).outputs
    assert [(each.location, each.component, each.type) for each in outputs] == [
        (each.location, each.component, each.type) for each in found.inputs
    ]


def test_contents_are_small_in_a_plan(tmp_path: Path) -> None:
    (tmp_path / "own.spv").write_bytes(
        spirv(
            COLOR
            + "layout(binding = 0) uniform U { mat4 m[1000]; };\nvoid main() { color = m[7][1]; }"
        )
    )
    (descriptor,) = own_shader(str(tmp_path / "own.spv"))[1].descriptors
    assert (
        descriptor.size,
        len(unpacked(descriptor.contents)),
        len(descriptor.contents) < 1000,
    ) == (64000, 64000, True)

"""What an entry point takes from outside and hands on, as SPIR-V from a compiler declares it."""

from __future__ import annotations

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.frame.spirv.bindings import Descriptor, ImageType
from msaa_lint.frame.spirv.constants import Constants
from msaa_lint.frame.spirv.interface import Interface, interface
from msaa_lint.frame.spirv.layouts import Layouts
from msaa_lint.frame.spirv.module import Module
from msaa_lint.frame.spirv.words import SpirvError
from tests.frame.spirv.test_hostile import assembled
from tests.glsl import spirv
from tests.strength import examples

COLOR = "layout(location = 0) out vec4 color;\n"


def reflected(code: bytes, specialization: dict[int, float] | None = None) -> Interface:
    module = Module(code)
    return interface(module, module.entry("main"), Constants(module, specialization or {}))


def only(text: str, **options: str) -> Descriptor:
    """The only descriptor of a shader."""
    (found,) = reflected(spirv(text, **options)).descriptors
    return found


FLOAT_2D = ImageType("2D", "float", False, False, False, 0)


@pytest.mark.parametrize(
    ("declared", "used", "kind", "image"),
    [
        ("uniform sampler2D t", "texture(t, vec2(0))", "COMBINED_IMAGE_SAMPLER", FLOAT_2D),
        ("uniform isampler2D t", "vec4(texture(t, vec2(0)))", "COMBINED_IMAGE_SAMPLER",
        FLOAT_2D._replace(component="int")),
        ("uniform usampler2DArray t", "vec4(texture(t, vec3(0)))", "COMBINED_IMAGE_SAMPLER",
         ImageType("2D", "uint", False, True, False, 0)),
        ("uniform sampler1D t", "texture(t, 0)", "COMBINED_IMAGE_SAMPLER",
        FLOAT_2D._replace(dimension="1D")),
        ("uniform sampler3D t", "texture(t, vec3(0))", "COMBINED_IMAGE_SAMPLER",
        FLOAT_2D._replace(dimension="3D")),
        ("uniform samplerCube t", "texture(t, vec3(1))", "COMBINED_IMAGE_SAMPLER",
        FLOAT_2D._replace(dimension="CUBE")),
        ("uniform samplerCubeArray t", "texture(t, vec4(1))", "COMBINED_IMAGE_SAMPLER",
        ImageType("CUBE", "float", False, True, False, 0)),
        ("uniform sampler2DShadow t", "vec4(texture(t, vec3(0)))", "COMBINED_IMAGE_SAMPLER",
        FLOAT_2D._replace(depth=True)),
        ("uniform sampler2DMS t", "texelFetch(t, ivec2(0), 1)", "COMBINED_IMAGE_SAMPLER",
        FLOAT_2D._replace(multisampled=True)),
        ("uniform sampler2DMSArray t", "texelFetch(t, ivec3(0), 1)", "COMBINED_IMAGE_SAMPLER",
         ImageType("2D", "float", False, True, True, 0)),
        ("uniform texture2D t", "texelFetch(t, ivec2(0), 0)", "SAMPLED_IMAGE", FLOAT_2D),
        ("uniform samplerBuffer t", "texelFetch(t, 0)", "UNIFORM_TEXEL_BUFFER",
        FLOAT_2D._replace(dimension="BUFFER")),
        ("uniform textureBuffer t", "texelFetch(t, 0)", "UNIFORM_TEXEL_BUFFER",
        FLOAT_2D._replace(dimension="BUFFER")),
        ("rgba16f) uniform image2D t", "imageLoad(t, ivec2(0))", "STORAGE_IMAGE",
        FLOAT_2D._replace(format=2)),
        ("r32ui) uniform uimage3D t", "vec4(imageLoad(t, ivec3(0)))", "STORAGE_IMAGE",
        ImageType("3D", "uint", False, False, False, 33)),
        ("rgba8) uniform imageBuffer t", "imageLoad(t, 0)", "STORAGE_TEXEL_BUFFER",
        ImageType("BUFFER", "float", False, False, False, 4)),
        ("input_attachment_index = 2) uniform subpassInput t", "subpassLoad(t)", "INPUT_ATTACHMENT",
         FLOAT_2D._replace(dimension="SUBPASS")),
        ("input_attachment_index = 2) uniform subpassInputMS t", "subpassLoad(t, 0)",
        "INPUT_ATTACHMENT",
         ImageType("SUBPASS", "float", False, False, True, 0)),
    ],
)  # fmt: skip
def test_images(declared: str, used: str, kind: str, image: ImageType) -> None:
    qualifiers, _, variable = declared.rpartition(") ")
    stated = f", {qualifiers}" if qualifiers else ""
    text = (
        "#extension GL_EXT_samplerless_texture_functions : enable\nlayout(set = 1, binding = "
        f"3{stated}) {variable};\n{COLOR}"
    )
    found = only(text + f"void main() {{ color = {used}; }}")
    assert (found.set, found.binding, found.kind, found.length, found.image) == (
        1,
        3,
        kind,
        1,
        image,
    )
    assert found.attachment == (2 if kind == "INPUT_ATTACHMENT" else 0)
    assert found.compares == (image.depth is True) and not found.writes


BLOCKS = """
struct Light { vec3 position; float radius; mat3x4 turn; };
layout(constant_id = 5) const int LIGHTS = 3;
layout(set = 0, binding = 0) uniform Scene { mat4 view; layout(row_major) mat3x2 other; Light lights[LIGHTS]; int count; } scene;
layout(set = 0, binding = 1) readonly buffer Nodes { uint first; Light nodes[]; } nodes[2];
layout(push_constant) uniform Push { layout(offset = 16) vec4 tint; mat2 turn; };
"""


def test_blocks_have_the_sizes_that_their_offsets_give() -> None:
    use = (
        "color = scene.view[0] + scene.lights[1].position.xyzx + tint + nodes[1].nodes[2].radius "
        "+ turn[0].xyxy;"
    )
    code = spirv(BLOCKS + COLOR + f"void main() {{ {use} }}")
    found = reflected(code)
    scene, nodes = found.descriptors
    # std140: 64 bytes, 2 rows of 16 bytes, 3 lights of 64 bytes, an integer.
    assert (scene.kind, scene.length, scene.size, scene.stride) == (
        "UNIFORM_BUFFER",
        1,
        64 + 32 + 3 * 64 + 4,
        0,
    )
    assert (nodes.kind, nodes.length, nodes.size, nodes.stride) == ("STORAGE_BUFFER", 2, 16, 64)
    assert (nodes.reads, nodes.writes) == (True, False)
    # std430: the columns of a mat2 are 8 bytes apart.
    assert found.push_size == 16 + 16 + 16
    assert found.specialization == {5: "int"}
    # The offset of the integer stays.
    assert reflected(code, {5: 10}).descriptors[0].size == 64 + 32 + 10 * 64


def test_arrays_of_descriptors_have_the_sizes_of_constants() -> None:
    text = (
        "layout(constant_id = 0) const int N = 4;\nlayout(set = 0, binding = 0) uniform sampler2D "
        "t[N][3];\n" + COLOR
    )
    code = spirv(text + "void main() { color = texture(t[1][2], vec2(0)); }")
    assert [reflected(code, values).descriptors[0].length for values in ({}, {0: 7})] == [12, 21]
    bindless = (
        "#extension GL_EXT_nonuniform_qualifier : enable\nlayout(set = 0, binding = 0) uniform "
        "sampler2D t[];\n" + COLOR
    )
    found = only(
        bindless
        + "layout(location = 0) flat in int n;\nvoid main() { color = texture(t[nonuniformEXT(n)], "
        "vec2(0)); }"
    )
    assert (found.kind, found.length) == ("COMBINED_IMAGE_SAMPLER", 0)


def test_only_what_the_entry_point_uses_is_told() -> None:
    """Before SPIR-V 1.4, a module's interface does not list descriptors."""
    text = (
        "layout(binding = 0) uniform sampler2D a, b;\nlayout(binding = 1) uniform U { vec4 v; };\n"
        + COLOR
        + "vec4 unused() { return texture(b, vec2(0)); }\nvec4 used() { return v; }\nvoid main() { "
        "color = used(); }"
    )
    for environment in ("vulkan1.0", "vulkan1.1", "vulkan1.2", "vulkan1.3"):
        assert only(text, environment=environment).kind == "UNIFORM_BUFFER", environment


def test_separate_samplers_are_known_by_what_they_sample() -> None:
    text = """
layout(binding = 0) uniform texture2D colors;
layout(binding = 1) uniform utexture2D numbers;
layout(binding = 2) uniform texture2D shadows;
layout(binding = 3) uniform sampler plain;
layout(binding = 4) uniform sampler nearest;
layout(binding = 5) uniform samplerShadow comparing;
float shadow(texture2D image, samplerShadow with) { return texture(sampler2DShadow(image, with), vec3(0.5)); }
void main() {
    color = texture(sampler2D(colors, plain), vec2(0)) + texture(usampler2D(numbers, nearest), vec2(0)) + shadow(shadows, comparing);
}
"""
    found = reflected(spirv(COLOR + text)).descriptors
    assert [(each.compares, each.unfiltered) for each in found] == [
        (False, False), (False, False), (True, False), (False, False), (False, True), (True, False),
    ]  # fmt: skip


def test_what_is_stored_is_told() -> None:
    text = """
layout(binding = 0, r32ui) uniform uimage2D counted;
layout(binding = 1, rgba8) uniform writeonly image2D written;
layout(binding = 2) buffer A { uint a[]; };
layout(binding = 3) buffer B { uint b; };
layout(binding = 4, rgba8) uniform readonly image2D read;
void count(inout uint n) { atomicAdd(b, n); }
void main() {
    uint n = imageAtomicAdd(counted, ivec2(0), 1u);
    imageStore(written, ivec2(0), vec4(1));
    a[n] = 2u;
    count(n);
    color = imageLoad(read, ivec2(0));
}
"""
    found = reflected(spirv(COLOR + text)).descriptors
    assert [(each.reads, each.writes) for each in found] == [
        (True, True),
        (False, True),
        (False, True),
        (True, True),
        (True, False),
    ]


def test_inputs_outputs_and_how_they_are_interpolated() -> None:
    text = """
layout(location = 0) in vec3 normal;
layout(location = 1) flat in ivec2 material;
layout(location = 2) centroid noperspective in vec2 place;
layout(location = 3) sample in mat3 tangent;
layout(location = 6, component = 2) in float last;
layout(location = 7) in vec4 weights[2];
layout(location = 9) in Block { vec2 a; flat uint b; } block;
layout(location = 0) out vec4 color;
layout(location = 1) out uvec2 other;
layout(location = 0, index = 1) out vec4 second;
void main() {
    color = normal.xyzx + place.xyxy + tangent[1].xyzx + last + weights[1] + block.a.xyxy + float(gl_PrimitiveID) + gl_FragCoord;
    other = uvec2(material) + block.b;
    second = color;
}
"""
    found = reflected(spirv(text))
    assert [(each.location, each.component, each.type,
    each.interpolation) for each in found.inputs] == [
        (0, 0, "vec3", set()), (1, 0, "ivec2", {"flat"}), (2, 0, "vec2", {"centroid",
        "noperspective"}), (3, 0, "mat3x3", {"sample"}),
        (6, 2, "float", set()), (7, 0, "vec4[2]", set()), (9, 0, "struct", {"flat"}),
    ]  # fmt: skip
    assert found.built_ins == {7: 1, 15: 1}
    assert [(each.location, each.blend_index, each.type) for each in found.outputs] == [
        (0, 0, "vec4"),
        (0, 1, "vec4"),
        (1, 0, "uvec2"),
    ]


@pytest.mark.parametrize(
    ("environment", "version"),
    [("vulkan1.0", (1, 0)), ("vulkan1.1", (1, 3)), ("vulkan1.2", (1, 5)), ("vulkan1.3", (1, 6))],
)
def test_versions_and_capabilities(environment: str, version: tuple[int, int]) -> None:
    found = reflected(
        spirv(COLOR + "void main() { color = vec4(gl_SampleID); }", environment=environment)
    )
    assert found.version == version and {1, 35} <= found.capabilities


def test_pointers_to_buffers_are_refused() -> None:
    text = """#extension GL_EXT_buffer_reference : enable
layout(buffer_reference) buffer Node { vec4 v; };
layout(push_constant) uniform P { Node node; };
void main() { color = node.v; }
"""
    with pytest.raises(SpirvError, match="a block has pointers to buffers"):
        reflected(spirv(text.replace("void", COLOR + "void")))


# Hostile modules


def hostile(
    *types: tuple[int, ...], holds: int, decorations: tuple[tuple[int, ...], ...] = ()
) -> bytes:
    """A module whose entry point loads a uniform block of a type."""
    start = ((15, 4, 1, 0x6E69616D, 0), (71, 50, 34, 0), (71, 50, 33, 0), *decorations)
    common = ((19, 2), (33, 3, 2), (21, 4, 32, 0), (22, 5, 32))
    return assembled(
        *start, *common, *types, (32, 40, 2, holds), (59, 40, 50, 2), (54, 2, 1, 0, 3), (248, 10),
        (61, holds, 60, 50), (253,), (56,)
    )  # fmt: skip


def test_a_huge_array_is_refused_and_not_built() -> None:
    huge = ((43, 4, 6, 0x7FFFFFFF), (28, 7, 5, 6), (30, 8, 7))
    strides = ((71, 7, 6, 4), (72, 8, 0, 35, 0))
    with pytest.raises(SpirvError, match="larger than 16 MiB"):
        reflected(hostile(*huge, holds=8, decorations=strides))


def test_structures_of_structures_are_counted_once() -> None:
    """2 to the power of 14 members of 4 bytes."""
    types, decorations, inner = [], [], 5
    for number in range(100, 114):
        types.append((30, number, inner, inner))
        decorations += [(72, number, 0, 35, 0), (72, number, 1, 35, 4 << number - 100)]
        inner = number
    module = Module(hostile(*types, holds=113, decorations=tuple(decorations)))
    assert (
        interface(module, module.entry("main"), Constants(module, {})).descriptors[0].size
        == 4 << 14
    )


def test_an_image_of_no_numbers_is_refused() -> None:
    code = spirv(
        "layout(binding = 0) uniform sampler2D t;\n"
        + COLOR
        + "void main() { color = texture(t, vec2(0)); }"
    )
    words = list(struct.unpack(f"<{len(code) // 4}I", code))
    # Of OpTypeImage the component type, here OpTypeVoid.
    image = next(at for at, word in enumerate(words) if word == 9 << 16 | 25)
    words[image + 2] = words[next(at for at, word in enumerate(words) if word == 2 << 16 | 19) + 1]
    with pytest.raises(SpirvError, match="components of an unknown type"):
        reflected(struct.pack(f"<{len(words)}I", *words))


def test_a_structure_in_itself_is_refused() -> None:
    with pytest.raises(SpirvError, match="nested too deeply"):
        reflected(hostile((30, 8, 8), holds=8, decorations=((72, 8, 0, 35, 0),)))


@examples(2)
@given(
    st.lists(st.tuples(st.integers(5, 10**6), st.integers(0, 2**32 - 1)), min_size=1, max_size=6)
)
def test_a_damaged_module_is_read_or_refused(damage: list[tuple[int, int]]) -> None:
    words = list(struct.unpack(f"<{len(DAMAGED) // 4}I", DAMAGED))
    for at, value in damage:
        words[5 + at % (len(words) - 5)] = value if value % 3 else value % 200
    try:
        module = Module(struct.pack(f"<{len(words)}I", *words))
        found = reflected(struct.pack(f"<{len(words)}I", *words))
        Layouts(module, Constants(module, {}))
        assert all(each.size <= 16 << 20 for each in found.descriptors)
    except SpirvError:
        pass


DAMAGED = spirv(
    BLOCKS
    + COLOR
    + "layout(location = 0) in mat3 m[2];\nlayout(binding = 2) uniform sampler2DShadow s;\n"
    "void main() { color = scene.lights[1].position.xyzx + tint + nodes[1].nodes[2].radius + "
    "m[1][0].xyzx + texture(s, m[0][1]); }"
)

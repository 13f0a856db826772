"""Source code made to take long, to nest deeply, or to break the readers: a limit ends it with a
finding, and nothing else does.
"""

from __future__ import annotations

import contextlib
import random
from collections.abc import Iterator
from itertools import product
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from msaa_lint.core.text.source import Unreadable
from msaa_lint.input.code.core.limits import BASE_STEPS, MAX_CHARACTERS, STEPS_PER_CHARACTER
from msaa_lint.input.code.parsing import Code, ascii_only, tree
from msaa_lint.input.source_file import SourceFile, read_source_file
from tests.benchmarks.shapes.shape import Shape
from tests.benchmarks.shapes.source import SHAPES
from tests.command import run
from tests.paths import ROOT

BY_NAME = {shape.name: shape for shape in SHAPES}
IMAGE = """\
    VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.samples = VK_SAMPLE_COUNT_4_BIT;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
"""
CREATE = "    vkCreateImage(device, &info, nullptr, &image);\n"
SWIFT = """\
import Metal
class Renderer {
    func setup(device: MTLDevice, f: (Int) -> Int) {
        let d = MTLTextureDescriptor()
        d.textureType = .type2DMultisample
        d.sampleCount = 4
"""
GLSL = """\
#version 450
layout(binding = 0) uniform sampler2DMS image;
layout(location = 0) out vec4 color;
"""
MAIN = (
    "void main() {{\n    vec4 s = texelFetch(image, ivec2(gl_FragCoord.xy), 0);\n{}\n    color "
    "= s;\n}}\n"
)


def source(text: str, language: str = "cpp") -> SourceFile:
    return read_source_file(text.encode("utf-8", "surrogatepass"), f"a.{language}", language)


def function(body: str) -> str:
    return f"void setup() {{\n{IMAGE}{body}\n{CREATE}}}\n"


def images(file: SourceFile) -> list[str]:
    return [name for document in file.program.documents for name in document.description.images]


def unread(file: SourceFile) -> list[str]:
    return [part.message for part in file.program.unread]


def steps(text: str) -> str:
    limit = BASE_STEPS + STEPS_PER_CHARACTER * len(text)
    return (
        f"following the code takes more than {limit} steps, the limit for code of this length; "
        "what it creates is not checked"
    )


@pytest.mark.parametrize(
    "name", ["C++: conditional structures", "C++: doubled lists", "C++: conditional copies"]
)
def test_values_that_double_end_with_a_finding(name: str, tmp_path: Path) -> None:
    BY_NAME[name].write(tmp_path, 60)
    text = (tmp_path / "a.cpp").read_text()
    ended = run(tmp_path, "check", "--isolated", "a.cpp", "--output", "concise")
    assert ended.returncode == 2
    line = text[: text.index("void setup")].count("\n") + 1
    assert f"a.cpp:{line}:6: error[limit-exceeded] {steps(text)} (MSAA906)" in ended.stdout


def test_a_swift_file_that_exceeds_the_limit_is_a_finding() -> None:
    closures = "".join(
        f"        let f{n + 1} = {{ (x: Int) in [{', '.join([f'f{n}(x)'] * 20)}] }}\n"
        for n in range(8)
    )
    text = (
        f"{SWIFT}        let f0 = {{ (x: Int) in x }}\n{closures}        d.sampleCount = f8(4)\n"
        f"    }}\n}}\n"
    )
    file = source(text, "swift")
    assert unread(file) == [steps(text)]
    assert text[file.program.unread[0].at.start :].startswith("func setup")
    assert file.program.documents == ()


def test_what_a_limit_ends_is_said_by_convert_and_facts(tmp_path: Path) -> None:
    BY_NAME["C++: doubled lists"].write(tmp_path, 60)
    for command in ("convert", "facts"):
        ended = run(tmp_path, command, "a.cpp")
        assert (
            ended.returncode,
            "a.cpp:1: following the code takes more than" in ended.stderr,
        ) == (2, True)


def test_a_file_beside_one_that_exceeds_a_limit_is_checked(tmp_path: Path) -> None:
    BY_NAME["C++: doubled lists"].write(tmp_path, 60)
    other = (ROOT / "tests/input/code/corpus/resolve_command.cpp").read_text()
    (tmp_path / "b.cpp").write_text(other)
    ended = run(tmp_path, "check", "--isolated", "a.cpp", "b.cpp", "--output", "concise")
    assert ended.returncode == 2
    assert {line.partition(":")[0] for line in ended.stdout.splitlines() if ": " in line} >= {
        "a.cpp",
        "b.cpp",
    }


def test_long_conditions_are_read() -> None:
    """Each `||` was written into the text of the next, with its quotes escaped once more."""
    text = function(
        f"    if (flag{' || flag'.join(map(str, range(100)))}) info.samples = "
        "VK_SAMPLE_COUNT_2_BIT;\n"
    )
    assert (images(source(text)), unread(source(text))) == (["image"], [])
    chain = "".join(f"    bool on{n + 1} = !(on{n} || !(flag{n} && !on{n}));\n" for n in range(60))
    assert images(
        source(
            function(
                f"    bool on0 = flag;\n{chain}    if (on60) info.samples = "
                "VK_SAMPLE_COUNT_2_BIT;\n"
            )
        )
    ) == ["image"]


def test_arguments_are_evaluated_once() -> None:
    """Nested calls of functions elsewhere evaluated each argument twice, so that thirty of them
    took 2^30 evaluations.
    """
    text = function(
        f"    use({'f(' * 60}x{')' * 60});\n    "
        "use(a().b.c().d.e().f.g().h.i().j.k().l.m().n.o().p);\n"
    )
    assert (images(source(text)), unread(source(text))) == (["image"], [])


def test_source_code_that_is_too_long_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.cpp").write_text("// samples\n" + " " * MAX_CHARACTERS)
    ended = run(tmp_path, "check", "--isolated", "a.cpp", "--output", "concise")
    message = (
        f"source code is read up to {MAX_CHARACTERS} characters, and this file has "
        f"{MAX_CHARACTERS + 11}"
    )
    assert (ended.returncode, message in ended.stdout) == (2, True)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (
            "s = " + "(" * 90 + "s" + ")" * 90 + ";",
            "an expression of the shader nests more than 80 levels deep",
        ),
        ("{" * 70 + "}" * 70, "the blocks of the shader nest more than 60 levels deep"),
        ("\n".join(f"#define M{n} {n}" for n in range(501)), "the shader has more than 500 macros"),
        (
            "#define A0 1.0\n"
            + "".join(f"#define A{n + 1} A{n} + A{n}\n" for n in range(15))
            + "s *= A15 + A15 + A15;",
            "the macros of the shader expand to more than 131072 characters in a line, or 1048576 "
            "in all",
        ),
    ],
)
def test_limits_of_shaders_are_findings(body: str, message: str) -> None:
    assert unread(source(GLSL + MAIN.format(body), "glsl")) == [
        f"{message}; the shader is not checked"
    ]


def test_the_fifty_first_shader_of_a_page_is_said_to_be_unread() -> None:
    page = ("```glsl\n" + GLSL + MAIN.format("") + "```\n\n\n\ntext\n\n\n\n") * 51
    file = source(page, "markdown")
    assert (len(file.program.documents), unread(file)) == (
        50,
        ["only the first 50 shaders of a page are checked"],
    )


def test_overloads_and_methods_are_found_by_their_class() -> None:
    """The same answers as before functions were indexed: of the class, else of the namespace, and
    none where two match.
    """
    make = "{ " + " ".join(IMAGE.split()) + " " + CREATE.strip() + " }\n"
    others = "".join(
        f"struct K{n} {{ void make(int n) {{}} void other() {{ make(1); }} }};\n" for n in range(50)
    )
    text = (
        f"{others}struct K {{ void make(int n) {make} void other() {{ make(1); }} }};\nvoid "
        f"make(int n) {{}}\n"
    )
    assert len(images(source(text))) == 1
    assert (
        len(
            images(
                source(
                    f"namespace a {{ void make(int n) {make} }}\nvoid setup() {{ a::make(1); }}\n"
                )
            )
        )
        == 1
    )


EXTREMES = [
    "info.mipLevels = 0x" + "f" * 5000 + ";", "if (n == 0x" + "f" * 5000 + ") info.samples = 2;",
    f"int q[{'1' * 5000}];",
    "VkImage q[1 << 40];", "VkImage q[99999999999]; q[99999999998] = 0; q[-1] = 0; q[UNKNOWN] = 1;",
    "VkAttachmentDescription q[] = {[-1] = {}, [UNKNOWN] = {}, [1 << 40] = {}, [64] = {}, [65] = "
    "{}};",
    "VkAttachmentDescription q = {[3] = 1, .a[2].b = 3, . = 1, [] = 2};", "int x = 1 << 9999; x = "
        "1 << -1; x = 1 / 0; x = 1 % 0; x = -x;",
    "float x = 1e999; info.minSampleShading = x * 0; x = x - x;", "info.pNext = &info; info = "
        "info; info = {{{info}}};",
    "auto l = [&](auto l) { l(l); }; l(l);", "memset(); memset(&info, 0); min(1); max(); size(); "
        "make_array(); to_array({});",
    "vkCreateImage(); vkCreateImage(d); vkCmdResolveImage(); vkCmdResolveImage2(); "
    "resolveImage2(); bindMemory();",
    "info.setSamples(); info.setSamples(1, 2); info.set();", "q.push_back(); q.at(); q.back(); "
        "q.resize(-1); q.assign();",
    "std::vector<VkImage> q(-1), w(99999999999), e(3, 1, 2); q.at(9) = 1; q.back() = 1;", "goto x; "
        "x: goto x; throw; return {};",
    "switch (n) {} switch (n) { case 1 ... 5:; default:; default:; }", "int* p = &p; *p = *p; **p "
        "= 1; p++; p++;",
    "info.samples = VK_SAMPLE_COUNT_65_BIT; info.samples = vk::SampleCountFlagBits::e; info.usage "
    "= 1 | 2.5;",
]  # fmt: skip


@pytest.mark.parametrize("body", EXTREMES)
@pytest.mark.parametrize("language", ["c", "cpp"])
def test_extreme_values_are_unknown(body: str, language: str) -> None:
    for text in (
        function(body),
        f"class A {{\nint m = 0x{'f' * 5000};\nVkImage image;\n{function(body)}}};\n",
    ):
        assert unread(source(text, language)) == []


BUILT_INS = [
    "texelFetch",
    "texelFetchOffset",
    "imageLoad",
    "subpassLoad",
    "textureSamples",
    "imageSamples",
    "imageStore",
    "imageAtomicAdd",
    "textureSize",
    "texture",
    "min",
    "fma",
    "mix",
    "clamp",
    "smoothstep",
    "modf",
    "frexp",
    "length",
    "dot",
    "any",
    "bitCount",
    "lessThan",
    "not",
    "pow",
    "barrier",
    "interpolateAtSample",
    "vec2",
    "vec4",
    "mat4",
    "int",
    "float",
    "bool",
    "sampler2D",
    "sampler2DMS",
    "packUnorm4x8",
]
ARGUMENTS = [
    "",
    "image",
    "s",
    "1",
    "image, 1",
    "image, ivec2(0)",
    "image, ivec2(0), 0, 0",
    "s, s",
    "s, s, s",
    "true, false",
    "image, s",
    "s,",
]


@pytest.mark.parametrize("name", BUILT_INS)
def test_built_ins_with_any_arguments_are_read_or_left_out(name: str) -> None:
    for arguments, form in product(ARGUMENTS, ("s += vec4({}({}));", "{}({});")):
        assert unread(source(GLSL + MAIN.format(form.format(name, arguments)), "glsl")) == []
        assert (
            unread(source(GLSL + f"void main() {{ color = vec4({name}({arguments})); }}\n", "glsl"))
            == []
        )


NESTED = {
    "cpp": (
        "(",
        "{",
        "f(",
        "[&]{",
        "if(x){",
        "x?1:",
        "!",
        "*",
        "a.",
        "a->",
        "a+",
        "a=",
        "(int)",
        "for(;;)",
        "do ",
        "a||(b&&",
        "a<",
        "&x[",
        "new ",
    ),
    "glsl": (
        "(",
        "{",
        "vec4(",
        "s[",
        "if(true){",
        "true?s:",
        "-",
        "s+",
        "s=",
        "for(;;){",
        "true&&(",
    ),
    "swift": (
        "(",
        "{",
        "[",
        "f(",
        "f{",
        "if x{",
        "x?1:",
        "!",
        "a.",
        "a?.",
        "a+",
        "for x in y{",
        "func f(){",
        "if x{}else ",
        "a??",
        "try ",
    ),
}
CLOSING = {"(": ")", "{": "}", "[": "]"}


@pytest.mark.parametrize(
    ("language", "opening"),
    [(language, opening) for language, every in NESTED.items() for opening in every],
)
def test_nothing_nests_too_deeply_to_end(language: str, opening: str) -> None:
    closing = "".join(CLOSING[sign] for sign in reversed(opening) if sign in CLOSING)
    for count in (50, 2000):
        nested = (
            opening * count + {"cpp": "x", "glsl": "s", "swift": "x"}[language] + closing * count
        )
        place = {
            "cpp": function("@;"),
            "glsl": GLSL + MAIN.format("@;"),
            "swift": f"{SWIFT}        @\n    }}\n}}\n",
        }[language]
        for text in (place.replace("@", "x = " + nested), nested + "\n" + place.replace("@", "")):
            with contextlib.suppress(Unreadable):
                source(text, language)


def _texts(text: str) -> Iterator[str]:
    yield from (
        text.replace("\n", "\r\n"),
        text.replace("\n", "\r"),
        "\ufeff" + text,
        text.replace("a", "\0"),
        text[::-1],
    )
    yield from (
        text.replace("samples", "\u0430samples"),
        text.replace(" ", "\u202e"),
        text + "\0" * 100,
        text[: len(text) // 2],
    )
    yield from (
        "/*" + text,
        '"' + text,
        'R"(' + text,
        "#if 0\n" + text,
        "x" * 100_000 + text,
        text.replace("\n", "\\\n"),
    )


@pytest.mark.parametrize("language", ["cpp", "c", "glsl", "swift", "objc"])
def test_any_text_is_read(language: str) -> None:
    text = {"glsl": GLSL + MAIN.format(""), "swift": SWIFT + "    }\n}\n"}.get(
        language, function("")
    )
    for changed in _texts(text):
        source(changed, language)


CORPUS = {
    "cpp": sorted((ROOT / "tests/input/code/corpus").glob("*.cpp")),
    "c": sorted((ROOT / "tests/input/code/corpus").glob("*.c")),
    "objc": sorted((ROOT / "tests/input/code/objc").glob("*.m")),
    "objcpp": sorted((ROOT / "tests/input/code/objc").glob("*.mm")),
    "swift": sorted((ROOT / "tests/input/code/swift").glob("*.swift")),
    "glsl": sorted((ROOT / "tests/frame/spirv/shaders").glob("*.frag")),
}


EXPRESSIONS = (
    "-1",
    "1/0",
    "1<<99",
    "{}",
    "()",
    "x[1<<40]",
    "\0",
    "textureSamples()",
    ".",
    "::",
    "self",
)


def mutated(text: str, language: str, change: random.Random) -> str:
    """The text with nodes of its syntax tree deleted, repeated, exchanged, emptied, or replaced."""
    for _ in range(change.choice((1, 1, 2, 4))):
        root = tree(Code(ascii_only(text), language)).root_node
        nodes = [root]
        for node in nodes:
            nodes += node.children
        one, other = (change.choice(nodes) for _ in range(2))
        start, end = one.start_byte, one.end_byte
        part, another = text[start:end], text[other.start_byte : other.end_byte]
        separator = change.choice(("", " ", ",", ";"))
        new = change.choice(
            ("", part + separator + part, another, part[:1] + part[-1:], change.choice(EXPRESSIONS))
        )
        text = (text[:start] + new + text[end:])[:40_000]
    return text


@pytest.mark.parametrize("language", CORPUS)
@given(seed=st.integers(0, 2**32))
@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_mutated_syntax_is_read(language: str, seed: int) -> None:
    change = random.Random(seed)
    text = change.choice(CORPUS[language]).read_text(encoding="utf-8")
    source(mutated(text, language, change), language)


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
def test_shapes_end_with_a_result_or_a_limit(shape: Shape, tmp_path: Path) -> None:
    shape.write(tmp_path, 40)
    ended = run(tmp_path, *shape.arguments)
    assert ended.returncode in shape.codes
    assert "internal error" not in ended.stdout + ended.stderr


def test_calls_that_are_not_repeated_cost_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # `recreate` calls what `initialize` has called; once much of the work is done, such calls are
    # not followed again.
    monkeypatch.setattr("msaa_lint.input.code.core.calls.MAX_REPEATED_STEPS", 0)
    program = tmp_path / "targets.cpp"
    program.write_text("""#include <vulkan/vulkan.h>
class Targets {
public:
    void initialize() { createDepth(); }
    void recreate() { createDepth(); }
    void draw(VkCommandBuffer commands) {
        VkRenderingAttachmentInfo depth = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        depth.imageView = depthView;
        depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        VkRenderingInfo info = {VK_STRUCTURE_TYPE_RENDERING_INFO};
        info.pDepthAttachment = &depth;
        vkCmdBeginRendering(commands, &info);
    }
private:
    void createImage(VkImageUsageFlags usage, VkImage& image) {
        VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.format = VK_FORMAT_D32_SFLOAT;
        info.samples = VK_SAMPLE_COUNT_4_BIT;
        info.usage = usage;
        vkCreateImage(device, &info, nullptr, &image);
    }
    VkImageView createView(VkImage image) {
        VkImageViewCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        info.image = image;
        VkImageView view;
        vkCreateImageView(device, &info, nullptr, &view);
        return view;
    }
    void createDepth() {
        createImage(VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, depthImage);
        depthView = createView(depthImage);
    }
    VkDevice device;
    VkImage depthImage;
    VkImageView depthView;
};
""")
    result = run(tmp_path, "check", "--isolated", "--no-cache", "--output", "concise", program.name)
    assert "MSAA401" in result.stdout, result.stdout

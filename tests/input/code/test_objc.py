"""Metal in Objective-C, Objective-C++, and metal-cpp."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.core.text.node import Node
from tests.input.code.expected import outcome

pytest.importorskip("tree_sitter_cpp")

from msaa_lint.input.code.objc.description_trees import trees
from msaa_lint.input.code.objc.messages import rewrite
from msaa_lint.input.code.parsing import Code

PROGRAMS = sorted((Path(__file__).parent / "objc").iterdir())

MADE = """\
MTLTextureDescriptor *d = [[MTLTextureDescriptor alloc] init];
d.textureType = MTLTextureType2DMultisample;
d.sampleCount = 4;
d.usage = MTLTextureUsageRenderTarget;
id<MTLTexture> color = [device newTextureWithDescriptor:d];
"""
PASS = (
    "MTLRenderPassDescriptor *pass = [MTLRenderPassDescriptor renderPassDescriptor];\n"
    "pass.colorAttachments[0].texture = color;\n"
)
ENCODED = (
    "id<MTLRenderCommandEncoder> encoder = [buffer renderCommandEncoderWithDescriptor:pass];\n"
)


def plain(node: Node) -> Any:
    if node.kind == "mapping":
        return {key: plain(value) for key, value in node.value.items()}
    return [plain(item) for item in node.value] if node.kind == "sequence" else node.value


def metal(
    body: str,
    language: str = "objc",
    around: str = "void f(id<MTLDevice> device, id<MTLCommandBuffer> buffer) {\n%s}\n",
) -> Any:
    (only,) = trees(Code(around % body, language))
    return plain(only.tree)["metal"]


def color(text: str, language: str = "objc") -> Any:
    """Returns the first color attachment of the only pass."""
    (only,) = metal(text, language)["renderPasses"].values()
    return only["colorAttachments"]["0"]


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
def test_what_a_program_says(program: Path) -> None:
    held = outcome(program)
    assert held.false == ()
    assert held.missed == ()


# Syntax


@pytest.mark.parametrize(
    ("written", "read_as"),
    [
        ("x = [a b];", "x =  a.b ;"),
        ("[a b:c];", " a.b(c);"),
        ("[a b:c d:e];", " a.b(c , e);"),
        ("[[A alloc] init];", "  A.alloc .init ;"),
        ("[a b:c ? d : e f:g];", " a.b(c ? d : e , g);"),
        ("x = y[i];", "x = y[i];"),
        ("x = f(y)[i + 1];", "x = f(y)[i + 1];"),
        ("x = (id<B>)[a b];", "x = (id<B>) a.b ;"),
        ("x = [(id)a b];", "x =  (id)a.b ;"),
        ("[NSFoo new];", " NSFoo.ne_ ;"),
        ("auto f = [&](int x) { g(x); };", "auto f = [&](int x) { g(x); };"),
        ("auto f = [self] { g(); };", "auto f = [self] { g(); };"),
        ("[a b:^{ c(); }];", " a.([]{ c(); });"),
        ("[a bcd:e f: ^(id x) { c(x); }];", " a.bcd(e , [](id x) { c(x); });"),
        ("for (id x in y) { }", "for (id x :  y) { }"),
        ('s = @"a [b c]";', 's =  "a [b c]";'),
        ("l = @[a, b];", "l =  {a, b};"),
        ("@autoreleasepool { a(); }", "                 { a(); }"),
        ("if (@available(macOS 11, *)) { }", "if (_available_macOS_11____) { }"),
        ("__weak id x = (__bridge id)y;", "       id x = (         id)y;"),
    ],
)
def test_messages_become_calls_of_the_same_length(written: str, read_as: str) -> None:
    rewritten = rewrite(written)
    assert rewritten.text == read_as
    assert len(written) == len(read_as)


def test_methods_become_functions() -> None:
    text = (
        "@implementation A\n- (void)draw:(nonnull MTKView *)view at:(int)n {\n}\n+ (id)new { "
        "return nil; }\n@end\n"
    )
    rewritten = rewrite(text)
    assert len(rewritten.text) == len(text)
    assert "void draw(MTKView * view, int n)" in rewritten.text
    assert [
        (name, message.name, message.labels) for name, message in rewritten.methods.values()
    ] == [
        ("A", "draw", ("at",)),
        ("A", "new", None),
    ]


# Values


@pytest.mark.parametrize(
    "made",
    [
        MADE,
        MADE.replace("[[MTLTextureDescriptor alloc] init]", "[MTLTextureDescriptor new]"),
        MADE.replace(
            "[[MTLTextureDescriptor alloc] init]",
            "[[[MTLTextureDescriptor alloc] init] autorelease]",
        ),
        MADE.replace("d.sampleCount = 4;", "[d setSampleCount:4];"),
        MADE.replace("d.sampleCount = 4;", "d.sampleCount = (NSUInteger)4;"),
        MADE.replace("d.sampleCount = 4;", "d.sampleCount = MAX(1, 4);"),
        MADE.replace(
            "d.sampleCount = 4;",
            "if (samples > 1) {\nd.sampleCount = 4;\n} else {\nd.sampleCount = 1;\n}",
        ),
    ],
)
def test_ways_to_a_texture(made: str) -> None:
    assert metal(made)["textures"]["color"] == {
        "textureType": "type2DMultisample",
        "sampleCount": 4,
        "usage": ["renderTarget"],
    }


@pytest.mark.parametrize(
    "way",
    [
        "pass.colorAttachments[0].storeAction = MTLStoreActionMultisampleResolve;",
        "[pass.colorAttachments[0] setStoreAction:MTLStoreActionMultisampleResolve];",
        "[[pass.colorAttachments objectAtIndexedSubscript:0] "
        "setStoreAction:MTLStoreActionMultisampleResolve];",
        "MTLRenderPassColorAttachmentDescriptor *a = pass.colorAttachments[0];\na.storeAction = "
        "MTLStoreActionMultisampleResolve;",
        "__auto_type a = pass.colorAttachments[0];\na.storeAction = "
        "MTLStoreActionMultisampleResolve;",
        "pass.colorAttachments[0].storeAction = samples > 1 ? MTLStoreActionMultisampleResolve : "
        "MTLStoreActionStore;",
        "finish(pass, MTLStoreActionMultisampleResolve);",
        "@autoreleasepool {\npass.colorAttachments[0].storeAction = "
        "MTLStoreActionMultisampleResolve;\n}",
        "dispatch_sync(queue, ^{ pass.colorAttachments[0].storeAction = "
        "MTLStoreActionMultisampleResolve; });",
    ],
)
@pytest.mark.parametrize("language", ["objc", "objcpp"])
def test_ways_to_an_attachment(way: str, language: str) -> None:
    around = (
        "static void finish(MTLRenderPassDescriptor *p, MTLStoreAction s) { "
        "p.colorAttachments[0].storeAction = s; }\n"
        "void f(id<MTLDevice> device, id<MTLCommandBuffer> buffer, id<CAMetalDrawable> drawable) "
        "{\n%s}\n"
    )
    body = (
        MADE
        + PASS
        + "pass.colorAttachments[0].resolveTexture = drawable.texture;\n"
        + way
        + "\n"
        + ENCODED
    )
    (only,) = metal(body, language, around)["renderPasses"].values()
    assert only["colorAttachments"]["0"] == {
        "texture": "color",
        "resolveTexture": "drawable",
        "loadAction": "dontCare",
        "storeAction": "multisampleResolve",
    }


def test_a_store_action_that_the_encoder_sets() -> None:
    text = MADE + PASS + "pass.colorAttachments[0].storeAction = MTLStoreActionUnknown;\n" + ENCODED
    assert color(text)["storeAction"] == "unknown"
    assert (
        color(text + "[encoder setColorStoreAction:MTLStoreActionStore atIndex:0];\n")[
            "storeAction"
        ]
        == "store"
    )
    assert "storeAction" not in color(
        text + "[encoder setColorStoreAction:chosen(self) atIndex:0];\n"
    )


def test_properties_and_their_variables_are_one() -> None:
    text = (
        "@interface A : NSObject\n@property (nonatomic, strong, nullable) id<MTLTexture> color;\n"
        "@end\n"
        "@implementation A {\n    NSUInteger _samples;\n}\n"
        "- (void)make:(id<MTLDevice>)device {\n"
        + MADE.replace("id<MTLTexture> color", "_color").replace("= 4", "= self->_samples")
        + "}\n- (void)draw:(id<MTLCommandBuffer>)buffer {\n"
        + PASS.replace("= color", "= self.color")
        + ENCODED
        + "}\n@end\n"
    )
    (only,) = trees(Code(text, "objc"))
    tree = plain(only.tree)["metal"]
    assert tree["textures"] == {
        "color": {"textureType": "type2DMultisample", "sampleCount": 4, "usage": ["renderTarget"]}
    }
    assert [what for what, _, _ in only.assumed] == ["`samples`"]


def test_classes_of_cpp_in_a_file_of_objective_cpp() -> None:
    text = (
        "#import <Metal/Metal.h>\nnamespace gpu {\ntemplate <typename T> class Pool { "
        "std::vector<T> items; };\n"
        "class Target {\npublic:\n    void make(id<MTLDevice> device);\n    void "
        "draw(id<MTLCommandBuffer> buffer);\nprivate:\n"
        "    id<MTLTexture> color = nil;\n};\nvoid Target::make(id<MTLDevice> device) {\n"
        + MADE.replace("id<MTLTexture> color", "color")
        + "}\nvoid Target::draw(id<MTLCommandBuffer> buffer) {\n"
        + PASS
        + ENCODED
        + "}\n}\n"
    )
    (only,) = trees(Code(text, "objcpp"))
    tree = plain(only.tree)["metal"]
    assert tree["textures"]["color"]["sampleCount"] == 4
    assert tree["renderPasses"]["pass"]["colorAttachments"]["0"]["texture"] == "color"


def test_vulkan_in_objective_cpp() -> None:
    text = (
        "void f(VkDevice device) {\n@autoreleasepool {\nVkImageCreateInfo info = "
        "{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};\n"
        "info.format = VK_FORMAT_R8G8B8A8_UNORM;\ninfo.samples = VK_SAMPLE_COUNT_4_BIT;\n"
        "info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;\nVkImage image;\nvkCreateImage(device, "
        "&info, nullptr, &image);\n"
        '[[NSBundle mainBundle] pathForResource:@"a" ofType:nil];\n}\n}\n'
    )
    (only,) = trees(Code(text, "objcpp"))
    assert plain(only.tree)["images"]["image"]["samples"] == 4


HOSTILE = [
    "[" * 20_000,
    "[a " * 5_000,
    "[a b:" * 5_000 + "]" * 5_000,
    "@interface A {" * 2_000,
    "@implementation A\n" + "- (void)" * 5_000,
    "- (void)a:(" + "(" * 20_000,
    "@implementation A\n- (void)a" + ":(int)b c" * 3_000 + " {}\n@end",
    "^{" * 5_000 + "}" * 5_000,
    "@{" * 5_000 + "}" * 5_000,
    "@implementation A\n" + "- (id)a { return [self a]; }\n" * 2_000 + "@end",
    "[a b:c ? " * 5_000,
    "@protocol A\n" * 5_000,
    "for (" * 5_000 + "a in b",
    "<" * 20_000 + "[a b]",
]


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_text(text: str) -> None:
    begun = time.process_time()
    assert len(rewrite(text).text) == len(text)
    trees(Code("void f() {\n" + MADE + "}\n" + text, "objcpp"))
    assert time.process_time() - begun < 5


def test_an_object_of_a_class_without_members() -> None:
    text = (
        "Pool::Pool(int n) { }\nvoid f(id<MTLDevice> device, id<MTLCommandBuffer> buffer) {\nauto "
        "pool = Pool(1, 2);\n" + MADE + "}\n"
    )
    (only,) = trees(Code(text, "objcpp"))
    assert plain(only.tree)["metal"]["textures"]["color"]["sampleCount"] == 4

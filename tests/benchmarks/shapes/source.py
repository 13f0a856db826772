"""Source code: what GLSL, Swift, and Objective-C have many of, and how it can nest. C and C++ are
in `source_c`.
"""

from __future__ import annotations

from collections.abc import Callable

from .shape import Shape
from .source_c import SHAPES as C_SHAPES
from .source_code import code, repeated

FETCHES = """\
#version 450
layout(binding = 0) uniform sampler2DMS image;
layout(location = 0) out vec4 color;
"""
MAIN = "void main() {{\n    vec4 sum = vec4(0.0);\n{}    color = sum;\n}}\n"
FETCH = "    sum += texelFetch(image, ivec2(gl_FragCoord.xy), {});\n"
TEXTURE = """\
        let d{n} = MTLTextureDescriptor()
        d{n}.textureType = .type2DMultisample
        d{n}.sampleCount = 4
        d{n}.pixelFormat = .bgra8Unorm
        let t{n} = device.makeTexture(descriptor: d{n})!
"""


def glsl(name: str, content: Callable[[int], str]) -> Shape:
    return code(f"GLSL: {name}", "a.frag", lambda count: FETCHES + content(count))


def swift(name: str, body: Callable[[int], str]) -> Shape:
    def content(count: int) -> str:
        head = (
            "import Metal\nclass Renderer {\n    var sampleCount = 4\n    func setup(device: "
            "MTLDevice, on: Bool) {\n"
        )
        return f"{head}{body(count)}    }}\n}}\n"

    return code(f"Swift: {name}", "a.swift", content)


OBJC_TEXTURE = """\
    MTLTextureDescriptor *d{n} = [[MTLTextureDescriptor alloc] init];
    d{n}.textureType = MTLTextureType2DMultisample;
    d{n}.sampleCount = 4;
    id<MTLTexture> t{n} = [device newTextureWithDescriptor:d{n}];
"""


def objc(name: str, body: Callable[[int], str]) -> Shape:
    def content(count: int) -> str:
        head = (
            "#import <Metal/Metal.h>\n@implementation Renderer\n- "
            "(void)make:(id<MTLDevice>)device on:(BOOL)on {\n"
        )
        return f"{head}{body(count)}}}\n@end\n"

    return code(f"Objective-C: {name}", "a.m", content)


def objc_textures(count: int) -> str:
    return repeated(OBJC_TEXTURE, count)


def objc_nested_messages(count: int) -> str:
    return OBJC_TEXTURE.format(n=0) + "    " + "[" * count + "device" + " next]" * count + ";\n"


def objc_nested_arguments(count: int) -> str:
    return OBJC_TEXTURE.format(n=0) + "    " + "[self use:" * count + "device" + "]" * count + ";\n"


def objc_blocks(count: int) -> str:
    return OBJC_TEXTURE.format(n=0) + repeated(
        "    [self do{n}: ^{{ d0.sampleCount = {n}; }}];\n", count
    )


def objc_methods(count: int) -> str:
    calls = repeated("}}\n- (void)step{m} {{\n    [self step{n}];\n    [self step{n}];\n", count)
    return OBJC_TEXTURE.format(n=0) + calls


def objc_properties(count: int) -> str:
    every = repeated("@property (nonatomic) id<MTLTexture> p{n};\n", count)
    return (
        "}\n@end\n@interface Renderer ()\n"
        + every
        + "@end\n@implementation Renderer\n- (void)draw {\n"
        + repeated("    self.p{n} = nil;\n", count)
    )


def markdown(count: int) -> str:
    return repeated(
        "# Part {n}\n\n```cpp\nVkAttachmentDescription a{n}{{}};\na{n}.samples = "
        "VK_SAMPLE_COUNT_4_BIT;\n```\n\n",
        count,
    )


def markdown_shaders(count: int) -> str:
    return ("```glsl\n" + FETCHES + MAIN.format(FETCH.format(0)) + "```\n\ntext\n\n\n") * count


def glsl_functions(count: int) -> str:
    every = "vec4 f0(vec4 v) { return v; }\n" + repeated(
        "vec4 f{m}(vec4 v) {{ return f{n}(v); }}\n", count
    )
    return every + MAIN.format(FETCH.format(0) + f"    sum = f{count}(sum);\n")


def glsl_overloads(count: int) -> str:
    every = repeated("struct T{n} {{ vec4 v; }};\nvec4 f(T{n} t) {{ return t.v; }}\n", count)
    return every + MAIN.format(
        FETCH.format(0) + repeated("    T{n} t{n};\n    sum += f(t{n});\n", count)
    )


def glsl_call_tree(count: int) -> str:
    every = "vec4 f0(vec4 v) { return v; }\n" + repeated(
        "vec4 f{m}(vec4 v) {{ return f{n}(v) + f{n}(v); }}\n", count
    )
    return every + MAIN.format(FETCH.format(0) + f"    sum = f{count}(sum);\n")


def glsl_fetches(count: int) -> str:
    return MAIN.format(FETCH.format(0) * count)


def glsl_images(count: int) -> str:
    images = repeated("layout(binding = {m}) uniform sampler2DMS image{n};\n", count)
    reads = repeated("    sum += texelFetch(image{n}, ivec2(gl_FragCoord.xy), 0);\n", count)
    return images + MAIN.format(reads)


def glsl_locals(count: int) -> str:
    return MAIN.format(
        FETCH.format(0)
        + repeated("    vec4 v{n} = sum.wzyx;\n    v{n}.xy += v{n}.zw;\n    sum += v{n};\n", count)
    )


def glsl_members(count: int) -> str:
    block = (
        f"layout(binding = 1) uniform Block {{\n{repeated('    vec4 m{n};' + chr(10), count)}}};\n"
    )
    return block + MAIN.format(FETCH.format(0) + repeated("    sum += m{n};\n", count))


def glsl_loops(count: int) -> str:
    return MAIN.format(
        "    for (int i = 0; i < 4; ++i)\n    "
        + (FETCH.format("i") + "    for (int i = 0; i < 4; ++i)\n    ") * count
        + ";\n"
    )


def glsl_nested_loops(count: int) -> str:
    loops = repeated("    for (int i{n} = 0; i{n} < 4; ++i{n}) {{\n", count)
    return MAIN.format(loops + FETCH.format("0") + "    }\n" * count)


def glsl_branches(count: int) -> str:
    return MAIN.format(
        FETCH.format(0)
        + repeated("    if (sum.x > {n}.0) sum = sum * 2.0; else sum += 1.0;\n", count)
    )


def glsl_macros(count: int) -> str:
    return repeated("#define A{m} A{n}\n", count) + MAIN.format(
        FETCH.format(0) + f"    sum *= A{count};\n"
    )


def glsl_macro_uses(count: int) -> str:
    return "#define AT(n) texelFetch(image, ivec2(gl_FragCoord.xy), n)\n" + MAIN.format(
        "    sum += AT(0);\n" * count
    )


def glsl_long_macro_uses(count: int) -> str:
    return "#define A 0\n" + MAIN.format(f"    sum.x += {' + A' * count};\n" + FETCH.format(0))


def glsl_doubling_macros(count: int) -> str:
    return (
        "#define A0 1.0\n"
        + repeated("#define A{m} A{n} + A{n}\n", count)
        + MAIN.format(FETCH.format(0) + f"    sum *= A{count};\n")
    )


def glsl_directives(count: int) -> str:
    return repeated("#ifdef A{n}\n", count) + "#endif\n" * count + MAIN.format(FETCH.format(0))


def glsl_long_sum(count: int) -> str:
    return MAIN.format(FETCH.format(0) + f"    sum = sum{' + sum' * count};\n")


def glsl_comma(count: int) -> str:
    return MAIN.format(FETCH.format(0) + f"    vec4 v0{repeated(', v{m} = v{n}', count)};\n")


def swift_textures(count: int) -> str:
    return repeated(TEXTURE, count)


def swift_passes(count: int) -> str:
    one = (
        TEXTURE
        + "        let p{n} = MTLRenderPassDescriptor()\n        p{n}.colorAttachments[0].texture "
        "= t{n}\n"
        "        p{n}.colorAttachments[0].storeAction = .store\n"
        "        let e{n} = commands.makeRenderCommandEncoder(descriptor: p{n})!\n        "
        "e{n}.endEncoding()\n"
    )
    return repeated(one, count)


def swift_one_descriptor(count: int) -> str:
    """A descriptor that is encoded many times, each time with another texture."""
    one = (
        TEXTURE + "        p.colorAttachments[0].texture = t{n}\n        _ = "
        "commands.makeRenderCommandEncoder(descriptor: p)!\n"
    )
    return "        let p = MTLRenderPassDescriptor()\n" + repeated(one, count)


def swift_branches(count: int) -> str:
    return "        let d = MTLTextureDescriptor()\n" + repeated(
        "        if flag{n} {{ d.width = {n} }} else {{ d.width = 1 }}\n", count
    )


def swift_nested_branches(count: int) -> str:
    body = repeated("        if flag{n} {{\n        d.sampleCount = 4\n", count)
    return "        let d = MTLTextureDescriptor()\n" + body + "        }\n" * count


def swift_cases(count: int) -> str:
    cases = repeated("        case {n}: d.sampleCount = 4\n", count)
    return (
        "        let d = MTLTextureDescriptor()\n        switch quality {\n"
        + cases
        + "        default: break\n        }\n"
    )


def swift_returning_cases(count: int) -> str:
    cases = repeated("            case {n}: return {m}\n", count)
    choice = (
        "        func count(_ quality: Int) -> Int {\n            switch quality {\n"
        + cases
        + "            default: return 1\n            }\n        }\n"
    )
    return (
        "        let d = MTLTextureDescriptor()\n"
        + choice
        + "        d.sampleCount = count(quality)\n"
    )


def swift_assumptions(count: int) -> str:
    return repeated(
        "        let d{n} = MTLTextureDescriptor()\n        d{n}.sampleCount = settings{n}.samples "
        "// msaa-lint: assume samples=4\n",
        count,
    )


def swift_closures(count: int) -> str:
    return repeated(
        "        let f{n} = {{ (x: Int) in d.sampleCount = x }}\n        f{n}(4)\n", count
    )


def swift_closure_tree(count: int) -> str:
    body = (
        "        let d = MTLTextureDescriptor()\n        let f0 = { (x: Int) in d.sampleCount = "
        "x }\n"
    )
    return (
        body
        + repeated("        let f{m} = {{ (x: Int) in f{n}(x); f{n}(x) }}\n", count)
        + f"        f{count}(4)\n"
    )


def swift_optionals(count: int) -> str:
    body = repeated("        guard let a{m} = a{n}?.descriptor?.texture else {{ return }}\n", count)
    return "        let a0 = MTLTextureDescriptor()\n" + body


def swift_wide_closures(count: int) -> str:
    body = "        let d = MTLTextureDescriptor()\n        let f0 = { (x: Int) in x }\n"
    calls = ", ".join(["f{n}(x)"] * 20)
    return (
        body
        + repeated(f"        let f{{m}} = {{{{ (x: Int) in [{calls}] }}}}\n", count)
        + f"        d.sampleCount = f{count}(4)\n"
    )


def swift_equal_tuples(count: int) -> str:
    """Two tuples of tuples that are alike, but not the same."""
    body = "        let t0 = (1, 2)\n        let u0 = (1, 2)\n"
    pairs = "        let t{m} = (t{n}, t{n})\n        let u{m} = (u{n}, u{n})\n"
    return body + repeated(
        pairs + "        var v{n} = t{m}\n        if on {{ v{n} = u{m} }}\n", count
    )


def swift_options(count: int) -> str:
    return "        var usage: MTLTextureUsage = .renderTarget\n" + repeated(
        "        usage = usage | usage\n        d.usage.formUnion(.a{n})\n", count
    )


def swift_tuples(count: int) -> str:
    return "        let t0 = (1, 2)\n" + repeated(
        "        let t{m} = (t{n}, t{n})\n        if on {{ t = t{m} }} else {{ t = t{n} }}\n", count
    )


def swift_long_sum(count: int) -> str:
    return f"        let samples = 1{' + 1' * count}\n        d.sampleCount = samples\n"


def swift_functions(count: int) -> str:
    every = repeated("    func f{n}() -> MTLTextureDescriptor {{ return f{m}() }}\n", count)
    return (
        f"import Metal\nclass A {{\n{every}    func f{count}() -> MTLTextureDescriptor {{ "
        f"d.sampleCount = 4 }}\n}}\n"
    )


def swift_call_tree(count: int) -> str:
    every = repeated("    func f{n}(_ d: MTLTextureDescriptor) {{ f{m}(d); f{m}(d) }}\n", count)
    return (
        f"import Metal\nclass A {{\n{every}    func f{count}(_ d: MTLTextureDescriptor) {{ "
        f"d.sampleCount = 4 }}\n}}\n"
    )


def swift_overloads(count: int) -> str:
    every = repeated("    func f(a{n}: Int) -> Int {{ return a{n} }}\n", count)
    return (
        f"import Metal\nclass A {{\n{every}    func g() {{\n"
        f"{repeated('        d.sampleCount = f(a{n}: {n})' + chr(10), count)}    }}\n}}\n"
    )


def swift_types(count: int) -> str:
    return "import Metal\n" + repeated(
        "class A{n}: B{n} {{ var samples = 4\n    func f() {{ d.sampleCount = samples }}\n}}\n",
        count,
    )


SHAPES: tuple[Shape, ...] = (
    *C_SHAPES,
    code("Markdown: C++", "a.md", markdown),
    code("Markdown: GLSL", "a.md", markdown_shaders),
    glsl("functions", glsl_functions),
    glsl("overloads", glsl_overloads),
    glsl("functions that call the last twice", glsl_call_tree),
    glsl("fetches", glsl_fetches),
    glsl("images", glsl_images),
    glsl("locals", glsl_locals),
    glsl("block members", glsl_members),
    glsl("loops", glsl_loops),
    glsl("nested loops", glsl_nested_loops),
    glsl("branches", glsl_branches),
    glsl("macros", glsl_macros),
    glsl("macro uses", glsl_macro_uses),
    glsl("macro uses in a line", glsl_long_macro_uses),
    glsl("doubling macros", glsl_doubling_macros),
    glsl("directives", glsl_directives),
    glsl("long sum", glsl_long_sum),
    glsl("declarators", glsl_comma),
    swift("textures", swift_textures),
    swift("passes", swift_passes),
    swift("passes of one descriptor", swift_one_descriptor),
    swift("branches", swift_branches),
    swift("nested branches", swift_nested_branches),
    swift("switch cases", swift_cases),
    swift("switch cases that return", swift_returning_cases),
    swift("assumptions", swift_assumptions),
    swift("closures", swift_closures),
    swift("closures that call the last twice", swift_closure_tree),
    swift("optionals", swift_optionals),
    swift("tuples", swift_tuples),
    swift("wide closures", swift_wide_closures),
    swift("tuples that are alike", swift_equal_tuples),
    swift("option sets", swift_options),
    swift("long sum", swift_long_sum),
    objc("textures", objc_textures),
    objc("nested messages", objc_nested_messages),
    objc("nested arguments", objc_nested_arguments),
    objc("blocks", objc_blocks),
    objc("methods that call the last twice", objc_methods),
    objc("properties", objc_properties),
    code("Swift: functions", "a.swift", swift_functions),
    code("Swift: functions that call the next twice", "a.swift", swift_call_tree),
    code("Swift: overloads", "a.swift", swift_overloads),
    code("Swift: types", "a.swift", swift_types),
)

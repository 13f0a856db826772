"""Source code: what C, C++, GLSL and Swift have many of, and how it can nest."""

from __future__ import annotations

from collections.abc import Callable

from .shape import Shape, text

ATTACHMENT = """\
    VkAttachmentDescription a{n} = {{}};
    a{n}.format = VK_FORMAT_R8G8B8A8_UNORM;
    a{n}.samples = VK_SAMPLE_COUNT_4_BIT;
    a{n}.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    a{n}.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
"""
PASS = """\
    VkAttachmentReference r{n} = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkSubpassDescription s{n} = {{}};
    s{n}.colorAttachmentCount = 1;
    s{n}.pColorAttachments = &r{n};
    VkRenderPassCreateInfo i{n} = {{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO}};
    i{n}.attachmentCount = 1;
    i{n}.pAttachments = &a{n};
    i{n}.subpassCount = 1;
    i{n}.pSubpasses = &s{n};
    vkCreateRenderPass(device, &i{n}, nullptr, &pass{n});
"""
IMAGE = """\
    VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.samples = samples;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    vkCreateImage(device, &info, nullptr, &image);
"""
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


def repeated(line: str, count: int, start: int = 0) -> str:
    """Formats a line with every number `n`."""
    return "".join(line.format(n=number, m=number + 1) for number in range(start, start + count))


def function(body: str, name: str = "void setup(int samples)") -> str:
    return f"{name} {{\n{body}}}\n"


def code(name: str, file: str, content: Callable[[int], str]) -> Shape:
    """A file that the command names: in a folder, only files that mention multisampling are read."""
    return Shape(name, text(file, content), ("check", "--isolated", file))


def cpp(name: str, content: Callable[[int], str]) -> Shape:
    return code(f"C++: {name}", "a.cpp", content)


def swift(name: str, body: Callable[[int], str]) -> Shape:
    def content(count: int) -> str:
        return f"import Metal\nclass Renderer {{\n    func setup(device: MTLDevice, on: Bool) {{\n{body(count)}    }}\n}}\n"

    return code(f"Swift: {name}", "a.swift", content)


def glsl(name: str, content: Callable[[int], str]) -> Shape:
    return code(f"GLSL: {name}", "a.frag", lambda count: FETCHES + content(count))


def passes(count: int) -> str:
    return function(repeated(ATTACHMENT + PASS, count))


def attachments_of_one_pass(count: int) -> str:
    listed = f"    VkAttachmentDescription all[] = {{{', '.join(f'a{n}' for n in range(count))}}};\n"
    info = f"    VkRenderPassCreateInfo info = {{}};\n    info.attachmentCount = {count};\n    info.pAttachments = all;\n"
    return function(repeated(ATTACHMENT, count) + listed + info + "    vkCreateRenderPass(device, &info, nullptr, &pass);\n")


def passes_of_many_attachments(count: int) -> str:
    many = 8
    bodies = []
    for number in range(count):
        body = repeated(ATTACHMENT, many)
        body += f"    VkAttachmentDescription all[{many}] = {{{', '.join(f'a{n}' for n in range(many))}}};\n"
        body += repeated("    VkAttachmentReference r{n} = {{{n}, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};\n", many)
        body += f"    VkAttachmentReference refs[{many}] = {{{', '.join(f'r{n}' for n in range(many))}}};\n"
        body += f"    VkSubpassDescription sub = {{}};\n    sub.colorAttachmentCount = {many};\n    sub.pColorAttachments = refs;\n"
        body += f"    VkRenderPassCreateInfo info = {{}};\n    info.attachmentCount = {many};\n    info.pAttachments = all;\n"
        body += "    info.subpassCount = 1;\n    info.pSubpasses = &sub;\n    vkCreateRenderPass(device, &info, nullptr, &pass);\n"
        bodies.append(function(body, f"void setup{number}()"))
    return "".join(bodies)


def overloads(count: int) -> str:
    many = repeated("struct T{n} {{ int v; }};\nvoid create(T{n} t, int samples) {{ image{n} = t.v + samples; }}\n", count)
    return many + function(repeated("    T{n} t{n};\n    create(t{n}, VK_SAMPLE_COUNT_4_BIT);\n", count))


def functions(count: int) -> str:
    return repeated("void create{n}(int samples) {{\n" + IMAGE.replace("{", "{{").replace("}", "}}") + "}}\n", count)


def call_chain(count: int) -> str:
    chain = repeated("void create{n}(int samples) {{ create{m}(samples); }}\n", count)
    return chain + function(IMAGE, f"void create{count}(int samples)")


def call_fan(count: int) -> str:
    return function(IMAGE, "void create(int samples)") + function("    create(VK_SAMPLE_COUNT_4_BIT);\n" * count)


def call_tree(count: int) -> str:
    """Functions that call the next one twice."""
    chain = repeated("void create{n}(int samples) {{ create{m}(samples); create{m}(samples); }}\n", count)
    return chain + function(IMAGE, f"void create{count}(int samples)")


def recursion(count: int) -> str:
    every = repeated("int sample{n}(int n) {{ return n > 0 ? sample{n}(n - 1) + sample{m}(n) : 4; }}\n", count)
    return every + function("    return 4;\n", f"int sample{count}(int n)")


def conditional_writes(count: int) -> str:
    return function("    int count = 1;\n" + repeated("    if (flag{n}) count = VK_SAMPLE_COUNT_4_BIT;\n", count) + IMAGE)


def conditional_copies(count: int) -> str:
    """Structures that hold each other's alternatives."""
    writes = repeated("    if (c{n}) a.x = b;\n    if (d{n}) b.x = a;\n    if (e{n}) a.samples = b.samples;\n", count)
    return function("    Config a, b;\n    a.samples = 1;\n    b.samples = 4;\n" + writes + IMAGE.replace("= samples", "= a.samples"))


def conditional_structures(count: int) -> str:
    """Structures of structures, each written under conditions."""
    body = "    VkAttachmentDescription v0 = {}, w0 = {};\n    v0.samples = VK_SAMPLE_COUNT_4_BIT;\n"
    for number in range(count):
        body += f"    Config v{number + 1};\n"
        body += "".join(f"    if (c{number}_{way}) v{number + 1}.m{way % 2} = v{number};\n" for way in range(4))
    return function(body + f"    vkCreateThing(device, &v{count}, nullptr, &image);\n")


def conditional_counts(count: int) -> str:
    body = "    int count = 1;\n" + repeated("    count = flag{n} ? count : count * 2;\n", count)
    return function(body + IMAGE.replace("= samples", "= count"))


def negated_conditions(count: int) -> str:
    body = "    bool on = flag;\n" + repeated("    bool on{n} = !(on || !(flag{n} && !on));\n    on = on{n} || on;\n", count)
    return function(body + "    if (on) samples = 4;\n" + IMAGE)


def early_returns(count: int) -> str:
    return function(repeated("    if (flag{n}) return;\n", count) + IMAGE)


def nested(opening: str, closing: str, inner: str = IMAGE) -> Callable[[int], str]:
    def content(count: int) -> str:
        opened = "".join(opening.replace("#", str(number)) for number in range(count))
        return function(opened + inner + closing * count)

    return content


def else_chain(count: int) -> str:
    chain = "    if (flag) samples = 2;\n" + repeated("    else if (flag{n}) samples = 4;\n", count)
    return function(chain + IMAGE)


def switch(count: int) -> str:
    cases = repeated("        case {n}: samples = VK_SAMPLE_COUNT_4_BIT; break;\n", count)
    return function("    switch (quality) {\n" + cases + "    }\n" + IMAGE)


def lambdas(count: int) -> str:
    return function(repeated("    auto f{n} = [&](int n) {{ samples = n; }};\n    f{n}(4);\n", count) + IMAGE)


def nested_lambda_calls(count: int) -> str:
    chain = "    auto f0 = [&](int n) { samples = n; };\n" + repeated("    auto f{m} = [&](int n) {{ f{n}(n); f{n}(n); }};\n", count)
    return function(chain + f"    f{count}(4);\n" + IMAGE)


def macros(count: int) -> str:
    return repeated("#define SAMPLES_{m} SAMPLES_{n}\n", count) + function(IMAGE.replace("= samples", f"= SAMPLES_{count}"))


def enumerators(count: int) -> str:
    listed = repeated("    COUNT_{n},\n", count)
    return f"enum Samples {{\n{listed}}};\n" + function(IMAGE)


def enumerator_values(count: int) -> str:
    every = "    COUNT_0 = 1,\n" + repeated("    COUNT_{m} = COUNT_{n} + COUNT_{n},\n", count)
    return f"enum {{\n{every}}};\n" + function(IMAGE.replace("= samples", f"= COUNT_{count}"))


def structure_members(count: int) -> str:
    members = repeated("    int samples{n} = 4;\n", count)
    writes = repeated("    c.samples{n} = VK_SAMPLE_COUNT_4_BIT;\n", count)
    return f"struct Config {{\n{members}}};\n" + function("    Config c;\n" + writes + IMAGE)


def class_members(count: int) -> str:
    members = repeated("    int samples{n};\n", count)
    methods = repeated("    void set{n}() {{ samples{n} = VK_SAMPLE_COUNT_4_BIT; }}\n", count)
    return f"class Config {{\n{members}{methods}    void make() {{\n{IMAGE}    }}\n}};\n"


def classes(count: int) -> str:
    return repeated("class C{m} : public C{n} {{ int samples = 4; virtual void set(int n) {{ samples = n; }} }};\n", count)


def methods_of_objects(count: int) -> str:
    kinds = repeated("struct K{n} {{ int samples; void set(int n) {{ samples = n; }} }};\n", count)
    return kinds + function(repeated("    K{n} k{n};\n    k{n}.set(4);\n", count) + IMAGE)


def class_layers(count: int) -> str:
    """Objects that hold objects: `a.b.c.samples`."""
    kinds = "struct K0 { int samples; };\n" + repeated("struct K{m} {{ K{n} inner; }};\n", count)
    return kinds + function(f"    K{count} k;\n    k" + ".inner" * count + ".samples = 4;\n" + IMAGE)


def templates(count: int) -> str:
    return repeated("template <typename T> T pick{n}(T samples) {{ return samples; }}\n", count) + function(
        repeated("    samples = pick{n}<int>(4);\n", count) + IMAGE
    )


def namespaces(count: int) -> str:
    return repeated("namespace n{n} {{ const int samples = {n}; }}\n", count) + function(
        repeated("    samples = n{n}::samples;\n", count) + IMAGE
    )


def nested_namespaces(count: int) -> str:
    return repeated("namespace n{n} {{\n", count) + function("    samples = other;\n" * count + IMAGE) + "}\n" * count


def aliases(count: int) -> str:
    return repeated("using Image{n} = VkImage;\n", count) + function(repeated("    Image{n} i{n};\n", count) + IMAGE)


def globals_(count: int) -> str:
    return repeated("static int samples{n} = VK_SAMPLE_COUNT_4_BIT;\n", count) + function(
        repeated("    samples{n} = 2;\n", count) + IMAGE
    )


def prototypes(count: int) -> str:
    return repeated("void create{n}(VkDevice device, const VkImageCreateInfo* info, VkImage* image);\n", count) + function(
        repeated("    create{n}(device, &info, &image{n});\n", count)
    )


def designated(count: int) -> str:
    item = "        [{n}] = {{.format = VK_FORMAT_R8G8B8A8_UNORM, .samples = VK_SAMPLE_COUNT_4_BIT}},\n"
    return function(f"    VkAttachmentDescription all[] = {{\n{repeated(item, count)}    }};\n")


def constant_array(count: int) -> str:
    return f"const int samples[] = {{{', '.join(str(n) for n in range(count))}}};\n" + function(IMAGE)


def declarators(count: int) -> str:
    return function(f"    int samples0{''.join(f', samples{n} = {n}' for n in range(1, count + 1))};\n" + IMAGE)


def long_sum(count: int) -> str:
    return function(f"    samples = 1{' + samples' * count};\n" + IMAGE)


def long_condition(count: int) -> str:
    return function(f"    if (flag{repeated(' || flag{n}', count)}) samples = 4;\n" + IMAGE)


def long_choice(count: int) -> str:
    return function(f"    samples = {repeated('flag{n} ? {n} : ', count)}4;\n" + IMAGE)


def flags(count: int) -> str:
    return function(f"    info.usage = {' | '.join(['VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT'] * (count + 1))};\n" + IMAGE)


def parentheses(count: int) -> str:
    return function(f"    samples = {'(' * count}4{')' * count};\n" + IMAGE)


def unary(count: int) -> str:
    return function(f"    samples = {'!' * count}4;\n" + IMAGE)


def method_chain(count: int) -> str:
    return function("    auto info = vk::ImageCreateInfo()" + ".setSamples(vk::SampleCountFlagBits::e4)" * count + ";\n")


def arguments(count: int) -> str:
    return function(f"    create({', '.join(f'&image{n}' for n in range(count + 1))});\n" + IMAGE)


def parameters(count: int) -> str:
    return function(IMAGE, f"void setup({', '.join(f'int samples{n} = 4' for n in range(count + 1))})")


def comments(count: int) -> str:
    return function("    // samples: \"a /* b\n    /* samples \\*/\n" * count + IMAGE)


def strings(count: int) -> str:
    return function('    log("samples \\" // /* " R"x(samples " )")x" \'"\');\n' * count + IMAGE)


def open_strings(count: int) -> str:
    return function('    R"(samples' * count + "\n" + IMAGE)


def suppressions(count: int) -> str:
    return function("    a.samples = 4;  // msaa-lint: ignore[no-resolve]\n" * count)


def directives(count: int) -> str:
    return function(repeated("#ifdef FLAG{n}\n    samples = {n};\n#endif\n", count) + IMAGE)


def nested_directives(count: int) -> str:
    return function(repeated("#ifdef FLAG{n}\n", count) + "    samples = 4;\n" + "#endif\n" * count + IMAGE)


def list_directives(count: int) -> str:
    item = "#ifdef FLAG{n}\n        {{.samples = VK_SAMPLE_COUNT_4_BIT}},\n#endif\n"
    return function(f"    VkAttachmentDescription all[] = {{\n{repeated(item, count)}    }};\n")


def else_directives(count: int) -> str:
    chain = "#if FLAG\n        {.samples = 1},\n" + repeated("#elif FLAG{n}\n        {{.samples = 4}},\n", count) + "#endif\n"
    return function(f"    VkAttachmentDescription all[] = {{\n{chain}    }};\n")


def member_writes(count: int) -> str:
    """A member of the class that many methods write."""
    return "class R {\n    VkImage image;\n" + repeated(
        "    void make{n}(int samples) {{\n" + IMAGE.replace("{", "{{").replace("}", "}}") + "    }}\n", count
    ) + "};\n"


def member_paths(count: int) -> str:
    return "class R {\n    Config config;\n    void make() {\n" + repeated("        config.a{n}.samples = 4;\n", count) + "    }\n};\n"


def list_appends(count: int) -> str:
    body = "    std::vector<VkAttachmentDescription> all;\n" + "    all.push_back(a);\n    all[0].samples = VK_SAMPLE_COUNT_4_BIT;\n" * count
    return function(body)


def copies_of_lists(count: int) -> str:
    body = f"    std::vector<VkAttachmentDescription> l0(64);\n{repeated('    auto l{m} = l{n};' + chr(10), count)}"
    return function(body + IMAGE)


def doubled_lists(count: int) -> str:
    body = "    VkAttachmentDescription a0 = {};\n" + repeated("    std::vector<Config> a{m} = {{a{n}, a{n}}};\n", count)
    return function(body + IMAGE)


def choices(count: int) -> str:
    one = (
        "VkSampleCountFlagBits pick{n}() {{\n    VkSampleCountFlags counts = limits.framebufferColorSampleCounts;\n"
        "    if (counts & VK_SAMPLE_COUNT_64_BIT) return VK_SAMPLE_COUNT_64_BIT;\n"
        "    if (counts & VK_SAMPLE_COUNT_8_BIT) return VK_SAMPLE_COUNT_8_BIT;\n    return VK_SAMPLE_COUNT_1_BIT;\n}}\n"
    )
    return repeated(one, count)


def choice_uses(count: int) -> str:
    return choices(1) + function(repeated("    info{n}.samples = pick0();\n    info{n}.format = findFormat{n}();\n", count))


def choice_names(count: int) -> str:
    assigned = repeated("    counts{m} = counts{n} & limits.framebufferDepthSampleCounts;\n", count)
    return choices(1) + function("    auto counts0 = limits.framebufferColorSampleCounts;\n" + assigned)


def unread_creations(count: int) -> str:
    return function(repeated("    info.samples = settings{n};\n    createImage(info, VK_SAMPLE_COUNT_4_BIT);\n", count))


def unbalanced(sign: str) -> Callable[[int], str]:
    return lambda count: function("    samples = 4;\n" + f"    {sign}\n" * count)


def broken(count: int) -> str:
    return function("    VkImageCreateInfo = ; samples )( {{ = 4 }} ;\n" * count + IMAGE)


def markdown(count: int) -> str:
    return repeated("# Part {n}\n\n```cpp\nVkAttachmentDescription a{n}{{}};\na{n}.samples = VK_SAMPLE_COUNT_4_BIT;\n```\n\n", count)


def markdown_shaders(count: int) -> str:
    return ("```glsl\n" + FETCHES + MAIN.format(FETCH.format(0)) + "```\n\ntext\n\n\n") * count


def glsl_functions(count: int) -> str:
    every = "vec4 f0(vec4 v) { return v; }\n" + repeated("vec4 f{m}(vec4 v) {{ return f{n}(v); }}\n", count)
    return every + MAIN.format(FETCH.format(0) + f"    sum = f{count}(sum);\n")


def glsl_overloads(count: int) -> str:
    every = repeated("struct T{n} {{ vec4 v; }};\nvec4 f(T{n} t) {{ return t.v; }}\n", count)
    return every + MAIN.format(FETCH.format(0) + repeated("    T{n} t{n};\n    sum += f(t{n});\n", count))


def glsl_call_tree(count: int) -> str:
    every = "vec4 f0(vec4 v) { return v; }\n" + repeated("vec4 f{m}(vec4 v) {{ return f{n}(v) + f{n}(v); }}\n", count)
    return every + MAIN.format(FETCH.format(0) + f"    sum = f{count}(sum);\n")


def glsl_fetches(count: int) -> str:
    return MAIN.format(FETCH.format(0) * count)


def glsl_images(count: int) -> str:
    images = repeated("layout(binding = {m}) uniform sampler2DMS image{n};\n", count)
    reads = repeated("    sum += texelFetch(image{n}, ivec2(gl_FragCoord.xy), 0);\n", count)
    return images + MAIN.format(reads)


def glsl_locals(count: int) -> str:
    return MAIN.format(FETCH.format(0) + repeated("    vec4 v{n} = sum.wzyx;\n    v{n}.xy += v{n}.zw;\n    sum += v{n};\n", count))


def glsl_members(count: int) -> str:
    block = f"layout(binding = 1) uniform Block {{\n{repeated('    vec4 m{n};' + chr(10), count)}}};\n"
    return block + MAIN.format(FETCH.format(0) + repeated("    sum += m{n};\n", count))


def glsl_loops(count: int) -> str:
    return MAIN.format("    for (int i = 0; i < 4; ++i)\n    " + (FETCH.format("i") + "    for (int i = 0; i < 4; ++i)\n    ") * count + ";\n")


def glsl_nested_loops(count: int) -> str:
    loops = repeated("    for (int i{n} = 0; i{n} < 4; ++i{n}) {{\n", count)
    return MAIN.format(loops + FETCH.format("0") + "    }\n" * count)


def glsl_branches(count: int) -> str:
    return MAIN.format(FETCH.format(0) + repeated("    if (sum.x > {n}.0) sum = sum * 2.0; else sum += 1.0;\n", count))


def glsl_macros(count: int) -> str:
    return repeated("#define A{m} A{n}\n", count) + MAIN.format(FETCH.format(0) + f"    sum *= A{count};\n")


def glsl_macro_uses(count: int) -> str:
    return "#define AT(n) texelFetch(image, ivec2(gl_FragCoord.xy), n)\n" + MAIN.format("    sum += AT(0);\n" * count)


def glsl_long_macro_uses(count: int) -> str:
    return "#define A 0\n" + MAIN.format(f"    sum.x += {' + A' * count};\n" + FETCH.format(0))


def glsl_doubling_macros(count: int) -> str:
    return "#define A0 1.0\n" + repeated("#define A{m} A{n} + A{n}\n", count) + MAIN.format(FETCH.format(0) + f"    sum *= A{count};\n")


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
        TEXTURE + "        let p{n} = MTLRenderPassDescriptor()\n        p{n}.colorAttachments[0].texture = t{n}\n"
        "        p{n}.colorAttachments[0].storeAction = .store\n"
        "        let e{n} = commands.makeRenderCommandEncoder(descriptor: p{n})!\n        e{n}.endEncoding()\n"
    )
    return repeated(one, count)


def swift_one_descriptor(count: int) -> str:
    """A descriptor that is encoded many times, each time with another texture."""
    one = TEXTURE + "        p.colorAttachments[0].texture = t{n}\n        _ = commands.makeRenderCommandEncoder(descriptor: p)!\n"
    return "        let p = MTLRenderPassDescriptor()\n" + repeated(one, count)


def swift_branches(count: int) -> str:
    return "        let d = MTLTextureDescriptor()\n" + repeated("        if flag{n} {{ d.width = {n} }} else {{ d.width = 1 }}\n", count)


def swift_nested_branches(count: int) -> str:
    body = repeated("        if flag{n} {{\n        d.sampleCount = 4\n", count)
    return "        let d = MTLTextureDescriptor()\n" + body + "        }\n" * count


def swift_cases(count: int) -> str:
    cases = repeated("        case {n}: d.sampleCount = 4\n", count)
    return "        let d = MTLTextureDescriptor()\n        switch quality {\n" + cases + "        default: break\n        }\n"


def swift_closures(count: int) -> str:
    return repeated("        let f{n} = {{ (x: Int) in d.sampleCount = x }}\n        f{n}(4)\n", count)


def swift_closure_tree(count: int) -> str:
    body = "        let d = MTLTextureDescriptor()\n        let f0 = { (x: Int) in d.sampleCount = x }\n"
    return body + repeated("        let f{m} = {{ (x: Int) in f{n}(x); f{n}(x) }}\n", count) + f"        f{count}(4)\n"


def swift_optionals(count: int) -> str:
    body = repeated("        guard let a{m} = a{n}?.descriptor?.texture else {{ return }}\n", count)
    return "        let a0 = MTLTextureDescriptor()\n" + body


def swift_tuples(count: int) -> str:
    return "        let t0 = (1, 2)\n" + repeated("        let t{m} = (t{n}, t{n})\n        if on {{ t = t{m} }} else {{ t = t{n} }}\n", count)


def swift_long_sum(count: int) -> str:
    return f"        let samples = 1{' + 1' * count}\n        d.sampleCount = samples\n"


def swift_functions(count: int) -> str:
    every = repeated("    func f{n}() -> MTLTextureDescriptor {{ return f{m}() }}\n", count)
    return f"import Metal\nclass A {{\n{every}    func f{count}() -> MTLTextureDescriptor {{ return MTLTextureDescriptor() }}\n}}\n"


def swift_call_tree(count: int) -> str:
    every = repeated("    func f{n}(_ d: MTLTextureDescriptor) {{ f{m}(d); f{m}(d) }}\n", count)
    return f"import Metal\nclass A {{\n{every}    func f{count}(_ d: MTLTextureDescriptor) {{ d.sampleCount = 4 }}\n}}\n"


def swift_overloads(count: int) -> str:
    every = repeated("    func f(a{n}: Int) -> Int {{ return a{n} }}\n", count)
    return f"import Metal\nclass A {{\n{every}    func g() {{\n{repeated('        d.sampleCount = f(a{n}: {n})' + chr(10), count)}    }}\n}}\n"


def swift_types(count: int) -> str:
    return "import Metal\n" + repeated("class A{n}: B{n} {{ var samples = 4\n    func f() {{ d.sampleCount = samples }}\n}}\n", count)


SHAPES: tuple[Shape, ...] = (
    cpp("passes", passes),
    cpp("attachments of one pass", attachments_of_one_pass),
    cpp("passes of eight attachments", passes_of_many_attachments),
    cpp("overloads", overloads),
    cpp("functions", functions),
    cpp("call chain", call_chain),
    cpp("calls of one function", call_fan),
    cpp("functions that call the next twice", call_tree),
    cpp("recursive functions", recursion),
    cpp("conditional writes", conditional_writes),
    cpp("conditional copies", conditional_copies),
    cpp("conditional structures", conditional_structures),
    cpp("conditional counts", conditional_counts),
    cpp("negated conditions", negated_conditions),
    cpp("early returns", early_returns),
    cpp("nested blocks", nested("{", "}\n")),
    cpp("nested ifs", nested("if (flag#) {\n", "}\n")),
    cpp("nested loops", nested("for (int i# = 0; i# < 16; i#++) {\n", "}\n")),
    cpp("nested switches", nested("switch (v#) { case 4:\n", "}\n")),
    cpp("nested lambdas", nested("auto f# = [&]() {\n", "};\n")),
    cpp("else chain", else_chain),
    cpp("switch cases", switch),
    cpp("lambdas", lambdas),
    cpp("lambdas that call the last twice", nested_lambda_calls),
    cpp("macros", macros),
    cpp("enumerators", enumerators),
    cpp("enumerator values", enumerator_values),
    cpp("structure members", structure_members),
    cpp("class members", class_members),
    cpp("classes", classes),
    cpp("methods of objects", methods_of_objects),
    cpp("class layers", class_layers),
    cpp("templates", templates),
    cpp("namespaces", namespaces),
    cpp("nested namespaces", nested_namespaces),
    cpp("aliases", aliases),
    cpp("globals", globals_),
    cpp("prototypes", prototypes),
    cpp("designated items", designated),
    cpp("constant array", constant_array),
    cpp("declarators", declarators),
    cpp("long sum", long_sum),
    cpp("long condition", long_condition),
    cpp("long choice", long_choice),
    cpp("flags", flags),
    cpp("parentheses", parentheses),
    cpp("unary operators", unary),
    cpp("method chain", method_chain),
    cpp("arguments", arguments),
    cpp("parameters", parameters),
    cpp("comments", comments),
    cpp("strings", strings),
    cpp("open raw strings", open_strings),
    cpp("suppressions", suppressions),
    cpp("directives", directives),
    cpp("nested directives", nested_directives),
    cpp("directives in a list", list_directives),
    cpp("else directives in a list", else_directives),
    cpp("member writes", member_writes),
    cpp("member paths", member_paths),
    cpp("list appends", list_appends),
    cpp("copies of lists", copies_of_lists),
    cpp("doubled lists", doubled_lists),
    cpp("sample count choices", choices),
    cpp("uses of a choice", choice_uses),
    cpp("combined masks", choice_names),
    cpp("unread creations", unread_creations),
    cpp("open braces", unbalanced("{")),
    cpp("closing braces", unbalanced("}")),
    cpp("open parentheses", unbalanced("f(")),
    cpp("closing parentheses", unbalanced(")")),
    cpp("open lists", unbalanced("a = {")),
    cpp("open templates", unbalanced("a<b<")),
    cpp("broken statements", broken),
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
    swift("closures", swift_closures),
    swift("closures that call the last twice", swift_closure_tree),
    swift("optionals", swift_optionals),
    swift("tuples", swift_tuples),
    swift("long sum", swift_long_sum),
    code("Swift: functions", "a.swift", swift_functions),
    code("Swift: functions that call the next twice", "a.swift", swift_call_tree),
    code("Swift: overloads", "a.swift", swift_overloads),
    code("Swift: types", "a.swift", swift_types),
)

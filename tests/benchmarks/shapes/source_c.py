"""C++: what a file has many of, and how it can nest. What depends on its text is in
`source_c_syntax`.
"""

from __future__ import annotations

from collections.abc import Callable

from .shape import Shape
from .source_c_syntax import SHAPES as SYNTAX
from .source_code import IMAGE, cpp, function, repeated

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


def passes(count: int) -> str:
    return function(repeated(ATTACHMENT + PASS, count))


RENDERING = """\
    VkRenderingAttachmentInfo a{n} = {{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO}};
    a{n}.imageView = target->view();
    a{n}.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    a{n}.resolveImageView = other->view();
    a{n}.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo i{n} = {{VK_STRUCTURE_TYPE_RENDERING_INFO}};
    i{n}.colorAttachmentCount = 1;
    i{n}.pColorAttachments = &a{n};
    vkCmdBeginRendering(cmd, &i{n});
"""


def renderings_of_unknown_views(count: int) -> str:
    return function(repeated(RENDERING, count))


def images_and_descriptors(count: int) -> str:
    image = """\
    VkImageCreateInfo i{n} = {{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO}};
    i{n}.samples = VK_SAMPLE_COUNT_4_BIT;
    i{n}.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    vkCreateImage(device, &i{n}, nullptr, &image{n});
"""
    bound = (
        "    VkDescriptorImageInfo d{n} = {{}};\n    d{n}.imageView = view;\n    "
        "vkCmdCopyImage(cmd, from{n}, x, to, y, 1, &region);\n"
    )
    return function(repeated(image + bound, count))


def attachments_of_one_pass(count: int) -> str:
    listed = (
        f"    VkAttachmentDescription all[] = {{{', '.join(f'a{n}' for n in range(count))}}};\n"
    )
    info = (
        f"    VkRenderPassCreateInfo info = {{}};\n    info.attachmentCount = {count};\n    "
        "info.pAttachments = all;\n"
    )
    return function(
        repeated(ATTACHMENT, count)
        + listed
        + info
        + "    vkCreateRenderPass(device, &info, nullptr, &pass);\n"
    )


def passes_of_many_attachments(count: int) -> str:
    many = 8
    bodies = []
    for number in range(count):
        body = repeated(ATTACHMENT, many)
        body += (
            f"    VkAttachmentDescription all[{many}] = "
            f"{{{', '.join(f'a{n}' for n in range(many))}}};\n"
        )
        body += repeated(
            "    VkAttachmentReference r{n} = {{{n}, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};\n",
            many,
        )
        body += (
            f"    VkAttachmentReference refs[{many}] = "
            f"{{{', '.join(f'r{n}' for n in range(many))}}};\n"
        )
        body += (
            f"    VkSubpassDescription sub = {{}};\n    sub.colorAttachmentCount = {many};\n   "
            " sub.pColorAttachments = refs;\n"
        )
        body += (
            f"    VkRenderPassCreateInfo info = {{}};\n    info.attachmentCount = {many};\n    "
            "info.pAttachments = all;\n"
        )
        body += (
            "    info.subpassCount = 1;\n    info.pSubpasses = &sub;\n    "
            "vkCreateRenderPass(device, &info, nullptr, &pass);\n"
        )
        bodies.append(function(body, f"void setup{number}()"))
    return "".join(bodies)


def overloads(count: int) -> str:
    many = repeated(
        "struct T{n} {{ int v; }};\nvoid create(T{n} t, int samples) {{ image{n} = t.v + samples; "
        "}}\n",
        count,
    )
    return many + function(
        repeated("    T{n} t{n};\n    create(t{n}, VK_SAMPLE_COUNT_4_BIT);\n", count)
    )


def functions(count: int) -> str:
    return repeated(
        "void create{n}(int samples) {{\n" + IMAGE.replace("{", "{{").replace("}", "}}") + "}}\n",
        count,
    )


def call_chain(count: int) -> str:
    chain = repeated("void create{n}(int samples) {{ create{m}(samples); }}\n", count)
    return chain + function(IMAGE, f"void create{count}(int samples)")


def call_fan(count: int) -> str:
    return function(IMAGE, "void create(int samples)") + function(
        "    create(VK_SAMPLE_COUNT_4_BIT);\n" * count
    )


def call_tree(count: int) -> str:
    """Functions that call the next one twice."""
    chain = repeated(
        "void create{n}(int samples) {{ create{m}(samples); create{m}(samples); }}\n", count
    )
    return chain + function(IMAGE, f"void create{count}(int samples)")


def recursion(count: int) -> str:
    every = repeated(
        "int sample{n}(int n) {{ return n > 0 ? sample{n}(n - 1) + sample{m}(n) : 4; }}\n", count
    )
    return every + function("    return 4;\n", f"int sample{count}(int n)")


def conditional_writes(count: int) -> str:
    return function(
        "    int count = 1;\n"
        + repeated("    if (flag{n}) count = VK_SAMPLE_COUNT_4_BIT;\n", count)
        + IMAGE
    )


def conditional_copies(count: int) -> str:
    """Structures that hold each other's alternatives."""
    writes = repeated(
        "    if (c{n}) a.x = b;\n    if (d{n}) b.x = a;\n    if (e{n}) a.samples = b.samples;\n",
        count,
    )
    return function(
        "    Config a, b;\n    a.samples = 1;\n    b.samples = 4;\n"
        + writes
        + IMAGE.replace("= samples", "= a.samples")
    )


def conditional_structures(count: int) -> str:
    """Structures of structures, each written under conditions."""
    body = (
        "    VkAttachmentDescription v0 = {}, w0 = {};\n    v0.samples = VK_SAMPLE_COUNT_4_BIT;\n"
    )
    for number in range(count):
        body += f"    Config v{number + 1};\n"
        body += "".join(
            f"    if (c{number}_{way}) v{number + 1}.m{way % 2} = v{number};\n" for way in range(4)
        )
    return function(body + f"    vkCreateThing(device, &v{count}, nullptr, &image);\n")


def conditional_counts(count: int) -> str:
    body = "    int count = 1;\n" + repeated("    count = flag{n} ? count : count * 2;\n", count)
    return function(body + IMAGE.replace("= samples", "= count"))


def negated_conditions(count: int) -> str:
    body = "    bool on = flag;\n" + repeated(
        "    bool on{n} = !(on || !(flag{n} && !on));\n    on = on{n} || on;\n", count
    )
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
    return function(
        repeated("    auto f{n} = [&](int n) {{ samples = n; }};\n    f{n}(4);\n", count) + IMAGE
    )


def nested_lambda_calls(count: int) -> str:
    chain = "    auto f0 = [&](int n) { samples = n; };\n" + repeated(
        "    auto f{m} = [&](int n) {{ f{n}(n); f{n}(n); }};\n", count
    )
    return function(chain + f"    f{count}(4);\n" + IMAGE)


def macros(count: int) -> str:
    return repeated("#define SAMPLES_{m} SAMPLES_{n}\n", count) + function(
        IMAGE.replace("= samples", f"= SAMPLES_{count}")
    )


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
    return repeated(
        "class C{m} : public C{n} {{ int samples = 4; virtual void set(int n) {{ samples = n; }} "
        "}};\n",
        count,
    )


def methods_of_objects(count: int) -> str:
    kinds = repeated("struct K{n} {{ int samples; void set(int n) {{ samples = n; }} }};\n", count)
    return kinds + function(repeated("    K{n} k{n};\n    k{n}.set(4);\n", count) + IMAGE)


def class_layers(count: int) -> str:
    """Objects that hold objects: `a.b.c.samples`."""
    kinds = "struct K0 { int samples; };\n" + repeated("struct K{m} {{ K{n} inner; }};\n", count)
    return kinds + function(
        f"    K{count} k;\n    k" + ".inner" * count + ".samples = 4;\n" + IMAGE
    )


def templates(count: int) -> str:
    return repeated(
        "template <typename T> T pick{n}(T samples) {{ return samples; }}\n", count
    ) + function(repeated("    samples = pick{n}<int>(4);\n", count) + IMAGE)


def namespaces(count: int) -> str:
    return repeated("namespace n{n} {{ const int samples = {n}; }}\n", count) + function(
        repeated("    samples = n{n}::samples;\n", count) + IMAGE
    )


def nested_namespaces(count: int) -> str:
    return (
        repeated("namespace n{n} {{\n", count)
        + function("    samples = other;\n" * count + IMAGE)
        + "}\n" * count
    )


def aliases(count: int) -> str:
    return repeated("using Image{n} = VkImage;\n", count) + function(
        repeated("    Image{n} i{n};\n", count) + IMAGE
    )


def globals_(count: int) -> str:
    return repeated("static int samples{n} = VK_SAMPLE_COUNT_4_BIT;\n", count) + function(
        repeated("    samples{n} = 2;\n", count) + IMAGE
    )


def prototypes(count: int) -> str:
    return repeated(
        "void create{n}(VkDevice device, const VkImageCreateInfo* info, VkImage* image);\n", count
    ) + function(repeated("    create{n}(device, &info, &image{n});\n", count))


def designated(count: int) -> str:
    item = (
        "        [{n}] = {{.format = VK_FORMAT_R8G8B8A8_UNORM, .samples = "
        "VK_SAMPLE_COUNT_4_BIT}},\n"
    )
    return function(f"    VkAttachmentDescription all[] = {{\n{repeated(item, count)}    }};\n")


def constant_array(count: int) -> str:
    return f"const int samples[] = {{{', '.join(str(n) for n in range(count))}}};\n" + function(
        IMAGE
    )


def declarators(count: int) -> str:
    return function(
        f"    int samples0{''.join(f', samples{n} = {n}' for n in range(1, count + 1))};\n" + IMAGE
    )


def long_sum(count: int) -> str:
    return function(f"    samples = 1{' + samples' * count};\n" + IMAGE)


def long_condition(count: int) -> str:
    return function(f"    if (flag{repeated(' || flag{n}', count)}) samples = 4;\n" + IMAGE)


def long_choice(count: int) -> str:
    return function(f"    samples = {repeated('flag{n} ? {n} : ', count)}4;\n" + IMAGE)


def flags(count: int) -> str:
    return function(
        f"    info.usage = {' | '.join(['VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT'] * (count + 1))};\n"
        + IMAGE
    )


def parentheses(count: int) -> str:
    return function(f"    samples = {'(' * count}4{')' * count};\n" + IMAGE)


def unary(count: int) -> str:
    return function(f"    samples = {'!' * count}4;\n" + IMAGE)


def method_chain(count: int) -> str:
    return function(
        "    auto info = vk::ImageCreateInfo()"
        + ".setSamples(vk::SampleCountFlagBits::e4)" * count
        + ";\n"
    )


def arguments(count: int) -> str:
    return function(f"    create({', '.join(f'&image{n}' for n in range(count + 1))});\n" + IMAGE)


def parameters(count: int) -> str:
    return function(
        IMAGE, f"void setup({', '.join(f'int samples{n} = 4' for n in range(count + 1))})"
    )


SHAPES: tuple[Shape, ...] = (
    *SYNTAX,
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
    cpp("renderings of unknown views", renderings_of_unknown_views),
    cpp("images and descriptors", images_and_descriptors),
    cpp("parentheses", parentheses),
    cpp("unary operators", unary),
    cpp("method chain", method_chain),
    cpp("arguments", arguments),
    cpp("parameters", parameters),
)

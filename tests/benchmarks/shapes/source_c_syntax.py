"""C++: comments, strings, directives, lists, and broken code."""

from __future__ import annotations

from collections.abc import Callable

from .shape import Shape
from .source_code import IMAGE, cpp, function, repeated


def comments(count: int) -> str:
    return function('    // samples: "a /* b\n    /* samples \\*/\n' * count + IMAGE)


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
    return (
        "class R {\n    VkImage image;\n"
        + repeated("    void make{n}(int samples) {{\n" + IMAGE.replace("{", "{{").replace("}", "}}") + "    }}\n", count)
        + "};\n"
    )


def member_paths(count: int) -> str:
    return "class R {\n    Config config;\n    void make() {\n" + repeated("        config.a{n}.samples = 4;\n", count) + "    }\n};\n"


def list_appends(count: int) -> str:
    body = (
        "    std::vector<VkAttachmentDescription> all;\n" + "    all.push_back(a);\n    all[0].samples = VK_SAMPLE_COUNT_4_BIT;\n" * count
    )
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


SHAPES: tuple[Shape, ...] = (
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
)

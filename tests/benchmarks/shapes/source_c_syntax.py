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
    return function(
        repeated("#ifdef FLAG{n}\n", count) + "    samples = 4;\n" + "#endif\n" * count + IMAGE
    )


def list_directives(count: int) -> str:
    item = "#ifdef FLAG{n}\n        {{.samples = VK_SAMPLE_COUNT_4_BIT}},\n#endif\n"
    return function(f"    VkAttachmentDescription all[] = {{\n{repeated(item, count)}    }};\n")


def else_directives(count: int) -> str:
    chain = (
        "#if FLAG\n        {.samples = 1},\n"
        + repeated("#elif FLAG{n}\n        {{.samples = 4}},\n", count)
        + "#endif\n"
    )
    return function(f"    VkAttachmentDescription all[] = {{\n{chain}    }};\n")


def member_writes(count: int) -> str:
    """A member of the class that many methods write."""
    return (
        "class R {\n    VkImage image;\n"
        + repeated(
            "    void make{n}(int samples) {{\n"
            + IMAGE.replace("{", "{{").replace("}", "}}")
            + "    }}\n",
            count,
        )
        + "};\n"
    )


def member_paths(count: int) -> str:
    return (
        "class R {\n    Config config;\n    void make() {\n"
        + repeated("        config.a{n}.samples = 4;\n", count)
        + "    }\n};\n"
    )


def list_appends(count: int) -> str:
    body = (
        "    std::vector<VkAttachmentDescription> all;\n"
        + "    all.push_back(a);\n    all[0].samples = VK_SAMPLE_COUNT_4_BIT;\n" * count
    )
    return function(body)


def copies_of_lists(count: int) -> str:
    body = (
        "    std::vector<VkAttachmentDescription> l0(64);\n"
        f"{repeated('    auto l{m} = l{n};' + chr(10), count)}"
    )
    return function(body + IMAGE)


def doubled_lists(count: int) -> str:
    body = "    VkAttachmentDescription a0 = {};\n" + repeated(
        "    std::vector<Config> a{m} = {{a{n}, a{n}}};\n", count
    )
    return function(body + IMAGE)


def choices(count: int) -> str:
    one = (
        "VkSampleCountFlagBits pick{n}() {{\n    VkSampleCountFlags counts = "
        "limits.framebufferColorSampleCounts;\n"
        "    if (counts & VK_SAMPLE_COUNT_64_BIT) return VK_SAMPLE_COUNT_64_BIT;\n"
        "    if (counts & VK_SAMPLE_COUNT_8_BIT) return VK_SAMPLE_COUNT_8_BIT;\n    return "
        "VK_SAMPLE_COUNT_1_BIT;\n}}\n"
    )
    return repeated(one, count)


def choice_uses(count: int) -> str:
    return choices(1) + function(
        repeated("    info{n}.samples = pick0();\n    info{n}.format = findFormat{n}();\n", count)
    )


def choice_names(count: int) -> str:
    assigned = repeated("    counts{m} = counts{n} & limits.framebufferDepthSampleCounts;\n", count)
    return choices(1) + function(
        "    auto counts0 = limits.framebufferColorSampleCounts;\n" + assigned
    )


def unread_creations(count: int) -> str:
    return function(
        repeated(
            "    info.samples = settings{n};\n    createImage(info, VK_SAMPLE_COUNT_4_BIT);\n",
            count,
        )
    )


def unbalanced(sign: str) -> Callable[[int], str]:
    return lambda count: function("    samples = 4;\n" + f"    {sign}\n" * count)


def broken(count: int) -> str:
    return function("    VkImageCreateInfo = ; samples )( {{ = 4 }} ;\n" * count + IMAGE)


def macro_uses(count: int) -> str:
    """Uses of macros that use others."""
    macros = (
        "#define SET(info, name, value) info.name = value\n#define IMAGE(info, count) "
        "SET(info, samples, VK_SAMPLE_COUNT_##count##_BIT)\n"
    )
    return macros + function("    IMAGE(info, 4);\n" * count + IMAGE)


def doubled_macros(count: int) -> str:
    """Each macro doubles the one before it."""
    return (
        "#define M0 samples\n"
        + repeated("#define M{m} M{n} M{n}\n", count)
        + function(f"    M{count};\n" + IMAGE)
    )


def long_macros(count: int) -> str:
    """A list in a macro, and a use of it for each of its items."""
    items = "#define ITEMS(X) " + repeated("X({n}) ", count) + "\n#define X(n) samples = n;\n"
    return items + function("    ITEMS(X)\n" * count + IMAGE)


def open_macros(count: int) -> str:
    """Uses of a macro whose arguments do not end."""
    return "#define M(x) x\n" + function("    M(samples\n" * count + IMAGE)


def structural_directives(count: int) -> str:
    """Conditions whose parts open braces."""
    return function(
        repeated("#ifdef FLAG{n}\n    if (samples) {{\n#else\n    {{\n#endif\n    }}\n", count)
        + IMAGE
    )


def outer_directives(count: int) -> str:
    return repeated("#ifdef FLAG{n}\n", count) + function(IMAGE) + "#endif\n" * count


def settled_directives(count: int) -> str:
    return "#define N 4\n" + function(
        repeated(
            "#if N > {n} && N < 8\n    samples = {n};\n#else\n    samples = 1;\n#endif\n", count
        )
        + IMAGE
    )


def annotations(count: int) -> str:
    return repeated(
        "ENGINE_API ENGINE_INLINE void ENGINE_CALL f{n}(int samples) NOEXCEPT {{}}\n"
        "DECLARE(f{n})\n",
        count,
    ) + function(IMAGE)


def small_functions(count: int) -> str:
    """Functions of which each calls the next one."""
    return repeated("void f{n}() {{ f{m}(); }}\n", count) + function(IMAGE)


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
    cpp("uses of macros", macro_uses),
    cpp("doubled macros", doubled_macros),
    cpp("long macros", long_macros),
    cpp("open macros", open_macros),
    cpp("directives that split braces", structural_directives),
    cpp("directives around functions", outer_directives),
    cpp("settled directives", settled_directives),
    cpp("annotations", annotations),
    cpp("functions that call the next", small_functions),
)

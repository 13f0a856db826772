"""How programs choose their sample count: entries, locations, and what must not be reported."""

from __future__ import annotations

import time
from typing import Any, get_args

import pytest

from msaa_lint.core.text.node import Node
from msaa_lint.frame.description.models import SampleCountChoice, SampleCountLimit
from msaa_lint.input.code.c import description_trees as c_trees
from msaa_lint.input.code.parsing import Code
from msaa_lint.input.code.rust import description_trees as rust_trees
from msaa_lint.input.code.sample_counts.masks import LIMITS
from msaa_lint.input.code.sample_counts.program_formats import with_formats
from msaa_lint.input.source_file import read_source_file
from msaa_lint.linter.lint_options import LintOptions
from tests.test_rules import ENGINE, as_written, lint

COLOR, DEPTH, STENCIL = (
    f"framebuffer{aspect}SampleCounts" for aspect in ("Color", "Depth", "Stencil")
)
BOTH = f"VkSampleCountFlags counts = p.limits.{COLOR} & p.limits.{DEPTH};"
DESCENDING = [(64, 64), (32, 32), (16, 16), (8, 8), (4, 4), (2, 2)]
FROM_EIGHT = [(8, 8), (4, 4)]


def plain(node: Node) -> Any:
    if node.kind == "mapping":
        return {key: plain(value) for key, value in node.value.items()}
    return [plain(each) for each in node.value] if node.kind == "sequence" else node.value


def read(text: str, language: str = "cpp") -> dict[str, dict[str, Any]]:
    trees = rust_trees if language == "rust" else c_trees
    syntax = trees.file_syntax(Code(text, language))
    return {name: plain(node) for name, _, node in with_formats(syntax.choices, syntax.unit)}


def only(text: str, language: str = "cpp") -> dict[str, Any]:
    found = read(text, language)
    assert len(found) == 1, found
    return next(iter(found.values()))


def asked(found: dict[str, Any]) -> list[tuple[int, int]]:
    return [(test["tests"], test["gives"]) for test in found.get("tests", ())]


def fired(text: str, language: str = "cpp") -> list[tuple[str, int, str]]:
    """Returns the findings about choices: code, line, and the text at their location."""
    name = f"example.{language}"
    linted = ENGINE.lint(
        read_source_file(text.encode(), name, language), name, LintOptions(as_written)
    )
    assert linted.source is not None
    found = []
    for each in linted.findings:
        if each.code[:6] == "MSAA85":
            assert each.span is not None
            assert each.confidence in ("low", "medium")
            found.append(
                (
                    each.code,
                    linted.source.position(each.span.start).line,
                    text[each.span.start : each.span.end],
                )
            )
    return sorted(found)


def chain(
    counts: list[tuple[int, int]],
    form: str = "if (counts & VK_SAMPLE_COUNT_{0}_BIT) return VK_SAMPLE_COUNT_{1}_BIT;",
) -> str:
    return "\n".join(form.format(tested, given) for tested, given in counts)


def function(body: str, name: str = "pick") -> str:
    return (
        f"VkSampleCountFlagBits {name}(VkPhysicalDeviceProperties p) {{\n{BOTH}\n{body}\nreturn "
        f"VK_SAMPLE_COUNT_1_BIT;\n}}\n"
    )


def test_the_limits_are_those_of_the_format() -> None:
    assert SampleCountChoice.SHAPE["limits"] == ("list", ("word", get_args(SampleCountLimit)))
    assert set(get_args(SampleCountLimit)) == LIMITS


STYLES = {
    "ifs": chain(DESCENDING),
    "blocks": chain(
        DESCENDING, "if (counts & VK_SAMPLE_COUNT_{0}_BIT) {{ return VK_SAMPLE_COUNT_{1}_BIT; }}"
    ),
    "swapped": chain(
        DESCENDING, "if (VK_SAMPLE_COUNT_{0}_BIT & counts) return VK_SAMPLE_COUNT_{1}_BIT;"
    ),
    "compared": chain(
        DESCENDING, "if ((counts & VK_SAMPLE_COUNT_{0}_BIT) != 0) return VK_SAMPLE_COUNT_{1}_BIT;"
    ),
    "equal": chain(
        DESCENDING,
        "if ((counts & VK_SAMPLE_COUNT_{0}_BIT) == VK_SAMPLE_COUNT_{0}_BIT) return "
        "VK_SAMPLE_COUNT_{1}_BIT;",
    ),
    "numbers": chain(DESCENDING, "if (counts & {0}u) return (VkSampleCountFlagBits){1};"),
    "logged": chain(
        DESCENDING,
        'if (counts & VK_SAMPLE_COUNT_{0}_BIT) {{ log("{0}"); return VK_SAMPLE_COUNT_{1}_BIT; }}',
    ),
    "halved": "for (uint32_t c = 64; c > 1; c >>= 1) if (counts & c) return "
    "(VkSampleCountFlagBits)c;",
    "halved by division": """for (uint32_t c = VK_SAMPLE_COUNT_64_BIT; c >= 2; c /= 2) {
        if ((counts & c) != 0u) { return (VkSampleCountFlagBits)c; } }""",
    "shifted": "for (int i = 6; i > 0; --i) if (counts & (1u << i)) return "
    "(VkSampleCountFlagBits)(1u << i);",
}


@pytest.mark.parametrize("language", ["c", "cpp"])
@pytest.mark.parametrize("style", STYLES)
def test_a_chain_from_above(style: str, language: str) -> None:
    found = only(function(STYLES[style]), language)
    assert found["limits"] == [COLOR, DEPTH]
    assert found["combined"] == "AND"
    assert (found["chosen"], found["atMost"]) == ("MAXIMUM", 64)
    assert asked(found) == DESCENDING


CPP_STYLES = {
    "listed": "for (auto c : {VK_SAMPLE_COUNT_8_BIT, VK_SAMPLE_COUNT_4_BIT}) if (counts & c) "
    "return c;",
    "array": """const VkSampleCountFlagBits order[] = {VK_SAMPLE_COUNT_8_BIT, VK_SAMPLE_COUNT_4_BIT};
        for (size_t i = 0; i < std::size(order); i++) { if ((counts & order[i]) == order[i]) return order[i]; }""",
    "vector": """static const std::vector<VkSampleCountFlagBits> order{VK_SAMPLE_COUNT_8_BIT, VK_SAMPLE_COUNT_4_BIT};
        for (const auto& c : order) { if (counts & c) { return c; } }""",
    "ternary": """return counts & VK_SAMPLE_COUNT_8_BIT ? VK_SAMPLE_COUNT_8_BIT
        : (counts & VK_SAMPLE_COUNT_4_BIT) ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;""",
    "hpp": chain(
        FROM_EIGHT,
        "if (counts & vk::SampleCountFlagBits::e{0}) return vk::SampleCountFlagBits::e{1};",
    ),
    "using enum": "using enum vk::SampleCountFlagBits;"
    + chain(FROM_EIGHT, "if (counts & e{0}) return e{1};"),
    "cast flags": chain(
        FROM_EIGHT,
        "if (static_cast<bool>(counts & VK_SAMPLE_COUNT_{0}_BIT)) return VK_SAMPLE_COUNT_{1}_BIT;",
    ),
}


@pytest.mark.parametrize("style", CPP_STYLES)
def test_a_chain_from_eight(style: str) -> None:
    found = only(function(CPP_STYLES[style]))
    assert (found["chosen"], found["atMost"]) == ("ATMOST", 8)
    assert asked(found) == FROM_EIGHT


def test_else_if_gives_a_member() -> None:
    text = f"void App::init() {{ auto counts = props.limits.{COLOR};\n" + " else ".join(
        f"if (counts & VK_SAMPLE_COUNT_{n}_BIT) {{ m_samples = VK_SAMPLE_COUNT_{n}_BIT; }}"
        for n in (64, 8, 2)
    )
    found = read(text + " else { m_samples = VK_SAMPLE_COUNT_1_BIT; } }")
    assert asked(found["m_samples"]) == [(64, 64), (8, 8), (2, 2)]
    assert found["m_samples"]["combined"] == "NONE"
    assert fired(text + "}") == [("MSAA851", 2, "counts & VK_SAMPLE_COUNT_64_BIT")]


def test_tests_that_write_over_one_another_are_read_from_the_last() -> None:
    body = "\n".join(
        f"if (counts & VK_SAMPLE_COUNT_{n}_BIT) best = VK_SAMPLE_COUNT_{n}_BIT;" for n in (2, 4, 8)
    )
    found = only(
        f"void f() {{ {BOTH} VkSampleCountFlagBits best = VK_SAMPLE_COUNT_1_BIT; {body} }}"
    )
    assert asked(found) == [(8, 8), (4, 4), (2, 2)]
    assert found["atMost"] == 8


@pytest.mark.parametrize(
    "expression",
    [
        "std::bit_floor(counts)",
        "1u << (31 - __builtin_clz(counts))",
        "1u << (31u ^ std::countl_zero(counts))",
        "1u << (std::bit_width(counts) - 1)",
        "1 << glm::findMSB(counts)",
        "glm::highestBitValue(counts)",
        "std::pow(2, std::floor(std::log2(counts)))",
    ],
)
def test_the_highest_bit(expression: str) -> None:
    found = only(
        f"VkSampleCountFlagBits top() {{ {BOTH} return "
        f"static_cast<VkSampleCountFlagBits>({expression}); }}"
    )
    assert (found["chosen"], found["atMost"]) == ("MAXIMUM", 64)
    assert found["limits"] == [COLOR, DEPTH]


def test_the_highest_bit_of_a_masked_mask() -> None:
    found = only(
        f"auto top() {{ {BOTH} return std::bit_floor(counts & (VK_SAMPLE_COUNT_4_BIT | "
        f"VK_SAMPLE_COUNT_2_BIT | 1)); }}"
    )
    assert (found["chosen"], found["atMost"]) == ("ATMOST", 4)


def test_a_count_that_waits_for_its_bit() -> None:
    text = (
        f"void f() {{ {BOTH} uint32_t samples = 64; while (samples > 1 && !(counts & samples)) "
        f"samples >>= 1; use(samples); }}"
    )
    assert asked(only(text)) == DESCENDING
    empty = (
        f"void f() {{ {BOTH} uint32_t c; for (c = 8; (counts & c) == 0; c >>= 1) {{}} use(c); }}"
    )
    assert asked(only(empty)) == [(8, 8), (4, 4), (2, 2), (1, 1)]


def test_masks_are_followed() -> None:
    """Through functions, members, parameters, `&=`, conditions, and lambdas."""
    both = f"VkSampleCountFlags both() {{ return p.limits.{COLOR} & p.limits.{DEPTH}; }}"
    taken = (
        f"VkSampleCountFlagBits top() {{ auto c = both(); "
        f"{chain(FROM_EIGHT).replace('counts', 'c')} return VK_SAMPLE_COUNT_1_BIT; }}"
    )
    assert only(both + taken)["limits"] == [COLOR, DEPTH]
    assert only(taken + both)["limits"] == [COLOR, DEPTH]
    of_member = chain(FROM_EIGHT).replace("counts", "m_counts")
    member = (
        f"void a() {{ m_counts = p.limits.{COLOR}; }} VkSampleCountFlagBits b() {{ {of_member} }}"
    )
    assert only(member)["limits"] == [COLOR]
    added = f"{BOTH} if (hasStencil(format)) counts &= p.limits.{STENCIL}; {chain(FROM_EIGHT)}"
    assert only(f"VkSampleCountFlagBits f() {{ {added} }}")["limits"] == [COLOR, DEPTH, STENCIL]
    chosen = (
        f"auto counts = stencil ? p.limits.{COLOR} & p.limits.{STENCIL} : p.limits.{COLOR}; "
        f"{chain(FROM_EIGHT)}"
    )
    assert only(f"VkSampleCountFlagBits f() {{ {chosen} }}")["limits"] == [COLOR, STENCIL]
    given = (
        f"VkSampleCountFlagBits f(VkSampleCountFlags counts) {{ {chain(FROM_EIGHT)} return "
        f"VK_SAMPLE_COUNT_1_BIT; }}"
    )
    # The caller decides which mask it is and what is left of it.
    assert list(only(given)) == ["tests"]
    inner = (
        f"void f() {{ {BOTH} auto pick = [&]() {{ {chain(FROM_EIGHT)} return "
        f"VK_SAMPLE_COUNT_1_BIT; }}; samples = pick(); }}"
    )
    assert list(read(inner)) == ["pick"]
    second = (
        f"void f() {{ VkPhysicalDeviceProperties2 p2; auto counts = "
        f"p2.properties.limits.{COLOR}; {chain(FROM_EIGHT)} }}"
    )
    assert only(second)["limits"] == [COLOR]


def test_a_mask_that_is_given_anew_between_tests() -> None:
    first = f"auto c = l.{COLOR}; if (c & VK_SAMPLE_COUNT_4_BIT) return VK_SAMPLE_COUNT_4_BIT;"
    second = (
        "c = l.sampledImageColorSampleCounts; if (c & VK_SAMPLE_COUNT_4_BIT) return "
        "VK_SAMPLE_COUNT_2_BIT;"
    )
    assert (
        read(f"VkSampleCountFlagBits f() {{ {first} {second} return VK_SAMPLE_COUNT_1_BIT; }}")
        == {}
    )


def test_two_bits_of_two_masks() -> None:
    both = (
        f"(p.limits.{COLOR} & VK_SAMPLE_COUNT_{{0}}_BIT) && (p.limits.{DEPTH} & "
        f"VK_SAMPLE_COUNT_{{0}}_BIT)"
    )
    found = only(
        f"VkSampleCountFlagBits f() {{ "
        f"{chain(FROM_EIGHT, f'if ({both}) return VK_SAMPLE_COUNT_{{1}}_BIT;')} }}"
    )
    assert found["combined"] == "AND"
    assert found["limits"] == [COLOR, DEPTH]


WRONG = [
    (f"VkSampleCountFlags c = std::min(p.limits.{COLOR}, p.limits.{DEPTH});", "MIN", "std::min"),
    (f"VkSampleCountFlags c = std::max(p.limits.{COLOR}, p.limits.{DEPTH});", "MAX", "std::max"),
    (
        f"auto c = std::min<VkSampleCountFlags>(p.limits.{COLOR}, p.limits.{DEPTH});",
        "MIN",
        "std::min<VkSampleCountFlags>",
    ),
    (
        f"auto c = std::min({{p.limits.{COLOR}, p.limits.{DEPTH}, p.limits.{STENCIL}}});",
        "MIN",
        "std::min",
    ),
    (f"VkSampleCountFlags c = MIN(p->limits.{COLOR}, p->limits.{DEPTH});", "MIN", "MIN"),
    (
        f"auto a = l.{COLOR}; auto b = l.{DEPTH}; VkSampleCountFlags c = a < b ? a : b;",
        "MIN",
        "a < b",
    ),
    (
        f"auto a = l.{COLOR}; auto b = l.{DEPTH}; VkSampleCountFlags c = a < b ? b : a;",
        "MAX",
        "a < b",
    ),
    (
        f"auto a = l.{COLOR}; auto b = l.{DEPTH}; VkSampleCountFlags c; if (a > b) c = b; else c = "
        "a;",
        "MIN",
        "a > b",
    ),
    (f"VkSampleCountFlags c = l.{COLOR} && l.{DEPTH};", "LOGICAL_AND", "&&"),
    (f"uint32_t c = l.{COLOR} || l.{DEPTH};", "LOGICAL_OR", "||"),
    (f"c = l.{COLOR} & std::min(l.{DEPTH}, l.{STENCIL});", "MIN", "std::min"),
]


@pytest.mark.parametrize(("text", "combined", "at"), WRONG)
def test_masks_that_are_compared(text: str, combined: str, at: str) -> None:
    text = f"void f() {{ {text} }}"
    assert only(text)["combined"] == combined
    assert fired(text) == [("MSAA852", 1, at)]


def test_what_is_given_of_either_mask() -> None:
    text = (
        f"VkSampleCountFlagBits f() {{ auto counts = l.{COLOR} | l.{DEPTH};\n"
        f"{chain([(4, 4), (2, 2)])}\nreturn VK_SAMPLE_COUNT_1_BIT; }}"
    )
    assert fired(text) == [("MSAA852", 1, "|")]


def test_a_bit_that_is_tested_again() -> None:
    """The location of the second test."""
    text = function(
        chain(
            [(8, 8), (8, 4), (8, 2)],
            "if(counts & vk::SampleCountFlagBits::e{0}) return vk::SampleCountFlagBits::e{1};",
        )
    )
    assert [each for each in fired(text) if each[0] == "MSAA853"] == [
        ("MSAA853", 4, "counts & vk::SampleCountFlagBits::e8")
    ]
    ternary = (
        "return counts & 4 ? VK_SAMPLE_COUNT_4_BIT : counts & 4 ? VK_SAMPLE_COUNT_2_BIT : "
        "VK_SAMPLE_COUNT_1_BIT;"
    )
    assert fired(function(ternary)) == [("MSAA853", 3, "counts & 4")]
    nested = (
        "if (counts & 4) best = VK_SAMPLE_COUNT_4_BIT;\nelse if (counts & 4)\nbest = "
        "VK_SAMPLE_COUNT_2_BIT;"
    )
    assert fired(f"void f() {{ {BOTH}\n{nested} }}") == [("MSAA853", 3, "counts & 4")]


def test_the_message_says_what_is_never_given() -> None:
    linted = lint(function(chain([(8, 8), (8, 4), (8, 2)])), language="cpp")
    (found,) = [each for each in linted.findings if each.code == "MSAA853"]
    assert "4, 2 is never returned" in found.message
    assert [label.text for label in found.labels] == ["the same bit is tested here first"]


DEPTH_FORMAT = """
VkFormat findDepthFormat() {
    return findSupportedFormat({VK_FORMAT_D32_SFLOAT, VK_FORMAT_D24_UNORM_S8_UINT}, VK_IMAGE_TILING_OPTIMAL);
}
bool hasStencil(VkFormat f) { return f == VK_FORMAT_D16_UNORM_S8_UINT; }
"""


def test_formats_of_images_that_get_the_count() -> None:
    """Through a function, a variable, and a call that creates the image; a comparison names no
    format.
    """
    text = (
        function(chain([(4, 4)]))
        + DEPTH_FORMAT
        + "void a() { m_samples = pick(p); }\nvoid b() { VkFormat format = findDepthFormat();\n"
    )
    found = only(text + "createImage(w, h, 1, m_samples, format, image); }")
    assert found["formats"] == ["D32_SFLOAT", "D24_UNORM_S8_UINT"]
    assert fired(text + "createImage(w, h, 1, m_samples, format, image); }") == [
        ("MSAA854", 2, f"p.limits.{DEPTH}")
    ]
    assert "formats" not in only(
        text + "createImage(w, h, 1, VK_SAMPLE_COUNT_1_BIT, format, image); }"
    )
    assert "formats" not in only(
        text + "createImage(w, h, 1, m_samples, VK_FORMAT_R8G8B8A8_UNORM, image); }"
    )


@pytest.mark.parametrize(
    "use",
    [
        "VkImageCreateInfo info{}; info.format = VK_FORMAT_D24_UNORM_S8_UINT; info.samples = "
        "samples;",
        "VkImageCreateInfo info = {.format = VK_FORMAT_D24_UNORM_S8_UINT, .samples = samples};",
        "depth = Image(device, vk::Format::eD24UnormS8Uint, samples);",
    ],
)
def test_a_format_beside_the_count(use: str) -> None:
    text = function(chain([(4, 4)])) + f"void b() {{ auto samples = pick(p); {use} }}"
    assert only(text)["formats"] == ["D24_UNORM_S8_UINT"]
    assert [code for code, _, _ in fired(text)] == ["MSAA854"]


def test_a_count_that_a_constructor_keeps() -> None:
    kept = (
        "App::App(Gpu& gpu) : samples(gpu.pick(p)), depth(gpu, gpu.findDepthFormat(), samples) {}"
    )
    formats = DEPTH_FORMAT.replace("findDepthFormat", "Gpu::findDepthFormat")
    assert only(function(chain([(4, 4)]), "Gpu::pick") + formats + kept)["formats"] == [
        "D32_SFLOAT",
        "D24_UNORM_S8_UINT",
    ]


def test_stencil_that_is_asked_or_not_there() -> None:
    use = "void b() { auto samples = pick(p); createImage(samples, VK_FORMAT_D24_UNORM_S8_UINT); }"
    asked = function(f"counts &= p.limits.{STENCIL};\n{chain([(4, 4)])}")
    assert fired(asked + use) == []
    assert fired(function(chain([(4, 4)])) + use.replace("D24_UNORM_S8_UINT", "D32_SFLOAT")) == []


def test_caps() -> None:
    from_above = function(chain(DESCENDING))
    assert (
        only(from_above + "void f() { samples = std::min(pick(p), VK_SAMPLE_COUNT_4_BIT); }")[
            "atMost"
        ]
        == 4
    )
    assert (
        fired(from_above + "void f() { samples = std::min(pick(p), VK_SAMPLE_COUNT_4_BIT); }") == []
    )
    assert (
        fired(
            from_above
            + "void f() { auto most = pick(p); samples = std::min(most, VK_SAMPLE_COUNT_2_BIT); }"
        )
        == []
    )
    assert (
        only(
            from_above + "void f() { auto most = pick(p); samples = MIN(settings.msaa, most); }"
        ).get("chosen")
        is None
    )
    assert (
        only(
            from_above
            + "void f() { m_max = pick(p); } void g(int sampleCount) { if (sampleCount > m_max) "
            "sampleCount = m_max; }"
        ).get("chosen")
        is None
    )
    assert (
        only(
            from_above
            + "void f() { m_max = pick(p); if (m_max > VK_SAMPLE_COUNT_1_BIT) resolve(); }"
        )["chosen"]
        == "MAXIMUM"
    )


def test_four_is_offered_everywhere() -> None:
    """Tests after that of four are unreachable, except for masks that may lack it."""
    order = [(4, 4), (2, 2), (8, 8), (16, 16)]
    assert only(function(chain(order)))["atMost"] == 4
    assert (
        only(function(chain(order)).replace(COLOR, "framebufferIntegerColorSampleCounts"))["atMost"]
        == 16
    )


CLEAN = {
    "from four": function(chain([(4, 4), (2, 2)])),
    "by the user": function(
        "for (uint32_t c = wanted; c > 1; c >>= 1) if (counts & c) return (VkSampleCountFlagBits)c;"
    ),
    "by the user, waiting": function(
        "uint32_t c = wanted; while (!(counts & c)) c >>= 1; return (VkSampleCountFlagBits)c;"
    ),
    "by a bound": function(
        "for (uint32_t c = 64; c >= wanted; c >>= 1) if (counts & c) return "
        "(VkSampleCountFlagBits)c;"
    ),
    "by quality": function(
        "if (quality > 1 && (counts & 8)) return VK_SAMPLE_COUNT_8_BIT; if (quality && (counts & "
        "8)) return VK_SAMPLE_COUNT_4_BIT;"
    ),
    "by switch": function(
        "switch (wanted) { case 8: if (counts & 8) return VK_SAMPLE_COUNT_8_BIT; case 4: if "
        "(counts & 4) return VK_SAMPLE_COUNT_4_BIT; }"
    ),
    "by setting": function("if (settings.high) return VK_SAMPLE_COUNT_8_BIT; " + chain(DESCENDING)),
    "the mask": f"VkSampleCountFlags f() {{ return p.limits.{COLOR} & p.limits.{DEPTH}; }}",
    "a report": f"""void f() {{ auto c = p.limits.{COLOR};
        if (c & VK_SAMPLE_COUNT_8_BIT) printf("8"); if (c & VK_SAMPLE_COUNT_8_BIT) counts.push_back(VK_SAMPLE_COUNT_8_BIT);
        has8 = (c & VK_SAMPLE_COUNT_8_BIT) != 0; }}""",
    "numbers of bits": """int f(VkSampleCountFlags c) {
        if (c & VK_SAMPLE_COUNT_64_BIT) return 64; if (c & VK_SAMPLE_COUNT_32_BIT) return 32; return 1; }""",
    "other bits": """int f(int flags, int sampleCount) {
        if (flags & 64) return 64; if (flags & 8) return 8; if (flags & 8) return 4; return 1; }""",
    "the lesser count": f"auto f() {{ return std::min(greatest(p.limits.{COLOR}), "
    f"greatest(p.limits.{DEPTH})); }}",
    "both there": f"bool f() {{ return p.limits.{COLOR} && p.limits.{DEPTH}; }}",
    "a condition": f"void f() {{ if (p.limits.{COLOR} && p.limits.{DEPTH}) go(); }}",
    "either, listed": f"void f() {{ VkSampleCountFlags any = p.limits.{COLOR} | p.limits.{DEPTH}; "
    f"show(any); }}",
    "supported": f"bool f(VkSampleCountFlagBits s) {{ return p.limits.{COLOR} & p.limits.{DEPTH} & "
    f"s; }}",
    "in a comment": f"// VkSampleCountFlags c = std::min(p.limits.{COLOR}, p.limits.{DEPTH});\nint "
    "sampleCount;",
    "in a string": f'const char *text = "std::min(p.limits.{COLOR}, p.limits.{DEPTH})";',
}


@pytest.mark.parametrize("name", CLEAN)
def test_what_must_not_be_found(name: str) -> None:
    assert fired(CLEAN[name]) == []


def test_statements_of_a_page() -> None:
    text = f"VkSampleCountFlags counts = std::min(p.limits.{COLOR}, p.limits.{DEPTH})\n"
    assert fired(f"# Page\n\n```cpp\n{text}```\n", "markdown") == [("MSAA852", 4, "std::min")]
    chained = (
        f"```cpp\n{BOTH}\nif (counts & VK_SAMPLE_COUNT_64_BIT) {{ samples = "
        f"VK_SAMPLE_COUNT_64_BIT; }}\n```\n"
    )
    assert fired(chained, "markdown") == [("MSAA851", 3, "counts & VK_SAMPLE_COUNT_64_BIT")]


def test_two_choices_have_two_names() -> None:
    text = (
        f"void f() {{ samples = std::bit_floor(p.limits.{COLOR}); }} void g() {{ samples = "
        f"std::bit_floor(p.limits.{DEPTH}); }}"
    )
    assert list(read(text)) == ["samples", "samples 2"]


HOSTILE = [
    "auto c = " + "(" * 5000 + f"l.{COLOR}" + ")" * 5000 + ";",
    "auto c = " + f"l.{COLOR} & " * 5000 + "1;",
    "auto c = " + "a ? " * 3000 + f"l.{COLOR}" + " : 1" * 3000 + ";",
    "void f() {" + "{" * 2000 + BOTH + chain(DESCENDING) + "}" * 2000 + "}",
    "void f() {" + BOTH + "if (counts & 8) s = 8; else " * 3000 + ";}",
    "void f() {" + BOTH + "if (counts & 8) return 4;" * 5000 + "}",
    "auto c = " + "std::min(" * 2000 + f"l.{COLOR}" + f", l.{DEPTH})" * 2000 + ";",
    "auto s = " + "[&]() { return " * 500 + f"l.{COLOR}" + "; }()" * 500 + ";",
    "a::" * 3000 + f"sampleCount & l.{COLOR};",
    "uint32_t c = 64; while (!(" + "!" * 2000 + f"(l.{COLOR} & c))) c >>= 1;",
    f"void f() {{ samples = std::bit_floor(l.{COLOR}); "
    + "x = samples; use(samples); " * 3000
    + "}",
    function(chain([(4, 4)]))
    + "void g() { auto samples = pick(p); "
    + "".join(
        f"aFormat{n} = bFormat{n % 97} + cFormat(aFormat{n // 2}, bFormat{n % 13}); make(samples, "
        f"aFormat{n}); "
        for n in range(2000)
    )
    + "}",
    "\x00\ufffd SampleCount }}}} ((( if (counts & ",
]


@pytest.mark.parametrize("n", range(len(HOSTILE)))
def test_hostile_code_ends_soon(n: int) -> None:
    begun = time.process_time()
    read(HOSTILE[n])
    assert time.process_time() - begun < 5


RUST_MASK = """let limits = instance.get_physical_device_properties(device).limits;
let counts = limits.framebuffer_color_sample_counts & limits.framebuffer_depth_sample_counts;
"""
RUST_TEST = (
    "if counts.contains(vk::SampleCountFlags::TYPE_{0}) {{ return "
    "vk::SampleCountFlags::TYPE_{1}; }}"
)
RUST_STYLES = {
    "ifs": chain(DESCENDING, RUST_TEST) + "vk::SampleCountFlags::TYPE_1",
    "else if": " else ".join(
        f"if counts.contains(vk::SampleCountFlags::TYPE_{n}) {{ vk::SampleCountFlags::TYPE_{n} }}" for n, _ in DESCENDING
    )
    + " else { vk::SampleCountFlags::TYPE_1 }",
    "a variable": "let best = "
    + " else ".join(f"if counts.contains(vk::SampleCountFlags::TYPE_{n}) {{ "
        f"vk::SampleCountFlags::TYPE_{n} }}" for n, _ in DESCENDING)
    + " else { vk::SampleCountFlags::TYPE_1 }; best",
    "intersects": chain(DESCENDING, RUST_TEST.replace("contains",
    "intersects")) + "vk::SampleCountFlags::TYPE_1",
    "is_empty": chain(
        DESCENDING, "if !(counts & vk::SampleCountFlags::TYPE_{0}).is_empty() {{ return "
            "vk::SampleCountFlags::TYPE_{1}; }}"
    ),
    "equal": chain(
        DESCENDING,
        "if (counts & vk::SampleCountFlags::TYPE_{0}) == vk::SampleCountFlags::TYPE_{0} {{ return "
        "vk::SampleCountFlags::TYPE_{1}; }}",
    ),
    "not empty": chain(
        DESCENDING,
        "if counts & vk::SampleCountFlags::TYPE_{0} != vk::SampleCountFlags::empty() {{ return "
        "vk::SampleCountFlags::TYPE_{1}; }}",
    ),
    "vulkanalia": "[" + ", ".join(f"vk::SampleCountFlags::_{n}" for n, _ in DESCENDING) + "]"
    ".iter().cloned().find(|c| counts.contains(*c)).unwrap_or(vk::SampleCountFlags::_1)",
    "filtered": "[" + ", ".join(f"vk::SampleCountFlags::TYPE_{n}" for n, _ in DESCENDING) + "]"
    ".into_iter().filter(|&c| counts.contains(c)).next().unwrap()",
    "reversed": "[" + ", ".join(f"vk::SampleCountFlags::TYPE_{n}" for n,
    _ in reversed(DESCENDING)) + "]"
    ".into_iter().rev().find(|&c| counts.contains(c)).unwrap()",
    "a loop": "for count in [" + ", ".join(f"vk::SampleCountFlags::TYPE_{n}" for n,
    _ in DESCENDING) + "]"
    " { if counts.contains(count) { return count; } } vk::SampleCountFlags::TYPE_1",
    "halved": "let mut count = 64; while count > 1 { if counts.as_raw() & count != 0 { return "
        "count; } count >>= 1; } 1",
    "vulkano": chain(DESCENDING, "if counts.intersects(SampleCounts::SAMPLE_{0}) {{ return "
        "SampleCount::Sample{1}; }}"),
}  # fmt: skip


def rust(body: str) -> str:
    return (
        "use ash::vk;\nfn pick(instance: &Instance, device: vk::PhysicalDevice) -> "
        f"vk::SampleCountFlags {{\n{RUST_MASK}{body}\n}}\n"
    )


@pytest.mark.parametrize("style", RUST_STYLES)
def test_a_choice_in_rust(style: str) -> None:
    found = only(rust(RUST_STYLES[style]), "rust")
    assert (found["limits"], found["combined"]) == ([COLOR, DEPTH], "AND")
    assert (found["chosen"], found["atMost"]) == ("MAXIMUM", 64)
    assert asked(found) == DESCENDING


@pytest.mark.parametrize(
    ("masks", "combined", "at"),
    [
        (
            "limits.framebuffer_color_sample_counts.min(limits.framebuffer_depth_sample_counts)",
            "MIN",
            "min",
        ),
        (
            "std::cmp::min(limits.framebuffer_color_sample_counts, "
            "limits.framebuffer_depth_sample_counts)",
            "MIN",
            "std::cmp::min",
        ),
        (
            "limits.framebuffer_color_sample_counts.max(limits.framebuffer_depth_sample_counts)",
            "MAX",
            "max",
        ),
        (
            "limits.framebuffer_color_sample_counts | limits.framebuffer_depth_sample_counts",
            "OR",
            "|",
        ),
    ],
)
def test_masks_that_rust_compares(masks: str, combined: str, at: str) -> None:
    text = rust(
        f"let counts = {masks};\n{chain([(4, 4), (2, 2)], RUST_TEST)}\nvk::SampleCountFlags::TYPE_1"
    )
    assert only(text, "rust")["combined"] == combined
    name = "example.rs"
    linted = ENGINE.lint(
        read_source_file(text.encode(), name, "rust"), name, LintOptions(as_written)
    )
    (found,) = [item for item in linted.findings if item.code[:6] == "MSAA85"]
    assert found.span is not None
    assert (found.code, text[found.span.start : found.span.end]) == ("MSAA852", at)


RUST_CLEAN = {
    "from four": chain([(4, 4), (2, 2)], RUST_TEST),
    "by the user": "if counts.contains(wanted) { wanted } else { vk::SampleCountFlags::TYPE_1 }",
    "by the user, listed": "[vk::SampleCountFlags::TYPE_8, "
    "vk::SampleCountFlags::TYPE_4].into_iter()"
    ".find(|&c| c <= wanted && counts.contains(c)).unwrap_or(vk::SampleCountFlags::TYPE_1)",
    "by a setting": "if counts.contains(vk::SampleCountFlags::TYPE_8) && wanted >= 8 { return "
    "vk::SampleCountFlags::TYPE_8; }",
    "capped": f"let best = {{ "
    f"{chain(DESCENDING, RUST_TEST.replace('return ', '').replace('; }}', ' }}'))} }}; best.min(wanted)",
}


@pytest.mark.parametrize("name", RUST_CLEAN)
def test_what_must_not_be_found_in_rust(name: str) -> None:
    text = rust(RUST_CLEAN[name])
    linted = ENGINE.lint(
        read_source_file(text.encode(), "example.rs", "rust"), "example.rs", LintOptions(as_written)
    )
    assert [item.code for item in linted.findings if item.code[:6] == "MSAA85"] == []


def test_a_depth_format_of_a_count_that_rust_chooses() -> None:
    use = """
fn create(device: &ash::Device, samples: vk::SampleCountFlags) {
    let info = vk::ImageCreateInfo::default().format(vk::Format::D24_UNORM_S8_UINT).samples(samples);
}
fn main() { let samples = pick(&instance, physical); create(&device, samples); }
"""
    text = rust(chain([(4, 4)], RUST_TEST) + "vk::SampleCountFlags::TYPE_1") + use
    assert only(text, "rust")["formats"] == ["D24_UNORM_S8_UINT"]

"""Descriptions read from C and C++: locations, configurations, objects, limits."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from msaa_lint.core.text.emitter import emit
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.input.code.c.description_trees import trees
from msaa_lint.input.code.parsing import Code, ascii_only
from tests.input.code.expected import PROGRAMS

HEAD = "#include <vulkan/vulkan.h>\n"


def read(text: str, language: str = "cpp", fragments: bool = False) -> dict[str, object]:
    """Returns the description of a program, without locations."""
    found = trees(Code(ascii_only(text), language, fragments))
    assert len(found) <= 1
    made = yaml.safe_load(emit(found[0].tree)) if found else {}
    assert isinstance(made, dict)
    return made


def node(text: str, *path: str | int) -> Node:
    """Returns a node of a program's description."""
    (found,) = trees(Code(ascii_only(text), "cpp"))
    at = found.tree
    for part in path:
        at = at.value[part]
    return at


def image(body: str, before: str = "") -> str:
    """Returns a program that creates an image and renders to it."""
    return f"""{HEAD}{before}
void make(VkDevice device, VkCommandBuffer commands, VkFormat format, bool msaa, int level) {{
    VkImageCreateInfo info{{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO}};
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    {body}
    VkImage image;
    vkCreateImage(device, &info, nullptr, &image);
    VkImageViewCreateInfo made{{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO}};
    made.image = image;
    VkImageView view;
    vkCreateImageView(device, &made, nullptr, &view);
    VkRenderingAttachmentInfo color{{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO}};
    color.imageView = view;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    VkRenderingInfo rendering{{VK_STRUCTURE_TYPE_RENDERING_INFO}};
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &color;
    vkCmdBeginRendering(commands, &rendering);
}}
"""


SAMPLES = [
    ("info.samples = VK_SAMPLE_COUNT_4_BIT;", 4),
    ("info.samples = (VkSampleCountFlagBits)8;", 8),
    ("info.samples = static_cast<VkSampleCountFlagBits>(1 << 1);", 2),
    ("info.samples = msaa ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;", 4),
    ("info.samples = VK_SAMPLE_COUNT_1_BIT; if (msaa) info.samples = VK_SAMPLE_COUNT_4_BIT;", 4),
    (
        "if (!msaa) info.samples = VK_SAMPLE_COUNT_1_BIT; else info.samples = "
        "VK_SAMPLE_COUNT_8_BIT;",
        8,
    ),
    ("info.samples = VK_SAMPLE_COUNT_8_BIT; info.samples = VK_SAMPLE_COUNT_4_BIT;", 4),
    (
        "switch (level) { case 1: info.samples = VK_SAMPLE_COUNT_2_BIT; break; case 2: "
        "info.samples = VK_SAMPLE_COUNT_4_BIT; break; }",
        4,
    ),
    ("auto pick = [&] { return VK_SAMPLE_COUNT_4_BIT; }; info.samples = pick();", 4),
    ("VkImageCreateInfo* p = &info; p->samples = VK_SAMPLE_COUNT_4_BIT;", 4),
    ("VkImageCreateInfo& r = info; r.samples = VK_SAMPLE_COUNT_4_BIT;", 4),
    (
        "VkImageView out = VK_NULL_HANDLE; info.samples = out ? VK_SAMPLE_COUNT_1_BIT : "
        "VK_SAMPLE_COUNT_4_BIT;",
        4,
    ),
    ("info.samples = VK_SAMPLE_COUNT_1_BIT;", 1),
    ("info.samples = unknown();", None),
    ("change(&info);", None),
    (
        "for (int i = 0; i < level; i++) info.samples = (VkSampleCountFlagBits)(info.samples * 2);",
        None,
    ),
]


@pytest.mark.parametrize(("body", "count"), SAMPLES)
def test_a_count(body: str, count: int | None) -> None:
    images = read(image(body)).get("images")
    assert isinstance(images, dict)
    assert images["image"].get("samples") == count


LONG = f"static const uint32_t shader[] = {{2, 4, {'0x08, ' * 200}}};\n"
"""A list that is too long to say something of a frame, such as the code of a shader. It is not
parsed.
"""


@pytest.mark.parametrize(
    ("body", "count"), [("info.samples = (VkSampleCountFlagBits)shader[1];", None), SAMPLES[0]]
)
def test_a_long_list_of_numbers_is_unknown(body: str, count: int | None) -> None:
    images = read(image(body, LONG)).get("images")
    assert isinstance(images, dict)
    assert images["image"].get("samples") == count
    assert node(image(SAMPLES[0][0], LONG), "images", "image", "samples").start == image(
        SAMPLES[0][0], LONG
    ).index("VK_SAMPLE_COUNT_4_BIT")


def test_what_hangs_on_the_same_condition_goes_the_same_way() -> None:
    """The multisampled configuration is described, whatever the condition is called."""
    for condition in (
        "msaa",
        "level > 1",
        "level != 1",
        "settings.samples > VK_SAMPLE_COUNT_1_BIT",
        "isOn()",
    ):
        body = f"""
            info.samples = {condition} ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
            if ({condition}) info.usage |= VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT; else info.usage = 0;"""
        images = read(image(body))["images"]
        assert images == {
            "image": {
                **images["image"],
                "samples": 4,
                "usage": ["COLOR_ATTACHMENT", "TRANSIENT_ATTACHMENT"],
            }
        }


def test_what_hangs_on_another_condition_is_not_known() -> None:
    body = (
        "info.samples = msaa ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT; if (level) "
        "info.usage = VK_IMAGE_USAGE_SAMPLED_BIT;"
    )
    images = read(image(body))["images"]
    assert "usage" not in images["image"]


@pytest.mark.parametrize("count", [1, 10, 11, 12, 13, 30])
def test_conditional_writes_leave_the_value_before_them_possible(count: int) -> None:
    """Whatever their number: with too many alternatives, the value is unknown."""
    conditional = "".join(
        f"if (device_{n}) info.tiling = VK_IMAGE_TILING_LINEAR;\n" for n in range(count)
    )
    body = (
        "info.samples = VK_SAMPLE_COUNT_4_BIT; info.tiling = VK_IMAGE_TILING_OPTIMAL; "
        f"{conditional}"
    )
    images = read(image(body).replace("info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO}", "info"))[
        "images"
    ]
    assert "tiling" not in images["image"]
    images = read(image(f"{body} info.tiling = VK_IMAGE_TILING_OPTIMAL;"))["images"]
    assert images["image"]["tiling"] == "OPTIMAL", "an unconditional write replaces all before it"


@pytest.mark.parametrize("count", [1, 10])
def test_an_unconditional_write_is_kept_below_conditional_ones(count: int) -> None:
    conditional = "".join(
        f"if (device_{n}) info.tiling = VK_IMAGE_TILING_OPTIMAL;\n" for n in range(count)
    )
    images = read(
        image(
            "info.samples = VK_SAMPLE_COUNT_4_BIT; info.tiling = VK_IMAGE_TILING_OPTIMAL; "
            f"{conditional}"
        )
    )["images"]
    assert images["image"]["tiling"] == "OPTIMAL"


@pytest.mark.parametrize("count", [12, 13, 30])
def test_a_member_with_too_many_writers_is_unknown(count: int) -> None:
    """The last function may write a value that the others do not."""
    last = "void last() { tiling = VK_IMAGE_TILING_LINEAR; }"
    before = "".join(
        f"void set{n}() {{ tiling = VK_IMAGE_TILING_OPTIMAL; }}\n" for n in range(count)
    )
    text = image(
        "info.samples = VK_SAMPLE_COUNT_4_BIT; info.tiling = tiling;",
        f"VkImageTiling tiling;\n{before}{last}",
    )
    images = read(text)["images"]
    assert "tiling" not in images["image"]


def test_a_flag_of_a_helpers_call_stands_at_the_call() -> None:
    text = f"""{HEAD}
void create(VkDevice device, VkImageUsageFlags usage, VkImage* image) {{
    VkImageCreateInfo info{{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO}};
    info.format = VK_FORMAT_D32_SFLOAT;
    info.samples = VK_SAMPLE_COUNT_4_BIT;
    info.usage = usage;
    vkCreateImage(device, &info, nullptr, image);
}}
void all(VkDevice device) {{
    VkImage depth, other;
    create(device, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, &depth);
    create(device, VK_IMAGE_USAGE_SAMPLED_BIT, &other);
}}
"""
    for name, flag in (
        ("depth", "VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT"),
        ("other", "VK_IMAGE_USAGE_SAMPLED_BIT"),
    ):
        found = node(text, "images", name, "usage", 0)
        assert text[found.start : found.end] == flag


def test_a_structure_is_taken_as_it_is_at_the_call() -> None:
    text = f"""{HEAD}
void all(VkDevice device, VkImage* images) {{
    VkImage first, second;
    VkImageCreateInfo info{{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO}};
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    info.samples = VK_SAMPLE_COUNT_4_BIT;
    vkCreateImage(device, &info, nullptr, &first);
    info.samples = VK_SAMPLE_COUNT_8_BIT;
    vkCreateImage(device, &info, nullptr, &second);
}}
"""
    images = read(text)["images"]
    assert {name: each["samples"] for name, each in images.items()} == {"first": 4, "second": 8}


def test_objects_of_one_class_are_told_apart() -> None:
    text = f"""{HEAD}
struct Target {{
    Target(VkDevice device, VkImageUsageFlags usage, VkSampleCountFlagBits samples) {{
        VkImageCreateInfo info{{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO}};
        info.format = VK_FORMAT_R8G8B8A8_UNORM;
        info.usage = usage;
        info.samples = samples;
        vkCreateImage(device, &info, nullptr, &image);
    }}
    VkImage image;
}};
class Scene {{
    Scene(VkDevice device)
        : color(device, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_SAMPLE_COUNT_4_BIT),
          id(device, VK_IMAGE_USAGE_SAMPLED_BIT, VK_SAMPLE_COUNT_8_BIT) {{}}
    Target color, id;
}};
"""
    images = read(text)["images"]
    assert {name: each["samples"] for name, each in images.items()} == {
        "color.image": 4,
        "id.image": 8,
    }


@pytest.mark.parametrize(
    "path", [path for path in PROGRAMS if path.suffix in (".c", ".cpp")], ids=lambda path: path.name
)
def test_what_is_read_is_a_description_without_mistakes(path: Path) -> None:
    text = path.read_bytes().decode()
    for found in trees(Code(ascii_only(text), "c" if path.suffix == ".c" else "cpp")):
        parsed = parse(Source("read.yaml", emit(found.tree)), Limits())
        assert not parsed.problems


MUCH = {
    "parentheses": "void f() { samples = " + "(" * 20000 + "1" + ")" * 20000 + "; }",
    "blocks": "void f_samples() {" + "{" * 20000 + "}" * 20000 + "}",
    "setters": "void f_samples() { x" + ".setSamples(1)" * 5000 + "; }",
    "flags": "void f_samples() { int x = " + " | ".join(["VK_SAMPLE_COUNT_4_BIT"] * 5000) + "; }",
    "else": "void f_samples() { if (a) { x.samples = 1; } "
    + "else if (b) { x.samples = 2; } " * 5000
    + "}",
    "namespaces": "namespace a {" * 5000 + "void f_samples() {}" + "}" * 5000,
    "calls": "".join(
        f"void f{n}_samples() {{ f{n + 1}_samples(); f{n + 1}_samples(); f{n + 1}_samples(); }}\n"
        for n in range(1000)
    ),
    "itself": "void f_samples() { f_samples(); g_samples(); } void g_samples() { f_samples(); "
    "g_samples(); }",
    "writes": "void f_samples() { VkAttachmentDescription a{}; "
    + "a.samples = VK_SAMPLE_COUNT_4_BIT; " * 5000
    + "}",
    "lambdas": "void f_samples() { auto x = " + "[]{ return " * 1000 + "1" + ";}" * 1000 + "; }",
    "list": "void f_samples() { std::vector<VkAttachmentDescription> v; "
    + "v.push_back(v[0]); " * 2000
    + "}",
    "conditions": "void f_samples() { " + "if (a) " * 5000 + "x.samples = 1; }",
    "nothing": "",
    "no code": "\x00\x01 attachment sample \ufeff {{{ ((( <<< >>> ;;; '\"",
}


@pytest.mark.parametrize("name", MUCH)
def test_what_is_too_much_is_passed_over(name: str) -> None:
    for language in ("c", "cpp"):
        for fragments in (False, True):
            trees(Code(ascii_only(MUCH[name]), language, fragments))


LISTED = [
    (
        "\n#ifdef MSAA\n.samples = VK_SAMPLE_COUNT_4_BIT,\n#else\n.samples = "
        "VK_SAMPLE_COUNT_1_BIT,\n#endif\n",
        4,
    ),
    (
        "\n#if defined(MSAA)\n.samples = VK_SAMPLE_COUNT_4_BIT,\n#else\n.samples = "
        "VK_SAMPLE_COUNT_1_BIT,\n#endif\n",
        4,
    ),
    (
        "\n#ifndef MSAA\n.samples = VK_SAMPLE_COUNT_1_BIT,\n#else\n.samples = "
        "VK_SAMPLE_COUNT_4_BIT,\n#endif\n",
        4,
    ),
    (
        ".samples = (VkSampleCountFlagBits)(VK_SAMPLE_COUNT_4_BIT\n#ifdef MORE\n* 2\n#endif\n),",
        None,
    ),
]


@pytest.mark.parametrize(("listed", "count"), LISTED)
def test_a_directive_in_braces(listed: str, count: int | None) -> None:
    """The grammar has none there."""
    text = f"""{HEAD}
void create(VkDevice device, VkImage* image) {{
    VkImageCreateInfo info{{
        .format = VK_FORMAT_R8G8B8A8_UNORM,{listed}
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
    }};
    vkCreateImage(device, &info, nullptr, image);
}}
"""
    found = read(text).get("images", {})
    assert isinstance(found, dict)
    assert [image.get("samples") for image in found.values()] == (
        [count] if count is not None else []
    )


def test_which_member_is_which_is_not_known_behind_a_directive() -> None:
    text = f"""{HEAD}
void create(VkDevice device, VkImage* image) {{
    VkImageCreateInfo info{{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, nullptr, 0, VK_IMAGE_TYPE_2D,
#ifdef WIDE
        VK_FORMAT_R16G16B16A16_SFLOAT,
#else
        VK_FORMAT_R8G8B8A8_UNORM,
#endif
        extent, 1, 1, VK_SAMPLE_COUNT_4_BIT, VK_IMAGE_TILING_OPTIMAL, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT}};
    vkCreateImage(device, &info, nullptr, image);
}}
"""
    assert "samples" not in str(read(text).get("images", ""))

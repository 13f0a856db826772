"""Vulkan names as C and C++ spell them, compared with the registry."""

from __future__ import annotations

import pytest

from msaa_lint.input.code.core.types import array_size, element_type
from msaa_lint.input.code.vulkan.names import (
    MEMBERS,
    WITHOUT_TYPE,
    constant,
    member,
    setter_member,
    vulkan_struct,
)


@pytest.fixture(scope="module")
def registry() -> dict[str, list[str]]:
    vulkan_object = pytest.importorskip("vulkan_object")
    structs = vulkan_object.get_vulkan_object().structs
    names = {name: [each.name for each in struct.members] for name, struct in structs.items()}
    return names | {
        alias: names[name] for name, struct in structs.items() for alias in struct.aliases
    }


@pytest.mark.parametrize("kind", sorted(MEMBERS))
def test_members_come_in_the_registrys_order(kind: str, registry: dict[str, list[str]]) -> None:
    members = next(
        registry[f"Vk{kind}{suffix}"]
        for suffix in ("", "KHR", "EXT")
        if f"Vk{kind}{suffix}" in registry
    )
    assert ("sType" not in members) == (kind in WITHOUT_TYPE)
    own = [name for name in members if name not in ("sType", "pNext")]
    # Of some structures, rules need only the first members.
    assert list(MEMBERS[kind]) == own[: len(MEMBERS[kind])]


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("VK_SAMPLE_COUNT_4_BIT", 4),
        ("vk::SampleCountFlagBits::e16", 16),
        ("VK_TRUE", True),
        ("VK_SUCCESS", 0),
        ("vk::AttachmentStoreOp::eDontCare", "DONT_CARE"),
        ("vk::ImageLayout::ePresentSrcKHR", "PRESENT_SRC_KHR"),
        ("VULKAN_HPP_NAMESPACE::Format::eD24UnormS8Uint", "D24_UNORM_S8_UINT"),
        ("vk::PipelineStageFlagBits::eColorAttachmentOutput", "COLOR_ATTACHMENT_OUTPUT"),
        ("VK_ATTACHMENT_STORE_OP_STORE", "VK_ATTACHMENT_STORE_OP_STORE"),
        ("VK_NULL_HANDLE", None),
        ("vk::AttachmentStoreOp::eNoSuch", None),
        ("Quality::e4", None),
        ("samples", None),
    ],
)
def test_constants(name: str, value: object) -> None:
    assert constant(name) == value
    assert type(constant(name)) is type(value)


def test_types() -> None:
    assert (
        vulkan_struct("VkImageCreateInfo")
        == vulkan_struct("vk::ImageCreateInfo")
        == "ImageCreateInfo"
    )
    assert vulkan_struct("VkRenderingAttachmentInfoKHR") == "RenderingAttachmentInfo"
    assert (
        vulkan_struct("VkImageCreateInfo[3]")
        == vulkan_struct("VkDevice")
        == vulkan_struct("ImageCreateInfo")
        == ""
    )
    assert (
        element_type("std::array<VkImageView,3>")
        == element_type("VkImageView[]")
        == element_type("std::vector<VkImageView>")
        == "VkImageView"
    )
    assert element_type("VkImageView") is None
    assert [
        array_size(text)
        for text in (
            "std::array<VkImageView,3>",
            "VkImageView[N]",
            "VkImageView[]",
            "std::vector<VkImageView>",
        )
    ] == [
        "3",
        "N",
        "",
        "",
    ]


def test_members_and_setters() -> None:
    assert [member(name) for name in ("pAttachments", "pNext", "preserve", "p")] == [
        "attachments",
        "next",
        "preserve",
        "p",
    ]
    assert [
        setter_member(name)
        for name in ("setSamples", "setPDepthStencilAttachment", "settle", "samples")
    ] == [
        "samples",
        "depthStencilAttachment",
        None,
        None,
    ]

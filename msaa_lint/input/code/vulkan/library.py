"""Vulkan's names in source code, as the interpreter asks for them."""

from __future__ import annotations

import re

from msaa_lint.frame.vulkan.names import parse_enum
from msaa_lint.input.code.core.library import Construction, Library

from . import names

_CAST = re.compile(r"(?:Vk|vk::)\w+(?:FlagBits2?|Flags2?|Bool32)(?:KHR|EXT)?$")

_COUNTS = re.compile(
    r"max.*sample|sample.*max|usable.*sample|supported.*sample|best.*sample|sample.*support|choose.*sample|pick.*sample|select.*sample|clamp.*sample"
    r"|^clamp$",
    re.IGNORECASE,
)

_DYNAMIC = re.compile(
    r"(?:DYNAMIC_STATE_|^)(?:RASTERIZATION_SAMPLES|SAMPLE_MASK|ALPHA_TO_|SAMPLE_LOCATIONS_ENABLE)"
)

_MEMBER_TYPES = {
    "extent": "VkExtent3D",
    "subpasses": "std::vector<VkSubpassDescription>",
    "dependencies": "std::vector<VkSubpassDependency>",
    "depthStencilAttachment": "VkAttachmentReference",
    "fragmentDensityMapAttachment": "VkAttachmentReference",
    "shadingRateAttachmentTexelSize": "VkExtent2D",
}

_ONE_SAMPLE = {
    "AttachmentDescription": {"samples": 1},
    "AttachmentDescription2": {"samples": 1},
    "ImageCreateInfo": {"samples": 1},
    "PipelineMultisampleStateCreateInfo": {"rasterizationSamples": 1},
}
"""The members of structures of vulkan.hpp that default to a sample count of 1 rather than 0."""


class VulkanLibrary(Library):
    """The names of Vulkan in C and of vulkan.hpp."""

    def __init__(self) -> None:
        self.has_dynamic_samples = False
        """Whether the program makes a part of the multisample state dynamic
        (VK_EXT_extended_dynamic_state3, VK_EXT_shader_object).
        """

    def constant(self, name: str) -> int | str | bool | None:
        value = names.constant(name)
        if isinstance(value, str) and _DYNAMIC.search(value):
            self.has_dynamic_samples = True
        return value

    def structure(self, type_text: str) -> str:
        return names.vulkan_struct(type_text)

    def construction(self, type_text: str) -> Construction:
        structure = names.vulkan_struct(type_text)
        is_hpp = type_text.startswith(("vk::", "VULKAN"))
        members = names.MEMBERS[structure]
        if structure not in names.WITHOUT_TYPE:
            members = (*members, "pNext") if is_hpp else ("sType", "pNext", *members)
        return Construction(
            structure, members, _ONE_SAMPLE.get(structure, {}) if is_hpp else {}, is_hpp
        )

    def is_alike(self, structure: str, other: str) -> bool:
        return names.first_version(structure) == names.first_version(other)

    def member(self, name: str) -> str:
        return names.member(name)

    def member_type(self, structure: str, member: str) -> str:
        return _MEMBER_TYPES.get(names.member(member), "") if structure else ""

    def setter(self, method: str) -> str | None:
        return names.setter_member(method)

    def has_member(self, structure: str, member: str) -> bool:
        return member == "next" or member in map(names.member, names.MEMBERS[structure])

    def is_type(self, type_text: str) -> bool:
        return type_text.startswith(("Vk", "VK", "PFN", "vk::"))

    def is_scalar(self, type_text: str) -> bool:
        return names.is_scalar(type_text)

    def is_cast(self, type_text: str) -> bool:
        return _CAST.match(type_text) is not None

    def is_format(self, value: str) -> bool:
        return parse_enum("VkFormat", value) not in (None, "UNDEFINED")

    def is_success(self, name: str) -> bool:
        return name.endswith(("VK_SUCCESS", "Result::eSuccess"))

    def is_count_choice(self, function: str) -> bool:
        return _COUNTS.search(function) is not None
